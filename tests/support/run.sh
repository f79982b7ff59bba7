#!/bin/sh
# Runs every test given as an argument, prints failures and adds up the counts.
# A test is a program or a .sh file.  Its last line is `N passed, N failed`; exit
# status 77 means skipped, for the reason that it printed.
#
# `make deps` installs what a reason or a note that ends with `(make deps)` names,
# and the packages in $MISSING.  These are listed before the last line.  With
# CI=true each of them is a failure.

# A make that a test starts does not share the jobs of the make that runs this.
MAKEFLAGS=$(printf '%s' "$MAKEFLAGS" | sed 's/ *--jobserver-[a-z]*=[^ ]*//g')
export MAKEFLAGS
unset MFLAGS

passed=0 failed=0 skipped=0 untested=
untested() { # TEXT: not tested, because a package of `make deps` is missing
    untested="$untested
not tested: $1"
    [ "$CI" = true ] && failed=$((failed + 1))
}

for word in $MISSING; do
    untested "what needs $word"
done
for t in "$@"; do
    case $t in *.sh) run="sh $t" ;; *) run=$t ;; esac
    out=$($run 2>&1)
    status=$?
    counts=$(printf '%s\n' "$out" | sed -n 's/^\([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p' | tail -n 1)
    if [ "$status" -eq 77 ]; then
        reason=$(printf '%s\n' "$out" | tail -n 1)
        skipped=$((skipped + 1))
        printf 'skip %s: %s\n' "$t" "$reason"
        case $reason in *'(make deps)') untested "$t: ${reason% (*}" ;; esac
        continue
    fi
    if [ -z "$counts" ]; then
        counts="0 1"
        out="$out
(no counts; exit status $status)"
    elif [ "$status" -ne 0 ] && [ "${counts#* }" -eq 0 ]; then
        counts="${counts% *} 1"
    fi
    passed=$((passed + ${counts% *}))
    failed=$((failed + ${counts#* }))
    if [ "${counts#* }" -eq 0 ]; then
        printf 'ok   %s: %s passed\n' "$t" "${counts% *}"
        notes=$(printf '%s\n' "$out" | sed -n 's/^note: //p')
        [ -z "$notes" ] || printf '%s\n' "$notes" | sed 's/^/     /'
        case $notes in *'(make deps)'*)
            untested "a part of $t: $(printf '%s\n' "$notes" |
                sed -n 's/ (make deps)$//p' | tail -n 1)" ;;
        esac
    else
        printf 'FAIL %s\n%s\n' "$t" "$out"
    fi
done
if [ -n "$untested" ]; then
    printf '%s\n' "${untested#?}"
    echo "'make deps check' installs what was missing and tests everything."
fi
[ "$skipped" -eq 0 ] && printf '%d passed, %d failed\n' $passed $failed ||
    printf '%d passed, %d failed, %d skipped\n' $passed $failed $skipped
[ "$failed" -eq 0 ]
