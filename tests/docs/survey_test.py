# SPDX-License-Identifier: Apache-2.0
"""bench/survey.py gives each mesh of a folder the verdict that it was made for.

Usage: survey_test.py SURVEY NEF
"""
import json
import pathlib
import subprocess
import sys
import tempfile

VERTICES = [(x, y, z) for z in (0, 2) for y in (0, 2) for x in (0, 2)]
FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def off(*cubes):
    """Cubes, each given by its shift and its faces."""
    lines, vertices, faces = [], 0, []
    for shift, some in cubes:
        lines += [" ".join(str(x + shift) for x in vertex) for vertex in VERTICES]
        faces += [f"{len(face)} " + " ".join(str(vertices + v) for v in face) for face in some]
        vertices += 8
    return f"OFF\n{vertices} {len(faces)} 0\n" + "\n".join(lines + faces) + "\n"


def main():
    survey, nef = sys.argv[1:]
    turned = [FACES[0][::-1], *FACES[1:]]
    fine = [(face[0], face[i], face[i + 1]) for face in FACES for i in (1, 2)]
    meshes = {
        "taken": off((0, FACES)),
        "resolved": off((0, FACES), (1, FACES)),
        "repaired": off((0, turned), (1, FACES)),
        "lids": off((0, fine[1:])),  # half of a side is a twelfth of the area
        "refused": off((0, FACES[:1])),
    }
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for verdict, text in meshes.items():
            (folder / f"{verdict}.off").write_text(text)
        done = subprocess.run([sys.executable, survey, name, "--nef", nef, "--json", str(folder / "rows.json")],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"exit code {done.returncode}\n{done.stdout}{done.stderr}")
        for row in json.loads((folder / "rows.json").read_text()):
            wanted = pathlib.Path(row["file"]).stem
            if row["verdict"] != wanted:
                sys.exit(f"{wanted}.off: {row}")
            if (row["why"] == "") != (wanted == "taken"):
                sys.exit(f"{wanted}.off: says {row['why']!r}")
        (folder / "none").mkdir()
        empty = subprocess.run([sys.executable, survey, str(folder / "none"), "--nef", nef], capture_output=True, text=True, check=False)
        if empty.returncode == 0 or "holds no meshes" not in empty.stderr:
            sys.exit(f"an empty folder: {empty.returncode}, {empty.stderr}")


if __name__ == "__main__":
    main()
