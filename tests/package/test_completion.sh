#!/bin/sh
# Completion in bash and zsh offers the options of --help, the names of --list and
# the words that the commands accept, and otherwise file names.
. "$(dirname "$0")/../support/verdict.sh"
completion=$top/tools/cylint/completion
PATH=$build:$PATH
mkdir "$scratch/work" "$scratch/functions"
cp "$completion" "$scratch/functions/_cylint"
cd "$scratch/work" || exit 1

# offers WORD...: what the shell offers for the last word, sorted
in_bash()
{
    bash -c '. "$0"
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
        _cylint "$1" "${!#}" "${COMP_WORDS[COMP_CWORD-1]}"
        [ -z "$COMPREPLY" ] || printf "%s\n" "${COMPREPLY[@]}"' "$completion" "$@" 2>&1 | sort
}

# The functions that need an editor's line are replaced.
in_zsh()
{
    zsh -fc 'fpath=("$0")
        compset() { prefix=${words[CURRENT]%%[^=,]#} }
        compadd() { print -l -- ${(M)offers:#${words[CURRENT]##*[=,]}*} }
        _files() { :; }
        autoload -Uz _cylint
        words=("$@") CURRENT=$#
        _cylint' "$scratch/functions" "$@" 2>&1 | sort
}

# is_offered NAME WORDS ARGUMENT...: these words for the last argument
is_offered()
{
    name=$1
    printf '%s\n' $2 | sed '/^$/d' | sort > "$scratch/expected"
    shift 2
    $shell "$@" | diff "$scratch/expected" -
    verdict "$shell: $name" $?
}

for shell in in_bash in_zsh; do
    command -v ${shell#in_} > /dev/null || {
        echo "note: no ${shell#in_} (make deps)"
        continue
    }
    for command in cylint cylint-render; do
        command -v $command > /dev/null || continue
        options=$($command --help | grep -Eo -e ' -(-[a-z-]+|[a-zA-Z])' | sort -u)
        [ "$(echo $options | wc -w)" -gt 15 ] &&
            is_offered "the options of $command" "$options" $command -
    done
    is_offered 'some options' '--header --help' cylint file --he
    for list in methods columns; do
        option=--method
        [ $list = methods ] || option=-f
        is_offered $list "$(cylint --list=$list | cut -f 1)" cylint $option ''
    done
    is_offered 'queries' 'nearest first any count all pieces inside' cylint -s scene -q ''
    is_offered 'a query' 'nearest' cylint -q n
    is_offered 'ends' 'capped open cap0 cap1 infinite nappe' cylint --ends ''
    is_offered 'bad records' 'mark skip stop' cylint -e ''
    is_offered 'searches' 'auto none tree' cylint --accel ''
    is_offered 'modes of pieces' 'owner union cells chords' cylint --pieces ''
    is_offered 'sums' 'label label:t total total:t' cylint --sum ''
    is_offered 'what is left out' 'number label' cylint --not ''
    is_offered 'forms of neurons' 'cones round' cylint --swc ''
    is_offered 'lists' 'methods shapes columns' cylint --list ''
    command -v cylint-render > /dev/null &&
        is_offered 'shades' 'light plain normal' cylint-render --shade '' &&
        is_offered 'X-rays' 'auto linear' cylint-render --xray ''
    for words in 'cylint' 'cylint -o' 'cylint -s' 'cylint --header' 'cylint -p'; do
        is_offered "files after $words" '' $words ''
    done
    case $shell in
    in_bash)
        is_offered 'the next column' 'n,t n,t0 n,t1' cylint -f n,t
        is_offered 'a value after =' 'cap0 cap1 capped' cylint --ends = cap
        is_offered 'all values after =' 'auto none tree' cylint --accel =
        ;;
    in_zsh)
        is_offered 'the next column' 't t0 t1' cylint -f n,t
        is_offered 'a value after =' 'cap0 cap1 capped' cylint --ends=cap
        is_offered 'all values after =' 'auto none tree' cylint --accel=
        ;;
    esac
done
[ -z "$(ls -A)" ]
verdict 'completion makes no file' $?
check_end
