# SPDX-License-Identifier: MIT
"""The programs that resample pictures of the sphere, each as commands: who takes part in compare_engines.

Another one is a subclass of Engine and a line in contestants().
"""

import os
import re
import shutil
import subprocess

PI = 3.141592653589793
RADIUS = "6371007.2"

# The middles of faces in the order of the frame geo: lon, lat.
FACES = [(0, 0), (90, 0), (180, 0), (-90, 0), (0, 90), (0, -90)]

# One thread for everybody, and texts as they are.
ALONE = {"OMP_NUM_THREADS": "1", "GDAL_NUM_THREADS": "1", "OPENIMAGEIO_THREADS": "1", "LC_ALL": "C"}


class Job:
    """From one picture to another: to the faces of a cube, or back; perhaps to a much smaller one."""

    def __init__(self, to_cube, width, face, kind):
        self.to_cube, self.width, self.face, self.kind = to_cube, width, face, kind
        self.is_smaller = 8 * face < width

    def pixels(self):
        return 6 * self.face * self.face if self.to_cube else self.width * self.width // 2

    def sphere(self):
        return f"equirect/{self.width}"

    def radians(self):
        """of a pixel of the equirectangular picture"""
        return 2.0 * PI / self.width

    def cube(self, mapping):
        return f"cube/{mapping}/{self.face}"


class Engine:
    """A program that resamples: a contestant. mapping is that of its faces, what it needs is asked of its subclasses:

    prepare(job)       projects and the like, once; names without a folder are of the folder that all work in
    commands(job)      what to run; it leaves what outputs(job) names
    lesser(job)        what to run for nearly no pixels, so that the difference is resampling and writing; or None
    """

    mapping = "gnomonic"
    equirect = "equirect" # how a source of that kind lies: see scene_image.cpp
    program = None

    def __init__(self, name):
        self.name = name

    def source(self, job):
        """Whole files: an equirectangular picture, or a strip of faces."""
        return f"{self.equirect if job.to_cube else 'strip-' + self.mapping}-{job.kind}.tif"

    def source_faces(self, job):
        return [f"face{i}-{self.mapping}-{job.kind}.tif" for i in range(6)]

    def slug(self):
        return "".join(c if c.isalnum() else "-" for c in self.name)

    def outputs(self, job):
        return [f"out-{self.slug()}.tif"]

    def prepare(self, folder, job):
        pass

    def lesser(self, job):
        return None

    def does(self, job):
        """does it take part in this one?"""
        return True

    def alone(self, least, job):
        """Seconds that the pixels took, from the least seconds by what was run."""
        return least["whole"] - least["lesser"]


class Reproject(Engine):
    """cubemap-reproject"""

    def __init__(self, build, filter_name):
        super().__init__(f"cubemap-reproject, {filter_name}")
        self.program, self.filter = str(build / "tools" / "cubemap-reproject"), filter_name

    def command(self, job, face, width, out):
        common = [self.program, "--threads", "1", "--quiet", "--filter", self.filter]
        if job.to_cube:
            return common + ["--from", "equirect", "--to", "cube:gnomonic", "--layout", "strip", "--size", str(face),
                             self.source(job), out]
        return common + ["--from", "cube:gnomonic", "--from-layout", "strip", "--to", "equirect", "--size", str(width),
                         self.source(job), out]

    def commands(self, job):
        return [self.command(job, job.face, job.width, self.outputs(job)[0])]

    def lesser(self, job):
        return [self.command(job, 8, 16, "lesser.tif")]


class V360(Engine):
    """ffmpeg's filter. It computes a table at the first frame; later frames are of the same picture."""

    FRAMES = 5
    TYPES = {"uint8": ("gbrp", "rgb24"), "uint16": ("gbrp16le", "rgb48le")}

    def __init__(self, filter_name):
        super().__init__(f"ffmpeg v360, {filter_name}")
        self.program, self.filter = "ffmpeg", filter_name

    def does(self, job):
        return job.kind in self.TYPES

    def command(self, job, frames, out):
        planar, packed = self.TYPES[job.kind]
        size = (6 * job.face, job.face) if job.to_cube else (job.width, job.width // 2)
        way = "e:c6x1:out_forder=frblud" if job.to_cube else "c6x1:e:in_forder=frblud"
        filters = f"format={planar},loop=loop={frames - 1}:size=1"
        if frames > 0:
            filters += f",v360={way}:interp={self.filter}:w={size[0]}:h={size[1]}"
        to = ["-f", "null", "-"] if out is None else ["-compression_algo", "raw", out]
        filters = filters.replace("loop=-1", "loop=0") + ("" if out is None else f",format={packed}")
        quiet = ["-nostdin", "-hide_banner", "-loglevel", "error", "-y"]
        return ["ffmpeg"] + quiet + ["-threads", "1", "-filter_threads", "1", "-i", self.source(job), "-vf", filters,
                                     "-frames:v", str(max(frames, 1))] + to

    def commands(self, job):
        return [self.command(job, 1, self.outputs(job)[0])]

    def more_commands(self, job):
        """no filter, one frame, and one frame and FRAMES more, without writing"""
        return {"none": [self.command(job, 0, None)], "one": [self.command(job, 1, None)],
                "many": [self.command(job, 1 + self.FRAMES, None)]}

    def alone(self, least, job):
        return (least["many"] - least["one"]) / self.FRAMES

    def first(self, least):
        return least["one"] - least["none"]


class V360WithEnds(V360):
    """The same of a picture as it takes equirectangular ones to be: its first and last pixels on the edges."""

    equirect = "equirect-ends"

    def __init__(self, filter_name):
        super().__init__(filter_name)
        self.name += ", its own pixels"

    def does(self, job):
        return super().does(job) and job.to_cube


class Nona(Engine):
    """hugin's stitcher, with panotools' interpolators; a project a face, or one of six faces."""

    INTERPOLATORS = {"poly3": 0, "spline36": 2, "sinc256": 3}
    # neither lens nor exposure change anything
    NEUTRAL = "Eev0 Er1 Eb1 Ra0 Rb0 Rc0 Rd0 Re0 Va1 Vb0 Vc0 Vd0 Vx0 Vy0"

    def __init__(self, filter_name):
        super().__init__(f"nona, {filter_name}")
        self.program, self.filter = "nona", filter_name

    def outputs(self, job):
        return [f"out-{self.slug()}-{i}.tif" for i in range(6 if job.to_cube else 1)]

    def project(self, job, face, face_size, width):
        interpolator = f"m g1 i{self.INTERPOLATORS[self.filter]}"
        if not job.to_cube:
            pictures = [f'i w{job.face} h{job.face} f0 v90 y{lon} p{lat} r0 {self.NEUTRAL} n"{name}"'
                        for (lon, lat), name in zip(FACES, self.source_faces(job))]
            return "\n".join([f'p f2 w{width} h{width // 2} v360 E0 R0 n"TIFF c:NONE"', interpolator] + pictures + [""])
        lon, lat = FACES[face]
        return "\n".join([f'p f0 w{face_size} h{face_size} v90 E0 R0 n"TIFF c:NONE"', interpolator,
                          f'i w{job.width} h{job.width // 2} f4 v360 y{-lon} p{-lat} r0 {self.NEUTRAL} '
                          f'n"{self.source(job)}"', ""])

    def prepare(self, folder, job):
        for i in range(len(self.outputs(job))):
            (folder / f"{self.slug()}-{i}.pto").write_text(self.project(job, i, job.face, job.width))
            (folder / f"{self.slug()}-lesser-{i}.pto").write_text(self.project(job, i, 8, 16))

    def command(self, job, i, words):
        kind = {"uint8": "UINT8", "uint16": "UINT16", "float": "FLOAT"}[job.kind]
        name = self.outputs(job)[i] if not words else "lesser.tif"
        return ["nona", "-z", "NONE", "-p", kind, "-r", "ldr", "-m", "TIFF", "-o", name,
                f"{self.slug()}{words}-{i}.pto"]

    def commands(self, job):
        return [self.command(job, i, "") for i in range(len(self.outputs(job)))]

    def lesser(self, job):
        return [self.command(job, i, "-lesser") for i in range(len(self.outputs(job)))]


class Gdalwarp(Engine):
    """GDAL, to and from the faces of qsc; by its approximation of positions, 1/8 of a pixel, or exactly"""

    mapping = "qsc"

    def __init__(self, filter_name, is_exact):
        super().__init__(f"gdalwarp, {filter_name}" + (", exact" if is_exact else ""))
        self.program, self.filter = "gdalwarp", filter_name
        self.threshold = "0" if is_exact else "0.125"

    EARTH = f"+proj=longlat +R={RADIUS} +no_defs"
    EARTH_BOX = ["-180", "-90", "180", "90"]
    FACE_BOX = ["-" + RADIUS, "-" + RADIUS, RADIUS, RADIUS]

    @staticmethod
    def face_of(i):
        return f"+proj=qsc +lon_0={FACES[i][0]} +lat_0={FACES[i][1]} +R={RADIUS} +units=m +no_defs"

    def outputs(self, job):
        return [f"out-{self.slug()}-{i}.tif" for i in range(6 if job.to_cube else 1)]

    @staticmethod
    def describe(folder, name, system, box):
        """a picture with its place, as another file: NAME.vrt"""
        corners = [box[0], box[3], box[2], box[1]]
        subprocess.run(["gdal_translate", "-q", "-of", "VRT", "-a_srs", system, "-a_ullr"] + corners +
                       [name, name + ".vrt"], cwd=folder, env=dict(os.environ, **ALONE), check=True)

    def prepare(self, folder, job):
        if job.to_cube:
            self.describe(folder, self.source(job), self.EARTH, self.EARTH_BOX)
            return
        for i, name in enumerate(self.source_faces(job)):
            self.describe(folder, name, self.face_of(i), self.FACE_BOX)

    def command(self, job, i, is_lesser):
        sources = [self.source(job)] if job.to_cube else self.source_faces(job)
        box = self.FACE_BOX if job.to_cube else self.EARTH_BOX
        size = (job.face, job.face) if job.to_cube else (job.width, job.width // 2)
        if is_lesser: # a few pixels of the same size, at one side
            box = [box[0], box[1], str(float(box[0]) + 8 * (float(box[2]) - float(box[0])) / size[0]),
                   str(float(box[1]) + 8 * (float(box[3]) - float(box[1])) / size[1])]
            size = (8, 8)
        name = "lesser.tif" if is_lesser else self.outputs(job)[i]
        return ["gdalwarp", "-q", "-overwrite", "-et", self.threshold, "-r", self.filter, "-t_srs",
                self.face_of(i) if job.to_cube else self.EARTH, "-te"] + box + \
            ["-ts", str(size[0]), str(size[1])] + [source + ".vrt" for source in sources] + [name]

    def commands(self, job):
        return [self.command(job, i, False) for i in range(len(self.outputs(job)))]

    def lesser(self, job):
        return [self.command(job, i, True) for i in range(len(self.outputs(job)))]


class GdalAverage(Gdalwarp):
    """The mean of the pixels that a pixel covers, which is for smaller pictures."""

    def __init__(self):
        super().__init__("average", False)

    def does(self, job):
        return job.is_smaller


def version(command):
    """the first line that says one"""
    said = subprocess.run(command, capture_output=True, text=True, check=False)
    for line in (said.stdout + said.stderr).splitlines():
        if re.search(r"\d\.\d", line):
            return re.split(" Copyright|, released|-0", line)[0].strip()
    return f"{command[0]} of an unknown version"


def versions(engines):
    """Of the programs of others that take part."""
    commands = {"ffmpeg": ["ffmpeg", "-version"], "nona": ["nona", "--help"], "gdalwarp": ["gdalwarp", "--version"]}
    here = {engine.program for engine in engines}
    return [version(command) for name, command in commands.items() if name in here] or ["no program of others"]


def contestants(build, only):
    """Those whose names have the word only and whose programs are here, and the names of programs that are not. All are
    compared with the first of them."""
    engines = [Reproject(build, name) for name in ("bilinear", "nearest", "lanczos3", "bspline5", "ewa")]
    engines += [V360(name) for name in ("line", "cubic", "lanczos")] + [V360WithEnds("cubic")]
    engines += [Nona(name) for name in Nona.INTERPOLATORS]
    engines += [Gdalwarp(name, False) for name in ("bilinear", "cubic", "lanczos")] + [Gdalwarp("cubic", True)]
    engines += [GdalAverage()]
    engines = [engine for engine in engines if only in engine.name]
    here = [engine for engine in engines if shutil.which(engine.program)]
    return here, sorted({engine.program for engine in engines} - {engine.program for engine in here})
