/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures: the same pixels whole or in parts, PNG and PDF with exactly the drawing. */
#include <glib.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "render/draw/looks.h"
#include "render/draw/picture.h"
#include "render/encode/page.h"
#include "render/figure/still.h"
#include "render/view/area.h"
#include "render/view/views.h"
#include "tests/missing.h"
#include "tests/pictures.h"

/* ---- the view in movies ---- */

static uint64_t play(const struct built *built, bool down, bool dirty, double until)
{
    struct bead_look look;
    struct bead_colormap map;
    struct bead_view *view;
    struct bead_frame frame, background;
    const struct bead_view_type *type = bead_view_find(BEAD_VIEW_SPACETIME);
    assert_int_equal(bead_colormap_load("inferno", &map, NULL), BEAD_OK);
    bead_look_screen(&look, 300, 200, true);
    struct bead_view_setup setup = {.chain = built->chain,
                                    .beads = {0, 9},
                                    .time = {0, 1e-3},
                                    .look = &look,
                                    .orientation = down ? BEAD_TIME_DOWN : BEAD_TIME_RIGHT,
                                    .fill = true};
    setup.colours = (struct bead_colours){&map, BEAD_SCALE_SQRT, 0, 30, 0};
    assert_int_equal(type->create(&setup, &view, NULL), BEAD_OK);
    assert_int_equal(type->place(view, (struct bead_rect){40, 20, 201, 111}, NULL, NULL), BEAD_OK);
    assert_int_equal(bead_frame_create(300, 200, &frame, NULL), BEAD_OK);
    assert_int_equal(bead_frame_create(300, 200, &background, NULL), BEAD_OK);
    memset(background.pixels, 77, background.stride * 200);
    memcpy(frame.pixels, background.pixels, frame.stride * 200);
    for (int i = 0; i <= 1000; i++) {
        struct bead_sample *sample = make_sample(built, i * 1e-6);
        struct bead_changes changes = {0};
        assert_int_equal(type->feed(view, sample, NULL), BEAD_OK);
        free_sample(sample);
        bool last = i * 1e-6 >= until - 1e-9;
        if (last || (dirty && i % 7 == 0))
            assert_int_equal(type->draw(view, i * 1e-6, &frame, &background, &changes, NULL), BEAD_OK);
        for (size_t c = 0; c < changes.count; c++) {
            struct bead_rect r = changes.rect[c];
            assert_true(r.x >= 40 && r.y >= 20 && r.x + r.width <= 241 && r.y + r.height <= 131);
        }
        if (last)
            break;
    }
    uint64_t hash = bead_frame_hash(&frame);
    bead_frame_free(&frame);
    bead_frame_free(&background);
    type->destroy(view);
    return hash;
}

static void test_filling_in_parts_gives_the_same_pixels(void **state)
{
    (void)state;
    struct built built = build_chain("");
    for (int down = 0; down < 2; down++) {
        assert_int_equal(play(&built, down, true, 1e-3), play(&built, down, false, 1e-3));
        assert_int_equal(play(&built, down, true, 0.333e-3), play(&built, down, false, 0.333e-3));
        assert_int_not_equal(play(&built, down, true, 0.333e-3), play(&built, down, true, 0.5e-3));
    }
    release_chain(&built);
}

/* ---- PNG ---- */

static void fill_frame(struct bead_frame *frame, uint32_t colours)
{
    uint32_t x = 12345;
    for (int row = 0; row < frame->height; row++) {
        for (int col = 0; col < frame->width; col++) {
            x = x * 1664525u + 1013904223u;
            uint32_t colour = (x >> 8) % colours * 2654435761u >> 8;
            uint8_t *pixel = frame->pixels + (size_t)row * frame->stride + 4 * (size_t)col;
            pixel[0] = (uint8_t)colour;
            pixel[1] = (uint8_t)(colour >> 8);
            pixel[2] = (uint8_t)(colour >> 16);
            pixel[3] = (uint8_t)x; /* not part of the picture */
        }
    }
}

static void assert_round_trip(uint32_t colours, int colour_type)
{
    char path[512];
    struct bead_frame frame;
    struct bead_picture_notes notes = {.size = sizeof notes,
                                       .dpi = 600,
                                       .title = "Füße <1 & 2>",
                                       .description = "what it is",
                                       .software = "beadreel",
                                       .source = "a: 1\n"};
    uint64_t bytes = 0;
    in_directory("frame.png", path, sizeof path);
    assert_int_equal(bead_frame_create(173, 91, &frame, NULL), BEAD_OK);
    fill_frame(&frame, colours);
    assert_int_equal(bead_png_write(path, &frame, &notes, &bytes, NULL), BEAD_OK);
    struct png_file png = read_png(path);
    assert_int_equal(png.width, 173);
    assert_int_equal(png.height, 91);
    assert_int_equal(png.colour_type, colour_type);
    assert_int_equal(png.per_metre, 23622); /* 600 dpi */
    assert_string_equal(png.title, notes.title);
    assert_string_equal(png.source, notes.source);
    assert_true(png.srgb);
    for (int y = 0; y < 91; y++) {
        for (int x = 0; x < 173; x++) {
            const uint8_t *had = frame.pixels + (size_t)y * frame.stride + 4 * (size_t)x, *got = png.rgb + 3 * (y * 173 + x);
            assert_true(had[0] == got[2] && had[1] == got[1] && had[2] == got[0]);
        }
    }
    free(png.rgb);
    bead_frame_free(&frame);
    assert_true(bytes > 0);
    assert_no_part_files();
}

static void test_png_holds_the_frame(void **state)
{
    (void)state;
    assert_round_trip(1, PNG_COLOR_TYPE_PALETTE);
    assert_round_trip(256, PNG_COLOR_TYPE_PALETTE);
    assert_round_trip(257, PNG_COLOR_TYPE_RGB);
    assert_round_trip(100000, PNG_COLOR_TYPE_RGB);
}

static void test_png_errors(void **state)
{
    (void)state;
    struct bead_frame frame;
    struct bead_message msg = {""};
    assert_int_equal(bead_frame_create(5, 5, &frame, NULL), BEAD_OK);
    assert_int_equal(bead_png_write("/nonexistent/x.png", &frame, NULL, NULL, &msg), BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "/nonexistent/x.png"));
    bead_frame_free(&frame);
    assert_int_equal(bead_frame_create(0, 5, &frame, &msg), BEAD_ERROR_UNSUPPORTED);
    assert_int_equal(bead_frame_create(40000, 5, &frame, &msg), BEAD_ERROR_UNSUPPORTED);
}

/* ---- sinks ---- */

/* 10 beads, the pulse at bead j in a tenth of the time from j tenths on: colours of a picture of 40 x 20 or 20 x 40 pixels. */
static void check_bare_pixels(const char *orientation, bool down, bool upside)
{
    char path[512], output[160];
    snprintf(output, sizeof output, "image: bare.png, axes: false, size: %s, range: [0, 10 N], scale: linear%s",
             down ? "[20, 40]" : "[40, 20]", orientation);
    struct built built = build_chain(output);
    draw_output(&built, pulse_down_the_chain);
    in_directory("bare.png", path, sizeof path);
    struct png_file png = read_png(path);
    const int width = down ? 20 : 40;
    assert_true(png.width == width && png.height == 60 - width && png.colour_type == PNG_COLOR_TYPE_PALETTE);
    struct bead_colormap map;
    assert_int_equal(bead_colormap_load("ember", &map, NULL), BEAD_OK);
    /* 2 pixels a bead, 4 of time a bead. */
    for (int place = 0; place < 20; place++) {
        for (int time = 0; time < 40; time++) {
            const int bead = place / 2, y = down ? time : upside ? 19 - place : place, x = down ? place : time;
            bool edge = time % 4 == 0 || time % 4 == 3; /* the pulse rises and falls there */
            if (!edge || time / 4 != bead)
                assert_memory_equal(png.rgb + 3 * (y * width + x), map.rgb[time / 4 == bead ? 255 : 0], 3);
        }
    }
    free(png.rgb);
    release_chain(&built);
}

static void test_bare_pixels_lie_as_imagesc(void **state)
{
    (void)state;
    check_bare_pixels("", false, false);
    check_bare_pixels(", orientation: matrix", false, false);
}

static void test_bare_pixels_turn(void **state)
{
    (void)state;
    check_bare_pixels(", orientation: time-right", false, true);
    check_bare_pixels(", orientation: time-down", true, false);
}

static void test_needs_are_no_more_than_shown(void **state)
{
    (void)state;
    struct built built = build_chain("image: part.png, beads: [2, 6], time: [0.1 ms, 0.5 ms]");
    struct bead_run_context context = make_stage(&built);
    struct bead_sink *sink;
    struct bead_needs needs;
    assert_int_equal(bead_image_sink.create(&built.scene->outputs[0], &context, &sink, NULL), BEAD_OK);
    bead_image_sink.needs(sink, &needs);
    assert_int_equal(needs.fields, BEAD_FIELD_BIT(BEAD_FIELD_FORCE));
    assert_true(needs.beads.first == 2 && needs.beads.last == 6);
    assert_true(needs.until == 0.5e-3 && needs.grid.start == 0.1e-3 && needs.grid.end == 0.5e-3 && !needs.range);
    assert_true(needs.grid.every > 0 && needs.grid.every <= context.resolution);
    bead_image_sink.destroy(sink);
    context.native = (struct bead_grid){.every = 7e-6, .end = 1e-3}; /* those of a file: from the one before to the one behind */
    assert_int_equal(bead_image_sink.create(&built.scene->outputs[0], &context, &sink, NULL), BEAD_OK);
    bead_image_sink.needs(sink, &needs);
    assert_true(needs.grid.every == 7e-6 && fabs(needs.grid.start - 98e-6) < 1e-12 && fabs(needs.grid.end - 504e-6) < 1e-12);
    bead_image_sink.destroy(sink);
    release_chain(&built);
}

/* Where some other chain of the scene has sensors, the scene cannot know. */
static void test_sensors_view_without_sensors_is_refused(void **state)
{
    (void)state;
    struct built built = build_chain("");
    struct bead_look look;
    struct bead_view *view;
    struct bead_message msg = {""};
    bead_look_screen(&look, 300, 200, false);
    struct bead_view_setup setup = {.chain = built.chain, .beads = {0, 9}, .time = {0, 1e-3}, .look = &look};
    assert_int_equal(bead_view_find(BEAD_VIEW_SENSORS)->create(&setup, &view, &msg), BEAD_ERROR_SCENE);
    assert_null(view);
    assert_non_null(strstr(msg.text, "sensor: first"));
    release_chain(&built);
}

/* Is `small` somewhere in `large`? */
static bool contains(const struct png_file *large, const struct png_file *small)
{
    for (int top = 0; top + small->height <= large->height; top++) {
        for (int left = 0; left + small->width <= large->width; left++) {
            int y = 0;
            while (y < small->height && memcmp(large->rgb + 3 * ((top + y) * large->width + left),
                                               small->rgb + 3 * y * small->width, 3 * (size_t)small->width) == 0)
                y++;
            if (y == small->height)
                return true;
        }
    }
    return false;
}

static void test_pdf_raster_is_the_png_s(void **state)
{
    (void)state;
    char path[512], pdf[512], command[1200], raster[512];
    if (!has_program("pdfimages"))
        skip_without("pdfimages (poppler-utils)");
    struct built built = build_chain("image: f.png, size: [86 mm, 60 mm], dpi: 150");
    draw_output(&built, pulse_down_the_chain);
    release_chain(&built);
    built = build_chain("image: f.pdf, size: [86 mm, 60 mm], dpi: 150");
    draw_output(&built, pulse_down_the_chain);
    release_chain(&built);
    in_directory("f.png", path, sizeof path);
    in_directory("f.pdf", pdf, sizeof pdf);
    in_directory("f-000.png", raster, sizeof raster);
    snprintf(command, sizeof command, "pdfimages -png %s %.*s", pdf, (int)(strlen(pdf) - 4), pdf);
    assert_int_equal(system(command), 0);
    struct png_file whole = read_png(path), part = read_png(raster);
    assert_true(part.width > 200 && part.height > 150);
    assert_true(contains(&whole, &part));
    free(whole.rgb);
    free(part.rgb);
}

/* The longest run of pixels darker than paper in a row or column, to which the frame around an image belongs. */
static int longest_line(const struct png_file *png, bool column, int index)
{
    int longest = 0, run = 0;
    for (int i = 0; i < (column ? png->height : png->width); i++) {
        const uint8_t *pixel = png->rgb + 3 * (column ? i * png->width + index : index * png->width + i);
        run = pixel[1] < 225 ? run + 1 : 0;
        longest = run > longest ? run : longest;
    }
    return longest;
}

/* At a screen's 100 dpi, poppler paints images over whole pixels: the frame must be above them on all four sides. The image is
 * white except for the pulse. */
static void test_pdf_frames_are_seen_on_screens(void **state)
{
    (void)state;
    char pdf[512], raster[512], command[1200];
    if (!has_program("pdftoppm"))
        skip_without("pdftoppm (poppler-utils)");
    for (int size = 50; size < 60; size++) { /* the frame at other parts of a pixel */
        char output[160];
        snprintf(output, sizeof output, "image: s.pdf, style: paper, size: [86 mm, %d mm], dpi: 300", size);
        struct built built = build_chain(output);
        draw_output(&built, pulse_down_the_chain);
        release_chain(&built);
        in_directory("s.pdf", pdf, sizeof pdf);
        in_directory("s.png", raster, sizeof raster);
        snprintf(command, sizeof command, "pdftoppm -r 100 -png -singlefile %s %.*s", pdf, (int)(strlen(pdf) - 4), pdf);
        assert_int_equal(system(command), 0);
        struct png_file png = read_png(raster);
        int sides[2] = {0, 0}, last[2] = {-9, -9};
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < (k ? png.width : png.height); i++) {
                if (longest_line(&png, k, i) < 0.5 * (k ? png.height : png.width))
                    continue;
                sides[k] += i > last[k] + 2;
                last[k] = i;
            }
        }
        if (sides[0] != 2 || sides[1] < 2)
            fail_msg("%d mm: %d lines across and %d upright", size, sides[0], sides[1]);
        free(png.rgb);
    }
}

/* A screen reader finds a figure, and its text, which is that of the document's information. */
static void test_pdf_is_tagged(void **state)
{
    (void)state;
    static const char *const outputs[] = {"image: t.pdf", "image: t.pdf, axes: false",
                                          "image: t.pdf, background: none, style: paper"};
    char pdf[512], command[1200];
    if (!has_program("pdfinfo"))
        skip_without("pdfinfo (poppler-utils)");
    in_directory("t.pdf", pdf, sizeof pdf);
    for (size_t i = 0; i < sizeof outputs / sizeof outputs[0]; i++) {
        size_t length;
        struct built built = build_chain(outputs[i]);
        draw_output(&built, pulse_down_the_chain);
        release_chain(&built);
        char *bytes = read_all(pdf, &length);
        const char *subject = memmem(bytes, length, "/Subject ", 9), *text = memmem(bytes, length, "/Alt ", 5);
        assert_true(subject && text);
        const size_t words = strcspn(subject + 9, "\n");
        assert_true(words > 100);
        assert_memory_equal(subject + 9, text + 5, words + 1);
        free(bytes);
        snprintf(command, sizeof command, "pdfinfo -struct %s 2>&1 | tr -d ' \\n' | grep -qx DocumentFigure", pdf);
        assert_int_equal(system(command), 0); /* without a warning */
    }
}

static void assert_same_twice(const char *name, const char *output)
{
    char *text[2], path[512];
    size_t length[2];
    in_directory(name, path, sizeof path);
    for (int i = 0; i < 2; i++) {
        struct built built = build_chain(output);
        draw_output(&built, pulse_down_the_chain);
        release_chain(&built);
        text[i] = read_all(path, &length[i]);
    }
    assert_int_equal(length[0], length[1]);
    assert_memory_equal(text[0], text[1], length[0]);
    free(text[0]);
    free(text[1]);
}

static void test_same_picture_same_bytes(void **state)
{
    (void)state;
    assert_same_twice("s.png", "image: s.png, size: [320, 200]");
    assert_same_twice("s.pdf", "image: s.pdf");
    assert_same_twice("s.svg", "image: s.svg");
}

/* No two parts of an SVG file have the same name, and what is referred to is there. */
/* Each tag is closed before the next one begins. */
static void assert_tags(const char *svg)
{
    bool open = false;
    for (; *svg; svg++) {
        assert_true(*svg != (open ? '<' : '>'));
        open = *svg == '<' || (open && *svg != '>');
    }
}

static void assert_names(const char *svg)
{
    char name[64], used[80];
    size_t names = 0;
    for (const char *at = svg; (at = strstr(at, " id=\"")) != NULL; names++) {
        at += strlen(" id=\"");
        snprintf(name, sizeof name, " id=\"%.*s\"", (int)strcspn(at, "\""), at);
        assert_null(strstr(at, name));
    }
    for (const char *at = svg; (at = strchr(at, '#')) != NULL; at++) {
        if (strncmp(at - 6, "href=\"", 6) != 0 && strncmp(at - 4, "url(", 4) != 0)
            continue;
        snprintf(used, sizeof used, " id=\"%.*s\"", (int)strcspn(at + 1, "\")"), at + 1);
        assert_non_null(strstr(svg, used));
    }
    assert_true(names > 1);
}

/* Runs of a text follow each other; those below or above its line have a smaller size. */
static void assert_runs_follow(const char *text)
{
    const char *end = strstr(text, "</text>");
    double last = NAN, line = NAN, most = 0;
    for (const char *run = text; (run = strstr(run, "<tspan ")) != NULL && run < end; run++) {
        double x, y, width, size;
        assert_int_equal(sscanf(run, "<tspan x=\"%lf\" y=\"%lf\" textLength=\"%lf\"", &x, &y, &width), 3);
        assert_int_equal(sscanf(strstr(run, "font-size="), "font-size=\"%lf\"", &size), 1);
        assert_true(width >= 0 && (isnan(last) || fabs(x - last) < 0.02 * size));
        line = isnan(line) ? y : line;
        assert_true(y == line ? size >= most : size < most);
        most = fmax(most, size);
        last = x + width;
    }
    assert_true(last > 0);
}

/* Letters of an SVG file are text in named fonts, after the drawing; or outlines, if requested. It has a title and a
 * description. */
static void test_svg_keeps_letters(void **state)
{
    (void)state;
    static const char *const outputs[] = {"image: t.svg, caption: \"<b>B</b>, *F*_{max} < 2 & more<u>U</u><s>S</s>\"",
                                          "image: t.svg, outlines: true"};
    char path[512];
    in_directory("t.svg", path, sizeof path);
    for (int outlines = 0; outlines < 2; outlines++) {
        size_t length;
        struct built built = build_chain(outputs[outlines]);
        draw_output(&built, pulse_down_the_chain);
        release_chain(&built);
        char *svg = read_all(path, &length);
        assert_non_null(strstr(svg, "<desc>bead force in 1 chain of beads. In Ten one pulse of 10\u00a0N, "));
        assert_int_equal(strstr(svg, ">bead force (N)</tspan>") != NULL, !outlines);
        assert_int_equal(strstr(svg, "font-family=\"'STIX'") != NULL, !outlines);
        assert_int_equal(strstr(svg, "<text ") != NULL, !outlines);
        assert_int_equal(strstr(svg, "<use xlink:href=\"#glyph") != NULL, outlines);
        if (!outlines) {
            assert_non_null(strstr(svg, "&lt; 2 &amp; more</tspan>"));
            assert_non_null(strstr(svg, " font-weight=\"bold\">B</tspan>"));
            assert_non_null(strstr(svg, " font-style=\"italic\">F</tspan>"));
            assert_non_null(strstr(svg, " text-decoration=\"underline\">U</tspan>"));
            for (const char *text = svg; (text = strstr(text, "<text ")) != NULL; text++)
                assert_runs_follow(text);
            assert_non_null(strstr(svg, " text-decoration=\"line-through\">S</tspan>"));
            assert_true(strstr(svg, "<text ") > strstr(svg, "<image"));
            for (const char *run = svg; (run = strstr(run, "<tspan ")) != NULL; run++) /* of one colour, that of its text */
                assert_true(strstr(run, " fill=") == NULL || strstr(run, " fill=") > strchr(run, '>'));
        }
        assert_string_equal(svg + length - 7, "</svg>\n");
        assert_names(svg);
        assert_tags(svg);
        free(svg);
    }
    size_t length;
    struct built built = build_chain("image: t.svg, panels: [[{field: force}, {field: velocity}]]"); /* two images */
    draw_output(&built, pulse_down_the_chain);
    release_chain(&built);
    char *svg = read_all(path, &length);
    assert_names(svg);
    free(svg);
}

/* Nothing is drawn over the border, at any size: the outermost pixels are background. */
static void test_nothing_is_cut(void **state)
{
    (void)state;
    static const char *const sizes[] = {"[300, 200]", "[640, 360]", "[200, 600]", "[1300, 260]", "[86 mm, 60 mm], dpi: 200"};
    static const char *const views[] = {"[spacetime]", "[profile]", "[profile, spacetime]"};
    char path[512], output[256];
    in_directory("cut.png", path, sizeof path);
    for (size_t s = 0; s < 5; s++) {
        for (size_t v = 0; v < 3; v++) {
            snprintf(output, sizeof output, "image: cut.png, size: %s, views: %s, field: %s", sizes[s], views[v],
                     v ? "force" : "velocity");
            struct built built = build_chain(output);
            draw_output(&built, pulse_down_the_chain);
            struct png_file png = read_png(path);
            assert_border_white(&png, output);
            free(png.rgb);
            release_chain(&built);
        }
    }
}

/* Beads alone, without axes: striker, its arrow and the wall are on the picture. */
static void test_bare_beads_are_whole(void **state)
{
    (void)state;
    char path[512];
    in_directory("b.png", path, sizeof path);
    struct built built = build_chain("image: b.png, views: [beads], axes: false, size: [640, 160], at: 0.3 ms");
    draw_output(&built, pulse_down_the_chain);
    release_chain(&built);
    struct png_file png = read_png(path);
    assert_border_white(&png, "bare beads");
    free(png.rgb);
}

static enum bead_error draw_warning(void *context, cairo_t *, struct bead_message *)
{
    if (*(const bool *)context)
        g_log("made up", G_LOG_LEVEL_WARNING, "for a test");
    return BEAD_OK;
}

/* What the libraries warn of is an error of the picture that they warn of, and of no other, in each kind of file. */
static void test_warnings_are_errors(void **state)
{
    (void)state;
    struct built built = build_chain("image: a.png");
    for (int k = 0; k < 4; k++) {
        bool warns = k % 2 == 0;
        const bool vector = k >= 2;
        const struct bead_page page = {.width = 20, .height = 20, .dpi = 72, .vector = vector};
        const struct bead_drawing drawing = {.draw = draw_warning, .context = &warns};
        struct bead_message msg = {""};
        char path[512];
        uint64_t bytes;
        in_directory(vector ? "w.svg" : "w.png", path, sizeof path);
        const enum bead_error err = bead_page_write(&page, &built.scene->outputs[0], built.scene, &drawing, path, &bytes, &msg);
        assert_int_equal(err, warns ? BEAD_ERROR_GRAPHICS : BEAD_OK);
        assert_int_equal(strcmp(msg.text, "a picture was not drawn correctly: made up: for a test") == 0, warns);
    }
    release_chain(&built);
    assert_no_part_files();
}

static enum bead_error draw_or_fail(void *context, cairo_t *cr, struct bead_message *msg)
{
    cairo_rectangle(cr, 1, 2, 3, 4);
    cairo_fill(cr);
    return *(bool *)context ? BEAD_OK : bead_fail(msg, BEAD_ERROR_USAGE, "made up");
}

/* A file is whole, or not there. Its end says what it is, in any letters. */
static void test_vector_files_are_whole(void **state)
{
    (void)state;
    static const struct {
        const char *name, *begins;
        double dpi;
    } files[] = {{"v.pdf", "%PDF-1.4", 72}, {"v.SVG", "<?xml", 72}, {"v.Eps", "%!PS-Adobe-3.0 EPSF", 72},
                 {"v", NULL, 72},           {"v.doc", NULL, 72},    {"v.pdf", NULL, 0},
                 {"v.pdf", NULL, -1},       {"v.pd", NULL, 72}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        for (int good = 0; good < 2; good++) {
            const struct bead_picture_notes notes = {.size = sizeof notes, .dpi = files[i].dpi};
            struct bead_message msg = {""};
            bool draws = good;
            char path[512], text[64] = "";
            uint64_t bytes = 0;
            in_directory(files[i].name, path, sizeof path);
            const enum bead_error err = bead_vector_write(path, 40, 30, draw_or_fail, &draws, &notes, &bytes, &msg);
            FILE *file = fopen(path, "r");
            assert_int_equal(err, !files[i].begins ? BEAD_ERROR_UNSUPPORTED : good ? BEAD_OK : BEAD_ERROR_USAGE);
            assert_true((file != NULL) == !err && (bytes > 0) == !err);
            if (!file)
                continue;
            assert_true(fread(text, 1, sizeof text - 1, file) > 0 && strncmp(text, files[i].begins, strlen(files[i].begins)) == 0);
            assert_int_equal(fseek(file, 0, SEEK_END), 0);
            assert_int_equal(ftell(file), bytes);
            fclose(file);
            unlink(path);
        }
    }
    assert_no_part_files();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_filling_in_parts_gives_the_same_pixels),
        cmocka_unit_test(test_png_holds_the_frame),
        cmocka_unit_test(test_png_errors),
        cmocka_unit_test(test_bare_pixels_lie_as_imagesc),
        cmocka_unit_test(test_bare_pixels_turn),
        cmocka_unit_test(test_needs_are_no_more_than_shown),
        cmocka_unit_test(test_sensors_view_without_sensors_is_refused),
        cmocka_unit_test(test_pdf_raster_is_the_png_s),
        cmocka_unit_test(test_pdf_frames_are_seen_on_screens),
        cmocka_unit_test(test_pdf_is_tagged),
        cmocka_unit_test(test_bare_beads_are_whole),
        cmocka_unit_test(test_same_picture_same_bytes),
        cmocka_unit_test(test_svg_keeps_letters),
        cmocka_unit_test(test_nothing_is_cut),
        cmocka_unit_test(test_warnings_are_errors),
        cmocka_unit_test(test_vector_files_are_whole),
    };
    return cmocka_run_group_tests_name("pictures", tests, make_directory, remove_directory);
}
