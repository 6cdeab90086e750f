/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A field along chains at a few moments: what `show: profiles` plots and lists. For sinks: give them the output and context they
 * were made with, and every sample. */
#pragma once

#include "beadreel/sink.h"
#include "sim/base/internal.h"

struct bead_profile_times;

/* For output->shown.field at output->curves.profile_times. The context is copied; what it points to must outlive the
 * moments. Errors: MEMORY; SCENE where the run ends before the last moment. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_profile_times_create(const struct bead_output *output,
                                                                   const struct bead_run_context *context,
                                                                   struct bead_profile_times **moments, struct bead_message *msg);
BEAD_INTERNAL void bead_profile_times_destroy(struct bead_profile_times *moments);

/* The samples to take them from: at the moments themselves if these have a common spacing, else close enough for straight lines
 * between them. */
BEAD_INTERNAL struct bead_needs bead_profile_times_needs(const struct bead_profile_times *moments);
/* Are the moments sample times? Else profiles are interpolated linearly between two samples. */
bool bead_profile_times_are_samples(const struct bead_profile_times *moments);
/* Errors: UNSUPPORTED if the samples lack the field. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_profile_times_feed(struct bead_profile_times *moments,
                                                                 const struct bead_sample *sample, struct bead_message *msg);

/* Values of a chain (beads, contacts or points), where they are along it, and their values at a moment, SI; borrowed. */
BEAD_INTERNAL size_t bead_profile_times_values(const struct bead_profile_times *moments, size_t chain);
BEAD_INTERNAL const double *bead_profile_times_places(const struct bead_profile_times *moments, size_t chain);
BEAD_INTERNAL const double *bead_profile_times_profile(const struct bead_profile_times *moments, size_t chain, size_t moment);
