#!/bin/sh
# The fuzz targets of tests/fuzz hold on the kept inputs.  `make fuzz` searches for
# more inputs.  scene/test_file.c runs the target scene_file, which has none.
. "$(dirname "$0")/../support/verdict.sh"
for target in record command shapes; do
    program=$build/tests/fuzz/$target
    [ -x "$program" ] || skip_all 'no linker that wraps calls'
    # All in one process; if that fails, one by one, to name the input.
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
verdict "the corpus has more than 30 inputs" $?
check_end
