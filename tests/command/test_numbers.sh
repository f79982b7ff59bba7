#!/bin/sh
# Floor command: numbers are read and written alike by the C++17 library and by
# the C library.
. "$(dirname "$0")/../support/verdict.sh"
: "${CC:=cc}" "${CXX:=c++}"
strict='-std=c99 -D_POSIX_C_SOURCE=200809L -O2 -Itools/cylint -Itests/support'
rename=
for name in read_number write_number read_decimal write_digits; do
    rename="$rename -Dcylint_$name=plain_$name"
done

if ! $CXX -std=c++17 -O2 -c -o "$scratch/cxx.o" tools/cylint/numbers.cc; then
    skip_all 'no C++17 compiler to compare with (make deps)'
fi
# shellcheck disable=SC2086
for file in tools/cylint/numbers tools/cylint/numbers_c; do
    $CC $strict $rename -c -o "$scratch/plain_${file##*/}.o" $file.c || exit 1
done
for file in tools/cylint/numbers tools/cylint/text tests/command/numbers_agree; do
    $CC $strict -c -o "$scratch/${file##*/}.o" $file.c || exit 1
done
$CXX -o "$scratch/agree" "$scratch"/*.o -lm && "$scratch/agree"
