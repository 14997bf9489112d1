/* C-IPC's fig. 23 at size ci: rods, shells, particles and a volume, of which every pair meets that the figure is about. That every invariant holds is the business of the run of all
 * scenes; here, that there was something for them to hold against. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "cipc/contact.h"
#include "cipc/scene.h"

enum { BODIES_MAX = 8 };

/* How many contacts each pair of bodies had at the ends of steps. */
typedef struct meetings {
    const cipc_model *model;
    int count[BODIES_MAX][BODIES_MAX];
} meetings;

static void note(meetings *met, const cipc_contact_set *set)
{
    for (int c = 0; c < set->count; c++) {
        const cipc_contact *contact = &set->contacts[c];
        int first = met->model->node_body[contact->nodes[0]], last = met->model->node_body[contact->nodes[contact->count - 1]];
        met->count[first][last]++;
        if (first != last) met->count[last][first]++;
    }
}

static void look(meetings *met, cipc_broad_phase *broad_phase, const double *x, double dhat)
{
    cipc_candidates candidates = {0};
    cipc_contact_set set = {0};
    cipc_contact_options options = cipc_contact_options_default();
    options.dhat = dhat;
    assert_int_equal(cipc_broad_phase_find(broad_phase, met->model, x, NULL, 0, dhat, NULL, 1, &candidates, NULL), CIPC_OK);
    assert_int_equal(cipc_contact_set_build(&set, met->model, &candidates, x, 1, &options, 1, NULL), CIPC_OK);
    note(met, &set);
    cipc_contact_set_free(&set);
    cipc_candidates_free(&candidates);
}

static int body(const cipc_model *m, const char *name)
{
    for (int b = 0; b < m->body_count; b++) {
        if (strcmp(m->bodies[b].name, name) == 0) return b;
    }
    fail_msg("no body %s", name);
    return 0;
}

static void test_all_codimensions_meet(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {{"net", "figure"}, {"net", "sand"}, {"floor", "figure"}, {"floor", "sand"}, {"sand", "figure"}, {"sand", "cloth"}, {"cloth", "figure"}};
    cipc_scene *scene;
    cipc_stepper *stepper;
    cipc_broad_phase *broad_phase;
    cipc_error error;
    if (cipc_scene_load(&scene, "tests/scenes/all-in.json", 0, NULL, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    meetings met = {.model = scene->model};
    assert_true(scene->model->body_count <= BODIES_MAX);
    assert_int_equal(cipc_broad_phase_create(&broad_phase, scene->model, NULL), CIPC_OK);
    assert_int_equal(cipc_stepper_create(&stepper, scene->model, &scene->options, NULL), CIPC_OK);
    look(&met, broad_phase, scene->state->position, scene->options.contact.dhat);
    for (size_t p = 0; p < sizeof pairs / sizeof pairs[0]; p++) assert_int_equal(met.count[body(scene->model, pairs[p][0])][body(scene->model, pairs[p][1])], 0); /* apart at first */
    for (int s = 0; s < scene->steps; s++) {
        cipc_step_report report;
        if (cipc_step(stepper, scene->state, &report, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
        look(&met, broad_phase, scene->state->position, scene->options.contact.dhat);
    }
    for (size_t p = 0; p < sizeof pairs / sizeof pairs[0]; p++) {
        int count = met.count[body(scene->model, pairs[p][0])][body(scene->model, pairs[p][1])];
        print_message("%s and %s: %d contacts at the ends of %d steps\n", pairs[p][0], pairs[p][1], count, scene->steps);
        if (count == 0) fail_msg("%s and %s never meet", pairs[p][0], pairs[p][1]);
    }
    cipc_stepper_destroy(stepper);
    cipc_broad_phase_destroy(broad_phase);
    cipc_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_codimensions_meet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
