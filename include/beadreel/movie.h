/* Movies: frames into a file through libavcodec and libavformat. The container follows the extension:
 * mp4 (H.264), mkv (FFV1, or lossless H.264), webm (VP9), gif, png/apng (APNG).
 *
 *   bead_movie_open(path, &settings, &movie, &msg);   writes path.part
 *   bead_movie_add(movie, &frame, &changes, &msg);    once a frame, in order
 *   bead_movie_close(movie, &msg);                    finishes, fsyncs, renames; or bead_movie_abort(movie)
 *
 * Only the changed rectangles are converted; a frame without changes is not encoded where the container
 * can show the one before for longer. Encoder settings are deterministic: same frames, same decoded frames. */
#ifndef BEADREEL_MOVIE_H
#define BEADREEL_MOVIE_H

#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/frame.h"
#include "beadreel/scene.h"

struct bead_movie_settings {
    int width, height; /* pixels; odd sizes are an error where the codec needs even ones */
    double fps;
    enum bead_quality quality;
    const char *title, *comment; /* metadata; may be NULL */
};

struct bead_movie;

/* NULL-terminated list of file extensions that can be written, with a description of the codec. */
struct bead_codec_info {
    const char *extension, *description;
};
BEAD_API const struct bead_codec_info *bead_movie_codecs(void);

BEAD_API BEAD_CHECK enum bead_error bead_movie_open(const char *path, const struct bead_movie_settings *settings,
                                         struct bead_movie **movie, struct bead_message *msg);
/* The first frame is taken whole, whatever `changes` says. */
BEAD_API BEAD_CHECK enum bead_error bead_movie_add(struct bead_movie *movie, const struct bead_frame *frame,
                                        const struct bead_changes *changes, struct bead_message *msg);
BEAD_API uint64_t bead_movie_frames(const struct bead_movie *movie);  /* shown */
BEAD_API uint64_t bead_movie_encoded(const struct bead_movie *movie); /* given to the encoder */
/* Frees the movie in any case. */
BEAD_API BEAD_CHECK enum bead_error bead_movie_close(struct bead_movie *movie, uint64_t *bytes, struct bead_message *msg);
/* Frees the movie and removes its file. NULL is allowed. */
BEAD_API void bead_movie_abort(struct bead_movie *movie);

#endif
