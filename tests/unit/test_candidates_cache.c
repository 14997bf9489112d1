/* Candidates kept over iterations: at every point of a covered path they give the same contacts as a search made for that point. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/crowded_scene.h"
#include "support/failing_memory.h"

enum { MOST = 3 * 64 };

/* The contacts at x by a search of its own. */
static void fresh_contacts(const cipc_stepper *s, const double *x, cipc_contact_set *set)
{
    cipc_broad_phase *broad_phase;
    cipc_candidates candidates;
    memset(&candidates, 0, sizeof candidates);
    assert_int_equal(cipc_broad_phase_create(&broad_phase, s->model, NULL), CIPC_OK);
    assert_int_equal(
        cipc_broad_phase_find(broad_phase, s->model, x, NULL, 1, s->options.contact.dhat, s->is_dirichlet, 1, &candidates, NULL), CIPC_OK);
    assert_int_equal(cipc_contact_set_build(set, s->model, &candidates, x, s->kappa, &s->options.contact, 1, NULL), CIPC_OK);
    cipc_candidates_free(&candidates);
    cipc_broad_phase_destroy(broad_phase);
}

/* Same contacts from the cache as from the search? */
static bool cache_is_complete(cipc_stepper *s, const double *x)
{
    cipc_contact_set fresh;
    memset(&fresh, 0, sizeof fresh);
    fresh_contacts(s, x, &fresh);
    assert_int_equal(cipc_contacts_at(s, x, &s->trial_contacts, NULL), CIPC_OK);
    bool same = fresh.count == s->trial_contacts.count && fresh.min_gap == s->trial_contacts.min_gap;
    for (int i = 0; same && i < fresh.count; i++)
        same = memcmp(fresh.contacts[i].nodes, s->trial_contacts.contacts[i].nodes, sizeof fresh.contacts[i].nodes) == 0 &&
               fresh.contacts[i].barrier.weight == s->trial_contacts.contacts[i].barrier.weight;
    cipc_contact_set_free(&fresh);
    return same;
}

static void along(const cipc_stepper *s, const double *p, double t, double *x)
{
    for (int i = 0; i < 3 * s->model->node_count; i++) x[i] = s->x[i] + t * p[i];
}

/* Random walks of small and large steps, as a line search makes them. */
static void test_walks(void **state)
{
    (void)state;
    int searches = 0, reuses = 0, contacts = 0;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        sheet_scene scene;
        crowded_scene(&scene, seed, crowded_euler, 0, 1);
        cipc_stepper *s = scene.stepper;
        uint64_t random = 71 * seed;
        for (int step = 0; step < 30; step++) {
            double p[MOST], x[MOST], size = crowded_dhat * pow(10, random_uniform(&random, -2.5, 1)), drift[3];
            random_fill(&random, drift, 3, step % 3 ? 0 : 5 * size); /* now and then all free nodes go the same way */
            for (int i = 0; i < 3 * scene.model->node_count; i++)
                p[i] = s->is_dirichlet[i / 3] ? 0 : drift[i % 3] + random_uniform(&random, -size, size);
            assert_int_equal(cipc_cache_cover(s, s->x, p, NULL), CIPC_OK);
            searches += s->cache.along_path;
            reuses += !s->cache.along_path;
            for (int k = 0; k <= 4; k++) {
                along(s, p, k / 4.0, x);
                assert_true(cache_is_complete(s, x));
                contacts += s->trial_contacts.count;
            }
            along(s, p, random_uniform(&random, 0, 1), x);
            memcpy(s->x, x, 3 * (size_t)scene.model->node_count * sizeof *x);
            cipc_cache_recentre(s);
            assert_true(cache_is_complete(s, s->x));
            assert_int_equal(cipc_cache_cover(s, s->x, NULL, NULL), CIPC_OK); /* no motion: the point alone */
            assert_true(cache_is_complete(s, s->x));
        }
        s->cache.candidates.lists[CIPC_POINT_TRIANGLE].count = s->cache.candidates.lists[CIPC_EDGE_EDGE].count = 0; /* the check can fail */
        assert_true(s->trial_contacts.count == 0 || !cache_is_complete(s, s->x));
        sheet_scene_free(&scene);
    }
    assert_true(searches > 50 && reuses > 50 && contacts > 1000);
}

/* Without a path there is nothing to recentre on; a cache without slack is empty. */
static void test_recentre(void **state)
{
    (void)state;
    sheet_scene scene;
    crowded_scene(&scene, 1, crowded_euler, 0, 1);
    cipc_stepper *s = scene.stepper;
    size_t bytes = 3 * (size_t)scene.model->node_count * sizeof(double);
    double p[MOST] = {0}, reference[MOST];
    s->cache.slack = 0;
    assert_int_equal(cipc_cache_cover(s, s->x, NULL, NULL), CIPC_OK);
    assert_true(s->cache.slack > 0 && !s->cache.along_path);
    memcpy(reference, s->cache.reference, bytes);
    s->x[3 * 10] += 1e-4;
    cipc_cache_recentre(s);
    assert_memory_equal(s->cache.reference, reference, bytes);
    s->cache.slack = 0;
    p[3 * 10] = 1e-4;
    assert_int_equal(cipc_cache_cover(s, s->x, p, NULL), CIPC_OK);
    assert_true(s->cache.along_path);
    s->x[3 * 10] += 1e-4;
    cipc_cache_recentre(s);
    assert_memory_equal(s->cache.reference, s->x, bytes);
    sheet_scene_free(&scene);
}

/* A search that fails leaves an empty cache: the next one starts afresh. */
static void test_out_of_memory(void **state)
{
    (void)state;
    long n = 1;
    for (bool failed = true; failed; n++) {
        sheet_scene scene;
        crowded_scene(&scene, 2, crowded_euler, 0, 1);
        cipc_stepper *s = scene.stepper;
        s->cache.slack = 0;
        cipc_candidates_free(&s->cache.candidates);
        cipc_contact_set_free(&s->contacts);
        fail_allocation(n);
        cipc_status status = cipc_cache_cover(s, s->x, NULL, &scene.error);
        if (!status) status = cipc_contacts_at(s, s->x, &s->contacts, &scene.error);
        failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        assert_int_equal(cipc_cache_cover(s, s->x, NULL, &scene.error), CIPC_OK);
        assert_true(cache_is_complete(s, s->x));
        sheet_scene_free(&scene);
    }
    assert_true(n > 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_walks),
        cmocka_unit_test(test_recentre),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
