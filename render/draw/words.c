/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of words, for everything with headings, captions and facts; names of walls, decimals of magnetisms. */
#include "render/draw/words.h"

#include <math.h>

#include "render/draw/axis.h"
#include "render/draw/markup.h"

enum { LONGEST = 1024 };

struct bead_text_style bead_words_style(const struct bead_look *look, double size, struct bead_rgb colour, enum bead_align down)
{
    return (struct bead_text_style){.family = look->family, .size = size, .colour = colour, .down = down};
}

double bead_words_width(cairo_t *cr, const struct bead_text_style *style, const char *markup)
{
    double width = 0, height;
    if (*markup)
        bead_text_size(cr, style, markup, &width, &height);
    return width;
}

void bead_words_draw_within(cairo_t *cr, const struct bead_text_style *style, struct bead_rect box, double x, double y,
                            const char *markup)
{
    cairo_save(cr);
    cairo_rectangle(cr, box.x, box.y, box.width, box.height);
    cairo_clip(cr);
    bead_text_draw(cr, style, x, y, markup);
    cairo_restore(cr);
}

/* Cuts after `length` bytes, never within a character or after a space. */
static void cut(const char *text, size_t length, char *out, size_t size)
{
    while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80)
        length--;
    while (length > 0 && text[length - 1] == ' ')
        length--;
    snprintf(out, size, "%.*s%s", (int)length, text, length > 0 ? "\u2026" : "");
}

double bead_words_fit(cairo_t *cr, const struct bead_text_style *style, const char *text, bool marked, double room, char *markup,
                      size_t size)
{
    void (*const to_markup)(const char *, char *, size_t) = marked ? bead_markup : bead_text_escape;
    char part[LONGEST + sizeof "\u2026"];
    size_t length = strnlen(text, LONGEST), low = 0, high = length;
    to_markup(text, markup, size);
    double width = bead_words_width(cr, style, markup);
    if (width <= room && !text[length])
        return width;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        cut(text, middle, part, sizeof part);
        to_markup(part, markup, size);
        if (bead_words_width(cr, style, markup) <= room)
            low = middle;
        else
            high = middle - 1;
    }
    cut(text, low, part, sizeof part);
    to_markup(part, markup, size);
    return bead_words_width(cr, style, markup);
}

void bead_wall_name(const struct bead_chain *chain, char *out, size_t size)
{
    enum { MOST = 40 };
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const bool rigid = spec->wall == BEAD_WALL_RIGID;
    const char *name = rigid ? "rigid" : bead_chain_scene(chain)->materials[spec->wall_material].label;
    const size_t length = strcspn(name, ","); /* without the radius, which walls do not have */
    snprintf(out, size, "%.*s wall", (int)(length < MOST ? length : MOST), name);
}

/* "": nothing is driven. */
static void name_drive(const struct bead_drive *drive, char *out, size_t size)
{
    const enum bead_wave wave = drive->displacement ? drive->displacement : drive->force;
    char from[40], to[40];
    bead_quantity(drive->frequency, "Hz", 3, from, sizeof from);
    bead_quantity(drive->to, "Hz", 3, to, sizeof to);
    out[0] = '\0';
    if (wave == BEAD_WAVE_SINE)
        snprintf(out, size, "driven at %s", from);
    else if (wave == BEAD_WAVE_CHIRP)
        snprintf(out, size, "driven from %s to %s", from, to);
    else if (wave != BEAD_WAVE_NONE)
        snprintf(out, size, "driven by %s", wave == BEAD_WAVE_NOISE ? "noise" : "a measured wave");
}

void bead_mover_name(const struct bead_chain *chain, char *out, size_t size)
{
    const double velocity = bead_chain_spec(chain)->striker_velocity;
    char speed[40];
    name_drive(&bead_chain_spec(chain)->drive, out, size);
    if (*out || velocity == 0)
        return;
    if (fabs(velocity) >= 0.01 && fabs(velocity) < 1) /* as the field writes it */
        snprintf(speed, sizeof speed, "%.3g m/s", velocity);
    else
        bead_quantity(velocity, "m/s", 3, speed, sizeof speed);
    snprintf(out, size, "striker %s", speed);
}

int bead_magnetism_digits(double magnetism)
{
    enum { MOST = 3 };
    int digits = 0;
    while (digits < MOST && fabs(remainder(magnetism, bead_power_of_ten(-digits))) > 1e-9)
        digits++;
    return digits;
}

int bead_magnetism_decimals(const struct bead_chain *const *chains, size_t count)
{
    int most = 0;
    for (size_t c = 0; c < count; c++) {
        const int digits = *bead_chain_spins(chains[c]) ? bead_magnetism_digits(bead_chain_magnetism(chains[c])) : 0;
        most = digits > most ? digits : most;
    }
    return most;
}
