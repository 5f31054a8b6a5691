#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every engine on every case in turn, single-threaded, and prints one table.

  bench/run.py [--bin build/release/bin] [--repeat 3] [--passes 1] [--json FILE] [CASE ...]
  bench/run.py --sweep            time per result vertex over N (is the cost n log n?)
  bench/run.py --plot FOLDER ...  draws the table as figures, too (bench/plot.py)
  bench/run.py --manifold PREFIX [CASE ...]    ours beside the Manifold library installed at PREFIX, which is fast and
                                  not exact: build, operation, export to triangles of doubles, peak memory
  bench/run.py --before BIN [CASE ...]         ours beside another build of ours, whose programs are in the folder BIN

An engine is a program nef_bench_<engine> CASE_DIRECTORY REPEAT that prints one line of JSON. Each
case runs in a process of its own, so that peak memory is the case's; with --passes the engines
alternate, and the best pass of each counts.
"""
import argparse
import contextlib
import importlib.util
import io
import json
import math
import os
import subprocess
import sys
import tempfile

import plot

CASES = [
    "tetgrid-12", "wall-40", "facet-40", "minus-30", "sphere_map-100", "cylinder-1000-1e-1",
    "cylinder-1000-1e-6", "ray-4000", "spheres-5", "spheres-6", "bigsmall-6", "locate-12",
    "staircase-50", "cascade-200-25", "cascade2-200-25",
]
# CGAL's operation time over ours that the project promises.
WANTED = {
    "tetgrid": 8, "wall": 8, "facet": 10, "sphere_map": 10, "locate": 10, "minus": 15, "cylinder": 20, "ray": 20,
    "spheres": 30, "bigsmall": 30,
}
# Solids of which the peer takes all faces.
MANIFOLD_CASES = [
    "tetgrid-12", "tetgrid-20", "wall-40", "cylinder-1000-1e-6", "spheres-5", "spheres-6", "spheres-7", "bigsmall-6",
    "bigsmall-7", "bigsmall-8", "scans-6", "holes-50", "boxes-1000", "lattice-20",
]
SWEEPS = {
    "tetgrid": [4, 6, 8, 10, 12, 14, 16], "wall": [10, 20, 40, 60, 80], "facet": [10, 20, 40, 80],
    "spheres": [3, 4, 5, 6], "cylinder": [250, 500, 1000, 2000], "ray": [1000, 2000, 4000, 8000],
}


def run(binary, directory, repeat, timeout):
    """The engine's report, or {"error": ...}."""
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    try:
        done = subprocess.run([binary, directory, str(repeat)], capture_output=True, text=True, timeout=timeout,
                              env=environment, check=False)
    except subprocess.TimeoutExpired:
        return {"error": f"over {timeout} s"}
    if done.returncode != 0:
        message = done.stderr.strip().splitlines()
        return {"error": message[-1] if message else f"exit code {done.returncode}"}
    return json.loads(done.stdout)


def better(old, new):
    """The faster of two reports of one engine."""
    if old is None or "error" in old:
        return new
    if "error" in new or old["op_s"] <= new["op_s"]:
        return old
    return new


def counts_of(report):
    return tuple(report[k] for k in ("vertices", "edges", "facets", "volumes", "inside"))


def verdict(ours, cgal):
    if cgal is None or "error" in cgal or "error" in ours:
        return "-"
    return "same" if counts_of(ours) == counts_of(cgal) else "DIFFER"


def cell(report, key, form="{:.4g}"):
    if report is None:
        return "-"
    if "error" in report:
        return "X"
    return form.format(report[key])


def ratio(ours, cgal, key):
    if ours is None or cgal is None or "error" in ours or "error" in cgal or ours[key] == 0:
        return "-"
    return f"{cgal[key] / ours[key]:.1f}"


def measured(args, name, engines):
    """The best report of each engine for one case, over passes in which they take turns. Tells of errors."""
    directory = os.path.join(args.directory, name)
    subprocess.run([os.path.join(args.bin, "nef_bench_generate"), args.directory, name], check=True)
    best = {}
    for _ in range(args.passes):
        for engine, binary in engines.items():
            best[engine] = better(best.get(engine), run(binary, directory, args.repeat, args.timeout))
    for engine, report in best.items():
        if "error" in report:
            print(f"{name}: {engine}: {report['error']}", file=sys.stderr)
    return best


def table(args, engines):
    header = ["case", "ours s", "CGAL s", "ratio", "wanted", "coref s", "build s", "CGAL", "ratio", "MB", "CGAL", "ratio",
              "counts", "V/E/F/C"]
    rows = []
    results = {}
    for name in args.cases or CASES:
        best = results[name] = measured(args, name, engines)
        ours, cgal, coref = best["nef"], best.get("cgal"), best.get("corefinement")
        memory = ratio(ours, cgal, "peak_kb")
        rows.append([name, cell(ours, "op_s"), cell(cgal, "op_s"), ratio(ours, cgal, "op_s"),
                     str(WANTED.get(name.split("-")[0], "")), cell(coref, "op_s"), cell(ours, "build_s"),
                     cell(cgal, "build_s"), ratio(ours, cgal, "build_s"),
                     "X" if "error" in ours else f"{ours['peak_kb'] / 1024:.0f}",
                     "-" if cgal is None or "error" in cgal else f"{cgal['peak_kb'] / 1024:.0f}", memory,
                     verdict(ours, cgal), "X" if "error" in ours else "/".join(map(str, counts_of(ours)[:4]))])
        print(" | ".join(rows[-1]), flush=True)
    print_table(header, rows)
    if args.json:
        with open(args.json, "w", encoding="utf-8") as out:
            json.dump(results, out, indent=1)
    return 1 if any(row[-2] == "DIFFER" for row in rows) else 0


def build_manifold_peer(args, root):
    """The program that runs Manifold, compiled against an installation that is there."""
    folder = os.path.join(os.path.dirname(os.path.abspath(args.bin)), "manifold_peer")
    for command in (["cmake", "-S", os.path.join(root, "bench", "manifold"), "-B", folder,
                     "-DCMAKE_PREFIX_PATH=" + os.path.abspath(args.manifold)],
                    ["cmake", "--build", folder]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return os.path.join(folder, "nef_bench_manifold")


def beside(args, ours_binary, peer, peer_binary, cases):
    """One line a case: ours, the peer's, ours / the peer's. Exit code 1 if a build of ours counts other items."""
    keys = (("build", "build_s"), ("operation", "op_s"), ("export", "export_s"), ("peak MB", "peak_kb"))
    header = ["case"] + [text for name, _ in keys for text in (name, peer, "ratio")] + ["vertices", "B/vertex"]
    rows = []
    results = {}
    differ = False
    for name in args.cases or cases:
        best = results[name] = measured(args, name, {"nef": ours_binary, peer: peer_binary})
        ours, theirs = best["nef"], best[peer]
        if peer == "before" and verdict(ours, theirs) == "DIFFER":
            differ = True
            print(f"{name}: counts differ: {counts_of(theirs)} before, {counts_of(ours)} now", file=sys.stderr)
        row = [name]
        for _, key in keys:
            for report in (ours, theirs):
                row.append("X" if "error" in report else
                           f"{report[key] / 1024:.0f}" if key == "peak_kb" else f"{report[key]:.4g}")
            row.append("-" if "X" in row[-2:] or theirs[key] == 0 else f"{ours[key] / theirs[key]:.2f}")
        row += ["X", "X"] if "error" in ours else [str(ours["vertices"]), f"{ours['bytes'] / max(1, ours['vertices']):.0f}"]
        rows.append(row)
        print(" | ".join(row), flush=True)
    print_table(header, rows)
    if args.json:
        with open(args.json, "w", encoding="utf-8") as out:
            json.dump(results, out, indent=1)
    return 1 if differ else 0


def print_table(header, rows):
    widths = [max(len(r[i]) for r in rows + [header]) for i in range(len(header))]
    print()
    for row in [header] + rows:
        print("  ".join(text.ljust(width) for text, width in zip(row, widths)).rstrip())


def sweep(args, engines):
    print(f"{'case':24} {'vertices':>9} {'op s':>9} {'us/vertex':>10} {'us/(v log2 v)':>14}")
    for kind, sizes in SWEEPS.items():
        for n in sizes:
            name = f"{kind}-{n}" + ("-1e-1" if kind == "cylinder" else "")
            directory = os.path.join(args.directory, name)
            subprocess.run([os.path.join(args.bin, "nef_bench_generate"), args.directory, name], check=True)
            report = run(engines["nef"], directory, args.repeat, args.timeout)
            if "error" in report:
                print(f"{name:24} {report['error']}")
                continue
            v = report["vertices"]
            per = 1e6 * report["op_s"] / v
            print(f"{name:24} {v:9} {report['op_s']:9.4f} {per:10.2f} {per / math.log2(v):14.3f}", flush=True)
    return 0


class Tee:
    """Standard output, with a copy kept."""

    def __init__(self, copy):
        self.copy = copy
        self.out = sys.stdout

    def write(self, text):
        self.copy.write(text)
        return self.out.write(text)

    def flush(self):
        self.out.flush()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser.add_argument("--bin", default=os.path.join(root, "build", "release", "bin"), help="folder of the programs")
    parser.add_argument("--directory", default=None, help="where the cases are written (default: a temporary folder)")
    parser.add_argument("--repeat", type=int, default=3, help="operations in one process; the median counts")
    parser.add_argument("--passes", type=int, default=1, help="alternations of the engines; the best counts")
    parser.add_argument("--timeout", type=float, default=600)
    parser.add_argument("--json", default=None, help="write all reports to this file")
    parser.add_argument("--sweep", action="store_true")
    parser.add_argument("--manifold", default=None, metavar="PREFIX", help="where the Manifold library is installed")
    parser.add_argument("--before", default=None, metavar="BIN", help="folder with nef_bench_nef of another build of ours")
    parser.add_argument("--plot", default=None, metavar="FOLDER", help="draw the table as SVG (needs python3-matplotlib)")
    parser.add_argument("--only", default="", help="engines, comma-separated: nef,cgal,corefinement")
    parser.add_argument("cases", nargs="*")
    args = parser.parse_args()
    if args.plot and importlib.util.find_spec("matplotlib") is None:
        parser.error("--plot needs matplotlib (apt-get install python3-matplotlib, and run it with /usr/bin/python3)")
    engines = {e: os.path.join(args.bin, "nef_bench_" + e) for e in ("nef", "cgal", "corefinement")
               if os.path.exists(os.path.join(args.bin, "nef_bench_" + e)) and (not args.only or e in args.only.split(","))}
    if "nef" not in engines:
        print(f"bench/run.py: no nef_bench_nef in {args.bin}; build it or give --bin", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as temporary:
        args.directory = args.directory or temporary
        printed = io.StringIO()
        with contextlib.redirect_stdout(Tee(printed)):
            if args.manifold:
                peer = build_manifold_peer(args, root)
                code = beside(args, engines["nef"], "Manifold", peer, MANIFOLD_CASES)
            elif args.before:
                code = beside(args, engines["nef"], "before", os.path.join(args.before, "nef_bench_nef"),
                              list(dict.fromkeys(CASES + MANIFOLD_CASES)))
            else:
                code = sweep(args, engines) if args.sweep else table(args, engines)
    if args.plot:
        for path in plot.draw(printed.getvalue(), args.plot):
            print(path)
    return code


if __name__ == "__main__":
    sys.exit(main())
