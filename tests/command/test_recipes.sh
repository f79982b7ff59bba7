#!/bin/sh
# The displays of cylint(7) that are not transcripts work: shapes of other programs
# and lengths in solids.  test_cli.sh runs the transcripts, test_formats.py the
# displays about trees and molecules, `make check-cluster` those about many machines.
. "$(dirname "$0")/../support/verdict.sh"
PATH=$build:$PATH

# Each shape and solid of a display has the pieces of its definition in the manual
# of the other program: DISPLAY, their number, lines in two pieces.
test_foreign_solids()
{
    awk 'function pick(reach) { return (2 * rand() - 1) * reach }
         BEGIN { srand(11)
                 for (n = 0; n < 300; n++) {
                     reach = 2 ^ (n % 7)
                     ox = pick(60); oy = pick(60); oz = pick(60)
                     printf "line %.6f %.6f %.6f  %.6f %.6f %.6f\n", ox, oy, oz,
                            1 + pick(reach) - ox, 2 + pick(reach) - oy, 3 + pick(reach) - oz
                 } }' > "$scratch/lines"
    for display in mcnp,18,0 geant4,5,0 openmc,13,0 povray,5,0 solids,9,5; do
        counts=${display#*,} display=${display%%,*}
        sh tests/support/recipe.sh $display > "$scratch/solids"
        cylint -s "$scratch/solids" -q pieces --pieces chords -f record,shape,t0,t1 \
            "$scratch/lines" > "$scratch/pieces" &&
            awk -v least=${counts%,*} -v twice=${counts#*,} -f tests/command/solids.awk \
                "$scratch/solids" "$scratch/lines" "$scratch/pieces" > "$scratch/log"
        status=$?
        [ $status -eq 0 ] || tail -5 "$scratch/log"
        verdict "${display}_has_the_pieces_of_its_manual" $status
    done
}

# prints NAME RECIPE TEXT: the recipe prints TEXT in a folder with its files.
prints()
{
    sh tests/support/recipe.sh "$2" > "$scratch/recipe"
    (cd "$scratch" && sh recipe) > "$scratch/output" 2>&1
    [ "$(cat "$scratch/output")" = "$3" ] || { cat "$scratch/output"; false; }
    verdict "$1" $?
}

# Volumes by random lines, here of a union whose volume is known, and radiation
# lengths.
test_lengths()
{
    printf 'sphere 0 0 0  10  soma\ncapsule 0 0 0  30 0 0  1  branch\n' > "$scratch/cell"
    prints random_lines_measure_the_volume_in_cylint_7 volume \
        "$(sh tests/support/recipe.sh volume-said)"
    awk '{ off = $2 - 4253.8; exit !(off * off < 9 * $5 * $5) }' "$scratch/output"
    verdict the_volume_is_within_three_standard_errors $?
    prints the_detector_has_the_radiation_lengths_in_cylint_7 detector \
        "$(sh tests/support/recipe.sh detector-said)"
    # at eta = 0: the pipe and the tracker, and 10 cm of lead beside the hole
    awk '$1 == 0 { fine = $3 == 0.008 && $2 < 17.827 && $2 > 16
                   exit !fine }' "$scratch/output"
    verdict the_hole_for_cables_has_no_lead $?
}

# The function for McStas, beside the one that it replaces.
test_mcstas()
{
    sh tests/support/recipe.sh mcstas > "$scratch/mcstas.c"
    cat tests/command/mcstas_cases.c >> "$scratch/mcstas.c"
    quiet "${CC:-cc}" ${CFLAGS:-} -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Werror -Iinclude \
        -o "$scratch/mcstas" "$scratch/mcstas.c" "$build/libcylint.a" -lm
    verdict the_function_for_mcstas_compiles $? && {
        "$scratch/mcstas" > "$scratch/log"
        status=$?
        cat "$scratch/log"
        verdict far_parallel_and_hollow_samples_of_mcstas_are_right $status
    }
}

# Every display of the page has a name or is a transcript, and every name is run
# here, by tests/python/test_formats.py or tests/package/cluster/check.sh.
test_all_are_run()
{
    awk '/^\.\\" recipe/ { named = NR + 1 }
         /^\.Bd/ && NR != named { getline; if (!/^\$ /) print NR ": " $0 }
        ' man/cylint.7 > "$scratch/unnamed"
    for name in $(sh tests/support/recipe.sh); do
        grep -Eq "[ '\"]$name([ ',;)\"]|\$)" tests/command/test_recipes.sh \
            tests/python/test_formats.py tests/package/cluster/check.sh || echo "$name"
    done >> "$scratch/unnamed"
    [ ! -s "$scratch/unnamed" ] || { cat "$scratch/unnamed"; false; }
    verdict every_display_of_the_page_is_run $?
}

test_all_are_run
test_foreign_solids
test_lengths
test_mcstas
check_end
