# SPDX-License-Identifier: Apache-2.0
"""The corpus of compare_paths.py: commands over shipped data, and over generated meshes, expressions and scenes."""
import dataclasses
import itertools
import json
import math
import pathlib
import random
import struct

Point = tuple[float, float, float]
Mesh = tuple[list[Point], list[list[int]]]


@dataclasses.dataclass
class Case:
    """Commands that are run one after the other in one folder; their first words are names of programs."""

    name: str
    commands: list[list[str]]
    legal: bool = True  # none of them may refuse its input

    @property
    def program(self) -> str:
        """The program that it is about."""
        others = {command[0] for command in self.commands} - {"nef"}
        assert len(others) < 2, f"{self.name} is about {sorted(others)}"
        return others.pop() if others else "nef"


# Meshes.


def box(low: Point, high: Point) -> Mesh:
    points = [tuple((high if corner >> axis & 1 else low)[axis] for axis in range(3)) for corner in range(8)]
    return points, [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]


def triangles(mesh: Mesh) -> Mesh:
    points, faces = mesh
    return points, [[face[0], face[i], face[i + 1]] for face in faces for i in range(1, len(face) - 1)]


def inside_out(mesh: Mesh) -> Mesh:
    return mesh[0], [face[::-1] for face in mesh[1]]


def star(rng: random.Random, levels: int, rough: float) -> Mesh:
    """An octahedron, subdivided, whose vertices move along their rays: edges bend both ways unless `rough` is 0."""
    points: list[Point] = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [[i, (i + 1) % 4, 4] for i in range(4)] + [[(i + 1) % 4, i, 5] for i in range(4)]
    for _ in range(levels):
        middles: dict[tuple[int, int], int] = {}

        def middle(a: int, b: int) -> int:
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append(tuple((points[a][i] + points[b][i]) / 2 for i in range(3)))
            return middles[key]

        finer = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        faces = finer
    moved = []
    for p in points:
        size = (1 + rough * rng.uniform(-1, 1)) / math.sqrt(sum(x * x for x in p))
        moved.append(tuple(x * size for x in p))
    return moved, faces


def prism(rng: random.Random, sides: int, dented: bool) -> Mesh:
    """A prism over a polygon, its bottom and top cut into fans around their middles."""
    ring = []
    for i in range(sides):
        radius = rng.uniform(0.5, 1.5) if dented else 1.0
        ring.append((radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides)))
    points: list[Point] = [(x, y, 0.0) for x, y in ring] + [(x, y, 1.0) for x, y in ring] + [(0, 0, 0), (0, 0, 1)]
    faces = []
    for i in range(sides):
        j = (i + 1) % sides
        faces += [[i, j, sides + j], [i, sides + j, sides + i]]
        faces += [[j, i, 2 * sides], [sides + i, sides + j, 2 * sides + 1]]
    return points, faces


# Radius and height along a flange with a hub and a stepped bore.
FLANGE = (
    *((10, 0), (14, 0), (14, 2), (16, 2), (16.5, 2.5), (16.5, 5), (16, 5.5), (13, 5.5), (12.5, 6), (12.5, 12)),
    *((13, 12.5), (13, 16), (12, 17), (10, 17), (9.6, 16.8), (9.6, 12), (8, 12), (8, 8), (9, 8), (9, 1)),
)


def flange(sides: int, turn: float) -> Mesh:
    """As a lathe makes it, about the z axis: two of them have very many places where sides of their sum nearly meet."""
    points: list[Point] = []
    faces = []
    for i, (radius, height) in enumerate(FLANGE):
        j = (i + 1) % len(FLANGE)
        for k in range(sides):
            angle = 2 * math.pi * k / sides + turn
            m = (k + 1) % sides
            points.append((radius * math.cos(angle), radius * math.sin(angle), height))
            faces += [[i * sides + k, i * sides + m, j * sides + m], [i * sides + k, j * sides + m, j * sides + k]]
    return points, faces


def turned(rng: random.Random, mesh: Mesh, by: float = 1.0, to: Point = (0, 0, 0)) -> Mesh:
    """Turned by a random rotation, scaled and shifted, in doubles."""
    w, x, y, z = (rng.gauss(0, 1) for _ in range(4))
    n = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / n, x / n, y / n, z / n
    matrix = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    points = [tuple(by * sum(row[i] * p[i] for i in range(3)) + t for row, t in zip(matrix, to)) for p in mesh[0]]
    return points, mesh[1]


def joined(*meshes: Mesh) -> Mesh:
    points: list[Point] = []
    faces: list[list[int]] = []
    for more, of_these in meshes:
        faces += [[i + len(points) for i in face] for face in of_these]
        points += more
    return points, faces


def spoiled(rng: random.Random, mesh: Mesh) -> Mesh:
    """With one or two things wrong."""
    points, faces = list(mesh[0]), [list(face) for face in mesh[1]]
    for _ in range(rng.randint(1, 2)):
        at = rng.randrange(len(faces))
        what = rng.randrange(7)
        if what == 0:
            faces.append(list(faces[at]))
        elif what == 1:
            faces[at].reverse()
        elif what == 2 and len(faces) > 1:
            del faces[at]
        elif what == 3:  # a vertex of its own
            points.append(points[faces[at][0]])
            faces[at][0] = len(points) - 1
        elif what == 4:
            faces.append([faces[at][0], faces[at][1], faces[at][0]])
        elif what == 5:  # bent
            points[faces[at][0]] = tuple(x + rng.uniform(-0.01, 0.01) for x in points[faces[at][0]])
        else:
            faces[at][0] = rng.randrange(len(points))
    return points, faces


def soup(rng: random.Random, count: int, grid: int) -> Mesh:
    """Triangles on a small grid, many of which cross, touch and cover each other."""
    points = [tuple(float(rng.randint(0, grid)) for _ in range(3)) for _ in range(3 * count)]
    return points, [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(count)]


def number(x: float) -> str:
    return str(int(x)) if x == int(x) and abs(x) < 1e15 else repr(x)


def off(mesh: Mesh, suffix: str = "") -> str:
    """`suffix` is put behind all coordinates, such as e30."""
    lines = ["OFF", f"{len(mesh[0])} {len(mesh[1])} 0"]
    lines += [" ".join(number(x) + (suffix if x != 0 and "e" not in number(x) else "") for x in p) for p in mesh[0]]
    lines += [" ".join(map(str, [len(face), *face])) for face in mesh[1]]
    return "\n".join(lines) + "\n"


def ply(mesh: Mesh) -> str:
    head = ["ply", "format ascii 1.0", f"element vertex {len(mesh[0])}"]
    head += [f"property double {axis}" for axis in "xyz"]
    head += [f"element face {len(mesh[1])}", "property list uchar int vertex_indices", "end_header"]
    return "\n".join(head + off(mesh).split("\n")[2:])


def stl(mesh: Mesh) -> bytes:
    points, faces = triangles(mesh)
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for i in face for x in points[i]), 0) for face in faces)
    return b"\0" * 80 + struct.pack("<I", len(faces)) + body


# Expressions.


def rational(rng: random.Random, large: bool) -> str:
    if large and rng.random() < 0.5:
        return str(rng.choice((-1, 1)) * (2 ** rng.choice((31, 53, 62, 63, 127)) + rng.randint(-2, 2)))
    quotient = f"{rng.randint(-9, 9)}/{rng.randint(1, 7)}"
    return rng.choice((str(rng.randint(-4, 4)), quotient, f"{rng.uniform(-4, 4):.3f}"))


def leaf(rng: random.Random, large: bool) -> str:
    kind = rng.randrange(9)
    points = [[rational(rng, large) for _ in range(3)] for _ in range(6)]
    if kind < 2:
        low = [rng.randint(-4, 3) for _ in range(3)]
        high = [x + rng.randint(1, 4) for x in low]
        return f"box({','.join(map(str, low))}, {','.join(map(str, high))})"
    if kind == 2:
        normal = rng.choice(("1,0,0", "0,0,1", "1,2,-1", "-3,1/2,5", "0,1,1"))
        return f"halfspace({normal}, {rational(rng, large)})"
    if kind == 3:
        return f"point({','.join(points[0])})"
    if kind == 4 and points[0] != points[1]:
        return f"segment({','.join(points[0])}, {','.join(points[1])})"
    if kind == 5:
        return f"hull({', '.join(','.join(p) for p in points)})"
    if kind == 6:
        return f"translate(sphere({rng.randint(1, 3)}, 8), {','.join(points[0])})"
    if kind == 7:
        axis = rng.choice(("x", "(1,2,2)", "(0,1,1)"))
        return f"rotate(cylinder(3, 1, {rng.randint(0, 2)}, 9), {axis}, {rng.randint(1, 89)})"
    return f"rotate(box(-1,-1,-1, 1,2,1), {rng.choice(('z', '(2,1,2)'))}, {rng.randint(1, 89)})"


def expression(rng: random.Random, depth: int, large: bool = False) -> str:
    if depth == 0:
        return leaf(rng, large)
    if rng.random() < 0.3:
        name = rng.choice(("interior", "closure", "boundary", "exterior", "regularize", "complement"))
        return f"{name}({expression(rng, depth - 1, large)})"
    return f"({expression(rng, depth - 1, large)} {rng.choice('++-*^')} {expression(rng, depth - 1, large)})"


# Cases.


class Corpus:
    def __init__(self, data: pathlib.Path, folder: pathlib.Path, seed: int):
        self.data = data
        self.folder = folder
        self.rng = random.Random(seed)
        self.cases: list[Case] = []
        folder.mkdir(parents=True)

    def write(self, name: str, content: str | bytes) -> str:
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return str(path)

    def add(self, name: str, *commands: str, legal: bool = True) -> None:
        """Words of commands are parted by blanks; what has blanks in it stands in a file."""
        self.cases.append(Case(name, [command.split() for command in commands], legal))

    def shipped_meshes(self) -> None:
        for path in sorted((self.data / "meshes").glob("*.*")):
            if path.suffix == ".md":
                continue
            self.add(
                f"shipped {path.name}",
                f"nef convert {path} -o a.nef",
                f"nef check {path}",
                "nef convert a.nef -o b.ply",
                f"nef convert {path} --as-surface -o s.nef --text",
                "nef info a.nef",
                "minkowski a.nef --hull -o h.nef",
                legal=path.stem not in ("cube-shuffled", "prim"),
            )
        for path in sorted((self.data / "nef3").glob("*.*[!d]")):
            self.add(
                f"shipped {path.name}",
                f"nef convert {path} -o a.nef",
                "nef complement a.nef -o b.nef3",
                "nef info a.nef",
            )

    def generated_meshes(self) -> None:
        rng = self.rng
        shapes = {
            "boxes that touch": joined(
                box((0, 0, 0), (1, 1, 1)), box((1, 0.5, 0.5), (2, 2, 2)), box((2, 2, 2), (3, 3, 3))
            ),
            "cavity": joined(box((0, 0, 0), (4, 4, 4)), inside_out(box((1, 1, 1), (4, 2, 2)))),
            "ball": turned(rng, star(rng, 3, 0), 10),
            "bumpy ball": turned(rng, star(rng, 3, 0.2), 1, (0.1, 0.2, 0.3)),
            "short bumpy ball": ([tuple(round(x * 64) for x in p) for p in star(rng, 3, 0.3)[0]], star(rng, 3, 0)[1]),
            "flat ball": ([tuple(float(round(x * 4)) for x in p) for p in star(rng, 2, 0.1)[0]], star(rng, 2, 0)[1]),
            "prism": turned(rng, prism(rng, 40, False), 7, (1e5, -2e5, 3e5)),
            "dented prism": turned(rng, prism(rng, 60, True), 0.01, (1, 1, 1)),
            "box inside out": inside_out(box((0, 0, 0), (1, 2, 3))),
            "balls that cross": joined(star(rng, 2, 0.1), turned(rng, star(rng, 2, 0.1), 1, (0.5, 0.3, 0.1))),
        }
        for name, mesh in shapes.items():
            stem = name.replace(" ", "_")
            path = self.write(f"{stem}.off", off(mesh))
            self.add(
                f"mesh {name}",
                f"nef convert {path} -o a.nef",
                f"nef check {path}",
                f"nef repair {path} -o r.off",
                f"nef convert {path} --as-surface -o s.nef --text",
                "nef convert a.nef -o b.obj --polygons",
                "nef section a.nef --plane 1,2,3,-1/7 -o s.svg",
                legal="cross" not in name,
            )
            self.add(
                f"mesh {name}, other formats",
                f"nef convert {self.write(f'{stem}.stl', stl(mesh))} -o a.nef --text",
                f"nef convert {self.write(f'{stem}.ply', ply(mesh))} -o b.nef",
                "nef equal a.nef b.nef",
                "nef distance a.nef b.nef",
                legal="cross" not in name,
            )
        for suffix in ("e30", "e-30", "e120", "e-120"):
            for name in ("boxes that touch", "short bumpy ball", "balls that cross"):
                path = self.write(f"{name.replace(' ', '_')}{suffix}.off", off(shapes[name], suffix))
                self.add(
                    f"mesh {name}{suffix}",
                    f"nef convert {path} -o a.nef",
                    f"nef check {path}",
                    "minkowski a.nef --hull -o h.nef",
                    f"nef convert {path} --as-surface -o s.nef",
                    legal="cross" not in name,
                )

    def dirty_meshes(self) -> None:
        rng = self.rng
        for i in range(48):
            clean = rng.choice(
                (
                    box((0, 0, 0), (1, 1, 1)),
                    triangles(box((0, 0, 0), (2, 1, 1))),
                    star(rng, 1, 0.1),
                    prism(rng, 7, True),
                    joined(box((0, 0, 0), (1, 1, 1)), box((0, 0, 1), (1, 1, 2))),
                )
            )
            mesh = spoiled(rng, clean) if i % 3 else soup(rng, rng.randint(2, 12), 3)
            path = self.write(f"dirty{i}.off", off(mesh))
            self.add(
                f"dirty {i}",
                f"nef convert {path} -o a.nef",
                f"nef check {path}",
                f"nef repair {path} --fill-holes -o r.off",
                f"nef convert {path} --as-surface -o s.nef",
                legal=False,
            )

    def solids(self) -> None:
        """Booleans of turned and shifted solids, written to all formats."""
        rng = self.rng
        for i in range(10):
            shift = rng.choice(("1/2,1/3,1/5", "0.3,0,0", "0,0,1", "1/7,-2,0.01"))
            first = rng.choice(("sphere(2, 14)", "cylinder(3, 1, 1, 20)", "box(-1,-1,-1, 1,1,2)"))
            a = self.write(f"solid{i}a.txt", f"rotate({first}, (1,2,2), {rng.randint(1, 89)})")
            b = self.write(f"solid{i}b.txt", f"translate(rotate(sphere(2, 12), z, {rng.randint(1, 89)}), {shift})")
            self.add(
                f"solids {i}",
                f"nef eval -f {a} -o a.nef",
                f"nef eval -f {b} -o b.nef",
                "nef union a.nef b.nef -o u.nef --text",
                "nef difference a.nef b.nef -o d.off",
                "nef symdiff a.nef b.nef -o x.stl --binary",
                "nef intersection b.nef a.nef -o i.glb",
                "nef union a.nef b.nef -o p.ply --exact",
                "nef equal a.nef b.nef",
                "nef info u.nef",
                "nef locate u.nef 1/3,1/3,1/3 9,9,9 0,0,2",
                "nef ray u.nef 9,8,7 -9,-8,-7",
                "nef distance a.nef b.nef",
                "nef transform u.nef --translate 1e6,2e6,-3e6 --rotate 1,1,0,30 -o t.nef",
                "nef split x.stl -o parts",
            )
        steps = ""
        for i in range(8):
            at = f"{rng.randint(-9, 9)}/4,{rng.randint(-9, 9)}/4,{i}/3"
            turned_ball = f"rotate(sphere(1, 10), (1,2,2), {rng.randint(1, 89)})"
            steps += f"{rng.choice('+-')} translate({turned_ball}, {at})\n"
        steps = self.write("steps.txt", steps)
        ball = self.write("ball.txt", "sphere(3, 20)")
        self.add(
            "tiles",
            f"nef eval -f {ball} -o ball.nef",
            f"nef apply ball.nef --steps {steps} --tiles 150 -o tiles.nef",
            f"nef apply ball.nef --steps {steps} --tiles off -o plain.nef",
            "nef equal tiles.nef plain.nef",
        )

    def expressions(self) -> None:
        """Open, closed, unbounded sets of all dimensions, with small and large coordinates."""
        rng = self.rng
        for i in range(80):
            large = i % 4 == 0
            a = self.write(f"expression{i}a.txt", expression(rng, 2 if large else 3, large))
            b = self.write(f"expression{i}b.txt", expression(rng, 2, large))
            self.add(
                f"expression {i}",
                f"nef eval -f {a} -o a.nef --text",
                f"nef eval -f {b} -o b.nef",
                "nef symdiff a.nef b.nef -o x.nef",
                "nef interior x.nef -o i.nef",
                "nef equal i.nef x.nef",
                "nef info x.nef",
                "nef ray x.nef 9,8,7 -9,-8,-7",
                "nef ray x.nef 5,1,1 -1,0,0",
            )

    def sums(self) -> None:
        folder = self.data / "minkowski"
        pairs = (("tripod.off", "cube.off"), ("P.off", "tripod.off"), ("tripod.off", "tripod.off"))
        for (a, b), way in itertools.product(pairs, ("auto", "queue", "convolution")):
            self.add(f"sum {a} {b} {way}", f"minkowski {folder / a} {folder / b} --union {way} -o s.nef")
        self.add("sum mushroom.off cube.off", f"minkowski {folder / 'mushroom.off'} {folder / 'cube.off'} -o s.nef")
        self.add(
            "decomposition",
            f"minkowski --decompose {folder / 'tripod.off'} -o cells --format nef",
            f"minkowski {folder / 'P.off'} --offset 1/4,2 -o grown.nef",
            f"minkowski {folder / 'P.off'} --offset=-1/16,2 --inner -o shrunk.nef",
            f"minkowski {folder / 'tripod.off'} {folder / 'P.off'} --penetration",
        )
        rng = self.rng
        ball = self.write("sum_ball.off", off(turned(rng, star(rng, 1, 0), 0.3)))
        dent = self.write("sum_dent.off", off(turned(rng, prism(rng, 9, True), 2)))
        self.add(
            "sum turned",
            f"minkowski {dent} {ball} -o s.nef",
            f"minkowski {ball} {ball} -o c.nef",
            f"minkowski {dent} {ball} --union queue -o q.nef",
        )
        of_twelve = self.write("flange12.off", off(flange(12, 0)))
        of_seven = self.write("flange7.off", off(flange(7, 0.3)))
        self.add(
            "sum of flanges",
            f"minkowski {of_twelve} {of_seven} -o s.nef",
            f"minkowski {of_twelve} {of_seven} --negate-b -o d.nef",
            f"minkowski {of_seven} --ball 1/2,4 --close -o c.nef",
        )
        for i in range(4):
            a = self.write(f"sum{i}a.txt", f"({expression(rng, 1)}) * box(-5,-5,-5, 5,5,5)")
            b = self.write(f"sum{i}b.txt", f"({leaf(rng, False)}) * box(-2,-2,-2, 2,2,2)")
            self.add(
                f"sum {i}",
                f"nef eval -f {a} -o a.nef",
                f"nef eval -f {b} -o b.nef",
                "minkowski a.nef b.nef -o s.nef",
            )

    def hulls(self) -> None:
        folder = self.data / "visual_hull"
        for way in ("direct", "cones"):
            for scene in ("letters/nef.vsh", "letters/mpi.vsh"):
                self.add(f"hull {scene} {way}", f"visual_hull {folder / scene} --way {way} -o h.nef")
            self.add(f"hull elk {way}", f"visual_hull {folder / 'elk/elk.json'} --simplify 4 --way {way} -o h.nef")
        self.add("hull eight", f"visual_hull {folder / 'eight/eight.json'} --simplify 1 -o h.nef")
        rng = self.rng
        for i in range(3):
            points = [f"{rng.uniform(-9, 9)!r},{rng.uniform(-9, 9)!r},{rng.randint(-9, 9)}" for _ in range(150)]
            hull = self.write(f"hull{i}.txt", f"hull({', '.join(points)})")
            self.add(
                f"hull of points {i}",
                f"nef eval -f {hull} -o h.nef",
                "nef convert h.nef -o h.off",
                "nef convert h.off -o r.nef",
            )

    def scenes(self) -> None:
        folder = self.data / "planner"
        for path in sorted([*folder.glob("*.json"), *folder.glob("omplapp/*.cfg")]):
            commands = [f"planner {path} -o p.txt"]
            if "rotation" not in path.read_text() and "rotating" not in path.name:
                commands += [f"planner --tight {path}", f"planner {path} --clearance --prefer roomy -o c.txt"]
            self.add(f"scene {path.name}", *commands)
        self.rigid_scenes()
        for path in sorted(folder.glob("assembly/*.json")):
            if path.stem != "burr":
                self.add(f"assembly {path.name}", f"planner --assembly {path}")
        rng = self.rng
        for i in range(3):
            obstacles = []
            for _ in range(4):
                at = f"{rng.randint(1, 7)},{rng.randint(-2, 3)},{rng.randint(-2, 3)}"
                wall = f"rotate(box(-1/2,-2,-1, 1/2,1,1), (1,2,2), {rng.randint(1, 89)})"
                obstacles.append(f"translate({wall}, {at})")
            scene = {
                "robot": "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)",
                "obstacles": obstacles,
                "start": [-2, 0, 0],
                "goal": [10, 0, 0],
                "box": [[-3, -4, -4], [11, 4, 4]],
                "contact": rng.choice(("allow", "forbid")),
            }
            path = self.write(f"scene{i}.json", json.dumps(scene))
            self.add(
                f"scene {i}",
                f"planner {path} -o p.txt",
                f"planner {path} --clearance -o c.txt",
                f"planner --tight {path}",
            )

    def rigid_scenes(self) -> None:
        """Robots that turn freely: a path through slices, one through a slot that fits, and a proof."""
        elbow = self.data / "planner" / "rigid" / "elbow.json"
        self.add("rigid elbow", f"planner {elbow} -o p.path --proof p.proof")
        turn = "24/25,-7/25,0,0, 7/25,24/25,0,0, 0,0,1,0"
        bar = "box(-2,-1/2,-3/2, 2,1/2,3/2)"
        slot = f"transform(box(0,-30,-30, 4,30,30) - box(-1,-1/2,-3/2, 5,1/2,3/2), {turn})"
        cube = "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)"
        hole = "box(0,-30,-30, 1/2,30,30) - box(-1,-9/20,-9/20, 1,9/20,9/20)"
        for name, robot, wall, goal in (("slot", bar, slot, [8, 2, 0]), ("cube", cube, hole, [8, 2, 1])):
            scene = {
                "robot": robot,
                "obstacles": [wall],
                "box": [[-9, -9, -9], [9, 9, 9]],
                "rotation": "SO(3)",
                "start": {"position": [-4, -1, 0], "quaternion": [1, 0, 0, 0]},
                "goal": {"position": goal, "quaternion": [1, 0, 0, 0]},
            }
            path = self.write(f"rigid_{name}.json", json.dumps(scene))
            self.add(f"rigid {name}", f"planner {path} -o p.path --proof p.proof")


def cases(data: pathlib.Path, folder: pathlib.Path, seed: int) -> list[Case]:
    """All cases; what they read is written to `folder`, which must not be there yet."""
    corpus = Corpus(data, folder, seed)
    corpus.scenes()
    corpus.sums()
    corpus.hulls()
    corpus.shipped_meshes()
    corpus.generated_meshes()
    corpus.dirty_meshes()
    corpus.solids()
    corpus.expressions()
    return corpus.cases
