/* What a sweep's file says of itself. */
#ifndef BEADREEL_SIM_OUTPUT_FILE_KINDS_H
#define BEADREEL_SIM_OUTPUT_FILE_KINDS_H

#define BEAD_SWEEP_KIND "beadreel-sweep"
enum { BEAD_SWEEP_FORMAT = 2 };

#endif
