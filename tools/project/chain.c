/* SPDX-License-Identifier: MIT */
#include "chain.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <cubemap/number.h>

#include "tools/cli/catalogue_name.h"
#include "tools/cli/command.h"
#include "tools/cli/failure.h"

/* ------------------------------------------------------------------------------- what fits together */

/* Two options of which one has no meaning beside the other. */
struct pair
{
    const char *one;
    const char *one_name;
    const char *other;
    const char *other_name;
    const char *reason;
};

static bool check_words(const struct chain_words *words, bool single, cm_failure *failure)
{
    const char *const single_word = single ? "" : NULL;
    const char *const healpix = words->healpix;
    const struct pair pairs[] = {
        {words->mapping, "-m", healpix, "--healpix", "has a projection of its own"},
        {words->frame, "--frame", healpix, "--healpix", "has no faces of a cube"},
        {words->cell, "--cell", healpix, "--healpix", "has pixels for cells"},
        {single_word, "--float", words->cell, "--cell", "computes in double precision"},
        {single_word, "--float", healpix, "--healpix", "computes in double precision"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    {
        if (pairs[i].one != NULL && pairs[i].other != NULL)
        {
            return fail(failure, EXIT_USAGE, "%s has no meaning with %s, which %s",
                        pairs[i].one_name, pairs[i].other_name, pairs[i].reason);
        }
    }
    return true;
}

/* Options that mean nothing for mappings of this kind. */
static bool check_kind(const struct chain_words *words, const cm_mapping *mapping,
                       const char *specification, cm_failure *failure)
{
    const struct
    {
        const char *option;
        const char *given;
        bool needs_cube; /* or else a sphere */
    } needs[] = {{"--frame", words->frame, true},        {"--cell", words->cell, true},
                 {words->form, words->form, false},      {"--ellipsoid", words->ellipsoid, false},
                 {"--latitude", words->latitude, false}, {"--rotate", words->rotation, false}};
    const cm_kind kind = cm_mapping_describe(mapping)->kind;
    for (size_t i = 0; i < sizeof needs / sizeof *needs; i++)
    {
        if (needs[i].given != NULL && needs[i].needs_cube && kind != CM_KIND_CUBE)
        {
            return fail(failure, EXIT_USAGE, "%s has no meaning with -m %s, which has one face",
                        needs[i].option, specification);
        }
        if (needs[i].given != NULL && kind == CM_KIND_DISC_SQUARE)
        {
            return fail(failure, EXIT_USAGE,
                        "%s has no meaning with -m %s, which joins disc and square, not the sphere",
                        needs[i].option, specification);
        }
    }
    return true;
}

/* ------------------------------------------------------------------------------- words */

/* What is before the first colon, a whole number in a range; *rest is what is behind it, or NULL. */
static bool take_count(const char *option, const char *text, double least, double most,
                       int64_t *count, const char **rest, cm_failure *failure)
{
    double value;
    const char *const colon = strchr(text, ':');
    const size_t length = colon != NULL ? (size_t)(colon - text) : strlen(text);
    if (!cm_number_parse(text, length, &value) || !(value >= least && value <= most) ||
        value != (double)(int64_t)value)
    {
        return fail(failure, EXIT_USAGE,
                    "%s is '%s': it begins with a whole number from %.0f to %.0f", option, text,
                    least, most);
    }
    *count = (int64_t)value;
    *rest = colon != NULL ? colon + 1 : NULL;
    return true;
}

/* ------------------------------------------------------------------------------- objects */

/* What the words say of a grid. */
struct grid_parts
{
    cm_ellipsoid ellipsoid;
    cm_rotation rotation;
    cm_latitude latitude;
};

static bool take_grid_parts(const struct chain_words *words, struct grid_parts *parts,
                            cm_failure *failure)
{
    char message[256];
    const char *const name = words->ellipsoid != NULL  ? words->ellipsoid
                             : words->latitude != NULL ? "WGS84"
                                                       : NULL;
    if (name != NULL &&
        cm_ellipsoid_parse(name, &parts->ellipsoid, message, sizeof message) != CM_OK)
    {
        const cm_nearest nearest = nearest_name(name, ellipsoid_name_at);
        return fail_nearest(failure, &nearest, "--ellipsoid %s: %s", name, message);
    }
    if (words->latitude != NULL &&
        !take_latitude("--latitude", words->latitude, &parts->latitude, failure))
    {
        return false;
    }
    if (words->rotation != NULL &&
        cm_rotation_parse(words->rotation, &parts->rotation, message, sizeof message) != CM_OK)
    {
        const cm_nearest nearest = nearest_name(words->rotation, orientation_name_at);
        return fail_nearest(failure, &nearest, "--rotate %s: %s", words->rotation, message);
    }
    return true;
}

/* None if the command line asks for nothing that a grid has. */
static bool create_grid(const struct chain_words *words, const cm_frame *frame,
                        const char *specification, cm_grid **grid, cm_failure *failure)
{
    struct grid_parts parts = {.ellipsoid = {.size = sizeof parts.ellipsoid,
                                             .identifier = "",
                                             .name = "",
                                             .source = "",
                                             .a = 6371007.2}};
    if (words->ellipsoid == NULL && words->latitude == NULL && words->rotation == NULL &&
        words->cell == NULL)
    {
        return true;
    }
    if (!take_grid_parts(words, &parts, failure))
    {
        return false;
    }
    const cm_grid_options options = {.size = sizeof options,
                                     .mapping = specification,
                                     .frame = frame,
                                     .ellipsoid = &parts.ellipsoid,
                                     .latitude = words->latitude != NULL ? &parts.latitude : NULL,
                                     .rotation = words->rotation != NULL ? &parts.rotation : NULL};
    const cm_status status = cm_grid_create(&options, grid);
    return status == CM_OK ||
           fail(failure, EXIT_FAILURE, "-m %s: %s", specification, cm_status_text(status));
}

static bool create_cells(struct chain *chain, const char *text, cm_failure *failure)
{
    int64_t level = 0;
    cm_curve curve = CM_CURVE_HILBERT;
    const char *name = NULL;
    if (!take_count("--cell", text, 0, CM_CELL_LEVEL_MAX, &level, &name, failure))
    {
        return false;
    }
    const bool is_s2 = name != NULL && (strcmp(name, "s2") == 0 || strcmp(name, "S2") == 0);
    if (name != NULL && !is_s2 && cm_curve_find(name, &curve) != CM_OK)
    {
        return fail(failure, EXIT_USAGE, "--cell is '%s': the curve is hilbert, morton or s2",
                    text);
    }
    chain->level = (int)level;
    const cm_status status = is_s2 ? cm_cell_grid_create_s2(chain->grid, &chain->cells)
                                   : cm_cell_grid_create(chain->grid, curve, &chain->cells);
    if (is_s2 && status == CM_ERROR_UNSUPPORTED)
    {
        return fail(failure, EXIT_USAGE,
                    "--cell %s is of -m s2 --frame s2 on a sphere, or with --latitude geographic, "
                    "not rotated",
                    text);
    }
    return status == CM_OK ||
           fail(failure, EXIT_FAILURE, "--cell %s: %s", text, cm_status_text(status));
}

static bool create_pixels(struct chain *chain, const char *text, cm_failure *failure)
{
    char message[256];
    int64_t nside = 0;
    cm_healpix_order order = CM_HEALPIX_RING;
    const char *name = NULL;
    if (!take_count("--healpix", text, 1, CM_HEALPIX_NSIDE_MAX, &nside, &name, failure))
    {
        return false;
    }
    if (name != NULL)
    {
        const bool nested = strcasecmp(name, "nest") == 0 || strcasecmp(name, "nested") == 0;
        if (!nested && strcasecmp(name, "ring") != 0)
        {
            return fail(failure, EXIT_USAGE, "--healpix is '%s': the order is ring or nest", text);
        }
        order = nested ? CM_HEALPIX_NESTED : CM_HEALPIX_RING;
    }
    if (cm_healpix_check(nside, order, message, sizeof message) != CM_OK)
    {
        return fail(failure, EXIT_USAGE, "--healpix %s: %s", text, message);
    }
    const cm_status status = cm_healpix_create(nside, order, NULL, &chain->pixels);
    return status == CM_OK ||
           fail(failure, EXIT_FAILURE, "--healpix %s: %s", text, cm_status_text(status));
}

static bool check_mapping(const char *specification, cm_failure *failure)
{
    char message[256];
    const cm_status status = cm_specification_check(specification, message, sizeof message);
    const cm_nearest nearest = nearest_mapping(specification);
    if (status == CM_ERROR_MAPPING && nearest.best != NULL)
    {
        return fail_nearest(failure, &nearest, "-m %s: %s", specification, message);
    }
    if (status != CM_OK)
    {
        return fail(failure, EXIT_USAGE, "-m %s: %s; see --list", specification, message);
    }
    return cm_instructions_check(NULL, message, sizeof message) == CM_OK ||
           fail(failure, EXIT_FAILURE, "%s", message);
}

bool chain_create(const struct chain_words *words, bool single, struct chain *chain,
                  cm_failure *failure)
{
    const char *const specification = words->healpix != NULL   ? "healpix"
                                      : words->mapping != NULL ? words->mapping
                                                               : CM_MAPPING_RECOMMENDED;
    const char *const frame_name = words->frame != NULL ? words->frame : "geo";
    const cm_frame *const frame = cm_frame_find(frame_name);
    if (!check_words(words, single, failure))
    {
        return false;
    }
    if (frame == NULL)
    {
        return fail_name(failure, "--frame", frame_name, frame_name_at);
    }
    if (!check_mapping(specification, failure))
    {
        return false;
    }
    const cm_status status = cm_mapping_create(specification, frame, &chain->mapping);
    if (status != CM_OK)
    {
        return fail(failure, EXIT_FAILURE, "-m %s: %s", specification, cm_status_text(status));
    }
    return check_kind(words, chain->mapping, specification, failure) &&
           create_grid(words, frame, specification, &chain->grid, failure) &&
           (words->cell == NULL || create_cells(chain, words->cell, failure)) &&
           (words->healpix == NULL || create_pixels(chain, words->healpix, failure));
}

void chain_destroy(struct chain *chain)
{
    cm_healpix_destroy(chain->pixels);
    cm_cell_grid_destroy(chain->cells);
    cm_grid_destroy(chain->grid);
    cm_mapping_destroy(chain->mapping);
}
