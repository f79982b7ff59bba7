#!/bin/sh
# Floor tools: cylint-convert makes round shapes where it is asked to, of neurons,
# molecules and trees, and of POV-Ray's spheres.  All tests run with each awk
# found.
. "$(dirname "$0")/../support/verdict.sh"
. "$(dirname "$0")/converts.sh"
data=../shared/data
remedy='; --skip leaves such shapes out'

test_swc()
{
    swc='tools/convert/swc2scene --swc=round'
    input '1 1 0 0 0.50 2 -1\n2 3 0 0 1e1 1.0 1\n3 3 0 1 10 0 2\n'
    expect 'sphere 0 0 0.50 2 1\nrcone 0 0 1e1 1.0 0 0 0.50 2 2\nrcone 0 1 10 0 0 0 1e1 1.0 3\n'
    gives swc_gives_rounded_cones_and_a_sphere_at_the_root $swc
    expect 'cone 0 0 1e1 1.0 0 0 0.50 2 2\ncone 0 1 10 0 0 0 1e1 1.0 3\n'
    gives swc_cones_are_the_default tools/convert/swc2scene
    gives swc_cones_may_be_asked_for tools/convert/swc2scene --swc=cones
    input '7 1 1 2 3 4 -1\n'
    expect 'sphere 1 2 3 4 7\n'
    gives swc_a_soma_of_one_point_gives_a_sphere $swc
    input '1 1 0 0 0 0 -1\n2 3 0 0 0 2 1\n3 3 0 0 0 1 2\n4 3 0 0 5 0 1\n5 3 9 9 9 1 77\n'
    expect 'rcone 0 0 0 2 0 0 0 0 2\nrcone 0 0 0 1 0 0 0 2 3\nsphere 9 9 9 1 5\n'
    gives swc_edges_without_length_are_balls $swc
    says swc_what_has_no_radius_is_counted "cylint-convert: 1 node with a parent that is not in the file taken as a root
cylint-convert: 1 edge of no radius skipped
cylint-convert: 1 root of no radius skipped"
    refuses_with 2 swc_names_its_forms \
        "cylint-convert: swc: expected --swc=cones or --swc=round, found '--swc=oval'; see cylint-convert --help" \
        tools/convert/swc2scene --swc=oval
    input '1 1 0 0 0 2 -1\n2 3 0 0 1 -1 1\n'
    refuses swc_names_file_and_line \
        "cylint-convert: -:2: negative radius: '-1'" $swc
}

test_qsm()
{
    qsm=tools/convert/qsm2scene
    input 'ID,radius,startX,startY,startZ,endX,endY,endZ\n7,.5,1,2,3,1,2,4\n8,.5,1,2,4,1,2,4\n9,0,1,2,4,1,2,5\n'
    expect 'capsule 1 2 3 1 2 4 .5 7\ncapsule 1 2 4 1 2 4 .5 8\n'
    gives qsm_gives_capsules_which_may_have_no_length $qsm --round
    says qsm_capsules_without_radius_are_counted \
        'cylint-convert: 1 cylinder of no radius skipped'
    expect 'cylinder 1 2 3 1 2 4 .5 7\n'
    gives qsm_cylinders_are_the_default $qsm
    input '0.5 2 1 2 3 0 0 1\n'
    expect 'capsule 1 2 3 1 2 5 0.5 1\n'
    gives qsm_of_treeqsm_may_be_round $qsm -t --round
    refuses_with 2 pov_is_not_asked_for_round_joints \
        "cylint-convert: pov: unknown option --round; see cylint-convert --help" \
        tools/convert/pov2scene --round
}

# atom SERIAL NAME X ELEMENT: one PDB line.
atom()
{
    printf 'ATOM  %5s %-4s GLY A   1    %8s   0.000   0.000  1.00  0.00          %2s\n' \
        "$@"
}

test_molecule()
{
    pdb=tools/convert/pdb2scene
    { atom 1 ' CA' 0.000 C; atom 2 ' N' 1.500 N
      atom 3 ZN 9.000 ZN; } > "$scratch/in"
    expect 'sphere 0.000 0.000 0.000 0.425 1
sphere 1.500 0.000 0.000 0.3875 2
cylinder 0.000 0.000 0.000 1.500 0.000 0.000 0.15 1-2
sphere 9.000 0.000 0.000 0.5975 3
'
    gives pdb_balls_are_a_fraction_of_the_van_der_waals_radius $pdb -b 0.25
    expect 'sphere 0.000 0.000 0.000 1.7 1\nsphere 1.500 0.000 0.000 1.55 2\nsphere 9.000 0.000 0.000 2.39 3\n'
    gives pdb_balls_may_be_without_bonds $pdb -b 1 -r 0
    cat > "$scratch/in" <<'CIF'
data_TWO
loop_
_atom_site.id
_atom_site.type_symbol
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
1 C 0.0 0 0
2 N 1.5 0 0
3 Zn 9.0 0 0
CIF
    expect 'sphere 0.0 0 0 1.7 1\nsphere 1.5 0 0 1.55 2\nsphere 9.0 0 0 2.39 3\n'
    gives mmcif_has_the_balls_of_pdb $pdb -b 1 -r 0
    for wrong in 0 -1 big nan 1e999; do
        refuses_with 2 "pdb_refuses_a_fraction_of_$wrong" \
            "cylint-convert: -b: expected a positive number, found '$wrong'" \
            $pdb -b $wrong
    done
    refuses_with 2 pdb_refuses_a_fraction_that_makes_balls_too_large \
        "cylint-convert: -b: number too large: '1.5e308'" $pdb -b 1.5e308
    refuses_with 2 pdb_refuses_to_make_nothing \
        "cylint-convert: -r: expected a positive number, found '0'" $pdb -r 0
    refuses_with 2 pdb_refuses_a_negative_stick_beside_balls \
        "cylint-convert: -r: expected a positive number or 0, found '-1'" \
        $pdb -b 1 -r -1
    refuses_with 2 pdb_fraction_needs_a_value \
        'cylint-convert: pdb: option -b needs a value; see cylint-convert --help' \
        $pdb -b
    test_elements
}

# Every element that has a covalent radius has a van der Waals radius, which is
# larger; all are accepted.
test_elements()
{
    elements=$(sed -n '/read_radii("H/,/covalent)/p' tools/convert/bonds.awk |
        grep -Eo '[A-Z]+ [0-9]' | cut -d ' ' -f 1)
    x=0
    for element in $elements; do
        x=$((x + 10))
        atom $x X $x.000 "$element"
    done > "$scratch/in"
    $pdb -b 1 -r 0 "$scratch/in" > "$scratch/out" 2> "$scratch/messages" &&
        [ "$(wc -l < "$scratch/out")" -eq "$(echo $elements | wc -w)" ] &&
        [ "$(wc -l < "$scratch/out")" -ge 34 ] &&
        $AWK '!($5 > 1 && $5 < 3) { exit 1 }' "$scratch/out"
    verdict "$AWK: pdb_every_element_has_its_ball" $?
}

test_pov()
{
    pov=tools/convert/pov2scene
    cat > "$scratch/in" <<'POV'
#declare N = 3; #declare P = <6, 8, 0>;
sphere { <1, 2, 3>, 4.0 pigment { color rgb 1 } }
union { sphere { 0, 1/2 } }
sphere_sweep {
  linear_spline N, <0, 0, 0>, 2, P, 1
  0, 0.5 tolerance 0.1
}
sphere_sweep { linear_spline 2 x 1 x 2 }
blob { threshold 1 }
isosurface { function { x } contained_by { sphere { 0, 2 } } }
POV
    expect 'sphere 1 2 3 4.0 2
sphere 0 0 0 0.5 3
rcone 0 0 0 2 6 8 0 1 4
rcone 6 8 0 1 0 0 0 0.5 4
rcone 1 0 0 1 1 0 0 2 8
'
    gives pov_spheres_and_linear_sweeps_are_converted $pov
    while IFS='|' read -r name shape message; do
        echo "$shape" > "$scratch/in"
        refuses "pov_refuses_$name" "cylint-convert: -:1: $message$remedy" $pov
    done <<'SHAPES'
an_ellipsoid|sphere { 0, 1 scale <1,2,1> }|sphere: transformed
a_negative_sphere|sphere { 0, -1 }|sphere: with a negative radius
a_point|sphere { 0, 0 }|sphere: without radius
a_line|sphere_sweep { linear_spline 3, 0, 1, x, 0, y, 0 }|sphere_sweep: without radius
a_negative_sweep|sphere_sweep { linear_spline 2, 0, 1, x, -1 }|sphere_sweep: with a negative radius
a_curve|sphere_sweep { b_spline 4, 0, 1, x, 1, y, 1, z, 1 }|sphere_sweep: not of linear type
one_sphere_swept|sphere_sweep { linear_spline 1, 0, 1 }|expected a whole number above 1 before this, found ','
half_a_sphere_swept|sphere_sweep { linear_spline 2.5, 0, 1, x, 1 }|expected a whole number above 1 before this, found ','
too_few_spheres|sphere_sweep { linear_spline 3, 0, 1, x, 1 }|expected a number, found '}'
too_many_spheres|sphere_sweep { linear_spline 2, 0, 1, x, 1, y, 1 }|expected the end of a number, found ','
a_part_of_a_blob|blob { sphere { 0, 1, 1 } }|sphere: inside blob {}
a_declared_sphere|#declare S = sphere { 0, 1 }|sphere: only declared
SHAPES
    cat > "$scratch/in" <<'POV'
sphere_sweep { cubic_spline 4, 0, 1, x, 1, y, 1, z, 1 }
sphere_sweep { linear_spline 2, 0, R, x, 1 }
sphere { 0, 1 } sphere { 0, 1 rotate x }
POV
    expect 'sphere 0 0 0 1 3\n'
    gives pov_skip_leaves_out_round_shapes $pov --skip
    says pov_skip_counts_round_shapes 'cylint-convert: 1 sphere_sweep {} left out: not of linear type
cylint-convert: 1 sphere_sweep {} left out: with numbers that are not understood
cylint-convert: 1 sphere {} left out: transformed'
}

test_real_files()
{
    accepted swc_109228_rounded_cones_of_24_neurons $((109228 + 27)) \
        $data/medulla_top24.swc tools/convert/swc2scene --swc=round
    accepted pdb_a_protease_has_1922_sticks_and_1890_balls $((1922 + 1890)) \
        $data/1hvr.pdb tools/convert/pdb2scene -b 0.25
    accepted pdb_a_protease_has_1890_van_der_waals_balls 1890 \
        $data/1hvr.pdb tools/convert/pdb2scene -b 1 -r 0
    accepted qsm_a_tree_has_1231_capsules 1231 \
        $data/tree_archi.csv tools/convert/qsm2scene --round
}

with_each_awk test_swc test_qsm test_molecule test_pov
if [ -d $data ]; then
    with_each_awk test_real_files
else
    echo "note: no $data, the tests on real files are left out"
fi
check_end
