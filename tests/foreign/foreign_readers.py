#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether programs of others read what the suite writes: sets of every kind, the empty one too, in every format.

Each file must be the solid that was written: closed, without crossings where the reader looks for them, and with the volume
that `nef info` gives (within what floats lose). Readers are asked that are there; the last lines say which one read how many
files of which formats, and which ones are missing. Fails if a file was refused or is another solid.

Usage: foreign_readers.py PROGRAMS DATA WORK [--modules DIR] [--cgal PROGRAM]
    the folders of the programs, of data/ and for files; a node_modules with gltf-validator and three; tests/foreign/cgal_reader
"""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree
from collections import Counter

#: name, arguments of the program that makes the set, options of writing
SETS = [
    ("box", ["nef", "eval", "box(0,0,0, 3,2,1)"], []),
    ("notched", ["nef", "eval", "box(0,0,0, 3,3,3) - rotate(sphere(1,16), (1,2,3), 17)"], []),
    ("turned", ["nef", "eval", "rotate(box(0,0,0,2,1,1), (1,1,1), 20) + rotate(cylinder(3,1/2,1/2,9), x, 33)"], []),
    ("ring", ["nef", "eval", "rotate(cylinder(1,2,2,24) - translate(cylinder(3,1,1,20),0,0,-1), (3,1,2), 41)"], []),
    ("cavity", ["nef", "eval", "box(0,0,0, 4,4,4) - interior(box(1,1,1, 2,3,3))"], []),
    ("parts", ["nef", "eval", "sphere(1,12) + translate(rotate(box(0,0,0,1,1,1),z,30), 3,0,0)"], []),
    ("plate", ["nef", "eval", "rotate(box(0,0,0, 5,4,1/1000), (1,2,2), 11)"], []),
    ("far", ["nef", "eval", "translate(sphere(1,16), 700000,1400000,-2100000)"], ["--recenter"]),
    ("edge", ["nef", "eval", "box(0,0,0, 1,1,1) + box(1,1,0, 2,2,1)"], ["--manifold"]),
    ("corner", ["nef", "eval", "box(0,0,0, 1,1,1) + box(1,1,1, 2,2,2)"], ["--manifold"]),
    ("tetrahedron", ["nef", "eval", "hull(0,0,0, 3,1/3,0, 1,2,1/7, 1,1,5/3)"], []),
    ("cone", ["nef", "eval", "rotate(cylinder(3,1,0,17), (1,1,0), 50)"], []),
    ("frustum", ["nef", "eval", "rotate(cylinder(2,2,1/3,11) - box(-1/2,-1/2,-1, 1/2,1/2,3), (0,1,3), 77)"], []),
    ("half", ["nef", "eval", "sphere(2,20) * halfspace(1,2,3,-1/3)"], []),
    ("lens", ["nef", "eval", "sphere(2,24) * translate(sphere(2,24), 1/3,2,1/5)"], []),
    ("chain", ["nef", "eval", "sphere(1,10) + translate(sphere(1,10),3/2,0,0) + translate(rotate(sphere(1,10),x,9),3,1/9,0)"], []),
    ("holes", ["nef", "eval", "c = cylinder(9,1/4,1/4,12); box(0,0,0,4,3,1) - translate(c,1,1,-2) - translate(c,2,2,-2)"
               " - translate(rotate(c,x,25),3,2,-4)"], []),
    ("stairs", ["nef", "eval", "rotate(box(0,0,0,3,1,1) + box(1,0,1,3,1,2) + box(2,0,2,3,1,3), (2,1,2), 31)"], []),
    ("nested", ["nef", "eval", "sphere(3,14) - interior(sphere(2,12)) + sphere(1,10)"], []),
    ("rounded", ["minkowski", "DATA/minkowski/P.off", "--ball", "1/5,2"], []),
    ("large", ["nef", "eval", "scale(rotate(box(0,0,0,3,2,1),(1,2,3),5) - sphere(1,14), 1000000)"], []),
    ("cut", ["nef", "eval", 'file("DATA/meshes/hand.off") * rotate(halfspace(0,0,1,-1/100), (1,3,2), 40)'], []),
    ("rotor", ["nef", "convert", "DATA/meshes/rotor.off"], []),
    ("carved", ["nef", "eval", 'file("DATA/meshes/eight.off") - translate(sphere(1/2,16), 0,0,1/2)'], []),
    ("eroded", ["minkowski", "DATA/meshes/star.off", "--ball", "1/30,1", "--erode"], []),
    ("no-fit", ["minkowski", "DATA/minkowski/tripod.off", "DATA/minkowski/cube.off", "--negate-b"], []),
    ("scan", ["nef", "convert", "DATA/meshes/eight.off"], []),
    ("sum", ["minkowski", "DATA/meshes/star.off", "--ball", "1/7,2"], []),
    ("hull", ["visual_hull", "DATA/visual_hull/letters/mpi.vsh"], []),
    ("empty", ["nef", "eval", "nothing"], []),
]
FILES = [(extension, []) for extension in ("off", "obj", "ply", "stl", "glb", "3mf")]
FILES += [("binary.ply", ["--binary"]), ("binary.stl", ["--binary"])]


class Check:
    """One run: the files, and what the readers said of them."""

    def __init__(self, options):
        self.options = options
        self.read = {}  # reader: Counter of formats
        self.missing = []
        self.problems = []
        self.files = []  # (path, extension, name, info)
        self.drawings = []  # (path, area)

    def run(self, *command, **more):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, text=True, timeout=300,
                              errors="replace", **more)
        return done.returncode, done.stdout + done.stderr

    def suite(self, program, *arguments):
        """What one of our programs prints on its standard output; its notes go to standard error."""
        path = os.path.join(self.options.programs, program)
        done = subprocess.run([path, *(word.replace("DATA", self.options.data, 1) for word in arguments)], check=False,
                              capture_output=True, text=True, timeout=300)
        if done.returncode:
            raise RuntimeError(f"{program} {' '.join(arguments)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def write(self):
        for name, (program, *arguments), flags in SETS:
            whole = os.path.join(self.options.work, name + ".nef")
            self.suite(program, *arguments, "-o", whole, "-q")
            info = json.loads(self.suite("nef", "info", whole, "--json"))["result"]
            for ending, more in FILES:
                if "--manifold" in flags and ending.endswith("stl"):
                    continue  # STL names no vertices
                path = os.path.join(self.options.work, f"{name}.{ending}")
                self.suite("nef", "convert", whole, "-o", path, "-q", *flags, *more)
                self.files.append((path, ending.split(".")[-1], name, info))
            path = os.path.join(self.options.work, name + ".svg")
            told = self.suite("nef", "section", whole, "--plane", "1,2,3,-1/7", "-o", path, "--json")
            self.drawings.append((path, json.loads(told)["area"]))

    def those(self, extensions, empty=False):
        return [file for file in self.files if file[1] in extensions and (empty or file[2] != "empty")]

    def problem(self, reader, path, text):
        self.problems.append(f"{reader}: {os.path.basename(path)}: {text}")

    def count(self, reader, path):
        self.read.setdefault(reader, Counter())[path.split(".", 1)[1]] += 1

    def same_volume(self, reader, path, info, volume):
        self.count(reader, path)
        wanted = info["volume_double"]
        # Floats keep 2^-24 of each coordinate, and a plate is thin beside its other sides. Two readers print six decimals.
        sides = [high - low for low, high in zip(*info["bbox"])] if info["bbox"] else [0]
        if abs(volume - wanted) > 1e-5 * wanted + 1e-6 * max(sides) ** 3 + 5e-7:
            self.problem(reader, path, f"the volume is {volume} instead of {wanted}")

    def installed(self, program):
        if shutil.which(program):
            return True
        self.missing.append(program)
        return False

    def ask_node(self):
        modules = self.options.modules
        there = [name for name in ("gltf-validator", "three") if modules and os.path.isdir(os.path.join(modules, name))]
        self.missing += [name for name in ("gltf-validator", "three") if name not in there]
        if not there or not self.installed("node"):
            return
        files = self.those(("glb", "obj", "ply", "stl"), empty=True)
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "three_reader.mjs")
        code, text = self.run("node", script, modules, *(path for path, *_ in files))
        if code:
            raise RuntimeError(text)
        answers = [json.loads(line) for line in text.splitlines() if line.startswith("{")]
        for (path, extension, name, info), answer in zip(files, answers, strict=True):
            if "issues" in answer:
                self.count("gltf-validator", path)
                if answer["issues"]:
                    self.problem("gltf-validator", path, "; ".join(answer["issues"][:3]))
            if "error" in answer:
                self.problem("three", path, answer["error"])
            elif "volume" in answer:
                self.same_volume("three", path, info, answer["volume"])
                if extension == "glb" and info["bbox"]:  # the offset of a mesh that was moved is applied; y is up
                    x, y, z = [(low + high) / 2 for low, high in zip(*info["bbox"])]
                    middle = [x, z, -y]
                    off = max(abs(a - b) for a, b in zip(answer["middle"], middle))
                    if off > 1e-4 * max(1, *map(abs, middle)):
                        self.problem("three", path, f"its middle is {answer['middle']} instead of {middle}")

    def ask_admesh(self):
        if not self.installed("admesh"):
            return
        for path, _, _, info in self.those(("stl",)):
            code, text = self.run("admesh", path)
            found = dict(re.findall(r"([A-Z][A-Za-z ]+?) *: +(-?[0-9.]+)", text))
            bad = [key for key in ("Degenerate facets", "Edges fixed", "Facets removed", "Facets added", "Facets reversed",
                                   "Backwards edges", "Total disconnected facets") if float(found.get(key, "1")) != 0]
            if code or bad:
                self.problem("admesh", path, ", ".join(f"{key}: {found.get(key)}" for key in bad) or text[-300:])
            self.same_volume("admesh", path, info, float(found.get("Volume", "nan")))

    def ask_prusa_slicer(self):
        if not self.installed("prusa-slicer"):
            return
        for path, _, name, info in self.those(("stl", "obj", "3mf")):
            code, text = self.run("prusa-slicer", "--info", path)
            found = dict(re.findall(r"^(\w+) = +(\S+)", text, re.MULTILINE))
            # It knows the points of solids that touch themselves as one.
            if code or (found.get("manifold") != "yes" and name not in ("edge", "corner")):
                self.problem("prusa-slicer", path, f"manifold: {found.get('manifold')} {text[-300:]}")
            self.same_volume("prusa-slicer", path, info, float(found.get("volume", "nan")))

    def ask_assimp(self):
        if not self.installed("assimp"):
            return
        for path, extension, name, info in self.those(("off", "obj", "ply", "stl", "glb", "3mf")):
            if name == "far" and extension in ("glb", "3mf"):
                continue  # it moves the mesh to its offset, in floats
            again = path + ".assimp.stl"
            code, text = self.run("assimp", "export", path, again, "-tri")
            if code or not os.path.exists(again):
                self.problem("assimp", path, text[-300:])
                continue
            self.same_volume("assimp", path, info, volume_of_stl(again))

    def ask_openscad(self):
        if not self.installed("openscad"):
            return
        script = os.path.join(self.options.work, "import.scad")
        made = os.path.join(self.options.work, "made.stl")
        for path, _, name, info in self.those(("off", "stl", "3mf")):
            if name in ("edge", "corner"):
                continue  # it joins equal points again, and then refuses the edge of four faces
            # A difference makes a solid of the mesh, by CGAL.
            text = f'difference() {{ import("{path}"); translate([1e4,0,0]) cube(1); }}'
            self.same_volume("openscad", path, info, self.rendered(script, text, made, path))
        for path, area in self.drawings:
            text = f'linear_extrude(1) import("{path}", dpi=25.4);'  # a unit of the drawing is one of OpenSCAD's
            volume = self.rendered(script, text, made, path, empty=area == 0)
            self.count("openscad", path)
            if abs(volume - area) > 1e-4 * max(1, area):
                self.problem("openscad", path, f"the area is {volume} instead of {area}")

    def rendered(self, script, text, made, path, empty=False):
        with open(script, "w", encoding="utf-8") as file:
            file.write(text)
        if os.path.exists(made):
            os.remove(made)
        _, said = self.run("openscad", "-o", made, script)
        if "WARNING" in said or "ERROR" in said:
            self.problem("openscad", path, said[:300])
        if not os.path.exists(made):
            if not empty:
                self.problem("openscad", path, said[-300:])
            return 0
        return volume_of_stl(made)

    def ask_cgal(self):
        if not self.options.cgal or not os.path.exists(self.options.cgal):
            self.missing.append("CGAL")
            return
        files = self.those(("off", "obj", "ply", "stl"))
        _, text = self.run(self.options.cgal, *(path for path, *_ in files))
        answers = {line.split()[0]: line.split()[1:] for line in text.splitlines() if line.startswith("/")}
        for path, _, name, info in files:
            answer = answers.get(path, ["nothing was said"])
            # What touches itself is two sheets there, which meet.
            simple = len(answer) == 4 and (answer[2] == "simple" or name in ("edge", "corner"))
            if not simple or answer[1] != "closed":
                self.problem("CGAL", path, " ".join(answer))
                continue
            self.same_volume("CGAL", path, info, float(answer[3]))

    def ask_meshio(self):
        try:
            import meshio  # pylint: disable=import-outside-toplevel
        except ImportError:
            self.missing.append("meshio")
            return
        for path, _, _, info in self.those(("off", "obj", "ply", "stl")):
            try:
                mesh = meshio.read(path)
            except BaseException as error:  # it exits where it does not understand
                self.problem("meshio", path, repr(error))
                continue
            faces = [face for block in mesh.cells for face in block.data]
            self.same_volume("meshio", path, info, volume_of([[mesh.points[v] for v in face] for face in faces]))

    def ask_xml(self):
        for path, area in self.drawings:
            root = xml.etree.ElementTree.parse(path).getroot()
            self.count("Python's XML", path)
            box = [float(x) for x in root.get("viewBox").split()]
            if not (box[2] > 1e-30 and box[3] > 1e-30):
                self.problem("Python's XML", path, f"the drawing of area {area} has the box {box}")


def volume_of(faces):
    """Of a closed surface of polygons that are fans."""
    total = 0
    origin = faces[0][0] if faces else None
    for face in faces:
        a, *rest = [[float(x) - float(o) for x, o in zip(corner, origin)] for corner in face]
        for b, c in zip(rest, rest[1:]):
            total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                      + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


def volume_of_stl(path):
    with open(path, encoding="ascii") as file:
        corners = [line.split()[1:4] for line in file if line.split()[:1] == ["vertex"]]
    return volume_of([corners[i:i + 3] for i in range(0, len(corners), 3)])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("programs", "data", "work"):
        parser.add_argument(name, type=os.path.abspath)
    parser.add_argument("--modules", type=os.path.abspath)
    parser.add_argument("--cgal", type=os.path.abspath)
    check = Check(parser.parse_args())
    os.makedirs(check.options.work, exist_ok=True)
    check.write()
    for ask in (check.ask_node, check.ask_admesh, check.ask_prusa_slicer, check.ask_assimp, check.ask_openscad,
                check.ask_cgal, check.ask_meshio, check.ask_xml):
        ask()
    for line in check.problems:
        print(line)
    for reader, formats in check.read.items():
        print(f"{reader} read " + ", ".join(f"{count} {name}" for name, count in sorted(formats.items())))
    if check.missing:
        print("not there, so not asked: " + ", ".join(check.missing))
    print(f"{len(check.files) + len(check.drawings)} files, {len(check.problems)} problems")
    return 1 if check.problems else 0


if __name__ == "__main__":
    sys.exit(main())
