/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Camera: the piece of a chain that a picture shows while the front runs through it.
 *
 * The window has a constant length. It rests at the start of the chain until the front is well inside, moves with the front at
 * the front's own speed, and comes to rest at the end of the chain. It never moves back. Every chain has its own camera. */
#pragma once

#include <stdbool.h>

#include "beadreel/chain.h"
#include "beadreel/sample.h"

/* ---- following a front ---- */

/* A low pass of third order that does not lag behind constant speed. */
struct bead_follower {
    double context[3], time;
    double constant; /* s */
    bool begun;
};
/* `width` of a window, `length` of the chain in the same unit, `beads` in it; `span`: duration of the whole picture, s. */
struct bead_follower bead_follower_make(double width, double length, size_t beads, double span);
double bead_follower_advance(struct bead_follower *follower, double target, double time);

/* The left edge of a window with the front at `front`, between the edges `low` and `high`, all m: starts and stops softly. */
double bead_window_left(double front, double width, double low, double high);

/* ---- a chain's camera ---- */

struct bead_camera;

/* Shows `beads` of the chain in a window of `width` m; `time`: first and last of the picture, s. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_camera_create(const struct bead_chain *chain, struct bead_span beads, double width,
                                              const double time[2], struct bead_camera **camera, struct bead_message *msg);
void bead_camera_destroy(struct bead_camera *camera);
/* Samples of the chain, with displacements. Errors: UNSUPPORTED. */
BEAD_CHECK enum bead_error bead_camera_feed(struct bead_camera *camera, const struct bead_sample *sample, struct bead_message *msg);
/* Call it for each frame, with rising times. */
void bead_camera_advance(struct bead_camera *camera, double time);
/* m along the chain: left edge of the window at the last advance, and its width. */
double bead_camera_left(const struct bead_camera *camera);
double bead_camera_width(const struct bead_camera *camera);
/* Returns the mean distance of beads, m, and their largest radius. */
double bead_chain_spacing(const struct bead_chain *chain, struct bead_span beads, double *radius);
