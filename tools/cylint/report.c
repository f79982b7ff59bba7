/*
 * report.c - messages about records, files and memory
 */
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "report.h"

enum { FOUND_MOST = 32, COMPLAINT_CAPACITY = 512 };

static struct note *present_note(struct notes *notes)
{
    return &notes->note[notes->kept];
}

/* Only the first ten bad records of a block have a text. */
static int is_silent(const struct notes *notes)
{
    return notes->kept_bad == NOTES_MOST && !notes->may_remark;
}

/* lint: va_start() was called */
int refuse(struct notes *notes, const char *at, const char *format, ...)
{
    va_list list;
    struct note *note = present_note(notes);
    if (is_silent(notes))
        return EXIT_BAD;
    note->line = notes->line;
    note->record = notes->record;
    note->column = at ? (unsigned long long)(at - notes->text) + 1 : 1;
    note->remark = REMARK_NONE;
    note->looks_binary = 0;
    va_start(list, format);
    vsnprintf(note->text, NOTE_CAPACITY, format, list);
    va_end(list);
    return EXIT_BAD;
}

int refuse_text(struct notes *notes, const char *what, struct string text)
{
    char found[SHOWN_CAPACITY];
    return text.length == 0 || is_silent(notes)
               ? refuse(notes, text.text, "%s", what)
               : refuse(notes, text.text, "%s: '%s'", what,
                        escape(found, text, FOUND_MOST));
}

int refuse_other(struct notes *notes, const char *expected, struct string text)
{
    char found[SHOWN_CAPACITY];
    return text.length == 0 || is_silent(notes)
               ? refuse(notes, text.text,
                        "expected %s, found the end of the line", expected)
               : refuse(notes, text.text, "expected %s, found '%s'", expected,
                        escape(found, text, FOUND_MOST));
}

static void append(struct note *note, const char *before, const char *text,
                   const char *after)
{
    const size_t length = strlen(note->text);
    snprintf(note->text + length, NOTE_CAPACITY - length, "; %s%s%s", before,
             text, after);
}

void advise(struct notes *notes, const char *advice)
{
    if (!is_silent(notes))
        append(present_note(notes), "", advice, "");
}

void suggest(struct notes *notes, struct words words, struct string text)
{
    const char *word = is_silent(notes) ? NULL : similar_word(words, text);
    if (word)
        append(present_note(notes), "did you mean ", word, "?");
}

int wants_remark(struct notes *notes, enum remark remark)
{
    notes->may_remark |= (notes->wanted & 1u << remark) != 0;
    return (notes->wanted & 1u << remark) != 0;
}

void make_remark(struct notes *notes, enum remark remark)
{
    present_note(notes)->remark = remark;
    notes->wanted &= ~(1u << remark);
    notes->may_remark = 0;
    notes->kept++;
}

/* In text, control characters other than tabs and line ends are rare; in
 * random bytes every ninth is one.  A file looks binary if they are more than
 * one in 20 of the 512 bytes from the bad record on.  A few of them may be
 * typing errors. */
static int looks_binary(const char *text, const char *end)
{
    enum { LOOKED_AT = 512, ONE_IN = 20, SLIPS = 3 };
    const size_t length = text ? (size_t)(end - text) : 0;
    const size_t looked_at = length < LOOKED_AT ? length : LOOKED_AT;
    size_t control = 0;
    for (size_t i = 0; i < looked_at; i++)
        control += (size_t)is_control(text[i]);
    return control > SLIPS && control > looked_at / ONE_IN;
}

void count_bad(struct notes *notes)
{
    struct note *note = present_note(notes);
    notes->bad++;
    notes->may_remark = 0;
    if (notes->kept_bad < NOTES_MOST) {
        note->looks_binary = looks_binary(notes->text, notes->end);
        notes->kept_bad++;
        notes->kept++;
    }
}

/* ------------------------------------------------------------ printing -- */

static const char *escaped_name(char shown[SHOWN_CAPACITY], const char *name)
{
    return strcmp(name, "-") == 0 ? "stdin"
           : *name                ? escape(shown, string_of(name), SHOWN_MOST)
                                  : "''";
}

/* lint: va_start() was called */
int complain(int status, const char *name, const char *format, ...)
{
    char shown[SHOWN_CAPACITY], text[COMPLAINT_CAPACITY];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    message("%s: %s", escaped_name(shown, name), text);
    return status;
}

int complain_errno(const char *name)
{
    return complain(EXIT_IO, name, "%s", strerror(errno));
}

int complain_at(const char *name, unsigned long long line,
                unsigned long long column, const char *what)
{
    char shown[SHOWN_CAPACITY];
    message("%s:%llu:%llu: %s", escaped_name(shown, name), line, column, what);
    return EXIT_BAD;
}

int out_of_memory(void)
{
    message("out of memory");
    return EXIT_MEMORY;
}

static void print_note(const struct note *note, const char *name)
{
    char text[NOTE_CAPACITY + 40];
    if (note->line > 0) {
        snprintf(text, sizeof text, "%s%s", note->text,
                 note->looks_binary ? "; this looks like a binary file" : "");
        complain_at(name, note->line, note->column, text);
    } else {
        complain(EXIT_BAD, name, "record %llu: %s", note->record, note->text);
    }
}

/* Returns whether a note must be printed, and updates *report if so. */
static int must_print(struct report *report, const struct note *note,
                      const char *name)
{
    if (note->remark != REMARK_NONE) {
        const unsigned bit = 1u << note->remark;
        const int is_first = !(report->remarks & bit);
        report->remarks |= bit;
        return is_first;
    }
    if (report->shown == NOTES_MOST || report->binary_file == name)
        return 0;
    report->binary_file = note->looks_binary ? name : NULL;
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
