/* What the scenes of mass-spring cloth are there to show. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/invariant.h"
#include "cipc/scene.h"

typedef struct trial {
    cipc_scene *scene;
    cipc_massspring *integrator;
    double greatest;        /* deformation, after any step */
    long hits, iterations, beyond; /* in all */
    int intersecting;       /* steps that end with cloth in cloth */
    double deepest;         /* distance from colliders, smallest of any node after any step, m */
} trial;

static void look(trial *t)
{
    const cipc_scene *s = t->scene;
    for (int i = 0; i < s->model->node_count; i++)
        for (int c = 0; c < s->collider_count && !s->model->bodies[s->model->node_body[i]].fixed; c++)
            t->deepest = fmin(t->deepest, cipc_collider_distance(&s->colliders[c], s->state->position + 3 * i, NULL));
}

/* At size ci; either override may be NULL. */
static trial run(const char *name, const char *first, const char *second)
{
    trial t = {.deepest = INFINITY};
    const char *const overrides[] = {"size=ci", first, second};
    const int count = first == NULL ? 1 : second == NULL ? 2 : 3;
    char path[128];
    cipc_error error;
    cipc_monitor *monitor;
    snprintf(path, sizeof path, "tests/scenes/%s.json", name);
    if (cipc_scene_load(&t.scene, path, count, overrides, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    const cipc_scene *s = t.scene;
    assert_int_equal(s->method, CIPC_METHOD_MASS_SPRING);
    assert_int_equal(cipc_massspring_create(&t.integrator, s->model, s->colliders, s->collider_count, &s->massspring, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_create(&monitor, s->model, NULL, &error), CIPC_OK);
    for (int step = 0; step < s->steps; step++) {
        cipc_massspring_report report;
        assert_int_equal(cipc_massspring_step(t.integrator, s->state, &report, &error), CIPC_OK);
        t.greatest = fmax(t.greatest, report.deformation);
        t.hits += report.hits;
        t.iterations += report.iterations;
        t.beyond += report.beyond_bound;
        t.intersecting += cipc_monitor_intersection(monitor, s->state->position, NULL, &error) != CIPC_OK;
        look(&t);
    }
    cipc_monitor_destroy(monitor);
    return t;
}

static void end(trial *t)
{
    cipc_massspring_destroy(t->integrator);
    cipc_scene_destroy(t->scene);
}

/* Mean of a coordinate of the nodes of a body, counted from the last. */
static double mean_of_body(const trial *t, int from_last, int axis)
{
    const cipc_body *cloth = &t->scene->model->bodies[t->scene->model->body_count - 1 - from_last];
    double sum = 0;
    for (int i = 0; i < cloth->node_count; i++) sum += t->scene->state->position[3 * (cloth->first_node + i) + axis];
    return sum / cloth->node_count;
}

static double mean_of(const trial *t, int axis) { return mean_of_body(t, 0, axis); }

static void test_hung_cloth(void **state)
{
    (void)state;
    trial bounded = run("cloth-hang", NULL, NULL), free_of_it = run("cloth-hang", "mass_spring.deformation.bound=0", NULL);
    assert_true(bounded.greatest > 0.09 && bounded.greatest <= 0.1 * (1 + 1e-3) && bounded.beyond == 0);
    assert_true(free_of_it.greatest > 0.2);
    assert_true(mean_of(&bounded, 1) < -0.2 && mean_of(&free_of_it, 1) < mean_of(&bounded, 1)); /* it hangs, and lower without */
    end(&bounded);
    end(&free_of_it);
}

/* The same accuracy for fewer evaluations: no node is ever inside, by either. Without the bound on deformation that is bisection's alone. */
static void test_cloth_on_a_ball(void **state)
{
    (void)state;
    static const char unbound[] = "mass_spring.deformation.bound=0";
    trial improved = run("cloth-ball", unbound, NULL), plain = run("cloth-ball", unbound, "mass_spring.bisection=plain"), smooth = run("cloth-ball", unbound, "colliders.ball.friction=0");
    assert_true(improved.iterations > 0 && improved.iterations * 3 < plain.iterations * 2);
    assert_true(improved.deepest >= 0 && plain.deepest >= 0 && improved.deepest < 2e-5);
    trial bounded = run("cloth-ball", "mass_spring.bisection=plain", NULL);
    assert_true(bounded.deepest >= 0); /* what the bound presses in comes out again */
    end(&bounded);
    assert_true(mean_of(&improved, 1) > -0.2); /* it has not fallen off: friction holds it */
    assert_true(mean_of(&smooth, 1) < mean_of(&improved, 1) - 0.01);
    end(&improved);
    end(&plain);
    end(&smooth);
}

/* Nodes that keep 1.4 edges apart keep this cloth out of itself, and without them it is not. */
static void test_cloth_on_itself(void **state)
{
    (void)state;
    trial apart = run("cloth-ball", NULL, NULL), through = run("cloth-ball", "mass_spring.self.distance=0", NULL);
    print_message("steps with cloth in cloth: %d, without collision with itself %d\n", apart.intersecting, through.intersecting);
    assert_true(apart.intersecting == 0 && through.intersecting > 20);
    end(&apart);
    end(&through);
}

static void test_round_table(void **state)
{
    (void)state;
    trial wind = run("round-table", NULL, NULL), calm = run("round-table", "mass_spring.wind.velocity=[0,0,0]", NULL);
    trial gale = run("round-table", "mass_spring.wind.velocity=[12,0,0]", NULL);
    assert_true(wind.deepest >= 0 && wind.deepest < 2e-4 && wind.hits > 0);
    assert_true(mean_of(&wind, 0) > mean_of(&calm, 0) + 0.01); /* downwind */
    assert_true(mean_of(&gale, 0) > mean_of(&wind, 0) + 0.01); /* further in stronger wind */
    end(&gale);
    assert_true(mean_of(&wind, 1) > -0.35 && mean_of(&wind, 1) < 0.02);
    end(&wind);
    end(&calm);
}

/* The same wind and three materials: friction alone holds the runners. Where each has come to, along the wind, after a second; the table's middle is at 0, and 0.3 is where they began. */
static void test_materials(void **state)
{
    (void)state;
    static const struct { const char *wind; int going; } winds[] = {{"mass_spring.wind.velocity=[0,0,0]", 0}, {"mass_spring.wind.velocity=[3,0,0]", 1}, {NULL, 2}, {"mass_spring.wind.velocity=[8,0,0]", 3}};
    for (size_t k = 0; k < sizeof winds / sizeof *winds; k++) {
        trial t = run("table-materials", winds[k].wind, NULL);
        const double silk = mean_of_body(&t, 2, 0), brocade = mean_of_body(&t, 1, 0), linen = mean_of_body(&t, 0, 0);
        print_message("%s: %.3f %.3f %.3f m\n", winds[k].wind ? winds[k].wind : "5 m/s", silk, brocade, linen);
        assert_true(silk > brocade && brocade > linen);
        assert_int_equal((silk > 0.45) + (brocade > 0.45) + (linen > 0.45), winds[k].going);
        assert_true((winds[k].going > 0 || silk < 0.32) && (winds[k].going > 1 || brocade < 0.32) && (winds[k].going > 2 || linen < 0.32)); /* what stays has not come further at all */
        assert_true(t.deepest >= 0 && t.beyond == 0);
        end(&t);
    }
}

/* The neckline bears the dress; bound and body both have what they ask for, after every substep. */
static void test_dress(void **state)
{
    (void)state;
    trial bounded = run("dress-on-body", NULL, NULL), free_of_it = run("dress-on-body", "mass_spring.deformation.bound=0", NULL);
    assert_true(bounded.greatest > 0.09 && bounded.greatest <= 0.1 * (1 + 1e-3) && bounded.beyond == 0);
    assert_true(free_of_it.greatest > 0.2);
    assert_true(bounded.deepest >= 0 && free_of_it.deepest >= 0);
    assert_true(mean_of(&bounded, 1) > 0.75); /* it has not come down along the body */
    assert_true(mean_of(&free_of_it, 1) < mean_of(&bounded, 1) - 0.01);
    end(&bounded);
    end(&free_of_it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hung_cloth), cmocka_unit_test(test_cloth_on_a_ball), cmocka_unit_test(test_cloth_on_itself), cmocka_unit_test(test_round_table), cmocka_unit_test(test_materials), cmocka_unit_test(test_dress)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
