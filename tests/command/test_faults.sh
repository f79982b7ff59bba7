#!/bin/sh
# The transcripts of faults.txt: when system calls are short, interrupted or late, no
# answer is lost, reordered or changed; when they fail, the command prints a message and
# stops at the end of a line.  hostile.txt has hostile input and the failures that a shell
# can make.
. "$(dirname "$0")/../support/verdict.sh"
[ -x "$build/tests/command/faulty" ] || skip_all 'no linker that wraps calls'
. tests/support/transcripts.sh
PATH=$build/tests/command:$PATH
: "${WORKERS:=1 2}"
export WORKERS
run_transcripts faults.txt <tests/command/faults.txt
check_end
