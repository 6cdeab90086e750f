/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the beads of a long chain that the drawing of the experiment shows, and its words, for the plan. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/schematic/schematic_plan.h"
#include "render/schematic/schematic_sketch.h"

/* Spins of up to this many cells are written out. */
enum { MOST_DIGITS = 12 };

static void spin_words(const struct bead_segment *segment, char *out, size_t size)
{
    out[0] = '\0';
    if (!segment->spins_given || segment->cell_beads < 2)
        return;
    if (segment->spins == BEAD_SPINS_RANDOM) /* the header gives their M */
        snprintf(out, size, "random");
    else if (segment->spins == BEAD_SPINS_DIGITS && segment->count > MOST_DIGITS)
        snprintf(out, size, "given spins");
    else
        snprintf(out, size, "%s",
                 segment->spins == BEAD_SPINS_DIGITS ? segment->digits
                 : segment->spins == BEAD_SPINS_UP   ? "up"
                                                     : "down");
}

static void segment_words(const struct bead_segment *segment, struct bead_part *part)
{
    if (segment->sensor) /* its name is above */
        return;
    snprintf(part->words[0], sizeof part->words[0], "%zu %s", segment->count,
             bead_cell_word(segment->cell_beads, segment->count != 1));
    spin_words(segment, part->words[1], sizeof part->words[1]);
}

/* Number of entries from `from` on that are single beads, such as those of a tapered chain. */
static size_t plain_entries(const struct bead_chain_spec *spec, size_t from)
{
    size_t s = from;
    while (s < spec->segment_count && spec->segments[s].cell_beads == 1 && !spec->segments[s].sensor &&
           !spec->segments[s].spins_given)
        s++;
    return s - from;
}

/* The least number of such entries in a row that form one part. */
enum { ROW = 5 };

/* "20 beads", "R = 4.76 mm to 1.80 mm". */
static void row_words(const struct bead_chain *chain, struct bead_part *part)
{
    const double *radius = bead_chain_radius(chain);
    const double first = radius[part->first], last = radius[part->first + part->beads - 1];
    char from[32], to[32];
    snprintf(part->words[0], sizeof part->words[0], "%zu beads", part->beads);
    bead_quantity(first, "m", 3, from, sizeof from);
    bead_quantity(last, "m", 3, to, sizeof to);
    if (strcmp(from, to) != 0)
        snprintf(part->words[1], sizeof part->words[1], BEAD_SYMBOL("R") " = %s to %s", from, to);
}

/* The part that begins with entry *s at bead `first`; moves *s on to the next part. */
static struct bead_part part_from(const struct bead_chain *chain, size_t *s, size_t first)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const size_t row = plain_entries(spec, *s), entries = row >= ROW ? row : 1;
    struct bead_part part = {.segment = &spec->segments[*s], .first = first};
    for (size_t i = 0; i < entries; i++, (*s)++)
        part.beads += spec->segments[*s].cell_beads * spec->segments[*s].count;
    if (row >= ROW)
        row_words(chain, &part);
    else
        segment_words(part.segment, &part);
    return part;
}

static size_t count_parts(const struct bead_chain *chain)
{
    size_t count = 0, s = 0;
    for (; s < bead_chain_spec(chain)->segment_count; count++)
        (void)part_from(chain, &s, 1);
    return count;
}

size_t bead_parts_make(const struct bead_chain *chain, size_t most, struct bead_part *parts)
{
    size_t count = count_parts(chain), used = 0, bead = 1, s = 0;
    size_t front = count <= most ? count : (most + 1) / 2, back = count <= most ? 0 : most / 2;
    for (size_t i = 0; i < count; i++) {
        struct bead_part part = part_from(chain, &s, bead);
        bead += part.beads;
        if (i < front || i >= count - back) {
            parts[used++] = part;
        } else if (i == front) {
            part.segment = NULL;
            parts[used++] = part;
        } else {
            parts[used - 1].beads += part.beads;
        }
    }
    for (size_t i = 0; i < used; i++) {
        if (parts[i].segment)
            continue;
        snprintf(parts[i].words[0], sizeof parts[i].words[0], "%zu more entries", count - front - back);
        snprintf(parts[i].words[1], sizeof parts[i].words[1], "%zu beads", parts[i].beads);
    }
    return used;
}

/* Adds at most about `most` beads of a part; whole cells if they are short enough. */
static bool strip_part(const struct bead_chain *chain, const struct bead_part *part, size_t index, size_t most,
                       struct bead_strip *strip)
{
    const size_t *material = bead_chain_material(chain);
    if (!part->segment)
        return bead_strip_add_gap(strip, index);
    size_t cell = part->segment->cell_beads, lead = (most + 1) / 2, tail = most / 2;
    if (cell <= most) {
        lead = (lead + cell - 1) / cell * cell;
        tail = tail < cell ? cell : tail / cell * cell;
    }
    lead = part->beads <= most ? part->beads : lead;
    return bead_strip_add(strip, material + part->first, 1, part->beads, lead, tail, index);
}

bool bead_parts_strip(const struct bead_chain *chain, const struct bead_part *parts, size_t count, size_t most,
                      struct bead_strip *strip)
{
    strip->count = 0;
    for (size_t i = 0; i < count; i++) {
        if (!strip_part(chain, &parts[i], i, most, strip))
            return false;
    }
    return true;
}

/* ---- words above and below ---- */

static void add_label(struct bead_plan_labels *labels, const struct bead_text_style *style, size_t part, const char *first,
                      const char *second)
{
    size_t i = labels->count++;
    snprintf(labels->words[i][0], sizeof labels->words[i][0], "%s", first);
    snprintf(labels->words[i][1], sizeof labels->words[i][1], "%s", second);
    labels->part[i] = part;
    labels->label[i].width = fmax(bead_sketch_width(style, first), bead_sketch_width(style, second));
}

static void striker_words(const struct bead_chain *chain, char *out, size_t size)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    if (spec->striker_velocity != 0)
        snprintf(out, size, "striker, %.4g m/s", fabs(spec->striker_velocity));
    else if (spec->drive.bead == 0 && (spec->drive.displacement || spec->drive.force))
        bead_mover_name(chain, out, size);
    else
        snprintf(out, size, "striker at rest");
}

void bead_parts_labels(struct bead_plan_row *row, const struct bead_text_style *style, bool details)
{
    char words[160], wall[96];
    row->above.count = row->below.count = 0;
    striker_words(row->chain, words, sizeof words);
    add_label(&row->above, style, SIZE_MAX, words, "");
    for (size_t i = 0; i < row->part_count; i++) {
        const struct bead_part *part = &row->parts[i];
        if (part->segment && part->segment->sensor) {
            bead_text_escape(part->segment->sensor, words + strlen("sensor "), sizeof words - strlen("sensor "));
            memcpy(words, "sensor ", strlen("sensor "));
            add_label(&row->above, style, i, words, "");
        } else if (*part->words[0]) {
            add_label(&row->below, style, i, part->words[0], details ? part->words[1] : "");
        }
    }
    if (bead_chain_spec(row->chain)->wall != BEAD_WALL_NONE) {
        bead_wall_name(row->chain, wall, sizeof wall);
        bead_text_escape(wall, words, sizeof words);
        add_label(&row->below, style, SIZE_MAX, words, "");
    }
}

/* What moves besides the striker. */
static void other_movers(const struct bead_chain *chain, char *out, size_t size)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const struct bead_start *start = spec->starts;
    size_t count = spec->start_count;
    if (count > 0 && start->bead == 0)
        start++, count--;
    char words[160];
    out[0] = '\0';
    if (spec->drive.bead > 0 && (spec->drive.displacement || spec->drive.force)) {
        bead_mover_name(chain, words, sizeof words);
        snprintf(out, size, "bead %zu %s", spec->drive.bead, words);
    } else if (count == 1) {
        const bool moves = start->velocity != 0;
        bead_quantity(moves ? start->velocity : start->displacement, moves ? "m/s" : "m", 3, words, sizeof words);
        snprintf(out, size, "bead %zu starts %s %s", start->bead, moves ? "with" : "at", words);
    } else if (count > 1)
        snprintf(out, size, "%zu beads that do not start at rest", count);
}

/* Composes name, number of beads, M, tilt or absorbing end, precompression, gaps, and what else moves, as much as fits. */
void bead_parts_header(struct bead_plan_row *row, const struct bead_text_style *style, int decimals, double width)
{
    const struct bead_chain_spec *spec = bead_chain_spec(row->chain);
    char name[160], pieces[7][200] = {""}, text[sizeof row->header], number[128];
    bead_text_escape(bead_chain_title(row->chain), name, sizeof name);
    if (*name)
        snprintf(pieces[0], sizeof pieces[0], "<b>%s</b>", name);
    snprintf(pieces[1], sizeof pieces[1], "%zu bead%s", bead_chain_beads(row->chain) - 1,
             bead_chain_beads(row->chain) == 2 ? "" : "s");
    for (size_t i = 0; i < row->below.count; i++)
        pieces[1][0] = strcmp(pieces[1], row->below.words[i][0]) == 0 ? '\0' : pieces[1][0]; /* a brace names it */
    if (*bead_chain_spins(row->chain)) {
        bead_number(bead_chain_magnetism(row->chain), decimals, number, sizeof number);
        snprintf(pieces[2], sizeof pieces[2], BEAD_SYMBOL("M") " = %s", number);
    }
    if (spec->tilt > 0)
        snprintf(pieces[3], sizeof pieces[3], "tilt %.3g°%s", spec->tilt * 180 / M_PI,
                 fabs(row->slope - tan(spec->tilt)) > 1e-9 ? " (drawn flatter)" : "");
    if (spec->absorbs) /* without a wall, and so without a tilt */
        snprintf(pieces[3], sizeof pieces[3], "absorbing end");
    if (spec->precompression > 0) {
        bead_quantity(spec->precompression, "N", 3, number, sizeof number);
        snprintf(pieces[4], sizeof pieces[4], "precompressed by %s", number);
    }
    if (spec->gap > 0) {
        bead_quantity(spec->gap, "m", 3, number, sizeof number);
        snprintf(pieces[5], sizeof pieces[5], "gaps of %s", number);
    }
    other_movers(row->chain, pieces[6], sizeof pieces[6]);
    row->header[0] = '\0';
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; i++) {
        const char *apart = *row->header ? "    " : "";
        if (!*pieces[i] || strlen(row->header) + strlen(apart) + strlen(pieces[i]) >= sizeof text)
            continue;
        memcpy(text, row->header, sizeof text);
        strcat(strcat(text, apart), pieces[i]);
        if (bead_sketch_width(style, text) <= width)
            memcpy(row->header, text, sizeof text);
    }
}
