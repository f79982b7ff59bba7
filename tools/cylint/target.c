/*
 * target.c - a file that a command writes, whole or not at all
 */
#define _XOPEN_SOURCE 700 /* realpath() */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "main.h"
#include "report.h"
#include "target.h"

enum { NAME_KEPT = 200, TRIES = 100 };

int open_file(const char *name, int flags, unsigned mode)
{
    int fd;
    do {
        fd = open(name, flags | O_NOCTTY, mode);
    } while (fd < 0 && errno == EINTR);
    return fd;
}

static int failed(const struct target *t)
{
    complain_errno(t->name);
    return EXIT_IO;
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

static const int deadly[] = {SIGHUP,  SIGINT,  SIGQUIT, SIGPIPE,
                             SIGTERM, SIGXCPU, SIGXFSZ};

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

/* Opens a new file beside the place.  A number in its name that another file has
 * already, from a host that shares the folder, is passed over. */
static int open_part(struct target *t, unsigned mode)
{
    const char *slash = strrchr(t->place, '/');
    const char *base = slash ? slash + 1 : t->place;
    long number = (long)getpid();
    int fd;
    do {
        snprintf(t->part, sizeof t->part, "%.*s%.*s.%ld.part",
                 (int)(base - t->place), t->place, NAME_KEPT, base, number++);
        fd = open_file(t->part, O_WRONLY | O_CREAT | O_EXCL, mode);
    } while (fd < 0 && errno == EEXIST && number < (long)getpid() + TRIES);
    return fd;
}

/* Sets t->fd to a new part.  `old` is the file in its place, NULL if there is
 * none.  Returns 0 if it cannot be opened, or not with the old owner. */
static int begin_part(struct target *t, const struct stat *old)
{
    sigset_t before;
    block_deadly(&before);
    int fd = open_part(t, old ? old->st_mode & 0777 : 0666);
    if (fd >= 0 && old &&
        (fchown(fd, old->st_uid, old->st_gid) != 0 ||
         fchmod(fd, old->st_mode & 07777) != 0)) {
        unlink(t->part);
        close(fd);
        fd = -1;
    }
    if (fd >= 0) {
        t->fd = fd;
        remove_at_signals(t->part);
    } else {
        t->part[0] = '\0';
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    return fd >= 0;
}

static int is_link(const char *name)
{
    struct stat s;
    return lstat(name, &s) == 0 && S_ISLNK(s.st_mode);
}

static int open_new(struct target *t)
{
    if (is_link(t->name)) {
        t->fd = open_file(t->name, O_WRONLY | O_CREAT, 0666);
        return t->fd >= 0 ? 0 : failed(t);
    }
    if (snprintf(t->place, PATH_MAX, "%s", t->name) >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return failed(t);
    }
    return begin_part(t, NULL) ? 0 : failed(t);
}

int target_open(struct target *t, const char *name)
{
    struct stat old;
    t->name = name ? name : "standard output";
    t->part[0] = '\0';
    if (!name) {
        t->fd = 1;
        return 0;
    }
    const int fd = t->fd = open_file(name, O_WRONLY, 0);
    if (fd < 0)
        return errno == ENOENT ? open_new(t) : failed(t);
    if (fstat(fd, &old) != 0 || !S_ISREG(old.st_mode))
        return 0;
    if (realpath(name, t->place) && begin_part(t, &old)) {
        close(fd);
        return 0;
    }
    return ftruncate(fd, 0) == 0 ? 0 : failed(t);
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

int target_close(struct target *t, int is_whole)
{
    int status = 0;
    if (t->part[0] && is_whole && !is_stored(t->fd))
        status = failed(t);
    if (close(t->fd) != 0 && errno != EINTR && status == 0)
        status = failed(t);
    if (t->part[0] && is_whole && status == 0 && rename(t->part, t->place) != 0)
        status = failed(t);
    if (t->part[0] && (!is_whole || status != 0))
        unlink(t->part);
    has_part = 0;
    return status;
}
