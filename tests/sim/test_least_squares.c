/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares: data and certified results of the National Institute of Standards and Technology (Statistical Reference Datasets,
 * nonlinear regression). */
#include "support.h"

#include "sim/statistics/least_squares.h"

struct data {
    size_t count;
    const double *x, *y;
    double (*model)(const double *b, double x);
};

static enum bead_error residuals(const void *context, const double *b, double *r, struct bead_message *)
{
    const struct data *d = context;
    for (size_t i = 0; i < d->count; i++)
        r[i] = d->model(b, d->x[i]) - d->y[i];
    return BEAD_OK;
}

static struct bead_message msg;

static enum bead_error fit(const struct data *data, size_t parameters, double *b, double *error, double *rms)
{
    static const char *const names[] = {"b1", "b2", "b3"};
    struct bead_least_squares f = {parameters, data->count, residuals, data, names, 0, 2, b, error, 0, 0};
    for (size_t i = 0; i < data->count; i++)
        f.size = hypot(f.size, data->y[i]);
    enum bead_error err = bead_least_squares(&f, &msg);
    *rms = f.rms;
    return err;
}

static double misra1a(const double *b, double x)
{
    return b[0] * (1 - exp(-b[1] * x));
}

/* From the first and the second start of the collection. */
static void certified_parameters_are_found(void **state)
{
    (void)state;
    static const double x[] = {77.6, 114.9, 141.1, 190.8, 239.9, 289, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760},
                        y[] = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.4, 75.47, 81.78},
                        starts[2][2] = {{500, 1e-4}, {250, 5e-4}};
    for (int s = 0; s < 2; s++) {
        double b[] = {starts[s][0], starts[s][1]}, error[2], rms;
        assert_int_equal(fit(&(struct data){14, x, y, misra1a}, 2, b, error, &rms), BEAD_OK);
        assert_near(b[0], 238.94212918, 1e-4 * 2.7070075241);
        assert_near(b[1], 5.5015643181e-4, 1e-4 * 7.2668688436e-6);
        assert_near(error[0], 2.7070075241, 1e-4 * 2.7);
        assert_near(error[1], 7.2668688436e-6, 1e-4 * 7.3e-6);
        assert_near(rms, 0.10187876330, 1e-8);
    }
}

static double sum(const double *b, double x)
{
    return (b[0] + b[1]) * x;
}
static double first(const double *b, double x)
{
    return b[0] * x;
}

static double three(const double *b, double x)
{
    return (b[0] + b[2]) * x + b[1] * x * x;
}

/* Parameters that begin at 0 also have a step; parameters that the data cannot determine are reported, by name. */
static void what_cannot_be_found_is_said(void **state)
{
    (void)state;
    static const double x[] = {1, 2, 3, 4, 5}, y[] = {3, 6, 9.1, 12, 15.1};
    double b[] = {0, 0, 3}, error[3], rms;
    assert_int_equal(fit(&(struct data){3, x, y, first}, 1, b, error, &rms), BEAD_OK);
    assert_near(b[0], 42.3 / 14, 1e-9);
    b[0] = 1;
    assert_int_equal(fit(&(struct data){3, x, y, sum}, 2, b, error, &rms), BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "cannot tell b2 from"));
    b[1] = 5;
    assert_int_equal(fit(&(struct data){3, x, y, first}, 2, b, error, &rms), BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "b2 changes nothing"));
    assert_int_equal(fit(&(struct data){2, x, y, first}, 2, b, error, &rms), BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "2 points are too few for 2 parameters"));
    assert_int_equal(fit(&(struct data){5, x, y, three}, 3, b, error, &rms), BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "cannot tell b3 from"));
}

static double hardly(const double *b, double x)
{
    return 5 + 1e-3 * b[0] * x;
}
static double less(const double *b, double x)
{
    return 5 + 1e-6 * b[0] * x;
}

/* Parameters that change the data little are found, with steps of up to their own size; no such step does for the second. */
static void weak_parameters_are_found(void **state)
{
    (void)state;
    static const double x[] = {1, 2, 3}, y[] = {5.003, 5.006, 5.009};
    double b[] = {1}, error[1], rms;
    assert_int_equal(fit(&(struct data){3, x, y, hardly}, 1, b, error, &rms), BEAD_OK);
    assert_near(b[0], 3, 1e-9);
    b[0] = 1;
    assert_int_equal(fit(&(struct data){3, x, y, less}, 1, b, error, &rms), BEAD_ERROR_NUMBERS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(certified_parameters_are_found),
                                       cmocka_unit_test(what_cannot_be_found_is_said), cmocka_unit_test(weak_parameters_are_found)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
