/* XDMF: well-formed, and every reference leads to a dataset of the trajectory with the extents it claims. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <hdf5.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/output.h"
#include "support/every_kind.h"

/* Tags open and close in order; attribute values are quoted; no stray '<' or '&'. Enough of a parser for what we write. */
static void assert_well_formed(const char *text)
{
    char stack[16][32];
    int depth = 0;
    for (const char *c = strchr(text, '<'); c != NULL; c = strchr(c + 1, '<')) {
        char name[32];
        const char *end = strchr(c, '>');
        assert_non_null(end);
        if (c[1] == '?') {
            continue;
        }
        assert_int_equal(sscanf(c[1] == '/' ? c + 2 : c + 1, "%31[A-Za-z]", name), 1);
        if (c[1] == '/') {
            assert_true(depth > 0);
            assert_string_equal(stack[--depth], name);
        } else if (end[-1] != '/') {
            assert_true(depth < 16);
            strcpy(stack[depth++], name);
        }
    }
    assert_int_equal(depth, 0);
    for (const char *c = strchr(text, '&'); c != NULL; c = strchr(c + 1, '&')) {
        assert_true(strncmp(c, "&amp;", 5) == 0 || strncmp(c, "&lt;", 4) == 0 || strncmp(c, "&gt;", 4) == 0 ||
                    strncmp(c, "&quot;", 6) == 0 || strncmp(c, "&apos;", 6) == 0);
    }
}

static int count(const char *text, const char *word)
{
    int found = 0;
    for (const char *c = strstr(text, word); c != NULL; c = strstr(c + 1, word)) {
        found++;
    }
    return found;
}

/* The selection start:stride:count:extents behind a dataset's name is one frame of [frames][nodes][3] with the extents claimed. */
static void check_selection(const char *selection, const int claimed[3], const hsize_t dims[3])
{
    int start[3], stride[3], chosen[3], whole[3];
    const int read = sscanf(selection, "|%d %d %d:%d %d %d:%d %d %d:%d %d %d\n", &start[0], &start[1], &start[2], &stride[0], &stride[1],
                            &stride[2], &chosen[0], &chosen[1], &chosen[2], &whole[0], &whole[1], &whole[2]);
    assert_int_equal(read, 12);
    const int wanted[3] = {1, claimed[0], claimed[1]};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(stride[i], 1);
        assert_int_equal(chosen[i], wanted[i]);
        assert_int_equal(whole[i], dims[i]);
        assert_in_range(start[i], 0, whole[i] - chosen[i]);
    }
}

/* Each Format="HDF" ... Dimensions="a b c">t.h5:/path, with a selection or without. Returns how many. */
static int check_references(const char *text, const path *h5)
{
    hid_t file = H5Fopen(h5->text, H5F_ACC_RDONLY, H5P_DEFAULT);
    int references = 0;
    for (const char *c = strstr(text, "Format=\"HDF\""); c != NULL; c = strstr(c + 1, "Format=\"HDF\"")) {
        int claimed[3] = {0, 0, 0}, length = 0;
        char dataset[64];
        const char *dimensions = strstr(c, "Dimensions=\""), *content = strchr(c, '>');
        const int rank = sscanf(dimensions, "Dimensions=\"%d %d %d", &claimed[0], &claimed[1], &claimed[2]);
        assert_int_equal(sscanf(content, ">t.h5:%63[^<|]%n", dataset, &length), 1);
        hid_t data = H5Dopen(file, dataset, H5P_DEFAULT), space = H5Dget_space(data);
        hsize_t dims[3] = {0, 0, 0};
        const int rank_of_data = H5Sget_simple_extent_dims(space, dims, NULL);
        if (content[length] == '|') {
            assert_int_equal(rank_of_data, 3);
            check_selection(content + length, claimed, dims);
        } else {
            assert_int_equal(rank_of_data, rank);
            for (int i = 0; i < rank; i++) {
                assert_int_equal(dims[i], claimed[i]);
            }
        }
        H5Sclose(space);
        H5Dclose(data);
        references++;
    }
    H5Fclose(file);
    return references;
}

/* A grid refers to its cells, the bodies of nodes, and twice each to positions and velocities: once for each library that reads XDMF. */
enum { FRAMES = 3, REFERENCES = 6 };

/* The text of the XDMF file of a trajectory of FRAMES frames (malloc'd), its references held against the datasets; how many there are
 * goes to *references. */
static char *write_both(sample_run *run, double times[FRAMES], int *references)
{
    cipc_error error;
    const path folder = folder_make(), h5 = path_in(&folder, "t.h5"), xdmf = path_in(&folder, "t.xdmf");
    cipc_trajectory *t;
    assert_int_equal(cipc_trajectory_create(&t, h5.text, run->model, run->state, "{}", FRAMES, &error), CIPC_OK);
    for (int i = 1; i < FRAMES; i++) {
        sample_run_advance(run);
        assert_int_equal(cipc_trajectory_append(t, run->state, &error), CIPC_OK);
    }
    assert_int_equal(cipc_trajectory_close(t, &error), CIPC_OK);
    assert_int_equal(cipc_trajectory_times(h5.text, times, FRAMES, &error), CIPC_OK);
    assert_int_equal(cipc_xdmf_write(xdmf.text, "t.h5", run->model, FRAMES, times, &error), CIPC_OK);
    char *text = file_read(&xdmf, NULL);
    assert_well_formed(text);
    assert_int_equal(count(text, "<Time "), FRAMES);
    *references = check_references(text, &h5);
    folder_remove(&folder);
    return text;
}

static void test_every_reference_is_good(void **state)
{
    (void)state;
    double times[FRAMES];
    int references;
    sample_run run = sample_run_create();
    char *text = write_both(&run, times, &references);
    assert_int_equal(references, REFERENCES * FRAMES);
    char last[64];
    snprintf(last, sizeof last, "<Time Value=\"%.17g\"/>", times[FRAMES - 1]);
    assert_non_null(strstr(text, last));
    assert_non_null(strstr(text, ">2 0 0  1 1 1  1 13 3<")); /* the slab of frame 2: start, stride, count */
    assert_non_null(strstr(text, "/velocities|2 0 0:1 1 1:1 13 3:3 13 3\n"));
    free(text);
    sample_run_destroy(&run);
}

static void test_every_sort_is_a_block(void **state)
{
    (void)state;
    double times[FRAMES];
    int references;
    sample_run run = every_kind_create_all();
    char *text = write_both(&run, times, &references);
    assert_int_equal(references, 3 * REFERENCES * FRAMES);
    assert_int_equal(count(text, "CollectionType=\"Spatial\""), FRAMES);
    /* 2 triangles of the cloth, 4 around the tetrahedron; 3 segments of the strand, 2 needles */
    assert_int_equal(count(text, "TopologyType=\"Triangle\" NumberOfElements=\"6\""), FRAMES);
    assert_int_equal(count(text, "TopologyType=\"Polyline\" NodesPerElement=\"2\" NumberOfElements=\"5\""), FRAMES);
    assert_int_equal(count(text, "TopologyType=\"Polyvertex\" NodesPerElement=\"1\" NumberOfElements=\"3\""), FRAMES);
    free(text);
    sample_run_destroy(&run);
}

/* What the model does not have is not there: ParaView takes a grid without cells for an error. */
static void test_a_sort_alone_is_the_frame(void **state)
{
    (void)state;
    static const struct { cipc_body_kind kind; const char *topology; } cases[] = {
        {CIPC_BODY_SHELL, "Triangle"}, {CIPC_BODY_RODS, "Polyline"}, {CIPC_BODY_PARTICLES, "Polyvertex"}, {CIPC_BODY_VOLUME, "Triangle"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double times[FRAMES];
        int references;
        sample_run run = every_kind_create(&cases[i].kind, 1, false);
        char *text = write_both(&run, times, &references), topology[64];
        snprintf(topology, sizeof topology, "<Topology TopologyType=\"%s\"", cases[i].topology);
        assert_int_equal(references, REFERENCES * FRAMES);
        assert_int_equal(count(text, topology), FRAMES);
        assert_int_equal(count(text, "<Topology"), FRAMES);
        assert_int_equal(count(text, "Spatial"), 0);
        free(text);
        sample_run_destroy(&run);
    }
}

static void test_awkward_names_and_no_frames(void **state)
{
    (void)state;
    cipc_error error;
    const double time = 0;
    const path folder = folder_make(), xdmf = path_in(&folder, "t.xdmf");
    sample_run run = sample_run_create();
    assert_int_equal(cipc_xdmf_write(xdmf.text, "a<b>&\"c'\n.h5", run.model, 1, &time, &error), CIPC_OK);
    char *text = file_read(&xdmf, NULL);
    assert_well_formed(text);
    assert_non_null(strstr(text, "a&lt;b&gt;&amp;&quot;c&apos; .h5:/positions"));
    free(text);
    assert_int_equal(cipc_xdmf_write(xdmf.text, "t.h5", run.model, 0, NULL, &error), CIPC_OK);
    text = file_read(&xdmf, NULL);
    assert_well_formed(text);
    free(text);
    assert_int_equal(cipc_xdmf_write("/no/such/folder/t.xdmf", "t.h5", run.model, 0, NULL, &error), CIPC_E_IO);
    sample_run_destroy(&run);
    folder_remove(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_reference_is_good),
        cmocka_unit_test(test_every_sort_is_a_block),
        cmocka_unit_test(test_a_sort_alone_is_the_frame),
        cmocka_unit_test(test_awkward_names_and_no_frames),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
