#!/bin/sh
# Floor tools: cylint-convert swc, qsm and pdb convert small files to the expected
# scenes and refuse invalid lines; they convert real files where ../shared/data
# has them.  All tests run with each awk found.
. "$(dirname "$0")/../support/verdict.sh"
. "$(dirname "$0")/converts.sh"
data=../shared/data

test_swc()
{
    swc=tools/convert/swc2scene
    input '# neuron\n1 1 0 0 0.50 2 -1\n 2 3 0 0 1e1 1.0 1\n\n3 3 0 1 10 0 2\n'
    expect 'cone 0 0 1e1 1.0 0 0 0.50 2 2\ncone 0 1 10 0 0 0 1e1 1.0 3\n'
    gives swc_gives_a_frustum_from_node_to_parent $swc
    input '2 3 0 0 4 1 1\r\n1 1 0 0 0 2 -1\r\n'
    expect 'cone 0 0 4 1 0 0 0 2 2\n'
    gives swc_parents_may_follow_and_lines_may_end_in_cr_lf $swc
    input '\357\273\2771 1 0 0 0 2 -1\n2 3 0 0 4 1 1'
    gives swc_may_begin_with_a_mark_and_end_without_a_newline $swc
    input '1 1 0 0 0 1 -1\n2 0 0.0 0 0 2 1\n3 0 -0 0e5 0 2 2\n4 0 0 0 1 0 3\n5 0 0 0 2 0 4\n'
    expect 'cone 0 0 1 0 -0 0e5 0 2 4\n'
    gives swc_edges_that_bound_nothing_are_left_out $swc
    says swc_edges_left_out_are_counted "cylint-convert: 2 edges of no length skipped
cylint-convert: 1 edge of no radius skipped"
    input '1 1 0 0 0 2 -1\n'
    expect ''
    gives swc_a_root_alone_gives_nothing $swc

    cp "$scratch/in" "$scratch/a.swc"
    printf '1 1 5 5 5 1 -1\n2 1 5 5 6 1 1\n' > "$scratch/b.swc"
    expect 'cone 5 5 6 1 5 5 5 1 2\n'
    gives swc_files_number_their_nodes_apart $swc "$scratch/a.swc" \
        "$scratch/b.swc"
    printf '1 1 5 5 5 1 -1\n2 1 5 5 6 1 x\n' > "$scratch/b.swc"
    refuses swc_names_file_and_line \
        "cylint-convert: $scratch/b.swc:2: expected a node's number or -1, found 'x'" \
        $swc "$scratch/a.swc" "$scratch/b.swc"
    test_swc_as_found
    input '1 1 0 0 0 2 -1\n2 1 0 abc 0 2 1\n'
    refuses swc_refuses_what_is_no_number \
        "cylint-convert: -:2: expected a number, found 'abc'" $swc
    input '1 1 0 0 1e999 2 -1\n'
    refuses swc_refuses_overflow \
        "cylint-convert: -:1: number too large: '1e999'" $swc
    input '1 1 0 0 nan 2 -1\n'
    refuses swc_refuses_nan \
        "cylint-convert: -:1: expected a number, found 'nan'" $swc
    input '1 1 0 0 0x10 2 -1\n'
    refuses swc_refuses_hexadecimal \
        "cylint-convert: -:1: expected a number, found '0x10'" $swc
    input '1 1 0 0 0 2\n'
    refuses swc_refuses_short_lines \
        "cylint-convert: -:1: expected a node's number or -1, found the end of the line" $swc
    input '1 1 0 0 0 -2 -1\n'
    refuses swc_refuses_negative_radii \
        "cylint-convert: -:1: negative radius: '-2'" $swc
    input '1 1 0 0 0 2 -1\n1 1 0 0 3 2 -1\n'
    refuses swc_refuses_a_node_given_twice \
        "cylint-convert: -:2: this node was given before: '1'" $swc
    input '1 1 0 0 0 2 -1\n2 1 0 0 9 2 1\n3 1 0 0 9 2 5\n4 1 0 0 9 2 3\n5 1 0 0 9 2 4\n'
    refuses swc_refuses_a_cycle_where_it_begins \
        "cylint-convert: -:3: the parents of node 3 lead back to it" $swc
    input '1 1 0 0 0 2 -1\n2 1 0 0 9 2 2\n'
    refuses swc_refuses_a_node_that_is_its_parent \
        "cylint-convert: -:2: node 2 is its own parent" $swc
    refuses_with 3 swc_fails_on_a_missing_file \
        "cylint-convert: $scratch/a=b.swc: cannot be read" $swc "$scratch/a=b.swc"
}

# What other programs write: decimal ids, commas, CR, parents left out.
test_swc_as_found()
{
    expect 'cone 0 0 4 1 0 0 0 2 2\ncone 0 0 9 1 0 0 4 1 10\n'
    input '1.0 1 0 0 0 2 -1.0\n2.0 3. 0 0 4 1 1.0\n10. 3 0 0 9 1 2e0\n'
    gives swc_ids_may_be_decimal $swc
    input '1,1,0,0,0,2,-1\n2 , 3 , 0 , 0 , 4 , 1 , 1,\n10\t3,0 0,9 1,2\n'
    gives swc_fields_may_be_separated_by_commas $swc
    input '# mac\r1 1 0 0 0 2 -1\r\r2 3 0 0 4 1 1\r10 3 0 0 9 1 2'
    gives swc_lines_may_end_in_cr $swc
    input '1 1 0 0 0 2 -1\r2 3 0 0 4 1 x\r\n'
    refuses swc_lines_that_end_in_cr_are_counted \
        "cylint-convert: -:2: expected a node's number or -1, found 'x'" $swc
    input '1 1 0 0 0 2 0\n2 3 0 0 4 1 1\n10 3 0 0 9 1 2\n11 3 9 9 9 1 12\n'
    gives swc_a_parent_that_is_not_in_the_file_makes_a_root $swc
    says swc_parents_that_are_not_in_the_file_are_counted \
        "cylint-convert: 2 nodes with a parent that is not in the file taken as roots"
    input '1 1,,0 0 0 2 -1\n'
    refuses swc_refuses_a_comma_too_many \
        "cylint-convert: -:1: expected a number, found ','" $swc
    input '1.5 1 0 0 0 2 -1\n'
    refuses swc_refuses_ids_that_are_not_whole \
        "cylint-convert: -:1: expected a node's number, found '1.5'" $swc
    input '1 1 0 0 0 nan -1\n'
    refuses swc_refuses_a_radius_that_is_nan \
        "cylint-convert: -:1: expected a number, found 'nan'" $swc
}

test_qsm()
{
    qsm=tools/convert/qsm2scene
    input '"cyl_ID","startX","startY","startZ","endX","endY","endZ","radius_cyl"\n7,1,2,3.10,1,2,4,0.50\n'
    expect 'cylinder 1 2 3.10 1 2 4 0.50 7\n'
    gives qsm_reads_archi_tables $qsm
    input 'ID;parentID;radius;start_x;start_y;start_z;end_x;end_y;end_z\n7;0;0.50;1;2;3.10;1;2;4\n'
    gives qsm_finds_columns_by_name $qsm
    input 'radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z\n.5,2,1,2,3,0,0,1\n.5,0,1,2,3,0,0,1\n0,1,1,2,3,0,0,1\n'
    expect 'cylinder 1 2 3 1 2 5 .5 1\n'
    gives qsm_takes_axis_and_length_for_the_end $qsm
    says qsm_cylinders_left_out_are_counted \
        "cylint-convert: 1 cylinder of no length skipped
cylint-convert: 1 cylinder of no radius skipped"
    input '0.5\t2\t1\t2\t3\t0\t0\t1\t0\t2\t1\n0.4\t0.1\t1\t2\t3\t1\t0\t0\t1\t0\t1\n'
    expect 'cylinder 1 2 3 1 2 5 0.5 1\ncylinder 1 2 3 1.1000000000000001 2 3 0.4 2\n'
    gives qsm_reads_treeqsm_text $qsm -t
    input 'radius,startX,startY\n1,2,3\n'
    refuses qsm_names_the_column_it_misses \
        "cylint-convert: -:1: the header names no column 'startz'" $qsm
    input 'radius,startX,startY,startZ,endX,endY,endZ\n1,2,3,4,5,6\n'
    refuses qsm_refuses_short_lines \
        "cylint-convert: -:2: expected 7 fields, found 6" $qsm
    input 'radius;startX;startY;startZ;endX;endY;endZ\n1;2;3;4;5;6;7\n0,5;2;3;4;5;6;7\n'
    refuses qsm_refuses_decimal_commas \
        "cylint-convert: -:3: expected a number for radius, found '0,5'" $qsm
}

# atom SERIAL NAME ALT X Y Z ELEMENT: one PDB line.
atom()
{
    printf 'ATOM  %5s %-4s%1sGLY A   1    %8s%8s%8s  1.00  0.00          %2s\n' \
        "$@"
}

test_pdb()
{
    pdb=tools/convert/pdb2scene
    { echo 'HEADER    TEST'
      atom 1 ' CA' '' 0.000 0.000 0.000 C
      atom 2 ' CB' '' 1.540 0.000 0.000 C
      atom 3 ' O' '' 3.060 0.000 0.000 O
      atom 4 ' HA' '' 0.000 1.100 0.000 H
      atom 5 ' HB' '' 0.700 1.100 0.000 H
      atom 6 ' S' '' -9.000 0.000 0.000 S; } > "$scratch/in"
    expect 'cylinder 0.000 0.000 0.000 1.540 0.000 0.000 0.15 1-2
cylinder 1.540 0.000 0.000 3.060 0.000 0.000 0.15 2-3
cylinder 0.000 0.000 0.000 0.000 1.100 0.000 0.15 1-4
cylinder 0.000 0.000 0.000 0.700 1.100 0.000 0.15 1-5
cylinder 1.540 0.000 0.000 0.700 1.100 0.000 0.15 2-5
'
    gives pdb_bonds_by_distance_but_no_two_hydrogens $pdb
    sed 's/0\.15/2e-1/' "$scratch/expected" > "$scratch/with_radius"
    mv "$scratch/with_radius" "$scratch/expected"
    gives pdb_radius_is_an_option $pdb -r 2e-1
    { atom 1 ' C' A 0.000 0.000 0.000 C
      atom 2 ' C' B 0.500 0.000 0.000 C
      atom 3 'CL' A -1.700 0.000 0.000 ''
      echo ENDMDL
      atom 4 ' C' '' 0.000 1.500 0.000 C; } > "$scratch/in"
    expect 'cylinder 0.000 0.000 0.000 -1.700 0.000 0.000 0.15 1-3\n'
    gives pdb_takes_one_location_and_the_first_model $pdb
    atom 1 ' C' '' 0.000 oops 0.000 C > "$scratch/in"
    refuses pdb_refuses_what_is_no_number \
        "cylint-convert: -:1: expected a number in columns 39 to 46, found 'oops'" \
        $pdb
    atom 1 'XX' '' 0.000 0.000 0.000 XX > "$scratch/in"
    refuses pdb_refuses_elements_without_radius \
        "cylint-convert: -:1: no covalent radius is known for 'XX'" $pdb
    refuses_with 2 pdb_refuses_a_negative_stick \
        "cylint-convert: -r: expected a positive number, found '-1'" $pdb -r -1
    echo hello > "$scratch/hello.txt"
    refuses pdb_refuses_a_file_without_atoms \
        "cylint-convert: $scratch/hello.txt: no atom was found" $pdb \
        "$scratch/hello.txt"
    refuses pdb_refuses_an_empty_file \
        'cylint-convert: /dev/null: no atom was found' $pdb /dev/null
}

# twin: mmCIF of a PDB file's atoms, its columns in another order.
twin()
{
    $AWK '
    BEGIN {
        print "data_TWIN\nloop_\n_atom_site.group_PDB\n_atom_site.Cartn_z"
        print "_atom_site.Cartn_y\n_atom_site.Cartn_x\n_atom_site.label_alt_id"
        print "_atom_site.auth_asym_id\n_atom_site.auth_seq_id"
        print "_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id"
        print "_atom_site.pdbx_PDB_model_num"
        model = 1
    }
    /^ENDMDL/ { model++ }
    /^(ATOM  |HETATM)/ {
        alternate = substr($0, 17, 1)
        sub(/ /, ".", alternate)
        name = substr($0, 13, 4)
        gsub(/ /, "", name)
        print substr($0, 1, 6), substr($0, 47, 8), substr($0, 39, 8),
              substr($0, 31, 8), alternate, substr($0, 22, 1),
              substr($0, 23, 4), substr($0, 7, 5), substr($0, 77, 2),
              "\"" name "\"", model
    }' "$1"
}

test_mmcif()
{
    pdb=tools/convert/pdb2scene
    { atom 1 " C1'" '' 0.000 0.000 0.000 C
      atom 2 ' CB' A 1.540 0.000 0.000 C
      atom 3 ' CB' B 1.500 0.300 0.000 C
      atom 4 ' O' '' 3.060 0.000 0.000 O
      echo ENDMDL
      atom 5 ' C' '' 0.000 1.500 0.000 C; } > "$scratch/two.pdb"
    twin "$scratch/two.pdb" > "$scratch/in"
    $pdb "$scratch/two.pdb" > "$scratch/expected" &&
        [ "$(wc -l < "$scratch/expected")" -eq 2 ]
    verdict "$AWK: pdb_twin_has_two_bonds" $?
    gives mmcif_gives_the_scene_of_its_pdb_twin $pdb
    cat > "$scratch/in" <<'CIF'
# a comment, then a blank line

data_1ABC
_entry.id   1ABC
_struct.title   'An atom''s   title with _atom_site.id, loop_ and # in it'
_struct.details
;loop_
_atom_site.Cartn_x
 9.9 data_NONE
; _cell.length_a 10.0
loop_
_entity.id
_entity.description
1 "a 'quoted' name"
2 'it's one'
#
LOOP_
_Atom_Site.group_PDB _atom_site.id _atom_site.type_symbol
_atom_site.label_atom_id
_atom_site.label_alt_id
_atom_site.label_comp_id _atom_site.label_asym_id _atom_site.label_seq_id
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
_atom_site.pdbx_PDB_model_num
ATOM   11 C "C1'" . U A 1 0.000
  0.000 0.000 1
ATOM   12 C 'C2"' ? U A 1
; 1.50
;
(3) 0 1
CIF
    # A text keeps its blanks, so this is not a number.
    refuses mmcif_reads_texts_and_quotes \
        "cylint-convert: -:31: expected a number for _atom_site.Cartn_x, found ' 1.50'" \
        $pdb
    sed -e 's/^; 1.50/;1.50(2)/' -e 's/^(3) 0 1/0.0 -0 1 ATOM/' "$scratch/in" > "$scratch/cif"
    cat >> "$scratch/cif" <<'CIF'
13 O "O1'" A U A 1 1.500 1.4e0 0.000 1 ATOM 14 O "O1'" B U A 1 1.500 1.3 0.000 1
ATOM 15 ? "O5'" . U A 1 2.9 0 0.000 1
HETATM 16 C C . U A 1 0.000 1.000 0.000 2
_atom_site_anisotrop.id 3
data_2ABC
loop_
_atom_site.id
_atom_site.type_symbol
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
21 C 0 0 1.5
CIF
    mv "$scratch/cif" "$scratch/in"
    expect 'cylinder 0.000 0.000 0.000 1.50 0.0 -0 0.15 11-12
cylinder 1.50 0.0 -0 1.500 1.4e0 0.000 0.15 12-13
cylinder 1.50 0.0 -0 2.9 0 0.000 0.15 12-15
'
    gives mmcif_takes_loops_over_lines_one_location_the_first_model_and_block $pdb
    input 'data_X\nloop_\n_atom_site.id\n_atom_site.Cartn_x\n1 2.0 3\n'
    refuses mmcif_refuses_half_a_row \
        "cylint-convert: -:5: expected a number for _atom_site.Cartn_y, found ''" $pdb
    input 'data_X\nloop_\n_cell.id\n_cell.x\n1 2.0 3\nloop_\n'
    refuses mmcif_refuses_a_loop_that_ends_within_a_row \
        'cylint-convert: -:6: the loop ends within a row: 1 of 2 values' $pdb
    input 'data_X\n_cell.id\n;text\nloop_\n'
    refuses mmcif_refuses_a_text_without_an_end \
        'cylint-convert: -:3: the text that begins here has no end' $pdb
    input 'data_X\n_cell.id "text\nloop_\n'
    refuses mmcif_refuses_a_quote_without_an_end \
        "cylint-convert: -:2: expected the quote that ends the value, found '\"text'" $pdb
    input 'data_X\n_cell.id 3\n'
    refuses mmcif_refuses_a_file_without_atoms \
        'cylint-convert: -: no atom was found' $pdb
    input 'data_X\n_atom_site.id 3\n_atom_site.Cartn_x 1\n_atom_site.Cartn_y 1\n_atom_site.Cartn_z 1\n_atom_site.type_symbol C\n'
    expect ''
    gives mmcif_one_atom_may_stand_without_a_loop $pdb
    input 'data_X\n_atom_site.id 3\n_atom_site.Cartn_x A\n_cell.x 1\n'
    refuses mmcif_one_atom_is_read_without_a_loop \
        "cylint-convert: -:4: expected a number for _atom_site.Cartn_x, found 'A'" $pdb
}

# Rays from a corner of the scene's box of axis ends to points within it,
# by the low-discrepancy steps of the plastic number.
rays_through()
{
    $AWK -v rays="$2" '
    { for (i = 0; i < 3; i++) {
          if (NR == 1 || $(2 + i) < low[i]) low[i] = $(2 + i)
          if (NR == 1 || $(2 + i) > high[i]) high[i] = $(2 + i)
      } }
    END {
        step[0] = 0.8191725134; step[1] = 0.6710436067; step[2] = 0.5497004779
        for (n = 1; n <= rays; n++) {
            line = "ray " low[0] - 100 " " low[1] - 100 " " low[2] - 100
            for (i = 0; i < 3; i++) {
                f = n * step[i]
                f -= int(f)
                line = line sprintf(" %.6f",
                                    100 + f * (high[i] - low[i]))
            }
            print line, n
        }
    }' "$1"
}

test_real_files()
{
    accepted swc_all_109228_frusta_of_24_neurons_are_accepted 109228 \
        $data/medulla_top24.swc tools/convert/swc2scene
    accepted pdb_1922_sticks_of_a_protease_are_accepted 1922 \
        $data/1hvr.pdb tools/convert/pdb2scene
    twin $data/1hvr.pdb > "$scratch/1hvr.cif"
    accepted mmcif_1922_sticks_of_its_twin_are_accepted 1922 \
        "$scratch/1hvr.cif" tools/convert/pdb2scene
    tools/convert/pdb2scene $data/1hvr.pdb | cmp - "$scratch/scene"
    verdict "$AWK: mmcif_gives_the_scene_of_a_real_pdb_file" $?
    accepted qsm_1231_cylinders_of_a_tree_are_accepted 1231 \
        $data/tree_archi.csv tools/convert/qsm2scene
}

# 10,000 rays at the largest neuron: no error, and some, not all, must hit.
test_scan_of_a_neuron()
{
    tools/convert/swc2scene $data/medulla_7114.swc > "$scratch/scene" &&
        rays_through "$scratch/scene" 10000 > "$scratch/rays" &&
        "$build/cylint" -s "$scratch/scene" "$scratch/rays" \
            > "$scratch/out" 2> "$scratch/messages" &&
        [ ! -s "$scratch/messages" ] &&
        [ "$(wc -l < "$scratch/out")" -eq 10000 ] &&
        $AWK '$1 > 0 { hits++ } $NF != NR { wrong++ }
              END { exit !(hits > 100 && hits < 9900 && !wrong) }' \
            "$scratch/out"
    verdict "$AWK: ten_thousand_rays_at_a_neuron_are_answered" $?
}

with_each_awk test_swc test_qsm test_pdb test_mmcif
if [ -d $data ]; then
    with_each_awk test_real_files
    AWK=awk test_scan_of_a_neuron
else
    echo "note: no $data, the tests on real files are left out"
fi
check_end
