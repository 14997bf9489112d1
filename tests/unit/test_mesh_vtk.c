/* Legacy VTK files, good and bad. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "support/mesh_files.h"
#include "support/mesh_properties.h"

#define HEAD(version) "# vtk DataFile Version " version "\nany title: BINARY\nASCII\n"
#define GRID HEAD("3.0") "DATASET UNSTRUCTURED_GRID\n"
#define GRID5 HEAD("5.1") "DATASET UNSTRUCTURED_GRID\n"
#define POLY HEAD("2.0") "DATASET POLYDATA\n"
#define POINTS5 "POINTS 5 double\n0 0 0 1 0 0\n0 1 0\n0 0\n1 9 9 9\n"
/* A vertex, a line, a triangle, a quadrilateral, a polyline, a tetrahedron the wrong way round, a wedge that is not read. */
#define CELLS7 "CELLS 7 30\n1 0\n2 0 1\n3 0 1 2\n4 0 1 2 3\n3 0 1\n2\n4 0 2 1 3\n6 0 1 2 3 4 0\n"
#define TYPES7 "CELL_TYPES 7\n1 3 5 9\n4\n10 13\n"
#define GOOD GRID POINTS5 CELLS7 TYPES7
#define CELLS5 "CELLS 8 23\nOFFSETS vtktypeint64\n0 1 3 6 10 13 17 23\nCONNECTIVITY vtktypeint64\n0 0 1 0 1 2 0 1 2 3 0 1 2\n0 2 1 3\n0 1 2 3 4 0\n"
#define GOOD5 GRID5 "FIELD FieldData 1\nTimeValue 1 2 double\n0.5\n1\n" POINTS5 "METADATA\nINFORMATION 1\nNAME X LOCATION y\n\n" CELLS5 TYPES7

static void check_grid(const char *text)
{
    cipc_mesh mesh = accept_mesh("m.vtk", text, CIPC_MESH_TETRAHEDRA);
    assert_int_equal(mesh.node_count, 4);
    assert_int_equal(mesh.tetrahedron_count, 1);
    const int turned[4] = {0, 2, 3, 1};
    assert_memory_equal(mesh.tetrahedra[0], turned, sizeof turned);
    assert_true(measure_volume(&mesh).volume == 1.0 / 6);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.vtk", text, CIPC_MESH_TRIANGLES);
    const int triangles[3][3] = {{0, 1, 2}, {0, 1, 2}, {0, 2, 3}};
    assert_int_equal(mesh.triangle_count, 3);
    assert_memory_equal(mesh.triangles, triangles, sizeof triangles);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.vtk", text, CIPC_MESH_SEGMENTS);
    const int segments[3][2] = {{0, 1}, {0, 1}, {1, 2}};
    assert_int_equal(mesh.segment_count, 3);
    assert_int_equal(mesh.node_count, 3);
    assert_memory_equal(mesh.segments, segments, sizeof segments);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.vtk", text, CIPC_MESH_NODES);
    assert_int_equal(mesh.node_count, 5);
    assert_true(mesh.nodes[11] == 1 && mesh.nodes[14] == 9);
    cipc_mesh_free(&mesh);
}

static void test_unstructured_grids(void **state)
{
    (void)state;
    check_grid(GOOD);
    check_grid(GOOD5);
    check_grid(GOOD "POINT_DATA 5\nSCALARS s double\nLOOKUP_TABLE default\n1 2 3\nwhatever\n");
    check_grid(GOOD "CELL_DATA 7\nFIELD f 1\n");
    check_grid("# vtk DataFile Version 2.0\n\nascii\ndataset unstructured_grid\n" POINTS5 CELLS7 TYPES7); /* empty title; letters of any case */
}

static void test_polydata(void **state)
{
    (void)state;
    const char *text = POLY POINTS5 "VERTICES 1 3\n2 0 4\nLINES 2 7\n2 0 1\n3 1 2 3\nPOLYGONS 2 9\n3 0 1 2\n4 0 1 2 3\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\nPOINT_DATA 5\n";
    cipc_mesh mesh = accept_mesh("m.vtk", text, CIPC_MESH_TRIANGLES);
    assert_int_equal(mesh.triangle_count, 3);
    assert_int_equal(mesh.node_count, 4);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.vtk", text, CIPC_MESH_SEGMENTS);
    const int want[3][2] = {{0, 1}, {1, 2}, {2, 3}};
    assert_int_equal(mesh.segment_count, 3);
    assert_memory_equal(mesh.segments, want, sizeof want);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.vtk", text, CIPC_MESH_NODES);
    assert_int_equal(mesh.node_count, 5);
    cipc_mesh_free(&mesh);
    reject_mesh("m.vtk", text, CIPC_MESH_TETRAHEDRA, CIPC_E_BAD_MESH,
                "an empty mesh: 5 points and 0 tetrahedra, but 3 triangles, 3 segments, 1 elements of types that are not read (first: TRIANGLE_STRIPS)");
    mesh = accept_mesh("m.vtk", HEAD("5.1") "DATASET POLYDATA\n" POINTS5 "POLYGONS 3 7\nOFFSETS vtktypeint64\n0 3 7\nCONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3\n", CIPC_MESH_TRIANGLES);
    assert_int_equal(mesh.triangle_count, 3);
    cipc_mesh_free(&mesh);
}

static void test_an_empty_section(void **state)
{
    (void)state;
    cipc_mesh mesh = accept_mesh("m.vtk", HEAD("5.1") "DATASET POLYDATA\n" POINTS5 "LINES 0 0\nOFFSETS vtktypeint64\nCONNECTIVITY vtktypeint64\n", CIPC_MESH_NODES);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.vtk", GRID POINTS5 "CELLS 0 0\nCELL_TYPES 0\n", CIPC_MESH_NODES);
    cipc_mesh_free(&mesh);
}

static void bad(const char *text, const char *what)
{
    reject_mesh("m.vtk", text, CIPC_MESH_TETRAHEDRA, CIPC_E_BAD_MESH, what);
}

static void too_many(const char *text, const char *what)
{
    reject_mesh("m.vtk", text, CIPC_MESH_TETRAHEDRA, CIPC_E_OUT_OF_RANGE, what);
}

static void test_bad_heads(void **state)
{
    (void)state;
    bad("@", "not a legacy VTK file");
    bad("@<VTKFile type=\"UnstructuredGrid\">\n", "not a legacy VTK file");
    bad("@# vtk DataFile Version 6.0\n", "version 6.0 is not read; 1.0 to 5.1 are");
    bad("@# vtk DataFile Version 5.2\n", "version 5.2 is not read");
    bad("@# vtk DataFile Version 3\n", "version 3 is not read");
    bad("# vtk DataFile Version 3.0\ntitle\n@BINARY\nDATASET UNSTRUCTURED_GRID\n", "binary VTK is not read: save as ASCII");
    bad("# vtk DataFile Version 3.0\ntitle\n@TEXT\n", "'TEXT' where ASCII is expected");
    bad(HEAD("3.0") "@POINTS 3 double\n", "'POINTS' where DATASET is expected");
    bad(HEAD("3.0") "@DATASET STRUCTURED_POINTS\n", "DATASET STRUCTURED_POINTS is not read; UNSTRUCTURED_GRID and POLYDATA are");
    bad(GRID, "it has no POINTS");
}

static void test_bad_points(void **state)
{
    (void)state;
    too_many(GRID "@POINTS 999999999999 double\n", "the number of points is 999999999999; 0 to 10000000 are allowed");
    too_many(GRID "@POINTS -3 double\n", "the number of points is -3");
    bad(GRID "POINTS 2 double\n0 0 0 1 0\n@CELLS 1 5\n", "'CELLS' after 5 of 6 coordinates");
    bad(GRID "POINTS 2 double\n0 0 0 1 0@", "the file ends after 5 of 6 coordinates");
    bad(GRID "POINTS 1 double\n0 0 0\n@1 0 0\n", "'1' where a section should begin");
    bad(GRID "POINTS 1 double\n@0 zero 0\n", "'zero' is not a number; a coordinate is expected");
    bad(GRID "POINTS 1 double\n@0 1e999 0\n", "a coordinate is not a finite number");
    bad(GRID POINTS5 "@POINTS 1 double\n", "a second POINTS");
    bad(GRID "@POINTS 1\n0 0 0\n", "the line ends where the type of the coordinates is expected");
}

static void test_bad_cells(void **state)
{
    (void)state;
    too_many(GRID POINTS5 "@CELLS 999999999999 5\n", "the number of cells is 999999999999");
    too_many(GRID POINTS5 "@CELLS 1 999999999999\n", "the number of numbers is 999999999999");
    bad(GRID POINTS5 "CELLS 1 5\n@5 0 1 2 3 4\n", "a cell of 5 points, but 4 numbers are left of the 5 announced");
    bad(GRID POINTS5 "CELLS 1 5\n@0\n", "a cell of 0 points");
    bad(GRID POINTS5 "CELLS 1 5\n@-4 0 1 2 3\n", "a cell of -4 points");
    bad(GRID POINTS5 "CELLS 1 6\n@4 0 1 2 3\nCELL_TYPES 1\n10\n", "1 cells of 5 numbers, but 6 are announced");
    bad(GRID POINTS5 "CELLS 2 10\n4 0 1 2 3\n@CELL_TYPES 1\n10\n", "'CELL_TYPES' after 1 of 2 cells");
    bad(GRID POINTS5 "CELLS 1 5\n4 0 1 2\n@CELL_TYPES 1\n", "'CELL_TYPES' after 3 of 4 points of a cell");
    bad(GRID POINTS5 "CELLS 1 5\n@4 0 1 2 x\n", "'x' is not a whole number");
    bad(GRID POINTS5 "CELLS 1 5\n4 0 1 2 3\n", "it has CELLS, but no CELL_TYPES");
    bad(GRID POINTS5 "@CELL_TYPES 1\n10\n", "CELL_TYPES before CELLS");
    bad(GRID POINTS5 CELLS7 TYPES7 "@CELL_TYPES 7\n", "a second CELL_TYPES");
    bad(GRID POINTS5 CELLS7 TYPES7 "@CELLS 7 30\n", "a second CELLS");
    bad(GRID POINTS5 "CELLS 1 5\n4 0 1 2 3\n@CELL_TYPES 2\n10 10\n", "2 cell types for 1 cells");
    bad(GRID POINTS5 "CELLS 2 10\n4 0 1 2 3 4 0 1\n2 3\nCELL_TYPES 2\n10@", "the file ends after 1 of 2 cell types");
    bad(GRID POINTS5 "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n@10\n", "'10' where a section should begin");
    bad(GRID POINTS5 "CELLS 1 4\n@3 0 1 2\nCELL_TYPES 1\n10\n", "a cell of type 10 with 3 points; 4 are needed");
    bad(GRID POINTS5 "CELLS 1 5\n@4 0 1 2 3\nCELL_TYPES 1\n5\n", "a cell of type 5 with 4 points; 3 are needed");
    bad(GRID POINTS5 "CELLS 1 5\n@4 0 1 2 5\nCELL_TYPES 1\n10\n", "point index 5, but the file has 5 points, counted from 0");
    bad(GRID POINTS5 "CELLS 1 5\n@4 0 1 2 -1\nCELL_TYPES 1\n10\n", "point index -1");
    bad(GRID POINTS5 "CELLS 1 5\n@4 0 1 2 2\nCELL_TYPES 1\n10\n", "a tetrahedron that names a point twice");
    bad(GRID "POINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\nCELLS 1 5\n@4 0 1 2 3\nCELL_TYPES 1\n10\n", "points 0, 1, 2 and 3 lie in a plane");
}

static void test_bad_offsets(void **state)
{
    (void)state;
    bad(GRID5 POINTS5 "CELLS 1 5\n@4 0 1 2 3\n", "'4' where OFFSETS is expected");
    bad(GRID POINTS5 "CELLS 2 4\n@OFFSETS vtktypeint64\n0 4\n", "'OFFSETS' after 0 of 2 cells"); /* of version 5.1 in a file of 3.0 */
    bad(GRID5 POINTS5 "CELLS 2 4\nOFFSETS vtktypeint64\n@1 4\n", "offset 1 is 1; offsets must rise from 0 to 4");
    bad(GRID5 POINTS5 "CELLS 3 4\nOFFSETS vtktypeint64\n@0 3 2\n", "offset 3 is 2");
    bad(GRID5 POINTS5 "CELLS 2 4\nOFFSETS vtktypeint64\n@0 5\n", "offset 2 is 5");
    bad(GRID5 POINTS5 "CELLS 2 4\nOFFSETS vtktypeint64\n@0 3\nCONNECTIVITY vtktypeint64\n0 1 2\n", "the offsets end at 3, but 4 points are announced");
    bad(GRID5 POINTS5 "CELLS 0 4\n@OFFSETS vtktypeint64\n", "the offsets end at 0, but 4 points are announced");
    bad(GRID5 POINTS5 "CELLS 2 4\nOFFSETS vtktypeint64\n0\n@CONNECTIVITY vtktypeint64\n", "'CONNECTIVITY' after 1 of 2 offsets");
    bad(GRID5 POINTS5 "CELLS 2 4\nOFFSETS vtktypeint64\n0 4\n@CELL_TYPES 1\n", "'CELL_TYPES' where CONNECTIVITY is expected");
    bad(GRID5 POINTS5 "CELLS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2\n@CELL_TYPES 1\n", "'CELL_TYPES' after 3 of 4 points of CONNECTIVITY");
}

static void test_bad_sections(void **state)
{
    (void)state;
    bad(GRID POINTS5 "@POLYGONS 1 4\n3 0 1 2\n", "'POLYGONS' where a section should begin");
    bad(POLY POINTS5 "@CELLS 1 5\n4 0 1 2 3\n", "'CELLS' where a section should begin");
    bad(POLY POINTS5 "POLYGONS 1 3\n@2 0 1\n", "a cell of type 7 with 2 points; 3 are needed");
    bad(GRID POINTS5 "FIELD f 1\na 2 3 double\n1 2 3 4 5@", "the file ends where an array's entry is expected");
}

static void test_maimed_files(void **state)
{
    (void)state;
    maim_mesh_file("m.vtk", GOOD, CIPC_MESH_TETRAHEDRA, strlen(GOOD) - 4); /* without the 3 of the last type, 13, a cell of one point is too short */
    maim_mesh_file("m.vtk", GOOD5, CIPC_MESH_TETRAHEDRA, strlen(GOOD5) - 4);
    static const char poly[] = POLY POINTS5 "LINES 1 3\n2 0 1\nPOLYGONS 2 9\n3 0 1 2\n4 0 1 2 3\n";
    maim_mesh_file("m.vtk", poly, CIPC_MESH_TRIANGLES, strlen(poly) - 2);
}

static void test_no_memory(void **state)
{
    (void)state;
    starve_mesh_file("m.vtk", GOOD, CIPC_MESH_TETRAHEDRA);
    starve_mesh_file("m.vtk", GOOD5, CIPC_MESH_TRIANGLES);
    starve_mesh_file("m.vtk", POLY POINTS5 "POLYGONS 1 4\n3 0 1 2\n", CIPC_MESH_TRIANGLES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unstructured_grids),
        cmocka_unit_test(test_polydata),
        cmocka_unit_test(test_an_empty_section),
        cmocka_unit_test(test_bad_heads),
        cmocka_unit_test(test_bad_points),
        cmocka_unit_test(test_bad_cells),
        cmocka_unit_test(test_bad_offsets),
        cmocka_unit_test(test_bad_sections),
        cmocka_unit_test(test_maimed_files),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
