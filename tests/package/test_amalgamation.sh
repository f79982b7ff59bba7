#!/bin/sh
# The transcripts of amalgamation.txt: `make amalgamation` writes the libraries, scenes
# too, as one C file, which every compiler at hand compiles without a flag or a warning,
# and tests of the libraries that are linked to it pass.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
. "$(dirname "$0")/../support/installs.sh"
command -v python3 > /dev/null || skip_all 'no python3 (make deps)'
export make cc cxx
run_transcripts amalgamation.txt < tests/package/amalgamation.txt
check_end
