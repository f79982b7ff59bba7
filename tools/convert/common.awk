# common.awk - the common part of all kinds: files, numbers, messages
#
# A kind defines begin_file(), read_line(text), end_file() and finish(), which is
# called after the last file; its BEGIN calls convert_files().  A kind that
# reads ahead calls next_line() in begin_file().  Files are read by getline, so
# that a missing or empty file is detected and a name may have a `=`.  Lines end
# with LF, CR LF or CR.
#
# Numbers are written with the digits that were read.  Their values are used only
# to refuse what `cylint -s` refuses.

function convert_files(   i)
{
    if (ARGC < 2)
        convert_file("-")
    for (i = 1; i < ARGC; i++)
        convert_file(ARGV[i])
    finish()
}

function convert_file(name)
{
    file = name
    line_number = parts = 0
    next_part = 1
    begin_file()
    while (next_line())
        read_line(line)
    close(file)
    end_file()
}

# Reads the next line of the file into `line`.  Returns whether there is one.
function next_line(   status)
{
    if (next_part <= parts)
        line = part[next_part++]
    else {
        status = (getline line < file)
        if (status < 0)
            fail(file, "cannot be read", 3)
        if (status == 0)
            return 0
        if (line_number == 0)
            sub(/^\357\273\277/, "", line) # a byte-order mark
        sub(/\r$/, "", line)
        if (index(line, "\r") > 0)
            cut_line()
    }
    line_number++
    return 1
}

# Splits `line` into lines, in a file in which CR alone ends a line.
function cut_line()
{
    parts = split(line, part, "\r")
    line = part[1]
    next_part = 2
}

# ------------------------------------------------------------------ numbers --

# Returns whether the text is a finite decimal number.
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

# The same wording as in cylint.
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
