/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text through Pango, laid out independently of the pixel grid, so that it is the same in rasters and vector files. */
#include <hb.h>
#include <limits.h>
#include <math.h>
#include <pango/pangocairo.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "render/draw/vector.h"

/* Middle of digits and capitals above the baseline, in units of the font size (STIX 0.34, Lato 0.36). */
static const double digit_middle = 0.35;

/* Height of a family's lines above and below the baseline, in units of the font size. These are Lato 2.0's own; Lato 2.015 has
 * 0.987 and 0.213: layouts of pictures are the same with either. */
static const struct line_metrics {
    const char *family;
    double above, below;
} line_metrics[] = {{"Lato", 0.805, 0.195}};

/* Symbols are set in STIX, whose letters are lower than Lato's by this. */
static const char symbols[] = "STIX";
static const double symbol_scale = 1.1;

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

/* Makes symbols as high as the letters around them; lowered and raised text has its own size already. */
static void match_symbols(PangoAttrList *attributes)
{
    GSList *all = pango_attr_list_get_attributes(attributes);
    for (GSList *i = all; i; i = i->next) {
        const PangoAttribute *face = i->data;
        bool sized = false;
        if (face->klass->type != PANGO_ATTR_FAMILY || strcmp(((const PangoAttrString *)i->data)->value, symbols) != 0)
            continue;
        for (GSList *k = all; k; k = k->next) {
            const PangoAttribute *other = k->data;
            bool size = other->klass->type == PANGO_ATTR_SCALE || other->klass->type == PANGO_ATTR_SIZE ||
                        other->klass->type == PANGO_ATTR_ABSOLUTE_SIZE;
            sized = sized || (size && other->start_index < face->end_index && other->end_index > face->start_index);
        }
        if (sized)
            continue;
        PangoAttribute *scale = pango_attr_scale_new(symbol_scale);
        scale->start_index = face->start_index;
        scale->end_index = face->end_index;
        pango_attr_list_insert(attributes, scale);
    }
    g_slist_free_full(all, (GDestroyNotify)pango_attribute_destroy);
}

/* Broken markup is shown as plain text: Pango's own call would print a warning. */
static void set_contents(PangoLayout *layout, const char *family, const char *markup)
{
    PangoAttrList *attributes = NULL;
    char *text = NULL;
    if (pango_parse_markup(markup, -1, 0, &attributes, &text, NULL, NULL)) {
        pango_layout_set_text(layout, text, -1);
        pango_attr_list_insert(attributes, pango_attr_font_features_new("liga=0")); /* Lato joins the t and i of "time" */
        if (strcmp(family, symbols) != 0)
            match_symbols(attributes);
        pango_layout_set_attributes(layout, attributes);
        pango_attr_list_unref(attributes);
        g_free(text);
    } else if (g_utf8_validate(markup, -1, NULL)) {
        pango_layout_set_text(layout, markup, -1);
    }
}

static PangoLayout *make_layout(cairo_t *cr, const struct bead_text_style *style, double wrap, const char *markup)
{
    bead_fonts_use_own();
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
    if (wrap < 0) {
        pango_layout_set_width(layout, (int)ceil(-wrap * PANGO_SCALE));
        pango_layout_set_ellipsize(layout, PANGO_ELLIPSIZE_MIDDLE);
        pango_layout_set_single_paragraph_mode(layout, TRUE);
    }
    if (wrap > 0) {
        static const PangoAlignment alignments[] = {
            [BEAD_ALIGN_START] = PANGO_ALIGN_LEFT, [BEAD_ALIGN_MIDDLE] = PANGO_ALIGN_CENTER, [BEAD_ALIGN_END] = PANGO_ALIGN_RIGHT};
        pango_layout_set_width(layout, (int)ceil(wrap * PANGO_SCALE));
        pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
        pango_layout_set_alignment(layout, alignments[style->across]);
    }
    set_contents(layout, style->family, markup);
    return layout;
}

/* A line of a layout, in Pango's units: its left end and baseline, and its reach above and below that. */
struct line {
    PangoLayoutLine *line;
    PangoRectangle ink; /* right of and below the layout's origin */
    int x, baseline, above, below;
};

struct laid_out {
    PangoLayout *layout;
    struct line *lines;
    int count;
    bool moved; /* lines are not where Pango puts them */
    /* px: how far right of the layout's origin its text begins (more than 0 for centred lines), its box, its first baseline. */
    double begins, width, height, baseline;
};

/* Corrects above and below, in Pango's units, to the family's metrics; false: they are right, within the rounding of font files. */
static bool count_metrics(const char *family, double size, int *above, int *below)
{
    const double same = 0.02 * size;
    for (size_t i = 0; i < sizeof line_metrics / sizeof line_metrics[0]; i++) {
        const struct line_metrics *metrics = &line_metrics[i];
        int up = (int)lround(metrics->above * size), down = (int)lround(metrics->below * size);
        if (strcmp(family, metrics->family) != 0 || (abs(up - *above) < same && abs(down - *below) < same))
            continue;
        *above = up, *below = down;
        return true;
    }
    return false;
}

/* Like count_metrics, for the run at `runs`, which may be raised or lowered. */
static bool run_metrics(PangoLayoutIter *runs, int *above, int *below)
{
    PangoRectangle box;
    pango_layout_iter_get_run_extents(runs, NULL, &box);
    int baseline = pango_layout_iter_get_run_baseline(runs), rise = pango_layout_iter_get_baseline(runs) - baseline;
    *above = baseline - box.y, *below = box.y + box.height - baseline;
    PangoFont *font = pango_layout_iter_get_run_readonly(runs)->item->analysis.font;
    PangoFontDescription *description = pango_font_describe(font);
    int width, size; /* as laid out; the description has the size in the drawing */
    hb_font_get_scale(pango_font_get_hb_font(font), &width, &size);
    bool other = count_metrics(pango_font_description_get_family(description), size, above, below);
    pango_font_description_free(description);
    *above += rise, *below -= rise;
    return other;
}

/* A line extends as far as any of its runs; `iter` is at it. */
static bool measure_line(const struct bead_text_style *style, PangoLayoutIter *iter, struct line *line)
{
    PangoRectangle box;
    bool moved = false, any = false;
    pango_layout_iter_get_line_extents(iter, &line->ink, &box);
    line->line = pango_layout_iter_get_line_readonly(iter);
    line->x = box.x, line->baseline = pango_layout_iter_get_baseline(iter);
    line->above = line->baseline - box.y, line->below = box.y + box.height - line->baseline;
    int highest = INT_MIN, lowest = INT_MIN;
    PangoLayoutIter *runs = pango_layout_iter_copy(iter);
    do {
        int above, below;
        if (!pango_layout_iter_get_run_readonly(runs))
            continue;
        moved |= run_metrics(runs, &above, &below);
        highest = above > highest ? above : highest, lowest = below > lowest ? below : lowest;
        any = true;
    } while (pango_layout_iter_next_run(runs) && pango_layout_iter_get_line_readonly(runs) == line->line);
    pango_layout_iter_free(runs);
    if (!any)
        return count_metrics(style->family, style->size * PANGO_SCALE, &line->above, &line->below);
    if (moved)
        line->above = highest, line->below = lowest;
    return moved;
}

static struct laid_out lay_out(cairo_t *cr, const struct bead_text_style *style, double wrap, const char *markup)
{
    struct laid_out text = {.layout = make_layout(cr, style, wrap, markup)};
    PangoRectangle box;
    pango_layout_get_extents(text.layout, NULL, &box);
    text.begins = (double)box.x / PANGO_SCALE, text.width = (double)box.width / PANGO_SCALE;
    text.lines = g_new0(struct line, pango_layout_get_line_count(text.layout));
    PangoLayoutIter *iter = pango_layout_get_iter(text.layout);
    do {
        text.moved |= measure_line(style, iter, &text.lines[text.count++]);
    } while (pango_layout_iter_next_line(iter));
    pango_layout_iter_free(iter);
    int height = 0;
    for (int i = 0; i < text.count; i++) {
        struct line *line = &text.lines[i];
        line->ink.y += height + line->above - line->baseline;
        line->baseline = height + line->above;
        height += line->above + line->below;
    }
    text.height = (double)height / PANGO_SCALE;
    text.baseline = (double)text.lines[0].baseline / PANGO_SCALE;
    return text;
}

static void lay_away(struct laid_out *text)
{
    g_free(text->lines);
    g_object_unref(text->layout);
}

static const cairo_user_data_key_t watch_key;

bool bead_text_watch(cairo_surface_t *surface, const struct bead_text_watch *watch)
{
    return cairo_surface_set_user_data(surface, &watch_key, (void *)watch, NULL) == CAIRO_STATUS_SUCCESS;
}

/* Tells the watch of the text at the context's origin. */
static void tell(cairo_t *cr, const struct laid_out *text, const char *markup)
{
    const struct bead_text_watch *watch = cairo_surface_get_user_data(cairo_get_target(cr), &watch_key);
    if (!watch)
        return;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < text->count; i++) {
        const PangoRectangle *ink = &text->lines[i].ink;
        if (!ink->width && !ink->height && text->count > 1)
            continue;
        low[0] = fmin(low[0], (double)ink->x / PANGO_SCALE), high[0] = fmax(high[0], (double)(ink->x + ink->width) / PANGO_SCALE);
        low[1] = fmin(low[1], (double)ink->y / PANGO_SCALE), high[1] = fmax(high[1], (double)(ink->y + ink->height) / PANGO_SCALE);
    }
    cairo_user_to_device(cr, &low[0], &low[1]);
    cairo_user_to_device(cr, &high[0], &high[1]);
    watch->seen(watch->context, markup, fmin(low[0], high[0]), fmin(low[1], high[1]), fabs(high[0] - low[0]),
                fabs(high[1] - low[1]));
}

/* From the box's start to (x, y), for an extent of the box. */
static double aligned(enum bead_align align, double extent)
{
    return align == BEAD_ALIGN_MIDDLE ? extent / 2 : align == BEAD_ALIGN_END ? extent : 0;
}

/* At the context's origin. */
static void show(cairo_t *cr, const struct laid_out *text)
{
    FILE *file = bead_svg_text_file(cr);
    cairo_move_to(cr, 0, 0);
    pango_cairo_update_layout(cr, text->layout);
    if (!file && !text->moved)
        pango_cairo_show_layout(cr, text->layout);
    for (int i = 0; (file || text->moved) && i < text->count; i++) {
        const struct line *line = &text->lines[i];
        cairo_move_to(cr, (double)line->x / PANGO_SCALE, (double)line->baseline / PANGO_SCALE);
        if (file)
            bead_svg_text_line(file, cr, text->layout, line->line, line->x, line->baseline);
        else
            pango_cairo_show_layout_line(cr, line->line);
    }
}

void bead_text_draw(cairo_t *cr, const struct bead_text_style *style, double x, double y, const char *markup)
{
    bead_text_draw_lines(cr, style, 0, x, y, markup);
}

void bead_text_draw_lines(cairo_t *cr, const struct bead_text_style *style, double wrap, double x, double y, const char *markup)
{
    struct laid_out text = lay_out(cr, style, wrap, markup);
    cairo_save(cr);
    cairo_set_source_rgb(cr, style->colour.r, style->colour.g, style->colour.b);
    if (style->upwards) {
        double down = style->down == BEAD_ALIGN_BASELINE ? BEAD_ALIGN_MIDDLE : style->down;
        cairo_translate(cr, x - aligned(style->across, text.height), y - aligned((enum bead_align)down, text.width) + text.width);
        cairo_rotate(cr, -G_PI / 2);
    } else {
        double up = aligned(style->down, text.height);
        if (style->down == BEAD_ALIGN_MIDDLE)
            up = text.baseline - digit_middle * style->size;
        if (style->down == BEAD_ALIGN_BASELINE)
            up = text.baseline;
        cairo_translate(cr, x - aligned(style->across, text.width), y - up);
    }
    cairo_translate(cr, -text.begins, 0);
    tell(cr, &text, markup);
    show(cr, &text);
    cairo_restore(cr);
    lay_away(&text);
}

/* A context for measuring only: the layout does not depend on it. */
static cairo_t *measuring_context(void)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
    cairo_t *cr = cairo_create(surface);
    cairo_surface_destroy(surface);
    return cr;
}

/* Widths and heights of texts, by thread: layouts ask for a few texts many times, and Pango is slow. */
static GPrivate measured = G_PRIVATE_INIT((GDestroyNotify)g_hash_table_unref);
enum { MOST_MEASURED = 1024 };

static GHashTable *measured_texts(void)
{
    GHashTable *texts = g_private_get(&measured);
    if (!texts || g_hash_table_size(texts) >= MOST_MEASURED) {
        texts = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
        g_private_replace(&measured, texts);
    }
    return texts;
}

void bead_text_size(cairo_t *cr, const struct bead_text_style *style, const char *markup, double *width, double *height)
{
    bead_text_size_lines(cr, style, 0, markup, width, height);
}

void bead_text_size_lines(cairo_t *cr, const struct bead_text_style *style, double wrap, const char *markup, double *width,
                          double *height)
{
    GHashTable *texts = measured_texts();
    char *key = g_strdup_printf("%s %a %d %a %s", style->family, style->size, style->bold, wrap, markup);
    double *size = g_hash_table_lookup(texts, key);
    if (size) {
        g_free(key);
    } else {
        cairo_t *used = cr ? cairo_reference(cr) : measuring_context();
        struct laid_out text = lay_out(used, style, wrap, markup);
        size = g_new(double, 2);
        size[0] = text.width, size[1] = text.height;
        g_hash_table_insert(texts, key, size);
        lay_away(&text);
        cairo_destroy(used);
    }
    *width = size[0], *height = size[1];
}
