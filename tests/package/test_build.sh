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
check_end
