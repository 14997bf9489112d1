/* Safety for any parameters (claim A1, SPEC T-A8): crowds in collision with thickness, stiffness, steps, speeds, restitution and friction drawn over decades, also with forces beyond any stable
 * step, so that runs blow up. They may stall; but at no frame is there an intersection or a gap lost, and along no path, by exact arithmetic; and no number is not finite. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_crowd.h"
#include "support/claim.h"
#include "support/exact_geometry.h"

static double decades(uint64_t *seed, double low, double high) { return exp(random_uniform(seed, log(low), log(high))); }

typedef struct tally { int done, stalled, violations, deep; long paths, contacts; double gap; } tally;

/* Somewhere else in the world, where coordinates have fewer digits to spare. */
static void move_away(asynchronous_scene *s, uint64_t *seed)
{
    double by[3];
    random_fill(seed, by, 3, decades(seed, 1, 1e4));
    for (int i = 0; i < 3 * s->sheet.model->node_count; i++) s->sheet.state->position[i] += by[i % 3];
}

/* Parameters by chance. `wild`: forces inside bodies tick at up to thirty times their stable steps. */
static void draw(asynchronous_scene *s, uint64_t *seed, bool wild)
{
    static const unsigned kinds[] = {CROWD_ALL, CROWD_SHEETS, CROWD_RODS | CROWD_PARTICLES, CROWD_VOLUME | CROWD_RODS, CROWD_SHEETS | CROWD_PARTICLES | CROWD_STITCHES};
    crowd_shape shape = crowd_shape_default();
    shape.kinds = kinds[random_below(seed, 5)];
    shape.cells = 1 + random_below(seed, 2);
    shape.speed = decades(seed, 0.1, 100);
    shape.offset = random_below(seed, 2) ? decades(seed, 1e-6, 1e-2) : 0;
    shape.friction = random_below(seed, 2) ? decades(seed, 1e-2, 10) : 0;
    shape.damping = random_below(seed, 2) ? decades(seed, 1e-6, 1e-2) : 0;
    asynchronous_scene_init(s);
    crowd_add(s, &shape, random_bits(seed));
    for (int b = 1; b < s->sheet.body_count; b++) {
        cipc_material *m = &s->sheet.bodies[b].material;
        const double factor = decades(seed, 1e-2, 1e2);
        m->young *= factor;
        m->membrane_young *= factor;
        m->bending_young *= decades(seed, 1e-2, 1e2);
        if (random_below(seed, 2)) m->volume = CIPC_VOLUME_COROTATIONAL;
    }
    s->options.thickness = decades(seed, 1e-6, 1e-2);
    s->options.layer_factor = decades(seed, 1e-2, 1);
    s->options.element_factor = decades(seed, 1e-2, 1);
    s->options.restitution = random_below(seed, 3) ? random_uniform(seed, 0, 1) : random_below(seed, 2);
    s->options.clocks = random_below(seed, 2) ? CIPC_CLOCKS_OWN : CIPC_CLOCKS_NESTED;
    s->options.event_limit = 30000;
    crowd_build(s, &shape);
    const double rule = s->integrator->options.stiffness;
    s->options.stiffness = rule * decades(seed, 1e-2, 1e2);
    s->options.frame = 0.1 / shape.speed / 8; /* all have met after eight or so */
    asynchronous_scene_start(s);
    if (random_below(seed, 3) == 0) move_away(s, seed);
    const double stretch = wild ? decades(seed, 1, 30) : 1;
    for (int c = 0; c < s->integrator->clock_count; c++) s->integrator->clocks[c].h *= stretch;
}

static void live(asynchronous_scene *s, tally *seen)
{
    long contacts[CIPC_PAIR_KIND_COUNT] = {0};
    cipc_status status = CIPC_OK;
    asynchronous_watch(s);
    for (int frame = 0; frame < 16 && !status; frame++) {
        status = asynchronous_try_step(s);
        if (!status) crowd_count_contacts(s, contacts);
    }
    const bool violated = cipc_status_exit(status) == 3;
    if (status && status != CIPC_E_NO_PROGRESS) print_error("%s: %s: %s\n", cipc_status_name(status), s->error.place, s->error.what);
    assert_true(status == CIPC_OK || status == CIPC_E_NO_PROGRESS || violated);
    seen->violations += violated;
    status ? seen->stalled++ : seen->done++;
    seen->deep += s->layers > 20;
    seen->paths += s->paths_checked;
    seen->gap = fmin(seen->gap, s->seen_gap);
    for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) seen->contacts += contacts[k];
}

/* Returns how many of sixty runs the monitors objected to. */
static int live_all(uint64_t seed, bool wild)
{
    tally seen = {.gap = INFINITY};
    for (int trial = 0; trial < 60; trial++) {
        asynchronous_scene s;
        draw(&s, &seed, wild);
        live(&s, &seen);
        asynchronous_scene_free(&s);
    }
    assert_true(seen.done >= 10 && seen.stalled >= 10 && seen.deep >= 20 && seen.contacts >= 100 && seen.paths >= 5000);
    assert_true(seen.gap < 1e-5);
    return seen.violations;
}

/* Within stable steps and beyond them. */
static void test_any_parameters(void **state)
{
    (void)state;
    const int violations = live_all(1, false) + live_all(2, true);
    claim_figure("A1", "violations in random runs", violations, "1", CLAIM_EQUAL, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_any_parameters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
