#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sums that make unions explode: makes the operands, runs `minkowski` on each, prints CPU seconds and peak memory.

    bench/minkowski/stress.py [--bin DIR] [--cases NAME ...] [--unions auto queue] [--limit SECONDS] [--keep DIR]
    bench/minkowski/stress.py --cgal --manifold PREFIX --openscad ...      peers beside, where they are there
    bench/minkowski/stress.py --growth                          families that grow, with exponents

Extrusions (stars, gears) have caps in common planes; a ball written in doubles is convex but for 10^-16; a cube minus a
ball is all reflex edges. Processor seconds of the whole process on one thread, with reading and writing.
"""
import argparse
import json
import math
import os
import resource
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
DATA = os.path.join(HERE, "..", "..", "data")


def write_off(path, vertices, faces):
    with open(path, "w") as out:
        out.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        for v in vertices:
            out.write(" ".join(repr(x) for x in v) + "\n")
        for f in faces:
            out.write(f"{len(f)} " + " ".join(map(str, f)) + "\n")


def extrude(path, outline, height):
    """A prism over a counterclockwise outline."""
    n = len(outline)
    vertices = [(x, y, 0) for x, y in outline] + [(x, y, height) for x, y in outline]
    faces = [list(range(n - 1, -1, -1)), list(range(n, 2 * n))]
    faces += [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
    write_off(path, vertices, faces)


def star_prism(path, k, turn, height=100):
    """2k corners, radii 1000 and 700, turned by `turn` steps of half a tip, rounded to integers."""
    outline = []
    for i in range(2 * k):
        angle = (i + turn) * math.pi / k
        radius = 1000 if i % 2 == 0 else 700
        outline.append((round(radius * math.cos(angle)), round(radius * math.sin(angle))))
    extrude(path, outline, height)


def gear(path, teeth, height=100):
    """Trapezoid teeth between the radii 800 and 1000, rounded to integers."""
    outline = []
    for i in range(teeth):
        for share, radius in ((0.0, 800), (0.3, 800), (0.45, 1000), (0.8, 1000)):
            angle = (i + share) * 2 * math.pi / teeth
            outline.append((round(radius * math.cos(angle)), round(radius * math.sin(angle))))
    extrude(path, outline, height)


def latitude_ball(path, radius, around, rings, split):
    """A sphere of rings as CAD programs write it, in doubles; caps are polygons; quads split into triangles or not."""
    vertices, faces = [], []
    for i in range(rings):
        polar = math.pi * (i + 0.5) / rings
        for j in range(around):
            angle = 2 * math.pi * j / around
            vertices.append((radius * math.sin(polar) * math.cos(angle), radius * math.sin(polar) * math.sin(angle),
                             radius * math.cos(polar)))
    faces.append(list(range(around)))
    faces.append([(rings - 1) * around + j for j in range(around - 1, -1, -1)])
    for i in range(rings - 1):
        for j in range(around):
            a, b = i * around + j, i * around + (j + 1) % around
            c, d = a + around, b + around
            faces += [[a, c, d], [a, d, b]] if split else [[a, c, d, b]]
    write_off(path, vertices, faces)


def bumpy_ball(path, n, seed):
    """A star-shaped body of about 2 n^2 triangles with waves on it: concave everywhere, like a scan."""
    vertices = [(0, 0, 1000)]
    def radius(theta, phi):
        return 700 + 200 * math.sin(3 * theta + seed) * math.cos(4 * phi + seed) + 40 * math.sin(9 * theta + 7 * phi)
    for i in range(1, n):
        theta = math.pi * i / n
        for j in range(n):
            phi = 2 * math.pi * (j + 0.5 * (i % 2)) / n
            r = radius(theta, phi)
            vertices.append((round(r * math.sin(theta) * math.cos(phi)), round(r * math.sin(theta) * math.sin(phi)),
                             round(r * math.cos(theta))))
    vertices.append((0, 0, -1000))
    faces = []
    row = lambda i, j: 1 + (i - 1) * n + j % n
    for j in range(n):
        faces.append([0, row(1, j), row(1, j + 1)])
        faces.append([len(vertices) - 1, row(n - 1, j + 1), row(n - 1, j)])
    for i in range(1, n - 1):
        for j in range(n):
            a, b, c, d = row(i, j), row(i, j + 1), row(i + 1, j), row(i + 1, j + 1)
            faces += [[a, c, b], [b, c, d]] if i % 2 == 0 else [[a, c, d], [a, d, b]]
    write_off(path, vertices, faces)


class NotForThisEngine(Exception):
    """Raised for operands that a peer has no counterpart of."""


class Bench:
    def __init__(self, binaries, folder):
        self.binaries, self.folder, self.manifold = binaries, folder, None

    def path(self, name):
        return os.path.join(self.folder, name)

    def data(self, name):
        return os.path.join(DATA, name)

    def nef(self, expression, name):
        subprocess.run([os.path.join(self.binaries, "nef"), "eval", expression, "-o", self.path(name), "-q"],
                       check=True, cwd=self.folder)
        return self.path(name)

    def make(self, maker, name, *arguments):
        maker(self.path(name), *arguments)
        return self.path(name)

    def cases(self):
        """name -> a function that makes the operands and returns the command line."""
        result = {}
        for k in (10, 16, 24, 48):
            result[f"stars {k}"] = lambda k=k: [self.make(star_prism, f"star{k}.off", k, 0),
                                                self.make(star_prism, f"turned{k}.off", k, 0.4)]
        result["gears 12, 24"] = lambda: [self.make(gear, "gear12.off", 12), self.make(gear, "gear24.off", 24)]
        ball = lambda scale: self.make(latitude_ball, "ball28.off", scale, 7, 4, True)
        result["star + ball 28"] = lambda: [self.data("meshes/star.off"), ball(0.1)]
        result["mushroom + ball 28"] = lambda: [self.data("minkowski/mushroom.off"), ball(0.1)]
        result["cube - ball, + ball 15"] = self.carved
        result["the same, closed"] = lambda: self.carved("regularize")
        result["mushroom + ball, 16 splits"] = lambda: [self.data("minkowski/mushroom.off"), "--ball", "1/10,16"]
        result["mushroom + mushroom"] = lambda: [self.data("minkowski/mushroom.off")] * 2
        result["co-mushroom + cube"] = lambda: [
            self.nef(f'!file("{self.data("minkowski/mushroom.off")}")', "comushroom.nef"),
            self.data("minkowski/cube.off")]
        star = f'file("{self.data("meshes/star.off")}")'
        result["co-star + star/10"] = lambda: [self.nef(f"!{star}", "costar.nef"),
                                               self.nef(f"scale({star}, 1/10)", "tenth.nef")]
        result["scans of 220"] = lambda: [self.make(bumpy_ball, "scan220a.off", 11, 0), self.make(bumpy_ball, "scan220b.off", 11, 1)]
        result["scans of 1012"] = lambda: [self.make(bumpy_ball, "scan1012a.off", 23, 0), self.make(bumpy_ball, "scan1012b.off", 23, 1)]
        return result

    def carved(self, how=""):
        """Without the ball's surface, so neither open nor closed, unless it is regularized."""
        self.make(latitude_ball, "ball24.off", 6.0, 24, 12, True)
        carved = self.nef(f'{how}(box(-5,-5,-5, 5,5,5) - file("{self.path("ball24.off")}"))', f"carved{how}.nef")
        return [carved, self.make(latitude_ball, "ball15.off", 1.0, 5, 3, True)]

    def command(self, operands, engine):
        """The command line of an engine: a strategy of ours, or a peer."""
        if engine == "cgal":
            return [os.path.join(self.binaries, "sum_peer"), "exact",
                    *(self.mesh(operand, "off", "--exact") for operand in self.pair(operands)), self.path("peer.nef3")]
        if engine == "manifold":
            return [self.manifold, *(self.mesh(operand, "stl") for operand in self.pair(operands))]
        if engine == "openscad":
            files = " ".join(f'import("{self.mesh(operand, "stl")}");' for operand in self.pair(operands))
            with open(self.path("sum.scad"), "w", encoding="utf-8") as script:
                script.write(f"minkowski() {{ {files} }}\n")
            return ["openscad", "-o", self.path("peer.off"), self.path("sum.scad")]
        command = [os.path.join(self.binaries, "minkowski"), *operands, "-o", self.path("sum.nef"), "--threads", "1", "--report",
                   self.path("report.json")]
        return command + (["--union", engine] if engine != "default" else [])

    def pair(self, operands):
        """The two operands of a plain sum, as files for a peer, which has no option for balls, say."""
        if len(operands) == 2 and not any(operand.startswith("--") for operand in operands):
            return operands
        if len(operands) == 3 and operands[1] == "--ball":
            name = "peer_ball_" + operands[2].replace("/", "_").replace(",", "_") + ".off"
            point = self.nef("hull(0,0,0)", "point.nef")
            subprocess.run([os.path.join(self.binaries, "minkowski"), point, "--ball", operands[2], "-o", self.path(name),
                            "-q"], check=True, capture_output=True)
            return [operands[0], self.path(name)]
        if len(operands) == 3 and operands[2] == "--negate-b":
            return [operands[0], self.nef(f'scale(file("{operands[1]}"), -1)', "peer_negated.nef")]
        raise NotForThisEngine

    def mesh(self, operand, extension, *options):
        """The operand as a mesh for a peer; .stl holds triangles only."""
        if operand.endswith("." + extension):
            return operand
        name = os.path.splitext(os.path.basename(operand))[0] + "." + extension
        subprocess.run([os.path.join(self.binaries, "nef"), "convert", operand, "-o", self.path(name), "-q", *options],
                       check=True, capture_output=True)
        return self.path(name)

    def run(self, operands, engine, limit):
        try:
            command = self.command(operands, engine)
        except (subprocess.CalledProcessError, NotForThisEngine):
            return 0.0, 0.0, False, "not for this engine"
        environment = dict(os.environ, OMP_NUM_THREADS="1")
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   env=environment,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
        output = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status
        seconds = usage.ru_utime + usage.ru_stime
        line = output.strip().split("\n")[-1][-72:]
        return seconds, usage.ru_maxrss / 1024, status == 0, line

    def cells(self, operand):
        """How many convex cells an operand has."""
        done = subprocess.run([os.path.join(self.binaries, "minkowski"), "--decompose", operand, "-o",
                               self.path("cells.off")], check=True, capture_output=True, text=True)
        return int(done.stdout.split()[0])

    def families(self):
        """name -> pairs of operands that grow together."""
        return {
            "generic": [[self.make(bumpy_ball, f"bumpy{n}{seed}.off", n, seed) for seed in (0, 1)]
                        for n in (5, 7, 9, 11, 13, 17, 23)],
            "extruded": [[self.make(star_prism, f"grow{k}.off", k, 0), self.make(star_prism, f"grown{k}.off", k, 0.4)]
                         for k in (6, 9, 13, 18, 24, 36, 48)],
            "nearly convex": [[self.make(latitude_ball, f"ball{n}.off", 1.0, n, n // 2, True),
                               self.make(latitude_ball, f"other{n}.off", 0.7, n + 1, n // 2, True)]
                              for n in (8, 12, 16, 22, 30, 40)],
        }


def exponent(points):
    """The slope of the line through the logarithms of points (x, y)."""
    logs = [(math.log(x), math.log(y)) for x, y in points if x > 1 and y > 0]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    return (sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs))


def growth(bench, limit):
    """Seconds over the number of pairs of cells, by the default strategy."""
    print(f"{'family of sums':14}  {'cells':>12}  {'pairs':>8}  {'CPU s':>8}  {'peak MB':>8}  {'strategy':>11}", flush=True)
    exponents = []
    for name, pairs in bench.families().items():
        points = []
        for operands in pairs:
            k, l = (bench.cells(operand) for operand in operands)
            seconds, peak, done, line = bench.run(operands, "default", limit)
            with open(bench.path("report.json"), encoding="utf-8") as report:
                chosen = json.load(report)["strategies"][0]["chosen"]
            print(f"{name:14}  {f'{k} x {l}':>12}  {k * l:8}  {seconds:8.3f}  {peak:8.0f}  "
                  f"{chosen if done else 'not done: ' + line:>11}", flush=True)
            if done:
                points.append((k * l, seconds))
        if len(points) > 1:
            exponents.append(f"{name}: seconds grow as the pairs of cells to the power {exponent(points):.2f}")
    print("\n".join(exponents))


def build_manifold_peer(binaries, prefix):
    """The program for the library installed at a prefix."""
    folder = os.path.join(os.path.dirname(os.path.abspath(binaries)), "manifold_peer")
    for command in (["cmake", "-S", os.path.join(HERE, "..", "manifold"), "-B", folder,
                     "-DCMAKE_PREFIX_PATH=" + os.path.abspath(prefix)], ["cmake", "--build", folder]):
        subprocess.run(command, check=True, capture_output=True)
    return os.path.join(folder, "nef_bench_manifold_sum")


def arguments_of(description, unions):
    """The command line that this program and parts.py have in common."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default=os.path.join(HERE, "..", "..", "build", "release", "bin"))
    parser.add_argument("--cases", nargs="*", help="run cases whose names hold one of these")
    parser.add_argument("--unions", nargs="*", default=unions, help="default, convolution, queue")
    parser.add_argument("--growth", action="store_true", help="instead: families of operands that grow, with exponents")
    parser.add_argument("--cgal", action="store_true", help="CGAL's minkowski_sum_3 (the program sum_peer) beside ours")
    parser.add_argument("--manifold", metavar="PREFIX", help="the Manifold library installed there beside ours (doubles)")
    parser.add_argument("--openscad", action="store_true", help="the program openscad beside ours")
    parser.add_argument("--limit", type=int, default=60, help="CPU seconds after which a run is ended")
    parser.add_argument("--keep", help="leave the operands in this directory")
    return parser.parse_args()


def engines_of(bench, arguments):
    """Our strategies and the peers that a command line asks for."""
    engines = list(arguments.unions)
    if arguments.cgal:
        engines.append("cgal")
    if arguments.manifold:
        bench.manifold = build_manifold_peer(arguments.bin, arguments.manifold)
        engines.append("manifold")
    if arguments.openscad:
        engines.append("openscad")
    return engines


def main():
    arguments = arguments_of(__doc__, ["default", "convolution", "queue"])
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or temporary
        os.makedirs(folder, exist_ok=True)
        bench = Bench(os.path.abspath(arguments.bin), os.path.abspath(folder))
        if arguments.growth:
            growth(bench, arguments.limit)
            return 0
        engines = engines_of(bench, arguments)
        print(f"{'case':28} {'union':8} {'CPU s':>8} {'peak MB':>8}")
        for name, make in bench.cases().items():
            if arguments.cases and not any(part in name for part in arguments.cases):
                continue
            operands = make()
            for union in engines:
                seconds, peak, done, line = bench.run(operands, union, arguments.limit)
                print(f"{name:28} {union:8} {seconds:8.2f} {peak:8.0f}  {line if done else 'not done: ' + line}",
                      flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
