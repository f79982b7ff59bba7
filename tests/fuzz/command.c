/*
 * command.c - fuzzes the whole command
 *
 * An input has the arguments in its first line, separated by single blanks,
 * then standard input, the content of files, and that of the files whose names
 * begin with y; lines `%%` separate them.  The command runs twice: with one
 * worker that reads a file, and with two workers that read a pipe a few bytes at
 * a time.  Both must write the same bytes and exit with the same status.  The
 * Makefile links this file's open(), read(), write() and close() in place of the
 * system's, so nothing else is written.
 */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "../../tools/cylint/report.h"
#include "fuzz.h"

enum { PIPE_MOST = 1 << 15, ARGUMENTS_MOST = 64 };
enum { STANDARD_INPUT, FILES, Y_FILES, TEXTS };

/* The input and output of the current run. */
static struct {
    const char *text[TEXTS];
    size_t size[TEXTS];
    int piped;
    unsigned long long written, hash;
    char last;
} now;

int command_main(int argc, char **argv); /* main() of tools/cylint/main.c */
int __real_open(const char *name, int flags, ...);
ssize_t __real_read(int fd, void *to, size_t n);
ssize_t __real_write(int fd, const void *from, size_t n);
int __real_close(int fd);

/* ------------------------------------------------------------ the files -- */

/* A descriptor that reads this text. */
static int readable(int text)
{
    const size_t size = now.size[text];
    FILE *file = tmpfile();
    MUST(file);
    const int fd = dup(fileno(file));
    MUST(fd >= 0 && fclose(file) == 0);
    MUST(__real_write(fd, now.text[text], size) == (ssize_t)size);
    MUST(lseek(fd, 0, SEEK_SET) == 0);
    return fd;
}

static int piped(int text)
{
    const size_t size = now.size[text];
    int ends[2];
    MUST(pipe(ends) == 0);
    MUST(__real_write(ends[1], now.text[text], size) == (ssize_t)size);
    MUST(__real_close(ends[1]) == 0);
    return ends[0];
}

static void become(int number, int fd)
{
    MUST(fd >= 0 && dup2(fd, number) == number);
    MUST(__real_close(fd) == 0);
}

int __wrap_open(const char *name, int flags, ...)
{
    if ((flags & O_ACCMODE) != O_RDONLY)
        return __real_open("/dev/null", flags & O_ACCMODE);
    if (name[0] == '/') {
        errno = ENOENT;
        return -1;
    }
    return readable(name[0] == 'y' ? Y_FILES : FILES);
}

ssize_t __wrap_read(int fd, void *to, size_t n)
{
    return __real_read(fd, to, now.piped && n > 7 ? 7 : n);
}

ssize_t __wrap_write(int fd, const void *from, size_t n)
{
    const char *p = from;
    (void)fd;
    for (size_t i = 0; i < n; i++) {
        now.hash = (now.hash ^ (unsigned char)p[i]) * 0x100000001b3u;
        now.last = p[i];
    }
    now.written += n;
    return (ssize_t)n;
}

int __wrap_close(int fd)
{
    return fd > 2 ? __real_close(fd) : 0;
}

/* ------------------------------------------------------------- the runs -- */

/* The command may reorder argv. */
static int run(const char *line, const char *jobs)
{
    char *argv[ARGUMENTS_MOST + 4], *text = strdup(line);
    int argc = 0;
    char name[] = "cylint", option[] = "-j", count[] = "1";
    MUST(text);
    count[0] = jobs[0];
    argv[argc++] = name;
    argv[argc++] = option;
    argv[argc++] = count;
    for (char *p = text; *p && argc < ARGUMENTS_MOST;) {
        char *blank = strchr(p, ' ');
        argv[argc++] = p;
        p = blank ? blank + 1 : p + strlen(p);
        if (blank)
            *blank = '\0';
    }
    argv[argc] = NULL;
    now.piped = jobs[0] != '1';
    now.written = now.hash = 0;
    now.last = '\n';
    become(0, now.piped ? piped(STANDARD_INPUT) : readable(STANDARD_INPUT));
    become(1, __real_open("/dev/null", O_WRONLY));
    const int status = command_main(argc, argv);
    free(text);
    return status;
}

/* Sets a text that ends before a line `%%`, or with the input.  Returns where
 * the next one begins. */
static const char *take_text(int text, const char *from, const char *end)
{
    const char *p = from;
    now.text[text] = from;
    for (; end - p >= 3; p++)
        if (memcmp(p, "%%\n", 3) == 0 && (p == from || p[-1] == '\n'))
            break;
    const int is_marked = end - p >= 3;
    now.size[text] = (size_t)((is_marked ? p : end) - from);
    return is_marked ? p + 3 : end;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *text = (const char *)data, *end = text + size;
    const char *feed = memchr(data, '\n', size);
    if (!feed || size > PIPE_MOST)
        return 0;
    char *line = malloc((size_t)(feed - text) + 1);
    MUST(line);
    memcpy(line, text, (size_t)(feed - text));
    line[feed - text] = '\0';
    const char *from = feed + 1;
    for (int i = 0; i < TEXTS; i++)
        from = take_text(i, from, end);
    const int status = run(line, "1");
    const unsigned long long written = now.written, hash = now.hash;
    MUST(status >= EXIT_ANSWERED && status <= EXIT_IO);
    MUST(now.last == '\n' || /* lines, unless binary */
         strchr(line, 'b') || strstr(line, "save"));
    MUST(run(line, "2") == status);
    MUST(now.written == written && now.hash == hash);
    free(line);
    return 0;
}
