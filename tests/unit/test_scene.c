/* Loading scenes whole: syntax, overrides, the resolved scene, lack of memory. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/failing_memory.h"
#include "support/scene_trial.h"

static const char two_bodies[] =
    "{\n"
    "  \"comment\": \"a scene with some of everything\",\n"
    "  \"time_step\": 0.04, \"steps\": 5, \"seed\": 3,\n"
    "  \"integrator\": \"implicit-midpoint\",\n"
    "  \"bodies\": [\n"
    "    {\"name\": \"ball\", \"fixed\": true, \"shell\": {\"icosphere\": {\"radius\": 0.1, \"subdivisions\": 1}}},\n"
    "    {\"name\": \"cloth\", \"material\": \"cotton\", \"membrane_factor\": 0.01, \"strain_limit\": \"material\", \"offset\": 1e-4,\n"
    "     \"shell\": {\"irregular\": {\"size\": [1, 0.7], \"nodes\": 60}}, \"velocity\": [0.1, 0, 0],\n"
    "     \"transform\": {\"scale\": [1, 1, 1.1], \"rotate\": [{\"axis\": [1, 2, 3], \"angle\": 0.3}], \"translate\": [0, 0.4, 0]}}\n"
    "  ],\n"
    "  \"friction\": [{\"between\": [\"cloth\", \"ball\"], \"mu\": 0.4}],\n"
    "  \"dirichlet\": [\n"
    "    {\"body\": \"cloth\", \"select\": {\"box\": {\"max\": [0.1, 1, 1]}}, \"release\": 1.5},\n"
    "    {\"name\": \"spin\", \"body\": \"ball\", \"select\": {\"all\": true}, \"motion\": [{\"begin\": 1, \"angular_velocity\": 3, "
    "\"axis\": [1, 1, 0]}]}\n"
    "  ],\n"
    "  \"sizes\": {\"ci\": {}, \"desk\": {\"bodies.cloth.shell.irregular.nodes\": 90, \"steps\": 7}}\n"
    "}\n";

/* Every kind of body, and everything that binds bodies. */
static const char every_kind[] =
    "{\"time_step\": 0.04, \"steps\": 5, \"quasistatic\": true, \"strain_coupling\": \"split\", \"bodies\": [\n"
    "  {\"name\": \"silk\", \"membrane\": {\"model\": \"orthotropic\", \"fabric\": \"silk\", \"factor\": 0.1, \"warp\": [1, 0, 1]}, \"bending_factor\": 0.3,"
    " \"strain_limit\": {\"lower\": 0.7, \"lower_activation\": 0.75}, \"collision_group\": \"cloth\","
    " \"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [3, 3]}}, \"damping\": {\"stiffness\": 0.01, \"mass\": 0.1}},\n"
    "  {\"name\": \"wool\", \"material\": \"wool\", \"collision_group\": \"cloth\", \"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [3, 3]}}},\n"
    "  {\"name\": \"hair\", \"rods\": {\"grid\": {\"count\": [2, 1, 2], \"spacing\": [0.1, 0.1, 0.1], \"length\": 0.3, \"segments\": 4}}, \"density\": 1300,"
    " \"diameter\": 8e-5, \"young\": 4e8, \"bending_factor\": 0.01, \"rest_curvature\": \"rest\"},\n"
    "  {\"name\": \"sand\", \"particles\": {\"lattice\": {\"count\": [3, 3, 3], \"spacing\": [0.1, 0.1, 0.1], \"jitter\": 0.01}}, \"density\": 1600,"
    " \"diameter\": 2e-3},\n"
    "  {\"name\": \"jelly\", \"volume\": {\"box\": {\"size\": [1, 1, 1], \"cells\": [2, 1, 2]}}, \"density\": 1000, \"young\": 1e4, \"poisson\": 0.4},\n"
    "  {\"name\": \"bowl\", \"fixed\": true, \"shell\": {\"revolution\": {\"profile\": [[0, 0], [1, 0.1], [2, 1]], \"sectors\": 8}}}],\n"
    "\"collisions\": [{\"between\": [\"sand\", \"hair\"], \"enabled\": false}],\n"
    "\"stitches\": [{\"body_a\": \"silk\", \"nodes_a\": [0, 1, 2], \"body_b\": \"wool\", \"nodes_b\": [0, 1, 2]}],\n"
    "\"dirichlet\": [{\"bodies\": [\"wool\", \"silk\"], \"select\": {\"ring\": {\"end\": \"max\"}}, \"release\": 0.1, \"release_interval\": 0.07,"
    " \"motion\": [{\"velocity\": [0, 1, 0], \"turn\": 0.3}]},"
    " {\"body\": \"sand\", \"select\": {\"box\": {\"max\": [1, 0.9, 1], \"relative_to\": \"so-far\"}}}]}\n";

static void assert_same_doubles(const double *a, const double *b, int count)
{
    assert_memory_equal(a, b, (size_t)count * sizeof *a);
}

static void assert_same_sets(const cipc_model *a, const cipc_model *b)
{
    assert_int_equal(a->dirichlet_count, b->dirichlet_count);
    for (int i = 0; i < a->dirichlet_count; i++) {
        const cipc_dirichlet_set *p = &a->dirichlet[i], *q = &b->dirichlet[i];
        assert_int_equal(p->node_count, q->node_count);
        assert_memory_equal(p->nodes, q->nodes, (size_t)p->node_count * sizeof *p->nodes);
        assert_true(p->release == q->release);
        assert_int_equal(p->motion_count, q->motion_count);
        if (p->motion_count > 0) assert_memory_equal(p->motions, q->motions, (size_t)p->motion_count * sizeof *p->motions);
    }
}

/* Member by member: between them there may be padding. */
static void assert_same_materials(const cipc_material *p, const cipc_material *q)
{
    assert_true(p->density == q->density && p->thickness == q->thickness && p->membrane == q->membrane);
    assert_true(p->membrane_young == q->membrane_young && p->membrane_poisson == q->membrane_poisson);
    assert_memory_equal(&p->orthotropic, &q->orthotropic, sizeof p->orthotropic);
    assert_true(p->bending_young == q->bending_young && p->bending_poisson == q->bending_poisson && p->hinge_constant == q->hinge_constant);
    assert_true(p->strain_limit == q->strain_limit && p->strain_activation == q->strain_activation && p->strain_stiffness == q->strain_stiffness);
    assert_true(p->strain_lower_limit == q->strain_lower_limit && p->strain_lower_activation == q->strain_lower_activation);
    assert_true(p->young == q->young && p->poisson == q->poisson && p->curved == q->curved && p->volume == q->volume);
    assert_true(p->damping_stiffness == q->damping_stiffness && p->damping_mass == q->damping_mass);
}

static void assert_same_elements(const cipc_model *a, const cipc_model *b)
{
    assert_int_equal(a->edge_count, b->edge_count);
    assert_int_equal(a->segment_count, b->segment_count);
    assert_int_equal(a->tetrahedron_count, b->tetrahedron_count);
    assert_int_equal(a->stitch_count, b->stitch_count);
    if (a->edge_count > 0) assert_memory_equal(a->edges, b->edges, (size_t)a->edge_count * sizeof *a->edges);
    if (a->tetrahedron_count > 0) assert_memory_equal(a->tetrahedra, b->tetrahedra, (size_t)a->tetrahedron_count * sizeof *a->tetrahedra);
    assert_memory_equal(a->pair_apart, b->pair_apart, (size_t)a->body_count * (size_t)a->body_count * sizeof *a->pair_apart);
    for (int i = 0; i < a->stitch_count; i++) {
        assert_memory_equal(a->stitches[i].nodes, b->stitches[i].nodes, sizeof a->stitches[i].nodes);
        assert_true(a->stitches[i].ratio == b->stitches[i].ratio && a->stitches[i].stiffness == b->stitches[i].stiffness);
    }
}

static void assert_same_models(const cipc_scene *s, const cipc_scene *t)
{
    const cipc_model *a = s->model, *b = t->model;
    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->triangle_count, b->triangle_count);
    assert_int_equal(a->hinge_count, b->hinge_count);
    assert_same_doubles(a->rest, b->rest, 3 * a->node_count);
    assert_same_doubles(a->mass, b->mass, a->node_count);
    assert_same_doubles(a->gravity, b->gravity, 3);
    assert_same_doubles(a->pair_friction, b->pair_friction, a->body_count * a->body_count);
    assert_memory_equal(a->triangles, b->triangles, (size_t)a->triangle_count * sizeof *a->triangles);
    assert_same_doubles(s->state->position, t->state->position, 3 * a->node_count);
    assert_same_doubles(s->state->velocity, t->state->velocity, 3 * a->node_count);
    for (int i = 0; i < a->body_count; i++) {
        const cipc_body *p = &a->bodies[i], *q = &b->bodies[i];
        assert_string_equal(p->name, q->name);
        assert_true(p->kind == q->kind && p->offset == q->offset && p->friction == q->friction && p->fixed == q->fixed);
        assert_same_materials(&p->material, &q->material);
    }
    assert_same_elements(a, b);
    assert_same_sets(a, b);
}

/* The resolved scene loads to the same arrays, bit by bit, and resolves to itself. */
static void test_resolved_scene_is_the_same_scene(void **state)
{
    (void)state;
    const struct {
        const char *text, *override;
    } scenes[] = {{two_bodies, NULL},
                  {two_bodies, "size=desk"},
                  {two_bodies, "compat=released"},
                  {two_bodies, "bodies.cloth.strain_limit={\"limit\": 1.01}"},
                  {every_kind, NULL},
                  {every_kind, "compat=released"}};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        cipc_scene *s = accept_scene(scenes[i].text, scenes[i].override), *t = accept_scene(s->resolved, NULL);
        assert_same_models(s, t);
        assert_string_equal(s->resolved, t->resolved);
        assert_string_equal(s->size, t->size);
        assert_int_equal(s->steps, t->steps);
        assert_int_equal(s->seed, t->seed);
        assert_true(s->options.newton_tolerance == t->options.newton_tolerance && s->options.newton_norm == t->options.newton_norm);
        assert_true(s->options.released == t->options.released && s->options.contact.area_weights == t->options.contact.area_weights);
        assert_true(s->options.integrator.beta == t->options.integrator.beta);
        assert_true(s->options.quasistatic == t->options.quasistatic && s->options.strain_coupling == t->options.strain_coupling);
        cipc_scene_destroy(s);
        cipc_scene_destroy(t);
    }
}

static void test_sizes_and_overrides_change_the_scene(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(two_bodies, NULL);
    assert_string_equal(s->size, "ci");
    assert_int_equal(s->model->node_count, 42 + 60);
    cipc_scene_destroy(s);
    s = accept_scene(two_bodies, "size=desk");
    assert_string_equal(s->size, "desk");
    assert_int_equal(s->model->node_count, 42 + 90);
    assert_int_equal(s->steps, 7);
    cipc_scene_destroy(s);
    s = accept_scene(two_bodies, "bodies.cloth.strain_limit=false");
    assert_true(s->model->bodies[1].material.strain_limit == 0);
    cipc_scene_destroy(s);
    reject_scene(two_bodies, "size=huge", CIPC_E_USAGE, "--set size=huge", "unknown size 'huge'; known sizes: ci, desk");
    reject_scene(two_bodies, "bodies.cloth.thicknes=1", CIPC_E_UNKNOWN_KEY, "--set bodies.cloth.thicknes=1", "'thickness'");
    reject_scene(two_bodies, "bodies.cloth.offset=-1", CIPC_E_OUT_OF_RANGE, "--set bodies.cloth.offset=-1", "at least 0");
    reject_scene(two_bodies, "bodies.cloth.offset=NaN", CIPC_E_WRONG_TYPE, "--set bodies.cloth.offset=NaN",
                 "must be a number, but is a string");
    reject_scene(two_bodies, "time_step=1e999", CIPC_E_WRONG_TYPE, "--set time_step=1e999", "must be a number");
    reject_scene(two_bodies, "sizes.ci.steps=1", CIPC_E_USAGE, "--set sizes.ci.steps=1", "size blocks");
}

static void test_meshes_are_found_beside_the_scene_and_again_from_the_resolved_one(void **state)
{
    (void)state;
    static const char mesh[] = "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\nf 1 3 2\nf 2 3 4\n";
    static const char text[] =
        "{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", \"material\": \"wool\", \"shell\": {\"mesh\": \"m.obj\"}}]}";
    char *folder = make_folder(), *mesh_path = write_file(folder, "m.obj", mesh, strlen(mesh)),
         *path = write_file(folder, "s.json", text, strlen(text));
    cipc_scene *s, *t;
    assert_int_equal(cipc_scene_load(&s, path, 0, NULL, NULL), CIPC_OK);
    assert_string_equal(s->path, path);
    t = accept_scene(s->resolved, NULL); /* from another folder */
    assert_same_models(s, t);
    cipc_scene_destroy(s);
    cipc_scene_destroy(t);
    free(mesh_path);
    free(path);
    remove_folder(folder);
}

static void reject_syntax(const char *text, const char *place, const char *what)
{
    reject_scene(text, NULL, CIPC_E_SYNTAX, place, what);
}

static void test_syntax_errors_have_line_and_column(void **state)
{
    (void)state;
    reject_syntax("", ".json:1:1", "expected");
    reject_syntax("{\n  \"steps\": }\n", ".json:2:12", "unexpected token");
    reject_syntax("{\n  \"steps\": NaN}\n", ".json:2:14", "invalid token");
    reject_syntax("{\n  \"steps\": 1e999}\n", ".json:2:", "real number overflow");
    reject_syntax("{\n  \"steps\": 99999999999999999999}\n", ".json:2:", "too big integer");
    reject_syntax("{\"steps\": 1,\n  \"steps\": 2}\n", ".json:2:9", "duplicate object key");
    reject_syntax("{\"steps\": 1} x", ".json:1:", "end of file expected");
    reject_syntax("{\"steps\": \"\377\"}", ".json:1:", "decode byte");
    reject_scene("@[]", NULL, CIPC_E_WRONG_TYPE, "", "a scene must be an object");
}

static void test_missing_files(void **state)
{
    (void)state;
    cipc_scene *s;
    cipc_error error;
    assert_int_equal(cipc_scene_load(&s, "/nowhere/at/all.json", 0, NULL, &error), CIPC_E_MISSING_FILE);
    assert_string_equal(error.place, "/nowhere/at/all.json");
    assert_null(s);
    assert_int_equal(cipc_scene_load(&s, "/nowhere/at/all.json", 0, NULL, NULL), CIPC_E_MISSING_FILE);
    assert_int_equal(cipc_scene_load(&s, "/", 0, NULL, &error), CIPC_E_MISSING_FILE);
    reject_scene(
        "{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", \"material\": \"wool\", \"shell\": {@\"mesh\": \"none.obj\"}}]}",
        NULL, CIPC_E_MISSING_FILE, "bodies.a.shell.mesh", "none.obj' cannot be opened");
}

/* What only the model can see is said at the body's shell. */
static void test_meshes_the_model_refuses(void **state)
{
    (void)state;
    static const char flat[] = "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n";
    static const char text[] =
        "{\"time_step\": 1, \"steps\": 1, \"bodies\": [\n{\"name\": \"a\", \"material\": \"wool\", \"shell\": {\"mesh\": \"m.obj\"}}]}";
    char *folder = make_folder(), *mesh_path = write_file(folder, "m.obj", flat, strlen(flat)),
         *path = write_file(folder, "s.json", text, strlen(text)), place[700];
    cipc_scene *s;
    cipc_error error;
    assert_int_equal(cipc_scene_load(&s, path, 0, NULL, &error), CIPC_E_BAD_MESH);
    snprintf(place, sizeof place, "%s:2:35 bodies.a.shell", path);
    assert_string_equal(error.place, place);
    assert_null(s);
    free(mesh_path);
    free(path);
    remove_folder(folder);
}

/* Let every allocation of a load fail in turn; returns how many there are. */
static long starve(const char *text)
{
    char *folder = make_folder(), *path = write_file(folder, "s.json", text, strlen(text));
    const char *const override = "steps=3";
    long n = 1;
    for (;; n++) {
        cipc_scene *s;
        cipc_error error;
        fail_allocation(n);
        cipc_status status = cipc_scene_load(&s, path, 1, &override, &error);
        if (!allocation_failed()) {
            cipc_scene_destroy(s);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(s);
    }
    fail_allocation(0);
    free(path);
    remove_folder(folder);
    return n;
}

static void test_no_memory(void **state)
{
    (void)state;
    assert_true(starve(two_bodies) > 30); /* the loops have met the allocations of every part */
    assert_true(starve(every_kind) > 60);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_resolved_scene_is_the_same_scene),
        cmocka_unit_test(test_sizes_and_overrides_change_the_scene),
        cmocka_unit_test(test_meshes_are_found_beside_the_scene_and_again_from_the_resolved_one),
        cmocka_unit_test(test_syntax_errors_have_line_and_column),
        cmocka_unit_test(test_missing_files),
        cmocka_unit_test(test_meshes_the_model_refuses),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
