/* Mesh files: the same small mesh in every format, elements picked by kind, unused nodes left out; every malformed file refused with its line. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cipc/scene.h"

/* Two tetrahedra on a triangle, a line, and a node that nothing uses; the second tetrahedron is given inside out. */
static const char gmsh2[] = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"a b\"\n$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n30 0 1 0\n4 0 0 1\n5 1 1 1\n6 9 9 9\n$EndNodes\n"
                            "$Elements\n4\n1 4 2 1 1 1 2 30 4\n2 4 2 1 1 2 4 30 5\n3 2 2 1 1 1 2 30\n4 1 2 1 1 1 2\n$EndElements\n";
static const char gmsh4[] = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n2 6 1 30\n3 1 0 4\n1\n2\n30\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 1 0 2\n5\n6\n1 1 1\n9 9 9\n$EndNodes\n"
                            "$Elements\n3 4 1 4\n3 1 4 2\n1 1 2 30 4\n2 2 4 30 5\n2 1 2 1\n3 1 2 30\n1 1 1 1\n4 1 2\n$EndElements\n";
static const char vtk_old[] = "# vtk DataFile Version 2.0\nA title of words\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n0 0 0 1 0 0 0 1 0\n0 0 1 1 1 1 9 9 9\nCELLS 4 17\n4 0 1 2 3\n4 1 3 2 4\n3 0 1 2\n2 0 1\n"
                              "CELL_TYPES 4\n10 10 5 3\nPOINT_DATA 6\nSCALARS s float 1\nLOOKUP_TABLE default\n1 2 3 4 5 6\n";
static const char vtk_new[] = "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1 9 9 9\nCELLS 5 13\nOFFSETS vtktypeint64\n0 4 8 11 13\n"
                              "CONNECTIVITY vtktypeint64\n0 1 2 3 1 3 2 4 0 1 2 0 1\nCELL_TYPES 4\n10 10 5 3\n";
static const char polydata[] = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\nLINES 1 4\n3 0 1 2\nPOLYGONS 1 5\n4 0 1 2 3\n";
static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\nl 1 2 3\np 4\n";
static const char seg[] = "v 0 0 0\nv 1 0 0\ns 1 2\n";

static void write_file(char path[64], const char *ending, const char *text, size_t length)
{
    (void)snprintf(path, 64, "/tmp/cipc-mesh-XXXXXX%s", ending);
    int file = mkstemps(path, (int)strlen(ending));
    assert_true(file >= 0);
    assert_int_equal(write(file, text, length), (ssize_t)length);
    close(file);
}

static cipc_status read_text(cipc_mesh *mesh, const char *ending, const char *text, size_t length, cipc_mesh_kind kind, cipc_error *error)
{
    char path[64];
    write_file(path, ending, text, length);
    cipc_status status = cipc_mesh_read(mesh, path, kind, error);
    unlink(path);
    return status;
}

static double volume(const cipc_mesh *m, int t)
{
    double e[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) e[i][k] = m->nodes[3 * m->tetrahedra[t][i + 1] + k] - m->nodes[3 * m->tetrahedra[t][0] + k];
    return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) + e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) / 6;
}

static const struct format {
    const char *ending, *text;
} solids[] = {{".msh", gmsh2}, {".msh", gmsh4}, {".vtk", vtk_old}, {".vtk", vtk_new}};
enum { SOLIDS = sizeof solids / sizeof *solids };

static void test_one_mesh_in_every_format(void **state)
{
    (void)state;
    for (int i = 0; i < SOLIDS; i++) {
        cipc_mesh m;
        cipc_error error;
        const char *text = solids[i].text, *ending = solids[i].ending;
        if (read_text(&m, ending, text, strlen(text), CIPC_MESH_TETRAHEDRA, &error)) fail_msg("format %d: %s: %s", i, error.place, error.what);
        assert_true(m.node_count == 5 && m.tetrahedron_count == 2 && m.triangle_count == 0);
        assert_true(fabs(volume(&m, 0) - 1.0 / 6) < 1e-15 && fabs(volume(&m, 1) - 2.0 / 6) < 1e-15); /* made positive */
        cipc_mesh_free(&m);
        assert_int_equal(read_text(&m, ending, text, strlen(text), CIPC_MESH_TRIANGLES, &error), CIPC_OK);
        assert_true(m.node_count == 3 && m.triangle_count == 1 && m.triangles[0][0] == 0 && m.triangles[0][2] == 2 && m.nodes[7] == 1);
        cipc_mesh_free(&m);
        assert_int_equal(read_text(&m, ending, text, strlen(text), CIPC_MESH_SEGMENTS, &error), CIPC_OK);
        assert_true(m.node_count == 2 && m.segment_count == 1 && m.nodes[3] == 1);
        cipc_mesh_free(&m);
        assert_int_equal(read_text(&m, ending, text, strlen(text), CIPC_MESH_NODES, &error), CIPC_OK);
        assert_true(m.node_count == 6 && m.nodes[17] == 9);
        cipc_mesh_free(&m);
    }
}

static void test_lines_and_polygons(void **state)
{
    (void)state;
    cipc_mesh m;
    assert_int_equal(read_text(&m, ".vtk", polydata, strlen(polydata), CIPC_MESH_TRIANGLES, NULL), CIPC_OK);
    assert_true(m.node_count == 4 && m.triangle_count == 2 && m.triangles[1][0] == 0 && m.triangles[1][1] == 2);
    cipc_mesh_free(&m);
    assert_int_equal(read_text(&m, ".vtk", polydata, strlen(polydata), CIPC_MESH_SEGMENTS, NULL), CIPC_OK);
    assert_true(m.node_count == 3 && m.segment_count == 2 && m.segments[1][1] == 2);
    cipc_mesh_free(&m);
    assert_int_equal(read_text(&m, ".obj", obj, strlen(obj), CIPC_MESH_SEGMENTS, NULL), CIPC_OK);
    assert_true(m.node_count == 3 && m.segment_count == 2 && m.segments[1][0] == 1);
    cipc_mesh_free(&m);
    assert_int_equal(read_text(&m, ".OBJ", obj, strlen(obj), CIPC_MESH_TRIANGLES, NULL), CIPC_OK);
    assert_true(m.node_count == 3 && m.triangle_count == 1);
    cipc_mesh_free(&m);
    assert_int_equal(read_text(&m, ".obj", obj, strlen(obj), CIPC_MESH_NODES, NULL), CIPC_OK);
    assert_int_equal(m.node_count, 4);
    cipc_mesh_free(&m);
    assert_int_equal(read_text(&m, ".seg", seg, strlen(seg), CIPC_MESH_SEGMENTS, NULL), CIPC_OK);
    assert_true(m.node_count == 2 && m.segment_count == 1);
    cipc_mesh_free(&m);
}

static void test_refused(void **state)
{
    (void)state;
    static const struct {
        const char *ending, *text, *line, *says;
        cipc_mesh_kind kind;
    } bad[] = {
        {".stl", "solid\n", "", ".vtk", CIPC_MESH_TRIANGLES},
        {".msh", "hello\n", ":1", "not a Gmsh file", CIPC_MESH_TETRAHEDRA},
        {".msh", "$MeshFormat\n2.2 1 8\n", ":2", "binary", CIPC_MESH_TETRAHEDRA},
        {".msh", "$MeshFormat\n3 0 8\n", ":2", "version 3", CIPC_MESH_TETRAHEDRA},
        {".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n999999\n1 0 0 0\n", ":5", "announced", CIPC_MESH_TETRAHEDRA},
        {".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n1 0 0 1\n$EndNodes\n", ":7", "twice", CIPC_MESH_TETRAHEDRA},
        {".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 zero\n", ":6", "'zero'", CIPC_MESH_TETRAHEDRA},
        {".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 1 0 1 7\n", ":10", "node 7", CIPC_MESH_SEGMENTS},
        {".vtk", "VTK\n", ":1", "not a VTK file", CIPC_MESH_TRIANGLES},
        {".vtk", "# vtk DataFile Version 2.0\ntitle\nBINARY\n", ":3", "binary", CIPC_MESH_TRIANGLES},
        {".vtk", "# vtk DataFile Version 2.0\ntitle\nASCII\nDATASET STRUCTURED_GRID\n", ":4", "UNSTRUCTURED_GRID", CIPC_MESH_TRIANGLES},
        {".vtk", "# vtk DataFile Version 2.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\nPOLYGONS 1 4\n3 0 1 2\n", ":8", "point's number is 1", CIPC_MESH_TRIANGLES},
        {".vtk", "# vtk DataFile Version 2.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 inf\n", ":6", "'inf'", CIPC_MESH_TRIANGLES},
        {".obj", "v 0 0 0\nv 1 0 0\nl 1\n", ":3", "2 are needed", CIPC_MESH_SEGMENTS},
        {".obj", "v 0 0 0\nv 1 0 0\nl 1 5\n", ":3", "vertex index 5", CIPC_MESH_SEGMENTS},
        {".obj", "v 0 0 0\n", "", "lines", CIPC_MESH_SEGMENTS},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        cipc_mesh m;
        cipc_error error;
        assert_int_equal(read_text(&m, bad[i].ending, bad[i].text, strlen(bad[i].text), bad[i].kind, &error), CIPC_E_BAD_MESH);
        assert_null(m.nodes);
        if (!strstr(error.what, bad[i].says)) fail_msg("case %zu: '%s' does not say '%s'", i, error.what, bad[i].says);
        size_t length = strlen(error.place), end = strlen(bad[i].line);
        if (strcmp(error.place + length - end, bad[i].line) != 0) fail_msg("case %zu: at %s, not at line %s", i, error.place, bad[i].line);
    }
}

/* Cut anywhere, a file is refused or says what was there; nothing crashes. With what is cut off, the whole mesh is lost: tetrahedra and the node after them. */
static void test_truncated(void **state)
{
    (void)state;
    for (int i = 0; i < SOLIDS; i++) {
        int refused = 0;
        const char *text = solids[i].text;
        for (size_t length = 0; length < strlen(text); length++) {
            cipc_mesh m;
            cipc_error error;
            cipc_status status = read_text(&m, solids[i].ending, text, length, CIPC_MESH_TETRAHEDRA, &error);
            refused += status == CIPC_E_BAD_MESH;
            assert_true(status == CIPC_OK || status == CIPC_E_BAD_MESH);
            if (status == CIPC_OK) assert_true(m.tetrahedron_count > 0 && m.tetrahedron_count <= 2);
            cipc_mesh_free(&m);
        }
        assert_true(refused > (int)strlen(text) / 2);
    }
}

static void test_missing(void **state)
{
    (void)state;
    cipc_mesh m;
    cipc_error error;
    assert_int_equal(cipc_mesh_read(&m, "/no/such/file.msh", CIPC_MESH_TETRAHEDRA, &error), CIPC_E_MISSING_FILE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_mesh_in_every_format), cmocka_unit_test(test_lines_and_polygons), cmocka_unit_test(test_refused),
        cmocka_unit_test(test_truncated),                cmocka_unit_test(test_missing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
