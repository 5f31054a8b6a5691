# SPDX-License-Identifier: Apache-2.0
"""Results of queries. All are named tuples; numbers are fractions.Fraction where they are exact."""
from typing import NamedTuple, Optional


class Location(NamedTuple):
    """The item of a set's complex that contains a point."""

    #: 'vertex', 'edge', 'facet' or 'volume'
    kind: str
    #: the number of the item among its kind (of an edge, a halfedge)
    index: int
    #: 0 outside of the set
    label: int


class RayHit(NamedTuple):
    """What a ray meets first."""

    #: three Fractions
    point: tuple
    location: Location


class Polygon(NamedTuple):
    """A polygon in space with holes. As seen from where the normal points, the outer ring runs counterclockwise."""

    #: array of shape (N, 3)
    outer: object
    #: a list of arrays of shape (M, 3)
    holes: list


class Section(NamedTuple):
    """What a plane cuts from a set."""

    #: the intersection itself, a Polyhedron: open and closed where the set is
    set: object
    #: the closures of its two-dimensional parts
    polygons: list
    #: the ends of segments outside of all polygons: arrays of shape (2, 3)
    segments: list
    #: array of shape (N, 3)
    points: object
    #: how many polygons and segments reach infinity; they are in `set` only
    unbounded: int


class Distance(NamedTuple):
    """How far two sets are apart."""

    #: 'disjoint', 'touching' or 'overlapping'
    contact: str
    #: whether a point is in both sets themselves
    common_point: bool
    #: the distance, a float
    value: float
    #: its exact square, a Fraction
    squared: object
    #: the nearest points of the closures, three Fractions each
    on_a: tuple
    on_b: tuple


class Penetration(NamedTuple):
    """Whether two sets overlap, and how to make them touch."""

    #: 'disjoint', 'touching' or 'overlapping'
    contact: str
    #: a shortest translation of the second set after which they touch, three Fractions; zero if they do
    translation: tuple
    #: the square of its length, a Fraction
    squared_length: object


class Repair(NamedTuple):
    """What a repair has made of a mesh."""

    #: the solid, a Polyhedron; None if the mesh still bounds none
    set: object
    #: why it bounds none, and what to do; None if it bounds one
    problem: Optional[str]
    #: a line for each kind of change; empty if nothing was changed
    done: list
    #: of each face of the mesh, then of those that were added: 'kept', 'turned', 'cut' (it crosses others), 'inside' (nothing
    #: of it is left), 'copy' (another one has its corners), 'no_area' or 'added'
    faces: list
    #: the corners of faces that were added, vertices of the mesh
    added: list
    #: of faces that were cut, what is in the boundary of the solid, a Polyhedron
    cut_kept: object
    #: and what is not
    cut_off: object
    #: {winding number: (how many parts, their volume as Measured)}, if the rule for crossings decided
    volumes: dict
    #: how many holes the surface had
    holes: int
    #: the share of lids for all of them in the area of the mesh with its lids, with close=
    lid_share: float
    #: whether they were closed, which is a guess
    has_lids: bool


class MeshWithOrigins(NamedTuple):
    """The boundary of a Boolean of sets, and which of them each face comes from."""

    #: array of shape (N, 3)
    vertices: object
    #: array of shape (M, 3), or a list of M arrays
    faces: object
    #: of each face, a tuple of the numbers of the sets on whose boundary it lies
    origins: list


class Reach(NamedTuple):
    """Where a tool can go, and what it can touch there."""

    #: the connected free positions of the tool's origin, a Polyhedron
    positions: object
    #: the part of the boundary of the part that the tool touches at one of them, a Polyhedron
    touched: object
    #: the rest of that boundary, a Polyhedron
    untouched: object


class SimplifiedOffset(NamedTuple):
    """An offset of fewer triangles or digits."""

    #: a Polyhedron
    set: object
    #: how far it may be from the offset by the radius, a Fraction: it is inside or around one whose radius differs by that
    error: object


class Millable(NamedTuple):
    """What a milling tool leaves of the material around a part."""

    #: closed, contains the part, and is the part wherever the tool reaches, a Polyhedron
    shape: object
    #: what that has beyond the part, a list of closed solids by descending volume
    unreached: object


class Measured(NamedTuple):
    """A measure in floats, which is off by at most `error`; an infinite one has the error 0."""

    value: float
    error: float


class ApproximateMoments(NamedTuple):
    """Centroid and inertia of a solid of density one, in floats with proven bounds."""

    #: three floats, each off by at most centroid_error
    centroid: tuple
    centroid_error: float
    #: the inertia tensor about the centroid, array of shape (3, 3), each entry off by at most inertia_error
    inertia: object
    inertia_error: float
    #: the eigenvalues of the tensor given here, smallest first, each off by 3 inertia_error and some units in the last place
    principal_moments: object
    #: unit vectors that belong to them, the rows of a rotation matrix
    principal_axes: object


class Moments(NamedTuple):
    """Integrals over a solid of density one. Without volume there is neither a centroid nor what follows from it."""

    volume: object
    #: three Fractions
    centroid: tuple
    #: the integrals of x, y, z
    first: tuple
    #: those of the products of two coordinates: three rows of three Fractions
    second: tuple
    #: the inertia tensor about the centroid
    inertia: tuple
    #: its eigenvalues, smallest first: array of three floats
    principal_moments: object
    #: unit vectors that belong to them, the rows of a rotation matrix
    principal_axes: object


class Counts(NamedTuple):
    """How many items the complex of a set has, without those at infinity; the outer volume counts."""

    vertices: int
    edges: int
    facets: int
    volumes: int
    shells: int
