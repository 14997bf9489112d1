/* OBJ: read back with a reader of the test's own, exact to the bit. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/output.h"
#include "support/every_kind.h"

static void test_round_trip(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "a.obj");
    sample_run run = sample_run_create();
    sample_run_advance(&run);
    run.state->position[0] = -1.0 / 3 * DBL_MIN;
    run.state->position[1] = DBL_MAX;
    memcpy(run.model->bodies[1].name, "my ground", sizeof "my ground");
    assert_int_equal(cipc_obj_write(file.text, run.model, run.state->position, &error), CIPC_OK);

    char *text = file_read(&file, NULL), *rest = text, groups[256] = "";
    int nodes = 0, triangles = 0;
    for (char *line = strtok_r(text, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        double x[3];
        int v[3];
        if (sscanf(line, "v %lf %lf %lf", &x[0], &x[1], &x[2]) == 3) {
            assert_memory_equal(x, run.state->position + 3 * nodes, sizeof x);
            nodes++;
        } else if (sscanf(line, "f %d %d %d", &v[0], &v[1], &v[2]) == 3) {
            for (int i = 0; i < 3; i++) {
                assert_int_equal(v[i] - 1, run.model->triangles[triangles][i]);
            }
            triangles++;
        } else if (line[0] == 'g') {
            snprintf(groups + strlen(groups), sizeof groups - strlen(groups), "%s@%d;", line, triangles);
        } else {
            assert_int_equal(line[0], '#');
        }
    }
    assert_int_equal(nodes, run.model->node_count);
    assert_int_equal(triangles, run.model->triangle_count);
    assert_string_equal(groups, "g cloth@0;g my_ground@8;");
    free(text);
    sample_run_destroy(&run);
    folder_remove(&folder);
}

/* Every element below the group of its body: what follows the nodes, word for word. */
static void test_every_kind(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "a.obj");
    sample_run run = every_kind_create_all();
    const int (*surface)[3] = (const int (*)[3])run.model->triangles + run.model->bodies[3].first_triangle;
    char expected[512];
    int used = snprintf(expected, sizeof expected, "%s%s",
                        "g cloth\nf 1 2 3\nf 3 2 4\ng strand\nl 5 6\nl 6 7\nl 7 8\n", "g grains\np 9\np 10\np 11\ng block\n");
    for (int t = 0; t < 4; t++) {
        used += snprintf(expected + used, sizeof expected - (size_t)used, "f %d %d %d\n", surface[t][0] + 1, surface[t][1] + 1,
                         surface[t][2] + 1);
    }
    snprintf(expected + used, sizeof expected - (size_t)used, "g needles\nl 16 17\nl 18 19\n");
    assert_int_equal(cipc_obj_write(file.text, run.model, run.state->position, &error), CIPC_OK);
    char *text = file_read(&file, NULL);
    assert_string_equal(strstr(text, "g cloth"), expected);
    assert_non_null(strstr(text, "19 nodes, 6 triangles, 5 segments, 3 particles"));
    free(text);
    sample_run_destroy(&run);
    folder_remove(&folder);
}

static void test_unwritable(void **state)
{
    (void)state;
    cipc_error error;
    sample_run run = sample_run_create();
    assert_int_equal(cipc_obj_write("/no/such/folder/a.obj", run.model, run.state->position, &error), CIPC_E_IO);
    sample_run_destroy(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_every_kind),
        cmocka_unit_test(test_unwritable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
