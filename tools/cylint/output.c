/*
 * output.c - the file that a command writes, whole or not at all
 */
#define _XOPEN_SOURCE 700 /* realpath() */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "report.h"
#include "output.h"

enum { NAME_KEPT = 200, TRIES = 100 };

/* Of messages; NULL is standard output. */
static const char *shown_name(const char *name)
{
    return name ? name : "standard output";
}

int open_file(const char *name, int flags, unsigned mode)
{
    int fd;
    do {
        fd = open(name, flags | O_NOCTTY, mode);
    } while (fd < 0 && errno == EINTR && !is_interrupted());
    return fd;
}

/* ------------------------------------------------------------ signals -- */

/* The file that a signal removes. */
static const char *part_of_signal;
static volatile sig_atomic_t has_part;

/* The disposition is the default again, so that raise() ends the command. */
static void remove_and_die(int number)
{
    if (has_part)
        unlink(part_of_signal);
    raise(number);
}

/* SIGBUS: a saved scene has become shorter. */
static const int deadly[] = {SIGHUP,  SIGINT,  SIGQUIT, SIGPIPE, SIGTERM,
                             SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM, SIGVTALRM,
                             SIGPROF, SIGSYS,  SIGABRT, SIGBUS};

static void block_deadly(sigset_t *before)
{
    sigset_t set;
    sigemptyset(&set);
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; i++)
        sigaddset(&set, deadly[i]);
    sigprocmask(SIG_BLOCK, &set, before);
}

/* A signal that is ignored stays ignored. */
static void remove_at_signals(const char *part)
{
    struct sigaction action, old;
    memset(&action, 0, sizeof action);
    action.sa_handler = remove_and_die;
    action.sa_flags = (int)SA_RESETHAND;
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; i++)
        if (sigaction(deadly[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL)
            sigaction(deadly[i], &action, NULL);
    part_of_signal = part;
    has_part = 1;
}

/* --------------------------------------------------------------- part -- */

/* Opens a new file beside the place.  A number in its name that another file
 * has already, from a host that shares the folder, is passed over. */
static int open_part(struct output *out, unsigned mode)
{
    const char *slash = strrchr(out->place, '/');
    const char *base = slash ? slash + 1 : out->place;
    long number = (long)getpid();
    int fd;
    do {
        snprintf(out->part, sizeof out->part, "%.*s%.*s.%ld.part",
                 (int)(base - out->place), out->place, NAME_KEPT, base,
                 number++);
        fd = open_file(out->part, O_WRONLY | O_CREAT | O_EXCL, mode);
    } while (fd < 0 && errno == EEXIST && number < (long)getpid() + TRIES);
    return fd;
}

/* Sets out->fd to a new part.  `old` is the file in its place, NULL if there is
 * none.  The part gets its permissions, and its owner if that is allowed.  Returns
 * 0 if it cannot be opened. */
static int begin_part(struct output *out, const struct stat *old)
{
    sigset_t before;
    block_deadly(&before);
    const int fd = open_part(out, old ? old->st_mode & 0777 : 0666);
    if (fd >= 0) {
        if (old)
            fchmod(fd, fchown(fd, old->st_uid, old->st_gid) == 0
                           ? old->st_mode & 07777
                           : old->st_mode & 0777);
        out->fd = fd;
        remove_at_signals(out->part);
    } else {
        out->part[0] = '\0';
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    return fd >= 0;
}

static int is_link(const char *name)
{
    struct stat s;
    return lstat(name, &s) == 0 && S_ISLNK(s.st_mode);
}

static int open_new(struct output *out)
{
    if (is_link(out->name)) {
        out->fd = open_file(out->name, O_WRONLY | O_CREAT, 0666);
        return out->fd >= 0 ? 0 : complain_errno(out->name);
    }
    if (snprintf(out->place, PATH_MAX, "%s", out->name) >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return complain_errno(out->name);
    }
    return begin_part(out, NULL) ? 0 : complain_errno(out->name);
}

static int is_same_file(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

/* As /dev/stdout is. */
static int is_standard_output(const struct stat *file)
{
    struct stat s;
    return fstat(1, &s) == 0 && is_same_file(&s, file);
}

static int open_target(struct output *out, const char *name)
{
    struct stat old;
    out->name = shown_name(name);
    out->part[0] = '\0';
    if (!name) {
        out->fd = 1;
        return 0;
    }
    const int fd = out->fd = open_file(name, O_WRONLY, 0);
    if (fd < 0)
        return errno == ENOENT ? open_new(out) : complain_errno(out->name);
    if (fstat(fd, &old) != 0 || !S_ISREG(old.st_mode))
        return 0;
    if (is_standard_output(&old)) {
        out->fd = 1; /* which has its own place in the file */
        close(fd);
        return 0;
    }
    const int status =
        realpath(name, out->place) && begin_part(out, &old)
            ? 0
            : complain(EXIT_IO, out->name, "cannot be replaced: %s",
                       strerror(errno));
    close(fd);
    return status;
}

/* -------------------------------------------------------------- output -- */

/* Opens each standard stream that is closed in the wrong direction, so that
 * its use fails. */
void guard_standard_streams(void)
{
    signal(SIGXFSZ, SIG_IGN);
    for (int fd = 0; fd < 3; fd++)
        if (fcntl(fd, F_GETFD) == -1 && errno == EBADF)
            (void)open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

int output_is_input(const char *file, const char *input)
{
    struct stat a, b;
    const int is_same =
        (file ? stat(file, &a) : fstat(1, &a)) == 0 && S_ISREG(a.st_mode) &&
        (strcmp(input, "-") == 0 ? fstat(0, &b) : stat(input, &b)) == 0 &&
        is_same_file(&a, &b);
    return is_same &&
           complain(EXIT_IO, shown_name(file), "is both input and output");
}

/* Reports a closed standard output even if there is no output. */
int output_open(struct output *out, const char *name, size_t row_size)
{
    out->row_size = row_size;
    const int status = open_target(out, name);
    if (status == 0 && (fcntl(out->fd, F_GETFL) & O_ACCMODE) == O_RDONLY) {
        errno = EBADF;
        return complain_errno(out->name);
    }
    return status;
}

/* The number of bytes at the end that are not a whole row. */
static size_t length_of_half_row(const struct output *out, const char *data,
                                 size_t length)
{
    if (out->row_size > 0)
        return length % out->row_size;
    size_t whole = length;
    while (whole > 0 && data[whole - 1] != '\n')
        whole--;
    return length - whole;
}

/* Cuts a file that could not take all bytes after its last whole row, unless
 * another program has written to its end. */
static void cut_half_row(const struct output *out, size_t length)
{
    struct stat s;
    const off_t at = lseek(out->fd, 0, SEEK_CUR);
    if (fstat(out->fd, &s) == 0 && S_ISREG(s.st_mode) && at == s.st_size &&
        ftruncate(out->fd, at - (off_t)length) != 0)
        complain_errno(out->name);
}

int output_write(struct output *out, const char *data, size_t length)
{
    const size_t most = (size_t)1 << 30; /* some systems refuse 2 GiB */
    size_t done = 0;
    while (done < length) {
        const size_t remaining = length - done;
        const ssize_t n =
            write(out->fd, data + done, remaining < most ? remaining : most);
        if (n >= 0) {
            done += (size_t)n;
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            struct pollfd p = {out->fd, POLLOUT, 0};
            poll(&p, 1, -1);
        } else if (errno != EINTR) {
            complain_errno(out->name);
            cut_half_row(out, length_of_half_row(out, data, done));
            return EXIT_IO;
        }
    }
    return 0;
}

/* Returns whether all bytes are on the disk.  Not all file systems support
 * fsync(); a disk may become full only now. */
static int is_stored(int fd)
{
    int status;
    do {
        status = fsync(fd);
    } while (status != 0 && errno == EINTR);
    return status == 0 || errno == EINVAL || errno == ENOTSUP;
}

int output_close(struct output *out, int is_whole)
{
    int status = 0;
    if (out->part[0] && is_whole && !is_stored(out->fd))
        status = complain_errno(out->name);
    if (close(out->fd) != 0 && errno != EINTR && status == 0)
        status = complain_errno(out->name);
    if (out->part[0] && is_whole && status == 0 &&
        rename(out->part, out->place) != 0)
        status = complain_errno(out->name);
    if (out->part[0] && (!is_whole || status != 0))
        unlink(out->part);
    has_part = 0;
    return status;
}
