# What shell tests begin with: `. "$(dirname "$0")/verdict.sh"`.
#
# $top is the folder they were started in, $build, absolute, has what is
# tested, $scratch is theirs and goes when they do.  Their last line is
# check_end, which prints what tests/run.sh adds up.
LC_ALL=C
export LC_ALL
top=$(pwd)
build=${BUILD:-build}
case $build in /*) ;; *) build=$top/$build ;; esac
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0

# verdict NAME STATUS: counts a test that ended with STATUS 0 as passed, names
# one that did not, and ends with STATUS.
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

check_end()
{
    printf '%d passed, %d failed\n' $passed $failed
    [ $failed -eq 0 ]
}
