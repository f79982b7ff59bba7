# common.awk - what the converters share: reading numbers, refusing lines
#
# Each converter puts this text in front of its own program.  Numbers are
# passed on as the text they came in, never reformatted, so nothing is lost;
# their values are looked at only to refuse what `cylint -s` would refuse.

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

# Where the current line is, for messages.
function here()
{
    return (FILENAME == "" ? "-" : FILENAME) ":" FNR
}

# In the command's words.
function refuse_found(expected, text)
{
    refuse(here(), "expected " expected ", found " quoted(text))
}

function quoted(text)
{
    return "'" text "'"
}

# Says what is wrong and ends with exit status 1 (see END of each program).
function refuse(place, why)
{
    note(place ": " why)
    failed = 1
    exit 1
}

function note(text)
{
    print program ": " text | "cat 1>&2"
}

function note_skipped(count, what, lacks)
{
    if (count > 0)
        note(count " " what (count == 1 ? "" : "s") " of no " lacks \
             " skipped")
}

# Line ends and a byte-order mark as other systems write them.
FNR == 1 { sub(/^\357\273\277/, "") }
{ sub(/\r$/, "") }
