#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a burr of six pieces to standard output, as an assembly for `planner --assembly`.

Six sticks of 2 x 2 x 6 cross each other in pairs. Each cube that several sticks claim is given to one of them, at random
but for the seed, until all pieces are connected and no piece but the key, an unnotched stick, can leave alone at first.

    make_burr.py [SEED] > burr.json
"""
import itertools
import json
import random
import sys


def stick(axis, side):
    """The cubes (by their low corners) of a stick along an axis, of the pair's lower (0) or upper (1) one."""
    across, along = {0: (1, 2), 1: (2, 0), 2: (0, 1)}[axis]
    ranges = [None] * 3
    ranges[axis] = range(-3, 3)
    ranges[across] = range(-1, 1)
    ranges[along] = range(-2, 0) if side == 0 else range(0, 2)
    return set(itertools.product(*ranges))


def connected(cubes):
    todo, seen = [next(iter(cubes))], set()
    while todo:
        cube = todo.pop()
        if cube in seen:
            continue
        seen.add(cube)
        for axis, step in itertools.product(range(3), (1, -1)):
            other = tuple(c + (step if i == axis else 0) for i, c in enumerate(cube))
            if other in cubes:
                todo.append(other)
    return len(seen) == len(cubes)


def leaves_straight(piece, others):
    for axis, step in itertools.product(range(3), (1, -1)):
        if all(tuple(c + (step * k if i == axis else 0) for i, c in enumerate(cube)) not in others
               for cube in piece for k in range(1, 9)):
            return True
    return False


def make(seed):
    generator = random.Random(seed)
    sticks = [stick(axis, side) for axis in range(3) for side in range(2)]
    while True:
        pieces = [set() for _ in sticks]
        for cube in sorted(set().union(*sticks)):
            owners = [i for i, s in enumerate(sticks) if cube in s]
            pieces[0 if 0 in owners else generator.choice(owners)].add(cube)
        if not all(connected(piece) for piece in pieces):
            continue
        others = [set().union(*(q for q in pieces if q is not p)) for p in pieces]
        if [leaves_straight(p, o) for p, o in zip(pieces, others)] == [True] + [False] * 5:
            return sticks, pieces


def bars(cubes):
    """The cubes as few boxes: runs along x, equal runs beside each other joined along y."""
    boxes = []
    left = set(cubes)
    while left:
        x, y, z = low = min(left)
        end = x
        while (end, y, z) in left:
            end += 1
        top = y
        while all((k, top, z) in left for k in range(x, end)):
            top += 1
        left -= {(a, b, z) for a in range(x, end) for b in range(y, top)}
        boxes.append((low, (end, top, z + 1)))
    return boxes


def main():
    _, pieces = make(int(sys.argv[1]) if len(sys.argv) > 1 else 1)
    names = ["key", "b", "c", "d", "e", "f"]
    text = {name: " + ".join("box(%d,%d,%d, %d,%d,%d)" % (low + high) for low, high in bars(piece))
            for name, piece in zip(names, pieces)}
    print(json.dumps({"parts": text}, indent=2))


if __name__ == "__main__":
    main()
