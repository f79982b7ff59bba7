#!/bin/sh
# The transcripts of workers.txt: any number of workers gives the same answers, messages
# and exit status as one, and no worker waits for input after the work has ended.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
run_transcripts workers.txt <tests/command/workers.txt
check_end
