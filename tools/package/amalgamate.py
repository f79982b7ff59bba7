"""Joins the library's sources to one file.

usage: amalgamate.py CC OUTPUT VERSION FILE.c... [FILE-NAME=FLAGS]...

OUTPUT compiles with `cc -c cylint.c`.  Every FILE.c is a section.  A further
argument adds a section for an instruction set: FILE.c again with -D and -m of
FLAGS, for gcc and clang on x86.

Headers that are the same for all files come first.  Headers that depend on the
instruction set (they include a header of intrinsics) and templates stand in each
section that includes them.  The macros of a section are undefined at its end.
Names of file scope that several sections define get the section's number: the
preprocessor (CC -E) shows the names, and #define renames them.
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
PUBLIC = {
    "cylint.h",
    "cylint_distance.h",
    "cylint_methods.h",
    "cylint_pieces.h",
    "cylint_scene.h",
}
X86 = "defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))"


# ----------------------------------------------------------- include files --


def resolve(name, includer):
    """The path of an included file of the project; None for a public header."""
    beside = (includer.parent / name).resolve()
    if beside.exists():
        return beside
    if name in PUBLIC:
        return None
    raise SystemExit(f"{includer}: cannot find {name}")


def included(path):
    found = [INCLUDE.match(line) for line in path.read_text().splitlines()]
    files = [resolve(m[1], path) for m in found if m]
    return [f for f in files if f is not None]


def is_repeated(path):
    """Whether it has no guard: a template, or a part of a file."""
    return not re.search(r"^#ifndef \w+_H$", path.read_text(), re.M)


@functools.cache
def is_private(path):
    """Whether a header belongs to each section that includes it."""
    return (
        is_repeated(path)
        or path.name.endswith("simd.h")
        or any(is_private(f) and not is_repeated(f) for f in included(path))
    )


def private_files(path):
    """A file and the private headers that it includes."""
    files = {path}
    for header in included(path):
        if is_private(header):
            files |= private_files(header)
    return files


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


def text_of(path, done):
    """The lines of a file with its includes in their places.

    done: the private headers with guards that this section has already.
    """
    lines = [f"/* {path.parent.name}/{path.name} */"]
    for line in path.read_text().splitlines():
        match = INCLUDE.match(line)
        if not match:
            lines.append(line)
            continue
        file = resolve(match[1], path)
        if file is None or not is_private(file) or file in done:
            continue
        if not is_repeated(file):
            done.add(file)
        lines += text_of(file, done)
    return lines


# ------------------------------------------------------ names of file scope --


def tokens_of(cc, path, flags, private):
    """The tokens of the preprocessed file, those of private files marked."""
    command = [*cc.split(), "-E", "-std=c99", "-Iinclude", *flags, str(path)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    chain = [True]  # for the files that include each other: all are private
    for line in done.stdout.splitlines():
        marker = re.match(r'# \d+ "(.*)"((?: \d)*)', line)
        if marker:
            flags = marker[2].split()
            if "1" in flags:
                file = Path(marker[1])
                private_file = file.exists() and file.resolve() in private
                chain.append(chain[-1] and private_file)
            elif "2" in flags:
                chain.pop()
            continue
        inside = chain[-1]
        if line.startswith("#"):
            continue
        for token in re.findall(
            r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'])+\'|\w+|\S', line
        ):
            yield token, inside


def is_name(token):
    return re.match(r"[A-Za-z_]\w*$", token) is not None


def enumerators(body):
    depth, fresh = 0, True
    for token in body:
        depth += token in "({"
        depth -= token in ")}"
        if fresh and is_name(token):
            yield token
        fresh = token == "," and depth == 0


def drop_attributes(tokens):
    """Without __attribute__((...)) and _Pragma(...)."""
    kept, i = [], 0
    while i < len(tokens):
        if tokens[i] in ("__attribute__", "_Pragma", "__pragma"):
            depth, i = 0, i + 1
            while True:
                depth += {"(": 1, ")": -1}.get(tokens[i], 0)
                i += 1
                if depth == 0:
                    break
        else:
            kept.append(tokens[i])
            i += 1
    return kept


def names_in(declaration):
    """The names that a declaration of file scope defines, but external ones.

    declaration: tokens; the tokens within braces are lists.
    """
    flat = drop_attributes(declaration)
    for i, token in enumerate(flat):
        if token in ("struct", "union", "enum") and i + 1 < len(flat):
            tag = flat[i + 1] if not isinstance(flat[i + 1], list) else None
            body = flat[i + 2] if tag and i + 2 < len(flat) else flat[i + 1]
            if isinstance(body, list):
                if tag:
                    yield tag
                if token == "enum":
                    yield from enumerators(body)
    if "typedef" not in flat and "static" not in flat:
        return
    words = [t for t in flat if not isinstance(t, list)]
    if "(" in words and "=" not in words[: words.index("(")]:
        at = words.index("(")
        yield words[at + 2] if words[at + 1] == "*" else words[at - 1]
        return
    for i, token in enumerate(words):
        if token in "=[;," and is_name(words[i - 1]):
            yield words[i - 1]
            if token in "=[;":
                return


def names_of(cc, path, flags, private):
    names, declaration, stack, mine = set(), [], [], False
    for token, inside in tokens_of(cc, path, flags, private):
        if token == "{":
            stack.append(declaration)
            declaration = []
            continue
        if token == "}":
            body, declaration = declaration, stack.pop()
            declaration.append(body)
            ends = not stack and ")" in declaration and "=" not in declaration
        else:
            declaration.append(token)
            ends = not stack and token == ";"
        mine = mine or (inside and not stack)
        if ends:
            if mine:
                names.update(names_in(declaration))
            declaration, mine = [], False
    return names


def names_in_text(lines):
    matches = filter(None, map(DEFINED.match, lines))
    return {next(filter(None, match.groups())) for match in matches}


# ---------------------------------------------------------------- sections --


class Section:
    def __init__(self, path, flags, cc):
        self.path = path
        self.flags = flags.split()
        self.done = set()
        self.lines = text_of(path, self.done)
        private = private_files(path)
        defined = ["-DCYLINT_BUILDS_X86"] if flags else []
        self.names = names_of(cc, path, self.flags + defined, private)
        self.names |= names_in_text(self.lines)
        self.names -= set(self.macros())

    def macros(self):
        """The macros that are defined at the section's end, perhaps."""
        found = [re.match(r" *# *define (\w+)", line) for line in self.lines]
        return sorted({m[1] for m in found if m})

    def isa(self):
        """The instruction sets, as names of gcc.  Options with a value only
        change the speed."""
        return [f[2:] for f in self.flags if f.startswith("-m") and "=" not in f]

    def write(self, out, number, clashing):
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
        out += [f"#define {name} {value}" for name, value in defined]
        out += [f"#define {name} {name}_{number}" for name in renamed]
        out += self.lines
        for name in [*self.macros(), *renamed, *(d[0] for d in defined)]:
            out.append(f"#undef {name}")
        if target:
            out += target_end(target)
            out.append("#endif")


def feature(isa):
    return f"__{isa.upper()}__"


def target_begin(target):
    """gcc's pragma defines the macros of the instruction sets; clang's does
    not."""
    text = ",".join(target)
    return [
        "#ifdef __clang__",
        f'#pragma clang attribute push(__attribute__((target("{text}"))), \\',
        "                             apply_to = function)",
        *(
            line
            for isa in target
            for line in (
                f"#ifndef {feature(isa)}",
                f"#define {feature(isa)} 1",
                f"#define CYLINT_UNDEFINE_{isa.upper()}",
                "#endif",
            )
        ),
        "#else",
        "#pragma GCC push_options",
        f'#pragma GCC target("{text}")',
        "#endif",
    ]


def target_end(target):
    return [
        "#ifdef __clang__",
        "#pragma clang attribute pop",
        *(
            line
            for isa in target
            for line in (
                f"#ifdef CYLINT_UNDEFINE_{isa.upper()}",
                f"#undef {feature(isa)}",
                f"#undef CYLINT_UNDEFINE_{isa.upper()}",
                "#endif",
            )
        ),
        "#else",
        "#pragma GCC pop_options",
        "#endif",
    ]


PREAMBLE = """/*
 * cylint.c - libcylint {version} in one file; made by `make amalgamation`
 *
 * Compile it with `cc -O2 -c cylint.c`; programs include cylint.h and link with
 * -lm.  Scenes, of cylint_scene.h, use threads with -DCYLINT_THREADS -pthread.
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
#define _DEFAULT_SOURCE 1 /* threads and madvise() with -std=c99 */
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
#ifdef __clang__
#pragma clang diagnostic ignored "-Wunused-function"
#elif defined(__GNUC__)
/* The vectorizer of gcc 12 compiles (double)(float)x to x where two of them are
 * adjacent. */
#pragma GCC optimize("fp-contract=off", "no-tree-slp-vectorize")
#if __GNUC__ >= 11 /* false alarms where functions of two sections inline */
#pragma GCC diagnostic ignored "-Wstringop-overread"
#endif
#endif
"""


def main(cc, output, version, *arguments):
    plain = [Path(a).resolve() for a in arguments if "=" not in a]
    sections = [Section(path, "", cc) for path in plain]
    for argument in arguments:
        if "=" in argument:
            name, flags = argument.split("=", 1)
            path = Path(re.sub(r"-\w+$", ".c", name)).resolve()
            sections.append(Section(path, flags, cc))
    headers = []
    for header in shared_headers(plain):
        headers += text_of(header, set())
    counts = Counter(name for s in sections for name in s.names)
    clashing = {name for name, count in counts.items() if count > 1}
    clashing |= names_in_text(headers)
    licence = "\n".join(
        f" * {line}".rstrip()
        for line in Path("LICENSE").read_text().splitlines()
    )
    out = [PREAMBLE.format(version=version, licence=licence, x86=X86), *headers]
    for number, section in enumerate(sections):
        section.write(out, number, clashing)
    Path(output).write_text("\n".join([*out, "#endif"]) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
