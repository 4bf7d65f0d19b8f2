/* SPDX-License-Identifier: MIT
 *
 * Panoramas and the text of XMP, which is not parsed as XML but scanned: what writers make of it is not always well-formed, and
 * only names and values count here.
 */
#include <cubemap/number.h>
#include <cubemap/panorama.h>

#include <math.h>
#include <string.h>

#include "text_end.h"

#define NAMESPACE "http://ns.google.com/photos/1.0/panorama/"

/* A part of a text; text is NULL for none. */
typedef struct span
{
    const char *text;
    size_t length;
} span;

/* ---- scanning ---- */

static const char *find(span in, const char *what, size_t length)
{
    for (size_t i = 0; length <= in.length && i <= in.length - length; i++)
    {
        if (memcmp(in.text + i, what, length) == 0)
        {
            return in.text + i;
        }
    }
    return NULL;
}

static span after(span in, const char *at)
{
    return (span){at, in.length - (size_t)(at - in.text)};
}

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static span trimmed(span in)
{
    while (in.length > 0 && is_blank(in.text[0]))
    {
        in.text++;
        in.length--;
    }
    while (in.length > 0 && is_blank(in.text[in.length - 1]))
    {
        in.length--;
    }
    return in;
}

static int is_of_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
}

/* The prefix that stands for the namespace: xmlns:PREFIX="NAMESPACE". Without it that which everyone takes. */
static span find_prefix(span in)
{
    const char *uri = find(in, NAMESPACE, strlen(NAMESPACE));
    const char *end = uri;
    while (end != NULL && end > in.text && !is_of_name(end[-1]))
    {
        end--;
    }
    const char *begin = end;
    while (begin != NULL && begin > in.text && is_of_name(begin[-1]))
    {
        begin--;
    }
    if (begin == NULL || begin == end || begin == in.text || begin[-1] != ':')
    {
        return (span){"GPano", 5};
    }
    return (span){begin, (size_t)(end - begin)};
}

/* What follows a name: ="VALUE" of an attribute, or >VALUE< of an element. */
static span value_after(span rest)
{
    const span none = {NULL, 0};
    rest = trimmed(rest);
    if (rest.length == 0 || (rest.text[0] != '=' && rest.text[0] != '>'))
    {
        return none;
    }
    char stop = '<';
    const int is_attribute = rest.text[0] == '=';
    rest = (span){rest.text + 1, rest.length - 1};
    if (is_attribute)
    {
        rest = trimmed(rest);
        if (rest.length == 0 || (rest.text[0] != '"' && rest.text[0] != '\''))
        {
            return none;
        }
        stop = rest.text[0];
        rest = (span){rest.text + 1, rest.length - 1};
    }
    const char *end = memchr(rest.text, stop, rest.length);
    return end == NULL ? none : trimmed((span){rest.text, (size_t)(end - rest.text)});
}

/* The value of the first field of that name that has one. */
static span field(span in, span prefix, const char *name)
{
    const size_t length = strlen(name);
    while (in.length > 0)
    {
        const char *at = find(in, name, length);
        if (at == NULL)
        {
            break;
        }
        const size_t before = (size_t)(at - in.text);
        const int is_prefixed = before > prefix.length && at[-1] == ':' &&
                                memcmp(at - 1 - prefix.length, prefix.text, prefix.length) == 0;
        const span value = is_prefixed ? value_after(after(in, at + length)) : (span){NULL, 0};
        if (value.text != NULL)
        {
            return value;
        }
        in = after(in, at + length);
    }
    return (span){NULL, 0};
}

/* ---- fields ---- */

typedef struct fields
{
    span text;
    span prefix;
    int found;
    cm_status status;
} fields;

static double read_number(fields *from, const char *name, double standard)
{
    double value = standard;
    const span text = field(from->text, from->prefix, name);
    if (text.text == NULL)
    {
        return standard;
    }
    from->found = 1;
    if (!cm_number_parse(text.text, text.length, &value) || !isfinite(value))
    {
        from->status = CM_ERROR_SYNTAX;
        return standard;
    }
    return value;
}

static uint32_t read_pixels(fields *from, const char *name, double standard)
{
    const double value = read_number(from, name, standard);
    if (!(value >= 0.0 && value <= (double)UINT32_MAX && value == floor(value)))
    {
        from->status = from->status == CM_OK ? CM_ERROR_RANGE : from->status;
        return 0;
    }
    return (uint32_t)value;
}

static int is_equirectangular(span value)
{
    static const char name[] = "equirectangular";
    size_t i = 0;
    while (i < value.length && i < sizeof name - 1 && (value.text[i] | 0x20) == name[i])
    {
        i++;
    }
    return i == value.length && i == sizeof name - 1;
}

cm_status cm_panorama_read(const char *text, size_t length, cm_panorama *panorama)
{
    if (text == NULL || panorama == NULL || panorama->size != sizeof *panorama)
    {
        return CM_ERROR_ARGUMENT;
    }
    fields from = {.text = {text, length}};
    cm_panorama made = {.size = sizeof made};
    from.prefix = find_prefix(from.text);
    const span projection = field(from.text, from.prefix, "ProjectionType");
    from.found = projection.text != NULL;
    made.full_width = read_pixels(&from, "FullPanoWidthPixels", 0.0);
    made.full_height = read_pixels(&from, "FullPanoHeightPixels", 0.0);
    made.cropped_left = read_pixels(&from, "CroppedAreaLeftPixels", 0.0);
    made.cropped_top = read_pixels(&from, "CroppedAreaTopPixels", 0.0);
    made.cropped_width = read_pixels(&from, "CroppedAreaImageWidthPixels", made.full_width);
    made.cropped_height = read_pixels(&from, "CroppedAreaImageHeightPixels", made.full_height);
    made.heading = read_number(&from, "PoseHeadingDegrees", (double)NAN);
    made.pitch = read_number(&from, "PosePitchDegrees", 0.0);
    made.roll = read_number(&from, "PoseRollDegrees", 0.0);
    if (!from.found || (projection.text != NULL && !is_equirectangular(projection)))
    {
        return CM_ERROR_UNSUPPORTED;
    }
    /* some write 360 for north, and -180 for 180 */
    made.heading = made.heading == 360.0 ? 0.0 : made.heading;
    made.roll = made.roll == -180.0 ? 180.0 : made.roll;
    const cm_status status = from.status != CM_OK ? from.status : cm_panorama_check(&made);
    if (status == CM_OK)
    {
        *panorama = made;
    }
    return status;
}

/* ---- writing ---- */

static void append_field(cm_text_end *to, const char *name, double value)
{
    cm_text_add(to, "\n    GPano:");
    cm_text_add(to, name);
    cm_text_add(to, "=\"");
    cm_text_add_number(to, value);
    cm_text_add(to, "\"");
}

cm_status cm_panorama_write(const cm_panorama *panorama, char *text, size_t size)
{
    const cm_status status = cm_panorama_check(panorama);
    char packet[2048];
    cm_text_end to = {packet, sizeof packet, 0};
    if (status != CM_OK || text == NULL || panorama->full_width == 0)
    {
        return status != CM_OK ? status : text == NULL ? CM_ERROR_ARGUMENT : CM_ERROR_RANGE;
    }
    cm_text_add(&to, "<?xpacket begin=\"\xef\xbb\xbf\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
                     "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
                     " <rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
                     "  <rdf:Description rdf:about=\"\"\n"
                     "    xmlns:GPano=\"" NAMESPACE "\"\n"
                     "    GPano:UsePanoramaViewer=\"True\"\n"
                     "    GPano:ProjectionType=\"equirectangular\"");
    append_field(&to, "FullPanoWidthPixels", panorama->full_width);
    append_field(&to, "FullPanoHeightPixels", panorama->full_height);
    append_field(&to, "CroppedAreaLeftPixels", panorama->cropped_left);
    append_field(&to, "CroppedAreaTopPixels", panorama->cropped_top);
    append_field(&to, "CroppedAreaImageWidthPixels", panorama->cropped_width);
    append_field(&to, "CroppedAreaImageHeightPixels", panorama->cropped_height);
    const int has_heading = !isnan(panorama->heading);
    if (has_heading)
    {
        append_field(&to, "PoseHeadingDegrees", panorama->heading);
    }
    if (has_heading || panorama->pitch != 0.0 || panorama->roll != 0.0)
    {
        append_field(&to, "PosePitchDegrees", panorama->pitch);
        append_field(&to, "PoseRollDegrees", panorama->roll);
    }
    cm_text_add(&to, "/>\n </rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"w\"?>");
    if (to.length >= sizeof packet || to.length >= size)
    {
        return CM_ERROR_SPACE;
    }
    memcpy(text, packet, to.length);
    text[to.length] = '\0';
    return CM_OK;
}
