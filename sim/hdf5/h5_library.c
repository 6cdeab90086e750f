/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens HDF5's libraries, once for the process: see h5_private.h. */
#include "sim/hdf5/h5_private.h"

/* HDF5's structures and identifiers change with the number in these names: they must be those of the build. The Makefile gets the
 * names from the linker, and their packages from the packaging system. */
const struct bead_library_info bead_h5_libraries[] = {
    {{BEAD_HDF5_LIBRARY}, "trajectories and files of sweeps (HDF5); impossible without it", BEAD_HDF5_PACKAGES},
    {{BEAD_HDF5_HL_LIBRARY}, "the axes of these; impossible without it", BEAD_HDF5_PACKAGES},
    {{NULL}, NULL, NULL},
};
_Static_assert(sizeof BEAD_HDF5_LIBRARY > 1 && sizeof BEAD_HDF5_HL_LIBRARY > 1, "the linker found no HDF5");

/* Not constant: there is one HDF5 in the process, and it calls the driver of h5_disk.c without a context. */
void *bead_hdf5;
static bool no_exit_handler, stays_in_process;

void bead_h5_no_exit_handler(void)
{
    no_exit_handler = true;
}

void bead_h5_stay_in_process(void)
{
    stays_in_process = true;
}

bool bead_h5_stays_in_process(void)
{
    return stays_in_process;
}

enum bead_error bead_h5_load(struct bead_message *msg)
{
    struct bead_message why;
    if (bead_library_load(bead_h5_libraries, BEAD_LATE, &bead_hdf5, &why))
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "trajectories and files of sweeps need HDF5: %s", why.text);
    if (no_exit_handler)
        H5dont_atexit();
    return BEAD_OK;
}
