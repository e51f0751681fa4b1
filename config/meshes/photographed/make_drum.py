#!/usr/bin/env python3
"""Makes drum.glb: a weathered drum of a fluted column as a photogrammetry program would write it.

    python3 make_drum.py && presa model drum.glb --out . --overwrite --haptic-error 0.3 --pieces 12

A glTF 2.0 file with base colour, normal and roughness maps of 512 x 512 pixels (JPEG). Drum 80 mm wide, 110 mm high, origin
in the middle of its lower face; glTF: metres, y up. Colour, grain and chips are functions of the place in the stone, so no
map has a seam. Python's standard library and ffmpeg (JPEG).
"""
import json
import random
import struct
import subprocess
import tempfile
import zlib
from math import cos, floor, pi, sin, sqrt
from pathlib import Path

RADIUS, HEIGHT = 0.040, 0.110  # [m]
FLUTES, FLUTE_DEPTH = 16, 0.0024
AROUND = 128                    # vertices of a ring
SIDE = 512                      # of the maps [pixel]
SIDE_FROM = 0.36                # the side of the drum has the rows above, the faces the rows below
FACES = [(0.18, 0.18, 0.17), (0.54, 0.18, 0.17)]  # centre and radius of lower and upper face in the maps


class Noise:
    """Values in [0, 1] on a lattice, smoothly between."""

    def __init__(self, seed):
        self.table = [random.Random(seed * 7919 + i).random() for i in range(4096)]

    def corner(self, x, y, z):
        h = (x * 0x8da6b343 ^ y * 0xd8163841 ^ z * 0xcb1ab31f) & 0xffffffff
        h = (h ^ h >> 15) * 0x2c1b3c6d & 0xffffffff
        return self.table[(h ^ h >> 13) & 4095]

    def __call__(self, x, y, z):
        i, j, k = floor(x), floor(y), floor(z)
        u, v, w = x - i, y - j, z - k
        u, v, w = u * u * (3 - 2 * u), v * v * (3 - 2 * v), w * w * (3 - 2 * w)
        c = self.corner
        low = (c(i, j, k) * (1 - u) + c(i + 1, j, k) * u) * (1 - v) + (c(i, j + 1, k) * (1 - u) + c(i + 1, j + 1, k) * u) * v
        k += 1
        high = (c(i, j, k) * (1 - u) + c(i + 1, j, k) * u) * (1 - v) + (c(i, j + 1, k) * (1 - u) + c(i + 1, j + 1, k) * u) * v
        return low * (1 - w) + high * w


CLOUD, STAIN, GRAIN, PIT, LICHEN, CHIP, STREAK = (Noise(seed) for seed in range(1, 8))


def octaves(noise, p, frequency, count):
    total, weight, sum_of_weights = 0.0, 1.0, 0.0
    x, y, z = p
    for i in range(count):
        # turned from octave to octave, so that no lattice shows
        x, y, z = 0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z
        f = frequency * 2 ** i
        total += weight * noise(x * f + 13.7 * i, y * f, z * f)
        sum_of_weights += weight
        weight /= 2
    return total / sum_of_weights


def smooth(low, high, x):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def edge(p):
    """1 at the rims, 0 from 12 mm on."""
    rim = min(p[2], HEIGHT - p[2])
    return 1 - smooth(0, 0.012, rim)


def pits(p):
    return smooth(0.60, 0.78, octaves(PIT, p, 420, 2)) * smooth(0.40, 0.65, octaves(STAIN, p, 60, 2))


def relief(p):
    """Height of the grain [m], for the normal map."""
    return 0.00022 * octaves(GRAIN, p, 700, 2) + 0.00030 * octaves(CLOUD, p, 180, 3) - 0.0007 * pits(p)


def paint(p, upright):
    """Display colour and roughness, 0 to 1."""
    cloud, grain = octaves(CLOUD, p, 45, 4), octaves(GRAIN, p, 900, 2)
    color = [0.80, 0.72, 0.58]
    ochre = smooth(0.45, 0.70, octaves(STAIN, p, 28, 3))
    color = [c + ochre * (o - c) * 0.65 for c, o in zip(color, (0.72, 0.53, 0.33))]
    # soot where rain does not wash, in streaks down the sides
    streak = smooth(0.50, 0.72, octaves(STREAK, (p[0], p[1], p[2] * 0.12), 90, 3)) * smooth(0.25, 0.6, cloud)
    soot = 0.75 * streak * upright + 0.35 * (1 - upright) * smooth(0.5, 0.75, cloud)
    color = [c + soot * (s - c) for c, s in zip(color, (0.27, 0.25, 0.23))]
    # lichen: round patches with a pale rim
    spots = octaves(LICHEN, p, 70, 4)
    lichen = smooth(0.655, 0.70, spots)
    rim = lichen * (1 - smooth(0.70, 0.74, spots))
    green = [a + rim * (b - a) for a, b in zip((0.58, 0.57, 0.42), (0.78, 0.76, 0.62))]
    color = [c + 0.6 * lichen * (g - c) for c, g in zip(color, green)]
    # broken edges are fresh
    fresh = edge(p) * smooth(0.50, 0.62, octaves(CHIP, p, 95, 2))
    color = [c + 0.8 * fresh * (f - c) for c, f in zip(color, (0.88, 0.83, 0.74))]
    shade = (0.72 + 0.42 * cloud) * (0.80 + 0.34 * grain) * (1 - 0.45 * pits(p))
    rough = 0.80 + 0.15 * grain - 0.30 * ochre * (1 - soot) * (1 - lichen)
    return [min(max(c * shade, 0), 1) for c in color], min(max(rough, 0.05), 1)


def radius_at(turn, z):
    """Of the drum, with flutes, worn rims and chips."""
    flute = abs(sin(FLUTES * turn / 2))  # an arris at turn 0
    r = RADIUS - FLUTE_DEPTH * flute ** 0.7
    rim = min(z, HEIGHT - z)
    r -= 0.0016 * (1 - sqrt(1 - (1 - min(rim / 0.0025, 1)) ** 2))
    p = (RADIUS * cos(turn), RADIUS * sin(turn), z)
    r -= 0.0065 * edge(p) ** 1.5 * smooth(0.52, 0.75, octaves(CHIP, p, 95, 2))
    return r - 0.0007 * octaves(CLOUD, p, 60, 2)


def heights():
    near = [0, 0.0006, 0.0013, 0.0025, 0.004, 0.006, 0.0085, 0.012]
    middle = [0.012 + (HEIGHT - 0.024) * i / 8 for i in range(1, 8)]
    return near + middle + [HEIGHT - z for z in reversed(near)]


def place(turn, z, share=1.0):
    r = share * radius_at(turn, z)
    return (r * cos(turn), r * sin(turn), z)


def surface():
    """Vertices (place, texture coordinates) and triangles; each map island has its own vertices."""
    vertices, triangles = [], []

    def grid(rows, flip):
        first = len(vertices) - len(rows) * (AROUND + 1)
        for row in range(len(rows) - 1):
            for i in range(AROUND):
                a = first + row * (AROUND + 1) + i
                b, c, d = a + 1, a + AROUND + 2, a + AROUND + 1
                triangles.extend([(a, b, c), (a, c, d)] if not flip else [(a, c, b), (a, d, c)])

    turns = [2 * pi * (i % AROUND) / AROUND for i in range(AROUND + 1)]
    rows = heights()
    for z in rows:
        for i, turn in enumerate(turns):
            vertices.append((place(turn, z), (i / AROUND, SIDE_FROM + (1 - SIDE_FROM) * z / HEIGHT)))
    grid(rows, False)
    for face, z in enumerate((0.0, HEIGHT)):
        shares = [0.0, 0.25, 0.5, 0.7, 0.85, 0.94, 1.0]
        middle_u, middle_v, size = FACES[face]
        for share in shares:
            for turn in turns:
                p = place(turn, z, share)
                side = 1 if face else -1  # the lower face is seen from below
                vertices.append((p, (middle_u + side * size * p[0] / RADIUS, middle_v + size * p[1] / RADIUS)))
        grid(shares, face == 1)
    used = [t for t in triangles if len({vertices[v][0] for v in t}) == 3]
    return vertices, used


def normals_of(vertices, triangles):
    """Smooth over each island: edges between side and faces stay sharp."""
    island = lambda v: vertices[v][1][1] >= SIDE_FROM
    sums = {}
    for t in triangles:
        a, b, c = (vertices[v][0] for v in t)
        ab, ac = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
        n = (ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0])
        for v in t:
            key = (vertices[v][0], island(v))
            sums[key] = tuple(s + x for s, x in zip(sums.get(key, (0, 0, 0)), n))
    normals = []
    for v in range(len(vertices)):
        n = sums.get((vertices[v][0], island(v)), (0, 0, 1))
        length = sqrt(sum(x * x for x in n)) or 1
        normals.append(tuple(x / length for x in n))
    return normals


def stone_at(u, v):
    """The place on the drum that a texel shows, how far a texel goes there along u and v [m], and whether upright."""
    if v >= SIDE_FROM - 0.01:
        turn, z = 2 * pi * u, HEIGHT * min(max((v - SIDE_FROM) / (1 - SIDE_FROM), 0), 1)
        r = radius_at(turn, z)
        return (r * cos(turn), r * sin(turn), z), 2 * pi * RADIUS / SIDE, HEIGHT / (1 - SIDE_FROM) / SIDE, 1.0
    face = 0 if u < 0.36 else 1
    middle_u, middle_v, size = FACES[face]
    side = 1 if face else -1
    x, y = side * (u - middle_u) / size * RADIUS, (v - middle_v) / size * RADIUS
    return (x, y, HEIGHT * face), RADIUS / size / SIDE, RADIUS / size / SIDE, 0.0


def maps():
    colors, normals, roughs, height, steps = bytearray(), bytearray(), bytearray(), [], []
    for row in range(SIDE):
        for column in range(SIDE):
            p, du, dv, upright = stone_at((column + 0.5) / SIDE, 1 - (row + 0.5) / SIDE)
            color, rough = paint(p, upright)
            colors += bytes(round(255 * c) for c in color)
            roughs += bytes((0, round(255 * rough), 0))
            height.append(relief(p))
            steps.append((du, dv))
    for row in range(SIDE):
        for column in range(SIDE):
            du, dv = steps[row * SIDE + column]
            at = lambda r, c: height[min(max(r, 0), SIDE - 1) * SIDE + c % SIDE]
            x = (at(row, column - 1) - at(row, column + 1)) / (2 * du)
            y = (at(row + 1, column) - at(row - 1, column)) / (2 * dv)
            length = sqrt(x * x + y * y + 1)
            normals += bytes(round(127.5 * (1 + n / length)) for n in (x, y, 1))
    return colors, normals, roughs


def png(pixels):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes(pixels[3 * SIDE * row:3 * SIDE * (row + 1)]) for row in range(SIDE))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIDE, SIDE, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def jpeg(pixels, quality):
    with tempfile.TemporaryDirectory() as folder:
        source, out = Path(folder) / "map.png", Path(folder) / "map.jpg"
        source.write_bytes(png(pixels))
        subprocess.run(["ffmpeg", "-v", "error", "-i", source, "-q:v", str(quality), "-bitexact", out], check=True)
        return out.read_bytes()


def main():
    vertices, triangles = surface()
    normals = normals_of(vertices, triangles)
    turned = lambda p: (p[0], p[2], -p[1])  # y up
    places = [turned(p) for p, _ in vertices]
    blocks = [b"".join(struct.pack("<3f", *p) for p in places),
              b"".join(struct.pack("<3f", *turned(n)) for n in normals),
              b"".join(struct.pack("<2f", at[0], 1 - at[1]) for _, at in vertices),  # glTF counts v from above
              b"".join(struct.pack("<3H", *t) for t in triangles)]
    blocks += [jpeg(pixels, quality) for pixels, quality in zip(maps(), (4, 4, 8))]
    views, data = [], b""
    for block in blocks:
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(block)})
        data += block + bytes(-len(block) % 4)
    low = [min(p[i] for p in places) for i in range(3)]
    high = [max(p[i] for p in places) for i in range(3)]
    accessor = lambda view, kind, count, component=5126, **more: {
        "bufferView": view, "componentType": component, "count": count, "type": kind, **more}
    gltf = {
        "asset": {"version": "2.0", "generator": "make_drum.py"},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "drum"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3,
                                    "material": 0}]}],
        "materials": [{"name": "limestone", "normalTexture": {"index": 1}, "pbrMetallicRoughness": {
            "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 2}, "metallicFactor": 0}}],
        "textures": [{"source": i} for i in range(3)],
        "images": [{"bufferView": 4 + i, "mimeType": "image/jpeg"} for i in range(3)],
        "accessors": [accessor(0, "VEC3", len(places), min=low, max=high), accessor(1, "VEC3", len(places)),
                      accessor(2, "VEC2", len(places)), accessor(3, "SCALAR", 3 * len(triangles), 5123)],
        "bufferViews": views, "buffers": [{"byteLength": len(data)}]}
    text = json.dumps(gltf, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    whole = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data))
    whole += struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    Path(__file__).with_name("drum.glb").write_bytes(whole)


if __name__ == "__main__":
    main()
