/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages: size and look of a still from its output, and writing a drawing as PNG, PDF or SVG with its notes. */
#include "render/encode/page.h"

#include <math.h>

#include "render/draw/looks.h"
#include "render/draw/raster.h"
#include "render/encode/picture_file.h"
#include "sim/chain/system.h"
#include "sim/kinds/output_kinds.h"

/* Limits of cairo and of memory, in pixels. */
static const double largest_side = 32767, largest_area = 3e8;
/* CSS's pixel, for vector files whose size is in pixels. */
static const double screen_dpi = 96;
static const double inch = 0.0254;

bool bead_page_titled(const struct bead_page *page)
{
    const int least = 240; /* px */
    return !page->paper && page->height >= least;
}

enum bead_error bead_page_find(const struct bead_output *output, struct bead_page *page, struct bead_message *msg)
{
    double size[2];
    BEAD_TRY(output->views.axes ? bead_text_check(msg) : BEAD_OK);
    bool vector = bead_output_ends_like(".pdf, .svg, .eps", output->path), length = output->paper.size_is_length;
    for (int i = 0; i < 2; i++)
        size[i] = round(length ? output->paper.size[i] / inch * output->paper.dpi : output->paper.size[i]);
    if (!(size[0] >= 1 && size[1] >= 1 && size[0] <= largest_side && size[1] <= largest_side && size[0] * size[1] <= largest_area))
        return bead_output_wrong(output, msg, "size: is %.0f x %.0f pixels; at most %.0f a side and %.0f million in all", size[0],
                                 size[1], largest_side, largest_area / 1e6);
    bool screen = output->paper.style == BEAD_STYLE_SLIDE || output->paper.style == BEAD_STYLE_MOVIE;
    bool paper = output->paper.style == BEAD_STYLE_PAPER || (length && !screen);
    double dpi = length || paper ? output->paper.dpi : vector ? screen_dpi : 0;
    *page = (struct bead_page){
        (int)size[0], (int)size[1], dpi, paper, vector, length, output->paper.background == BEAD_BACKGROUND_NONE};
    if (page->clear && bead_output_ends_like(".jpg, .jpeg, .avif", output->path))
        return bead_output_wrong(output, msg,
                                 "background: `none` needs a file that can be transparent: .png, .tif, .webp, or vectors");
    return vector ? BEAD_OK : bead_picture_check(output->path, page->width, page->height, page->clear, msg);
}

const char *bead_page_size(const struct bead_page *page, char words[BEAD_SIZE_WORDS])
{
    double unit = page->length && page->dpi > 0 ? page->dpi / (1e3 * inch) : 1;
    snprintf(words, BEAD_SIZE_WORDS, "%.5g x %.5g %s", round(10 * page->width / unit) / 10, round(10 * page->height / unit) / 10,
             page->length ? "mm" : "pixels");
    return words;
}

static void set_look(const struct bead_page *page, const struct bead_paper *asked, struct bead_look *look)
{
    bool automatic = asked->theme == BEAD_THEME_AUTO;
    bool dark = asked->theme == BEAD_THEME_DARK || (automatic && asked->style == BEAD_STYLE_MOVIE);
    if (!page->paper && asked->style == BEAD_STYLE_SLIDE) {
        bead_look_slide(look, page->width, page->height, dark);
        return;
    }
    if (!page->paper) {
        bead_look_screen(look, page->width, page->height, dark);
        return;
    }
    bead_look_paper(look, page->dpi);
    if (dark)
        bead_look_darken(look);
}

void bead_page_look(const struct bead_page *page, const struct bead_paper *asked, struct bead_look *look)
{
    set_look(page, asked, look);
    bead_look_font(look, asked->font);
    look->clear = page->clear;
}

/* Describes the picture in words. */
static const char *subject_of(const struct bead_output *output, const struct bead_scene *scene)
{
    static const char *const plots[BEAD_SHOW_COUNT] = {
        [BEAD_SHOW_SENSORS] = "force of sensors",           [BEAD_SHOW_PEAKS] = "peak force of contacts",
        [BEAD_SHOW_SETUP] = "drawing of the experiment",    [BEAD_SHOW_CONTACT] = "drawing of a contact",
        [BEAD_SHOW_CELL] = "drawing of the cells",          [BEAD_SHOW_MODES] = "energies of modes",
        [BEAD_SHOW_PROFILES] = "profiles at several times", [BEAD_SHOW_BANDS] = "frequency against wave number",
        [BEAD_SHOW_EIGENMODES] = "participation in modes",  [BEAD_SHOW_ENERGY] = "parts of the energy",
        [BEAD_SHOW_SPREADING] = "spreading of the energy"};
    if (scene->sweep_count > 0)
        return "results of a sweep";
    if (output->views.count == 0 && output->curves.show < BEAD_SHOW_COUNT && plots[output->curves.show])
        return plots[output->curves.show];
    return bead_field_info(output->shown.field)->title;
}

void bead_page_notes(const struct bead_page *page, const struct bead_output *output, const struct bead_scene *scene,
                     const char *tale, char description[BEAD_DESCRIPTION], struct bead_picture_notes *notes)
{
    const size_t size = BEAD_DESCRIPTION;
    const char *what = subject_of(output, scene), *equation = scene->chains[0].system->label;
    if (*equation)
        snprintf(description, size, "%s of the equation %s", what, equation);
    else
        snprintf(description, size, "%s in %zu chain%s of beads", what, scene->chain_count, scene->chain_count == 1 ? "" : "s");
    const size_t used = strlen(description);
    if (tale && *tale)
        snprintf(description + used, size - used, ". %s", tale);
    *notes = (struct bead_picture_notes){.size = sizeof *notes,
                                         .dpi = page->dpi,
                                         .title = scene->title,
                                         .description = description,
                                         .software = "beadreel " BEADREEL_VERSION,
                                         .source = scene->text,
                                         .author = scene->author,
                                         .outlines = output->paper.outlines};
}

static enum bead_error write_raster(const struct bead_page *page, const struct bead_drawing *drawing, const char *path,
                                    const struct bead_picture_notes *notes, uint64_t *bytes, struct bead_message *msg)
{
    BEAD_LEFT_TO(bead_frame_free) struct bead_frame frame = {0};
    BEAD_TRY(bead_frame_create(page->width, page->height, &frame, msg));
    frame.alpha = page->clear;
    bead_warnings_watch();
    BEAD_TRY(drawing->raster ? drawing->raster(drawing->context, &frame, msg)
                             : bead_raster_draw(&frame, drawing->draw, drawing->context, msg));
    BEAD_TRY(bead_warnings_check(msg));
    return bead_picture_write(path, &frame, notes, bytes, msg);
}

enum bead_error bead_page_write(const struct bead_page *page, const struct bead_output *output, const struct bead_scene *scene,
                                const struct bead_drawing *drawing, const char *path, uint64_t *bytes, struct bead_message *msg)
{
    struct bead_picture_notes notes;
    char description[BEAD_DESCRIPTION];
    bead_page_notes(page, output, scene, drawing->tale, description, &notes);
    return page->vector ? bead_vector_write(path, page->width, page->height, drawing->draw, drawing->context, &notes, bytes, msg)
                        : write_raster(page, drawing, path, &notes, bytes, msg);
}
