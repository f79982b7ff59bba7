# Time of Python's readers for a file of 13 numbers a line.  All columns are
# summed, so that every number is read.  usage: text_readers.py NAME FILE THREADS
# Prints elapsed seconds and processor seconds of reading, and peak resident
# memory in KiB; exits with status 77 without the library.
import importlib.util
import os
import resource
import sys
import time

name, path, threads = sys.argv[1], sys.argv[2], int(sys.argv[3])
if importlib.util.find_spec(name) is None:
    sys.exit(77)
os.environ["POLARS_MAX_THREADS"] = sys.argv[3]


def reader():
    if name == "pandas":
        import pandas

        return lambda: pandas.read_csv(path, sep=" ", header=None).sum()
    if name == "polars":
        import polars

        return lambda: polars.read_csv(
            path, separator=" ", has_header=False
        ).sum()
    import duckdb

    base = duckdb.connect(config={"threads": threads})
    columns = ", ".join(f"'c{i}': 'DOUBLE'" for i in range(13))
    sums = ", ".join(f"sum(c{i})" for i in range(13))
    query = (
        f"SELECT {sums} FROM read_csv('{path}', delim=' ', "
        f"header=false, columns={{{columns}}})"
    )
    return lambda: base.execute(query).fetchall()


read = reader()
clock, processor = time.perf_counter(), time.process_time()
read()
print(
    f"{time.perf_counter() - clock:.3f} {time.process_time() - processor:.3f}"
    f" {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss}"
)
