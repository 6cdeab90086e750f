/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Additions to cairo's SVG files: words of a page as <text> elements that name their fonts; title and description; names
 * renumbered, so that one picture always has the same bytes. text.c gives the lines, vector.c writes the file. */
#include "render/draw/vector.h"

#include <ctype.h>
#include <hb.h>
#include <string.h>

#include "render/origin/origin.h"

/* ---- words ---- */

static const cairo_user_data_key_t file_key;

bool bead_svg_text_keep(cairo_surface_t *surface, FILE *file)
{
    return cairo_surface_set_user_data(surface, &file_key, file, NULL) == CAIRO_STATUS_SUCCESS;
}

FILE *bead_svg_text_file(cairo_t *cr)
{
    return cairo_surface_get_user_data(cairo_get_target(cr), &file_key);
}

static const char *after_comma(const char *family)
{
    return strncmp(family, "STIX", 4) == 0 ? ", 'STIX Two Text', serif" : ", sans-serif";
}

/* The lines and the colour of a run, if its markup gives any. */
static void put_attribute(FILE *file, const PangoAttribute *attribute)
{
    const PangoColor *colour = &((const PangoAttrColor *)attribute)->color;
    if (attribute->klass->type == PANGO_ATTR_FOREGROUND)
        fprintf(file, " fill=\"#%02x%02x%02x\"", colour->red >> 8, colour->green >> 8, colour->blue >> 8);
    if (attribute->klass->type == PANGO_ATTR_UNDERLINE)
        fputs(" text-decoration=\"underline\"", file);
    if (attribute->klass->type == PANGO_ATTR_STRIKETHROUGH)
        fputs(" text-decoration=\"line-through\"", file);
}

static void put_font(FILE *file, PangoFont *font)
{
    PangoFontDescription *description = pango_font_describe(font);
    const char *family = pango_font_description_get_family(description);
    int width, size; /* as laid out; the description has the size in the drawing */
    hb_font_get_scale(pango_font_get_hb_font(font), &width, &size);
    fprintf(file, " font-family=\"'%s'%s\" font-size=\"%.7g\"", family, after_comma(family), (double)size / PANGO_SCALE);
    if (pango_font_description_get_weight(description) >= PANGO_WEIGHT_BOLD)
        fputs(" font-weight=\"bold\"", file);
    if (pango_font_description_get_style(description) != PANGO_STYLE_NORMAL)
        fputs(" font-style=\"italic\"", file);
    pango_font_description_free(description);
}

/* At x and y, in units of Pango. */
static void put_run(FILE *file, PangoLayout *layout, const PangoGlyphItem *run, int x, int y)
{
    const PangoItem *item = run->item;
    bool dots = item->analysis.flags & PANGO_ANALYSIS_FLAG_IS_ELLIPSIS;
    char *text = dots ? g_strdup("\u2026") : g_markup_escape_text(pango_layout_get_text(layout) + item->offset, item->length);
    fprintf(file, "<tspan x=\"%.7g\" y=\"%.7g\" textLength=\"%.7g\" lengthAdjust=\"spacingAndGlyphs\"", (double)x / PANGO_SCALE,
            (double)y / PANGO_SCALE, (double)pango_glyph_string_get_width(run->glyphs) / PANGO_SCALE);
    put_font(file, item->analysis.font);
    for (GSList *i = item->analysis.extra_attrs; i; i = i->next)
        put_attribute(file, i->data);
    fprintf(file, ">%s</tspan>", text);
    g_free(text);
}

static unsigned level(double part)
{
    return (unsigned)(255 * CLAMP(part, 0, 1) + 0.5);
}

/* Not with Pango's iterator of runs: version 1.50 leaves part of a copied one unset. */
void bead_svg_text_line(FILE *file, cairo_t *cr, PangoLayout *layout, const PangoLayoutLine *line, int x, int y)
{
    double red = 0, green = 0, blue = 0, alpha = 1;
    cairo_matrix_t m;
    cairo_get_matrix(cr, &m);
    (void)cairo_pattern_get_rgba(cairo_get_source(cr), &red, &green, &blue, &alpha);
    fprintf(file, "<text transform=\"matrix(%.9g %.9g %.9g %.9g %.9g %.9g)\" fill=\"#%02x%02x%02x\" xml:space=\"preserve\">", m.xx,
            m.yx, m.xy, m.yy, m.x0, m.y0, level(red), level(green), level(blue));
    for (GSList *i = line->runs; i; i = i->next) {
        const PangoGlyphItem *run = i->data;
        x += run->start_x_offset;
        put_run(file, layout, run, x, y - run->y_offset);
        x += pango_glyph_string_get_width(run->glyphs) + run->end_x_offset;
    }
    fputs("</text>\n", file);
}

/* ---- names, and the file ---- */

enum { MOST_NAMES = 1024 };

struct names {
    unsigned long long number[MOST_NAMES];
    size_t count;
};

static const char *const kinds[] = {"surface", "image", "source-"}; /* the last by cairo 1.18 */

/* Length of a kind's name at `at`, if it is one and a digit follows: id="surface604", "#surface604", url(#image607). */
static size_t name_length(const char *begin, const char *at, const char *end)
{
    if (at - begin < 2 || !(at[-1] == '#' || (at[-1] == '"' && at[-2] == '=')))
        return 0;
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        size_t length = strlen(kinds[k]);
        if ((size_t)(end - at) > length && memcmp(at, kinds[k], length) == 0 && isdigit((unsigned char)at[length]))
            return length;
    }
    return 0;
}

/* From 1, in order of first appearance; 0: too many. */
static size_t new_number(struct names *names, unsigned long long number)
{
    size_t i = 0;
    while (i < names->count && names->number[i] != number)
        i++;
    if (i == MOST_NAMES)
        return 0;
    if (i == names->count)
        names->number[names->count++] = number;
    return i + 1;
}

static void put_element(FILE *file, const char *name, const char *text)
{
    if (!text || !*text)
        return;
    char *escaped = g_markup_escape_text(text, -1);
    fprintf(file, "<%s>%s</%s>\n", name, escaped, name);
    g_free(escaped);
}

/* Puts title and description, for screen readers, after the root's tag. Returns the rest of the drawing. */
static const char *put_head(const struct bead_svg_parts *svg, FILE *file)
{
    const char *root = memmem(svg->text, svg->length, "<svg ", 5), *end = svg->text + svg->length;
    const char *body = root ? memchr(root, '>', (size_t)(end - root)) : NULL;
    if (!body)
        return svg->text;
    fwrite(svg->text, 1, (size_t)(body - svg->text), file);
    fputs(" role=\"img\">\n", file);
    put_element(file, "title", svg->title);
    put_element(file, "desc", svg->description);
    if (svg->source && *svg->source) {
        fputs("<metadata>", file);
        bead_origin_escape(BEAD_ORIGIN_HEAD, file);
        bead_origin_escape(svg->source, file);
        fputs("</metadata>\n", file);
    }
    return body + 1 + (body[1] == '\n');
}

/* Copies the drawing from `from` to `end` with its names renumbered. */
static enum bead_error put_body(const char *from, const char *end, FILE *file, struct bead_message *msg)
{
    struct names names = {.count = 0};
    const char *begin = from;
    for (const char *at = from; at < end; at++) {
        size_t kind = *at == 's' || *at == 'i' ? name_length(begin, at, end) : 0;
        if (kind == 0)
            continue;
        unsigned long long number = 0;
        fwrite(from, 1, (size_t)(at + kind - from), file);
        for (from = at + kind; from < end && isdigit((unsigned char)*from); from++)
            number = 10 * number + (unsigned long long)(*from - '0');
        size_t now = new_number(&names, number);
        if (now == 0)
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "an SVG file has at most %d images", MOST_NAMES);
        fprintf(file, "%zu", now);
        at = from - 1;
    }
    fwrite(from, 1, (size_t)(end - from), file);
    return BEAD_OK;
}

enum bead_error bead_svg_write(const struct bead_svg_parts *svg, FILE *file, struct bead_message *msg)
{
    const char *end = svg->text + svg->length, *last = memrchr(svg->text, '<', svg->length); /* "</svg>" */
    last = last ? last : end;
    enum bead_error err = put_body(put_head(svg, file), last, file, msg);
    fwrite(svg->words, 1, svg->words_length, file);
    fwrite(last, 1, (size_t)(end - last), file);
    return err;
}
