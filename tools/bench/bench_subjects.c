/* SPDX-License-Identifier: MIT
 *
 * Which mappings are measured, and in which ways.
 */
#define _POSIX_C_SOURCE 200809L

#include "truth/cube_count.h"

#include "bench.h"
#include "tools/cli/catalogue_name.h"

#include <fnmatch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const direction_names[DIRECTIONS] = {"forward", "inverse"};
const char *const precision_names[PRECISIONS + 1] = {"double", "float", "fast", NULL};
const char *const form_names[FORMS + 1] = {"array", "single", NULL};
const char *const measure_names[MEASURES] = {"face", "sphere"};
const double percentiles[PERCENTILES] = {5.0, 25.0, 50.0, 75.0, 95.0};

const char *subject_name_at(size_t index)
{
    return index < cube_count() ? cm_catalogue_at(index)->identifier : NULL;
}

static int is_there(const suite *all, const char *specification)
{
    for (size_t i = 0; i < all->subject_count; i++)
    {
        if (strcmp(all->subjects[i].specification, specification) == 0)
        {
            return 1;
        }
    }
    return 0;
}

static void add(suite *all, const char *specification)
{
    if (is_there(all, specification))
    {
        return;
    }
    all->subjects = grow(all->subjects, all->subject_count, sizeof *all->subjects);
    subject made = {.specification = ""};
    snprintf(made.specification, sizeof made.specification, "%s", specification);
    all->subjects[all->subject_count++] = made;
}

/* Do two specifications of a mapping come to the same parameters? */
static int is_same(const char *one, const char *other)
{
    cm_mapping *made[2] = {NULL, NULL};
    int same = cm_mapping_create(one, NULL, &made[0]) == CM_OK &&
               cm_mapping_create(other, NULL, &made[1]) == CM_OK;
    for (size_t i = 0; same && i < cm_mapping_describe(made[0])->parameter_count; i++)
    {
        same = cm_mapping_parameter(made[0], i) == cm_mapping_parameter(made[1], i);
    }
    cm_mapping_destroy(made[0]);
    cm_mapping_destroy(made[1]);
    return same;
}

/* The presets that are not the standard parameters. */
static void add_presets(suite *all, const cm_mapping_info *info)
{
    for (const char *word = info->presets == NULL ? "" : info->presets; *word != '\0';)
    {
        char specification[sizeof all->subjects[0].specification];
        snprintf(specification, sizeof specification, "%s:%.*s", info->identifier,
                 (int)strcspn(word, ":"), word);
        if (!is_same(info->identifier, specification))
        {
            add(all, specification);
        }
        word += strcspn(word, " ");
        word += strspn(word, " ");
    }
}

static int add_pattern(suite *all, const char *pattern)
{
    int found = 0;
    for (size_t i = 0; i < cube_count(); i++)
    {
        const char *identifier = cm_catalogue_at(i)->identifier;
        if (fnmatch(pattern, identifier, 0) == 0)
        {
            add(all, identifier);
            add_presets(all, cm_catalogue_at(i));
            found = 1;
        }
    }
    if (!found)
    {
        usage("no mapping matches ", pattern);
    }
    return found;
}

static int has_six_faces(const char *specification)
{
    cm_mapping *mapping = NULL;
    int cube = cm_mapping_create(specification, NULL, &mapping) == CM_OK &&
               cm_mapping_describe(mapping)->kind == CM_KIND_CUBE;
    cm_mapping_destroy(mapping);
    return cube;
}

/* The mapping that was meant, or else the command. */
static cm_nearest nearest_mapping_or_command(const char *word)
{
    cm_nearest nearest = nearest_mapping(word);
    if (nearest.best == NULL)
    {
        nearest = cm_nearest_to(word, strlen(word));
        cm_nearest_try(&nearest, "advise", 6);
        cm_nearest_try(&nearest, "compare", 7);
        cm_nearest_try(&nearest, "papers", 6);
    }
    return nearest;
}

int suite_add(suite *all, const char *word)
{
    char why[200];
    if (strpbrk(word, "*?[") != NULL)
    {
        return add_pattern(all, word);
    }
    if (cm_specification_check(word, why, sizeof why) != CM_OK)
    {
        const cm_nearest nearest = nearest_mapping_or_command(word);
        usage_of_name(why, "", &nearest);
        return 0;
    }
    if (!has_six_faces(word))
    {
        usage("it has not six faces: ", word);
        return 0;
    }
    if (strlen(word) >= sizeof all->subjects[0].specification)
    {
        usage("too long a specification: ", word);
        return 0;
    }
    add(all, word);
    return 1;
}

int suite_add_all(suite *all, int count, char **words)
{
    for (int i = 0; i < count; i++)
    {
        if (!suite_add(all, words[i]))
        {
            return 0;
        }
    }
    return count > 0 || suite_add(all, "*");
}

static int make(const suite *all, const char *specification, int fast, cm_mapping **mapping)
{
    const cm_options options = {.size = sizeof options,
                                .instructions = all->set.instructions,
                                .tier = fast ? CM_TIER_FAST : CM_TIER_EXACT};
    cm_status status = cm_mapping_create_with(specification, NULL, &options, mapping);
    if (status != CM_OK)
    {
        char why[200] = "";
        (void)cm_instructions_check(all->set.instructions, why, sizeof why);
        fprintf(harness_err(), "%s: %s: %s\n", program_name(), specification,
                why[0] != '\0' ? why : cm_status_text(status));
    }
    return status == CM_OK;
}

static int add_way(suite *all, size_t index, int precision, int form)
{
    way w = {.subject = index, .precision = precision, .form = form, .offered = {1, 1}};
    if (!make(all, all->subjects[index].specification, precision == PRECISION_FAST, &w.mapping))
    {
        return 0;
    }
    if (precision == PRECISION_FAST)
    {
        unsigned fast = cm_mapping_describe(w.mapping)->fast;
        int has_tier = cm_mapping_tier(w.mapping) == CM_TIER_FAST;
        w.offered[FORWARD] = has_tier && (fast & CM_FAST_FORWARD) != 0;
        w.offered[INVERSE] = has_tier && (fast & CM_FAST_INVERSE) != 0;
        if (!w.offered[FORWARD] && !w.offered[INVERSE] && !all->set.all_tiers)
        {
            cm_mapping_destroy(w.mapping); /* it would be the exact one again */
            return 1;
        }
    }
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        w.error[direction] = (errors){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    }
    all->ways[all->way_count++] = w;
    return 1;
}

static int is_wanted(const settings *set, int precision, int form)
{
    /* single points gain nothing from the fast tier */
    return (set->precision < 0 || set->precision == precision) &&
           (set->form < 0 || set->form == form) &&
           !(precision == PRECISION_FAST && form == FORM_SINGLE);
}

int suite_prepare(suite *all)
{
    int good = 1;
    all->ways = allocate(all->subject_count * PRECISIONS * FORMS, sizeof *all->ways);
    for (size_t i = 0; i < all->subject_count && good; i++)
    {
        good = make(all, all->subjects[i].specification, 0, &all->subjects[i].mapping);
        for (int k = 0; k < PRECISIONS * FORMS && good; k++)
        {
            if (is_wanted(&all->set, k / FORMS, k % FORMS))
            {
                good = add_way(all, i, k / FORMS, k % FORMS);
            }
        }
    }
    return good;
}

void suite_close(suite *all)
{
    for (size_t i = 0; i < all->way_count; i++)
    {
        cm_mapping_destroy(all->ways[i].mapping);
        free(all->ways[i].samples[FORWARD]);
        free(all->ways[i].samples[INVERSE]);
    }
    for (size_t i = 0; i < all->subject_count; i++)
    {
        cm_mapping_destroy(all->subjects[i].mapping);
        free(all->subjects[i].lengths);
        free(all->subjects[i].error_map[FORWARD]);
        free(all->subjects[i].error_map[INVERSE]);
    }
    free(all->ways);
    free(all->subjects);
}

void stage_progress(stage part, size_t done, size_t total, const char *text)
{
    double within = (double)done / (double)(total == 0 ? 1 : total);
    progress_bar(part.begin + (part.end - part.begin) * within, 1.0, text);
}
