// SPDX-License-Identifier: MIT

#include "face_image.hpp"
#include "tools/cli/program.hpp"

#include <cubemap/options.h>

MappingPointer make_mapping(const std::string &specification, const cm_frame &frame)
{
    char message[160];
    if (cm_instructions_check(nullptr, message, sizeof message) != CM_OK)
    {
        throw Failure(message);
    }
    cm_mapping *made = nullptr;
    const cm_status status = cm_mapping_create(specification.c_str(), &frame, &made);
    if (status != CM_OK)
    {
        throw Failure(in_quotes(specification) + ": " + cm_status_text(status));
    }
    return MappingPointer(made);
}

int face_count(const cm_mapping &mapping)
{
    return cm_mapping_describe(&mapping)->kind == CM_KIND_CUBE ? 6 : 1;
}

FaceImage::FaceImage(const std::string &specification, const cm_frame &faces_frame, int face_size)
    : mapping(make_mapping(specification, faces_frame)), frame(faces_frame), size(face_size)
{
}

double FaceImage::mean_scale() const
{
    return 6 / 3.14159265358979323846;
}

void FaceImage::face_coordinates(int face, int row, int first_column, std::size_t count,
                                 PointBatch &batch) const
{
    const double down = (2.0 * row + 1) / size - 1;
    const double v = frame.first_row_v > 0 ? -down : down;
    for (std::size_t i = 0; i < count; ++i)
    {
        batch.plane[i] = static_cast<std::uint8_t>(face);
        batch.x[i] = (2.0 * (first_column + static_cast<double>(i)) + 1) / size - 1;
        batch.y[i] = v;
    }
}

void FaceImage::directions(int plane, int row, int first_column, std::size_t count,
                           PointBatch &batch) const
{
    face_coordinates(plane, row, first_column, count, batch);
    cm_inverse_array(mapping.get(), count, batch.plane.data(), batch.x.data(), batch.y.data(),
                     batch.direction_x.data(), batch.direction_y.data(), batch.direction_z.data());
}

void FaceImage::positions(std::size_t count, PointBatch &batch) const
{
    cm_forward_array(mapping.get(), count, batch.direction_x.data(), batch.direction_y.data(),
                     batch.direction_z.data(), batch.plane.data(), batch.x.data(), batch.y.data());
    static_assert(no_plane == CM_NO_FACE, "planes are faces");
    const double half = 0.5 * size;
    const double down = frame.first_row_v > 0 ? -half : half;
    for (std::size_t i = 0; i < count; ++i)
    {
        batch.x[i] = half + half * batch.x[i];
        batch.y[i] = half + down * batch.y[i];
    }
}

void FaceImage::derivatives(std::size_t count, const PointBatch &batch,
                            DerivativeBatch &derivatives) const
{
    thread_local DerivativeBatch::Numbers u, v;
    const double per_column = 2.0 / size;
    const double per_row = frame.first_row_v > 0 ? -per_column : per_column;
    const double half = 0.5 * size;
    const double down = frame.first_row_v > 0 ? -half : half;
    // Counted from the middle, so that what is on a diagonal stays there.
    for (std::size_t i = 0; i < count; ++i)
    {
        u[i] = (batch.x[i] - half) / half;
        v[i] = (batch.y[i] - half) / down;
    }
    DerivativeBatch &d = derivatives;
    double *const jacobian[6] = {d.by_x[0].data(), d.by_y[0].data(), d.by_x[1].data(),
                                 d.by_y[1].data(), d.by_x[2].data(), d.by_y[2].data()};
    cm_inverse_jacobian_array(mapping.get(), count, batch.plane.data(), u.data(), v.data(),
                              jacobian);
    for (int axis = 0; axis < 3; ++axis)
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            jacobian[2 * axis][i] *= per_column;
            jacobian[2 * axis + 1][i] *= per_row;
        }
    }
}
