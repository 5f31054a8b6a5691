#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What docs/python.md promises, measured: PYTHONPATH=build/release/python python3 bench/python/bench_python.py

Times are the best of some runs. CPU seconds of the process where nothing else is said; where several threads or answers
to signals are measured, wall seconds, which say little on a busy machine.
"""
import concurrent.futures
import gc
import os
import signal
import statistics
import subprocess
import sys
import threading
import time

import numpy

import nef


def best(work, runs=5, clock=time.process_time):
    times = []
    for _ in range(runs):
        begin = clock()
        work()
        times.append(clock() - begin)
    return min(times)


def imports():
    code = "import numpy, time; begin = time.process_time(); import nef; print(time.process_time() - begin)"
    seconds = min(float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
                  for _ in range(7))
    print(f"import nef, beyond numpy: {1000 * seconds:.0f} ms (must be under 60)")


def sphere(rings, segments, radius=1.0):
    """(vertices, faces) of a sphere of 2 * segments * (rings - 1) triangles."""
    vertices = [[0, 0, radius]]
    for i in range(1, rings):
        theta = numpy.pi * i / rings
        for k in range(segments):
            phi = 2 * numpy.pi * k / segments
            vertices.append([radius * numpy.sin(theta) * numpy.cos(phi), radius * numpy.sin(theta) * numpy.sin(phi),
                             radius * numpy.cos(theta)])
    vertices.append([0, 0, -radius])
    last = len(vertices) - 1
    ring = lambda i, k: 1 + (i - 1) * segments + k % segments
    faces = []
    for k in range(segments):
        faces.append([0, ring(1, k), ring(1, k + 1)])
        faces.append([last, ring(rings - 1, k + 1), ring(rings - 1, k)])
        for i in range(1, rings - 1):
            faces.append([ring(i, k), ring(i + 1, k), ring(i + 1, k + 1)])
            faces.append([ring(i, k), ring(i + 1, k + 1), ring(i, k + 1)])
    return numpy.array(vertices), numpy.array(faces)


def one_point():
    """What Python adds to a point location: everything, set against the empty set, whose location costs nothing."""
    nothing, point = nef.empty(), (0.25, 0.5, 0.75)
    loops = 100000

    def work():
        contains = nothing.contains
        for _ in range(loops):
            contains(point)

    print(f"contains, one point: overhead {best(work) / loops * 1e6:.2f} us (must be under 2)")


def many_points():
    solid = nef.from_mesh(*sphere(101, 100))
    solid.contains((0, 0, 0))
    points = numpy.random.default_rng(0).uniform(-1, 1, (10**6, 3))
    seconds = best(lambda: solid.contains(points), 3)
    print(f"contains, 10^6 points in {len(sphere(101, 100)[1])} triangles: {seconds:.2f} s (must be under 2)")
    near = points / numpy.linalg.norm(points, axis=1)[:, None]
    print(f"  the same, all on the unit sphere, which the facets come near: {best(lambda: solid.contains(near), 1):.2f} s")


def meshes():
    """from_mesh and to_mesh against the same calls of the library; in turn, as the machine is not always as fast, and by
    the medians of the rounds: a few milliseconds differ by a tenth from one round to the next."""
    vertices, faces = sphere(251, 200)
    solid = nef.from_mesh(vertices, faces)
    rounds = [(best(lambda: nef.from_mesh(vertices, faces), 1), best(solid.to_mesh, 3),
               *nef._nef._core_times(vertices, faces)) for _ in range(25)]
    into, out, core_into, core_out = [statistics.median(times) for times in zip(*rounds)]
    print(f"from_mesh, {len(faces)} triangles: {into:.3f} s, the library alone {core_into:.3f} s, "
          f"added {100 * (into / core_into - 1):.0f} % (must be at most 10)")
    print(f"to_mesh: {1000 * out:.1f} ms, the library alone {1000 * core_out:.1f} ms, "
          f"added {100 * (out / core_out - 1):.0f} % (must be at most 10)")


def memory():
    a, b = nef.box((0, 0, 0), (2, 2, 2)), nef.box((1, 1, 1), (3, 3, 3))

    def resident():
        gc.collect()
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    for i in range(11000):
        a - b
        if i == 1000:
            before = resident()
    print(f"10^4 Booleans: {(resident() - before) / 1024:.0f} KiB more resident (must not grow)")


def two_threads():
    a = nef.from_mesh(*sphere(60, 60))
    turned = [a.rotate((1, 2, 3), 10 * i + 5) for i in range(8)]
    alone = best(lambda: [a & b for b in turned], 3, time.perf_counter)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        together = best(lambda: list(pool.map(lambda b: a & b, turned)), 3, time.perf_counter)
    print(f"two threads: {alone / together:.2f} times as fast (must be 1.6); wall seconds")


def ctrl_c():
    mesh = sphere(251, 200)
    a = nef.from_mesh(*mesh)
    b = a.rotate((1, 2, 3), 20)
    tasks = {"union": lambda: a | b, "interior": a.interior, "from_mesh": lambda: nef.from_mesh(*mesh),
             "unite_all": lambda: nef.unite_all([a.translate((i, 0, 0)) for i in range(6)])}
    try:
        from nef import minkowski
        teeth = [nef.box((2 * i, 0, 0), (2 * i + 1, i + 1, 5)) for i in range(12)]
        comb = nef.unite_all(teeth + [nef.box((0, 0, 0), (24, 1, 1))])
        tasks["minkowski.sum"] = lambda: minkowski.sum(comb, comb.rotate((1, 2, 2), 20))
    except ImportError:
        pass
    for name, task in tasks.items():
        delays = []
        for wait in (0.1, 0.2, 0.3):
            sent = []

            def send():
                sent.append(time.perf_counter())
                os.kill(os.getpid(), signal.SIGINT)

            timer = threading.Timer(wait, send)
            timer.start()
            try:
                while True:
                    task()
            except KeyboardInterrupt:
                delays.append(time.perf_counter() - sent[0])
        print(f"Ctrl-C in {name}: {max(delays) * 1000:.0f} ms (must be at most 200)")


if __name__ == "__main__":
    wanted = sys.argv[1:]
    for measurement in (imports, one_point, many_points, meshes, memory, two_threads, ctrl_c):
        if not wanted or measurement.__name__ in wanted:
            measurement()
            sys.stdout.flush()
