# SPDX-License-Identifier: Apache-2.0
"""Parts at their places, joints that move one of them, and robots of several links. nef.planner has all of it."""
import os
import warnings
from fractions import Fraction
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

from . import _planner
from ._nef import Polyhedron
from .arguments import shown, wrong_type
from .assemblies import Parts, parts_of
from .errors import InputError, InputWarning

Exact3 = Tuple[Fraction, Fraction, Fraction]
Integer3 = Tuple[int, int, int]


class Overlap(NamedTuple):
    """Where two parts overlap."""

    #: the intersection of their interiors
    region: Polyhedron
    #: two corners around it
    box: Tuple[Exact3, Exact3]
    #: off by volume_error at most
    volume: float
    volume_error: float
    #: a Fraction, if it was asked for or is short
    exact_volume: Optional[Fraction]


class PairVerdict(NamedTuple):
    """Whether two parts are disjoint, touch or overlap."""

    #: their names
    parts: Tuple[str, str]
    #: 'disjoint', 'touching' or 'overlapping'
    contact: str
    #: the square of their distance, exactly; and the distance
    squared: Fraction
    distance: float
    #: nearest points of the two; one common point if they touch
    points: Tuple[Exact3, Exact3]
    #: of parts that touch: the item of each that has the point, "vertex 3"
    items: Optional[Tuple[str, str]]
    overlap: Optional[Overlap]


class PartVerdict(NamedTuple):
    """Whether a part can be taken away by translations while all others rest."""

    name: str
    #: 'removable', 'stuck' (it cannot begin to move), 'overlapping' or 'undecided' (it can begin to move, but leaves in no
    #: straight line that was tried)
    status: str
    #: along which it leaves
    direction: Optional[Exact3]
    #: of the cone of directions in which it can begin to move: 3, 2, 1, or 0 if it cannot
    dimension: int
    #: along the edges of that cone
    rays: List[Integer3]
    #: what bounds the cone: (name, normals) for a part that forbids the directions d with normal * d < 0 for all normals
    stops: List[Tuple[str, List[Integer3]]]


class RangeEnd(NamedTuple):
    """An end of a part of a range of motion."""

    #: degrees, or multiples of the slider's direction
    measure: float
    #: two bounds of the joint's own number, 2^-60 apart or less; equal if it is rational
    bounds: Tuple[Fraction, Fraction]
    #: what touches there
    stops: List["Stop"]


class Stop(NamedTuple):
    """Two items that touch."""

    #: of the moving part: "vertex 3"
    moving: str
    #: the name of the other part, and its item
    part: str
    item: str


class RangePart(NamedTuple):
    """A maximal interval of values of a joint with one status, or one value."""

    #: 'free', 'touching', 'colliding', or 'undecided': parts of the range of a FourBar, single values of a Screw
    status: str
    start: RangeEnd
    end: RangeEnd


class Hinge(NamedTuple):
    """A joint that turns about a line; its values are degrees."""

    axis: Any = (0, 0, 1)
    point: Any = (0, 0, 0)


class Slider(NamedTuple):
    """A joint that moves along a direction; its values are multiples of it."""

    direction: Any


class Screw(NamedTuple):
    """A joint that turns and moves along its axis, by `pitch` for each full turn; its values are degrees."""

    axis: Any = (0, 0, 1)
    point: Any = (0, 0, 0)
    pitch: Any = 1


class FourBar(NamedTuple):
    """A planar four-bar linkage that moves its coupler or its rocker; its values are degrees of the crank.

    Pivots and pins are points on lines along the axis, as they are when the crank is at 0 degrees.
    """

    axis: Any = (0, 0, 1)
    #: about which the crank turns
    crank_pivot: Any = (0, 0, 0)
    rocker_pivot: Any = (1, 0, 0)
    #: where the coupler is joined to the crank, and to the rocker
    crank_pin: Any = (0, 1, 0)
    rocker_pin: Any = (1, 1, 0)
    #: the bar that the part belongs to: 'coupler' or 'rocker'
    moves: str = "coupler"


class Verdict(NamedTuple):
    """A verdict on parts at their places."""

    #: all pairs, a list of PairVerdict
    pairs: List[PairVerdict]
    #: all parts, a list of PartVerdict
    parts: List[PartVerdict]

    @property
    def interferes(self) -> bool:
        """Whether some parts overlap."""
        return any(pair.overlap for pair in self.pairs)

    @property
    def smallest_gap(self) -> Optional[PairVerdict]:
        """The pair with the smallest distance, of those that are apart."""
        apart = [pair for pair in self.pairs if pair.contact == "disjoint"]
        return min(apart, key=lambda pair: pair.squared, default=None)


def verdict(parts: Parts, exact: bool = False) -> Verdict:
    """Checks parts at their places: overlaps, gaps, contacts, and which parts can be removed. All exact but for volumes.

    - parts: {name: Polyhedron} of bounded solids, or an assembly's file as `planner --assembly` takes it
    - exact: volumes as fractions, too

        >>> import nef
        >>> from nef import planner
        >>> block = nef.box((0, 0, 0), (3, 3, 3)) - nef.box((1, 1, 1), (2, 2, 4)).interior()
        >>> judged = planner.verdict({"block": block, "peg": nef.box((1, 1, 1), (2, 2, 4))})
        >>> judged.parts[1].status, [int(x) for x in judged.parts[1].direction]
        ('removable', [0, 0, 1])
    """
    names, sets = parts_of(parts)
    pairs, judged = _planner.verdict(names, sets, exact)
    return Verdict(
        [PairVerdict((names[a], names[b]), contact, squared, distance, (on_a, on_b), items, overlap and Overlap(*overlap))
         for a, b, contact, squared, distance, on_a, on_b, items, overlap in pairs],
        [PartVerdict(name, status, direction, dimension, rays, [(names[part], normals) for part, normals in stops])
         for name, (status, direction, dimension, rays, stops) in zip(names, judged)])


def _joint_values(joint):
    if not isinstance(joint, (Hinge, Slider, Screw, FourBar)):
        raise TypeError(f"joint must be a Hinge, Slider, Screw or FourBar, not {shown(joint)}")
    if not isinstance(joint, FourBar):
        return (type(joint).__name__.lower(), *joint)
    if joint.moves not in ("coupler", "rocker"):
        raise InputError("moves must be 'coupler' or 'rocker'")
    return ("four-bar", *joint[:-1], joint.moves == "rocker")


def range_of_motion(moving: Any, fixed: Optional[Union[Dict[str, Polyhedron], Sequence[Polyhedron]]] = None,
                    joint: Optional[Union[Hinge, Slider, Screw, FourBar]] = None, low: Any = 0, high: Any = 360) -> List[RangePart]:
    """The exact values of a joint at which a part is free, touches or collides: a list of RangePart, in order.

    - moving: the part that moves, in its place at the value 0; or a mechanism's file as `planner --range` takes it, alone
    - fixed: the parts that stay, {name: Polyhedron} or a list
    - joint: a Hinge, Slider, Screw or FourBar
    - low, high: degrees, or multiples of a slider's direction

        >>> import nef
        >>> from nef import planner
        >>> door = nef.box((0, 0, 0), (3, "1/5", 2))
        >>> parts = planner.range_of_motion(door, [nef.box((2, 1, 0), (3, 2, 1))], planner.Hinge(), 0, 90)
        >>> [part.status for part in parts]
        ['free', 'touching', 'colliding', 'touching', 'free']
        >>> round(parts[1].start.measure, 6)
        15.612286
    """
    if not isinstance(moving, Polyhedron):
        if fixed is not None or joint is not None:
            raise InputError("fixed and joint must be left out for the file of a mechanism, which contains them")
        parts, names, messages = _planner.range_of_file(os.fspath(moving))
        for message in messages:
            warnings.warn(message, InputWarning, stacklevel=2)
    else:
        if fixed is None or joint is None:
            raise InputError("a range of motion needs `fixed` and `joint`")
        if isinstance(fixed, Polyhedron):
            raise TypeError("fixed must be a list or a dictionary of Polyhedron: write [fixed] for one part")
        names = list(fixed) if isinstance(fixed, dict) else [f"part {i}" for i in range(len(fixed))]
        sets = list(fixed.values()) if isinstance(fixed, dict) else list(fixed)
        parts = _planner.range_of_motion(moving, sets, _joint_values(joint), low, high)

    def end(measure, lower, upper, stops):
        return RangeEnd(measure, (lower, upper), [Stop(item, names[part], other) for item, part, other in stops])
    return [RangePart(status, end(*start), end(*stop)) for status, start, stop in parts]


class CheckedMotion(NamedTuple):
    """The verdict on a motion of a linkage. True if it is free."""

    #: 'path' (with a gap everywhere), 'blocked' or 'undecided' (contact, or a gap too small for doubles)
    status: str
    #: blocked: where two bodies overlap, 0 at the beginning and 1 at the end
    parameter: float
    #: blocked: the names of the two; an obstacle has the name None
    links: Optional[Tuple[str, Optional[str]]]
    #: undecided: parts of the motion, from parameter to parameter
    undecided: List[Tuple[float, float]]

    def __bool__(self):
        return self.status == "path"


class CertifiedLinkagePath(NamedTuple):
    """What is proved about a path of a linkage. True if every motion is free."""

    #: 'path', 'blocked' or 'undecided'
    status: str
    #: the verdicts on its motions, a list of CheckedMotion; empty if the time was over
    motions: List[CheckedMotion]
    #: the number of the first motion that collides, or None
    blocked: Optional[int]

    def __bool__(self):
        return self.status == "path"


def reads_urdf() -> bool:
    """Whether Linkage.read() works: the package was built with urdfdom (Debian: liburdfdom-dev)."""
    return _planner.reads_urdf()


class Joint(NamedTuple):
    """A joint of a file that has a value."""

    name: str
    #: limits of its value; -pi and pi for a continuous joint
    lower: float
    upper: float
    #: whether it turns without end, so that the limits do not bound it
    continuous: bool = False


def _floats(name, values, count):
    """The values as `count` floats."""
    try:
        numbers = tuple(float(value) for value in values)
    except (TypeError, OverflowError):
        raise TypeError(f"{name} must be {count} numbers, not {shown(values)}") from None
    if len(numbers) != count:
        raise InputError(f"{name} must be {count} numbers, not {len(numbers)}")
    return numbers


def _require_body(name, body):
    if not isinstance(body, (type(None), Polyhedron)):
        raise TypeError(wrong_type(name, "Optional[nef.Polyhedron]", body))


class Linkage:
    """A robot of several links, joined by hinges and sliders. Whole motions of its joints are proved free, or collide.

        >>> import math, nef
        >>> from nef import planner
        >>> robot = planner.Linkage()
        >>> robot.add("arm", nef.box((0, "-1/4", "-1/4"), (2, "1/4", "1/4")), kind="revolute")
        >>> robot.add("hand", nef.box((0, "-1/4", "-1/4"), (1, "1/4", "1/4")), "arm", "revolute", shift=(2.5, 0, 0))
        >>> wall = nef.box((1, 2, -1), (4, 3, 1))
        >>> robot.check([0, 0], [0.3, 0.3], [wall]).status, robot.check([0, 0], [1.2, 0], [wall]).links
        ('path', ('hand', None))
    """

    def __init__(self, base: Optional[Polyhedron] = None):
        """`base` is the body of the link "base", which does not move; None if it has no shape."""
        _require_body("base", base)
        self._links = [("base", base, "fixed", 0, (0, 0, 0), (1, 0, 0, 0), (0, 0, 1))]
        self._allowed = []
        self._checker = None  # the last one, and its obstacles
        self._limits = None

    @classmethod
    def read(cls, urdf: Any, srdf: Any = None, *, crossings: str = "union", close: float = 0) -> "Linkage":
        """The robot of a URDF file: joints that are fixed, revolute, continuous or prismatic, boxes and meshes as collision
        geometry. Changes to its meshes are reported as warnings.

        - srdf: an SRDF file, whose disabled collisions are left out
        - crossings, close: how meshes are read, as in nef.from_mesh
        """
        links, allowed, messages = _planner.read_urdf(os.fspath(urdf), "" if srdf is None else os.fspath(srdf), crossings,
                                                      close)
        robot = cls()
        robot._links = [link[:7] for link in links]
        robot._allowed = [list(pair) for pair in allowed]
        robot._limits = [Joint(*link[7:]) for link in links[1:] if link[2] != "fixed"]
        for message in messages:
            warnings.warn(message, InputWarning, stacklevel=2)
        return robot

    @property
    def joints(self) -> Optional[List[Joint]]:
        """Of a robot from a file: the joints with a value, in the order of values; else None."""
        return self._limits

    @property
    def links(self) -> List[str]:
        """The names of all links, the base first."""
        return [link[0] for link in self._links]

    def add(self, name: str, body: Optional[Polyhedron] = None, parent: str = "base", kind: str = "fixed",
            shift: Any = (0, 0, 0), turn: Any = (1, 0, 0, 0), axis: Any = (0, 0, 1)) -> None:
        """Adds a link. A point v of it is at R(turn) J v + shift in the coordinates of its parent.

        - kind: what J does: 'revolute' turns about the axis by the joint's value, in radians; 'prismatic' shifts along it,
          by the value; 'fixed' does nothing and has no value
        - turn: a quaternion w, x, y, z of any length; `axis` is of any length, too. These numbers are floats
        """
        if kind not in ("fixed", "revolute", "prismatic"):
            raise InputError(f"kind must be 'fixed', 'revolute' or 'prismatic', not {shown(kind)}")
        if name in (link[0] for link in self._links):
            raise InputError(f"there is a link {name!r}")
        if not isinstance(name, str):
            raise TypeError(wrong_type("name", "str", name))
        _require_body("body", body)
        self._links.append((name, body, kind, self._number(parent), _floats("shift", shift, 3), _floats("turn", turn, 4),
                            _floats("axis", axis, 3)))
        self._checker = None

    def allow(self, first: str, second: str) -> None:
        """Leaves out the comparison of two links. Links that share a joint are never compared."""
        self._allowed.append([self._number(first), self._number(second)])
        self._checker = None

    def _number(self, name):
        numbers = {link[0]: i for i, link in enumerate(self._links)}
        if name not in numbers:
            raise InputError(f"there is no link {name!r}")
        return numbers[name]

    def check(self, start: Sequence[float], end: Optional[Sequence[float]] = None,
              obstacles: Sequence[Polyhedron] = ()) -> CheckedMotion:
        """Whether the robot collides, with obstacles or itself, while all joints go evenly from values to values.

        - start, end: a value for each joint that has one, in the order of the links (radians, or lengths); the robot stays
          if `end` is None
        """
        return self._told(self._checker_of(obstacles).check(list(start), list(start if end is None else end)))

    def certify(self, path: Any, obstacles: Sequence[Polyhedron] = (),
                seconds: Optional[float] = None,
                progress: Optional[Callable[[str, int, int], object]] = None) -> CertifiedLinkagePath:
        """Whether the robot collides, with obstacles or itself, on a path: proves every motion free, or finds where it collides.

        - path: a list of values as check() takes them, or a file as `planner --linkage ROBOT --path` takes it. Values must be
          within the limits of a file's joints, unless these are continuous
        - seconds: time limit, after which the path is undecided
        - progress: a function of (phase, done, total): motions
        """
        if isinstance(path, (str, os.PathLike)):
            names = [link[0] for link in self._links if link[2] != "fixed"]
            if self._limits is not None:
                names = [joint.name for joint in self._limits]
            path = _planner.read_joint_path(os.fspath(path), names)
        path = [list(values) for values in path]
        for i, values in enumerate(path):
            for joint, value in zip(self._limits or [], values):
                if not joint.continuous and not joint.lower <= value <= joint.upper:
                    raise InputError(f"way-point {i}: the value {value:g} of joint {joint.name!r} is not within its limits, "
                                     f"{joint.lower:g} to {joint.upper:g}")
        status, motions, blocked = self._checker_of(obstacles).certify(path, seconds, progress)
        return CertifiedLinkagePath(status, [self._told(motion) for motion in motions], blocked)

    def _checker_of(self, obstacles):
        if isinstance(obstacles, Polyhedron):
            raise TypeError("obstacles must be a list of Polyhedron: write [obstacle] for one")
        obstacles = list(obstacles)
        known = self._checker
        if known is None or len(known[1]) != len(obstacles) or any(a is not b for a, b in zip(known[1], obstacles)):
            self._checker = known = _planner.LinkageChecker(self._links, self._allowed, obstacles), obstacles
        return known[0]

    def _told(self, verdict):
        status, parameter, link, other, undecided = verdict
        names = [entry[0] for entry in self._links]
        links = (names[link], None if other is None else names[other]) if status == "blocked" else None
        return CheckedMotion(status, parameter, links, [tuple(part) for part in undecided])
