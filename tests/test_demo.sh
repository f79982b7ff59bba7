#!/bin/sh
# The demo: the same bytes each time and under each awk, an account that
# agrees with the answers, and no failure hidden.
. "$(dirname "$0")/verdict.sh"

# demo NAME [AWK]: runs the demo in $scratch/bin; what it says goes to
# $scratch/NAME, without what the clock said.
demo()
{
    BUILD=$scratch/bin AWK=${2:-awk} sh tools/demo/demo.sh \
        > "$scratch/said" 2> "$scratch/messages" &&
        [ ! -s "$scratch/messages" ] &&
        sed 's/^time: .*/time:/' "$scratch/said" > "$scratch/$1"
}

mkdir "$scratch/bin"
cp "$build/cylint" "$scratch/bin"

demo first
verdict the_demo_succeeds_in_silence $?
[ "$(grep -c '^time: .*[0-9]' "$scratch/said")" -eq 1 ]
verdict the_demo_tells_its_time $?
demo second && cmp "$scratch/first" "$scratch/second"
verdict the_demo_gives_the_same_bytes_again $?
for awk in mawk gawk; do
    command -v $awk > /dev/null || continue
    demo other $awk && cmp "$scratch/first" "$scratch/other"
    verdict "the_demo_gives_the_same_bytes_under_$awk" $?
done

scan=$scratch/bin/demo
grep -q '^rays 25600, hits [0-9]* (' "$scratch/first" &&
    [ "$(wc -l < "$scan/rays.txt")" -eq 25600 ] &&
    [ "$(wc -l < "$scan/answers.txt")" -eq 25600 ]
verdict every_ray_is_answered $?

# Told hits against counted ones, and the rows of the table against both.
awk -v counted="$(awk '$1 > 0' "$scan/answers.txt" | wc -l)" '
    /^rays / { told = $4 + 0 }
    /^(ground|stem|branch|twig|foliage) / { shapes += $2; sum += $3; rows++ }
    END { exit !(told == counted && sum == counted && rows == 5 &&
                 counted > 8000 && counted < 20000) }' "$scratch/first"
verdict the_summary_agrees_with_the_answers $?

# A ray (o, d) that met the ground met it at z = 0, to nine digits of d.
paste "$scan/rays.txt" "$scan/answers.txt" | awk '
    $10 == 1 { n++
               z = $4 + $11 * $7
               if (z > 1e-6 || z < -1e-6 || $12 != "cap1") wrong++ }
    $10 == 0 && $7 < -0.1 { wrong++ }
    END { exit !(n > 1000 && !wrong) }'
verdict the_ground_is_met_at_its_upper_cap_at_height_0 $?

# The tallest tree planted bounds the tallest hit, which must be in a crown.
awk -v told="$(sed -n 's/^tallest hit: \([0-9.]*\) m.*/\1/p' \
    "$scratch/first")" '
    /^cone/ && $8 > top { top = $8 }
    END { exit !(told > 5 && told <= top) }' "$scan/forest.scene"
verdict the_tallest_hit_is_within_the_tallest_tree $?

awk '/as a picture/ { seen = NR }
     seen && /^range in m/ { rows = NR - seen - 2; exit }
     seen && length($0) > 100 { wide = 1 }
     END { exit !(rows == 32 && !wide) }' "$scratch/first"
verdict the_picture_is_32_rows_of_at_most_100_characters $?

# A picture is told of if one was made, else not.
! grep -q 'forest.png' "$scratch/said" && [ ! -e "$scan/forest.png" ]
verdict no_picture_is_told_of_where_none_can_be_taken $?
if [ -x "$build/cylint-render" ]; then
    cp "$build/cylint-render" "$scratch/bin"
    demo pictured && tail -n 1 "$scratch/said" | grep -q "$scan/forest.png" &&
        [ "$(head -c 4 "$scan/forest.png" | tail -c 3)" = PNG ] &&
        grep -q 'foliage #' "$scan/painted.scene"
    verdict the_demo_takes_a_picture $?
    rm "$scratch/bin/cylint-render"
else
    echo 'note: no cylint-render, the demo takes no picture (make deps)'
fi

# Whoever fails along the way, the demo fails.
fails()
{
    ! BUILD=$scratch/bin AWK=$1 sh tools/demo/demo.sh > /dev/null 2>&1
}
rm "$scratch/bin/cylint"
fails awk
verdict the_demo_fails_without_the_command $?
printf '#!/bin/sh\n"%s/cylint" "$@"; exit 1\n' "$build" \
    > "$scratch/bin/cylint"
chmod +x "$scratch/bin/cylint"
fails awk
verdict the_demo_fails_when_the_command_does $?
cp "$build/cylint" "$scratch/bin/cylint"
fails false
verdict the_demo_fails_when_awk_does $?

check_end
