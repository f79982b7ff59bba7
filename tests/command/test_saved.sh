#!/bin/sh
# The transcripts of saved.txt: a saved scene gives the bytes that its text gives, for
# every query and any number of workers.  Processes that open it share its memory.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
run_transcripts saved.txt <tests/command/saved.txt
check_end
