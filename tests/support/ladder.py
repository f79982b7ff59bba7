#!/usr/bin/env python3
"""Do includes and calls of src/ point down the ladder, without a circle?

    ladder.py [BUILD]

The floors and what each stands on are the table of src/README.md.  A floor
may use itself, what it stands on, and what that stands on.  An include is a
line `#include "..."`; a call is an undefined symbol cylint_... of an object
below BUILD/src that another object defines.  Files must not include or call
each other in a circle either.  Functions that include/ declares count as
calls of the file that defines them, except from src/methods, which is written
for the public interface.  Every arrow that points up is printed with its place,
and a circle if there is one.
"""
import glob
import os
import re
import subprocess
import sys
from graphlib import CycleError, TopologicalSorter

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))


def text_of(path):
    with open(path) as file:
        return file.read()


def sources(ending):
    return sorted(glob.glob("src/**/*." + ending, recursive=True))


def circle(arrows):
    """One circle of a graph {from: [to]}, or None."""
    try:
        TopologicalSorter(arrows).prepare()
    except CycleError as error:
        return error.args[1][::-1]


def floors():
    """{floor: floors that it may use, itself included}"""
    rows = re.findall(r"(?m)^\| `([\w.]+)` \| ([^|]*)\|", text_of("src/README.md"))
    below = {floor: re.findall(r"[\w.]+", text) for floor, text in rows}
    may_use = {}
    if circle(below):
        sys.exit("ladder: src/README.md has a circle: " + " ".join(circle(below)))
    for floor in TopologicalSorter(below).static_order():
        if floor not in below:
            sys.exit("ladder: %s has no row in src/README.md" % floor)
        may_use[floor] = {floor}.union(*(may_use[f] for f in below[floor]))
    return may_use


def includes():
    """(file, included file, how a message begins)"""
    for path in sources("[ch]"):
        for number, line in enumerate(text_of(path).split("\n"), 1):
            found = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
            for place in (os.path.dirname(path), "src") if found else ():
                target = os.path.normpath(os.path.join(place, found[1]))
                if os.path.exists(target):  # else of include/
                    yield path, target, "%s:%d: includes %s" % (path, number, target)
                    break


def calls(build):
    """The same of objects: (file, file that defines the symbol, how a message begins)"""
    defined, used, home = {}, {}, {}
    for path in sources("c"):
        stem = os.path.join(build, path[:-2])
        for object in glob.glob(stem + ".o") + glob.glob(stem + "-*.o"):
            listed = subprocess.run(
                ["nm", object], capture_output=True, check=True, text=True).stdout
            for kind, symbol in re.findall(r"(\w) (cylint_\w+)", listed):
                (used if kind == "U" else defined).setdefault(path, set()).add(symbol)
        home.update(dict.fromkeys(defined.get(path, ()), path))
    public = {name for header in glob.glob("include/*.h")
              for name in re.findall(r"\bcylint_\w+(?=\()", text_of(header))}
    for path in used:
        for symbol in sorted(used[path] - defined[path]):
            is_public = symbol in public and path.startswith("src/methods/")
            if symbol in home and not is_public:
                where = path, symbol, home[symbol]
                yield path, home[symbol], "%s: calls %s of %s" % where


def floor_of(path):
    """The folder of a file below src."""
    return os.path.dirname(path)[len("src/"):] or "."


def faults(arrows, may_use):
    graph = {}
    for path, target, message in arrows:
        if floor_of(path) not in may_use:
            yield "%s: its folder has no row in src/README.md" % path
        elif floor_of(target) not in may_use[floor_of(path)]:
            yield message + ", which stands above it"
        if path != target:
            graph.setdefault(path, []).append(target)
    if circle(graph):
        yield "a circle: " + " ".join(circle(graph))


kinds = [list(includes())]
if len(sys.argv) > 1:
    kinds.append(list(calls(sys.argv[1])))
    if not kinds[1]:
        sys.exit("ladder: no objects below %s/src" % sys.argv[1])
may_use = floors()
found = [fault for arrows in kinds for fault in faults(arrows, may_use)]
print("\n".join(found), end="\n" if found else "")
sys.exit(bool(found))
