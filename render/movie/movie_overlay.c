/* What changes around the views: time, line about the horizon, caption, ends of the colour bar. The composer updates it after the
 * views. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "render/movie/captions.h"
#include "render/movie/composer_private.h"
#include "render/view/trust_words.h"

void bead_overlay_draw_bar(struct bead_composer *c, cairo_t *cr)
{
    const struct bead_field_info *field = bead_chain_field(c->setup.chains[0], c->setup.output->shown.field);
    if (c->layout.bar.width > 0)
        bead_colour_bar_draw(cr, &c->look, &c->colours, field->unit, field->title, c->layout.bar, c->bar_over, c->bar_under);
}

/* The bar gets pointed ends once values beyond its range have appeared. */
void bead_overlay_bar(struct bead_composer *c, struct bead_changes *changes)
{
    const struct bead_rect *bar = &c->layout.bar;
    if (bar->width == 0 || (c->over == c->bar_over && c->under == c->bar_under))
        return;
    c->bar_over = c->over;
    c->bar_under = c->under;
    int pad = 2 * bar->width, x = bar->x - bar->width / 2, y = bar->y - pad > 0 ? bar->y - pad : 0;
    int bottom = bar->y + bar->height + pad < c->frame.height ? bar->y + bar->height + pad : c->frame.height;
    struct bead_rect rect = {x, y, c->frame.width - x, bottom - y};
    cairo_save(c->cr);
    cairo_rectangle(c->cr, rect.x, rect.y, rect.width, rect.height);
    cairo_clip(c->cr);
    cairo_set_source_rgb(c->cr, c->look.background.r, c->look.background.g, c->look.background.b);
    cairo_paint(c->cr);
    bead_overlay_draw_bar(c, c->cr);
    cairo_restore(c->cr);
    cairo_surface_flush(c->surface);
    bead_frame_copy(&c->background, &c->frame, rect);
    bead_changes_add(changes, rect);
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
            trust.chain = c->wants.chain_count > 1 ? bead_chain_name(c->setup.chains[i / c->wants.view_count]) : "";
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
    bead_trust_draw(c->cr, &c->look, &trust, rect, rect.x > c->layout.time.x);
    cairo_restore(c->cr);
    cairo_surface_flush(c->surface);
    bead_changes_add(changes, rect);
    c->trust_said = true;
}

void bead_overlay_caption(struct bead_composer *c, double time, struct bead_changes *changes)
{
    struct bead_rect rect = c->layout.caption;
    size_t now = bead_captions_find(&c->setup.output->movie, c->slowed, time + 1e-6 * c->setup.step);
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
