#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Replays a .proof file of the planner in exact arithmetic, with Python's standard library alone.

    check.py FILE [--claim SHA256]

Prints what is proved and the SHA-256 of the claim, and exits with 0; with 1 if the proof does not hold, or if --claim
names another claim; with 2 if the file cannot be read. docs/proofs.md says what a claim means, docs/how/proofs.md why this proves it.
"""
import argparse
import collections
import hashlib
import json
import math
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


def items(value, count=None):
    require(isinstance(value, list) and count in (None, len(value)), f"expected a list of {count or 'any number'}")
    return value


def number(value):
    """Each number has one spelling, a fraction in lowest terms, so that equal claims have equal digests. Integers are of
    type int, which is faster; so whoever divides makes a Fraction first."""
    well_formed = isinstance(value, str) and re.fullmatch("-?[0-9]+(/[1-9][0-9]*)?", value)
    fraction = Fraction(value) if well_formed else None
    require(well_formed and str(fraction) == value, f"numbers are strings such as '1/3', not {value!r}")
    return fraction.numerator if fraction.denominator == 1 else fraction


def numbers(value, count=None):
    return [number(x) for x in items(value, count)]


def index(value, count):
    require(type(value) is int and 0 <= value < count, f"there is no item {value!r} of {count}")
    return value


def pieces(value):
    result = [[numbers(vertex, 3) for vertex in items(piece)] for piece in items(value)]
    require(all(result), "a piece has no vertices")
    return result


# Vectors and rotations. A quaternion is w, x, y, z, of any length.

def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def integral(a):
    """The vector times the least positive number that makes all its components integers."""
    scale = math.lcm(*(x.denominator for x in a))
    return [int(x * scale) for x in a]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def between(a, b, s):
    return [(1 - s) * x + s * y for x, y in zip(a, b)]


def rotation_form(q):
    """The rotation matrix of a quaternion times its square, and a row with the square."""
    w, x, y, z = q
    return [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z], [dot(q, q)]]


def mixed_rotation(p, q):
    """B(p, q) / <p, q>, where B(q, q) / <q, q> is the rotation matrix of q and B is symmetric and bilinear."""
    forms = (rotation_form([x + y for x, y in zip(p, q)]), rotation_form(p), rotation_form(q))
    *rows, [scale] = [minus(minus(both, one), other) for both, one, other in zip(*forms)]
    return [[Fraction(entry) / scale for entry in row] for row in rows]


def placed(turn, vertex, position):
    return [dot(row, vertex) + at for row, at in zip(turn, position)]


def is_flat(piece):
    """Whether all vertices lie in one plane."""
    sides = [minus(vertex, piece[0]) for vertex in piece[1:]]
    normals = (cross(a, b) for i, a in enumerate(sides) for b in sides[:i])
    normal = next((n for n in normals if any(n)), [0, 0, 0])
    return all(dot(normal, side) == 0 for side in sides)


# How far a motion has come when its rotation is at a parameter of the arc: angles, enclosed by rational numbers.

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
        product = dot(self.p, self.q)
        self.turns = product ** 2 != dot(self.p, self.p) * dot(self.q, self.q)
        if not self.turns:
            self.q = self.p
        elif product < 0:
            self.q = [-x for x in self.q]

    def quaternion(self, s):
        return between(self.p, self.q, s)

    def position(self, time):
        return between(self.start, self.end, time)

    def times(self, s):
        """Two bounds of the part of the way that is done when the rotation is at parameter s."""
        if not self.turns or s in (0, 1):
            return s, s
        r, least = self.quaternion(s), half_angle(self.p, self.q, False)
        low = rounded(half_angle(self.p, r, False) / half_angle(self.p, self.q, True), False)
        return low, min(1, rounded(half_angle(self.p, r, True) / least, True)) if least else 1


# Paths.

class PathClaim:
    def __init__(self, value):
        _, contact, box, robot, obstacles, path = fields(value, "status", "contact", "box", "robot", "obstacles", "path")
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
        self.flat = [is_flat(piece) for piece in self.robot], [is_flat(piece) for piece in self.obstacles]

    def in_box(self, position):
        return self.box is None or all(a <= x <= b for a, x, b in zip(self.box[0], position, self.box[1]))

    def may_touch(self, i, j):
        """Solid pieces may touch, if contact is allowed; flat ones never."""
        return self.contact_allowed and not self.flat[0][i] and not self.flat[1][j]


def are_apart(a, b, may_touch, planes):
    """Whether one of the planes, given by their normals, has a below it and b above it."""
    for normal in planes:
        top, bottom = max(dot(normal, v) for v in a), min(dot(normal, v) for v in b)
        if any(normal) and (top < bottom or may_touch and top == bottom):
            return True
    return False


AXES = [[sign if k == axis else 0 for k in range(3)] for axis in range(3) for sign in (1, -1)]


def check_part(claim, motion, start, end, given):
    """Every pair of pieces is apart from parameter start to end: enclosed by the images of each vertex by the rotations
    at both ends and the mixed one between them, at both ends of an interval that has the positions."""
    planes = {}
    for plane in items(given):
        i, j, normal = fields(plane, "robot", "obstacle", "normal")
        planes[index(i, len(claim.robot)), index(j, len(claim.obstacles))] = numbers(normal, 3)
    p, q = motion.quaternion(start), motion.quaternion(end)
    require(dot(p, q) > 0, "a part turns too far")
    turns = [mixed_rotation(p, p), mixed_rotation(p, q), mixed_rotation(q, q)]
    positions = [motion.position(motion.times(start)[0]), motion.position(motion.times(end)[1])]
    for i, piece in enumerate(claim.robot):
        swept = [placed(turn, vertex, position) for vertex in piece for turn in turns for position in positions]
        for j, obstacle in enumerate(claim.obstacles):
            normals = AXES + [planes[i, j]] if (i, j) in planes else AXES
            require(are_apart(swept, obstacle, claim.may_touch(i, j), normals), f"nothing separates pieces {i} and {j}")


def check_free_path(claim, witness):
    require(all(claim.in_box(position) for position, _ in claim.poses), "a pose is outside the box")
    motions = items(fields(witness, "motions")[0], len(claim.motions))
    for motion, parts in zip(claim.motions, motions):
        start = Fraction(0)
        for part in items(parts):
            until, planes = fields(part, "until", "planes")
            end = number(until)
            require(start < end <= 1, "the parts of a motion do not go up to 1")
            check_part(claim, motion, start, end, planes)
            start = end
        require(start == 1, "the parts of a motion do not go up to 1")
    return f"path: all {len(motions)} motions are free"


def weighted_sum(points, weights, positive):
    require(all(w > 0 if positive else w >= 0 for w in weights) and sum(weights) == 1,
            "weights must be positive and add up to 1")
    return [dot(weights, coordinates) for coordinates in zip(*points)]


def check_blocked_path(claim, witness):
    if isinstance(witness, dict) and "outside" in witness:
        pose = index(fields(witness, "outside")[0], len(claim.poses))
        require(not claim.in_box(claim.poses[pose][0]), "the pose is in the box")
        return f"blocked: pose {pose} is outside the box"
    m, parameter, times, i, j, common = fields(fields(witness, "collision")[0], "motion", "parameter", "times", "robot",
                                               "obstacle", "common")
    motion = claim.motions[index(m, len(claim.motions))]
    piece, obstacle = claim.robot[index(i, len(claim.robot))], claim.obstacles[index(j, len(claim.obstacles))]
    s = number(parameter)
    require(0 <= s <= 1, "the parameter is not between 0 and 1")
    times = numbers(times, 2)
    low, high = motion.times(s)
    require(times[0] <= low and high <= times[1], "the position is not where the proof says")
    turn = mixed_rotation(motion.quaternion(s), motion.quaternion(s))
    for time, point in zip(times, items(common, 2)):
        ours, theirs = fields(point, "robot", "obstacle")
        here = [placed(turn, vertex, motion.position(time)) for vertex in piece]
        inside = claim.may_touch(i, j)
        require(weighted_sum(here, numbers(ours, len(here)), inside) ==
                weighted_sum(obstacle, numbers(theirs, len(obstacle)), inside), "the pieces have not the point in common")
    return f"blocked: motion {m} collides at parameter {parameter}"


# That there is no path: a barrier of triangles.

def beyond_a_side(box, corners):
    return box is not None and any(all(p[k] < box[0][k] for p in corners) or all(p[k] > box[1][k] for p in corners)
                                   for k in range(3))


def check_triangle(claim, points, triangle):
    """No position on the triangle is free: it lies beyond a side of the box, or two pieces overlap at its corners, and so
    on all of it. Returns the numbers of the corners."""
    if isinstance(triangle, dict) and set(triangle) == {"corners"}:
        corners = [index(c, len(points)) for c in items(triangle["corners"], 3)]
        require(beyond_a_side(claim.box, [points[c] for c in corners]), "a triangle may be passed")
        return corners
    given, i, j, common = fields(triangle, "corners", "robot", "obstacle", "common")
    corners = [index(c, len(points)) for c in items(given, 3)]
    piece, obstacle = claim.robot[index(i, len(claim.robot))], claim.obstacles[index(j, len(claim.obstacles))]
    require(not claim.contact_allowed or claim.may_touch(i, j), "a flat piece bars nothing where contact is allowed")
    for corner, point in zip(corners, items(common, 3)):
        ours, theirs = fields(point, "robot", "obstacle")
        require(minus(weighted_sum(obstacle, numbers(theirs, len(obstacle)), claim.contact_allowed),
                      weighted_sum(piece, numbers(ours, len(piece)), claim.contact_allowed)) == points[corner],
                "the pieces have not the point in common")
    return corners


def sign(x):
    return (x > 0) - (x < 0)


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


def check_infeasible(claim, witness):
    """Triangles whose edges occur an even number of times are a cycle modulo 2; what it separates is told by rays."""
    points, triangles = fields(fields(witness, "barrier")[0], "points", "triangles")
    points = [numbers(point, 3) for point in items(points)]
    require(len(claim.poses) == 2 and all(q == [1, 0, 0, 0] for _, q in claim.poses), "expected start and goal, not turned")
    found = [check_triangle(claim, points, triangle) for triangle in items(triangles)]
    edges = collections.Counter(tuple(sorted(edge)) for a, b, c in found for edge in ((a, b), (b, c), (c, a)))
    require(all(count % 2 == 0 for count in edges.values()), "an edge is one of an odd number of triangles")
    placed_triangles = [[points[c] for c in corners] for corners in found]
    sides = [crosses_odd(placed_triangles, position) for position, _ in claim.poses]
    require(sides[0] != sides[1], "start and goal are on the same side of the barrier")
    return f"infeasible: {len(found)} triangles separate start and goal"


# That there is no path of a robot that turns. A chart is a set of quaternions, origin + sum t_k directions[k], each t_k from
# -1 to 1; a part of one is a box of parameters.

UNITS = [[int(i == k) for i in range(4)] for k in range(4)]


def whole(rows):
    """Numbers times a positive integer that makes them integers."""
    scale = math.lcm(*(x.denominator for row in rows for x in row))
    return [[int(x * scale) for x in row] for row in rows]


def mixtures(chart, low, high):
    """Every rotation of a part of a chart is a mixture of these matrices (the Bernstein coefficients of the quadratic form,
    divided by those of the square): at the ends and in the middle of each parameter, less the form of half of the edge for
    each middle. Each is four rows of integers: three of the matrix, and its positive divisor."""
    origin, directions = chart
    result = []
    for number_of_mixture in range(3 ** len(directions)):
        ends = [number_of_mixture // 3 ** k % 3 for k in range(len(directions))]
        at = [Fraction((2 - end) * low[k] + end * high[k]) / 2 for k, end in enumerate(ends)]
        rows = rotation_form([x + sum(t * d[i] for t, d in zip(at, directions)) for i, x in enumerate(origin)])
        for k, end in enumerate(ends):
            if end == 1:
                edge = rotation_form([x * Fraction(high[k] - low[k]) / 2 for x in directions[k]])
                rows = [minus(row, less) for row, less in zip(rows, edge)]
        require(rows[3][0] > 0, "what is blocked has too many orientations")
        result.append(whole(rows))
    return result


def faces(piece):
    """The half-spaces n x <= c of a solid piece, found by trying all planes through three vertices."""
    require(not is_flat(piece), "a flat piece blocks nothing")
    scale = math.lcm(*(x.denominator for vertex in piece for x in vertex))
    vertices = [[int(x * scale) for x in vertex] for vertex in piece]
    found = {}
    for i, a in enumerate(vertices):
        for j in range(i):
            for k in range(j):
                normal = cross(minus(vertices[j], a), minus(vertices[k], a))
                heights = [dot(normal, minus(v, a)) for v in vertices]
                if any(normal) and (max(heights) == 0 or min(heights) == 0):
                    length = math.gcd(*normal) * (1 if max(heights) == 0 else -1)
                    normal = [x // length for x in normal]
                    found[tuple(normal)] = Fraction(dot(normal, a), scale)
    return list(found.items())


class Blocking:
    """Shows that pieces overlap at all orientations of a part of a chart, and at all positions of the reference point in the
    hull of some."""

    def __init__(self, claim, charts, reference):
        self.claim, self.charts, self.reference = claim, charts, reference
        self.faces, self.normals = {}, {}

    def faces_of(self, kind, i):
        if (kind, i) not in self.faces:
            piece = self.claim.robot[i] if kind == "robot" else self.claim.obstacles[i]
            self.faces[kind, i] = faces([minus(v, self.reference) for v in piece] if kind == "robot" else piece)
        return self.faces[kind, i]

    def inner_piece(self, chart, low, high, i):
        """Half-spaces n x < c of integers, as (*n, c), whose points are inside the piece at all of the orientations."""
        key = chart, *low, *high, i
        if key not in self.normals:
            mixed = mixtures(self.charts[chart], low, high)
            self.normals[key] = [(*(dot(row, normal) * c.denominator for row in m[:3]), c.numerator * m[3][0])
                                 for normal, c in self.faces_of("robot", i) for m in mixed]
        return self.normals[key]

    def check(self, chart, low, high, positions, i, j, common):
        """Each position has a point of the obstacle that is inside the inner piece there. Both are convex, so each position
        between them has one."""
        index(i, len(self.claim.robot))
        obstacle = self.faces_of("obstacle", index(j, len(self.claim.obstacles)))
        inner = self.inner_piece(chart, low, high, i)
        for position, point in zip(positions, items(common, len(positions))):
            point = numbers(point, 3)
            require(all(dot(n, point) <= c for n, c in obstacle), "a point of both pieces is not in the obstacle")
            seen = minus(point, position)
            scale = math.lcm(*(x.denominator for x in seen))
            x, y, z = (int(x * scale) for x in seen)
            require(all(a * x + b * y + c * z < most * scale for a, b, c, most in inner),
                    "a point of both pieces is not inside the robot")


# About all axes: boxes of poses, of three coordinates and three parameters of a chart.

# Quaternions with component c = 1; the others are the parameters.
PARAMETERS = [[e for e in range(4) if e != c] for c in range(4)]
CHARTS = [(UNITS[c], [UNITS[e] for e in PARAMETERS[c]]) for c in range(4)]


def seam(c, e, end):
    """Where charts meet, component c = 1 and e = end; times the end, e = 1 and c = end. Chart, axis of the box and end of it,
    the same beyond, and pairs of other axes, whose values are multiplied by the end."""
    def axis(chart, component):
        return 3 + PARAMETERS[chart].index(component)
    return c, axis(c, e), e, axis(e, c), end, [(axis(c, f), axis(e, f)) for f in range(4) if f not in (c, e)]


class PoseBoxes:
    """The boxes of a witness: checks each, and that no box on the side of the start has a facet in common with one on that of
    the goal."""

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
        self.outside, self.leaves = outside, 0
        self.trees = [self.tree(cell, chart, self.bounds[0] + [-1] * 3, self.bounds[1] + [1] * 3)
                      for chart, cell in enumerate(items(charts, 4))]

    def tree(self, cell, chart, low, high):
        """A box as (low, high, the sides of the boxes in it, its halves)."""
        if isinstance(cell, dict) and "halves" in cell:
            axis, at, halves = fields(cell, "axis", "at", "halves")
            index(axis, 6)
            at = number(at)
            require(low[axis] < at < high[axis], "a box is cut outside of it")
            below, above = items(halves, 2)
            middle = [[at if k == axis else x for k, x in enumerate(end)] for end in (high, low)]
            halves = [self.tree(below, chart, low, middle[0]), self.tree(above, chart, middle[1], high)]
            self.require_apart(*halves, lambda a, b: self.facet_along(axis, a, b))
            return low, high, halves[0][2] | halves[1][2], halves
        self.leaves += 1
        if isinstance(cell, dict) and "side" in cell:
            side = fields(cell, "side")[0]
            require(side in ("start", "goal"), "a box is on no side")
            at_bounds = any(low[k] == self.bounds[0][k] or high[k] == self.bounds[1][k] for k in range(3))
            require(self.outside in (None, side) or not at_bounds, "a box at the bounds is on another side than what is beyond")
            return low, high, {side}, []
        if isinstance(cell, dict) and "beyond" in cell:
            self.check_beyond(chart, low, high, index(fields(cell, "beyond")[0], 6))
        else:
            corners = [[(high if corner >> k & 1 else low)[k] for k in range(3)] for corner in range(8)]
            self.blocking.check(chart, low[3:], high[3:], corners, *fields(cell, "robot", "obstacle", "common"))
        return low, high, set(), []

    def check_beyond(self, chart, low, high, side):
        """The robot's origin, R(q) reference away from the positions of the box, is beyond a side of the claim's box."""
        require(self.claim.box is not None, "there is no box to be beyond")
        upper, k = divmod(side, 3)
        for m in mixtures(CHARTS[chart], low[3:], high[3:]):
            away = Fraction(dot(m[k], self.reference)) / m[3][0]
            require(low[k] - away > self.claim.box[1][k] if upper else high[k] - away < self.claim.box[0][k],
                    "a box is not beyond a side of the claim's box")

    @staticmethod
    def facet_along(axis, a, b):
        """Whether the upper facet of one box has an inner point in common with the lower one of another."""
        return a[1][axis] == b[0][axis] and all(a[0][k] < b[1][k] and b[0][k] < a[1][k] for k in range(6) if k != axis)

    @staticmethod
    def facet_at(at, a, b):
        """The same of boxes of two charts."""
        _, here, _, there, end, others = at
        if a[(1 + end) // 2][here] != end or b[(1 + end) // 2][there] != end:
            return False
        spans = [(a[0][k], a[1][k], k) for k in range(3)]
        spans += [(*sorted((end * a[0][k], end * a[1][k])), other) for k, other in others]
        return all(low < b[1][k] and b[0][k] < high for low, high, k in spans)

    def require_apart(self, a, b, have_facet):
        """No box in a on one side has a facet in common with one in b on the other side."""
        if len(a[2] | b[2]) < 2 or not a[2] or not b[2] or not have_facet(a, b):
            return
        require(a[3] or b[3], "a box on the side of the start has a facet in common with one on that of the goal")
        for half in a[3] or b[3]:
            self.require_apart(half, b, have_facet) if a[3] else self.require_apart(a, half, have_facet)

    def has(self, side, pose):
        """Whether some box on a side contains a pose."""
        position, q = pose
        at = placed(mixed_rotation(q, q), self.reference, position)
        if self.outside is not None and any(x < a or x > b for x, a, b in zip(at, *self.bounds)):
            return self.outside == side
        chart = max(range(4), key=lambda c: abs(q[c]))
        at = at + [Fraction(q[e]) / q[chart] for e in PARAMETERS[chart]]
        open_trees = [self.trees[chart]]
        for low, high, sides, halves in open_trees:
            if side in sides and all(a <= x <= b for a, x, b in zip(low, at, high)):
                if not halves:
                    return True
                open_trees += halves
        return False


def check_boxes(claim, cells):
    """A path that meets no blocked box can be moved off the edges of boxes, so it goes through facets, and stays on its
    side."""
    boxes = PoseBoxes(claim, cells)
    for at in [seam(c, e, end) for c in range(4) for e in range(c + 1, 4) for end in (1, -1)]:
        boxes.require_apart(boxes.trees[at[0]], boxes.trees[at[2]], lambda a, b, at=at: boxes.facet_at(at, a, b))
    for side, pose in zip(("start", "goal"), claim.poses):
        require(boxes.has(side, pose), f"the {side} is in no box on its side")
    return f"infeasible: {boxes.leaves} boxes of poses separate start and goal"


# Along a chain of arcs: layers of orientations. In each, triangles of positions are blocked; where one layer follows on
# another one, tetrahedra fill what is between their triangles.

def are_parallel(p, q):
    return all(p[i] * q[j] == p[j] * q[i] for i in range(4) for j in range(i))


def unit(v):
    """The shortest integer vector that is parallel to one, its first number that is not zero positive."""
    v = integral(v)
    length = math.gcd(*v) * (1 if next((x for x in v if x), 0) > 0 else -1)
    require(length, "a triangle has no extent")
    return tuple(x // length for x in v)


def edge_ends(corners):
    """The ends of a triangle's edges, each with the line of its edge. If these cancel out modulo 2 over some triangles, so do
    the edges as sets of points, however they are cut."""
    for a, b in zip(corners, corners[1:] + corners[:1]):
        along = unit(minus(b, a))
        line = along, *cross(a, along)
        yield line, *a
        yield line, *b


def plane_ends(corners):
    """The same with the plane of the triangle. If these cancel out, so do the triangles."""
    normal = unit(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])))
    return [(normal, dot(normal, corners[0]), end) for end in edge_ends(corners)]


def cancel_out(ends):
    return all(count % 2 == 0 for count in collections.Counter(ends).values())


class Layers:
    """Checks the layers of a witness: that all in them is blocked, and that it is a cycle modulo 2 of poses."""

    def __init__(self, claim, chain, places, layers):
        quaternions = [numbers(q, 4) for q in items(chain)]
        arcs = list(zip(quaternions, quaternions[1:]))
        require(arcs and all(dot(p, q) > 0 for p, q in arcs), "neighbours in a chain are at least a half turn apart")
        self.quaternions = quaternions
        self.places = None if places is None else [index(place, len(quaternions)) for place in items(places, 2)]
        self.closed = places is None and are_parallel(quaternions[0], quaternions[-1])
        charts = [(between(p, q, Fraction(1, 2)), [[x / 2 for x in map(Fraction, minus(q, p))]]) for p, q in arcs]
        points, given = fields(layers, "points", "charts")
        self.claim, self.blocking = claim, Blocking(claim, charts, [0, 0, 0])
        self.points = [numbers(point, 3) for point in items(points)]
        self.barriers, self.closings, self.first = [], [], []
        for chart, parts in enumerate(items(given, len(charts))):
            self.first.append(len(self.barriers))
            self.add_chart(chart, items(parts))
        self.first.append(len(self.barriers))
        self.check_cycle()

    def add_chart(self, chart, parts):
        low = -1
        for part in parts:
            until, barrier, closing = fields(part, "until", "barrier", "closing")
            high = number(until)
            require(low < high <= 1, "the layers of a chart do not go from -1 up to 1")
            self.barriers.append([self.simplex(3, chart, low, high, given) for given in items(barrier)])
            self.closings.append([self.simplex(4, chart, high, high, given) for given in items(closing)])
            low = high
        require(low == 1, "the layers of a chart do not go from -1 up to 1")

    def simplex(self, count, chart, low, high, given):
        """The corners of a triangle or tetrahedron: beyond a side of the box, or two pieces overlap on all of it."""
        hit = isinstance(given, dict) and "robot" in given
        numbers_of_corners, *pair = fields(given, "corners", *(("robot", "obstacle", "common") if hit else ()))
        corners = [self.points[index(c, len(self.points))] for c in items(numbers_of_corners, count)]
        if hit:
            self.blocking.check(chart, [low], [high], corners, *pair)
        require(hit or beyond_a_side(self.claim.box, corners), "a position in a layer may be free")
        return corners

    def check_cycle(self):
        for i, (barrier, closing) in enumerate(zip(self.barriers, self.closings)):
            require(cancel_out(end for triangle in barrier for end in edge_ends(triangle)), "the triangles of a layer have a border")
            if i + 1 == len(self.barriers) and not self.closed:
                require(not closing, "no layer follows on the last one")
                return
            sides = [solid[:k] + solid[k + 1:] for solid in closing for k in range(4)]
            triangles = barrier + self.barriers[(i + 1) % len(self.barriers)] + sides
            require(cancel_out(end for triangle in triangles for end in plane_ends(triangle)), "there is a gap between two layers")

    def is_inside(self, end):
        """Whether a ray from the start (0) or the goal (1) crosses the triangles of its layer an odd number of times."""
        position, q = self.claim.poses[end]
        place = next((i for i, p in enumerate(self.quaternions) if are_parallel(p, q)), None) if self.places is None else self.places[end]
        require(place is not None and are_parallel(self.quaternions[place], q), "the quaternion of a pose is not in the chain")
        return crosses_odd(self.barriers[min(self.first[place], len(self.barriers) - 1)], position)


def check_layers(claim, chain, places, witness):
    """The triangles at all orientations of their layers, and the tetrahedra, are a cycle modulo 2 in the space of poses, and no
    pose on it is free. What it separates is told by rays."""
    layers = Layers(claim, chain, places, witness)
    require(layers.is_inside(0) != layers.is_inside(1), "start and goal are on the same side of the barrier")
    return f"infeasible: a barrier in {len(layers.barriers)} layers of orientations separates start and goal"


def check_no_rigid_path(claim, witness):
    rotations, places = claim["rotations"], claim.get("places")
    require(places is not None or "places" not in claim, "there are no places in the chain")
    claim = PathClaim({key: value for key, value in claim.items() if key not in ("rotations", "places")})
    require(len(claim.poses) == 2, "expected start and goal")
    if rotations != "all":
        return check_layers(claim, rotations, places, fields(witness, "layers")[0])
    require(places is None, "only a chain has places")
    return check_boxes(claim, fields(witness, "cells")[0])


# Cones of directions, in each of which contacts block the way.

def outer_planes(vectors):
    """The outward normals of the planes through two of the vectors that have all of them on one side: those around the
    cone that the vectors span, if that is neither flat nor all of space."""
    vectors = [integral(v) for v in vectors]
    found = []
    for i, u in enumerate(vectors):
        for v in vectors[:i]:
            normal = cross(u, v)
            sides = {sign(dot(normal, w)) for w in vectors}
            if sides in ({0, -1}, {0, 1}):
                found.append(normal if -1 in sides else minus([0, 0, 0], normal))
    return found


def blocked_cone(piece, ours, other, theirs):
    """Two pieces with a point in common, each a weighted sum of its vertices: the first one overlaps the second one as soon as
    it moves in a direction of the inside of the cone of the vectors from the point to the second one and from the first one
    to the point. Returns the normals around that cone."""
    point = weighted_sum(piece, numbers(ours, len(piece)), False)
    require(point == weighted_sum(other, numbers(theirs, len(other)), False), "two pieces have not the point in common")
    normals = outer_planes([minus(vertex, point) for vertex in other] + [minus(point, vertex) for vertex in piece])
    require(normals, "two pieces of a contact overlap, or are flat")
    return normals


def uncut_cones(octants, frame, middle):
    """All directions in cones of three vectors: octants, whose vector k is negated if bit k of the number is set. One with an
    `edge` is cut by what is in the middle between two of its vectors. Yields those that are not cut."""
    waiting = [(cone, [[-x for x in vector] if octant >> k & 1 else vector for k, vector in enumerate(frame)])
               for octant, cone in enumerate(items(octants, 8))]
    for cone, corners in waiting:
        if not isinstance(cone, dict) or "edge" not in cone:
            yield cone, corners
            continue
        edge, halves = fields(cone, "edge", "halves")
        after = (index(edge, 3) + 1) % 3
        cut = middle(corners[edge], corners[after])
        waiting += [(half, [cut if k == end else corner for k, corner in enumerate(corners)])
                    for half, end in zip(items(halves, 2), (after, edge))]


AXES_OF_SPACE = [[int(i == k) for i in range(3)] for k in range(3)]


# That no set of parts can begin to move: in each cone all parts are tied together.

def check_contact(parts, contact):
    """Returns both parts and the normals around the cone of directions that is blocked."""
    first, second, common = fields(contact, "first", "second", "common")
    pieces_of_contact = []
    for piece, weights in zip((first, second), fields(common, "first", "second")):
        part, place = items(piece, 2)
        pieces_of_contact += [parts[index(part, len(parts))][index(place, len(parts[part]))], weights]
    require(first[0] != second[0], "a part does not touch itself")
    return first[0], second[0], blocked_cone(*pieces_of_contact)


def reaches_all(count, ties, start):
    """Whether all parts are reached from the first one, by ties from their end `start` to the other one."""
    known, waiting = {0}, [0]
    while waiting:
        part = waiting.pop()
        new = {tie[1 - start] for tie in ties if tie[start] == part} - known
        known |= new
        waiting += new
    return len(known) == count


def check_inseparable(claim, witness):
    _, named = fields(claim, "status", "parts")
    names, parts = [], []
    for part in items(named):
        name, its_pieces = fields(part, "name", "pieces")
        require(isinstance(name, str) and name not in names, "parts have names, each its own")
        names.append(name)
        parts.append(pieces(its_pieces))
    require(len(parts) > 1, "the claim has less than two parts")
    given, octants = fields(witness, "contacts", "octants")
    contacts = [check_contact(parts, contact) for contact in items(given)]
    count = 0
    for cone, corners in uncut_cones(octants, AXES_OF_SPACE, lambda a, b: [x + y for x, y in zip(a, b)]):
        ties = []
        for way, blocked in zip((1, -1), fields(cone, "first_blocked", "second_blocked")):
            for contact in items(blocked):
                a, b, normals = contacts[index(contact, len(contacts))]
                require(all(way * dot(normal, corner) < 0 for normal in normals for corner in corners),
                        "a contact does not block all directions of a cone")
                ties.append((a, b)[::way])
        require(all(reaches_all(len(parts), ties, start) for start in (0, 1)), "in some directions a set of parts is not blocked")
        count += 1
    return f"inseparable: no set of {len(parts)} parts can begin to move, in {count} cones of directions"


# That passages are tight: in each cone one contact blocks all that does not lead along the passage.

def tight_frame(along):
    """Three vectors that span space, those of the passage first."""
    axes = list(AXES_OF_SPACE)
    if len(along) == 1 and any(along[0]):
        first = next(k for k in range(3) if along[0][k])
        axes[first] = axes[0]
        return [along[0], *axes[1:]]
    frame = [*along, cross(*along)] if len(along) == 2 else axes
    require(len(along) in (0, 2) and all(map(any, frame)), "a passage needs at most two vectors, linearly independent")
    return frame


def is_along(along, direction):
    """Whether a direction is in the span of the vectors of the passage."""
    if len(along) == 2:
        return dot(cross(*along), direction) == 0
    return len(along) == 1 and not any(cross(along[0], direction))


def tight_contact(claim, position, contact):
    """The normals around the cone of directions that a contact blocks: of two pieces, or at a side of the box."""
    if isinstance(contact, dict) and "side" in contact:
        side = index(fields(contact, "side")[0], 6)
        upper, axis = divmod(side, 3)
        require(claim.box is not None and position[axis] == claim.box[upper][axis], "the position is not on that side of the box")
        return [[(-1 if upper else 1) if k == axis else 0 for k in range(3)]]
    i, j, common = fields(contact, "robot", "obstacle", "common")
    piece = [[x + at for x, at in zip(vertex, position)] for vertex in claim.robot[index(i, len(claim.robot))]]
    obstacle = claim.obstacles[index(j, len(claim.obstacles))]
    ours, theirs = fields(common, "robot", "obstacle")
    return blocked_cone(piece, ours, obstacle, theirs)


def balanced_sum(a, b):
    """The sum, the shorter one first multiplied by the largest power of two with which it is not the longer one."""
    lengths = [Fraction(sum(map(abs, v))) for v in (a, b)]
    ratio = lengths[1] / lengths[0]
    up, down = (max(0, math.floor(r).bit_length() - 1) for r in (ratio, 1 / ratio))
    return [x * 2 ** up + y * 2 ** down for x, y in zip(a, b)]


def check_tight(claim, witness):
    require(isinstance(claim, dict) and "along" in claim, "the claim does not say along what passages lead")
    passages = [[numbers(vector, 3) for vector in items(along)] for along in items(claim["along"])]
    claim = PathClaim({key: value for key, value in claim.items() if key != "along"})
    require(claim.contact_allowed, "without contact no passage is tight")
    places = items(fields(witness, "places")[0], len(claim.poses))
    require(len(passages) == len(claim.poses), "each pose needs the vectors of its passage")
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


def of_path(check_witness):
    return lambda claim, witness: check_witness(PathClaim(claim), witness)


def check_any_infeasible(claim, witness):
    return check_no_rigid_path(claim, witness) if "rotations" in claim else of_path(check_infeasible)(claim, witness)


CHECKS = {"path": of_path(check_free_path), "blocked": of_path(check_blocked_path),
          "infeasible": check_any_infeasible, "inseparable": check_inseparable, "tight": check_tight}


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
