/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places the parts of a stage: beads first, then the bar, images and curve in the rest. */
#include "render/movie/movie_stage.h"

#include <math.h>

#include "render/stage/stage_key.h"

/* In units of the label's font size: lines of titles, gaps, and the least sizes of a stage, a curve and an image. */
static const double line = 1.35, between = 0.6, before_plots = 0.7, heading = 1.5, stage_margin = 2, least_key = 0.8,
                    least_stage = 1.8, least_curve[] = {8, 2.4}, least_image[] = {3.75, 2.5}, beside_title = 0.5,
                    colours_width = 0.45, between_numbers = 0.5;
/* In frames this wide, in heights, beads are inset by this part of the width, so that they are large in as much of the frame; in
 * others, numbers at the end leave as much air as the margin of a panel. */
static const double wide = 1.5, wide_inset = 0.03;
/* The curve has at least this part of the area of all plots; images have at most this part of a frame. */
static const double curve_part = 0.28, most_images = 0.25;

/* First the images become smaller, then the beads, then air, then the curve's axis replaces the bar, then images and curve
 * disappear. */
const struct bead_stage_plan bead_stage_plans[BEAD_STAGE_PLANS] = {
    {0.447, 0.15, true, true, 1},    {0.43, 0.15, true, true, 1},     {0.41, 0.15, true, true, 1},
    {0.39, 0.15, true, true, 1},     {0.37, 0.15, true, true, 1},     {0.39, 0.15, true, true, 0.4},
    {0.355, 0.15, true, true, 0.4},  {0.38, 0.15, false, true, 0.4},  {0.355, 0.15, false, true, 0.4},
    {0.355, 0.12, false, true, 0.4}, {0.355, 0.12, false, true, 0.2}, {0.355, 0.09, false, true, 0.2},
    {0.355, 0.06, false, true, 0.2}, {0.447, 0, false, true, 0.4},    {0.44, 0, false, true, 0.2},
    {0.40, 0, false, true, 0.4},     {0.355, 0, false, true, 0.4},    {0.465, 0, false, true, 0.2},
    {0.48, 0, false, true, 0.2},     {0.60, 0, false, true, 0.2},     {0.30, 0, false, true, 0.2},
    {0.40, 0, false, false, 0.2},
};

/* One arrangement of one plan. */
struct stage {
    const struct bead_movie_wants *w;
    const struct bead_stage_plan *plan;
    struct bead_rect area;
    struct bead_movie_layout *to;
    double em, area_px;                          /* px, of letters; px^2, of the frame */
    size_t acts, curve;                          /* views; view_count: none */
    size_t others[BEAD_MOST_VIEWS], other_count; /* below the beads, with a plot for each chain */
    bool bar;
    int colours;      /* px: the images' colours along the curve's axis, if there is no bar; 0: none */
    bool names_above; /* names of images have a line above the titles; else they are beside these */
    int inset;        /* px: of beads, within the area of plots with their axes */
    size_t columns;   /* of stages */
};

static int whole(double x)
{
    return (int)ceil(x);
}

size_t bead_stage_view(const struct bead_movie_wants *w)
{
    size_t view = 0;
    while (view < w->view_count && !bead_view_has(w->views[view], BEAD_ACTS))
        view++;
    return view;
}

int bead_stage_inset(const struct bead_movie_wants *w)
{
    if (!w->axes)
        return 0;
    return whole(w->width >= wide * w->height ? wide_inset * w->width : fmax(0, w->along_end - w->look->gap));
}

size_t bead_stage_columns(const struct bead_movie_wants *w)
{
    return w->chain_count == 4 && w->width >= w->height ? 2 : 1;
}

static void sort_views(struct stage *s)
{
    const struct bead_movie_wants *w = s->w;
    s->acts = bead_stage_view(w);
    s->curve = w->view_count;
    bool coloured = false;
    for (size_t v = 0; v < w->view_count; v++) {
        bool image = bead_view_has(w->views[v], BEAD_SHOWS_IMAGE);
        if (v == s->acts)
            continue;
        if (bead_view_has(w->views[v], BEAD_OVERLAYS) && s->curve == w->view_count)
            s->curve = s->plan->curve ? v : s->curve;
        else if (!bead_view_has(w->views[v], BEAD_OVERLAYS) && (image ? s->plan->images > 0 : s->plan->curve))
            s->others[s->other_count++] = v;
        coloured = coloured || (image && s->plan->images > 0 && w->axes && !w->colourless);
    }
    const bool curve = s->curve < w->view_count;
    s->bar = coloured && (s->plan->bar || !curve); /* colours always have a scale */
    s->colours = coloured && !s->bar ? whole(colours_width * w->look->tick) : 0;
}

/* ---- beads ---- */

bool bead_stage_keyed(const struct bead_movie_wants *w)
{
    const double room = w->width - 2.0 * bead_stage_inset(w);
    return bead_stage_columns(w) == 1 && w->keyed_heading + 0.04 * w->width + w->look->label <= room;
}

static bool key_fits(const struct bead_movie_wants *w, double width)
{
    return least_key * width <= w->width - 2.0 * bead_stage_inset(w) - 2 * stage_margin * w->look->gap;
}

int bead_stage_key_lines(const struct bead_movie_wants *w)
{
    if (w->key_width == 0 || bead_stage_keyed(w))
        return 0;
    return key_fits(w, w->key_width) || key_fits(w, w->key_brief) ? 1 : key_fits(w, w->key_part) ? 2 : 0;
}

bool bead_stage_key_brief(const struct bead_movie_wants *w)
{
    return !key_fits(w, w->key_width) && key_fits(w, w->key_brief);
}

/* Headings that fit beside the key are over the top of their stage, which leaves room for them; those of a grid have no key beside
 * them. */
static bool heads_above(const struct stage *s)
{
    return s->columns == 1 && (s->to->label_lines || !bead_stage_keyed(s->w));
}

static int heading_of(const struct stage *s)
{
    const double lines = s->to->label_lines ? line : 0;
    const bool needed = s->w->axes && (s->w->headings || bead_stage_keyed(s->w));
    return needed ? whole((heading + lines) * s->w->look->label) : 0;
}

/* Returns their end; < 0: there is no room. If chains have the same numbers, only the last row has them. */
static int place_beads(const struct stage *s)
{
    const struct bead_movie_wants *w = s->w;
    const size_t rows = (w->chain_count + s->columns - 1) / s->columns, numbered = !w->axes ? 0 : w->same_beads ? 1 : rows;
    const bool alone = s->other_count == 0 && s->curve == w->view_count;
    const int gap = whole(s->plan->air * between * s->em), head = heading_of(s), above = heads_above(s) ? head : 0,
              numbers = whole(BEAD_STAGE_NUMBERS * s->w->look->tick), all_width = s->area.width - 2 * s->inset,
              beside = whole(between * s->em), width = (all_width - ((int)s->columns - 1) * beside) / (int)s->columns;
    double all = alone ? s->area.height - (double)(rows - 1) * gap : s->plan->beads * s->area_px / (width * (double)s->columns);
    int block = (int)floor((all - (double)numbered * numbers) / (double)rows), y = s->area.y;
    if (block - head < least_stage * s->em)
        return -1;
    s->to->head = head - above;
    for (size_t i = 0; i < w->chain_count; i++) {
        struct bead_movie_chain *chain = &s->to->chains[i];
        const int x = s->area.x + s->inset + (int)(i % s->columns) * (width + beside);
        const bool last = i / s->columns + 1 == rows, ends = i % s->columns + 1 == s->columns || i + 1 == w->chain_count;
        chain->labels[s->acts] = numbered == rows || (numbered == 1 && last);
        if (head > 0 && w->headings)
            chain->heading = (struct bead_rect){x, y, width, head};
        chain->plot[s->acts] = (struct bead_rect){x, y + above, width, block - above + (chain->labels[s->acts] ? numbers : 0)};
        y += ends ? above + chain->plot[s->acts].height + (last ? 0 : gap) : 0;
    }
    return y <= s->area.y + s->area.height ? y : -1;
}

/* ---- plots ---- */

/* Heights around the plots of a view: its title, its horizontal axis. */
static int above(const struct stage *s)
{
    return s->w->axes ? whole(line * s->w->look->label) : 0;
}

/* The height of the line of image names; the width of the images' title. */
static int name_line(const struct stage *s)
{
    return whole(line * s->w->look->label);
}

static double title_width(const struct stage *s)
{
    return s->to->against ? s->w->against : s->w->along;
}

static int below(const struct stage *s, size_t view)
{
    bool time = bead_movie_across(s->w, view) == BEAD_ACROSS_TIME;
    return s->w->axes ? whole(!time ? s->w->below_beads : s->to->against ? s->w->below_numbers : s->w->below_time) : 0;
}

static double bar_room(const struct stage *s)
{
    const struct bead_look *look = s->w->look;
    return s->bar
               ? whole(0.8 * look->tick) + whole(fmax(bead_colour_bar_width(look, BEAD_BAR_OF_MOVIE) + s->w->bar, s->w->bar_title))
               : 0;
}

/* Room left of the first plot of a view, and before each of the next; right of the last. */
static double left_of(const struct stage *s, bool first)
{
    return !s->w->axes ? (first ? 0 : 0.5 * s->em) : first ? s->w->left : 0.5 * s->em + 2 * s->w->time_end;
}

/* More room before an image beside a curve, whose numbers would begin at the curve's end. */
static double air_between(const struct stage *s)
{
    return s->w->axes ? fmax(0, s->w->image_left + between_numbers * s->em - s->w->left) : 0;
}

static double left_of_curve(const struct stage *s)
{
    return left_of(s, true) + s->colours;
}

static double right_of(const struct stage *s)
{
    return s->w->axes && s->other_count > 0 ? fmax(0, s->w->time_end - (s->bar ? 0.4 * s->em : s->w->look->gap)) : 0;
}

static double right_of_curve(const struct stage *s)
{
    return s->w->axes ? fmax(right_of(s), s->w->along_end - s->w->look->gap) : 0;
}

static void place_bar(const struct stage *s, struct bead_rect last)
{
    const struct bead_look *look = s->w->look;
    int x = last.x + last.width + whole(right_of(s) + 0.8 * look->tick), pad = whole(0.6 * look->tick);
    if (!s->bar || last.height < 4 * pad)
        return;
    s->to->bar = (struct bead_rect){x, last.y + pad, whole(bead_colour_bar_width(look, BEAD_BAR_OF_MOVIE)), last.height - 2 * pad};
    s->to->bar_title = (struct bead_rect){x, last.y - above(s), s->area.x + s->area.width - x, above(s)};
}

/* One profile for all chains. */
static void place_curve(const struct stage *s, struct bead_rect plot)
{
    for (size_t i = 0; i < s->w->chain_count; i++) {
        s->to->chains[i].plot[s->curve] = plot;
        s->to->chains[i].labels[s->curve] = s->to->chains[i].values[s->curve] = s->w->axes && i == 0;
    }
    s->to->overlay = s->curve;
    s->to->colours = s->colours;
}

/* The name above an image, up to its right end; it may begin above the gap before it. */
static struct bead_rect name_of(const struct stage *s, size_t chain, int x, int y, int width)
{
    const bool beside = chain == 0 && !s->names_above;
    const int taken = whole(beside ? title_width(s) + beside_title * s->em : beside_title * s->em - left_of(s, chain == 0)),
              top = y - above(s) - (s->names_above ? name_line(s) : 0);
    return (struct bead_rect){x + taken, top, width - taken, name_line(s)};
}

/* Places the plots of a view from `x`; returns their end. */
static double place_view(const struct stage *s, size_t view, double x, int y, double width, int height)
{
    for (size_t i = 0; i < s->w->chain_count; i++) {
        struct bead_movie_chain *chain = &s->to->chains[i];
        x += left_of(s, i == 0);
        chain->plot[view] = (struct bead_rect){(int)ceil(x), y, (int)floor(width), height};
        chain->values[view] = s->w->axes && i == 0;
        chain->labels[view] = s->w->axes;
        if (s->w->chain_count > 1 && s->w->axes && s->w->headings) {
            chain->name = name_of(s, i, (int)ceil(x), y, (int)floor(width));
        }
        x += width;
    }
    return x;
}

static struct bead_rect last_plot(const struct stage *s)
{
    return s->to->chains[s->w->chain_count - 1].plot[s->others[s->other_count - 1]];
}

/* Is there room for the title of the axes, with the name of the first chain beside it or above? If names are in another line, the
 * title of all images may extend over the next ones. */
static bool titled(const struct stage *s, double width)
{
    if (s->names_above && s->to->against && s->other_count == 1)
        width = width * (double)s->w->chain_count + left_of(s, false) * (double)(s->w->chain_count - 1);
    const bool named = s->w->axes && s->w->chain_count > 1 && s->w->headings && s->w->name_least > 0;
    const double beside = named && !s->names_above ? beside_title * s->em + s->w->name_least : 0;
    return s->other_count == 0 || beside + (beside > 0 || s->to->against ? title_width(s) : 0) <= width;
}

static bool large_enough(const struct stage *s, double width, double height)
{
    return width >= least_image[0] * s->em && height >= least_image[1] * s->em;
}

/* Curve and images in one row. */
static bool place_beside(const struct stage *s, int y, int bottom)
{
    const double plots = (double)(s->other_count * s->w->chain_count);
    const bool has_curve = s->curve < s->w->view_count;
    int under = has_curve ? below(s, s->curve) : 0;
    for (size_t k = 0; k < s->other_count; k++)
        under = under > below(s, s->others[k]) ? under : below(s, s->others[k]);
    int top = y + above(s) + (s->names_above ? name_line(s) : 0), height = bottom - under - top;
    const double drawn = s->w->inset > 0 ? s->inset + s->w->inset + before_plots * s->em : 0;
    double first = drawn > 0 ? drawn + left_of_curve(s) : fmax(left_of_curve(s), s->inset),
           right = plots > 0 ? right_of(s) : right_of_curve(s),
           room = s->area.width - (has_curve ? first : drawn) - bar_room(s) - right;
    const double air = has_curve && plots > 0 ? air_between(s) : 0;
    room -= air + (double)s->other_count * (left_of(s, true) + (double)(s->w->chain_count - 1) * left_of(s, false));
    double least = has_curve ? fmax(least_curve[0] * s->em, curve_part * room) : 0;
    double width = plots > 0 ? floor((room - least) / plots) : 0; /* images take what they need, the curve the rest */
    if (has_curve && s->plan->images > 0)
        width = fmin(width, ceil(s->plan->images * s->area_px / (plots * height)));
    width = fmin(width, floor(most_images * s->area_px / (plots * height)));
    if (height < least_curve[1] * s->em || room < least || (plots > 0 && !large_enough(s, width, height)) ||
        (plots > 0 && plots * width * height < s->plan->images * s->area_px) || !titled(s, width))
        return false;
    double x = s->area.x + (has_curve ? first : drawn);
    if (drawn > 0)
        s->to->inset = (struct bead_rect){s->area.x + s->inset, y, (int)floor(s->w->inset), bottom - y};
    if (has_curve) {
        place_curve(s, (struct bead_rect){whole(x), top, (int)floor(room - plots * width), height});
        x = whole(x) + floor(room - plots * width) + air;
    }
    for (size_t k = 0; k < s->other_count; k++)
        x = place_view(s, s->others[k], x, top, width, height);
    if (s->other_count > 0)
        place_bar(s, last_plot(s));
    return true;
}

/* The curve, and below it a row for each other view. */
static bool place_below(const struct stage *s, int y, int bottom)
{
    if (s->w->inset > 0) /* it is beside the curve */
        return false;
    const double n = (double)s->w->chain_count, rows = (double)s->other_count;
    double room = s->area.width - left_of(s, true) - (n - 1) * left_of(s, false) - bar_room(s) - right_of(s),
           width = floor(room / n);
    double left = bottom - y - above(s) - below(s, s->curve), gap = whole(s->plan->air * between * s->em);
    for (size_t k = 0; k < s->other_count; k++)
        left -= above(s) + below(s, s->others[k]) + gap + (s->names_above ? name_line(s) : 0);
    double least = s->plan->images * s->area_px / (n * rows * width), most = most_images * s->area_px / (n * rows * width);
    double height = floor(fmin(most, fmax(least, (left - fmax(least_curve[1] * s->em, curve_part * left)) / rows)));
    double curve = floor(left - rows * height);
    if (curve < least_curve[1] * s->em || height < least || !large_enough(s, width, height) || !titled(s, width))
        return false;
    int top = y + above(s), x = s->area.x + whole(left_of_curve(s));
    place_curve(s, (struct bead_rect){x, top, s->area.x + s->area.width - x - whole(right_of_curve(s)), (int)curve});
    top += (int)curve + below(s, s->curve);
    for (size_t k = 0; k < s->other_count; k++) {
        top += (int)gap + above(s) + (s->names_above ? name_line(s) : 0);
        place_view(s, s->others[k], s->area.x, top, width, (int)height);
        top += (int)height + below(s, s->others[k]);
    }
    place_bar(s, last_plot(s));
    return true;
}

bool bead_stage_place(const struct bead_movie_wants *w, const struct bead_stage_plan *plan, struct bead_rect area,
                      struct bead_movie_layout *layout)
{
    struct stage s = {.w = w,
                      .plan = plan,
                      .area = area,
                      .to = layout,
                      .em = w->look->label,
                      .area_px = (double)w->width * w->height,
                      .inset = bead_stage_inset(w),
                      .columns = bead_stage_columns(w)};
    sort_views(&s);
    layout->overlay = w->view_count;
    layout->grid = s.columns > 1;
    int end = place_beads(&s), top = end + whole(plan->air * before_plots * s.em), bottom = area.y + area.height;
    bool curve = s.curve < w->view_count, both = curve && s.other_count > 0;
    if (end < 0 || (!curve && s.other_count == 0))
        return end >= 0;
    const bool named = w->axes && w->headings && w->chain_count > 1;
    for (int tries = 0; tries < (named ? 4 : 2); tries++) {
        s.names_above = tries >= 2;
        layout->against = tries % 2 == 0;
        if (layout->against && (w->orientation == BEAD_TIME_DOWN || !w->axes))
            continue;
        if (place_beside(&s, top, bottom) || (both && place_below(&s, top, bottom)))
            return true;
    }
    return false;
}
