// SPDX-License-Identifier: MIT

/** What the library refuses, in its words; code is the number of cm_status. */
export class CubemapError extends Error {
    readonly code: number;
}
export class ArgumentError extends CubemapError {}
export class SpecificationSyntaxError extends CubemapError {}
export class MappingError extends CubemapError {}
export class ParameterError extends CubemapError {}
export class OutOfRangeError extends CubemapError {}
export class FrameError extends CubemapError {}
export class UnsupportedError extends CubemapError {}
export class MemoryError extends CubemapError {}
export class InstructionsError extends CubemapError {}
export class EllipsoidError extends CubemapError {}
export class LatitudeError extends CubemapError {}
export class OrientationError extends CubemapError {}
export class CellError extends CubemapError {}
export class PixelError extends CubemapError {}
export class SpaceError extends CubemapError {}
export class StoppedError extends CubemapError {}
export class CameraError extends CubemapError {}
export class RankError extends CubemapError {}
export class FileError extends CubemapError {}
export class DataError extends CubemapError {}
export class VersionError extends CubemapError {}
