/* Text through Pango, laid out without regard to the pixel grid, so that it is the same in rasters and vector files. */
#include <pango/pangocairo.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/look.h"

/* Middle of digits and capitals above the baseline, in units of the font size (STIX 0.34, Lato 0.36). */
static const double digit_middle = 0.35;

/* Broken markup is shown as it stands: Pango's own call would print a warning. */
static void set_contents(PangoLayout *layout, const char *markup)
{
    PangoAttrList *attributes = NULL;
    char *text = NULL;
    if (pango_parse_markup(markup, -1, 0, &attributes, &text, NULL, NULL)) {
        pango_layout_set_text(layout, text, -1);
        pango_attr_list_insert(attributes, pango_attr_font_features_new("liga=0")); /* Lato joins the t and i of "time" */
        pango_layout_set_attributes(layout, attributes);
        pango_attr_list_unref(attributes);
        g_free(text);
    } else if (g_utf8_validate(markup, -1, NULL)) {
        pango_layout_set_text(layout, markup, -1);
    }
}

static PangoLayout *make_layout(cairo_t *cr, const struct bead_text_style *style, const char *markup)
{
    PangoContext *context = pango_cairo_create_context(cr);
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_SLIGHT);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(context, options);
    cairo_font_options_destroy(options);
    pango_context_set_round_glyph_positions(context, FALSE);

    PangoLayout *layout = pango_layout_new(context);
    g_object_unref(context);
    PangoFontDescription *font = pango_font_description_new();
    pango_font_description_set_family(font, style->family);
    pango_font_description_set_absolute_size(font, style->size * PANGO_SCALE);
    pango_font_description_set_weight(font, style->bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(layout, font);
    pango_font_description_free(font);
    set_contents(layout, markup);
    return layout;
}

static void layout_size(PangoLayout *layout, double *width, double *height)
{
    int w, h;
    pango_layout_get_size(layout, &w, &h);
    *width = (double)w / PANGO_SCALE;
    *height = (double)h / PANGO_SCALE;
}

/* From the box's start to (x, y), for an extent of the box. */
static double aligned(enum bead_align align, double extent)
{
    return align == BEAD_ALIGN_MIDDLE ? extent / 2 : align == BEAD_ALIGN_END ? extent : 0;
}

void bead_text_draw(cairo_t *cr, const struct bead_text_style *style, double x, double y, const char *markup)
{
    double width, height;
    PangoLayout *layout = make_layout(cr, style, markup);
    layout_size(layout, &width, &height);
    double baseline = (double)pango_layout_get_baseline(layout) / PANGO_SCALE;
    cairo_save(cr);
    cairo_set_source_rgb(cr, style->colour.r, style->colour.g, style->colour.b);
    if (style->upwards) {
        double down = style->down == BEAD_ALIGN_BASELINE ? BEAD_ALIGN_MIDDLE : style->down;
        cairo_translate(cr, x - aligned(style->across, height), y - aligned((enum bead_align)down, width) + width);
        cairo_rotate(cr, -G_PI / 2);
    } else {
        double up = aligned(style->down, height);
        if (style->down == BEAD_ALIGN_MIDDLE)
            up = baseline - digit_middle * style->size;
        if (style->down == BEAD_ALIGN_BASELINE)
            up = baseline;
        cairo_translate(cr, x - aligned(style->across, width), y - up);
    }
    cairo_move_to(cr, 0, 0);
    pango_cairo_update_layout(cr, layout);
    pango_cairo_show_layout(cr, layout);
    cairo_restore(cr);
    g_object_unref(layout);
}

/* A context to measure with where there is none to draw with: the layout does not depend on it. */
static cairo_t *measuring_context(void)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
    cairo_t *cr = cairo_create(surface);
    cairo_surface_destroy(surface);
    return cr;
}

void bead_text_size(cairo_t *cr, const struct bead_text_style *style, const char *markup, double *width, double *height)
{
    cairo_t *used = cr ? cairo_reference(cr) : measuring_context();
    PangoLayout *layout = make_layout(used, style, markup);
    layout_size(layout, width, height);
    g_object_unref(layout);
    cairo_destroy(used);
}

static const char *escaped(const char *c)
{
    return *c == '&' ? "&amp;" : *c == '<' ? "&lt;" : *c == '>' ? "&gt;" : (unsigned char)*c < ' ' ? " " : NULL;
}

void bead_text_escape(const char *text, char *out, size_t size)
{
    size_t used = 0;
    for (const char *next; *text && size > 0; text = next) {
        gunichar c = g_utf8_get_char_validated(text, -1);
        bool valid = c != (gunichar)-1 && c != (gunichar)-2;
        next = valid ? g_utf8_next_char(text) : text + 1;
        const char *replaced = valid ? escaped(text) : "?", *from = replaced ? replaced : text;
        size_t length = replaced ? strlen(replaced) : (size_t)(next - text);
        if (used + length >= size)
            break;
        memcpy(out + used, from, length);
        used += length;
    }
    if (size > 0)
        out[used] = '\0';
}

void bead_text_magnetism(double magnetism, char *out, size_t size)
{
    char number[32];
    snprintf(number, sizeof number, "%.2f", magnetism);
    for (char *end = number + strlen(number) - 1; strchr(number, '.') && (*end == '0' || *end == '.'); end--) {
        bool point = *end == '.';
        *end = '\0';
        if (point)
            break;
    }
    snprintf(out, size, "<span face=\"STIX\"><i>M</i> = %s</span>", number);
}
