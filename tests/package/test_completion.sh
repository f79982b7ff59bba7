#!/bin/sh
# The transcripts of completion.txt: completion in bash and zsh offers the options of
# --help, the names of --list and the words that the commands accept, and otherwise file
# names.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
mkdir "$scratch/functions"
cp tools/cylint/completion "$scratch/functions/_cylint"
shells=
for shell in bash zsh; do
    command -v $shell > /dev/null && shells="$shells $shell" || echo "note: no $shell (make deps)"
done
export shells
run_transcripts completion.txt < tests/package/completion.txt
check_end
