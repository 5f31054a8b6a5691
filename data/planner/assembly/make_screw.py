#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a bolt in a nut to standard output, as an assembly for `planner --assembly` in which parts may turn.

The thread is a row of hulls between triangles that go round the axis; the thread of the nut is that of the bolt, larger
by a clearance, cut out of a block. The clearance must be more than what the chords of the thread are off the circle.

    make_screw.py [PIECES PER TURN] [TURNS] [CLEARANCE] > screw.json
"""
import json
import math
import sys


def point(angle, radius, height):
    return [round(radius * math.cos(angle), 3), round(radius * math.sin(angle), 3), round(height, 3)]


def thread(pieces, turns, radius, depth, pitch, half, low, clearance):
    """Hulls whose triangles have their tip outside; a column inside, from `low`, through all of the thread."""
    ring = []
    for i in range(pieces):
        ring += point(2 * math.pi * i / pieces, radius + clearance, low)
    high = low + pitch * turns + 2
    top = [high if i % 3 == 2 else x for i, x in enumerate(ring)]
    parts = ["hull(%s)" % ", ".join(map(str, ring + top))]
    for i in range(pieces * turns):
        corners = []
        for k in (i, i + 1):
            angle = 2 * math.pi * k / pieces
            height = pitch * k / pieces
            for side in (-half - clearance, half + clearance):
                corners += point(angle, radius / 2, height + side) + point(angle, radius + clearance, height + side)
            corners += point(angle, radius + depth + clearance, height)
        parts.append("hull(%s)" % ", ".join(map(str, corners)))
    return "(" + " + ".join(parts) + ")"


def main():
    pieces = int(sys.argv[1]) if len(sys.argv) > 1 else 12
    turns = int(sys.argv[2]) if len(sys.argv) > 2 else 2
    clearance = float(sys.argv[3]) if len(sys.argv) > 3 else 0.25
    pitch, radius, depth, half = 3, 4, 1, 0.6
    bolt = thread(pieces, turns, radius, depth, pitch, half, -1.5, 0)
    # The thread of the nut goes on below and above its block.
    hole = "translate(%s, 0,0,%d)" % (thread(pieces, turns + 2, radius, depth, pitch, half, -1.5, clearance), -pitch)
    nut = "box(-7,-7,1, 7,7,%d) - %s" % (pitch * turns - 1, hole)
    print(json.dumps({"parts": {"bolt": bolt, "nut": nut}, "rotation": "SO(3)"}, indent=1))


main()
