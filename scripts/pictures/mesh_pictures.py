#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The pictures of docs/meshes.md: for each cause a mesh, its faces coloured by what became of them, and the solid beside it.

  scripts/pictures/mesh_pictures.py [--nef build/release/bin/nef] [--out docs/pictures]

Each mesh is written here as polygons; `nef repair --record` says what became of its faces, and `nef picture` draws the groups and the
result, cut open. A line for each picture tells which options were needed.
"""
import argparse
import math
import pathlib
import subprocess
import tempfile

BOX = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))


def box(low, high):
    """Corners and outward faces."""
    corners = [tuple((high if v >> i & 1 else low)[i] for i in range(3)) for v in range(8)]
    return corners, [list(face) for face in BOX]


def together(*meshes):
    vertices, faces = [], []
    for more, those in meshes:
        faces += [[v + len(vertices) for v in face] for face in those]
        vertices += more
    return vertices, faces


def cup(sides=24, top=3):
    """A round cup without its top, of a wall of this height whose rim goes up and down."""
    vertices, faces = [(0, 0, 0)], []
    for k in range(sides):
        a = 2 * math.pi * k / sides
        vertices += [(math.cos(a), math.sin(a), 0), (math.cos(a), math.sin(a), top + .1 * top * math.sin(3 * a))]
    for k in range(sides):
        a, b = 1 + 2 * k, 1 + 2 * ((k + 1) % sides)
        faces += [[0, b, a], [a, b, b + 1], [a, b + 1, a + 1]]
    return vertices, faces


def sheets():
    """Six squares that stick out beyond the cube that they enclose."""
    vertices, faces = [], []
    for axis in range(3):
        for sign in (-1, 1):
            first = len(vertices)
            for u, v in ((-1.5, -1.5), (1.5, -1.5), (1.5, 1.5), (-1.5, 1.5)):
                p = [0, 0, 0]
                p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = sign, u, v
                vertices.append(tuple(p))
            face = [first, first + 1, first + 2, first + 3]
            faces.append(face if sign > 0 else face[::-1])
    return vertices, faces


def sheet(count=12):
    """A flat square of many faces."""
    at = lambda i, k: i * (count + 1) + k
    vertices = [(3 * i / count, 3 * k / count, 0) for i in range(count + 1) for k in range(count + 1)]
    faces = [[at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)] for i in range(count) for k in range(count)]
    return vertices, faces


def crumbs():
    """A part and three small boxes beside it."""
    near = [(2.3, .2, .1), (2.6, 1.4, 1), (.4, 2.4, 1.7)]
    return together(box((0, 0, 0), (2, 2, 2)), *(box(p, tuple(x + .2 for x in p)) for p in near))


def turned():
    vertices, faces = box((0, 0, 0), (2, 2, 2))
    return vertices, [face[::-1] if f in (1, 3) else face for f, face in enumerate(faces)]


def copies():
    vertices, faces = box((0, 0, 0), (2, 2, 2))
    return vertices, faces + [face[::-1] for face in faces[1:4]]


CAUSES = {  # mesh, options of repair, and of x + y <= cut
    "overlap": (together(box((0, 0, 0), (3, 3, 2)), box((.5, .5, .5), (2, 2, 3))), [], 3),
    "nested": (together(box((0, 0, 0), (3, 3, 3)), box((1, 1, 1), (2, 2, 2))), [], 3),
    "turned": (turned(), [], None),
    "copies": (copies(), [], None),
    "hole": (cup(), ["--close=20"], None),
    "large": (cup(top=.6), ["--close=60"], None),
    "sheets": (sheets(), ["--crossings", "guess"], None),
}


def write_off(path, mesh):
    vertices, faces = mesh
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"] + [" ".join(map(repr, v)) for v in vertices]
    lines += [" ".join(map(str, [len(face), *face])) for face in faces]
    path.write_text("\n".join(lines) + "\n")


def draw_unrepaired(nef, folder, out):
    """Meshes that no repair makes another solid of."""
    view = ["--from", "2,1.6,1.3", "--size", "560x320"]
    write_off(folder / "flat.off", sheet())
    subprocess.run([nef, "picture", "flat.off", "--as-surface", *view, "-q", "-o", (out / "mesh_flat.png").resolve()], cwd=folder, check=True)
    write_off(folder / "crumbs.off", crumbs())
    for words in (["split", "crumbs.off", "--above", "1", "-o", "part.nef"],
                  ["transform", "part.nef", "--translate", "-4,4,0", "-o", "part_after.nef"],
                  ["picture", "crumbs.off", "part_after.nef", *view, "-o", (out / "mesh_crumbs.png").resolve()]):
        subprocess.run([nef, *words, "-q"], cwd=folder, check=True)
    print("mesh_flat.png: nef picture --as-surface\nmesh_crumbs.png: nef split --above 1")


def draw(nef, name, cause, folder, out):
    def run(*words):
        subprocess.run([nef, *map(str, words), "-q"], cwd=folder, check=True)

    mesh, options, cut = cause
    vertices = mesh[0]
    write_off(folder / f"{name}.off", mesh)
    run("repair", f"{name}.off", "-o", f"{name}.nef", "--record", f"{name}.obj", *options)
    width = max(v[0] for v in vertices) - min(v[0] for v in vertices)
    run("transform", f"{name}.nef", "--translate", f"{-1.4 * width},{1.4 * width},0", "-o", f"{name}_after.nef")
    lines = (folder / f"{name}.obj").read_text().splitlines()
    groups = [line[2:] for line, after in zip(lines, lines[1:]) if line.startswith("g ") and after.startswith("f ")]
    shown = [f"{name}.obj#{group}" for group in groups]
    picture = (out / f"mesh_{name}.png").resolve()
    section = ["--section", f"1,1,0,-{cut}"] if cut else []
    run("picture", *shown, f"{name}_after.nef", "--as-surface", *section, "--from", "2,1.6,1.3", "--size", "560x320", "-o", picture)
    print(f"{picture.name}: {', '.join(groups)}; nef repair {' '.join(options)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nef", default="build/release/bin/nef", type=pathlib.Path)
    parser.add_argument("--out", default="docs/pictures", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for name, cause in CAUSES.items():
            draw(options.nef.resolve(), name, cause, pathlib.Path(folder), options.out)
        draw_unrepaired(options.nef.resolve(), pathlib.Path(folder), options.out)


if __name__ == "__main__":
    main()
