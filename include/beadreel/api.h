/* Marks of the public interface: what is exported, what must be checked. */
#ifndef BEADREEL_API_H
#define BEADREEL_API_H

/* Everything is built with -fvisibility=hidden; a function so marked is part of the library. */
#define BEAD_API __attribute__((visibility("default")))
/* The result must be looked at. */
#define BEAD_CHECK __attribute__((warn_unused_result))
/* Argument `f` is a printf format, its values start at argument `v`. */
#define BEAD_PRINTF(f, v) __attribute__((format(printf, f, v)))

/* Around the declarations of every header: C++ programs link to the same functions. */
#ifdef __cplusplus
#define BEAD_BEGIN extern "C" {
#define BEAD_END   }
#else
#define BEAD_BEGIN
#define BEAD_END
#endif

/* Version of these headers; bead_version() is that of the library that runs. Before 1.0 both numbers change together: structures
 * may grow and functions may change with every minor version, and the soname's number goes up with them. */
#define BEADREEL_VERSION "0.1.0"

BEAD_BEGIN

BEAD_API const char *bead_version(void); /* "0.1.0" */

BEAD_END

#endif
