"""The recipe spark-arrow: its input from text, its answers as text.

usage: table.py make RAYS.TXT RAYS.PARQUET
       table.py show ANSWERS

`show` prints the answers in the order of their labels, as `cylint -p 17 -f shape,t`
prints them.
"""

import sys

import pyarrow as pa
import pyarrow.parquet as parquet

NUMBERS = ("ox", "oy", "oz", "dx", "dy", "dz")


def make(text, table):
    with open(text) as file:
        rows = [line.split() for line in file]
    # rye for ray, a bad record of text, is a direction of length 0 in a table
    columns = {
        name: [float(row[i + 1]) if row[0] == "ray" else 0.0 for row in rows]
        for i, name in enumerate(NUMBERS)
    }
    columns["id"] = [" ".join(row[7:]) for row in rows]
    parquet.write_table(
        pa.table(columns), table, row_group_size=2000, compression="gzip"
    )


def show(answers):
    table = parquet.read_table(answers).to_pylist()
    for row in sorted(table, key=lambda row: int(row["id"].split("ray")[1])):
        print(row["index"] + 1, f"{row['t']:.17g}", row["id"], sep="\t")


if __name__ == "__main__":
    {"make": make, "show": show}[sys.argv[1]](*sys.argv[2:])
