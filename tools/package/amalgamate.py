"""Joins the library's sources to one C file, which has each text once.

usage: amalgamate.py CC OUTPUT VERSION FILE.c... [FILE-NAME=FLAGS]...

OUTPUT, cylint.c, compiles with `cc -c cylint.c`.  Every FILE.c is a section.  A further
argument adds a section for an instruction set: FILE.c again with -D and -m of
FLAGS, for gcc and clang on x86.

Headers that are the same for all files come first.  A part is a text that several
sections need under different macros: a template; a header of an instruction set (it
includes a header of intrinsics), if several files include it; a file with several
builds.  Parts stand in two files beside OUTPUT: cylint_templates.h has the templates,
cylint_builds.h the others.  OUTPUT defines CYLINT_PART, the number of a part, and
includes its file.  Part 1 of cylint_templates.h undefines all macros of parts.  There
are two files because compilers read a file to its end.

Names of file scope get the number of their section: all names of parts, and the names of
other files that several files define.  The preprocessor (CC -E) shows the names, and
#define renames them.
"""

import functools
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

INCLUDE = re.compile(r'^ *# *include "(.*)"')
# What a line of text defines, also where the preprocessor leaves it out: code for
# other processors than that of CC.
DEFINED = re.compile(
    r"^(?:static|INLINE|CYLINT_INLINE|ASIDE) [^=;(]*?\b(\w+)\("
    r"|^typedef [^(]*?\b(\w+);|^} (\w+);"
)
# Strings, __attribute__((...)) and _Pragma(...).
LEFT_OUT = re.compile(
    r'"(?:\\.|[^"\\])*"'
    r"|\b(?:__attribute__|_Pragma|__pragma)\s*\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)"
)
# The names in text whose braces, with what they contain, are @: of functions and
# objects, of structs, of types, of types of functions.
NAMED = [
    re.compile(r"\bstatic\b[^=;@(]*?(\w+)\s*(?:\[[^=;]*\]\s*)?[=;(]"),
    re.compile(r"\b(?:struct|union|enum)\s+(\w+)\s*@"),
    re.compile(r"\btypedef\b[^;]*?(\w+)\s*(?:\[[^;]*\]\s*)?;"),
    re.compile(r"\btypedef\b[^;(]*?(?:\(\s*\*\s*)?(\w+)\s*\)?\s*\("),
]
X86 = "defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__)) && !defined(CYLINT_PLAIN)"


# ----------------------------------------------------------- include files --


def resolve(name, includer):
    """The path of an included file of the project; None for a public header."""
    beside = (includer.parent / name).resolve()
    if beside.exists():
        return beside
    if Path("include", name).exists():
        return None
    raise SystemExit(f"{includer}: cannot find {name}")


@functools.cache
def included(path):
    """The files that it includes."""
    names = map(INCLUDE.match, path.read_text().splitlines())
    files = [resolve(m[1], path) for m in names if m]
    return [f for f in files if f is not None]


@functools.cache
def guard_of(path):
    """The macro of a header; None for a template, or a part of a file."""
    match = re.search(r"^#ifndef (\w+_H)$", path.read_text(), re.M)
    return match and match[1]


@functools.cache
def is_private(path):
    """Whether a header belongs to each section that includes it."""
    return (
        not guard_of(path)
        or path.name.endswith("simd.h")
        or any(is_private(f) and guard_of(f) for f in included(path))
    )


def private_files(path):
    """A file and the private headers that it includes."""
    private = filter(is_private, included(path))
    return {path}.union(*map(private_files, private))


def included_once(files):
    """The private headers that one file includes, once: their text stands in that file."""
    reached = set().union(*map(private_files, files))
    count = Counter(header for path in reached for header in included(path))
    return {h for h, n in count.items() if n == 1 and is_private(h) and guard_of(h)}


def shared_headers(files):
    """The other headers, each after those that it includes."""
    order = []

    def visit(path):
        for header in included(path):
            visit(header)
        if path.suffix == ".h" and not is_private(path) and path not in order:
            order.append(path)

    for path in files:
        visit(path)
    return order


# ------------------------------------------------------------------- parts --


class Parts:
    """The texts that sections include: path -> number, from 2 on."""

    def __init__(self, files, built_again):
        self.number = {}
        self.alone = included_once(files)
        for path in files:
            self.collect(path)
        for path in filter(built_again.__contains__, files):
            self.add(path)
        self.templates = {
            p for p in self.number if not guard_of(p) and p not in built_again
        }

    def add(self, path):
        self.number.setdefault(path, len(self.number) + 2)

    def collect(self, path):
        for header in included(path):
            self.collect(header)
            if is_private(header) and header not in self.alone:
                self.add(header)

    def text(self, path):
        """The lines of a file, with includes of parts."""
        lines = [f"/* {path.parent.name}/{path.name} */"]
        for line in path.read_text().splitlines():
            match = INCLUDE.match(line)
            file = match and resolve(match[1], path)
            if not match:
                lines.append(line)
            elif file in self.number:
                lines += self.include(file)
            elif file in self.alone:
                lines += self.text(file)
        return lines

    def include(self, path):
        """A header, which has a guard, is read once."""
        name = "templates" if path in self.templates else "builds"
        guard = guard_of(path)
        lines = include_part(self.number[path], name)
        return [f"#ifndef {guard}", *lines, "#endif"] if guard else lines

    def write(self):
        """The lines of cylint_builds.h and of cylint_templates.h."""
        builds = ["#if 0"]
        templates = ["#if CYLINT_PART == 1"]
        templates += [f"#undef {name}" for name in self.macros()]
        for path, number in self.number.items():
            to = templates if path in self.templates else builds
            to.append(f"#elif CYLINT_PART == {number}")
            to += self.text(path)
        return [*builds, "#endif"], [*templates, "#endif"]

    def macros(self):
        lines = [line for path in self.number for line in self.text(path)]
        return sorted(macros_in(lines) - {"CYLINT_PART"})


def include_part(number, name):
    return [
        "#undef CYLINT_PART",
        f"#define CYLINT_PART {number}",
        f'#include "cylint_{name}.h"',
        "#undef CYLINT_PART",
    ]


def macros_in(lines):
    found = [re.match(r" *# *define (\w+)", line) for line in lines]
    return {m[1] for m in found if m}


# ------------------------------------------------------ names of file scope --


def private_text(cc, path, flags, private):
    """The preprocessed file without the other files that it includes."""
    command = [*cc.split(), "-E", "-std=c99", "-Iinclude", *flags, str(path)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    chain = [True]  # for the files that include each other: all are private
    lines = []
    for line in done.stdout.splitlines():
        marker = line[:1] == "#" and re.match(r'# \d+ "(.*)"((?: \d)*)', line)
        if marker and " 1" in marker[2]:
            file = Path(marker[1])
            chain.append(chain[-1] and file.exists() and file.resolve() in private)
        elif marker and " 2" in marker[2]:
            chain.pop()
        elif chain[-1] and not line.startswith("#"):
            lines.append(line)
    return "\n".join(lines)


def names_of(cc, path, flags, private):
    """The names that declarations of file scope define, but external ones."""
    text = LEFT_OUT.sub("", private_text(cc, path, flags, private))
    names = set()
    for body in re.findall(r"\benum\s*\w*\s*\{([^{}]*)\}", text):
        names |= set(re.findall(r"(?:^|,)\s*([A-Za-z_]\w*)", body))
    nested = 1
    while nested:
        text, nested = re.subn(r"\{[^{}]*\}", "@", text)
    return names.union(*(pattern.findall(text) for pattern in NAMED))


def names_in_text(lines):
    matches = filter(None, map(DEFINED.match, lines))
    return {next(filter(None, match.groups())) for match in matches}


# ---------------------------------------------------------------- sections --


class Section:
    def __init__(self, path, flags, cc, parts):
        self.path = path
        self.flags = flags.split()
        self.is_part = path in parts.number
        self.lines = parts.text(path)
        private = private_files(path)
        self.headers = [h for h in private if guard_of(h)]
        defined = ["-DCYLINT_BUILDS_X86"] if flags else []
        self.names = names_of(cc, path, self.flags + defined, private)
        self.names |= names_in_text(self.lines)
        for header in self.headers:
            self.names |= names_in_text(parts.text(header))
        self.names -= macros_in(self.lines)

    def is_private(self):
        return bool(self.headers or self.is_part)

    def isa(self):
        """The instruction sets, as names of gcc.  Options with a value only
        change the speed."""
        return [f[2:] for f in self.flags if f.startswith("-m") and "=" not in f]

    def write(self, out, number, clashing, parts):
        title = "/".join(self.path.parts[-2:])
        target = self.isa()
        out.append(
            f"/* {'-' * 20} {title} {' '.join(self.flags)} {'-' * 20} */"
        )
        renamed = sorted(self.names & clashing)
        defined = [f[2:].split("=") for f in self.flags if f.startswith("-D")]
        if target:
            out.append(f"#if {X86}")
            out += target_begin(target)
        out.append(f"#define CYLINT_SECTION {number}")
        out += [f"#define {name} {value}" for name, value in defined]
        out += [f"#define {name} CYLINT_OWN({name})" for name in renamed]
        out += parts.include(self.path) if self.is_part else self.lines
        if self.is_private():
            out += include_part(1, "templates")
        # musl reads _GNU_SOURCE in each of its headers.
        kept = macros_in(PREAMBLE.splitlines())
        mine = [] if self.is_part else sorted(macros_in(self.lines) - kept)
        for name in [*mine, *renamed, *(d[0] for d in defined)]:
            out.append(f"#undef {name}")
        out.append("#undef CYLINT_SECTION")
        if target:
            out += target_end(target)
            out.append("#endif")


def feature(isa):
    return f"__{isa.upper()}__"


def by_compiler(clang, gcc):
    return ["#ifdef __clang__", *clang, "#else", *gcc, "#endif"]


def target_begin(target):
    """gcc's pragma defines the macros of the instruction sets; clang's does
    not."""
    text = ",".join(target)
    clang = [
        f'#pragma clang attribute push(__attribute__((target("{text}"))), \\',
        "                             apply_to = function)",
    ]
    for isa in target:
        name = feature(isa)
        clang += [f'#pragma push_macro("{name}")', f"#define {name} 1"]
    gcc = ["#pragma GCC push_options", f'#pragma GCC target("{text}")']
    return by_compiler(clang, gcc)


def target_end(target):
    clang = [f'#pragma pop_macro("{feature(isa)}")' for isa in target]
    clang.append("#pragma clang attribute pop")
    return by_compiler(clang, ["#pragma GCC pop_options"])


PREAMBLE = """/*
 * cylint.c - libcylint {version} in one file; made by `make amalgamation`
 *
 * Compile it with `cc -O2 -c cylint.c`; cylint_builds.h and cylint_templates.h lie beside
 * it.  Programs include cylint.h and link with -lm.  Scenes, of cylint_scene.h, use
 * threads with -DCYLINT_THREADS -pthread.  -DCYLINT_PLAIN leaves out the kernels for AVX2
 * and AVX-512, which take half of the time to compile.
 * gcc and clang need no other flags: the file turns the contraction of a * b + c
 * off, and compiles the kernels for AVX2 and AVX-512 by attributes.  Other
 * compilers must not contract; cylint_selftest() reports if they do.
 *
{licence}
 */
#ifdef __cplusplus
#error "cylint.c is C: compile it with a C compiler and link it to C++ programs."
#else

#ifdef __linux__
#define _GNU_SOURCE 1 /* threads and madvise() with -std=c99 */
#endif
#include "cylint.h"
#include "cylint_distance.h"
#include "cylint_methods.h"
#include "cylint_pieces.h"
#include "cylint_scene.h"

#if {x86}
#define CYLINT_BUILDS_X86
#include <immintrin.h>
#endif
#ifdef __GNUC__ /* locals have names that other sections have at file scope */
#pragma GCC diagnostic ignored "-Wshadow"
#endif
#ifdef __clang__
#pragma clang diagnostic ignored "-Wunused-function"
#elif defined(__GNUC__)
/* The vectorizer of gcc 12 compiles (double)(float)x to x where two of them are
 * adjacent. */
#pragma GCC optimize("fp-contract=off", "no-tree-slp-vectorize")
/* false alarms: with -O3, and where functions of two sections inline */
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#if __GNUC__ >= 11
#pragma GCC diagnostic ignored "-Wstringop-overread"
#endif
#endif

/* A name with the number of the section. */
#define CYLINT_JOIN(x, number) x##_##number
#define CYLINT_JOINED(x, number) CYLINT_JOIN(x, number)
#define CYLINT_OWN(x) CYLINT_JOINED(x, CYLINT_SECTION)
"""


def main(cc, output, version, *arguments):
    plain = [Path(a).resolve() for a in arguments if "=" not in a]
    builds = [
        (Path(re.sub(r"-\w+$", ".c", name)).resolve(), flags)
        for name, flags in (a.split("=", 1) for a in arguments if "=" in a)
    ]
    parts = Parts(plain, {path for path, _ in builds})
    sections = [Section(p, f, cc, parts) for p, f in [*((p, "") for p in plain), *builds]]
    sections.sort(key=Section.is_private)
    shared = [s for s in sections if not s.is_private()]
    headers = [line for h in shared_headers(plain) for line in parts.text(h)]
    counts = Counter(name for s in shared for name in s.names)
    clashing = {name for name, count in counts.items() if count > 1}
    clashing |= names_in_text(headers)
    own = set().union(*(s.names for s in sections if s.is_private()))
    own -= set(parts.macros())
    licence = "\n".join(
        f" * {line}".rstrip()
        for line in Path("LICENSE").read_text().splitlines()
    )
    out = [
        PREAMBLE.format(version=version, licence=licence, x86=X86),
        *headers,
    ]
    for number, section in enumerate(shared):
        section.write(out, number, clashing, parts)
    out += [f"#define {name} CYLINT_OWN({name})" for name in sorted(own)]
    for number, section in enumerate(sections[len(shared):], len(shared)):
        section.write(out, number, set(), parts)
    Path(output).write_text("\n".join([*out, "#endif"]) + "\n")
    for name, lines in zip(("builds", "templates"), parts.write()):
        file = f"cylint_{name}.h"
        title = f"/* {file} - what cylint.c includes several times */"
        Path(output).with_name(file).write_text("\n".join([title, *lines]) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
