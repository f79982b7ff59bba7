"""Prints comments in C and pages (*.md) that name what does not exist.

A file in a comment has a name of three letters or more; it is in the repository, or
some file includes it as <name>.  A function has an underscore and is a word of the
code.  A path in a page is one from the top or from the page's folder.
"""
import os
import re
import sys

os.chdir(os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "../.."))
COMMENT = re.compile(r"/\*.*?\*/", re.S)
PATH = re.compile(r"`((?!build/)\w+/[\w./-]+\.\w+)`")
names, code, comments, found = {"example.c"}, set(), {}, []
for folder, folders, files in os.walk("."):
    folders[:] = [f for f in folders if f != ".git" and not f.startswith("build")]
    names |= set(files)
    for file in files:
        path = os.path.join(folder, file)[2:]
        if not re.search(r"\.(c|h|cc|py|sh|awk|md)$", file):
            continue
        with open(path, errors="replace") as opened:
            text = opened.read()
        if file.endswith(".md"):
            found += [(path, x) for x in PATH.findall(text)
                      if not os.path.exists(x) and not os.path.exists(os.path.join(folder, x))]
        if file.endswith((".c", ".h", ".cc")):
            comments[path] = " ".join(COMMENT.findall(text))
            text = COMMENT.sub(" ", text)
        names |= set(re.findall(r"#\s*include <([\w/.]+)>", text))
        code |= set(re.findall(r"\w+", text))
for path, text in comments.items():
    named = set(re.findall(r"\b\w{3,}\.(?:c|h|cc|py|sh|awk|mk)\b", text)) - names
    called = set(re.findall(r"\b([a-z]\w*_\w+)\(\)", text)) - code
    found += [(path, x) for x in sorted(named | called)]
print("".join("%s: there is no %s\n" % x for x in found), end="")
sys.exit(bool(found))
