/* M3: the strain monitor rejects a triangle at its limit exactly, and accepts the double below. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/oracle.h"
#include "support/exact_geometry.h"
#include "support/monitor_trial.h"

/* Stretches of well-shaped triangles in plain double: a few dozen roundings. */
#define STRETCH_ERROR (64 * DBL_EPSILON)

static monitor_trial look(const hand_model *h)
{
    return try_monitor(cipc_monitor_strain, h, NULL);
}

/* The triangle (0 0 0), (1 0 0), (0 1 0) of a body with this limit. */
static hand_model *unit_triangle(double limit)
{
    hand_model *h = hand_model_create();
    int body = hand_body(h, "cloth", 0, limit, false);
    hand_new_triangle(h, body, (const double[9]){0, 0, 0, 1, 0, 0, 0, 1, 0});
    return h;
}

static const double limits[] = {1.134, 1.0608, 1.01, 1.001};

static void test_one_ulp_from_the_limit(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        hand_model *h = unit_triangle(limits[i]);
        h->x[3] = limits[i];
        monitor_trial t = look(h);
        assert_int_equal(t.status, CIPC_E_VIOLATED_STRAIN);
        assert_int_equal(t.report.exact_strain_checks, 1);
        h->x[3] = nextafter(limits[i], 0);
        t = look(h);
        assert_int_equal(t.status, CIPC_OK);
        assert_int_equal(t.report.exact_strain_checks, 1);
        h->x[3] = nextafter(limits[i], 2);
        assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
        hand_model_destroy(h);
    }
}

/* Simple shear by 3/2 stretches by 2, although no edge along the axes does. */
static void test_shear(void **state)
{
    (void)state;
    hand_model *h = unit_triangle(2);
    h->x[6] = 1.5;
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
    h->x[6] = nextafter(1.5, 0);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

/* The filter, the exact answer and the number of exact checks around the limit, for random triangles scaled to within +-k parts of it. */
static void test_around_the_limit(void **state)
{
    (void)state;
    uint64_t seed = 91;
    long exact = 0, rejected = 0;
    enum { SAMPLES = 4000 };
    for (int i = 0; i < SAMPLES; i++) {
        double limit = limits[i % 4], distance = pow(10, random_uniform(&seed, -17, -2)) * (random_below(&seed, 2) ? 1 : -1);
        hand_model *h = unit_triangle(limit);
        random_fill(&seed, h->model.rest, 9, 1);
        double c = random_uniform(&seed, -1, 1), s = sqrt(1 - c * c), scale = limit * (1 + distance);
        for (int k = 0; k < 3; k++) { /* turn about z and scale */
            const double *r = &h->model.rest[3 * k];
            h->x[3 * k] = scale * (c * r[0] - s * r[1]);
            h->x[3 * k + 1] = scale * (s * r[0] + c * r[1]);
            h->x[3 * k + 2] = scale * r[2];
        }
        monitor_trial t = look(h);
        bool below = cipc_exact_compare_stretch(h->model.rest, h->x, limit) > 0;
        assert_int_equal(t.status, below ? CIPC_OK : CIPC_E_VIOLATED_STRAIN);
        exact += t.report.exact_strain_checks;
        rejected += below ? 0 : 1;
        hand_model_destroy(h);
    }
    assert_true(rejected > SAMPLES / 3 && rejected < 2 * SAMPLES / 3);
    assert_true(exact < SAMPLES);  /* every rejected one, and those within rounding */
    assert_true(exact > rejected); /* some accepted ones needed it ... */
    assert_true(SAMPLES - exact >
                SAMPLES / 8); /* ... and many did not (equal stretches are the filter's worst case: det M is quadratic in the distance) */
}

/* Stretched in one direction only, oblique to the edges, to within a few ulp of the limit: det M in doubles is noise, of either sign. */
static void test_one_stretch_at_the_limit(void **state)
{
    (void)state;
    uint64_t seed = 93;
    long rejected = 0;
    enum { SAMPLES = 2000 };
    for (int i = 0; i < SAMPLES; i++) {
        double limit = limits[i % 4], scale = limit * (1 + random_uniform(&seed, -4, 4) * DBL_EPSILON);
        hand_model *h = unit_triangle(limit);
        double c = random_uniform(&seed, -1, 1), s = sqrt(1 - c * c);
        for (int k = 0; k < 3; k++) {
            double *r = &h->model.rest[3 * k], *x = &h->x[3 * k];
            r[0] = random_uniform(&seed, -1, 1);
            r[1] = random_uniform(&seed, -1, 1);
            double along = c * r[0] + s * r[1];
            x[0] = r[0] + (scale - 1) * along * c;
            x[1] = r[1] + (scale - 1) * along * s;
        }
        bool below = cipc_exact_compare_stretch(h->model.rest, h->x, limit) > 0;
        assert_int_equal(look(h).status, below ? CIPC_OK : CIPC_E_VIOLATED_STRAIN);
        rejected += below ? 0 : 1;
        hand_model_destroy(h);
    }
    assert_true(rejected > SAMPLES / 4 && rejected < 3 * SAMPLES / 4);
}

static void test_report(void **state)
{
    (void)state;
    hand_model *h = unit_triangle(1.5);
    h->x[3] = 1.25; /* stretch 1.25 of 1.5 */
    int free_body = hand_body(h, "free", 0, 0, false), bare = hand_body(h, "bare", 0, 0, false);
    for (int body = free_body; body <= bare; body++) {
        int a = hand_node(h, body, 0, 0, 5 * body);
        hand_node(h, body, 1, 0, 5 * body);
        hand_node(h, body, 0, 1, 5 * body);
        hand_triangle(h, a, a + 1, a + 2);
    }
    h->x[12] = 3;   /* the free body's: stretch 3, with a membrane and no limit */
    h->x[21] = 100; /* the bare body's: no membrane, not measured */
    h->model.bodies[bare].material.membrane = CIPC_MEMBRANE_NONE;
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_OK);
    assert_true(fabs(t.report.max_stretch - 3) < STRETCH_ERROR);
    assert_int_equal(t.report.max_stretch_triangle, 1);
    assert_true(fabs(t.report.max_stretch_ratio - 0.5) < STRETCH_ERROR);
    assert_int_equal(t.report.exact_strain_checks, 0);
    hand_model_destroy(h);
}

/* What is reported is the least double that is not below the exact stretch: of well-shaped triangles, slivers and collapsed ones. */
static void test_report_is_rounded_upwards(void **state)
{
    (void)state;
    uint64_t seed = 9;
    int slivers = 0;
    for (int trial = 0; trial < 200; trial++) {
        double rest[9], x[9], height = pow(10, random_uniform(&seed, -7, 0));
        for (int k = 0; k < 9; k++) {
            x[k] = random_uniform(&seed, -1, 1);
            rest[k] = random_uniform(&seed, -1, 1);
        }
        for (int k = 0; k < 3; k++) { rest[6 + k] = 0.5 * (rest[k] + rest[3 + k]) + height * rest[6 + k]; }
        hand_model *h = hand_model_create();
        hand_new_triangle(h, hand_body(h, "cloth", 0, 1e30, false), rest);
        memcpy(h->x, x, sizeof x);
        monitor_trial t = look(h);
        double up = t.report.max_stretch;
        assert_int_equal(t.status, CIPC_OK);
        assert_true(cipc_exact_compare_stretch(rest, x, up) >= 0);
        assert_int_equal(cipc_exact_compare_stretch(rest, x, nextafter(up, 0)), -1);
        assert_true(t.report.max_stretch_ratio == fmax(0, (up - 1) / (1e30 - 1)));
        slivers += height < 1e-5;
        hand_model_destroy(h);
    }
    assert_true(slivers >= 20);
    hand_model *h = unit_triangle(1.5);
    h->x[3] = 1.25;
    monitor_trial t = look(h);
    assert_true(t.report.max_stretch == 1.25 && t.report.max_stretch_ratio == 0.5); /* exact ones are exact */
    hand_model_destroy(h);
}

static void test_report_of_nothing(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    hand_node(h, hand_body(h, "point", 0, 0, false), 0, 0, 0);
    monitor_trial t = look(h);
    assert_true(t.status == CIPC_OK && t.report.max_stretch == 0 && t.report.max_stretch_triangle == -1 && t.report.max_stretch_ratio == 0);
    hand_model_destroy(h);
}

/* Rest shape and motion anywhere: a large common translation of the positions costs digits of the positions, not of the answer. */
static void test_large_common_translation(void **state)
{
    (void)state;
    hand_model *h = unit_triangle(1.0625);
    const double far[3] = {0x1p30, -0x1p30, 0x1p30};
    h->x[3] = 1.0625;
    hand_translate(h, far);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
    h->x[3] = nextafter(h->x[3], 0);
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

static void test_degenerate(void **state)
{
    (void)state;
    hand_model *h = unit_triangle(1.5);
    memset(h->x, 0, 9 * sizeof *h->x); /* collapsed to a point: no stretch at all */
    assert_int_equal(look(h).status, CIPC_OK);
    h->x[3] = 1.25; /* a line */
    assert_int_equal(look(h).status, CIPC_OK);
    memset(h->model.rest, 0, 9 * sizeof *h->x); /* no rest area: the stretch is infinite, or undefined */
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
    hand_model_destroy(h);
}

/* Forms that underflow or overflow are left to exact arithmetic. */
static void test_extreme_scales(void **state)
{
    (void)state;
    const int exponents[] = {-540, -300, 300, 520};
    for (int i = 0; i < 4; i++) {
        hand_model *h = unit_triangle(1.25);
        for (int k = 0; k < 9; k++) {
            h->model.rest[k] = ldexp(h->model.rest[k], exponents[i]);
            h->x[k] = h->model.rest[k];
        }
        h->x[3] = ldexp(1.25, exponents[i]);
        assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
        h->x[3] = nextafter(h->x[3], 0);
        monitor_trial t = look(h);
        assert_int_equal(t.status, CIPC_OK);
        assert_int_equal(t.report.exact_strain_checks, 1);
        hand_model_destroy(h);
    }
}

/* Several sections of triangles, any number of threads: the first violating triangle is named. */
static void test_many_triangles(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int body = hand_body(h, "cloth", 0, 1.1, false);
    const double o[3] = {0, 0, 0}, u[3] = {1, 0, 0}, v[3] = {0, 1, 0};
    hand_grid(h, body, o, u, v, 40, 40); /* 3200 triangles */
    cipc_invariant_options options = cipc_invariant_options_default();
    for (options.threads = 1; options.threads <= 4; options.threads++) {
        h->x[3 * 1500 + 2] = 0;
        monitor_trial t = try_monitor(cipc_monitor_strain, h, &options);
        assert_int_equal(t.status, CIPC_OK);
        h->x[3 * 1500 + 2] = 0.1;
        t = try_monitor(cipc_monitor_strain, h, &options);
        assert_int_equal(t.status, CIPC_E_VIOLATED_STRAIN);
        int first = 0;
        while (h->model.triangles[first][0] != 1500 && h->model.triangles[first][1] != 1500 && h->model.triangles[first][2] != 1500) {
            first++;
        }
        char name[32];
        snprintf(name, sizeof name, "triangle %d (", first);
        assert_non_null(strstr(t.error.what, name));
    }
    hand_model_destroy(h);
}

static void test_message(void **state)
{
    (void)state;
    hand_model *h = unit_triangle(1.25);
    h->x[3] = 1.5;
    monitor_trial t = look(h);
    const char *const parts[] = {"triangle 0 (nodes 0 1 2, body \"cloth\")", "1.5 (0x1.8p+0", "1.25 (0x1.4p+0)"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) { assert_non_null(strstr(t.error.what, parts[i])); }
    assert_string_equal(t.error.place, "monitor strain");
    h->x[3] = NAN;
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_FINITE);
    hand_model_destroy(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_ulp_from_the_limit),   cmocka_unit_test(test_shear),      cmocka_unit_test(test_around_the_limit),
        cmocka_unit_test(test_one_stretch_at_the_limit), cmocka_unit_test(test_report),     cmocka_unit_test(test_report_is_rounded_upwards), cmocka_unit_test(test_report_of_nothing),
        cmocka_unit_test(test_large_common_translation), cmocka_unit_test(test_degenerate), cmocka_unit_test(test_extreme_scales),
        cmocka_unit_test(test_many_triangles),           cmocka_unit_test(test_message),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
