"""Reads the reasons that stand beside lines of the sources.

A comment of one of these forms, beside a line of code or above it:

    /* untaken N of M: REASON */     no test takes N of the M branches of the line
    /* untaken: REASON */            some of its branches are not taken everywhere
    /* untaken never called: REASON */   no test calls the function
    /* mutant 'a' -> 'b': REASON */  no test detects this change of the line;
                                     several changes are separated by commas

Above the first line of a function a comment is about all lines of it.
"""
import os
import re


def without_comments(text):
    """Comments, strings and directives become blanks of the same length."""
    blank = lambda m: re.sub(r"[^\n]", " ", m.group())
    text = re.sub(r"/\*.*?\*/", blank, text, flags=re.S)
    text = re.sub(r'"[^"\n]*"', blank, text)
    return re.sub(r"^#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)


def lines_of(code, comment):
    """The numbers of the lines that a comment is about."""
    lines = code.split("\n")
    first = code.count("\n", 0, comment.start())
    while first < len(lines) and not lines[first].strip():
        first += 1
    last = first
    if lines[first:] and re.match(r"\w", lines[first]):
        while last < len(lines) - 1 and lines[last] != "}":
            last += 1
    return range(first + 1, last + 2)


def beside_lines(text, word):
    """Yields (what, lines) of each comment of this word: what stands before the
    reason, and the numbers of the lines."""
    code = without_comments(text)
    for comment in re.finditer(r"/\*\s*%s\b(.*?)\*/" % word, text, re.S):
        said = re.sub(r"\s*\n\s*\*?\s*", " ", comment.group(1)).strip()
        what, colon, reason = said.partition(": ")
        if not colon or not reason.strip():
            raise SystemExit("no reason: " + comment.group())
        yield what.strip(), lines_of(code, comment)


def sources(top):
    """The names of all C files below src."""
    for place, _, names in sorted(os.walk(os.path.join(top, "src"))):
        for name in sorted(names):
            if name.endswith((".c", ".h")):
                yield os.path.relpath(os.path.join(place, name), top)
