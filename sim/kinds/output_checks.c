/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of the keys of an output against each other and against the scene, shared by several kinds. */
#include "sim/base/suggest.h"
#include "sim/kinds/outputs.h"
#include "sim/kinds/view_kinds.h"

#include <math.h>

BEAD_OUTPUT_CHECK(bead_output_check_times)
{
    double until = reader->scene->simulate.until;
    const char *unit = bead_scene_seconds(reader->scene);
    if (output->shown.time[0] >= until)
        return BEAD_WRONG_KEY(reader, at, "time", "begins at %g%s; must begin before the run ends at %g%s", output->shown.time[0],
                              unit, until, unit);
    if (output->shown.time[1] > until * (1 + 1e-9))
        return BEAD_WRONG_KEY(reader, at, "time", "goes to %g%s; must not go beyond the end of the run at %g%s",
                              output->shown.time[1], unit, until, unit);
    if (output->image.at > until)
        return BEAD_WRONG_KEY(reader, at, "at", "is %g%s; must not be later than the end of the run at %g%s", output->image.at,
                              unit, until, unit);
    return BEAD_OK;
}

/* Keys of views that show one moment, given for a picture without such a view. */
BEAD_OUTPUT_CHECK(bead_output_check_moment)
{
    const struct bead_views_asked *views = &output->views;
    bool beads = bead_views_any(views, BEAD_SHOWS_BEADS);
    bool moment = !bead_views_all(views, BEAD_SHOWS_ALL_TIMES);
    if (output->still.panel_count > 0)
        return BEAD_OK;
    if (!moment && !isnan(output->image.at))
        return BEAD_WRONG_KEY(
            reader, at, "at",
            "is a moment, but the picture shows all times: add beads or profile to `views`, or give `time` instead");
    return beads || output->views.magnify == 0
               ? BEAD_OK
               : BEAD_WRONG_KEY(reader, at, "magnify", "is given, but no beads are drawn: add beads to `views`");
}

enum bead_error bead_output_need_modes(const struct bead_reader *reader, const struct bead_at *at, const char *key)
{
    return bead_scene_has_modes(reader->scene)
               ? BEAD_OK
               : BEAD_WRONG_KEY(reader, at, key, "modes are those of equations, such as fput; %s",
                                reader->scene->chain_count > 1 ? "not all chains here have some" : "this chain has none");
}

static enum bead_error check_orientation(const struct bead_reader *reader, const struct bead_at *at,
                                         const struct bead_output *output)
{
    if (output->views.orientation != BEAD_MATRIX || !output->views.axes)
        return BEAD_OK;
    return BEAD_WRONG_KEY(
        reader, at, "orientation",
        "is matrix, which is how pictures without axes lie: needs `axes: false`; must be time-right or time-down");
}

/* Views need chains with the quantities they show. */
BEAD_OUTPUT_CHECK(bead_output_check_views)
{
    const struct bead_views_asked *views = &output->views;
    bool modes = bead_views_any(views, BEAD_SHOWS_MODES);
    if (bead_views_any(views, BEAD_SHOWS_BEADS) && !bead_scene_has_beads(reader->scene))
        return BEAD_WRONG_KEY(reader, at, "views", "the equation has no beads to show; must be profile or spacetime");
    BEAD_TRY(modes ? bead_output_need_modes(reader, at, "views") : BEAD_OK);
    return check_orientation(reader, at, output);
}

BEAD_OUTPUT_CHECK(bead_output_check_still_views)
{
    if (bead_views_any(&output->views, BEAD_SHOWS_MODES))
        return BEAD_WRONG_KEY(reader, at, "views",
                              "modes are a view of movies; {plot: FILE, show: modes} has their energies over time");
    return bead_output_check_views(reader, at, output);
}

/* Only fields that every chain has. */
static enum bead_error check_fields(const struct bead_reader *reader, const struct bead_at *at, const char *key, unsigned asked)
{
    unsigned known = bead_scene_fields(reader->scene);
    char all[120] = "";
    if (!(asked & ~known))
        return BEAD_OK;
    const char *missing = NULL;
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        const char *name = bead_field_info((enum bead_field)f)->name;
        if (known & BEAD_FIELD_BIT(f))
            bead_list_add(all, sizeof all, ", ", name);
        else if (asked & BEAD_FIELD_BIT(f) && !missing)
            missing = name;
    }
    return BEAD_WRONG_KEY(reader, at, key, "there is no %s in %s; there is %s", missing,
                          reader->scene->chain_count > 1 ? "every chain" : "this chain", all);
}

BEAD_OUTPUT_CHECK(bead_output_check_field)
{
    return check_fields(reader, at, "field", BEAD_FIELD_BIT(output->shown.field));
}

BEAD_OUTPUT_CHECK(bead_output_check_field_list)
{
    return check_fields(reader, at, "fields", output->trajectory.fields);
}

BEAD_OUTPUT_CHECK(bead_output_check_theory)
{
    if (!output->shown.theory)
        return BEAD_OK;
    if (!output->views.axes)
        return BEAD_WRONG_KEY(reader, at, "theory", "is set, but `axes: false` leaves pixels bare and no room for its words");
    return bead_views_any(&output->views, BEAD_SHOWS_IMAGE)
               ? BEAD_OK
               : BEAD_WRONG_KEY(reader, at, "theory", "is set, but there is no spacetime to show it over: add that to `views`");
}

/* `trust` shows in views of all times, and needs room for its words. */
BEAD_OUTPUT_CHECK(bead_output_check_trust)
{
    bool shows = bead_views_any(&output->views, BEAD_SHOWS_ALL_TIMES);
    if (!output->shown.trust)
        return BEAD_OK;
    if (!output->views.axes)
        return BEAD_WRONG_KEY(reader, at, "trust", "is set, but `axes: false` leaves pixels bare and no room for its line of text");
    return shows ? BEAD_OK
                 : BEAD_WRONG_KEY(reader, at, "trust", "is set, but no view shows all times: add spacetime or sensors to `views`");
}
