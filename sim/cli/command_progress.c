/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress on stderr, as a bar, plain lines or JSON; and numbers with units for all output. */
#include "sim/cli/command_line.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sim/base/clock.h"
#include "sim/base/json.h"

#define REDRAW    0.1 /* s between redraws of a terminal's line */
#define SAY_EVERY 3   /* s between plain lines */
#define MARK      3   /* s between marks: the rate is that of the last 3 to 6 s */

void command_meter_init(struct command_meter *meter, enum command_progress mode)
{
    *meter = (struct command_meter){.mode = mode, .began = bead_clock()};
    const char *terminal = getenv("TERM");
    if (mode == COMMAND_PROGRESS_AUTO && (!isatty(STDERR_FILENO) || (terminal && strcmp(terminal, "dumb") == 0)))
        meter->mode = COMMAND_PROGRESS_PLAIN;
}

/* "3 s", "2:05" into text. */
static const char *duration(double seconds, char *text, size_t size)
{
    if (!(seconds < 360000))
        snprintf(text, size, "?");
    else if (seconds < 99.5)
        snprintf(text, size, "%.0f s", fmax(seconds, 1)); /* what is not over takes a while */
    else
        snprintf(text, size, "%d:%02d", (int)seconds / 60, (int)seconds % 60);
    return text;
}

/* ", 83 chains/s": what was done since this stage began. */
static void rate_words(const struct command_meter *meter, const struct bead_progress *progress, double elapsed, char *text,
                       size_t size)
{
    double items = progress->items - meter->items_began;
    text[0] = 0;
    if (progress->item && items > 0 && elapsed > 0.5)
        snprintf(text, size, ", %.3g %s/s", items / elapsed, progress->item);
}

static void draw_bar(struct command_meter *meter, double done, double left, const char *rate)
{
    enum { WIDTH = 24 };
    char bar[WIDTH + 1], time[32];
    for (int i = 0; i < WIDTH; i++)
        bar[i] = i < (int)(done * WIDTH + 0.5) ? '#' : '.';
    bar[WIDTH] = 0;
    fprintf(stderr, "\r\033[K[%s] %3.0f %%  %.40s%s", bar, 100 * done, meter->what, rate);
    if (left >= 0)
        fprintf(stderr, ", %s left", duration(left, time, sizeof time));
    fflush(stderr);
    meter->drawn = true;
}

static void write_plain(const struct command_meter *meter, double done, double left, const char *rate)
{
    char time[32];
    if (left >= 0)
        fprintf(stderr, "%s: %.0f %%%s, %s left\n", meter->what, 100 * done, rate, duration(left, time, sizeof time));
    else
        fprintf(stderr, "%s: %.0f %%%s\n", meter->what, 100 * done, rate);
}

static void write_json(const struct command_meter *meter, double done, double left, double elapsed,
                       const struct bead_progress *progress)
{
    struct bead_json json = {.out = stderr};
    bead_json_open(&json, NULL, '{');
    bead_json_text(&json, "what", meter->what);
    bead_json_number(&json, "done", round(1e4 * done) / 1e4);
    bead_json_number(&json, "elapsed_s", round(1e3 * elapsed) / 1e3);
    if (left >= 0)
        bead_json_number(&json, "left_s", round(1e3 * left) / 1e3);
    if (progress->item)
        bead_json_number(&json, progress->item, round(progress->items));
    if (isfinite(progress->time))
        bead_json_number(&json, "time_s", progress->time);
    bead_json_close(&json, "}");
    fputc('\n', stderr);
}

/* Seconds, at the rate of the last few; -1: not known. */
static double time_left(struct command_meter *meter, double now, double done)
{
    const double gone = done - meter->marks[0].done, took = now - meter->marks[0].time;
    if (now - meter->marks[1].time > MARK) {
        meter->marks[0] = meter->marks[1];
        meter->marks[1].time = now;
        meter->marks[1].done = done;
    }
    return took > 0.5 && gone > 1e-6 && done > 0.005 && done < 1 ? took * (1 - done) / gone : -1;
}

void command_meter_tell(void *context, const struct bead_progress *progress)
{
    struct command_meter *meter = context;
    if (meter->mode == COMMAND_PROGRESS_NONE)
        return;
    double now = bead_clock();
    bool fresh = strncmp(meter->what, progress->what, sizeof meter->what - 1) != 0;
    if (fresh) {
        if (*meter->what)
            meter->began = now; /* the first stage began with the program */
        snprintf(meter->what, sizeof meter->what, "%s", progress->what);
        meter->done_began = progress->items > 0 ? progress->done : 0;
        meter->items_began = progress->items;
        meter->marks[0].time = meter->marks[1].time = meter->began;
        meter->marks[0].done = meter->marks[1].done = meter->done_began; /* work found done took no time */
        if (meter->mode == COMMAND_PROGRESS_PLAIN)
            meter->said = now; /* what takes no time needs no line */
    }
    bool wait = now - meter->said < (meter->mode == COMMAND_PROGRESS_PLAIN ? SAY_EVERY : REDRAW);
    if (wait && (!fresh || meter->mode == COMMAND_PROGRESS_PLAIN)) /* nothing more may be reported about a stage */
        return;
    meter->said = now;
    double done = progress->done >= 0 ? fmin(progress->done, 1) : 0, elapsed = now - meter->began;
    double left = time_left(meter, now, done);
    char rate[64];
    rate_words(meter, progress, elapsed, rate, sizeof rate);
    if (meter->mode == COMMAND_PROGRESS_JSON)
        write_json(meter, done, left, elapsed, progress);
    else if (meter->mode == COMMAND_PROGRESS_PLAIN)
        write_plain(meter, done, left, rate);
    else
        draw_bar(meter, done, left, rate);
}

void command_meter_clear(struct command_meter *meter)
{
    if (meter->drawn)
        fputs("\r\033[K", stderr);
    meter->drawn = false;
}

const char *command_quantity(double value, const char *unit, char *text, size_t size)
{
    static const char *const prefixes[] = {"f", "p", "n", "u", "m", "", "k", "M", "G", "T"};
    double scale = value;
    int prefix = 5;
    if (*unit && isfinite(value) && value != 0) { /* plain numbers stay as they are */
        while (fabs(scale) >= 999.95 && prefix < 9)
            scale /= 1000, prefix++;
        while (fabs(scale) < 0.99995 && prefix > 0)
            scale *= 1000, prefix--;
    }
    snprintf(text, size, "%.*g%s%s%s", *unit ? 4 : 6, scale, *unit ? " " : "", prefixes[prefix], unit);
    return text;
}
