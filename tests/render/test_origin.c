/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes in files: small files made by hand, as the standards of their formats have them, give back the text that was put into
 * them; and a file that is cut off anywhere gives no more than the beginning of it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "render/origin/origin_private.h"

/* ---- bytes ---- */

struct bytes {
    unsigned char at[200000];
    size_t count;
};

static void add(struct bytes *b, const void *more, size_t count)
{
    assert_true(b->count + count <= sizeof b->at);
    memcpy(b->at + b->count, more, count);
    b->count += count;
}

static void add_words(struct bytes *b, const char *words)
{
    add(b, words, strlen(words));
}

#define ADD(b, ...) add(b, (const unsigned char[]){__VA_ARGS__}, sizeof((const unsigned char[]){__VA_ARGS__}))

static uint64_t number(const unsigned char *at, int bytes, bool big)
{
    uint64_t value = 0;
    for (int i = 0; i < bytes; i++)
        value |= (uint64_t)at[i] << 8 * (big ? bytes - 1 - i : i);
    return value;
}

/* A box of MP4: its length with its head, its name; `of` is put into it. */
static void put_box(struct bytes *b, const char *name, const char *before, size_t count, const struct bytes *of)
{
    const uint32_t length = (uint32_t)(8 + count + of->count);
    ADD(b, (unsigned char)(length >> 24), (unsigned char)(length >> 16), (unsigned char)(length >> 8), (unsigned char)length);
    add(b, name, 4);
    add(b, before, count);
    add(b, of->at, of->count);
}

/* An element of Matroska with a length of four bytes. */
static void put_element(struct bytes *b, uint32_t name, int bytes, const struct bytes *of)
{
    for (int i = bytes; i-- > 0;)
        ADD(b, (unsigned char)(name >> 8 * i));
    ADD(b, (unsigned char)(0x10 | of->count >> 24), (unsigned char)(of->count >> 16), (unsigned char)(of->count >> 8),
        (unsigned char)of->count);
    add(b, of->at, of->count);
}

static void add_escaped(struct bytes *b, const char *text)
{
    char *bytes;
    size_t length;
    FILE *file = open_memstream(&bytes, &length);
    bead_origin_escape(text, file);
    fclose(file);
    add(b, bytes, length);
    free(bytes);
}

/* ---- files that libraries or other rooms write with their text ---- */

static struct bytes inner, outer; /* of nested boxes; too large for the stack */

static void nest(const char *name, const char *before, size_t count)
{
    outer.count = 0;
    put_box(&outer, name, before, count, &inner);
    inner = outer;
}

/* moov/udta/meta/ilst/(c)cmt/data; MOV has a number in place of (c)cmt and no udta. `long_box`: a box before it with a length of 64
 * bits; another reaches to the end. */
static void make_boxes(struct bytes *b, const char *text, bool mov)
{
    static const struct bytes none = {.count = 0};
    put_box(b, "ftyp", "isom\0\0\0\0", 8, &none);
    ADD(b, 0, 0, 0, 1, 'm', 'd', 'a', 't', 0, 0, 0, 0, 0, 0, 0, 19, 1, 2, 3);
    inner.count = 0;
    add_words(&inner, text);
    nest("data", "\0\0\0\1\0\0\0\0", 8);
    nest(mov ? "\0\0\0\1" : "\251cmt", "", 0);
    nest("ilst", "", 0);
    nest("meta", "\0\0\0\0", 4);
    if (!mov)
        nest("udta", "", 0);
    outer.count = 0;
    put_box(&outer, "udta", "", 0, &none); /* one without a text before it */
    add(&outer, inner.at, inner.count);
    put_box(b, "moov", "", 0, &outer);
    ADD(b, 0, 0, 0, 0, 'f', 'r', 'e', 'e', 1, 2);
}

static void make_mp4(struct bytes *b, const char *text)
{
    make_boxes(b, text, false);
}

static void make_mov(struct bytes *b, const char *text)
{
    make_boxes(b, text, true);
}

/* A segment of unknown length, as of films that are still written, with a void element before its tags. */
static void make_matroska(struct bytes *b, const char *text)
{
    static const uint32_t names[] = {0x4487, 0x67c8, 0x7373, 0x1254c367};
    static const int bytes[] = {2, 2, 2, 4};
    static const struct bytes none = {.count = 0};
    ADD(b, 0x1a, 0x45, 0xdf, 0xa3, 0x83, 1, 2, 3, 0x18, 0x53, 0x80, 0x67, 0x01, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xec,
        0x82, 7, 7);
    inner.count = 0;
    add_words(&inner, text);
    for (int i = 0; i < 4; i++) {
        outer.count = 0;
        if (i == 2) /* a list without a text before it */
            put_element(&outer, names[i], bytes[i], &none);
        put_element(&outer, names[i], bytes[i], &inner);
        inner = outer;
    }
    add(b, inner.at, inner.count);
}

static void make_svg(struct bytes *b, const char *text)
{
    add_words(b, "<svg><metadata>");
    add_escaped(b, text);
    add_words(b, "</metadata><g/></svg>");
}

static void make_html(struct bytes *b, const char *text)
{
    add_words(b, "<html><meta name=\"generator\" content=\"beadreel " BEADREEL_VERSION "\"><code id=\"scene-text\">");
    add_escaped(b, text + strlen(BEAD_ORIGIN_HEAD));
    add_words(b, "</code></html>");
}

static void make_pdf(struct bytes *b, const char *text)
{
    char head[100];
    snprintf(head, sizeof head, "%%PDF-1.7\n4 0 obj\n<< /Type /EmbeddedFile /Length %zu >>\nstream\n", strlen(text));
    add_words(b, head);
    add_words(b, text);
    add_words(b, "\nendstream\nendobj\n");
}

static void make_eps(struct bytes *b, const char *text)
{
    char *bytes;
    size_t length;
    FILE *file = open_memstream(&bytes, &length);
    bead_origin_write_eps(text + strlen(BEAD_ORIGIN_HEAD), file);
    fclose(file);
    add_words(b, "%!PS-Adobe-3.0 EPSF-3.0\n%%EndComments\n");
    for (size_t i = 0, line = 0; i < length; i++) { /* DSC 3.0: ASCII in lines of at most 255 characters */
        line = bytes[i] == '\n' ? 0 : line + 1;
        assert_true(line <= 255 && (bytes[i] == '\n' || (bytes[i] >= 32 && bytes[i] < 127)));
    }
    add(b, bytes, length);
    add_words(b, "showpage\n");
    free(bytes);
}

/* ---- files whose text is put into them ---- */

/* JFIF: the start, the segment of the application, an empty one, a scan, whose data look like a comment, the end. */
static void begin_jpeg(struct bytes *b)
{
    ADD(b, 0xff, 0xd8, 0xff, 0xe0, 0, 16, 'J', 'F', 'I', 'F', 0, 1, 2, 0, 0, 1, 0, 1, 0, 0, 0xff, 0xe1, 0, 2, 0xff, 0xda, 0, 3, 9,
        0xff, 0xfe, 0, 3, 'N', 0xff, 0xd9);
}

static void check_jpeg(const struct bytes *b, size_t)
{
    assert_true(b->at[24] == 0xff && b->at[25] == 0xfe); /* behind the application's, before the scan */
    assert_memory_equal(b->at + b->count - 12, ((const unsigned char[]){0xff, 0xda, 0, 3, 9, 0xff, 0xfe, 0, 3, 'N', 0xff, 0xd9}),
                        12);
}

/* Two colours of all pictures, an extension, a picture of one pixel with four colours of its own. */
static void begin_gif(struct bytes *b)
{
    add_words(b, "GIF89a");
    ADD(b, 1, 0, 1, 0, 0x80, 0, 0, 1, 2, 3, 4, 5, 6, 0x21, 0xf9, 4, 0, 0, 0, 0, 0, 0x2c, 0, 0, 0, 0, 1, 0, 1, 0, 0x81, 1, 1, 1, 2,
        2, 2, 3, 3, 3, 4, 4, 4, 2, 2, 0x44, 1, 0, 0x3b);
}

static void check_gif(const struct bytes *b, size_t was)
{
    assert_true(b->at[b->count - 1] == 0x3b && b->at[was - 1] == 0x21 && b->at[was] == 0xfe);
}

/* Width, height, program: the tags on both sides of the description's, 270. */
static void begin_tiff(struct bytes *b)
{
    ADD(b, 'I', 'I', 42, 0, 8, 0, 0, 0, 3, 0);
    ADD(b, 0, 1, 3, 0, 1, 0, 0, 0, 7, 0, 0, 0, 1, 1, 3, 0, 1, 0, 0, 0, 5, 0, 0, 0, 49, 1, 2, 0, 4, 0, 0, 0, 'a', 'b', 'c', 0);
    ADD(b, 0, 0, 0, 0, 9);
}

static void check_tiff(const struct bytes *b, size_t)
{
    const unsigned char *list = b->at + number(b->at + 4, 4, false);
    static const unsigned tags[] = {256, 257, 270, 305}, values[] = {7, 5, 0, 'a' | 'b' << 8 | 'c' << 16};
    assert_true((list - b->at) % 2 == 0 && number(list, 2, false) == 4);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(number(list + 2 + 12 * i, 2, false), tags[i]);
        assert_true(tags[i] == 270 || number(list + 2 + 12 * i + 8, 4, false) == values[i]);
    }
    assert_true(list + 2 + 12 * 4 + 4 == b->at + b->count && number(b->at + b->count - 4, 4, false) == 0);
    assert_int_equal(number(list + 2 + 24 + 8, 4, false) % 2, 0);
}

/* A lossless one of 300 x 200 with alpha: 14 bits each of width - 1 and height - 1, then one. */
static void begin_webp(struct bytes *b)
{
    const uint32_t bits = 299 | 199 << 14 | 1u << 28;
    add_words(b, "RIFF");
    ADD(b, 18, 0, 0, 0);
    add_words(b, "WEBPVP8L");
    ADD(b, 5, 0, 0, 0, 0x2f, (unsigned char)bits, (unsigned char)(bits >> 8), (unsigned char)(bits >> 16),
        (unsigned char)(bits >> 24), 0);
}

static void check_webp(const struct bytes *b, size_t)
{
    assert_int_equal(number(b->at + 4, 4, false), b->count - 8);
    assert_memory_equal(b->at + 12, "VP8X\12\0\0\0", 8);
    assert_int_equal(b->at[20], 4 | 16); /* XMP and alpha */
    assert_true(number(b->at + 24, 3, false) == 299 && number(b->at + 27, 3, false) == 199);
    assert_memory_equal(b->at + 30, "VP8L\5\0\0\0", 8);
    assert_true(b->count % 2 == 0);
}

static void begin_avif(struct bytes *b)
{
    static const struct bytes none = {.count = 0};
    put_box(b, "ftyp", "avif\0\0\0\0", 8, &none);
    put_box(b, "mdat", "\1\2\3", 3, &none);
}

static void check_avif(const struct bytes *b, size_t was)
{
    assert_int_equal(number(b->at + was, 4, true), b->count - was);
    assert_memory_equal(b->at + was + 4, "uuid\xbe\x7a\xcf\xcb\x97\xa9\x42\xe8\x9c\x71\x99\x94\x91\xe3\xaf\xac", 20);
}

/* One pixel. */
static void begin_png(struct bytes *b)
{
    ADD(b, 0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0, 0, 1, 0, 0, 0, 1, 8, 6, 0, 0, 0, 0x1f, 0x15,
        0xc4, 0x89, 0, 0, 0, 10, 'I', 'D', 'A', 'T', 0x78, 0x9c, 0x63, 0, 1, 0, 0, 5, 0, 1, 13, 10, 0x2d, 0xb4, 0, 0, 0, 0, 'I',
        'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82);
}

/* The remainder of contents and checksum, without the last inversion, is the polynomial's own number. */
static void check_png(const struct bytes *b, size_t was)
{
    const unsigned char *chunk = b->at + was - 12;
    const uint64_t length = number(chunk, 4, true);
    uint32_t value = UINT32_MAX;
    assert_true(chunk + 12 + length + 12 == b->at + b->count && memcmp(chunk + 4, "iTXt", 4) == 0);
    for (uint64_t i = 0; i < length + 8; i++) {
        const uint64_t at = i < length + 4 ? 4 + i : 4 + length + 4 + (length + 7 - i); /* the checksum has its high byte first */
        for (int bit = 0; bit < 8; bit++)
            value = value >> 1 ^ (((value ^ chunk[at] >> bit) & 1) != 0 ? 0xedb88320u : 0);
    }
    assert_int_equal(value, 0xdebb20e3u);
}

/* ---- the test ---- */

static const struct {
    const char *name;
    void (*make)(struct bytes *b, const char *text);
    void (*begin)(struct bytes *b);
    void (*check)(const struct bytes *b, size_t was);
} kinds[] = {
    {"a.mp4", make_mp4, NULL, NULL},          {"a.mov", make_mov, NULL, NULL},          {"a.mkv", make_matroska, NULL, NULL},
    {"a.webm", make_matroska, NULL, NULL},    {"a.svg", make_svg, NULL, NULL},          {"a.html", make_html, NULL, NULL},
    {"a.pdf", make_pdf, NULL, NULL},          {"a.eps", make_eps, NULL, NULL},          {"a.jpg", NULL, begin_jpeg, check_jpeg},
    {"a.gif", NULL, begin_gif, check_gif},    {"a.tiff", NULL, begin_tiff, check_tiff}, {"a.webp", NULL, begin_webp, check_webp},
    {"a.avif", NULL, begin_avif, check_avif}, {"a.png", NULL, begin_png, check_png}};

static enum bead_error try_to_put(struct bytes *b, const char *name, const char *text, struct bead_message *msg)
{
    FILE *file = tmpfile();
    assert_int_equal(fwrite(b->at, 1, b->count, file), b->count);
    fflush(file);
    assert_true(bead_origin_is_put(name));
    const enum bead_error err = bead_origin_put(name, fileno(file), text, msg);
    const ssize_t count = pread(fileno(file), b->at, sizeof b->at, 0);
    assert_true(count > 0 && count < (ssize_t)sizeof b->at);
    b->count = (size_t)count;
    fclose(file);
    return err;
}

static void put(struct bytes *b, const char *name, const char *text)
{
    struct bead_message msg = {""};
    if (try_to_put(b, name, text, &msg))
        fail_msg("%s", msg.text);
}

/* The scene of the first `count` bytes, in memory of their own, so that sanitizers see their end. */
static char *find(const char *name, const struct bytes *b, size_t count)
{
    char version[40], *scene;
    struct bead_message msg = {""};
    unsigned char *bytes = malloc(count + (count == 0));
    memcpy(bytes, b->at, count);
    assert_int_equal(bead_origin_find(name, bytes, count, &scene, version, sizeof version, &msg), BEAD_OK);
    assert_string_equal(version, scene ? BEADREEL_VERSION : "");
    free(bytes);
    return scene;
}

/* All characters that some format has names for, and more than a segment of JPEG, a block of GIF or a line of EPS can have. */
static void make_scene(char *scene, size_t length)
{
    static const char some[] = "chain: {name: \"<a & b's>\"} # \\ \xc3\xa9 \xe6\xbc\xa2\n\tend; ";
    for (size_t i = 0; i < length; i += sizeof some - 1)
        memcpy(scene + i, some, sizeof some);
}

static void scenes_are_found_again(void **)
{
    static struct bytes file;
    static char text[80100];
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        for (int lengthy = 0; lengthy < 2; lengthy++) {
            strcpy(text, BEAD_ORIGIN_HEAD);
            char *scene = text + strlen(text);
            make_scene(scene, lengthy ? 70000 : 260);
            file.count = 0;
            (kinds[k].make ? kinds[k].make(&file, text) : kinds[k].begin(&file));
            const size_t was = file.count;
            if (!kinds[k].make) {
                assert_null(find(kinds[k].name, &file, file.count));
                put(&file, kinds[k].name, text);
                kinds[k].check(&file, was);
            }
            char *found = find(kinds[k].name, &file, file.count);
            if (!found || strcmp(found, scene) != 0)
                fail_msg("%s of %zu bytes: %s", kinds[k].name, file.count, found ? found : "no scene");
            free(found);
            assert_null(find("a.txt", &file, file.count));
            for (size_t count = 0; !lengthy && count < file.count; count++) {
                found = find(kinds[k].name, &file, count);
                const char *code = found ? strrchr(found, '\\') : NULL; /* one that is cut off */
                if (found && strncmp(found, scene, code && strlen(code) < 4 ? (size_t)(code - found) : strlen(found)) != 0)
                    fail_msg("%s, %zu of %zu bytes: %s", kinds[k].name, count, file.count, found);
                free(found);
            }
        }
    }
}

/* Files that end early: no scene is put there, or it is found again. */
static void nothing_is_lost_in_files_cut_off(void **)
{
    static struct bytes whole, file;
    static const char text[] = BEAD_ORIGIN_HEAD "chain: {}\n";
    size_t refused = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        whole.count = 0;
        if (kinds[k].begin && strcmp(kinds[k].name, "a.avif") != 0) /* whose boxes are not read before one is added */
            kinds[k].begin(&whole);
        for (size_t count = 1; count < whole.count; count++) {
            struct bead_message msg = {""};
            memcpy(file.at, whole.at, count);
            file.count = count;
            if (try_to_put(&file, kinds[k].name, text, &msg)) {
                refused++;
                continue;
            }
            char *found = find(kinds[k].name, &file, file.count);
            if (!found || strcmp(found, "chain: {}\n") != 0)
                fail_msg("%s, %zu of %zu bytes: %s", kinds[k].name, count, whole.count, found ? found : "no scene");
            free(found);
        }
    }
    assert_true(refused > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(scenes_are_found_again),
                                       cmocka_unit_test(nothing_is_lost_in_files_cut_off)};
    return cmocka_run_group_tests_name("origin", tests, NULL, NULL);
}
