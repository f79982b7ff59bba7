#!/bin/sh
# The transcripts of swc.txt: `cylint -s neuron.swc` makes the shapes of the definition,
# whatever the form of the file.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
data=$(cd .. && pwd)/shared/data
export data
[ -d "$data" ] || echo "note: no $data, so no real neurons are read"
run_transcripts swc.txt <tests/command/swc.txt
check_end
