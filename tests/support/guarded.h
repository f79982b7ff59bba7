/*
 * guarded.h - arrays that begin or end at a guard page
 *
 * A struct guarded is some pages between two guard pages, which can be neither
 * read nor written.  An array is placed `gap` bytes from one of them.  An
 * access to a guard page ends the program with a message.
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

struct guarded {
    char *from, *to; /* the accessible bytes */
};

static void guarded_access(int signal_number)
{
    static const char message[] =
        "FAILED an access outside of an array, or a write to a read-only one\n";
    (void)signal_number;
    if (write(2, message, sizeof message - 1) >= 0)
        _exit(1);
    _exit(2);
}

/* Allocates pages for `bytes` and a gap of up to 64. */
static struct guarded guarded_allocate(size_t bytes)
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
    signal(SIGSEGV, guarded_access);
    signal(SIGBUS, guarded_access);
    return (struct guarded){all + page, all + page + inside};
}

static void guarded_permit(const struct guarded *pages, int writing)
{
    if (mprotect(pages->from, (size_t)(pages->to - pages->from),
                 writing ? PROT_READ | PROT_WRITE : PROT_READ))
        abort();
}

/* Fills the pages with a pattern and returns a place for `bytes` in them. */
static void *guarded_place(const struct guarded *pages, size_t bytes,
                           size_t gap, int at_end)
{
    guarded_permit(pages, 1);
    memset(pages->from, GUARDED_UNTOUCHED, (size_t)(pages->to - pages->from));
    return at_end ? pages->to - bytes - gap : pages->from + gap;
}

/* Whether all bytes except `bytes` at p still have the pattern. */
static int guarded_kept(const struct guarded *pages, const void *p,
                        size_t bytes)
{
    const char *first = p;
    for (const char *c = pages->from; c < pages->to; c++) {
        if (c == first)
            c += bytes;
        if (c < pages->to && *c != GUARDED_UNTOUCHED)
            return 0;
    }
    return 1;
}

#endif
