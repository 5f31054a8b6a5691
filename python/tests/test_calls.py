# SPDX-License-Identifier: Apache-2.0
"""Threads, Ctrl-C, memory. No test here depends on how fast the machine is, but for an upper bound of seconds."""
import asyncio
import concurrent.futures
import contextvars
import gc
import os
import signal
import subprocess
import sys
import threading
import time

import numpy
import pytest

import nef


def ball(rings, seed=0):
    """A solid of many facets: the hull of points about a sphere."""
    rng = numpy.random.default_rng(seed)
    points = rng.normal(size=(rings, 3))
    return nef.hull(points / numpy.linalg.norm(points, axis=1)[:, None])


def test_other_threads_run_meanwhile():
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    a = ball(4000)
    b = a.rotate((1, 2, 3), 20)
    thread.start()
    begin = time.perf_counter()
    a | b
    end = time.perf_counter()
    stop.set()
    thread.join()
    assert len([t for t in ticks if begin < t < end]) >= 3


def test_calls_from_other_threads():
    a = ball(300)
    turned = [a.rotate((1, 2, 3), 10 * i) for i in range(6)]
    alone = [a & b for b in turned]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        together = list(pool.map(lambda b: a & b, turned))
    assert together == alone


def test_exceptions_come_from_long_calls():
    points = numpy.random.default_rng(0).normal(size=(5000, 3))
    with pytest.raises(nef.InputError):
        nef.from_mesh(points, numpy.arange(4998).reshape(-1, 3))
    with pytest.raises(nef.InputError):
        ball(3000).transform(numpy.zeros((3, 3)))


@pytest.mark.parametrize("what", ["union", "unite_all", "hash", "mesh"])
def test_ctrl_c(what):
    """The exception comes at once, and the sets are whole; measured in docs/python.md."""
    a = ball(6000)
    b = a.rotate((1, 2, 3), 20)
    before = a.counts(), b.counts()
    work = {
        "union": lambda: [a | b for _ in range(1000)],
        "unite_all": lambda: nef.unite_all([a.translate((i, 0, 0)) for i in range(5)] * 100),
        "hash": lambda: [a == b.translate((1, 0, 0)) for _ in range(1000000)],
        "mesh": lambda: [nef.from_mesh(*a.to_mesh()) for _ in range(1000)],
    }[what]
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        work()
    assert (a.counts(), b.counts()) == before
    assert a.validate() == ""
    assert (a & a) == a


def test_the_interpreter_ends_after_ctrl_c():
    """An abandoned call does not keep the process alive, nor does it crash it."""
    code = """
import os, signal, sys, threading, numpy, nef
points = numpy.random.default_rng(0).normal(size=(20000, 3))
a = nef.hull(points / numpy.linalg.norm(points, axis=1)[:, None])
b = a.rotate((1, 2, 3), 20)
threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    while True: a | b
except KeyboardInterrupt:
    print("interrupted")
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert done.stdout.strip() == "interrupted" and done.returncode == 0, done.stderr


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs /proc")
def test_memory_is_returned():
    """10^4 Booleans; what the first thousand took is there for the rest."""
    a = nef.box((0, 0, 0), (2, 2, 2))
    b = nef.box((1, 1, 1), (3, 3, 3))
    points = numpy.random.default_rng(0).normal(size=(10, 3))
    for i in range(10000):
        c = (a - b).closure()
        (c.contains(points), c.to_mesh(), c.volume(), c.bounding_box())
        if i == 1000:
            gc.collect()
            first = resident()
    gc.collect()
    assert resident() - first < 4 << 20


def test_progress_of_booleans():
    a, b = ball(3000), ball(3000, seed=1)
    told = []
    with nef.progress(lambda phase, done, total: told.append((phase, done, total))):
        c = a | b
        assert {phase for phase, _, _ in told} >= {"edges through facets", "sphere maps", "synthesis"}
        assert told[-1] == ("synthesis", 3, 3)
        with nef.progress(None):
            count = len(told)
            c.interior()
        assert len(told) == count
        nef.unite_all([nef.box((2 * i, 0, 0), (2 * i + 1, 1, 1)) for i in range(50)])
        assert told[-1] == ("sets", 49, 49)
    count = len(told)
    assert a | b == c
    assert len(told) == count


def test_exception_of_progress_ends_the_operation():
    class Enough(Exception):
        pass

    def refuse(phase, done, total):
        raise Enough

    for size in (30, 3000):  # where the call is, and in a thread of its own
        a, b = ball(size), ball(size, seed=1)
        with pytest.raises(Enough):
            with nef.progress(refuse):
                a | b
        assert (a & b) <= a
    with pytest.raises(TypeError):
        with nef.progress("no function"):
            pass


def test_progress_belongs_to_a_context():
    a, b = ball(100), ball(100, seed=1)
    told = []
    with nef.progress(lambda *what: told.append(what)):
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            pool.submit(lambda: a | b).result()
            assert not told
            pool.submit(contextvars.copy_context().run, lambda: a | b).result()
            assert told
            count = len(told)
            pool.submit(lambda: a | b).result()
        contextvars.Context().run(lambda: a | b)
        assert len(told) == count


def test_progress_of_tasks():
    a, b = ball(100), ball(100, seed=1)

    async def unite(told):
        with nef.progress(lambda *what: told.append(what)):
            await asyncio.sleep(0)  # the other task comes into its block
            a | b
            await asyncio.to_thread(lambda: a | b)
        count = len(told)
        await asyncio.sleep(0)
        a | b
        assert len(told) == count

    async def both(first, second):
        await asyncio.gather(unite(first), unite(second))

    first, second, before = [], [], []
    with nef.progress(lambda *what: before.append(what)):
        asyncio.run(both(first, second))
        assert first and first == second
        assert before


def test_progress_in_a_thread_of_its_own():
    """Of calls that are large enough to run beside the main thread."""
    a, b = ball(4000), ball(4000, seed=1)
    far, within = a.translate((100, 0, 0)), b.scale("1/2")
    for other in (b, far, within):
        told = []
        with nef.progress(lambda *what: told.append(what)):
            a | other
        assert told


DAEMON = """
import sys, threading, time
import nef
a, b = nef.box((0, 0, 0), (1, 1, 1)), nef.box((0, 0, 0), (2, 1, 1))
def work():
    with nef.progress({progress}):
        while True:
            a | b
            a.contains((0, 0, 0))
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.2)
"""


@pytest.mark.parametrize("progress", ["None", "lambda *what: None"])
def test_daemon_threads_do_not_harm_the_end_of_python(progress):
    # Many at once, so that threads are stopped in the middle of anything.
    runs = [subprocess.Popen([sys.executable, "-c", DAEMON.format(progress=progress)], stderr=subprocess.PIPE)
            for _ in range(24)]
    for run in runs:
        _, said = run.communicate(timeout=120)
        assert (run.returncode, said) == (0, b"")


def drilled(steps=40):
    """A large set minus many small ones, which waits until somebody looks."""
    solid = ball(4000)
    for i in range(steps):
        low = [0.9 - 0.01 * i, 0.02 * i - 0.5, 0.1]
        solid = solid - nef.box(low, [low[0] + 0.05, low[1] + 0.015, 0.2])
    return solid


def test_looks_at_waiting_steps_from_several_threads():
    """One of those who look tells of its progress, for which it needs the interpreter's lock."""
    told = []
    solid = drilled()

    def look():
        with nef.progress(lambda *what: told.append(what)):
            return solid.counts()

    with concurrent.futures.ThreadPoolExecutor(3) as pool:
        counts = [pool.submit(look) for _ in range(3)]
        assert bool(solid) and not solid.is_empty() and solid.is_bounded()
        assert {each.result() for each in counts} == {solid.counts()}


def test_ctrl_c_while_steps_are_computed():
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            solid = drilled()
            bool(solid)
    assert solid.validate() == ""
