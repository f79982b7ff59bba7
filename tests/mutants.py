#!/usr/bin/env python3
"""Do the tests notice when the library is wrong?

Changes one operator, sign, constant or index of the numeric core at a time,
builds that and runs the library's tests, the fastest first.  What they let
through is printed with its line.  A survivor is a test that is missing, a
bound that is wider than need be, or a change that changes nothing; those that
were understood stand in tests/mutants.txt, with the reason, and are counted
but not printed.

    tests/mutants.py [--count N] [--seed N] [--skip N] [--files a.c,b.h]
                     [--again FILE]

Needs what `make check` needs, MPFR and GSL among it.  --skip leaves out the
first N of the seed's sequence, so that a run can be taken up again; --again
tries only what an earlier run printed to FILE.
"""
import argparse
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

CORE = ["forms.h", "fraction.h", "eft.h", "decide.c", "root.c", "query.c",
        "exact.c", "hit.c", "box.c"]
TESTS = [("test_ties", {}), ("test_corners", {}), ("test_shape", {}),
         ("test_query", {"CYLINT_CASES": "100"}),
         ("test_query", {"CYLINT_CASES": "600", "CYLINT_SEED": "7"}),
         ("test_environment", {}), ("test_exact", {}), ("test_eft", {}),
         ("test_budget", {}), ("test_properties", {})]
SECONDS = 60  # of processor time: a test that takes longer hangs

# (pattern, what may stand there instead)
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
    (r"\bCYLINT_ENTERING\b", ["CYLINT_LEAVING"]),
    (r"\bCYLINT_LEAVING\b", ["CYLINT_ENTERING"]),
    (r"(?<![\w.])[0-9]+(?![\w.])", ["+1"]),   # a constant or an index
    (r"(?<=p)[-+]?[0-9]+\b", ["+1"]),         # a power of two
]


def without_comments(text):
    """Comments, strings and directives become blanks of the same length."""
    blank = lambda m: re.sub(r"[^\n]", " ", m.group())
    text = re.sub(r"/\*.*?\*/", blank, text, flags=re.S)
    text = re.sub(r'"[^"\n]*"', blank, text)
    return re.sub(r"^#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)


def mutants_of(name, text):
    code = without_comments(text)
    for pattern, others in SWAPS:
        for m in re.finditer(pattern, code):
            for other in others:
                if other == "+1":
                    other = "%d" % (int(m.group()) + 1)
                yield name, m.start(), m.end(), other


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, **more)


def limit_time():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))


class Bench:
    """A copy of the sources, built once; then one object at a time."""

    def __init__(self, top, work, cc):
        self.work, self.cc = work, cc
        for folder in ("src", "include", "tests", "man"):
            shutil.copytree(os.path.join(top, folder),
                            os.path.join(work, folder))
        self.flags = ["-std=c99", "-O1", "-ffp-contract=off", "-Iinclude",
                      "-fsanitize=bounds", "-fsanitize-undefined-trap-on-error",
                      "-Isrc", "-Itests", "-D_POSIX_C_SOURCE=200809L",
                      "-DHAVE_MPFR", "-DHAVE_GSL"]
        src = os.path.join(work, "src")
        self.sources = ["src/" + f for f in os.listdir(src)
                        if f.endswith(".c")]
        self.sources += ["src/methods/" + f
                         for f in os.listdir(os.path.join(src, "methods"))
                         if f.endswith(".c")]
        self.programs = sorted({t for t, _ in TESTS})
        self.common = ["tests/%s.c" % t
                       for t in ("families", "constructed", "oracle")]
        tests = ["tests/%s.c" % t for t in self.programs]
        if not self.compile(self.sources + self.common + tests):
            sys.exit("mutants: the sources do not compile as they are")

    def compile(self, sources):
        def job(source):
            return run([self.cc] + self.flags +
                       ["-c", source, "-o", source[:-2] + ".o"],
                       cwd=self.work).returncode == 0
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            return all(pool.map(job, sources))

    def users(self, name):
        """The library's sources that see this file."""
        if name.endswith(".c"):
            return ["src/" + name]
        seen = []
        for s in self.sources:
            rule = subprocess.run([self.cc] + self.flags + ["-MM", s],
                                  cwd=self.work, capture_output=True,
                                  text=True).stdout
            if "src/" + name in rule:
                seen.append(s)
        return seen

    def passes(self):
        """The first test to fail, or None."""
        objects = [s[:-2] + ".o" for s in self.sources + self.common]
        for test, environment in TESTS:
            program = "tests/" + test
            if run([self.cc, "-o", program, program + ".o"] + objects +
                   ["-lmpfr", "-lgmp", "-lgsl", "-lgslcblas", "-lm"],
                   cwd=self.work).returncode != 0:
                return "link"
            if run(["./" + program], cwd=self.work, preexec_fn=limit_time,
                   env=dict(os.environ, **environment)).returncode != 0:
                return test
        return None


def try_mutant(bench, texts, mutant, users):
    name, start, end, other = mutant
    text, path = texts[name], os.path.join(bench.work, "src", name)
    with open(path, "w") as f:
        f.write(text[:start] + other + text[end:])
    objects = [os.path.join(bench.work, u[:-2] + ".o") for u in users]
    for o in objects:
        os.rename(o, o + ".kept")
    compiled = bench.compile(users)
    killer = bench.passes() if compiled else "compiler"
    with open(path, "w") as f:
        f.write(text)
    for o in objects:
        os.replace(o + ".kept", o)
    return killer


def line_of(texts, mutant):
    return texts[mutant[0]].count("\n", 0, mutant[1]) + 1


def describe(texts, mutant):
    """What is changed, by its text: line numbers do not last."""
    name, start, end, other = mutant
    line = texts[name].splitlines()[line_of(texts, mutant) - 1].strip()
    return "%r -> %r: %s" % (texts[name][start:end], other, line)


def key(texts, mutant):
    return "src/%s: %s" % (mutant[0], describe(texts, mutant))


def keys_of(path):
    """Of a run's output, or of mutants.txt, where `#` begins a reason."""
    with open(path) as f:
        lines = [line.split("  #")[0].strip() for line in f]
    return {re.sub(r"^(src/[^:]*):\d+:", r"\1:", line) for line in lines}


def choose(args, texts):
    every = [m for n in texts for m in mutants_of(n, texts[n])]
    if args.again:
        again = keys_of(args.again)
        return every, [m for m in every if key(texts, m) in again]
    chosen = random.Random(args.seed).sample(every, len(every))
    return every, chosen[args.skip:args.skip + args.count]


def main():
    p = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    p.add_argument("--count", type=int, default=300)
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--skip", type=int, default=0)
    p.add_argument("--cc", default="cc")
    p.add_argument("--files", default=",".join(CORE))
    p.add_argument("--again")
    args = p.parse_args()
    tests = os.path.dirname(os.path.abspath(__file__))
    understood = keys_of(os.path.join(tests, "mutants.txt"))
    with tempfile.TemporaryDirectory() as work:
        bench = Bench(os.path.dirname(tests), os.path.join(work, "copy"),
                      args.cc)
        texts = {n: open(os.path.join(bench.work, "src", n)).read()
                 for n in args.files.split(",")}
        users = {n: bench.users(n) for n in texts}
        every, chosen = choose(args, texts)
        failing = bench.passes()
        if failing:
            sys.exit("mutants: %s fails before anything is changed" % failing)
        count = dict.fromkeys(("killed", "senseless", "understood",
                               "survived"), 0)
        for mutant in chosen:
            killer = try_mutant(bench, texts, mutant, users[mutant[0]])
            fate = ("senseless" if killer in ("compiler", "link") else
                    "killed" if killer else
                    "understood" if key(texts, mutant) in understood else
                    "survived")
            count[fate] += 1
            if fate == "survived":
                print("src/%s:%d: %s" % (mutant[0], line_of(texts, mutant),
                                         describe(texts, mutant)), flush=True)
        print("%d possible, %d tried: %d killed, %d did not compile, "
              "%d survived as they must, %d survived"
              % (len(every), len(chosen), count["killed"], count["senseless"],
                 count["understood"], count["survived"]))


if __name__ == "__main__":
    main()
