#!/bin/sh
# `make amalgamation` writes the libraries, scenes too, as one C file, which every
# compiler at hand compiles without a flag or a warning, and tests of the libraries
# that are linked to it pass.
. "$(dirname "$0")/../support/verdict.sh"
. "$(dirname "$0")/../support/installs.sh"

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

make_here amalgamation
folder=$build/amalgamation
[ -s "$folder/cylint.c" ] && cmp "$folder/cylint.h" include/cylint.h &&
    cmp "$folder/cylint_scene.h" include/cylint_scene.h
verdict make_amalgamation_writes_a_file_and_its_headers $?

# within a tenth
cat "$folder/cylint.c" "$folder/cylint_builds.h" "$folder/cylint_templates.h" > "$scratch/all"
sed -n 's/^have \([0-9.]*\) MB and \([0-9,]*\) lines: each .*/\1 \2/p' man/cylint.3 | tr -d , |
    awk -v bytes="$(wc -c < "$scratch/all")" -v lines="$(wc -l < "$scratch/all")" '
        function near(a, b) { return a > 0.9 * b && a < 1.1 * b }
        { found = near($1 * 1e6, bytes) && near($2, lines) }
        END { exit !found }'
verdict cylint_3_states_its_size $?
compiles "$cc" plain
verdict it_compiles_without_a_flag $? || { check_end; exit; }
compiles "$cc" small -DCYLINT_PLAIN -fsyntax-only # no code for an instruction set of its own
verdict it_compiles_without_kernels_for_avx $?
strict='-Wall -Wextra -Wpedantic -Wconversion -Wshadow'
compiles "$cc" library -O2 -std=c99 $strict -DCYLINT_THREADS -pthread ${CFLAGS:-}
verdict it_compiles_optimized_without_a_warning $? || { check_end; exit; }
for other in clang tcc aarch64-linux-gnu-gcc s390x-linux-gnu-gcc \
    'musl-gcc -fsyntax-only' 'x86_64-w64-mingw32-gcc -fsyntax-only'; do
    command -v ${other%% *} > /dev/null || continue
    compiles "$other" other -Wall -DCYLINT_THREADS -DCYLINT_STATIC
    verdict "${other%% *}_compiles_it" $?
done

$cxx -c "$folder/cylint.c" -o "$scratch/cxx.o" > "$scratch/log" 2>&1
[ $? -ne 0 ] && grep -q 'error.*cylint.c is C: compile it with a C compiler' "$scratch/log" &&
    [ "$(grep -c 'error:' "$scratch/log")" -eq 1 ] || { head "$scratch/log"; false; }
verdict a_compiler_of_cxx_gives_one_error $?

# The examples of README.md and cylint_scene(3), linked with it as a user does.
block c 1 > "$scratch/example.c"
$cc -I "$folder" -o "$scratch/example" "$scratch/example.c" "$scratch/plain.o" -lm &&
    [ "$("$scratch/example")" = "$(block '' 1)" ]
verdict the_example_runs_with_it $?
for object in plain library; do
    display cylint_scene.3 1 > "$scratch/scene.c"
    $cc ${CFLAGS:-} -I "$folder" -o "$scratch/scene" "$scratch/scene.c" \
        "$scratch/$object.o" -pthread -lm &&
        display cylint_scene.3 2 > "$scratch/said" && "$scratch/scene" | diff "$scratch/said" -
    verdict "the_example_of_scenes_runs_with_it_$object" $?
done

# Tests that `make check` has built, with this object for libcylint.a.  The number of
# cases follows the name: `make check` runs each with all its cases on the same text,
# and what is new here, one unit and other flags, is in every build of the kernels and
# every call from the first case of each family on.
libraries=
for library in mpfr gmp; do
    echo 'int main(void) { return 0; }' > "$scratch/empty.c"
    $cc -o "$scratch/empty" "$scratch/empty.c" -l$library 2> /dev/null &&
        libraries="$libraries -l$library"
done
common=
for part in support/families support/family_records support/oracle support/scenes; do
    [ -f "$build/tests/$part.o" ] && common="$common $build/tests/$part.o"
done
for t in library/test_batch:1 library/test_environment:5 numbers/test_exact:2000 \
    library/test_intersect:200 methods/test_methods: \
    library/test_outside:50 \
    shapes/test_constructors: library/test_hits: \
    roots/test_midpoints: bvh/test_nodes: scene/test_paths:2 scene/test_many: \
    bounds/test_scene_point_bounds:; do
    cases=${t#*:} t=${t%:*}
    [ -f "$build/tests/$t.o" ] || continue
    $cc ${CFLAGS:-} -o "$scratch/test" "$build/tests/$t.o" $common \
        "$scratch/library.o" $libraries -pthread -lm &&
        env ${cases:+CYLINT_CASES="$cases"} "$scratch/test" > "$scratch/log" 2>&1
    status=$?
    sum=$(sed -n 's/^\([0-9]*\) passed, 0 failed$/\1/p' "$scratch/log")
    [ $status -eq 0 ] && [ "${sum:-0}" -gt 0 ] || tail -n 20 "$scratch/log"
    verdict "${t}_passes_with_it" $status
    passed=$((passed + ${sum:-0}))
done
check_end
