#!/bin/sh
# What fuzzing has found worth keeping, run again: tests/fuzz says what each
# target sees to.  `make fuzz` looks for more.
. "$(dirname "$0")/verdict.sh"
for target in record command shapes; do
    program=$build/tests/fuzz/$target
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
        "$program" "$input" 2>"$scratch/messages"
        verdict "$program $input" $? || tail -n 5 "$scratch/messages"
    done
done
[ $passed -gt 30 ]
verdict "there is a corpus" $?
check_end
