/* The assembled Newton matrix: against a dense sum of projected element matrices, against differences of the gradient; its pattern and when
 * it is made anew. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>

#include "implicit/psd_projection.h"
#include "support/crowded_scene.h"
#include "support/failing_memory.h"

enum { MOST_NODES = 64, MOST = 3 * MOST_NODES };

typedef struct dense {
    double entry[MOST][MOST];
} dense;

static dense *zero_matrix(void)
{
    dense *d = malloc(sizeof *d);
    assert_non_null(d);
    memset(d, 0, sizeof *d);
    return d;
}

/* Both halves of the assembled matrix. */
static dense *expand(const cipc_stepper *s)
{
    dense *d = zero_matrix();
    const cipc_block_matrix *m = &s->matrix;
    for (int j = 0; j < 3 * m->n; j++)
        for (int k = m->p[j]; k < m->p[j + 1]; k++)
            if (m->i[k] >= j) d->entry[m->i[k]][j] = d->entry[j][m->i[k]] = m->x[k];
    return d;
}

/* The gradient first, as Newton does: it makes the blended positions. */
static void assemble(sheet_scene *scene, bool project)
{
    scene->stepper->project = project;
    assert_int_equal(cipc_potential_gradient(scene->stepper, NULL), CIPC_OK);
    if (cipc_assemble_hessian(scene->stepper, &scene->error)) fail_msg("%s", scene->error.what);
}

/* Add factor * H of a stencil, n nodes, where both nodes are free. */
static void add_local(const cipc_stepper *s, const int *nodes, int n, const double *H, double factor, dense *d)
{
    for (int i = 0; i < 3 * n; i++)
        for (int j = 0; j < 3 * n; j++) {
            int a = s->free_index[nodes[i / 3]], b = s->free_index[nodes[j / 3]];
            if (a >= 0 && b >= 0) d->entry[3 * a + i % 3][3 * b + j % 3] += factor * H[3 * n * i + j];
        }
}

/* The sum as the theory has it: alpha h^2 beta^2 of elements at the blended point (alpha h^2 beta of the limit at the point), contacts,
 * friction, masses. */
static dense *reference(const cipc_stepper *s, bool project)
{
    dense *d = zero_matrix();
    double h2 = s->options.time_step * s->options.time_step, alpha = s->options.integrator.alpha, beta = s->options.integrator.beta,
           gamma = s->options.integrator.gamma;
    double H[144], y[12];
    for (int g = 0; g < CIPC_GROUP_COUNT; g++) {
        const cipc_element_group *group = &s->groups[g];
        int n = group->energy->nodes;
        bool limit = g == CIPC_GROUP_STRAIN_LIMIT;
        for (int i = 0; i < group->count; i++) {
            const int *nodes = group->nodes + n * i;
            for (int k = 0; k < 3 * n; k++) {
                int at = 3 * nodes[k / 3] + k % 3;
                y[k] = limit ? s->x[at] : beta * s->x[at] + gamma * s->x_start[at];
            }
            group->energy->hessian(y, (const char *)group->params + (size_t)i * group->energy->params_size, H);
            if (project) assert_true(cipc_psd_project_plain(3 * n, H));
            add_local(s, nodes, n, H, limit ? alpha * beta * h2 * s->strain_factor : alpha * beta * beta * h2, d);
        }
    }
    for (int i = 0; i < s->contacts.count; i++) {
        const cipc_contact *contact = &s->contacts.contacts[i];
        for (int k = 0; k < 3 * contact->count; k++) y[k] = s->x[3 * contact->nodes[k / 3] + k % 3];
        cipc_energy_entry(contact->energy)->hessian(y, &contact->barrier, H);
        if (project) assert_true(cipc_psd_project_plain(3 * contact->count, H));
        add_local(s, contact->nodes, contact->count, H, 1, d);
    }
    for (int i = 0; i < s->friction.count; i++) {
        for (int k = 0; k < 12; k++) y[k] = s->x[3 * s->friction.nodes[i][k / 3] + k % 3];
        cipc_friction_hessian(y, &s->friction.params[i], H);
        add_local(s, s->friction.nodes[i], 4, H, 1, d);
    }
    for (int k = 0; k < 3 * s->free_count; k++) {
        int node = s->free_nodes[k / 3];
        d->entry[k][k] += s->model->mass[node] * (s->penalty > 0 && s->moves[node] ? 1 + s->penalty : 1);
    }
    return d;
}

static double largest_entry(const dense *d, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) most = fmax(most, fabs(d->entry[i][j]));
    return most;
}

/* Equal to `relative` times the largest entry. */
static bool same_matrix(const dense *a, const dense *b, int n, double relative)
{
    double limit = relative * largest_entry(b, n);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            if (!(fabs(a->entry[i][j] - b->entry[i][j]) <= limit)) return false;
    return true;
}

/* Projections agree to 256 u / sine^2 (test_contact_hessian.c) with sine^2 >= 1e-3 where edges are not mollified; sums of some hundred add
 * a few u: 1e-10. */
static const double rounding = 1e-10;

static void assert_right_matrix(sheet_scene *scene, bool project)
{
    assemble(scene, project);
    dense *got = expand(scene->stepper), *want = reference(scene->stepper, project);
    assert_true(same_matrix(got, want, 3 * scene->stepper->free_count, rounding));
    free(got);
    free(want);
}

static void test_dense_sum(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 6; seed++)
        for (int v = 0; v < 8; v++) {
            sheet_scene scene;
            crowded_scene(&scene, seed, v % 2 ? crowded_midpoint : crowded_euler, v & 2 ? 1e6 : 0, 1);
            assert_right_matrix(&scene, !(v & 4));
            sheet_scene_free(&scene);
        }
}

/* The check notices: a contact left out, a node pair left out, projection left out. */
static void test_check_rejects(void **state)
{
    (void)state;
    sheet_scene scene;
    crowded_scene(&scene, 2, crowded_euler, 0, 1);
    assemble(&scene, true);
    cipc_stepper *s = scene.stepper;
    int n = 3 * s->free_count;
    dense *got = expand(s), *raw = reference(s, false), *want = reference(s, true);
    assert_true(same_matrix(got, want, n, rounding));
    assert_false(same_matrix(got, raw, n, rounding));
    s->contacts.count--;
    dense *fewer = reference(s, true);
    assert_false(same_matrix(got, fewer, n, rounding));
    s->contacts.count++;
    want->entry[4][1] += 1e-6 * largest_entry(want, n);
    assert_false(same_matrix(got, want, n, rounding));
    free(got), free(raw), free(want), free(fewer);
    sheet_scene_free(&scene);
}

/* Without projection it is the Jacobian of the gradient. Central differences with step d = 1e-7: truncation (d / gap)^2 < 1e-8 of the
 * stiffest term, rounding u |grad| / d < 1e-8; ten times both. */
static const double jacobian_tolerance = 1e-7;

static void test_jacobian(void **state)
{
    (void)state;
    const double step = 1e-7;
    for (int v = 0; v < 4; v++) {
        sheet_scene scene;
        crowded_scene(&scene, 3, v % 2 ? crowded_midpoint : crowded_euler, v & 2 ? 1e6 : 0, 1);
        cipc_stepper *s = scene.stepper;
        int n = 3 * s->free_count;
        assemble(&scene, false);
        dense *got = expand(s), *want = zero_matrix();
        for (int j = 0; j < n; j++) {
            double *x = &s->x[3 * s->free_nodes[j / 3] + j % 3], kept = *x;
            for (int side = 1; side >= -1; side -= 2) {
                *x = kept + side * step;
                assert_int_equal(cipc_potential_gradient(s, NULL), CIPC_OK);
                for (int i = 0; i < n; i++) want->entry[i][j] += side * s->gradient[3 * s->free_nodes[i / 3] + i % 3] / (2 * step);
            }
            *x = kept;
        }
        assert_true(same_matrix(got, want, n, jacobian_tolerance));
        want->entry[0][0] += 1e-5 * largest_entry(want, n);
        assert_false(same_matrix(got, want, n, jacobian_tolerance));
        free(got);
        free(want);
        sheet_scene_free(&scene);
    }
}

/* Same bits for any number of threads. */
static void test_threads(void **state)
{
    (void)state;
    double *values = NULL;
    for (int threads = 1; threads <= 4; threads++) {
        sheet_scene scene;
        crowded_scene(&scene, 5, crowded_euler, 0, threads);
        assemble(&scene, true);
        size_t bytes = 9 * (size_t)scene.stepper->matrix.start[scene.stepper->matrix.n] * sizeof(double);
        if (threads == 1) {
            values = malloc(bytes);
            assert_non_null(values);
            memcpy(values, scene.stepper->matrix.x, bytes);
        }
        /* the upper halves of diagonal blocks are stored too, so all of it */
        assert_memory_equal(values, scene.stepper->matrix.x, bytes);
        sheet_scene_free(&scene);
    }
    free(values);
}

/* Fewer contacts, or the same again: the pattern stays. New ones: it is made anew, and keeps those of before. */
static void test_pattern_is_kept(void **state)
{
    (void)state;
    sheet_scene scene;
    crowded_scene(&scene, 6, crowded_euler, 0, 1);
    cipc_stepper *s = scene.stepper;
    assert_right_matrix(&scene, true);
    assert_int_equal(scene.report.symbolic_analyses, 1);
    int contacts = s->contacts.count, friction = s->friction.count;
    s->contacts.count = contacts / 2;
    s->friction.count = 0;
    assert_right_matrix(&scene, true);
    s->contacts.count = contacts;
    s->friction.count = friction;
    assert_right_matrix(&scene, true);
    assert_int_equal(scene.report.symbolic_analyses, 1);
    cipc_assembly_invalidate(s);
    s->contacts.count = 0;
    s->friction.count = 0;
    assert_right_matrix(&scene, true);
    assert_int_equal(scene.report.symbolic_analyses, 2);
    int elements_only = s->matrix.start[s->matrix.n];
    s->contacts.count = contacts / 2;
    assert_right_matrix(&scene, true);
    assert_int_equal(scene.report.symbolic_analyses, 3);
    int half = s->matrix.start[s->matrix.n];
    assert_true(half > elements_only);
    cipc_contact first[3];
    memcpy(first, s->contacts.contacts, sizeof first);
    memmove(s->contacts.contacts, s->contacts.contacts + contacts / 2, (size_t)(contacts - contacts / 2) * sizeof *first);
    s->contacts.count = contacts - contacts / 2; /* the other half: new pairs, and the first half's are kept */
    assert_right_matrix(&scene, true);
    assert_int_equal(scene.report.symbolic_analyses, 4);
    memcpy(s->contacts.contacts, first, sizeof first);
    s->contacts.count = 3;
    assert_right_matrix(&scene, true);
    assert_int_equal(scene.report.symbolic_analyses, 4);
    sheet_scene_free(&scene);
}

/* Lack of memory at any place is reported, and the next attempt succeeds: nothing half-made is used. */
static void out_of_memory(bool with_old_pattern)
{
    for (long n = 1;; n++) {
        sheet_scene scene;
        crowded_scene(&scene, 4, crowded_euler, 0, 1);
        cipc_stepper *s = scene.stepper;
        int contacts = s->contacts.count, friction = s->friction.count;
        if (with_old_pattern) {
            s->contacts.count = s->friction.count = 0;
            assemble(&scene, true);
            s->contacts.count = contacts;
            s->friction.count = friction;
        }
        s->project = true;
        assert_int_equal(cipc_potential_gradient(s, NULL), CIPC_OK);
        fail_allocation(n);
        cipc_status status = cipc_assemble_hessian(s, &scene.error);
        bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        assert_right_matrix(&scene, true);
        sheet_scene_free(&scene);
        if (failed) continue;
        assert_true(n > 8);
        return;
    }
}

static void test_out_of_memory(void **state)
{
    (void)state;
    out_of_memory(false);
    out_of_memory(true);
}

/* --- as released ---------------------------------------------------------------------------------------------------------------- */

/* The released code projects the limit in F (SPEC R.1). The limit's energy is a convex function of F - the sum of an increasing convex
 * function of its singular values -, so there is nothing to project, and the matrix is the exact Hessian. */
static void test_released_strain_limit(void **state)
{
    (void)state;
    const double a[3] = {0, 0, 0}, b[3] = {0.3, 0, 0}, c[3] = {0.1, 0, 0.2};
    uint64_t seed = 61;
    int feasible = 0;
    for (int trial = 0; trial < 100; trial++) {
        sheet_scene scene;
        sheet_scene_init(&scene);
        scene.options.released = true;
        cipc_body_description *body = sheet_add_triangle(&scene, "triangle", a, b, c);
        body->material.membrane = CIPC_MEMBRANE_NONE;
        body->material.strain_limit = 1.2;
        body->material.strain_activation = 1;
        body->material.strain_stiffness = 1e3;
        sheet_scene_build(&scene);
        sheet_begin(&scene);
        cipc_stepper *s = scene.stepper;
        for (int i = 0; i < 9; i++) s->x[i] = 1.03 * s->x[i] + random_uniform(&seed, -0.015, 0.015);
        if (cipc_strain_feasible(s, s->x)) {
            double H[81], plain[81];
            cipc_strain_limit_hessian(s->x, s->groups[CIPC_GROUP_STRAIN_LIMIT].params, H);
            memcpy(plain, H, sizeof H);
            assert_true(cipc_psd_project_plain(9, plain));
            for (int i = 0; i < 81; i++) assert_true(fabs(plain[i] - H[i]) <= 1e-12 * fabs(H[0] + H[10] + H[20])); /* convex, indeed */
            assemble(&scene, true);
            dense *got = expand(s), *want = reference(s, false);
            assert_true(same_matrix(got, want, 9, rounding));
            free(got), free(want);
            feasible++;
        }
        sheet_scene_free(&scene);
    }
    assert_true(feasible > 50);
}

/* The released code gives flat hinges no stiffness (SPEC C.6); bent ones have theirs. */
static void test_released_hinges(void **state)
{
    (void)state;
    const double corner[3] = {0, 0, 0}, u[3] = {1, 0, 0}, v[3] = {0, 0, 1};
    for (int released = 0; released < 2; released++) {
        sheet_scene scene;
        sheet_scene_init(&scene);
        scene.options.released = released;
        sheet_add_grid(&scene, "sheet", corner, u, v, 1, 1)->material.membrane = CIPC_MEMBRANE_NONE;
        sheet_scene_build(&scene);
        sheet_begin(&scene);
        assemble(&scene, true);
        dense *got = expand(scene.stepper);
        for (int k = 0; k < 12; k++) /* flat in y: only there is stiffness */
            assert_true((got->entry[k][k] > scene.model->mass[k / 3]) == (!released && k % 3 == 1));
        free(got);
        scene.stepper->x[4] += 0.01;
        assemble(&scene, true);
        got = expand(scene.stepper);
        assert_true(got->entry[4][4] > scene.model->mass[1]);
        free(got);
        sheet_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dense_sum),
        cmocka_unit_test(test_check_rejects),
        cmocka_unit_test(test_jacobian),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_pattern_is_kept),
        cmocka_unit_test(test_out_of_memory),
        cmocka_unit_test(test_released_strain_limit),
        cmocka_unit_test(test_released_hinges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
