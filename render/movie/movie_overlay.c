/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What changes around the views: time, line about the horizon, caption; and the colour bar. The composer updates it after the
 * views. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "render/draw/names.h"
#include "render/movie/captions.h"
#include "render/movie/composer_private.h"
#include "render/view/panel.h"
#include "render/view/trust_words.h"

void bead_composer_bar_title(const struct bead_composer *c, char *out, size_t size)
{
    const struct bead_field_info *field = bead_chain_field(c->setup.chains[0], c->setup.output->shown.field);
    struct bead_axis axis;
    bead_axis_make(&axis, c->colours.low, c->colours.high, field->unit, c->colours.scale, c->setup.height, c->look.tick, false);
    bead_axis_title(&axis, bead_field_short(field), out, size);
}

void bead_overlay_draw_bar(struct bead_composer *c, cairo_t *cr)
{
    const struct bead_field_info *field = bead_chain_field(c->setup.chains[0], c->setup.output->shown.field);
    const struct bead_rect *bar = &c->layout.bar, *title = &c->layout.bar_title;
    bool lies = bar->width > bar->height;
    char markup[256];
    struct bead_text_style style = {.family = c->look.family,
                                    .size = c->look.label,
                                    .colour = c->look.ink,
                                    .across = lies ? BEAD_ALIGN_END : BEAD_ALIGN_START,
                                    .down = BEAD_ALIGN_MIDDLE};
    if (bar->width == 0)
        return;
    bead_composer_bar_title(c, markup, sizeof markup);
    bead_text_draw(cr, &style, lies ? title->x + title->width : title->x,
                   lies ? bar->y + 0.5 * bar->height : title->y + 0.5 * title->height, markup);
    if (lies)
        bead_colour_bar_draw_lying(cr, &c->look, &c->colours, field->unit, *bar, c->setup.over, c->setup.under);
    else
        bead_colour_bar_draw(cr, &c->look, &c->colours, field->unit, NULL, *bar, c->setup.over, c->setup.under);
}

/* Redraws the time if its text has changed. */
void bead_overlay_time(struct bead_composer *c, double time, struct bead_changes *changes)
{
    char text[sizeof c->time_text];
    struct bead_rect rect = c->layout.time;
    bead_clock_text(&c->clock, time, &c->look, text, sizeof text);
    if (rect.width == 0 || strcmp(text, c->time_text) == 0)
        return;
    snprintf(c->time_text, sizeof c->time_text, "%s", text);
    cairo_surface_flush(c->surface);
    bead_frame_copy(&c->frame, &c->background, rect);
    cairo_surface_mark_dirty(c->surface);
    struct bead_text_style style = bead_clock_style(&c->look);
    cairo_save(c->cr);
    cairo_rectangle(c->cr, rect.x, rect.y, rect.width, rect.height);
    cairo_clip(c->cr);
    bead_text_draw(c->cr, &style, rect.x, rect.y + 0.5 * rect.height, text);
    cairo_restore(c->cr);
    cairo_surface_flush(c->surface);
    bead_changes_add(changes, rect);
}

/* Finds the earliest horizon drawn so far, and its chain. */
static struct bead_trust find_trust(const struct bead_composer *c)
{
    struct bead_trust trust = bead_trust_make(c->setup.chains[0], c->setup.tolerance_factor);
    trust.from = c->setup.time[0];
    trust.bold = true;
    for (size_t i = 0; i < c->wants.chain_count * c->wants.view_count; i++) {
        const struct bead_view_type *type = c->wants.views[i % c->wants.view_count];
        double horizon = type->horizon ? type->horizon(c->views[i]) : INFINITY;
        if (horizon < trust.until) {
            trust.until = horizon;
            trust.chain = c->wants.chain_count > 1 ? bead_chain_title(c->setup.chains[i / c->wants.view_count]) : "";
        }
    }
    return trust;
}

/* Shows the line about the horizon once the horizon is reached, or at the end if it never is. */
void bead_overlay_trust(struct bead_composer *c, double time, struct bead_changes *changes)
{
    struct bead_rect rect = c->layout.trust;
    if (c->trust_said || rect.width == 0)
        return;
    struct bead_trust trust = find_trust(c);
    if (!isfinite(trust.until) && time < c->setup.time[1])
        return;
    cairo_save(c->cr);
    cairo_rectangle(c->cr, rect.x, rect.y, rect.width, rect.height);
    cairo_clip(c->cr);
    bead_trust_draw(c->cr, &c->look, &trust, rect, !c->layout.words_left);
    cairo_restore(c->cr);
    cairo_surface_flush(c->surface);
    bead_changes_add(changes, rect);
    c->trust_said = true;
}

void bead_overlay_caption(struct bead_composer *c, double time, struct bead_changes *changes)
{
    struct bead_rect rect = c->layout.caption;
    size_t now = bead_captions_find(&c->setup.output->movie, c->setup.film, time + 1e-6 * c->setup.step);
    if (rect.width == 0 || now == c->caption)
        return;
    c->caption = now;
    cairo_surface_flush(c->surface);
    bead_frame_copy(&c->frame, &c->background, rect);
    cairo_surface_mark_dirty(c->surface);
    if (now < c->setup.output->movie.caption_count)
        bead_caption_draw(c->cr, &c->look, c->setup.output->movie.captions[now].text, rect);
    cairo_surface_flush(c->surface);
    bead_changes_add(changes, rect);
}
