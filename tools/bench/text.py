"""The command beside polars and mawk.

usage: text.py COMMAND [--quick]

Records of 13 numbers with six decimals, a ray and a cylinder each.  The rivals read
these numbers and sum each column.  Times are of processor time on one core, in ns a
record, the least of the rounds, in which the contestants take turns.  The last lines
are megabytes in a second of that time.  The lines of output are those of bench.c.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

os.environ["POLARS_MAX_THREADS"] = "1"

import numpy as np  # noqa: E402
import polars  # noqa: E402
from rows import print_header, print_row  # noqa: E402

ROUNDS, COPIES = 5, 20
COMMAND, RECORDS = sys.argv[1], 200_000 if "--quick" in sys.argv else 2_000_000


def write_records(folder):
    """As text and as doubles."""
    random = np.random.default_rng(1)
    most = np.array([50] * 3 + [1] * 3 + [30] * 6)
    numbers = random.uniform(-1, 1, (RECORDS // COPIES, 12)) * most
    numbers = np.round(np.c_[numbers, random.uniform(5, 30, len(numbers))], 6)
    np.savetxt(folder / "some", numbers, "%.6f")
    (folder / "text").write_bytes((folder / "some").read_bytes() * COPIES)
    (folder / "doubles").write_bytes(numbers.tobytes() * COPIES)


def run(command, file):
    """Seconds of processor time."""
    with open(file) as text, open(os.devnull, "w") as sink:
        child = subprocess.Popen(command, stdin=text, stdout=sink)
        _, child.returncode, used = os.wait4(child.pid, 0)
    if child.returncode:
        raise OSError(command)
    return used.ru_utime + used.ru_stime


def by_polars(file):
    start = time.process_time()
    polars.read_csv(file, separator=" ", has_header=False).sum()
    return time.process_time() - start


def by_mawk(file):
    sums = "{ for (i = 1; i <= 13; i++) s[i] += $i } END { for (i in s) print s[i] }"
    return run(["mawk", sums], file)


def main():
    print_header()
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[-1:])
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        write_records(folder)
        ours = [COMMAND, "-k", "ray,cylinder", "-j", "1"]
        text = folder / "text"
        for rival, call in ("polars", by_polars), ("mawk sums", by_mawk):
            times = [(call(text), run(ours, text)) for _ in range(ROUNDS)]
            print_row("text", "command", "a record", rival, "ns",
                      *(1e9 * min(t) / RECORDS for t in zip(*times)))
        for name, flags in ("text", []), ("doubles", ["-b"]):
            file = folder / name
            least = min(run([*ours, *flags], file) for _ in range(ROUNDS))
            print_row("text", "command", name, "-", "MB/s", None, file.stat().st_size / least / 1e6)


if __name__ == "__main__":
    main()
