# Transcripts of commands; a test sources this file after verdict.sh.
#
# A transcript is `$ command`, `> more` lines of it, and the expected output.  `! text`
# is a line of standard error, `? N` the exit status (default 0), `(empty)` an empty line.
# `$ command  !? text` is a wrong command line and its message.
#
# `% command` begins a table of runs.  Each line has `[options < ]input => answer`: the
# input, a text of printf, goes to standard input, and the answer is its lines of
# standard output and error, with ` | ` between them; of a message `! ` replaces
# `cylint: ` or `cylint: stdin:`.  The status is 1 if there is a message alone.
#
# A blank line, or another command, ends a transcript or table; text between them, and
# `# text` within a table, is comment.  All commands run in the folder $scratch/work, with
# $build first in PATH.
PATH=$build:$PATH
export build top
mkdir "$scratch/work"

# Runs $command and compares its output with expected.out and expected.err.
finish() {
    case $command in
    '') return ;;
    *'  !? '*)
        status=2
        printf '%s: %s\n%s\n' "${command%% *}" "${command#*  !? }" \
            "Try '${command%% *} --help'." >"$scratch/expected.err"
        command=${command%  !? *} ;;
    esac
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

# Runs $line of the table $table.
run_row() {
    input=${line%% => *} options= status=0
    case $line in
    *' => ! '*) status=1 ;;
    *' => '*) ;;
    '# '*) return ;;
    esac
    case $input in *' < '*) options=${input%% < *} input=${input#* < } ;; esac
    (cd "$scratch/work" && printf '%b\n' "$input" | sh -c "$table $options") \
        >"$scratch/out" 2>"$scratch/err"
    ended=$?
    sed 's/^[a-z-]*: \(stdin:\)\{0,1\}/! /' "$scratch/err" | cat "$scratch/out" - |
        awk 'NR > 1 { printf " | " } { printf "%s", $0 }' >"$scratch/said"
    [ $ended -eq $status ] && printf %s "${line#* => }" | cmp -s - "$scratch/said"
    verdict "$source: $table: $line" $? || echo "$(cat "$scratch/said"), status $ended"
}

# Takes a line behind a command.
take_line() {
    case $1 in
    '> '*) command="$command
${1#??}" ;;
    '! '*) printf '%s\n' "${1#??}" >>"$scratch/expected.err" ;;
    '? '*) status=${1#??} ;;
    '(empty)') echo >>"$scratch/expected.out" ;;
    *) printf '%s\n' "$1" >>"$scratch/expected.out" ;;
    esac
}

run_transcripts() { # name; transcripts on standard input
    source=$1 command= table=
    while IFS= read -r line; do
        case $line in
        '$ '*) finish; table=; begin "${line#??}" ;;
        '% '*) finish; table=${line#??} ;;
        '') finish; table= ;;
        *)  if [ -n "$table" ]; then
                run_row
            elif [ -n "$command" ]; then
                take_line "$line"
            fi ;;
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
