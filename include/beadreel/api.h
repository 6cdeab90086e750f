/* Marks of the public interface: what is exported, what must be checked. */
#ifndef BEADREEL_API_H
#define BEADREEL_API_H

/* Everything is built with -fvisibility=hidden; a function so marked is part of the library. */
#define BEAD_API __attribute__((visibility("default")))
/* The result must be looked at. */
#define BEAD_CHECK __attribute__((warn_unused_result))
/* Argument `f` is a printf format, its values start at argument `v`. */
#define BEAD_PRINTF(f, v) __attribute__((format(printf, f, v)))

#define BEADREEL_VERSION "0.1.0"

#endif
