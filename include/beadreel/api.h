/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Marks of the public interface: what is exported, what must be checked. */
#ifndef BEADREEL_API_H
#define BEADREEL_API_H

#include <string.h>

/* Everything is built with -fvisibility=hidden; a function marked so is part of the library. Other exports are only for the other
 * library and the programs. */
#define BEAD_API __attribute__((visibility("default")))
/* The result must be looked at. */
#define BEAD_CHECK __attribute__((warn_unused_result))
/* Argument `f` is a printf format, whose values start at argument `v`. */
#define BEAD_PRINTF(f, v) __attribute__((format(printf, f, v)))

/* Around the declarations of every header: C++ programs link to the same functions. */
#ifdef __cplusplus
#define BEAD_BEGIN extern "C" {
#define BEAD_END   }
#else
#define BEAD_BEGIN
#define BEAD_END
#endif

/* The version of these headers; bead_version() gives that of the running library.
 *
 * What stays. Within one soname (libbeadsim.so.0), a program that was compiled against older headers runs with a newer library:
 * - Functions are added, never removed or changed. tests/reference/libbeadsim.symbols and libbeadreel.symbols list all of them,
 * with the version that brought them.
 * - Structures that a caller fills in (bead_job, bead_chain_settings, bead_player_settings, bead_sweep_settings,
 * bead_movie_settings) begin with their size and grow at the end. Members that the caller's header lacked get their default, which
 * is 0. An unknown size, such as that of a newer header, is refused with a message.
 * - Values of enums keep their numbers; new ones come after them.
 * - Keys of scenes keep their meaning. Trajectories and results of sweeps remain readable.
 *
 * What may change before 1.0, with a new minor version (0.2), a new soname and an entry in CHANGELOG.md: everything else. These are
 * functions and their arguments; structures that the library fills in (bead_outcome, bead_counts, bead_needs, bead_run_context,
 * bead_sample, ...), bead_own, or structures that are passed by value; tables of functions (bead_sink_type, bead_view_type);
 * bead_scene and what is in it; default values. The last digits of results may change with any version; CHANGELOG.md says so. */
#define BEADREEL_VERSION "0.1.0"

/* Settings begin with their size; any other member that is 0 means the default:
 *   struct bead_job job;
 *   BEAD_DEFAULT(&job);
 *   job.input = "scene.yaml";
 * or, in C, struct bead_job job = {.size = sizeof job, .input = "scene.yaml"}; */
#define BEAD_DEFAULT(settings) (memset((settings), 0, sizeof *(settings)), (void)((settings)->size = sizeof *(settings)))

BEAD_BEGIN

BEAD_API const char *bead_version(void); /* "0.1.0" */

BEAD_END

#endif
