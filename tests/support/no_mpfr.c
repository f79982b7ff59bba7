/*
 * no_mpfr.c - stands for a program that compares with MPFR where there is none
 */
#include "program.h"

int main(void)
{
    return check_skip("no MPFR: nothing to compare with (make deps)");
}
