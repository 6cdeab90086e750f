/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts in files that are text themselves: XML, HTML, PDF and EPS. */
#include <glib.h>
#include <stdlib.h>
#include <string.h>

#include "render/origin/origin_private.h"

/* ---- XML and HTML ---- */

static const struct {
    const char *name;
    char character;
} names[] = {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}, {"&apos;", '\''}};

void bead_origin_escape(const char *text, FILE *file)
{
    for (; *text; text++) {
        size_t i = 0;
        while (i < sizeof names / sizeof *names && names[i].character != *text)
            i++;
        if (i < sizeof names / sizeof *names)
            fputs(names[i].name, file);
        else if ((unsigned char)*text >= 32 || *text == '\n' || *text == '\t')
            fputc(*text, file);
    }
}

/* The character, as UTF-8, for a name at the beginning of a text; returns the length of the name, 0: there is none. */
static size_t resolve(struct origin_span text, char utf8[8])
{
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (origin_begins(text, names[i].name, strlen(names[i].name))) {
            utf8[0] = names[i].character;
            utf8[1] = 0;
            return strlen(names[i].name);
        }
    }
    char digits[12];
    const bool hex = origin_begins(text, "&#x", 3);
    const struct origin_span part = origin_part(text, hex ? 3 : 2, sizeof digits - 1);
    memcpy(digits, part.bytes, part.length);
    digits[part.length] = 0;
    char *end = digits;
    const unsigned long code = origin_begins(text, "&#", 2) && g_ascii_isxdigit(*digits) ? strtoul(digits, &end, hex ? 16 : 10) : 0;
    if (*end != ';' || code == 0 || !g_unichar_validate((gunichar)code))
        return 0;
    utf8[g_unichar_to_utf8((gunichar)code, utf8)] = 0;
    return (size_t)(end - digits) + (hex ? 4 : 3);
}

/* Copies a text with its characters' names resolved. */
static void unescape(struct origin_span text, FILE *file)
{
    for (size_t at = 0, length; at < text.length; at += length) {
        char utf8[8];
        length = text.bytes[at] == '&' ? resolve(origin_part(text, at, SIZE_MAX), utf8) : 0;
        if (length > 0)
            fputs(utf8, file);
        else
            fwrite(text.bytes + at, 1, length = 1, file);
    }
}

/* Finds the text between `open` and the next `close`. False: there is none. */
static bool between(struct origin_span span, const char *open, const char *close, struct origin_span *found)
{
    const char *begin = memmem(span.bytes, span.length, open, strlen(open)), *limit = (const char *)span.bytes + span.length;
    const char *end = NULL;
    if (begin) {
        begin += strlen(open);
        end = memmem(begin, (size_t)(limit - begin), close, strlen(close));
    }
    if (end)
        *found = (struct origin_span){(const unsigned char *)begin, (size_t)(end - begin)};
    return end;
}

static const char xmp_begins[] =
    "<?xpacket begin=\"\ufeff\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?><x:xmpmeta xmlns:x=\"adobe:ns:meta/\">"
    "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description rdf:about=\"\" "
    "xmlns:dc=\"http://purl.org/dc/elements/1.1/\"><dc:description><rdf:Alt>",
                  xmp_text[] = "<rdf:li xml:lang=\"x-default\">", xmp_text_ends[] = "</rdf:li>",
                  xmp_ends[] = "</rdf:Alt></dc:description></rdf:Description></rdf:RDF></x:xmpmeta><?xpacket end=\"r\"?>";

bool origin_make_xmp(struct origin_span text, struct origin_block *packet)
{
    origin_block_begin(packet);
    if (!packet->file)
        return false;
    fputs(xmp_begins, packet->file);
    fputs(xmp_text, packet->file);
    bead_origin_escape((const char *)text.bytes, packet->file);
    fputs(xmp_text_ends, packet->file);
    fputs(xmp_ends, packet->file);
    return fclose(packet->file) == 0;
}

void origin_get_xmp(struct origin_span packet, FILE *text)
{
    struct origin_span found;
    if (between(packet, xmp_text, xmp_text_ends, &found))
        unescape(found, text);
}

void origin_get_svg(struct origin_span file, FILE *text)
{
    struct origin_span found;
    if (between(file, "<metadata>", "</metadata>", &found))
        unescape(found, text);
}

/* Reports show the scene; slides have it hidden. The program is the page's generator. */
void origin_get_html(struct origin_span file, FILE *text)
{
    struct origin_span program, scene;
    if (!between(file, "<meta name=\"generator\" content=\"", "\">", &program) ||
        !between(file, "<code id=\"scene-text\">", "</code>", &scene))
        return;
    fwrite(program.bytes, 1, program.length, text);
    fputs(", scene:\n", text);
    unescape(scene, text);
}

/* ---- PDF: the attached file (ISO 32000-1, 7.11.4) ---- */

void origin_get_pdf(struct origin_span file, FILE *text)
{
    struct origin_span length;
    char digits[16];
    if (!between(file, "<< /Type /EmbeddedFile /Length ", " >>\nstream\n", &length) || length.length >= sizeof digits)
        return;
    memcpy(digits, length.bytes, length.length);
    digits[length.length] = 0;
    const size_t begin = (size_t)(length.bytes - file.bytes) + length.length + strlen(" >>\nstream\n");
    origin_offer(origin_part(file, begin, strtoul(digits, NULL, 10)), text);
}

/* ---- EPS: comments of ASCII, whose lines have at most 255 characters (DSC 3.0) ---- */

static const char eps_line[] = "%scene:", eps_more[] = "%scene+";
enum { EPS_CHARACTERS = 240 };

static void put_comment(const char *text, size_t *used, FILE *file)
{
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        const bool plain = c >= 32 && c < 127 && c != '\\', full = *used >= EPS_CHARACTERS;
        if (c == '\n' || full) {
            fprintf(file, "\n%s", c == '\n' ? eps_line : eps_more);
            *used = 0;
        }
        if (c != '\n')
            *used += (size_t)fprintf(file, plain ? "%c" : "\\%03o", c);
    }
}

void bead_origin_write_eps(const char *scene, FILE *file)
{
    size_t used = 0;
    fputs(eps_line, file);
    put_comment(BEAD_ORIGIN_HEAD, &used, file);
    put_comment(scene, &used, file);
    fputc('\n', file);
}

static void get_comment(struct origin_span line, FILE *text)
{
    for (size_t at = 0; at < line.length; at++) {
        const struct origin_span code = origin_part(line, at + 1, 3);
        if (line.bytes[at] != '\\' || code.length < 3) {
            fputc(line.bytes[at], text);
            continue;
        }
        fputc((code.bytes[0] & 7) << 6 | (code.bytes[1] & 7) << 3 | (code.bytes[2] & 7), text);
        at += 3;
    }
}

void origin_get_eps(struct origin_span file, FILE *text)
{
    bool first = true;
    for (size_t at = 0; at < file.length;) {
        const struct origin_span rest = origin_part(file, at, SIZE_MAX);
        const unsigned char *end = memchr(rest.bytes, '\n', rest.length);
        const size_t length = end ? (size_t)(end - rest.bytes) : rest.length;
        const bool line = origin_begins(rest, eps_line, strlen(eps_line)), more = origin_begins(rest, eps_more, strlen(eps_more));
        if (!line && !more && !first)
            return;
        if (line && !first)
            fputc('\n', text);
        if (line || more) {
            get_comment(origin_part(rest, strlen(eps_line), length - strlen(eps_line)), text);
            first = false;
        }
        at += length + 1;
    }
}
