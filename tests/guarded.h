/*
 * guarded.h - arrays that end, or begin, where no memory may be touched
 *
 * A room is some pages between two that can be neither read nor written; an
 * array is placed `gap` bytes from the one before it or from the one after
 * it.  Whoever steps over the edge ends the program, which says so.
 */
#ifndef CYLINT_GUARDED_H
#define CYLINT_GUARDED_H

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { GUARDED_UNTOUCHED = 0x5a };

struct room {
    char *from, *to; /* what may be touched */
};

static void guarded_stepped_over(int signal_number)
{
    static const char message[] =
        "FAILED memory outside of an array, or for reading only, was touched\n";
    (void)signal_number;
    if (write(2, message, sizeof message - 1) >= 0)
        _exit(1);
    _exit(2);
}

/* Room for `bytes` and a gap of up to 64. */
static struct room guarded_room(size_t bytes)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    const size_t inside = (bytes + 64 + page - 1) / page * page;
    const int zeros = open("/dev/zero", O_RDWR);
    char *all = mmap(NULL, inside + 2 * page, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE, zeros, 0);
    if (zeros < 0 || all == MAP_FAILED || mprotect(all, page, PROT_NONE) ||
        mprotect(all + page + inside, page, PROT_NONE))
        abort();
    close(zeros);
    signal(SIGSEGV, guarded_stepped_over);
    signal(SIGBUS, guarded_stepped_over);
    return (struct room){all + page, all + page + inside};
}

static void guarded_permit(const struct room *room, int writing)
{
    if (mprotect(room->from, (size_t)(room->to - room->from),
                 writing ? PROT_READ | PROT_WRITE : PROT_READ))
        abort();
}

/* A place for `bytes` in the room, which is filled with a pattern. */
static void *guarded_place(const struct room *room, size_t bytes, size_t gap,
                           int at_end)
{
    guarded_permit(room, 1);
    memset(room->from, GUARDED_UNTOUCHED, (size_t)(room->to - room->from));
    return at_end ? room->to - bytes - gap : room->from + gap;
}

/* Whether all of the room but `bytes` at p still holds the pattern. */
static int guarded_kept(const struct room *room, const void *p, size_t bytes)
{
    const char *first = p;
    for (const char *c = room->from; c < room->to; c++) {
        if (c == first)
            c += bytes;
        if (c < room->to && *c != GUARDED_UNTOUCHED)
            return 0;
    }
    return 1;
}

#endif
