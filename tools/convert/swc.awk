# swc.awk - neurons in SWC: a frustum or a rounded cone from each node to its
# parent
#
# An SWC line is `id type x y z radius parent`; `#` begins a comment; parent
# -1 marks a root.  Fields are separated by blanks, tabs and at most one comma.
# Each node with a parent gives one frustum, labelled with the node's id:
#
#     cone x y z radius  xp yp zp radiusp  id
#
# If `round`, it gives a rounded cone, and each root gives a sphere:
#
#     rcone x y z radius  xp yp zp radiusp  id
#     sphere x y z radius  id
#
# A node whose parent is not in the file is a root.  tools/cylint/swc.c reads
# the same files, gives the same shapes and writes the same messages.

BEGIN { convert_files() }

function begin_file()
{
    split("", index_of)
    nodes = 0
}

function read_line(text,   i)
{
    if (text ~ /^[ \t]*(#|$)/)
        return
    split_fields(text)
    if (!is_node(field[1]))
        refuse_field("a node's number", 1)
    for (i = 3; i <= 6; i++)
        if (!is_decimal(field[i]))
            refuse_field("a number", i)
        else if (!is_finite(field[i]))
            refuse(here(), "number too large: " quoted(field[i]))
    if (field[6] < 0)
        refuse(here(), "negative radius: " quoted(field[6]))
    if (!is_root(field[7]) && !is_node(field[7]))
        refuse_field("a node's number or -1", 7)
    add_node(node(field[1]), is_root(field[7]) ? -1 : node(field[7]))
}

function split_fields(text)
{
    if (text !~ /,/) {
        fields = split(text, field, " ")
        return
    }
    sub(/^[ \t]+/, "", text)
    gsub(/[ \t]*,[ \t]*/, ",", text)
    gsub(/[ \t]+/, ",", text)
    sub(/,$/, "", text)
    fields = split(text, field, ",")
}

# An empty field means a comma too many.
function refuse_field(what, i)
{
    if (i <= fields)
        refuse_found(what, field[i] == "" ? "," : field[i])
    refuse(here(), "expected " what ", found the end of the line")
}

# Node numbers are digits, at most 18, or a whole decimal number below 2^53.
function is_node(text)
{
    if (text ~ /^[0-9]+$/)
        return length(without_zeros(text)) <= 18
    return is_decimal(text) && text !~ /^-/ && text + 0 < 9007199254740992 &&
           text + 0 == int(text)
}

function node(text)
{
    return text ~ /^[0-9]+$/ ? without_zeros(text) : sprintf("%.0f", text)
}

function without_zeros(text)
{
    sub(/^0+/, "", text)
    return text == "" ? "0" : text
}

function is_root(text)
{
    return text == "-1" || (is_decimal(text) && text + 0 == -1)
}

function add_node(number, parent_number)
{
    if (number in index_of)
        refuse(here(), "this node was given before: " quoted(field[1]))
    index_of[number] = ++nodes
    id[nodes] = number
    parent[nodes] = parent_number
    x[nodes] = field[3]
    y[nodes] = field[4]
    z[nodes] = field[5]
    radius_of[nodes] = field[6]
    place[nodes] = here()
}

function end_file(   n)
{
    if (nodes == 0)
        refuse(file, "no node was found")
    find_parents()
    for (n = 1; n <= nodes; n++)
        if (parent[n] > 0)
            write_edge(n, parent[n])
        else if (round)
            write_ball(n)
}

# Replaces the parents' numbers by their indices; 0: the node is a root.
function find_parents(   n)
{
    for (n = 1; n <= nodes; n++)
        if (parent[n] == -1)
            parent[n] = 0
        else if (parent[n] in index_of)
            parent[n] = index_of[parent[n]]
        else {
            parent[n] = 0
            without_parent++
        }
    split("", walk)
    for (n = 1; n <= nodes; n++)
        refuse_cycle(n)
}

# Follows the parents of a node to a root or to a node followed before.
function refuse_cycle(start,   n)
{
    for (n = start; n > 0 && !(n in walk); n = parent[n])
        walk[n] = start
    if (n > 0 && walk[n] == start) {
        n = first_of_cycle(n)
        refuse(place[n], parent[n] == n ? \
               "node " id[n] " is its own parent" : \
               "the parents of node " id[n] " lead back to it")
    }
}

function first_of_cycle(start,   first, n)
{
    first = start
    for (n = parent[start]; n != start; n = parent[n])
        if (n < first)
            first = n
    return first
}

# A rounded cone without length is a ball.
function write_edge(from, to)
{
    if (!round && x[from] + 0 == x[to] + 0 && y[from] + 0 == y[to] + 0 &&
        z[from] + 0 == z[to] + 0)
        without_length++
    else if (radius_of[from] + 0 == 0 && radius_of[to] + 0 == 0)
        without_radius++
    else
        print round ? "rcone" : "cone", x[from], y[from], z[from],
              radius_of[from], x[to], y[to], z[to], radius_of[to], id[from]
}

function write_ball(root)
{
    if (radius_of[root] + 0 == 0)
        roots_without_radius++
    else
        print "sphere", x[root], y[root], z[root], radius_of[root], id[root]
}

function finish()
{
    if (without_parent > 0)
        note(counted(without_parent, "node") \
             " with a parent that is not in the file taken as " \
             (without_parent == 1 ? "a root" : "roots"))
    note_skipped(without_length, "edge", "length")
    note_skipped(without_radius, "edge", "radius")
    note_skipped(roots_without_radius, "root", "radius")
}
