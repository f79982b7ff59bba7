#!/bin/sh
# What fuzzing has found worth keeping, run again: tests/fuzz says what each
# target sees to.  `make fuzz` looks for more.
: "${BUILD:=build}"
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0
for target in record command shapes; do
    program=$BUILD/tests/fuzz/$target
    [ -x "$program" ] || {
        echo "no linker that wraps calls"
        exit 77
    }
    # All in one process; where that fails, one by one, to tell which.
    count=$(ls tests/fuzz/corpus/$target | wc -l)
    if "$program" tests/fuzz/corpus/$target/* 2>/dev/null; then
        passed=$((passed + count))
        continue
    fi
    for input in tests/fuzz/corpus/$target/*; do
        if "$program" "$input" 2>"$scratch/messages"; then
            passed=$((passed + 1))
        else
            failed=$((failed + 1))
            echo "FAILED $program $input"
            tail -n 5 "$scratch/messages"
        fi
    done
done
printf '%d passed, %d failed\n' $passed $failed
[ $failed -eq 0 ] && [ $passed -gt 30 ]
