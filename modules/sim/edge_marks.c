/* SPDX-License-Identifier: MIT
 *
 * Outlines and edges of what formulas give, and outlines of meshes, drawn into a sensor's cells: what is thinner than a cell
 * lies between the middles, and is sampled nevertheless. Outlines as lamps see them are drawn where their shadows fall.
 */
#include "tof_picture.h"
#include "tof_world.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    DEEPEST = 14,
    MOST_PLACES = 20000,
    RIM_PLACES = 64, /* of a cone whose spot may lie between cells' middles */
    PLACES_AT_ONCE = 256
};

typedef struct drawing
{
    const tof_scenery *scenery;
    uint8_t *mark;
    const double *eye; /* that sees outlines: the camera, or a lamp */
    int is_lamp;
    double step; /* radians between places of a line, as the eye sees them */
    size_t waiting;
    double place[3][PLACES_AT_ONCE];
} drawing;

/* Of the way from a lamp to an outline: so far behind it a shadow begins. */
#define BEHIND 1e-6

static void mark_cell(const drawing *to, double column, double row)
{
    const sensor_cells *cells = &to->scenery->sensor->cells;
    const double c = floor((column - cells->first) / cells->width);
    const double r = floor(row - cells->top);
    if (c >= 0.0 && c < (double)cells->columns && r >= 0.0 && r < (double)cells->rows)
    {
        to->mark[(size_t)r * cells->columns + (size_t)c] = 1;
    }
}

/* Places of an outline become those where its shadow falls; infinitely far away where it does not. */
static void throw_shadows(drawing *to)
{
    double direction[3][PLACES_AT_ONCE], distance[PLACES_AT_ONCE];
    for (size_t i = 0; i < to->waiting; i++)
    {
        double way[3];
        for (int k = 0; k < 3; k++)
        {
            way[k] = to->place[k][i] - to->eye[k];
        }
        const double length = sqrt(dot(way, way));
        for (int k = 0; k < 3; k++)
        {
            direction[k][i] = length > 0.0 ? way[k] / length : (double)(k == 2);
            to->place[k][i] += BEHIND * way[k];
        }
    }
    const double *const origins[3] = {to->place[0], to->place[1], to->place[2]};
    const double *const directions[3] = {direction[0], direction[1], direction[2]};
    const tof_hits hits = {.distance = distance};
    tof_cast(to->scenery->instant, to->waiting, origins, directions, &hits);
    for (size_t i = 0; i < to->waiting; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            to->place[k][i] += distance[i] < INFINITY ? distance[i] * direction[k][i] : (double)NAN;
        }
    }
}

static void mark_waiting(drawing *to)
{
    double column[PLACES_AT_ONCE], row[PLACES_AT_ONCE];
    const double beside = 0.3 * to->scenery->sensor->cells.width;
    if (to->is_lamp)
    {
        throw_shadows(to);
    }
    for (size_t i = 0; i < to->waiting; i++)
    {
        const double world[3] = {to->place[0][i], to->place[1][i], to->place[2][i]};
        double camera[3];
        cm_pose_apply(&to->scenery->camera, world, camera);
        for (int k = 0; k < 3; k++)
        {
            to->place[k][i] = camera[k];
        }
    }
    cm_camera_project_array(to->scenery->sensor->given.camera, to->waiting, to->place[0],
                            to->place[1], to->place[2], column, row);
    for (size_t i = 0; i < to->waiting; i++)
    {
        if (column[i] + row[i] < INFINITY) /* not NaN */
        {
            mark_cell(to, column[i] - beside, row[i] - 0.3);
            mark_cell(to, column[i] + beside, row[i] - 0.3);
            mark_cell(to, column[i] - beside, row[i] + 0.3);
            mark_cell(to, column[i] + beside, row[i] + 0.3);
        }
    }
    to->waiting = 0;
}

static void mark_place(drawing *to, const double world[3])
{
    for (int k = 0; k < 3; k++)
    {
        to->place[k][to->waiting] = world[k];
    }
    to->waiting++;
    if (to->waiting == PLACES_AT_ONCE)
    {
        mark_waiting(to);
    }
}

/* Of two places, as the eye sees them. */
static double seen_apart(const drawing *to, const double a[3], const double b[3])
{
    const double *eye = to->eye;
    const double one[3] = {a[0] - eye[0], a[1] - eye[1], a[2] - eye[2]};
    const double other[3] = {b[0] - eye[0], b[1] - eye[1], b[2] - eye[2]};
    return angle_between(one, other);
}

static void mark_line(drawing *to, const double a[3], const double b[3], int depth)
{
    mark_place(to, a);
    if (depth < DEEPEST && seen_apart(to, a, b) > to->step)
    {
        const double middle[3] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
        mark_line(to, a, middle, depth + 1);
        mark_line(to, middle, b, depth + 1);
    }
    else
    {
        mark_place(to, b);
    }
}

static void mark_circle(drawing *to, const double centre[3], const double axis[3], double radius)
{
    double one[3], other[3], square = 0.0;
    find_across(axis, one);
    cross(axis, one, other);
    for (int k = 0; k < 3; k++)
    {
        const double way = centre[k] - to->eye[k];
        square += way * way;
    }
    const double nearest = fmax(sqrt(square) - radius, 1e-3 * radius);
    const double places = fmin(ceil(2.0 * PI * radius / nearest / to->step), MOST_PLACES);
    for (double i = 0.0; i < places; i++)
    {
        const double angle = 2.0 * PI * i / places;
        double place[3];
        for (int k = 0; k < 3; k++)
        {
            place[k] = centre[k] + radius * (cos(angle) * one[k] + sin(angle) * other[k]);
        }
        mark_place(to, place);
    }
}

static void mark_box(drawing *to, const tof_solid *box)
{
    double corner[8][3];
    for (int i = 0; i < 8; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            corner[i][k] = box->centre[k];
            for (int axis = 0; axis < 3; axis++)
            {
                corner[i][k] += (i >> axis & 1 ? 1.0 : -1.0) * box->half[axis] * box->axis[axis][k];
            }
        }
    }
    for (int i = 0; i < 8; i++)
    {
        for (int axis = 0; axis < 3; axis++)
        {
            if ((i >> axis & 1) == 0)
            {
                mark_line(to, corner[i], corner[i | 1 << axis], 0);
            }
        }
    }
}

/* The circle where tangents from the eye touch it. */
static void mark_sphere(drawing *to, const tof_solid *sphere)
{
    double axis[3], square = 0.0;
    for (int k = 0; k < 3; k++)
    {
        axis[k] = sphere->centre[k] - to->eye[k];
        square += axis[k] * axis[k];
    }
    const double part = sphere->radius * sphere->radius / square;
    if (!(part < 1.0))
    {
        return; /* seen from inside */
    }
    double centre[3];
    for (int k = 0; k < 3; k++)
    {
        centre[k] = to->eye[k] + (1.0 - part) * axis[k];
        axis[k] /= sqrt(square);
    }
    mark_circle(to, centre, axis, sphere->radius * sqrt(1.0 - part));
}

/* Both rims, and the lines along which tangents touch the wall. */
static void mark_cylinder(drawing *to, const tof_solid *cylinder)
{
    double from[3], one[3], other[3], along = 0.0, square = 0.0;
    const double *axis = cylinder->axis[0];
    for (int k = 0; k < 3; k++)
    {
        from[k] = to->eye[k] - cylinder->centre[k];
        along += from[k] * axis[k];
    }
    for (int k = 0; k < 3; k++)
    {
        one[k] = from[k] - along * axis[k];
        square += one[k] * one[k];
    }
    const double apart = sqrt(square);
    for (int end = -1; end <= 1; end += 2)
    {
        double centre[3];
        for (int k = 0; k < 3; k++)
        {
            centre[k] = cylinder->centre[k] + end * cylinder->half[0] * axis[k];
        }
        mark_circle(to, centre, axis, cylinder->radius);
    }
    if (!(apart > cylinder->radius))
    {
        return;
    }
    for (int k = 0; k < 3; k++)
    {
        one[k] /= apart;
    }
    cross(axis, one, other);
    const double cosine = cylinder->radius / apart;
    const double sine = sqrt(1.0 - cosine * cosine);
    for (int side = -1; side <= 1; side += 2)
    {
        double a[3], b[3];
        for (int k = 0; k < 3; k++)
        {
            const double touch =
                cylinder->centre[k] + cylinder->radius * (cosine * one[k] + side * sine * other[k]);
            a[k] = touch - cylinder->half[0] * axis[k];
            b[k] = touch + cylinder->half[0] * axis[k];
        }
        mark_line(to, a, b, 0);
    }
}

/* Where a mesh has an outline it ends, or turns away: in between neighbours see what it is. */
static cm_status mark_mesh(drawing *to, const tof_body *body, cm_pool *pool)
{
    const cm_mesh *mesh = mesh_rays_mesh(body->rays);
    const cm_mesh_options *shape = cm_mesh_describe(mesh);
    const mesh_edges *edges = NULL;
    double eye[3];
    const cm_status status = mesh_rays_edges((mesh_rays *)(uintptr_t)body->rays, &edges);
    int8_t *const facing = malloc(shape->triangle_count + 1);
    if (status != CM_OK || facing == NULL)
    {
        free(facing);
        return CM_ERROR_MEMORY;
    }
    cm_pose_apply(&body->pose, to->eye, eye);
    mesh_edges_face(mesh, eye, pool, facing);
    for (size_t i = 0; i < edges->count; i++)
    {
        const mesh_edge *edge = &edges->edge[i];
        if (mesh_edge_is_outline(edge, facing))
        {
            double a[3], b[3];
            cm_pose_apply_back(&body->pose, shape->position + 3 * (size_t)edge->vertex[0], a);
            cm_pose_apply_back(&body->pose, shape->position + 3 * (size_t)edge->vertex[1], b);
            mark_line(to, a, b, 0);
        }
    }
    free(facing);
    return CM_OK;
}

static cm_status mark_all(drawing *to, cm_pool *pool)
{
    const tof_instant *instant = to->scenery->instant;
    cm_status status = CM_OK;
    for (size_t i = 0; i < instant->solids; i++)
    {
        const tof_solid *solid = &instant->solid[i];
        if (solid->kind == CM_PRIMITIVE_BOX)
        {
            mark_box(to, solid);
        }
        else if (solid->kind == CM_PRIMITIVE_SPHERE)
        {
            mark_sphere(to, solid);
        }
        else if (solid->kind == CM_PRIMITIVE_CYLINDER)
        {
            mark_cylinder(to, solid);
        }
    }
    for (size_t i = 0; status == CM_OK && i < instant->bodies; i++)
    {
        status = mark_mesh(to, &instant->body[i], pool);
    }
    mark_waiting(to);
    return status;
}

/* ---- cones of light ---- */

static int is_cone(const tof_lamp *lamp)
{
    return lamp->least_cosine > -1.0;
}

void find_outside_cones(const tof_scenery *scenery, size_t n, tof_light_block *light)
{
    const double *const distance = light->rays.distance;
    for (size_t j = 0; j < scenery->lamps; j++)
    {
        const tof_lamp *lamp = &scenery->lamp[j];
        double from[3];
        for (int k = 0; k < 3; k++)
        {
            from[k] = scenery->camera.position[k] - lamp->position[k];
        }
        for (size_t i = 0; is_cone(lamp) && i < n; i++)
        {
            const double way[3] = {from[0] + distance[i] * light->rays.direction[0][i],
                                   from[1] + distance[i] * light->rays.direction[1][i],
                                   from[2] + distance[i] * light->rays.direction[2][i]};
            const int is_outside = dot(way, lamp->axis) < lamp->least_cosine * sqrt(dot(way, way));
            light->shadows[i] |= (uint64_t)is_outside << j;
        }
    }
}

/* The cone's rim, as shadows are marked; the eye is the lamp. */
static void mark_rim(const tof_lamp *lamp, drawing *to)
{
    const double sine = 2.0 * sqrt(lamp->part * (1.0 - lamp->part));
    double x[3], y[3];
    find_across(lamp->axis, x);
    cross(lamp->axis, x, y);
    for (int i = 0; i < RIM_PLACES; i++)
    {
        const double angle = 2.0 * PI * i / RIM_PLACES;
        double place[3];
        for (int k = 0; k < 3; k++)
        {
            place[k] =
                lamp->position[k] + BEHIND * ((1.0 - 2.0 * lamp->part) * lamp->axis[k] +
                                              sine * (cos(angle) * x[k] + sin(angle) * y[k]));
        }
        mark_place(to, place);
    }
    mark_waiting(to);
}

cm_status mark_edges(const tof_scenery *scenery, cm_pool *pool, uint8_t *mark)
{
    const tof_sensor *sensor = scenery->sensor;
    const cm_camera_options *camera = cm_camera_describe(sensor->given.camera);
    const double solid_angle = cm_camera_solid_angle(
        sensor->given.camera, 0.5 * (double)camera->width + sensor->cells.first,
        0.5 * (double)camera->height + sensor->cells.top);
    const double pixel = solid_angle > 0.0 ? sqrt(solid_angle) : 1e-3;
    drawing to = {.scenery = scenery,
                  .mark = mark,
                  .eye = scenery->camera.position,
                  .step = 0.5 * pixel * sensor->cells.width};
    cm_status status = mark_all(&to, pool);
    to.is_lamp = 1;
    to.step *= 0.5; /* what a shadow falls onto may be nearer to the camera than to the lamp */
    for (size_t j = 0; status == CM_OK && j < scenery->lamps; j++)
    {
        to.eye = scenery->lamp[j].position;
        if (lamp_is_beside(&scenery->lamp[j], scenery->camera.position))
        {
            status = mark_all(&to, pool);
        }
        if (is_cone(&scenery->lamp[j]))
        {
            mark_rim(&scenery->lamp[j], &to);
        }
    }
    return status;
}
