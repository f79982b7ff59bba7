# What the tests of installed and of packaged files share; `verdict.sh` comes
# first.
cc=${CC:-cc}
cxx=${CXX:-c++}
make=${MAKE:-make}
version=$(sed -n 's/^#define CYLINT_VERSION "\(.*\)"/\1/p' include/cylint.h)

# block LANGUAGE NUMBER: the text of a fenced block of README.md.
block()
{
    awk -v fence='```'"$1" -v wanted="$2" '
        inside && /^```/ { inside = 0; next }
        inside == 2
        /^```/ && !inside { inside = 1 }
        $0 == fence && inside == 1 && ++n == wanted { inside = 2 }
    ' README.md
}

# display PAGE NUMBER [SECTION]: the text of a literal display in a page's
# EXAMPLES, or in another section.
display()
{
    sh "$top/tests/support/recipe.sh" "${3:-EXAMPLES}:$2" "$1"
}
