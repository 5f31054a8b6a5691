# SPDX-License-Identifier: Apache-2.0
"""Exact planning for a robot that translates among obstacles and may turn about an axis: a path, or a proof that there
is none.

    >>> import nef
    >>> from nef import planner
    >>> wall = nef.box((4, 0, 0), (5, 9, 9)) - nef.box((3, 3, 3), (6, 4, 4)).interior()
    >>> robot = nef.box((0, 0, 0), (1, 1, 1))                  # as wide as the hole
    >>> scene = planner.Scene(robot, [wall], box=((0, 0, 0), (8, 8, 8)))
    >>> plan = scene.plan((1, 1, 1), (7, 7, 7))
    >>> plan.status, plan.thinness.piece                      # through a passage exactly as wide as the robot
    ('path', 1)
"""
import os
import time
import warnings
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Callable, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy

from . import _nearest, _of_application, _planner
from ._nef import Polyhedron
from .arguments import require_int, shown
from .assemblies import (Disassembly, DisassemblyStep, FreeDirections, Inseparable, Turning, Undecided, disassemble, free_directions,
                         prove_inseparable, complaint_about_inseparable)
from .errors import Error, InputError, InputWarning
from .mechanisms import (CertifiedLinkagePath, CheckedMotion, FourBar, Hinge, Joint, Linkage, Overlap, PairVerdict, PartVerdict, RangeEnd, RangePart, Screw, Slider,
                         Stop, Verdict, range_of_motion, reads_urdf, verdict)

Exact3 = Tuple[Fraction, Fraction, Fraction]

__all__ = ["Cell", "CertifiedLinkagePath", "CertifiedPath", "CheckedMotion", "CollidingPose", "Component", "Disassembly", "DisassemblyStep",
           "FourBar", "FreeDirections", "Hinge", "Inseparable", "Joint", "Linkage", "Overlap", "PairVerdict",
           "PartVerdict", "Plan", "Proof", "RangeEnd", "RangePart", "Rotation", "Scene", "Screw", "Slider", "Stop", "Thinness",
           "TightPassage", "Turning", "TurningProof", "Undecided", "Verdict", "Widest", "complaint_about_inseparable", "disassemble",
           "free_directions", "prove_inseparable", "range_of_motion", "read", "reads_urdf", "verdict"]

__getattr__ = _of_application(__name__, __all__, {"plan": "Scene(robot, obstacles).plan(start, goal)", "certify": "Scene(robot, obstacles).certify(path)", "prove": "Scene(robot, obstacles).prove()"})


class Cell(NamedTuple):
    """A cell of the free space."""

    #: such as "edge 3"
    name: str
    dimension: int
    #: three Fractions each; in boundary order for a facet, none for a volume
    vertices: List[Exact3]


class TightPassage(NamedTuple):
    """A part of free space without interior: everywhere in it the robot touches obstacles on opposite sides."""

    #: of its largest cell: 2, 1 or 0
    dimension: int
    #: the component of free space that it belongs to
    component: int
    cells: List[Cell]
    #: the cells of the rest of free space from which it is entered
    mouths: List[Cell]


class Component(NamedTuple):
    """A connected component of free space."""

    #: of its largest cell
    dimension: int
    bounded: bool
    #: how many cells it has
    cells: int


class Thinness(NamedTuple):
    """How thin free space is on the best path between two points."""

    #: the largest k so that a path stays where free space is locally at least k-dimensional
    piece: int
    #: the largest j so that a path crosses only cells of dimension j or more, except at its ends
    junction: int


class Widest(NamedTuple):
    """How large a robot may be and still pass: between `low`, at which there is a path, and `high`, at which none exists."""

    #: None: no path at the smallest size that was tried
    low: Optional[Fraction]
    #: None: a path at the largest size that was tried
    high: Optional[Fraction]
    #: whether a size between them could not be decided, so that the interval is wider than the precision
    undecided: bool
    #: the robot of the size `low`
    robot: Polyhedron


class Proof(NamedTuple):
    """Why there is no path: start and goal lie in different components of the exact free space."""

    #: numbers in Scene.components()
    start_component: int
    goal_component: int


class CollidingPose(NamedTuple):
    """A pose of a path at which the robot collides."""

    #: the motion, from way-point `motion` to the next one
    motion: int
    #: where on it: 0 at its beginning, 1 at its end
    parameter: float
    position: Exact3
    #: w, x, y, z, of any length
    quaternion: Tuple[Fraction, Fraction, Fraction, Fraction]


class CertifiedPath:
    """What is proved about a path of a rigid body. True if every motion is free.

    - status: 'path' (no pose collides, between the way-points or at them), 'blocked' (one collides: `collision`) or
      'undecided'
    - collision: a CollidingPose of the first motion that collides, or None
    - undecided: numbers of the motions that could not be decided; contact during a turn is the usual cause
    - touching: numbers of the free motions on which robot and obstacles touch, or come closer than doubles can resolve
    """

    def __init__(self, status, collision, undecided, touching):
        self.status = status
        self.collision = None if collision is None else CollidingPose(*collision[:2], *collision[2])
        self.undecided = undecided
        self.touching = touching

    def __bool__(self):
        return self.status == "path"

    def __repr__(self):
        at = f", motion {self.collision.motion}" if self.collision else ""
        return f"<nef.planner.CertifiedPath: {self.status}{at}>"


class Rotation(NamedTuple):
    """How a robot may turn about its reference point."""

    #: "x", "y", "z" or a direction of three numbers
    axis: Any = "z"
    #: the range of angles, in degrees; one of 360 degrees is the full circle, closed
    low: Any = 0
    high: Any = 360


class TurningProof:
    """Why there is no path of a robot that turns, at any angles of its range."""

    def __init__(self, proof):
        self._proof = proof

    @property
    def cells(self) -> int:
        """How many cells the range of angles is cut into."""
        return self._proof.cells

    def complaint(self) -> Optional[str]:
        """The first error in the proof, found independently of the search; None if it is valid."""
        return self._proof.complaint()

    def text(self) -> Optional[str]:
        """The same as the text of a .proof file (`planner --proof`), which `python/proofs/check.py` checks; None where start
        and goal are separated by no distance, or only by surfaces, or where it takes more than 100,000 parts."""
        return self._proof.text()


class Plan:
    """The answer to a query. True if it is a path.

    - status: 'path', 'infeasible', 'invalid_start', 'invalid_goal', 'blocked' (a given path leaves free space) or
      'undecided' (more time, or of a robot that turns more cells of angles, may decide)
    - motions: which motions the answer covers: 'translation' (at the orientation of the robot), 'translation and turning'
      (about one axis) or 'rigid' (all)
    - waypoints: the path, a list of three Fractions each; None if there is none
    - turns: of a robot that turns, for each way-point the quaternion w, x, y, z of its rotation, of any length; else None
    - degrees: the same as floats, if it turns about an axis; else None
    - samples, slices, boxes: of a robot that turns freely: how many random poses, exact free spaces and, for a proof that
      there is no path, boxes of poses the search took; else None
    - boxes_in_question, reference_in_question: of a robot that turns freely, if that is undecided: boxes, each as its low
      and high corner, in which a proof that there is no path may have a hole, and the point of the robot whose positions
      they are about; else an empty list and None
    - open_ranges: undecided: the ranges of degrees in question
    - unrounded: numbers of way-points between the ends with more decimals than `digits`
    - length: of the path, a float; None for a robot that turns
    - segment_dimensions: for each segment, the smallest dimension of the cells that it runs along
    - passages: numbers in Scene.passages(), in the order in which the path uses them
    - thinness: of the best path, a Thinness
    - proof: a Proof (or a TurningProof) if the problem is infeasible
    - collision: what an invalid start or goal, or a blocked path, hits, as text
    - blocked_segment: of a given path, the first segment that leaves free space
    """

    def __init__(self, answer, motions="translation"):
        self.status = answer["status"]
        self.motions = motions
        self.waypoints = answer.get("points")
        self.turns = answer.get("turns")
        self.degrees = answer.get("degrees")
        self.samples = answer.get("samples")
        self.slices = answer.get("slices")
        self.boxes = answer.get("boxes")
        self.boxes_in_question = [tuple(map(tuple, box)) for box in answer.get("boxes_in_question", [])]
        self.reference_in_question = answer.get("reference_in_question") if self.boxes_in_question else None
        self.open_ranges = answer.get("open_ranges", [])
        self.unrounded = answer.get("unrounded", [])
        self.length = answer.get("length")
        self.segment_dimensions = answer.get("segment_dimensions")
        self.passages = answer.get("passages")
        self.thinness = Thinness(*answer["thinness"]) if "thinness" in answer else None
        self.proof: Union[Proof, TurningProof, None] = Proof(*answer["components"]) if "components" in answer else None
        if "proof" in answer:
            self.proof = TurningProof(answer["proof"])
        self.collision = answer.get("collision")
        self.blocked_segment = answer.get("blocked_segment")

    def __bool__(self):
        return self.status == "path"

    if not TYPE_CHECKING:  # type checkers shall find unknown names themselves
        def __getattr__(self, name):
            hint = "; use waypoints" if name in ("path", "points", "way_points", "poses") else _nearest(name, vars(self))
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}{hint}")

    def __array__(self, dtype=None):
        """The way-points as an array of shape (N, 3) of the nearest floats; (N, 4) with degrees for a robot that turns about
        an axis; (N, 7) with a unit quaternion w, x, y, z for one that turns freely."""
        if self.waypoints is None:
            raise Error(f"there is no path: {self.status}")
        rows = [[float(x) for x in point] for point in self.waypoints]
        if self.degrees is not None:
            rows = [row + [degrees] for row, degrees in zip(rows, self.degrees)]
        elif self.turns is not None:
            turns = numpy.array([[float(x) for x in turn] for turn in self.turns])
            rows = numpy.hstack([rows, turns / numpy.linalg.norm(turns, axis=1, keepdims=True)])
        return numpy.array(rows, dtype=dtype or float)

    def __repr__(self):
        if self:
            length = "" if self.length is None else f", length {self.length:.6g}"
            return f"<nef.planner.Plan: a path of {len(self.waypoints)} way-points{length}>"
        return f"<nef.planner.Plan: {self.status}{', ' + self.collision if self.collision else ''}>"


class Scene:
    """A robot that translates among obstacles, and may turn about an axis or freely.

    - robot: a Polyhedron, its reference point at the origin
    - obstacles: a list of Polyhedron
    - box: two corners that bound the reference point; or None
    - contact: whether the robot may touch obstacles; then passages as narrow as the robot are free
    - names: of the obstacles, for messages
    - rotation: a Rotation if the robot may turn; then it must be a bounded solid. plan() answers for all angles of the
      range; free_space(), components(), passages() and check() are about translations and raise InputError. "SO(3)" if it
      may turn about all axes; start and goal are (position, quaternion) then
    """

    def __init__(self, robot: Polyhedron, obstacles: Sequence[Polyhedron], box: Any = None, contact: bool = True,
                 names: Optional[Sequence[str]] = None, rotation: Union[Rotation, str, None] = None):
        if isinstance(obstacles, Polyhedron):
            raise TypeError("obstacles must be a list of Polyhedron: write [obstacle] for one")
        if isinstance(contact, str):
            raise TypeError(f"contact must be True (allow) or False (forbid), not {shown(contact)}")
        if isinstance(rotation, str) and rotation != "SO(3)":
            raise TypeError(f"rotation must be 'SO(3)' or a Rotation, such as Rotation('z', 0, 360), not {shown(rotation)}")
        obstacles = list(obstacles)
        if names is None:
            names = [f"obstacle {i}" for i in range(len(obstacles))]
        if len(names) != len(obstacles):
            raise InputError(f"{len(obstacles)} obstacles need as many names, not {len(names)}")
        turns = rotation
        if rotation is not None and rotation != "SO(3)":
            axis, low, high = rotation
            if isinstance(axis, str):
                if axis not in ("x", "y", "z"):
                    raise InputError(f"axis must be 'x', 'y', 'z' or a direction, not {shown(axis)}")
                axis = [int(axis == name) for name in "xyz"]
            turns = (axis, low, high, 0, 0)
        self._scene = _planner.Scene(robot, obstacles, list(names), box, contact, turns)
        self._space = None

    @property
    def robot(self) -> Polyhedron:
        return self._scene.robot

    @property
    def obstacles(self) -> List[Polyhedron]:
        return self._scene.obstacles

    @property
    def start(self) -> Optional[Tuple[Any, ...]]:
        """The start that a file gives, or None; with a fourth number, degrees, if the robot turns about an axis; (position,
        quaternion) if it turns freely."""
        return self._end(self._scene.start, 3)

    @property
    def goal(self) -> Optional[Tuple[Any, ...]]:
        """The goal that a file gives, or None, as start."""
        return self._end(self._scene.goal, 4)

    def _end(self, position, angle):
        rotation = self._scene.rotation
        return position if position is None or rotation is None else position + (rotation[angle],)

    @property
    def names(self) -> List[str]:
        """Of the obstacles, for messages."""
        return self._scene.names

    @property
    def box(self) -> Optional[Tuple[Exact3, Exact3]]:
        """Two corners that bound the reference point; or None."""
        return self._scene.box

    @property
    def contact(self) -> bool:
        """Whether the robot may touch obstacles."""
        return self._scene.contact

    @property
    def rotation(self) -> Union[Rotation, str, None]:
        """How the robot may turn, a Rotation or "SO(3)"; None if it only translates."""
        if self._scene.turns_freely:
            return "SO(3)"
        return None if self._scene.rotation is None else Rotation(*self._scene.rotation[:3])

    @property
    def messages(self) -> List[str]:
        """The changes made to the input, one per line."""
        return self._scene.messages

    def keep_clear(self, distance: Any) -> "Scene":
        """The scene of the robot enlarged by a polyhedron around the ball of this radius: its free positions keep at least
        this distance from all obstacles, and all positions that keep 1.2 times as much are free."""
        scene = Scene.__new__(Scene)
        scene._scene = self._scene.kept_clear(distance)
        scene._space = None
        return scene

    def widest(self, start: Any = None, goal: Any = None, *, growth: str = "scale", precision: Any = "1/1000",
               max_cells: Optional[int] = None, seconds: Optional[float] = None) -> Widest:
        """How large the robot may be and still have a path from start to goal.

        - start, goal, max_cells: as in plan()
        - growth: "scale": the largest factor about the reference point, from which all of the robot must be visible; "box":
          the largest r for the robot enlarged by the cube from -r to r
        - precision: relative width of the interval
        - seconds: time limit, after which sizes are undecided

            >>> import nef
            >>> from nef import planner
            >>> wall = nef.box((4, 0, 0), (5, 9, 9)) - nef.box((3, 3, 3), (6, 5, 5)).interior()
            >>> scene = planner.Scene(nef.box((0, 0, 0), (1, 1, 1)), [wall], box=((0, 0, 0), (8, 8, 8)))
            >>> scene.widest((1, 1, 1), (6, 6, 6)).low
            Fraction(2, 1)
        """
        if growth not in ("scale", "box"):
            raise InputError(f"growth must be 'scale' or 'box', not {shown(growth)}")
        scene = self._scene.with_ends(start, goal)
        return Widest(*scene.widest(growth == "box", precision, self._cells(max_cells), seconds))

    def _cells(self, max_cells):
        if max_cells is None:
            return 2000
        if self._scene.rotation is None:
            raise InputError("max_cells applies to a robot that turns, but the scene has no rotation")
        return max_cells

    def build(self, threads: int = 1, progress: Optional[Callable[[str, int, int], object]] = None) -> "Scene":
        """Computes the free space, which the first query does otherwise.

        - progress: a function of (phase, done, total); a total of 0 means that it is not known
        """
        if self._space is None:
            self._space = _planner.Space(self._scene, threads, progress, None)
        return self

    def free_space(self) -> Polyhedron:
        """The free positions of the reference point: closed if contact is allowed."""
        return self.build()._space.free()

    def components(self) -> List[Component]:
        """The connected components of free space, a list of Component."""
        return [Component(*component) for component in self.build()._space.components()]

    def passages(self) -> List[TightPassage]:
        """The tight passages, a list of TightPassage."""
        return [TightPassage(dimension, component, [Cell(*cell) for cell in cells], [Cell(*cell) for cell in mouths])
                for dimension, component, cells, mouths in self.build()._space.passages()]

    def plan(self, start: Any = None, goal: Any = None, *, raw: bool = False, clearance: bool = False, roomy: bool = False,
             min_dimension: int = 0, quick: bool = False, digits: Optional[int] = None, max_cells: Optional[int] = None,
             seconds: Optional[float] = None) -> Plan:
        """A path from start to goal, or a proof that there is none.

        - start, goal: three numbers each, and a fourth, degrees, if the robot turns about an axis (that of the scene if it is
          left out); (position, quaternion) if it turns freely; those of the scene's file if None
        - raw: no shortcuts
        - clearance: way-points away from obstacles where possible
        - roomy: use thin passages only where necessary (else: any passage)
        - min_dimension: stay in pieces of free space of at least this dimension
        - quick: shorten the first path found a little, instead of choosing the shortest of several
        - digits: round way-points to this many decimals where the motions stay free
        - seconds: time limit, after which the status is 'undecided'
        - max_cells: for a robot that turns about an axis: maximal number of cells of angles (2000); freely: of exact free
          spaces (2000, or without limit if seconds is given)

        Of a robot that turns freely every motion of a path is certified, and 'infeasible' is proved; a search that ends
        with neither is 'undecided'.
        """
        scene = self._scene.with_ends(start, goal)
        if scene.start is None or scene.goal is None:
            raise InputError("a plan needs a start and a goal")
        if digits is not None:
            require_int("digits", digits, 0, 300)
        if scene.turns_freely:
            if raw or clearance or roomy or quick or min_dimension or digits is not None:
                raise InputError("a plan of a robot that turns freely takes only max_cells and seconds")
            return Plan(_planner.solve_rigid(scene, max_cells, seconds), "rigid")
        if scene.rotation is not None:
            if raw or clearance or roomy or quick or min_dimension:
                raise InputError("a plan of a robot that turns takes only digits, max_cells and seconds")
            answer = _planner.solve_turning(scene, self._cells(max_cells), seconds, digits)
            return Plan(answer, "translation and turning")
        self._cells(max_cells)
        if self._space is None:
            invalid = scene.invalid_end(scene.start, scene.goal)
            if invalid is not None:
                return Plan(invalid)
        options = _planner.PathOptions(raw, clearance, roomy, min_dimension, quick, digits)
        began = time.monotonic()
        if self._space is None and seconds is not None:
            space = _planner.Space(self._scene, 1, None, seconds)
            if not space.built:
                return Plan({"status": "undecided"})
            self._space = space
        left = None if seconds is None else seconds - (time.monotonic() - began)
        return Plan(self.build()._space.solve(scene.start, scene.goal, options, left))

    def check(self, waypoints: Any) -> Plan:
        """Whether a path stays in free space, exactly: a Plan, 'path' or 'blocked'. Of a robot that only translates."""
        return Plan(self.build()._space.check(waypoints))

    def certify(self, path: Any, seconds: Optional[float] = None,
                progress: Optional[Callable[[str, int, int], object]] = None) -> CertifiedPath:
        """Whether a path of the robot as a rigid body collides: proves every motion free, or finds a colliding pose.

        - path: a list of (position, quaternion), quaternions as w, x, y, z of any length; a Plan; or a file of poses as
          planner --path takes it. Between two poses the position goes straight, and the rotation evenly along the
          shorter arc
        - seconds: time limit, after which the path is undecided
        - progress: a function of (phase, done, total), as in build()

        The robot is as in its own file; the rotation of the scene, if it has one, does not bound the path.

            >>> import nef
            >>> from nef import planner
            >>> bar = nef.box((-2, "-1/4", "-1/4"), (2, "1/4", "1/4"))
            >>> scene = planner.Scene(bar, [nef.box((1, 1, -1), (2, 2, 1))])
            >>> turn = [((0, 0, 0), (1, 0, 0, 0)), ((0, 0, 0), (1, 0, 0, 1))]     # a quarter turn about z
            >>> scene.certify(turn).collision.motion
            0
        """
        return CertifiedPath(*self._scene.certify(_poses_of(path, self._scene.turns_freely), seconds, progress))

    def prove(self, path: Any = None, *, start: Any = None, goal: Any = None) -> str:
        """A proof that others can check, as the text of a .proof file (`planner --proof`): of a path, that none of its poses
        collides or one does; without a path, that there is one from start to goal, or none, for the motions that the scene
        allows.

        - path: as in certify()
        - start, goal: as in plan()

        Write the text to a file, and `python/proofs/check.py FILE` checks it with Python's standard library alone. Raises
        InputError if there is no proof.

            >>> import json, nef
            >>> from nef import planner
            >>> wall = nef.box((4, 0, 0), (5, 9, 9))
            >>> scene = planner.Scene(nef.box((0, 0, 0), (1, 1, 1)), [wall], box=((0, 0, 0), (8, 8, 8)))
            >>> text = scene.prove(start=(1, 1, 1), goal=(7, 7, 7))
            >>> json.loads(text)["claim"]["status"], scene.complaint(text)
            ('infeasible', None)
        """
        if path is not None:
            if start is not None or goal is not None:
                raise InputError("a proof is about a path or about a start and a goal, not both")
            text = self._scene.prove_path(_poses_of(path, self._scene.turns_freely))
            if text is None:
                raise InputError("the path is undecided, so there is no proof")
            return text
        scene = self._scene.with_ends(start, goal)
        if scene.start is None or scene.goal is None:
            raise InputError("a proof needs a path, or a start and a goal")
        if scene.turns_freely or scene.rotation is not None:
            return self._prove_turning(scene, start, goal)
        return self.build()._space.prove(scene.start, scene.goal)

    def _prove_turning(self, scene, start, goal) -> str:
        if scene.turns_freely:
            answer = _planner.solve_rigid(scene, None, None)
            plan, text = Plan(answer, "rigid"), answer.get("proof_text")
        else:
            plan = self.plan(start=start, goal=goal)
            text = plan.proof.text() if plan.status == "infeasible" else None
        if plan.status == "path":
            return self.prove(plan)
        if text is None:
            raise InputError(f"the answer is {plan.status!r}, and there is no proof of it")
        return text

    def prove_tight(self) -> str:
        """The proof that the tight passages are tight, as the text of a .proof file (`planner --tight --proof`). Raises InputError
        if there is no passage, or no such proof.

            >>> import json, nef
            >>> from nef import planner
            >>> wall = nef.box((4, 0, 0), (5, 9, 9)) - nef.box((3, 3, 3), (6, 4, 4)).interior()
            >>> scene = planner.Scene(nef.box((0, 0, 0), (1, 1, 1)), [wall], box=((0, 0, 0), (8, 8, 8)))
            >>> text = scene.prove_tight()
            >>> json.loads(text)["claim"]["status"], scene.complaint(text)
            ('tight', None)
        """
        return self.build()._space.prove_tight()

    def complaint(self, text: str) -> Optional[str]:
        """What is wrong with the text of a .proof file, by itself or as one about this scene; None if it is valid. The check
        uses nothing of the search (`planner --check-proof`)."""
        return self._scene.complaint(text)


def _poses_of(path, turns_freely):
    """(position, quaternion) for each pose of a list, a Plan or a file."""
    if isinstance(path, (str, os.PathLike)):
        poses = _planner.read_poses(os.fspath(path), turns_freely)
        if poses is None:
            raise InputError(f"{os.fspath(path)}: no pose is turned: use check()")
        return poses
    if isinstance(path, Plan):
        if path.waypoints is None:
            raise Error(f"there is no path: {path.status}")
        return list(zip(path.waypoints, path.turns or [(1, 0, 0, 0)] * len(path.waypoints)))
    return [_pose(pose) for pose in path]


def _pose(pose):
    try:
        position, quaternion = pose
        return tuple(position), tuple(quaternion)
    except (TypeError, ValueError):
        raise InputError(f"a pose is (position, quaternion), such as ((0, 0, 0), (1, 0, 0, 0)), not {shown(pose)}; "
                         "check() takes positions alone") from None


def read(path: Any, *, crossings: str = "union", close: float = 0, turn_freely: bool = False) -> Scene:
    """The scene of a file: JSON, or an OMPL.app problem (.cfg). Changes to its meshes are reported as warnings.

    crossings, close: how its meshes are read, as in nef.from_mesh. A mesh that does not bound a solid is interpreted,
    perhaps as a surface; with crossings="refuse" it is an InputError.
    turn_freely: the robot of an OMPL.app problem turns about all axes, as in OMPL.app, whatever its start and goal.
    """
    scene = Scene.__new__(Scene)
    scene._scene = _planner.read(os.fspath(path), crossings, close, bool(turn_freely))
    scene._space = None
    for message in scene.messages:
        warnings.warn(message, InputWarning, stacklevel=2)
    return scene
