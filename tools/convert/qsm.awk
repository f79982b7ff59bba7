# qsm.awk - trees as tables of cylinders (QSM)
#
# Columns are found by name, in any order, case and punctuation, so that the
# tables of aRchi, rTwig and SimpleForest can be read: startX or start_x, endX
# or else axis_x and length, radius or radius_cyl, ID or cyl_ID.  Fields are
# separated by commas, semicolons or tabs, as in the header.  TreeQSM text
# (`treeqsm`) has no header; its columns are radius, length, start (3) and axis
# (3), then others; its lines are numbered from 1.
#
#     cylinder x0 y0 z0  x1 y1 z1  radius  id
#
# If `round`, cylinders become capsules, whose round ends fill the joints.  A
# capsule may have no length.

BEGIN { convert_files() }

function begin_file()
{
    rows = 0
    if (treeqsm)
        name_treeqsm_columns()
}

function read_line(text)
{
    if (line_number == 1 && !treeqsm)
        read_header(text)
    else if (text !~ /^[ \t]*(#|$)/ &&
             !(line_number == 1 && tolower(text) ~ /^[ \t"]*radius/))
        read_row(text)
}

function read_row(text,   fields)
{
    rows++
    fields = treeqsm ? split(text, field, " ") : split(text, field, separator)
    if (fields < last_column)
        refuse(here(), "expected " last_column " fields, found " fields)
    write_cylinder()
}

function end_file()
{
    if (line_number == 0 && !treeqsm)
        refuse(file, "expected a header line, found the end of the file")
}

function finish()
{
    note_skipped(without_length, "cylinder", "length")
    note_skipped(without_radius, "cylinder", "radius")
}

# Returns the value of a named column of the current line; it must be a number.
function number(name,   text)
{
    text = bare(field[column[name]])
    if (!is_number(text))
        refuse_found("a number for " name, text)
    return text
}

function bare(text)
{
    gsub(/^[ \t"]+|[ \t"]+$/, "", text)
    return text
}

function write_cylinder(   x0, y0, z0, x1, y1, z1, r, length_, id)
{
    x0 = number("startx"); y0 = number("starty"); z0 = number("startz")
    r = number("radius")
    if (r < 0)
        refuse(here(), "negative radius " r)
    if ("endx" in column) {
        x1 = number("endx"); y1 = number("endy"); z1 = number("endz")
    } else {
        length_ = number("length")
        x1 = sprintf("%.17g", x0 + length_ * number("axisx"))
        y1 = sprintf("%.17g", y0 + length_ * number("axisy"))
        z1 = sprintf("%.17g", z0 + length_ * number("axisz"))
    }
    id = "id" in column ? bare(field[column["id"]]) : rows
    if (!round && x0 + 0 == x1 + 0 && y0 + 0 == y1 + 0 && z0 + 0 == z1 + 0)
        without_length++
    else if (r + 0 == 0)
        without_radius++
    else
        print round ? "capsule" : "cylinder", x0, y0, z0, x1, y1, z1, r, id
}

function name_treeqsm_columns(   i, names)
{
    last_column = split("radius length startx starty startz " \
                        "axisx axisy axisz", names, " ")
    for (i = 1; i <= last_column; i++)
        column[names[i]] = i
}

# Finds the columns by the names in the header line.
function read_header(text,   i, n, name, names)
{
    separator = text ~ /;/ ? ";" : (text ~ /\t/ ? "\t" : ",")
    split("", column)
    n = split(text, names, separator)
    for (i = 1; i <= n; i++) {
        name = tolower(names[i])
        gsub(/[^a-z0-9]/, "", name)
        sub(/^cylid$/, "id", name)
        sub(/^(radiuscyl|cylradius)$/, "radius", name)
        if (!(name in column))
            column[name] = i
    }
    last_column = 0
    need("startx starty startz radius")
    if ("endx" in column)
        need("endx endy endz")
    else
        need("axisx axisy axisz length")
}

function need(list,   i, n, names)
{
    n = split(list, names, " ")
    for (i = 1; i <= n; i++) {
        if (!(names[i] in column))
            refuse(here(), "the header names no column " quoted(names[i]))
        if (column[names[i]] > last_column)
            last_column = column[names[i]]
    }
}
