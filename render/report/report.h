/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports: a run, or a sweep, as one HTML file that needs nothing else. report_run.c (life of the sink), report_data.c (contents of
 * its page), report_sweep.c (both of sweeps), report_write.c (text). The page itself, its style and its program are the files of
 * assets/report. */
#pragma once

#include "beadreel/sink.h"

extern const struct bead_sink_type bead_report_sink;
extern const struct bead_sink_type bead_report_sweep_sink;
