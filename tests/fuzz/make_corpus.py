#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes those first inputs of the harnesses that are not text into corpus/, beside this script.

Each function below packs what the harness of that name takes from its input, in the same order. The
inputs that are text stand in corpus/ as they are.
"""
import base64
import pathlib
import struct
import zlib

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"

STANDARD, PARAMETERS = 1, 129  # what follows the number of a mapping: also the number of a frame
GNOMONIC, TANGENT, QSC, COUPLED, SMOOTHSTEP, HEALPIX = 0, 1, 4, 10, 13, 15

# the kinds of directions and points
RAW, FRACTION, ANY_SIZE, BESIDE, HARD = range(5)


def word(value):
    return struct.pack("<I", value & 0xFFFFFFFF)


def number(form, *values):
    return struct.pack("<%d%s" % (len(values), form), *values)


def fractions(*values):
    """Numbers in [-1, 1)."""
    return b"".join(word(int((value + 1) * 2**31)) for value in values)


def subject(mapping, choice=STANDARD, instructions=3):
    """instructions: the number of the set, modulo how many there are; 0 is scalar."""
    return bytes([mapping, choice, instructions])


def middle_parameter():
    return fractions(0.0) + bytes([3])


def directions(form):
    """One of each kind, without what stands before it."""
    return [
        bytes([RAW]) + number(form, 1.0, 0.5, -0.25),
        bytes([RAW]) + number(form, float("nan"), 0.0, 1.0),
        bytes([FRACTION]) + fractions(0.3, -0.2, 0.9),
        bytes([ANY_SIZE]) + word(4711),
        bytes([BESIDE]) + word(123456) + bytes([9, 7, 8]),
        bytes([HARD]) + word(1000001),
    ]


def points(form):
    """One of each kind; those of BESIDE are numbered otherwise than those of directions."""
    return [
        bytes([0]) + number(form, 0.5, -0.25),
        bytes([0]) + number(form, float("inf"), 0.0),
        bytes([1]) + fractions(0.3, -0.99),
        bytes([2]) + word(97) + bytes([9, 7]),
        bytes([3]) + word(98) + bytes([255, 120]),
        bytes([4]) + word(1234),
    ]


def points_inputs(form):
    body = b"".join(bytes([0]) + one for one in directions(form))
    body += b"".join(bytes([1]) + one + bytes([3]) for one in points(form))
    body += b"".join(bytes([2]) + one for one in points(form))
    return {
        "gnomonic": subject(GNOMONIC) + body,
        "coupled": subject(COUPLED) + body,
        "healpix": subject(HEALPIX) + body,
        "tangent-c": subject(TANGENT, PARAMETERS) + middle_parameter() + body,
        "smoothstep-c": subject(SMOOTHSTEP, PARAMETERS) + middle_parameter() + body,
    }


def arrays_inputs(form):
    places = bytes([5, 1, 0, 3])
    forward = word(0) + b"".join(directions(form)) + places + bytes([2])
    inverse = word(0) + b"".join(bytes([3]) + one for one in points(form)) + places + bytes([4, 1])
    return {
        "forward-6": subject(COUPLED) + bytes([1]) + word(6) + bytes([0, 3]) + forward,
        "inverse-6": subject(COUPLED) + bytes([1]) + word(6) + bytes([1, 1]) + inverse,
        "forward-513": subject(QSC, instructions=0) + bytes([0]) + word(513) + bytes([0, 1]) + forward,
        "inverse-257": subject(HEALPIX) + bytes([0]) + word(257) + bytes([1, 0]) + inverse,
        "none": subject(GNOMONIC) + bytes([1]) + word(0) + bytes([0, 0]),
    }


def threads_inputs():
    """How many threads, least and elements; the rest is read as a second one of these."""
    def one(threads, least, count):
        return bytes([threads]) + word(least) + number("Q", count)
    return {
        "none": one(4, 64, 0),
        "one": one(1, 64, 1000),
        "few": one(3, 64, 1000) + one(0, 0, 64),
        "many": one(16, 1, 16 * 64 + 1) + one(16, 64, 2**64 - 1),
    }


def lonlat_inputs():
    angles = [
        bytes([0]) + number("d", 0.7),
        bytes([1]) + fractions(0.25),
        bytes([2 + 4 * 5, 10]),
        bytes([3 + 4 * 3, 200]),
    ]
    both = [lon + lat for lon in angles for lat in angles]
    steps = zip(both, 3 * directions("d"), 3 * points("d"))
    body = b"".join(angle + direction + point + bytes([3]) for angle, direction, point in steps)
    return {"coupled": subject(COUPLED) + body, "healpix": subject(HEALPIX) + body}


def grid_inputs():
    """A mapping, an ellipsoid, a latitude, a rotation, and points of both sides."""
    ellipsoids = [bytes([0, 3]), bytes([0, 0]) + number("d", 0.1), bytes([0, 0]) + number("d", -9.0),
                  bytes([0, 2]) + fractions(0.9)]
    steps = zip(directions("d"), points("d"))
    body = b"".join(direction + point + bytes([2, 0]) + fractions(0.3, 0.4) for direction, point in steps)
    return {
        "grid-%d" % i: subject(mapping) + ellipsoid + bytes([3 + i]) + fractions(0.2, 0.1, -0.3) + bytes([i]) + body
        for i, (mapping, ellipsoid) in enumerate(zip([COUPLED, QSC, HEALPIX, TANGENT], ellipsoids))
    }


def healpix_inputs():
    def resolution(kind, nside, order):
        return bytes([kind]) + number("q", nside) + bytes([order, 3])

    points = b"".join(bytes([0]) + word(977 * i) for i in range(7))
    points += b"".join(bytes([1]) + number("d", 0.5 * i, 0.1, -0.7) for i in range(6))
    points += b"".join(bytes([2]) + fractions(0.1 * i, 0.5, -0.9) for i in range(6))
    pixels = b"".join(bytes([i % 4]) + number("Q", 2**40 * i + i) for i in range(19))
    maps = bytes([2]) + bytes([3, 1, 7, 0, 0, 1]) + fractions(-0.5)
    maps += number("d", *[0.5 * i for i in range(20)], float("nan"), -1.6375e30)
    return {
        "nested": resolution(0, 29, 1) + points + pixels + maps,
        "ring": resolution(0, 29, 0) + points + pixels + maps,
        "seven": resolution(100, 7, 0) + points + pixels + maps,
        "one": resolution(0, 0, 1) + points + pixels + maps,
        "none": resolution(200, -1, 0) + maps,
    }


def frames_inputs():
    table = bytes([0]) + bytes([3, 1, 2, 0, 3, 6, 1, 5, 0, 2, 0, 7])
    body = b"".join(directions("d"))
    axes = ((1, 2, 3), (2, -1, 3), (-1, -2, 3), (-2, 1, 3), (3, 2, -1), (-3, 2, 1))
    # size, two texts, the sign of rows and padding, then a text, three axes and padding a face
    raw = number("Q", 0, 0, 0) + number("i", 1, 0)
    raw += b"".join(number("Q", 0) + number("b", *axis) + bytes(5) for axis in axes)
    return {
        "any": bytes([2]) + table + subject(COUPLED) + body,
        "spoilt": bytes([1]) + table + bytes([12, 4]) + subject(COUPLED) + body,
        "spoilt-not": bytes([1]) + table + bytes([1, 1]) + subject(QSC) + body,
        "raw": bytes([0]) + raw + subject(GNOMONIC) + body,
    }


def degrees_inputs():
    steps = zip(range(0, 60, 10), directions("d"))
    inputs = {"one-of-each": b"".join(bytes([turn]) + one + bytes([9]) for turn, one in steps)}
    for name, components in {
        "smallest": (5e-324, 5e-324, 5e-324),
        "small": (1e-310, -2e-310, 3e-310),
        "largest": (1.7976931348623157e308,) * 3,
    }.items():
        inputs[name] = bytes([0, RAW]) + number("d", *components) + bytes([9])
    return inputs


def amounts(*values):
    """Small numbers as the harnesses of scenes take them: a kind of which the rest by 8 is the number, and halves of 1."""
    return b"".join(bytes([32 + int(value)]) if value == int(value) else bytes([200]) + fractions(value)
                    for value in values)


def pose_inputs():
    """Two twists, a place between, and a quaternion; then any pose."""
    numbers = amounts(*[0.5, -0.25, 0.125, 0.3, -0.7, 0.1, 0.9, -0.9, 0.6, 0.2, -0.4, 0.8, 0.5])
    quaternion = bytes([1]) + amounts(*[0.1, 0.2, 0.3, 0.5, -0.5, 0.5, 0.5])
    raw = bytes([0]) + number("d", float("nan"))
    half_turn = bytes([160 + 4]) * 12
    return {
        "some": numbers + quaternion + amounts(*[0.5] * 12),
        "half-turn": half_turn + amounts(0.5) + quaternion,
        "none": raw * 12 + quaternion,
        "rest": bytes([0]) * 200,
    }


def pool_inputs():
    """A pool and what is within, elements, the least of a piece."""
    return {
        "one": bytes([1, 0, 100, 1]),
        "many": bytes([3, 2, 0, 1, 2 + 4, 1, 3, 7, 3 + 8, 1, 255, 0]),
        "none": bytes([3, 0, 0, 1, 0, 1, 1, 1]),
        "greatest": bytes([195, 1, 0, 3, 255, 0, 9, 9]),
    }


def random_inputs():
    """Seed, view, first pixel, sample, how many, a block, their means."""
    place = word(1) + word(2) + word(3) + word(2**32 - 2) + word(5)
    means = b"".join(bytes([0]) + number("d", mean) for mean in (0.5, 9.999, 10.0, 1e3, 1e9, -1.0, float("nan"), 1e300))
    return {"some": place + bytes([8]) + word(7) + means, "none": place + bytes([0]) + word(0)}


def budget_inputs():
    """Its size, how many, a limit; of each flags, six bytes of its name, and amounts; the rest is the subject."""
    def entry(flags, name, contribution, cost):
        return bytes([flags]) + name + bytes([32 + contribution, 32 + cost])
    entries = entry(3, b"noise ", 1, 2) + entry(0, b"blur\n\xff", 5, 0) + entry(2, b"m" + bytes(5), 3, 7)
    return {
        "three": bytes([0, 3, 36]) + entries + b'of "all"',
        "none": bytes([0, 0, 32]) + b"nothing",
        "refused": bytes([0, 3, 4]) + number("d", -1.0) + entries,
    }


def trajectory_inputs():
    """Two trajectories, a time, then what is done with them."""
    def poses(count, gap):
        steps = [bytes([gap]) + amounts(*[0.1 * i - 0.5, 0.5, 0.25, 0.125, 0.01 * i, -0.3]) for i in range(count)]
        return bytes([count]) + amounts(1) + b"".join(steps)
    rest = amounts(1.5 - 1.0) + amounts(4, 0, 1, 0.1, 0.01, 0.001) + amounts(1) + bytes([0]) + amounts(0, 0)
    return {
        "two": poses(12, 20) + poses(12, 20) + rest,
        "near": poses(20, 1) + poses(9, 2) + rest,
        "one": poses(1, 9) + poses(2, 9) + rest,
        "none": poses(0, 0) + poses(3, 0) + rest,
        "far": bytes([3, 0]) + number("d", 1e300) + poses(3, 200) + rest,
    }


def rotation_inputs():
    """A direction, three angles, an element to change, one of the table, a text."""
    def one(direction, angles, text):
        return direction + angles + bytes([4]) + number("d", 0.5) + bytes([0]) + text
    turned = b"".join(bytes([0]) + number("d", angle) for angle in (17.0, -10.0, 32.0))
    quarters = b"".join(bytes([1 + 3 * turn, 8]) for turn in (5, 4, 2))
    texts = [b"17,-10,32", b"0,90", b"land-coupled", b"1,91,0", b"1,2,3,4"]
    return {
        "one-%d" % i: one(direction, quarters if i % 2 else turned, text)
        for i, (direction, text) in enumerate(zip(directions("d"), texts))
    }


def world_inputs():
    """A mesh: size, arrays, vertices, triangles, their numbers, indices, material; a world; primitives; rays."""
    def one(*values):
        return b"".join(bytes([int(4 * value + 16) + 32]) if value % 2 else bytes([0]) + number("d", value)
                        for value in values)
    triangle = bytes([0, 0x41, 3, 1]) + one(1, 0, 0, 0, 1, 0, 0, 0, 1) + bytes([0, 1, 2, 1])
    standing = bytes([1, 1]) + one(1, 2, 3, 4, 5, 6)
    rays = bytes([3]) + one(*3 * (0, 0, 1, 1, 0.5, -0.25)) + bytes([1])
    plain = {kind: bytes([9, 1, index]) + one(-1, 1, 0, -1, 1, 0, -1, 1.5, 0, 1) + bytes([1]) + one(1, 1, 1) + bytes([1])
             for index, kind in enumerate(("plane", "box", "sphere", "cylinder", "mesh"))}
    worlds = {name: bytes([index, 0]) for index, name in enumerate(("room", "corridor", "spheres"))}
    return {name: triangle + body + rays for name, body in {**plain, **worlds, "standing": standing}.items()}


def scene_text_inputs():
    """Worlds of JSON."""
    return {
        "all": b'{"planes":[{"point":[0,0,0],"normal":[0,0,1],"color":[0.5,0.5,0.5]}],'
               b'"boxes":[{"min":[0,0,0],"max":[1,1,1],"reflectance":0.5}],"spheres":[{"centre":[0,0,0],"radius":1}],'
               b'"cylinders":[{"from":[0,0,0],"to":[0,0,1],"radius":0.5}]}',
        "mesh": b'{"meshes":[{"file":"a.glb","position":[0,0,0],"quaternion":[0,0,0,1],"color":[1,1,1]}]}',
        "unknown": b'{"cones":[]}',
        "none": b"{}",
    }


def mesh_file_inputs():
    """What kind of file, and the file."""
    triangle = struct.pack("<9f3H", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)
    text = (b'{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[2,2,2]}],'
            b'"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],'
            b'"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},'
            b'{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],'
            b'"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],'
            b'"buffers":[{%s"byteLength":42}]}')
    inline = b'"uri":"data:application/octet-stream;base64,' + base64.b64encode(triangle) + b'",'
    chunk = text % b""
    chunk += b" " * (-len(chunk) % 4)
    binary = triangle + b"\0" * (-len(triangle) % 4)
    whole = 12 + 8 + len(chunk) + 8 + len(binary)
    glb = struct.pack("<III", 0x46546c67, 2, whole) + struct.pack("<II", len(chunk), 0x4e4f534a) + chunk
    glb += struct.pack("<II", len(binary), 0x004e4942) + binary
    return {
        "text": bytes([0]) + text % inline,
        "binary": bytes([1]) + glb,
        "obj": bytes([2]) + b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 -2 -1\n",
    }


def cells_inputs():
    """A grid, a number, a level and steps, a place, room for a token, points, a region, cells, a text."""
    def one(grid, cell, region, kind, text):
        body = bytes([grid, 1 + 4 * (7 + grid)]) + number("Q", cell) + bytes([5]) + number("q", -77)
        body += bytes([3, 9, 0, 0]) + word(100) + word(300) + bytes([17, 12])
        body += b"".join(9 * directions("d")[:1])
        for angle in region:
            body += number("d", angle) + bytes([0])
        body += bytes([kind]) + (bytes([1, 0]) if kind == 3 else b"")
        body += bytes([0, 12, 20, 0]) + directions("d")[0]
        return body + bytes([2, 5]) + number("Q", 1) + bytes([5]) + number("Q", 2) + text
    corner = (1.0, 2.5, 1.0, 0.1) + 12 * (0.0,)
    box = (0.1, 0.5, 0.7, 1.5) + 12 * (0.0,)
    triangle = (0.1, 0.25, 0.5, 0.3, 0.3, 1.5, 0.2, 1.0) + 8 * (0.0,)
    return {
        "cap": one(0, 1 << 40, corner, 0, b"89c25"),
        "metres": one(2, 12345, (0.3, 0.1, 0.5, 0.0) + 12 * (0.0,), 1, b"X"),
        "box": one(1, 999999, box, 2, b"morton"),
        "polygon": one(3, 31, triangle, 3, b"123g"),
    }


def orient_inputs():
    """Patience, mapping, measure, over, resolution, width, height, twelve values, a name."""
    def one(patience, mapping, measure, over, values, name):
        return bytes([patience, mapping, measure, over, 3, 4, 3]) + bytes(values) + name
    land = [0, 1, 0, 2, 1, 1, 0, 0, 0, 4, 0, 0]
    return {
        "deformation": one(0, TANGENT, 0, 1, land, b"deformation"),
        "edges": one(0, COUPLED, 4, 1, land, b"edges"),
        "over-face": one(0, GNOMONIC, 2, 0, land, b"area"),
        "stopped": one(2, QSC, 1, 1, land, b""),
        "no-mask": one(0, TANGENT, 0, 1, [8] * 12, b"none"),
    }


def advise_inputs():
    terms = bytes([0, 0, 10, 0, 3])                    # WGS 84, a millimetre, geographic to authalic
    sizes = bytes([1]) + fractions(0.0) + bytes([30, 3, 0]) # gnomonic
    limits = bytes([11, 11, 8, 8, 2, 3, 3, 3, 12, 3])  # their numbers
    row = bytes([0, 0, 1, 1, 3, 3])                    # gnomonic in double
    torn = bytes([1, 1, 2, 2, 3, 3])                   # arvo in float

    def request(limited, more):
        return bytes([2, 0]) + word(limited) + bytes([0]) + limits + bytes(more)

    free = [0, 0, 0, 0, 0, 0, 0]
    wishes = [1, 2, 1, 7, 3, 1, 1]  # equal areas, C1, continuous edges, all precisions, single points, WGS 84
    return {
        "terms": terms,
        "sizes": sizes,
        "all": request(0, free) + bytes([2]) + row + torn + bytes([0, 0]),
        "limits": request(0x3FF, free) + bytes([2]) + row + torn + bytes([0, 0]),
        "wishes": request(0x201, wishes) + bytes([2]) + torn + row + bytes([1, 2]),
        "none": request(0, free) + bytes([0]),
        "refused": request(0, [0, 5, 0, 8, 4, 0, 0]) + bytes([1]) + row,
    }


def number_inputs():
    values = [0.1, -1.0, 2.0 / 3.0, 1e22, 1e-7, 123456.789, 5e-324, 1.7976931348623157e308]
    return {
        "bytes": b"".join(bytes([i % 17]) + number("d", value) for i, value in enumerate(values))
    }


def point_lines_inputs():
    """Here only what is long."""
    return {"long-line": b"\x08\x80" + 1200 * b"1 2 " + b"\n3 4\n"}


def latitudes_inputs():
    """An ellipsoid, two latitudes, a tolerance, an instruction set, latitudes and directions."""
    inputs = {}
    for first in range(7):
        second = (first + 3) % 7
        inputs["pair-%d" % first] = (
            bytes([first]) + bytes([1]) + fractions(0.067) + bytes([first, second, 2, 3])
            + b"".join(bytes([1]) + fractions(0.1 * i) + one
                       for i, one in enumerate(directions("d")[:4])))
    inputs["far"] = bytes([0]) + bytes([2 + 3 * 4]) + bytes([3, 4, 2, 3]) + bytes([2, 3])
    inputs["wrong"] = bytes([254, 2, 0, 7])
    return inputs


def png_chunk(name, content):
    check = zlib.crc32(name + content)
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", check)


def whole_png_inputs():
    signature = b"\x89PNG\r\n\x1a\n"
    head = signature + png_chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0))
    whole = head + png_chunk(b"IDAT", zlib.compress(b"\0\x80")) + png_chunk(b"IEND", b"")
    return {"whole": whole, "cut": whole[:-6], "more": whole + b"more", "other": b"no PNG file"}


TEXELS = {"rgba8": (28, 37, 1, 4), "srgb": (29, 43, 1, 4), "rgba16": (11, 91, 2, 8), "half": (10, 97, 2, 8),
          "float": (2, 109, 4, 16)}  # DXGI, Vulkan, bytes of a sample and of a texel


def dds(texel, edge, faces, levels):
    dxgi, _, _, size = TEXELS[texel]
    words = [124, 0x2100F, edge, edge, edge * size, 0, levels] + [0] * 11
    words += [32, 4, 0x30315844] + [0] * 5 + [0x401008, 0xFE00 if faces == 6 else 0, 0, 0, 0]
    words += [dxgi, 3, 4 if faces == 6 else 0, 1, 1]
    return b"DDS " + number("I", *words) + bytes(range(256)) * 8


def ktx(texel, edge, faces, levels, orientation=b"rd"):
    _, vulkan, sample, size = TEXELS[texel]
    index_end = 80 + 24 * levels
    keys = b"KTXorientation\0" + orientation + b"\0"
    keys = word(len(keys)) + keys + bytes(-len(keys) % 4)
    head = b"\xabKTX 20\xbb\r\n\x1a\n" + number("I", vulkan, sample, edge, edge, 0, 0, faces, levels, 0)
    head += number("I", index_end, 28, index_end + 28, len(keys)) + number("Q", 0, 0)
    lengths = [max(edge >> level, 1) ** 2 * size * faces for level in range(levels)]
    begin = index_end + 28 + len(keys)
    begin += -begin % size
    places = [begin + sum(lengths[level + 1:]) for level in range(levels)]
    index = b"".join(number("Q", place, length, length) for place, length in zip(places, lengths))
    data = word(28) + bytes(20) + word(size) + keys
    return (head + index + data).ljust(begin, b"\0") + bytes(i % 251 for i in range(sum(lengths)))


def texture_inputs():
    inputs = {"cut.dds": dds("rgba8", 2, 6, 1)[:120], "other": b"no texture",
              "upwards.ktx2": ktx("half", 1, 1, 1, b"ru")}
    for texel in TEXELS:
        inputs[texel + ".dds"] = dds(texel, 2, 6, 2)
        inputs[texel + ".ktx2"] = ktx(texel, 2, 6, 2)
    return inputs


def pnm_inputs():
    """A byte that says whether samples are bare, and the stream."""
    texts = {
        "pgm": b"P5 # grey\n3 2\n255\nabcdef",
        "pgm-16": b"P5\n2 1\n1000\n\x00\x10\x03\xe8",
        "ppm": b"P6\n1 2\n255\nabcdefP6\n1 1\n15\n\x01\x0f\x05",
        "pam": b"P7\n# made by hand\nWIDTH 2\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\nabcdefgh",
        "pam-16": b"P7\nWIDTH 1\nHEIGHT 1\nDEPTH 2\nMAXVAL 65535\nTUPLTYPE GRAYSCALE_ALPHA\nENDHDR\nabcd",
        "pfm": b"Pf\n2 1\n-1.0\n" + number("f", 0.5, float("nan")),
        "pfm-color": b"PF\n1 1\n2.5\n" + struct.pack(">3f", 1.0, float("inf"), -0.0),
        "cut": b"P6\n4 4\n255\nabc",
        "large": b"P5\n1048576 1048576\n65535\n",
        "above": b"P5\n1 1\n7\n\x08",
        "other": b"P4\n1 1\n\0",
    }
    inputs = {name: b"\0" + text for name, text in texts.items()}
    inputs["bare"] = bytes([0b00110011]) + bytes(range(24))
    inputs["bare-floats"] = bytes([0b11100001]) + number("f", 1.0, -2.0, 3.0)
    return inputs


def fits_cards_inputs():
    cards = ["SIMPLE  =                    T / conforms", "NAXIS1  =                  512", "BZERO   =               32768.0",
             "BSCALE  =             1.0D-003", "OBJECT  = 'it''s a name'       / quoted", "COMMENT   text without a value",
             "HISTORY = 'not closed", "EMPTY   =", "ORDER   =  -9223372036854775807 ", "LONG    = '" + 68 * "'", "END"]
    text = "".join(card.ljust(80) for card in cards).encode()
    return {"head": text, "one": text[:80], "odd": text[40:160], "byte": b"KEY     = \x7f"}


def store_inputs():
    """Steps: 0 to 7 put, 8 to 11 remove, 12 and 13 commit, 14 rollback, 15 bad arguments; times 16 the key."""
    return {"steps": bytes([0x00, 5, 65, 0x10, 200, 66, 12, 0x20, 3, 67, 8, 14, 0x30, 9, 68, 13]),
            "arguments": bytes([15, 1, 2, 0x40, 0, 1, 15, 0, 0, 12])}


def store_file_inputs():
    """Bytes and the places where they are written, three bytes each; or F and a file."""
    return {"good": b"E", "other-program": b"E" + word(68 << 8 | 88), "newer": b"E" + word(63 << 8 | 2),
            "pages": b"E" + b"".join(word((page * 4096 + 5) << 8 | 9) for page in range(1, 5)), "text": b"Fno store"}


def ply_inputs():
    head = (b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            b"property float z\nelement face 1\nproperty list uchar uint vertex_index\nend_header\n")
    return {"binary": head + number("f", *range(9)) + bytes([3]) + number("I", 0, 1, 2)}


def npy_inputs():
    def one(text, data):
        return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text + data
    return {"float": one(b"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }\n", number("f", 1, 2, 3, 4)),
            "whole": one(b"{'descr': '>u2', 'fortran_order': True, 'shape': (1, 3), }\n", number("H", 1, 2, 3)),
            "half": one(b"{'descr': '<f2', 'fortran_order': False, 'shape': (1, 1), }\n", b"\x00\x3c")}


def check_sum(data):
    """FNV-1a of 64 bits."""
    total = 14695981039346656037
    for byte in data:
        total = (total ^ byte) * 1099511628211 % 2**64
    return struct.pack("<Q", total)


def view_stream_inputs():
    camera = b'{"width":2,"height":2,"fx":2,"fy":2,"cx":0.5,"cy":0.5}'
    head = b"CMVIEWS1" + number("I", len(camera), 0) + check_sum(camera) + camera
    pixels = number("H", 1, 2, 3, 4) + bytes(range(12))
    view = (b"VIEW" + word(192) + number("d", 1.5, 1, 0, 0, 0, 1, 0, 0, 0, 1, 3, 4, 5, 0.001) + number("I", 0, 0, 2, 2) +
            number("I", 1, 1, 0, 3, 0, 0) + number("Q", len(pixels)) + check_sum(pixels) + number("Q", 0))
    end = b"DONE" + word(24) + number("Q", 1)
    whole = head + view + check_sum(view) + pixels + end + check_sum(end)
    return {"whole": b"0" + whole, "mended": b"1" + whole, "cut": b"1" + whole[:-60], "empty": b"0" + head}


def tiff_directory(order, big, tags, offset, following=0):
    """The directory at that offset, and behind it the contents that do not fit into it; tags are (number, type, bytes)."""
    size = {2: 1, 3: 2, 12: 8}
    count, entry, wide = ("Q", "HHQ", 8) if big else ("H", "HHI", 4)
    end = offset + struct.calcsize(order + count) + len(tags) * (4 + 2 * wide) + wide
    directory, behind = struct.pack(order + count, len(tags)), b""
    for number, kind, content in tags:
        directory += struct.pack(order + entry, number, kind, len(content) // size[kind])
        if len(content) <= wide:
            directory += content.ljust(wide, b"\0")
        else:
            directory += struct.pack(order + entry[-1], end + len(behind))
            behind += content
    return directory + struct.pack(order + entry[-1], following) + behind


def geo_tags_inputs():
    inputs = {}
    for name, order, big in (("little", "<", False), ("big", ">", False), ("bigtiff", "<", True)):
        head = {"<": b"II", ">": b"MM"}[order] + (struct.pack(order + "HHHQ", 43, 8, 0, 16) if big
                                                   else struct.pack(order + "HI", 42, 8))
        tags = [(33550, 12, struct.pack(order + "3d", 0.5, 0.25, 0)), (33922, 12, struct.pack(order + "6d", 0, 0, 0, -180, 90, 0)),
                (34735, 3, struct.pack(order + "8H", 1, 1, 1, 1, 1024, 0, 1, 2)), (34736, 12, struct.pack(order + "d", 6378137)),
                (34737, 2, b"WGS 84|\0"), (42113, 2, b"-99\0")]
        inputs[name] = b"\0" + head + tiff_directory(order, big, tags, len(head))
        inputs[name + "-cut"] = inputs[name][:-20]
    inputs["other"] = b"\0no TIFF file"
    return inputs


def surface_inputs():
    """A specification behind a rotation and the size of the picture, then positions."""
    def one(text, width=0, height=0, turned=0):
        text = text.encode()
        return (bytes([turned]) + fractions(0.1, 0.2, 0.3) + word(width) + word(height) + bytes([len(text)]) + text +
                bytes([0]) + fractions(0.5, -0.5) + bytes([1]) + fractions(-0.99, 0.25))

    return {
        "equirect": one("equirect", 64),
        "part": one("equirect;west=-10;east=170.5;north=45;size=33"),
        "cube": one("cube:coupled;frame=gl;layout=strip", 60, 10, 1),
        "chart": one("azimuthal:equidistant:fov=200;size=31", turned=1),
        "mercator": one("mercator;size=100;height=70"),
        "wrong-key": one("cube;depth=3", 8),
        "wrong-size": one("cube:qsc;layout=3x2", 7, 5),
        "no-kind": one(";;=:", 8),
        "view": one("view:fov=90,lon=30,lat=20,roll=5,shift-x=0.4;size=64;aspect=1.5"),
        "fisheye": one("fisheye:equisolid:fov=220;size=40;height=20;x=11.5;y=7;radius=13.25"),
        "pair": one("dual-fisheye:lambert:fov=190;size=44", turned=1),
        "paraboloids": one("dual-paraboloid", 40, 20),
        "healpix": one("healpix:7"),
        "cross": one("cube:tangent;frame=s2;layout=cross:north=0,south=2;size=8"),
        "eac": one("cube:tangent;frame=geo;layout=eac:pad=3;size=7"),
        "preset": one("unreal"),
    }


def resample_inputs():
    """Options, two surfaces with their types, pixels."""
    def scene(surface, size, kind, turned=0):
        return bytes([kind]) + fractions(0.3, -0.4) + bytes([turned, surface, size])

    def one(channels, options, source, target):
        return bytes([channels]) + bytes(options) + source + target + bytes(range(256)) * 3

    plain = [2, 0, 0, 0, 0, 0, 0, 0, 0]
    return {
        "bilinear": one(2, plain, scene(0, 16, 0), scene(4, 6, 0)),
        "nearest": one(0, [1] + plain[1:], scene(5, 5, 2), scene(9, 20, 1)),
        "lanczos": one(3, [5, 1, 0, 1, 4, 0, 0, 0, 1], scene(7, 9, 3), scene(11, 12, 0)),
        "spline": one(4, [7, 2, 9, 2, 0, 0, 1, 1, 0], scene(6, 8, 3, 1), scene(3, 17, 3)),
        "text": b"cubemap-plan 1\nfrom equirect;size=8\nto cube:coupled;size=3\nto-rotation 0 1 0 -1 0 0 0 0 1\n"
                b"filter mitchell\ngamma 2.2\nalpha 4\n",
        "ewa": one(2, [8, 0, 30, 0, 0, 0, 0, 0, 0], scene(0, 20, 0), scene(8, 2, 0)),
        "views": one(2, [8, 0, 30, 0, 0, 0, 0, 0, 0], scene(15, 20, 0, 1), scene(16, 12, 3)),
        "fisheyes": one(1, [5] + plain[1:], scene(18, 20, 1), scene(20, 15, 0)),
        "pairs": one(2, [7] + plain[1:], scene(21, 20, 0), scene(23, 15, 0)),
        "healpix": one(2, [3] + plain[1:], scene(24, 8, 0), scene(22, 9, 0)),
        "crosses": one(2, [4] + plain[1:], scene(25, 8, 0), scene(27, 9, 1)),
        "eac": one(2, [6] + plain[1:], scene(28, 8, 2), scene(29, 9, 3)),
    }


def environment_inputs():
    """A part, a mapping, then what that part takes."""
    def numbers(count):
        return fractions(*[0.7 * ((37 * i) % 101) / 50.5 - 0.7 for i in range(count)])

    points = b"".join(bytes([1]) + fractions(0.3, -0.2, 0.1 * i) for i in range(5))
    harmonics = bytes([3, 1]) + numbers(32) + points + fractions(0.1, 0.2, 0.3) + bytes([1]) + fractions(-0.5)
    harmonics += bytes([1, 64, 1, 3, 4])

    def environment(kind, flat, method):
        """Solid angles, faces, how they are filtered, another picture's faces."""
        return (bytes([5, 2, 2, kind, 5, 3, flat, 63]) + (b"" if flat else bytes(range(256)) * 12) +
                bytes([3, 6]) + bytes([method, 1, 0, 30, 1, 3, 1, 1]) + bytes([1]) + fractions(0.2))
    return {
        "brdf": bytes([0]) + subject(COUPLED) + bytes([0, 1]) + fractions(0.5, -0.4, -0.92) + bytes([2, 2, 1]),
        "harmonics": bytes([1]) + subject(GNOMONIC) + harmonics,
        "cells": bytes([2]) + subject(COUPLED) + environment(3, 1, 1),
        "spiral": bytes([2]) + subject(QSC) + environment(3, 0, 2),
        "hammersley": bytes([2]) + subject(TANGENT) + environment(0, 1, 3),
        "all": bytes([2]) + subject(HEALPIX) + environment(1, 0, 5),
    }


def panorama_inputs():
    """Fields, and texts."""
    def fields(*words):
        return bytes([0]) + word(64) + word(32) + bytes([1]) + b"".join(map(word, words))

    angles = bytes([3]) + fractions(0.4) + bytes([3]) + fractions(-0.2) + bytes([3]) + fractions(0.1)
    name = b"http://ns.google.com/photos/1.0/panorama/"
    text = (b'<x xmlns:GPano="' + name + b'" GPano:ProjectionType="equirectangular" GPano:FullPanoWidthPixels="640" '
            b'GPano:FullPanoHeightPixels="320" GPano:CroppedAreaLeftPixels="10" GPano:CroppedAreaTopPixels="3" '
            b'GPano:CroppedAreaImageWidthPixels="200" GPano:CroppedAreaImageHeightPixels="100" '
            b'GPano:PosePitchDegrees="5.5" GPano:PoseRollDegrees="-3"/>')
    return {
        "whole": fields(640, 320, 0, 0, 640, 320) + angles,
        "part": fields(1000, 500, 17, 33, 200, 100) + angles,
        "attributes": bytes([1]) + text,
        "elements": bytes([1]) + b'xmlns:a="' + name + b'"><a:FullPanoWidthPixels> 64 </a:FullPanoWidthPixels>'
                    b"<a:FullPanoHeightPixels>32<",
        "cut": bytes([1]) + text[:-30],
        "specification": bytes([1]) + b"equirect;west=-90;east=90;south=0;north=90",
        "no-panorama": bytes([1]) + b"cube",
    }


def camera_inputs():
    """Sizes, focal lengths, coefficients, points and pixels, or a mapping."""
    def sized(*values):
        return b"".join(bytes([1]) + fractions(value) for value in values)

    def raw(*values):
        return b"".join(bytes([0]) + number("d", value) for value in values)

    size = bytes([1, 1])
    places = b"".join(one + sized(0.2, 0.1) for one in directions("d")[2:])
    lens = sized(-0.3, 0.1, 0.01, -0.01, 0.02, 0.1, 0.0, 0.0, 0.01, 0.0, 0.01, 0.0, 0.1, -0.1)
    return {
        "plain": bytes([1]) + size + sized(0.5, 0.5, 0.4, 0.3) + bytes([1, 0]) + sized(0.1) + places,
        "lens": bytes([1]) + size + sized(0.5, 0.5, 0.4, 0.3) + bytes([1, 14]) + lens + sized(0.1) + places,
        "fold": bytes([1]) + size + sized(0.5, -0.5, 0.4, 0.3) + bytes([1, 2]) + sized(-0.9, 0.3) + sized(0.1) + places,
        "none": bytes([1]) + size + raw(float("nan"), 0.0, 1.0, 1.0) + bytes([1, 0]),
        "huge": bytes([1, 0]) + word(-1) + bytes([0]) + word(-1) + sized(0.5, 0.5, 0.4, 0.3),
        "coupled": bytes([0]) + subject(COUPLED) + bytes([63]) + places,
        "healpix": bytes([0]) + subject(HEALPIX) + bytes([7]) + places,
    }


def depth_inputs():
    """A camera, values of pixels, limits, a box, options."""
    def one(camera, size, kinds):
        pixels = b"".join(bytes([kinds[i % len(kinds)]]) + word(i * 2654435761 % 2**32) for i in range(size))
        rest = bytes([0, 3]) + number("d", 0.5, 0.1, 3.0) + word(1) + word(2) + word(9) + word(7) + bytes([1])
        return bytes([camera, 1]) + pixels + rest
    return {"smooth": one(6, 256, [100]), "lens": one(16 + 2, 85, [100, 101]),
            "holes": one(8 + 6, 256, [1, 2, 3, 205, 215, 255])}


def raster_inputs():
    """A camera, a pose, shapes of twelve numbers each."""
    def one(kind, number_kind):
        numbers = b"".join(bytes([number_kind + i % 5]) + word(i * 2654435761 % 2**32) for i in range(12 * 16))
        return bytes([8 * kind + 2, 1, 1]) + numbers
    return {"kind-%d" % kind: one(kind, 100 if kind % 2 else 0) for kind in range(6)}


INPUTS = {
    "camera": camera_inputs(),
    "depth": depth_inputs(),
    "raster": raster_inputs(),
    "environment": environment_inputs(),
    "panorama": panorama_inputs(),
    "surface": surface_inputs(),
    "resample": resample_inputs(),
    "points_double": points_inputs("d"),
    "points_float": points_inputs("f"),
    "arrays_double": arrays_inputs("d"),
    "arrays_float": arrays_inputs("f"),
    "threads": threads_inputs(),
    "latitudes": latitudes_inputs(),
    "healpix": healpix_inputs(),
    "lonlat": lonlat_inputs(),
    "frames": frames_inputs(),
    "degrees": degrees_inputs(),
    "cells": cells_inputs(),
    "number": number_inputs(),
    "grid": grid_inputs(),
    "rotation": rotation_inputs(),
    "pose": pose_inputs(),
    "pool": pool_inputs(),
    "random": random_inputs(),
    "budget": budget_inputs(),
    "trajectory": trajectory_inputs(),
    "world": world_inputs(),
    "scene_text": scene_text_inputs(),
    "mesh_file": mesh_file_inputs(),
    "orient": orient_inputs(),
    "advise": advise_inputs(),
    "point_lines": point_lines_inputs(),
    "whole_png": whole_png_inputs(),
    "geo_tags": geo_tags_inputs(),
    "texture": texture_inputs(),
    "pnm": pnm_inputs(),
    "store": store_inputs(),
    "store_file": store_file_inputs(),
    "ply": ply_inputs(),
    "npy": npy_inputs(),
    "view_stream": view_stream_inputs(),
    "fits_cards": fits_cards_inputs(),
}


def main():
    for harness, inputs in INPUTS.items():
        folder = CORPUS / harness
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in inputs.items():
            (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()
