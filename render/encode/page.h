/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages: size and look of a still, from its output's settings and file name. */
#pragma once

#include <stdbool.h>

#include "beadreel/scene.h"
#include "render/draw/axis.h"
#include "render/draw/picture.h"

struct bead_page {
    int width, height;          /* px */
    double dpi;                 /* of these pixels; 0: unknown */
    bool paper, vector, length; /* length: the scene gives its size in mm, not px */
    bool clear;                 /* no background is painted */
};

/* Does the page show the scene's title? Papers have captions instead, low pictures no room. */
bool bead_page_titled(const struct bead_page *page);
/* Errors: SCENE (with the output's place), UNSUPPORTED (no encoder for files with this name). */
BEAD_CHECK enum bead_error bead_page_find(const struct bead_output *output, struct bead_page *page, struct bead_message *msg);
enum { BEAD_SIZE_WORDS = 64 };
/* The size of a picture as given in the scene, for messages: "86 x 64 mm", "1920 x 1080 pixels". Returns `words`. */
const char *bead_page_size(const struct bead_page *page, char words[BEAD_SIZE_WORDS]);
void bead_page_look(const struct bead_page *page, const struct bead_paper *asked, struct bead_look *look);
enum { BEAD_DESCRIPTION = 2048 };
/* Metadata of a picture file. The description of what it shows and what happens there (`tale`; NULL: unknown) must live as long as
 * the notes. */
void bead_page_notes(const struct bead_page *page, const struct bead_output *output, const struct bead_scene *scene,
                     const char *tale, char description[BEAD_DESCRIPTION], struct bead_picture_notes *notes);
/* Functions that draw a page into vector files and into frames (NULL: like vector files). */
struct bead_drawing {
    bead_draw draw;
    enum bead_error (*raster)(void *context, struct bead_frame *frame, struct bead_message *msg);
    void *context;
    const char *tale; /* for the notes */
};
/* Draws the page and writes it in the format of its name. Errors: those of the drawing, GRAPHICS, IO, MEMORY. */
BEAD_CHECK enum bead_error bead_page_write(const struct bead_page *page, const struct bead_output *output,
                                           const struct bead_scene *scene, const struct bead_drawing *drawing, const char *path,
                                           uint64_t *bytes, struct bead_message *msg);
