#!/bin/sh
# Floor tools: cylint-convert pov converts small files to the expected scenes,
# refuses others, and leaves shapes out with --skip.  All tests run with each awk
# found.
. "$(dirname "$0")/../support/verdict.sh"
. "$(dirname "$0")/converts.sh"
remedy='; --skip leaves such shapes out'

test_pov()
{
    pov=tools/convert/pov2scene
    cat > "$scratch/in" <<'POV'
// cylinder { <0,0,0>, <1,1,1>, 9 }
camera { location <0, 0, -5> look_at <0, 0, 0> }
light_source { <1, 2, 3> color rgb 1 cylinder radius 3 }
#declare Skin = texture { pigment { color rgb <1, 0, 0> } scale 2 };
cylinder { <0,0,0>, <0,0,1.50>, 0.5 open texture { Skin scale 3 } }
union {
  cone {
    <-1,0,0>, 1e0 /* base
    cylinder */
    <0, 0, 3>, 0
  }
  torus { 2, 1 translate x }
  pigment { color "cone {" }
}
cylinder{<1,2,3>,<4,5,6>,.25}
POV
    expect 'cylinder 0 0 0 0 0 1.50 0.5 ends=open 5\ncone -1 0 0 1e0 0 0 3 0 7\ncylinder 1 2 3 4 5 6 .25 15\n'
    gives pov_takes_literal_shapes_wherever_they_stand $pov
    one='cylinder { <0,0,0>, <0,0,1>, 1 }'
    input "$one\ncylinder { <0,0,0>, <0,0,1>, R }\n"
    refuses pov_refuses_identifiers \
        "cylint-convert: -:2: expected a number, found 'R'$remedy" $pov
    input 'cone { <0,0,0>, 1, <0,0,1>, 2\nrotate x*90 }\n'
    refuses pov_refuses_transformed_shapes \
        "cylint-convert: -:2: cone: transformed$remedy" $pov
    input "union { $one\ntranslate x }\n"
    refuses pov_refuses_transformed_unions \
        "cylint-convert: -:1: cylinder: inside union {}, which is transformed$remedy" $pov
    input "#declare C = $one\n"
    refuses pov_refuses_declared_shapes \
        "cylint-convert: -:1: cylinder: only declared$remedy" $pov
    input "#for (I, 0, 3)\n$one\n#end\n"
    refuses pov_refuses_loops \
        "cylint-convert: -:2: cylinder: inside a loop, condition or macro$remedy" $pov
    input "difference { $one }\n"
    refuses pov_refuses_differences \
        "cylint-convert: -:1: cylinder: inside difference {}$remedy" $pov
    input 'cylinder { <0,0,0>, <0,0,1>, 1'
    refuses pov_refuses_half_a_shape \
        "cylint-convert: -:1: expected the end of a number, found the end of the file$remedy" $pov
    input 'union { cylinder { <0,0,0>, <0,0,1>, 1 }'
    refuses pov_refuses_half_a_union \
        'cylint-convert: -:1: the file ends inside a block' $pov
    input 'cylinder { <0,0,0>, <0,0,0>, 1 }'
    refuses pov_refuses_no_length "cylint-convert: -:1: cylinder: without length$remedy" $pov
}

# values NAME NUMBERS EXPRESSIONS: what stands in a cylinder {}.
values()
{
    echo "$3" > "$scratch/in"
    echo "cylinder $2" > "$scratch/expected"
    gives "pov_$1" $pov
}

test_pov_numbers()
{
    pov=tools/convert/pov2scene
    values sums '0 0 0 0 0 3 2 1' 'cylinder { <0,0,0>, <0,0,1+2>, 5 -3 }'
    values products_bind_tighter '0 0 7 0 0 1 6.5 1' \
        'cylinder { <0,0,1+2*3>, <0,0,(1+2)/3>, 1+2*3-1/2 }'
    values signs '-1.50 0 0 1 -2e0 0 7 1' \
        'cylinder { <-1.50,-0,+0>, -<-1,2e0,0>, -(-7) }'
    values unit_vectors_and_pi '2 0 -1 0 -3 0 3.141592653589793 1' \
        'cylinder { x*2-z, 3*-y, pi }'
    values vectors_by_component '2 4 -1.5 0.5 1 1.5 1 1' \
        'cylinder { <1,2,3>*<2,2,-0.5>, <1,2,3>/2, 1 }'
    values a_number_stands_for_three '1 1 1 1 2 1 1 1' \
        'cylinder { 1, 1 + y, 1 }'
    values commas_may_be_missing '0 0 0 1 2 3 .5 1' \
        'cylinder { <0 0 0> <1 2 3> .5 }'
    values names '0 0 0 0 3 0 1.5 1' \
        '#declare R = 3/2; #local V = <0,2*R,0>; cylinder { 0, V, V.y - R }'
    values names_change '0 0 0 0 2 0 1.5 1' \
        '#declare R = 1; #declare R = R + .5; cylinder { 0, 2*y, R }'
    input 'cylinder { 0, y, 1/0 }\n'
    refuses pov_refuses_a_division_by_0 \
        "cylint-convert: -:1: expected a divisor other than 0 before this, found '}'$remedy" $pov
    input 'cylinder { 0, y, x }\n'
    refuses pov_refuses_a_vector_for_a_number \
        "cylint-convert: -:1: expected a number, not a vector, before this, found '}'$remedy" $pov
    input 'cylinder { 0, 1e999, 1 }\n'
    refuses pov_refuses_overflow \
        "cylint-convert: -:1: expected a finite number, found '1e999'$remedy" $pov
    input 'cylinder { <1,2>, y, 1 }\n'
    refuses pov_refuses_two_components \
        "cylint-convert: -:1: expected a number, found '>'$remedy" $pov
    # R may be another number, at the cylinder, than that of line 1
    for change in '#if (Q) #declare R = 2; #end' '#include "r.inc"' \
        '#undef R' '#declare R = sin(1);' '#for (R, 0, 3) #end' \
        '#macro M() #declare R = 2; #end M() #declare R = 1; M()' \
        '#macro M(A) #declare A = 2; #end M(R)' '#read (File, R)' \
        '#while (Q) #local R = 2; #end' '#declare R = array[2] {1, 2}' \
        '#declare R[1] = 2;' '#declare R = 1 > 2;'; do
        printf '%s\n' '#declare R = 1;' "$change" 'cylinder { 0, y, R }' \
            > "$scratch/in"
        refuses "pov_forgets_a_number_at: $change" \
            "cylint-convert: -:3: expected a number, found 'R'$remedy" $pov
    done
}

test_pov_skip()
{
    pov='tools/convert/pov2scene --skip'
    cat > "$scratch/in" <<'POV'
// A scene as people write them  /* this opens no comment
#version 3.7;
#include "colors.inc"
/* nested /* comment { */ cylinder { 0, y, 1 } */
global_settings { assumed_gamma 1.0 }
#declare R = 0.25; #declare Top = <0, 2, 0>;
#declare Skin = texture { pigment { color rgb <1, 0, 0> } scale 2 }
camera { location <0, 0, -5> look_at <0, 0, 0> angle degrees(1) }
light_source { <1, 2, 3> color rgb 1 cylinder radius 3 point_at 0 }
cylinder { 0, Top, R texture { Skin scale 3 } }
cone { <0, 0, 0>, 1.50, Top*2, 0 open }
union {
  cylinder { Top, Top + z, Top.y pigment { color "cone {" } }
  sphere { 0, 1 translate x }
  union { cone { x, 1, y, 0.5 } rotate <0, 90, 0> }
  object { Post translate x }
}
difference {
  union { box { -1, 1 } cylinder { -2*z, 2*z, pi/4 } }
  intersection { cylinder { 0, y, 1 } box { -1, 1 } }
}
#declare Post = union { cylinder { 0, y, .1 } cone { y, .2, 2*y, 0 } }
#declare Peg = cylinder { 0, y, 1 }
object { Post }
cylinder { 0, y, 1 scale 2 }
cylinder { 0, y, 1 matrix <1,0,0, 0,1,0, 0,0,1, 0,0,0> }
object { union { cylinder { 0, y, 1 } } translate -x }
#declare I = 0;
#while (I < 3)
  cylinder { I*x, I*x + y, R }
  #declare I = I + 1;
#end
union { cylinder { 0, y, 2 } Grow(3) }
#if (sin(3) > 0) difference { #else merge { #end cylinder { 0, y, 4 } }
cylinder { 0, y, 1 #if (R < 1) open #end }
cylinder { 0, 2*y, sqrt(2) }
cylinder { 0, 2*y, rand(S)*<1,2> open no_shadow }
cylinder { 0, y, 5 clipped_by { plane { y, 0.5 } } }
sphere { 0, 1 bounded_by { cylinder { -y, y, 1 } } }
blob { threshold .6 cylinder { 0, y, 1, 1 } }
cylinder { <0,0,0>, <0,0,0>, 1 }
cylinder { 0, y, -1 }
merge { cylinder { 0, y, 6 } }
POV
    expect 'cylinder 0 0 0 0 2 0 0.25 10
cone 0 0 0 1.50 0 4 0 0 ends=open 11
cylinder 0 2 0 0 2 1 2 13
sphere 0 0 0 1 39
cylinder 0 0 0 0 1 0 6 43
'
    gives pov_skip_takes_the_shapes_that_stand_as_written $pov
    says pov_skip_counts_what_it_left_out 'cylint-convert: 1 sphere {} left out: transformed
cylint-convert: 1 cone {} left out: inside union {}, which is transformed
cylint-convert: 2 object {} left out: declared elsewhere
cylint-convert: 2 box {} left out
cylint-convert: 2 cylinder {} left out: inside difference {}
cylint-convert: 2 cylinder {} left out: only declared
cylint-convert: 1 cone {} left out: only declared
cylint-convert: 2 cylinder {} left out: transformed
cylint-convert: 1 cylinder {} left out: inside object {}, which is transformed
cylint-convert: 3 cylinder {} left out: inside a loop, condition or macro
cylint-convert: 1 cylinder {} left out: inside union {}, which is given to a macro
cylint-convert: 2 cylinder {} left out: with numbers that are not understood
cylint-convert: 1 cylinder {} left out: clipped
cylint-convert: 1 plane {} left out
cylint-convert: 1 blob {} left out
cylint-convert: 1 cylinder {} left out: inside blob {}
cylint-convert: 1 cylinder {} left out: without length
cylint-convert: 1 cylinder {} left out: with a negative radius'
    # each alone is refused without --skip, or left out with it
    for transform in 'translate x' 'rotate 90*x' 'scale <1, 2, 1>' \
        'matrix <1,0,0, 0,1,0, 0,0,1, 0,0,0>' 'transform T' \
        'transform { T }' 'Move(1)' '#if (Q) translate x #end'; do
        for place in "cylinder { 0, y, 1 $transform }" \
            "union { cylinder { 0, y, 1 } $transform }" \
            "object { cylinder { 0, y, 1 } $transform }" \
            "merge { $transform union { cylinder { 0, y, 1 } } }"; do
            echo "$place" > "$scratch/in"
            tools/convert/pov2scene "$scratch/in" > "$scratch/out" \
                2> "$scratch/messages"
            [ $? -eq 1 ] && [ ! -s "$scratch/out" ] &&
                grep -q 'skip leaves such shapes out$' "$scratch/messages" &&
                $pov "$scratch/in" > "$scratch/out" 2> "$scratch/messages" &&
                [ ! -s "$scratch/out" ] &&
                grep -q '1 cylinder {} left out' "$scratch/messages"
            verdict "$AWK: pov_never_misplaces: $place" $?
        done
    done
}

with_each_awk test_pov test_pov_numbers test_pov_skip
check_end
