# common.awk - what all kinds share: reading files, numbers, messages
#
# A kind defines begin_file(), read_line(text), end_file() and, for what
# follows the last file, finish(); its BEGIN calls convert_files().  Files are
# read by getline, so that a missing or empty file and a name with a `=` are
# noticed, and lines end with LF, CR LF or CR.
#
# Numbers are written as the text that was read, so no digit is lost; their
# values serve to refuse what `cylint -s` refuses.

function convert_files(   i)
{
    if (ARGC < 2)
        convert_file("-")
    for (i = 1; i < ARGC; i++)
        convert_file(ARGV[i])
    finish()
}

function convert_file(name,   status, text)
{
    file = name
    line_number = 0
    begin_file()
    while ((status = (getline text < file)) > 0) {
        if (line_number == 0)
            sub(/^\357\273\277/, "", text) # a byte-order mark
        sub(/\r$/, "", text)
        if (index(text, "\r") > 0)
            read_lines(text)
        else
            take_line(text)
    }
    if (status < 0)
        fail(file, "cannot be read", 3)
    close(file)
    end_file()
}

# The lines of a file in which CR alone ends a line.
function read_lines(text,   i, n, lines)
{
    n = split(text, lines, "\r")
    for (i = 1; i <= n; i++)
        take_line(lines[i])
}

function take_line(text)
{
    line_number++
    read_line(text)
}

# ------------------------------------------------------------------ numbers --

# Is this text a finite decimal number?
function is_number(text)
{
    return is_decimal(text) && is_finite(text)
}

function is_decimal(text)
{
    return text ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/
}

function is_finite(text)
{
    return text + 0 <= 1.7976931348623157e308 &&
           text + 0 >= -1.7976931348623157e308
}

# ----------------------------------------------------------------- messages --

# The current file and line.
function here()
{
    return file ":" line_number
}

# The command's wording.
function refuse_found(expected, text)
{
    refuse(here(), "expected " expected ", found " quoted(text))
}

function quoted(text)
{
    return "'" text "'"
}

function refuse(place, why)
{
    fail(place, why, 1)
}

# Writes a message and ends with this exit status.
function fail(place, why, status)
{
    note(place ": " why)
    exit status
}

function note(text)
{
    print "cylint-convert: " text | "cat 1>&2"
}

# "3 edges": a number and a noun.
function counted(count, noun)
{
    return count " " noun (count == 1 ? "" : "s")
}

function note_skipped(count, what, lacks)
{
    if (count > 0)
        note(counted(count, what) " of no " lacks " skipped")
}
