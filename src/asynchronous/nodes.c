/* Nodes: drift and kick (SPEC A.1, A.2). */
#include "asynchronous/integrator.h"

#include <stdarg.h>
#include <stdio.h>

void asynchronous_gather(const cipc_asynchronous *a, const int *nodes, int count, double *x)
{
    for (int i = 0; i < count; i++) asynchronous_position(&a->nodes[nodes[i]], a->now, x + 3 * i);
}

static void advance(cipc_asynchronous *a, int node, const double x[3])
{
    asynchronous_node *n = &a->nodes[node];
    v3_copy(n->q, x);
    n->t = a->now;
    if (!a->dirty[node]) {
        a->dirty[node] = true;
        a->dirty_nodes[a->dirty_count++] = node;
    }
    if (a->kicked[node] != a->now) {
        a->kicked[node] = a->now;
        a->kicks[node]++;
        v3_copy(a->before + 3 * node, n->v);
    }
    if (a->monitor) asynchronous_windows_break(a, node, x);
}

void asynchronous_kick(cipc_asynchronous *a, int node, const double x[3], const double dv[3])
{
    advance(a, node, x);
    v3_axpy(a->nodes[node].v, 1, dv);
}

void asynchronous_steer(cipc_asynchronous *a, int node, const double x[3], const double v[3])
{
    advance(a, node, x);
    v3_copy(a->nodes[node].v, v);
}

/* Every node's position at t becomes where it starts from. Frames do this, so that a run that is taken up from a frame goes on with the same numbers. */
void asynchronous_synchronise(cipc_asynchronous *a, double t)
{
    for (int i = 0; i < a->model->node_count; i++) {
        asynchronous_node *n = &a->nodes[i];
        double x[3];
        asynchronous_position(n, t, x);
        v3_copy(n->q, x);
        n->t = t;
    }
}

void asynchronous_fail(cipc_asynchronous *a, cipc_status status, const char *format, ...)
{
    if (a->status) return; /* the first one is the cause */
    char text[sizeof a->error.what], place[64];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    snprintf(place, sizeof place, "t = %.9g s", a->now);
    a->status = cipc_fail(&a->error, status, place, "%s", text);
}
