#!/bin/sh
# Floor command: its two back-ends for numbers give the same bytes and doubles.
. "$(dirname "$0")/../support/verdict.sh"
: "${CC:=cc}" "${CXX:=c++}"
rename='-Dcylint_read_number=plain_read_number
        -Dcylint_write_number=plain_write_number'
strict='-std=c99 -D_POSIX_C_SOURCE=200809L -O2 -Itools/cylint -Itests/support'

if ! $CXX -std=c++17 -O2 -c -o "$scratch/cxx.o" tools/cylint/numbers.cc; then
    skip_all 'no C++17 compiler to compare with (make deps)'
fi
# shellcheck disable=SC2086
$CC $strict $rename -c -o "$scratch/c.o" tools/cylint/numbers_c.c &&
$CC $strict -c -o "$scratch/agree.o" tests/command/numbers_agree.c &&
$CXX -o "$scratch/agree" "$scratch/agree.o" "$scratch/cxx.o" "$scratch/c.o" -lm &&
"$scratch/agree"
