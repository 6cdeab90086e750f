/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes PDF, EPS and SVG through cairo. PDF and EPS keep text as text, with fonts embedded; SVG as text with fonts named, or as
 * outlines. text.c gives the lines. */
#include <cairo-pdf.h>
#include <cairo-ps.h>
#include <cairo-svg.h>
#include <ctype.h>
#include <errno.h>
#include <hb.h>
#include <stdlib.h>
#include <strings.h>
#include <time.h>

#include "render/draw/picture.h"
#include "render/draw/raster.h"
#include "render/draw/vector.h"
#include "render/origin/origin.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"

/* An SVG file in parts. */
struct bead_svg_parts {
    char *text; /* the drawing, a whole file */
    size_t length;
    char *words; /* elements that come last, above everything else */
    size_t words_length;
    const char *title, *description, *source; /* "" or NULL: none; source: the scene */
};

struct format {
    const char *extension;
    cairo_surface_t *(*create)(cairo_write_func_t write, void *closure, double width, double height);
    void (*describe)(cairo_surface_t *surface, const struct bead_picture_notes *notes);
    enum bead_error (*write)(const struct bead_svg_parts *drawn, FILE *file, struct bead_message *msg);
    bool svg;
};

static void vector_put(cairo_surface_t *surface, cairo_pdf_metadata_t key, const char *text)
{
    if (text && *text)
        cairo_pdf_surface_set_metadata(surface, key, text);
}

/* One scene always gives the same file: no clock, unless a packager sets one (reproducible-builds.org/specs/source-date-epoch). */
static void put_date(cairo_surface_t *surface)
{
    const char *epoch = getenv("SOURCE_DATE_EPOCH");
    time_t seconds = epoch ? (time_t)strtoll(epoch, NULL, 10) : 0;
    struct tm utc;
    char date[32];
    if (gmtime_r(&seconds, &utc) && strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &utc) > 0)
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, date);
}

static void describe_pdf(cairo_surface_t *surface, const struct bead_picture_notes *notes)
{
    cairo_pdf_surface_restrict_to_version(surface,
                                          CAIRO_PDF_VERSION_1_4); /* without compressed objects, which bead_pdf_write cannot read */
    vector_put(surface, CAIRO_PDF_METADATA_TITLE, notes->title);
    vector_put(surface, CAIRO_PDF_METADATA_AUTHOR, notes->author);
    vector_put(surface, CAIRO_PDF_METADATA_SUBJECT, notes->description);
    vector_put(surface, CAIRO_PDF_METADATA_CREATOR, notes->software);
    put_date(surface);
}

static void describe_svg(cairo_surface_t *surface, const struct bead_picture_notes *)
{
    cairo_svg_surface_restrict_to_version(surface, CAIRO_SVG_VERSION_1_1);
}

static void describe_eps(cairo_surface_t *surface, const struct bead_picture_notes *)
{
    cairo_ps_surface_set_eps(surface, true);
}

static enum bead_error write_pdf(const struct bead_svg_parts *pdf, FILE *file, struct bead_message *)
{
    bead_pdf_write(pdf->text, pdf->length, pdf->source, file);
    return BEAD_OK;
}

/* Without the date, which cairo takes from the clock; with the scene after the comments that begin the file. */
static enum bead_error write_eps(const struct bead_svg_parts *eps, FILE *file, struct bead_message *)
{
    static const char ends[] = "%%EndComments\n";
    const char *date = strstr(eps->text, "%%CreationDate:"), *after = date ? strchr(date, '\n') + 1 : eps->text;
    const char *body = strstr(after, ends);
    fwrite(eps->text, 1, date ? (size_t)(date - eps->text) : 0, file);
    if (body && eps->source && *eps->source) {
        body += strlen(ends);
        fwrite(after, 1, (size_t)(body - after), file);
        bead_origin_write_eps(eps->source, file);
        after = body;
    }
    fwrite(after, 1, eps->length - (size_t)(after - eps->text), file);
    return BEAD_OK;
}

/* ---- SVG: words ---- */

static const cairo_user_data_key_t file_key;

/* Text drawn on this surface goes to `file`, which is borrowed until the surface is destroyed. False: out of memory. */
static bool bead_svg_text_keep(cairo_surface_t *surface, FILE *file)
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

/* Writes the drawing to `file`, with its title, description, scene (as metadata) and words, and with "surface604", "image607" and
 * "source-610" numbered from 1 in order of appearance. Write errors show when the file is closed. Errors: UNSUPPORTED (too many
 * names). */
static enum bead_error bead_svg_write(const struct bead_svg_parts *svg, FILE *file, struct bead_message *msg)
{
    const char *end = svg->text + svg->length, *last = memrchr(svg->text, '<', svg->length); /* "</svg>" */
    last = last ? last : end;
    enum bead_error err = put_body(put_head(svg, file), last, file, msg);
    fwrite(svg->words, 1, svg->words_length, file);
    fwrite(last, 1, (size_t)(end - last), file);
    return err;
}

static const struct format formats[] = {
    {"pdf", cairo_pdf_surface_create_for_stream, describe_pdf, write_pdf, false},
    {"eps", cairo_ps_surface_create_for_stream, describe_eps, write_eps, false},
    {"svg", cairo_svg_surface_create_for_stream, describe_svg, bead_svg_write, true},
};

static const struct format *find_format(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof formats / sizeof formats[0]; i++) {
        if (strcasecmp(dot + 1, formats[i].extension) == 0)
            return &formats[i];
    }
    return NULL;
}

static cairo_status_t write_bytes(void *closure, const unsigned char *data, unsigned int length)
{
    return fwrite(data, 1, length, closure) == length ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static enum bead_error vector_failed(const char *part, cairo_status_t status, struct bead_message *msg)
{
    enum bead_error code = status == CAIRO_STATUS_NO_MEMORY ? BEAD_ERROR_MEMORY : BEAD_ERROR_IO;
    return bead_fail(msg, code, "%s: %s", part,
                     status == CAIRO_STATUS_WRITE_ERROR ? strerror(errno) : cairo_status_to_string(status));
}

struct page {
    const struct format *format;
    int width, height;
    bead_draw draw;
    void *context;
    const struct bead_picture_notes *notes;
};

/* For screen readers a PDF page has a figure, whose text bead_pdf_write adds. It holds an invisible dot, since cairo 1.16 fails if
 * images are within a tag; on top, since anything below the background is left out. */
static void put_figure(cairo_t *cr)
{
    cairo_save(cr);
    cairo_tag_begin(cr, "Document", "");
    cairo_tag_begin(cr, "Figure", "");
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_rectangle(cr, 0, 0, 0.01, 0.01);
    cairo_fill(cr);
    cairo_tag_end(cr, "Figure");
    cairo_tag_end(cr, "Document");
    cairo_restore(cr);
}

static enum bead_error draw_page(cairo_surface_t *surface, double scale, const struct page *page, struct bead_message *msg)
{
    cairo_t *cr = cairo_create(surface);
    cairo_scale(cr, scale, scale);
    bead_warnings_watch();
    enum bead_error err = page->draw(page->context, cr, msg);
    if (!page->format->svg)
        put_figure(cr);
    if (!err)
        cairo_show_page(cr);
    if (!err)
        err = bead_warnings_check(msg);
    cairo_destroy(cr);
    return err;
}

/* `words`: the file for letters that remain text; NULL: they are drawn. */
static enum bead_error write_page(const struct page *page, FILE *file, FILE *words, const char *part, struct bead_message *msg)
{
    const struct bead_picture_notes *notes = page->notes;
    double scale = 72 / notes->dpi;
    /* Cairo crashes without memory for parts that PDF and SVG cannot express, which it holds twice as pixels; the rest is small. */
    const uint64_t bytes = (uint64_t)page->width * (uint64_t)page->height * 4 * 2 + (32 << 20);
    if (!bead_memory_room(bytes))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: needs %.2g GB of free addresses (ulimit -v)", part, 1e-9 * (double)bytes);
    cairo_surface_t *surface = page->format->create(write_bytes, file, page->width * scale, page->height * scale);
    cairo_surface_set_fallback_resolution(surface, notes->dpi, notes->dpi);
    page->format->describe(surface, notes);
    enum bead_error err = words && !bead_svg_text_keep(surface, words)
                              ? bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", part)
                              : draw_page(surface, scale, page, msg);
    cairo_surface_finish(surface);
    cairo_status_t status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    return err ? err : status ? vector_failed(part, status, msg) : BEAD_OK;
}

/* In memory first, because cairo's SVG and PDF lack some parts, and its EPS has too many. */
static enum bead_error vector_fill(void *context, FILE *file, const char *part, struct bead_message *msg)
{
    const struct page *page = context;
    struct bead_svg_parts svg = {
        .title = page->notes->title, .description = page->notes->description, .source = page->notes->source};
    FILE *drawn = open_memstream(&svg.text, &svg.length), *words = open_memstream(&svg.words, &svg.words_length);
    enum bead_error err =
        drawn && words ? write_page(page, drawn, page->format->svg && !page->notes->outlines ? words : NULL, part, msg) : BEAD_OK;
    bool full = !drawn || !words;
    full = (drawn && fclose(drawn) != 0) || full;
    full = (words && fclose(words) != 0) || full;
    if (full && !err)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", part);
    if (!err)
        err = page->format->write(&svg, file, msg);
    free(svg.text);
    free(svg.words);
    return err;
}

enum bead_error bead_vector_write(const char *path, int width, int height, bead_draw draw, void *context,
                                  const struct bead_picture_notes *notes, uint64_t *bytes, struct bead_message *msg)
{
    struct bead_picture_notes own;
    BEAD_TRY(bead_notes_take(&own, notes, msg));
    struct page page = {find_format(path), width, height, draw, context, &own};
    if (!page.format || !(own.dpi > 0))
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s: vector files end in .pdf, .svg or .eps and need dots per inch > 0",
                         path);
    return bead_file_write(path, vector_fill, &page, bytes, msg);
}
