# pov.awk - POV-Ray cylinders, cones, spheres and sphere sweeps
#
# Reads `cylinder { <x,y,z>, <x,y,z>, r [open] ... }`, `cone { <x,y,z>, r,
# <x,y,z>, r [open] ... }`, `sphere { <x,y,z>, r ... }` and `sphere_sweep {
# linear_spline n, <x,y,z>, r, ... }` whose numbers pov_numbers.awk can compute.
# Each becomes one line of the scene, a sweep n - 1 lines; the label is the line
# of the file on which the object begins.  Other objects and textures are
# skipped.  Coordinates are not changed: POV-Ray's axes are left-handed, so the
# scene is mirrored in right-handed axes.
#
# A shape that only POV-Ray can evaluate is refused, or left out and counted if
# `skip`: one that is transformed, clipped, declared, repeated, conditional, or
# a part of a difference, an intersection or an object that is transformed.

BEGIN { convert_files() }

function begin_file()
{
    begin_tokens()
    begin_names()
    depth = directives = declaring = 0
    in_macro[0] = 0
    previous = ""
    advance()
    while (token != "")
        take()
    if (depth > 0)
        refuse(here(), "the file ends inside a block")
}

function read_line(text)
{
}

function end_file()
{
}

function finish(   n)
{
    for (n = 1; n <= shapes; n++)
        print scene[n]
    for (n = 1; n <= kinds; n++)
        note(left_out[kind_of[n]] " " noun_of[n] " {} left out" reason_of[n])
    if (shapes == 0)
        note("no cylinder {}, cone {}, sphere {} or sphere_sweep {}" \
             " was converted")
}

function take(   word)
{
    if (declaring > 0)
        declaring--
    word = token
    if (word ~ /^#/) {
        previous = word
        take_directive(word)
        return
    }
    if (is_shape(word))
        take_shape(word)
    else {
        if (word == "{")
            open_block(previous)
        else if (word == "}")
            close_block()
        else
            take_modifier(word, previous)
        advance()
        if (block[depth] == "object" && previous == "{" && depth > 0 &&
            word ~ /^[A-Za-z_]/ && token != "{")
            count_left_out("object", ": declared elsewhere")
        if (word in macro && token == "(") {
            take_modifier("(", word)
            skip_arguments(1)
        }
    }
    previous = word
}

function is_shape(word)
{
    return word ~ /^(cylinder|cone|sphere|sphere_sweep)$/
}

# -------------------------------------------------------------- directives --

function take_directive(word)
{
    advance()
    if (word ~ /^#(while|for|if|ifdef|ifndef|macro|switch)$/) {
        directives++
        depth_at[directives] = depth
        in_macro[directives] = in_macro[directives - 1] || word == "#macro"
        if (word == "#macro")
            read_macro_name()
        skip_arguments(word == "#for")
    } else if (word ~ /^#(else|elseif|case|range)$/ && directives > 0) {
        depth = depth_at[directives] # the branches open the same blocks
        skip_arguments(0)
    } else if (word == "#end" && directives > 0)
        directives--
    else if (word == "#declare" || word == "#local")
        read_declaration(word)
    else if (word == "#undef")
        forget(token)
    else if (word == "#read")
        skip_arguments(1)
    else if (word == "#include")
        forget_all_names()
}

# ------------------------------------------------------------------ blocks --

# A stack has the word before the brace of each open block.
function open_block(name)
{
    depth++
    block[depth] = name
    shape_of[depth] = altered[depth] = ""
    first_inside[depth] = shapes + 1
    declared[depth] = declaring == 1
    conditional[depth] = directives > 0
    if (name ~ /^(box|torus|mesh2?|plane|disc|triangle|prism)$/ ||
        name ~ /^(lathe|sor|smooth_triangle|polygon|height_field|text)$/ ||
        name ~ /^(bicubic_patch|superellipsoid|blob|isosurface|cubic)$/ ||
        name ~ /^(parametric|julia_fractal|quadric|quartic|poly)$/)
        count_left_out(name, "")
}

function close_block(   n, reason)
{
    if (depth == 0)
        refuse(here(), "a } without its {")
    if (shape_of[depth] != "")
        end_shape()
    else if (altered[depth] != "") {
        reason = "inside " block[depth] " {}, which is " altered[depth]
        for (n = first_inside[depth]; n <= shapes; n++)
            leave_out(shape_kind[n], reason, shape_place[n])
        if (shapes >= first_inside[depth])
            shapes = first_inside[depth] - 1
    }
    depth--
}

# A word in a block that transforms or clips its contents.  A word before a
# parenthesis may be a macro that does this.
function take_modifier(word, before)
{
    if (depth == 0)
        return
    if (word ~ /^(translate|rotate|scale|matrix|transform)$/)
        alter("transformed")
    else if (word == "clipped_by")
        alter("clipped")
    else if (word == "(" && before ~ /^[A-Za-z_]/)
        alter("given to a macro")
    else if (word == "open" && shape_of[depth] != "") {
        ends[depth] = " ends=open"
        if (directives > 0)
            alter("inside a loop, condition or macro")
    }
}

function alter(how)
{
    if (altered[depth] != "")
        return
    altered[depth] = how
    if (shape_of[depth] != "")
        leave_out_now(how, here())
}

# ------------------------------------------------------------------ shapes --

# Reads the text after the name of a shape; cylinder may also be a light.
function take_shape(kind,   place, first_line, reason)
{
    place = here()
    first_line = line_number
    advance()
    if (token != "{")
        return
    reason = surroundings()
    open_block(kind)
    declaring = 0
    advance()
    previous = ""
    shape_of[depth] = kind
    left[depth] = ""
    ends[depth] = ""
    place_of[depth] = place
    label[depth] = first_line
    directives_of[depth] = directives
    if (reason != "")
        leave_out_now(reason, place)
    else
        read_numbers(kind)
}

# Returns why POV-Ray does not show a shape here as it is written, or "".
function surroundings(   i)
{
    for (i = 1; i <= depth; i++)
        if (block[i] ~ /^(bounded_by|contained_by)$/)
            return "bounds"
    if (directives > 0)
        return "inside a loop, condition or macro"
    if (declaring > 0)
        return "only declared"
    for (i = 1; i <= depth; i++) {
        if (declared[i])
            return "only declared"
        if (conditional[i])
            return "inside a loop, condition or macro"
        if (block[i] !~ /^(union|merge|object|light_group)$/)
            return "inside " (block[i] ~ /^[A-Za-z_]/ ? block[i] : "a block") \
                   " {}"
    }
    return ""
}

# Leaves out the present shape and counts it once.  A bounding shape is not
# part of the picture.
function leave_out_now(reason, place)
{
    if (left[depth] == "" && reason != "bounds")
        leave_out(shape_of[depth], reason, place)
    left[depth] = reason
}

function leave_out(kind, reason, place)
{
    if (!skip)
        refuse(place, kind ": " reason "; --skip leaves such shapes out")
    count_left_out(kind, ": " reason)
}

function count_left_out(noun, reason)
{
    if (!skip)
        return
    if (!((noun reason) in left_out)) {
        kind_of[++kinds] = noun reason
        noun_of[kinds] = noun
        reason_of[kinds] = reason
    }
    left_out[noun reason]++
}

function read_numbers(kind,   fine)
{
    numbers[depth] = kind
    if (kind == "sphere_sweep" && token != "linear_spline") {
        leave_out_now("not of linear type", here())
        return
    }
    if (kind == "sphere_sweep")
        fine = read_sweep()
    else
        fine = read_values(kind == "cylinder" ? "vvn" : \
                           kind == "cone" ? "vnvn" : "vn")
    if (fine)
        return
    if (!skip)
        refuse(here(), trouble "; --skip leaves such shapes out")
    leave_out_now("with numbers that are not understood", here())
}

# Appends values to the numbers of the present shape.  plan: v for a vector, n
# for a number; the last value is followed by a word, a directive or a `}`.
function read_values(plan,   i)
{
    for (i = 1; i <= length(plan); i++)
        if (!read_value(substr(plan, i, 1), i == length(plan)))
            return 0
    return 1
}

function read_value(type, is_last,   value)
{
    value = parse_value()
    if (value != "" && value !~ / / && type == "v")
        value = value " " value " " value
    if (value ~ / / && type == "n")
        value = expect("a number, not a vector, before this")
    if (!is_last && token == ",")
        advance()
    if (is_last && value != "" && token !~ /^[#}A-Za-z_]/)
        value = expect("the end of a number")
    numbers[depth] = numbers[depth] " " value
    return value != ""
}

# The number of spheres, and the centre and the radius of each.
function read_sweep(   i, count)
{
    advance()
    count = parse_value()
    if (count != "" && (count !~ /^[0-9]+$/ || count < 2))
        count = expect("a whole number above 1 before this")
    if (count == "")
        return 0
    if (token == ",")
        advance()
    for (i = 1; i <= count; i++)
        if (!read_value("v", 0) || !read_value("n", i == count))
            return 0
    return 1
}

function end_shape(   fault)
{
    if (left[depth] != "")
        return
    fault = directives != directives_of[depth] ? \
            "inside a loop, condition or macro" : fault_of(numbers[depth])
    if (fault != "") {
        leave_out_now(fault, place_of[depth])
        return
    }
    write_shape()
}

# A sweep becomes a rounded cone for each pair of neighbours.
function write_shape(   i, n, value)
{
    if (shape_of[depth] != "sphere_sweep") {
        add_line(numbers[depth] ends[depth])
        return
    }
    n = split(numbers[depth], value, " ")
    for (i = 2; i + 7 <= n; i += 4)
        add_line("rcone " value[i] " " value[i + 1] " " value[i + 2] " " \
                 value[i + 3] " " value[i + 4] " " value[i + 5] " " \
                 value[i + 6] " " value[i + 7])
}

function add_line(text)
{
    scene[++shapes] = text " " label[depth]
    shape_kind[shapes] = shape_of[depth]
    shape_place[shapes] = place_of[depth]
}

function fault_of(text,   i, n, value, fault)
{
    n = split(text, value, " ")
    if (value[1] == "cylinder" || value[1] == "sphere")
        fault = fault_of_radii(value[n], value[n])
    else
        for (i = 5; i + 4 <= n && fault == ""; i += 4)
            fault = fault_of_radii(value[i], value[i + 4])
    if (fault == "" && ((value[1] == "cylinder" && same_point(value, 2, 5)) ||
                        (value[1] == "cone" && same_point(value, 2, 6))))
        fault = "without length"
    return fault
}

function fault_of_radii(r0, r1)
{
    if (r0 < 0 || r1 < 0)
        return "with a negative radius"
    return r0 + 0 == 0 && r1 + 0 == 0 ? "without radius" : ""
}

function same_point(value, p, q)
{
    return value[p] + 0 == value[q] + 0 && \
           value[p + 1] + 0 == value[q + 1] + 0 && \
           value[p + 2] + 0 == value[q + 2] + 0
}
