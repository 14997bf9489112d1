#define _XOPEN_SOURCE 700 /* nftw */
#include "support/sample_run.h"

#include <stdarg.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <ftw.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SIDE = 3, CLOTH_NODES = SIDE * SIDE, CLOTH_TRIANGLES = 8 };

static void fill_cloth(double position[3 * CLOTH_NODES], int triangles[CLOTH_TRIANGLES][3])
{
    for (int j = 0; j < SIDE; j++) {
        for (int i = 0; i < SIDE; i++) {
            const double x[3] = {i / 2.0 - 0.5, 0.2, j / 2.0 - 0.5};
            memcpy(position + 3 * (j * SIDE + i), x, sizeof x);
        }
    }
    for (int c = 0; c < 4; c++) {
        const int a = c / 2 * SIDE + c % 2;
        const int pair[2][3] = {{a, a + SIDE, a + 1}, {a + 1, a + SIDE, a + SIDE + 1}};
        memcpy(triangles[2 * c], pair, sizeof pair);
    }
}

sample_run sample_run_create(void)
{
    double cloth[3 * CLOTH_NODES];
    int cloth_triangles[CLOTH_TRIANGLES][3];
    const double ground[12] = {-1, 0, -1, 1, 0, -1, -1, 0, 1, 1, 0, 1};
    const int ground_triangles[2][3] = {{0, 2, 1}, {1, 2, 3}};
    fill_cloth(cloth, cloth_triangles);
    const cipc_material cotton = {.density = 472, .thickness = 3e-4, .membrane = CIPC_MEMBRANE_NEO_HOOKEAN, .membrane_young = 8e3,
                                        .membrane_poisson = 0.24, .strain_limit = 1.06, .strain_activation = 1, .strain_stiffness = 1e3};
    cipc_material stone = cotton;
    stone.strain_limit = 0;
    const cipc_body_description bodies[2] = {
        {.name = "cloth",
         .material = cotton,
         .node_count = CLOTH_NODES,
         .rest = cloth,
         .position = cloth,
         .triangle_count = CLOTH_TRIANGLES,
         .triangles = (const int(*)[3])cloth_triangles},
        {.name = "ground",
         .material = stone,
         .fixed = true,
         .node_count = 4,
         .rest = ground,
         .position = ground,
         .triangle_count = 2,
         .triangles = ground_triangles},
    };
    const double gravity[3] = {0, -9.81, 0};
    sample_run run = {NULL, NULL};
    cipc_error error;
    if (cipc_model_create(&run.model, bodies, 2, gravity, &error) != CIPC_OK ||
        cipc_state_create(&run.state, bodies, 2, &error) != CIPC_OK) {
        fail_msg("%s: %s", error.place, error.what);
    }
    return run;
}

void sample_run_destroy(sample_run *run)
{
    cipc_model_destroy(run->model);
    cipc_state_destroy(run->state);
}

void sample_run_advance(sample_run *run)
{
    cipc_state *s = run->state;
    s->step++;
    s->time = s->step * 0.01;
    s->barrier_stiffness = 1e3 / 3 * s->step;
    s->strain_stiffness_factor = 1 + 1.0 / 3 * s->step;
    for (int i = 0; i < 3 * CLOTH_NODES && i < 3 * s->node_count; i++) {
        s->position[i] += 0.001 * sin(i + 7.0 * s->step);
        s->velocity[i] = 0.1 * cos(i + 3.0 * s->step);
    }
}

path folder_make(void)
{
    path folder;
    const char *base = getenv("TMPDIR");
    snprintf(folder.text, sizeof folder.text, "%s/cipc-test-XXXXXX", base != NULL ? base : "/tmp");
    assert_non_null(mkdtemp(folder.text));
    return folder;
}

static int remove_entry(const char *name, const struct stat *status, int kind, struct FTW *where)
{
    (void)status;
    (void)kind;
    (void)where;
    return remove(name);
}

void folder_remove(const path *folder)
{
    enum { OPEN_FOLDERS = 8 };
    nftw(folder->text, remove_entry, OPEN_FOLDERS, FTW_DEPTH | FTW_PHYS);
}

path path_in(const path *folder, const char *name)
{
    path file;
    int length = snprintf(file.text, sizeof file.text, "%s/%s", folder->text, name);
    assert_in_range(length, 1, sizeof file.text - 1);
    return file;
}

char *file_read(const path *file, size_t *size)
{
    FILE *in = fopen(file->text, "rb");
    if (in == NULL) {
        fail_msg("cannot open %s", file->text);
    }
    fseek(in, 0, SEEK_END);
    const long length = ftell(in);
    rewind(in);
    char *bytes = malloc((size_t)length + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, (size_t)length, in), length);
    bytes[length] = '\0';
    fclose(in);
    if (size != NULL) {
        *size = (size_t)length;
    }
    return bytes;
}

void file_write(const path *file, const void *bytes, size_t size)
{
    FILE *out = fopen(file->text, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}

int file_exists(const path *file)
{
    return access(file->text, F_OK) == 0;
}
