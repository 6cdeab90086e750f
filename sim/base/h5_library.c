/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens HDF5's libraries, once for the process: see h5_private.h. */
#include "sim/base/h5_private.h"

#include <pthread.h>
#include <string.h>

/* HDF5's structures and identifiers change with the number in these names: only those that this program was built with will do. The
 * Makefile asks the linker for them, and the packaging system for their packages. */
static const struct bead_library_info libraries[] = {
    {{BEAD_HDF5_LIBRARY}, "trajectories and files of sweeps (HDF5); without it there are none"},
    {{BEAD_HDF5_HL_LIBRARY}, "the axes of these; without it there are none"},
};

const struct bead_library_info *bead_h5_library_info(size_t index)
{
    return index < sizeof libraries / sizeof *libraries ? &libraries[index] : NULL;
}

_Static_assert(sizeof BEAD_HDF5_LIBRARY > 1 && sizeof BEAD_HDF5_HL_LIBRARY > 1, "the linker found no HDF5");

#define NAME(symbol) #symbol,
static const char *const core_names[] = {BEAD_H5_CORE_SYMBOLS(NAME)};
static const char *const scale_names[] = {BEAD_H5_SCALE_SYMBOLS(NAME)};
enum { CORE = sizeof core_names / sizeof *core_names, SCALES = sizeof scale_names / sizeof *scale_names };

/* Not constant, as HDF5 is one for the process, and calls the driver of h5_disk.c without saying for whom; filled once. */
static struct {
    struct bead_h5_symbols symbols;
    bool no_exit_handler;
    enum bead_error error;
    struct bead_message why;
} hdf5;

const struct bead_h5_symbols *bead_h5_symbols(void)
{
    return &hdf5.symbols;
}

void bead_h5_no_exit_handler(void)
{
    hdf5.no_exit_handler = true;
}

static void load(void)
{
    void (*found[CORE + SCALES])(void);
    struct bead_message why;
    _Static_assert(sizeof found == sizeof hdf5.symbols, "nothing but addresses");
    if (bead_library_load(libraries[0].files, core_names, CORE, found, &why) ||
        bead_library_load(libraries[1].files, scale_names, SCALES, found + CORE, &why)) {
        hdf5.error = bead_fail(&hdf5.why, BEAD_ERROR_UNSUPPORTED, "trajectories and files of sweeps need HDF5 (install %s): %s",
                               BEAD_HDF5_PACKAGES, why.text);
        return;
    }
    memcpy(&hdf5.symbols, found, sizeof found);
    if (hdf5.no_exit_handler)
        H5dont_atexit();
}

enum bead_error bead_h5_load(struct bead_message *msg)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    (void)pthread_once(&once, load);
    return hdf5.error ? bead_fail(msg, hdf5.error, "%s", hdf5.why.text) : BEAD_OK;
}
