/*
 * about.c - --help, --version and the lists
 */
#include <stdio.h>
#include <string.h>

#include "cylint.h"
#include "main.h"
#include "options.h"
#include "report.h"

static const char help[] =
    "cylint [OPTION]... [FILE]...\n"
    "  a line and a shape in every record\n"
    "cylint -s SCENE [OPTION]... [FILE]...\n"
    "  a line or point in every record, and all shapes of SCENE\n"
    "\n"
    "Intersects lines with cylinders, cones and round shapes, and computes "
    "the\n"
    "distances of points from them.  Reads records from files or standard "
    "input\n"
    "(-), one a line, and writes one answer for each.\n"
    "\n"
    "  record  LINE SHAPE [ends=WORD] [TAIL]\n"
    "          with -s: LINE [not=NAME]... [TAIL]\n"
    "  LINE    line|ray ox oy oz dx dy dz   segment ax ay az bx by bz\n"
    "          span ox oy oz dx dy dz tmin tmax   point x y z\n"
    "  SHAPE   cylinder p0 p1 r   cone p0 r0 p1 r1   ecylinder c a b h\n"
    "          econe c a b h k    acone v u degrees\n"
    "          sphere c r   capsule p0 p1 r   rcone p0 r0 p1 r1\n"
    "          halfspace p n\n"
    "  WORD    capped open cap0 cap1 infinite nappe\n"
    "\n"
    "  -k LINE,SHAPE      records are bare numbers of these kinds; -s: -k "
    "LINE\n"
    "  -s FILE            a scene, one SHAPE [ends=WORD] [SOLID]... [TAIL] a "
    "line,\n"
    "                     or a neuron: NAME.swc, or a file of --save\n"
    "                     SOLID: in=NAME[/CLAUSE] or out=NAME[/CLAUSE]\n"
    "  --save FILE        save the scene for other calls' -s; without input\n"
    "                     files only that\n"
    "  --text             write the scene as text instead of answers\n"
    "  --swc FORM         of a neuron: cones (default) or round\n"
    "  -q QUERY           with -s: nearest (default), first, any, count, all,\n"
    "                     pieces or inside\n"
    "  --pieces MODE      of -q pieces: owner (default), union, cells or "
    "chords\n"
    "  --union            the same as --pieces union\n"
    "  --rank FILE        lines LABEL INTEGER: of several solids the one with "
    "the\n"
    "                     least rank owns a place\n"
    "  --first K          of -q pieces: the first K pieces of each line\n"
    "  --sum WHAT         of -q pieces: sums of lengths, one for each label: "
    "label;\n"
    "                     in multiples of the direction: label:t\n"
    "  --not WHAT         with -s: a record's not=NAME leaves out the shape "
    "with\n"
    "                     this number (default) or those with this label\n"
    "  --within R         with -s: of points, shapes up to R away\n"
    "  --signed           of points: distances from closed solids\n"
    "  -f LIST            output columns, see --list=columns\n"
    "  --ends WORD        the ends of shapes without ends=\n"
    "  -t MIN,MAX         the domain of lines and rays\n"
    "  --method NAME      answer by a published method, see --list=methods\n"
    "  --accel HOW        with -s: auto, none or tree; the answers are the "
    "same\n"
    "  -p N, -x           N significant digits; hexadecimal\n"
    "  -d CHAR            output separator, instead of a tab\n"
    "  --miss TOKEN       what to write for a missing value\n"
    "  -e HOW             bad records: mark (default), skip or stop\n"
    "  --tail             with -k: a tail may begin with a number\n"
    "  --no-tail          a record with a tail is bad\n"
    "  -C                 copy blank lines and comments through\n"
    "  -b, --binary-in, --binary-out\n"
    "                     little-endian doubles in and out, in, out (needs "
    "-k)\n"
    "  --npy              binary answers as a .npy array\n"
    "  -j N               workers, at most; one for each processor by default\n"
    "  --hits-only        only answers with a hit\n"
    "  --header           column names first\n"
    "  -o FILE            output file\n"
    "  --progress         write the progress to standard error\n"
    "  --list=WHAT        methods, shapes or columns, one a line\n"
    "  --help, --version\n"
    "\n"
    "Exit status: 0 all answered, 1 some records bad, 2 usage, 3 input or "
    "output\n"
    "failed, 4 out of memory.  See cylint(1).\n";

static void print_row(const char *name, const char *second, const char *third)
{
    printf("%s\t%s\t%s\n", name, second, third);
}

static void list_shapes(void)
{
    for (int i = 0; i < SHAPE_KINDS; i++) {
        printf("%s\t%d\t%s\n", shape_kinds[i].word, shape_kinds[i].numbers,
               shape_kinds[i].names);
    }
}

static void list_methods(void)
{
    for (const cylint_method *m = cylint_methods(); m->name; m++) {
        print_row(m->name, m->source, m->shapes);
    }
}

int print_about(const char *what)
{
    if (strcmp(what, "help") == 0) {
        fputs(help, stdout);
    } else if (strcmp(what, "version") == 0) {
        puts("cylint " CYLINT_VERSION);
    } else if (strcmp(what, "methods") == 0) {
        list_methods();
    } else if (strcmp(what, "shapes") == 0) {
        list_shapes();
    } else {
        list_columns(print_row);
    }
    if (fflush(stdout) != 0 || ferror(stdout)) {
        complain_errno("standard output");
        return EXIT_IO;
    }
    return 0;
}
