#!/bin/sh
# The transcripts of cli.txt and hostile.txt and the examples of
# the manuals give their output, and every option, word and column has a transcript.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
# A sanitizer reserves more address space than any limit allows.
limit='ulimit -v 20000'
! grep -Eq '__(asan|tsan)_init' "$build/cylint" || limit=:
export limit

covered() { # word: is it in cli.txt, not as a part of another?
    grep -Eq -e "(^|[^a-z0-9-])$1([^a-z0-9]|\$)" "$top/tests/command/cli.txt"
    verdict "no transcript for $1" $?
}

for file in cli.txt hostile.txt; do
    run_transcripts $file <"$top/tests/command/$file"
done

for page in cylint.1 cylint.7; do
    rm -rf "$scratch/work"
    mkdir "$scratch/work"
    ln -s "$top/tools" "$scratch/work"
    sh tests/support/recipe.sh all $page >"$scratch/examples"
    run_transcripts $page <"$scratch/examples"
    [ "$(grep -c '^\$ ' "$scratch/examples")" -ge 4 ]
    verdict "$page has examples" $?
done

has_the_options_of_help cylint
for word in $(cat "$scratch/options") \
        line ray segment span point capped open cap0 cap1 infinite nappe \
        $(cylint --list=shapes | cut -f1) $(cylint --list=methods | cut -f1) \
        $(cylint --list=columns | cut -f1); do
    covered "$word"
done
check_end
