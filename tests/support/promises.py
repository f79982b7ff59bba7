"""Checks tests/promises.txt, which names the tests of each promise.

    == DOCUMENT
    FOLDER/FILE[:PROPERTY] ...
      the beginning of a sentence of the document

The indented sentences below a line of tests are what these tests prove.  Each must
stand in the document, letter for letter but for blanks and signs; of a manual the
lines that begin with a dot do not count, but for the rows of a table.  Each property
must be one that its file runs; of a file of transcripts it begins a line of text.
Each function of a header must have a line `name()`.
"""
import functools
import os
import re
import sys

TOP = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "../..")


@functools.lru_cache(None)
def read(path):
    try:
        with open(os.path.join(TOP, path)) as file:
            return file.read()
    except OSError:
        return ""


@functools.lru_cache(None)
def words(path):
    text = read(path)
    if not path.endswith(".h"):
        text = re.sub(r"(?m)^\.(?!It .* Ta ).*$|\\f[BIRP]", "", text)
    return " %s " % " ".join(re.findall(r"\w+", text))


def is_run(test):
    """Whether the file of a test exists and runs the property."""
    path, _, name = test.partition(":")
    text = read("tests/" + path)
    pattern = r"(TEST|PROPERTY)\(%s\b" if path.endswith(".c") else r"(verdict|example|def) %s\b"
    if path.endswith(".txt"):
        pattern, name = r"(?m)^%s\b", name.replace("_", " ")
    return bool(text) and (not name or re.search(pattern % re.escape(name), text))


def faults(promises):
    document, tests, known = "", [], set()
    for number, line in enumerate(promises.splitlines(), 1):
        if line.startswith("== "):
            document = line[3:]
        elif line.startswith("  "):
            if " %s " % " ".join(re.findall(r"\w+", line)) not in words(document):
                yield "%d: not in %s: %s" % (number, document, line.strip())
            if not tests:
                yield "%d: no test" % number
            known.add((document, line.strip()))
        elif line and line[0] != "#":
            tests = line.split()
            for test in tests:
                if not is_run(test):
                    yield "%d: no test %s" % (number, test)
    for header in sorted(os.listdir(os.path.join(TOP, "include"))):
        declared = r"CYLINT_API[^;(]*?(cylint_\w+)\("
        for name in re.findall(declared, read("include/" + header)):
            if ("include/" + header, name + "()") not in known:
                yield "include/%s: %s() has no test" % (header, name)


found = ["tests/promises.txt:" + x for x in faults(read("tests/promises.txt"))]
print("\n".join(found), end="\n" if found else "")
sys.exit(bool(found))
