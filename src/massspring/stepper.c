/* Semi-implicit Euler on springs, with collision response and the bound on deformation, in substeps that are stable (SPEC B.6; docs/theory/massspring.md). */
#include "massspring/stepper.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "massspring/memory.h"
#include "massspring/topology.h"

/* Of the step up to which springs, repulsion and wind together are stable: friction is not in it, which is limited by what it acts on (forces.c), and near the limit itself the fastest modes swing wide
 * ((10) and what follows it). */
static const double stable_fraction = 0.8;
/* So many nodes can push one at a time while none is nearer to another than the pushing lets it: the kissing number. */
static const double most_pushing = 12;
/* The part of Bmax by which B may be beyond it after a step. */
static const double deformation_tolerance = 1e-3;
/* More substeps in a frame than anybody would wait for: the springs, or what was asked for, are beyond the method. */
static const double most_substeps = 1e6;

cipc_massspring_options cipc_massspring_options_default(void)
{
    return (cipc_massspring_options){.frame = 1.0 / 60, .deformation = 0.1, .sweeps = 2000, .bisection = CIPC_BISECTION_IMPROVED, .threshold = 1e-3, .law = CIPC_LAW_BIDIRECTIONAL,
                                     .presliding = 1e-4, .breakaway = 1.2, .damping_ratio = 0.5, .band = 1e-3};
}

static cipc_status check_options(const cipc_massspring_options *o, cipc_error *error)
{
    const struct { const char *name; double value; bool good; } numbers[] = {
        {"frame", o->frame, o->frame > 0}, {"step", o->step, o->step >= 0}, {"bending_stiffness", o->bending_stiffness, o->bending_stiffness >= 0},
        {"buckling", o->buckling, o->buckling >= 0}, {"deformation", o->deformation, o->deformation >= 0 && o->deformation < 1},
        {"wind_pressure", o->wind_pressure, o->wind_pressure >= 0}, {"threshold", o->threshold, o->threshold > 0}, {"repulsion", o->repulsion, o->repulsion >= 0},
        {"presliding", o->presliding, o->presliding > 0}, {"breakaway", o->breakaway, o->breakaway >= 1}, {"damping_ratio", o->damping_ratio, o->damping_ratio >= 0},
        {"band", o->band, o->band > 0}, {"self_distance", o->self_distance, o->self_distance >= 0}, {"self_friction", o->self_friction, o->self_friction >= 0},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (!numbers[i].good || !isfinite(numbers[i].value)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "mass-spring", "%s = %g is out of range", numbers[i].name, numbers[i].value);
    if (o->sweeps < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "mass-spring", "sweeps = %d is out of range", o->sweeps);
    if (o->self_distance > 0 && !(o->repulsion > 0)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "mass-spring", "cloth that is kept apart needs a repulsion");
    return CIPC_OK;
}

static cipc_status no_memory(cipc_error *error) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "mass-spring", "no memory for the integrator"); }

/* ---- Springs and triangles of all cloth ---- */

static bool is_cloth_body(const cipc_body *body) { return !body->fixed && body->kind == CIPC_BODY_SHELL && body->material.membrane == CIPC_MEMBRANE_SPRINGS; }

static cipc_status check_bodies(const cipc_model *m, cipc_error *error)
{
    for (int b = 0; b < m->body_count; b++)
        if (!m->bodies[b].fixed && !is_cloth_body(&m->bodies[b])) return cipc_fail(error, CIPC_E_WRONG_TYPE, m->bodies[b].name, "the mass-spring method moves shells with a membrane of springs, and nothing else");
    return CIPC_OK;
}

static cipc_spring spring_of(const cipc_massspring *s, const cipc_material *m, double length, bool structural)
{
    const double k = structural ? cipc_spring_stiffness_of_sheet(m->membrane_young, m->thickness) : s->options.bending_stiffness;
    return (cipc_spring){.form = structural ? s->options.structural : s->options.bending_form, .length = length, .stiffness = k, .damping = m->damping_stiffness * k, .bending = s->options.buckling};
}

/* Springs of one sort of a body: structural ones stand before bending ones in the list of all, because the bound is theirs. */
static cipc_status add_springs(cipc_massspring *s, int body, bool structural, cipc_error *error)
{
    massspring_topology t;
    cipc_status status = massspring_topology_create(&t, s->model, body, error);
    if (status) return status;
    const int first = structural ? 0 : t.structural_count, count = structural ? t.structural_count : t.count - t.structural_count;
    cipc_spring *springs = cipc_realloc(s->springs, (size_t)(s->spring_count + count), sizeof *springs);
    if (springs) s->springs = springs;
    int(*ends)[2] = cipc_realloc(s->ends, (size_t)(s->spring_count + count), sizeof *ends);
    if (ends) s->ends = ends;
    if (!springs || !ends) status = no_memory(error);
    for (int k = first; k < first + count && !status; k++, s->spring_count++) {
        s->springs[s->spring_count] = spring_of(s, &s->model->bodies[body].material, t.lengths[k], structural);
        memcpy(s->ends[s->spring_count], t.ends[k], sizeof t.ends[k]);
    }
    massspring_topology_free(&t);
    return status;
}

static cipc_status list_joined(cipc_massspring *s, cipc_error *error)
{
    s->joined = cipc_alloc((size_t)s->spring_count, sizeof *s->joined);
    if (!s->joined) return no_memory(error);
    for (int k = 0; k < s->spring_count; k++) s->joined[k] = massspring_join(s, s->ends[k][0], s->ends[k][1]);
    qsort(s->joined, (size_t)s->spring_count, sizeof *s->joined, massspring_compare_joins);
    return CIPC_OK;
}

static double area_at_rest(const cipc_model *m, int triangle)
{
    const int *n = m->triangles[triangle];
    double a[3], b[3], normal[3];
    v3_sub(a, m->rest + 3 * n[1], m->rest + 3 * n[0]);
    v3_sub(b, m->rest + 3 * n[2], m->rest + 3 * n[0]);
    v3_cross(normal, a, b);
    return 0.5 * v3_norm(normal);
}

/* Of lengths, as far as wind is concerned: it counts on no larger triangles, so that the step that is chosen for these stays stable. The bound keeps those of equilateral meshes below it. */
static double largest_stretch(const cipc_massspring_options *o) { return o->reading == CIPC_DEFORMATION_PROJECT && o->deformation > 0 ? 1 + o->deformation : 2; }

static cipc_status find_cloth(cipc_massspring *s, cipc_error *error)
{
    const cipc_model *m = s->model;
    cipc_status status = CIPC_OK;
    s->triangles = cipc_alloc((size_t)m->triangle_count, sizeof *s->triangles);
    s->areas = cipc_alloc((size_t)m->triangle_count, sizeof *s->areas);
    if (!s->triangles || !s->areas) return no_memory(error);
    for (int t = 0; t < m->triangle_count; t++) {
        if (!is_cloth_body(&m->bodies[m->triangle_body[t]])) continue;
        s->areas[s->triangle_count] = area_at_rest(m, t) * largest_stretch(&s->options) * largest_stretch(&s->options);
        s->triangles[s->triangle_count++] = (const int(*)[3]) & m->triangles[t];
    }
    for (int i = 0; i < m->node_count; i++) s->is_cloth[i] = is_cloth_body(&m->bodies[m->node_body[i]]);
    for (int b = 0; b < m->body_count && !status; b++)
        if (is_cloth_body(&m->bodies[b])) status = add_springs(s, b, true, error);
    s->structural_count = s->spring_count;
    for (int b = 0; b < m->body_count && !status && s->options.bending_stiffness > 0; b++)
        if (is_cloth_body(&m->bodies[b])) status = add_springs(s, b, false, error);
    return status ? status : list_joined(s, error);
}

/* ---- The step ---- */

/* Half springs of repulsion: of a body on a node, and of nodes on each other, where Gershgorin's bound counts every one twice. N/m at a node. */
static double pushing(const cipc_massspring *s) { return ((s->collider_count > 0 ? 1 : 0) + (s->options.self_distance > 0 ? 2 * most_pushing : 0)) * s->options.repulsion; }

/* Wind brakes: (14) has q A/9 between any two corners of a triangle, in a row of the matrix q A/3, over the node's mass, which is a third of its triangles' too, q over the mass per area. 1/s. */
static double braking(const cipc_massspring *s)
{
    const double stretch = largest_stretch(&s->options);
    double lightest = INFINITY;
    for (int b = 0; b < s->model->body_count; b++)
        if (is_cloth_body(&s->model->bodies[b])) lightest = fmin(lightest, s->model->bodies[b].material.density * s->model->bodies[b].material.thickness);
    return s->options.wind_pressure * stretch * stretch / lightest;
}

static double stable_step(const cipc_massspring *s, double push, double drag)
{
    return stable_fraction * cipc_spring_stable_step(s->springs, (const int(*)[2])s->ends, s->spring_count, push, drag, s->inverse_mass, s->model->node_count);
}

static cipc_status choose_step(cipc_massspring *s, cipc_error *error)
{
    const double frame = s->options.frame, asked = s->options.step > 0 ? s->options.step : frame, push = pushing(s);
    const double stable = stable_step(s, push, braking(s)), without_wind = stable_step(s, push, 0), of_springs = stable_step(s, 0, 0);
    if (isnan(stable) || isnan(without_wind) || isnan(of_springs)) return no_memory(error);
    const char *cause = asked > of_springs ? "these springs" : asked > without_wind ? "this repulsion" : "this wind";
    if (s->options.refuse && asked > stable) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "mass-spring", "a step of %g s is too long for %s: at most %g s", asked, cause, stable);
    const double substeps = ceil(frame / fmin(asked, stable) * (1 - 1e-12));
    if (!(substeps <= most_substeps)) {
        cipc_fail(error, CIPC_E_OUT_OF_RANGE, "mass-spring", "a frame of %g s would take %g substeps; at most %g are allowed", frame, substeps, most_substeps);
        return cipc_fail_remedy(error, "softer or heavier cloth, less repulsion or wind, a longer mass_spring.step, or a shorter time_step");
    }
    s->substeps = (int)substeps;
    s->h = frame / s->substeps;
    return CIPC_OK;
}

static bool allocate(cipc_massspring *s, const cipc_collider *colliders, int count)
{
    const size_t n = (size_t)s->model->node_count;
    s->inverse_mass = cipc_alloc(n, sizeof *s->inverse_mass);
    s->force = cipc_alloc(3 * n, sizeof *s->force);
    s->target = cipc_alloc(3 * n, sizeof *s->target);
    s->is_dirichlet = cipc_alloc(n, sizeof *s->is_dirichlet);
    s->moves = cipc_alloc(n, sizeof *s->moves);
    s->is_cloth = cipc_alloc(n, sizeof *s->is_cloth);
    s->contacts = cipc_alloc(n, sizeof *s->contacts);
    s->clearances = cipc_alloc(n * (size_t)count, sizeof *s->clearances);
    s->colliders = cipc_alloc((size_t)count, sizeof *s->colliders);
    if (!s->inverse_mass || !s->force || !s->target || !s->is_dirichlet || !s->moves || !s->is_cloth || !s->contacts || !s->clearances || !s->colliders) return false;
    if (s->options.self_distance > 0 && !(s->near.at = cipc_alloc(3 * n, sizeof *s->near.at))) return false;
    for (int c = 0; c < count; c++) s->colliders[c] = colliders[c];
    s->collider_count = count;
    for (size_t i = 0; i < n; i++) {
        s->contacts[i].collider = -1;
        for (int c = 0; c < count; c++) s->clearances[i * (size_t)count + (size_t)c].distance = -INFINITY;
        s->inverse_mass[i] = 1 / s->model->mass[i];
    }
    return true;
}

cipc_status cipc_massspring_create(cipc_massspring **integrator, const cipc_model *model, const cipc_collider *colliders, int collider_count, const cipc_massspring_options *options,
                                   cipc_error *error)
{
    *integrator = NULL;
    cipc_status status = check_options(options, error);
    if (!status) status = check_bodies(model, error);
    if (status) return status;
    cipc_massspring *s = cipc_alloc(1, sizeof *s);
    if (!s) return no_memory(error);
    s->model = model;
    s->options = *options;
    if (!allocate(s, colliders, collider_count)) status = no_memory(error);
    if (!status) status = find_cloth(s, error);
    if (!status) s->bound = massspring_bound_create((const int(*)[2])s->ends, s->structural_count, model->node_count);
    if (!status && !s->bound) status = no_memory(error);
    if (!status) status = choose_step(s, error);
    if (status) cipc_massspring_destroy(s);
    else *integrator = s;
    return status;
}

void cipc_massspring_destroy(cipc_massspring *s)
{
    if (!s) return;
    massspring_bound_destroy(s->bound);
    void *blocks[] = {s->colliders, s->springs, s->ends, s->triangles, s->areas, s->inverse_mass, s->force, s->target, s->is_dirichlet, s->moves, s->contacts, s->clearances, s->is_cloth, s->joined, s->near.pairs, s->near.at, s};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) cipc_free(blocks[i]);
}

/* ---- Stepping ---- */

/* Prescribed nodes move as the script has them at the end of the substep. */
static void read_script(cipc_massspring *s, const double *x, double time)
{
    const cipc_model *m = s->model;
    cipc_dirichlet_targets(m, x, time, s->h, s->is_dirichlet, s->target, s->moves);
    for (int i = 0; i < m->node_count; i++) s->inverse_mass[i] = s->is_dirichlet[i] || !s->is_cloth[i] ? 0 : 1 / m->mass[i];
}

static void move_prescribed(const cipc_massspring *s, int i, double *x, double *v)
{
    for (int k = 0; k < 3; k++) {
        v[3 * i + k] = s->moves[i] ? (s->target[3 * i + k] - x[3 * i + k]) / s->h : 0;
        x[3 * i + k] = s->target[3 * i + k];
    }
}

/* v += h f/m, then x += h v as far as bodies let it. */
static void advance(cipc_massspring *s, double *x, double *v)
{
    for (int i = 0; i < s->model->node_count; i++) {
        if (!s->is_cloth[i]) continue;
        if (!(s->inverse_mass[i] > 0)) {
            move_prescribed(s, i, x, v);
            continue;
        }
        v3_axpy(v + 3 * i, s->h * s->inverse_mass[i], s->force + 3 * i);
        massspring_respond(s, i, x + 3 * i, v + 3 * i);
    }
}

static bool leave_bodies(void *integrator, int node, double x[3], double v[3]) { return massspring_leave_bodies(integrator, node, x, v); }

static void bound_deformation(cipc_massspring *s, double *x, double *v)
{
    const massspring_sheet sheet = {.springs = s->springs, .ends = (const int(*)[2])s->ends, .count = s->structural_count, .node_count = s->model->node_count, .inverse_mass = s->inverse_mass,
                                    .dt = s->h, .x = x, .v = v};
    if (!(s->options.deformation > 0)) return;
    if (s->options.reading == CIPC_DEFORMATION_REST_LENGTH) cipc_deformation_adjust(s->springs, sheet.ends, sheet.count, s->options.deformation, x);
    else {
        bool kept;
        s->report.sweeps += massspring_bound_sweep(s->bound, &sheet, s->options.deformation, deformation_tolerance, s->options.sweeps, leave_bodies, s, &kept);
        s->report.beyond_bound += !kept;
    }
}

/* At once: the bound would sweep in vain over positions that are no numbers. */
static cipc_status check_finite(const cipc_massspring *s, const cipc_state *state, cipc_error *error)
{
    for (int i = 0; i < 3 * s->model->node_count; i++) {
        if (isfinite(state->position[i]) && isfinite(state->velocity[i])) continue;
        cipc_fail(error, CIPC_E_NO_PROGRESS, "mass-spring", "step %d: node %d is no longer anywhere", state->step + 1, i / 3);
        return cipc_fail_remedy(error, "a shorter mass_spring.step, or less of what drives the cloth: gravity, wind, prescribed motion");
    }
    return CIPC_OK;
}

static cipc_status substep(cipc_massspring *s, double time, cipc_state *state, cipc_error *error)
{
    double *x = state->position, *v = state->velocity;
    read_script(s, x, time);
    massspring_forces(s, x, v);
    if (s->options.self_distance > 0) {
        const cipc_status status = massspring_self_forces(s, x, v, error);
        if (status) return status;
    }
    advance(s, x, v);
    const cipc_status status = check_finite(s, state, error);
    if (!status) bound_deformation(s, x, v);
    return status;
}

static bool is_inside(const cipc_massspring *s, const double x[3])
{
    bool inside = false;
    for (int c = 0; c < s->collider_count; c++) inside = inside || cipc_collider_distance(&s->colliders[c], x, NULL) < 0;
    return inside;
}

static void measure(cipc_massspring *s, const double *x, const double *v)
{
    cipc_massspring_report *r = &s->report;
    for (int i = 0; i < s->model->node_count; i++) {
        if (!(s->inverse_mass[i] > 0)) continue;
        r->kinetic += 0.5 * s->model->mass[i] * v3_norm2(v + 3 * i);
        r->gravitational -= s->model->mass[i] * v3_dot(s->model->gravity, x + 3 * i);
        r->inside += is_inside(s, x + 3 * i);
    }
    for (int k = 0; k < s->spring_count; k++) {
        double between[3];
        v3_sub(between, x + 3 * s->ends[k][1], x + 3 * s->ends[k][0]);
        r->elastic += cipc_spring_energy(&s->springs[k], v3_norm(between));
    }
    r->deformation = cipc_deformation_greatest(s->springs, (const int(*)[2])s->ends, s->structural_count, x);
}

cipc_status cipc_massspring_step(cipc_massspring *s, cipc_state *state, cipc_massspring_report *report, cipc_error *error)
{
    cipc_status status = CIPC_OK;
    s->report = (cipc_massspring_report){.substeps = s->substeps, .substep = s->h};
    massspring_recall(s, state);
    for (int k = 0; k < s->substeps && !status; k++) status = substep(s, state->step * s->options.frame + k * s->h, state, error);
    if (!status) status = check_finite(s, state, error);
    if (status) return status;
    massspring_remember(s, state);
    measure(s, state->position, state->velocity);
    *report = s->report;
    state->step++;
    state->time = state->step * s->options.frame;
    return CIPC_OK;
}
