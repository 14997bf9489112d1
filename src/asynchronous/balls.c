/* Kinetic balls: every node is certified to stay in a ball for a while. All that is coarse about contact (k-DOPs, pairs that cannot meet) rests on the balls alone, so that a change of
 * velocity concerns one certificate of its own node and nothing above it (docs/theory/asynchronous.md, section 6). */
#include "asynchronous/integrator.h"

/* Near contact a ball is made so large that the node takes about this fraction of a frame to leave it, within bounds: a larger one would bring more pairs near. */
static const double ball_life = 1.0 / 16;
/* Away from contact it grows by this factor each time it is made anew. */
static const double ball_growth = 1.5;
/* A node this near to the centre, as a fraction of the radius, keeps its ball for another while. */
static const double ball_middle = 0.7;
/* Its centre lies this fraction of the radius ahead of the node. */
static const double ball_lead = 0.5;
/* The certificate is of a ball smaller by this fraction, which covers what positions are rounded by. */
static const double ball_spare = 1e-6;

static double certified_radius(const asynchronous_ball *ball) { return ball->radius * (1 - ball_spare); }

/* When the node leaves, at most a frame from now: |q - c + s v| = r for the later s, by the form of the root that does not cancel. */
static double exit_time(const cipc_asynchronous *a, const asynchronous_ball *ball, const double x[3], const double v[3])
{
    double from[3];
    v3_sub(from, x, ball->center);
    const double r = certified_radius(ball), distance = v3_norm(from), speed = v3_norm(v), frame = a->options.frame;
    if (!(speed > 0)) return INFINITY;
    if (speed * frame <= r - distance) return a->now + frame;
    const double along = v3_dot(from, v) / speed, room = fmax((r - distance) * (r + distance), 0), root = sqrt(along * along + room);
    const double way = along > 0 ? room / (root + along) : root - along;
    return a->now + fmin(way / speed * (1 - ball_spare), frame);
}

static void set_deadline(cipc_asynchronous *a, int node, const double x[3])
{
    asynchronous_ball *ball = &a->balls[node];
    ball->deadline = exit_time(a, ball, x, a->nodes[node].v);
    asynchronous_queue_schedule(&a->queue, ball->event, ball->deadline);
}

static bool is_at_rest(const asynchronous_node *node) { return !(v3_norm2(node->v) > 0) && !(node->inverse_mass > 0); }

/* What stands still and cannot be moved has a ball of no size. */
static double suitable_radius(const cipc_asynchronous *a, int node, double speed)
{
    const asynchronous_ball *ball = &a->balls[node];
    if (is_at_rest(&a->nodes[node])) return 0;
    const double near_contact = fmin(fmax(speed * ball_life * a->options.frame, ball->least), ball->most_near);
    return a->pairs.of_node[node].count > 0 ? near_contact : fmin(fmax(ball_growth * ball->radius, near_contact), ball->most);
}

/* A new ball about the node. Returns how far the old one has moved and grown at most. */
static double refit(cipc_asynchronous *a, int node)
{
    asynchronous_ball *ball = &a->balls[node];
    const double *v = a->nodes[node].v, speed = v3_norm(v), old_radius = ball->radius;
    double x[3], center[3], moved[3];
    asynchronous_position(&a->nodes[node], a->now, x);
    ball->radius = suitable_radius(a, node, speed);
    v3_copy(center, x);
    if (speed > 0) v3_axpy(center, ball_lead * ball->radius / speed, v);
    v3_sub(moved, center, ball->center);
    v3_copy(ball->center, center);
    for (int k = 0; k < 3; k++) a->scale = fmax(a->scale, fabs(center[k]));
    set_deadline(a, node, x);
    return v3_norm(moved) + fabs(ball->radius - old_radius);
}

void asynchronous_ball_start(cipc_asynchronous *a, int node)
{
    refit(a, node);
    asynchronous_shadow(a, node);
}

void asynchronous_ball_check(cipc_asynchronous *a, int node)
{
    const asynchronous_ball *ball = &a->balls[node];
    const asynchronous_node *n = &a->nodes[node];
    double x[3], from[3];
    if (ball->deadline < INFINITY) {
        const double r = certified_radius(ball);
        asynchronous_position(n, ball->deadline, x);
        v3_sub(from, x, ball->center);
        if (v3_norm2(from) <= r * r) return; /* inside now and then: inside all the way */
    } else if (!(v3_norm2(n->v) > 0)) {
        return;
    }
    asynchronous_position(n, a->now, x);
    set_deadline(a, node, x);
}

/* A deadline that has come because it was set for the time being, or because the node was faster once. */
static bool stays_in_the_middle(const cipc_asynchronous *a, int node, double x[3])
{
    const asynchronous_ball *ball = &a->balls[node];
    double from[3];
    asynchronous_position(&a->nodes[node], a->now, x);
    v3_sub(from, x, ball->center);
    return v3_norm(from) < ball_middle * certified_radius(ball) && !is_at_rest(&a->nodes[node]);
}

void asynchronous_ball_event(cipc_asynchronous *a, int node)
{
    double x[3];
    a->report.events[CIPC_EVENT_CELL]++;
    if (stays_in_the_middle(a, node, x)) {
        set_deadline(a, node, x);
        return;
    }
    const double travel = refit(a, node);
    asynchronous_shadow(a, node);
    asynchronous_separation_update(a, node, travel);
}
