/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Method choice: the method that a scene names or that `auto` picks, its step, and the reason. */
#pragma once

#include <stdbool.h>

#include "beadreel/error.h"

struct bead_chain;
struct bead_method;
struct bead_simulate;

struct bead_method_choice {
    const struct bead_method *method;
    double theta, order, cap; /* theta for peaks to 1e-6; proportional to accuracy^(1/order), up to the cap */
    double share;             /* of the requested accuracy, for which steps are chosen */
    const char *why;          /* reason, for the plan; "as asked" if the scene names the method */
};

/* Errors: SCENE, with the method's name. */
BEAD_CHECK enum bead_error bead_choose_method(const struct bead_chain *chain, const struct bead_simulate *asked,
                                              struct bead_method_choice *choice, struct bead_message *msg);
/* True for chains so long that steps no longer become shorter with their length: errors may be larger than asked. */
bool bead_is_long(const struct bead_chain *chain);
/* Step in units of 1/omega for peaks of this relative accuracy. */
double bead_method_theta(const struct bead_method_choice *choice, double accuracy);
/* Expected relative error of peaks with steps of theta/omega: the inverse of bead_method_theta, at most 1. */
double bead_method_error(const struct bead_method_choice *choice, double theta);
