#!/bin/sh
# usage: run.sh run TEST, or run.sh report TEST...     (run.mk does both)
#
# `run` runs a test, a program or a .sh file.  What it prints goes to a file below
# $BUILD/tests/results, its exit status and its seconds to FILE.status.  A test's last
# line is `N passed, N failed`, not both 0; exit status 77 means skipped, for the
# reason that it printed.
#
# `report` prints failures and adds up the counts.  `make deps` installs what a
# reason or a note that ends with `(make deps)` names, and the packages in $MISSING.
# These are listed before the last line.  With CI=true each of them is a failure.

result_of() { # TEST
    case $1 in
    "$BUILD"/tests/*) echo "$BUILD/tests/results/${1#"$BUILD/tests/"}" ;;
    *) echo "$BUILD/tests/results/${1#tests/}" ;;
    esac
}

run() { # TEST
    # A make that a test starts does not share the jobs of the make that runs this.
    MAKEFLAGS=$(printf '%s' "$MAKEFLAGS" | sed 's/ *--jobserver-[a-z]*=[^ ]*//g')
    export MAKEFLAGS
    unset MFLAGS TESTS
    result=$(result_of "$1")
    mkdir -p "$(dirname "$result")"
    rm -f "$result.status"
    began=$(date +%s.%N)
    case $1 in
    *.sh) sh "$1" ;;
    *) "$1" ;;
    esac </dev/null >"$result" 2>&1
    echo $? $(printf '%s %s\n' "$began" "$(date +%s.%N)" |
        awk '{ printf "%.1f", $2 - $1 }') >"$result.status"
}

passed=0 failed=0 skipped=0 untested=
untested() { # TEXT: not tested, because a package of `make deps` is missing
    untested="$untested
not tested: $1"
    [ "$CI" = true ] && failed=$((failed + 1))
}

report_one() { # TEST
    result=$(result_of "$1")
    out=$(cat "$result")
    read -r status seconds <"$result.status"
    counts=$(printf '%s\n' "$out" | sed -n 's/^\([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p' | tail -n 1)
    if [ "$status" = 77 ]; then
        reason=$(printf '%s\n' "$out" | tail -n 1)
        skipped=$((skipped + 1))
        printf 'skip %s: %s\n' "$1" "$reason"
        case $reason in *'(make deps)') untested "$1: ${reason% (*}" ;; esac
        return
    fi
    if [ -z "$counts" ] || [ "$counts" = '0 0' ]; then
        counts="0 1"
        out="$out
(no counts; exit status $status)"
    elif [ "$status" != 0 ] && [ "${counts#* }" -eq 0 ]; then
        counts="${counts% *} 1"
    fi
    passed=$((passed + ${counts% *}))
    failed=$((failed + ${counts#* }))
    if [ "${counts#* }" -eq 0 ]; then
        printf 'ok   %s: %s passed (%s s)\n' "$1" "${counts% *}" "$seconds"
        notes=$(printf '%s\n' "$out" | sed -n 's/^note: //p')
        [ -z "$notes" ] || printf '%s\n' "$notes" | sed 's/^/     /'
        case $notes in *'(make deps)'*)
            untested "a part of $1: $(printf '%s\n' "$notes" |
                sed -n 's/ (make deps)$//p' | tail -n 1)" ;;
        esac
    else
        printf 'FAIL %s (%s s)\n%s\n' "$1" "$seconds" "$out"
    fi
}

report() { # TEST...
    for word in $MISSING; do
        untested "what needs $word"
    done
    for t in "$@"; do
        report_one "$t"
    done
    if [ -n "$untested" ]; then
        printf '%s\n' "${untested#?}"
        echo "'make deps check' installs what was missing and tests everything."
    fi
    [ "$skipped" -eq 0 ] && printf '%d passed, %d failed\n' $passed $failed ||
        printf '%d passed, %d failed, %d skipped\n' $passed $failed $skipped
    [ "$failed" -eq 0 ]
}

"$@"
