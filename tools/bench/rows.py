"""The lines of output of the scripts here: those of bench.c."""


def print_header():
    print("case,subject,question,order,rival,unit,theirs,ours,ratio")


def print_row(case, subject, question, rival, unit, theirs, ours):
    """theirs: None if there is no rival."""
    figure = "-" if theirs is None else f"{theirs:.4g}"
    ratio = f"{ours / theirs:.4g}" if theirs else "-"
    print(f"{case + ',':9} {subject + ',':19} {question + ',':43} -,        "
          f"{rival + ',':21} {unit + ',':3} {figure}, {ours:.4g}, {ratio}", flush=True)
