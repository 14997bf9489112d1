/* Damping, a reconstruction [R] (SPEC A.8): what is proportional to the stiffness of one element takes the same part of its swing's energy in every tick. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "asynchronous/integrator.h"
#include "base/vector.h"
#include "support/asynchronous_scene.h"
#include "support/validation.h"

/* One degree of freedom C, a tick every h: C += h C', then C' -= h omega^2 (C + beta C'). That is a linear map with the determinant D = 1 - h beta omega^2, and what two points of the plane span with
 * their images changes by D: Q = C'^2 + omega^2 (beta + h) C C' + omega^2 C^2 is D^k Q_0 after k ticks, whatever the phase. */
typedef struct swing { double value, rate; } swing;

static double form(swing s, double omega2, double beta, double h) { return s.rate * s.rate + omega2 * (beta + h) * s.value * s.rate + omega2 * s.value * s.value; }

/* Steps of the element that is the only one, its ticks counted. */
static double only_step(const asynchronous_scene *s)
{
    assert_int_equal(s->integrator->clock_count, 1);
    assert_int_equal(s->integrator->clocks[0].count, 1);
    return s->integrator->clocks[0].h;
}

typedef swing measure(const asynchronous_scene *s);

/* Energy-like Q against its closed form at every frame until it has fallen by a factor of 100. */
static void decays(asynchronous_scene *s, measure *look, double omega2, double beta, double tolerance, const char *what)
{
    const double h = only_step(s), loss = 1 - h * beta * omega2, start = form(look(s), omega2, beta, h);
    double off = 0, left = 1;
    assert_true(loss > 0 && loss < 1 && start > 0);
    while (left > 0.01) {
        asynchronous_steps(s, 1);
        long ticks = s->events[CIPC_EVENT_STRETCHING] + s->events[CIPC_EVENT_BENDING];
        left = form(look(s), omega2, beta, h) / start;
        off = fmax(off, fabs(left / pow(loss, (double)ticks) - 1));
    }
    const double decay = -log(left) / s->sheet.state->time;
    print_message("%s: omega = %.4g/s, beta = %.3g s, h = %.3g s: %.3g left, off its closed form by %.2g; rate %.5g/s, beta omega^2 = %.5g/s\n", what, sqrt(omega2), beta, h, left, off, decay, beta * omega2);
    char scene[128];
    (void)snprintf(scene, sizeof scene, "asynchronous: damped swing of a %s", what);
    validation_row(scene, "decay of its energy, 1/s", -log(loss) / h, decay, tolerance);
    assert_true(off < tolerance);
    /* -log(1 - y)/y - 1 < y for y < 1/2: the rate is beta omega^2 of the differential equation, but for a part y of it. */
    assert_true(fabs(decay / (beta * omega2) - 1) < h * beta * omega2 + tolerance);
}

/* ---- A segment that stretches: C = l - L, exactly linear along its line ------------------------------------------------------------------- */

static const double length = 0.5, thickness = 0.01, density = 1000;

static swing extension(const asynchronous_scene *s)
{
    const double *x = s->sheet.state->position, *v = s->sheet.state->velocity;
    return (swing){x[3] - x[0] - length, v[3] - v[0]};
}

static void test_segment(void **state)
{
    (void)state;
    static const int segment[1][2] = {{0, 1}};
    const double young = 1e5, beta = 2e-3, ends[6] = {0, 0, 0, length, 0, 0}, velocity[6] = {-0.3, 0, 0, 0.5, 0, 0};
    const double omega2 = 4 * young / (density * length * length); /* k = E A/L, half of rho A L in either end */
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    const cipc_body_description body = {.name = "segment", .kind = CIPC_BODY_RODS, .node_count = 2, .rest = ends, .position = ends, .velocity = velocity, .segment_count = 1, .segments = segment,
                                        .material = {.density = density, .thickness = thickness, .young = young, .damping_stiffness = beta}};
    sheet_add(&s.sheet, &body);
    asynchronous_scene_build(&s);
    decays(&s, extension, omega2, beta, 1e-9 /* positions are rounded by 1e-16 m in each of some hundred ticks, the swings are of 1e-3 m in the end */, "segment");
    asynchronous_scene_free(&s);
}

/* Angles are of 1e-4 at most: what is of second order in them is below 1e-8. Their rates, 1e-4/s in the end, are differences over 2e-6 s of angles good to 1e-16: 1e-10/s. */
static const double small_angles = 1e-5;

/* ---- A hinge: C = the angle ------------------------------------------------------------------------------------------------------------------ */

enum { SIDE = 1 };
static const double angle_at_start = 1e-4;

/* Angle between the normals of (0 1 2) and (1 0 3), the shared edge along z; and how it changes, by the difference over a short time. */
static double angle_of(const double *x)
{
    double e[3], a[3], b[3], n[3], m[3], across[3];
    v3_sub(e, x + 3, x);
    v3_sub(a, x + 6, x);
    v3_sub(b, x + 9, x);
    v3_cross(n, e, a);
    v3_cross(m, b, e);
    v3_cross(across, n, m);
    return atan2(v3_dot(across, e) / v3_norm(e), v3_dot(n, m));
}

static swing fold(const asynchronous_scene *s)
{
    static const double short_time = 1e-6;
    double before[12], after[12];
    for (int i = 0; i < 12; i++) {
        before[i] = s->sheet.state->position[i] - short_time * s->sheet.state->velocity[i];
        after[i] = s->sheet.state->position[i] + short_time * s->sheet.state->velocity[i];
    }
    return (swing){angle_of(s->sheet.state->position), (angle_of(after) - angle_of(before)) / (2 * short_time)};
}

static void test_hinge(void **state)
{
    (void)state;
    static const int triangles[2][3] = {{0, 1, 2}, {1, 0, 3}};
    const double young = 1e11, sheet = 1e-3, beta = 0.01, height = sqrt(0.75) * SIDE, tip = height * angle_at_start / 4;
    /* Bent by raising the edge and lowering the tips by as much: the outer nodes are as heavy as a third of a triangle, those of the edge twice that. */
    const double flat[12] = {0, 0, 0, 0, 0, SIDE, height, 0, SIDE / 2.0, -height, 0, SIDE / 2.0}, bent[12] = {0, tip, 0, 0, tip, SIDE, height, -2 * tip, SIDE / 2.0, -height, -2 * tip, SIDE / 2.0};
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    cipc_body_description body = {.name = "hinge", .kind = CIPC_BODY_SHELL, .node_count = 4, .rest = flat, .position = bent, .triangle_count = 2, .triangles = triangles};
    body.material = (cipc_material){.density = density, .thickness = sheet, .bending_young = young, .bending_poisson = 0.3, .damping_stiffness = beta};
    sheet_add(&s.sheet, &body);
    asynchronous_scene_build(&s);
    /* E = k theta^2 3 e^2/(A1 + A2), k = D/6 (SPEC F1); gradient of the angle: 1/height at the tips, minus that at each end of the edge in sum over both triangles. */
    const double *m = s.sheet.model->mass, rigidity = young * sheet * sheet * sheet / (12 * (1 - 0.3 * 0.3)), area = height * SIDE / 2;
    const double twice_k = 2 * rigidity / 6 * 3 * SIDE * SIDE / (2 * area), omega2 = twice_k * (2 / m[2] + 2 / m[0]) / (height * height);
    decays(&s, fold, omega2, beta, small_angles, "hinge");
    asynchronous_scene_free(&s);
}

/* ---- A joint of a rod: damped along the gradient of its energy ------------------------------------------------------------------------------ */

static swing bow(const asynchronous_scene *s)
{
    const double *x = s->sheet.state->position, *v = s->sheet.state->velocity;
    return (swing){(2 * x[4] - x[1] - x[7]) / length, (2 * v[4] - v[1] - v[7]) / length};
}

static void test_joint(void **state)
{
    (void)state;
    static const int segments[2][2] = {{0, 1}, {1, 2}};
    const double young = 1e9, beta = 5e-3, up = length * angle_at_start / 4, straight[9] = {0, 0, 0, length, 0, 0, 2 * length, 0, 0}, bent[9] = {0, -up, 0, length, up, 0, 2 * length, -up, 0};
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    const cipc_body_description body = {.name = "joint", .kind = CIPC_BODY_RODS, .node_count = 3, .rest = straight, .position = bent, .segment_count = 2, .segments = segments,
                                        .material = {.density = density, .thickness = thickness, .bending_young = young, .damping_stiffness = beta}};
    sheet_add(&s.sheet, &body);
    asynchronous_scene_build(&s);
    /* E = 1/2 E I phi^2/length for a small turn phi, I = pi d^4/64 (docs/theory/energies.md). */
    const double *m = s.sheet.model->mass, twice_k = young * acos(-1) / 64 * pow(thickness, 4) / length, omega2 = twice_k * (1 / m[0] + 4 / m[1] + 1 / m[2]) / (length * length);
    decays(&s, bow, omega2, beta, small_angles, "joint");
    asynchronous_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_segment),
        cmocka_unit_test(test_hinge),
        cmocka_unit_test(test_joint),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
