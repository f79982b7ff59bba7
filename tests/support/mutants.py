#!/usr/bin/env python3
"""Tests whether the tests detect a wrong library.

Changes one operator, sign, constant or index of the library at a time (a
mutant), builds the library and runs its tests; those that detected most
mutants of the file so far run first.  Prints each mutant that passes all tests
(a survivor) with its line.  A survivor means that a test is missing, that a
bound is wider than necessary, or that the change has no effect.  The reason of
an understood survivor stands beside its line (tests/support/reasons.py); such mutants
are counted but not printed.

    tests/support/mutants.py [--count N] [--seed N] [--files a.c,b.h] [--jobs N]
                     [--full] [--understood]
    tests/support/mutants.py --check

Only the plain builds of kernels are tried, so changes of lines for AVX or a fused
multiply-add survive.  Needs what `make check` needs, including MPFR.  --count is
the number of random mutants of each file.  --understood tries those that have a
reason, and prints reasons whose mutants a test detects.  --full runs all tests with
all cases.  --check only prints reasons beside lines without such a mutant or branch, and
test programs that no list has.
"""
import argparse
import glob
import os
import queue
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from reasons import beside_lines, sources, without_comments

# The folders whose files are changed, and files there of which no test detects a
# change.
CORE = ("src", "src/bvh", "src/distance", "src/filter", "src/methods", "src/numbers",
        "src/roots", "src/scene", "src/shapes", "src/signs")
LEFT_OUT = ("dispatch.c", "dispatch.h", "version.c", "numbers/compiler.h",
            "numbers/diagnostics.h", "numbers/simd.h")


def cases(n):
    return {"CYLINT_CASES": str(n)}


# (program, environment).  Programs that take seconds run with few cases first,
# and with all cases only for --full, on mutants that pass the others.
SHORT = [("library/test_hits", {}), ("shapes/test_constructors", {}),
         ("bounds/test_form_depth", {}), ("bounds/test_local_bounds", {}),
         ("bounds/test_local_residuals", {}), ("bounds/test_arena", {}),
         ("bounds/test_member_bounds", cases(2000)),
         ("filter/test_local_coordinates", cases(50)),
         ("library/test_intersect", cases(50)), ("roots/test_midpoints", {}),
         ("numbers/test_exact", cases(2000)), ("numbers/test_turns", cases(10000)),
         ("signs/test_zeros", {}), ("shapes/test_errors", cases(50)),
         ("library/test_environment", cases(5)),
         ("library/test_batch", cases(3)), ("library/test_outside", cases(50)),
         ("library/test_chord", cases(60)), ("library/test_tube", {})]
FULL = [(test, {}) for test, few in SHORT if few] + [
    ("scene/test_paths", {}), ("distance/test_batch", cases(3))]  # batches of contains
DISTANCE = [("distance/test_known", cases(3)), ("bounds/test_arena", {}),
            ("bounds/test_distance_bounds", cases(400)),
            ("bounds/test_local_residuals", {}),
            ("distance/test_batch", cases(3)), ("distance/test_oracle", cases(2)),
            ("distance/test_elliptic", {})]
SCENE = [("scene/test_many", {}), ("scene/test_pieces", cases(20)),
         ("scene/test_solids", {}), ("scene/test_refit", {}),
         ("scene/test_records", cases(50)),
         ("scene/test_file", {}), ("scene/test_memory", {}),
         ("scene/test_queries", {})]
BVH = [("bvh/test_nodes", {}), ("bounds/test_scene_point_bounds", {})] + SCENE
# The tests of a file, or of the files in a folder; of others they are SHORT and FULL.
OF_FOLDER = {"distance": DISTANCE, "bvh": BVH, "scene": SCENE,
             "methods": [("methods/test_methods", {})],
             "merge_sort_template.h": SCENE}


def tests_of(name, full=True):
    return OF_FOLDER.get(name.split("/")[0]) or SHORT + (FULL if full else [])


# (pattern, replacements)
SWAPS = [
    (r"(?<= )\+(?= )", ["-"]), (r"(?<= )-(?= )", ["+"]),
    (r"(?<= )\*(?= )", ["+"]), (r"(?<= )/(?= )", ["*"]),
    (r"(?<= )<(?= )", ["<=", ">"]), (r"(?<= )>(?= )", [">=", "<"]),
    (r"(?<= )<=(?= )", ["<"]), (r"(?<= )>=(?= )", [">"]),
    (r"(?<= )==(?= )", ["!="]), (r"(?<= )!=(?= )", ["=="]),
    (r"&&", ["||"]), (r"\|\|", ["&&"]),
    (r"(?<=[(,= ])-(?=[A-Za-z(0-9])", [""]),  # a sign
    (r"(?<=[ (])!(?=[A-Za-z(])", [""]),
    (r"\bADD\b", ["SUB"]), (r"\bSUB\b", ["ADD"]),
    (r"\bpair_add\b", ["pair_sub"]), (r"\bpair_sub\b", ["pair_add"]),
    (r"\btwo_sum\b", ["two_diff"]), (r"\bfast_two_sum\b", ["two_diff"]),
    (r"\bROOT_ENTRY\b", ["ROOT_EXIT"]), (r"\bROOT_EXIT\b", ["ROOT_ENTRY"]),
    (r"\bCYLINT_SIDE_ENTERING\b", ["CYLINT_SIDE_LEAVING"]),
    (r"\bCYLINT_SIDE_LEAVING\b", ["CYLINT_SIDE_ENTERING"]),
    (r"(?<![\w.])[0-9]+(?![\w.])", ["+1"]),   # a constant or an index
    (r"(?<=p)[-+]?[0-9]+\b", ["+1"]),         # a power of two
]


def core(top):
    """The files to change, by their names below src."""
    names = [p[len("src/"):] for p in sources(top) if os.path.dirname(p) in CORE]
    return [n for n in names if n not in LEFT_OUT]


def is_length(code, at):
    """Whether the number there is the length of an array that is declared: a
    longer one changes nothing."""
    kind = (r"\s*(?:(?:const|static)\s+)*(?!return\b)[A-Za-z_]\w*\s+"
            r"\*?\w[\w\s,*\[\]+]*\[$")
    return any(re.match(kind, re.split(ends, code[:at][-400:])[-1])
               for ends in (r"[;{}()=]", r"[;{}()=,]"))


def mutants_of(name, text):
    code = without_comments(text)
    for pattern, others in SWAPS:
        for m in re.finditer(pattern, code):
            for other in others:
                if other == "+1":
                    if is_length(code, m.start()):
                        continue
                    other = "%d" % (int(m.group()) + 1)
                yield name, m.start(), m.end(), other


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, **more)


class Bench:
    """A copy of the sources, of which make builds what a changed file needs."""

    def __init__(self, top, work, cc, tests):
        self.work, self.tests = work, tests
        shutil.copytree(top, work, dirs_exist_ok=True, symlinks=True,
                        ignore=shutil.ignore_patterns("build", ".git"))
        self.make = ["make", "-s", "BUILD=build", "CC=" + cc, "X86=",
                     "CPPFLAGS=-DCHECK_STOPS", "CFLAGS=-O1 -fsanitize=bounds "
                     "-fsanitize-undefined-trap-on-error"]
        if not all(self.build(t, jobs="-j2") for t, _ in tests):
            sys.exit("mutants: the sources do not compile as they are")
        self.seconds = [self.time_of(*t) for t in tests]

    def build(self, test, jobs="-j1"):
        """The program of a test.  Tests link the static library, because they use
        functions that are hidden in the shared one."""
        return run(self.make + [jobs, "build/tests/" + test],
                   cwd=self.work).returncode == 0

    def passes(self, test, environment, seconds=600):
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU,
                                           (int(seconds), int(seconds)))
        return run(["build/tests/" + test], cwd=self.work, preexec_fn=limit,
                   env=dict(os.environ, **environment)).returncode == 0

    def time_of(self, test, environment):
        before = os.times().children_user
        if not self.passes(test, environment):
            sys.exit("mutants: %s fails before anything is changed" % test)
        return max(os.times().children_user - before, 0.01)

    def killer(self, order):
        """The number of the first test to fail, "compiler", or None.  A test that
        takes far longer than usual counts as a failure."""
        for i in order:
            test, environment = self.tests[i]
            if not self.build(test):
                return "compiler"
            if not self.passes(test, environment, 3 * self.seconds[i] + 2):
                return i
        return None

    def detect(self, texts, mutant, order):
        """What kills a mutant: see killer()."""
        name, start, end, other = mutant
        text, path = texts[name], os.path.join(self.work, "src", name)
        with open(path, "w") as f:
            f.write(text[:start] + other + text[end:])
        killer = self.killer(order)
        with open(path, "w") as f:
            f.write(text)
        return killer


def line_of(texts, mutant):
    return texts[mutant[0]].count("\n", 0, mutant[1]) + 1


def change(texts, mutant):
    name, start, end, other = mutant
    return "%r -> %r" % (texts[name][start:end], other)


def describe(texts, mutant):
    line = line_of(texts, mutant)
    return "src/%s:%d: %s: %s" % (mutant[0], line, change(texts, mutant),
                                  texts[mutant[0]].splitlines()[line - 1].strip())


def reasons_of(text):
    """(change, line) of each mutant that has a reason."""
    return {(one, line) for what, lines in beside_lines(text, "mutant")
            for one in re.findall(r"'[^']*' -> '[^']*'", what)
            for line in lines}


def drawn(args, texts, name, understood):
    """All mutants of a file, and those to try."""
    every = list(mutants_of(name, texts[name]))
    if args.understood:
        return every, [m for m in every if is_understood(texts, m, understood)]
    return every, random.Random(args.seed).sample(every, min(args.count, len(every)))


def is_understood(texts, mutant, understood):
    return (change(texts, mutant), line_of(texts, mutant)) in understood


def check(top):
    """Prints the reasons that concern nothing and the programs that no list has, and
    returns their number."""
    listed = {test for of in (SHORT, FULL, *OF_FOLDER.values()) for test, _ in of}
    programs = sorted(os.path.relpath(p, os.path.join(top, "tests"))[:-len(".c")]
                      for p in glob.glob(os.path.join(top, "tests/*/test_*.c")))
    stale = ["tests/%s.c: in no list" % p for p in programs
             if p not in listed and "embree" not in p]
    for path in sources(top):
        with open(os.path.join(top, path)) as f:
            name, text = path[len("src/"):], f.read()
        possible = {(change({name: text}, m), line_of({name: text}, m))
                    for m in mutants_of(name, text)}
        stale += ["%s:%d: no mutant %s" % (path, line, what)
                  for what, line in sorted(reasons_of(text) - possible)]
        code = without_comments(text).split("\n")
        stale += ["%s:%d: no branch" % (path, lines[0])
                  for what, lines in beside_lines(text, "untaken")
                  if what != "never called" and not any(
                      re.search(r"\b(if|for|while|case|AND|OR)\b|\?|&&|\|\|", l)
                      for l in code[lines[0] - 1:lines[-1]])]
    print("".join(line + "\n" for line in stale), end="")
    return len(stale)


def try_file(name, args, benches, texts):
    understood = reasons_of(texts[name])
    every, chosen = drawn(args, texts, name, understood)
    if not chosen:
        return 0
    idle = queue.Queue()
    for bench in benches:
        idle.put(bench)
    tests = benches[0].tests
    used = [tests.index(test) for test in tests_of(name, args.full)]
    kills = [0] * len(tests)
    fates = {}  # of the mutants with one description, as a line may have several
    count = dict.fromkeys(("killed", "uncompiled", "understood", "survived"), 0)

    def try_one(mutant):
        bench = idle.get()
        worth = [-k / s for k, s in zip(kills, bench.seconds)]
        order = sorted(used, key=lambda i: worth[i])
        killer = bench.detect(texts, mutant, order)
        idle.put(bench)
        if killer is None:
            fate = "survived"
            if is_understood(texts, mutant, understood):
                fate = "understood"
        elif killer == "compiler":
            fate = "uncompiled"
        else:
            fate = "killed"
            kills[killer] += 1
        count[fate] += 1
        if fate == "survived":
            print(describe(texts, mutant), flush=True)
        fates.setdefault(describe(texts, mutant), set()).add(fate)

    with ThreadPoolExecutor(len(benches)) as pool:
        list(pool.map(try_one, chosen))
    print("%s: %d possible, %d tried: %d killed, %d did not compile, "
          "%d survived for a known reason, %d survived"
          % (name, len(every), len(chosen), count["killed"],
             count["uncompiled"], count["understood"], count["survived"]),
          flush=True)
    stale = [d for d, of in fates.items() if "understood" not in of]
    for line in stale if args.understood else []:
        print("detected: " + line, flush=True)
    return len(stale) if args.understood else count["survived"]


def main():
    p = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    p.add_argument("--count", type=int, default=20)
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--jobs", type=int, default=2)
    p.add_argument("--cc", default="cc")
    p.add_argument("--files")
    p.add_argument("--understood", action="store_true")
    p.add_argument("--check", action="store_true")
    p.add_argument("--full", action="store_true")
    args = p.parse_args()
    here = os.path.dirname(os.path.abspath(__file__))
    top = os.path.dirname(os.path.dirname(here))
    if args.check:
        return check(top) > 0
    texts = {n: open(os.path.join(top, "src", n)).read()
             for n in (args.files.split(",") if args.files else core(top))}
    tests = []
    for name in texts:
        tests += [t for t in tests_of(name, args.full) if t not in tests]
    with tempfile.TemporaryDirectory() as work:
        benches = [Bench(top, os.path.join(work, str(i)), args.cc, tests)
                   for i in range(args.jobs)]
        survived = sum(try_file(n, args, benches, texts) for n in texts)
    return survived > 0


if __name__ == "__main__":
    sys.exit(main())
