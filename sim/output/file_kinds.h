/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind and format that a sweep's file states; here, because opening a trajectory must recognise it. */
#ifndef BEADREEL_SIM_OUTPUT_FILE_KINDS_H
#define BEADREEL_SIM_OUTPUT_FILE_KINDS_H

#define BEAD_SWEEP_KIND "beadreel-sweep"
enum { BEAD_SWEEP_FORMAT = 2 };

#endif
