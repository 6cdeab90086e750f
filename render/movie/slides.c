/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A film as slides: one page for a browser with the film inside, which plays from stop to stop. */
#include "render/movie/film.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "beadreel/sink.h"
#include "render/draw/axis.h"
#include "render/origin/origin.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"

static const char before[] =
    "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>%s</title>\n"
    "<meta name=\"generator\" content=\"beadreel " BEADREEL_VERSION "\">\n"
    "<style>html,body{margin:0;height:100%%;background:%s}video{display:block;width:100%%;height:100%%;object-fit:contain}\n"
    "p{position:fixed;left:0;right:0;bottom:0;width:fit-content;margin:.4em auto;padding:.3em .8em;border-radius:.4em;"
    "font:1em sans-serif;color:#ddd;background:#222}</style>\n"
    "<video playsinline preload=\"auto\" aria-label=\"%s\" src=\"data:video/%s;base64,";
static const char after[] =
    "\"></video>\n<p>space, \u2192 or a click: on to the next stop \u00b7 \u2190: back \u00b7 F: full screen</p>\n<script>\n"
    "const stops = [%s], video = document.querySelector('video'), half = %.9g;\n"
    "let until = Infinity;\n"
    "const next = () => {\n"
    "  document.querySelector('p').hidden = true;\n"
    "  until = stops.find(t => t > video.currentTime + half) ?? Infinity;\n"
    "  video.play();\n"
    "};\n"
    "const halt = time => {\n"
    "  video.pause();\n"
    "  until = Infinity;\n"
    "  video.currentTime = time;\n"
    "};\n"
    "const back = () => halt(stops.findLast(t => t < video.currentTime - half) ?? 0);\n"
    "const watch = () => {\n"
    "  if (video.currentTime >= until) halt(until);\n"
    "  requestAnimationFrame(watch);\n"
    "};\n"
    "watch();\n"
    "addEventListener('click', next);\n"
    "addEventListener('keydown', event => {\n"
    "  if ([' ', 'ArrowRight', 'ArrowDown', 'PageDown', 'Enter'].includes(event.key)) next();\n"
    "  else if (['ArrowLeft', 'ArrowUp', 'PageUp', 'Backspace'].includes(event.key)) back();\n"
    "  else if (event.key === 'Home') halt(0);\n"
    "  else if (event.key === 'f') document.documentElement.requestFullscreen();\n"
    "  else return;\n"
    "  event.preventDefault();\n"
    "});\n"
    "</script>\n<div hidden><code id=\"scene-text\">";

/* The middle of the frame at a stop, s of the film, because players round times of frames either way. */
static double stop_time(const struct bead_film *film, double motion)
{
    const double fps = film->output->movie.fps;
    return bead_movie_stop_time(&film->times, motion, fps) + 0.5 / fps;
}

struct deck {
    const struct bead_film *film;
    const char *movie, *tale;
};

static void write_stops(const struct bead_film *film, char *out, size_t size)
{
    size_t used = 0;
    out[0] = '\0';
    for (size_t i = 0; i < film->output->movie.stop_count && used + 32 < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%.6f", i ? ", " : "", stop_time(film, film->output->movie.stops[i]));
}

static enum bead_error fill(void *context, FILE *file, const char *, struct bead_message *msg)
{
    const struct deck *deck = context;
    const struct bead_film *film = deck->film;
    const char *title = film->context.scene->title, *dot = strrchr(film->output->path, '.');
    BEAD_FREED char *bytes = NULL;
    char name[1024], words[4096], stops[8192];
    size_t length;
    BEAD_TRY(bead_file_read(deck->movie, UINT32_MAX, &bytes, &length, msg));
    bead_text_escape(title && title[0] ? title : "beadreel", name, sizeof name);
    bead_text_escape(deck->tale, words, sizeof words);
    for (char *quote = words; (quote = strchr(quote, '"'));)
        *quote = '\'';
    write_stops(film, stops, sizeof stops);
    fprintf(file, before, name, film->output->paper.theme == BEAD_THEME_LIGHT ? "#fff" : "#000", words,
            dot && strcasecmp(dot, ".webm") == 0 ? "webm" : "mp4");
    for (size_t at = 0; at < length; at += 3 * 4096) {
        gchar *text = g_base64_encode((const guchar *)bytes + at, length - at < 3 * 4096 ? length - at : 3 * 4096);
        fputs(text, file);
        g_free(text);
    }
    fprintf(file, after, stops, 0.5 / film->output->movie.fps);
    bead_origin_escape(film->context.scene->text, file);
    fputs("</code></div>\n</html>\n", file);
    return BEAD_OK;
}

enum bead_error bead_slides_write(const struct bead_film *film, const char *path, const char *movie, const char *tale,
                                  uint64_t *bytes, struct bead_message *msg)
{
    struct deck deck = {film, movie, tale};
    return bead_file_write(path, fill, &deck, bytes, msg);
}
