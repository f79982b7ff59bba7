#!/usr/bin/env python3
"""Prints the branches of the library that no test takes.

The argument is the folder of a build with --coverage and without optimisation.
The counts of gcov are added up for src/ without src/bvh/, src/scene/ and
src/embree/, and without builds and choices of a build that this processor cannot
run.  A line can be in several objects (a header's line, or a kernel's
line for each instruction set); a branch is taken if one object takes it.
Prints functions that are never called and, of lines that ran, the number of
branches that were not taken; every other line ran.  Where the reason stands
beside the line (tests/support/reasons.py) nothing is printed, except a reason with a
number of branches that is not the number found.  Any printed line is a failure.
"""
import json
import os
import re
import subprocess
import sys

from reasons import beside_lines


def runs_avx512():
    try:
        with open("/proc/cpuinfo") as f:
            return " avx512dq " in f.read()
    except OSError:
        return False


def counted(folder):
    """gcov's report on every object below the folder that this processor runs."""
    all_run = runs_avx512()
    for place, _, names in os.walk(folder):
        for name in names:
            if not name.endswith(".gcno") or (
                    name.endswith("-avx512.gcno") and not all_run):
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


def main():
    top = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                        "..", ".."))
    calls, runs, taken = add_up(sys.argv[1])
    found = set(not_taken(calls, runs, taken))
    texts, expected, printed = {}, set(), 0
    for name in {name for name, _ in calls}:
        with open(os.path.join(top, name)) as f:
            texts[name] = f.read()
        expected |= {(name, line, what)
                     for what, lines in beside_lines(texts[name], "untaken")
                     for line in lines}
    for name, line, what in sorted(found):
        text = texts[name].split("\n")[line - 1].strip()
        if not re.search(r"OF_(BUILD|FMA|LANES)\(", text) and not (
                expected & {(name, line, what), (name, line, "")}):
            printed += 1
            print("%s:%d: %s: %s" % (name, line, what, text))
    for name, line, what in sorted(expected - found):
        if what and what != "never called":
            printed += 1
            print("%s:%d: `untaken %s` is not so" % (name, line, what))
    branches = [n for counts in taken.values() for n in counts]
    print("%d of %d functions called, %d of %d lines run, "
          "%d of %d branches taken; %d without a reason"
          % (sum(n > 0 for n in calls.values()), len(calls),
             sum(n > 0 for n in runs.values()), len(runs),
             sum(n > 0 for n in branches), len(branches), printed))
    return printed > 0


if __name__ == "__main__":
    sys.exit(main())
