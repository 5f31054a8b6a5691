#!/usr/bin/env python3
"""Runs the suite's main jobs on data/ and writes an index page of the results.

Usage: demo.py PROGRAM_DIRECTORY OUTPUT_DIRECTORY. Each step prints its command and its time; a
step that fails stops the demo with its message, except where the failure is the point (an
infeasible planning problem exits with 1).
"""
import html
import os
import subprocess
import sys
import time


class Demo:
    def __init__(self, programs: str, out: str) -> None:
        self.programs = programs
        self.out = out
        self.sections: list[str] = []
        os.makedirs(out, exist_ok=True)

    def path(self, name: str) -> str:
        return os.path.join(self.out, name)

    def run(self, *command: str, expect: tuple[int, ...] = (0,)) -> str:
        """Runs one of the programs; returns what it printed."""
        print("  " + " ".join(command), flush=True)
        start = time.monotonic()
        result = subprocess.run(
            [os.path.join(self.programs, command[0]), *command[1:]], capture_output=True, text=True, check=False
        )
        took = time.monotonic() - start
        if result.returncode not in expect:
            sys.exit(f"{result.stdout}{result.stderr}demo: step failed with exit code {result.returncode}")
        text = (result.stdout + result.stderr).strip()
        for line in text.splitlines()[:4]:
            print("    " + line[:150])
        print(f"    {took:.2f} s", flush=True)
        self.sections[-1] += (
            f"<pre>{html.escape(' '.join(command))}\n{html.escape(text[:1500])}\n({took:.2f} s)</pre>"
        )
        return text

    def section(self, title: str, text: str) -> None:
        print(title, flush=True)
        self.sections.append(f"<h2>{html.escape(title)}</h2><p>{text}</p>")

    def show(self, *files: str, source: str = "1,-1.6,1.1") -> None:
        """A picture and a page of the given polyhedra, next to each other in the index."""
        name = os.path.splitext(os.path.basename(files[0]))[0]
        self.run("nef", "picture", *files, "-o", self.path(name + ".png"), "--from", source, "--size", "640x480")
        self.run("nef", "view", *files, "-o", self.path(name + ".html"))
        self.sections[-1] += (
            f'<a href="{name}.html"><img src="{name}.png" alt="{name}" width="640" height="480"></a>'
            f'<p><a href="{name}.html">turn it, click on it</a></p>'
        )

    def write_index(self) -> None:
        body = "\n".join(self.sections)
        page = f"""<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Exact solid geometry: demo</title>
<style>body{{font:16px/1.5 sans-serif;max-width:72em;margin:2em auto;padding:0 1em}}pre{{background:#f4f4f4;padding:.6em;
overflow-x:auto}}img{{max-width:100%;height:auto;border:1px solid #ddd}}</style></head><body>
<h1>Exact solid geometry with Nef polyhedra</h1>
{body}
</body></html>
"""
        with open(self.path("index.html"), "w", encoding="utf-8") as file:
            file.write(page)
        print(f"Open {self.path('index.html')}")


def main() -> None:
    demo = Demo(sys.argv[1], sys.argv[2])

    demo.section("Booleans", "Marks, open boundaries and parts of lower dimension survive every operation.")
    demo.run(
        "nef", "eval", "(box(0,0,0, 4,4,4) - interior(box(2,2,2, 6,6,6))) ^ box(1,-1,1, 2,5,2) + "
        "polygon(-1,-1,3/2, 6,-1,3/2, 6,0,3/2, -1,0,3/2) + segment(4,0,4, 6,0,6) + point(6,4,5)",
        "-o", demo.path("mixed.nef"),
    )
    demo.run("nef", "info", demo.path("mixed.nef"))
    demo.show(demo.path("mixed.nef"))

    demo.section("A visual hull", "Twelve silhouettes with a hole in some views; every number on the way is rational.")
    demo.run("visual_hull", "data/visual_hull/eight/eight.json", "-o", demo.path("eight.nef"), "--simplify", "1",
             "--verify", "--page", demo.path("eight_cameras.html"))
    demo.show(demo.path("eight.nef"))
    demo.sections[-1] += '<p><a href="eight_cameras.html">the hull with its cameras and their images</a></p>'

    demo.section("Three letters", "The thesis' example with letters of our own: three cameras see an M, a P and an I.")
    demo.run("visual_hull", "data/visual_hull/letters/mpi.vsh", "-o", demo.path("letters.nef"))
    demo.show(demo.path("letters.nef"))

    demo.section("A Minkowski sum", "A mushroom of 226 vertices and a cube: 106 s in the thesis.")
    demo.run("minkowski", "data/minkowski/mushroom.off", "data/minkowski/cube.off", "-o", demo.path("mushroom.nef"))
    demo.show(demo.path("mushroom.nef"))

    demo.section(
        "A configuration space with a tight passage",
        "The free positions of a unit cube between two rooms that a hole of exactly its size joins: two boxes and a segment.",
    )
    demo.run("nef", "eval", "box(0,0,0, 1,1,1)", "-o", demo.path("robot.nef"))
    demo.run("nef", "eval", "box(4,0,0, 5,3,3) - box(4,1,1, 5,2,2)", "-o", demo.path("wall.nef"))
    demo.run("minkowski", "--configuration-space", "--robot", demo.path("robot.nef"), "--obstacles",
             demo.path("wall.nef"), "--box=0,0,0", "8,2,2", "-o", demo.path("free_space.nef"))
    demo.show(demo.path("free_space.nef"), source="0.4,-1.6,0.7")
    demo.run("planner", "--tight", "data/planner/s1_tight_hole.json")

    demo.section("Through the passage", "Our planner finds the only way. Sampling in doubles cannot hit a set of measure zero, but with this suite's samplers and exact motion validator OMPL's planners get through too.")
    demo.run("planner", "data/planner/s1_tight_hole.json", "-o", demo.path("path.txt"), "-o", demo.path("planner.glb"),
             "--page", demo.path("planner.html"))
    demo.sections[-1] += '<p><a href="planner.html">move the robot</a>, or the same as <a href="planner.glb">glTF</a></p>'
    demo.run("planner", "data/planner/s1_tight_hole.json", "--ompl", "RRTConnect", "--time", "2", expect=(0, 1, 4))

    demo.section("No way", "A billionth less room, and the answer is a proof.")
    demo.run("planner", "data/planner/s1_narrower.json", expect=(1,))

    demo.write_index()


if __name__ == "__main__":
    main()
