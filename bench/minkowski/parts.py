#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sums, offsets, clearance and reach of machine parts: makes the parts, runs `minkowski` on each task, prints CPU seconds.

    bench/minkowski/parts.py [--bin DIR] [--cases NAME ...] [--unions auto queue ...] [--limit SECONDS] [--keep DIR]
    bench/minkowski/parts.py --cgal --manifold PREFIX --openscad ...      peers beside, where they are there
    bench/minkowski/parts.py --growth                                     offsets of parts that grow, with exponents

Parts are turned, extruded and drilled, with coordinates in doubles as CAD programs write them; scans are bumpy balls.
Processor seconds of the whole process on one thread, with reading and writing; `must` is what the project promises.
"""
import math
import os
import sys
import tempfile

from stress import Bench, arguments_of, bumpy_ball, engines_of, exponent, extrude, write_off

# Radius and height along a flange with a hub and a stepped bore: 40 triangles a side.
FLANGE = [(10, 0), (14, 0), (14, 2), (16, 2), (16.5, 2.5), (16.5, 5), (16, 5.5), (13, 5.5), (12.5, 6), (12.5, 12), (13, 12.5),
          (13, 16), (12, 17), (10, 17), (9.6, 16.8), (9.6, 12), (8, 12), (8, 8), (9, 8), (9, 1)]


def turned(path, profile, sides, turn=0.0):
    """The ring that a counterclockwise profile of radius and height sweeps about the z axis."""
    vertices, faces = [], []
    for radius, height in profile:
        for k in range(sides):
            angle = 2 * math.pi * k / sides + turn
            vertices.append((radius * math.cos(angle), radius * math.sin(angle), height))
    for i in range(len(profile)):
        j = (i + 1) % len(profile)
        for k in range(sides):
            m = (k + 1) % sides
            faces += [[i * sides + k, i * sides + m, j * sides + m], [i * sides + k, j * sides + m, j * sides + k]]
    write_off(path, vertices, faces)


def mill(path, radius, length, around, rings):
    """A ball mill, its centre in the origin: a half ball of rings below, a shaft above. around * (2 * rings + 2) facets or so."""
    vertices, faces = [(0.0, 0.0, -radius)], []
    for i in range(1, rings + 1):
        polar = 0.5 * math.pi * i / rings
        for k in range(around):
            angle = 2 * math.pi * k / around
            vertices.append((radius * math.sin(polar) * math.cos(angle), radius * math.sin(polar) * math.sin(angle),
                             -radius * math.cos(polar) if i < rings else 0.0))
    vertices += [(x, y, length) for x, y, _ in vertices[-around:]]
    row = lambda i, k: 1 + i * around + k % around
    for k in range(around):
        faces.append([0, row(0, k + 1), row(0, k)])
        for i in range(rings):
            faces += [[row(i, k), row(i, k + 1), row(i + 1, k + 1)], [row(i, k), row(i + 1, k + 1), row(i + 1, k)]]
    faces.append([row(rings, k) for k in range(around)])
    write_off(path, vertices, faces)


def gear_outline(teeth, radius=1000.0, depth=100.0):
    """Five corners a tooth, in doubles."""
    outline = []
    for t in range(teeth):
        for share, height in ((0, 0), (0.25, 0), (0.4, 1), (0.7, 1), (0.85, 0.1)):
            angle = 2 * math.pi * (t + share) / teeth
            outline.append(((radius + depth * height) * math.cos(angle), (radius + depth * height) * math.sin(angle)))
    return outline


def gear(path, corners, height=100.0, radius=1000.0):
    """An extruded gear."""
    extrude(path, gear_outline(corners // 5, radius, radius / 10), height)


def flat(path, outline):
    """One face."""
    write_off(path, [(x, y, 0) for x, y in outline], [list(range(len(outline)))])


def wavy_outline(corners, seed, radius=1000.0):
    """A polygon with a wavy border."""
    outline = []
    for k in range(corners):
        angle = 2 * math.pi * k / corners
        r = radius * (1 + 0.2 * math.sin(3 * angle + seed) + 0.1 * math.sin(17 * angle) + 0.05 * math.sin(41 * angle + 2 * seed))
        outline.append((r * math.cos(angle), r * math.sin(angle)))
    return outline


def sheet(path, n):
    """A wavy sheet of 2 n^2 triangles."""
    vertices = [(x, y, 0.8 * math.sin(0.5 * x) * math.cos(0.4 * y)) for x in range(n + 1) for y in range(n + 1)]
    faces = []
    for x in range(n):
        for y in range(n):
            a, b = x * (n + 1) + y, (x + 1) * (n + 1) + y
            faces += [[a, b, b + 1], [a, b + 1, a + 1]]
    write_off(path, vertices, faces)


class Parts(Bench):
    def coupling(self):
        """A flange with bolt holes and a keyway: about 3,700 triangles."""
        if not os.path.exists(self.path("coupling.off")):
            self.make(turned, "blank.off", FLANGE, 60)
            holes = " - ".join(f'translate(cylinder(20, 0.7, 0.7, 24), {15 * math.cos(a):.12f}, {15 * math.sin(a):.12f}, -1)'
                               for a in (math.pi * k / 4 for k in range(8)))
            self.nef(f'regularize(file("{self.path("blank.off")}") - {holes} - box(-1.5,0,-1, 1.5,11,20))', "coupling.off")
        return self.path("coupling.off")

    def obstacles(self):
        names = []
        for k in range(50):
            name = f"obstacle{k}.off"
            self.make(bumpy_ball, f"ball_{k}.off", 7, k)
            self.nef(f'translate(scale(file("{self.path(f"ball_{k}.off")}"), 1/1000), {3 * (k % 5)}, {3 * (k // 5 % 5)}, {3 * (k // 25)})',
                     name.replace(".off", ".nef"))
            names.append(self.path(name.replace(".off", ".nef")))
        return names

    def command(self, operands, engine):
        command = super().command(operands, engine)
        if "--penetration" in operands:  # an answer, and no set; no peer gets here
            at = command.index("-o")
            del command[at:at + 2]
        return command

    def tasks(self):
        """name -> what it must take (seconds), and a function that makes the operands and returns the arguments."""
        flange = lambda: self.make(turned, "flange.off", FLANGE, 30)
        bore = lambda: self.nef(f'regularize(file("{self.make(gear, "gear_b.off", 300, 6.0, 12.0)}") - '
                                f'translate(cylinder(14, 4, 4, 24), 0,0,-1))', "bored.off")
        extruded = lambda corners: self.make(gear, f"gear{corners}.off", corners)
        flat_gear = lambda n: self.make(flat, f"flat{n}.off", gear_outline(n // 5))
        ball_mill = lambda: self.make(mill, "mill.off", 0.8, 30.0, 24, 2)
        where = lambda x: self.nef(f'translate(file("{bore()}"), {x}, 1/3, 1/7)', f"bored{x}.nef")
        robot = lambda: self.nef(f'scale(file("{self.make(bumpy_ball, "robot.off", 13, 9)}"), 1/2000)', "robot.nef")
        scan = lambda n: self.make(bumpy_ball, f"scan{n}.off", n, 3)
        return {
            "flange + -(bored gear)": (3, lambda: [flange(), bore(), "--negate-b"]),
            "penetration, overlapping": (0.3, lambda: [flange(), where(9), "--penetration"]),
            "penetration, disjoint": (0.05, lambda: [flange(), where(40), "--penetration"]),
            "flange + flange": (10, lambda: [flange(), flange()]),
            "bored gear + itself": (10, lambda: [bore(), bore()]),
            "offset of the coupling": (None, lambda: [self.coupling(), "--ball", "1/2,4"]),
            "opening of the coupling": (None, lambda: [self.coupling(), "--ball", "1/2,4", "--open"]),
            "closing of the coupling": (3, lambda: [self.coupling(), "--ball", "1/2,4", "--close"]),
            "reach of a ball mill": (4, lambda: [ball_mill(), self.coupling(), "--reach"]),
            "milling of the coupling": (None, lambda: [self.coupling(), "--ball", "1/2,4", "--millable"]),
            "the same from above": (None, lambda: [self.coupling(), "--ball", "1/2,4", "--millable", "--axes", "3"]),
            "milling of a scan of 50,000": (10, lambda: [scan(160), "--ball", "10,4", "--millable"]),
            "gears of 200 + 200": (1.5, lambda: [extruded(200), extruded(200)]),
            "gears of 200 + 20": (1.5, lambda: [extruded(200), extruded(20)]),
            "sheet + ball": (0.3, lambda: [self.make(sheet, "sheet.off", 24), "--as-surface", "--ball", "1/3,2"]),
            "flat gears of 60 + 60": (0.05, lambda: [flat_gear(60), flat_gear(60), "--as-surface"]),
            "flat gears of 300 + 300": (None, lambda: [flat_gear(300), flat_gear(300), "--as-surface"]),
            "polygons of 1000": (0.5, lambda: [self.make(flat, "wavy0.off", wavy_outline(1000, 0)),
                                               self.make(flat, "wavy1.off", wavy_outline(1000, 1)), "--as-surface"]),
            "configuration space": (2, lambda: ["--configuration-space", "--robot", robot(), "--obstacles", *self.obstacles(),
                                                "--box=-5,-5,-5,20,20,10"]),
            "offset of a scan of 20,000": (None, lambda: [scan(101), "--ball", "10,2"]),
            "offset of a scan of 80,000": (None, lambda: [scan(201), "--ball", "10,2"]),
            "offset of a scan of 300,000": (60, lambda: [scan(388), "--ball", "10,2"]),
            "the same by regions": (None, lambda: [scan(388), "--ball", "10,2", "--memory", "200M"]),
        }


    def offsets(self):
        """name -> how many triangles each part of a family has that grows, and a function that makes it and its ball.

        The ball grows with a tooth, or the length of a side, as the offset of a part does that is scanned more finely."""
        def extruded(n):
            outline = gear_outline(n // 5, 1000.0, 30000 / n)  # teeth as deep as they are apart
            return [self.make(extrude, f"grow_gear{n}.off", outline, 100.0), "--ball", f"{20000 / n:.6f},2"]

        def of_turned(n):
            return [self.make(turned, f"grow_flange{n}.off", FLANGE, n), "--ball", f"{60 / n:.6f},2"]

        def of_scan(n):
            return [self.make(bumpy_ball, f"grow_scan{n}.off", n, 3), "--ball", f"{3880 / n:.6f},2"]

        return {
            "extruded": ([4 * n for n in (250, 1000, 4000, 16000, 75000)], lambda size: extruded(size // 4)),
            "turned": ([40 * n for n in (25, 100, 400, 1600, 7500)], lambda size: of_turned(size // 40)),
            "scanned": ([2 * n * n for n in (23, 45, 90, 180, 388)], lambda size: of_scan(math.isqrt(size // 2))),
        }


def offset_growth(bench, limit):
    """Seconds and memory over the triangles of a part."""
    print(f"{'family':10} {'triangles':>9} {'CPU s':>8} {'peak MB':>8}", flush=True)
    exponents = []
    for name, (sizes, make) in bench.offsets().items():
        points = []
        for size in sizes:
            seconds, peak, done, line = bench.run(make(size), "default", limit)
            print(f"{name:10} {size:9} {seconds:8.2f} {peak:8.0f}  {line if done else 'not done: ' + line}", flush=True)
            if done:
                points.append((size, seconds))
        exponents.append(f"{name}: seconds grow as triangles to the power {exponent(points):.2f}, "
                         f"{exponent(points[-3:]):.2f} over the last three")
    print("\n".join(exponents))


def main():
    arguments = arguments_of(__doc__, ["default"])
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or temporary
        os.makedirs(folder, exist_ok=True)
        bench = Parts(os.path.abspath(arguments.bin), os.path.abspath(folder))
        if arguments.growth:
            offset_growth(bench, arguments.limit)
            return 0
        engines = engines_of(bench, arguments)
        print(f"{'task':28} {'union':11} {'CPU s':>8} {'must':>5} {'peak MB':>8}")
        for name, (must, make) in bench.tasks().items():
            if arguments.cases and not any(part in name for part in arguments.cases):
                continue
            operands = make()
            for union in engines:
                seconds, peak, done, line = bench.run(operands, union, arguments.limit)
                print(f"{name:28} {union:11} {seconds:8.2f} {must or '':>5} {peak:8.0f}  {line if done else 'not done: ' + line}",
                      flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
