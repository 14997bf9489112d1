/* Steps that keep an element's limit all along, held against dense samples of random paths; the jump through a limit to the other side of it; known ends. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/energy.h"
#include "implicit/element_limits.h"
#include "support/exact_geometry.h"

static const double rest[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
enum { LIMITS = 4, PATHS = 400, SAMPLES = 500 };

/* The four limits on the rest triangle or tetrahedron. */
typedef struct subject {
    const element_limit *limit;
    int nodes;
    cipc_strain_limit upper, lower;
    cipc_orthotropic cloth;
    cipc_volume volume;
    const void *params;
} subject;

static void make(subject *s, int which)
{
    const double moduli[4] = {2, 1, 2, 1}, limits[3] = {0.3, 0.3, 0.2}, warp[3] = {1, 0.3, 0};
    const element_limit *const all[LIMITS] = {&implicit_limit_upper, &implicit_limit_lower, &implicit_limit_strains, &implicit_limit_volume};
    assert_true(cipc_strain_limit_init(&s->upper, rest, 1, 1.3, 1, 1) && cipc_strain_limit_lower_init(&s->lower, rest, 1, 0.7, 1, 1));
    assert_true(cipc_orthotropic_init(&s->cloth, rest, 1, warp, NULL, moduli, limits) && cipc_volume_init(&s->volume, rest, 1, 0.3));
    const void *const params[LIMITS] = {&s->upper, &s->lower, &s->cloth, &s->volume};
    s->limit = all[which];
    s->params = params[which];
    s->nodes = which == 3 ? 4 : 3;
}

static double slack_at(const subject *s, const double *d, double t)
{
    double y[12];
    for (int i = 0; i < 3 * s->nodes; i++) y[i] = rest[i] + t * d[i];
    return s->limit->slack(s->params, y);
}

/* A step ends with this much of the slack or less. */
static const double slack_left = 0.1;

/* Kept at every sample of the step; and no shorter than is due, on paths that are not so long that the advances run out: these (every other one) may end anywhere. */
static void test_kept_all_along(void **state)
{
    (void)state;
    uint64_t seed = 17;
    for (int which = 0; which < LIMITS; which++) {
        subject s;
        int cut = 0, through = 0;
        make(&s, which);
        double first = s.limit->slack(s.params, rest);
        assert_true(first > 0);
        for (int path = 0; path < PATHS; path++) {
            double d[12], step;
            random_fill(&seed, d, 3 * s.nodes, path % 2 ? 3 : 0.3);
            step = implicit_limit_step(s.limit, s.params, s.nodes, rest, d, 1);
            assert_true(step > 0 && step <= 1);
            for (int k = 0; k <= SAMPLES; k++)
                if (!(slack_at(&s, d, step * k / SAMPLES) > 0)) fail_msg("limit %d, path %d: step %g, but at %g of it the slack is %g", which, path, step, (double)k / SAMPLES, slack_at(&s, d, step * k / SAMPLES));
            cut += step < 1;
            if (step < 1 && slack_at(&s, d, 1) > 0) through++; /* both ends are good, the path is not */
            if (step < 1 && path % 2 == 0 && !(slack_at(&s, d, step) <= slack_left * first)) fail_msg("limit %d, path %d: ends at %g with %g of the slack left", which, path, step, slack_at(&s, d, step) / first);
        }
        assert_true(cut > PATHS / 10 && cut < PATHS);
        assert_true(which == 0 ? through == 0 : through > 0);
    }
}

/* The third node goes through the opposite side to where the triangle is as large as before. */
static void test_turning_inside_out(void **state)
{
    (void)state;
    double d[12] = {0};
    subject s;
    make(&s, 1);
    d[7] = -2;
    assert_true(slack_at(&s, d, 1) > 0);
    double step = implicit_limit_step(s.limit, s.params, 3, rest, d, 1); /* sigma_2 = 1 - 2 t comes to 0.7 at 0.15 */
    assert_true(step < 0.15 && step > 0.15 * 0.89);
}

/* Each node of a tetrahedron alone, through the opposite face and on: det = 1 - 2 t for those on the axes. */
static void test_each_node_through_its_face(void **state)
{
    (void)state;
    subject s;
    make(&s, 3);
    for (int node = 1; node < 4; node++) {
        double d[12] = {0};
        d[3 * node + node - 1] = -2;
        double step = implicit_limit_step(s.limit, s.params, 4, rest, d, 1);
        assert_true(step < 0.5 && step >= 0.45);
    }
}

/* Shear alone: the weft leans over, E12 = t/2 and E22 = t^2/2, so that E12 meets its limit 0.2 at 0.4, E22 its 0.3 at 0.77. */
static void test_shear_alone(void **state)
{
    (void)state;
    const double moduli[4] = {2, 1, 2, 1}, limits[3] = {0.3, 0.3, 0.2}, warp[3] = {1, 0, 0};
    double d[9] = {0};
    cipc_orthotropic cloth;
    assert_true(cipc_orthotropic_init(&cloth, rest, 1, warp, NULL, moduli, limits));
    d[6] = 0.7;
    double step = implicit_limit_step(&implicit_limit_strains, &cloth, 3, rest, d, 1);
    assert_true(0.7 * step < 0.4 && 0.7 * step >= 0.36);
}

static void test_start_beyond(void **state)
{
    (void)state;
    for (int which = 0; which < LIMITS; which++) {
        subject s;
        double y[12], d[12] = {0};
        make(&s, which);
        memcpy(y, rest, sizeof y);
        if (which == 3) y[11] = -1;
        else y[7] = which == 0 ? 2 : 0.1;
        assert_true(s.limit->slack(s.params, y) < 0);
        assert_true(implicit_limit_step(s.limit, s.params, s.nodes, y, d, 1) == 0);
        assert_true(implicit_limit_step(s.limit, s.params, s.nodes, rest, d, 0.5) == 0.5); /* and one that rests may go on */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_kept_all_along), cmocka_unit_test(test_turning_inside_out), cmocka_unit_test(test_each_node_through_its_face), cmocka_unit_test(test_shear_alone), cmocka_unit_test(test_start_beyond)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
