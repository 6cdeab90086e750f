/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes PDF, EPS and SVG through cairo. PDF and EPS keep text as text, with fonts embedded; SVG as text with fonts named, or as
 * outlines. */
#include <cairo-pdf.h>
#include <cairo-ps.h>
#include <cairo-svg.h>
#include <errno.h>
#include <stdlib.h>
#include <strings.h>
#include <time.h>

#include "render/draw/picture.h"
#include "render/draw/raster.h"
#include "render/draw/vector.h"
#include "render/origin/origin.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"

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
