/*
 * measure.c - runs a command and says what it took
 *
 *   measure COMMAND [ARGUMENT]...
 *
 * prints seconds by the clock, seconds of processor time and the most memory
 * resident in KiB, and exits as the command does.  The command's standard
 * output should go elsewhere: the figures go to descriptor 3.
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
