/*
 * measure.c - runs a command and prints its time and memory
 *
 *   measure COMMAND [ARGUMENT]...
 *
 * Prints on descriptor 3: elapsed seconds, seconds of processor time and peak
 * resident memory in KiB.  Exits with the command's status.
 */
#if defined(__linux__)
#define _DEFAULT_SOURCE /* wait4 */
#endif
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double seconds(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fputs("measure: no command\n", stderr);
        return 2;
    }
    const double start = now();
    const pid_t child = fork();
    if (child == 0) {
        execvp(argv[1], argv + 1);
        perror(argv[1]);
        _exit(127);
    }
    int status = 0;
    struct rusage used;
    if (child == -1 || wait4(child, &status, 0, &used) != child) {
        perror("measure");
        return 3;
    }
    dprintf(3, "%.3f %.3f %ld\n", now() - start,
            seconds(used.ru_utime) + seconds(used.ru_stime), used.ru_maxrss);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
