# SPDX-License-Identifier: MIT
"""First inputs of the harnesses of lenses, texel images and measures of depth."""
import struct


def fraction(value):
    """What take_fraction makes a number in [-1, 1) of."""
    return struct.pack("<I", round((value + 1.0) * 2**31) % 2**32)


def scaled(value, scale):
    """What take_number of fuzz_lens.c makes a number of."""
    return b"\1" + fraction(value / scale)


def lens_inputs():
    """Size, focal lengths, principal point, centre, distortion; delta, vertices, guard; pinhole, pictures, gap."""
    def camera(*distortion):
        scales = (0.4, 0.2, 0.02, 0.02)
        return bytes([19, 14, 1]) + fraction(0.0) + fraction(0.0) + scaled(0.2, 3.0) + scaled(-0.1, 3.0) + \
            bytes([1, len(distortion)]) + b"".join(map(scaled, distortion, scales))
    vertices = scaled(0.1, 1.0) + b"".join(scaled(value, 3.0) for value in (0.3, 0.2, 1.0, -0.4, 0.5, 2.0)) + \
        b"".join(scaled(value, 3.0) for value in (0.1, 0.2, -1.0, 2.9, 0.5, 1.0)) + b"\1"
    pictures = bytes([1, 0, 1, 20, 21, 22, 90, 200]) + struct.pack("<d", 0.05)
    return {"barrel": camera(-0.1) + vertices + pictures, "pincushion": camera(0.1, 0.05) + vertices + pictures,
            "aslant": camera(-0.05, 0.01, 0.015, -0.01) + vertices + pictures}


def texel_inputs():
    """Options, the buffer, values of the canvas, two poses, a world."""
    def options(columns, spacing):
        return bytes([0, 1]) + fraction(-0.4) + bytes([32, 24, columns, 6, 4, 2, spacing, 1])
    buffer = struct.pack("<dd4f", 0.1, 20.0, 0.0, 0.5, 0.999, 1.0)
    values = bytes([20, 30, 2, 3, 90])
    poses = b"".join(b"\1" + fraction(value / 10.0) for value in range(-6, 6))
    return {"spaces": options(8, 0) + buffer + values + poses + b"\0",
            "angles": options(9, 1) + buffer + values + poses + b"\2"}


def depth_error_inputs():
    """Depth, truth, a limit, confidences, a measure, coordinates, edges, a checkerboard."""
    truth = bytes(range(20, 44))
    near = bytes(value + value % 3 for value in truth)
    holes = bytes(235 if value % 5 == 0 else value for value in truth)
    rest = struct.pack("<d", 0.1) + bytes(range(40, 64)) + bytes([0, 1]) + bytes(range(90, 114))[::-1] + \
        struct.pack("<dB4d", 0.1, 1, 1.0, 0.085, 0.01, 4e-6)
    return {"near": near + truth + rest, "holes": holes + truth + rest}


INPUTS = {"depth_error": depth_error_inputs(), "lens": lens_inputs(), "texel": texel_inputs()}
