#!/bin/sh
# The transcripts of build.txt: the Makefile runs its probes after `deps`, objects depend
# on what the probes find, nothing is compiled twice, and tests that could not run are
# named.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
make=${MAKE:-make} cc=${CC:-cc}
export make cc
unset MPFR MAKEFLAGS # -s and the like hide what is done
run_transcripts build.txt < tests/package/build.txt

# Code without wide vectors is slow after a function that leaves the upper halves
# of registers in use.  gcc does not clear them (vzeroupper) in a function with a
# vector among its arguments.
if command -v objdump > /dev/null && [ -n "$(ls "$build"/src/*/*-avx2.o 2> /dev/null)" ] &&
    grep -q -e ' -O[23] ' "$build/src/filter/flags"; then
    for object in "$build"/src/*/*-avx*.o "$build"/src/*/*-fma.o; do
        objdump -d --no-show-raw-insn "$object" | awk -v object="${object##*/}" '
            /^[0-9a-f]+ <.*>:$/ { f = $2; order[++n] = f }
            /%[yz]mm/ { wide[f]++ }
            /vzeroupper/ { clears[f]++ }
            END { for (i = 1; i <= n; i++) if (wide[order[i]] && !clears[order[i]]) print object, order[i] }'
    done > "$scratch/output"
    [ ! -s "$scratch/output" ] || { cat "$scratch/output"; false; }
    verdict functions_with_wide_vectors_clear_the_upper_halves $?
fi

check_end
