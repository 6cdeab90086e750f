/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the page of a report from its template, and escapes texts of scenes. */
#include "render/report/report_write.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/api.h"
#include "sim/base/assets.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"

/* ---- HTML and JSON ---- */

void report_html(FILE *file, const char *text)
{
    static const struct {
        char plain;
        const char *html;
    } escapes[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
    for (; *text; text++) {
        const char *html = NULL;
        for (size_t i = 0; i < sizeof escapes / sizeof *escapes; i++)
            html = *text == escapes[i].plain ? escapes[i].html : html;
        if (html)
            fputs(html, file);
        else if ((unsigned char)*text >= 32 || *text == '\n' || *text == '\t')
            fputc(*text, file);
    }
}

void report_string(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < 32 || c == '"' || c == '\\' || c == '<' || c == '>' || c == '&')
            fprintf(file, "\\u%04x", c);
        else
            fputc(c, file);
    }
    fputc('"', file);
}

void report_number(FILE *file, double value)
{
    if (isfinite(value))
        fprintf(file, "%.12g", value);
    else
        fputs("null", file);
}

void report_numbers(FILE *file, const double *values, size_t count)
{
    fputc('[', file);
    for (size_t i = 0; i < count; i++) {
        if (i > 0)
            fputc(',', file);
        report_number(file, values[i]);
    }
    fputc(']', file);
}

void report_base64(FILE *file, const unsigned char *bytes, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < count; i += 3) {
        size_t left = count - i;
        unsigned word = (unsigned)bytes[i] << 16 | (left > 1 ? (unsigned)bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0u);
        fputc(digits[word >> 18], file);
        fputc(digits[word >> 12 & 63], file);
        fputc(left > 1 ? digits[word >> 6 & 63] : '=', file);
        fputc(left > 2 ? digits[word & 63] : '=', file);
    }
}

void report_key(FILE *file, const char *name)
{
    fprintf(file, ",\"%s\":", name);
}

void report_named_number(FILE *file, const char *name, double value)
{
    report_key(file, name);
    report_number(file, value);
}

void report_named_string(FILE *file, const char *name, const char *text)
{
    report_key(file, name);
    report_string(file, text);
}

void report_open(FILE *file, const char *kind, const struct bead_scene *scene)
{
    fprintf(file, "{\"kind\":\"%s\",\"program\":\"beadreel " BEADREEL_VERSION "\"", kind);
    report_named_string(file, "title", scene->title ? scene->title : "");
}

void report_field(FILE *file, const struct bead_field_info *info, enum bead_field field)
{
    fputs(",\"field\":{\"title\":", file);
    report_string(file, info->title);
    report_named_string(file, "name", bead_field_info(field)->name);
    report_named_string(file, "unit", info->unit);
    fprintf(file, ",\"contacts\":%s}", info->of_contacts ? "true" : "false");
}

void report_range(FILE *file, const struct bead_colour_range *range, enum bead_scale scale)
{
    static const char *const scales[] = {[BEAD_SCALE_LINEAR] = "linear", [BEAD_SCALE_SQRT] = "sqrt", [BEAD_SCALE_LOG] = "log"};
    fputs(",\"range\":{\"low\":", file);
    report_number(file, range->low);
    report_named_number(file, "high", range->high);
    fprintf(file, ",\"scale\":\"%s\",\"over\":%s,\"under\":%s}", scales[scale], range->over ? "true" : "false",
            range->under ? "true" : "false");
}

void report_maps(FILE *file, const struct bead_colormap maps[2])
{
    fputs(",\"maps\":{\"light\":\"", file);
    report_base64(file, maps[0].rgb[0], sizeof maps[0].rgb);
    fputs("\",\"dark\":\"", file);
    report_base64(file, maps[1].rgb[0], sizeof maps[1].rgb);
    fputs("\"}", file);
}

enum bead_error report_samples(FILE *file, const float *values, size_t count, struct bead_message *msg)
{
    double low = 0, high = 0;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    const bool has_sign = low < 0;
    const double step = fmax(high, -low) / (has_sign ? INT16_MAX : UINT16_MAX);
    BEAD_FREED unsigned char *bytes = malloc(2 * count + 1);
    if (!bytes)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a report");
    for (size_t i = 0; i < count; i++) {
        uint16_t whole = (uint16_t)(step > 0 && isfinite(values[i]) ? lround(values[i] / step) : 0);
        bytes[2 * i] = (unsigned char)(whole & 255);
        bytes[2 * i + 1] = (unsigned char)(whole >> 8);
    }
    fputs("{\"step\":", file);
    report_number(file, step);
    fprintf(file, ",\"signed\":%s,\"data\":\"", has_sign ? "true" : "false");
    report_base64(file, bytes, 2 * count);
    fputs("\"}", file);
    return BEAD_OK;
}

/* ---- the page ---- */

static enum bead_error read_file(const char *name, char **text, size_t *length, struct bead_message *msg)
{
    char asset[96];
    snprintf(asset, sizeof asset, "report/%.64s", name);
    return bead_asset_read(asset, text, length, msg);
}

/* A file of assets/report as it is. */
static enum bead_error include_file(const char *name, FILE *file, struct bead_message *msg)
{
    BEAD_FREED char *text = NULL;
    size_t length = 0;
    enum bead_error err = read_file(name, &text, &length, msg);
    if (!err)
        fwrite(text, 1, length, file);
    return err;
}

struct filling {
    const struct report_page *page;
    const struct bead_scene *scene;
    const void *context;
    const char *text; /* of page.html */
};

static enum bead_error write_title(const struct filling *filling, FILE *file, struct bead_message *)
{
    const char *title = filling->scene->title;
    report_html(file, title && *title ? title : "beadreel");
    return BEAD_OK;
}

static enum bead_error write_scene(const struct filling *filling, FILE *file, struct bead_message *)
{
    report_html(file, filling->scene->text);
    return BEAD_OK;
}

static enum bead_error write_scripts(const struct filling *filling, FILE *file, struct bead_message *msg)
{
    for (const char *const *script = filling->page->scripts; *script; script++) {
        if (script != filling->page->scripts)
            fputc('\n', file);
        BEAD_TRY(include_file(*script, file, msg));
    }
    return BEAD_OK;
}

static enum bead_error write_skip(const struct filling *filling, FILE *file, struct bead_message *)
{
    if (filling->page->controls)
        fprintf(file, "<a class=\"skip\" href=\"#%s\">Skip to the controls</a>\n", filling->page->controls);
    return BEAD_OK;
}

static enum bead_error write_body(const struct filling *filling, FILE *file, struct bead_message *msg);

static enum bead_error write_part(const struct filling *filling, const char *name, FILE *file, struct bead_message *msg)
{
    static const struct {
        const char *name;
        enum bead_error (*write)(const struct filling *filling, FILE *file, struct bead_message *msg);
    } own[] = {
        {"title", write_title}, {"scene", write_scene}, {"skip", write_skip}, {"body", write_body}, {"scripts", write_scripts}};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        if (strcmp(own[i].name, name) == 0)
            return own[i].write(filling, file, msg);
    }
    for (const struct report_part *part = filling->page->parts; part->name; part++) {
        if (strcmp(part->name, name) == 0)
            return part->write(filling->context, file, msg);
    }
    return include_file(name, file, msg);
}

/* Writes a text with its parts filled in; `name` is that of its file, for messages. */
static enum bead_error fill(const struct filling *filling, const char *name, const char *text, FILE *file, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    while (!err) {
        const char *open = strstr(text, "{{"), *close = open ? strstr(open, "}}") : NULL;
        char part[64];
        if (!open) {
            fputs(text, file);
            return BEAD_OK;
        }
        if (!close || (size_t)(close - open - 2) >= sizeof part)
            return bead_fail(msg, BEAD_ERROR_FORMAT, "report/%s: `{{` without a name and `}}`", name);
        fwrite(text, 1, (size_t)(open - text), file);
        snprintf(part, sizeof part, "%.*s", (int)(close - open - 2), open + 2);
        err = write_part(filling, part, file, msg);
        text = close + 2;
    }
    return err;
}

/* Leaves out the first line, the licence, which the page already has. */
static enum bead_error write_body(const struct filling *filling, FILE *file, struct bead_message *msg)
{
    BEAD_FREED char *text = NULL;
    size_t length = 0;
    const char *name = filling->page->body;
    enum bead_error err = read_file(name, &text, &length, msg);
    const char *licence_end = err ? NULL : strchr(text, '\n');
    if (!err && (!licence_end || strstr(text, "{{body}}")))
        err = bead_fail(msg, BEAD_ERROR_FORMAT, "report/%s: its first line is not the licence, or it contains {{body}}", name);
    if (!err)
        err = fill(filling, name, licence_end + 1, file, msg);
    return err;
}

static enum bead_error fill_page(void *context, FILE *file, const char *part, struct bead_message *msg)
{
    const struct filling *filling = context;
    (void)part; /* errors of writing are reported as the file is closed */
    return fill(filling, "page.html", filling->text, file, msg);
}

enum bead_error report_write_page(const struct report_page *page, const struct bead_scene *scene, const void *context,
                                  const char *path, uint64_t *bytes, struct bead_message *msg)
{
    BEAD_FREED char *text = NULL;
    size_t length = 0;
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    enum bead_error err = plain == (locale_t)0 ? bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a report") : BEAD_OK;
    if (!err)
        err = read_file("page.html", &text, &length, msg);
    if (!err) {
        struct filling filling = {page, scene, context, text};
        locale_t before = uselocale(plain);
        err = bead_file_write(path, fill_page, &filling, bytes, msg);
        uselocale(before);
    }
    if (plain != (locale_t)0)
        freelocale(plain);
    return err;
}
