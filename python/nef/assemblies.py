# SPDX-License-Identifier: Apache-2.0
"""Assemblies that are taken apart. nef.planner has all of it."""
import os
import warnings
from fractions import Fraction
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

from . import _planner
from ._nef import Polyhedron
from .arguments import require_int, shown
from .errors import InputError, InputWarning

Exact3 = Tuple[Fraction, Fraction, Fraction]
Integer3 = Tuple[int, int, int]
Turns = Union[None, str, Sequence[Any]]
Parts = Union[Dict[str, Polyhedron], str, "os.PathLike[str]"]


class Turning(NamedTuple):
    """How parts turn while they move: at way-point i of the path, a point v is at R(v - pivot) + pivot + path[i] with R
    the rotation of quaternions[i]. Between two way-points the rotation takes the shorter arc, at constant speed."""

    pivot: Exact3
    #: w, x, y, z of any length, four Fractions each
    quaternions: List[Tuple[Fraction, Fraction, Fraction, Fraction]]


class DisassemblyStep(NamedTuple):
    """Parts that leave the others as one, or each in a direction of its own."""

    #: their names
    parts: List[str]
    #: names of the parts that stay
    stay: List[str]
    #: way-points relative to the place in the assembly, three Fractions each
    path: List[Exact3]
    #: one motion, which may continue forever
    straight: bool
    #: numbers of way-points with more decimals than `digits`
    unrounded: List[int]
    #: how the parts turn; None if they do not
    turning: Optional[Turning] = None
    #: {name: where the part goes} if parts go straight in different directions at once, where parts with equal vectors
    #: stay together; then `path` is empty. Empty otherwise
    vectors: Dict[str, Exact3] = {}


class Inseparable(NamedTuple):
    """Parts of which no subset can leave the others."""

    #: their names
    parts: List[str]
    #: whether no subset can even begin to move
    nothing_moves: bool
    #: {name: names of the parts that block it in some direction}
    blocked_by: Dict[str, List[str]]
    #: as few of them as do not come apart by themselves
    interlocked: List[str]
    #: whether without any one of these the others come apart; False if the search for fewer was stopped
    interlocked_is_least: bool


class Undecided(NamedTuple):
    """Parts for which the time ran out, or for which no answer was found."""

    #: their names
    parts: List[str]
    #: no subset of fewer parts than this can leave the others
    proved_below: int


class Disassembly(NamedTuple):
    """How an assembly comes apart, or why it does not."""

    #: 'sequence', 'inseparable', 'undecided', 'overlap' or, with a clearance, 'too_close'
    status: str
    #: a list of DisassemblyStep, in order
    steps: List[DisassemblyStep]
    inseparable: List[Inseparable]
    undecided: List[Undecided]
    #: the names of two parts that overlap, or are closer than the clearance; None if no parts are
    overlap: Optional[Tuple[str, str]]


class FreeDirections(NamedTuple):
    """The directions in which a part can begin to move while all others rest."""

    #: the part of the closed cone in the cube from -1 to 1, a Polyhedron
    cone: Polyhedron
    #: 3, 2, 1, or 0 if the part cannot move
    dimension: int
    #: whether the part can move in every direction
    everything: bool
    #: along the edges of the cone
    rays: List[Integer3]
    #: (name, normals) for a part that forbids the directions d with normal * d < 0 for all normals
    stops: List[Tuple[str, List[Integer3]]]


def _read(parts: Parts) -> Tuple[List[str], List[Polyhedron], bool, Optional[Exact3]]:
    """Names and sets of parts, whether they may turn freely, and the axis about which they may turn."""
    if isinstance(parts, dict):
        return [str(name) for name in parts], list(parts.values()), False, None
    if not isinstance(parts, (str, os.PathLike)):
        raise TypeError(f"parts must be a dictionary {{name: Polyhedron}} or the name of a file, not {type(parts).__name__}")
    names, sets, messages, free, axis = _planner.read_parts(os.fspath(parts))
    for message in messages:
        warnings.warn(message, InputWarning, stacklevel=4)
    return names, sets, free, axis


def parts_of(parts: Parts) -> Tuple[List[str], List[Polyhedron]]:
    """Names and sets of parts, which may be an assembly's file. Changes to the input of a file are warnings."""
    return _read(parts)[:2]


def disassemble(parts: Parts, *, rotation: Turns = None, simultaneous: bool = False,
                keep_clear: Union[None, int, str, float, Fraction] = None, digits: Optional[int] = None,
                max_cells: int = 200, seconds: Optional[float] = None) -> Disassembly:
    """Takes an assembly apart, or proves that it is stuck, as `planner --assembly`.

    - parts: {name: Polyhedron} of bounded solids, or an assembly's file
    - rotation: None, parts keep their orientation, or as the file says; "SO(3)", parts may turn; three numbers, they may
      turn about axes of this direction
    - simultaneous: where no set of parts can leave as one, try parts that move at once in different directions
    - keep_clear: keep parts that move at least this distance from parts that rest
    - digits: round way-points to this many decimals where the motions stay free
    - max_cells: limit on the cells of angles, or slices, for each set of parts that may turn
    - seconds: time limit, after which the status is 'undecided'

        >>> import nef
        >>> from nef import planner
        >>> block = nef.box((0, 0, 0), (3, 3, 3)) - nef.box((1, 1, 1), (2, 2, 3)).interior()
        >>> answer = planner.disassemble({"block": block, "peg": nef.box((1, 1, 1), (2, 2, 4))})
        >>> answer.status, len(answer.steps)
        ('sequence', 1)
    """
    if digits is not None:
        require_int("digits", digits, 0, 300)
    names, sets, free, axis = _read(parts)
    if rotation is not None:
        free, axis = rotation == "SO(3)", rotation
    if free:
        axis = None
    elif isinstance(axis, str):
        raise InputError(f'rotation must be None, "SO(3)" or three numbers, not {shown(axis)}')
    steps, inseparable, undecided, overlap = _planner.take_apart(names, sets, digits, seconds, free, axis, simultaneous,
                                                                 keep_clear, max_cells)

    def named(numbers):
        return [names[i] for i in numbers]

    stuck = []
    for numbers, nothing_moves, pairs, core, is_least in inseparable:
        blocked_by: Dict[str, List[str]] = {}
        for a, b in pairs:
            blocked_by.setdefault(names[a], []).append(names[b])
        stuck.append(Inseparable(named(numbers), nothing_moves, blocked_by, named(core), is_least))
    close = "overlap" if keep_clear is None else "too_close"
    status = close if overlap else "inseparable" if stuck else "undecided" if undecided else "sequence"
    return Disassembly(status,
                       [DisassemblyStep(named(moving), named(stay), path, straight, unrounded,
                                        None if turning is None else Turning(*turning), dict(zip(named(moving), vectors)))
                        for moving, stay, path, straight, unrounded, turning, vectors in steps], stuck,
                       [Undecided(named(numbers), below) for numbers, below in undecided],
                       None if overlap is None else (names[overlap[0]], names[overlap[1]]))


def free_directions(parts: Parts, part: str) -> FreeDirections:
    """The exact cone of directions in which a part of an assembly can begin to move: FreeDirections.

    - parts: {name: Polyhedron} of bounded solids, or an assembly's file; they must not overlap
    - part: a name

        >>> import nef
        >>> from nef import planner
        >>> floor, brick = nef.box((0, 0, 0), (9, 9, 1)), nef.box((3, 3, 1), (4, 4, 2))
        >>> planner.free_directions({"floor": floor, "brick": brick}, "brick").dimension
        3
    """
    names, sets = parts_of(parts)
    if part not in names:
        raise InputError(f"part {part!r} is not one of {', '.join(names)}")
    cone, dimension, everything, rays, stops = _planner.free_directions(names, sets, names.index(part))
    return FreeDirections(cone, dimension, everything, rays, [(names[other], normals) for other, normals in stops])


def prove_inseparable(parts: Parts) -> str:
    """A proof that no set of these parts can begin to move by translation while the others rest, as the text of a .proof
    file (`planner --assembly --proof`). Raises InputError if some can.

    - parts: {name: Polyhedron} of bounded solids, or an assembly's file: all parts that `Inseparable.parts` names, say

        >>> import nef
        >>> from nef import planner
        >>> shell = nef.box((0, 0, 0), (3, 3, 3)) - nef.box((1, 1, 1), (2, 2, 2)).interior()
        >>> stuck = {"shell": shell, "core": nef.box((1, 1, 1), (2, 2, 2))}
        >>> text = planner.prove_inseparable(stuck)
        >>> planner.complaint_about_inseparable(stuck, text) is None
        True
    """
    names, sets = parts_of(parts)
    text = _planner.prove_inseparable(names, sets)
    if text is None:
        raise InputError("some of these parts can begin to move; only parts that cannot move have a proof")
    return text


def complaint_about_inseparable(parts: Parts, text: str) -> Optional[str]:
    """What is wrong with the text of such a proof, by itself or as one about these parts; None if it is valid."""
    return _planner.complaint_about_inseparable(*parts_of(parts), text)
