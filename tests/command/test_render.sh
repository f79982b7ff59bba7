#!/bin/sh
# Floor tools: cylint-render writes PNG files whose bytes do not depend on the
# number of workers; shapes, shadows and colours are at the right pixels; errors
# give a message and leave no incomplete file; the manual's examples run.
# The program pixels prints the pixels of a file.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
page=$top/man/cylint-render.1
[ -x "$build/cylint-render" ] ||
    skip_all 'no libpng, so no cylint-render (make deps)'
PATH=$build:$build/tests/command:$PATH
cd "$scratch" || exit 1

# ------------------------------------------------------------ one picture --

cat > some.scene << 'END'
cylinder 0 0 0  0 0 2  1  #ff0000
cone 4 0 0 1  4 0 2 0
cylinder 0 4 0  0 4 2  0.7 ends=open  #00ff00
econe 4 4 0  1 0 0  0 0.5 0  0 0.5 2  0.3
END

test_bytes()
{
    for j in 1 2 7; do
        cylint-render some.scene -o $j.png --size 90x61 --samples 3 -j $j \
            --ground '#808080' || return 1
    done
    cmp 1.png 2.png && cmp 1.png 7.png
    verdict the_picture_is_the_same_for_any_number_of_workers $?
    [ "$(od -An -tx1 -N 24 1.png | tr -d ' \n')" = \
        89504e470d0a1a0a0000000d494844520000005a0000003d ]
    verdict it_is_a_png_of_the_given_size $?
    cylint-render - -o - --size 90x61 --samples 3 --ground '#808080' < some.scene | cmp - 1.png
    verdict scene_and_picture_may_be_standard_streams $?
    cylint-render some.scene -o /dev/stdout --size 90x61 --samples 3 \
        --ground '#808080' | cmp - 1.png
    verdict a_picture_may_go_to_a_file_that_is_not_regular $?
}

# Looking down x at a cylinder and a cone of height 2 about z = 0: with
# --ortho the picture is as wide as the scene and 6 % more.
cat > level.scene << 'END'
cylinder 0 -2 -1  0 -2 1  1  #ff0000
cone 0 2 -1 1  0 2 1 0  tail #0000ff more
END

# brightest FILE X Y CHANNEL: at this pixel only this channel is bright
brightest()
{
    pixels "$1" "$2" "$3" | awk -v c="$4" '{
        for (i = 1; i <= 3; i++)
            bad += i == c ? $i < 60 : $i > 20
        exit bad > 0
    }'
}

# A pipe along the view, of which a quarter is left out.
cat > pipe.scene << 'END'
cylinder 0 0 -1  0 0 1  2  in=pipe  #00ff00
cylinder 0 0 -1  0 0 1  1  out=pipe
halfspace 0 0 0  1 0 0  in=pipe/3
halfspace 0 0 0  0 1 0  in=pipe/3
END

test_cut_solids()
{
    cylint-render pipe.scene -o pipe.png --ortho --from 0,0,1 --up 0,1,0 \
        --size 212x212 --shade light --background none --samples 1 || return 1
    # 50 pixels for a unit, the axis at 106, 106, x to the right and y up
    pixels pipe.png | awk '
        { x = ($1 + 0.5 - 106) / 50; y = (106 - $2 - 0.5) / 50
          r = sqrt(x * x + y * y) }
        r < 0.97 || r > 2.03 || (x > 0.03 && y > 0.03) { out++; shown += $6 > 0 }
        r > 1.03 && r < 1.97 && (x < -0.03 || y < -0.03) {
            inside++; green += $6 == 255 && $4 > 60 && $4 > 2 * $3 }
        END { exit !(out > 9000 && !shown && inside > 15000 &&
                     green == inside) }'
    verdict solids_are_hollow_and_cut $?
    sed 's/ *in=pipe  #/  ends=open  in=pipe  #/; s/ *out=/  ends=cap1  out=/' pipe.scene > open.scene
    cylint-render open.scene -o open.png --ortho --from 0,0,1 --up 0,1,0 \
        --size 212x212 --shade light --background none --samples 1 &&
        cmp pipe.png open.png
    verdict members_of_solids_count_with_their_caps $?
}

test_framing()
{
    cylint-render level.scene -o level.png --ortho --from 1,0,0 \
        --size 318x106 --shade plain --background none --samples 1 || return 1
    # 50 pixels for a unit: y from -3 to 3, z from -1 to 1
    brightest level.png 59 53 1
    verdict the_left_shape_is_red $?
    brightest level.png 259 53 3
    verdict a_colour_stands_anywhere_in_the_tail $?
    pixels level.png | awk '
        $6 > 0 { if (low == "" || $1 < low) low = $1; if ($1 > high) high = $1
                 if (top == "" || $2 < top) top = $2
                 if ($2 > bottom) bottom = $2 }
        # the 6 units fill 318 / 1.06 = 300 pixels, from the 9th on
        END { exit !(low == 9 && high == 308 && top >= 2 && bottom <= 103 &&
                     bottom - top == 99) }'
    verdict the_scene_fills_the_picture_except_its_margin $?
    pixels level.png | awk '
        # the cone at its foot, at half height and near its apex
        $2 == 102 && $1 > 159 && $6 { foot++ }
        $2 == 53 && $1 > 159 && $6 { half++ }
        $2 == 4 && $1 > 159 && $6 { tip++ }
        END { exit !(foot >= 98 && half >= 49 && half <= 51 && tip <= 2 &&
                     foot <= 100) }'
    verdict a_cone_has_the_outline_of_a_cone $?
    awk '{ $2 += 7000; $3 -= 4000; $4 += 500
           i = $1 == "cone" ? 6 : 5
           $i += 7000; $(i + 1) -= 4000; $(i + 2) += 500; print }' level.scene > away.scene
    cylint-render away.scene -o near.png --from 1,0.2,0.3 --size 200x150 \
        --samples 1 --background none || return 1
    pixels near.png | awk '
        $6 { n++; if ($1 < 3 || $1 > 196 || $2 < 3 || $2 > 146) out++ }
        END { exit !(n > 2000 && !out) }'
    verdict nothing_is_cut_off_in_perspective $?
    # a slab as thin as the steps of the doubles; 1 / 49 times 49 is below 1
    printf '%s\n' 'cylinder 0 0 0  0 0 1  1  #ff0000' \
        'cylinder 0 0 1000  0 0 1000.0000000000001  1  #0000ff' > slab.scene
    cylint-render slab.scene -o slab.png --ortho --from 0,0,49 --up 0,1,0 \
        --size 3x3 --samples 1 --shade plain || return 1
    brightest slab.png 1 1 3
    verdict the_eye_is_before_the_scene_with_ortho $?
    for power in 0 -1000 1000; do
        sed "s/@/p$power/g" > power.scene << 'END'
cylinder 0 0 0  0 0 0x2@  0x1@
cone 0x4@ 0 0  0x1@  0x4@ 0 0x2@  0
rcone 0x2@ 0x4@ 0  0x1@  0 0x5@ 0x2@  0x.8@
END
        for camera in --ortho --fov=30; do
            cylint-render power.scene -o power.png "$camera" --size 60x40 --samples 1 \
                --colour radius || return 1
            pixels power.png > "size$power$camera"
        done
    done
    for power in -1000 1000; do
        cmp size0--ortho "size$power--ortho" && cmp size0--fov=30 "size$power--fov=30"
        verdict "a_picture_does_not_depend_on_the_scenes_size_$power" $?
    done
    cylint-render level.scene -o eye.png --eye 10,-2,0 --look-at 0,-2,0 \
        --size 100x100 --fov 20 --samples 1 --shade plain --background none || return 1
    # The upper rim's near point is at the angle atan(1/9), which is
    # 1/9 / tan(10 degrees) = 63.0 % of the half picture.
    pixels eye.png | awk '
        $1 == 50 && $6 { if (top == "") top = $2; bottom = $2 }
        END { exit !(top == 18 && bottom == 81) }'
    verdict fov_is_the_angle_of_the_picture $?
}

# A pillar on a wide plate, the sun at 45 degrees: its shadow is as long as
# the pillar is high and points away from the sun.
test_shadow()
{
    printf '%s\n' 'cylinder 0 0 -0.1  0 0 0  10  #ffffff' \
        'cylinder 0 0 0  0 0 4  0.5  #ffffff' > pillar.scene
    cylint-render pillar.scene -o shadow.png --ortho --from 0.0001,0,1 \
        --up 0,0,1 --light 0,1,1 --size 424x424 --samples 4 || return 1
    # from above: y to the right, 20 pixels a unit, the middle at 212
    pixels shadow.png | awk '
        $2 == 212 { light[$1] = $3 + $4 + $5 }
        END { lit = light[300]
              exit !(light[212 - 60] < 0.8 * lit && light[212 - 78] < 0.8 * lit &&
                     light[212 - 102] > 0.97 * lit) }'
    verdict a_shadow_has_the_length_of_the_suns_angle $?
    # Rounding makes no surface shade itself: the plate, far from the pillar,
    # and a cylinder drawn three times, far from the origin, have no dark pixel.
    pixels shadow.png | awk '
        $1 > 240 && $1 < 370 && $2 > 150 && $2 < 270 {
            s = $3 + $4 + $5
            if (least == "" || s < least) least = s
            if (s > most) most = s }
        END { exit !(least > 0.97 * most) }'
    verdict a_lit_plate_has_no_dark_specks $?
    for i in 1 2 3; do
        echo 'cylinder 1e6 2e6 3e6  1000000.3 2000000.7 3000003  1  #ffffff'
    done > thrice.scene
    head -n 1 thrice.scene > once.scene
    for s in once thrice; do
        cylint-render $s.scene -o $s.png --samples 4 --size 120x90 || return 1
    done
    cmp once.png thrice.png
    verdict a_shape_drawn_thrice_does_not_shade_itself $?
}

test_inside()
{
    # Into an open tube, towards the sun behind the viewer: the far inner
    # wall is lit where the near one does not hide the sun.
    echo 'cylinder 0 0 0  0 0 4  1 ends=open  #ffffff' > tube.scene
    echo 'cylinder 0 0 0  0 0 4  1 ends=cap1  #ffffff' > lid.scene
    for s in tube lid; do
        cylint-render $s.scene -o $s.png --eye 0.9,0,3 --look-at -1,0,3 \
            --light 1,0,4 --size 40x40 --fov 20 --samples 16 || return 1
    done
    bright=$(pixels tube.png 20 20 | awk '{ print $1 + $2 + $3 }')
    dark=$(pixels lid.png 20 20 | awk '{ print $1 + $2 + $3 }')
    [ "$bright" -gt 500 ] && [ "$dark" -lt 420 ] || {
        echo "open $bright, with a lid $dark"
        false
    }
    verdict light_falls_into_a_tube_but_not_through_its_lid $?
    # the other nappe of a double cone keeps the light off
    echo 'acone 0 0 0  0 0 1  45  #ffffff' > double.scene
    echo 'acone 0 0 0  0 0 1  45 ends=nappe  #ffffff' > single.scene
    for s in double single; do
        cylint-render $s.scene -o $s.png --eye 0,9,2 --look-at 0,2.05,2 \
            --light 0,1,-1.3 --size 9x9 --fov 1 --samples 16 || return 1
    done
    bright=$(pixels single.png 4 4 | awk '{ print $1 + $2 + $3 }')
    dark=$(pixels double.png 4 4 | awk '{ print $1 + $2 + $3 }')
    [ "$bright" -gt $((dark + 100)) ] || {
        echo "one nappe $bright, both $dark"
        false
    }
    verdict the_other_nappe_shades_the_first $?
}

# ------------------------------------------------------------------ X-rays --

# xray FILE SCENE ARGUMENT...: a ball of radius 1 as shows_ball expects it
xray()
{
    file=$1 scene=$2
    shift 2
    cylint-render "$scene" -o "$file" --eye 0,0,10 --look-at 0,0,0 --up 0,1,0 \
        --fov 14 --size 61x40 --samples 1 "$@"
}

# The lengths of the rays of xray() inside the ball, by the command and by the
# textbook: 2 sqrt(1 - b^2), b the distance of the ray from the centre.
ball_lengths()
{
    awk 'BEGIN {
        angle = 7 * 0.017453292519943295
        half = sin(angle) / cos(angle)
        for (y = 0; y < 40; y++)
            for (x = 0; x < 61; x++) {
                right = (2 * (x + 0.5) / 61 - 1) * half * 61 / 40
                up = (1 - 2 * (y + 0.5) / 40) * half
                aside = right * right + up * up
                b = 100 * aside / (aside + 1)
                printf "ray 0 0 10  %.17g %.17g -1  %.17g\n", right, up,
                    b < 1 ? 2 * sqrt(1 - b) : 0
            } }' | cylint -s ball.scene -q pieces --pieces chords --sum total
}

# shows_ball FILE GREY: the pixels have the greys that are computed from the length l
shows_ball()
{
    ball_lengths > lengths
    pixels "$1" | paste - lengths | awk '
        { l = $4; off = l - $5; inside += l > 0
          wrong += $3 != int(65535 * ('"$2"') + 0.5) || off * off > 1e-18 }
        END { print inside " pixels show the ball, " wrong " are wrong"
              exit !inside || wrong > 0 || NR != 61 * 40 }'
}

# note FILE: what the file says about its greys
note() { grep -aoE '65535 (exp\(-[0-9.e+-]+ length\)|length / [0-9.e+-]+)' "$1"; }

test_xray()
{
    echo 'sphere 0 0 0  1' > ball.scene
    xray mu.png ball.scene --xray 0.75 && shows_ball mu.png 'exp(-0.75 * l)'
    verdict an_x_ray_of_a_ball_has_the_lengths_of_its_chords $?
    [ "$(note mu.png)" = '65535 exp(-0.75 length)' ]
    verdict an_x_ray_describes_itself $?
    xray linear.png ball.scene --xray linear &&
        shows_ball linear.png "l / $(note linear.png | sed 's/.* //')" &&
        [ "$(pixels linear.png | awk '$3 > m { m = $3 } END { print m }')" = 65535 ]
    verdict the_longest_ray_is_white_on_a_linear_scale $?
    xray auto.png ball.scene --xray auto &&
        pixels auto.png | awk -v mu="$(note auto.png | sed 's/.*-//; s/ .*//')" '
            $3 < 65535 { n++; sum += -log($3 / 65535) / mu }
            END { f = mu * sum / n; exit !(f > 0.69310 && f < 0.69319) }'
    verdict a_ray_of_the_mean_length_is_half_as_bright $?
    # within the ball, twice, and as an open tube's closed solid
    printf '%s\n' 'sphere 0 0 0 1' 'sphere 0.25 0 0 0.5' 'sphere 0 0 0 1' \
        'cylinder 0 0 -0.5 0 0 0.5 0.5 ends=open' > balls.scene
    xray balls.png balls.scene --xray 0.75 && cmp mu.png balls.png
    verdict places_in_several_shapes_count_once $?
    for j in 1 2 7; do
        cylint-render some.scene -o $j.png --size 90x61 --samples 16 -j $j \
            --xray auto || return 1
    done
    cmp 1.png 2.png && cmp 1.png 7.png
    verdict an_x_ray_is_the_same_for_any_number_of_workers $?
    # a plane's edge through the middle: half of the samples hit a slab of 2
    echo 'econe 0 0 -1  1 0 0  0 1 0  0 0 2  1' > disc.scene
    cylint-render disc.scene -o edge.png --ortho --eye 1,0,5 --look-at 1,0,0 \
        --up 0,1,0 --zoom 1e6 --size 1x1 --samples 64 --xray 0.5 &&
        pixels edge.png | awk '
            { length_of = -log($3 / 65535) / 0.5
                     exit !(length_of > 0.99 && length_of < 1.01) }'
    verdict the_length_of_a_pixel_is_the_mean_of_its_rays $?
}

# A shell: the ball without a smaller one.
test_solids()
{
    printf '%s\n' 'sphere 0 0 0  1  in=shell' 'sphere 0 0 0  0.5  out=shell' > shell.scene
    printf '%s\n' 'sphere 0 0 0  0.5' > core.scene
    for s in ball core shell; do
        xray $s.png $s.scene --xray 0.75 && pixels $s.png |
            awk '{ print -log($3 / 65535) / 0.75 }' > $s.lengths
    done
    paste ball.lengths core.lengths shell.lengths | awk '
        { off = $1 - $2 - $3; bad += off * off > 1e-8; hollow += $2 > 0 }
        END { exit bad || !hollow }'
    verdict an_x_ray_of_a_shell_is_the_difference_of_two_balls $?
    # what is cut off does not count for the view
    printf '%s\n' 'sphere 0 0 0  1  in=a' 'cylinder -99 0 0  99 0 0  99  in=a/2' \
        'halfspace 0 0 5  0 0 1  in=a/3' 'sphere 0 0 99  9  out=a' > cut.scene
    for s in ball cut; do
        cylint-render $s.scene -o $s.png --size 61x40 --xray 0.75 || return 1
    done
    cmp ball.png cut.png
    verdict a_solid_fills_the_picture_not_its_members $?
}

# A pipe whose quarter x > 0, y > 0 is cut away, from there.
test_bore()
{
    printf '%s\n' 'cylinder 0 0 0  0 0 4  1  in=p  #ff0000' \
        'cylinder 0 0 0  0 0 4  0.5  out=p  #0000ff' 'halfspace 0 0 0  1 0 0  in=p/3' \
        'halfspace 0 0 0  0 1 0  in=p/3' > quarter.scene
    for j in 1 2; do
        cylint-render quarter.scene -o quarter$j.png -j $j --size 60x50 --samples 2 || return 1
    done
    cmp quarter1.png quarter2.png
    verdict a_picture_of_solids_is_the_same_for_any_number_of_workers $?
    cylint-render quarter.scene -o bore.png --eye 5,5,2 --look-at 0,0,2 --size 41x41 \
        --samples 16 --light 1,1,1.5 --fov 4 || return 1
    pixels bore.png 20 20 | awk '{ exit !($3 > 100 && $1 < 40) }'
    verdict a_bore_is_lit_in_its_own_colour $?
    pixels bore.png | awk '
        $1 > 15 && $1 < 25 && $2 > 10 && $2 < 20 {
            if (least == "" || $5 < least) least = $5
            if ($5 > most) most = $5 }
        END { exit !(least > 0.9 * most) }'
    verdict a_bore_does_not_shade_itself $?
}

# Nothing in the picture, and solids without an end.
test_xray_extremes()
{
    : > empty.scene
    for how in auto 2 linear; do
        xray empty.png empty.scene --xray $how &&
            pixels empty.png | awk -v how=$how '
                $3 != (how == "linear" ? 0 : 65535) { bad++ }
                END { exit NR < 9 || bad }'
        verdict "an_x_ray_of_nothing_is_empty_$how" $?
        printf '%s\n' 'cylinder 0 0 0  0 0 1  1 ends=infinite' \
            'cylinder 0 0 0  0 0 1  1' > endless.scene
        xray endless.png endless.scene --xray $how --ortho &&
            pixels endless.png | awk -v how=$how '
                $1 == 30 && $2 == 20 { middle = $3 }
                END { exit middle != (how == "linear" ? 65535 : 0) }'
        verdict "an_endless_solid_is_opaque_$how" $?
    done
}

# ---------------------------------------------------------------- colours --

# shows NAME COLOURS ARGUMENT...: the caps have COLOURS different colours
shows()
{
    name=$1 wanted=$2
    shift 2
    cylint-render five.scene -o five.png --ortho --from 0,0,1 --up 0,1,0 \
        --size 200x40 --samples 1 --background none "$@" || return 1
    found=$(pixels five.png | awk '$6 { print $3, $4, $5 }' |
        sort -u | wc -l)
    [ "$found" -eq "$wanted" ] || { echo "found $found colours"; false; }
    verdict "$name" $?
}

# discs LABEL...: the colours of discs with these labels from left to right
discs()
{
    x=0
    for label; do
        echo "cylinder $x 0 0 $x 0 2 1 $label"
        x=$((x + 2))
    done > atoms.scene
    cylint-render atoms.scene -o atoms.png --ortho --from 0,0,1 --up 0,1,0 \
        --size $((10 * x))x20 --samples 1 --background none --shade plain \
        --colour "$how" || return 1
    pixels atoms.png |
        awk '$2 == 10 && $6 && $3 " " $4 " " $5 != last { last = $3 " " $4 " " $5; print last }'
}

test_atoms()
{
    how=element
    discs A:1:GLY:CA A:1:GLY:N B:1:LIG:CL1:Cl A:1:GLY:1HB A:2:HOH:O A:1:GLY:CA--A:1:GLY:N \
        x A:1:GLY '' A:1:X:Q1 ':1:GLY:S #123456 x' 'a A:1:GLY:O' > atoms
    # carbon and hydrogen are grey, nitrogen blue, chlorine green, oxygen red, a bond
    # grey; three shapes without a label in one colour; pink; its own; as those
    awk 'function is(word) { if (word == "grey") return $1 == $2 && $2 == $3
             if (word == "blue") return $3 > 2 * $2
             if (word == "green") return $2 > 2 * $1
             if (word == "red") return $1 > 2 * $2
             if (word == "clay") return $1 == clay || !clay && (clay = $1)
             if (word == "pink") return $1 > 2 * $2 && $3 > 2 * $2
             return $3 > $2 && $2 > $1 }
         BEGIN { split("grey blue green grey red grey clay pink own clay", word) }
         !is(word[NR]) { print NR ": " $0; wrong = 1 }
         END { exit wrong || NR != 10 }' atoms
    verdict atoms_have_the_colours_of_their_elements $? || cat atoms
    how=chain
    discs A:1:GLY:CA B:1:GLY:CA A:2:X:Q:Zn AA:1:GLY:N A:1:GLY:C--B:1:GLY:N x > atoms
    [ "$(wc -l < atoms)" -eq 6 ] && [ "$(sort -u atoms | wc -l)" -eq 4 ] &&
        [ "$(sed -n 1p atoms)" = "$(sed -n 3p atoms)" ] &&
        [ "$(sed -n 1p atoms)" = "$(sed -n 5p atoms)" ]
    verdict each_chain_has_its_colour $? || cat atoms
}

test_colours()
{
    for x in '0 0.5 a' '2 0.6 b' '4 0.7 a' '6 0.8 a' '8 0.9 c'; do
        set -- $x
        echo "cylinder $1 0 0  $1 0 2  $2  $3"
    done > five.scene
    shows one_colour_for_all 1 --shade plain
    shows each_number_has_its_colour 5 --shade plain --colour number
    shows each_label_has_its_colour 3 --shade plain --colour label
    shows each_kind_has_its_colour 1 --shade plain --colour kind
    shows each_radius_has_its_colour 5 --shade plain --colour radius
    shows equal_heights_have_equal_colours 1 --shade plain --colour height
    shows unlinked_shapes_differ 5 --shade plain --colour connected
    shows normals_are_colours 1 --shade normal
    # the first and the third are linked by a thread too thin to be seen
    printf '%s\n' 'cylinder 0 0 0  0 0 2  0.5' 'cone 0 0 0 1e-9 4 -0 0 1e-9' \
        'cylinder 4 0 2  4 0 0  0.5' 'cylinder 2 0 0 2 0 2 0.5' \
        'ecylinder 6 0 0  0.5 0 0  0 0.5 0  0 0 2' 'cylinder 8 0 0 8 0 2 0.5' > five.scene
    shows linked_shapes_agree 4 --shade plain --colour connected
    test_atoms
}

# With round joints a bent neuron has no notch at its outer side: the pixel that
# is background with cones shows the ball.  A soma of one point is a disc.
test_joints()
{
    printf '%s\n' '1 1 0 0 0 1 -1' '2 3 4 0 0 1 1' '3 3 4 4 0 1 2' > bend.swc
    echo '1 1 0 0 0 1 -1' > soma.swc
    for form in cones round; do
        cylint-render bend.swc --swc=$form -o $form.png --eye 4,0,60 \
            --look-at 4,0,0 --up 0,1,0 --fov 5 --size 101x101 --samples 1 \
            --shade plain --background none || return 1
    done
    # 19.3 pixels a unit at z = 0; (4.6, -0.6) is within 1 of the bend
    [ "$(pixels cones.png 62 62 | cut -d ' ' -f 4)" = 0 ] &&
        [ "$(pixels round.png 62 62 | cut -d ' ' -f 4)" = 255 ]
    verdict a_round_joint_has_no_notch $?
    cylint-render soma.swc --swc=round -o soma.png --size 106x106 --ortho \
        --from 1,0,0 --samples 1 --shade plain --background none || return 1
    pixels soma.png | awk '
        $6 { n++ } END { exit !(n > 7800 && n < 7900) }' # pi 50^2 = 7854
    verdict a_soma_of_one_point_is_a_disc $?
}

# ------------------------------------------------------------------ faults --

test_faults()
{
    echo 'cylinder 0 0 0  0 0 zero 1' > bad.scene
    : > empty.scene
    ln -s . work
    run_transcripts render.txt < "$top/tests/command/render.txt"
    [ ! -e x.png ] && [ -z "$(ls | grep part)" ]
    verdict a_failure_leaves_no_file $?

    cylint-render some.scene -o - --size 20x20 >&- 2> messages
    [ $? -eq 3 ] && [ "$(cat messages)" = \
        'cylint-render: standard output: Bad file descriptor' ]
    verdict a_closed_standard_output_gives_a_message $?
    cylint-render some.scene -o y.png --size 20x20 --progress <&- 2>&- >&- &&
        cylint-render some.scene -o z.png --size 20x20 && cmp y.png z.png
    verdict closed_streams_do_not_change_the_picture $?

    # The old picture stays until the new one is whole.
    echo old > kept.png
    (ulimit -f 1; trap '' XFSZ
     exec cylint-render some.scene -o kept.png --size 200x200 --samples 1) > out 2> messages
    [ $? -eq 3 ] && [ "$(cat kept.png)" = old ] && [ -z "$(ls | grep part)" ] &&
        [ "$(cat messages)" = 'cylint-render: kept.png: File too large' ]
    verdict a_full_disk_leaves_the_old_picture $?
    cylint-render some.scene -o kept.png --size 20x20 --samples 1 &&
        pixels kept.png 3 3 > /dev/null
    verdict a_picture_replaces_the_old_one $?
    cylint-render empty.scene -o sky.png --eye 0,0,0 --look-at 1,0,0 \
        --size 8x8 --background '#123456' &&
        [ "$(pixels sky.png 4 4)" = '18 52 86 255' ]
    verdict an_empty_scene_shows_the_background $?
    cylint-render some.scene -o - --size 20x20 --samples 1 2> messages | cat > /dev/null
    [ ! -s messages ]
    verdict progress_appears_on_a_terminal_only $?
    cylint-render some.scene -o x.png --size 20x20 --progress 2> messages &&
        grep -q '^cylint-render: traced 400 pixels: [0-9.]* s, [0-9.]* s of CPU$' messages
    verdict progress_appears_with_its_option $?
}

# Each command of the manual succeeds and makes its picture, here a small one.
test_manual()
{
    mkdir manual && cd manual || return 1
    awk '/^\.Bd -literal/ { show = 1; next }
         /^\.Ed/ { show = 0 }
         show && /^\$ / { sub(/^\$ /, ""); gsub(/\\e/, "\\"); sub(/480x270/, "96x54"); print }' \
        "$page" > commands
    while read -r command; do
        sh -c "$command" < /dev/null > out 2>&1 || {
            cat out
            false
        }
        verdict "manual: $command" $?
    done < commands
    [ "$(ls *.png | wc -l)" -ge 3 ]
    verdict the_manual_makes_pictures $?
    for word in $(cylint-render --help |
        grep -Eo -e '^  -(-[a-z-]+|[a-zA-Z])' | tr -d - | sort -u); do
        grep -Eq "(Fl|Fl -|Cm) *-?$(echo "$word" | sed 's/lookat/look-at/')" "$page"
        verdict "the manual describes $word" $?
    done
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
}

test_bytes
test_framing
test_shadow
test_inside
test_xray
test_solids
test_cut_solids
test_bore
test_xray_extremes
test_colours
test_joints
test_faults
test_manual
test_pictures
test_far_view
test_forest
check_end
