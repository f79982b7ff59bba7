#!/bin/sh
# The transcripts of recipes.txt: displays of cylint(7) do what the page says.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
ln -s "$top/tests" "$top/man" "$top/include" "$scratch/work"
run_transcripts recipes.txt <tests/command/recipes.txt
check_end
