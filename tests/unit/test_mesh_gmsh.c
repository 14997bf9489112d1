/* Gmsh files, good and bad. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "support/mesh_files.h"
#include "support/mesh_properties.h"

#define FORMAT2 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
#define FORMAT4 "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
#define NODES2 "$Nodes\n5\n10 0 0 0\n20 1 0 0\n15 0 1 0\n7 0 0 1\n99 5 5 5\n$EndNodes\n"
/* A point, a segment, a triangle with three labels, a quadrilateral, a tetrahedron the wrong way round. */
#define ELEMENTS2 "$Elements\n5\n1 15 2 0 1 10\n2 1 2 0 1 10 20\n3 2 3 0 1 0 10 20 15\n4 3 2 0 1 10 20 15 7\n5 4 0 10 20 7 15\n$EndElements\n"
#define GOOD2 FORMAT2 "$PhysicalNames\n1\n3 1 \"a body\"\n$EndPhysicalNames\n" NODES2 ELEMENTS2

/* Two blocks of nodes, one with parameters; blocks of points, triangles and tetrahedra, none of segments. */
#define NODES4 "$Nodes\n2 5 7 99\n0 1 0 2\n10\n20\n0 0 0\n1 0 0\n2 1 1 3\n15\n7\n99\n0 1 0 0.5 0.5\n0 0 1 0.5 0.5\n5 5 5 0 0\n$EndNodes\n"
#define ELEMENTS4 "$Elements\n3 4 1 4\n0 1 15 1\n1 10\n2 1 2 2\n2 10 20 15\n3 20 7 15\n3 1 4 1\n4 10 20 7 15\n$EndElements\n"
#define GOOD4 FORMAT4 "$Entities\n0 0 0 0\n$EndEntities\n" NODES4 ELEMENTS4

static void check_tetrahedron(const char *text)
{
    cipc_mesh mesh = accept_mesh("m.msh", text, CIPC_MESH_TETRAHEDRA);
    assert_int_equal(mesh.node_count, 4);
    assert_int_equal(mesh.tetrahedron_count, 1);
    const int want[4] = {0, 1, 2, 3};
    assert_memory_equal(mesh.tetrahedra[0], want, sizeof want); /* turned */
    assert_true(measure_volume(&mesh).volume == 1.0 / 6);
    assert_true(mesh.nodes[3] == 1 && mesh.nodes[7] == 1 && mesh.nodes[11] == 1);
    cipc_mesh_free(&mesh);
}

static void test_tetrahedra(void **state)
{
    (void)state;
    check_tetrahedron(GOOD2);
    check_tetrahedron(GOOD4);
    check_tetrahedron(FORMAT2 ELEMENTS2 NODES2); /* any order of sections */
}

static void test_other_kinds(void **state)
{
    (void)state;
    cipc_mesh mesh = accept_mesh("m.msh", GOOD2, CIPC_MESH_TRIANGLES);
    assert_int_equal(mesh.triangle_count, 1);
    assert_int_equal(mesh.node_count, 3);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.msh", GOOD4, CIPC_MESH_TRIANGLES);
    const int want[2][3] = {{0, 1, 2}, {1, 3, 2}};
    assert_int_equal(mesh.triangle_count, 2);
    assert_memory_equal(mesh.triangles, want, sizeof want);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.msh", GOOD2, CIPC_MESH_SEGMENTS);
    assert_int_equal(mesh.segment_count, 1);
    assert_true(mesh.nodes[0] == 0 && mesh.nodes[3] == 1);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.msh", GOOD4, CIPC_MESH_NODES);
    assert_int_equal(mesh.node_count, 5);
    assert_true(mesh.nodes[12] == 5);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.msh", FORMAT2 NODES2, CIPC_MESH_NODES);
    assert_int_equal(mesh.node_count, 5);
    cipc_mesh_free(&mesh);
    reject_mesh("m.msh", GOOD4, CIPC_MESH_SEGMENTS, CIPC_E_BAD_MESH, "an empty mesh: 5 nodes and 0 segments, but 2 triangles, 1 tetrahedra");
    reject_mesh("m.msh", FORMAT2 NODES2 "$Elements\n1\n1 5 0 1 2 3 4 5 6 7 8\n$EndElements\n", CIPC_MESH_TETRAHEDRA, CIPC_E_BAD_MESH,
                "5 nodes and 0 tetrahedra, but 1 elements of types that are not read (first: type 5)");
}

static void bad(const char *text, const char *what)
{
    reject_mesh("m.msh", text, CIPC_MESH_TETRAHEDRA, CIPC_E_BAD_MESH, what);
}

static void too_many(const char *text, const char *what)
{
    reject_mesh("m.msh", text, CIPC_MESH_TETRAHEDRA, CIPC_E_OUT_OF_RANGE, what);
}

static void test_bad_formats(void **state)
{
    (void)state;
    bad("@", "the file ends where $MeshFormat is expected");
    bad("@$Nodes\n", "'$Nodes' where $MeshFormat is expected");
    bad("$MeshFormat\n@2.1 0 8\n$EndMeshFormat\n", "version 2.1 is not read; 2.2 and 4.1 are");
    bad("$MeshFormat\n@4 0 8\n$EndMeshFormat\n", "version 4 is not read");
    bad("$MeshFormat\n@4.1 1 8\n", "binary Gmsh is not read: save as ASCII");
    bad("$MeshFormat\n@4.1\n", "the line ends where 0 for ASCII is expected");
    bad("$MeshFormat\n4.1 0 8\n@$Nodes\n", "'$Nodes' where $EndMeshFormat is expected");
}

static void test_bad_sections(void **state)
{
    (void)state;
    bad(FORMAT2, "it has no $Nodes");
    bad(FORMAT2 "@12\n", "'12' where a section should begin");
    bad(FORMAT2 "@$EndNodes\n", "'$EndNodes' where a section should begin");
    bad(FORMAT2 "@$Periodic\n1\n2\n", "the file ends inside $Periodic");
    bad(FORMAT2 NODES2 "@$Nodes\n", "a second $Nodes");
    bad(FORMAT2 NODES2 ELEMENTS2 "@$Elements\n", "a second $Elements");
    bad(FORMAT2 NODES2, "an empty mesh: 5 nodes and 0 tetrahedra");
}

static void test_bad_nodes(void **state)
{
    (void)state;
    bad(FORMAT2 "$Nodes\n@two\n", "'two' is not a whole number; the number of nodes is expected");
    too_many(FORMAT2 "$Nodes\n@-1\n", "the number of nodes is -1");
    too_many(FORMAT2 "$Nodes\n@1000000000000\n", "the number of nodes is 1000000000000; 0 to 10000000 are allowed");
    too_many(FORMAT4 "$Nodes\n@1 1000000000000 1 9\n", "the number of nodes is 1000000000000");
    bad(FORMAT2 "$Nodes\n@1 2\n", "'2' after the head of a section");
    bad(FORMAT2 "$Nodes\n2\n1 0 0 0\n@$EndNodes\n", "'$EndNodes' after 1 of 2 nodes");
    bad(FORMAT2 "$Nodes\n1\n1 0 0 0\n@2 0 0 0\n$EndNodes\n", "'2' where $EndNodes is expected");
    bad(FORMAT2 "$Nodes\n1\n@1 0 0\n$EndNodes\n", "the line ends where a coordinate is expected");
    bad(FORMAT2 "$Nodes\n1\n@1 0 0 0 0\n$EndNodes\n", "'0' after three coordinates");
    bad(FORMAT2 "$Nodes\n1\n@1 0 nan 0\n$EndNodes\n", "a coordinate is not a finite number");
    bad(FORMAT2 "$Nodes\n1\n@0 0 0 0\n$EndNodes\n", "node tag 0; tags are positive");
    bad(FORMAT2 "$Nodes\n3\n5 0 0 0\n4 0 0 0\n@5 0 0 0\n$EndNodes\n", "node tag 5 is taken by line 6");
    bad(FORMAT4 "$Nodes\n1 2 1 2\n0 1 0 1\n1\n@0 0 0\n$EndNodes\n", "the blocks have 1 nodes fewer than announced");
    bad(FORMAT4 "$Nodes\n1 2 1 2\n@0 1 0 3\n1\n", "a block of 3 rows, but 2 are left of those announced");
    bad(FORMAT4 "$Nodes\n1 2 1 2\n@0 1 0 -1\n1\n", "a block of -1 rows");
    bad(FORMAT4 "$Nodes\n2 2 1 2\n0 1 0 1\n1\n0 0 0\n@$EndNodes\n", "'$EndNodes' after 1 of 2 blocks");
    bad(FORMAT4 "$Nodes\n1 2 1 2\n0 1 0 2\n1\n@$EndNodes\n", "'$EndNodes' after 1 of 2 tags");
    bad(FORMAT4 "$Nodes\n1 2 1 2\n0 1 0 2\n1\n2\n0 0 0\n@$EndNodes\n", "'$EndNodes' after 1 of 2 positions");
    bad(FORMAT4 "$Nodes\n@1 2\n0 1 0 2\n", "the line ends where a tag is expected");
}

static void test_bad_elements(void **state)
{
    (void)state;
    too_many(FORMAT2 NODES2 "$Elements\n@999999999999\n", "the number of elements is 999999999999");
    bad(FORMAT2 NODES2 "$Elements\n2\n1 4 0 10 20 7 15\n@$EndElements\n", "'$EndElements' after 1 of 2 elements");
    bad(FORMAT2 NODES2 "$Elements\n1\n1 4 0 10 20 7 15\n@2 4 0 10 20 7 15\n$EndElements\n", "'2' where $EndElements is expected");
    bad(FORMAT2 NODES2 "$Elements\n1\n@1 4 0 10 20 7\n$EndElements\n", "the line ends where a node's tag is expected");
    bad(FORMAT2 NODES2 "$Elements\n1\n@1 4 0 10 20 7 15 99\n$EndElements\n", "'99' after an element's last node");
    bad(FORMAT2 NODES2 "$Elements\n1\n@1 4 7 10 20 7 15\n$EndElements\n", "the line ends where a label is expected");
    bad(FORMAT2 NODES2 "$Elements\n1\n@1 4 0 10 20 7 16\n$EndElements\n", "node tag 16 is not in $Nodes");
    bad(FORMAT2 NODES2 "$Elements\n1\n@1 4 0 10 20 7 -15\n$EndElements\n", "node tag -15 is not in $Nodes");
    bad(FORMAT2 NODES2 "$Elements\n1\n@1 4 0 10 20 7 7\n$EndElements\n", "a tetrahedron that names a node twice");
    bad(FORMAT2 "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n$EndNodes\n$Elements\n1\n@1 4 0 1 2 3 4\n$EndElements\n", "a tetrahedron without volume");
    bad(FORMAT4 NODES4 "$Elements\n1 2 1 2\n3 1 4 1\n@1 10 20 7 15\n$EndElements\n", "1 elements fewer than announced");
    bad(FORMAT4 NODES4 "$Elements\n1 1 1 2\n@3 1 4 9\n1 10 20 7 15\n$EndElements\n", "a block of 9 rows");
}

static void test_maimed_files(void **state)
{
    (void)state;
    maim_mesh_file("m.msh", GOOD2, CIPC_MESH_TETRAHEDRA, strlen(GOOD2) - 2);
    maim_mesh_file("m.msh", GOOD4, CIPC_MESH_TETRAHEDRA, strlen(GOOD4) - 2);
}

static void test_no_memory(void **state)
{
    (void)state;
    starve_mesh_file("m.msh", GOOD2, CIPC_MESH_TETRAHEDRA);
    starve_mesh_file("m.msh", GOOD4, CIPC_MESH_TRIANGLES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tetrahedra),
        cmocka_unit_test(test_other_kinds),
        cmocka_unit_test(test_bad_formats),
        cmocka_unit_test(test_bad_sections),
        cmocka_unit_test(test_bad_nodes),
        cmocka_unit_test(test_bad_elements),
        cmocka_unit_test(test_maimed_files),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
