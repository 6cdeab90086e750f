/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Everything around the views: the colour bar and, updated after the views, the time, the line about the horizon and the
 * caption. */
#include <math.h>

#include "render/draw/words.h"
#include "render/movie/composer_private.h"
#include "render/stage/panel.h"
#include "render/view/horizon.h"

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
    struct bead_text_style style = bead_words_style(&c->look, c->look.label, c->look.ink, BEAD_ALIGN_MIDDLE);
    style.across = lies ? BEAD_ALIGN_END : BEAD_ALIGN_START;
    if (bar->width == 0)
        return;
    bead_composer_bar_title(c, markup, sizeof markup);
    bead_text_draw(cr, &style, lies ? title->x + title->width : title->x,
                   lies ? bar->y + 0.5 * bar->height : title->y + 0.5 * title->height, markup);
    if (lies)
        bead_colour_bar_draw_lying(cr, &c->look, &c->colours, field->unit, *bar, c->setup.range.over, c->setup.range.under);
    else
        bead_colour_bar_draw(cr, &c->look, &c->colours, field->unit, NULL, *bar, c->setup.range.over, c->setup.range.under);
}

/* Restores the background of a rectangle, and limits drawing to it. */
static void overlay_begin(struct bead_composer *c, struct bead_rect rect)
{
    cairo_surface_flush(c->surface);
    bead_frame_copy(&c->frame, &c->background, rect);
    cairo_surface_mark_dirty(c->surface);
    cairo_save(c->cr);
    cairo_rectangle(c->cr, rect.x, rect.y, rect.width, rect.height);
    cairo_clip(c->cr);
}

static void overlay_end(struct bead_composer *c, struct bead_rect rect, struct bead_changes *changes)
{
    cairo_restore(c->cr);
    cairo_surface_flush(c->surface);
    bead_changes_add(changes, rect);
}

/* The current speed, if it has changed. */
static void overlay_badge(struct bead_composer *c, double time, struct bead_changes *changes)
{
    char text[sizeof c->badge_text];
    struct bead_rect rect = c->layout.badge;
    bead_badge_text(&c->facts, time, text, sizeof text);
    if (rect.width == 0 || strcmp(text, c->badge_text) == 0)
        return;
    snprintf(c->badge_text, sizeof c->badge_text, "%s", text);
    overlay_begin(c, rect);
    bead_badge_draw(c->cr, &c->look, text, rect);
    overlay_end(c, rect, changes);
}

/* Draws the part of the film that has passed as a line at the lower edge. */
void bead_overlay_progress(struct bead_composer *c, double time, struct bead_changes *changes)
{
    const struct bead_film_clock *film = c->setup.film;
    const double *ends = c->setup.time;
    double part = film->count ? bead_film_time(film, time) / bead_film_length(film) : (time - ends[0]) / (ends[1] - ends[0]);
    int passed = (int)lround(fmin(1, fmax(0, part)) * c->frame.width), height = (int)fmax(2, 2 * c->look.line);
    if (!c->layout.axes || passed <= c->passed)
        return;
    struct bead_rect rect = {c->passed, c->frame.height - height, passed - c->passed, height};
    overlay_begin(c, rect);
    cairo_set_source_rgb(c->cr, c->look.accent.r, c->look.accent.g, c->look.accent.b);
    cairo_paint(c->cr);
    overlay_end(c, rect, changes);
    c->passed = passed;
}

/* Redraws the time if its text has changed. */
void bead_overlay_time(struct bead_composer *c, double time, struct bead_changes *changes)
{
    char text[sizeof c->time_text];
    struct bead_rect rect = c->layout.time;
    overlay_badge(c, time, changes);
    bead_clock_text(&c->clock, time, &c->look, text, sizeof text);
    if (rect.width == 0 || strcmp(text, c->time_text) == 0)
        return;
    snprintf(c->time_text, sizeof c->time_text, "%s", text);
    struct bead_text_style style = bead_clock_style(&c->look);
    overlay_begin(c, rect);
    bead_text_draw(c->cr, &style, rect.x, rect.y + 0.5 * rect.height, text);
    overlay_end(c, rect, changes);
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
    overlay_begin(c, rect);
    bead_trust_draw(c->cr, &c->look, &trust, rect, !c->layout.words_left);
    overlay_end(c, rect, changes);
    c->trust_said = true;
}

void bead_overlay_caption(struct bead_composer *c, double time, struct bead_changes *changes)
{
    struct bead_rect rect = c->layout.caption;
    size_t now = bead_captions_find(&c->setup.output->movie, c->setup.film, time + 1e-6 * c->setup.step);
    if (rect.width == 0 || now == c->caption)
        return;
    c->caption = now;
    overlay_begin(c, rect);
    if (now < c->setup.output->movie.caption_count)
        bead_caption_draw(c->cr, &c->look, c->setup.output->movie.captions[now].text, rect);
    overlay_end(c, rect, changes);
}
