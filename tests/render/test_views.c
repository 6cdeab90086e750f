/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of views: every row is complete, and its words, traits and functions fit together. */
#include "support.h"

#include "scratch.h"
#include "sessions.h"

#include <string.h>

#include "beadreel/view.h"
#include "render/view/views.h"
#include "sim/kinds/view_kinds.h"

static void test_rows_are_complete(void **state)
{
    (void)state;
    for (size_t i = 0; i < BEAD_VIEW_KINDS; i++) {
        const struct bead_view_info *info = &bead_view_infos[i];
        assert_true(info->name && *info->name && info->help && *info->help);
        assert_true(info->still_share > 0 && info->shape > 0 && info->movie_share > 0 && info->movie_most > 0);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(info->name, bead_view_infos[k].name);
    }
}

static void test_functions_fit_the_traits(void **state)
{
    (void)state;
    for (size_t i = 0; i < BEAD_VIEW_KINDS; i++) {
        const struct bead_view_type *type = bead_view_find((enum bead_view_kind)i);
        bool all_times = bead_view_has(type, BEAD_SHOWS_ALL_TIMES);
        assert_ptr_equal(type->info, &bead_view_infos[i]);
        assert_true(type->fields && type->create && type->place && type->decorate && type->feed && type->draw && type->vector &&
                    type->destroy);
        assert_true(all_times == (type->extremes != NULL));
        assert_true(all_times == (type->set_range != NULL));
        assert_true(all_times == (type->horizon != NULL));
        if (bead_view_has(type, BEAD_SHOWS_IMAGE))
            assert_true(all_times && bead_view_has(type, BEAD_SHOWS_COLOURS));
    }
    assert_null(bead_view_find(BEAD_VIEW_KINDS));
}

/* The error message about a list of views names every view. */
static void test_messages_name_every_view(void **state)
{
    (void)state;
    static const char *const kinds[] = {"image: a.png", "movie: a.mp4"};
    for (size_t k = 0; k < 2; k++) {
        struct bead_scene *scene = NULL;
        struct bead_message msg = {""};
        char text[200];
        snprintf(text, sizeof text, "chain: {beads: [{bead: large-steel}]}\noutputs: [{%s, views: beads}]\n", kinds[k]);
        assert_int_equal(bead_scene_parse("test", text, strlen(text), NULL, &scene, &msg), BEAD_ERROR_SCENE);
        const char *allowed = strstr(msg.text, "must be");
        assert_non_null(allowed);
        for (size_t i = 0; i < BEAD_VIEW_KINDS; i++) {
            if (!strstr(allowed, bead_view_infos[i].name))
                fail_msg("%s: does not name %s", msg.text, bead_view_infos[i].name);
        }
    }
}

static void test_any_and_all(void **state)
{
    (void)state;
    struct bead_views_asked views = {.kinds = {BEAD_VIEW_SPACETIME, BEAD_VIEW_SENSORS, BEAD_VIEW_BEADS}, .count = 2};
    assert_true(bead_views_all(&views, BEAD_SHOWS_ALL_TIMES));
    assert_false(bead_views_any(&views, BEAD_SHOWS_BEADS));
    views.count = 3;
    assert_false(bead_views_all(&views, BEAD_SHOWS_ALL_TIMES));
    assert_true(bead_views_any(&views, BEAD_SHOWS_BEADS));
    views.count = 0;
    assert_false(bead_views_any(&views, BEAD_SHOWS_BEADS));
}

/* Beside other views sensors show the movie's field, also when alone, and of both runs if the movie shows how far to trust it. */
static void test_movies_of_sensors_show_their_field(void **state)
{
    (void)state;
    static const char *const views[] = {"[sensors]", "[beads, sensors]"};
    for (size_t i = 0; i < 2; i++) {
        char scene[512], text[512];
        snprintf(text, sizeof text,
                 "chain: {beads: [{bead: large-steel, count: 6}, {bead: small-steel, sensor: a}], wall: brass}\n"
                 "simulate: {until: 0.2 ms}\n"
                 "outputs: [{movie: a.apng, views: %s, field: velocity, trust: true, fps: 4, duration: 0.5 s, size: [320, 240]}]\n",
                 views[i]);
        write_scene(text, scene);
        struct bead_counts counts = play_counts((struct bead_job){.input = scene, .output = directory});
        assert_true(counts.steps > 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_are_complete),
        cmocka_unit_test(test_functions_fit_the_traits),
        cmocka_unit_test(test_messages_name_every_view),
        cmocka_unit_test(test_any_and_all),
        cmocka_unit_test(test_movies_of_sensors_show_their_field),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
