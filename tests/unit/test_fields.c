/* The fields of the registry's params structs: they cover every byte that is not padding exactly once, and their flat list of numbers leads there and back. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/energy.h"
#include "cipc/oracle.h"

enum { MOST_BYTES = 1024, SAMPLES = 5 };
static const unsigned long SEED = 20261127;

static size_t field_bytes(const cipc_energy_field *field)
{
    return field->feature ? sizeof(cipc_feature) : (size_t)field->count * sizeof(double);
}

/* How often each byte of the params struct is covered. */
static void cover(const cipc_energy_field *fields, int count, int covered[MOST_BYTES])
{
    memset(covered, 0, MOST_BYTES * sizeof *covered);
    for (int i = 0; i < count; i++)
        for (size_t b = 0; b < field_bytes(&fields[i]); b++) covered[fields[i].offset + b]++;
}

/* The structs are made of doubles, but for a last feature of ints after which padding may follow: everything before its end counts. The plain barriers leave
 * out what only edge-edge reads: mollifier and feature. */
static size_t meaningful_bytes(const cipc_energy *energy)
{
    const cipc_energy_field *last = &energy->fields[energy->field_count - 1];
    if (last->feature) return offsetof(cipc_contact_barrier, feature) + sizeof(cipc_feature);
    return strncmp(energy->name, "barrier_", 8) == 0 ? offsetof(cipc_contact_barrier, mollifier_eps) : energy->params_size;
}

static bool covers_once(const cipc_energy *energy, const cipc_energy_field *fields, int count)
{
    int covered[MOST_BYTES];
    bool good = energy->params_size <= MOST_BYTES;
    cover(fields, count, covered);
    for (size_t b = 0; b < energy->params_size; b++) good = good && covered[b] == (b < meaningful_bytes(energy) ? 1 : 0);
    return good;
}

static void test_every_byte_is_covered_once(void **state)
{
    (void)state;
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)i);
        if (!covers_once(energy, energy->fields, energy->field_count)) fail_msg("%s: bytes left out or covered twice", energy->name);
    }
}

/* A field left out, one too short, one in another's place. */
static void test_wrong_fields_are_noticed(void **state)
{
    (void)state;
    const cipc_energy *friction = cipc_energy_find("friction");
    cipc_energy_field wrong[5];
    assert_int_equal(friction->field_count, 5);
    memcpy(wrong, friction->fields, sizeof wrong);
    assert_true(covers_once(friction, wrong, 5));
    assert_false(covers_once(friction, wrong, 4));
    wrong[3].count--;
    assert_false(covers_once(friction, wrong, 5));
    memcpy(wrong, friction->fields, sizeof wrong);
    wrong[1].offset = wrong[0].offset;
    assert_false(covers_once(friction, wrong, 5));
}

/* numbers -> params -> numbers, and params -> numbers -> params as far as the energy reads them: its value is the same to the bit. */
static void test_there_and_back(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    gsl_rng_set(rng, SEED);
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)i);
        int count = cipc_energy_number_count(energy);
        assert_in_range(count, 1, CIPC_ENERGY_NUMBERS);
        for (int k = 0; k < SAMPLES * energy->branch_count; k++) {
            union { double align; unsigned char bytes[MOST_BYTES]; } params = {0}, back = {0};
            double x[12], numbers[CIPC_ENERGY_NUMBERS], again[CIPC_ENERGY_NUMBERS];
            energy->sample(rng, k % energy->branch_count, x, &params);
            cipc_energy_numbers(energy, &params, numbers);
            assert_true(cipc_energy_params(energy, numbers, &back));
            cipc_energy_numbers(energy, &back, again);
            assert_memory_equal(numbers, again, (size_t)count * sizeof *numbers);
            double value = energy->value(x, &params), same = energy->value(x, &back);
            assert_memory_equal(&value, &same, sizeof value);
            assert_int_equal(energy->branch(x, &params), energy->branch(x, &back));
        }
    }
    gsl_rng_free(rng);
}

static void test_what_is_no_feature_is_refused(void **state)
{
    (void)state;
    const cipc_energy *energy = cipc_energy_find("barrier_edge_edge");
    const double wrong[] = {-1, 9, 0.5, 1e300, NAN, INFINITY};
    cipc_contact_barrier params;
    double numbers[CIPC_ENERGY_NUMBERS] = {1, 1, 0, 1e-3, 0, 0};
    for (int f = 0; f < cipc_feature_count(CIPC_EDGE_EDGE); f++) {
        numbers[5] = f;
        assert_true(cipc_energy_params(energy, numbers, &params));
        assert_int_equal(cipc_feature_index(CIPC_EDGE_EDGE, &params.feature), f);
    }
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        numbers[5] = wrong[k];
        assert_false(cipc_energy_params(energy, numbers, &params));
    }
}

/* The name of number `number` of an energy: "mass", "target[2]". */
static void number_name(const cipc_energy *energy, int number, char *text, size_t size)
{
    const cipc_energy_field *field = energy->fields;
    while (number >= field->count) number -= field++->count;
    if (field->count == 1) (void)snprintf(text, size, "%s", field->name);
    else (void)snprintf(text, size, "%s[%d]", field->name, number);
}

/* Does the oracle know this energy, with the same numbers under the same names? */
static bool oracle_agrees(const cipc_energy *energy)
{
    const cipc_oracle_function *f = cipc_oracle_function_find(energy->name);
    if (f == NULL || f->nodes != energy->nodes || f->field_count != cipc_energy_number_count(energy)) return false;
    for (int i = 0; i < f->field_count; i++) {
        char name[64];
        number_name(energy, i, name, sizeof name);
        if (strcmp(name, f->fields[i]) != 0) return false;
    }
    return true;
}

/* The functions of the oracle that are no energies. */
static const char *const bare[] = {"distance2_point_point", "distance2_point_line", "distance2_point_plane", "distance2_line_line", "edge_edge_mollifier"};

static bool is_bare(const char *name)
{
    for (size_t i = 0; i < sizeof bare / sizeof *bare; i++)
        if (strcmp(bare[i], name) == 0) return true;
    return false;
}

static void test_registry_and_oracle_list_the_same(void **state)
{
    (void)state;
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)i);
        if (!oracle_agrees(energy)) fail_msg("%s: the oracle lacks it, or has other parameters", energy->name);
    }
    for (int i = 0; i < cipc_oracle_function_count(); i++) {
        const char *name = cipc_oracle_function_at(i)->name;
        if (cipc_energy_find(name) == NULL && !is_bare(name)) fail_msg("%s: the registry lacks it", name);
    }
    for (size_t i = 0; i < sizeof bare / sizeof *bare; i++) assert_non_null(cipc_oracle_function_find(bare[i]));
    assert_null(cipc_oracle_function_find("no_such_function"));
}

/* A name that one table lacks, a field renamed, two fields exchanged. */
static void test_differences_of_the_tables_are_noticed(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("hinge_bending");
    cipc_energy_field fields[2];
    wrong.name = "hinge_bending_2";
    assert_false(oracle_agrees(&wrong));
    wrong = *cipc_energy_find("hinge_bending");
    wrong.fields = fields;
    memcpy(fields, cipc_energy_find("hinge_bending")->fields, sizeof fields);
    assert_true(oracle_agrees(&wrong));
    fields[1].name = "angle";
    assert_false(oracle_agrees(&wrong));
    fields[1] = cipc_energy_find("hinge_bending")->fields[0];
    fields[0] = cipc_energy_find("hinge_bending")->fields[1];
    assert_false(oracle_agrees(&wrong));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_byte_is_covered_once),
        cmocka_unit_test(test_wrong_fields_are_noticed),
        cmocka_unit_test(test_there_and_back),
        cmocka_unit_test(test_what_is_no_feature_is_refused),
        cmocka_unit_test(test_registry_and_oracle_list_the_same),
        cmocka_unit_test(test_differences_of_the_tables_are_noticed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
