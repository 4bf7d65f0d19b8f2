# SPDX-License-Identifier: MIT
"""First inputs of the harnesses of images: surfaces, resampling, environments, and files of pixels."""
import struct
import zlib

from input_words import COUPLED, GNOMONIC, HEALPIX, QSC, TANGENT, fractions, number, points, subject, word


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


INPUTS = {
    "environment": environment_inputs(),
    "panorama": panorama_inputs(),
    "surface": surface_inputs(),
    "resample": resample_inputs(),
    "whole_png": whole_png_inputs(),
    "geo_tags": geo_tags_inputs(),
    "texture": texture_inputs(),
    "pnm": pnm_inputs(),
    "fits_cards": fits_cards_inputs(),
}
