/* The campaign that holds every energy against MPFR: it must reject every planted fault, a missed branch and an unknown energy, and let the registry pass. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "support/wrong_energies.h"
#include "verify/energies.h"

static const unsigned long SEED = 20261127;

static int id_of(const char *name)
{
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++)
        if (strcmp(cipc_energy_entry((cipc_energy_id)i)->name, name) == 0) return i;
    fail_msg("no energy %s", name);
    return -1;
}

/* Run `samples` of one energy; true and the failure's text if the row fails. */
static bool row_fails(const verify_campaign *original, const verify_energy_subject *subject, int id, long samples, char *text, size_t size)
{
    verify_campaign campaign = *original;
    verify_run run = {.seed = SEED, .samples = samples, .shard = 1, .shards = 1, .threads = 1};
    verify_row *row = cipc_alloc(1, sizeof *row);
    cipc_error error;
    assert_non_null(row);
    campaign.context = subject;
    campaign.weight = 1;
    assert_int_equal(verify_run_row(&campaign, id, &run, row, &error), CIPC_OK);
    assert_int_equal(row->samples, samples);
    bool fails = verify_row_failure(row, true, text, size);
    cipc_free(row);
    return fails;
}

enum { PER_BRANCH = 2 };

static const cipc_energy *on_trial; /* test programs may have state */
static const cipc_energy *entry_on_trial(cipc_energy_id id)
{
    (void)id;
    return on_trial;
}

static bool is_rejected(const cipc_energy *energy, int id, char *text, size_t size)
{
    const verify_energy_subject subject = {entry_on_trial};
    on_trial = energy;
    return row_fails(&verify_energies, &subject, id, PER_BRANCH * energy->branch_count, text, size);
}

static void test_planted_faults_are_rejected(void **state)
{
    (void)state;
    for (int i = 0; i < wrong_energy_count(); i++) {
        const wrong_energy *wrong = wrong_energy_at(i);
        cipc_energy energy = wrong_energy_entry(wrong);
        char text[512];
        if (!is_rejected(&energy, id_of(wrong->energy), text, sizeof text)) fail_msg("%s: accepted", wrong->what);
        if (strstr(text, wrong->mpfr) == NULL) fail_msg("%s: rejected for another reason: %s", wrong->what, text);
    }
}

static void sample_one_branch_only(gsl_rng *rng, int branch, double *x, void *params)
{
    (void)branch;
    cipc_energy_find("membrane_stvk")->sample(rng, 1, x, params);
}

static void test_missed_branch_is_rejected(void **state)
{
    (void)state;
    char text[512];
    cipc_energy energy = *cipc_energy_find("membrane_stvk");
    energy.sample = sample_one_branch_only;
    assert_true(is_rejected(&energy, CIPC_ENERGY_MEMBRANE_STVK, text, sizeof text));
    if (strstr(text, "branch rest was reached 0 times") == NULL) fail_msg("%s", text);
}

static void test_what_mpfr_lacks_is_rejected(void **state)
{
    (void)state;
    char text[512];
    cipc_energy energy = *cipc_energy_find("gravity");
    energy.name = "levity";
    assert_true(is_rejected(&energy, CIPC_ENERGY_GRAVITY, text, sizeof text));
    if (strstr(text, "undecided by the oracle") == NULL) fail_msg("%s", text);
}

/* Both campaigns on the registry as it is: nothing fails. */
static void test_the_registry_passes(void **state)
{
    (void)state;
    const verify_energy_subject subject = {cipc_energy_entry};
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++) {
        char text[512];
        long samples = PER_BRANCH * cipc_energy_entry((cipc_energy_id)i)->branch_count;
        if (row_fails(&verify_energies, &subject, i, samples, text, sizeof text)) fail_msg("energies: %s (seed %lu)", text, SEED);
        if (row_fails(&verify_derivatives, &subject, i, samples, text, sizeof text)) fail_msg("derivatives: %s (seed %lu)", text, SEED);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_planted_faults_are_rejected),
        cmocka_unit_test(test_missed_branch_is_rejected),
        cmocka_unit_test(test_what_mpfr_lacks_is_rejected),
        cmocka_unit_test(test_the_registry_passes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
