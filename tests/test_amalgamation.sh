#!/bin/sh
# Floor tools: `make amalgamation` writes the library as one C file, which every
# compiler at hand compiles without a flag or a warning, and tests of the library
# that are linked to it pass.
. "$(dirname "$0")/verdict.sh"
cc=${CC:-cc}
make=${MAKE:-make}

command -v python3 > /dev/null || skip_all 'no python3 (make deps)'

# compiles COMPILER OBJECT FLAG...
compiles()
{
    compiler=$1 object=$2
    shift 2
    $compiler "$@" -c "$folder/cylint.c" -o "$scratch/$object.o" \
        > "$scratch/log" 2>&1 && [ ! -s "$scratch/log" ] ||
        { head -n 20 "$scratch/log"; false; }
}

$make --no-print-directory BUILD="${BUILD:-build}" CC="$cc" amalgamation \
    > "$scratch/log" 2>&1 || cat "$scratch/log"
folder=$build/amalgamation
[ -s "$folder/cylint.c" ] && cmp "$folder/cylint.h" include/cylint.h
verdict make_amalgamation_writes_a_file_and_its_headers $?

compiles "$cc" plain
verdict it_compiles_without_a_flag $? || { check_end; exit; }
strict='-Wall -Wextra -Wpedantic -Wconversion'
case ${CFLAGS:-} in # beside the sanitizers' code gcc warns of values that are initialized
*-fsanitize*) strict="$strict -Wno-maybe-uninitialized" ;;
esac
compiles "$cc" library -O2 -std=c99 $strict ${CFLAGS:-}
verdict it_compiles_optimized_without_a_warning $? || { check_end; exit; }
for other in clang tcc aarch64-linux-gnu-gcc s390x-linux-gnu-gcc; do
    command -v $other > /dev/null || continue
    compiles $other "$other" -Wall
    verdict "${other}_compiles_it" $?
done

# The example of README.md, compiled with it as a user does.
awk '/^```c$/ { inside = 1; next } /^```/ { inside = 0 } inside' README.md > "$scratch/example.c"
$cc -I "$folder" -o "$scratch/example" "$scratch/example.c" "$folder/cylint.c" -lm &&
    [ "$("$scratch/example")" = "t = 5
t = 6" ]
verdict the_example_runs_with_it $?

# Tests that `make check` has built, with this object for libcylint.a.
libraries=
for library in mpfr gmp gsl gslcblas; do
    echo 'int main(void) { return 0; }' > "$scratch/empty.c"
    $cc -o "$scratch/empty" "$scratch/empty.c" -l$library 2> /dev/null &&
        libraries="$libraries -l$library"
done
common=
for part in families family_records constructed oracle; do
    [ -f "$build/tests/$part.o" ] && common="$common $build/tests/$part.o"
done
for t in batch environment exact intersect interface methods \
    methods_contract methods_misprints outside properties round shape \
    special_cases ties; do
    [ -f "$build/tests/test_$t.o" ] || continue
    $cc ${CFLAGS:-} -o "$scratch/$t" "$build/tests/test_$t.o" $common \
        "$scratch/library.o" $libraries -pthread -lm && "$scratch/$t" > "$scratch/log" 2>&1
    status=$?
    sum=$(sed -n 's/^\([0-9]*\) passed, 0 failed$/\1/p' "$scratch/log")
    [ $status -eq 0 ] && [ "${sum:-0}" -gt 0 ] || tail -n 20 "$scratch/log"
    verdict "test_${t}_passes_with_it" $status
    passed=$((passed + ${sum:-0}))
done
check_end
