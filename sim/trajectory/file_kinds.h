/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind and format that a sweep's file states: here, because opening a trajectory must recognise it, too. */
#pragma once

#define BEAD_SWEEP_KIND "beadreel-sweep"
enum { BEAD_SWEEP_FORMAT = 2 };
