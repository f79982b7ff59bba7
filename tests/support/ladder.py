#!/usr/bin/env python3
"""Do includes and calls of src/ point down the ladder, without a circle?

    ladder.py [BUILD]

The floors and what each stands on are the table of src/README.md.  A floor
may use itself, what it stands on, and what that stands on.  An include is a
line `#include "..."`; a call is an undefined symbol cylint_... of an object
below BUILD/src that another object defines.  Files must not include or call
each other in a circle either.  Functions that include/ declares count as
calls of the file that defines them, except from src/methods, which is written
for the public interface.  Every arrow that points up and every circle is
printed with its place.
"""
import os
import re
import subprocess
import sys

TOP = os.path.normpath(os.path.join(os.path.dirname(__file__), "..", ".."))
SRC = os.path.join(TOP, "src")


def closure(graph):
    """{node: all nodes that it reaches by one step or more}"""
    def reached(start):
        seen, todo = set(), [start]
        while todo:
            new = graph.get(todo.pop(), set()) - seen
            seen |= new
            todo += new
        return seen
    return {node: reached(node) for node in graph}


def read_floors():
    """{floor: set of floors that it may use, itself included}"""
    direct = {}
    with open(os.path.join(SRC, "README.md")) as text:
        for line in text:
            row = re.match(r"\| `([\w.]+)` \| ([^|]*)\|", line)
            if row:
                direct[row[1]] = set(re.findall(r"[\w.]+", row[2]))
    reach = closure(direct)
    for floor, below in reach.items():
        if floor in below or not below <= set(direct):
            sys.exit("ladder: in the table of src/README.md %s stands on itself, or "
                     "on a floor that has no row" % floor)
    return {floor: below | {floor} for floor, below in reach.items()}


def floor_of(path):
    """The folder of a file that is named relative to src/."""
    return os.path.dirname(path) or "."


def include_arrows():
    """(file, included file, line number), named relative to src/"""
    for place, _, names in os.walk(SRC):
        for name in sorted(names):
            if not name.endswith((".c", ".h")):
                continue
            path = os.path.join(place, name)
            with open(path) as text:
                for number, line in enumerate(text, 1):
                    found = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
                    if not found:
                        continue
                    target = os.path.join(place, found[1])
                    if not os.path.exists(target):
                        target = os.path.join(SRC, found[1])
                    if not os.path.exists(target):
                        continue  # of include/, or the compiler finds out
                    yield (os.path.relpath(path, SRC),
                           os.path.relpath(target, SRC), number)


def symbols(build):
    """{file: (symbols it defines, symbols it uses)} of the objects of src/"""
    found = {}
    below = os.path.join(build, "src")
    for place, _, names in os.walk(below):
        for name in names:
            if not name.endswith(".o"):
                continue
            path = os.path.join(place, name)
            source = re.sub(r"(-\w+)?\.o$", ".c",
                            os.path.relpath(path, below))
            if not os.path.exists(os.path.join(SRC, source)):
                continue
            defined, used = found.setdefault(source, (set(), set()))
            for line in subprocess.run(["nm", path], capture_output=True,
                                       check=True, text=True).stdout.split("\n"):
                fields = line.split()
                if len(fields) < 2 or not fields[-1].startswith("cylint_"):
                    continue
                (used if fields[-2] == "U" else defined).add(fields[-1])
    return found


def public_names():
    """What include/ declares."""
    names = set()
    for name in os.listdir(os.path.join(TOP, "include")):
        with open(os.path.join(TOP, "include", name)) as text:
            names.update(re.findall(r"\bcylint_\w+(?=\()", text.read()))
    return names


def call_arrows(build):
    """(file, file that defines the symbol, symbol)"""
    objects = symbols(build)
    public = public_names()
    home = {s: path for path, (defined, _) in objects.items() for s in defined}
    for path, (defined, used) in sorted(objects.items()):
        for symbol in sorted(used - defined):
            if symbol in public and floor_of(path) == "methods":
                continue
            if symbol in home:
                yield path, home[symbol], symbol


def circles(arrows):
    """Each set of files that reach each other, once."""
    graph = {}
    for a, b, _ in arrows:
        if a != b:
            graph.setdefault(a, set()).add(b)
    reach = closure(graph)
    return sorted({tuple(sorted(b for b in reach[a] if a in reach.get(b, ())))
                   for a in reach if a in reach[a]})


def main():
    floors = read_floors()
    includes = list(include_arrows())
    calls = list(call_arrows(sys.argv[1])) if len(sys.argv) > 1 else []
    if len(sys.argv) > 1 and not calls:
        sys.exit("ladder: no objects below %s/src" % sys.argv[1])
    found = 0
    for kind, arrows in (("includes", includes), ("calls", calls)):
        for path, target, where in arrows:
            allowed = floors.get(floor_of(path))
            if allowed is None:
                print("src/%s: its folder has no row in src/README.md" % path)
            elif floor_of(target) in allowed:
                continue
            elif kind == "includes":
                print("src/%s:%d: includes %s, which stands above it"
                      % (path, where, target))
            else:
                print("src/%s: calls %s of %s, which stands above it"
                      % (path, where, target))
            found += 1
        for circle in circles(arrows):
            print("a circle of %s: %s" % (kind, " ".join(circle)))
            found += 1
    return found != 0


sys.exit(main())
