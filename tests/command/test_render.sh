#!/bin/sh
# cylint-render draws the pictures of render.txt, those of its manual and
# those of the README.  The program pixels prints the pixels of a file.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
[ -x "$build/cylint-render" ] ||
    skip_all 'no libpng, so no cylint-render (make deps)'
PATH=$build:$build/tests/command:$PATH
mkdir "$scratch/work"
ln -s "$top/tools" "$scratch/work"
run_transcripts render.txt < tests/command/render.txt
cd "$scratch" || exit 1

# Each command of the manual succeeds and makes its picture, here a small one.
test_manual()
{
    mkdir manual && cd manual || return 1
    sh "$top/tests/support/recipe.sh" all cylint-render.1 |
        sed -n 's/480x270/96x54/; s/^\$ //p' > commands
    while read -r command; do
        sh -c "$command" < /dev/null > out 2>&1 || {
            cat out
            false
        }
        verdict "manual: $command" $?
    done < commands
    [ "$(ls *.png | wc -l)" -ge 3 ]
    verdict the_manual_makes_pictures $?
    has_the_options_of_help cylint-render
    cd ..
}

# The commands of the README's pictures, on a smaller scale.
test_pictures()
{
    mkdir readme && cd readme && ln -s "$top/tools" tools || return 1
    for neuron in medulla_top24 medulla_7114; do
        data=$top/../shared/data/$neuron.swc
        if [ -e "$data" ]; then
            ln -s "$data" $neuron.swc
        else
            printf '1 1 0 0 0 2 -1\n2 3 0 9 9 1 1\n' > $neuron.swc
        fi
    done
    for p in forest neurons xray; do
        sh "$top/tests/support/recipe.sh" $p cylint-render.1 |
            sed "s|/usr/local/share/cylint|$top/tools/render|; s/trees=48/trees=1/" |
            sed 's/960x540/96x54/; s/640x540/64x54/; s/720x405/72x40/; s/samples [0-9]*/samples 1/' > small
        sh small > out 2>&1 && [ -s $p.png ] || { cat small out; false; }
        verdict "the manual's command draws $p" $?
    done
    for p in forest:518400:100 neurons:518400:100 xray:291600:20; do
        pixels "$top/tools/render/${p%%:*}.png" | awk -v p=$p '
            BEGIN { split(p, of, ":") }
            !(($3, $4, $5) in seen) { seen[$3, $4, $5] = 1; n++ }
            END { exit !(NR == of[2] && n > of[3]) }'
        verdict "the shipped ${p%%:*} is a picture of the size in its command" $?
    done
    cd ..
}

# The view from far away of the README: by the formula a twentieth of the pixels is
# wrong from 1e7 and more than half of them from 1e8.
test_far_view()
{
    (PATH=$build:$PATH && sh "$top/tools/render/far.sh" 40) > "$scratch/far.ppm" &&
        awk 'NR == 1 { size = $2 " " $3; next }
             { n = NR - 2
               pixel[int(n % 120 / 40), int(n / 120) * 40 + n % 40] = $0 }
             END { for (i = 0; i < 1600; i++) {
                       near += pixel[0, i] != pixel[2, i]
                       far += pixel[1, i] != pixel[2, i]
                       blank += pixel[2, i] == "250 250 248"
                   }
                   exit !(size == "120 40" && NR == 4801 && near > 80 && far > 800 &&
                          blank > 900 && blank < 1200) }' "$scratch/far.ppm"
    verdict the_view_from_far_away_is_clean_where_the_formula_s_is_not $?
}

# The forest of the README is the same under each awk.
test_forest()
{
    for awk in awk mawk gawk; do
        command -v $awk > /dev/null || continue
        $awk -v trees=2 -f "$top/tools/render/autumn.awk" > $awk.scene
    done
    cylint-render awk.scene -o x.png --size 32x20 --samples 1 &&
        [ "$(wc -l < awk.scene)" -gt 4000 ] && rm x.png
    verdict a_forest_is_a_scene $?
    for other in mawk gawk; do
        [ ! -e $other.scene ] || cmp awk.scene $other.scene
        verdict "a_forest_is_the_same_under_$other" $?
    done
    shapes=$(awk -v trees=48 -f "$top/tools/render/autumn.awk" | grep -vc '^#')
    [ "$(sed -n 's/.*48 trees of \([0-9,]*\) .*/\1/p' "$top/README.md" \
        "$top/man/cylint-render.1" | tr -d ,)" = "$(printf '%s\n' $shapes $shapes)" ]
    verdict the_forest_of_the_README_has_so_many_shapes $?
}

test_manual
test_pictures
test_far_view
test_forest
check_end
