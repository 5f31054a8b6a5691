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


def mixed_rotation(p, q):
    """B(p, q) / <p, q>, where B(q, q) / <q, q> is the rotation matrix of q and B is symmetric and bilinear."""
    def m(i, j):
        return p[i] * q[j] + p[j] * q[i]
    w, x, y, z = (m(i, i) for i in range(4))
    rows = [[w + x - y - z, 2 * (m(1, 2) - m(0, 3)), 2 * (m(1, 3) + m(0, 2))],
            [2 * (m(1, 2) + m(0, 3)), w - x + y - z, 2 * (m(2, 3) - m(0, 1))],
            [2 * (m(1, 3) - m(0, 2)), 2 * (m(2, 3) + m(0, 1)), w - x - y + z]]
    return [[Fraction(entry) / (2 * dot(p, q)) for entry in row] for row in rows]


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


# That there is no path of a robot that turns: boxes of poses. A box has intervals of three coordinates and of three parameters
# of a chart of quaternions, origin + sum t_k directions[k], each t_k from -1 to 1.

UNITS = [[int(i == k) for i in range(4)] for k in range(4)]


def rotation_form(q):
    """The rotation matrix of a quaternion times its square, and a row with the square."""
    w, x, y, z = q
    return [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z], [dot(q, q)]]


def whole(rows):
    """Numbers times a positive integer that makes them integers."""
    scale = math.lcm(*(x.denominator for row in rows for x in row))
    return [[int(x * scale) for x in row] for row in rows]


class Rotations:
    """The orientations of a claim as charts: all of them, or arcs from each quaternion of a chain to the next one. A seam
    says where two charts meet: chart, axis of the box and end of it, the same beyond, a sign, and pairs of other axes."""

    def __init__(self, value):
        self.chain = [] if value == "all" else [numbers(q, 4) for q in items(value)]
        if value == "all":
            self.parameters = [[e for e in range(4) if e != c] for c in range(4)]
            self.charts = [(UNITS[c], [UNITS[e] for e in self.parameters[c]]) for c in range(4)]
            self.seams = [self.seam(c, e, end) for c in range(4) for e in range(c + 1, 4) for end in (1, -1)]
            return
        pairs = list(zip(self.chain, self.chain[1:]))
        require(pairs and all(dot(p, q) > 0 for p, q in pairs), "neighbours in a chain are at least a half turn apart")
        self.charts = [(between(p, q, Fraction(1, 2)), [[x / 2 for x in map(Fraction, minus(q, p))]]) for p, q in pairs]
        self.seams = [(i, 3, 1, i + 1, 3, -1, 1, []) for i in range(len(pairs) - 1)]
        if self.same(self.chain[0], self.chain[-1]):
            self.seams.append((len(pairs) - 1, 3, 1, 0, 3, -1, 1, []))

    def seam(self, c, e, end):
        """Quaternions with components c = 1 and e = end; times the end, e = 1 and c = end."""
        def axis(chart, component):
            return 3 + self.parameters[chart].index(component)
        others = [(axis(c, f), axis(e, f)) for f in range(4) if f not in (c, e)]
        return c, axis(c, e), end, e, axis(e, c), end, end, others

    @staticmethod
    def same(p, q):
        return all(p[i] * q[j] == p[j] * q[i] for i in range(4) for j in range(i))

    def locate(self, q):
        """A chart, and the parameters of a quaternion in it."""
        if not self.chain:
            chart = max(range(4), key=lambda c: abs(q[c]))
            return chart, [Fraction(q[e]) / q[chart] for e in self.parameters[chart]]
        place = next((i for i, p in enumerate(self.chain) if self.same(p, q)), None)
        require(place is not None, "the quaternion of a pose is not in the chain")
        return (place, [-1]) if place < len(self.charts) else (place - 1, [1])

    def mixed(self, chart, low, high):
        """Every rotation of a box is a mixture of these matrices (the Bernstein coefficients of the quadratic form, divided
        by those of the square): at the ends and in the middle of each parameter, less the form of half of the edge for
        each middle. Each is four rows of integers: three of the matrix, and its positive divisor."""
        origin, directions = self.charts[chart]
        result = []
        for index in range(3 ** len(directions)):
            ends = [index // 3 ** k % 3 for k in range(len(directions))]
            at = [Fraction((2 - end) * low[k] + end * high[k]) / 2 for k, end in enumerate(ends)]
            rows = rotation_form([x + sum(t * d[i] for t, d in zip(at, directions)) for i, x in enumerate(origin)])
            for k, end in enumerate(ends):
                if end == 1:
                    edge = rotation_form([x * Fraction(high[k] - low[k]) / 2 for x in directions[k]])
                    rows = [minus(row, less) for row, less in zip(rows, edge)]
            require(rows[3][0] > 0, "a blocked box has too many orientations")
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


class PoseBoxes:
    """The boxes of a witness: checks each, and that no box on the side of the start has a facet in common with one on that of
    the goal."""

    def __init__(self, claim, rotations, cells):
        reference, bounds, outside, charts = fields(cells, "reference", "bounds", "outside", "charts")
        self.claim, self.rotations, self.reference = claim, rotations, numbers(reference, 3)
        self.bounds = [numbers(corner, 3) for corner in items(bounds, 2)]
        require(all(a < b for a, b in zip(*self.bounds)), "the bounds are empty")
        if claim.box is not None:
            rooms = minus(claim.box[0], self.bounds[0]) + minus(self.bounds[1], claim.box[1])
            require(outside is None and all(room >= 0 and room ** 2 >= dot(self.reference, self.reference) for room in rooms),
                    "the bounds are too narrow for the reference point")
        else:
            require(outside in ("start", "goal"), "it is not said on which side the outside of the bounds is")
        self.outside, self.leaves, self.faces, self.normals = outside, 0, {}, {}
        self.trees = [self.tree(cell, chart, self.bounds[0] + [-1] * 3, self.bounds[1] + [1] * 3)
                      for chart, cell in enumerate(items(charts, len(rotations.charts)))]

    def tree(self, cell, chart, low, high):
        """A box as (low, high, the sides of the boxes in it, its halves)."""
        if isinstance(cell, dict) and "halves" in cell:
            axis, at, halves = fields(cell, "axis", "at", "halves")
            index(axis, 3 + len(self.rotations.charts[0][1]))
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
            self.check_blocked(chart, low, high, *fields(cell, "robot", "obstacle", "common"))
        return low, high, set(), []

    def faces_of(self, kind, i):
        if (kind, i) not in self.faces:
            piece = self.claim.robot[i] if kind == "robot" else self.claim.obstacles[i]
            self.faces[kind, i] = faces([minus(v, self.reference) for v in piece] if kind == "robot" else piece)
        return self.faces[kind, i]

    def inner_piece(self, chart, low, high, i):
        """Half-spaces n x < c of integers, as (*n, c), whose points are inside the piece at all orientations of the box."""
        key = chart, *low[3:], *high[3:], i
        if key not in self.normals:
            mixed = self.rotations.mixed(chart, low[3:], high[3:])
            self.normals[key] = [(*(dot(row, normal) * c.denominator for row in m[:3]), c.numerator * m[3][0])
                                 for normal, c in self.faces_of("robot", i) for m in mixed]
        return self.normals[key]

    def check_blocked(self, chart, low, high, i, j, common):
        """Each corner of the box of positions has a point of the obstacle that is inside the inner piece there. Both are
        convex, so each position has one."""
        index(i, len(self.claim.robot))
        obstacle = self.faces_of("obstacle", index(j, len(self.claim.obstacles)))
        inner = self.inner_piece(chart, low, high, i)
        for corner, point in enumerate(items(common, 8)):
            point = numbers(point, 3)
            require(all(dot(n, point) <= c for n, c in obstacle), "a point of a blocked box is not in the obstacle")
            seen = minus(point, [(high if corner >> k & 1 else low)[k] for k in range(3)])
            scale = math.lcm(*(x.denominator for x in seen))
            x, y, z = (int(x * scale) for x in seen)
            require(all(a * x + b * y + c * z < most * scale for a, b, c, most in inner),
                    "a point of a blocked box is not inside the robot")

    def check_beyond(self, chart, low, high, side):
        """The robot's origin, R(q) reference away from the positions of the box, is beyond a side of the claim's box."""
        require(self.claim.box is not None, "there is no box to be beyond")
        upper, k = divmod(side, 3)
        for m in self.rotations.mixed(chart, low[3:], high[3:]):
            away = Fraction(dot(m[k], self.reference)) / m[3][0]
            require(low[k] - away > self.claim.box[1][k] if upper else high[k] - away < self.claim.box[0][k],
                    "a box is not beyond a side of the claim's box")

    @staticmethod
    def facet_along(axis, a, b):
        """Whether the upper facet of one box has an inner point in common with the lower one of another."""
        return a[1][axis] == b[0][axis] and all(a[0][k] < b[1][k] and b[0][k] < a[1][k] for k in range(6) if k != axis)

    @staticmethod
    def facet_at(seam, a, b):
        """The same of boxes of two charts."""
        _, here, end, _, there, other_end, sign, others = seam
        if a[(1 + end) // 2][here] != end or b[(1 + other_end) // 2][there] != other_end:
            return False
        spans = [(a[0][k], a[1][k], k) for k in range(3)]
        spans += [(*sorted((sign * a[0][k], sign * a[1][k])), other) for k, other in others]
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
        chart, parameters = self.rotations.locate(q)
        at = at + parameters + [0] * (3 - len(parameters))
        open_trees = [self.trees[chart]]
        for low, high, sides, halves in open_trees:
            if side in sides and all(a <= x <= b for a, x, b in zip(low, at, high)):
                if not halves:
                    return True
                open_trees += halves
        return False


def check_no_rigid_path(claim, witness):
    """A path that meets no blocked box can be moved off the edges of boxes, so it goes through facets, and stays on its
    side."""
    rotations = Rotations(claim["rotations"])
    claim = PathClaim({key: value for key, value in claim.items() if key != "rotations"})
    require(len(claim.poses) == 2, "expected start and goal")
    boxes = PoseBoxes(claim, rotations, fields(witness, "cells")[0])
    for seam in rotations.seams:
        boxes.require_apart(boxes.trees[seam[0]], boxes.trees[seam[3]], lambda a, b, seam=seam: boxes.facet_at(seam, a, b))
    for side, pose in zip(("start", "goal"), claim.poses):
        require(boxes.has(side, pose), f"the {side} is in no box on its side")
    return f"infeasible: {boxes.leaves} boxes of poses separate start and goal"


# That no set of parts can begin to move: cones of directions in each of which all parts are tied together.

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


def check_contact(parts, contact):
    """Two pieces with a point in common. The first one overlaps the second one as soon as it moves in a direction of the
    inside of the cone of the vectors from the point to the second one and from the first one to the point. Returns both
    parts and the normals around that cone."""
    first, second, common = fields(contact, "first", "second", "common")
    found = []
    for piece, weights in zip((first, second), fields(common, "first", "second")):
        part, place = items(piece, 2)
        vertices = parts[index(part, len(parts))][index(place, len(parts[part]))]
        found.append((part, vertices, weighted_sum(vertices, numbers(weights, len(vertices)), False)))
    (a, piece, point), (b, other, same) = found
    require(a != b and point == same, "two pieces have not the point in common")
    normals = outer_planes([minus(vertex, point) for vertex in other] + [minus(point, vertex) for vertex in piece])
    require(normals, "two pieces of a contact overlap, or are flat")
    return a, b, normals


def reaches_all(count, ties, start):
    """Whether all parts are reached from the first one, by ties from their end `start` to the other one."""
    known, waiting = {0}, [0]
    while waiting:
        part = waiting.pop()
        new = {tie[1 - start] for tie in ties if tie[start] == part} - known
        known |= new
        waiting += new
    return len(known) == count


def check_cone(count, contacts, cone, corners):
    """In all directions that three vectors span, each set of parts is blocked by another part. Returns the number of
    cones that are not cut."""
    if isinstance(cone, dict) and "edge" in cone:
        edge, halves = fields(cone, "edge", "halves")
        after = (index(edge, 3) + 1) % 3
        middle = [x + y for x, y in zip(corners[edge], corners[after])]
        first, second = items(halves, 2)
        return sum(check_cone(count, contacts, half, [middle if k == end else corner for k, corner in enumerate(corners)])
                   for half, end in ((first, after), (second, edge)))
    ties = []
    for way, blocked in zip((1, -1), fields(cone, "first_blocked", "second_blocked")):
        for contact in items(blocked):
            a, b, normals = contacts[index(contact, len(contacts))]
            require(all(way * dot(normal, corner) < 0 for normal in normals for corner in corners),
                    "a contact does not block all directions of a cone")
            ties.append((a, b)[::way])
    require(all(reaches_all(count, ties, start) for start in (0, 1)), "in some directions a set of parts is not blocked")
    return 1


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
    cones = sum(check_cone(len(parts), contacts, cone,
                           [[(-1 if octant >> k & 1 else 1) if i == k else 0 for i in range(3)] for k in range(3)])
                for octant, cone in enumerate(items(octants, 8)))
    return f"inseparable: no set of {len(parts)} parts can begin to move, in {cones} cones of directions"


# That passages are tight: cones of directions in each of which one contact blocks all that does not lead along the passage.

def tight_frame(along):
    """Three vectors that span space, those of the passage first."""
    axes = [[int(i == k) for i in range(3)] for k in range(3)]
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
    point = weighted_sum(piece, numbers(ours, len(piece)), False)
    require(point == weighted_sum(obstacle, numbers(theirs, len(obstacle)), False), "two pieces have not the point in common")
    normals = outer_planes([minus(vertex, point) for vertex in obstacle] + [minus(point, vertex) for vertex in piece])
    require(normals, "two pieces of a contact overlap, or are flat")
    return normals


def balanced_sum(a, b):
    """The sum, the shorter one first multiplied by the largest power of two with which it is not the longer one."""
    lengths = [Fraction(sum(map(abs, v))) for v in (a, b)]
    ratio = lengths[1] / lengths[0]
    up, down = (max(0, math.floor(r).bit_length() - 1) for r in (ratio, 1 / ratio))
    return [x * 2 ** up + y * 2 ** down for x, y in zip(a, b)]


def check_tight_cone(along, contacts, cone, corners):
    if isinstance(cone, dict) and "edge" in cone:
        edge, halves = fields(cone, "edge", "halves")
        after = (index(edge, 3) + 1) % 3
        middle = balanced_sum(corners[edge], corners[after])
        first, second = items(halves, 2)
        for half, end in ((first, after), (second, edge)):
            check_tight_cone(along, contacts, half, [middle if k == end else corner for k, corner in enumerate(corners)])
        return
    normals = contacts[index(fields(cone, "contact")[0], len(contacts))]
    for corner in corners:
        sides = {sign(dot(normal, corner)) for normal in normals}
        require(sides <= ({-1, 0} if is_along(along, corner) else {-1}), "a contact does not block all directions of a cone")


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
        frame = tight_frame(along)
        for octant, cone in enumerate(items(octants, 8)):
            corners = [[-x for x in vector] if octant >> k & 1 else vector for k, vector in enumerate(frame)]
            check_tight_cone(along, contacts, cone, corners)
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
