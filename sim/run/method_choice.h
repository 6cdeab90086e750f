/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The choice of a method: the one that a scene names or that `auto` picks, its step, and the reason. */
#ifndef BEADREEL_SIM_RUN_METHOD_CHOICE_H
#define BEADREEL_SIM_RUN_METHOD_CHOICE_H

#include "beadreel/error.h"

struct bead_chain;
struct bead_method;
struct bead_simulate;

struct bead_method_choice {
    const struct bead_method *method;
    double theta, order, cap; /* theta for peaks to 1e-6, for others it goes with accuracy^(1/order), up to the cap */
    double share;             /* of the accuracy asked, that steps are made for */
    const char *why;          /* in words, for the plan; "as asked" where the scene names the method */
};

/* Errors: SCENE, with the method's name. */
BEAD_CHECK enum bead_error bead_choose_method(const struct bead_chain *chain, const struct bead_simulate *asked,
                                              struct bead_method_choice *choice, struct bead_message *msg);
/* Step in units of 1/omega for peaks as accurate as that. */
double bead_method_theta(const struct bead_method_choice *choice, double accuracy);

/* The relative error of peaks to expect of steps of theta/omega: the inverse of that, at most 1. */
double bead_method_error(const struct bead_method_choice *choice, double theta);

#endif
