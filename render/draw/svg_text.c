/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words of a page as <text> elements, with the fonts named that they were laid out in. text.c gives the lines, vector.c writes
 * them. */
#include "render/draw/svg_text.h"

#include <hb.h>
#include <string.h>

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

/* The colour of a run, if its markup gives one. */
static const PangoColor *own_colour(const PangoItem *item)
{
    for (GSList *i = item->analysis.extra_attrs; i; i = i->next) {
        const PangoAttribute *attribute = i->data;
        if (attribute->klass->type == PANGO_ATTR_FOREGROUND)
            return &((const PangoAttrColor *)i->data)->color;
    }
    return NULL;
}

static void put_font(FILE *file, PangoFont *font)
{
    PangoFontDescription *description = pango_font_describe(font);
    const char *family = pango_font_description_get_family(description);
    int width, size; /* as laid out; the description's is that of the drawing */
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
    const PangoColor *colour = own_colour(item);
    if (colour)
        fprintf(file, " fill=\"#%02x%02x%02x\"", colour->red >> 8, colour->green >> 8, colour->blue >> 8);
    fprintf(file, ">%s</tspan>", text);
    g_free(text);
}

static unsigned level(double part)
{
    return (unsigned)(255 * CLAMP(part, 0, 1) + 0.5);
}

/* Runs are walked by hand: a copy of Pango 1.50's iterator has a place that nobody has set. */
void bead_svg_text_line(FILE *file, cairo_t *cr, PangoLayout *layout, const PangoLayoutIter *iter, int baseline)
{
    PangoRectangle line;
    pango_layout_iter_get_line_extents((PangoLayoutIter *)iter, NULL, &line);
    double red = 0, green = 0, blue = 0, alpha = 1;
    cairo_matrix_t m;
    cairo_get_matrix(cr, &m);
    (void)cairo_pattern_get_rgba(cairo_get_source(cr), &red, &green, &blue, &alpha);
    fprintf(file, "<text transform=\"matrix(%.9g %.9g %.9g %.9g %.9g %.9g)\" fill=\"#%02x%02x%02x\" xml:space=\"preserve\">", m.xx,
            m.yx, m.xy, m.yy, m.x0, m.y0, level(red), level(green), level(blue));
    int x = line.x;
    for (GSList *i = pango_layout_iter_get_line_readonly((PangoLayoutIter *)iter)->runs; i; i = i->next) {
        const PangoGlyphItem *run = i->data;
        x += run->start_x_offset;
        put_run(file, layout, run, x, baseline - run->y_offset);
        x += pango_glyph_string_get_width(run->glyphs) + run->end_x_offset;
    }
    fputs("</text>\n", file);
}
