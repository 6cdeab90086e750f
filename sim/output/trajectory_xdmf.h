/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The XDMF file beside a trajectory: how ParaView and VTK read its HDF5 file. */
#ifndef BEADREEL_SIM_OUTPUT_TRAJECTORY_XDMF_H
#define BEADREEL_SIM_OUTPUT_TRAJECTORY_XDMF_H

#include "sim/output/trajectory_sink.h"

/* Writes it when the trajectory has all its samples. Errors: MEMORY, IO. */
BEAD_CHECK enum bead_error bead_trajectory_write_xdmf(struct bead_sink *sink, struct bead_message *msg);

#endif
