#!/bin/sh
# cylint-render draws the pictures of render.txt, among them those of its manual and
# those of the README.  The program pixels prints the pixels of a file.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
[ -x "$build/cylint-render" ] ||
    skip_all 'no libpng, so no cylint-render (make deps)'
PATH=$build/tests/command:$PATH
ln -s "$top/tools" "$scratch/work"
run_transcripts render.txt < tests/command/render.txt
has_the_options_of_help cylint-render
check_end
