/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uncertainty: errors of the peaks of a run, measured by runs of the same chain with other tolerances.
 *
 * Steps are chosen so that errors are proportional to the tolerance. So a run P with the tolerance a, one with a coarser tolerance
 * r a, and one with a finer tolerance q a, give two estimates of the error of each peak: |P_r - P| / (r - 1) and |P - P_q| / (1 -
 * q). Where they are not (a steep law, steps that a drifting energy has shortened), r is the ratio of both runs' energy errors, if
 * that is smaller.
 *
 * The factor of proportionality is not the same in two runs, because contacts open and close elsewhere in their steps. In a chain
 * that is not chaotic that does not matter: its errors are far below the accuracy asked for, as the coarser run alone shows. In a
 * chaotic chain a few unstable motions drive all later peaks: the error of peak i is g_i X, where the growth g_i belongs to the
 * chain, and X, the contribution of the run's own errors to the motion, differs from run to run by more than r. There the coarser
 * run shows how strongly peaks respond, but not this run's contribution: the ratio of two such X has the heavy tail of a Cauchy
 * distribution, so that any bound from it is a hundred times too large for most peaks or too small for some. The finer run shows
 * it, because its own X is smaller by q: P - P_q is the error of P, except for a part of about q. (A tangent driven by the local
 * errors would show the same, but needs steps repeated at half their length, which costs twice the run; and it fails when a chaotic
 * motion is no longer linear.)
 *
 * After the first peak that is lost in this way, the horizon, the motion of any run is one of many that are equally likely. A later
 * maximum of the true motion may then overtake an earlier one that is known well. Both other runs note how high forces are in each
 * part of the run (heights.h), and so how high they are after the horizon and the peak, and how much two such motions differ, at
 * the peak's contact or bead and its neighbours. If there is no finer run, another coarse one takes its place.
 *
 * A maximum is also compared with the same one of the other run, not only with its highest, which may be a different one: the runs
 * may differ by a per cent in each of two bumps, one the higher in the first run, the other in the second, both equally high by
 * chance. If h is the height of a maximum and e the bound of its error, the highest, P, may really be as low as P - e, but no
 * higher than the largest h + e of all. The runs keep their two highest.
 *
 * The finer run's own error is a part of about q only if errors fall with the tolerance. Chaos of light beads may stop at a per
 * cent of the force on heavy ones, for any tolerance. The differences from both runs give the power by which errors fall, and so
 * the finer run's part and the safety factor; if that is too much for the motion that differs most, it is not predictable.
 *
 * Errors of the times of maxima follow from the same differences, relative to the time since the start. If the highest is another
 * maximum in the other run, or may be, the uncertainty of the time is the distance of the two.
 *
 * A peak at which P - P_q happens to cross zero still has an error: at least its response to the coarser run, times the usual ratio
 * of measured errors to responses in this chain. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/sink.h"
#include "sim/base/internal.h"

/* Tolerance of the finer run in units of the run's: q. */
#define BEAD_UNCERTAINTY_FINER 0.01

/* Two other runs show how high later maxima are. */
enum { BEAD_UNCERTAINTY_LATE = 2 };
struct bead_uncertainty_of {
    double accuracy; /* a; 0: the step was given */
    double factor;   /* r: the errors of the coarser run, or its step, in units of the run's */
    double end;      /* s: of the run that ended first; later peaks are not compared. 0: all ended together */
    double apart;    /* s: half the shortest period of the chain; maxima further apart than that are different ones */
};

/* The highest maxima of a run for each contact or bead, and the second highest (bead_peaks_keep_second); NULL: none. */
struct bead_maxima {
    const struct bead_peak *highest, *second;
};

/* The peaks of contacts, or of beads, in order. */
struct bead_uncertain_peaks {
    const struct bead_peak *peaks, *second;
    struct bead_maxima coarse, fine;           /* of the other runs */
    const double *late[BEAD_UNCERTAINTY_LATE]; /* N: heights of other runs after bead_uncertainty_after, 0: none; NULL: no run */
    size_t count;                              /* 0: unknown */
    double *uncertainty, *time_uncertainty;    /* N, s: out */
};

/* True if more than a few peaks of a chain respond so strongly to the coarser run that a finer one is needed, or if there are so
 * few that it costs nothing. */
bool bead_uncertainty_wants_fine(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p);
/* Sets the uncertainties, at least the accuracy asked for, as a part of force or time. Returns the time from which peaks are not
 * predictable, s, when the first one is not known to a tenth of itself; INFINITY: all are. */
double bead_uncertainty_find(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p);
/* The time after which a maximum may overtake peak i: the horizon, or the peak itself if that is later and known as well as asked.
 */
double bead_uncertainty_after(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double from);
/* The reach of later maxima, in standard deviations of their logarithms: hardly any peak that exceeds the other runs' late heights
 * by more is overtaken. */
double bead_uncertainty_reach(const struct bead_uncertain_peaks *p);
/* True if peak i is not predictable: it comes after the horizon and is less accurate than asked, or a maximum after both it and the
 * horizon may be higher. */
bool bead_uncertainty_is_lost(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double from,
                              double reach);
/* The uncertainty of a force, or of any number, from a finer run alone: at least the accuracy asked for, as a part of it; NaN: the
 * finer run lacks the number. */
BEAD_INTERNAL double bead_uncertainty_measured(double accuracy, double force, double finer);
/* True if a number is not known to a tenth of itself. */
bool bead_uncertainty_is_large(double value, double uncertainty);
