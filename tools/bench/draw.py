"""Draws time against error of the methods in a file of `bench methods`.

usage: draw.py METHODS.csv SUBJECT >CHART.svg

A panel for each family of lines: nanoseconds of both t, and the error that 99 % of all t
do not exceed, in radii.  Both axes are logarithmic, and less is better.  libcylint's
error is at most half a unit in the last place, drawn at 1e-17; "wrong" are verdicts.
"""

import csv
import sys
from math import log10

WIDTH, HEIGHT, LEFT, TOP = 300, 250, 56, 34
COLOURS = "#1b6e3c #c0392b #2c5aa0 #b8860b #7d3c98 #00838f #555555".split()
TIMES, ERRORS = (1, 3.2), (-17.5, 4)  # exponents of ten


def read(name, subject):
    """family -> method -> [ns, error, wrong]"""
    families = {}
    with open(name, newline="") as file:
        for row in csv.DictReader(file, skipinitialspace=True):
            if row["subject"] != subject or row["case"] == "case":
                continue
            family, _, what = row["question"].partition("; ")
            methods = families.setdefault(family, {"libcylint": [1e9, 0, 0]})
            figures = methods.setdefault(row["rival"], [0, 0, 0])
            if not what:
                figures[0] = float(row["theirs"])
                best = list(row.values())[-2]
                methods["libcylint"][0] = min(methods["libcylint"][0], float(best))
            elif what.startswith("error"):
                figures[1] = float(row["theirs"])
            elif what == "wrong":
                figures[2] = float(row["theirs"])
    return families


def scaled(value, low, high, length):
    return (min(max(log10(max(value, 1e-300)), low), high) - low) / (high - low) * length


def panel(family, methods, left, top):
    yield (f'<g transform="translate({left},{top})"><text y="-8" font-weight="bold">'
           f'{family}</text><rect width="{WIDTH}" height="{HEIGHT}" fill="none" '
           'stroke="#999"/>')
    for power in 1, 2, 3:
        x = scaled(10**power, *TIMES, WIDTH)
        yield (f'<path d="M{x:.0f} 0V{HEIGHT}" stroke="#ddd"/><text x="{x:.0f}" '
               f'y="{HEIGHT + 14}" text-anchor="middle">{10**power} ns</text>')
    for power in range(-16, 4, 4):
        y = HEIGHT - scaled(10.0**power, *ERRORS, HEIGHT)
        yield (f'<path d="M0 {y:.0f}H{WIDTH}" stroke="#ddd"/><text x="-4" '
               f'y="{y + 4:.0f}" text-anchor="end">1e{power}</text>')
    for i, (name, (ns, error, wrong)) in enumerate(methods.items()):
        x = scaled(ns, *TIMES, WIDTH)
        y = HEIGHT - scaled(max(error, 1e-17), *ERRORS, HEIGHT)
        label = name + (f" ({wrong:.2g} % wrong)" if wrong else "")
        colour = COLOURS[i % len(COLOURS)]
        yield (f'<circle cx="{x:.0f}" cy="{y:.0f}" r="4" fill="{colour}"/><text '
               f'x="{WIDTH - 6}" y="{HEIGHT - 105 + 13 * i}" text-anchor="end" '
               f'fill="{colour}">{label}</text>')
    yield "</g>"


def main():
    families = read(sys.argv[1], sys.argv[2])
    width, height = 2 * (WIDTH + LEFT) + 110, 2 * (HEIGHT + TOP + 22)
    print(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
          'font-family="sans-serif" font-size="11"><rect width="100%" height="100%" '
          'fill="white"/>')
    for i, (family, methods) in enumerate(families.items()):
        left = LEFT + i % 2 * (WIDTH + LEFT + 50)
        for line in panel(family, methods, left, TOP + i // 2 * (HEIGHT + TOP + 16)):
            print(line)
    print("</svg>")


if __name__ == "__main__":
    main()
