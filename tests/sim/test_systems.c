/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of systems: every row is complete and its traits agree with each other. */
#include "tests/support.h"

#include "sim/equation/equation.h"

static bool moves(const struct bead_equation *e)
{
    return e->check && e->create && e->destroy && e->pace && e->time && e->step && e->sample && e->evaluations && e->state &&
           e->energy && e->measures;
}

/* Traits that no system has one without the other. */
static const char *contradicts(const struct bead_system *system)
{
    if (system->has_contacts == !!system->equation)
        return "contacts or an equation, one of the two";
    if (system->equation && (!moves(system->equation) || !system->label[0]))
        return "a function of the equation, or its label";
    if (system->has_contacts && !(system->has_masses && system->time_unit[0]))
        return "masses and units of its contacts";
    return system->has_striker && !system->has_contacts ? "contacts for the striker" : NULL;
}

/* The member that a row lacks; NULL: it is complete. */
static const char *lacks(const struct bead_system *system)
{
    if (!system->name || !system->help || !system->label)
        return "name, help or label";
    if (!system->points || !system->axis || !system->axis_unit || !system->time_unit)
        return "words or units";
    if (!system->field || !system->field_signed || !system->describe || !system->count || !system->places)
        return "a function";
    if (!system->modes != !system->mode_title)
        return "modes or their title";
    return contradicts(system);
}

/* Its fields have names and titles; those that its modes need are among them. */
static void check_fields(const struct bead_system *system)
{
    unsigned known = 0;
    for (const enum bead_field *field = system->fields; field && *field < BEAD_FIELD_COUNT; field++) {
        const struct bead_field_info *info = system->field(*field);
        assert_string_equal(info->name, bead_field_info(*field)->name);
        assert_true(info->title[0] && !info->unit[0] == !system->time_unit[0]);
        known |= BEAD_FIELD_BIT(*field);
    }
    assert_int_equal(system->mode_fields & ~known, 0);
}

static void rows_are_whole(void **state)
{
    (void)state;
    const struct bead_system *system;
    for (size_t i = 0; (system = bead_system_info(i)); i++) {
        if (lacks(system))
            fail_msg("%s lacks %s", system->name, lacks(system));
        check_fields(system);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(bead_system_info(k)->name, system->name);
    }
    assert_ptr_equal(bead_system_info(0), &bead_system_beads);
}

static void rows_that_are_not_are_refused(void **state)
{
    (void)state;
    struct bead_system some = bead_system_kdv;
    some.points = NULL;
    assert_string_equal(lacks(&some), "words or units");
    some = bead_system_kdv;
    some.count = NULL;
    assert_string_equal(lacks(&some), "a function");
    some = bead_system_kdv;
    some.mode_title = NULL;
    assert_string_equal(lacks(&some), "modes or their title");
    some = bead_system_kdv;
    some.equation = NULL;
    assert_string_equal(lacks(&some), "contacts or an equation, one of the two");
    some = bead_system_fput;
    struct bead_equation halts = *some.equation;
    halts.step = NULL;
    some.equation = &halts;
    assert_string_equal(lacks(&some), "a function of the equation, or its label");
    some = bead_system_beads;
    some.time_unit = "";
    assert_string_equal(lacks(&some), "masses and units of its contacts");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_whole),
        cmocka_unit_test(rows_that_are_not_are_refused),
    };
    return cmocka_run_group_tests_name("systems", tests, NULL, NULL);
}
