# pov.awk - POV-Ray cylinders and cones

BEGIN { convert_files() }

function begin_file()
{
    start_file()
}

function read_line(text)
{
    read_tokens(text)
}

function end_file()
{
    if (depth > 0)
        refuse(last_place, "the file ends inside a block")
}

function finish(   n)
{
    for (n = 1; n <= shapes; n++)
        print scene[n]
}

# state: what the next token may be.  "" anything; "brace" the { of a shape;
# "number" the next number of a shape; "rest" the words after its numbers.
function start_file()
{
    depth = in_comment = directives = 0
    state = word = ""
}

# Cuts a line into words, numbers, strings and single characters.
function read_tokens(rest)
{
    last_place = here()
    while (rest != "") {
        if (in_comment) {
            if (!match(rest, /\*\//))
                return
            in_comment = 0
        } else if (match(rest, /^[ \t,]+/)) {
            # Commas only part numbers, which are counted.
        } else if (match(rest, /^\/\//)) {
            return
        } else if (match(rest, /^\/\*/)) {
            in_comment = 1
        } else if (match(rest, /^"([^"\\]|\\.)*"/) ||
                   match(rest, /^#?[A-Za-z_][A-Za-z_0-9]*/) ||
                   match(rest, \
                   /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?/) ||
                   match(rest, /^./)) {
            take(substr(rest, 1, RLENGTH))
        }
        rest = substr(rest, RSTART + RLENGTH)
    }
}

function take(token)
{
    if (state == "brace")
        open_shape(token)
    else if (state == "number")
        take_number(token)
    else if (state == "rest" && depth == shape_depth)
        take_modifier(token)
    else if (token == "cylinder" || token == "cone")
        begin_shape(token)
    else if (token ~ /^#(while|for|if|ifdef|ifndef|macro|switch)$/)
        directives++
    else if (token == "#end")
        directives--
    else
        take_other(token)
    if (token == "#declare" || token == "#local")
        declares = 4 # this word, the name, the = and the word of an object
    else if (token == ";")
        declares = 0
    else if (declares > 0)
        declares--
    word = token
}

# Blocks are kept on a stack by the word before their brace.
function take_other(token)
{
    if (token == "{") {
        depth++
        block[depth] = word
        holds[depth] = ""
        transformed[depth] = declared[depth] = 0
        if (declares > 0)
            declared[depth] = 1
    } else if (token == "}") {
        if (depth == 0)
            refuse(here(), "a } without its {")
        close_block()
    } else if (is_transform(token) && depth > 0 && state == "")
        transformed[depth] = 1
}

function close_block()
{
    if (state == "rest" && depth == shape_depth)
        end_shape()
    else if (transformed[depth] && holds[depth] != "")
        refuse(holds[depth], "a shape inside a transformed " block[depth])
    else if (holds[depth] != "" && depth > 1)
        holds[depth - 1] = holds[depth]
    depth--
}

function begin_shape(token)
{
    place = here()
    shape = token
    first_line = line_number
    state = "brace"
}

# Refuses a shape that does not stand in the picture as it is written.
function check_surroundings(   i)
{
    if (directives > 0)
        refuse(place, "a shape inside a loop, condition or macro")
    if (declares > 0)
        refuse(place, "a shape that is only declared")
    for (i = 1; i <= depth; i++) {
        if (declared[i])
            refuse(place, "a shape that is only declared")
        if (block[i] !~ /^(union|merge|object|light_group)$/)
            refuse(place, "a shape inside " block[i] "{}")
    }
}

function open_shape(token)
{
    if (token != "{") { # for instance `cylinder` as a kind of light
        state = ""
        take_other(token)
        return
    }
    check_surroundings()
    depth++
    block[depth] = shape
    holds[depth] = ""
    transformed[depth] = 0
    shape_depth = depth
    plan = shape == "cone" ? "<nnn>n<nnn>n" : "<nnn><nnn>n"
    numbers = shape
    ends = ""
    state = "number"
}

# The plan says what follows: brackets as they are, n for a number.
function take_number(token,   expected)
{
    expected = substr(plan, 1, 1)
    plan = substr(plan, 2)
    if (expected == "n") {
        if (!is_number(token))
            refuse_found("a literal number", token)
        numbers = numbers " " token
    } else if (token != expected)
        refuse_found(quoted(expected), token)
    if (plan == "")
        state = "rest"
}

function take_modifier(token)
{
    if (token == "open")
        ends = " ends=open"
    else if (is_transform(token))
        refuse(here(), "a transformed " shape)
    else if (token ~ /^[-+*\/.0-9]/)
        refuse_found("the end of a number", token)
    else
        take_other(token)
}

function is_transform(token)
{
    return token ~ /^(translate|rotate|scale|matrix|transform)$/
}

function end_shape(   n, value)
{
    n = split(numbers, value, " ")
    check_shape(n, value)
    scene[++shapes] = numbers ends " " first_line
    state = ""
    if (depth > 1)
        holds[depth - 1] = place
}

function check_shape(n, value,   p, q, r0)
{
    p = 2
    q = shape == "cone" ? 6 : 5
    r0 = shape == "cone" ? value[5] : value[8]
    if (r0 < 0 || value[n] < 0)
        refuse(place, "negative radius")
    if (r0 + 0 == 0 && value[n] + 0 == 0)
        refuse(place, "no radius")
    if (value[p] + 0 == value[q] + 0 && value[p + 1] + 0 == value[q + 1] + 0 \
        && value[p + 2] + 0 == value[q + 2] + 0)
        refuse(place, "no length")
}
