/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The key in the headroom of the stage: materials in their colours, and a scale for the light. */
#include <math.h>
#include <stdio.h>

#include "beadreel/law.h"
#include "render/draw/axis.h"
#include "render/stage/magnify.h"
#include "render/stage/stage_key.h"
#include "render/stage/stage_view.h"
#include "sim/chain/system.h"

/* In units of the type's size: between entries, from a sample to its word, radius of a ball; width and height of the scale. */
static const double between = 1.1, to_word = 0.3, ball = 0.36, scale_width = 4, scale_height = 0.5;
enum { MOST_MATERIALS = 6 };

enum bead_field bead_stage_field(const struct bead_view_setup *setup)
{
    return bead_chain_spec(setup->chain)->system->has_contacts ? BEAD_FIELD_CONTACT_FORCE : setup->field;
}

/* The largest static force of a chain's contacts: on a tilt they rise towards the wall. */
static double static_force(const struct bead_chain *chain)
{
    const size_t contacts = bead_chain_spec(chain)->system->has_contacts ? bead_chain_contacts(chain) : 0;
    return contacts > 0 ? bead_chain_static_force(chain)[contacts - 1] : 0;
}

double bead_stage_full(const struct bead_view_setup *setup)
{
    const bool force = setup->field == BEAD_FIELD_FORCE || setup->field == BEAD_FIELD_CONTACT_FORCE;
    if (force || !bead_chain_spec(setup->chain)->system->has_contacts) {
        const double most = fmax(fabs(setup->colours.low), fabs(setup->colours.high)), rest = static_force(setup->chain);
        return most > rest ? most - rest : most;
    }
    const struct bead_law_spec *spec = &bead_chain_spec(setup->chain)->law;
    const double compression = bead_compression_scale(setup->chain);
    return compression > 0 ? spec->row->force(bead_chain_stiffness(setup->chain)[0], spec, compression) : 0;
}

struct key {
    cairo_t *cr; /* NULL: measures only */
    struct bead_text_style style;
    double right, middle; /* the key's next entry ends here */
    bool used;            /* it has entries */
};

/* Adds a word at the right end of the remaining room. */
static void add_word(struct key *key, const char *plain)
{
    char markup[300];
    double width, height;
    bead_text_escape(plain, markup, sizeof markup);
    bead_text_size(key->cr, &key->style, markup, &width, &height);
    if (key->cr)
        bead_text_draw(key->cr, &key->style, key->right, key->middle, markup);
    key->right -= width;
}

/* `size`: its radius in units of the largest. */
static void add_ball(struct key *key, const double colour[3], double size)
{
    const double r = ball * key->style.size * fmax(0.5, size), x = key->right - to_word * key->style.size - r;
    key->right = x - r;
    if (!key->cr)
        return;
    cairo_pattern_t *shades = cairo_pattern_create_radial(x - 0.3 * r, key->middle - 0.4 * r, 0.1 * r, x, key->middle, r);
    cairo_pattern_add_color_stop_rgb(shades, 0, fmin(1, 1.15 * colour[0]), fmin(1, 1.15 * colour[1]), fmin(1, 1.15 * colour[2]));
    cairo_pattern_add_color_stop_rgb(shades, 1, 0.75 * colour[0], 0.75 * colour[1], 0.75 * colour[2]);
    cairo_set_source(key->cr, shades);
    cairo_arc(key->cr, x, key->middle, r, 0, 2 * M_PI);
    cairo_fill(key->cr);
    cairo_pattern_destroy(shades);
}

/* Adds the materials of a chain's shown beads to those found, in their order along the chain; returns their number, or
 * MOST_MATERIALS + 1 if there are too many to tell apart by colour. */
static size_t find_materials(const struct bead_chain *chain, struct bead_span beads, size_t *found, size_t count)
{
    const size_t *material = bead_chain_material(chain);
    for (size_t i = beads.first; material && i <= beads.last && i < bead_chain_beads(chain) && count <= MOST_MATERIALS; i++) {
        size_t k = 0;
        found[count] = bead_chain_scene(chain)->materials[material[i]].of;
        while (found[k] != found[count])
            k++;
        count += k == count;
    }
    return count;
}

/* Does a chain have only materials of an earlier one? */
static bool named_before(const struct bead_chain *const *chains, size_t chain)
{
    const struct bead_span all = {0, SIZE_MAX};
    size_t found[MOST_MATERIALS + 1];
    bool named = false;
    for (size_t i = 0; i < chain && !named; i++) {
        const size_t count = find_materials(chains[i], all, found, 0);
        named = count <= MOST_MATERIALS && find_materials(chains[chain], all, found, count) == count;
    }
    return named;
}

unsigned bead_stage_key_elsewhere(const struct bead_chain *const *chains, size_t count, size_t chain)
{
    size_t lit = count - 1;
    while (lit > 0 && !named_before(chains, lit))
        lit--;
    return (chain != lit ? BEAD_KEY_LIGHT : 0u) | (named_before(chains, chain) ? BEAD_KEY_MATERIALS : 0u);
}

static void add_materials(struct key *key, const struct bead_view_setup *setup, const struct bead_chain *const *chains, size_t n)
{
    const struct bead_scene *scene = bead_chain_scene(setup->chain);
    size_t found[MOST_MATERIALS + 1], count = 0;
    double largest = 0;
    for (size_t i = 0; i < n; i++)
        count = find_materials(chains[i], setup->beads, found, count);
    if (count > MOST_MATERIALS)
        return;
    for (size_t k = 0; k < count; k++)
        largest = fmax(largest, scene->materials[found[k]].radius);
    while (count-- > 0) {
        key->right -= key->used ? between * key->style.size : 0;
        key->used = true;
        add_word(key, scene->materials[found[count]].label);
        add_ball(key, scene->materials[found[count]].colour, scene->materials[found[count]].radius / largest);
    }
}

/* Adds a scale from no light to full light, as on a bead beside the contact. */
static void add_scale(struct key *key, const struct bead_view_setup *setup, double full)
{
    const struct bead_field_info *info = bead_chain_field(setup->chain, bead_stage_field(setup));
    const double width = scale_width * key->style.size, height = scale_height * key->style.size;
    char words[64];
    bead_quantity(full, info->unit, 2, words, sizeof words);
    add_word(key, words);
    key->right -= to_word * key->style.size;
    if (key->cr) {
        cairo_pattern_t *scale = cairo_pattern_create_linear(key->right - width, 0, key->right, 0);
        for (int i = 0; i <= 16; i++) {
            float light[3];
            bead_stage_glow(i / 16.0, light);
            cairo_pattern_add_color_stop_rgb(scale, i / 16.0, bead_stage_shown(0.05 + light[0]), bead_stage_shown(0.05 + light[1]),
                                             bead_stage_shown(0.06 + light[2]));
        }
        cairo_set_source(key->cr, scale);
        cairo_rectangle(key->cr, key->right - width, key->middle - 0.5 * height, width, height);
        cairo_fill(key->cr);
        cairo_pattern_destroy(scale);
    }
    key->right -= width + to_word * key->style.size;
    if (setup->elsewhere & BEAD_KEY_QUANTITY)
        snprintf(words, sizeof words, "light 0");
    else if (static_force(setup->chain) > 0)
        snprintf(words, sizeof words, "light: force above rest  0");
    else
        snprintf(words, sizeof words, "light: %s  0",
                 setup->light == BEAD_LIGHT_BEADS && info->of_contacts ? bead_field_info(BEAD_FIELD_FORCE)->title : info->title);
    add_word(key, words);
}

double bead_stage_draw_key_of(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_chain *const *chains, size_t n,
                              double right, double middle, double size)
{
    const struct bead_look *look = setup->look;
    struct key key = {
        .cr = cr,
        .style = {.family = look->family, .size = size, .colour = look->ink, .across = BEAD_ALIGN_END, .down = BEAD_ALIGN_MIDDLE},
        .right = right,
        .middle = middle};
    const double full = bead_stage_full(setup);
    if (setup->light != BEAD_LIGHT_NONE && !(setup->elsewhere & BEAD_KEY_LIGHT) && full > 0)
        add_scale(&key, setup, full);
    key.used = key.right < right;
    if (bead_chain_spec(setup->chain)->system->has_contacts && !(setup->elsewhere & BEAD_KEY_MATERIALS))
        add_materials(&key, setup, chains, n);
    return right - key.right;
}

/* ---- which of several waves the window follows ---- */

/* Waves that begin at a bead: two, in both directions, except at the ends. */
static size_t waves_at(size_t bead, size_t beads)
{
    return bead > 0 && bead + 1 < beads ? 2 : 1;
}

/* Waves that the scene starts. Neighbours start one. */
static size_t count_waves(const struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const size_t beads = bead_chain_beads(chain);
    size_t count = 0, next = 0; /* next: the bead after the last that moves */
    if (spec->striker_velocity != 0)
        count = next = 1;
    if (spec->drive.displacement || spec->drive.force)
        count += waves_at(spec->drive.bead, beads);
    for (size_t i = 0; i < spec->start_count; i++) {
        const struct bead_start *start = &spec->starts[i];
        if (start->velocity == 0 && start->displacement == 0)
            continue;
        count += next > 0 && start->bead <= next ? 0 : waves_at(start->bead, beads);
        next = start->bead + 1;
    }
    return count;
}

/* Draws the words about this, left of the rest of the key; returns their width, 0 if there is only one wave. */
static double draw_followed(cairo_t *cr, const struct bead_view_setup *setup, double right, double middle)
{
    const struct bead_look *look = setup->look;
    const struct bead_chain_spec *spec = bead_chain_spec(setup->chain);
    struct key key = {.cr = cr,
                      .style = {.family = look->family,
                                .size = look->tick,
                                .colour = look->accent,
                                .across = BEAD_ALIGN_END,
                                .down = BEAD_ALIGN_MIDDLE},
                      .right = right - between * look->tick,
                      .middle = middle};
    if (!spec->system->has_contacts || count_waves(setup->chain) < 2)
        return 0;
    add_word(&key, spec->striker_velocity != 0 ? "window: striker's wave" : "window: one wave");
    return right - key.right;
}

double bead_stage_key_room(const struct bead_view_setup *setup)
{
    if (!setup->axes)
        return 0;
    return bead_stage_draw_key_of(NULL, setup, &setup->chain, 1, 0, 0, setup->look->tick) + draw_followed(NULL, setup, 0, 0);
}

void bead_stage_draw_key(const struct bead_view *v, cairo_t *cr)
{
    const double right = v->strip.x + v->strip.width - 0.5 * v->look.tick, middle = v->strip.y + 0.75 * v->look.label;
    const double followed = v->camera.width > 0 ? draw_followed(NULL, &v->setup, 0, 0) : 0, most = v->strip.width - v->look.tick;
    for (int materials = 1; materials >= 0; materials--) {
        if (bead_stage_draw_key_of(NULL, &v->setup, &v->setup.chain, (size_t)materials, 0, 0, v->look.tick) + followed > most)
            continue;
        const double used = bead_stage_draw_key_of(cr, &v->setup, &v->setup.chain, (size_t)materials, right, middle, v->look.tick);
        if (followed > 0)
            draw_followed(cr, &v->setup, right - used, middle);
        return;
    }
}
