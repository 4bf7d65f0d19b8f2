# SPDX-License-Identifier: MIT
"""First inputs of the harnesses of scenes: poses, worlds, cameras, and the files of depth images."""
import base64
import struct

from input_words import COUPLED, HEALPIX, amounts, directions, fractions, number, subject, word


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
    shorts = struct.pack("<12h3H", 0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0, 0, 1, 2) + bytes(12)
    quantized = text % inline
    for old, new in ((b'5126', b'5122,"normalized":true'), (b'"byteLength":36', b'"byteLength":24,"byteStride":8'),
                     (b'"byteOffset":36', b'"byteOffset":24'),
                     (b'{"asset"', b'{"extensionsRequired":["KHR_mesh_quantization"],"asset"'),
                     (base64.b64encode(triangle), base64.b64encode(shorts))):
        quantized = quantized.replace(old, new)
    chunk = text % b""
    chunk += b" " * (-len(chunk) % 4)
    binary = triangle + b"\0" * (-len(triangle) % 4)
    whole = 12 + 8 + len(chunk) + 8 + len(binary)
    glb = struct.pack("<III", 0x46546c67, 2, whole) + struct.pack("<II", len(chunk), 0x4e4f534a) + chunk
    glb += struct.pack("<II", len(binary), 0x004e4942) + binary
    return {
        "text": bytes([0]) + text % inline,
        "binary": bytes([1]) + glb,
        "quantized": bytes([0]) + quantized,
        "obj": bytes([2]) + b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 -2 -1\n",
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
        "near": bytes([1]) + size + sized(0.5, 0.5, 0.4, 0.3) + bytes([1, 6]) + sized(*[0.0] * 5) + raw(-1e200) + sized(0.1) + places,
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
    return {"whole": b"0" + whole, "mended": b"1" + whole, "cut": b"1" + whole[:-60], "empty": b"0" + head,
            "two": b"1" + whole + whole}


def tof_inputs():
    """What a frame is made of, in the order of the harness; bytes that turn its kinds on one after another."""
    def frame(step, kinds):
        return bytes((i * step + kinds) % 251 for i in range(700))
    return {"plain": bytes(700), "kinds": frame(37, 0), "motion": frame(83, 64), "measured": frame(101, 1), "short": bytes([7] * 60)}


def compensate_inputs():
    """A size; a picture, a flow, a part; a count and a limit; a scheme and channels of pictures and flows."""
    def values(count, step):
        return bytes((i * step) % 220 for i in range(count))
    def whole(width, height, scheme, channels):
        pixels = width * height
        return (bytes([width, height]) + values(pixels, 37) + values(2 * pixels, 3) + bytes([1]) + amounts(0.5) + word(15) +
                number("d", 2.0) + bytes([scheme, channels]) + values(6 * pixels * channels, 11) + number("d", 5.0))
    return {**{f"scheme-{scheme}": whole(7, 6, scheme, 4) for scheme in range(6)}, "pixel": whole(1, 1, 0, 2),
            "unknown": bytes([5, 4]) + bytes([225]) * 400, "none": bytes([0, 3]) + bytes(60)}


INPUTS = {
    "compensate": compensate_inputs(),
    "tof": tof_inputs(),
    "camera": camera_inputs(),
    "depth": depth_inputs(),
    "raster": raster_inputs(),
    "pose": pose_inputs(),
    "pool": pool_inputs(),
    "random": random_inputs(),
    "budget": budget_inputs(),
    "trajectory": trajectory_inputs(),
    "world": world_inputs(),
    "scene_text": scene_text_inputs(),
    "mesh_file": mesh_file_inputs(),
    "store": store_inputs(),
    "store_file": store_file_inputs(),
    "ply": ply_inputs(),
    "npy": npy_inputs(),
    "view_stream": view_stream_inputs(),
}
