# pov_numbers.awk - numbers and vectors of POV-Ray: literals and arithmetic
#
#     sum    = product { (+ | -) product }
#     product = factor { (* | /) factor }
#     factor = (+ | -) factor | atom { . (x | y | z) }
#     atom   = number | name | x | y | z | pi | ( sum ) | < sum , sum , sum >
#
# A value is the text of one number, or of three numbers separated by blanks.  A
# literal keeps its text.  As in POV-Ray, operators work on each component of
# vectors, and a number beside a vector means three equal components.
#
# Each function returns "" if it fails; then `trouble` is the message.

function parse_value()
{
    trouble = ""
    return sum()
}

function expect(what)
{
    if (trouble == "")
        trouble = "expected " what ", found " \
                  (token == "" ? "the end of the file" : quoted(token))
    return ""
}

function sum(   left, operator)
{
    left = product()
    while (left != "" && (token == "+" || token == "-")) {
        operator = token
        advance()
        left = combine(operator, left, product())
    }
    return left
}

function product(   left, operator)
{
    left = factor()
    while (left != "" && (token == "*" || token == "/")) {
        operator = token
        advance()
        left = combine(operator, left, factor())
    }
    return left
}

function factor(   value)
{
    if (token == "-") {
        advance()
        value = factor()
        return value == "" ? "" : negative(value)
    }
    if (token == "+") {
        advance()
        return factor()
    }
    value = atom()
    while (value != "" && token == ".")
        value = component(value)
    return value
}

function atom(   value)
{
    if (token == "<")
        return vector()
    if (token == "(") {
        advance()
        value = sum()
        if (value != "" && token != ")")
            return expect("')'")
    } else if (token ~ /^[.0-9]/ && is_decimal(token))
        value = is_finite(token) ? token : expect("a finite number")
    else if (token == "x" || token == "y" || token == "z")
        value = (token == "x") " " (token == "y") " " (token == "z")
    else if (token == "pi")
        value = "3.141592653589793"
    else if (token in known)
        value = known[token]
    else
        return expect("a number")
    if (value != "")
        advance()
    return value
}

# Commas may be left out, as in POV-Ray.
function vector(   i, value, list)
{
    advance()
    for (i = 1; i <= 3; i++) {
        value = sum()
        if (value == "")
            return ""
        if (value ~ / /)
            return expect("a number, not a vector, before this")
        if (i < 3 && token == ",")
            advance()
        list = list (i > 1 ? " " : "") value
    }
    if (token != ">")
        return expect("'>'")
    advance()
    return list
}

function component(value,   v)
{
    advance()
    if (token !~ /^[xyz]$/ || split(value, v, " ") != 3)
        return expect("a component of a vector")
    value = v[index("xyz", token)]
    advance()
    return value
}

function negative(value,   i, n, v, list)
{
    n = split(value, v, " ")
    for (i = 1; i <= n; i++) {
        if (v[i] + 0 != 0)
            v[i] = v[i] ~ /^-/ ? substr(v[i], 2) : "-" v[i]
        list = list (i > 1 ? " " : "") v[i]
    }
    return list
}

function combine(operator, left, right,   i, n, a, b, result, list)
{
    if (right == "")
        return ""
    n = split(left, a, " ")
    if (split(right, b, " ") != n) {
        if (n == 1)
            left = left " " left " " left
        else
            right = right " " right " " right
        n = split(left, a, " ")
        split(right, b, " ")
    }
    for (i = 1; i <= n; i++) {
        result = operate(operator, a[i] + 0, b[i] + 0)
        if (result == "")
            return ""
        list = list (i > 1 ? " " : "") result
    }
    return list
}

function operate(operator, a, b,   result)
{
    if (operator == "/" && b == 0)
        return expect("a divisor other than 0 before this")
    result = operator == "+" ? a + b : operator == "-" ? a - b : \
             operator == "*" ? a * b : a / b
    if (!is_finite(result))
        return expect("a finite result before this")
    return shortest(result)
}

# The text with the fewest digits that reads back as the same double.
function shortest(value,   digits, text)
{
    for (digits = 15; digits <= 17; digits++) {
        text = sprintf("%." digits "g", value)
        if (text + 0 == value)
            break
    }
    return text
}

# ------------------------------------------------------- names of numbers --

# known: the values of names.  changeable: names that a macro declares; a
# call of the macro changes them.

function begin_names()
{
    split("", known)
    split("", changeable)
    split("", macro)
}

function forget(name)
{
    delete known[name]
}

# An included file may declare any name.
function forget_all_names()
{
    split("", known)
}

# Reads the text after the word #declare or #local.  In a loop or a condition the
# name becomes unknown.  In a macro #local declares a name of the macro.
function read_declaration(directive,   name, value)
{
    name = token
    if (name !~ /^[A-Za-z_]/)
        return
    advance()
    value = ""
    if (token == "=") {
        advance()
        value = parse_value()
        if (value == "" || token !~ /^([;#}A-Za-z_].*)?$/) {
            value = ""
            skip_value()
        }
    }
    if (in_macro[directives]) {
        if (directive == "#local")
            return
        changeable[name] = 1
    }
    if (value == "" || directives > 0 || name in changeable)
        forget(name)
    else
        known[name] = value
}

# Skips a value that is not a number: to its end, or to its block.
function skip_value()
{
    while (token != "" && token !~ /^([;{}]|#.*)$/ && !is_shape(token)) {
        previous = token
        advance()
    }
    declaring = token == ";" ? 0 : 2
}

function read_macro_name()
{
    macro[token] = 1
    advance()
}

# Skips the text in parentheses.  forgetting: the names in it become unknown.
function skip_arguments(forgetting,   open)
{
    if (token != "(")
        return
    while (token != "") {
        if (token == "(")
            open++
        else if (token == ")" && --open == 0)
            return
        else if (forgetting)
            forget(token)
        advance()
    }
}
