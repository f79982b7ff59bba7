#!/bin/sh
# Floor command: the transcripts of cli.txt and hostile.txt and the examples of the
# manuals give their output, and every option, word and column has a transcript.
#
# A transcript is `$ command` and the expected output.  `! text` is a line of
# standard error, `? N` the exit status (default 0), `!? text` the message and
# status of a wrong command line, `(empty)` an empty line.  A blank line ends the
# transcript; text between transcripts is comment.  All commands run in one
# scratch folder.
. "$(dirname "$0")/../support/verdict.sh"
mkdir "$scratch/work"
PATH=$build:$PATH

# Runs $command and compares its output with expected.out and expected.err.
finish() {
    [ -n "$command" ] || return
    (cd "$scratch/work" && sh -c "$command") </dev/null >"$scratch/out" 2>"$scratch/err"
    echo "? $?" >>"$scratch/err"
    echo "? $status" >>"$scratch/expected.err"
    diff "$scratch/expected.out" "$scratch/out"
    wrong=$?
    diff "$scratch/expected.err" "$scratch/err" || wrong=1
    verdict "$source: $command" $wrong
    command=
}

begin() {
    command=$1 status=0
    : >"$scratch/expected.out"
    : >"$scratch/expected.err"
}

run_transcripts() { # name; transcripts on standard input
    source=$1 command=
    while IFS= read -r line; do
        case $line in
        '$ '*) finish; begin "${line#??}" ;;
        '') finish ;;
        '!? '*)
            printf 'cylint: %s\n%s\n' "${line#???}" "Try 'cylint --help'." \
                >>"$scratch/expected.err"
            status=2 ;;
        '! '*) printf '%s\n' "${line#??}" >>"$scratch/expected.err" ;;
        '? '*) status=${line#??} ;;
        '(empty)') echo >>"$scratch/expected.out" ;;
        *) [ -z "$command" ] ||
            printf '%s\n' "$line" >>"$scratch/expected.out" ;;
        esac
    done
    finish
}

# Prints, unescaped, the literal displays of a manual that have a command.
examples() {
    awk '/^\.Bd -literal/ { show = 1; next }
         /^\.Ed/ { show = 0; print "" }
         show { gsub(/\\e/, "\\"); gsub(/\\&/, ""); gsub(/\\-/, "-"); print }
    ' "$1"
}

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
    examples "$top/man/$page" >"$scratch/examples"
    run_transcripts $page <"$scratch/examples"
    [ "$(grep -c '^\$ ' "$scratch/examples")" -ge 4 ]
    verdict "$page has examples" $?
done

# The options are those of the manual.
cylint --help | grep -Eo -e ' -(-[a-z-]+|[a-zA-Z])' | tr -d ' ' | sort -u >"$scratch/options"
sed -n '/^\.Sh OPTIONS/,/^\.Sh SOLIDS/s/^\.It \(Fl .*\)/\1/p' "$top/man/cylint.1" |
    grep -Eo 'Fl -?[a-zA-Z-]+' | sed 's/Fl /-/' | sort -u | diff "$scratch/options" -
verdict 'cylint.1 has the options of --help' $?

for word in $(cat "$scratch/options") \
        line ray segment span point capped open cap0 cap1 infinite nappe \
        $(cylint --list=shapes | cut -f1) $(cylint --list=methods | cut -f1) \
        $(cylint --list=columns | cut -f1); do
    covered "$word"
done
check_end
