/*
 * replay.c - runs a fuzz target on files, without a fuzzer
 */
#include "fuzz.h"

static void replay(const char *name)
{
    enum { MOST = 1 << 20 };
    FILE *file = fopen(name, "rb");
    uint8_t *data = malloc(MOST);
    MUST(file && data);
    const size_t size = fread(data, 1, MOST, file);
    fclose(file);
    /* The memory ends with the input, so a sanitizer detects reading beyond. */
    data = realloc(data, size + (size == 0));
    MUST(data);
    LLVMFuzzerTestOneInput(data, size);
    free(data);
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        replay(argv[i]);
    return 0;
}
