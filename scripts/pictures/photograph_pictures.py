#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The pictures of docs/photographs.md: photographs of a painted duck that turns on a printed board, rendered here, and what
visual_hull makes of them.

  scripts/pictures/photograph_pictures.py [--bin build/release/bin] [--out docs/pictures] [--keep DIR]

The camera has a lens with distortion and noise, its axis does not meet the middle of the image, and a lamp that stands still
throws a shadow. The commands that are run are printed, with what they print, and how far the hull's volume is from the duck's.
"""
import argparse
import json
import pathlib
import re
import struct
import subprocess
import tempfile
import zlib

import numpy

SHAPE = 480, 640
FOCAL, CENTRE, DISTORTION = 760, (331.5, 232), (-.12, .03)
# Middle, half-axes, colour: millimetres, z up from the board.
DUCK = [((0, 0, 24), (34, 22, 24), (235, 190, 30)), ((22, 0, 58), (16, 15, 17), (235, 190, 30)),
        ((41, 0, 55), (11, 7, 4), (230, 95, 20)), ((-32, 0, 38), (14, 9, 6), (235, 190, 30)),
        ((14, 0, 44), (12, 11, 16), (235, 190, 30)), ((31, 10, 63), (4, 4, 4), (40, 30, 120)),
        ((31, -10, 63), (4, 4, 4), (40, 30, 120)), ((-2, 19, 28), (18, 6, 12), (200, 140, 20)),
        ((-2, -19, 28), (18, 6, 12), (200, 140, 20))]


def write_png(path, pixels):
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    size = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", zlib.compress(rows, 9)) +
                     chunk(b"IEND", b""))


def sheet_of(svg, pixels=6):
    """The page of a board as brightness, and its size in millimetres."""
    width, height = (float(x) for x in re.search(r'viewBox="0 0 (\S+) (\S+)"', svg).groups())
    sheet = numpy.full((int(height * pixels), int(width * pixels)), .92)
    for x, y, w, h in re.findall(r"M([\d.]+) ([\d.]+)h([\d.]+)v([\d.]+)h", svg):
        left, top, right, bottom = (round(float(t) * pixels) for t in (x, y, float(x) + float(w), float(y) + float(h)))
        sheet[top:bottom, left:right] = .07
    return sheet, (width, height), pixels


def rays_of_lens():
    """Directions of four samples a pixel, by inverting the lens (fixed point)."""
    v, u = numpy.mgrid[-.25:SHAPE[0] - .5:.5, -.25:SHAPE[1] - .5:.5]
    x0, y0 = (u - CENTRE[0]) / FOCAL, (v - CENTRE[1]) / FOCAL
    x, y = x0.copy(), y0.copy()
    for _ in range(20):
        r = x * x + y * y
        factor = 1 + DISTORTION[0] * r + DISTORTION[1] * r * r
        x, y = x0 / factor, y0 / factor
    return numpy.stack([x, y, numpy.ones(x.shape)], -1)


def first_hit(eye, rays):
    """The parameter of the first ellipsoid that each ray meets, and its number; infinity where there is none."""
    best, which = numpy.full(rays.shape[:-1], numpy.inf), numpy.full(rays.shape[:-1], -1)
    for k, (middle, axes, _) in enumerate(DUCK):
        p, d = (eye - middle) / numpy.array(axes), rays / numpy.array(axes)
        a, b, c = (d * d).sum(-1), (d * p).sum(-1), (p * p).sum(-1) - 1
        disc = b * b - a * c
        t = (-b - numpy.sqrt(numpy.maximum(disc, 0))) / a
        hit = (disc > 0) & (t > 1e-6) & (t < best)
        best, which = numpy.where(hit, t, best), numpy.where(hit, k, which)
    return best, which


def lamp_of(rotation, eye, turns=False):
    """It stands to the left of the camera and above it, or turns with the board."""
    return numpy.array([250., -150, 500]) if turns else eye + rotation.T @ numpy.array([-250, -260, -20])


def paint_at(points, which, eye, lamp):
    """What a camera sees of points on the duck's ellipsoids, with a highlight: red, green and blue up to 1; outward normals."""
    middle, axes, paint = (numpy.array([part[i] for part in DUCK], float)[which] for i in range(3))
    normal = (points - middle) / axes ** 2
    normal /= numpy.linalg.norm(normal, axis=-1, keepdims=True)
    light, sight = lamp - points, eye - points
    light /= numpy.linalg.norm(light, axis=-1, keepdims=True)
    half = light + sight / numpy.linalg.norm(sight, axis=-1, keepdims=True)
    half /= numpy.linalg.norm(half, axis=-1, keepdims=True)
    shade = .35 + .65 * numpy.maximum((normal * light).sum(-1), 0)
    shine = .25 * numpy.maximum((normal * half).sum(-1), 0) ** 60
    return paint / 255 * shade[:, None] + shine[:, None], normal


def render(rotation, eye, lamp, board, rays_in_camera, random):
    """A photograph, bytes of red, green and blue."""
    sheet, page, pixels = board
    rays = rays_in_camera @ rotation
    colour = numpy.full(rays.shape, .33)
    best, which = first_hit(eye, rays)
    table = numpy.where(rays[..., 2] < 0, -eye[2] / rays[..., 2], numpy.inf)
    on_table = (table < best) & (table < 3000)
    at = eye + numpy.where(on_table, table, 0)[..., None] * rays
    x = numpy.floor((at[..., 0] + page[0] / 2) * pixels).astype(int)
    y = numpy.floor((page[1] / 2 - at[..., 1]) * pixels).astype(int)
    on = on_table & (x >= 0) & (y >= 0) & (x < sheet.shape[1]) & (y < sheet.shape[0])
    gray = numpy.where(on, sheet[y * on, x * on], .45)
    to_lamp = lamp - at
    distance, _ = first_hit(at + numpy.array([0, 0, 1e-3]), to_lamp)
    lit = numpy.where(distance < 1, .45, 1)
    colour = numpy.where(on_table[..., None], (gray * lit)[..., None], colour)
    mine = (which >= 0) & ~on_table
    if mine.any():
        colour[mine] = paint_at(eye + best[mine][:, None] * rays[mine], which[mine], eye, lamp)[0]
    # A lens blurs by a third of a pixel.
    for axis in 0, 1:
        around = numpy.pad(colour, [(1, 1) if k == axis else (0, 0) for k in range(3)], mode="edge")
        colour = (numpy.take(around, range(colour.shape[axis]), axis) + 2 * colour +
                  numpy.take(around, range(2, colour.shape[axis] + 2), axis)) / 4
    small = colour.reshape(SHAPE[0], 2, SHAPE[1], 2, 3).mean((1, 3))
    return numpy.clip(255 * small + random.normal(0, 3, small.shape), 0, 255).astype(numpy.uint8)


def looking(eye, at, roll=0.):
    ahead = (numpy.array(at) - eye) / numpy.linalg.norm(numpy.array(at) - eye)
    right = numpy.cross(ahead, (0, 0, 1))
    right /= numpy.linalg.norm(right)
    down = numpy.cross(ahead, right)
    c, s = numpy.cos(roll), numpy.sin(roll)
    return numpy.stack([c * right - s * down, s * right + c * down, ahead])


def place(distance, azimuth, elevation):
    return distance * numpy.array([numpy.cos(elevation) * numpy.cos(azimuth), numpy.cos(elevation) * numpy.sin(azimuth),
                                   numpy.sin(elevation)])


def cameras(count):
    """Rotation and eye of each photograph. The board turns; seen from it, the camera does. Every fourth looks down more."""
    eyes = [place(430, 2 * numpy.pi * i / count, numpy.radians(62 if i % 4 == 3 else 26)) for i in range(count)]
    return [(looking(eye, (4, 2, 28)), eye) for eye in eyes]


def take_photographs(folder, board, count, lamp_turns):
    rays, random = rays_of_lens(), numpy.random.default_rng(1)
    for name in "photographs", "lens":
        (folder / name).mkdir(exist_ok=True)
    for i, (rotation, eye) in enumerate(cameras(count)):
        write_png(folder / "photographs" / f"duck_{i:02}.png",
                  render(rotation, eye, lamp_of(rotation, eye, lamp_turns), board, rays, random))
    duck, DUCK[:] = DUCK[:], []  # the board alone, held at several tilts
    for i in range(8):
        eye = place(330, .9 * i, numpy.radians((40, 65)[i % 2]))
        rotation = looking(eye, (25 * numpy.cos(2 * i), 20 * numpy.sin(3 * i), 0), .7 * i)
        picture = render(rotation, eye, lamp_of(rotation, eye), board, rays, random)
        write_png(folder / "lens" / f"board_{i}.png", picture)
    DUCK[:] = duck


def volume_of_duck(step=.5):
    """By counting points of a grid."""
    x, y, z = numpy.mgrid[-50:55:step, -30:30:step, -1:80:step]
    inside = numpy.zeros(x.shape, bool)
    for (a, b, c), (i, j, k), _ in DUCK:
        inside |= ((x - a) / i) ** 2 + ((y - b) / j) ** 2 + ((z - c) / k) ** 2 <= 1
    return inside.sum() * step ** 3


def write_perfect_scene(folder, count):
    """The true cameras, and masks that say how much of each pixel the duck covers, by four samples."""
    (folder / "perfect").mkdir(exist_ok=True)
    matrix, views, rays = [[FOCAL, 0, CENTRE[0]], [0, FOCAL, CENTRE[1]], [0, 0, 1]], [], rays_of_lens()
    for i, (rotation, eye) in enumerate(cameras(count)):
        _, which = first_hit(eye, rays @ rotation)
        covered = (255 * (which >= 0).reshape(SHAPE[0], 2, SHAPE[1], 2).mean((1, 3))).round().astype(numpy.uint8)
        name = f"perfect/duck_{i:02}.png"
        write_png(folder / name, numpy.repeat(covered[..., None], 3, -1))
        pose = numpy.array(matrix) @ numpy.column_stack([rotation, -rotation @ eye])
        views.append({"name": f"duck_{i:02}.png", "image": name, "P": pose.tolist(), "K": matrix,
                      "distortion": [*DISTORTION, 0, 0, 0]})
    (folder / "perfect.json").write_text(json.dumps({"cameras": views}))


def errors_of_cameras(scene, count):
    """Degrees between the axes of found and true cameras, and millimetres between their centres."""
    angles, shifts = [], []
    truth = cameras(count)
    for view in json.loads(scene.read_text())["cameras"]:
        rotation, eye = truth[int(re.search(r"\d+", view["name"])[0])]
        pose = numpy.linalg.inv(numpy.array(view["K"])) @ numpy.array(view["P"])
        pose /= numpy.cbrt(numpy.linalg.det(pose[:, :3]))
        turn = pose[:, :3] @ rotation.T
        sine = numpy.linalg.norm(turn - turn.T) / numpy.sqrt(8)
        angles.append(numpy.degrees(numpy.arcsin(min(1, sine))))
        shifts.append(numpy.linalg.norm(-numpy.linalg.solve(pose[:, :3], pose[:, 3]) - eye))
    return numpy.array(angles), numpy.array(shifts)


def textured_points(glb):
    """Middles of the triangles of a GLB and their texture's colours there, up to 255."""
    data = glb.read_bytes()
    size = struct.unpack("<I", data[12:16])[0]
    tree, body = json.loads(data[20:20 + size]), data[28 + size:]

    def accessor(number, kind, width):
        item = tree["accessors"][number]
        at = tree["bufferViews"][item["bufferView"]].get("byteOffset", 0) + item.get("byteOffset", 0)
        return numpy.frombuffer(body, kind, item["count"] * width, at).reshape(-1, width)
    part = tree["meshes"][0]["primitives"][0]
    kind = {5123: numpy.uint16, 5125: numpy.uint32}[tree["accessors"][part["indices"]]["componentType"]]
    corners = accessor(part["indices"], kind, 1).reshape(-1, 3)
    places = accessor(part["attributes"]["POSITION"], numpy.float32, 3)[corners].astype(float)
    at = accessor(part["attributes"]["TEXCOORD_0"], numpy.float32, 2)[corners].mean(1)
    image = tree["bufferViews"][tree["images"][0]["bufferView"]]
    file = glb.with_suffix(".texture.png")
    file.write_bytes(body[image.get("byteOffset", 0):][:image["byteLength"]])
    pixels = read_png(file)
    row, column = ((at[:, k] * pixels.shape[1 - k]).astype(int) for k in (1, 0))
    area = numpy.linalg.norm(numpy.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]), axis=-1)
    return places.mean(1), pixels[row, column].astype(float), area


def errors_of_texture(glb, count, lamp_turns):
    """Mean differences, up to 255 and weighted by area, between the texture and what the cameras see there, without noise:
    their mean, weighted by how squarely they look at the point, their median in each channel, and the nearest of them; and
    the share of the hull's area that some camera sees and the duck has there. Where the lamp stands still each camera sees
    another shade."""
    position, colour, area = textured_points(glb)
    shown, square = numpy.full((count, *position.shape), numpy.nan), numpy.zeros((count, len(position)))
    for i, (rotation, eye) in enumerate(cameras(count)):
        rays = position - eye
        t, which = first_hit(eye, rays)
        seen = numpy.flatnonzero((which >= 0) & (numpy.abs(t - 1) * numpy.linalg.norm(rays, axis=-1) < 1.5))
        there = eye + t[seen, None] * rays[seen]
        paint, normal = paint_at(there, which[seen], eye, lamp_of(rotation, eye, lamp_turns))
        cosine = -(normal * rays[seen]).sum(-1) / numpy.linalg.norm(rays[seen], axis=-1)
        near = cosine > .1
        shown[i, seen[near]], square[i, seen[near]] = 255 * numpy.clip(paint[near], 0, 1), cosine[near]
    known = square.sum(0) > 0
    shown, square, colour, area = shown[:, known], square[:, known], colour[known], area[known] / area.sum()
    mean = numpy.nansum(shown * square[..., None], 0) / square.sum(0)[:, None]
    each = [numpy.abs(colour - mean).mean(-1), numpy.abs(colour - numpy.nanmedian(shown, 0)).mean(-1),
            numpy.nanmin(numpy.abs(colour - shown).mean(-1), 0)]
    return [(off * area).sum() / area.sum() for off in each], area.sum()


def run(*words):
    print("$", *words)
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    print(done.stdout + done.stderr, end="")
    if done.returncode:
        raise SystemExit(f"exit code {done.returncode}")
    return done.stdout


def beside(files, height=None):
    from_png = [read_png(file) for file in files]
    height = height or min(picture.shape[0] for picture in from_png)
    gap = numpy.full((height, 6, 3), 255, numpy.uint8)
    columns = []
    for picture in from_png:
        columns += [picture[:height], gap]
    return numpy.concatenate(columns[:-1], 1)


def read_png(path):
    """Of write_png: eight bits, three channels; filters as libpng chooses them are undone."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height = struct.unpack(">II", body[:8])
        if kind == b"IDAT":
            packed += body
        at += size + 12
    raw = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).reshape(height, 3 * width + 1)
    result = numpy.zeros((height + 1, 3 * width + 3), numpy.int64)
    for y in range(height):
        kind, line = raw[y, 0], raw[y, 1:].astype(numpy.int64)
        above = result[y]
        if kind in (0, 2):
            result[y + 1, 3:] = line if kind == 0 else (line + above[3:]) & 255
            continue
        row = result[y + 1]
        for x in range(3 * width):
            a, b, c = row[x], above[x + 3], above[x]
            if kind == 1:
                guess = a
            elif kind == 3:
                guess = (a + b) // 2
            else:
                p = a + b - c
                guess = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row[x + 3] = (line[x] + guess) & 255
    return result[1:, 3:].reshape(height, width, 3).astype(numpy.uint8)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default="build/release/bin")
    parser.add_argument("--out", type=pathlib.Path, default="docs/pictures")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for all files, which stays")
    parser.add_argument("--views", type=int, default=24)
    parser.add_argument("--lamp-turns", action="store_true", help="the lamp turns with the board")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        hulls = arguments.bin / "visual_hull"
        run(hulls, "board", "-o", folder / "board.svg")
        take_photographs(folder, sheet_of((folder / "board.svg").read_text()), arguments.views, arguments.lamp_turns)
        run(hulls, "calibrate", folder / "photographs", "--lens", folder / "lens", "-o", folder / "scene.json")
        method = "--mask", "threshold:red-blue"
        run(hulls, "masks", folder / "photographs", *method, "-o", folder / "masks")
        found = run(hulls, folder / "scene.json", *method, "--min-area", "400", "--repair-masks", "--simplify", "1", "--largest",
                    "--texture", "-o", folder / "duck.glb", "--picture", folder / "hull.png")
        write_perfect_scene(folder, arguments.views)
        perfect = run(hulls, folder / "perfect.json", "--soft", "--largest", "-o", folder / "perfect.nef")
        volume, of_perfect = (float(re.search(r"volume (\S+)", text)[1]) for text in (found, perfect))
        print(f"the duck has {volume_of_duck():.0f} cubic millimetres, the hull {volume:.0f}, the hull of true masks from true "
              f"cameras {of_perfect:.0f}: {100 * (volume / of_perfect - 1):+.2f} %")
        angles, shifts = errors_of_cameras(folder / "scene.json", arguments.views)
        print(f"cameras are off by {angles.mean():.3f} degrees, at most {angles.max():.3f}, and by {shifts.mean():.2f} mm, at "
              f"most {shifts.max():.2f}")
        (mean, median, nearest), share = errors_of_texture(folder / "duck.glb", arguments.views, arguments.lamp_turns)
        print(f"the texture is off by {mean:.1f} of 255 from the mean of what cameras see, by {median:.1f} from the median, and "
              f"by {nearest:.1f} from the nearest of them, over the {100 * share:.0f} % of the hull where the duck is seen")
        pictures = folder / "photographs"
        write_png(arguments.out / "photographs.png", beside([pictures / f"duck_{i:02}.png" for i in (0, 5, 11)])[::2, ::2])
        write_png(arguments.out / "photographs_masks.png", read_png(folder / "masks/overview/masks.png")[:480])
        write_png(arguments.out / "photographs_hull.png", read_png(folder / "hull.png"))


if __name__ == "__main__":
    main()
