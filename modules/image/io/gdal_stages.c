/* SPDX-License-Identifier: MIT */
#include "gdal_stages.h"

#include "image_io.h"

#include <gdal_utils.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum
{
    WORD = 32,
    WORDS_MOST = 2 * CM_CHANNELS_MAX + 16
};

/* How far off a pixel may be that is warped, in pixels: what gdalwarp allows. */
#define WARP_ERROR "0.125"

/* Bounds that are so near, in pixels, to those of the whole sphere are those. */
#define NEARLY 0.01

#define WEB_EDGE 20037508.342789244 /* pi times 6378137 */

const cm_gdal_extent cm_gdal_degrees = {360, 90}, cm_gdal_web_metres = {2 * WEB_EDGE, HUGE_VAL};

/* Words of GDAL's programs, which want them writable. */
typedef struct words
{
    char text[WORDS_MOST][WORD];
    char *word[WORDS_MOST + 1];
    size_t count;
} words;

static void add_word(words *to, const char *text)
{
    snprintf(to->text[to->count], WORD, "%s", text);
    to->word[to->count] = to->text[to->count];
    to->word[++to->count] = NULL;
}

static void add_words(words *to, size_t n, const char *const *text)
{
    for (size_t i = 0; i < n; i++)
    {
        add_word(to, text[i]);
    }
}

static void add_number(words *to, double value)
{
    char text[WORD];
    snprintf(text, sizeof text, "%.17g", value);
    add_word(to, text);
}

static GDALDatasetH translated(GDALDatasetH raster, words *with)
{
    GDALTranslateOptions *const options = GDALTranslateOptionsNew(with->word, NULL);
    const GDALDatasetH made = options == NULL ? NULL : GDALTranslate("", raster, options, NULL);
    GDALTranslateOptionsFree(options);
    return made;
}

static GDALDatasetH warped(GDALDatasetH raster, words *with)
{
    GDALWarpAppOptions *const options = GDALWarpAppOptionsNew(with->word, NULL);
    const GDALDatasetH made =
        options == NULL ? NULL : GDALWarp("", NULL, 1, &raster, options, NULL);
    GDALWarpAppOptionsFree(options);
    return made;
}

GDALDatasetH cm_gdal_expanded(GDALDatasetH raster)
{
    const char *const text[] = {"-of", "VRT", "-expand", "rgb"};
    words with = {.count = 0};
    add_words(&with, sizeof text / sizeof *text, text);
    return translated(raster, &with);
}

/* ---- what is missing ---- */

bool cm_gdal_has_whole_numbers(GDALDatasetH raster)
{
    const GDALDataType type = GDALGetRasterDataType(GDALGetRasterBand(raster, 1));
    return type == GDT_Byte || type == GDT_UInt16;
}

static bool has_alpha(GDALDatasetH raster)
{
    const GDALRasterBandH top = GDALGetRasterBand(raster, GDALGetRasterCount(raster));
    return GDALGetRasterColorInterpretation(top) == GCI_AlphaBand;
}

/* Of several channels each may have a value for none, which the others may have rightly. */
bool cm_gdal_lacks_alpha(GDALDatasetH raster)
{
    const int flags = GDALGetMaskFlags(GDALGetRasterBand(raster, 1));
    const bool masked = (flags & GMF_PER_DATASET) != 0 ||
                        ((flags & GMF_NODATA) != 0 && GDALGetRasterCount(raster) == 1);
    return cm_gdal_has_whole_numbers(raster) && !has_alpha(raster) && masked &&
           GDALGetRasterCount(raster) < CM_CHANNELS_MAX &&
           (flags & (GMF_ALPHA | GMF_ALL_VALID)) == 0;
}

GDALDatasetH cm_gdal_with_alpha(GDALDatasetH raster)
{
    const int channels = GDALGetRasterCount(raster);
    words with = {.count = 0};
    const char *const text[] = {"-of", "VRT"};
    add_words(&with, 2, text);
    char number[WORD];
    for (int i = 1; i <= channels; i++)
    {
        snprintf(number, sizeof number, "%d", i);
        add_word(&with, "-b");
        add_word(&with, number);
    }
    const char *const mask[] = {"-b", "mask", "-a_nodata", "none"};
    add_words(&with, sizeof mask / sizeof *mask, mask);
    const GDALDatasetH made = translated(raster, &with);
    if (made != NULL)
    {
        GDALSetRasterColorInterpretation(GDALGetRasterBand(made, channels + 1), GCI_AlphaBand);
    }
    return made;
}

GDALDatasetH cm_gdal_warped(GDALDatasetH raster)
{
    const char *const text[] = {"-of", "VRT",   "-t_srs", "EPSG:4326",
                                "-r",  "cubic", "-et",    WARP_ERROR};
    const char *const none[] = {"-ot", "Float32", "-dstnodata", "nan"};
    words with = {.count = 0};
    int has_none = 0;
    add_words(&with, sizeof text / sizeof *text, text);
    (void)GDALGetRasterNoDataValue(GDALGetRasterBand(raster, 1), &has_none);
    if (cm_gdal_has_whole_numbers(raster) && GDALGetRasterCount(raster) < CM_CHANNELS_MAX)
    {
        add_word(&with, "-dstalpha");
    }
    else if (!has_none)
    {
        add_words(&with, sizeof none / sizeof *none, none);
    }
    return warped(raster, &with);
}

/* ---- how far it goes ---- */

bool cm_gdal_is_upright(const double transform[6])
{
    return transform[2] == 0 && transform[4] == 0 && transform[1] > 0 && transform[5] < 0;
}

/* Of columns and rows, how many go, and between which coordinates what is left lies. */
typedef struct cutting
{
    double above; /* rows */
    double width; /* what is left, in pixels */
    double height;
    double west;
    double north;
    double east;
    double south;
} cutting;

static cutting cut_of(GDALDatasetH raster, cm_gdal_extent most)
{
    double at[6] = {0};
    (void)GDALGetGeoTransform(raster, at);
    const double column = at[1], row = -at[5];
    const double bottom = at[3] - GDALGetRasterYSize(raster) * row;
    cutting cut = {.west = at[0]};
    cut.width = fmin(GDALGetRasterXSize(raster), most.around / column);
    cut.north = fmin(at[3], most.highest);
    cut.south = fmax(bottom, -most.highest);
    cut.east = cut.west + cut.width * column;
    cut.above = (at[3] - cut.north) / row;
    cut.height = (cut.north - cut.south) / row;
    return cut;
}

bool cm_gdal_goes_beyond(GDALDatasetH raster, cm_gdal_extent most)
{
    const cutting cut = cut_of(raster, most);
    return cut.width < GDALGetRasterXSize(raster) - NEARLY ||
           cut.height < GDALGetRasterYSize(raster) - NEARLY;
}

static bool is_whole(double pixels)
{
    return fabs(pixels - round(pixels)) < NEARLY;
}

GDALDatasetH cm_gdal_cut(GDALDatasetH raster, cm_gdal_extent most)
{
    const cutting cut = cut_of(raster, most);
    words with = {.count = 0};
    const char *const text[] = {"-of", "VRT"};
    add_words(&with, 2, text);
    const bool as_it_stands = is_whole(cut.above) && is_whole(cut.width) && is_whole(cut.height);
    if (as_it_stands)
    {
        const double window[] = {0, round(cut.above), round(cut.width), round(cut.height)};
        add_word(&with, "-srcwin");
        for (size_t i = 0; i < sizeof window / sizeof *window; i++)
        {
            add_number(&with, window[i]);
        }
        return translated(raster, &with);
    }
    const double sides[] = {cut.west, cut.south, cut.east, cut.north};
    const double pixels[] = {fmax(round(cut.width), 1), fmax(round(cut.height), 1)};
    const char *const how[] = {"-r", "cubic", "-et", WARP_ERROR, "-te"};
    add_words(&with, sizeof how / sizeof *how, how);
    for (size_t i = 0; i < 4; i++)
    {
        add_number(&with, sides[i]);
    }
    add_word(&with, "-ts");
    add_number(&with, pixels[0]);
    add_number(&with, pixels[1]);
    return warped(raster, &with);
}
