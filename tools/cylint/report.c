/*
 * report.c - messages about records: the first ten bad ones, then a count
 */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "grammar.h"
#include "main.h"
#include "message.h"
#include "report.h"
#include "text.h"

enum { SHOWN_MOST = 32, NAME_MOST = 256 };

/* WHAT: 'TEXT', or expected WHAT, found 'TEXT'. */
static int describe_matter(char text[NOTE_CAPACITY], const struct fault *fault)
{
    char found[4 * SHOWN_MOST + 4];
    const int shown = fault->at != fault->end;
    if (shown)
        escape_bytes(found, fault->at, fault->end, SHOWN_MOST);
    if (fault->shape > 0) {
        return snprintf(text, NOTE_CAPACITY, "%s: shape %llu of the scene",
                        fault->what, fault->shape);
    }
    if (fault->numbers > 0) {
        return snprintf(text, NOTE_CAPACITY, "%d numbers where %s",
                        fault->numbers, fault->what);
    }
    if (!fault->expected) {
        return snprintf(text, NOTE_CAPACITY, shown ? "%s: '%s'" : "%s",
                        fault->what, shown ? found : "");
    }
    return shown ? snprintf(text, NOTE_CAPACITY, "expected %s, found '%s'",
                            fault->what, found)
                 : snprintf(text, NOTE_CAPACITY,
                            "expected %s, found the end of the line",
                            fault->what);
}

static void describe(char text[NOTE_CAPACITY], const struct fault *fault)
{
    int length = describe_matter(text, fault);
    if (fault->meant && length < NOTE_CAPACITY) {
        length += snprintf(text + length, (size_t)(NOTE_CAPACITY - length),
                           "; did you mean %s?", fault->meant);
    }
    if (fault->remedy && length < NOTE_CAPACITY) {
        snprintf(text + length, (size_t)(NOTE_CAPACITY - length), "; %s",
                 fault->remedy);
    }
}

/* In text, control characters other than tabs and line ends are rare; in
 * random bytes every ninth is one.  A file looks binary if they are more than
 * one in 20 of its first 512 bytes.  A few of them may be typing errors. */
static int looks_binary(const char *text, const char *end)
{
    enum { LOOKED_AT = 512, ONE_IN = 20, SLIPS = 3 };
    if (!text)
        return 0;
    const size_t length = (size_t)(end - text);
    const size_t looked_at = length < LOOKED_AT ? length : LOOKED_AT;
    size_t control = 0;
    for (size_t i = 0; i < looked_at; i++) {
        const unsigned char c = (unsigned char)text[i];
        control += c < 0x20 && c != '\t' && c != '\n' && c != '\r';
    }
    return control > SLIPS && control > looked_at / ONE_IN;
}

static struct note *add_note(struct notes *notes, unsigned long long line,
                             unsigned long long record, const char *text,
                             const struct fault *fault)
{
    struct note *note = &notes->note[notes->kept++];
    note->line = line;
    note->record = record;
    note->column = fault->at ? (unsigned long long)(fault->at - text) + 1 : 1;
    note->remark = NOT_GIVEN;
    note->binary = 0;
    describe(note->text, fault);
    return note;
}

void take_note(struct notes *notes, unsigned long long line,
               unsigned long long record, const char *text, const char *end,
               const struct fault *fault)
{
    notes->bad++;
    if (notes->kept_bad < NOTES_MOST) {
        notes->kept_bad++;
        /* `end` depends on how much of a pipe was read */
        add_note(notes, line, record, text, fault)->binary =
            !fault->remedy && looks_binary(text, end);
    }
}

void take_remarks(struct notes *notes, struct remarks *remarks,
                  unsigned long long line, unsigned long long record,
                  const char *text)
{
    for (int i = 0; i < REMARKS; i++)
        if (remarks->found & 1u << i)
            add_note(notes, line, record, text, &remarks->fault[i])->remark = i;
    remarks->wanted &= ~remarks->found;
    remarks->found = 0;
}

void print_note(const struct note *note, const char *name)
{
    char escaped[4 * NAME_MOST + 4];
    const char *binary = note->binary ? "; this looks like a binary file" : "";
    escape_bytes(escaped, name, name + strlen(name), NAME_MOST);
    if (note->line > 0) {
        message("%s:%llu:%llu: %s%s", escaped, note->line, note->column,
                note->text, binary);
    } else {
        message("%s: record %llu: %s", escaped, note->record, note->text);
    }
}

/* Returns whether a note must be printed, and updates *report if so. */
static int must_print(struct report *report, const struct note *note,
                      const char *name)
{
    if (note->remark != NOT_GIVEN) {
        const unsigned bit = 1u << note->remark;
        const int is_first = !(report->remarks & bit);
        report->remarks |= bit;
        return is_first;
    }
    if (report->shown == NOTES_MOST || report->binary == name)
        return 0;
    report->binary = note->binary ? name : NULL;
    report->shown++;
    return 1;
}

void report_notes(struct report *report, struct notes *notes, const char *name)
{
    for (int i = 0; i < notes->kept; i++)
        if (must_print(report, &notes->note[i], name))
            print_note(&notes->note[i], name);
    report->bad += notes->bad;
    notes->kept = notes->kept_bad = 0;
    notes->bad = 0;
}

void report_end(const struct report *report)
{
    if (report->bad > report->shown)
        message("%llu bad records in all", report->bad);
}

void complain(const char *name, const char *what)
{
    char escaped[4 * NAME_MOST + 4];
    escape_bytes(escaped, name, name + strlen(name), NAME_MOST);
    message("%s: %s", escaped, what);
}

void complain_errno(const char *name)
{
    complain(name, strerror(errno));
}

int out_of_memory(void)
{
    message("out of memory");
    return EXIT_MEMORY;
}
