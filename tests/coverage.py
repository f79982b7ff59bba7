#!/usr/bin/env python3
"""Prints the branches of the library that no test takes.

The argument is the folder of a build with --coverage and without optimisation.
The counts of gcov are added up for src/ without src/bvh/, src/scene/ and
src/embree/.  A line can be in several objects (a header's line, or a kernel's
line for each instruction set); a branch is taken if one object takes it.
Prints functions that are never called and, of lines that ran, the number of
branches that were not taken; every other line ran.  tests/coverage.txt lists
known ones with the reason; these are not printed.  An entry of that file that
a test takes is printed.  Any printed line is a failure.
"""
import json
import os
import re
import subprocess
import sys


def counted(folder):
    """gcov's report on every object below the folder."""
    for place, _, names in os.walk(folder):
        for name in names:
            if not name.endswith(".gcno"):
                continue
            path = os.path.join(os.path.abspath(place), name)
            text = subprocess.run(
                ["gcov", "--json-format", "--stdout", "-b", path],
                check=True, capture_output=True, text=True).stdout
            yield from json.loads(text)["files"]


def add_up(folder):
    """Calls by function; counts by line, and by branches of a line."""
    calls, runs, taken = {}, {}, {}
    for report in counted(folder):
        name = report["file"]
        if not name.startswith("src/") or name.startswith(
                ("src/bvh/", "src/scene/", "src/embree/")):
            continue
        for f in report["functions"]:
            # a macro may name a kernel's functions by instruction set
            at = (name, f["start_line"])
            calls[at] = calls.get(at, 0) + f["execution_count"]
        for line in report["lines"]:
            at = (name, line["line_number"])
            runs[at] = runs.get(at, 0) + line["count"]
            counts = [b["count"] for b in line["branches"]]
            before = taken.setdefault(at + (len(counts),), [0] * len(counts))
            taken[at + (len(counts),)] = [x + y for x, y in zip(before, counts)]
    return calls, runs, taken


def not_taken(calls, runs, taken):
    """(file, line, what) in order of lines."""
    found = [at + ("never called",) for at, n in calls.items() if n == 0]
    for (name, line, n), counts in taken.items():
        if runs[name, line] and counts.count(0):
            found.append((name, line, "%d of %d" % (counts.count(0), n)))
    return sorted(found)


def known(path):
    with open(path) as f:
        lines = [re.split(r"  # ", line)[0].strip() for line in f]
    return {line for line in lines if line and not line.startswith("#")}


def main():
    tests = os.path.dirname(os.path.abspath(__file__))
    reasons = known(os.path.join(tests, "coverage.txt"))
    calls, runs, taken = add_up(sys.argv[1])
    texts, seen, printed = {}, set(), 0
    for name, line, what in not_taken(calls, runs, taken):
        if name not in texts:
            with open(os.path.join(tests, "..", name)) as f:
                texts[name] = f.read().split("\n")
        key = "%s: %s: %s" % (name, what, texts[name][line - 1].strip())
        seen.add(key)
        if key not in reasons:
            printed += 1
            print("%s:%d: %s: %s" % (name, line, what,
                                     texts[name][line - 1].strip()))
    for key in sorted(reasons - seen):
        printed += 1
        print("in coverage.txt, but taken: " + key)
    branches = [n for counts in taken.values() for n in counts]
    print("%d of %d functions called, %d of %d lines run, "
          "%d of %d branches taken; %d without a reason"
          % (sum(n > 0 for n in calls.values()), len(calls),
             sum(n > 0 for n in runs.values()), len(runs),
             sum(n > 0 for n in branches), len(branches), printed))
    return printed > 0


if __name__ == "__main__":
    sys.exit(main())
