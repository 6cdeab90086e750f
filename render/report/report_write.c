/* Writes the page of a report from its template, and escapes what comes from scenes. */
#include "render/report/report_write.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/assets.h"
#include "beadreel/file.h"

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

void report_key(FILE *file, bool comma, const char *name)
{
    fprintf(file, "%s\"%s\":", comma ? "," : "", name);
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

enum bead_error report_samples(FILE *file, const float *values, size_t count, struct bead_message *msg)
{
    double low = 0, high = 0;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    const bool has_sign = low < 0;
    const double step = fmax(high, -low) / (has_sign ? INT16_MAX : UINT16_MAX);
    unsigned char *bytes = malloc(2 * count + 1);
    if (!bytes)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a report");
    for (size_t i = 0; i < count; i++) {
        uint16_t whole = (uint16_t)(step > 0 && isfinite(values[i]) ? lround(values[i] / step) : 0);
        bytes[2 * i] = (unsigned char)(whole & 255);
        bytes[2 * i + 1] = (unsigned char)(whole >> 8);
    }
    fputs("{\"step\":", file);
    report_number(file, step);
    fprintf(file, ",\"signed\":%s,\"data\":", has_sign ? "true" : "false");
    fputc('"', file);
    report_base64(file, bytes, 2 * count);
    fputs("\"}", file);
    free(bytes);
    return BEAD_OK;
}

/* ---- the page ---- */

/* A file of assets/report as it is. */
static enum bead_error include_file(const char *name, FILE *file, struct bead_message *msg)
{
    char asset[96], *text = NULL;
    size_t length = 0;
    snprintf(asset, sizeof asset, "report/%.64s", name);
    enum bead_error err = bead_asset_read(asset, &text, &length, msg);
    if (!err)
        fwrite(text, 1, length, file);
    free(text);
    return err;
}

static enum bead_error write_part(const struct report_part *parts, const void *context, const char *name, FILE *file,
                                  struct bead_message *msg)
{
    for (const struct report_part *part = parts; part->name; part++) {
        if (strcmp(part->name, name) == 0)
            return part->write(context, file, msg);
    }
    return include_file(name, file, msg);
}

struct filling {
    const struct report_part *parts;
    const void *context;
    const char *template;
};

static enum bead_error fill_template(void *context, FILE *file, const char *part, struct bead_message *msg)
{
    const struct filling *filling = context;
    const char *text = filling->template;
    enum bead_error err = BEAD_OK;
    (void)part; /* what cannot be written is told as the file is closed */
    while (!err) {
        const char *open = strstr(text, "{{"), *close = open ? strstr(open, "}}") : NULL;
        char name[64];
        if (!open) {
            fputs(text, file);
            return BEAD_OK;
        }
        if (!close || (size_t)(close - open - 2) >= sizeof name)
            return bead_fail(msg, BEAD_ERROR_FORMAT, "report/page.html: `{{` without a name and `}}`");
        fwrite(text, 1, (size_t)(open - text), file);
        snprintf(name, sizeof name, "%.*s", (int)(close - open - 2), open + 2);
        err = write_part(filling->parts, filling->context, name, file, msg);
        text = close + 2;
    }
    return err;
}

enum bead_error report_write_page(const struct report_part *parts, const void *context, const char *path, uint64_t *bytes,
                                  struct bead_message *msg)
{
    char *template = NULL;
    size_t length = 0;
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    enum bead_error err = plain == (locale_t)0 ? bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a report") : BEAD_OK;
    if (!err)
        err = bead_asset_read("report/page.html", &template, &length, msg);
    if (!err) {
        struct filling filling = {parts, context, template};
        locale_t before = uselocale(plain);
        err = bead_file_write(path, fill_template, &filling, bytes, msg);
        uselocale(before);
    }
    if (plain != (locale_t)0)
        freelocale(plain);
    free(template);
    return err;
}
