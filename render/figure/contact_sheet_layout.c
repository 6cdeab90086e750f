/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the configurations of a contact sheet, and their places. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/layout.h"
#include "render/draw/words.h"
#include "render/figure/contact_sheet.h"
#include "sim/base/memory.h"

/* In units of the numbers' font size: the preferred and the smallest size of a picture, and the heights of the parts above and
 * below it. */
static const double wanted_width = 11.5, wanted_height = 5.8, least_width = 6, least_height = 2.5;
static const double spins_height = 0.55, spins_gap = 0.22, words_height = 3.3, between = 1.1;

/* ---- rows ---- */

static size_t groups_of(const struct bead_sweep_panel *panel)
{
    const struct bead_sweep_spec *spec = panel->spec;
    return spec->spins || spec->own_magnetism ? 1 : spec->group_count;
}

/* The number of a group's first configuration. */
static size_t group_first(const struct bead_sweep_spec *spec, size_t group)
{
    size_t first = 0;
    for (size_t g = 0; g < group; g++)
        first += spec->groups[g].configurations;
    return first;
}

static size_t nearest_group(const struct bead_sweep_spec *spec, double magnetism)
{
    size_t nearest = 0;
    for (size_t g = 1; g < spec->group_count; g++) {
        if (fabs(spec->groups[g].magnetism - magnetism) < fabs(spec->groups[nearest].magnetism - magnetism))
            nearest = g;
    }
    return nearest;
}

static void add_row(struct contact_sheet *s, size_t panel, size_t first, size_t count, double magnetism)
{
    size_t shown = count < s->columns ? count : s->columns;
    s->rows[s->row_count++] = (struct contact_row){panel, first, shown, magnetism};
    s->image_count += shown;
}

/* The number of values of a sweep's last key, in which successive configurations differ; 0: the sweep is not over keys. */
static size_t last_values(const struct contact_sheet *s)
{
    const struct bead_over *over = &bead_sweep_panel(s->sweep, 0)->spec->over;
    return over->key_count > 0 && over->combine == BEAD_COMBINE_GRID ? over->keys[over->key_count - 1].count : 0;
}

/* Adds configurations one after the other, in as many rows as they need and as fit. */
static void add_wrapped(struct contact_sheet *s, size_t panel, size_t room)
{
    size_t all = bead_sweep_panel(s->sweep, panel)->configurations;
    for (size_t row = 0; row < room && row * s->columns < all; row++)
        add_row(s, panel, row * s->columns, all - row * s->columns, NAN);
}

/* Adds a row for each combination of the other keys, or for as many as fit, evenly spaced. */
static void add_by_key(struct contact_sheet *s, size_t room)
{
    const size_t last = last_values(s), all = bead_sweep_panel(s->sweep, 0)->configurations / last, rows = all < room ? all : room;
    for (size_t row = 0; row < rows; row++)
        add_row(s, 0, (rows > 1 ? row * (all - 1) / (rows - 1) : 0) * last, last, NAN);
}

/* Adds rows from the cleanest. Forces fall with 1 - M^2, so rows are evenly spaced in 1 - M^2: closer in M where waves are
 * clean. */
static void add_spaced(struct contact_sheet *s, size_t panel, size_t room)
{
    const struct bead_sweep_spec *spec = bead_sweep_panel(s->sweep, panel)->spec;
    const double low = spec->groups[0].magnetism, high = spec->groups[spec->group_count - 1].magnetism;
    size_t above = spec->group_count; /* earlier rows have higher magnetism */
    for (size_t row = 0; row < room && above > 0; row++) {
        double part = room > 1 ? pow((double)row / (double)(room - 1), 1.5) : 0;
        size_t group = spec->group_count <= room ? spec->group_count - 1 - row
                                                 : nearest_group(spec, sqrt(high * high - part * (high * high - low * low)));
        group = group < above ? group : above - 1;
        group = group + 1 < room - row && spec->group_count > room ? room - row - 1 : group; /* one left for each row below */
        above = group;
        add_row(s, panel, group_first(spec, group), spec->groups[group].configurations, spec->groups[group].magnetism);
    }
}

static bool shown(const struct contact_sheet *s, size_t panel, size_t first)
{
    for (size_t r = 0; r < s->row_count; r++) {
        if (s->rows[r].panel == panel && s->rows[r].first == first)
            return true;
    }
    return false;
}

/* Adds the requested rows, in the order of the scene; a sweep without that magnetism has no such row. */
static void add_asked(struct contact_sheet *s, size_t panel)
{
    static const double near = 0.05;
    const struct bead_sweep_spec *spec = bead_sweep_panel(s->sweep, panel)->spec;
    for (size_t i = 0; i < s->output->sheet.magnetism_count; i++) {
        size_t group = nearest_group(spec, s->output->sheet.magnetism[i]), first = group_first(spec, group);
        double magnetism = spec->groups[group].magnetism;
        if (fabs(magnetism - s->output->sheet.magnetism[i]) <= near && !shown(s, panel, first))
            add_row(s, panel, first, spec->groups[group].configurations, magnetism);
    }
}

static enum bead_error sheet_choose(struct contact_sheet *s, size_t room, struct bead_message *msg)
{
    const size_t panels = bead_sweep_panels(s->sweep);
    const size_t most = panels * (room + s->output->sheet.magnetism_count + 1);
    BEAD_TRY(bead_new(&s->rows, most, msg, "a sheet"));
    s->row_count = s->image_count = 0;
    for (size_t p = 0; p < panels; p++) {
        size_t share = room / panels > 0 ? room / panels : 1;
        if (s->by_key)
            add_by_key(s, share);
        else if (groups_of(bead_sweep_panel(s->sweep, p)) == 1)
            add_wrapped(s, p, share);
        else if (s->output->sheet.magnetism_count > 0)
            add_asked(s, p);
        else
            add_spaced(s, p, share);
    }
    return BEAD_OK;
}

/* ---- places ---- */

static double find_label_width(const struct contact_sheet *s)
{
    double most = 0;
    struct bead_text_style style = bead_words_style(&s->look, s->look.tick, s->look.ink, BEAD_ALIGN_MIDDLE);
    style.bold = true;
    for (size_t r = 0; r < s->row_count; r++) {
        char text[400];
        contact_sheet_row_name(s, &s->rows[r], text, sizeof text);
        most = fmax(most, bead_words_width(NULL, &style, text));
    }
    return most > 0 ? most + s->look.gap : 0;
}

/* Room for the bar's ticks and title beside it. */
static double find_bar_words(const struct contact_sheet *s, int width)
{
    const struct bead_rect bar = {0, 0, width, s->page.height / 2};
    const struct bead_field_info *field = bead_field_info(s->output->shown.field);
    const struct bead_colours colours = {&s->map, s->output->colours.scale, 0, 1.234, 0};
    return bead_colour_bar_draw(NULL, &s->look, &colours, field->unit, field->title, bar, false, false);
}

/* A picture's box: its spins along the chain, the picture, and the words below it. */
static void place_image(const struct contact_sheet *s, struct contact_image *image, struct bead_rect at)
{
    const int bar = (int)fmax(2, round(spins_height * s->small)), before = bar + (int)fmax(1, round(spins_gap * s->small));
    const bool down = s->orientation == BEAD_TIME_DOWN;
    image->spins = image->picture = at;
    *(down ? &image->spins.height : &image->spins.width) = bar;
    *(down ? &image->picture.y : &image->picture.x) += before;
    *(down ? &image->picture.height : &image->picture.width) -= before;
    image->words = (struct bead_rect){at.x, at.y + at.height, at.width, (int)round(words_height * s->small)};
}

/* Columns: names of rows, pictures, the bar. Rows: the words that explain the sheet, pictures. The last boxes belong to the words
 * and the bar. */
static enum bead_error make_grid(const struct contact_sheet *s, struct bead_layout_grid *grid, struct bead_message *msg)
{
    const double margin = s->look.margin, gap = between * s->small, bar = round(bead_colour_bar_width(&s->look, BEAD_BAR_OF_SHEET));
    BEAD_TRY(bead_layout_make(s->columns + 2, s->row_count + 1, s->image_count + 2, grid, msg));
    struct bead_lane *columns = grid->columns.lane, *rows = grid->rows.lane;
    columns[0].least = s->label_width;
    bead_lanes_want(columns + 1, s->columns, (struct bead_lane){.share = 1, .least = least_width * s->small, .gap = gap});
    columns[s->columns + 1] = (struct bead_lane){.least = bar, .gap = 1.5 * s->look.gap, .keep = {0, find_bar_words(s, (int)bar)}};
    bead_lanes_want(
        rows + 1, s->row_count,
        (struct bead_lane){.share = 1, .least = least_height * s->small, .gap = gap, .keep = {0, words_height * s->small}});
    bead_lanes_within(&grid->columns, margin, s->page.width - 2 * margin);
    bead_lanes_within(&grid->rows, margin, s->page.height - 2 * margin);
    struct bead_layout_box *box = grid->boxes;
    for (size_t r = 0; r < s->row_count; r++) {
        for (size_t c = 0; c < s->rows[r].count; c++)
            *box++ = (struct bead_layout_box){.column = 1 + c, .row = 1 + r};
    }
    *box++ = (struct bead_layout_box){.columns = s->columns + 1};
    *box = (struct bead_layout_box){.column = s->columns + 1, .row = 1, .rows = s->row_count};
    bead_layout_reach(grid, false);
    return BEAD_OK;
}

/* Places the words that explain the sheet beside the first row if it has a single picture and there is room, else above. False: the
 * pictures have no room. */
static bool place_intro(const struct contact_sheet *s, struct bead_layout_grid *grid)
{
    struct bead_layout_box *intro = &grid->boxes[s->image_count];
    const struct bead_layout_box above = *intro;
    if (s->rows[0].count == 1 && s->columns >= 3 && s->row_count > 1) {
        *intro = (struct bead_layout_box){.column = 2, .row = 1, .columns = s->columns - 1};
        if (bead_layout_divide(grid, NULL) && contact_sheet_intro(s, NULL, intro->at.width) <= intro->at.height)
            return true;
        *intro = above;
    }
    const bool wide = bead_layout_divide(grid, NULL);
    grid->rows.lane[0].least = ceil(contact_sheet_intro(s, NULL, intro->at.width));
    grid->rows.lane[1].gap = 1.5 * between * s->small;
    return bead_layout_divide(grid, NULL) && wide;
}

static enum bead_error make_images(struct contact_sheet *s, const struct bead_layout_box *boxes, struct bead_message *msg)
{
    size_t i = 0;
    BEAD_TRY(bead_new(&s->images, s->image_count + 1, msg, "a sheet"));
    BEAD_TRY(bead_new(&s->watches, s->image_count + 1, msg, "a sheet"));
    for (size_t r = 0; r < s->row_count; r++) {
        for (size_t c = 0; c < s->rows[r].count; c++, i++) {
            s->images[i] = (struct contact_image){.panel = s->rows[r].panel, .index = s->rows[r].first + c, .row = r};
            place_image(s, &s->images[i], boxes[i].at);
        }
    }
    return BEAD_OK;
}

static enum bead_error sheet_no_room(const struct contact_sheet *s, struct bead_message *msg)
{
    char size[BEAD_SIZE_WORDS];
    return bead_output_wrong(s->output, msg, "size: %s have no room for %zu row%s of %zu picture%s", bead_page_size(&s->page, size),
                             s->row_count, s->row_count == 1 ? "" : "s", s->columns, s->columns == 1 ? "" : "s");
}

/* The largest number of configurations of one magnetism. */
static size_t sheet_most_configurations(const struct contact_sheet *s)
{
    size_t most = 1;
    for (size_t p = 0; p < bead_sweep_panels(s->sweep); p++) {
        const struct bead_sweep_panel *panel = bead_sweep_panel(s->sweep, p);
        if (groups_of(panel) == 1)
            most = panel->configurations > most ? panel->configurations : most;
        for (size_t g = 0; groups_of(panel) > 1 && g < panel->spec->group_count; g++)
            most = panel->spec->groups[g].configurations > most ? panel->spec->groups[g].configurations : most;
    }
    return most;
}

enum bead_error contact_sheet_arrange(struct contact_sheet *s, struct bead_message *msg)
{
    const double gap = between * s->small, bar = round(bead_colour_bar_width(&s->look, BEAD_BAR_OF_SHEET));
    const double width = s->page.width - 2 * s->look.margin - 1.5 * s->look.gap - bar - find_bar_words(s, (int)bar);
    const double height = s->page.height - 2 * s->look.margin, row = (wanted_height + words_height + between) * s->small;
    const size_t most = sheet_most_configurations(s);
    struct bead_layout_grid grid;
    s->several = bead_sweep_panels(s->sweep) > 1;
    s->columns = (size_t)fmax(1, floor((width - 5 * s->small + gap) / (wanted_width * s->small + gap)));
    if (s->output->sheet.configurations > 0)
        s->columns = s->output->sheet.configurations;
    s->columns = s->columns < most ? s->columns : most;
    s->by_key = last_values(s) > 0;
    s->columns = s->by_key && last_values(s) < s->columns ? last_values(s) : s->columns;
    BEAD_TRY(sheet_choose(s, (size_t)fmax(1, floor((height + gap) / row)), msg));
    s->label_width = find_label_width(s);
    BEAD_TRY(make_grid(s, &grid, msg));
    enum bead_error err = place_intro(s, &grid) ? make_images(s, grid.boxes, msg) : sheet_no_room(s, msg);
    s->intro = grid.boxes[s->image_count].at;
    s->bar = grid.boxes[s->image_count + 1].at;
    bead_layout_free(&grid);
    return err;
}
