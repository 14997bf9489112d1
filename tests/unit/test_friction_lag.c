/* Lagged friction data: one entry for each contact that can have friction, with its pair's coefficient, and room that grows. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/crowded_scene.h"
#include "support/failing_memory.h"

static double coefficient(const cipc_model *m, const cipc_contact *c)
{
    /* bodies of a node of either primitive: for every kind the first and the last node */
    int a = m->node_body[c->nodes[0]], b = m->node_body[c->nodes[c->count - 1]];
    return m->pair_friction[m->body_count * a + b];
}

/* Every contact in its order, with the data that the contact room makes of it. */
static void assert_lagged(const cipc_stepper *s)
{
    int k = 0;
    double eps = s->options.friction_velocity * s->options.time_step;
    for (int i = 0; i < s->contacts.count; i++) {
        const cipc_contact *c = &s->contacts.contacts[i];
        cipc_friction want;
        if (!cipc_friction_from_contact(&want, c, s->x, s->x_start, coefficient(s->model, c), eps)) {
            assert_true(c->barrier.mollifier_eps > 0 || coefficient(s->model, c) == 0 || cipc_contact_gap(c, s->x) >= 0.999 * crowded_dhat);
            continue;
        }
        assert_memory_equal(&s->friction.params[k], &want, sizeof want);
        for (int j = 0; j < 4; j++) { /* what a short stencil lacks is its first node again, with weight 0 */
            assert_int_equal(s->friction.nodes[k][j], c->nodes[j < c->count ? j : 0]);
            assert_true(j < c->count || want.weights[j] == 0);
        }
        k++;
    }
    assert_int_equal(s->friction.count, k);
}

static void test_each_contact(void **state)
{
    (void)state;
    int entries = 0;
    for (uint64_t seed = 1; seed <= 8; seed++) {
        sheet_scene scene;
        crowded_scene(&scene, seed, crowded_euler, 0, 1);
        assert_int_equal(cipc_friction_lag(scene.stepper, NULL), CIPC_OK);
        assert_lagged(scene.stepper);
        entries += scene.stepper->friction.count;
        sheet_scene_free(&scene);
    }
    assert_true(entries > 100);
}

/* A pair without friction has no entries; a pair's own coefficient goes before the bodies'. */
static void test_pairs(void **state)
{
    (void)state;
    sheet_scene scene;
    crowded_scene(&scene, 1, crowded_euler, 0, 1);
    cipc_stepper *s = scene.stepper;
    assert_int_equal(cipc_friction_lag(s, NULL), CIPC_OK);
    int all = s->friction.count;
    cipc_model_set_friction(scene.model, 0, 1, 0); /* floor and cloth */
    assert_int_equal(cipc_friction_lag(s, NULL), CIPC_OK);
    assert_lagged(s);
    assert_true(s->friction.count < all && s->friction.count > 0);
    double before = s->friction.params[0].coefficient;
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < 4; b++) cipc_model_set_friction(scene.model, a, b, 0.9);
    assert_int_equal(cipc_friction_lag(s, NULL), CIPC_OK);
    assert_lagged(s);
    assert_int_equal(s->friction.count, all);
    assert_true(s->friction.params[0].coefficient > before);
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < 4; b++) cipc_model_set_friction(scene.model, a, b, 0);
    assert_int_equal(cipc_friction_lag(s, NULL), CIPC_OK);
    assert_int_equal(s->friction.count, 0);
    sheet_scene_free(&scene);
}

/* No contacts, no friction; room grows with the contacts and is kept. */
static void test_room(void **state)
{
    (void)state;
    sheet_scene scene;
    crowded_scene(&scene, 1, crowded_euler, 0, 1);
    cipc_stepper *s = scene.stepper;
    int contacts = s->contacts.count;
    s->contacts.count = 0;
    assert_int_equal(cipc_friction_lag(s, NULL), CIPC_OK);
    assert_int_equal(s->friction.count, 0);
    s->contacts.count = contacts;
    assert_int_equal(cipc_friction_lag(s, NULL), CIPC_OK);
    assert_true(s->friction.count > 0 && s->friction.capacity >= contacts);
    sheet_scene_free(&scene);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    long n = 1;
    for (bool failed = true; failed; n++) {
        sheet_scene scene;
        crowded_scene(&scene, 1, crowded_euler, 0, 1);
        cipc_stepper *s = scene.stepper;
        cipc_free(s->friction.params);
        cipc_free(s->friction.nodes);
        memset(&s->friction, 0, sizeof s->friction);
        fail_allocation(n);
        cipc_status status = cipc_friction_lag(s, &scene.error);
        failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        assert_int_equal(cipc_friction_lag(s, &scene.error), CIPC_OK); /* nothing half-grown is left */
        assert_lagged(s);
        sheet_scene_free(&scene);
    }
    assert_int_equal(n, 4); /* two blocks */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_contact),
        cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_room),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
