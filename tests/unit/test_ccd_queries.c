/* The reader of recorded queries: what it reads, and what it refuses with file and line. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "support/failing_memory.h"
#include "verify/ccd_queries.h"

#define POINTS "\"x0\":[1,2,3,4,5,6],\"p\":[0.5,0,0,0,0,-1]"
#define GOOD "{\"id\":3,\"fn\":\"toi_point_point\"," POINTS ",\"thickness\":0.25,\"scale\":0.2,\"step\":1}\n"

static cipc_status read_text(const char *text, verify_ccd_queries *q, cipc_error *error)
{
    FILE *stream = tmpfile();
    assert_non_null(stream);
    fputs(text, stream);
    rewind(stream);
    cipc_status status = verify_ccd_queries_read(q, stream, "q.jsonl", error);
    fclose(stream);
    return status;
}

static void test_reads(void **state)
{
    (void)state;
    verify_ccd_queries q = {0};
    assert_int_equal(read_text(GOOD "{\"id\":4,\"fn\":\"toi_point_point\",\"x0\":[1,2,3,4,5,6],\"x1\":[1,2,3,4,5,7]}\n", &q, NULL), CIPC_OK);
    assert_int_equal(read_text(GOOD, &q, NULL), CIPC_OK); /* appended */
    assert_int_equal(q.count, 3);
    const verify_ccd_query *a = &q.query[0], *b = &q.query[1];
    assert_true(a->path.kind == CIPC_POINT_POINT && !a->path.to_end && a->path.x[5] == 6 && a->path.p[0] == 0.5 && a->path.p[5] == -1);
    assert_true(a->thickness == 0.25 && a->scale == 0.2);
    assert_true(b->path.to_end && b->path.p[5] == 7 && b->thickness == 0 && b->scale == 0.1);
    verify_ccd_queries_free(&q);
    assert_true(q.query == NULL && q.count == 0);
}

static void refuse(const char *text, const char *place, const char *part)
{
    verify_ccd_queries q = {0};
    cipc_error error;
    assert_int_equal(read_text(text, &q, &error), CIPC_E_BAD_QUERY);
    if (strcmp(error.place, place) != 0 || strstr(error.what, part) == NULL) fail_msg("%s: %s", error.place, error.what);
    verify_ccd_queries_free(&q);
}

static void test_refuses(void **state)
{
    (void)state;
    refuse("", "q.jsonl", "empty");
    refuse(GOOD "{\"id\":1,\"fn\":\"distance2_point_point\",\"x\":[1,2,3,4,5,6]}\n", "q.jsonl:2", "distance2_point_point, not a time of impact");
    refuse(GOOD GOOD "{\"id\":1,\"fn\":\"toi_point_edge\"," POINTS "}\n", "q.jsonl:3", "x0");
    refuse("{\"id\":1,\"fn\":\"toi_point_point\",\"x0\":[1,2,3,4,5,\"nan\"],\"p\":[0,0,0,0,0,0]}\n", "q.jsonl:1", "finite");
    refuse("{\"id\":1,\"fn\":\"toi_point_point\"," POINTS ",\"thickness\":-1}\n", "q.jsonl:1", "negative");
    refuse("{\"id\":1,\"fn\":\"toi_point_point\"," POINTS "}", "q.jsonl:1", "middle of a line");
}

static void test_out_of_memory(void **state)
{
    (void)state;
    long tried = 0;
    for (long n = 1;; n++) {
        verify_ccd_queries q = {0};
        fail_allocation(n);
        cipc_status status = read_text(GOOD, &q, NULL);
        bool failed = allocation_failed();
        fail_allocation(0);
        verify_ccd_queries_free(&q);
        if (!failed) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        tried = n;
    }
    assert_true(tried >= 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_reads), cmocka_unit_test(test_refuses), cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
