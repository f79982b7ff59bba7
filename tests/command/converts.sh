# What the tests of cylint-convert share; `verdict.sh` comes first.

# gives NAME COMMAND...: $scratch/in through the command must give exactly
# $scratch/expected and exit status 0.
gives()
{
    name=$1
    shift
    "$@" < "$scratch/in" > "$scratch/out" 2> "$scratch/messages"
    status=$?
    diff "$scratch/expected" "$scratch/out" && [ $status -eq 0 ]
    verdict "$AWK: $name" $?
}

# refuses NAME MESSAGE COMMAND...: exit status 1 and that message alone.
refuses() { refuses_with 1 "$@"; }

# refuses_with STATUS NAME MESSAGE COMMAND...
refuses_with()
{
    expected=$1 name=$2 message=$3
    shift 3
    "$@" < "$scratch/in" > "$scratch/out" 2> "$scratch/messages"
    status=$?
    [ "$(cat "$scratch/messages")" = "$message" ] && [ $status -eq $expected ] || {
        echo "exit status $status, message: $(cat "$scratch/messages")"
        false
    }
    verdict "$AWK: $name" $?
}

# says NAME MESSAGE: what the last command wrote to standard error.
says()
{
    [ "$(cat "$scratch/messages")" = "$2" ] || {
        echo "message: $(cat "$scratch/messages")"
        false
    }
    verdict "$AWK: $1" $?
}

input() { printf "$1" > "$scratch/in"; }
expect() { printf "$1" > "$scratch/expected"; }

# accepted NAME COUNT FILE COMMAND...: the file gives COUNT shapes, all of
# which `cylint -s` takes: one ray is answered without a message.
accepted()
{
    name=$1 count=$2 file=$3
    shift 3
    "$@" "$file" > "$scratch/scene" 2> "$scratch/messages" &&
        [ "$(wc -l < "$scratch/scene")" -eq "$count" ] &&
        echo 'ray 1 2 3  1 1 1' |
        "$build/cylint" -s "$scratch/scene" > "$scratch/out" 2>&1 &&
        [ "$(wc -l < "$scratch/out")" -eq 1 ]
    verdict "$AWK: $name" $?
}

# with_each_awk TEST...: runs each TEST with each awk found.
with_each_awk()
{
    tried=
    for AWK in mawk gawk awk; do
        command -v $AWK > /dev/null || continue
        [ $AWK = awk ] && [ -n "$tried" ] && continue
        tried=yes
        export AWK
        for test in "$@"; do
            $test
        done
    done
}
