"""Molecules and trees.  convert.txt has `python -m libcylint convert`."""

import gzip
import re
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import libcylint as cylint

TOP = Path(__file__).parents[2]
DATA = TOP.parent / "shared" / "data"


def atom(number, name, x, y, z, element="", *, alt="", residue="GLY A   1"):
    """A line of PDB.  x, y, z: text or numbers."""
    at = "".join(f"{v:8}" if isinstance(v, str) else f"{v:8.3f}" for v in (x, y, z))
    return (
        f"ATOM  {number:5d} {name:4}{alt:1}{residue:10}   {at}  1.00  0.00"
        f"          {element:>2}\n"
    )


def twin(pdb):
    """mmCIF of a PDB file's atoms, its columns in another order."""
    rows, model = [], 1
    for line in pdb.splitlines():
        model += line.startswith("ENDMDL")
        if line.startswith(("ATOM  ", "HETATM")):
            name, alt = line[12:16].strip(), line[16].strip() or "."
            element = line[76:78].strip() or name[:1]
            rows.append(
                f"{line[:6]} {line[46:54]} {line[38:46]} {line[30:38]} {alt} "
                f"{line[21]} {line[22:26]} {line[17:20]} {line[6:11]} {element} "
                f'"{name}" {model} {line[21]} . 1 0'
            )
    names = (
        "group_PDB Cartn_z Cartn_y Cartn_x label_alt_id auth_asym_id auth_seq_id "
        "label_comp_id id type_symbol label_atom_id pdbx_PDB_model_num "
        "label_asym_id label_seq_id occupancy B_iso_or_equiv"
    ).split()
    heads = "\n".join("_atom_site." + name for name in names)
    return f"data_TWIN\nloop_\n{heads}\n" + "\n".join(rows) + "\n"


def reader(function):
    """A fixture that reads a text as a file."""

    @pytest.fixture
    def fixture(tmp_path):
        def read(text, **options):
            path = tmp_path / "file"
            path.write_text(text)
            return function(path, **options)

        return read

    return fixture


molecule, tree = reader(cylint.read_molecule), reader(cylint.read_qsm)


CHAIN = (
    atom(1, " CA", 0, 0, 0, "C")
    + atom(2, " CB", 1.54, 0, 0, "C")
    + atom(3, " O", 3.06, 0, 0, "O")
    + atom(4, " HA", 0, 1.1, 0, "H")
    + atom(5, " HB", 0.7, 1.1, 0, "H")
    + atom(6, " SG", -9, 0, 0, "S", residue="CYS B  45A")
)


@pytest.mark.parametrize("form", [str, twin])
def test_bonds_are_by_distance_but_not_of_two_hydrogens(molecule, form):
    text = CHAIN.replace("45A", "45 ") if form is twin else CHAIN  # no insertion code
    sticks = molecule(form(text))
    want = ["CA--CB", "CA--HA", "CA--HB", "CB--O", "CB--HB"]
    assert [re.sub("A:1:GLY:", "", x) for x in sticks.labels] == want
    assert sticks.p0[3].tolist() == [1.54, 0, 0]
    assert sticks.p1[3].tolist() == [3.06, 0, 0]
    assert (sticks.r == 0.15).all() and (sticks.kind == cylint.Kind.CYLINDER).all()
    assert (molecule(CHAIN, stick=0.25).r == 0.25).all()


def test_bonds_end_exactly_at_their_limits(molecule):
    """0.4 angstrom, and the sum of the covalent radii and 0.45."""
    for distance, bonded in ((0.399, 0), (0.4, 1), (1.91, 1), (1.911, 0)):
        text = atom(1, " C1", 0, 0, 0, "C") + atom(2, " C2", distance, 0, 0, "C")
        far = atom(3, " C3", 90, 0, 0, "C") + atom(4, " C4", 91, 0, 0, "C")
        assert len(molecule(text + far)) == 1 + bonded, distance


def test_balls_are_a_fraction_of_the_van_der_waals_radius(molecule):
    text = CHAIN + atom(7, "ZN", 20, 0, 0, "ZN", residue=" ZN A 301")
    balls = molecule(text, stick=0, ball=1)
    radii = [1.7, 1.7, 1.52, 1.2, 1.2, 1.8, 1.39]
    assert balls.r.tolist() == radii and balls.c[2].tolist() == [3.06, 0, 0]
    assert balls.labels.tolist() == [
        "A:1:GLY:CA", "A:1:GLY:CB", "A:1:GLY:O", "A:1:GLY:HA", "A:1:GLY:HB",
        "B:45A:CYS:SG", "A:301:ZN:ZN:Zn",
    ]
    both = molecule(text, ball=0.25)
    assert len(both) == 7 + 5 and both.r[0] == 0.25 * 1.7
    assert both.kind[:7].tolist() == [cylint.Kind.SPHERE] * 7


def test_labels_show_the_element_where_the_name_does_not(molecule):
    names = [(" CA", "C"), ("CA", "CA"), ("1HB", "H"), ("SE", "SE"), ("CL1", "CL")]
    text = "".join(
        atom(i, name, 5 * i, 0, 0, element, residue=f"GLY A   {i}")
        for i, (name, element) in enumerate(names)
    )
    labels = molecule(text, stick=0, ball=1).labels
    ends = [re.sub("A:.:GLY:", "", label) for label in labels]
    assert ends == ["CA", "CA:Ca", "1HB", "SE:Se", "CL1:Cl"]


@pytest.mark.parametrize("form", [str, twin])
def test_the_first_location_and_the_first_model_are_read(molecule, form):
    text = (
        "MODEL        1\n"
        + atom(1, " C", 0, 0, 0, "C", alt="A")
        + atom(2, " C", 0.5, 0, 0, "C", alt="B")
        + atom(3, "CL", -1.7, 0, 0, "CL", alt="A")
        + "ENDMDL\nMODEL        2\n"
        + atom(4, " C", 0, 1.5, 0, "C")
        + "ENDMDL\n"
    )
    sticks = molecule(form(text))
    assert len(sticks) == 1
    assert sorted([*sticks.p0[:, 0], *sticks.p1[:, 0]]) == [-1.7, 0]


@pytest.mark.parametrize("form", [str, twin])
def test_alternate_are_atoms_with_a_letter_alone(molecule, form):
    """Not atoms of one name, as Open Babel writes them, or residues of one number, as
    after 9999.  A residue with letters can be the alternate of another one."""
    text = "".join(
        atom(i, name, 5 * i, 0, 0, name.strip()[0], alt=alt, residue=residue)
        for i, (name, alt, residue) in enumerate((
            (" C", "", "UNL A   1"), (" C", "", "UNL A   1"), (" O", "", "ION A   1"),
            (" N", "A", "SER A   2"), (" N", "B", "THR A   2"), (" CB", "B", "THR A   2"),
        ))  # fmt: skip
    )
    assert molecule(form(text), stick=0, ball=1).c[:, 0].tolist() == [0, 5, 10, 15]


def test_symmetric_copies_are_not_bonded(molecule):
    cell = "CRYST1    3.000    3.000    3.000  90.00  90.00  90.00 P 1           1\n"
    text = atom(1, " C1", 0.2, 0, 0, "C") + atom(2, " C2", 2.7, 0, 0, "C")
    assert len(molecule(cell + text)) == 0


def test_atoms_may_be_far_from_all_others(molecule):
    """9999 stands for an unknown place in some files."""
    for far in (9999, "1e300", "-1e300"):
        assert len(molecule(CHAIN + atom(9, " C", far, far, far, "C"))) == 5


def test_a_compressed_file_is_read(tmp_path):
    path = tmp_path / "molecule.pdb.gz"
    packed = gzip.compress(CHAIN.encode())
    path.write_bytes(packed)
    assert len(cylint.read_molecule(path)) == 5
    for broken in (packed[:40], packed[:-9], packed[:3] + b"x" + packed[4:50]):
        path.write_bytes(broken)
        for read in (cylint.read_molecule, cylint.read_qsm):
            with pytest.raises(ValueError, match="not a whole file of gzip"):
                read(path)


def test_a_byte_order_mark_and_old_line_ends_hide_no_atom(tmp_path):
    path = tmp_path / "molecule"
    for text in (CHAIN, twin(CHAIN)):
        path.write_text(text)
        whole = cylint.read_molecule(path, ball=0.25)
        for end in ("\n", "\r\n", "\r"):
            changed = "\N{BYTE ORDER MARK}" + text.replace("\n", end)
            for code in ("utf-8", "utf-16-le", "utf-16-be"):
                path.write_bytes(changed.encode(code))
                assert (cylint.read_molecule(path, ball=0.25) == whole).all()


def test_names_that_are_no_text_are_refused(tmp_path):
    path = tmp_path / "latin"
    path.write_bytes(CHAIN.encode().replace(b" CA", b"\xe9CA"))
    with pytest.raises(ValueError, match="latin: .*can't decode byte 0xe9"):
        cylint.read_molecule(path)


@pytest.mark.parametrize(
    "text, options, message",
    [
        (atom(1, " C", 0, "oops", 0, "C"), {}, r":1: expected a number in columns 39 to 46, found 'oops'"),
        (atom(1, " C", 0, "1_2.5", 0, "C"), {}, r":1: expected a number in .* found '1_2.5'"),
        ("REMARK 2 \u00c5, 3 \u00c5\n" + atom(1, " C", 0, "oops", 0, "C"), {}, r":2: expected a number"),
        (atom(1, " C", 0, "oops", 0, "C").lower(), {}, r":1: expected a number in columns 39 to 46"),
        (atom(1, " C", 0, 0, "nan", "C"), {}, r"atom A:1:GLY:C has no coordinates"),
        (atom(1, "XX", 0, 0, 0, "XX"), {}, r"atom A:1:GLY:XX has no known element"),
        (twin(CHAIN).replace("1.540", " 1.5x"), {}, "atom A:1:GLY:CB has no coordinates"),
        ("hello\n", {}, "wrong format"),
        ("data_X\n_cell.id 3\n", {}, "no atom was found"),
        ("data_X\nloop_\n_cell.id\n_cell.x\n1 2.0 3\nloop_\n", {}, "Wrong number of values"),
        (CHAIN, {"stick": -1}, "stick: expected 0 or a positive number, found -1"),
        (CHAIN, {"stick": 0}, "stick and ball are 0: nothing to make"),
        (CHAIN, {"ball": np.nan}, "ball: expected 0 or a positive number, found nan"),
        (CHAIN, {"ball": 1.7e308}, "a number is not finite"),
    ],
)
def test_what_is_no_molecule_is_refused(molecule, text, options, message):
    with pytest.raises(ValueError, match=message):
        molecule(text, **options)


def test_a_file_that_cannot_be_read(tmp_path):
    for read in (cylint.read_molecule, cylint.read_qsm):
        with pytest.raises(FileNotFoundError, match="none"):
            read(tmp_path / "none")


def test_gemmi_is_needed(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "gemmi", None)
    with pytest.raises(ImportError, match="pip install gemmi"):
        cylint.read_molecule(tmp_path / "x")


# --------------------------------------------------------------- trees --


@pytest.mark.parametrize(
    "text, options",
    [
        ('"cyl_ID","startX","startY","startZ","endX","endY","endZ","radius_cyl"\n'
         "7,1,2,3.10,1,2,4,0.50\n", {}),
        ("ID;parentID;radius;start_x;start_y;start_z;end_x;end_y;end_z\n"
         '"7";0;0.50;1;2;3.10;1;2;4\n', {}),
        ("ID\tradius\tStart X\tStart Y\tStart Z\tend.X\tend.Y\tend.Z\r\n"
         "7\t.5\t1\t2\t3.1\t1\t2\t4\r\n# 8\n\n", {}),
        ('"ID"  radius startX startY startZ endX endY endZ\n 7 .5 1 2  3.1 1 2 4\n', {}),
        ("\n# of a program\nID,radius,startX,startY,startZ,endX,endY,endZ\r"
         "7,.5,1,2,3.1,1,2,4,,\r", {}),
        ("\N{BYTE ORDER MARK}ID,length,radius,startX,startY,startZ,axis_x,axis_y,axis_z\n"
         "7,1.125,.5,1,2,2.875,0,0,1\n", {"z": (2.875, 4)}),
    ],
)
def test_columns_are_found_by_name(tree, text, options):
    shapes = tree(text)
    low, high = options.get("z", (3.1, 4))
    assert shapes.p0.tolist() == [[1, 2, low]] and shapes.p1.tolist() == [[1, 2, high]]
    assert shapes.r.tolist() == [0.5] and shapes.labels.tolist() == ["7"]
    assert shapes.kind == cylint.Kind.CYLINDER
    assert tree(text, round=True).kind == cylint.Kind.CAPSULE
    for options in ({}, {"round": True}):
        assert tree(text, ends="open", **options).ends == cylint.Ends.OPEN


TREEQSM = "0.5\t2\t1\t2\t3\t0\t0\t1\t0\t2\t1\n0.4\t0.1\t1\t2\t3\t1\t0\t0\t1\t0\t1\n"


@pytest.mark.parametrize("head", ["", "radius (m)  length (m) start_point\n"])
def test_treeqsm_text_has_no_header(tree, head):
    shapes = tree(head + TREEQSM, treeqsm=True)
    assert shapes.p1.tolist() == [[1, 2, 5], [1 + 0.1 * 1, 2, 3]]
    assert shapes.r.tolist() == [0.5, 0.4] and shapes.labels.tolist() == ["1", "2"]


def test_a_number_sign_within_a_row_begins_no_comment(tree):
    assert tree(HEAD + "a#7,.5,1,2,3,1,2,4\n").labels.tolist() == ["a#7"]


HEAD = "ID,radius,startX,startY,startZ,endX,endY,endZ\n"
POINTS = "7,.5,1,2,3,1,2,4\n8,.5,1,2,4,1,2,4\n9,0,1,2,4,1,2,5\n"


def test_what_bounds_nothing_is_left_out_and_counted(tree):
    with pytest.warns(UserWarning) as said:
        shapes = tree(HEAD + POINTS)
    assert shapes.labels.tolist() == ["7"]
    texts = [re.sub("^.*?: ", "", str(warning.message)) for warning in said]
    assert texts == ["cylinders left out, of no length or radius: 2"]
    with pytest.warns(UserWarning, match="length or radius: 1$") as said:
        assert tree(HEAD + POINTS, round=1).labels.tolist() == ["7", "8"]
    assert len(said) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert len(tree(HEAD)) == 0 and len(tree("", treeqsm=True)) == 0


@pytest.mark.parametrize(
    "text, message",
    [
        ("radius,startX,startY\n1,2,3\n", ":1: the header names no column 'startz'"),
        (HEAD + "7,1,2,3,4,5,6\n", ":2: expected 8 columns, found 7"),
        (HEAD.replace(",", " ") + "7 1 2 3 4 5 6 7 8\n", ":2: expected 8 columns, found 9"),
        (HEAD + '7,1,2,3,4,5,6,7\n"8",8,1,2,3,4,5,6,7\n', ":3: expected 8 columns, found 9"),
        (HEAD[:-1] + ",note\n" + '7,1,2,3,4,5,6,7,"5" inch"\n8,1,2,3,4,5,6,7,"old\n' * 2,
         ":3: a quote has no end"),
        (HEAD + '7,1,2,3,4,5,6,"7\n8,1,2,3,4,5,6,7\n', ":2: a quote has no end"),
        (HEAD.replace(",", ";") + "7;1;2;3;4;5;6;7\n8;0,5;2;3;4;5;6;7\n",
         ":3: column 2: expected a number, found '0,5'"),
        (HEAD + "# 6\n\n7,-1,2,3,4,5,6,7\n", ":4: the radius is negative"),
        (HEAD + "7,1,2,3,4,5,6,nan\n", ":2: a number is not finite"),
        ("# 1\nradius\n", ":2: the header names no column 'startx'"),
        ("radius,startX,startY,startZ,axisX,axisY,axisZ,length\n1,0,0,0,0,0,1e300,1e300\n",
         ":2: a number is not finite"),
        ("", "expected a header line, found the end of the file"),
    ],
)
def test_what_is_no_table_is_refused(tree, text, message):
    with pytest.raises(ValueError, match=message):
        tree(text)


# ------------------------------------------------------------ real files --


@pytest.mark.skipif(not DATA.exists(), reason=f"no {DATA}")
def test_a_protease_has_1922_sticks_and_1890_balls(tmp_path):
    path = DATA / "1hvr.pdb"
    shapes = cylint.read_molecule(path, ball=0.25)
    kinds = [np.count_nonzero(shapes.kind == k) for k in (cylint.Kind.CYLINDER, cylint.Kind.SPHERE)]
    assert kinds == [1922, 1890]
    (tmp_path / "cif").write_text(twin(path.read_text()))
    again = cylint.read_molecule(tmp_path / "cif", ball=0.25)
    assert (again == shapes).all() and (again.labels == shapes.labels).all()
