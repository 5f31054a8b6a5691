#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Replays a .proof file of the planner in exact arithmetic, with Python's standard library alone.

    check.py FILE [--claim SHA256]

Prints what is proved and the SHA-256 of the claim, and exits with 0; with 1 if the proof does not hold, or if --claim
names another claim; with 2 if the file cannot be read. docs/proofs.md says what a claim means, docs/how/proofs.md why this proves it.

Sections, and the claims that need them:

    Reading; Vectors and rotations; Convex pieces            all
    How far a motion has come; What claims have in common    all but inseparable
    Free and blocked paths                                   path, blocked, tight
    Barriers of triangles                                    infeasible: of translations, along a chain
    Orientations                                             infeasible: about all axes, along a chain
    Boxes of poses                                           infeasible: about all axes
    Layers of orientations                                   infeasible: along a chain
    Cones of directions                                      inseparable, tight
    What cannot begin to move                                inseparable
    Tight passages                                           tight
"""
import argparse
import collections
import functools
import hashlib
import itertools
import json
import math
import operator
import re
import sys
from fractions import Fraction


class Refused(Exception):
    """The proof does not hold; the message says where."""


def require(condition, complaint):
    if not condition:
        raise Refused(complaint)


# Reading: every object has exactly the keys that are expected, every number is a string, every index is in range.

def unique_keys(pairs):
    require(len(dict(pairs)) == len(pairs), "a key occurs twice")
    return dict(pairs)


def fields(value, *keys):
    require(isinstance(value, dict) and set(value) == set(keys), f"expected an object with the keys {', '.join(keys)}")
    return [value[key] for key in keys]


def has_key(value, key):
    return isinstance(value, dict) and key in value


def items(value, count=None):
    require(isinstance(value, list) and count in (None, len(value)), f"expected a list of {count or 'any number'}")
    return value


@functools.lru_cache(maxsize=1 << 16)  # a proof has the same coordinates again and again
def fraction_of(text):
    well_formed = re.fullmatch("-?[0-9]+(/[1-9][0-9]*)?", text)
    fraction = Fraction(text) if well_formed else None
    require(well_formed and str(fraction) == text, f"numbers are strings such as '1/3', not {text!r}")
    return fraction.numerator if fraction.denominator == 1 else fraction


def number(value):
    """Each number has one spelling, a fraction in lowest terms, so that equal claims have equal digests. Integers are of
    type int, which is faster; so whoever divides makes a Fraction first."""
    require(isinstance(value, str), f"numbers are strings such as '1/3', not {value!r}")
    return fraction_of(value)


def numbers(value, count=None):
    return [number(x) for x in items(value, count)]


def index(value, count):
    require(type(value) is int and 0 <= value < count, f"there is no item {value!r} of {count}")
    return value


def intervals(parts, start, *keys):
    """Parts of an interval, from its start to 1: where each begins and ends (`until`), and its other values."""
    for part in items(parts):
        until, *others = fields(part, "until", *keys)
        end = number(until)
        require(start < end <= 1, "the parts of an interval do not go up to 1")
        yield (start, end, *others)
        start = end
    require(start == 1, "the parts of an interval do not go up to 1")


# Vectors and rotations. A quaternion is w, x, y, z, of any length.

def sign(x):
    return (x > 0) - (x < 0)


def dot(a, b):
    return sum(map(operator.mul, a, b))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def between(a, b, s):
    return [(1 - s) * x + s * y for x, y in zip(a, b)]


def axes(dimension):
    return [[int(i == k) for i in range(dimension)] for k in range(dimension)]


def whole(*rows):
    """Vectors times the least positive number that makes all their components integers."""
    scale = math.lcm(*(x.denominator for row in rows for x in row))
    return [[x.numerator * (scale // x.denominator) for x in row] for row in rows]


def shortest(v):
    """The shortest integer vector of the same direction."""
    [v] = whole(v)
    length = math.gcd(*v)
    require(length, "a vector has no direction")
    return tuple(x // length for x in v)


def unit(v):
    """The shortest integer vector that is parallel to one, its first number that is not zero positive."""
    v = shortest(v)
    return v if next(x for x in v if x) > 0 else tuple(-x for x in v)


def rotation_form(q):
    """The rotation matrix of a quaternion times its square, and a row with the square."""
    w, x, y, z = q
    return [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z], [dot(q, q)]]


def mixtures(chart, low, high):
    """A chart is a set of quaternions, origin + sum t_k directions[k]; in a part of it each t_k is from low[k] to high[k]. The
    Bernstein coefficients of the rotation matrix times the square of the quaternion, and of this square: at the ends and in the
    middle of each parameter, less the form of half of the edge for each middle. Each is four rows, as of rotation_form. All are
    multiplied by the same number, so that they are integers. Every rotation of the part is a mixture of these matrices, each
    divided by its square."""
    low, high, [unit] = whole(low, high, [1])
    origin, *directions = whole(chart[0], *chart[1])
    origin = [2 * unit * x for x in origin]
    edges = [rotation_form([(b - a) * x for x in d]) for a, b, d in zip(low, high, directions)]
    result = []
    for ends in itertools.product(range(3), repeat=len(directions)):
        ends = ends[::-1]
        at = [(2 - end) * a + end * b for end, a, b in zip(ends, low, high)]
        rows = rotation_form([x + dot(at, column) for x, *column in zip(origin, *directions)])
        for end, edge in zip(ends, edges):
            if end == 1:
                rows = [minus(row, less) for row, less in zip(rows, edge)]
        require(rows[3][0] > 0, "a part has too many orientations")
        result.append(rows)
    return result


def raised(coefficients, axis):
    """Bernstein coefficients of a polynomial of degree 2 in each of three parameters become those of its product with the parameter
    `axis`, which goes from -1 to 1, or with 1 if `axis` is 3; each is multiplied by 3 for each index that is 1 or 2."""
    for k in range(3):
        low = -1 if k == axis else 1
        inner = 4 ** k
        blocks = [[coefficients[i + inner * (3 * outer + at)] for i in range(inner)] for outer in range(3 ** (2 - k))
                  for at in range(3)]
        coefficients = [x for f0, f1, f2 in zip(*(blocks[at::3] for at in range(3)))
                        for part in ([low * a for a in f0], [a + 2 * low * b for a, b in zip(f0, f1)],
                                     [2 * b + low * c for b, c in zip(f1, f2)], f2) for x in part]
    return coefficients


def arc(p, q):
    """The chart of the quaternions between two, which are the ends of its parameter, -1 and 1."""
    return between(p, q, Fraction(1, 2)), [[Fraction(x) / 2 for x in minus(q, p)]]


def placed(mixture, vertex, position):
    *rows, [divisor] = mixture
    return [Fraction(dot(row, vertex)) / divisor + at for row, at in zip(rows, position)]


def rotated(q, vertices, position):
    [rotation] = mixtures((q, []), [], [])
    return [placed(rotation, vertex, position) for vertex in vertices]


# Convex pieces.

def outward_normals(vectors):
    """The outward normals of the planes through two of the vectors that have all of them on one side: those around the
    cone that the vectors span, if that is neither flat nor all of space."""
    [*vectors] = whole(*vectors)
    found = set()
    for i, u in enumerate(vectors):
        for v in vectors[:i]:
            normal, sides = cross(u, v), set()
            for w in vectors:
                sides.add(sign(dot(normal, w)))
                if len(sides) > 1 and 0 not in sides or len(sides) > 2:
                    break
            if sides in ({0, -1}, {0, 1}):
                found.add(shortest(normal if -1 in sides else minus([0, 0, 0], normal)))
    return found


def ranges(points):
    """The least and the largest of each coordinate."""
    return [(min(values), max(values)) for values in zip(*points)]


class Piece:
    """The hull of its vertices."""

    def __init__(self, vertices):
        self.vertices = [numbers(vertex, 3) for vertex in items(vertices)]
        require(self.vertices, "a piece has no vertices")

    @functools.cached_property
    def is_flat(self):
        """Whether all vertices lie in one plane."""
        sides = [minus(vertex, self.vertices[0]) for vertex in self.vertices[1:]]
        normals = (cross(a, b) for i, a in enumerate(sides) for b in sides[:i])
        normal = next((n for n in normals if any(n)), [0, 0, 0])
        return all(dot(normal, side) == 0 for side in sides)

    @functools.cached_property
    def faces(self):
        """The half-spaces n x <= c whose intersection it is, if it is solid."""
        require(not self.is_flat, "a flat piece blocks nothing")
        cones = ((a, outward_normals([minus(v, a) for v in self.vertices if v != a])) for a in self.vertices)
        return list({normal: Fraction(dot(normal, a)) for a, normals in cones for normal in normals}.items())

    @functools.cached_property
    def whole_vertices(self):
        """Its vertices times a positive integer, and this number."""
        *vertices, [unit] = whole(*self.vertices, [1])
        return vertices, unit

    @functools.cached_property
    def ranges(self):
        return ranges(self.whole_vertices[0])

    def require_inside(self, points, drift):
        """It contains some points, also if they move by any part of each drift, back or forth."""
        *rows, [scale] = whole(*points, *drift, [1])
        points, drift = rows[:len(points)], rows[len(points):]
        for normal, c in self.faces:
            most = scale * c.numerator - c.denominator * sum(abs(dot(normal, way)) for way in drift)
            require(all(dot(normal, point) * c.denominator <= most for point in points),
                    "a point of both pieces is not in the obstacle")


def pieces(value):
    return [Piece(piece) for piece in items(value)]


def common_point(first, of_first, second, of_second, inside):
    """A point of two hulls, given as a weighted sum of the vertices of each; without zeros it is inside both."""
    points = []
    for vertices, given in ((first, of_first), (second, of_second)):
        weights, [unit] = whole(numbers(given, len(vertices)), [1])
        require(all(w > 0 if inside else w >= 0 for w in weights) and sum(weights) == unit,
                "weights must be positive and add up to 1")
        *vertices, [scale] = whole(*vertices, [1])
        points.append([Fraction(dot(weights, coordinates), unit * scale) for coordinates in zip(*vertices)])
    require(points[0] == points[1], "two pieces have not the point in common")
    return points[0]


# How far a motion has come, when its rotation is at a parameter of the arc: angles, enclosed by rational numbers.

def root(x, upper):
    """A bound of the square root."""
    shift = max(0, 200 - x.numerator.bit_length() + x.denominator.bit_length()) // 2 + 1
    return Fraction(math.isqrt((x.numerator << 2 * shift) // x.denominator) + upper, 1 << shift)


def rounded(x, upper):
    """The next multiple of 2^-128: exact powers would have tens of thousands of digits."""
    n = x.numerator << 128
    return Fraction(-(-n // x.denominator) if upper else n // x.denominator, 1 << 128)


def arc_tangent(x, upper):
    """A bound of the arcus tangent, 0 <= x <= 1: the angle is halved twice, and then the series alternates."""
    for _ in range(2):
        x = rounded(x / (1 + root(1 + x * x, not upper)), upper)
    total, power = Fraction(0), [x, x]  # bounds from below and from above
    for k in range(19 if upper else 18):
        total += (-1) ** k * power[(k % 2 == 0) == upper] / (2 * k + 1)
        power = [rounded(power[side] * x * x, side) for side in (False, True)]
    return rounded(4 * total, upper)


def half_angle(p, r, upper):
    """A bound of half the angle between two quaternions, <p, r> >= 0."""
    lengths = dot(p, p) * dot(r, r)
    tangent = root(lengths - dot(p, r) ** 2, upper) / (root(lengths, not upper) + dot(p, r))
    return arc_tangent(min(tangent, Fraction(1)), upper)


class Motion:
    """From one pose to the next: position and angle go evenly together, the rotation along the shorter arc."""

    def __init__(self, start, end):
        (self.start, self.p), (self.end, self.q) = start, end
        if unit(self.p) == unit(self.q):
            self.q = self.p
        elif dot(self.p, self.q) < 0:
            self.q = [-x for x in self.q]

    def quaternion(self, s):
        return between(self.p, self.q, s)

    def position(self, time):
        return between(self.start, self.end, time)

    def times(self, s):
        """Two bounds of the part of the way that is done when the rotation is at parameter s."""
        if self.p == self.q or s in (0, 1):
            return s, s
        r, least = self.quaternion(s), half_angle(self.p, self.q, False)
        low = rounded(half_angle(self.p, r, False) / half_angle(self.p, self.q, True), False)
        return low, min(1, rounded(half_angle(self.p, r, True) / least, True)) if least else 1


# What claims have in common.

class PathClaim:
    """A claim about a path; `others` are the values of further keys."""

    def __init__(self, value, *further_keys):
        _, contact, box, robot, obstacles, path, *self.others = fields(
            value, "status", "contact", "box", "robot", "obstacles", "path", *further_keys)
        require(contact in ("allow", "forbid"), "unknown rule of contact")
        self.contact_allowed = contact == "allow"
        self.box = None if box is None else [numbers(corner, 3) for corner in items(box, 2)]
        self.robot, self.obstacles = pieces(robot), pieces(obstacles)
        require(self.robot, "the robot has no pieces")
        self.poses = [(numbers(position, 3), numbers(quaternion, 4))
                      for position, quaternion in (fields(pose, "position", "quaternion") for pose in items(path))]
        require(self.poses, "the path has no pose")
        require(all(any(q) for _, q in self.poses), "the quaternion of a pose is zero")
        ends = self.poses[1:] or self.poses  # a path of one pose has one motion, which stays
        self.motions = [Motion(start, end) for start, end in zip(self.poses, ends)]

    def in_box(self, position):
        return self.box is None or all(a <= x <= b for a, x, b in zip(self.box[0], position, self.box[1]))

    def beyond_a_side(self, positions):
        """Whether all positions, and so all between them, lie beyond the same side of the box."""
        return self.box is not None and any(all(p[k] < self.box[0][k] for p in positions) or
                                            all(p[k] > self.box[1][k] for p in positions) for k in range(3))

    def pair(self, i, j):
        return self.robot[index(i, len(self.robot))], self.obstacles[index(j, len(self.obstacles))]

    def may_touch(self, piece, obstacle):
        """Solid pieces may touch, if contact is allowed; flat ones never."""
        return self.contact_allowed and not piece.is_flat and not obstacle.is_flat

    def require_collision(self, piece, position, obstacle, common, turn=(1, 0, 0, 0)):
        """A piece of the robot, at a pose, collides with an obstacle; so it does at all positions between such positions."""
        ours, theirs = fields(common, "robot", "obstacle")
        common_point(rotated(turn, piece.vertices, position), ours, obstacle.vertices, theirs, self.may_touch(piece, obstacle))


# Free and blocked paths.

def are_apart(a, unit_a, b, unit_b, may_touch, normal):
    """Whether some points, given times a number, are below a plane, given by its normal, and others above it."""
    top, bottom = max(dot(normal, v) for v in a) * unit_b, min(dot(normal, v) for v in b) * unit_a
    return any(normal) and (top < bottom or may_touch and top == bottom)


def are_boxes_apart(a, unit_a, b, unit_b, may_touch):
    """The same for the planes along two axes, of boxes around the points (ranges)."""
    gaps = (x - y for (low, high), (other_low, other_high) in zip(a, b)
            for x, y in ((low * unit_b, other_high * unit_a), (other_low * unit_a, high * unit_b)))
    return any(gap > 0 or may_touch and gap == 0 for gap in gaps)


def check_part(claim, motion, start, end, given):
    """Every pair of pieces is apart from parameter start to end: enclosed by the images of each vertex by the mixtures of the
    rotations, at both ends of an interval that has the positions. A plane along two axes separates them, or the one that is
    given."""
    planes = {}
    for plane in items(given):
        i, j, normal = fields(plane, "robot", "obstacle", "normal")
        [planes[claim.pair(i, j)]] = whole(numbers(normal, 3))
    turns = mixtures(arc(motion.quaternion(start), motion.quaternion(end)), [-1], [1])
    *positions, [scale] = whole(motion.position(motion.times(start)[0]), motion.position(motion.times(end)[1]), [1])
    divisor = math.lcm(*(square for *_, [square] in turns))
    for i, piece in enumerate(claim.robot):
        vertices, unit = piece.whole_vertices
        turned = [[dot(row, vertex) * (divisor // square) * scale for row in rows] for vertex in vertices
                  for *rows, [square] in turns]
        swept = [[x + divisor * unit * at for x, at in zip(vertex, position)] for vertex in turned for position in positions]
        unit *= divisor * scale
        ends = ranges(swept)
        for j, obstacle in enumerate(claim.obstacles):
            others, other_unit = obstacle.whole_vertices
            may_touch = claim.may_touch(piece, obstacle)
            require(are_boxes_apart(ends, unit, obstacle.ranges, other_unit, may_touch) or (piece, obstacle) in planes and
                    are_apart(swept, unit, others, other_unit, may_touch, planes[piece, obstacle]),
                    f"nothing separates pieces {i} and {j}")


def check_free_path(claim, witness):
    claim = PathClaim(claim)
    require(all(claim.in_box(position) for position, _ in claim.poses), "a pose is outside the box")
    motions = items(fields(witness, "motions")[0], len(claim.motions))
    for motion, parts in zip(claim.motions, motions):
        for start, end, planes in intervals(parts, Fraction(0), "planes"):
            check_part(claim, motion, start, end, planes)
    return f"path: all {len(motions)} motions are free"


def check_blocked_path(claim, witness):
    claim = PathClaim(claim)
    if has_key(witness, "outside"):
        pose = index(fields(witness, "outside")[0], len(claim.poses))
        require(not claim.in_box(claim.poses[pose][0]), "the pose is in the box")
        return f"blocked: pose {pose} is outside the box"
    m, parameter, times, i, j, common = fields(fields(witness, "collision")[0], "motion", "parameter", "times", "robot",
                                               "obstacle", "common")
    motion, (piece, obstacle) = claim.motions[index(m, len(claim.motions))], claim.pair(i, j)
    s, times = number(parameter), numbers(times, 2)
    require(0 <= s <= 1, "the parameter is not between 0 and 1")
    low, high = motion.times(s)
    require(times[0] <= low and high <= times[1], "the position is not where the proof says")
    for time, point in zip(times, items(common, 2)):
        claim.require_collision(piece, motion.position(time), obstacle, point, motion.quaternion(s))
    return f"blocked: motion {m} collides at parameter {parameter}"


# Barriers of triangles, which are cycles modulo 2. What they separate is told by rays.

def simplex(claim, points, count, given, require_blocked):
    """The places in `points` of the corners of a triangle or tetrahedron, no position on which is free: it lies beyond a side of
    the box, or two pieces overlap at its corners, and so on all of it."""
    overlap = has_key(given, "robot")
    places, *pair = fields(given, "corners", *(("robot", "obstacle", "common") if overlap else ()))
    places = tuple(index(place, len(points)) for place in items(places, count))
    corners = [points[place] for place in places]
    if overlap:
        require_blocked(corners, *pair)
    require(overlap or claim.beyond_a_side(corners), "a position on a barrier may be free")
    return places


def in_integers(points, claim, *simplices):
    """Start and goal, and lists of simplices with the positions of their corners, all times the same number."""
    *at, start, goal = map(tuple, whole(*points, *(position for position, _ in claim.poses)))
    return (start, goal), *([tuple(at[place] for place in places) for places in some] for some in simplices)


@functools.lru_cache(maxsize=1 << 16)  # neighbours have their edges in common
def line_through(a, b):
    along = unit(minus(b, a))
    return along, *cross(a, along)


def edge_ends(corners):
    """The ends of a triangle's edges, each with the line of its edge. If these cancel out modulo 2 over some triangles, so do
    the edges as sets of points, however they are cut."""
    for a, b in zip(corners, corners[1:] + corners[:1]):
        line = line_through(*sorted((a, b)))
        yield line, a
        yield line, b


def cancel_out(ends):
    return all(count % 2 == 0 for count in collections.Counter(ends).values())


def have_no_border(triangles):
    return cancel_out(end for corners in triangles for end in edge_ends(corners))


def crosses(corners, origin, direction):
    """Whether a ray crosses a triangle; None if it comes too close to tell."""
    a, b, c = (minus(corner, origin) for corner in corners)
    sides = {sign(dot(direction, cross(p, q))) for p, q in ((a, b), (b, c), (c, a))}
    if {1, -1} <= sides:
        return False
    normal = cross(minus(b, a), minus(c, a))
    height = sign(dot(normal, a))
    return None if 0 in sides or height == 0 else height == sign(dot(normal, direction))


def crosses_odd(triangles, origin):
    """Whether a ray crosses an odd number of triangles: a ray that meets no edge, of some that are tried."""
    for ray in range(100):
        crossed = [crosses(corners, origin, [1000, 7 + 13 * ray, 11 + 17 * ray * ray]) for corners in triangles]
        if None not in crossed:
            return sum(crossed) % 2
    raise Refused("every ray meets an edge, or start or goal is on the barrier")


def check_no_translation(claim, witness):
    claim = PathClaim(claim)
    require(len(claim.poses) == 2 and all(q == [1, 0, 0, 0] for _, q in claim.poses), "expected start and goal, not turned")
    points, triangles = fields(fields(witness, "barrier")[0], "points", "triangles")
    points = [numbers(point, 3) for point in items(points)]

    def require_blocked(corners, i, j, common):
        piece, obstacle = claim.pair(i, j)
        require(not claim.contact_allowed or claim.may_touch(piece, obstacle), "a flat piece bars nothing where contact is allowed")
        for corner, point in zip(corners, items(common, 3)):
            claim.require_collision(piece, corner, obstacle, point)

    places = [simplex(claim, points, 3, triangle, require_blocked) for triangle in items(triangles)]
    ends, barrier = in_integers(points, claim, places)
    require(have_no_border(barrier), "an edge is one of an odd number of triangles")
    sides = [crosses_odd(barrier, end) for end in ends]
    require(sides[0] != sides[1], "start and goal are on the same side of the barrier")
    return f"infeasible: {len(barrier)} triangles separate start and goal"


# Orientations: pieces that overlap at all rotations of a part of a chart.

class Blocking:
    """Shows that pieces overlap at all orientations of a part of a chart, and at all positions of the reference point in the
    hull of some."""

    def __init__(self, claim, charts, reference):
        self.claim, self.charts, self.reference = claim, charts, reference
        self.seen_faces, self.inner_pieces, self.forms = {}, {}, {}

    def seen(self, piece):
        """The faces of a piece of the robot, seen from the reference point: n x <= c / unit, as (n, c, unit), all integers."""
        if piece not in self.seen_faces:
            seen = ((normal, Fraction(c - dot(normal, self.reference))) for normal, c in piece.faces)
            self.seen_faces[piece] = [(normal, c.numerator, c.denominator) for normal, c in seen]
        return self.seen_faces[piece]

    def inner_piece(self, chart, low, high, piece):
        """Half-spaces n x < c of integers, as (*n, c), whose points are inside the piece at all of the orientations."""
        key = chart, *low, *high, piece
        if key not in self.inner_pieces:
            self.inner_pieces[key] = [(*(dot(row, normal) * unit for row in m[:3]), c * m[3][0])
                                      for m in mixtures(self.charts[chart], low, high) for normal, c, unit in self.seen(piece)]
        return self.inner_pieces[key]

    def forms_of(self, chart, low, high):
        """The mixtures, and the cubic form of their square."""
        key = chart, *low, *high
        if key not in self.forms:
            turns = mixtures(self.charts[chart], low, high)
            self.forms[key] = turns, raised([m[3][0] for m in turns], 3)
        return self.forms[key]

    def check(self, chart, low, high, positions, i, j, common):
        """Each position has a point of the obstacle that is inside the inner piece there. Both are convex, so each position
        between them has one."""
        piece, obstacle = self.claim.pair(i, j)
        inner = self.inner_piece(chart, low, high, piece)
        points = [numbers(point, 3) for point in items(common, len(positions))]
        obstacle.require_inside(points, [])
        for position, point in zip(positions, points):
            [x, y, z], [scale] = whole(minus(point, position), [1])
            require(all(a * x + b * y + c * z < most * scale for a, b, c, most in inner),
                    "a point of both pieces is not inside the robot")

    def check_drifting(self, chart, low, high, positions, i, j, common, drift):
        """The same for points that drift: by so much while a parameter goes from the middle of its range to the upper end. For each
        face of the robot, R n (point + drifts - position) - c times the square of the quaternion is a polynomial of degree 3 in each
        parameter; its Bernstein coefficients are below zero."""
        piece, obstacle = self.claim.pair(i, j)
        drift = [numbers(way, 3) for way in items(drift, 3)]
        points = [numbers(point, 3) for point in items(common, len(positions))]
        obstacle.require_inside(points, drift)
        *seen, [scale] = whole(*map(minus, points, positions), *drift, [1])
        seen, drift = seen[:-3], seen[-3:]
        turns, squares = self.forms_of(chart, low, high)
        for normal, c, unit in self.seen(piece):
            turned = [[dot(row, normal) * unit for row in m[:3]] for m in turns]
            along = [raised([dot(n, way) for n in turned], k) for k, way in enumerate(drift)]
            moves = [sum(coefficients) for coefficients in zip(*along, [-c * scale * square for square in squares])]
            still = [raised(component, 3) for component in zip(*turned)]
            require(all(a * x + b * y + c * z + move < 0 for x, y, z in seen for a, b, c, move in zip(*still, moves)),
                    "a point of both pieces is not inside the robot")


# Boxes of poses: three coordinates, and three parameters of a chart. In chart c component c of the quaternion is 1, and the
# others are the parameters.

PARAMETERS = [[e for e in range(4) if e != c] for c in range(4)]
CHARTS = [(axes(4)[c], [axes(4)[e] for e in PARAMETERS[c]]) for c in range(4)]


class PoseBoxes:
    """The boxes of a witness, each checked. They are trees, one for each chart, of (low, high, the sides of the boxes in it, its
    halves)."""

    def __init__(self, claim, cells):
        reference, bounds, outside, charts = fields(cells, "reference", "bounds", "outside", "charts")
        self.claim, self.reference = claim, numbers(reference, 3)
        self.blocking = Blocking(claim, CHARTS, self.reference)
        self.bounds = [numbers(corner, 3) for corner in items(bounds, 2)]
        require(all(a < b for a, b in zip(*self.bounds)), "the bounds are empty")
        if claim.box is not None:
            rooms = minus(claim.box[0], self.bounds[0]) + minus(self.bounds[1], claim.box[1])
            require(outside is None and all(room >= 0 and room ** 2 >= dot(self.reference, self.reference) for room in rooms),
                    "the bounds are too narrow for the reference point")
        else:
            require(outside in ("start", "goal"), "it is not said on which side the outside of the bounds is")
        self.outside, self.leaves = outside, []
        self.trees = [self.tree(cell, chart, self.bounds[0] + [-1] * 3, self.bounds[1] + [1] * 3)
                      for chart, cell in enumerate(items(charts, 4))]

    def tree(self, cell, chart, low, high):
        if has_key(cell, "halves"):
            axis, at, halves = fields(cell, "axis", "at", "halves")
            index(axis, 6)
            at = number(at)
            require(low[axis] < at < high[axis], "a box is cut outside of it")
            below, above = items(halves, 2)
            middle = [[at if k == axis else x for k, x in enumerate(end)] for end in (high, low)]
            halves = [self.tree(below, chart, low, middle[0]), self.tree(above, chart, middle[1], high)]
            return low, high, halves[0][2] | halves[1][2], halves
        side = self.side_of(cell, chart, low, high)
        self.leaves.append((side, chart, low, high))
        return low, high, {side}, []

    def side_of(self, cell, chart, low, high):
        """The side of a box that is not cut; None if no pose in it is free."""
        if has_key(cell, "side"):
            side = fields(cell, "side")[0]
            require(side in ("start", "goal"), "a box is on no side")
            at_bounds = any(low[k] == self.bounds[0][k] or high[k] == self.bounds[1][k] for k in range(3))
            require(self.outside in (None, side) or not at_bounds, "a box at the bounds is on another side than what is beyond")
            return side
        if has_key(cell, "beyond"):
            self.check_beyond(chart, low, high, index(fields(cell, "beyond")[0], 6))
        else:
            corners = [[(high if corner >> k & 1 else low)[k] for k in range(3)] for corner in range(8)]
            part = chart, low[3:], high[3:], corners
            if has_key(cell, "drift"):
                self.blocking.check_drifting(*part, *fields(cell, "robot", "obstacle", "common", "drift"))
            else:
                self.blocking.check(*part, *fields(cell, "robot", "obstacle", "common"))
        return None

    def check_beyond(self, chart, low, high, side):
        """The robot's origin, R(q) reference away from the positions of the box, is beyond a side of the claim's box."""
        require(self.claim.box is not None, "there is no box to be beyond")
        upper, k = divmod(side, 3)
        for m in mixtures(CHARTS[chart], low[3:], high[3:]):
            away = Fraction(dot(m[k], self.reference)) / m[3][0]
            require(low[k] - away > self.claim.box[1][k] if upper else high[k] - away < self.claim.box[0][k],
                    "a box is not beyond a side of the claim's box")

    def meets(self, box, side, low, high):
        """Whether a box on a side, this one or one in it, has inner points in common with another box; of an axis in which
        that one has no extent, its value."""
        own_low, own_high, sides, halves = box
        return (side in sides and all(a < y and x < b if x < y else a <= x <= b
                                      for a, b, x, y in zip(own_low, own_high, low, high))
                and (not halves or any(self.meets(half, side, low, high) for half in halves)))

    def check_facets(self):
        """No box on the side of the start has a facet, or a part of one with an extent, in common with one on that of the goal."""
        for side, chart, *box in self.leaves:
            for axis in range(6) if side == "start" else ():
                for end in box:
                    low, high = ([*x[:axis], end[axis], *x[axis + 1:]] for x in box)
                    there = chart
                    if axis > 2 and abs(end[axis]) == 1:
                        there, low, high = beyond_seam(chart, PARAMETERS[chart][axis - 3], end[axis], low, high)
                    require(not self.meets(self.trees[there], "goal", low, high),
                            "a box on the side of the start has a facet in common with one on that of the goal")

    def has(self, side, pose):
        """Whether some box on a side contains a pose."""
        position, q = pose
        [at] = rotated(q, [self.reference], position)
        if self.outside is not None and any(x < a or x > b for x, a, b in zip(at, *self.bounds)):
            return self.outside == side
        chart = max(range(4), key=lambda c: abs(q[c]))
        at = at + [Fraction(q[e]) / q[chart] for e in PARAMETERS[chart]]
        return self.meets(self.trees[chart], side, at, at)


def beyond_seam(c, e, end, low, high):
    """Where charts meet, component c = 1 and e = end; times the end, e = 1 and c = end. The chart beyond, and a box there."""
    values = {f: sorted((end * a, end * b)) for f, a, b in zip(PARAMETERS[c], low[3:], high[3:])}
    values[c] = end, end
    return e, *([*x[:3], *(values[f][k] for f in PARAMETERS[e])] for k, x in enumerate((low, high)))


def check_boxes(claim, cells):
    """A path that meets no blocked box can be moved off the edges of boxes, so it goes through facets, and stays on its
    side."""
    boxes = PoseBoxes(claim, cells)
    boxes.check_facets()
    for side, pose in zip(("start", "goal"), claim.poses):
        require(boxes.has(side, pose), f"the {side} is in no box on its side")
    return f"infeasible: {len(boxes.leaves)} boxes of poses separate start and goal"


# Layers of orientations, along a chain of arcs. In each, triangles of positions are blocked; where one layer follows on
# another one, tetrahedra fill what is between their triangles.

@functools.lru_cache(maxsize=1 << 16)  # triangles of a layer are compared with the layers before and behind it
def plane_ends(corners):
    """The ends of a triangle's edges, each with the line of its edge and the plane of the triangle. If these cancel out, so do the
    triangles as sets of points."""
    normal = unit(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])))
    return [(normal, dot(normal, corners[0]), end) for end in edge_ends(corners)]


def check_layers(claim, chain, places, layers):
    """The triangles at all orientations of their layers, and the tetrahedra, are a cycle modulo 2 in the space of poses, and no
    pose on it is free."""
    quaternions = [numbers(q, 4) for q in items(chain)]
    arcs = list(zip(quaternions, quaternions[1:]))
    require(arcs and all(dot(p, q) > 0 for p, q in arcs), "neighbours in a chain are at least a half turn apart")
    orientations = [unit(q) for q in quaternions]
    blocking = Blocking(claim, [arc(p, q) for p, q in arcs], [0, 0, 0])
    points, charts = fields(layers, "points", "charts")
    points = [numbers(point, 3) for point in items(points)]
    barriers, closings, firsts = [], [], []
    for chart, parts in enumerate(items(charts, len(arcs))):
        firsts.append(len(barriers))
        for low, high, barrier, closing in intervals(parts, -1, "barrier", "closing"):
            blocked = functools.partial(blocking.check, chart, [low], [high])
            barriers.append([simplex(claim, points, 3, triangle, blocked) for triangle in items(barrier)])
            blocked = functools.partial(blocking.check, chart, [high], [high])
            closings.append([simplex(claim, points, 4, solid, blocked) for solid in items(closing)])
    firsts.append(len(barriers) - 1)  # the last quaternion is in the last layer
    ends, *simplices = in_integers(points, claim, *barriers, *closings)
    barriers, closings = simplices[:len(barriers)], simplices[len(barriers):]

    for barrier, following, closing in zip(barriers, barriers[1:] + barriers[:1], closings):
        require(have_no_border(barrier), "the triangles of a layer have a border")
        sides = [solid[:k] + solid[k + 1:] for solid in closing for k in range(4)]
        is_open = closing is closings[-1] and (places is not None or orientations[0] != orientations[-1])
        require(not sides if is_open else cancel_out(end for triangle in barrier + following + sides for end in plane_ends(triangle)),
                "no layer follows on the last one" if is_open else "there is a gap between two layers")

    if places is not None:
        places = [index(place, len(quaternions)) for place in items(places, 2)]
    inside = []
    for end, (_, q) in enumerate(claim.poses):
        require(unit(q) in orientations, "the quaternion of a pose is not in the chain")
        place = orientations.index(unit(q)) if places is None else places[end]
        require(orientations[place] == unit(q), "the quaternion of a pose is not at its place in the chain")
        inside.append(crosses_odd(barriers[firsts[place]], ends[end]))
    require(inside[0] != inside[1], "start and goal are on the same side of the barrier")
    return f"infeasible: a barrier in {len(barriers)} layers of orientations separates start and goal"


def check_infeasible(claim, witness):
    if "rotations" not in claim:
        return check_no_translation(claim, witness)
    claim = PathClaim(claim, "rotations", *(["places"] if "places" in claim else []))
    rotations, *places = claim.others
    require(len(claim.poses) == 2, "expected start and goal")
    if rotations == "all":
        require(not places, "only a chain has places")
        return check_boxes(claim, fields(witness, "cells")[0])
    require(places != [None], "there are no places in the chain")
    return check_layers(claim, rotations, places[0] if places else None, fields(witness, "layers")[0])


# Cones of directions, in each of which contacts block the way.

def blocked_cone(piece, ours, other, theirs):
    """Two pieces with a point in common, each a weighted sum of its vertices: the first one overlaps the second one as soon as
    it moves in a direction of the inside of the cone of the vectors from the point to the second one and from the first one
    to the point. Returns the normals around that cone."""
    point = common_point(piece, ours, other, theirs, False)
    normals = outward_normals([minus(vertex, point) for vertex in other] + [minus(point, vertex) for vertex in piece])
    require(normals, "two pieces of a contact overlap, or are flat")
    return normals


def uncut_cones(octants, frame, middle):
    """All directions in cones of three vectors: octants, whose vector k is negated if bit k of the number is set. One with an
    `edge` is cut by what is in the middle between two of its vectors. Yields those that are not cut."""
    waiting = [(cone, [[-x for x in vector] if octant >> k & 1 else vector for k, vector in enumerate(frame)])
               for octant, cone in enumerate(items(octants, 8))]
    for cone, corners in waiting:
        if not has_key(cone, "edge"):
            yield cone, corners
            continue
        edge, halves = fields(cone, "edge", "halves")
        after = (index(edge, 3) + 1) % 3
        cut = middle(corners[edge], corners[after])
        waiting += [(half, [cut if k == end else corner for k, corner in enumerate(corners)])
                    for half, end in zip(items(halves, 2), (after, edge))]


# What cannot begin to move: in each cone of directions all parts are tied together.

def check_contact(parts, contact):
    """Returns both parts and the normals around the cone of directions that is blocked."""
    first, second, common = fields(contact, "first", "second", "common")
    touching = []
    for piece, weights in zip((first, second), fields(common, "first", "second")):
        part, place = items(piece, 2)
        its_pieces = parts[index(part, len(parts))]
        touching += [its_pieces[index(place, len(its_pieces))].vertices, weights]
    require(first[0] != second[0], "a part does not touch itself")
    return first[0], second[0], blocked_cone(*touching)


def reaches_all(count, ties, start):
    """Whether all parts are reached from the first one, by ties from their end `start` to the other one."""
    known, waiting = {0}, [0]
    for part in waiting:
        new = {tie[1 - start] for tie in ties if tie[start] == part} - known
        known |= new
        waiting += new
    return len(known) == count


def check_inseparable(claim, witness):
    _, named = fields(claim, "status", "parts")
    claimed = [fields(part, "name", "pieces") for part in items(named)]
    names, parts = [name for name, _ in claimed], [pieces(its_pieces) for _, its_pieces in claimed]
    require(all(isinstance(name, str) for name in names) and len(set(names)) == len(names), "parts have names, each its own")
    require(len(parts) > 1, "the claim has less than two parts")
    given, octants = fields(witness, "contacts", "octants")
    contacts = [check_contact(parts, contact) for contact in items(given)]
    for count, (cone, corners) in enumerate(uncut_cones(octants, axes(3), lambda a, b: [x + y for x, y in zip(a, b)]), 1):
        ties = []
        for way, blocked in zip((1, -1), fields(cone, "first_blocked", "second_blocked")):
            for contact in items(blocked):
                a, b, normals = contacts[index(contact, len(contacts))]
                require(all(way * dot(normal, corner) < 0 for normal in normals for corner in corners),
                        "a contact does not block all directions of a cone")
                ties.append((a, b)[::way])
        require(all(reaches_all(len(parts), ties, start) for start in (0, 1)), "in some directions a set of parts is not blocked")
    return f"inseparable: no set of {len(parts)} parts can begin to move, in {count} cones of directions"


# Tight passages: in each cone one contact blocks all that does not lead along the passage.

def tight_frame(along):
    """Three vectors that span space, those of the passage first."""
    frame = axes(3)
    if len(along) == 1 and any(along[0]):
        first = next(k for k in range(3) if along[0][k])
        frame[first] = frame[0]
        return [along[0], *frame[1:]]
    if len(along) == 2:
        frame = [*along, cross(*along)]
    require(len(along) in (0, 2) and all(map(any, frame)), "a passage needs at most two vectors, linearly independent")
    return frame


def is_along(along, direction):
    """Whether a direction is in the span of the vectors of the passage."""
    if len(along) == 2:
        return dot(cross(*along), direction) == 0
    return len(along) == 1 and unit(along[0]) == unit(direction)


def tight_contact(claim, position, contact):
    """The normals around the cone of directions that a contact blocks: of two pieces, or at a side of the box."""
    if has_key(contact, "side"):
        side = index(fields(contact, "side")[0], 6)
        upper, axis = divmod(side, 3)
        require(claim.box is not None and position[axis] == claim.box[upper][axis], "the position is not on that side of the box")
        return [[(-1 if upper else 1) * x for x in axes(3)[axis]]]
    i, j, common = fields(contact, "robot", "obstacle", "common")
    piece, obstacle = claim.pair(i, j)
    ours, theirs = fields(common, "robot", "obstacle")
    return blocked_cone(rotated([1, 0, 0, 0], piece.vertices, position), ours, obstacle.vertices, theirs)


def balanced_sum(a, b):
    """The sum, the shorter one first multiplied by the largest power of two with which it is not the longer one."""
    lengths = [Fraction(sum(map(abs, v))) for v in (a, b)]
    ratio = lengths[1] / lengths[0]
    up, down = (max(0, math.floor(r).bit_length() - 1) for r in (ratio, 1 / ratio))
    return [x * 2 ** up + y * 2 ** down for x, y in zip(a, b)]


def check_tight(claim, witness):
    claim = PathClaim(claim, "along")
    passages = [[numbers(vector, 3) for vector in items(along)] for along in items(claim.others[0], len(claim.poses))]
    require(claim.contact_allowed, "without contact no passage is tight")
    places = items(fields(witness, "places")[0], len(claim.poses))
    for pose, along, place in zip(claim.poses, passages, places):
        position, quaternion = pose
        require(quaternion == [1, 0, 0, 0] and claim.in_box(position), "a pose is turned, or outside the box")
        planes, given, octants = fields(place, "planes", "contacts", "octants")
        check_part(claim, Motion(pose, pose), Fraction(0), Fraction(1), planes)
        contacts = [tight_contact(claim, position, contact) for contact in items(given)]
        for cone, corners in uncut_cones(octants, tight_frame(along), balanced_sum):
            normals = contacts[index(fields(cone, "contact")[0], len(contacts))]
            for corner in corners:
                sides = {sign(dot(normal, corner)) for normal in normals}
                require(sides <= ({-1, 0} if is_along(along, corner) else {-1}),
                        "a contact does not block all directions of a cone")
    return f"tight: {len(places)} passage" + "s" * (len(places) != 1)


# Files.

CHECKS = {"path": check_free_path, "blocked": check_blocked_path, "infeasible": check_infeasible,
          "inseparable": check_inseparable, "tight": check_tight}


def check(text, claim_digest=None):
    """What is proved, and the digest of the claim. Raises Refused."""
    try:
        root = json.loads(text, object_pairs_hook=unique_keys)
    except (ValueError, RecursionError) as error:
        raise Refused(f"this is no JSON: {error}") from None
    version, claim, witness = fields(root, "nef_proof", "claim", "witness")
    require(type(version) is int and version == 1, "unknown version of the format")
    digest = hashlib.sha256(json.dumps(claim, sort_keys=True, separators=(",", ":")).encode()).hexdigest()
    require(claim_digest in (None, digest), f"this proves another claim, {digest}")
    status = claim.get("status") if isinstance(claim, dict) else None
    require(isinstance(status, str) and status in CHECKS, "unknown status")
    return CHECKS[status](claim, witness), digest


def main():
    if hasattr(sys, "set_int_max_str_digits"):
        sys.set_int_max_str_digits(0)  # numbers of a proof may be long
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--claim", metavar="SHA256", help="the claim that is expected")
    arguments = parser.parse_args()
    try:
        with open(arguments.file, encoding="utf-8") as file:
            text = file.read()
    except (OSError, ValueError) as error:
        print(f"check.py: {error}", file=sys.stderr)
        return 2
    try:
        proved, digest = check(text, arguments.claim)
    except Refused as refused:
        print(f"refused: {refused}")
        return 1
    print(f"{proved}\nclaim {digest}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
