"""The lines of output of the scripts here: those of bench.c."""


def print_header():
    print("case,subject,question,order,rival,unit,theirs,ours,ratio")


def print_row(case, subject, question, rival, unit, theirs, ours):
    """theirs, ours: None if there is no rival, or nothing to judge ours by."""
    figures = ["-" if x is None else f"{x:.4g}" for x in (theirs, ours)]
    ratio = f"{ours / theirs:.4g}" if theirs and ours is not None else "-"
    print(f"{case + ',':9} {subject + ',':19} {question + ',':43} -,        "
          f"{rival + ',':21} {unit + ',':3} {figures[0]}, {figures[1]}, {ratio}", flush=True)
