/*
 * kernels.c - prints the names of the kernels that this processor runs, one a
 * line, the narrowest first
 */
#include <stdio.h>

#include "cylint.h"

int main(void)
{
    int n = 0;
    while (cylint_kernels_name(n))
        n++;
    while (n-- > 0)
        puts(cylint_kernels_name(n));
    return 0;
}
