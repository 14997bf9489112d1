/* What the scenes of asynchronous contact mechanics are there to show, at size ci; and that each run is, bit for bit, the run that is taken up on the way. That nothing passes
 * anything is not looked at here: the monitors look at every frame and all paths of these runs where they are held against golden files (test_golden_*.c). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include "base/vector.h"
#include "cipc/asynchronous.h"
#include "cipc/invariant.h"
#include "cipc/scene.h"
#include "support/sample_run.h"

/* ---- A run under way -------------------------------------------------------------------------------------------------------- */

typedef struct show {
    const char *name;
    cipc_scene *scene;
    const cipc_model *model;
    cipc_state *state;
    cipc_asynchronous *integrator;
    cipc_asynchronous_report report; /* of the last step */
    cipc_error error;
    double *start;                   /* positions; kept for comparison */
    double *position, *velocity;     /* of the last whole frame */
    int steps;                       /* up to there */
} show;

static void keep(show *s)
{
    const size_t size = 3 * (size_t)s->model->node_count * sizeof *s->position;
    memcpy(s->position, s->state->position, size);
    memcpy(s->velocity, s->state->velocity, size);
    s->steps = s->state->step;
}

/* From here on nothing is known but the state. */
static void take_up(show *s)
{
    cipc_asynchronous_destroy(s->integrator);
    if (cipc_asynchronous_create(&s->integrator, s->model, &s->scene->asynchronous, &s->error) != CIPC_OK) fail_msg("%s: %s", s->name, s->error.what);
}

static show open_show(const char *name, int override_count, const char *const *overrides)
{
    char file[128];
    show s = {.name = name};
    snprintf(file, sizeof file, "tests/scenes/%s.json", name);
    if (cipc_scene_load(&s.scene, file, override_count, overrides, &s.error) != CIPC_OK) fail_msg("%s: %s", s.error.place, s.error.what);
    assert_int_equal(s.scene->method, CIPC_METHOD_ASYNCHRONOUS);
    s.model = s.scene->model;
    s.state = s.scene->state;
    const size_t count = 3 * (size_t)s.model->node_count;
    s.start = calloc(count, sizeof *s.start);
    s.position = calloc(count, sizeof *s.position);
    s.velocity = calloc(count, sizeof *s.velocity);
    assert_true(s.start != NULL && s.position != NULL && s.velocity != NULL);
    memcpy(s.start, s.state->position, count * sizeof *s.start);
    take_up(&s);
    return s;
}

static void close_show(show *s)
{
    cipc_asynchronous_destroy(s->integrator);
    cipc_scene_destroy(s->scene);
    free(s->start);
    free(s->position);
    free(s->velocity);
}

/* One more frame; false at the end of the scene. */
static bool frame(show *s)
{
    if (s->state->step >= s->scene->steps) return false;
    if (cipc_asynchronous_step(s->integrator, s->state, &s->report, &s->error) != CIPC_OK) fail_msg("%s: %s: %s", s->name, s->error.place, s->error.what);
    keep(s);
    return true;
}

/* The same scene once more, taken up by another integrator half way. */
static void assert_same_when_taken_up(const show *s)
{
    show other = open_show(s->name, 0, NULL);
    while (other.steps < s->steps) {
        assert_true(frame(&other));
        if (other.steps == s->steps / 2) take_up(&other);
    }
    const size_t size = 3 * (size_t)s->model->node_count * sizeof *s->position;
    assert_memory_equal(other.position, s->position, size);
    assert_memory_equal(other.velocity, s->velocity, size);
    close_show(&other);
}

/* That comparison can fail: a run that starts one unit in the last place higher goes elsewhere. */
static void test_comparison_sees_one_ulp(void **state)
{
    (void)state;
    show s = open_show("pulled-knot", 0, NULL), other = open_show("pulled-knot", 0, NULL);
    other.state->position[1] = nextafter(other.state->position[1], 1);
    while (s.steps < 5 && frame(&s) && frame(&other)) {}
    assert_memory_not_equal(s.position, other.position, 3 * (size_t)s.model->node_count * sizeof(double));
    close_show(&s);
    close_show(&other);
}

static const cipc_body *body_of(const show *s, const char *name)
{
    for (int b = 0; b < s->model->body_count; b++) {
        if (strcmp(s->model->bodies[b].name, name) == 0) return &s->model->bodies[b];
    }
    fail_msg("%s has no body %s", s->name, name);
    return NULL;
}

/* Bounding box of a body at positions x. */
typedef struct extent { double low[3], high[3]; } extent;

static extent extent_of(const cipc_body *body, const double *x)
{
    extent e = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 3 * body->first_node; i < 3 * (body->first_node + body->node_count); i++) {
        e.low[i % 3] = fmin(e.low[i % 3], x[i]);
        e.high[i % 3] = fmax(e.high[i % 3], x[i]);
    }
    return e;
}

/* ---- Particles -------------------------------------------------------------------------------------------------------------- */

static double particle_mass(const show *s)
{
    return s->model->mass[body_of(s, "particle")->first_node];
}

/* Above the place where contact sets on. */
static double particle_energy(const show *s, double onset)
{
    const int node = body_of(s, "particle")->first_node;
    const double m = particle_mass(s);
    return s->report.kinetic + m * 9.81 * (s->position[3 * node + 1] - onset);
}

/* A bounce: what the layers have taken when the particle is deepest, by then E + m g depth, they give back but for 1 - e^2. */
static double energy_after(double energy, double e, double weight, double depth)
{
    return e * e * (energy + weight * depth) - weight * depth;
}

/* Bounces lose 3/4 of the energy, and it comes to rest in layer 1. There the layer pushes with F while the particle sinks and with e^2 F while it rises, so that it can lie wherever
 * e^2 F <= m g <= F (docs/theory/asynchronous.md, section 11): with gravity ticking as often as the layer, where F is hardly more. F = m g is a twentieth of eta(1) deep by the rule for r(1). */
static void test_falling_particle_comes_to_rest(void **state)
{
    (void)state;
    static const int before_first = 5, after_first = 13, after_second = 20; /* it falls; it is in the air after one impact, after two */
    static const double off = 0.02;      /* of the energy, by finite steps; measured: 0.005 */
    static const double hardly = 1.1;    /* measured: 1.02 */
    show s = open_show("falling-particle", 0, NULL);
    const double eta = s.scene->asynchronous.thickness, e = s.scene->asynchronous.restitution, onset = eta + cipc_model_pair_offset(s.model, 0, 1);
    const double weight = 9.81 * particle_mass(&s);
    double energy[3] = {0, 0, 0}, deepest[2] = {0, 0};
    int layers = 0, alone = 0;
    while (frame(&s)) {
        if (s.steps == before_first) energy[0] = particle_energy(&s, onset);
        if (s.steps == after_first) energy[1] = particle_energy(&s, onset);
        if (s.steps == after_second) energy[2] = particle_energy(&s, onset);
        if (s.steps <= after_first) deepest[0] = fmax(deepest[0], eta - s.report.min_gap);
        if (s.steps > after_first && s.steps <= after_second) deepest[1] = fmax(deepest[1], eta - s.report.min_gap);
        layers = s.report.layers > layers ? s.report.layers : layers;
        alone = s.report.layers == 1 && s.report.contacts == 1 ? alone + 1 : 0;
    }
    const double depth = onset - s.position[3 * body_of(&s, "particle")->first_node + 1], speed = fabs(s.velocity[1]);
    print_message("falling particle: %d layers in the first impact, energies %.4g, %.4g, %.4g J; the last %d frames in layer 1, %.4f of eta(1) deep, %.2g m/s\n", layers, energy[0], energy[1],
                  energy[2], alone, depth / eta, speed);
    assert_true(layers > 1);
    for (int k = 0; k < 2; k++) {
        const double expected = energy_after(energy[k], e, weight, deepest[k]);
        print_message("impact %d: %.4g m deep, leaves %.4f of the energy, expected %.4f\n", k + 1, deepest[k], energy[k + 1] / energy[k], expected / energy[k]);
        assert_true(fabs(energy[k + 1] - expected) < off * energy[k]);
    }
    assert_true(alone > s.steps / 2);
    assert_true(depth / eta > 0.05 && depth / eta < 0.05 * hardly);
    assert_true(speed <= 2 * 9.81 * s.scene->asynchronous.gravity_step);
    assert_same_when_taken_up(&s);
    close_show(&s);
}

/* SPEC T-A1: at 30 m/s 20 layers, to the gap at which they hold all of the kinetic energy, and back as fast as before; each but for n gamma^2 of the energy. */
static void test_head_on_takes_twenty_layers(void **state)
{
    (void)state;
    show s = open_show("head-on", 0, NULL);
    const cipc_asynchronous_options *o = &s.scene->asynchronous;
    const double energy = 0.5 * particle_mass(&s) * 900, slack = 20 * o->layer_factor * o->layer_factor;
    double gap = INFINITY;
    int layers = 0;
    assert_true(fabs(particle_mass(&s) - 1) < 1e-12);
    while (frame(&s)) {
        gap = fmin(gap, s.report.min_gap);
        layers = s.report.layers > layers ? s.report.layers : layers;
    }
    print_message("head-on: %d layers, least gap %.7f m, where they hold %.7f of the energy; back at %.6f m/s\n", layers, gap, cipc_layer_energy(o->thickness, o->stiffness, gap) / energy, s.velocity[1]);
    assert_int_equal(layers, 20);
    assert_true(fabs(cipc_layer_energy(o->thickness, o->stiffness, gap) / energy - 1) < slack);
    assert_true(s.velocity[0] == 0 && s.velocity[2] == 0 && fabs(s.velocity[1] * s.velocity[1] / 900 - 1) < slack);
    assert_int_equal(s.report.contacts, 0);
    assert_same_when_taken_up(&s);
    close_show(&s);
}

/* ---- Curtains --------------------------------------------------------------------------------------------------------------- */

/* Slowly few layers, at 16 m/s many; what is far from the particle goes on at its own pace; and the curtains still swing when the particle is long gone. */
static void test_curtains_keep_their_pace(void **state)
{
    (void)state;
    static const double fast_from = 0.325; /* s */
    enum { SLOW_LAYERS = 8, FAST_LAYERS = 20 };
    show s = open_show("curtains", 0, NULL);
    int slow = 0, fast = 0;
    double own = 0, median = INFINITY, least = INFINITY, slow_kinetic = 0;
    while (frame(&s)) {
        const double *steps = s.report.vertex_steps;
        own = s.steps == 1 ? steps[CIPC_QUANTILES / 2] : own; /* nothing touches yet */
        median = fmin(median, steps[CIPC_QUANTILES / 2]);
        least = fmin(least, steps[0]);
        if (s.state->time < fast_from) {
            slow = s.report.layers > slow ? s.report.layers : slow;
            slow_kinetic = fmax(slow_kinetic, s.report.kinetic);
        }
        fast = s.report.layers > fast ? s.report.layers : fast;
    }
    print_message("curtains: layer %d slowly, %d fast; median vertex step at least %.4g of the %.4g s without contact, the least vertex step %.3g s; kinetic energy %.3g J slowly, %.3g J at the end\n", slow,
                  fast, median / own, own, least, slow_kinetic, s.report.kinetic);
    assert_true(slow > 0 && slow <= SLOW_LAYERS && fast >= FAST_LAYERS);
    assert_true(own > 0 && median >= own / 4 && least < own / 50);
    assert_true(s.report.kinetic > slow_kinetic);
    assert_same_when_taken_up(&s);
    close_show(&s);
}

/* ---- Knots ------------------------------------------------------------------------------------------------------------------ */

/* Root mean square distance from their middle of the nodes that begin in the bights of both ribbons, m: the left one's is on the right, around x = 0.1. */
static double bights_radius(const show *s, const double *x)
{
    static const double bight = 0.08;
    double sum[3] = {0, 0, 0}, square = 0;
    int count = 0;
    for (int i = 0; i < s->model->node_count; i++) {
        const double along = s->model->node_body[i] == 0 ? s->start[3 * i] : -s->start[3 * i];
        if (along < bight) continue;
        v3_add(sum, sum, x + 3 * i);
        square += v3_norm2(x + 3 * i);
        count++;
    }
    assert_true(count > 0);
    return sqrt(square / count - v3_norm2(sum) / count / count);
}

/* Sum of m v; returns the sum of m |v|. */
static double momentum_of(const show *s, const double *v, double p[3])
{
    double flow = 0;
    p[0] = p[1] = p[2] = 0;
    for (int i = 0; i < s->model->node_count; i++) {
        v3_axpy(p, s->model->mass[i], v + 3 * i);
        flow += s->model->mass[i] * v3_norm(v + 3 * i);
    }
    return flow;
}

/* A run whose momentum is what the loads have given it, after every frame, but for roundings that add up as a random walk does (as in test_momentum.c). */
static void assert_momentum_of_loads(show *s, int frames)
{
    const cipc_model *m = s->model;
    double allowed = 0, off = 0, events = 0, flow = 0;
    int loaded = 0;
    double force[3] = {0, 0, 0};
    for (int l = 0; l < m->load_count; l++) {
        loaded += m->loads[l].node_count;
        v3_axpy(force, m->loads[l].node_count, m->loads[l].force);
    }
    for (int k = 0; k < frames; k++) {
        assert_true(frame(s));
        const long *e = s->report.events;
        double p[3];
        events += (double)(e[CIPC_EVENT_STRETCHING] + e[CIPC_EVENT_BENDING] + e[CIPC_EVENT_PENALTY] + e[CIPC_EVENT_GRAVITY] * loaded);
        flow = fmax(flow, momentum_of(s, s->velocity, p));
        allowed = sqrt(events) * 0x1p-53 * flow;
        v3_axpy(p, -s->state->time, force);
        off = fmax(off, v3_norm(p));
        assert_true(v3_norm(p) <= allowed);
    }
    print_message("%s, forces that add up to %g N: momentum off by at most %.3g kg m/s, rounding explains %.3g\n", s->name, v3_norm(force), off, allowed);
}

static void test_pulled_knot_tightens(void **state)
{
    (void)state;
    show s = open_show("pulled-knot", 0, NULL);
    assert_momentum_of_loads(&s, s.scene->steps);
    const double start = bights_radius(&s, s.start), end = bights_radius(&s, s.position);
    print_message("pulled knot: radius of the bights %.4f m, at the start %.4f m; %d layers in the last frame\n", end, start, s.report.layers);
    assert_true(end < start / 3);
    assert_true(s.report.layers > 0); /* which bear the pull */
    assert_same_when_taken_up(&s);
    close_show(&s);
    const char *const uneven[] = {"loads.0.force=[-0.01,0.002,0]"};
    show other = open_show("pulled-knot", 1, uneven);
    assert_momentum_of_loads(&other, 5);
    close_show(&other);
}

/* To the last whole frame before it stalls; the state at the stall is valid too. */
static void run_until_stalled(show *s, int fresh_at)
{
    cipc_status status = CIPC_OK;
    while (status == CIPC_OK) {
        assert_true(s->state->step < s->scene->steps); /* or it does not stall */
        status = cipc_asynchronous_step(s->integrator, s->state, &s->report, &s->error);
        if (status == CIPC_OK) keep(s);
        if (status == CIPC_OK && s->steps == fresh_at) take_up(s);
    }
    assert_int_equal(status, CIPC_E_NO_PROGRESS);
    assert_int_equal(cipc_status_exit(status), 1);
    assert_non_null(strstr(s->error.what, "stalled"));
}

static void assert_jammed_in_the_knot(const show *s)
{
    const cipc_contact_place *place = &s->report.deepest;
    assert_true(place->layers == s->report.layers && place->layers > 10 && place->gap < s->scene->asynchronous.thickness / 1.5);
    for (int k = 0; k < cipc_pair_nodes(place->kind); k++) assert_true(place->nodes[k] >= 0 && fabs(s->state->position[3 * place->nodes[k]]) < 0.05);
}

/* The pull grows without end, and with it what a frame costs, until it is more than asynchronous.events allows. */
static void test_jammed_knot_stalls(void **state)
{
    (void)state;
    show s = open_show("jammed-knot", 0, NULL), other = open_show("jammed-knot", 0, NULL);
    cipc_monitor *monitor;
    cipc_invariant_report seen;
    run_until_stalled(&s, -1);
    print_message("jammed knot: stalls in step %d of %d, at %.4f s; radius of the bights %.4f m, at the start %.4f m; layer %d, gap %.3g m, steps of %.3g s\n", s.steps + 1, s.scene->steps,
                  s.state->time, bights_radius(&s, s.position), bights_radius(&s, s.start), s.report.layers, s.report.deepest.gap, s.report.deepest.step);
    assert_true(s.steps > 5 && s.state->step == s.steps);
    assert_true(s.report.total_events >= s.scene->asynchronous.event_limit);
    assert_jammed_in_the_knot(&s);
    assert_true(bights_radius(&s, s.position) < bights_radius(&s, s.start) / 3);
    if (cipc_monitor_create(&monitor, s.model, NULL, &s.error) != CIPC_OK) fail_msg("%s", s.error.what);
    cipc_invariant_report_init(&seen);
    if (cipc_monitor_check(monitor, s.state->position, &seen, &s.error) != CIPC_OK) fail_msg("at the stall: %s", s.error.what);
    cipc_monitor_destroy(monitor);
    run_until_stalled(&other, s.steps / 2);
    const size_t size = 3 * (size_t)s.model->node_count * sizeof(double);
    assert_int_equal(other.steps, s.steps);
    assert_memory_equal(other.position, s.position, size);
    assert_memory_equal(other.velocity, s.velocity, size);
    close_show(&other);
    close_show(&s);
}

/* And so for who runs it: exit status 1, and the summary says why, with every invariant held up to there. CIPC names the program (default build/cipc). */
static void test_jammed_knot_ends_with_exit_status_1(void **state)
{
    (void)state;
    const char *program = getenv("CIPC");
    const path folder = folder_make(), summary = path_in(&folder, "summary.json");
    char command[1500];
    snprintf(command, sizeof command, "%s run tests/scenes/jammed-knot.json --quiet -o %s 2>/dev/null", program != NULL ? program : "build/cipc", folder.text);
    const int how = system(command);
    assert_true(WIFEXITED(how));
    assert_int_equal(WEXITSTATUS(how), 1);
    json_error_t error;
    json_t *object = json_load_file(summary.text, 0, &error);
    if (object == NULL) fail_msg("%s: %s", summary.text, error.text);
    const long long taken = json_integer_value(json_object_get(object, "steps_taken"));
    assert_string_equal(json_string_value(json_object_get(object, "status")), "NO_PROGRESS");
    assert_int_equal(json_integer_value(json_object_get(object, "exit_status")), 1);
    assert_true(json_is_false(json_object_get(object, "converged")));
    assert_true(taken > 5 && taken < json_integer_value(json_object_get(object, "steps_asked")));
    static const char *const monitors[] = {"M1", "M2", "M5", "M8"};
    for (size_t k = 0; k < sizeof monitors / sizeof monitors[0]; k++)
        assert_string_equal(json_string_value(json_object_get(json_object_get(object, "invariants"), monitors[k])), "holds");
    json_decref(object);
    folder_remove(&folder);
}

/* ---- Compactor -------------------------------------------------------------------------------------------------------------- */

/* Enclosed by a closed surface, m^3. */
static double volume_of(const show *s, const cipc_body *body, const double *x)
{
    double volume = 0, normal[3];
    for (int t = body->first_triangle; t < body->first_triangle + body->triangle_count; t++) {
        const int *v = s->model->triangles[t];
        v3_cross(normal, x + 3 * v[1], x + 3 * v[2]);
        volume += v3_dot(x + 3 * v[0], normal) / 6;
    }
    return volume;
}

/* The walls come to where the script has them, and all that is between them has given way: the balls have lost much of their volume, and lie within. */
static void test_compactor_crumples_what_is_in_it(void **state)
{
    (void)state;
    static const char *const moving[] = {"coarse", "medium", "small", "sheet"};
    enum { BALLS = 3, MOVING = 4 };
    static const double asked = 0.32 - 2 * 0.29 * 0.4; /* m: what is left of the box in x and z */
    show s = open_show("trash-compactor", 0, NULL);
    while (frame(&s)) {}
    const extent left = extent_of(body_of(&s, "left"), s.position), right = extent_of(body_of(&s, "right"), s.position);
    const extent front = extent_of(body_of(&s, "front"), s.position), back = extent_of(body_of(&s, "back"), s.position);
    print_message("trash compactor: walls %.9f and %.9f m apart\n", right.low[0] - left.high[0], front.low[2] - back.high[2]);
    assert_true(fabs(right.low[0] - left.high[0] - asked) < 1e-12 && fabs(front.low[2] - back.high[2] - asked) < 1e-12);
    for (int b = 0; b < MOVING; b++) {
        const cipc_body *body = body_of(&s, moving[b]);
        const extent e = extent_of(body, s.position);
        assert_true(e.low[0] > left.high[0] && e.high[0] < right.low[0] && e.low[2] > back.high[2] && e.high[2] < front.low[2] && e.low[1] > 0);
        if (b < BALLS) print_message("%s: %.3f of its volume is left\n", moving[b], volume_of(&s, body, s.position) / volume_of(&s, body, s.start));
    }
    const cipc_body *medium = body_of(&s, "medium");
    assert_true(volume_of(&s, medium, s.position) < 0.75 * volume_of(&s, medium, s.start)); /* as wide as the box is now and more, it had to */
    assert_same_when_taken_up(&s);
    close_show(&s);
}

/* ---- Nails ------------------------------------------------------------------------------------------------------------------ */

/* Is the point under the triangle as seen from above, and how high is the triangle there? */
static bool height_over(const double *x, const int *v, const double *point, double *height)
{
    const double *a = x + 3 * v[0], *b = x + 3 * v[1], *c = x + 3 * v[2];
    const double ux = b[0] - a[0], uz = b[2] - a[2], vx = c[0] - a[0], vz = c[2] - a[2], wx = point[0] - a[0], wz = point[2] - a[2], det = ux * vz - uz * vx;
    const double s = (wx * vz - wz * vx) / det, t = (ux * wz - uz * wx) / det;
    *height = a[1] + s * (b[1] - a[1]) + t * (c[1] - a[1]);
    return s >= 0 && t >= 0 && s + t <= 1;
}

/* Over how many tips there is cloth; nowhere is it lower than they are: a nail's axis is below its tip, so that cloth that came there has been pierced. */
static int tips_under(const show *s, const cipc_body *cloth)
{
    const cipc_body *nails = body_of(s, "nails");
    const double top = extent_of(nails, s->position).high[1];
    int covered = 0;
    for (int i = nails->first_node; i < nails->first_node + nails->node_count; i++) {
        const double *tip = s->position + 3 * i;
        bool over = false;
        if (tip[1] < top) continue;
        for (int t = cloth->first_triangle; t < cloth->first_triangle + cloth->triangle_count; t++) {
            double height;
            if (!height_over(s->position, s->model->triangles[t], tip, &height)) continue;
            assert_true(height > tip[1]);
            over = true;
        }
        covered += over;
    }
    return covered;
}

static void test_nails_pierce_no_cloth(void **state)
{
    (void)state;
    static const char *const cloths[] = {"lower", "upper"};
    enum { CLOTHS = 2, TIPS = 25 };
    show s = open_show("bed-of-nails", 0, NULL);
    int first[CLOTHS] = {0, 0}, last[CLOTHS] = {0, 0};
    double sag = INFINITY; /* between the nine tips in the middle, before the cloth is drawn */
    while (frame(&s)) {
        for (int c = 0; c < CLOTHS; c++) {
            const cipc_body *cloth = body_of(&s, cloths[c]);
            last[c] = tips_under(&s, cloth);
            first[c] = s.steps == 1 ? last[c] : first[c];
            for (int i = cloth->first_node; s.state->time < 0.3 && i < cloth->first_node + cloth->node_count; i++) {
                const double *x = s.position + 3 * i;
                if (fmax(fabs(x[0]), fabs(x[2])) < 0.06) sag = fmin(sag, x[1]);
            }
        }
    }
    print_message("bed of nails: tips under the lower cloth %d, then %d, under the upper %d, then %d; before it is drawn cloth hangs down to %.4f m between tips in the middle, at 0.08 m\n", first[0], last[0], first[1],
                  last[1], sag);
    assert_true(first[0] == TIPS && last[0] < TIPS && sag < 0.08);
    assert_same_when_taken_up(&s);
    close_show(&s);
}

static double centre_height(const show *s, const char *name)
{
    const cipc_body *body = body_of(s, name);
    double mass = 0, sum = 0;
    for (int i = body->first_node; i < body->first_node + body->node_count; i++) {
        mass += s->model->mass[i];
        sum += s->model->mass[i] * s->position[3 * i + 1];
    }
    return sum / mass;
}

/* Between the nails, whose tips are 0.08 m high and 0.06 m apart, there is room for a ball of radius 0.02 m, and none for one of 0.05 m. */
static void test_projectiles_lie_as_they_fit(void **state)
{
    (void)state;
    static const double tip = 0.08;
    show s = open_show("nail-landing", 0, NULL);
    while (frame(&s)) {}
    const extent fits = extent_of(body_of(&s, "fits"), s.position), not = extent_of(body_of(&s, "not"), s.position);
    print_message("nail landing: the ball that fits from %.4f to %.4f m, centre of the one that does not at %.4f m (lowest node %.4f m), of the one that hardly does %.4f m, of the fast one %.4f m\n", fits.low[1],
                  fits.high[1], centre_height(&s, "not"), not.low[1], centre_height(&s, "hardly"), centre_height(&s, "fast"));
    assert_true(fits.high[1] < tip);
    assert_true(centre_height(&s, "not") > tip && not.low[1] > tip / 2);
    assert_same_when_taken_up(&s);
    close_show(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_comparison_sees_one_ulp),
        cmocka_unit_test(test_falling_particle_comes_to_rest),
        cmocka_unit_test(test_head_on_takes_twenty_layers),
        cmocka_unit_test(test_curtains_keep_their_pace),
        cmocka_unit_test(test_pulled_knot_tightens),
        cmocka_unit_test(test_jammed_knot_stalls),
        cmocka_unit_test(test_jammed_knot_ends_with_exit_status_1),
        cmocka_unit_test(test_compactor_crumples_what_is_in_it),
        cmocka_unit_test(test_nails_pierce_no_cloth),
        cmocka_unit_test(test_projectiles_lie_as_they_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
