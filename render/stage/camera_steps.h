/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Camera of the stage: a window that is still while the wave crosses it, and moves on in steps with eased pans.
 *
 * It follows the head of the wave and, once that has reached the end of the chain, the reflected pulse: the centre of squared loads
 * near its previous place. If waves pass through each other it follows the one that goes its way, and both while they fit into the
 * window. Moving with the front would make beads of two materials alternate several times a second. Places are along the stage,
 * shown in whole pixels. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { BEAD_PAN_FRAMES = 16, BEAD_MOST_PANS = 16 };

struct bead_step_camera {
    double width, step, ends[2]; /* of the window, of a pan; places that the window may show */
    double margin;               /* the head never comes nearer than this to an edge of the window, despite pans */
    double middle;               /* of the window, now */
    double goal;                 /* and after all pans */
    struct bead_pan {
        double by;
        int frame; /* 0..BEAD_PAN_FRAMES */
    } pans[BEAD_MOST_PANS];
    size_t pan_count;
    double head;        /* place of the wave, in contacts from the first */
    size_t front;       /* the foremost contact that the wave has reached */
    double last, speed; /* of the place, per frame */
    bool begun, arrived;
    int way;      /* 1: to the right, -1: back from the end */
    bool meets;   /* another wave comes, or came, to meet it, */
    double other; /* with its middle here, in contacts */
};

/* Loads of contacts (>= 0, 1: strong), and their directions: 1, -1; NULL: unknown. */
struct bead_loads {
    const double *load;
    const signed char *way;
    size_t count;
};

/* The part of a pan that has passed, from 0 to 1: starts and stops with neither speed nor acceleration. */
double bead_pan_eased(double part);
/* The head of the wave, in contacts, now. */
double bead_step_camera_find(struct bead_step_camera *camera, struct bead_loads wave);
/* Advances by a frame, with the wave's head at `place`, and a wave that meets it at `other`. */
void bead_step_camera_advance(struct bead_step_camera *camera, double place, double other);
