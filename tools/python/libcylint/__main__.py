"""python -m libcylint convert: writes scenes for `cylint -s` from other formats."""

from __future__ import annotations

import argparse
import signal
import sys
import warnings
from contextlib import suppress
from typing import Any

from ._files import BAD, IO, MEMORY, scene_text, standard
from ._molecules import read_molecule
from ._trees import read_qsm


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m libcylint")
    convert = parser.add_subparsers(required=True, metavar="convert").add_parser(
        "convert",
        help="write the scene of other programs' files to standard output",
        description="Writes a scene for cylint -s to standard output.  FILE may be "
        "*.gz; - is standard input.",
    )
    kinds = convert.add_subparsers(required=True, metavar="KIND")

    def kind(name: str, read: Any, text: str, **named: Any) -> Any:
        made = kinds.add_parser(name, help=text, description=text, **named)
        made.set_defaults(read=read)
        made.add_argument("files", metavar="FILE", nargs="*", default=["-"])
        return made.add_argument

    add = kind(
        "molecule", read_molecule, "PDB or mmCIF: a cylinder for each bond, and with "
        "-b a ball for each atom", aliases=["pdb", "mmcif"],
    )
    add("-r", "--stick", type=float, default=0.15, metavar="RADIUS",
        help="of bonds, in angstrom, default 0.15; 0: no bonds")
    add("-b", "--ball", type=float, default=0.0, metavar="FRACTION",
        help="of the van der Waals radius, for balls")
    add("--no-waters", dest="waters", action="store_false", help="leave out water")
    add = kind("qsm", read_qsm, "trees as tables of cylinders")
    add("-t", "--treeqsm", action="store_true", help="text of TreeQSM, without header")
    add("--round", action="store_true", help="capsules in place of cylinders")
    return parser.parse_args()


def _print_message(message: Any, *_: Any) -> None:
    with suppress(AttributeError, OSError):  # standard error is closed, or full
        sys.stderr.write(f"libcylint: {message}\n")


def main() -> int:
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    warnings.showwarning = _print_message  # type: ignore[assignment]
    options = vars(_arguments())
    read, files = options.pop("read"), options.pop("files")
    try:
        output = standard(sys.stdout, "standard output")
        for name in files:
            for text in scene_text(read(name, **options)):
                output.write(text)
        output.flush()
    except (ValueError, ImportError) as error:
        _print_message(error)
        return BAD
    except OSError as error:
        name = error.filename or "standard output"
        _print_message(error if error.errno is None else f"{name}: {error.strerror}")
        return IO
    except MemoryError:
        _print_message("out of memory")
        return MEMORY
    return 0


if __name__ == "__main__":
    sys.exit(main())
