/*
 * report.c - messages about bad records: the first ten, then a count
 */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "grammar.h"
#include "main.h"
#include "report.h"
#include "text.h"

enum { SHOWN_MOST = 32, NAME_MOST = 256 };

static void describe(char text[NOTE_ROOM], const struct fault *fault)
{
    char found[4 * SHOWN_MOST + 4];
    if (fault->shape > 0) {
        snprintf(text, NOTE_ROOM, "%s: shape %llu of the scene", fault->what,
                 fault->shape);
        return;
    }
    const int shown = fault->at != fault->end;
    if (shown) {
        escape_bytes(found, fault->at, fault->end, SHOWN_MOST);
    }
    if (!fault->expected) {
        snprintf(text, NOTE_ROOM, shown ? "%s: '%s'" : "%s", fault->what,
                 shown ? found : "");
    } else if (shown) {
        snprintf(text, NOTE_ROOM, "expected %s, found '%s'", fault->what,
                 found);
    } else {
        snprintf(text, NOTE_ROOM, "expected %s, found the end of the line",
                 fault->what);
    }
}

void take_note(struct notes *notes, unsigned long long line,
               unsigned long long record, const char *text,
               const struct fault *fault)
{
    if (notes->count < NOTES_MOST) {
        struct note *note = &notes->note[notes->count];
        note->line = line;
        note->record = record;
        note->column =
            fault->at ? (unsigned long long)(fault->at - text) + 1 : 1;
        describe(note->text, fault);
    }
    notes->count++;
}

void print_note(const struct note *note, const char *name)
{
    char escaped[4 * NAME_MOST + 4];
    escape_bytes(escaped, name, name + strlen(name), NAME_MOST);
    if (note->line > 0) {
        fprintf(stderr, "%s: %s:%llu:%llu: %s\n", program, escaped, note->line,
                note->column, note->text);
    } else {
        fprintf(stderr, "%s: %s: record %llu: %s\n", program, escaped,
                note->record, note->text);
    }
}

void report_notes(struct report *report, const struct notes *notes,
                  const char *name)
{
    for (unsigned long long i = 0;
         i < notes->count && report->bad + i < NOTES_MOST; i++) {
        print_note(&notes->note[i], name);
    }
    report->bad += notes->count;
}

void report_end(const struct report *report)
{
    if (report->bad > NOTES_MOST) {
        fprintf(stderr, "%s: %llu bad records in all\n", program, report->bad);
    }
}

void complain(const char *name, const char *what)
{
    char escaped[4 * NAME_MOST + 4];
    escape_bytes(escaped, name, name + strlen(name), NAME_MOST);
    fprintf(stderr, "%s: %s: %s\n", program, escaped, what);
}

void complain_errno(const char *name)
{
    complain(name, strerror(errno));
}

int out_of_memory(void)
{
    fprintf(stderr, "%s: out of memory\n", program);
    return EXIT_MEMORY;
}
