"""Prints comments in C and pages (*.md) that name what does not exist.

A file in a comment has a name of three letters or more; it is in the repository, or
some file includes it as <name>.  A function has an underscore and is a word of the
code.  A path in a page is one from the top or from the page's folder.  A citation in
src, [AUTHORS YEAR], is in the list of references of cylint(3).  The first comment of a
test in C names the settings that it reads.
"""
import os
import re
import sys

os.chdir(os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "../.."))
SETTING = re.compile(r'check_setting\("(\w+)"|check_(seed)\(')
COMMENT = re.compile(r"/\*.*?\*/", re.S)
PATH = re.compile(r"`((?!build/)\w+/[\w./-]+\.\w+)`")
CITATION = re.compile(r"\[([A-Z][a-z]+)(?:, [A-Z][a-z]+)* (\d{4})(?:\]|, [A-Z])")
names, code, comments, found = {"example.c"}, set(), {}, []
with open("man/cylint.3") as manual:
    listed = re.findall(r"(?s)\.Rs\n(.*?)\.Re", manual.read())
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
            read = {name or "CYLINT_SEED" for name, _ in SETTING.findall(text)}
            found += [(path, "first comment that names " + x) for x in sorted(read)
                      if file.startswith("test_") and x not in COMMENT.search(text)[0]]
            text = COMMENT.sub(" ", text)
        names |= set(re.findall(r"#\s*include <([\w/.]+)>", text))
        code |= set(re.findall(r"\w+", text))
for path, text in comments.items():
    named = set(re.findall(r"\b\w{3,}\.(?:c|h|cc|py|sh|awk|mk)\b", text)) - names
    called = set(re.findall(r"\b([a-z]\w*_\w+)\(\)", text)) - code
    found += [(path, x) for x in sorted(named | called)]
    cited = CITATION.findall(re.sub(r"\n \* ", " ", text)) if path.startswith("src/") else []
    found += [(path, "[%s %s]" % x) for x in cited
              if not any(re.search(r"%%A .*\b%s\n(?s:.*)%%D %s" % x, y) for y in listed)]
print("".join("%s: there is no %s\n" % x for x in found), end="")
sys.exit(bool(found))
