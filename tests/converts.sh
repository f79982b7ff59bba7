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
