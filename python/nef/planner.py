# SPDX-License-Identifier: Apache-2.0
"""Exact planning for a robot that translates among obstacles: a path, or a proof that there is none.

    >>> import nef
    >>> from nef import planner
    >>> wall = nef.box((4, 0, 0), (5, 9, 9)) - nef.box((3, 3, 3), (6, 4, 4)).interior()
    >>> robot = nef.box((0, 0, 0), (1, 1, 1))                  # as wide as the hole
    >>> scene = planner.Scene(robot, [wall], box=((0, 0, 0), (8, 8, 8)))
    >>> plan = scene.plan((1, 1, 1), (7, 7, 7))
    >>> plan.status, plan.thinness.piece                      # through a passage without any room beside it
    ('path', 1)
"""
from fractions import Fraction
from typing import Any, Callable, List, NamedTuple, Optional, Sequence, Tuple

import numpy

from . import _planner
from ._nef import Polyhedron
from .errors import Error, InputError

Exact3 = Tuple[Fraction, Fraction, Fraction]

__all__ = ["Cell", "Component", "Plan", "Proof", "Scene", "Thinness", "TightPassage", "read"]


class Cell(NamedTuple):
    """A cell of the free space."""

    #: as people read it: "edge 3"
    name: str
    dimension: int
    #: three Fractions each; in boundary order for a facet, none for a volume
    vertices: List[Exact3]


class TightPassage(NamedTuple):
    """A part of free space without room: the robot touches obstacles on opposite sides everywhere in it."""

    #: of its largest cell: 2, 1 or 0
    dimension: int
    #: the component of free space that it belongs to
    component: int
    cells: List[Cell]
    #: the cells of the rest of free space from which one enters
    mouths: List[Cell]


class Component(NamedTuple):
    """A connected component of free space."""

    #: of its largest cell
    dimension: int
    bounded: bool
    #: how many cells it has
    cells: int


class Thinness(NamedTuple):
    """How thin free space gets on the best way between two points."""

    #: the largest k so that a path stays where free space is locally at least k-dimensional
    piece: int
    #: the largest j so that a path crosses only cells of dimension j or more, its ends exempt
    junction: int


class Proof(NamedTuple):
    """Why there is no path: start and goal lie in different components of the exact free space."""

    #: numbers in Scene.components()
    start_component: int
    goal_component: int


class Plan:
    """What came out of a question. True if it is a path.

    - status: 'path', 'infeasible', 'invalid_start', 'invalid_goal' or 'blocked' (a given path leaves free space)
    - waypoints: the path, a list of three Fractions each; None if there is none
    - length: of the path, a float
    - segment_dimensions: for each segment, the smallest dimension of the cells that it runs along
    - passages: numbers in Scene.passages(), in the order of their use
    - thinness: of the best path there is
    - proof: a Proof if the problem is infeasible
    - collision: what an invalid start or goal, or a blocked path, hits: a line for people
    - blocked_segment: of a given path, the first segment that leaves free space
    """

    def __init__(self, answer):
        self.status = answer["status"]
        self.waypoints = answer.get("points")
        self.length = answer.get("length")
        self.segment_dimensions = answer.get("segment_dimensions")
        self.passages = answer.get("passages")
        self.thinness = Thinness(*answer["thinness"]) if "thinness" in answer else None
        self.proof = Proof(*answer["components"]) if "components" in answer else None
        self.collision = answer.get("collision")
        self.blocked_segment = answer.get("blocked_segment")

    def __bool__(self):
        return self.status == "path"

    def __array__(self, dtype=None):
        """The way-points as an array of shape (N, 3) of the nearest floats."""
        if self.waypoints is None:
            raise Error(f"there is no path: {self.status}")
        return numpy.array([[float(x) for x in point] for point in self.waypoints], dtype=dtype or float)

    def __repr__(self):
        if self:
            return f"<nef.planner.Plan: a path of {len(self.waypoints)} way-points, length {self.length:.6g}>"
        return f"<nef.planner.Plan: {self.status}{', ' + self.collision if self.collision else ''}>"


class Scene:
    """A robot that translates among obstacles.

    - robot: a Polyhedron, its reference point at the origin
    - obstacles: a list of Polyhedron
    - box: two corners that bound the reference point; or None
    - contact: whether the robot may touch obstacles; then passages as narrow as the robot are free
    - names: of the obstacles, for messages
    """

    def __init__(self, robot: Polyhedron, obstacles: Sequence[Polyhedron], box: Any = None, contact: bool = True,
                 names: Optional[Sequence[str]] = None):
        obstacles = list(obstacles)
        if names is None:
            names = [f"obstacle {i}" for i in range(len(obstacles))]
        if len(names) != len(obstacles):
            raise ValueError(f"{len(obstacles)} obstacles need as many names, not {len(names)}")
        self._scene = _planner.Scene(robot, obstacles, list(names), box, contact)
        self._space = None

    @property
    def robot(self) -> Polyhedron:
        return self._scene.robot

    @property
    def obstacles(self) -> List[Polyhedron]:
        return self._scene.obstacles

    @property
    def start(self) -> Optional[Exact3]:
        """The start that a file gives, or None."""
        return self._scene.start

    @property
    def goal(self) -> Optional[Exact3]:
        """The goal that a file gives, or None."""
        return self._scene.goal

    def build(self, threads: int = 1, progress: Optional[Callable[[str, int, int], object]] = None) -> "Scene":
        """Computes the free space, which the first question does otherwise.

        - progress: a function of (phase, done, total); a total of 0 means that it is not known
        """
        if self._space is None:
            self._space = _planner.Space(self._scene, threads, progress)
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
             min_dimension: int = 0) -> Plan:
        """A path from start to goal, or a proof that there is none.

        - start, goal: three numbers each; those of the scene's file if None
        - raw: without shortcuts
        - clearance: way-points off the obstacles where there is a choice
        - roomy: the roomiest way first, then short (else just short)
        - min_dimension: only where free space is locally at least this thick
        """
        start = self.start if start is None else start
        goal = self.goal if goal is None else goal
        if start is None or goal is None:
            raise InputError("a plan needs a start and a goal")
        options = _planner.PathOptions(raw, clearance, roomy, min_dimension)
        return Plan(self.build()._space.solve(start, goal, options))

    def check(self, waypoints: Any) -> Plan:
        """Whether a path stays in free space, exactly: a Plan, 'path' or 'blocked'."""
        return Plan(self.build()._space.check(waypoints))


def read(path: Any) -> Scene:
    """The scene of a file: JSON, or an OMPL.app problem (.cfg)."""
    import os

    scene = Scene.__new__(Scene)
    scene._scene = _planner.read(os.fspath(path))
    scene._space = None
    return scene
