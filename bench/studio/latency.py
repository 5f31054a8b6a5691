#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long a page of the studio waits: from the request to the last byte of the scene, without drawing it.

Usage: bench/studio/latency.py PROGRAM_DIRECTORY [--steps N] [--only ROW]

Rows: a small set while its text changes; an obstacle among 200 dragged; a view of twelve switched off and on; a cube dragged
over a set of some 131,000 triangles. Prints a table of the median and the largest of the steps, the time of the computation in it
(what the panel measures) and the bytes that were sent.
"""
import argparse
import http.client
import json
import pathlib
import random
import shutil
import statistics
import struct
import subprocess
import tempfile
import time
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class Studio:
    """A running server for one folder."""

    def __init__(self, programs, root):
        self.process = subprocess.Popen([str(programs / "nef"), "studio", "--root", str(root), "--no-browser"],
                                        stdout=subprocess.PIPE, text=True)
        parts = urllib.parse.urlsplit(self.process.stdout.readline().strip())
        self.port, self.token = parts.port, urllib.parse.parse_qs(parts.query)["token"][0]

        self.pieces = []

    def compute(self, request):
        """(seconds, seconds of the computation, bytes)"""
        begin = time.perf_counter()
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=600)
        connection.request("POST", "/api/compute", json.dumps({"page": "bench", "has": self.pieces, **request}), {"X-Nef-Token": self.token})
        reply = connection.getresponse()
        body = reply.read()
        took = time.perf_counter() - begin
        connection.close()
        if reply.status != 200:
            raise RuntimeError(body.decode())
        length = struct.unpack("<I", body[:4])[0]
        report = json.loads(body[8:8 + length])
        self.pieces = [number for number, _ in report["pieces"]]  # a page keeps them
        return took, report["op_s"], len(body)

    def end(self):
        """Ends the server."""
        self.process.terminate()
        self.process.wait()


def small_set(_root, _programs):
    """A text that changes in one number."""
    return lambda i: {"panel": "sets", "text": f"box(0,0,0, 2,2,2) - translate(ball(6/5, 4), {i}/100,0,0)"}


def many_obstacles(_root, _programs):
    """One of 200 boxes moved; the robot is a cube."""
    dice = random.Random(43)
    boxes = []
    while len(boxes) < 200:
        x, y, z = (dice.randrange(2, 38) for _ in range(3))
        boxes.append(f"box({x},{y},{z}, {x + dice.randrange(1, 4)},{y + dice.randrange(1, 4)},{z + dice.randrange(1, 4)})")
    scene = {"robot": "box(0,0,0, 1/2,1/2,1/2)", "obstacles": boxes, "box": [[0, 0, 0], [42, 42, 42]], "start": [0, 0, 0],
             "goal": [41, 41, 41]}
    return lambda i: {"panel": "planner", "scene": json.dumps(scene), "folder": "", "start": None, "goal": None,
                      "moves": {"100": ["0", f"0.{i + 10}", "0"]}, "dragged": True}


def views(root, _programs):
    """A view of twelve switched off and on."""
    for path in (ROOT / "data/visual_hull/eight").iterdir():
        shutil.copy(path, root)
    return lambda i: {"panel": "hulls", "scene": "eight.json", "off": [i % 12] if i % 2 else [], "simplify": "1", "threshold": "",
                      "residuals": False}


def large_set(root, programs):
    """A cube dragged over a sphere of some 131,000 triangles."""
    subprocess.run([str(programs / "nef"), "eval", "sphere(10, 362)", "-o", str(root / "sphere.nef"), "-q"], check=True)
    return lambda i: {"panel": "sets", "text": f"file(\"sphere.nef\") - translate(box(-1,-1,-1, 1,1,1), {i}/10,0,10)"}


ROWS = {"a small set": small_set, "an obstacle among 200": many_obstacles, "a view of twelve": views,
        "a cube over 131,000 triangles": large_set}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--only", choices=sorted(ROWS))
    arguments = parser.parse_args()
    programs = arguments.programs.resolve()
    print("| row | median ms | largest ms | computed ms | KB |\n| --- | --- | --- | --- | --- |")
    for name, make in ROWS.items():
        if arguments.only not in (None, name):
            continue
        with tempfile.TemporaryDirectory() as folder:
            request = make(pathlib.Path(folder), programs)
            studio = Studio(programs, folder)
            try:
                studio.compute(request(0))  # files are read once
                runs = [studio.compute(request(i)) for i in range(1, arguments.steps + 1)]
            finally:
                studio.end()
        took = [run[0] for run in runs]
        computed = statistics.median(run[1] for run in runs)
        print(f"| {name} | {1000 * statistics.median(took):.1f} | {1000 * max(took):.1f} | {1000 * computed:.1f} | "
              f"{runs[-1][2] / 1000:.0f} |", flush=True)


if __name__ == "__main__":
    main()
