"""Calls: threads, interrupts, progress, ownership, references, memory."""

import contextlib
import gc
import inspect
import os
import re
import resource
import signal
import subprocess
import sys
import threading
import time
import tracemalloc

import numpy as np
import pytest
from conftest import ROD, drawn, equal, forest, rays, refused, same

import libcylint as cylint

BIG = 200_000


def test_arguments_have_the_names_that_are_documented():
    """Each function that reads no file, with all arguments by their names."""
    shapes, point = forest(3, 30), [0.0, 0.0, 0.0]
    given = dict.fromkeys("p0 c p v origins points".split(), point)
    given |= dict.fromkeys("p1 a n u directions".split(), [1.0, 0.0, 0.0])
    given |= dict.fromkeys("r r0 r1 k tangent degrees outer clause".split(), 1)
    given |= {"shapes": shapes, "b": [0, 1, 0], "h": [0, 0, 1]}
    given |= {"labels": "x", "shape": 0, "solid": 0}
    scene = cylint.Scene(shapes=shapes, threads=None, progress=None)
    called = 0
    for of in (cylint, shapes, scene):
        for name in cylint.__all__ if of is cylint else dir(of):
            function = getattr(of, name)
            if name[0] == "_" or not inspect.isroutine(function):
                continue
            taken = inspect.signature(function).parameters
            if "path" in taken or name == "reshape":
                continue
            function(**{
                key: given[key] if p.default is p.empty or key == "directions" else p.default
                for key, p in taken.items()
            })
            called += 1
    assert called > 30


def test_threads_make_no_difference():
    shapes, (o, d), hard = forest(500, 31), rays(20_000, 32), drawn(20_000, 32)
    scene, points = cylint.Scene(shapes, threads=1), o[:2000]
    for call, *members in (
        (lambda t: scene.nearest(o, d, threads=t), "index", "t"),
        (lambda t: cylint.intersect(shapes[:40, None], *hard, threads=t), "t", "n"),
        (lambda t: scene.all(o, d, threads=t), "line", "index", "t"),
        (lambda t: scene.closest(points, threads=t), "index", "point"),
        (lambda t: scene.within(points, 0.05, threads=t), "point", "index", "distance"),
        (lambda t: shapes[:9, None].distance(o, threads=t), "T"),
    ):
        one = call(1)
        assert np.isfinite(getattr(one, members[-1])).any()
        for threads in (2, 3, 8):
            assert equal(one, call(threads), *members)


def test_threads_are_a_whole_number():
    call, line = cylint.Scene(ROD).any, ([0, 0, 0], [0, 0, 1])
    with refused("threads: expected at least 1, found 0"):
        call(*line, threads=0)
    for wrong in (1.5, "2", [1]):
        with refused("threads: expected an integer", TypeError):
            call(*line, threads=wrong)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert call(*line, threads=np.int16(2)) and call(*line, threads=2**70)
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert after - before < 10_000  # kB: nothing for threads without work


def test_threads_of_python_share_a_scene():
    scene = cylint.Scene(forest(500, 33))
    o, d = rays(100_000, 34)
    want, got = scene.nearest(o, d).index, [None] * 4

    def call(i):
        got[i] = scene.nearest(o, d, threads=1).index

    threads = [threading.Thread(target=call, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(want, index) for index in got)


def test_other_threads_run_during_a_call():
    """The lock is released: a counter counts while a call computes."""
    scene = cylint.Scene(forest(2000, 35))
    (o, d), counts, stop = rays(100_000, 36), [0], threading.Event()

    def count():
        while not stop.is_set():
            counts[0] += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    time.sleep(0.05)
    before, start = counts[0], time.perf_counter()
    scene.count(o, d, threads=1)
    spent, during = time.perf_counter() - start, counts[0] - before
    stop.set()
    counter.join()
    assert spent > 0.02
    assert during > 5


@contextlib.contextmanager
def interrupted(after):
    """Runs a block that Ctrl-C ends; returns the seconds until then in a list."""
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_REAL, after)
    start, spent = time.perf_counter(), []
    try:
        with pytest.raises(KeyboardInterrupt):
            yield spent
        spent.append(time.perf_counter() - start)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_a_signal_ends_a_call():
    scene = cylint.Scene(forest(2000, 37))
    o, d = rays(1000, 38)
    d = np.broadcast_to(d, (30_000, 1000, 3))  # minutes of work
    end = time.perf_counter() + 60
    with interrupted(0.2) as spent:
        while time.perf_counter() < end:
            scene.count(o, d)
    assert spent[0] < 5


def sticks(n, seed):
    random = np.random.default_rng(seed)
    base = random.random((n, 3))
    return cylint.cylinder(base, base + random.normal(size=(n, 3)) * 0.02, 0.002)


def test_a_signal_ends_the_building_of_a_scene():
    """It ends long before the scene is built."""
    shapes = sticks(300_000, 62)
    start = time.perf_counter()
    cylint.Scene(shapes, threads=1)
    whole = time.perf_counter() - start
    with interrupted(whole / 20) as spent:
        cylint.Scene(shapes, threads=1)
    assert spent[0] < whole / 2


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are of POSIX")
def test_a_signal_ends_the_reading_of_a_pipe(tmp_path):
    """No process writes to it, and then one waits in the middle of a scene."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for read in (cylint.read_scene, cylint.Scene.read):
        with interrupted(0.2):
            read(pipe)
        writer = os.open(pipe, os.O_RDWR)
        os.write(writer, b"sphere 0 0 0 1\n")
        with interrupted(0.2):
            read(pipe)
        os.close(writer)


def scene_and_lines():
    return cylint.Scene(forest(2000, 39)), *rays(200_000, 40)


def test_progress_grows_to_the_total():
    shapes, (scene, o, d) = sticks(300_000, 63), scene_and_lines()
    for total, call in (
        (300_000, lambda report: cylint.Scene(shapes, threads=1, progress=report)),
        (200_000, lambda report: scene.count(o, d, threads=1, progress=report)),
        (1, lambda report: cylint.Scene(ROD, progress=report)),
    ):
        calls = []
        call(lambda *a: calls.append(a))
        assert calls[-1] == (total, total) and calls == sorted(calls)
        assert all(most == total for _, most in calls) and (len(calls) > 2 or total == 1)


def test_an_exception_of_progress_ends_the_call():
    def fail(done, total):
        raise LookupError("enough")

    scene, o, d = scene_and_lines()
    for call, *given in (
        (cylint.intersect, ROD, *drawn(100, 41)), (scene.count, o, d), (scene.closest, o),
        (scene.within, o, 0.01), (ROD.distance, o), (ROD.closest, o), (ROD.safety, o),
        (ROD.on_surface, o), (cylint.Scene, sticks(300_000, 63)),
    ):  # fmt: skip
        with refused("enough", LookupError):
            call(*given, progress=fail)


def test_a_scene_that_is_built_answers_nothing():
    """A method of a subclass can be its progress."""

    class Watched(cylint.Scene):
        def watch(self, done, total):
            self.nearest([0, 0, 0], [0, 0, 1])

        def __init__(self, shapes):
            super().__init__(shapes, threads=1, progress=self.watch)

    with refused("_scene", AttributeError):
        Watched(sticks(300_000, 63))


def use(shapes, o, d):
    """Calls of all kinds, some of which fail."""
    scene = cylint.Scene(shapes)
    shapes.bounds(), shapes.contains(o), scene.all(o, d), scene.any(o, d)
    shapes.safety(o), shapes.on_surface(o), scene.within(o, 0.5)
    for found in scene.nearest(o, d), cylint.intersect(shapes, o, d):
        assert found.normal.shape == found.point.shape == (*found.t.shape, 3)
    for found in shapes.closest(o), scene.closest(o):
        assert found.normal.shape == found.point.shape and found.part is not None
    for call, *given in ((scene.nearest, o * np.nan, d), (cylint.cylinder, o, o, 1)):
        with pytest.raises(ValueError):
            call(*given)


def references(*objects):
    gc.collect()
    return [sys.getrefcount(o) for o in objects]


def test_no_reference_is_kept_or_lost():
    o, d = rays(300, 44)
    shapes = forest(300, 45)
    watched = (cylint.intersect, o, d, shapes, shapes._records)
    before = references(*watched)
    for _ in range(50):
        use(shapes, o, d)
    assert references(*watched) == before


def test_results_own_the_lines_of_a_view_with_long_axes():
    base = np.random.default_rng(51).uniform(-0.3, 0.3, (300, 3))
    wide = np.broadcast_to(base, (100_000, 300, 3))[:, :1]
    tracemalloc.start()
    try:
        hit = cylint.Scene(ROD).nearest(wide, [0, 0, 1])
        held = tracemalloc.get_traced_memory()[0]
    finally:
        tracemalloc.stop()
    assert held < 30 * wide[..., 0].size
    point = cylint.Scene(ROD).nearest(base[0], [0, 0, 1]).point
    base += 100
    assert same(hit.point[99_999, 0], point) and np.isfinite(point).all()


def test_arrays_are_not_copied():
    """What a call allocates is its answer, and the lines or points that members
    which are computed later need, unless these are read-only."""
    o = np.full((BIG, 3), 0.75)
    d = np.ones((BIG, 3))
    fixed = o.copy(), d.copy()
    for array in fixed:
        array.flags.writeable = False
    scene = cylint.Scene(ROD)
    scene.nearest(o[0], d[0]), cylint.intersect(ROD, o[0], d[0])  # import what they need
    tracemalloc.start()
    try:
        for call, answer in (
            (lambda: cylint.intersect(ROD, o, d), 20 + 48),
            (lambda: cylint.intersect(ROD, o[::-1, ::-1], d[:1]), 20 + 24),
            (lambda: scene.nearest(o, d), 17 + 8 + 48),
            (lambda: scene.closest(o, r=2), 16 + 8 + 24),
            (lambda: ROD.closest(o), 8 + 24),
            (lambda: cylint.intersect(ROD, *fixed), 20),
            (lambda: scene.nearest(*fixed), 17 + 8),
            (lambda: ROD.closest(fixed[0]), 8),
            (lambda: cylint.intersect(ROD, o.astype("f4"), d[:1]), 20 + 36),
            (lambda: scene.any(o, d), 1),
            (lambda: scene.any(o, np.broadcast_to(np.float32([1, 0, 0]), o.shape)), 1),
            (lambda: ROD.contains(o), 1),
            (lambda: ROD.distance(o), 8),
            (lambda: ROD.safety(o[::-1, ::-1]), 8),
            (lambda: ROD.on_surface(o, 2), 1),
            (lambda: scene.within_count(o, 1), 8),
        ):
            tracemalloc.reset_peak()
            before = tracemalloc.get_traced_memory()[0]
            call()
            peak = tracemalloc.get_traced_memory()[1] - before
            assert peak < answer * BIG + 100_000
    finally:
        tracemalloc.stop()


def test_memory_does_not_grow():
    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    if not os.path.exists("/proc/self/statm"):
        pytest.skip("no /proc")
    o, d = rays(500, 48)
    shapes = forest(500, 49)
    for _ in range(20):
        use(shapes, o, d)
    before = resident()
    for _ in range(100):
        use(shapes, o, d)
    assert resident() - before < 20e6


AGAIN = """
for name in [name for name in sys.modules if name.startswith("libcylint")]:
    del sys.modules[name]
import libcylint
"""
SECOND = """
try:
    import _interpreters as interpreters
except ImportError:
    import _xxsubinterpreters as interpreters
code = f"import sys; sys.path[:] = {sys.path}; import libcylint"
found = interpreters.run_string(interpreters.create(), code)
if found is not None:  # since Python 3.13
    raise ImportError(found)
"""


@pytest.mark.parametrize(
    "code, message",
    [
        ("import libcylint" + AGAIN, "a process can load libcylint._core once"),
        # NumPy may refuse it before
        (SECOND, "main interpreter|load.*subinterpreters"),
    ],
)
def test_what_would_hang_or_break_is_refused_when_it_is_loaded(code, message):
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", "import sys\n" + code],
        capture_output=True, text=True, timeout=60,
    )
    assert done.returncode == 1 and re.search(message, done.stderr), done.stderr


EXIT = """
import os, sys, threading, time
import numpy as np
import libcylint

random = np.random.default_rng(1)
o, d = random.random((2, 400_000, 3))
rods = libcylint.cylinder(o[:20_000], o[:20_000] + 0.02 * d[:20_000], 0.01)
scene = libcylint.Scene(rods)

def repeat(call):
    began.append(1)
    while True:
        call()

calls = (
    lambda: scene.count(o, d, threads=1), lambda: scene.pieces(o, d),
    lambda: rods[0].distance(o), lambda: libcylint.Scene(rods),
    lambda: libcylint.cylinder(o, d, 1),
)
began = []
for call in calls:
    threading.Thread(target=repeat, args=(call,), daemon=True).start()
while len(began) < len(calls):
    time.sleep(0.1)
time.sleep(0.2)
if sys.argv[1:] and os.fork() == 0:
    sys.exit()
if sys.argv[1:]:
    assert os.wait()[1] == 0
print("the end")
"""


@pytest.mark.parametrize("fork", [[], ["fork"]] if hasattr(os, "fork") else [[]])
def test_python_exits_while_threads_compute(fork):
    """They are daemons, for which Python does not wait."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", EXIT, *fork],
        capture_output=True, text=True, timeout=120,
    )
    assert (done.returncode, done.stdout) == (0, "the end\n"), done.stderr
    assert "Traceback" not in done.stderr
