// SPDX-License-Identifier: MIT
//
// What the library refuses, in its words.

export class CubemapError extends Error {
    constructor(message, code) {
        super(message);
        this.name = new.target.name;
        this.code = code;
    }
}

const names = ["Argument", "SpecificationSyntax", "Mapping", "Parameter", "OutOfRange", "Frame", "Unsupported", "Memory", "Instructions",
    "Ellipsoid", "Latitude", "Orientation", "Cell", "Pixel", "Space", "Stopped", "Camera", "Rank", "File", "Data", "Version"];

/** By cm_status less one. */
const classes = names.map((name) => ({ [`${name}Error`]: class extends CubemapError {} })[`${name}Error`]);

export const [ArgumentError, SpecificationSyntaxError, MappingError, ParameterError, OutOfRangeError, FrameError,
    UnsupportedError, MemoryError, InstructionsError, EllipsoidError, LatitudeError, OrientationError, CellError,
    PixelError, SpaceError, StoppedError, CameraError, RankError, FileError, DataError, VersionError] = classes;

export function errorOf(status, words) {
    return new (classes[status - 1] ?? CubemapError)(words, status);
}
