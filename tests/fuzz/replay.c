/*
 * replay.c - runs a fuzz target on files, where there is no fuzzer
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
    /* Room that ends where the input does, so that a sanitizer sees whoever
     * reads on. */
    data = realloc(data, size + (size == 0));
    MUST(data);
    LLVMFuzzerTestOneInput(data, size);
    free(data);
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        replay(argv[i]);
    }
    return 0;
}
