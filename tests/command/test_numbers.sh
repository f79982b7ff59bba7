#!/bin/sh
# Numbers are read and written alike by the C++17 library and by the C library.
. "$(dirname "$0")/../support/verdict.sh"
: "${CC:=cc}" "${CXX:=c++}"
strict='-std=c99 -D_POSIX_C_SOURCE=200809L -O2 -Itools/cylint -Itests/support'
rename=
for name in read_number write_number read_decimal write_digits; do
    rename="$rename -Dcylint_$name=plain_$name"
done

made=$build/tools/cylint
[ -e "$made/numbers_cxx.o" ] || skip_all 'no C++17 compiler to compare with (make deps)'
for file in tools/cylint/numbers tools/cylint/numbers_c; do
    $CC $strict $rename -c -o "$scratch/plain_${file##*/}.o" $file.c || exit 1
done
$CC $strict ${CFLAGS:-} -c -o "$scratch/agree.o" tests/command/numbers_agree.c || exit 1
$CXX ${CXXFLAGS:-} -o "$scratch/agree" "$scratch"/*.o \
    "$made/numbers_cxx.o" "$made/numbers.o" "$made/text.o" -lm && "$scratch/agree"
