#!/bin/sh
# The demo prints the same bytes each time and with each awk, its summary agrees
# with the answers, and it fails if one of its steps fails.
. "$(dirname "$0")/../support/verdict.sh"

# demo NAME [AWK]: runs the demo in $scratch/bin and writes its output, without
# the time, to $scratch/NAME.
demo()
{
    BUILD=$scratch/bin AWK=${2:-awk} sh tools/demo/demo.sh \
        > "$scratch/output" 2> "$scratch/messages" &&
        [ ! -s "$scratch/messages" ] &&
        sed 's/^time: .*/time:/' "$scratch/output" > "$scratch/$1"
}

# `make demo` has a command of its own, with the builds for every processor only.
mkdir "$scratch/bin"
cp "$build/demo/cylint" "$scratch/bin" 2> /dev/null || cp "$build/cylint" "$scratch/bin"
demo first
verdict the_demo_succeeds_without_messages $?
[ "$(grep -c '^time: .*[0-9]' "$scratch/output")" -eq 1 ]
verdict the_demo_prints_its_time $?
cp "$build/cylint" "$scratch/bin"
# awk itself is mostly one of them, and so runs again.
for awk in $(command -v mawk gawk || echo awk); do
    demo other $awk && cmp "$scratch/first" "$scratch/other"
    verdict "the_demo_gives_the_same_bytes_again_under_${awk##*/}" $?
done

scan=$scratch/bin/demo
grep -q '^rays 25600, hits [0-9]* (' "$scratch/first" &&
    [ "$(wc -l < "$scan/rays.txt")" -eq 25600 ] &&
    [ "$(wc -l < "$scan/answers.txt")" -eq 25600 ]
verdict every_ray_is_answered $?

# The printed number of hits, the counted one and the sum of the table agree.
awk -v counted="$(awk '$1 > 0' "$scan/answers.txt" | wc -l)" '
    /^rays / { printed = $4 + 0 }
    /^(ground|stem|branch|twig|foliage) / { shapes += $2; sum += $3; rows++ }
    END { exit !(printed == counted && sum == counted && rows == 5 &&
                 counted > 8000 && counted < 20000) }' "$scratch/first"
verdict the_summary_agrees_with_the_answers $?

# The tallest hit is in a crown, not above the tallest tree.
awk -v tallest="$(sed -n 's/^tallest hit: \([0-9.]*\) m.*/\1/p' "$scratch/first")" '
    /^cone/ && $8 > top { top = $8 }
    END { exit !(tallest > 5 && tallest <= top) }' "$scan/forest.scene"
verdict the_tallest_hit_is_within_the_tallest_tree $?

awk '/as a picture/ { seen = NR }
     seen && /^range in m/ { rows = NR - seen - 2; exit }
     seen && length($0) > 100 { wide = 1 }
     END { exit !(rows == 32 && !wide) }' "$scratch/first"
verdict the_picture_is_32_rows_of_at_most_100_characters $?

# The demo names its picture if it made one.
! grep -q 'forest.png' "$scratch/output" && [ ! -e "$scan/forest.png" ]
verdict without_cylint_render_no_picture_is_named $?
if [ -x "$build/cylint-render" ]; then # here a small one
    printf '#!/bin/sh\nexec "%s/cylint-render" "$@" --size 80x40\n' "$build" > "$scratch/bin/cylint-render"
    chmod +x "$scratch/bin/cylint-render"
    demo pictured && tail -n 1 "$scratch/output" | grep -q "$scan/forest.png" &&
        [ "$(head -c 4 "$scan/forest.png" | tail -c 3)" = PNG ] &&
        grep -q 'foliage #' "$scan/forest.scene"
    verdict the_demo_makes_a_picture $?
    rm "$scratch/bin/cylint-render"
else
    echo 'note: no cylint-render, the demo makes no picture (make deps)'
fi

# The demo fails if a step fails.
fails()
{
    ! BUILD=$scratch/bin AWK=$1 sh tools/demo/demo.sh > /dev/null 2>&1
}
rm "$scratch/bin/cylint"
fails awk
verdict the_demo_fails_without_the_command $?
printf '#!/bin/sh\n"%s/cylint" "$@"; exit 1\n' "$build" > "$scratch/bin/cylint"
chmod +x "$scratch/bin/cylint"
fails awk
verdict the_demo_fails_when_the_command_does $?
cp "$build/cylint" "$scratch/bin/cylint"
fails false
verdict the_demo_fails_when_awk_does $?

check_end
