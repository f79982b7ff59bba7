#!/bin/sh
# Compares the command's answers from every compiler, optimisation and processor
# of this machine (make check-cross; takes some minutes).  Relation, n and all
# members of hits must be the same bytes everywhere, and so must the library's
# answers, which answers.c prints: hits, chords, distances, safeties.  Then the C
# tests about systems and compilers run: under Windows (wine), with subnormals
# flushed, and with the AVX-512 kernels in AVX2 (tests/package/avx512.h).
# The input is hard.txt and CYLINT_CASES (100000) records of all families with
# CYLINT_SEED (1).  Parts without their compiler or emulator are skipped; `make
# deps-cross` installs them.
. "$(dirname "$0")/../support/verdict.sh"
records=$build/tests/package/records
build=$build/cross
mkdir -p "$build" || exit 1

# The makes started here do not share the jobs of the make that runs this.
MAKEFLAGS=$(printf '%s' "$MAKEFLAGS" | sed 's/ *--jobserver-[a-z]*=[^ ]*//g')
export MAKEFLAGS
unset MFLAGS
unset DISPLAY
WINEPREFIX=$build/wine WINEDEBUG=-all
export WINEPREFIX WINEDEBUG

columns=relation,n,t0,t1,part0,part1,side0,side1,x0,y0,z0,nx0,ny0,nz0,h0,phi0
columns=$columns,x1,y1,z1,nx1,ny1,nz1,h1,phi1,chord

# gcc -m32 without gcc-multilib, which Debian cannot install beside cross
# compilers, does not find the kernel's headers.
kernel_headers="-idirafter /usr/include/$(gcc -print-multiarch 2>/dev/null)"

# name | compiler | its flags | flags to link | what runs the program | what is built:
# nothing: the command and answers.c; library: answers.c by the Makefile; bare: answers.c
# by the compiler alone
builds() {
    cat <<END
gcc -O2|gcc|-O2|||
gcc -O0|gcc|-O0|||
gcc -O3|gcc|-O3|||
gcc -O3 -march=native|gcc|-O3 -march=native|||
clang -O0|clang|-O0|||
clang -O3|clang|-O3|||
clang -O3 -mfma|clang|-O3 -mfma|||
clang 19 -O2|clang-19|-O2|||
clang 19 -O3 -mfma|clang-19|-O3 -mfma|||
musl|musl-gcc|-O2|-static||
gcc -m32 (SSE2)|gcc|-O2 -m32 -msse2 -mfpmath=sse $kernel_headers|-m32||
aarch64 (qemu)|aarch64-linux-gnu-gcc|-O2|-static|qemu-aarch64|
ARM, 32 bits (qemu)|arm-linux-gnueabihf-gcc|-O2 -mfpu=neon|-static|qemu-arm|
RISC-V (qemu)|riscv64-linux-gnu-gcc|-O2|-static|qemu-riscv64|
s390x, big-endian (qemu)|s390x-linux-gnu-gcc|-O2|-static|qemu-s390x|
tcc, without the Makefile|tcc|-O2|||bare
Windows (mingw-w64, wine)|x86_64-w64-mingw32-gcc|-O2|-static|/usr/lib/wine/wine64|library
END
}

# usable COMPILER FLAGS LINK RUNNER: whether programs can be built and run;
# says what is missing
usable() {
    for tool in "$1" $4; do
        command -v "$tool" >/dev/null || { echo "no $tool"; return 1; }
    done
    printf '#include <errno.h>\n#include <math.h>\nint main(int n, char **x)\n%s\n' \
        '{ return x[0] && sqrt((double)n) != 1; }' >"$build/probe.c"
    rm -f "$build/probe" "$build/probe.exe"
    $1 $2 $3 -o "$build/probe" "$build/probe.c" -lm 2>/dev/null ||
        { echo "$1 $2 does not link"; return 1; }
    [ -e "$build/probe" ] || mv "$build/probe.exe" "$build/probe"
    $4 "$build/probe" 2>/dev/null || { echo 'its programs do not run'; return 1; }
}

# folder_of NAME: the folder of its build
folder_of() {
    printf '%s/%s' "$build" "$(printf '%s' "$1" | tr -c 'a-zA-Z0-9\n' _)"
}

# built NAME TARGET...: by make in $folder with $compiler, $flags and $link;
# numbers by the C library, since few targets have a C++ one.  $avx512: other flags for
# the AVX-512 kernels.
avx512=
built() {
    what=$1
    shift
    targets=
    for target in "$@"; do
        targets="$targets $folder/$target"
    done
    ${MAKE:-make} -s -C "$top" CC="$compiler" CXX17= CFLAGS="$flags" \
        LDFLAGS="$link" ${avx512:+"avx512=$avx512"} BUILD="$folder" $targets \
        >"$build/messages" 2>&1 ||
        not_built "$what"
}

not_built() { # NAME
    verdict "$1: it cannot be built" 1 || tail -n 5 "$build/messages"
    return 1
}

result() { # NAME STATUS
    verdict "$1" "$2" && printf 'ok   %s\n' "$1"
}

# compare NAME KIND PROGRAM ARGUMENT...: the answers of this build's program are the
# bytes of the first build's, which are kept in $build/KIND.  $part, of sed, leaves the
# part of a line that is compared.
part=
compare() {
    what=$1 kind=$2
    shift 2
    trouble=
    $runner "$@" <"$build/input" >"$folder/printed" 2>"$build/messages" ||
        trouble=": exit status $?"
    tr -d '\r' <"$folder/printed" | sed "$part" >"$folder/answers"
    [ "$reference" != "$name" ] || cp "$folder/answers" "$build/$kind"
    sed "$part" "$build/$kind" >"$build/wanted"
    if [ -z "$trouble" ] && cmp -s "$build/wanted" "$folder/answers"; then
        result "$what" 0
        return
    fi
    result "$what$trouble" 1
    head -n 3 "$build/messages"
    printf '%d answers differ\n' "$(diff "$build/wanted" "$folder/answers" | grep -c '^>')"
    paste -d '\n' "$build/input" "$build/wanted" "$folder/answers" | awk '
        NR % 3 == 1 { record = $0 }
        NR % 3 == 2 { want = $0 }
        NR % 3 == 0 && $0 != want && n++ < 5 {
            printf "%s\n  got  %s\n  want %s\n", record, $0, want
        }'
}

if [ ! -x "$records" ]; then
    echo "$records has not been built"
    exit 77
fi
grep '=>' tests/library/hard.txt | grep -v '^#' | sed 's/ *=>.*//' >"$build/input"
"$records" "${CYLINT_SEED:-1}" "${CYLINT_CASES:-100000}" >>"$build/input" ||
    exit
printf '%d records\n' "$(wc -l <"$build/input")"
unset CYLINT_CASES # each C test has a number of cases of its own

# bare: $compiler on all files but those of scenes, and answers.c, in $folder
bare() {
    mkdir -p "$folder/tests/package"
    for file in $(find src -name '*.c' ! -path 'src/bvh/*' ! -path 'src/scene/*' \
        ! -path 'src/embree/*') tests/support/families.c tests/support/family_records.c \
        tests/package/answers.c; do
        object=$folder/$(printf '%s' "${file%.c}" | tr / -).o
        $compiler $flags -ffp-contract=off -Iinclude -Isrc -Itests/support \
            -c -o "$object" "$file" || return
    done >"$build/messages" 2>&1
    $compiler $link -o "$folder/tests/package/answers" "$folder"/*.o -lm
}

builds >"$build/table"
reference=
while IFS='|' read -r name compiler flags link runner parts; do
    missing=$(usable "$compiler" "$flags" "$link" "$runner") || {
        skip "$name" "$missing"
        continue
    }
    folder=$(folder_of "$name")
    part=
    case $parts in
    bare)
        part='s/ |.*//' # safeties need vectors of two lanes
        bare || not_built "$name" || continue ;;
    library) built "$name" tests/package/answers || continue ;;
    *)
        built "$name" cylint tests/package/answers || continue
        [ -n "$reference" ] || reference=$name
        compare "$name" command "$folder/cylint" -x -f "$columns" ;;
    esac
    program=$folder/tests/package/answers
    [ -e "$program" ] || program=$program.exe
    compare "$name, the library's answers" library "$program"
done <"$build/table"

printf 'answers of %s are the measure\n' "$reference"

# ----------------------------------------------------------- tests of systems --

# tests_pass NAME RUNNER TEST...: skipped tests print their reason
tests_pass() {
    name=$1 runner=$2
    shift 2
    for test in "$@"; do
        [ -e "$folder/$test.exe" ] && test=$test.exe
        $runner "$folder/$test" </dev/null >"$build/messages" 2>&1
        status=$?
        last=$(tr -d '\r' <"$build/messages" | tail -n 1)
        if [ $status -eq 77 ]; then
            skip "$name, $test" "$last"
        else
            result "$name, $test: $last" $status
            [ $status -eq 0 ] || head -n 5 "$build/messages"
        fi
    done
}

name=Windows compiler=x86_64-w64-mingw32-gcc flags=-O2 link=-static
runner=/usr/lib/wine/wine64
folder=$(folder_of 'Windows (mingw-w64, wine)')
if missing=$(usable $compiler "$flags" "$link" $runner); then
    # those that need no package and no memory that may not be touched
    tests=$(grep -L -e 'check_skip(' -e 'return 77' -e 'guarded\.h' \
        tests/*/test_*.c | sed -e 's|\.c$||' -e '/embree/d')
    built $name $tests && tests_pass $name $runner $tests
else
    skip "$name, C tests" "$missing"
fi

# FTZ and DAZ are set by these tests.  The last one draws cases and prints a digest
# of their answers.
link=
: >"$build/digests"
for compiler in gcc clang clang-19; do
    flags=-O2
    folder=$(folder_of "$compiler environment")
    missing=$(usable $compiler "$flags" '' '') || {
        skip "$compiler, subnormals flushed" "$missing"
        continue
    }
    tests='tests/library/test_environment tests/library/test_hits tests/scene/test_paths'
    built "$compiler" $tests && tests_pass "$compiler" '' $tests
    sed -n 's/.*digest //p' "$build/messages" >>"$build/digests"
done

# The AVX-512 kernels, on processors with AVX2, in functions of SIMDe.
name='AVX-512 (SIMDe)' compiler=gcc flags='-O2 -include tests/package/avx512.h'
avx512='-mavx2 -mfma -mpopcnt -Wno-psabi -DEMULATED'
folder=$(folder_of "$name")
missing=$(grep -qw avx2 /proc/cpuinfo || echo 'no AVX2'
    usable "$compiler" "$flags $avx512" '' '')
if [ -z "$missing" ]; then
    tests='tests/library/test_batch tests/distance/test_batch tests/scene/test_queries
        tests/scene/test_paths'
    built "$name" src/filter/many-avx512.o $tests && tests_pass "$name" '' $tests
    sed -n 's/.*digest //p' "$build/messages" >>"$build/digests"
else
    skip "$name" "$missing"
fi
avx512=

[ "$(sort -u "$build/digests" | wc -l)" -le 1 ]
result 'test_paths has one digest from all compilers' $?

check_end && [ $passed -gt 1 ]
