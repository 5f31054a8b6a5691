# SPDX-License-Identifier: Apache-2.0
"""Every option of every program is an argument in Python, or the table says what takes its place, or why nothing does."""
import importlib
import inspect
import os
import pathlib
import re
import subprocess

import pytest

PRINTS = "about what a program prints"
STUDIO = "the page and its server are the program's"
RUN = {
    "--help": "help(), and inspect.signature",
    "--version": "nef.__version__",
    "--json": PRINTS,
    "--quiet": PRINTS,
    "--threads": "nef.unite_all(threads)",
    "--repeat": "timeit repeats calls",
}
MESHES = {
    "--strict": "nef.read(strict)",
    "--as-surface": "nef.read(surface)",
    "--crossings": "nef.read(crossings)",
    "--close": "nef.read(close)",
    "--close-holes": "nef.read(close)",
}
FILES = {
    "--output": "nef.Polyhedron.write(path)",
    "--exact": "nef.Polyhedron.write(exact)",
    "--binary": "nef.Polyhedron.write(binary)",
    "--text": "nef.Polyhedron.write(text)",
    "--manifold": "nef.Polyhedron.write(manifold)",
    "--recenter": "nef.Polyhedron.write(recenter)",
    "--lenient": "nef.Polyhedron.write(lenient)",
    "--polygons": "nef.Polyhedron.write(polygons)",
    "--format": "nef.Polyhedron.write(format)",
}
TILES = {
    "--tiles": "nef.TiledPolyhedron.__init__(limit)",
    "--memory": "nef.read_tiles(memory)",
}
NEF = {
    **RUN, **MESHES, **FILES, **TILES,
    "--origins": "nef.mesh_with_origins(sets)",
    "--translate": "nef.Polyhedron.translate(by)",
    "--scale": "nef.Polyhedron.scale(factors)",
    "--rotate": "nef.Polyhedron.rotate(degrees)",
    "--matrix": "nef.Polyhedron.transform(matrix)",
    "--glued": "nef.TiledPolyhedron.polyhedron()",
    "--fill-holes": "nef.repair(fill_holes)",
    "--record": "the field `faces` of what nef.repair returns",
    "--triangles": "nef.remeshing.decimate(triangles)",
    "--times": "nef.remeshing.subdivide(times)",
    "--scheme": "nef.remeshing.subdivide(scheme)",
    "--plane": "nef.Polyhedron.section(normal)",
    "--volumes": "nef.Polyhedron.split(by)",
    "--above": "nef.Polyhedron.split(above)",
    "--largest": "nef.Polyhedron.largest_piece()",
    "--file": "read the text of the file, for nef.eval",
    "--steps": "the operators of nef.TiledPolyhedron, one after the other",
    "--from": "nef.notebook.picture(direction)",
    "--section": "nef.notebook.picture(section)",
    "--size": "nef.notebook.picture(width)",
    "--root": STUDIO,
    "--run": STUDIO,
    "--port": STUDIO,
    "--no-browser": STUDIO,
    "--time": STUDIO,
}
PROGRAMS = {
    "nef": NEF,
    "minkowski": {
        **RUN, **MESHES, **FILES,
        "--open-a": "nef.Polyhedron.interior()",
        "--open-b": "nef.Polyhedron.interior()",
        "--negate-b": "nef.minkowski.negate(a)",
        "--hull-b": "nef.minkowski.hull(a)",
        "--ball": "nef.minkowski.ball(radius)",
        "--box-tool": "nef.box(low)",
        "--union": "nef.minkowski.sum(union)",
        "--memory": "nef.read_tiles(memory), and nef.minkowski.sum of a TiledPolyhedron",
        "--erode": "nef.minkowski.erode(b)",
        "--open": "nef.minkowski.opening(b)",
        "--close": "nef.minkowski.closing(b)",
        "--offset": "nef.minkowski.offset(radius)",
        "--decimate": "nef.minkowski.simplified_offset(triangles)",
        "--digits": "nef.minkowski.simplified_offset(digits)",
        "--inner": "nef.minkowski.offset(side)",
        "--outer": "nef.minkowski.offset(side)",
        "--sweep": "nef.minkowski.sweep(path)",
        "--hull": "nef.minkowski.hull(a)",
        "--penetration": "nef.minkowski.penetration(b)",
        "--no-fit": "nef.minkowski.no_fit(b)",
        "--reach": "nef.minkowski.reach(tool)",
        "--from": "nef.minkowski.reach(start)",
        "--touched": "the field `touched` of what nef.minkowski.reach returns",
        "--untouched": "the field `untouched` of what nef.minkowski.reach returns",
        "--labels": "the fields of what nef.minkowski.reach and millable return",
        "--millable": "nef.minkowski.millable(tool)",
        "--axes": "nef.minkowski.millable(axes)",
        "--decompose": "nef.minkowski.decompose(a)",
        "--configuration-space": "nef.minkowski.configuration_space(robot)",
        "--robot": "nef.minkowski.configuration_space(robot)",
        "--obstacles": "nef.minkowski.configuration_space(obstacles)",
        "--box": "nef.minkowski.configuration_space(box)",
        "--report": "nef.minkowski.sum(report)",
        "--exact-volume": "nef.Polyhedron.volume()",
        "--preview": "nef.show, and pictures in notebooks",
    },
    "planner": {
        **RUN, **MESHES, **FILES,
        "--linkage": "nef.planner.Linkage.certify(path)",
        "--srdf": "nef.planner.Linkage.read(srdf)",
        "--obstacle": "nef.planner.Linkage.certify(obstacles)",
        "--exact": "nef.planner.verdict(exact)",
        "--assembly": "nef.planner.disassemble(parts)",
        "--simultaneous": "nef.planner.disassemble(simultaneous)",
        "--free-directions": "nef.planner.free_directions(part)",
        "--range": "nef.planner.range_of_motion(moving)",
        "--verdict": "nef.planner.verdict(parts)",
        "--output": "way-points are numbers in Python",
        "--page": "nef.show shows sets; pages in which a robot moves are the program's",
        "--tight": "nef.planner.Scene.passages()",
        "--turn-freely": "nef.planner.read(turn_freely)",
        "--path": "nef.planner.Scene.certify(path)",
        "--queries": "call nef.planner.Scene.plan for each; free space is computed once",
        "--start": "nef.planner.Scene.plan(start)",
        "--goal": "nef.planner.Scene.plan(goal)",
        "--contact": "nef.planner.Scene.__init__(contact)",
        "--prefer": "nef.planner.Scene.plan(roomy)",
        "--min-dimension": "nef.planner.Scene.plan(min_dimension)",
        "--raw": "nef.planner.Scene.plan(raw)",
        "--quick": "nef.planner.Scene.plan(quick)",
        "--digits": "nef.planner.Scene.plan(digits)",
        "--clearance": "nef.planner.Scene.plan(clearance)",
        "--se3": "about the program's files",
        "--max-cells": "nef.planner.Scene.plan(max_cells)",
        "--proof": "nef.planner.Scene.prove(path)",
        "--check-proof": "nef.planner.Scene.complaint(text)",
        "--widest": "nef.planner.Scene.widest(growth)",
        "--widest-box": "nef.planner.Scene.widest(growth)",
        "--precision": "nef.planner.Scene.widest(precision)",
        "--keep-clear": "nef.planner.Scene.keep_clear(distance)",
        "--speed": "about the program's files",
        "--acceleration": "about the program's files",
        "--ompl": "OMPL has bindings of its own",
        "--benchmark": "OMPL has bindings of its own",
        "--planners": "OMPL has bindings of its own",
        "--runs": "OMPL has bindings of its own",
        "--time": "nef.planner.Scene.plan(seconds)",
    },
    "visual_hull": {
        **RUN, **MESHES, **FILES,
        "--check": "nef.visual_hull.read fails, or returns views with their images",
        "--up": "nef.visual_hull.read(up)",
        "--matrices": "nef.visual_hull.read(matrices)",
        "--turntable": "nef.visual_hull.read(turntable)",
        "--K": "nef.visual_hull.read(intrinsics)",
        "--radius": "nef.visual_hull.read(radius)",
        "--height": "nef.visual_hull.read(height)",
        "--images": "nef.visual_hull.read(images)",
        "--without": "nef.visual_hull.read(without)",
        "--frames": "call nef.visual_hull.compute for each frame",
        "--silhouette": "scenes may have polygons in place of images",
        "--threshold": "nef.visual_hull.read(threshold)",
        "--channel": "nef.visual_hull.read(channel)",
        "--mask": "nef.visual_hull.read(mask)",
        "--repair-masks": "nef.visual_hull.read(repair_masks)",
        "--invert": "nef.visual_hull.read(invert)",
        "--pixel-origin": "nef.visual_hull.compute(half_pixels)",
        "--border": "nef.visual_hull.compute(unknown_beyond)",
        "--soft": "nef.visual_hull.compute(soft)",
        "--min-area": "nef.visual_hull.compute(min_area)",
        "--simplify": "nef.visual_hull.compute(tolerance)",
        "--outer": "nef.visual_hull.compute(outer)",
        "--box": "nef.visual_hull.compute(box)",
        "--decimate": "nef.remeshing.decimate(triangles)",
        "--color": "colours of vertices are the program's",
        "--texture": "nef.visual_hull.read(texture)",
        "--verify": "nef.visual_hull.compute(verify)",
        "--way": "nef.visual_hull.read(way)",
        "--refine": "nef.visual_hull.read(refine)",
        "--refined-scene": "the field `refinement` of what nef.visual_hull.read returns",
        "--suspects": "nef.visual_hull.compute(suspects)",
        "--drop-suspects": "nef.visual_hull.compute(drop_suspects)",
        "--at-least": "nef.visual_hull.compute(at_least)",
        "--largest": "nef.visual_hull.compute(largest)",
        "--exact-volume": "nef.Polyhedron.volume()",
        "--report": "the fields of what nef.visual_hull.compute returns",
        "--overlay": "pictures of views are the program's",
        "--page": "nef.show shows the hull; pages with its cameras are the program's",
        "--picture": "notebooks show pictures of sets; those with colours are the program's",
        "--points": "files of points are the program's",
        "--samples": "files of points are the program's",
        "--hull-masks": "masks of the hull for other programs are the program's",
        "--overview": "pictures of masks are the program's",
        "--board": "nef.visual_hull.board(description)",
        "--lens": "nef.visual_hull.calibrate(lens)",
    },
}


def help_of(*words):
    program = pathlib.Path(os.environ.get("NEF_PROGRAM_DIR", "")) / words[0]
    if not program.is_file():
        pytest.skip(f"no program {words[0]} beside the package")
    return subprocess.run([str(program), *words[1:], "--help"], capture_output=True, text=True, check=True).stdout


def options_of(*words):
    """The long options that begin a line of a help text, the last of several names."""
    lines = re.findall(r"^ +(?:-\w(?:,| ))?((?:--[\w-]+(?:,|\b))+)", help_of(*words), re.MULTILINE)
    return [name for line in lines for name in line.split(",") if name]


def commands_of(program):
    if program == "nef":
        listed = help_of("nef").split("Subcommands:")[-1]
        return [(program, word) for word in re.findall(r"^  ([a-z]+) ", listed, re.MULTILINE)]
    return [(program, word) for word in ("masks", "board", "calibrate", "combine")] if program == "visual_hull" else []


@pytest.mark.parametrize("program", sorted(PROGRAMS))
def test_options_are_arguments(program, needs):
    if program != "nef":
        needs(program)
    known = PROGRAMS[program]
    seen = set()
    for words in [(program,), *commands_of(program)]:
        options = options_of(*words)
        assert "--help" in options
        seen.update(options)
        for option in options:
            assert option in known, f"{' '.join(words)} {option}: which argument is it in Python, or why is there none?"
    shared = {*RUN, *MESHES, *FILES}
    assert set(known) - seen - shared == set(), "options that the program does not have"


@pytest.mark.parametrize("program", sorted(PROGRAMS))
def test_arguments_exist(program, needs):
    for option, place in PROGRAMS[program].items():
        match = re.fullmatch(r"nef\.([\w.]+)\((\w*)\)", place)
        if match is None:
            assert " " in place or place == "nef.__version__", place
            continue
        path, argument = match.groups()
        owner = importlib.import_module("nef")
        if path.split(".")[0] in ("minkowski", "planner", "remeshing", "visual_hull"):
            needs(path.split(".")[0])
        for name in path.split("."):
            owner = getattr(owner, name)
        assert not argument or argument in inspect.signature(owner).parameters, f"{option}: {place}"
