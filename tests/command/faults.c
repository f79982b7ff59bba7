/*
 * faults.c - system calls that fail on request, for test_faults.sh
 *
 * The Makefile links it around the command with -Wl,--wrap=read and so on.  The
 * environment sets the failures:
 *
 *   CYLINT_FAULTS='short=7 eintr=7'
 *
 * Numbers count from 1, bytes from 0.  What fails at the end has the exit status
 * 99.  A counter decides which calls fail, so one thread has the same failures in
 * every run.
 */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#include "../support/heap.h"

static long long partly, eintr, again, waits, storm, nonblock,
    read_most = -1, write_most = -1, close_nth, fsync_nth, rename_nth,
    thread_from, threads_most = -1, pipes, calls_most, leaks, count_allocations;

static const struct {
    const char *name;
    long long *value;
} words[] = {
    {"short", &partly}, /* a seed: reads and writes transfer only a part */
    {"eintr", &eintr},  /* a seed: one call in three does nothing */
    {"again", &again},  /* a seed: one read or write in three would block */
    {"wait", &waits},   /* a seed: one poll in three without timeout is 0 */
    {"storm", &storm},  /* the microseconds between signals that do nothing */
    {"nonblock", &nonblock}, /* 1: standard input and output do not block */
    {"read", &read_most},    /* the bytes that are read; then EIO */
    {"write", &write_most},  /* the bytes that are written; then ENOSPC */
    {"close", &close_nth},   /* the close that fails with EIO */
    {"fsync", &fsync_nth},   /* the fsync that fails with ENOSPC */
    {"rename", &rename_nth}, /* the rename */
    {"alloc", &heap.refuse}, /* the allocation that fails */
    {"allocs", &heap.refuse_from}, /* and all later ones */
    {"thread", &thread_from},   /* the thread that fails, and all later ones */
    {"threads", &threads_most}, /* fails at the end if it made more others */
    {"pipe", &pipes},           /* 1: every pipe fails */
    {"calls", &calls_most}, /* aborts after so many reads, writes and polls */
    {"leaks", &leaks},      /* 1: fails at the end if memory is not freed */
    {"count", &count_allocations}, /* 1: prints the number of allocations */
};

static long long draws, calls, closes, fsyncs, renames, threads, bytes_read,
    bytes_written;

/* ---------------------------------------------------------- beginning -- */

static void fail_and_exit(const char *what)
{
    fprintf(stderr, "faults: %s\n", what);
    fflush(stderr);
    _exit(99);
}

static void set_word(const char *word, size_t length)
{
    const size_t count = sizeof words / sizeof *words;
    for (size_t i = 0; i < count; i++) {
        const size_t n = strlen(words[i].name);
        if (length > n && word[n] == '=' && !memcmp(word, words[i].name, n)) {
            *words[i].value = atoll(word + n + 1);
            return;
        }
    }
    fail_and_exit("unknown word in CYLINT_FAULTS");
}

static void on_signal(int number)
{
    (void)number;
}

/* Without SA_RESTART, so that signals interrupt waiting calls. */
static void begin_storm(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_signal;
    sigaction(SIGALRM, &action, NULL);
    const struct timeval often = {0, (suseconds_t)storm};
    const struct itimerval timer = {often, often};
    setitimer(ITIMER_REAL, &timer, NULL);
}

__attribute__((constructor)) static void begin(void)
{
    const char *p = getenv("CYLINT_FAULTS");
    while (p && *p) {
        const size_t length = strcspn(p, " ");
        if (length > 0)
            set_word(p, length);
        p += length + (p[length] == ' ');
    }
    if (storm)
        begin_storm();
    for (int fd = 0; nonblock && fd < 2; fd++)
        fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK);
}

__attribute__((destructor)) static void end(void)
{
    if (count_allocations)
        fprintf(stderr, "faults: %lld allocations\n", heap.requested);
    if (threads_most >= 0 && threads > threads_most)
        fail_and_exit("too many threads");
    if (leaks && heap.held)
        fail_and_exit("memory was not freed");
}

/* ------------------------------------------------------ random failures -- */

/* SplitMix64 of the next number, for all threads */
static uint64_t draw(long long seed)
{
    uint64_t z = (uint64_t)seed * 0x100000001b3u +
                 (uint64_t)ADD(draws, 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static int fails(long long seed, int error)
{
    if (!seed || draw(seed) % 3 != 0)
        return 0;
    errno = error;
    return 1;
}

static int is_unlucky_transfer(void)
{
    if (calls_most && ADD(calls, 1) > calls_most)
        abort();
    return fails(eintr, EINTR) || fails(again, EAGAIN);
}

/* At least one byte, else it would be an end of file. */
static size_t part_of(size_t n)
{
    return partly && n > 1 ? 1 + (size_t)(draw(partly) % n) : n;
}

/* How many of n bytes may go before `most` have gone: none is a failure. */
static size_t rest_of(size_t n, long long most, long long gone)
{
    const long long rest = most - gone;
    return most < 0 || (long long)n <= rest ? n : (size_t)rest;
}

/* ---------------------------------------------------------- the calls -- */

ssize_t __real_read(int fd, void *to, size_t n);
ssize_t __wrap_read(int fd, void *to, size_t n)
{
    if (is_unlucky_transfer())
        return -1;
    const size_t rest = rest_of(part_of(n), read_most, bytes_read);
    if (rest == 0 && n > 0) {
        errno = EIO;
        return -1;
    }
    const ssize_t got = __real_read(fd, to, rest);
    ADD(bytes_read, got > 0 ? got : 0);
    return got;
}

ssize_t __real_write(int fd, const void *from, size_t n);
ssize_t __wrap_write(int fd, const void *from, size_t n)
{
    if (is_unlucky_transfer())
        return -1;
    const size_t rest = rest_of(part_of(n), write_most, bytes_written);
    if (rest == 0 && n > 0) {
        errno = ENOSPC;
        return -1;
    }
    const ssize_t put = __real_write(fd, from, rest);
    ADD(bytes_written, put > 0 ? put : 0);
    return put;
}

int __real_poll(struct pollfd *p, nfds_t n, int timeout);
int __wrap_poll(struct pollfd *p, nfds_t n, int timeout)
{
    if (calls_most && ADD(calls, 1) > calls_most)
        abort();
    if (fails(eintr, EINTR))
        return -1;
    return timeout == 0 && fails(waits, errno) ? 0 : __real_poll(p, n, timeout);
}

int __real_open(const char *name, int flags, ...);
int __wrap_open(const char *name, int flags, ...)
{
    va_list list;
    va_start(list, flags);
    const int mode = flags & O_CREAT ? va_arg(list, int) : 0;
    va_end(list);
    return fails(eintr, EINTR) ? -1 : __real_open(name, flags, mode);
}

/* Whether this is the n-th call; n 0: never. */
static int is_nth(long long n, long long *count, int error)
{
    if (!n || ADD(*count, 1) != n)
        return 0;
    errno = error;
    return 1;
}

/* An interrupted close has closed, as on Linux. */
int __real_close(int fd);
int __wrap_close(int fd)
{
    const int status = __real_close(fd);
    return is_nth(close_nth, &closes, EIO) || fails(eintr, EINTR) ? -1 : status;
}

/* A file system may find only here that the disk is full. */
int __real_fsync(int fd);
int __wrap_fsync(int fd)
{
    return is_nth(fsync_nth, &fsyncs, ENOSPC) || fails(eintr, EINTR)
               ? -1
               : __real_fsync(fd);
}

int __real_rename(const char *old, const char *new);
int __wrap_rename(const char *old, const char *new)
{
    return is_nth(rename_nth, &renames, ENOSPC) ? -1 : __real_rename(old, new);
}

int __real_pipe(int ends[2]);
int __wrap_pipe(int ends[2])
{
    if (pipes) {
        errno = EMFILE;
        return -1;
    }
    return __real_pipe(ends);
}

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attr,
                          void *(*start)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attr,
                          void *(*start)(void *), void *argument)
{
    const long long number = ADD(threads, 1);
    if (thread_from && number >= thread_from)
        return EAGAIN;
    return __real_pthread_create(thread, attr, start, argument);
}
