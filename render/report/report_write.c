/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the page of a report from its template, and escapes texts of scenes. */
#include "render/report/report_write.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>

#include "render/origin/origin.h"
#include "sim/base/assets.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"

/* ---- HTML and JSON ---- */

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

void report_open(struct bead_json *json, const struct bead_scene *scene)
{
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "program", "beadreel " BEADREEL_VERSION);
    bead_json_text(json, "title", scene->title ? scene->title : "");
}

void report_field(struct bead_json *json, const struct bead_field_info *info, const char *name)
{
    bead_json_open(json, "field", '{');
    bead_json_text(json, "title", info->title);
    bead_json_text(json, "name", name);
    bead_json_text(json, "unit", info->unit);
    bead_json_flag(json, "contacts", info->of_contacts);
    bead_json_close(json, "}");
}

void report_range(struct bead_json *json, const struct bead_colour_range *range, enum bead_scale scale)
{
    static const char *const scales[] = {[BEAD_SCALE_LINEAR] = "linear", [BEAD_SCALE_SQRT] = "sqrt", [BEAD_SCALE_LOG] = "log"};
    bead_json_open(json, "range", '{');
    bead_json_number(json, "low", range->low);
    bead_json_number(json, "high", range->high);
    bead_json_number(json, "rest", range->rest);
    bead_json_text(json, "scale", scales[scale]);
    bead_json_flag(json, "over", range->over);
    bead_json_flag(json, "under", range->under);
    bead_json_close(json, "}");
}

void report_bytes(struct bead_json *json, const char *key, const unsigned char *bytes, size_t count)
{
    FILE *file = bead_json_key(json, key);
    fputc('"', file);
    report_base64(file, bytes, count);
    fputc('"', file);
}

void report_maps(struct bead_json *json, const struct bead_colormap maps[2])
{
    bead_json_open(json, "maps", '{');
    report_bytes(json, "light", maps[0].rgb[0], sizeof maps[0].rgb);
    report_bytes(json, "dark", maps[1].rgb[0], sizeof maps[1].rgb);
    bead_json_close(json, "}");
}

enum bead_error report_samples(struct bead_json *json, const char *key, const float *values, size_t count, struct bead_message *msg)
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
    bead_json_open(json, key, '{');
    bead_json_number(json, "step", step);
    bead_json_flag(json, "signed", has_sign);
    report_bytes(json, "data", bytes, 2 * count);
    bead_json_close(json, "}");
    return BEAD_OK;
}

/* ---- the page ---- */

static enum bead_error read_file(const char *name, char **text, size_t *length, struct bead_message *msg)
{
    char asset[96];
    snprintf(asset, sizeof asset, "report/%.64s", name);
    return bead_asset_read(asset, text, length, msg);
}

/* Writes an unchanged file of assets/report. */
static enum bead_error include_file(const char *name, FILE *file, struct bead_message *msg)
{
    BEAD_FREED char *text = NULL;
    size_t length = 0;
    BEAD_TRY(read_file(name, &text, &length, msg));
    fwrite(text, 1, length, file);
    return BEAD_OK;
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
    bead_origin_escape(title && *title ? title : "beadreel", file);
    return BEAD_OK;
}

static enum bead_error write_scene(const struct filling *filling, FILE *file, struct bead_message *)
{
    bead_origin_escape(filling->scene->text, file);
    return BEAD_OK;
}

static enum bead_error write_version(const struct filling *, FILE *file, struct bead_message *)
{
    fputs(BEADREEL_VERSION, file);
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
    } own[] = {{"title", write_title}, {"scene", write_scene}, {"version", write_version},
               {"skip", write_skip},   {"body", write_body},   {"scripts", write_scripts}};
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

/* Writes a text with its parts filled in; `name`: of its file, for messages. */
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
    BEAD_TRY(read_file(name, &text, &length, msg));
    const char *licence_end = strchr(text, '\n');
    if (!licence_end || strstr(text, "{{body}}"))
        return bead_fail(msg, BEAD_ERROR_FORMAT, "report/%s: its first line is not the licence, or it contains {{body}}", name);
    return fill(filling, name, licence_end + 1, file, msg);
}

static enum bead_error fill_page(void *context, FILE *file, const char *part, struct bead_message *msg)
{
    const struct filling *filling = context;
    (void)part; /* errors of writing are reported when the file is closed */
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
