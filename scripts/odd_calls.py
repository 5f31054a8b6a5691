#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Calls of the Python package that are nearly right: values of the type that a parameter's name suggests, at times of another
one, sets of all kinds, and what earlier calls returned. Each has to end in time, and where it is refused, with an exception
that the documentation knows and a line that says why; sets that come back have to be valid. Prints every one that does not;
exits 1 if there is one. What is tried depends on the seed alone, the time says how much of it.

Usage: scripts/odd_calls.py PACKAGE [--seed N] [--seconds S] [--calls N]

PACKAGE is the folder that has `nef`. Calls are made in processes of their own, which write down each call before they make it.
"""
import argparse
import ast
import decimal
import fractions
import functools
import inspect
import math
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import warnings

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from odd_commands import FOREIGN_WORDS  # noqa: E402

DATA = pathlib.Path(__file__).resolve().parent.parent / "data"
LIMIT = 120  # seconds for one call
BATCH = 200  # calls of a process
MEMORY = 12 << 30  # bytes of address space
MODULES = ("nef", "nef.minkowski", "nef.planner", "nef.remeshing", "nef.visual_hull")
MADE_BY_USERS = {"FourBar", "Hinge", "Linkage", "Polyhedron", "Rotation", "Scene", "Screw", "Slider", "TiledPolyhedron"}
SPECIAL = {"__and__", "__bool__", "__contains__", "__eq__", "__hash__", "__le__", "__or__", "__repr__", "__sub__", "__xor__"}


class Raised(Exception):
    """What a function that was given to the package raises."""


def raising(*_):
    raise Raised("of the caller")


def parameters_in_stub(path: pathlib.Path) -> dict[str, list[tuple[str, bool, bool]]]:
    """Of "function" and "Class.method": name, whether it is needed, and whether it is by name only, of each parameter."""
    def of(node: ast.FunctionDef, is_method: bool):
        first = node.args.posonlyargs + node.args.args
        needed = len(first) - len(node.args.defaults)
        found = [(p.arg, i < needed, False) for i, p in enumerate(first)][1 if is_method else 0:]
        return found + [(p.arg, d is None, True) for p, d in zip(node.args.kwonlyargs, node.args.kw_defaults)]

    result = {}
    for node in ast.parse(path.read_text()).body:
        if isinstance(node, ast.FunctionDef):
            result[node.name] = of(node, False)
        elif isinstance(node, ast.ClassDef):
            result.update({f"{node.name}.{m.name}": of(m, True) for m in node.body if isinstance(m, ast.FunctionDef)})
    return result


class Package:
    """The functions and methods of the package, with their parameters."""

    def __init__(self):
        import importlib
        modules = [importlib.import_module(name) for name in MODULES]
        folder = pathlib.Path(modules[0].__file__).parent
        self._stubs = {**parameters_in_stub(folder / "_nef.pyi"), **parameters_in_stub(folder / "_minkowski.pyi")}
        self.calls = []  # (name, class or None, function's name, its owner, parameters)
        for module in modules:
            for name, value in sorted(vars(module).items()):
                origin = str(getattr(value, "__module__", ""))
                if name.startswith("_") or not origin.startswith("nef") or origin == "nef.arguments":
                    continue
                if inspect.isclass(value):
                    self._add_class(module, value)
                elif callable(value):
                    self._add(f"{module.__name__}.{name}", None, name, module, value)

    def _add(self, title, of_class, name, owner, function):
        key = f"{of_class.__name__}.{name}" if of_class else name
        try:
            found = list(inspect.signature(function).parameters.values())[1 if of_class else 0:]
            parameters = [(p.name, p.default is p.empty, p.kind is p.KEYWORD_ONLY) for p in found
                          if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
        except ValueError:  # of an extension module
            parameters = self._stubs.get(key)
        if parameters is not None:
            self.calls.append((title, of_class, name, owner, parameters))

    def _add_class(self, module, value):
        if issubclass(value, (BaseException, Warning)) or any(call[1] is value for call in self.calls):
            return
        for name in sorted(dir(value)):
            if name.startswith("_") and name not in SPECIAL and not (name == "__init__" and value.__name__ in MADE_BY_USERS):
                continue
            member = inspect.getattr_static(value, name)
            is_own = any(name in vars(base) for base in value.__mro__ if base.__module__.startswith("nef"))
            if is_own and callable(member) and not isinstance(member, (staticmethod, classmethod)):
                self._add(f"{module.__name__}.{value.__name__}.{name}", value, name, value, member)


class Values:
    """Values for parameters, by their names."""

    def __init__(self, nef, numpy):
        self.numpy = numpy
        third = fractions.Fraction(1, 3)
        cube = nef.box((0, 0, 0), (2, 2, 2))
        other = nef.box((1, 1, 1), (3, 3, 3))
        labeled = nef.overlay(cube, other, lambda x, y: x + 2 * y)
        self.sets = [nef.empty(), nef.everything(), cube, cube.interior(), other, nef.halfspace(0, 0, 1, 0), nef.point((1, 1, 1)),
                     nef.segment((0, 0, 0), (1, 2, 3)), cube - other, cube.boundary(), cube | nef.box((2, 2, 2), (3, 3, 3)), ~cube,
                     cube - nef.box((third,) * 3, (1, 1, 1)), nef.box((0, 0, 0), (1, 1, 0)), labeled, cube.scale(third / 10**30),
                     cube.translate((10**30, 0, 0)), cube | nef.segment((2, 2, 2), (5, 5, 5))]
        self.vertices, self.faces = cube.to_mesh()
        self.made = [nef.TiledPolyhedron(cube - other, 32)]
        for scene in ("gap.json", "peg.json", "s7_one_box.json", "corner.json"):
            self.made.append(nef.planner.read(f"data/planner/{scene}"))
        self.numbers = [0, 1, -1, 2, 3, 5, 0.5, -0.25, third, "1/3", "0.1", decimal.Decimal("2.5"), numpy.float32(1.5), numpy.int64(-2), True, 64, 90]
        self.odd_numbers = [math.nan, math.inf, -math.inf, 1e300, 1e-300, 10**40, 2**31, 2**63, 2**64, -2**31, -2**63, "x", "", "1/0", "9" * 400,
                            1j, b"1", numpy.array(3), numpy.array([3]), decimal.Decimal("NaN"), decimal.Decimal("1e-99")]
        self.odd = [None, True, False, "", "x", "auto", 0, -1, 7, b"abc", [], {}, (), object(), raising, print, sys, numpy.array([]), 1e300]

    def number(self, rng):
        return rng.choice(self.numbers if rng.random() < 0.85 else self.odd_numbers)

    def triple(self, rng):
        kind = rng.random()
        if kind < 0.6:
            return tuple(rng.choice([0, 1, -1, 2, 3, 0.5, fractions.Fraction(1, 3)]) for _ in range(3))
        values = [self.number(rng) for _ in range(rng.choice([3, 3, 3, 2, 4]))]
        if kind < 0.8:
            return values
        return rng.choice([self.numpy.zeros(3), self.numpy.zeros((1, 3)), "x", "y", "xyz", None, iter(values), {1, 2, 3}, 5])

    def points(self, rng):
        numpy = self.numpy
        a = numpy.random.default_rng(rng.randrange(100)).integers(-3, 4, size=(rng.choice([0, 1, 2, 4, 8, 20]), 3)).astype(float)
        kind = rng.random()
        if kind < 0.5:
            return a
        if kind < 0.6:
            a.flat[:1] = rng.choice([math.nan, math.inf, 1e300, 1e-300])
            return a
        return rng.choice([a.astype(numpy.float32), a.astype(int), a.astype(object), a.astype(">f8"), a.T, a[:, :2], a[::-1, ::-1], numpy.asfortranarray(a),
                           a[None], [self.triple(rng) for _ in range(3)], (self.triple(rng) for _ in range(3)), self.vertices,
                           numpy.broadcast_to(numpy.zeros(3), (4, 3)), [[]], [[1, 2, 3], [1, 2]], None, "abc", 5, {}])

    def face_lists(self, rng):
        numpy, faces = self.numpy, self.numpy.array(self.faces)
        kind = rng.random()
        if kind < 0.5:
            return faces
        if kind < 0.6:
            faces.flat[rng.randrange(faces.size)] = rng.choice([-1, 8, 100, 2**31 - 1, 0])
            return faces
        return rng.choice([faces[:-1], faces[:, ::-1], numpy.concatenate([faces, faces]), faces.astype(numpy.uint8), faces.astype(float), faces.T,
                           faces.ravel(), [*faces.tolist(), [0, 0, 0]], [*faces.tolist(), [2**40, 1, 2]], [*faces.tolist(), ["a", 1, 2]], [[]], [], None, 5])

    def masks(self, rng):
        numpy = self.numpy
        y, x = numpy.mgrid[0:24, 0:24]
        disc = ((x - 11.5) ** 2 + (y - 11.5) ** 2 < 49).astype(numpy.uint8) * 255
        good = [disc] * rng.choice([1, 2, 3, 3, 3])
        return good if rng.random() < 0.7 else rng.choice([good[:-1], [disc[:, ::2]], [disc * 0], [disc.astype(bool)], [disc * math.nan], [disc[0]], disc, None, 5])

    def cameras(self, rng):
        numpy = self.numpy
        turns = [numpy.eye(3), [[0, 1, 0], [0, 0, -1], [-1, 0, 0]], [[-1, 0, 0], [0, 0, -1], [0, -1, 0]]]
        k = numpy.array([[24.0, 0, 11.5], [0, 24, 11.5], [0, 0, 1]])
        good = [k @ numpy.hstack([turn, [[0], [0], [10.0]]]) for turn in turns[:rng.choice([1, 2, 3, 3, 3])]]
        if rng.random() < 0.2:
            good[0].flat[rng.randrange(12)] = rng.choice([math.nan, math.inf, 1e300, 0, 1e-300])
        return good if rng.random() < 0.9 else rng.choice([[c[:, :3] for c in good], [good[0] * 0] * 3, good[0], None])

    def path(self, rng):
        ending = rng.choice([".off", ".obj", ".stl", ".ply", ".nef3", ".nef", ".glb", ".html", ".png", ".svg", ".json", ".proof", ".tiles", ".3mf", ".pdf", ""])
        return rng.choice(["out" + ending, "data/meshes/hand.off", "data/meshes/README.md", "data/planner/gap.json", "data/planner/assembly",
                           "/nonexistent/x.off", ".", "", "a\0b", pathlib.Path("out.off"), 5, None, b"out.off", "/dev/null"])

    def text(self, rng):
        state = self.sets[2].to_bytes()
        return rng.choice(["box(0,0,0,1,1,1)", "box(", "", "a|b", "\0", "{}", '{"nef_proof":1}', b"", state, state[:50], b"\0" * 99, "(" * 2000])

    @functools.cached_property
    def _kinds(self):
        """Makers of values by the words of a parameter's name."""
        def one_of(*values):
            return lambda rng: rng.choice(values)

        a_set = lambda rng: rng.choice(self.sets)  # noqa: E731
        some = lambda rng: [a_set(rng) for _ in range(rng.randrange(4))]  # noqa: E731
        counts = one_of(0, 1, 2, 3, 5, 8, 40, 100, -1, 2**31, 2**63, 1.5, None, "3")
        lengths = one_of(0, 0.5, 1, 2, -1, 1e-9, 1e300, math.nan, math.inf, "1/2", fractions.Fraction(1, 3), None)
        turns = one_of("SO(3)", {"axis": (0, 0, 1)}, (1, 0, 0, 0), (1, 1, 0, 0), (0, 0, 0, 0), None, "z", [1, 2, 3])
        seconds = one_of(1, 0.5, 0, -1, math.nan, math.inf, "1", 1e-9, None)
        kinds = {
            "a b other set part robot tool body of": a_set, "sets parts obstacles": lambda rng: rng.choice([some(rng), tuple(some(rng)), iter(some(rng)), {"p": a_set(rng)}]),
            "point low high by axis origin direction normal start goal end pivot shift": self.triple, "points vertices": self.points, "faces": self.face_lists,
            "masks": self.masks, "cameras": self.cameras, "path file folder photographs images scenes urdf": self.path, "text proof bytes state expression": self.text,
            "matrix": lambda rng: rng.choice([self.numpy.eye(3), self.numpy.eye(4), [[1, 0, 0], [0, 2, 0], [0, 0, 1]], self.numpy.zeros((3, 3)), self.numpy.eye(4) * math.nan, "x", None]),
            "seconds": seconds, "threads": one_of(0, 1, 2, 3, -1, 10**6, 2**40, "2", 1.5, None), "rotation quaternion turn": turns,
            "limit runs samples detail corners times triangles count digits width height max_cells at_least turntable rings": counts,
            "tolerance min_area radius keep_clear clearance precision degrees close square pitch offset above growth size": lengths,
            "box": one_of(((0, 0, 0), (1, 1, 1)), ((-9,) * 3, (9,) * 3), ((1, 1, 1), (0, 0, 0)), None, 5, ((0, 0, 0),)),
            "progress report": one_of(None, print, raising, {}, 5), "function": one_of(max, lambda x, y: x + 2 * y, raising, lambda x, y: -1, lambda x, y: "x", None),
        }
        return {word: make for words, make in kinds.items() for word in words.split()}

    def of(self, rng, name):
        if rng.random() < 0.08:
            return rng.choice(self.odd + self.odd_numbers)
        if rng.random() < 0.06:
            return rng.choice(self.made)
        make = self._kinds.get(name) or rng.choice([self.number, self.triple, lambda r: r.choice(self.sets), lambda r: r.choice(self.odd)])
        return make(rng)


def shown(value) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) < 160 else text[:160] + "..."


def complaint(nef, error: Exception) -> str | None:
    """What is wrong with an exception; nothing if it is as it should be."""
    text = str(error)
    if isinstance(error, Raised):
        return None
    if not isinstance(error, (nef.Error, TypeError, ValueError, OSError, ImportError, MemoryError)):
        return f"{type(error).__name__}: {text[:300]}"
    if FOREIGN_WORDS.search(text):
        return f"refused in words of a library: {text[:300]}"
    if not text.strip() or isinstance(error, nef.Error) and len(text.splitlines()) > 2:
        return f"refused in {len(text.splitlines())} lines: {text[:300]!r}"
    return None


def call(nef, package: Package, values: Values, rng: random.Random, tell) -> str | None:
    """Makes one call, which it tells before; what is wrong with how that ended, if anything is."""
    everything = values.sets + values.made
    target = None
    while True:
        title, of_class, name, owner, parameters = rng.choice(package.calls)
        if of_class is None or name == "__init__":
            break
        known = [value for value in everything if type(value) is of_class]
        if known:
            target = rng.choice(known)
            break
    arguments, keywords = [], {}
    for parameter, needed, by_name in parameters:
        if parameter == "check":  # a promise about a mesh, after which it is not looked at
            continue
        if not needed and rng.random() < (0.8 if by_name else 0.6):
            continue
        if by_name or len(arguments) < [p[0] for p in parameters].index(parameter):
            keywords[parameter] = values.of(rng, parameter)
        else:
            arguments.append(values.of(rng, parameter))
    if rng.random() < 0.03:
        arguments.append(rng.choice(values.odd))
    if rng.random() < 0.03 and arguments:
        arguments.pop()
    function = getattr(owner, name) if of_class is None else of_class
    if target is not None:
        title = f"({shown(target)}).{name}"
        function = getattr(target, name)
    tell(f"{title}({', '.join([shown(a) for a in arguments] + [f'{k}={shown(v)}' for k, v in keywords.items()])})")
    try:
        result = function(*arguments, **keywords)
        repr(result)
        if isinstance(result, nef.Polyhedron) and result.validate():
            return f"an invalid set: {result.validate()}"
    except Exception as error:  # pylint: disable=broad-except
        return complaint(nef, error)
    if not isinstance(result, (type(None), bool, int, float, str, bytes)):
        values.made.append(result)
    return None


def make_calls(seed: int, first: int, last: int, log: str) -> None:
    """A process's share, in the folder where it is."""
    warnings.simplefilter("ignore")
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    import numpy

    import nef
    import nef.planner
    package, values = Package(), Values(nef, numpy)
    with open(log, "a", encoding="utf-8", buffering=1) as file:
        for i in range(first, last):
            tell = lambda text, i=i: file.write(f"{i}: {text}\n")  # noqa: E731
            wrong = call(nef, package, values, random.Random(seed * 1_000_003 + i), tell)
            if wrong:
                file.write(f"{i}! {' '.join(wrong.split())}\n")
        file.write("done\n")


def run_batch(options, first: int, last: int, work: pathlib.Path) -> tuple[int, list[str]]:
    """Where the next batch begins, and what was told."""
    log = work / f"{first}.log"
    log.touch()
    shutil.rmtree(work / "data", ignore_errors=True)  # calls may have written over it
    shutil.copytree(DATA, work / "data")
    words = [sys.executable, "-B", __file__, str(options.package.resolve()), "--seed", str(options.seed), "--part", str(first), str(last), str(log)]
    # What the package's functions print is of no use.
    with open(work / "stderr", "w+", encoding="utf-8", errors="replace") as told:
        child = subprocess.Popen(words, cwd=work, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=told,
                                 env={**os.environ, "PYTHONPATH": str(options.package.resolve())})
        size, since = 0, time.monotonic()
        while child.poll() is None:
            time.sleep(0.05)
            if log.stat().st_size != size:
                size, since = log.stat().st_size, time.monotonic()
            elif time.monotonic() - since > LIMIT:
                child.kill()
        told.seek(0)
        error = told.read()
    lines = log.read_text(encoding="utf-8").splitlines()
    if lines and lines[-1] == "done":
        return last, lines[:-1]
    if not lines:
        raise SystemExit(f"no call was made: {error}")
    number = int(lines[-1].partition(":")[0].rstrip("!"))
    late = time.monotonic() - since > LIMIT
    return number + 1, [*lines, f"{number}! " + (f"not done in {LIMIT} s" if late else f"exit code {child.returncode}: {error[-400:]}")]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("package", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--calls", type=int, default=1_000_000, help="so many at most")
    parser.add_argument("--part", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.part:
        make_calls(options.seed, int(options.part[0]), int(options.part[1]), options.part[2])
        return 0
    end = time.monotonic() + options.seconds
    work = pathlib.Path(tempfile.mkdtemp(prefix="nef-calls-"))
    made = wrong = first = 0
    try:
        while first < options.calls and time.monotonic() < end:
            first, lines = run_batch(options, first, min(first + BATCH, options.calls), work)
            calls = {line.partition(":")[0]: line for line in lines if re.match(r"\d+: ", line)}
            made += len(calls)
            for line in lines:
                number, mark, text = line.partition("! ")
                if mark and number.isdigit():
                    wrong += 1
                    print(f"{calls.get(number, number)}\n    {text}", flush=True)
    finally:
        shutil.rmtree(work, ignore_errors=True)
    print(f"{made} calls that are nearly right, seed {options.seed}: {wrong} ended badly")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
