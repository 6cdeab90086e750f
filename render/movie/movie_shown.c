/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fields, beads and values of its chains that a film shows; and the interest of a frame, by which sinks choose the poster. */
#include <math.h>
#include <stdlib.h>

#include "render/movie/composer_private.h"
#include "render/view/views.h"
#include "sim/base/memory.h"
#include "sim/kinds/view_kinds.h"

/* Fields of views that show all times, or of all views. */
static unsigned composer_fields_of(const struct bead_output *output, const struct bead_chain *chain, bool all_times)
{
    const struct bead_view_setup setup = {
        .chain = chain, .field = output->shown.field, .fill = true, .theory = output->shown.theory};
    unsigned fields = 0;
    for (size_t i = 0; i < output->views.count; i++) {
        const struct bead_view_type *type;
        if (!bead_view_take(&output->views, i, &type, NULL))
            fields |= (!all_times || bead_view_has(type, BEAD_SHOWS_ALL_TIMES)) ? type->fields(&setup) : 0;
    }
    return fields;
}

unsigned bead_composer_fields(const struct bead_output *output, const struct bead_chain *chain)
{
    unsigned fields = composer_fields_of(output, chain, false);
    return fields | (output->movie.follow == BEAD_FOLLOW_FRONT ? BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) : 0);
}

unsigned bead_composer_comparison(const struct bead_output *output, const struct bead_chain *chain)
{
    return output->shown.trust ? composer_fields_of(output, chain, true) : 0;
}

bool bead_composer_averages(const struct bead_output *output)
{
    /* Profiles below a stage keep the largest values so far, those of cells the largest of a passage. */
    const bool keeps = bead_views_any(&output->views, BEAD_ACTS) || output->movie.profile == BEAD_PROFILE_CELL;
    return bead_views_any(&output->views, BEAD_SHOWS_ALL_TIMES) || (keeps && bead_views_any(&output->views, BEAD_OVERLAYS));
}

static struct bead_span within(struct bead_span span, size_t count)
{
    span.last = span.last < count ? span.last : count - 1;
    span.first = span.first < span.last ? span.first : span.last;
    return span;
}

struct bead_span bead_composer_span(const struct bead_composer *c, size_t chain)
{
    const struct bead_output *output = c->setup.output;
    const struct bead_chain *own = c->setup.chains[chain];
    bool contacts = bead_field_info(output->shown.field)->of_contacts;
    return within(output->shown.beads, contacts ? bead_chain_contacts(own) : bead_chain_beads(own));
}

struct bead_span bead_composer_beads(const struct bead_composer *c, size_t chain)
{
    return within(c->setup.output->shown.beads, bead_chain_beads(c->setup.chains[chain]));
}

/* ---- samples between frames ---- */

enum bead_error bead_composer_hold(struct bead_composer *c, struct bead_message *msg)
{
    const struct bead_output *output = c->setup.output;
    const unsigned fields =
        bead_composer_fields(output, c->setup.chains[0]) | (c->setup.interest ? BEAD_FIELD_BIT(output->shown.field) : 0);
    BEAD_TRY(bead_new(&c->held, c->setup.chain_count, msg, "a movie"));
    for (size_t i = 0; i < c->setup.chain_count; i++)
        BEAD_TRY(bead_held_create(c->setup.chains[i], fields, output->shown.beads, &c->held[i], msg));
    return BEAD_OK;
}

/* ---- interest: the difference between chains, or the values that a single chain shows ---- */

enum bead_error bead_interest_open(struct bead_composer *c, struct bead_message *msg)
{
    for (size_t i = 0; i < c->setup.chain_count; i++) {
        struct bead_span span = bead_composer_span(c, i);
        size_t count = span.last - span.first + 1;
        c->fed_room = count > c->fed_room ? count : c->fed_room;
    }
    c->fed = calloc(c->setup.chain_count * c->fed_room, sizeof *c->fed);
    return c->fed ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a poster");
}

void bead_interest_keep(struct bead_composer *c, const struct bead_sample *sample)
{
    const double *value = sample->field[c->setup.output->shown.field];
    struct bead_span span = bead_composer_span(c, sample->chain);
    if (value)
        memcpy(c->fed + sample->chain * c->fed_room, value + span.first, (span.last - span.first + 1) * sizeof *value);
}

void bead_interest_feed(struct bead_composer *c, const struct bead_sample *sample)
{
    if (c->held)
        bead_held_feed(c->held[sample->chain], sample);
    else
        bead_interest_keep(c, sample);
}

void bead_interest_advance(struct bead_composer *c)
{
    for (size_t i = 0; c->held && i < c->setup.chain_count; i++) {
        const struct bead_sample *sample = bead_held_take(c->held[i]);
        if (sample)
            bead_interest_keep(c, sample);
    }
}

/* Root of the sum, over the beads, of the squared deviations of the chains from their mean. */
static double difference(const struct bead_composer *c)
{
    double sum = 0;
    for (size_t i = 0; i < c->fed_room; i++) {
        double mean = 0;
        for (size_t chain = 0; chain < c->setup.chain_count; chain++)
            mean += c->fed[chain * c->fed_room + i] / (double)c->setup.chain_count;
        for (size_t chain = 0; chain < c->setup.chain_count; chain++)
            sum += pow(c->fed[chain * c->fed_room + i] - mean, 2);
    }
    return sqrt(sum);
}

double bead_force_at_rest(const struct bead_chain *chain, enum bead_field field, size_t index)
{
    const double *force = bead_chain_static_force(chain);
    if (field != BEAD_FIELD_CONTACT_FORCE && field != BEAD_FIELD_FORCE)
        return 0;
    if (field == BEAD_FIELD_CONTACT_FORCE)
        return force[index];
    return 0.5 * ((index > 0 ? force[index - 1] : 0) + (index < bead_chain_contacts(chain) ? force[index] : 0));
}

static double along_bar(const struct bead_composer *c, double value)
{
    return fmin(1, fmax(0, bead_colours_place(&c->colours, value)));
}

/* Mean distance along the colour bar from the values at rest, weighted by how far views of all times have filled. */
static double shown(const struct bead_composer *c, double time)
{
    double passed = (time - c->setup.time[0]) / (c->setup.time[1] - c->setup.time[0]), sum = 0;
    const enum bead_field field = c->setup.output->shown.field;
    const size_t first = bead_composer_span(c, 0).first;
    for (size_t i = 0; i < c->fed_room; i++)
        sum += fabs(along_bar(c, c->fed[i]) - along_bar(c, bead_force_at_rest(c->setup.chains[0], field, first + i)));
    return (bead_views_any(&c->setup.output->views, BEAD_SHOWS_ALL_TIMES) ? 0.3 + 0.7 * passed : 1) * sum / (double)c->fed_room;
}

/* Does a value leave its panel, which extends a little beyond the range? */
static bool leaves_panel(const struct bead_composer *c)
{
    const struct bead_colour_range *range = &c->setup.range;
    const double air = 0.04 * (range->high - range->low);
    const bool both = range->low < 0 || range->rest > 0;
    for (size_t i = 0; i < c->setup.chain_count * c->fed_room; i++) {
        if (c->fed[i] > range->high + air || (both && c->fed[i] < range->low - air))
            return true;
    }
    return false;
}

double bead_composer_interest(const struct bead_composer *c, double time)
{
    static const double cut = 1e-6; /* such a frame is better than none */
    double interest = !c->fed ? 0 : c->setup.chain_count > 1 ? difference(c) : shown(c, time);
    return interest > 0 && leaves_panel(c) ? cut * interest : interest;
}
