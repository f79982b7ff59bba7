"""Molecules, trees, `python -m libcylint convert`, and the recipes that use them."""

import gzip
import io
import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import libcylint as cylint
from libcylint import __main__

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


def test_a_compressed_file_is_read(tmp_path, convert):
    path = tmp_path / "molecule.pdb.gz"
    packed = gzip.compress(CHAIN.encode())
    path.write_bytes(packed)
    assert len(cylint.read_molecule(path)) == 5
    for broken in (packed[:40], packed[:-9], packed[:3] + b"x" + packed[4:50]):
        path.write_bytes(broken)
        for read, kind in ((cylint.read_molecule, "pdb"), (cylint.read_qsm, "qsm")):
            with pytest.raises(ValueError, match="not a whole file of gzip"):
                read(path)
            assert convert(kind, path)[0] == 1


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
    texts = [re.sub(".*: ", "", str(warning.message)) for warning in said]
    assert texts == [
        "1 cylinder of no length skipped", "1 cylinder of no radius skipped",
    ]
    with pytest.warns(UserWarning, match="1 cylinder of no radius") as said:
        assert tree(HEAD + POINTS, round=True).labels.tolist() == ["7", "8"]
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
         ":3: could not convert string '0,5' to float64, column 2"),
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


# -------------------------------------------------------------- convert --


@pytest.fixture
def convert(monkeypatch, capfdbinary):
    """Calls `python -m libcylint convert` in this process."""
    monkeypatch.setattr(warnings, "showwarning", warnings.showwarning)
    monkeypatch.setattr(__main__.signal, "signal", lambda *_: None)

    def run(*arguments, given=b""):
        monkeypatch.setattr(sys, "argv", ["", "convert", *map(str, arguments)])
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(given)))
        try:
            with warnings.catch_warnings():
                status = __main__.main()
        except SystemExit as end:
            status = end.code
        out, err = capfdbinary.readouterr()
        return status, out.decode(), err.decode()

    return run


def test_convert_writes_the_scene_that_is_read(convert, tmp_path):
    path, scene = tmp_path / "m", tmp_path / "scene"
    path.write_text(CHAIN)
    for kind in ("molecule", "pdb", "mmcif"):
        status, text, said = convert(kind, "-b", "0.25", "-r", ".1", path)
        assert (status, said) == (0, "")
        scene.write_text(text)
        again = cylint.read_scene(scene)
        want = cylint.read_molecule(path, stick=0.1, ball=0.25)
        assert (again == want).all() and again.labels.tolist() == want.labels.tolist()
    packed = gzip.compress(CHAIN.encode())
    assert convert("molecule", "-b", ".25", "-r", ".1", given=packed)[1] == text
    water = CHAIN + atom(9, " O", 30, 0, 0, "O", residue="HOH A 401")
    options = ("molecule", "-r", "0", "-b", "1")
    assert convert(*options, given=water.encode())[1].count("\n") == 7
    status, text, _ = convert(*options, "--no-waters", given=water.encode())
    assert text.count("\n") == 6


def test_convert_reads_trees(convert):
    assert convert("qsm", "-t", given=TREEQSM.encode())[1] == (
        "cylinder 1 2 3 1 2 5 0.5 1\ncylinder 1 2 3 1.1 2 3 0.4 2\n"
    )
    status, text, said = convert("qsm", "--round", given=(HEAD + POINTS).encode())
    assert text == "capsule 1 2 3 1 2 4 0.5 7\nrcone 1 2 4 0.5 1 2 4 0.5 8\n"
    assert said == "libcylint: -: 1 cylinder of no radius skipped\n"


def test_convert_has_the_status_of_the_command(convert, tmp_path):
    bad = tmp_path / "bad"
    bad.write_text("1 1 0 0 0 2 x\n")
    assert convert("qsm", bad)[0] == convert("pdb", bad)[0] == 1
    for name, why in ((tmp_path / "none", "No such file or directory"), (tmp_path, "Is a directory")):
        assert convert("molecule", name) == (3, "", f"libcylint: {name}: {why}\n")
    for wrong in ((), ("pov",), ("pdb", "-r", "thick")):
        status, text, said = convert(*wrong)
        assert status == 2 and text == "" and said.startswith("usage: ")
    for kind in ((), ("molecule",), ("qsm",)):
        status, text, _ = convert(*kind, "--help")
        assert status == 0 and "usage: python -m libcylint convert" in text
    if os.path.exists("/dev/full"):
        with open("/dev/full", "w") as full:
            done = subprocess.run(
                [sys.executable, "-m", "libcylint", "convert", "qsm", "-t"],
                input=TREEQSM.encode(), stdout=full, stderr=subprocess.PIPE,
            )
        assert done.returncode == 3 and b"No space left" in done.stderr


@pytest.mark.skipif(os.name != "posix", reason="needs a shell")
def test_convert_with_closed_streams(tmp_path):
    (tmp_path / "tree").write_text(HEAD + POINTS)

    def run(redirection):
        line = f'"{sys.executable}" -m libcylint convert qsm {redirection}'
        done = subprocess.run(["sh", "-c", line], cwd=tmp_path, capture_output=True)
        return done.returncode, done.stdout, done.stderr

    shape = b"cylinder 1 2 3 1 2 4 0.5 7\n"  # and no message among the shapes
    assert run("tree 2>&-") == (0, shape, b"")
    assert b"Broken pipe" not in run("tree | true")[2]  # the reader has left
    for name, closed in (("output", "tree >&-"), ("input", "<&-")):
        said = f"libcylint: standard {name}: Bad file descriptor\n".encode()
        assert run(closed) == (3, b"", said)


# -------------------------------------------------------------- recipes --


def display(name, page="cylint.7"):
    """A display of a manual."""
    done = subprocess.run(
        ["sh", TOP / "tests/support/recipe.sh", name, page],
        capture_output=True, text=True, check=True,
    )
    assert done.stdout
    return done.stdout


@pytest.fixture
def recipe(tmp_path):
    """Runs a display in a folder, with the command and this Python."""
    command = os.environ.get("CYLINT_COMMAND")
    if not command:
        pytest.skip("CYLINT_COMMAND does not name the command")
    (tmp_path / "bin").mkdir()
    python = tmp_path / "bin" / "python"
    python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    python.chmod(0o755)
    path = f"{tmp_path / 'bin'}:{os.path.dirname(command)}:{os.environ['PATH']}"

    def run(text):
        done = subprocess.run(
            ["sh", "-c", text], cwd=tmp_path, env=os.environ | {"PATH": path},
            capture_output=True, text=True,
        )
        assert done.stderr == ""
        return done.stdout

    return run


def test_the_formats_of_the_manual(recipe, tmp_path):
    (tmp_path / "molecule.pdb").write_text(CHAIN)
    (tmp_path / "tree.csv").write_text(HEAD + POINTS[:17])
    recipe(display("formats").replace("pip ", ": pip "))
    count = {
        name: len(cylint.read_scene(tmp_path / f"{name}.scene")) for name in ("molecule", "tree")
    }
    assert count == {"molecule": 6 + 5, "tree": 1}


def test_half_of_the_points_are_near_a_stem(recipe, tmp_path):
    """Forty stems.  Each has one point 9 mm and one 45 mm in front of the bark."""
    table, cloud = [HEAD], []
    for n in range(40):
        c, s = np.cos(n * 0.157), np.sin(n * 0.157)
        r, d = 0.1 + n / 200, 10 + n
        foot = f"{d * c:.9f},{d * s:.9f}"
        table.append(f"{n},{r:g},{foot},250,{foot},260\n")
        for off in (0.009, 0.045):
            cloud.append(f"{(d - r - off) * c:.9f} {(d - r - off) * s:.9f} 255.5\n")
    (tmp_path / "tree.csv").write_text("".join(table))
    (tmp_path / "cloud.txt").write_text("".join(cloud))
    assert recipe(display("lidar")) == (
        "80 points: within 1 cm 50.0 %, 2 cm 50.0 %, 5 cm 100.0 %\n"
        "-2 to -1 cm      0\n-1 to  0 cm      0\n 0 to  1 cm     40\n"
        " 1 to  2 cm      0\n 2 to  3 cm      0\n 3 to  4 cm      0\n"
        " 4 to  5 cm     40\n"
    )


def test_a_ray_from_an_atom_hits_the_other_bond_and_not_its_own(recipe, tmp_path):
    """Two parallel bonds, the second 2 above the first.  Rays from the two lower
    atoms hit the upper bond, which is 0.2 thick, and nothing else."""
    (tmp_path / "molecule.pdb").write_text(
        atom(1, " C", 0, 0, 0, "C", residue="GLY A   1")
        + atom(2, " O", 1.2, 0, 0, "O", residue="GLY A   2")
        + atom(3, " C", 0, 0, 2, "C", residue="GLY A   3")
        + atom(4, " O", 1.2, 0, 2, "O", residue="GLY A  -4")
    )
    bond = "A:3:GLY:C--A:-4:GLY:O\t1.8\t"
    said = recipe(display("molecule"))
    assert said == f"{bond}A:1:GLY:C\n{bond}A:2:GLY:O\n"


def test_a_protein_has_the_colours_of_its_elements(recipe, tmp_path):
    render = Path(os.environ["CYLINT_COMMAND"]).with_name("cylint-render")
    if not render.exists():
        pytest.skip("no cylint-render")
    text = display("protein", "cylint-render.1")
    text = text.replace("640x540", "64x54").replace("samples 64", "samples 1")
    (tmp_path / "molecule.pdb").write_text(
        atom(1, " C", 0, 0, 0, "C") + atom(2, " O", 1.5, 0, 0, "O")
        + atom(3, " N", -1.4, 0, 0, "N")
    )
    recipe(text)
    pixels = recipe(f"{render.parent}/tests/command/pixels protein.png")
    colour = np.array([row.split()[2:5] for row in pixels.splitlines()], int)
    assert (colour[:, 0] > 2 * colour[:, 1]).sum() > 9  # red
    assert (colour[:, 2] > 2 * colour[:, 0]).sum() > 9  # blue


# ------------------------------------------------------------ real files --

real = pytest.mark.skipif(not DATA.exists(), reason=f"no {DATA}")


@real
def test_a_protease_has_1922_sticks_and_1890_balls(tmp_path):
    path = DATA / "1hvr.pdb"
    shapes = cylint.read_molecule(path, ball=0.25)
    kinds = [np.count_nonzero(shapes.kind == k) for k in (cylint.Kind.CYLINDER, cylint.Kind.SPHERE)]
    assert kinds == [1922, 1890]
    (tmp_path / "cif").write_text(twin(path.read_text()))
    again = cylint.read_molecule(tmp_path / "cif", ball=0.25)
    assert (again == shapes).all() and (again.labels == shapes.labels).all()


@real
def test_a_real_tree_has_the_answers_of_the_manual(recipe, tmp_path):
    for name, file in (("tree.csv", "tree_archi.csv"), ("cloud.txt", "tree_cloud_xyz.txt")):
        (tmp_path / name).symlink_to(DATA / file)
    assert len(cylint.read_qsm(tmp_path / "tree.csv")) == 1231
    for name, said in (
        ("lidar", "lidar-said"), ("residuals", "residuals-said"), ("crown", "crown-said"),
    ):
        assert recipe(display(name)) == display(said)
