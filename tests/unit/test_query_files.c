/* The reader of public queries: what it reads, and what it refuses with file and line. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "verify/query_files.h"

static const char row[] = "1,2,-3,4,0,1,1\n";

/* A file of these rows; the caller removes it. */
static void write_file(char path[64], const char *const *rows, int count)
{
    strcpy(path, "/tmp/cipc-queries-XXXXXX");
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "w");
    for (int i = 0; i < count; i++) fputs(rows[i], file);
    fclose(file);
}

static void refuse(const char *bad, int line, const char *part)
{
    const char *rows[8];
    char path[64], place[96];
    cipc_error error;
    verify_public_queries q = {0};
    for (int i = 0; i < 8; i++) rows[i] = i == line - 1 ? bad : row;
    write_file(path, rows, 8);
    assert_int_equal(verify_public_queries_read(&q, path, CIPC_EDGE_EDGE, &error), CIPC_E_BAD_QUERY);
    snprintf(place, sizeof place, "%s:%d", path, line);
    assert_string_equal(error.place, place);
    assert_non_null(strstr(error.what, part));
    verify_public_queries_free(&q);
    unlink(path);
}

static void test_reads(void **state)
{
    (void)state;
    const char *rows[16];
    char path[64];
    cipc_error error;
    verify_public_queries q = {0};
    for (int i = 0; i < 16; i++) rows[i] = i < 8 ? row : "-12345678901234567890,12345678901234567890,9007199254740993,9007199254740993,1,1024,0\n";
    write_file(path, rows, 16);
    assert_int_equal(verify_public_queries_read(&q, path, CIPC_POINT_TRIANGLE, &error), CIPC_OK);
    assert_int_equal(q.count, 2);
    assert_true(q.query[0].hit && !q.query[1].hit);
    const cipc_stencil_path *p = &q.query[0].path;
    assert_true(p->to_end && p->kind == CIPC_POINT_TRIANGLE && p->x[0] == 0.5 && p->x[1] == -0.75 && p->x[11] == 0 && p->p[10] == -0.75);
    assert_true(q.query[1].path.x[0] == -1 && q.query[1].path.x[1] == 1 && q.query[1].path.p[2] == 0x1p-10);
    verify_public_queries_free(&q);
    unlink(path);
}

static void test_refuses(void **state)
{
    (void)state;
    refuse("1,3,0,1,0,1,1\n", 2, "doubles");                      /* a third is none */
    refuse("1,0,0,1,0,1,1\n", 3, "doubles");
    refuse("1,-2,0,1,0,1,1\n", 3, "doubles");
    refuse("x,2,0,1,0,1,1\n", 4, "doubles");
    refuse("1,2,0,1,0,1\n", 5, "not a row");
    refuse("1,2,0,1,0,1,1,1\n", 5, "not a row");
    refuse("1,2,0,1,0,1,2\n", 6, "0 or 1");
    refuse("1,2,0,1,0,1,0\n", 7, "truth differs");
    refuse("9007199254740993,1,0,1,0,1,1\n", 8, "doubles");       /* 2^53 + 1 */
}

static void test_cut_off_and_absent(void **state)
{
    (void)state;
    const char *rows[5] = {row, row, row, row, row};
    char path[64];
    cipc_error error;
    verify_public_queries q = {0};
    write_file(path, rows, 5);
    assert_int_equal(verify_public_queries_read(&q, path, CIPC_EDGE_EDGE, &error), CIPC_E_BAD_QUERY);
    assert_non_null(strstr(error.what, "5 of 8 rows"));
    unlink(path);
    assert_int_equal(verify_public_queries_read(&q, path, CIPC_EDGE_EDGE, &error), CIPC_E_MISSING_FILE);
    assert_int_equal(verify_public_queries_read_all(&q, "/nowhere", &error), CIPC_E_MISSING_FILE);
    verify_public_queries_free(&q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_reads), cmocka_unit_test(test_refuses), cmocka_unit_test(test_cut_off_and_absent)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
