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

/* --- lower limits --- */

static void test_one_ulp_from_the_lower_limit(void **state)
{
    (void)state;
    const double lower[] = {0.9, 0.7, 0.999};
    for (int i = 0; i < 3; i++) {
        hand_model *h = unit_triangle(2);
        h->model.bodies[0].material.strain_lower_limit = lower[i];
        h->x[3] = 1.5;
        h->x[7] = lower[i];
        monitor_trial t = look(h);
        assert_int_equal(t.status, CIPC_E_VIOLATED_STRAIN);
        assert_true(t.report.exact_strain_checks == 1 && t.report.max_stretch_ratio == 1);
        assert_non_null(strstr(t.error.what, "least principal stretch"));
        assert_non_null(strstr(t.error.what, "rounded downwards) must be above the limit"));
        h->x[7] = nextafter(lower[i], 1);
        t = look(h);
        assert_int_equal(t.status, CIPC_OK);
        assert_int_equal(t.report.exact_strain_checks, 1);
        h->x[7] = nextafter(lower[i], 0);
        assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
        memset(h->x, 0, 9 * sizeof *h->x); /* collapsed */
        assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
        h->model.bodies[0].material.strain_lower_limit = 0;
        assert_int_equal(look(h).status, CIPC_OK);
        hand_model_destroy(h);
    }
}

/* The verdict is exact arithmetic's in whatever shape, near the limit and far from it; the filter decides most. */
static void test_lower_limit_of_random_triangles(void **state)
{
    (void)state;
    uint64_t seed = 97;
    long exact = 0, rejected = 0;
    enum { SAMPLES = 4000 };
    for (int i = 0; i < SAMPLES; i++) {
        double limit = 0.8, distance = pow(10, random_uniform(&seed, -17, -0.5)) * (random_below(&seed, 2) ? 1 : -1);
        hand_model *h = unit_triangle(0);
        h->model.bodies[0].material.strain_lower_limit = limit;
        double c = random_uniform(&seed, -1, 1), s = sqrt(1 - c * c);
        for (int k = 0; k < 3; k++) {
            double *r = &h->model.rest[3 * k], *x = &h->x[3 * k];
            r[0] = random_uniform(&seed, -1, 1);
            r[1] = random_uniform(&seed, -1, 1);
            double along = c * r[0] + s * r[1];
            x[0] = r[0] + (limit * (1 + distance) - 1) * along * c;
            x[1] = r[1] + (limit * (1 + distance) - 1) * along * s;
        }
        bool above = cipc_exact_compare_least_stretch(h->model.rest, h->x, limit) > 0;
        monitor_trial t = look(h);
        assert_int_equal(t.status, above ? CIPC_OK : CIPC_E_VIOLATED_STRAIN);
        exact += t.report.exact_strain_checks;
        rejected += above ? 0 : 1;
        hand_model_destroy(h);
    }
    assert_true(rejected > SAMPLES / 3 && rejected < 2 * SAMPLES / 3 && exact > rejected && exact < SAMPLES - SAMPLES / 8);
}

/* --- woven cloth --- */

/* The unit triangle, warp along x, limits of the three Green strains. */
static hand_model *fabric(double warp, double weft, double shear)
{
    hand_model *h = unit_triangle(0);
    cipc_material *m = &h->model.bodies[0].material;
    m->membrane = CIPC_MEMBRANE_ORTHOTROPIC;
    m->orthotropic = (cipc_orthotropic_material){.limits = {warp, weft, shear}, .warp = {3, 0, 0}};
    return h;
}

/* Coordinate `which` of the unit triangle set to a border and its neighbours; `outwards` is the direction that is forbidden. */
static void assert_fabric_border(hand_model *h, int which, double border, double outwards, const char *name)
{
    h->x[which] = border;
    monitor_trial t = look(h);
    assert_int_equal(t.status, CIPC_E_VIOLATED_STRAIN);
    assert_true(t.report.max_stretch_ratio == 1);
    assert_non_null(strstr(t.error.what, name));
    h->x[which] = nextafter(border, outwards);
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
    h->x[which] = nextafter(border, -outwards);
    t = look(h);
    assert_int_equal(t.status, CIPC_OK);
    assert_true(t.report.max_stretch_ratio <= 1 && t.report.max_stretch_ratio > 1 - 1e-14);
    assert_true(t.report.exact_strain_checks >= 1);
}

static void test_fabric_one_ulp_from_the_limits(void **state)
{
    (void)state;
    const double stretched = 9. / 32; /* (1.25^2 - 1)/2 */
    hand_model *h = fabric(stretched, 10, 10);
    assert_fabric_border(h, 3, 1.25, INFINITY, "along the warp");
    hand_model_destroy(h);
    h = fabric(10, stretched, 10);
    assert_fabric_border(h, 7, 1.25, INFINITY, "along the weft");
    hand_model_destroy(h);
    h = fabric(10, 10, 0.25); /* sheared by 1/2, either way */
    assert_fabric_border(h, 6, 0.5, INFINITY, "in shear");
    assert_fabric_border(h, 6, -0.5, -INFINITY, "in shear");
    hand_model_destroy(h);
    h = fabric(3. / 8, 10, 10); /* compressed to 1/2: strains count in magnitude */
    h->x[3] = 0.5;
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
    h->x[3] = nextafter(0.5, 1);
    assert_int_equal(look(h).status, CIPC_OK);
    h->model.bodies[0].material.membrane = CIPC_MEMBRANE_STVK; /* not woven: these limits mean nothing */
    h->x[3] = 9;
    assert_int_equal(look(h).status, CIPC_OK);
    hand_model_destroy(h);
}

/* Warp and weft are not the edges of the triangle: weft given, oblique; left out, across the warp; both out of the plane. */
static void test_fabric_directions(void **state)
{
    (void)state;
    hand_model *h = fabric(10, 9. / 32, 10);
    h->x[3] = 1.25; /* stretched along x, the warp */
    assert_int_equal(look(h).status, CIPC_OK);
    cipc_orthotropic_material *m = &h->model.bodies[0].material.orthotropic;
    m->warp[0] = 0;
    m->warp[1] = 1;
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN); /* across it */
    m->weft[1] = m->weft[2] = 2; /* along y */
    assert_int_equal(look(h).status, CIPC_OK);
    m->weft[0] = 1e-9;
    m->weft[1] = 0; /* along x, but for what sticks out */
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
    m->weft[0] = 0; /* no direction in the plane */
    assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
    hand_model_destroy(h);
}

/* The verdict is exact arithmetic's for random shapes, directions and limits within +-k parts of the strain; the filter decides most. */
static void test_fabric_against_exact_arithmetic(void **state)
{
    (void)state;
    uint64_t seed = 99;
    long exact = 0, rejected = 0, one = 0;
    enum { SAMPLES = 4000 };
    for (int i = 0; i < SAMPLES; i++) {
        hand_model *h = fabric(1e9, 1e9, 1e9);
        cipc_orthotropic_material *m = &h->model.bodies[0].material.orthotropic;
        random_fill(&seed, h->model.rest, 9, 1);
        random_fill(&seed, h->x, 9, 1);
        random_fill(&seed, m->warp, 3, 1);
        if (i % 2) { random_fill(&seed, m->weft, 3, 1); }
        monitor_trial t = look(h);
        if (t.status == CIPC_OK) {
            double used = t.report.max_stretch_ratio * 1e9, distance = pow(10, random_uniform(&seed, -17, -2)) * (random_below(&seed, 2) ? 1 : -1);
            for (int k = 0; k < 3; k++) { m->limits[k] = used * (1 + distance); }
            bool below = true;
            for (int k = 0; k < 3; k++) {
                below = below && cipc_exact_compare_green_strain((cipc_green_strain)k, h->model.rest, h->x, m->warp, m->weft, m->limits[k]) > 0;
            }
            t = look(h);
            assert_int_equal(t.status, below ? CIPC_OK : CIPC_E_VIOLATED_STRAIN);
            one += t.report.exact_strain_checks == 1;
            exact += t.report.exact_strain_checks > 0;
            rejected += below ? 0 : 1;
        }
        hand_model_destroy(h);
    }
    assert_true(rejected > SAMPLES / 3 && rejected < 2 * SAMPLES / 3 && one > SAMPLES / 2);
    assert_true(exact > rejected && exact < SAMPLES - SAMPLES / 4);
}

/* Where there is no filter for a triangle exact arithmetic decides: scales at which the axes overflow or underflow. */
static void test_fabric_of_extreme_scales(void **state)
{
    (void)state;
    const int exponents[] = {-1000, -300, 300, 950};
    for (int i = 0; i < 4; i++) {
        hand_model *h = fabric(9. / 32, 9. / 32, 9. / 32);
        for (int k = 0; k < 9; k++) {
            h->model.rest[k] = ldexp(h->model.rest[k], exponents[i]);
            h->x[k] = h->model.rest[k];
        }
        assert_int_equal(look(h).status, CIPC_OK);
        h->x[3] = ldexp(1.25, exponents[i]);
        assert_int_equal(look(h).status, CIPC_E_VIOLATED_STRAIN);
        h->x[3] = nextafter(h->x[3], 0);
        assert_int_equal(look(h).status, CIPC_OK);
        hand_model_destroy(h);
    }
}

/* All limits together: the one used most is reported, the first triangle's violated. The surfaces of volumes have none. */
static void test_largest_used_fraction(void **state)
{
    (void)state;
    hand_model *h = unit_triangle(2);
    h->model.bodies[0].material.strain_lower_limit = 0.5;
    h->x[3] = 1.25; /* a quarter of the way up */
    h->x[7] = 0.75; /* half of the way down */
    monitor_trial t = look(h);
    assert_true(t.status == CIPC_OK && t.report.max_stretch == 1.25 && t.report.max_stretch_ratio == 0.5);
    assert_int_equal(cipc_invariant_limited_triangles(&h->model), 0); /* hand-made: bodies do not know their triangles */
    h->model.bodies[0].triangle_count = 1;
    assert_int_equal(cipc_invariant_limited_triangles(&h->model), 1);
    h->model.bodies[0].kind = CIPC_BODY_VOLUME;
    h->x[3] = 9;
    t = look(h);
    assert_true(t.status == CIPC_OK && t.report.max_stretch == 0 && t.report.max_stretch_ratio == 0);
    assert_int_equal(cipc_invariant_limited_triangles(&h->model), 0);
    hand_model_destroy(h);
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
        cmocka_unit_test(test_one_ulp_from_the_lower_limit),
        cmocka_unit_test(test_lower_limit_of_random_triangles),
        cmocka_unit_test(test_fabric_one_ulp_from_the_limits),
        cmocka_unit_test(test_fabric_directions),
        cmocka_unit_test(test_fabric_against_exact_arithmetic),
        cmocka_unit_test(test_fabric_of_extreme_scales),
        cmocka_unit_test(test_largest_used_fraction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
