#!/bin/sh
# Runs every test given as an argument, shows what fails, adds the counts up.
# A test is a program or a .sh file; its last line says `N passed, N failed`;
# exit status 77 means it was skipped, for the reason it printed.
passed=0 failed=0 skipped=0
for t in "$@"; do
    case $t in *.sh) run="sh $t" ;; *) run=$t ;; esac
    out=$($run 2>&1)
    status=$?
    counts=$(printf '%s\n' "$out" | sed -n 's/^\([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p' | tail -n 1)
    if [ "$status" -eq 77 ]; then
        skipped=$((skipped + 1))
        printf 'skip %s: %s\n' "$t" "$(printf '%s\n' "$out" | tail -n 1)"
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
        printf '%s\n' "$out" | sed -n 's/^note: /     /p'
    else
        printf 'FAIL %s\n%s\n' "$t" "$out"
    fi
done
[ "$skipped" -eq 0 ] && printf '%d passed, %d failed\n' $passed $failed ||
    printf '%d passed, %d failed, %d skipped\n' $passed $failed $skipped
[ "$failed" -eq 0 ]
