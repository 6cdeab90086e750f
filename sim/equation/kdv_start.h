/* Starts of the Korteweg-de Vries equation u_t + drift u_x + a u u_x + b u_xxx = 0, and how fine a grid they and what becomes of
 * them need. */
#ifndef BEADREEL_SIM_EQUATION_KDV_START_H
#define BEADREEL_SIM_EQUATION_KDV_START_H

#include <stddef.h>

#include "beadreel/scene.h"

enum { BEAD_KDV_POINTS_MAX = 1 << 20 };

/* u at time 0 and place x of the domain; pulses and solitons with their images in the neighbouring periods. */
double bead_kdv_start(const struct bead_equation_spec *spec, double x);
/* Speed (less the drift) -> amplitude of a soliton: the thesis's Eq. 4. */
double bead_kdv_soliton_amplitude(const struct bead_equation_spec *spec, double speed);
/* 1 / width of the narrowest sech^2 that can appear, and the largest |u|. */
double bead_kdv_sharpest(const struct bead_equation_spec *spec);
double bead_kdv_highest(const struct bead_equation_spec *spec);
/* Grid points for the accuracy. */
size_t bead_kdv_points(const struct bead_equation_spec *spec, double accuracy);

#endif
