#!/bin/sh
# The transcripts of demo.txt: the demo prints the same bytes each time and with each
# awk, its summary agrees with the answers, and it fails if one of its steps fails.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
mkdir "$scratch/work"
ln -s "$top/tools" "$scratch/work"
export build
run_transcripts demo.txt <tests/command/demo.txt
check_end
