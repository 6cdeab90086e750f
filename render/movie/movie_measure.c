/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of creating a composer: measures axes, words and captions before the layout; after it, makes the cameras of a movie that
 * follows the front (windows of one length) and the widths of their plots. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/looks.h"
#include "render/draw/words.h"
#include "render/movie/composer_private.h"
#include "render/movie/movie_stage.h"
#include "render/stage/along.h"
#include "render/stage/camera.h"
#include "render/stage/panel.h"
#include "render/stage/stage_key.h"
#include "render/view/views.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"
#include "sim/kinds/view_kinds.h"

/* The most by which a title below vertical axes widens their margin, in units of the font size. */
static const double most_wider = 1.2;

/* px that an axis extends out of a plot. */
static double reach(const struct bead_look *look, const double range[2], const char *unit, enum bead_scale scale, double length,
                    enum bead_side side, const char *title)
{
    struct bead_axis axis;
    struct bead_rect plot = {0, 0, (int)length, (int)length};
    bead_axis_make(&axis, range[0], range[1], unit, scale, length, look->tick, side == BEAD_SIDE_BOTTOM);
    return bead_axis_draw(NULL, look, &axis, plot, side, false, true, title);
}

/* Titles of horizontal axes go to the left if they widen the margin only a little, and always if numbers move. */
static void reserve_name(struct bead_composer *c, const char *title)
{
    double room = bead_panel_name_room(&c->look, title);
    c->name_left = c->name_left && (c->wants.follow || room <= c->wants.left + most_wider * c->look.tick);
    c->wants.left = c->name_left ? fmax(c->wants.left, room) : c->wants.left;
}

/* Do plots tell of contacts, not of beads? */
static bool of_contacts(const struct bead_composer *c)
{
    return bead_field_info(c->setup.output->shown.field)->of_contacts;
}

static double reach_along(struct bead_composer *c, size_t chain, double length)
{
    struct bead_axis axis;
    struct bead_rect plot = {0, 0, (int)length, (int)length};
    size_t last = bead_composer_span(c, chain).last;
    const char *title = bead_axis_along_chain(&axis, c->setup.chains[chain], of_contacts(c), 0, last, length, c->look.tick, true);
    reserve_name(c, title);
    return bead_axis_draw(NULL, &c->look, &axis, plot, BEAD_SIDE_BOTTOM, false, true, c->name_left ? NULL : title);
}

/* The vertical axis of an image: time, or the chains. */
static double reach_left_of_image(const struct bead_composer *c, double length)
{
    double most = 0;
    struct bead_rect plot = {0, 0, (int)length, (int)length};
    if (c->wants.orientation == BEAD_TIME_DOWN)
        return reach(&c->look, c->setup.time, bead_chain_time_unit(c->setup.chains[0]), BEAD_SCALE_LINEAR, length, BEAD_SIDE_LEFT,
                     NULL);
    for (size_t i = 0; i < c->wants.chain_count; i++) {
        struct bead_axis axis;
        struct bead_span span = bead_composer_span(c, i);
        (void)bead_axis_along_chain(&axis, c->setup.chains[i], of_contacts(c), span.first, span.last, length, c->look.tick, false);
        most = fmax(most, bead_axis_draw(NULL, &c->look, &axis, plot, BEAD_SIDE_LEFT, false, true, NULL));
    }
    return most;
}

/* The vertical axis of a view in a plot of this height. */
static double reach_left_of(const struct bead_composer *c, const struct bead_view_info *view, double length)
{
    const struct bead_field_info *field = bead_chain_field(c->setup.chains[0], c->setup.output->shown.field);
    enum bead_scale scale = c->colours.scale == BEAD_SCALE_LOG ? BEAD_SCALE_LOG : BEAD_SCALE_LINEAR;
    if (view->traits & BEAD_SHOWS_BEADS)
        return 0;
    if (view->traits & BEAD_SHOWS_IMAGE)
        return reach_left_of_image(c, length);
    if (view->across == BEAD_ACROSS_MODES)
        return reach(&c->look, (const double[]){0, 1}, "", BEAD_SCALE_LINEAR, length, BEAD_SIDE_LEFT, NULL);
    return reach(&c->look, (const double[]){c->colours.low, c->colours.high}, field->unit, scale, length, BEAD_SIDE_LEFT, NULL);
}

/* Vertical axes of plots of several heights, for views with any of these traits, or all (0); the title is above them. */
static double reach_left(const struct bead_composer *c, unsigned traits)
{
    static const double parts[] = {0.08, 0.16, 0.3, 0.6};
    double most = 0;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        for (size_t v = 0; v < c->wants.view_count; v++) {
            if (!traits || bead_view_has(c->wants.views[v], traits))
                most = fmax(most, reach_left_of(c, c->wants.views[v]->info, fmax(24, parts[i] * c->wants.height)));
        }
    }
    return most;
}

static void measure_bar(struct bead_composer *c)
{
    struct bead_movie_wants *w = &c->wants;
    const struct bead_field_info *field = bead_chain_field(c->setup.chains[0], c->setup.output->shown.field);
    struct bead_rect standing = {0, 0, 20, (int)(0.6 * w->height)}, lying = {0, 0, (int)(0.4 * w->width), 20};
    char markup[256];
    struct bead_text_style style = bead_words_style(&c->look, c->look.label, c->look.ink, BEAD_ALIGN_MIDDLE);
    w->bar = bead_colour_bar_draw(NULL, &c->look, &c->colours, field->unit, NULL, standing, false, false);
    w->bar_below = bead_colour_bar_draw_lying(NULL, &c->look, &c->colours, field->unit, lying, false, false);
    bead_composer_bar_title(c, markup, sizeof markup);
    w->bar_title = ceil(bead_words_width(NULL, &style, markup) + 1);
}

/* Between a heading and the key beside it, in units of the labels' size. */
static const double air_before_key = 0.5;

static struct bead_view_setup key_setup(const struct bead_composer *c, size_t chain)
{
    const struct bead_output *output = c->setup.output;
    return (struct bead_view_setup){.chain = c->setup.chains[chain],
                                    .chain_index = chain,
                                    .field = output->shown.field,
                                    .beads = bead_composer_span(c, chain),
                                    .colours = c->colours,
                                    .look = &c->look,
                                    .axes = true,
                                    .light = output->views.light};
}

double bead_composer_key(const struct bead_composer *c, size_t chain)
{
    struct bead_view_setup setup = key_setup(c, chain);
    setup.elsewhere = bead_stage_key_elsewhere(c->setup.chains, c->setup.chain_count, chain);
    const bool here = bead_views_any(&c->setup.output->views, BEAD_ACTS) && c->layout.key.width == 0;
    const double key = here ? bead_stage_key_room(&setup) : 0;
    return key > 0 ? key + air_before_key * c->look.label : 0;
}

/* A line of the key for all chains, without the parts elsewhere; with `cr` NULL it is only measured. Returns its width. */
static double key_line(const struct bead_composer *c, cairo_t *cr, unsigned elsewhere, double right, double middle, double size)
{
    struct bead_view_setup setup = key_setup(c, 0);
    setup.elsewhere = elsewhere;
    return bead_stage_draw_key_of(cr, &setup, c->setup.chains, c->setup.chain_count, right, middle, size);
}

void bead_composer_draw_key(const struct bead_composer *c, cairo_t *cr)
{
    static const unsigned elsewhere[3][2] = {{0}, {BEAD_KEY_QUANTITY}, {BEAD_KEY_LIGHT, BEAD_KEY_MATERIALS}};
    const struct bead_movie_wants *w = &c->wants;
    const struct bead_rect *key = &c->layout.key;
    const int lines = key->width > 0 ? bead_stage_key_lines(w) : 0, kind = lines == 2 ? 2 : bead_stage_key_brief(w);
    const double widths[] = {w->key_width, w->key_brief, w->key_part}, part = fmin(1, key->width / fmax(1, widths[kind])),
                 size = part * c->look.tick;
    for (int i = 0; i < lines; i++) {
        const unsigned but = elsewhere[kind][i];
        const double width = key_line(c, NULL, but, 0, 0, size);
        (void)key_line(c, cr, but, key->x + width, key->y + (i + 0.5) * key->height / lines, size);
    }
}

static void measure_words(struct bead_composer *c)
{
    struct bead_movie_wants *w = &c->wants;
    char text[2048];
    struct bead_text_style style = bead_clock_style(&c->look);
    bead_clock_text(&c->clock, c->setup.time[1], &c->look, text, sizeof text);
    w->time_width = ceil(bead_words_width(NULL, &style, text) + 0.5 * c->look.gap);
    for (size_t i = 0; i < w->chain_count; i++) {
        w->heading_width = fmax(w->heading_width, bead_heading_width(&c->look, c->setup.chains[i]));
        w->label_width = fmax(w->label_width, bead_label_width(&c->look, c->setup.chains[i]));
        w->heading_least = fmax(w->heading_least, bead_heading_least(&c->look, c->setup.chains[i], true));
        w->keyed_heading = fmax(w->keyed_heading, bead_heading_least(&c->look, c->setup.chains[i], true) + bead_composer_key(c, i));
    }
    if (bead_views_any(&c->setup.output->views, BEAD_ACTS)) {
        const double size = c->look.tick;
        w->key_width = key_line(c, NULL, 0, 0, 0, size);
        w->key_brief = key_line(c, NULL, BEAD_KEY_QUANTITY, 0, 0, size);
        w->key_part = fmax(key_line(c, NULL, BEAD_KEY_LIGHT, 0, 0, size), key_line(c, NULL, BEAD_KEY_MATERIALS, 0, 0, size));
        c->facts.keyed = bead_stage_keyed(w) || bead_stage_key_lines(w) > 0;
    }
    w->badge_width = bead_badge_width(&c->look, &c->facts);
    w->facts = &c->facts;
    if (!c->setup.title || !c->setup.title[0])
        return;
    style.size = c->look.label;
    style.bold = true;
    bead_text_escape(c->setup.title, text, sizeof text);
    w->title_width = ceil(bead_words_width(NULL, &style, text) + 1);
}

/* The distance of beads in the widest chain, and beads in a window that moves. */
static void measure_beads(struct bead_composer *c)
{
    struct bead_movie_wants *w = &c->wants;
    const bool drawn = bead_views_any(&c->setup.output->views, BEAD_SHOWS_BEADS);
    const struct bead_view_setup first = {.chain = c->setup.chains[0], .beads = bead_composer_span(c, 0), .over_beads = drawn};
    w->same_beads = true;
    for (size_t i = 0; i < w->chain_count; i++) {
        const struct bead_chain *chain = c->setup.chains[i];
        const struct bead_chain_spec *spec = bead_chain_spec(chain);
        const struct bead_span beads = bead_composer_beads(c, i);
        const struct bead_view_setup setup = {.chain = chain, .beads = bead_composer_span(c, i)};
        double radius, spacing = bead_chain_spacing(chain, beads, &radius);
        size_t count = beads.last - beads.first + 1;
        double shown = fmin((double)c->setup.output->movie.window, (double)count);
        w->same_beads = w->same_beads && bead_along_alike(&first, &setup);
        w->beads = count > w->beads ? count : w->beads;
        w->striker = w->striker || (beads.first == 0 && spec->system->has_striker);
        w->wall = w->wall || (beads.last + 1 == bead_chain_beads(chain) && spec->wall != BEAD_WALL_NONE);
        w->bead_height = fmax(w->bead_height, 0.9 * w->width * 2 * radius / (spacing * shown));
    }
}

/* Widths of the plots to measure, as parts of the frame's width. */
static const double parts[] = {0.9, 0.4, 0.2};

/* px by which numbers extend beyond the right end of an axis along a chain. */
static double measure_along_end(const struct bead_composer *c, size_t chain)
{
    struct bead_axis axis;
    struct bead_text_style style = bead_words_style(&c->look, c->look.tick, c->look.ink, BEAD_ALIGN_MIDDLE);
    const struct bead_span span = bead_composer_span(c, chain);
    double most = 0;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const double length = parts[i] * c->wants.width;
        bead_axis_along_chain(&axis, c->setup.chains[chain], false, span.first, span.last, length, c->look.tick, true);
        for (size_t k = 0; k < axis.count; k++)
            most = fmax(most, (axis.ticks[k].place - 1) * length + 0.5 * bead_words_width(NULL, &style, axis.ticks[k].label));
    }
    return most;
}

/* Half of the longest number at an axis of time, in plots of several widths. */
static double measure_time_end(const struct bead_composer *c)
{
    struct bead_axis axis;
    struct bead_text_style style = bead_words_style(&c->look, c->look.tick, c->look.ink, BEAD_ALIGN_MIDDLE);
    double most = 0;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        bead_axis_make(&axis, c->setup.time[0], c->setup.time[1], bead_chain_time_unit(c->setup.chains[0]), BEAD_SCALE_LINEAR,
                       parts[i] * c->wants.width, c->look.tick, true);
        for (size_t k = 0; k < axis.count; k++)
            most = fmax(most, bead_words_width(NULL, &style, axis.ticks[k].label));
    }
    return 0.5 * most;
}

/* The titles above images, and the name beside the first. */
static void measure_names(struct bead_composer *c)
{
    const struct bead_chain *chain = c->setup.chains[0];
    const struct bead_text_style style = bead_words_style(&c->look, c->look.label, c->look.ink, BEAD_ALIGN_MIDDLE);
    struct bead_axis time;
    char both[128], markup[2200];
    bead_axis_make(&time, c->setup.time[0], c->setup.time[1], bead_chain_time_unit(chain), BEAD_SCALE_LINEAR, 100, c->look.tick,
                   true);
    snprintf(both, sizeof both, BEAD_PANEL_AGAINST, bead_chain_axis(chain, of_contacts(c)).title);
    bead_axis_title(&time, both, markup, sizeof markup);
    c->wants.against = bead_words_width(NULL, &style, markup);
    c->wants.along = bead_words_width(NULL, &style, bead_chain_axis(chain, of_contacts(c)).title);
    c->wants.name_least = bead_name_least(&c->look, chain);
}

static void measure_axes(struct bead_composer *c)
{
    struct bead_movie_wants *w = &c->wants;
    const char *unit = bead_chain_time_unit(c->setup.chains[0]);
    static const double numbers[] = {0, 1};
    const double length = 0.9 * w->width;
    w->left = reach_left(c, 0);
    w->image_left = reach_left(c, BEAD_SHOWS_IMAGE);
    c->name_left = true;
    if (bead_views_any(&c->setup.output->views, BEAD_SHOWS_MODES))
        reserve_name(c, "mode");
    for (size_t i = 0; i < w->chain_count; i++) {
        w->below_beads = fmax(w->below_beads, reach_along(c, i, length));
        w->along_end = fmax(w->along_end, measure_along_end(c, i));
    }
    w->below_numbers = reach(&c->look, numbers, "1", BEAD_SCALE_LINEAR, length, BEAD_SIDE_BOTTOM, NULL);
    w->time_end = measure_time_end(c);
    measure_names(c);
    w->below_time = reach(&c->look, c->setup.time, unit, BEAD_SCALE_LINEAR, length, BEAD_SIDE_BOTTOM, "time");
}

static enum bead_error find_views(struct bead_composer *c, struct bead_message *msg)
{
    const struct bead_output *output = c->setup.output;
    struct bead_movie_wants *w = &c->wants;
    for (size_t i = 0; i < output->views.count && i < BEAD_MOST_VIEWS; i++) {
        BEAD_TRY(bead_view_take(&output->views, i, &w->views[w->view_count++], msg));
    }
    if (w->view_count == 0)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: views: at least one is needed", output->path);
    w->colourless = !bead_views_any(&output->views, BEAD_SHOWS_COLOURS);
    return BEAD_OK;
}

/* Below a stage, where beads move on, images have time to the right, as in papers. */
static enum bead_orientation orientation_of(const struct bead_output *output)
{
    bool stage = output->movie.layout == BEAD_LAYOUT_AUTO || output->movie.layout == BEAD_LAYOUT_STAGE;
    if (output->views.orientation == BEAD_ORIENTATION_AUTO && stage && bead_views_any(&output->views, BEAD_ACTS))
        return BEAD_TIME_RIGHT;
    return bead_orientation_of(output);
}

static enum bead_error measure(struct bead_composer *c, struct bead_message *msg)
{
    const struct bead_output *output = c->setup.output;
    struct bead_movie_wants *w = &c->wants;
    *w = (struct bead_movie_wants){.width = c->setup.width,
                                   .height = c->setup.height,
                                   .look = &c->look,
                                   .orientation = orientation_of(output),
                                   .chain_count = c->setup.chain_count,
                                   .axes = output->views.axes,
                                   .trust = output->shown.trust,
                                   .inset = bead_inset_width(c),
                                   .follow = output->movie.follow == BEAD_FOLLOW_FRONT,
                                   .caption_lines = bead_captions_lines(&output->movie, &c->look, c->setup.width),
                                   .caption_line = bead_caption_height(&c->look)};
    BEAD_TRY(find_views(c, msg));
    for (size_t i = 0; i < w->chain_count; i++) {
        size_t sensors;
        (void)bead_chain_sensors(c->setup.chains[i], &sensors);
        w->sensors = w->sensors || sensors > 0;
        w->headings = w->headings || bead_heading_has(c->setup.chains[i]);
    }
    measure_beads(c);
    if (!w->axes)
        return BEAD_OK;
    measure_axes(c);
    measure_bar(c);
    measure_words(c);
    return BEAD_OK;
}

/* ---- the size of type ---- */

/* Type of the next try, as a part of the last one's. A choice: the result is at most 7 % smaller than necessary; values nearer to 1
 * take more tries, each of which measures all words. */
static const double smaller = 0.93;

void bead_composer_dress(struct bead_composer *c, double type)
{
    const struct bead_output *output = c->setup.output;
    bead_look_film(&c->look, c->setup.width, c->setup.height, output->paper.theme != BEAD_THEME_LIGHT,
                   output->movie.type == BEAD_TYPE_LARGE);
    bead_look_type(&c->look, type);
    bead_look_font(&c->look, output->paper.font);
    c->look.clear = output->paper.background == BEAD_BACKGROUND_NONE;
}

/* As in the layout, but also lacks names that would be cut. */
static enum bead_lack lacks(const struct bead_composer *c)
{
    bool named = true;
    for (size_t i = 0; i < c->layout.chain_count; i++) {
        const double room = c->layout.chains[i].heading.width;
        named = named && (room == 0 || bead_heading_least(&c->look, c->setup.chains[i], false) <= room);
    }
    return named || !c->wants.axes ? c->layout.lacks : BEAD_LACKS_WORDS;
}

static enum bead_error arrange(struct bead_composer *c, enum bead_layout layout, double type, struct bead_message *msg)
{
    bead_movie_layout_free(&c->layout);
    bead_composer_dress(c, type);
    BEAD_TRY(measure(c, msg));
    c->wants.layout = layout;
    return bead_movie_arrange(&c->wants, &c->layout, msg);
}

/* Refuses a layout that the scene names if another one would have room for all words. */
static enum bead_error refuse_layout(const struct bead_composer *c, struct bead_message *msg)
{
    return bead_output_wrong(
        c->setup.output, msg,
        "layout: %d x %d pixels have no room for the names and axes of %zu chains in this layout; leave it out, "
        "or use a larger size",
        c->setup.width, c->setup.height, c->wants.chain_count);
}

/* If words do not fit even without images, as in many columns on a phone, or no room is left for the images that the layout is
 * named for, type becomes smaller, as long as it can be read. Frames too small for that in any layout show less. */
enum bead_error bead_composer_arrange(struct bead_composer *c, struct bead_message *msg)
{
    const enum bead_layout asked = c->setup.output->movie.layout;
    const double least = fmin(1, bead_look_least_type(&c->look));
    double type = 1;
    BEAD_TRY(arrange(c, asked, type, msg));
    while (lacks(c) && type > least) {
        type = fmax(least, smaller * type);
        BEAD_TRY(arrange(c, asked, type, msg));
    }
    if (lacks(c) == BEAD_LACKS_IMAGES)
        return arrange(c, asked, 1, msg);
    if (lacks(c) < BEAD_LACKS_WORDS)
        return BEAD_OK;
    if (asked != BEAD_LAYOUT_AUTO) {
        BEAD_TRY(arrange(c, BEAD_LAYOUT_AUTO, least, msg));
        if (lacks(c) < BEAD_LACKS_WORDS)
            return refuse_layout(c, msg);
    }
    return arrange(c, asked, 1, msg);
}

/* ---- cameras ---- */

/* The width, px, available to windows of `width` m: beads with radii up to `largest` m must not be higher than their rows. */
static double window_room(const struct bead_composer *c, double width, double largest)
{
    double room = c->layout.chains[0].plot[0].width;
    for (size_t v = 0; v < c->wants.view_count; v++) {
        const struct bead_rect *plot = &c->layout.chains[0].plot[v];
        bool named = c->wants.sensors || c->layout.chains[0].labels[v];
        double names = named && plot->height > 2.6 * c->look.tick ? 1.35 * c->look.tick : 0;
        if (bead_view_has(c->wants.views[v], BEAD_SHOWS_BEADS))
            room = fmin(room, floor(0.9 * (plot->height - names) * width / (2 * largest)));
    }
    return room;
}

/* Makes views that follow the front no wider than `room`. */
static void narrow_moving(struct bead_composer *c, double room)
{
    for (size_t i = 0; i < c->wants.chain_count * c->wants.view_count; i++) {
        size_t view = i % c->wants.view_count;
        struct bead_rect *plot = &c->layout.chains[i / c->wants.view_count].plot[view];
        if (bead_view_has(c->wants.views[view], BEAD_FOLLOWS_FRONT))
            plot->width = (int)fmin(plot->width, fmax(room, 1));
    }
}

/* All windows have one length, so that all beads are drawn to one scale. If the beads would be higher than their rows, the windows
 * take less of the frame's width. */
enum bead_error bead_composer_cameras(struct bead_composer *c, struct bead_message *msg)
{
    size_t count = c->wants.chain_count;
    double width = 0, longest = 0, radius, largest = 0;
    BEAD_TRY(bead_new(&c->cameras, count, msg, "cameras"));
    for (size_t i = 0; i < count; i++) {
        struct bead_span beads = bead_composer_beads(c, i);
        double spacing = bead_chain_spacing(c->setup.chains[i], beads, &radius);
        width = fmax(width, spacing * (double)c->setup.output->movie.window);
        longest = fmax(longest, spacing * (double)(beads.last - beads.first + 1) + 3.2 * radius); /* with room at the ends */
        largest = fmax(largest, radius);
    }
    width = fmin(width, longest);
    narrow_moving(c, window_room(c, width, largest));
    for (size_t i = 0; i < count; i++)
        BEAD_TRY(bead_camera_create(c->setup.chains[i], bead_composer_beads(c, i), width, c->setup.time, &c->cameras[i], msg));
    return BEAD_OK;
}
