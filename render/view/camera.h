/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Camera: which piece of a chain is shown while the front runs through it.
 *
 * * The window has a constant length. It rests at the start of the chain until the front is well inside, moves with the front at
 * the front's own speed, and comes to rest at the end of the chain. It never moves back. Every chain has its own camera. */
#ifndef BEADREEL_RENDER_VIEW_CAMERA_H
#define BEADREEL_RENDER_VIEW_CAMERA_H

#include <stdbool.h>

#include "beadreel/chain.h"
#include "beadreel/sample.h"

/* ---- what follows a front ---- */

/* The length of chain that the wave has reached, in beads from the first. `load`: compression of each contact, in units of a strong
 * one; the largest so far counts, up to where the contact counts as reached. `reached` keeps the largest loads; [count], zeroed
 * before the first call. */
double bead_front_find(double *reached, const double *load, size_t count);

/* A low pass of third order that does not lag behind what moves at constant speed. */
struct bead_follower {
    double context[3], time;
    double constant; /* s */
    bool begun;
};
/* `width` of a window, `length` of the chain in the same unit, `beads` in it; `span`: s that the whole picture lasts. */
struct bead_follower bead_follower_make(double width, double length, size_t beads, double span);
double bead_follower_advance(struct bead_follower *follower, double target, double time);

/* The left edge of a window of that width between `low` and `high` (of the left edge) where the front is at `front`, all m: starts
 * and stops softly. */
double bead_window_left(double front, double width, double low, double high);

/* ---- a chain's camera ---- */

struct bead_camera;

/* `beads` of the chain are what there is to show, in a window of `width` m; `time`: first and last of the picture, s.
 * Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_camera_create(const struct bead_chain *chain, struct bead_span beads, double width,
                                              const double time[2], struct bead_camera **camera, struct bead_message *msg);
void bead_camera_destroy(struct bead_camera *camera);
/* Samples of the chain, with displacements. Errors: UNSUPPORTED. */
BEAD_CHECK enum bead_error bead_camera_feed(struct bead_camera *camera, const struct bead_sample *sample, struct bead_message *msg);
/* Once a frame, times rising. */
void bead_camera_advance(struct bead_camera *camera, double time);
/* m along the chain: of the window as of the last advance. */
double bead_camera_left(const struct bead_camera *camera);
double bead_camera_width(const struct bead_camera *camera);
/* Mean distance of beads, m; of the largest radius. */
double bead_chain_spacing(const struct bead_chain *chain, struct bead_span beads, double *radius);

#endif
