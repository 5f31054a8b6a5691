#!/usr/bin/env python3
"""Runs the suite's main jobs on data/ and writes an index page of the results.

Usage: demo.py PROGRAM_DIRECTORY OUTPUT_DIRECTORY. Each step prints its command and its time; a
step that fails stops the demo with its message, except where the failure is the point (an
infeasible planning problem exits with 1).
"""
import html
import json
import os
import shlex
import subprocess
import sys
import time


STYLE = """
:root { color-scheme: light dark; --line: #d5d5d5; --quiet: #555; --block: #f4f4f4; }
@media (prefers-color-scheme: dark) { :root { --line: #444; --quiet: #aaa; --block: #222; } }
body { font: 16px/1.5 sans-serif; max-width: 78em; margin: 2em auto; padding: 0 1em; }
.gallery { display: grid; grid-template-columns: repeat(auto-fill, minmax(21em, 1fr)); gap: 1.2em; }
figure { margin: 0; border: 1px solid var(--line); border-radius: 6px; overflow: hidden; }
figure img { width: 100%; height: auto; display: block; }
figcaption { padding: .6em .8em; } figcaption p { margin: .2em 0; color: var(--quiet); font-size: 14px; }
pre { background: var(--block); padding: .6em; overflow-x: auto; white-space: pre-wrap; overflow-wrap: anywhere; }
summary { cursor: pointer; color: var(--quiet); }
"""


SMALL_HOLE = {
    "robot": "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)",
    "obstacles": ["box(-1/4,-3,-3, 1/4,3,3) - box(-1/4,-19/40,-19/40, 1/4,19/40,19/40)"],
    "box": [[-4, -3, -3], [4, 3, 3]],
    "rotation": "SO(3)",
    "start": {"position": [-2, 0, 0], "quaternion": [1, 0, 0, 0]},
    "goal": {"position": [2, 0, 0], "quaternion": [1, 0, 0, 0]},
}


class Section:
    """One job: what it shows, and how it was done."""

    def __init__(self, title: str, text: str) -> None:
        self.title = title
        self.text = text
        self.pictures: list[tuple[str, str]] = []  # (picture, page)
        self.links: list[tuple[str, str]] = []  # (file, text)
        self.steps: list[tuple[str, str, float]] = []  # (command, what it printed, seconds)

    def figure(self) -> str:
        picture, page = self.pictures[0]
        links = "".join(f' · <a href="{file}">{html.escape(text)}</a>' for file, text in self.links)
        return (
            f'<figure><a href="{page}"><img src="{picture}" alt="{html.escape(self.title)}" width="640" height="480"></a>'
            f"<figcaption><b>{html.escape(self.title)}</b><p>{self.text}</p>"
            f'<p><a href="{page}">turn it, click on it</a>{links}</p></figcaption></figure>'
        )

    def details(self) -> str:
        """The commands, to be pasted into a shell, with what they printed folded beneath."""
        parts = [f"<h2>{html.escape(self.title)}</h2>"]
        if not self.pictures:
            parts.append(f"<p>{self.text}</p>")
        for command, printed, seconds in self.steps:
            parts.append(f"<pre>{html.escape(command)}</pre>")
            parts.append(f"<details><summary>{seconds:.2f} s</summary><pre>{html.escape(printed)}</pre></details>")
        return "\n".join(parts)


class Demo:
    def __init__(self, programs: str, out: str) -> None:
        self.programs = programs
        self.out = out
        self.sections: list[Section] = []
        os.makedirs(out, exist_ok=True)

    def path(self, name: str) -> str:
        return os.path.join(self.out, name)

    def run(self, *command: str, expect: tuple[int, ...] = (0,)) -> str:
        """Runs one of the programs; returns what it printed."""
        program = os.path.join(self.programs, command[0])
        print("  " + " ".join(command), flush=True)
        start = time.monotonic()
        result = subprocess.run([program, *command[1:]], capture_output=True, text=True, check=False)
        took = time.monotonic() - start
        if result.returncode not in expect:
            sys.exit(f"{result.stdout}{result.stderr}demo: step failed with exit code {result.returncode}")
        text = (result.stdout + result.stderr).strip()
        for line in text.splitlines()[:4]:
            print("    " + line[:150])
        print(f"    {took:.2f} s", flush=True)
        self.sections[-1].steps.append((shlex.join([program, *command[1:]]), text[:4000], took))
        return text

    def section(self, title: str, text: str) -> None:
        print(title, flush=True)
        self.sections.append(Section(title, text))

    def link(self, file: str, text: str) -> None:
        """A further file of the section."""
        self.sections[-1].links.append((file, text))

    def picture(self, name: str, files: tuple[str, ...], source: str) -> None:
        """A picture that leads to the page of the same name."""
        self.run("nef", "picture", *files, "-o", self.path(name + ".png"), "--from", source, "--size", "640x480")
        self.sections[-1].pictures.append((name + ".png", name + ".html"))

    def show(self, *files: str, source: str = "1,-1.6,1.1") -> None:
        """A picture of the given polyhedra in the gallery, which leads to their page."""
        name = os.path.splitext(os.path.basename(files[0]))[0]
        self.picture(name, files, source)
        self.run("nef", "view", *files, "-o", self.path(name + ".html"))

    def show_motion(self, name: str, *files: str, source: str) -> None:
        """A picture of where a motion begins, which leads to the page that plays it; both have the name, as its glTF."""
        self.picture(name, files, source)
        self.link(name + ".glb", "as glTF")

    def write_index(self) -> None:
        gallery = "\n".join(section.figure() for section in self.sections if section.pictures)
        details = "\n".join(section.details() for section in self.sections)
        page = f"""<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Exact solid geometry: demo</title>
<meta name="viewport" content="width=device-width"><style>{STYLE}</style></head><body>
<h1>Exact solid geometry with Nef polyhedra</h1>
<div class="gallery">
{gallery}
</div>
<h1>How it was made</h1>
<p>Each line can be pasted into a shell in the project's folder; under it, the time it took here and what it printed.</p>
{details}
</body></html>
"""
        with open(self.path("index.html"), "w", encoding="utf-8") as file:
            file.write(page)
        print(f"Open {self.path('index.html')}; live in the browser: {sys.argv[1]}/nef studio --root {sys.argv[2]}")


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
    demo.link("eight_cameras.html", "with its cameras and their images")

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
             demo.path("wall.nef"), "--box=0,0,0,8,2,2", "-o", demo.path("free_space.nef"))
    demo.show(demo.path("free_space.nef"), source="0.4,-1.6,0.7")
    demo.run("planner", "--tight", "data/planner/s1_tight_hole.json")

    demo.section("Through the passage", "Our planner finds the only way. Sampling in doubles cannot hit a set of measure zero, but with this suite's samplers and exact motion validator OMPL's planners get through too.")
    demo.run("planner", "data/planner/s1_tight_hole.json", "-o", demo.path("path.txt"), "-o", demo.path("planner.glb"),
             "--page", demo.path("planner.html"))
    demo.show_motion("planner", demo.path("wall.nef"), demo.path("robot.nef"), source="-1.6,-1,0.7")
    demo.run("planner", "data/planner/s1_tight_hole.json", "--ompl", "RRTConnect", "--time", "2", expect=(0, 1, 4))

    demo.section("No way", "A billionth less room, and the answer is a proof.")
    demo.run("planner", "data/planner/s1_narrower.json", expect=(1,))

    demo.section("A robot that turns freely", "An L of bars passes a square window: it has to turn about two axes, and every motion is certified, not sampled.")
    demo.run("planner", "data/planner/rigid/l_window.json", "-o", demo.path("turning.txt"), "-o", demo.path("turning.glb"),
             "--page", demo.path("turning.html"))
    demo.run("nef", "eval", "box(-4,4,-4, 4,33/8,4) - box(-4/5,4,-4/5, 4/5,5,4/5)", "-o", demo.path("window.nef"))
    demo.run("nef", "eval", "box(-1/2,-3/2,-1/2, 5/2,-1/2,1/2) + box(-1/2,-3/2,-1/2, 1/2,-1/2,5/2)", "-o", demo.path("l.nef"))
    demo.show_motion("turning", demo.path("window.nef"), demo.path("l.nef"), source="-0.8,-1.6,0.7")

    demo.section("No way, however it turns", "A unit cube before a hole 0.95 wide: the proof holds for all positions and orientations, and is checked by other means.")
    with open(demo.path("small_hole.json"), "w", encoding="utf-8") as file:
        json.dump(SMALL_HOLE, file, indent=2)
    demo.run("planner", demo.path("small_hole.json"), "--proof", demo.path("small_hole.proof"), expect=(1,))
    demo.run("planner", demo.path("small_hole.json"), "--check-proof", demo.path("small_hole.proof"))

    demo.section("A puzzle that comes apart", "A burr of six pieces: the order in which they can leave, found with no play between them at all.")
    with open("data/planner/assembly/burr.json", encoding="utf-8") as file:
        parts = json.load(file)["parts"]
    for name, shape in parts.items():
        demo.run("nef", "eval", shape, "-o", demo.path(f"burr_{name}.nef"))
    demo.run("planner", "--assembly", "data/planner/assembly/burr.json", "-o", demo.path("burr.glb"), "--page", demo.path("burr.html"))
    demo.show_motion("burr", *(demo.path(f"burr_{name}.nef") for name in parts), source="1,-1.6,1.1")

    demo.write_index()


if __name__ == "__main__":
    main()
