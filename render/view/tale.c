/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words about a wave: how high it is early and late, how wide, and when it arrives. */
#include "render/view/tale.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "render/draw/axis.h"
#include "render/draw/words.h"
#include "sim/base/memory.h"
#include "sim/chain/system.h"

/* Parts of the largest value so far: the front is where values exceed the first; the wave is wide from end to end of the second. */
static const double at_front = 0.01, in_wave = 0.1;
/* A pulse keeps its height if it changes by less than this part from the second eighth of the chain to the last but one. */
static const double keeps = 0.1;
enum { PART = 8, NARROW = 12 /* beads: at most, in a pulse */ };

struct chain_tale {
    const struct bead_chain *chain;
    size_t first, count;    /* values */
    double *rest, *largest; /* [count]: in the first sample; magnitude in all samples */
    double most, begun, seen, arrived;
    size_t reached, wide; /* beads behind the front; between the ends of the wave as it arrived */
};

struct bead_tale {
    enum bead_field field;
    size_t count;
    struct chain_tale chains[];
};

enum bead_error bead_tale_create(const struct bead_chain *const *chains, size_t count, enum bead_field field,
                                 struct bead_span beads, struct bead_tale **tale, struct bead_message *msg)
{
    BEAD_TRY(bead_allocate(tale, 1, sizeof **tale + count * sizeof *(*tale)->chains, msg, "the words of a picture"));
    struct bead_tale *t = *tale;
    t->field = field;
    for (size_t c = 0; c < count; c++) {
        struct chain_tale *k = &t->chains[t->count++];
        const size_t all = bead_field_info(field)->of_contacts ? bead_chain_contacts(chains[c]) : bead_chain_beads(chains[c]);
        *k = (struct chain_tale){.chain = chains[c], .first = beads.first, .begun = NAN, .arrived = NAN};
        k->count = beads.first < all ? (beads.last < all ? beads.last + 1 : all) - beads.first : 0;
        BEAD_TRY(bead_new(&k->rest, 2 * k->count + 1, msg, "the words of a picture"));
        k->largest = k->rest + k->count;
    }
    return BEAD_OK;
}

void bead_tale_destroy(struct bead_tale *tale)
{
    for (size_t c = 0; tale && c < tale->count; c++)
        free(tale->chains[c].rest);
    free(tale);
}

void bead_tale_feed(struct bead_tale *tale, const struct bead_sample *sample)
{
    struct chain_tale *k = &tale->chains[sample->chain];
    if (!sample->field[tale->field] || k->count == 0)
        return;
    const double *values = sample->field[tale->field] + k->first;
    size_t from = k->count, to = 0;
    const bool first = isnan(k->begun);
    if (first) {
        memcpy(k->rest, values, k->count * sizeof *values);
        k->begun = sample->time;
    }
    double now = 0;
    for (size_t i = 0; i < k->count; i++) {
        k->largest[i] = fmax(k->largest[i], fabs(values[i]));
        now = fmax(now, fabs(values[i] - k->rest[i]));
    }
    k->most = fmax(k->most, now);
    k->seen = sample->time;
    for (size_t i = k->reached; i < k->count && now > 0; i++)
        k->reached = fabs(values[i] - k->rest[i]) > at_front * k->most ? i + 1 : k->reached;
    if (k->reached < k->count || !isnan(k->arrived))
        return;
    for (size_t i = 0; i < k->count; i++) {
        if (fabs(values[i] - k->rest[i]) > in_wave * now) {
            from = i < from ? i : from;
            to = i + 1;
        }
    }
    k->arrived = sample->time;
    k->wide = to > from ? to - from : 0;
}

/* The largest value in a part of the chain. */
static double largest_of(const struct chain_tale *k, size_t part)
{
    double largest = 0;
    for (size_t i = part * k->count / PART; i < (part + 1) * k->count / PART; i++)
        largest = fmax(largest, k->largest[i]);
    return largest;
}

static void quantity(double value, const char *unit, char *out, size_t size)
{
    bead_quantity(value, unit, 2, out, size);
}

/* "In Clean (M = 1) "; "" if nothing tells chains apart. */
static void begin(const struct bead_tale *tale, const struct chain_tale *k, char *out, size_t size)
{
    const char *name = bead_chain_title(k->chain);
    const struct bead_chain *chains[64];
    size_t count = 0;
    char magnetism[32] = "", *at = magnetism;
    for (; count < tale->count && count < sizeof chains / sizeof *chains; count++)
        chains[count] = tale->chains[count].chain;
    if (*bead_chain_spins(k->chain)) {
        bead_number(bead_chain_magnetism(k->chain), bead_magnetism_decimals(chains, count), magnetism, sizeof magnetism);
        snprintf(out, size, *name ? "In %s (M = %s) " : "%.0sWith M = %s ", name, at);
    } else {
        snprintf(out, size, *name ? "In %s " : "%s", name);
    }
}

/* The story of a struck chain. */
static void wave_words(const struct bead_tale *tale, const struct chain_tale *k, char *out, size_t size)
{
    const struct bead_field_info *field = bead_chain_field(k->chain, tale->field);
    const char *what = field->of_contacts ? "contact" : "bead", *wide = k->wide == 1 ? "" : "s";
    const double early = largest_of(k, 1), late = largest_of(k, PART - 2);
    char from[48], to[48], time[48];
    const bool arrived = !isnan(k->arrived), same = fabs(late - early) <= keeps * early;
    quantity(early, field->unit, from, sizeof from);
    quantity(late, field->unit, to, sizeof to);
    quantity(arrived ? k->arrived : k->seen, bead_chain_time_unit(k->chain), time, sizeof time);
    if (!arrived)
        snprintf(out, size, "the wave has passed %zu of %zu %ss after %s; its %s is up to %s.", k->reached, k->count, what, time,
                 field->title, from);
    else if (same && k->wide <= NARROW)
        snprintf(out, size, "one pulse of %s, %zu %s%s wide, crosses %zu %ss in %s and keeps its height.", to, k->wide, what, wide,
                 k->count, what, time);
    else
        snprintf(
            out, size,
            "the front crosses %zu %ss in %s; the largest %s goes from %s near the start to %s near the end, where the wave is "
            "spread over %zu %s%s.",
            k->count, what, time, field->title, from, to, k->wide, what, wide);
}

void bead_tale_of_chain(const struct bead_tale *tale, size_t chain, char *out, size_t size)
{
    const struct chain_tale *k = tale ? &tale->chains[chain] : NULL;
    *out = '\0';
    if (!k || isnan(k->begun) || k->count < PART || !(k->most > 0))
        return;
    begin(tale, k, out, size);
    const size_t used = strlen(out);
    if (bead_chain_spec(k->chain)->system->has_striker) {
        wave_words(tale, k, out + used, size - used);
    } else {
        const struct bead_field_info *field = bead_chain_field(k->chain, tale->field);
        char most[48];
        double largest = 0;
        for (size_t i = 0; i < k->count; i++)
            largest = fmax(largest, k->largest[i]);
        quantity(largest, field->unit, most, sizeof most);
        snprintf(out + used, size - used, "the largest magnitude of %s is %s.", field->title, most);
    }
    *out = (char)toupper((unsigned char)*out);
}

void bead_tale_words(const struct bead_tale *tale, char *out, size_t size)
{
    size_t used = 0;
    *out = '\0';
    for (size_t c = 0; tale && c < tale->count && used + 1 < size; c++) {
        char one[BEAD_TALE_WORDS / 2];
        bead_tale_of_chain(tale, c, one, sizeof one);
        used += (size_t)snprintf(out + used, size - used, "%s%s", used && *one ? " " : "", one);
        used = used < size ? used : size - 1;
    }
}
