/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "chain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <cubemap/number.h>

#include "tools/cli/command.h"
#include "tools/cli/failure.h"

/* ------------------------------------------------------------------------------- what fits together */

/* Two options of which one has no meaning beside the other. */
static void refuse_both(const char *one, const char *one_name, const char *other,
                        const char *other_name, const char *reason)
{
    if (one != NULL && other != NULL)
    {
        die(EXIT_USAGE, "%s has no meaning with %s, which %s", one_name, other_name, reason);
    }
}

static void check_words(const struct chain_words *words, bool single)
{
    const char *const single_word = single ? "" : NULL;
    refuse_both(words->mapping, "-m", words->healpix, "--healpix", "has a projection of its own");
    refuse_both(words->frame, "--frame", words->healpix, "--healpix", "has no faces of a cube");
    refuse_both(words->cell, "--cell", words->healpix, "--healpix", "has pixels for cells");
    refuse_both(single_word, "--float", words->cell, "--cell", "computes in double precision");
    refuse_both(single_word, "--float", words->healpix, "--healpix",
                "computes in double precision");
}

/* Options that mean nothing for mappings of this kind. */
static void check_kind(const struct chain_words *words, const cm_mapping *mapping,
                       const char *specification)
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
            die(EXIT_USAGE, "%s has no meaning with -m %s, which has one face", needs[i].option,
                specification);
        }
        if (needs[i].given != NULL && kind == CM_KIND_DISC_SQUARE)
        {
            die(EXIT_USAGE,
                "%s has no meaning with -m %s, which joins disc and square, not the sphere",
                needs[i].option, specification);
        }
    }
}

/* ------------------------------------------------------------------------------- words */

static const cm_frame *find_frame(const char *identifier)
{
    const cm_frame *const frame = cm_frame_find(identifier);
    if (frame == NULL)
    {
        char known[256] = "";
        for (size_t i = 0; i < cm_frame_count(); i++)
        {
            const size_t length = strlen(known);
            snprintf(known + length, sizeof known - length, "%s%s", i == 0 ? "" : ", ",
                     cm_frame_at(i)->identifier);
        }
        die(EXIT_USAGE, "--frame is '%s', not one of %s", identifier, known);
    }
    return frame;
}

/* What is before the first colon, a whole number in a range; what is behind it, or NULL. */
static const char *parse_count(const char *option, const char *text, double least, double most,
                               int64_t *count)
{
    double value;
    const char *const colon = strchr(text, ':');
    const size_t length = colon != NULL ? (size_t)(colon - text) : strlen(text);
    if (!cm_number_parse(text, length, &value) ||
        !(value >= least && value <= most) || value != (double)(int64_t)value)
    {
        die(EXIT_USAGE, "%s is '%s': it begins with a whole number from %.0f to %.0f", option, text,
            least, most);
    }
    *count = (int64_t)value;
    return colon != NULL ? colon + 1 : NULL;
}

/* ------------------------------------------------------------------------------- objects */

/* NULL if the command line asks for nothing that a grid has. */
static cm_grid *create_grid(const struct chain_words *words, const cm_frame *frame,
                            const char *specification)
{
    char message[256];
    cm_ellipsoid ellipsoid = {
        .size = sizeof ellipsoid, .identifier = "", .name = "", .source = "", .a = 6371007.2};
    cm_rotation rotation;
    cm_latitude latitude = CM_LATITUDE_GEOGRAPHIC;
    if (words->ellipsoid == NULL && words->latitude == NULL && words->rotation == NULL &&
        words->cell == NULL)
    {
        return NULL;
    }
    const char *const name = words->ellipsoid != NULL  ? words->ellipsoid
                             : words->latitude != NULL ? "WGS84"
                                                       : NULL;
    if (name != NULL && cm_ellipsoid_parse(name, &ellipsoid, message, sizeof message) != CM_OK)
    {
        die(EXIT_USAGE, "--ellipsoid %s: %s", name, message);
    }
    if (words->latitude != NULL)
    {
        latitude = parse_latitude("--latitude", words->latitude);
    }
    if (words->rotation != NULL &&
        cm_rotation_parse(words->rotation, &rotation, message, sizeof message) != CM_OK)
    {
        die(EXIT_USAGE, "--rotate %s: %s", words->rotation, message);
    }
    const cm_grid_options options = {.size = sizeof options,
                                     .mapping = specification,
                                     .frame = frame,
                                     .ellipsoid = &ellipsoid,
                                     .latitude = words->latitude != NULL ? &latitude : NULL,
                                     .rotation = words->rotation != NULL ? &rotation : NULL};
    cm_grid *grid = NULL;
    const cm_status status = cm_grid_create(&options, &grid);
    if (status != CM_OK)
    {
        die(EXIT_FAILURE, "-m %s: %s", specification, cm_status_text(status));
    }
    return grid;
}

static cm_mapping *create_mapping(const char *specification, const cm_frame *frame)
{
    cm_mapping *mapping = NULL;
    const cm_status status = cm_mapping_create(specification, frame, &mapping);
    if (status != CM_OK)
    {
        die(EXIT_FAILURE, "-m %s: %s", specification, cm_status_text(status));
    }
    return mapping;
}

static void create_cells(struct chain *chain, const char *text)
{
    int64_t level;
    cm_curve curve = CM_CURVE_HILBERT;
    const char *const name = parse_count("--cell", text, 0, CM_CELL_LEVEL_MAX, &level);
    if (name != NULL && cm_curve_find(name, &curve) != CM_OK)
    {
        die(EXIT_USAGE, "--cell is '%s': the curve is hilbert or morton", text);
    }
    chain->level = (int)level;
    const cm_status status = cm_cell_grid_create(chain->grid, curve, &chain->cells);
    if (status != CM_OK)
    {
        die(EXIT_FAILURE, "--cell %s: %s", text, cm_status_text(status));
    }
}

static void create_pixels(struct chain *chain, const char *text)
{
    char message[256];
    int64_t nside;
    cm_healpix_order order = CM_HEALPIX_RING;
    const char *const name = parse_count("--healpix", text, 1, CM_HEALPIX_NSIDE_MAX, &nside);
    if (name != NULL)
    {
        const bool nested = strcasecmp(name, "nest") == 0 || strcasecmp(name, "nested") == 0;
        if (!nested && strcasecmp(name, "ring") != 0)
        {
            die(EXIT_USAGE, "--healpix is '%s': the order is ring or nest", text);
        }
        order = nested ? CM_HEALPIX_NESTED : CM_HEALPIX_RING;
    }
    if (cm_healpix_check(nside, order, message, sizeof message) != CM_OK)
    {
        die(EXIT_USAGE, "--healpix %s: %s", text, message);
    }
    const cm_status status = cm_healpix_create(nside, order, NULL, &chain->pixels);
    if (status != CM_OK)
    {
        die(EXIT_FAILURE, "--healpix %s: %s", text, cm_status_text(status));
    }
}

struct chain chain_create(const struct chain_words *words, bool single)
{
    char message[256];
    struct chain chain = {.mapping = NULL};
    check_words(words, single);
    const char *const specification = words->healpix != NULL   ? "healpix"
                                      : words->mapping != NULL ? words->mapping
                                                               : CM_MAPPING_RECOMMENDED;
    const cm_frame *const frame = find_frame(words->frame != NULL ? words->frame : "geo");
    if (cm_specification_check(specification, message, sizeof message) != CM_OK)
    {
        die(EXIT_USAGE, "-m %s: %s; see --list", specification, message);
    }
    if (cm_instructions_check(NULL, message, sizeof message) != CM_OK)
    {
        die(EXIT_FAILURE, "%s", message);
    }
    chain.mapping = create_mapping(specification, frame);
    check_kind(words, chain.mapping, specification);
    chain.grid = create_grid(words, frame, specification);
    if (words->cell != NULL)
    {
        create_cells(&chain, words->cell);
    }
    if (words->healpix != NULL)
    {
        create_pixels(&chain, words->healpix);
    }
    return chain;
}

void chain_destroy(struct chain *chain)
{
    cm_healpix_destroy(chain->pixels);
    cm_cell_grid_destroy(chain->cells);
    cm_grid_destroy(chain->grid);
    cm_mapping_destroy(chain->mapping);
}
