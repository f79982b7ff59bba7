"""Molecules in PDB and mmCIF, read by gemmi: balls for atoms, sticks for bonds."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from ._files import contents
from ._scene import Scene
from ._shapes import Shapes, concatenate, cylinder, sphere

_CLOSEST = 0.4  # of bonded atoms, in angstrom
_ALLOWANCE = 0.45  # beyond the sum of their covalent radii, the usual tolerance


def read_molecule(
    path: str | os.PathLike[str], *, stick: float = 0.15, ball: float = 0.0,
    waters: bool = True,
) -> Shapes:
    """Reads a molecule in PDB or mmCIF, also of a file *.gz; `-` is standard input.

    Needs gemmi: pip install gemmi.  The content shows which of the two formats a file
    has.  All lengths are in angstrom.

    stick: the radius of a cylinder for each bond; 0: no bonds.  Two atoms are bonded
    if their distance is at least 0.4, and at most the sum of their covalent radii,
    those of gemmi, plus 0.45; two hydrogens never are.
    ball: a sphere for each atom, of this fraction of its van der Waals radius; 0: none.
    stick=0, ball=1 gives van der Waals balls, ball=0.25 balls and sticks.
    waters: False leaves out the molecules of water.

    Of several models the first is read, of alternate locations the first.  The balls
    come first, in the order of the file.  The label of a ball is
    chain:residue:name:atom, for example A:45:CYS:SG; the residue is its number, with
    the insertion code if it has one.  If the first letter of the atom's name is not its
    element, the element follows: A:301:ZN:ZN:Zn.  The label of a stick is those of its
    two atoms with -- between them.

    Raises ValueError for a file without atoms, and names the first atom that has no
    coordinates or no known element; OSError if the file cannot be read.

    >>> import os, tempfile
    >>> name = os.path.join(tempfile.mkdtemp(), "co.pdb")
    >>> line = "HETATM    {} {:4} CMO A 300       0.000   0.000{:8.3f}  1.00  0.00"
    >>> with open(name, "w") as file:
    ...     print(line.format(1, " C", 0), line.format(2, " O", 1.2), sep="\\n", file=file)
    >>> molecule = cylint.read_molecule(name, ball=0.25)
    >>> molecule
    <libcylint.Shapes (3,): 1 cylinder, 2 spheres>
    >>> molecule.r, str(molecule.labels[2])
    (array([0.425, 0.38 , 0.15 ]), 'A:300:CMO:C--A:300:CMO:O')
    """
    for name, number in (("stick", stick), ("ball", ball)):
        if not (0 <= number < np.inf):
            raise ValueError(f"{name}: expected 0 or a positive number, found {number}")
    if stick == 0 and ball == 0:
        raise ValueError("stick and ball are 0: nothing to make")
    name = os.fspath(path)
    model = _model(name, waters)  # its atoms live as long as it does
    try:
        atoms = _first_locations(model)
        labels = np.array([_label(cra) for cra in atoms], object)
    except UnicodeDecodeError as error:
        raise ValueError(f"{name}: {error}") from None
    at = np.array([cra.atom.pos.tolist() for cra in atoms]).reshape(-1, 3)
    _check(name, atoms, labels, at)
    parts = []
    if ball > 0:
        radii = np.array([_radius(cra.atom.element.vdw_r) for cra in atoms])
        with np.errstate(over="ignore"):  # sphere() refuses infinity
            parts.append(sphere(at, ball * radii).with_labels(labels))
    if stick > 0:
        i, j = _bonds(atoms, at)
        named = labels[i] + "--" + labels[j]
        parts.append(cylinder(at[i], at[j], stick).with_labels(named))
    return concatenate(parts)


def _model(name: str, waters: bool) -> Any:
    """The first model of a file."""
    try:
        import gemmi  # type: ignore[import-not-found, unused-ignore]
    except ImportError:
        raise ImportError("read_molecule needs gemmi: pip install gemmi") from None
    data = contents(name)
    try:
        structure = gemmi.read_structure_string(data, merge_chain_parts=False)
    except (RuntimeError, ValueError) as error:
        raise ValueError(f"{name}: {error}") from None
    if structure.input_format == gemmi.CoorFormat.Pdb:
        _check_columns(name, data.decode("latin-1"))
    if not waters:
        structure.remove_waters()
    if len(structure) == 0 or structure[0].count_atom_sites() == 0:
        raise ValueError(f"{name}: no atom was found")
    return structure[0]


def _first_locations(model: Any) -> list[Any]:
    """The atoms of a model, of alternate locations the first.  Atoms without a letter
    for the location may have one name: Open Babel writes C, C, C."""
    parts = [part for part, chain in enumerate(model) for residue in chain for _ in residue]
    residues: dict[Any, str] = {}  # the first one of each number; another is alternate
    letters: dict[Any, str] = {}
    atoms = []
    for part, cra in zip(parts, model.all(), strict=True):
        place, name, letter = (part, str(cra.residue.seqid)), cra.atom.name, cra.atom.altloc
        residue = residues.setdefault(place, cra.residue.name)
        first = letters.setdefault((place, name), letter)
        if letter == "\0" or (residue, first) == (cra.residue.name, letter):
            atoms.append(cra)
    return atoms


def _check_columns(name: str, text: str) -> None:
    """gemmi reads what is no number as 0; Python accepts 1_2.  gemmi finds a record by
    four letters."""
    for row, line in enumerate(text.split("\n"), 1):
        if line[:4].upper() in ("ATOM", "HETA"):
            for column in (30, 38, 46):
                try:
                    float(line[column : column + 8].replace("_", "?"))
                except ValueError:
                    raise ValueError(
                        f"{name}:{row}: expected a number in columns {column + 1} to "
                        f"{column + 8}, found {line[column : column + 8].strip()!r}"
                    ) from None


def _check(name: str, atoms: list[Any], labels: Any, at: Any) -> None:
    known = np.array([cra.atom.element.atomic_number > 0 for cra in atoms])
    for good, what in (
        (np.isfinite(at).all(axis=1), "no coordinates"), (known, "no known element"),
    ):
        if not good.all():
            raise ValueError(f"{name}: atom {labels[np.argmin(good)]} has {what}")


def _label(cra: Any) -> str:
    """chain:residue:name:atom, and the element if the atom's name does not begin with
    it."""
    chain, residue, atom = cra.chain, cra.residue, cra.atom
    element = atom.element.name
    label = f"{chain.name}:{residue.seqid}:{residue.name}:{atom.name}"
    if atom.name.lstrip("0123456789'\"*")[:1].upper() != element:
        label += f":{element}"
    return label.replace(" ", "_")


def _radius(single: float) -> float:
    """gemmi has hundredths of an angstrom, rounded to singles."""
    return round(single, 2)


def _bonds(atoms: list[Any], at: Any) -> Any:
    """The numbers of bonded atoms, (2, k), ascending."""
    covalent = np.array([_radius(cra.atom.element.covalent_r) for cra in atoms])
    hydrogen = np.array([cra.atom.is_hydrogen() for cra in atoms])
    balls = Scene(sphere(at, covalent))
    near = balls.within(at, covalent + _ALLOWANCE + 0.01, signed=True)  # and some more
    i, j = near.point, near.index
    with np.errstate(over="ignore"):
        distance = np.sqrt(((at[i] - at[j]) ** 2).sum(axis=1))
    bonded = (
        (i < j)
        & (distance >= _CLOSEST)
        & (distance <= covalent[i] + covalent[j] + _ALLOWANCE)
        & ~(hydrogen[i] & hydrogen[j])
    )
    return i[bonded], j[bonded]
