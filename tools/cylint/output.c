/*
 * output.c - writes bytes to standard output or a file
 */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "main.h"
#include "npy.h"
#include "options.h"
#include "output.h"
#include "report.h"

/* Opens each standard stream that is closed in the wrong direction, so that
 * its use fails. */
void guard_standard_streams(void)
{
    for (int fd = 0; fd < 3; fd++)
        if (fcntl(fd, F_GETFD) == -1 && errno == EBADF)
            (void)open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

static int is_output(const struct stat *out, const char *file)
{
    struct stat in;
    const int status = strcmp(file, "-") == 0 ? fstat(0, &in) : stat(file, &in);
    return status == 0 && in.st_dev == out->st_dev && in.st_ino == out->st_ino;
}

static int put_array_header(struct output *out, unsigned long long rows)
{
    char header[NPY_WRITTEN];
    npy_write(header, rows, out->row / sizeof(double));
    return output_write(out, header, sizeof header);
}

int output_is_input(const char *file, const struct options *o)
{
    struct stat s;
    if (stat(file, &s) != 0 || !S_ISREG(s.st_mode))
        return 0;
    int read_too = (o->scene != NULL && is_output(&s, o->scene)) ||
                   (o->rank != NULL && is_output(&s, o->rank));
    for (int i = 0; i < o->file_count; i++)
        read_too |= is_output(&s, o->files[i]);
    if (read_too)
        complain(file, "is both input and output");
    return read_too;
}

/* The number of rows is written at the end, so the file must be seekable. */
static int begin_array(struct output *out)
{
    struct stat s;
    const int way_back = fstat(out->target.fd, &s) == 0 && S_ISREG(s.st_mode) &&
                         !(fcntl(out->target.fd, F_GETFL) & O_APPEND);
    if (!way_back) {
        complain(out->target.name, "a .npy array must go to a file");
        return EXIT_IO;
    }
    out->array = (long long)lseek(out->target.fd, 0, SEEK_CUR);
    return put_array_header(out, 0);
}

int output_open(struct output *out, const struct options *o)
{
    out->array = -1;
    out->row =
        o->style.binary ? sizeof(double) * (size_t)options_fields(o)->count : 0;
    if (o->output && output_is_input(o->output, o))
        return EXIT_IO;
    int status = target_open(&out->target, o->output);
    if (status != 0)
        return status;
    /* Reports a closed standard output even if there is no output. */
    if ((fcntl(out->target.fd, F_GETFL) & O_ACCMODE) == O_RDONLY) {
        errno = EBADF;
        complain_errno(out->target.name);
        status = EXIT_IO;
    } else if (o->array) {
        status = begin_array(out);
    }
    if (status != 0)
        target_close(&out->target, 0);
    return status;
}

/* The number of bytes at the end that are not a whole row. */
static size_t half_row(const struct output *out, const char *data,
                       size_t length)
{
    if (out->row > 0)
        return length % out->row;
    size_t whole = length;
    while (whole > 0 && data[whole - 1] != '\n')
        whole--;
    return length - whole;
}

/* Cuts a file that could not take all bytes after its last whole row, unless
 * another program has written to its end. */
static void take_back(const struct output *out, size_t length)
{
    struct stat s;
    const off_t at = lseek(out->target.fd, 0, SEEK_CUR);
    if (fstat(out->target.fd, &s) == 0 && S_ISREG(s.st_mode) &&
        at == s.st_size && ftruncate(out->target.fd, at - (off_t)length) != 0)
        complain_errno(out->target.name);
}

int output_write(struct output *out, const char *data, size_t length)
{
    size_t done = 0;
    while (done < length) {
        const ssize_t n = write(out->target.fd, data + done, length - done);
        if (n >= 0) {
            done += (size_t)n;
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            struct pollfd p = {out->target.fd, POLLOUT, 0};
            poll(&p, 1, -1);
        } else if (errno != EINTR) {
            complain_errno(out->target.name);
            take_back(out, half_row(out, data, done));
            return EXIT_IO;
        }
    }
    return 0;
}

/* Completes the .npy header.  Rows that could not be written are not counted. */
static int finish_array(struct output *out)
{
    struct stat s;
    const off_t at = lseek(out->target.fd, 0, SEEK_CUR);
    if (at == -1 || fstat(out->target.fd, &s) != 0 ||
        lseek(out->target.fd, (off_t)out->array, SEEK_SET) == -1) {
        complain_errno(out->target.name);
        return EXIT_IO;
    }
    const long long end = (long long)(at < s.st_size ? at : s.st_size);
    const long long rows = end - out->array - NPY_WRITTEN;
    return put_array_header(out, (unsigned long long)rows / out->row);
}

int output_close(struct output *out, int is_whole)
{
    const int stays = is_whole || !out->target.part[0];
    const int status = out->array >= 0 && stays ? finish_array(out) : 0;
    const int closed = target_close(&out->target, is_whole && status == 0);
    return status != 0 ? status : closed;
}
