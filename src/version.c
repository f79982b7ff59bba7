/*
 * version.c - which library this is, and how large its structs are
 */
#include "cylint.h"

const char *cylint_version(void)
{
    return CYLINT_VERSION;
}

int cylint_version_number(void)
{
    return CYLINT_VERSION_NUMBER;
}

size_t cylint_sizeof_shape(void)
{
    return sizeof(cylint_shape);
}

size_t cylint_sizeof_line(void)
{
    return sizeof(cylint_line);
}

size_t cylint_sizeof_hit(void)
{
    return sizeof(cylint_hit);
}

size_t cylint_sizeof_answer(void)
{
    return sizeof(cylint_answer);
}

size_t cylint_sizeof_pack(void)
{
    return sizeof(cylint_pack);
}
