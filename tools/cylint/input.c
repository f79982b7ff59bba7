/*
 * input.c - reads blocks of whole records from one file after another
 *
 * A block ends at the end of a record; bytes read beyond it are carried to the
 * next block.  A block is returned as soon as it has a whole record and reading
 * on would wait, so that a program on the other end of a pipe gets its answer.
 */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "grammar.h"
#include "input.h"
#include "output.h"

static int is_stdin(const char *file)
{
    return strcmp(file, "-") == 0;
}

/* The bytes of all files, to estimate the remaining time; 0 if one has no known
 * size. */
static double total_size(char *const *files, int count)
{
    double total = 0;
    for (int i = 0; i < count; i++) {
        struct stat s;
        if ((is_stdin(files[i]) ? fstat(0, &s) : stat(files[i], &s)) != 0 ||
            !S_ISREG(s.st_mode))
            return 0;
        total += (double)s.st_size;
    }
    return total;
}

int input_open(struct input *in, char *const *files, int count,
               size_t record_size)
{
    memset(in, 0, sizeof *in);
    in->files = files;
    in->count = count;
    in->record_size = record_size;
    in->fd = in->end_fd = -1;
    in->record = 1;
    in->total = total_size(files, count);
    in->carry = malloc(BLOCK_CAPACITY);
    return in->carry ? 0 : out_of_memory();
}

static void close_file(struct input *in)
{
    if (in->fd > 0)
        close(in->fd);
    in->fd = -1;
}

void input_close(struct input *in)
{
    close_file(in);
    free(in->carry);
    in->carry = NULL;
}

/* Records why the input failed.  Returns 0. */
static int fail(struct block *b, const char *why)
{
    snprintf(b->fault, sizeof b->fault, "%s", why);
    b->length = 0;
    return 0;
}

static int open_next(struct input *in, struct block *b)
{
    const char *file = in->files[in->next++];
    in->name = b->name = file;
    in->fd = is_stdin(file) ? 0 : open_file(file, O_RDONLY, 0);
    if (in->fd < 0)
        return fail(b, strerror(errno));
    struct stat s;
    in->is_regular = fstat(in->fd, &s) == 0 && S_ISREG(s.st_mode);
    in->line = 1;
    in->before = in->record - 1;
    in->is_fresh = 1;
    in->has_ended = in->has_header = 0;
    in->bytes_returned = 0;
    return 1;
}

/* ------------------------------------------------------------ reading -- */

/* Waits at most `timeout` milliseconds, -1: as long as it takes.  Returns 1 if
 * there is input, or its end; 0 if there is none yet; -1 if the work has ended. */
static int wait_for_input(const struct input *in, int timeout)
{
    struct pollfd p[2] = {{in->fd, POLLIN, 0}, {in->end_fd, POLLIN, 0}};
    int ready = 1, ends = 0;
    while (!in->is_regular && !ends && (ready = poll(p, 2, timeout)) < 0 &&
           errno == EINTR)
        ends = is_interrupted();
    return ends || p[1].revents != 0 ? -1 : ready != 0;
}

/* From `from` on, replaces each CR by LF unless an LF follows.  A CR at the end
 * is kept until the next byte is read. */
static void end_lines_at_cr(struct block *b, size_t from)
{
    char *last = b->text + b->length - 1;
    char *p = b->text + (from > 0 ? from - 1 : 0);
    while (p < last && (p = memchr(p, '\r', (size_t)(last - p))) != NULL) {
        if (p[1] != '\n')
            *p = '\n';
        p++;
    }
}

/* Appends bytes to the block's text.  Sets in->has_ended at the end of the file, at
 * an error, and if the work has ended. */
static void read_bytes(struct input *in, struct block *b)
{
    while (wait_for_input(in, -1) > 0) {
        const ssize_t n = read(in->fd, b->text + b->length, BLOCK_GOAL);
        if (n > 0) {
            b->length += (size_t)n;
            if (in->cr_ends_lines)
                end_lines_at_cr(b, b->length - (size_t)n);
            in->bytes_read += (unsigned long long)n;
            return;
        }
        if (n == 0)
            break;
        if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
            in->read_errno = errno;
            break;
        }
    }
    in->has_ended = 1;
}

static void drop_front(struct block *b, size_t n)
{
    memmove(b->text, b->text + n, b->length - n);
    b->length -= n;
}

/* Skips the remaining bytes of a line that was too long. */
static void skip_line(struct input *in, struct block *b)
{
    while (in->is_skipping) {
        b->length = 0;
        read_bytes(in, b);
        const char *end = memchr(b->text, '\n', b->length);
        if (end)
            drop_front(b, (size_t)(end - b->text) + 1);
        in->is_skipping = !end && !in->has_ended;
    }
}

/* ------------------------------------------------------------ records -- */

/* Returns the bytes up to the end of the last whole record.  The first `whole`
 * bytes are whole records; the first `searched` bytes were searched before, but the
 * last of them may be a CR that has become an LF. */
static size_t find_whole(const struct input *in, const struct block *b,
                         size_t whole, size_t searched)
{
    if (in->record_size > 0)
        return b->length - b->length % in->record_size;
    for (size_t i = b->length; i > whole && i >= searched; i--)
        if (b->text[i - 1] == '\n')
            return i;
    return whole;
}

/* Bytes that do not count as a part of a line: a byte order mark before the first
 * one, and CR before LF. */
enum { MARK_LENGTH = 3, NOT_COUNTED = MARK_LENGTH + 1 };

/* Reads until the block has a whole record and is large enough, or until
 * reading would wait. */
static size_t read_whole_records(struct input *in, struct block *b)
{
    size_t whole = find_whole(in, b, 0, 0);
    while (!in->has_ended && !(whole > 0 && (b->length >= BLOCK_GOAL ||
                                             wait_for_input(in, 0) == 0))) {
        if (whole == 0 && b->length > LINE_MOST + NOT_COUNTED) {
            in->is_skipping = 1;
            return b->length = LINE_MOST + NOT_COUNTED + 1;
        }
        const size_t searched = b->length;
        read_bytes(in, b);
        whole = find_whole(in, b, whole, searched);
    }
    b->is_full = b->length >= BLOCK_GOAL;
    return in->has_ended && !in->read_errno ? b->length : whole;
}

static void count_records(struct input *in, struct block *b)
{
    const char *const end = b->text + b->length;
    b->line = in->record_size > 0 ? 0 : in->line;
    b->record = in->record;
    b->record_of_file = in->record - in->before;
    if (in->record_size > 0)
        b->records = (b->length + in->record_size - 1) / in->record_size;
    else
        for (const char *p = b->text, *stop; p < end; p = stop + 1) {
            stop = end_of_line(p, end);
            b->records += is_record(p, stop) ? 1 : 0;
            in->line++;
        }
    in->record += b->records;
    in->bytes_returned += b->length;
}

/* -------------------------------------------------- beginning of a file -- */

static void skip_byte_order_mark(struct block *b)
{
    if (b->length >= MARK_LENGTH &&
        memcmp(b->text, "\xef\xbb\xbf", MARK_LENGTH) == 0)
        drop_front(b, MARK_LENGTH);
}

/* Skips a .npy header.  Returns 0 after a failure. */
static int skip_npy_header(struct input *in, struct block *b)
{
    const size_t columns = in->record_size / sizeof(double);
    char wrong[FAULT_CAPACITY] = "";
    unsigned long long rows = 0;
    size_t length;
    while ((length = npy_read(b->text, b->length, columns, &rows, wrong)) >
               b->length &&
           !in->has_ended)
        read_bytes(in, b);
    if (wrong[0])
        return fail(b, wrong);
    if (length > b->length)
        return length == NPY_PREFIX ||
               fail(b, ".npy header: length: the file ends within the header");
    drop_front(b, length);
    in->has_header = length > 0;
    in->bytes_stated = rows * in->record_size;
    return 1;
}

/* The checks at the end of a file, after its last block was returned.
 * Returns 0 after a failure. */
static int finish_file(struct input *in, struct block *b)
{
    const int is_complete =
        !in->has_header || in->bytes_returned == in->bytes_stated;
    close_file(in);
    b->name = in->name;
    if (in->read_errno)
        return fail(b, strerror(in->read_errno));
    return is_complete ||
           fail(b, "the .npy header has another number of rows than the file");
}

/* Closes the present file, if one is open, and opens the next.  Returns 0 if
 * there is none, or after a failure. */
static int change_file(struct input *in, struct block *b)
{
    return (in->fd < 0 || finish_file(in, b)) && in->next < in->count &&
           open_next(in, b);
}

static int begin_block(struct input *in, struct block *b)
{
    b->name = in->name;
    memcpy(b->text, in->carry, in->carried);
    b->length = in->carried;
    in->carried = 0;
    skip_line(in, b);
    return !in->is_fresh || in->record_size == 0 || skip_npy_header(in, b);
}

/* Carries the bytes beyond the last whole record to the next block.  At the end
 * of a file there are none. */
static void cut_block(struct input *in, struct block *b, size_t whole)
{
    if (!in->has_ended) {
        in->carried = b->length - whole;
        memcpy(in->carry, b->text + whole, in->carried);
    }
    b->length = whole;
    if (in->is_fresh && in->record_size == 0)
        skip_byte_order_mark(b);
    in->is_fresh = 0;
    b->text[b->length] = '\0';
}

/* Returns why a file with this beginning is refused, or NULL.  No line of text has
 * such a beginning; of doubles at least four bytes are compared, which do not
 * occur in data by chance. */
static const char *fault_of_beginning(const struct input *in,
                                      const struct block *b)
{
    static const char gzip[] = "is compressed by gzip; pipe it through zcat";
    static const char utf_16[] =
        "is UTF-16; pipe it through iconv -f UTF-16 -t UTF-8";
    static const struct {
        const char *bytes;
        size_t of_text,
            of_doubles; /* how many are compared; 0: this is no fault */
        const char *fault;
    } beginnings[] = {
        {"\x1f\x8b\x08\x00", 2, 4, gzip},
        {"\x1f\x8b\x08\x08", 2, 4, gzip},
        {"PK\3\4", 4, 4, "is a ZIP archive, as .npz files are; unpack it"},
        {"\x93NUMPY", 6, 0, "is a .npy array, not text: see --binary-in"},
        {"\211CYLINT", 7, 7,
         "is a saved scene: -s FILE reads it, but not from a pipe"},
        {"\xff\xfe", 2, 0, utf_16},
        {"\xfe\xff", 2, 0, utf_16}};
    for (size_t i = 0; i < sizeof beginnings / sizeof *beginnings; i++) {
        const size_t length = in->record_size == 0 ? beginnings[i].of_text
                                                   : beginnings[i].of_doubles;
        if (length > 0 && b->length >= length &&
            memcmp(b->text, beginnings[i].bytes, length) == 0)
            return beginnings[i].fault;
    }
    return NULL;
}

static void fill_block(struct input *in, struct block *b)
{
    while (b->length == 0) {
        if ((in->fd < 0 || in->has_ended) && !change_file(in, b))
            return;
        if (!begin_block(in, b))
            return;
        const size_t whole = read_whole_records(in, b);
        const char *fault =
            in->is_fresh && !in->has_header ? fault_of_beginning(in, b) : NULL;
        if (fault) {
            fail(b, fault);
            return;
        }
        cut_block(in, b, whole);
        count_records(in, b);
    }
}

void input_read(struct input *in, struct block *b)
{
    b->length = 0;
    b->records = 0;
    b->is_full = 0;
    b->fault[0] = '\0';
    fill_block(in, b);
    b->bytes_read = in->bytes_read;
}

int block_make(struct block *block)
{
    memset(block, 0, sizeof *block);
    block->text = malloc(BLOCK_CAPACITY + 1);
    return block->text != NULL;
}

/* ----------------------------------------------------- lines of one file -- */

static int handle_lines(struct block *b, struct notes *notes,
                        line_handler *handle, void *context)
{
    const char *const end = b->text + b->length, *stop;
    int status = 0;
    notes->line = b->line;
    notes->end = end;
    for (const char *p = b->text; p < end && status == 0; p = stop + 1) {
        stop = end_of_line(p, end);
        notes->text = p;
        if (is_record(p, stop))
            status = handle(context, p, stop, notes);
        if (status == EXIT_BAD)
            count_bad(notes);
        notes->line++;
    }
    return status;
}

int read_lines(const char *file, int cr_ends_lines, line_handler *handle,
               void *context)
{
    char *const files[] = {(char *)(uintptr_t)file};
    struct input in;
    struct block block;
    struct notes notes = {.wanted = 1u << REMARK_NUMBERS |
                                    1u << REMARK_LATE_WORD |
                                    1u << REMARK_LABEL};
    struct report report = {0};
    int status = block_make(&block) ? 0 : out_of_memory();
    if (status == 0 && (status = input_open(&in, files, 1, 0)) == 0) {
        in.cr_ends_lines = cr_ends_lines;
        do {
            input_read(&in, &block);
            status = block.fault[0]
                         ? complain(EXIT_IO, block.name, "%s", block.fault)
                         : handle_lines(&block, &notes, handle, context);
            report_notes(&report, &notes, block.name);
        } while (status == 0 && block.length > 0);
        input_close(&in);
    }
    free(block.text);
    return status;
}
