# Transcripts of commands; a test sources this file after verdict.sh.
#
# A transcript is `$ command`, `> more` lines of it, and the expected output.  `! text`
# is a line of standard error, `? N` the exit status (default 0), `!? text` the message
# and status of a wrong command line, `(empty)` an empty line.  A blank line ends the
# transcript; text between transcripts is comment.  All commands run in the folder
# $scratch/work.

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
        '> '*) command="$command
${line#??}" ;;
        '') finish ;;
        '!? '*)
            program=${command%% *}
            printf '%s: %s\n%s\n' "$program" "${line#???}" "Try '$program --help'." \
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

# has_the_options_of_help COMMAND: its manual describes them and no others; writes them
# to $scratch/options.
has_the_options_of_help() {
    "$1" --help | grep '^  -' | grep -Eo -e ' -(-[a-z-]+|[a-zA-Z])' | tr -d ' ' |
        sort -u >"$scratch/options"
    sed -n '/^\.Sh OPTIONS/,/^\.Sh [^O]/s/^\.It \(Fl .*\)/\1/p' "$top/man/$1.1" |
        grep -Eo 'Fl -?[a-zA-Z-]+' | sed 's/Fl /-/' | sort -u | diff "$scratch/options" -
    verdict "$1.1 has the options of --help" $?
}
