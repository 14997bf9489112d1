/* Public queries against the oracle, and the oracle against their truth. */
#include "verify/public_queries.h"

#include <math.h>

#include "cipc/oracle.h"
#include "verify/query_files.h"
#include "verify/toi.h"

static double size_of(const cipc_stencil_path *path)
{
    double most = 0;
    for (int i = 0; i < 12; i++) most = fmax(most, fabs(path->x[i] - path->x[i % 3]));
    return most;
}

static const double THICKNESS = 1e-3;

cipc_status verify_public_campaign(const char *directory, int shard, int shards, verify_report *report, cipc_error *error)
{
    static const char *const names[2] = {"public queries", "public queries, thickness 1e-3 of the size"};
    static const verify_toi_subject subject = {cipc_certified_ccd};
    verify_public_queries q = {0};
    cipc_status status = verify_public_queries_read_all(&q, directory, error);
    verify_row *rows = status == CIPC_OK ? verify_report_add(report, "public", 2) : NULL;
    if (status == CIPC_OK && rows == NULL) status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, directory, "no memory for the report");
    for (int thick = 0; thick < 2 && status == CIPC_OK; thick++) {
        verify_toi_describe(&rows[thick], names[thick], 0.01);
        int untrue = verify_row_forbid(&rows[thick], "the oracle contradicts the truth column");
        for (int i = shard - 1; i < q.count; i += shards) {
            const cipc_stencil_path *path = &q.query[i].path;
            rows[thick].samples++;
            verify_toi_judge(path, thick ? THICKNESS * size_of(path) : 0, i, &rows[thick], &subject);
            if (!thick && (cipc_exact_toi(path, 0, 1).verdict == CIPC_YES) != q.query[i].hit) verify_count(&rows[thick], untrue, i, NULL);
        }
    }
    verify_public_queries_free(&q);
    return status;
}
