/* The fields of the registry: all of every params struct, once; there and back; and the oracle's table speaks of the same. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "cipc/energy.h"
#include "cipc/oracle.h"

enum { MOST_PARAMS = 512, MOST_X = 12 };

/* Members that one barrier struct has and only edge-edge looks at. */
static size_t unlisted(const cipc_energy *energy)
{
    bool barrier = strncmp(energy->name, "barrier_", 8) == 0 && strcmp(energy->name, "barrier_edge_edge") != 0;
    return barrier ? sizeof(double) + sizeof(cipc_feature) : 0;
}

/* No member twice, and together they are the struct: all are doubles but the feature, whose 24 bytes need no padding. */
static void test_fields_cover_the_struct(void **state)
{
    (void)state;
    for (int e = 0; e < CIPC_ENERGY_COUNT; e++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)e);
        bool covered[MOST_PARAMS] = {false};
        size_t total = 0;
        for (int i = 0; i < energy->field_count; i++) {
            const cipc_energy_field *field = &energy->fields[i];
            size_t size = field->feature ? sizeof(cipc_feature) : (size_t)field->count * sizeof(double);
            for (size_t k = field->offset; k < field->offset + size; k++) {
                assert_true(k < energy->params_size && !covered[k]);
                covered[k] = true;
            }
            total += size;
        }
        assert_int_equal(total + unlisted(energy), energy->params_size);
        assert_in_range(cipc_energy_number_count(energy), 1, CIPC_ENERGY_NUMBERS);
    }
}

/* Numbers out of sampled parameters, back into parameters: the same energy. */
static void test_round_trip(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 3);
    for (int e = 0; e < CIPC_ENERGY_COUNT; e++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)e);
        for (int b = 0; b < energy->branch_count; b++) {
            union { double align; unsigned char bytes[MOST_PARAMS]; } params, back;
            double x[MOST_X], numbers[CIPC_ENERGY_NUMBERS], again[CIPC_ENERGY_NUMBERS];
            memset(&params, 0, sizeof params);
            energy->sample(rng, b, x, &params);
            cipc_energy_numbers(energy, &params, numbers);
            assert_true(cipc_energy_params(energy, numbers, &back));
            cipc_energy_numbers(energy, &back, again);
            assert_memory_equal(numbers, again, (size_t)cipc_energy_number_count(energy) * sizeof *numbers);
            double before = energy->value(x, &params), after = energy->value(x, &back);
            assert_memory_equal(&before, &after, sizeof before);
        }
    }
    gsl_rng_free(rng);
}

static void test_a_feature_that_is_none(void **state)
{
    (void)state;
    const cipc_energy *energy = cipc_energy_find("barrier_edge_edge");
    double numbers[CIPC_ENERGY_NUMBERS] = {1, 1, 0, 1, 0, 8};
    cipc_contact_barrier params;
    assert_true(cipc_energy_params(energy, numbers, &params));
    assert_int_equal(params.feature.kind, CIPC_EDGE_EDGE);
    static const double bad[] = {-1, 9, 0.5};
    for (int i = 0; i < 3; i++) {
        numbers[5] = bad[i];
        assert_false(cipc_energy_params(energy, numbers, &params));
    }
}

/* The same energies in both tables, and the same parameters under the same names. */
static void test_the_oracle_knows_the_same(void **state)
{
    (void)state;
    for (int e = 0; e < CIPC_ENERGY_COUNT; e++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)e);
        const cipc_oracle_function *function = cipc_oracle_function_find(energy->name);
        if (function == NULL) fail_msg("the oracle has no %s", energy->name);
        assert_int_equal(function->nodes, energy->nodes);
        assert_int_equal(function->field_count, cipc_energy_number_count(energy));
        int at = 0;
        for (int i = 0; i < energy->field_count; i++) {
            for (int k = 0; k < energy->fields[i].count; k++, at++) {
                char name[64];
                if (energy->fields[i].count > 1) snprintf(name, sizeof name, "%s[%d]", energy->fields[i].name, k);
                else snprintf(name, sizeof name, "%s", energy->fields[i].name);
                assert_string_equal(function->fields[at], name);
            }
        }
    }
    for (int i = 0; i < cipc_oracle_function_count(); i++) { /* and nothing that is neither an energy nor a distance nor the mollifier */
        const char *name = cipc_oracle_function_at(i)->name;
        assert_true(cipc_energy_find(name) != NULL || strncmp(name, "distance2_", 10) == 0 || strcmp(name, "edge_edge_mollifier") == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fields_cover_the_struct),
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_a_feature_that_is_none),
        cmocka_unit_test(test_the_oracle_knows_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
