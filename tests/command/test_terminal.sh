#!/bin/sh
# The transcripts of terminal.txt: on a terminal a message says that the command waits,
# and the progress is shown where it disturbs nothing.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
script -qec true /dev/null >/dev/null 2>&1 </dev/null || skip_all 'no terminal can be made here'
run_transcripts terminal.txt <tests/command/terminal.txt
check_end
