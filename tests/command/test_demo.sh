#!/bin/sh
# The transcripts of demo.txt: the demo prints the same bytes each time and with each
# awk, its summary agrees with the answers, and it fails if one of its steps fails.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
ln -s "$top/tools" "$scratch/work"
run_transcripts demo.txt <tests/command/demo.txt
check_end
