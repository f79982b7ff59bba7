# The first lines of every shell test: . "$(dirname "$0")/../support/verdict.sh"
#
# It sets $top, the folder in which the test was started (the repository's),
# $build, the absolute path of the build, and $scratch, a folder of the test's
# own that is removed at its end.  A test's last line is check_end, which
# prints the counts that tests/support/run.sh adds up.
LC_ALL=C
export LC_ALL
top=$(pwd)
build=${BUILD:-build}
case $build in /*) ;; *) build=$top/$build ;; esac
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0 skipped=0

# verdict NAME STATUS: counts a test.  STATUS 0 means passed; a failed test is
# named.  Returns STATUS.
verdict()
{
    if [ "$2" -eq 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED %s\n' "$1"
    fi
    return "$2"
}

# skip_all REASON: ends a test that cannot run here.  tests/support/run.sh counts exit
# status 77 as skipped.
skip_all()
{
    echo "$1"
    exit 77
}

# skip NAME REASON: counts one part as skipped, in a script that `make check` does not
# run; a test that it runs prints a line `note: REASON`.
skip()
{
    skipped=$((skipped + 1))
    echo "skip $1: $2"
}

# quiet COMMAND...: the end of its output is shown if it fails.
quiet()
{
    "$@" > "$scratch/log" 2>&1 || {
        echo "failed: $*"
        tail -n 40 "$scratch/log"
        return 1
    }
}

check_end()
{
    if [ $skipped -eq 0 ]; then
        printf '%d passed, %d failed\n' $passed $failed
    else
        printf '%d passed, %d failed, %d skipped\n' $passed $failed $skipped
    fi
    [ $failed -eq 0 ]
}
