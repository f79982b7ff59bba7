# pov_tokens.awk - the tokens of a POV-Ray file
#
# A token is a directive such as #declare, a word, an unsigned number, a
# string or a single character.  Comments are left out; they may be nested.

function begin_tokens()
{
    rest = token = ""
    comments = 0
}

# Reads the next token into `token`; "" at the end of the file.
function advance()
{
    token = ""
    while (token == "") {
        while (rest == "") {
            if (!next_line())
                return
            rest = line
        }
        cut_token()
    }
}

# Removes a token, blanks or a part of a comment from the rest of the line.
function cut_token()
{
    if (comments > 0) {
        if (!match(rest, /\/\*|\*\//)) {
            rest = ""
            return
        }
        comments += substr(rest, RSTART, 1) == "/" ? 1 : -1
    } else if (match(rest, /^\/\//)) {
        rest = ""
        return
    } else if (match(rest, /^\/\*/))
        comments = 1
    else if (!match(rest, /^[ \t\f]+/)) {
        if (!(match(rest, /^"([^"\\]|\\.)*"/) ||
              match(rest, /^#?[ \t]*[A-Za-z_][A-Za-z_0-9]*/) ||
              match(rest, /^([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?/)))
            match(rest, /^./)
        token = substr(rest, 1, RLENGTH)
        if (token ~ /^#/)
            gsub(/[ \t]/, "", token)
    }
    rest = substr(rest, RSTART + RLENGTH)
}
