/* What the figures of the paper show, as numbers: dinnerware that stays when its cloth is pulled away fast, a shuffled deck in order and no higher than its gaps, bowls filled by the volume
 * of what is in them, grains that no cloth lets through, strands that keep their thickness when twisted. At the size $CIPC_SIZE, "ci" by default (tests/support/figure_run.h). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/claim.h"
#include "support/figure_run.h"

static const double pi = 3.14159265358979323846;

/* ---- Fig. 1: the tablecloth --------------------------------------------------------------------------------------------------- */

typedef struct pull {
    const char *run, *velocity, *end, *steps; /* of 1 m, begun at 0.1 s; the run ends 0.1 s after it */
} pull;

/* Mean way of the dinnerware along the table. */
static double way_of_dinnerware(const pull *p)
{
    static const char *const dishes[] = {"meat-plate", "meat", "butter-plate", "butter", "glass", "bottle", "fork", "knife"};
    enum { DISHES = sizeof dishes / sizeof dishes[0] };
    figure_run run = figure_run_of(p->run, "tablecloth", (const char *[]){p->velocity, "dirichlet.pull.motion.0.begin=0.1", p->end, p->steps, NULL});
    double sum = 0;
    for (int i = 0; i < DISHES; i++) {
        double from[3], to[3];
        const cipc_body *body = figure_body(&run, dishes[i]);
        figure_centre(&run, body, run.scene->state->position, from);
        figure_centre(&run, body, run.end, to);
        sum += hypot(to[0] - from[0], to[2] - from[2]);
    }
    figure_run_free(&run);
    print_message("%s: %.4g m\n", p->run, sum / DISHES);
    return sum / DISHES;
}

/* Friction acts for a shorter time, so the dinnerware moves less. */
static void test_tablecloth(void **state)
{
    (void)state;
    static const pull pulls[] = {
        {"tablecloth-2", "dirichlet.pull.motion.0.velocity=[-2,0,0]", "dirichlet.pull.motion.0.end=0.6", "steps=70"},
        {"tablecloth-4", "dirichlet.pull.motion.0.velocity=[-4,0,0]", "dirichlet.pull.motion.0.end=0.35", "steps=45"},
        {"tablecloth-8", "dirichlet.pull.motion.0.velocity=[-8,0,0]", "dirichlet.pull.motion.0.end=0.225", "steps=33"},
    };
    double way[3];
    for (int i = 0; i < 3; i++) way[i] = way_of_dinnerware(&pulls[i]);
    claim_figure("C11 tablecloth", "way of the dinnerware, pulled at 4 m/s over at 2 m/s", way[1] / way[0], "1", CLAIM_LESS, 1);
    claim_figure("C11 tablecloth", "at 8 m/s over at 4 m/s", way[2] / way[1], "1", CLAIM_LESS, 1);
}

/* ---- Fig. 8: the cards -------------------------------------------------------------------------------------------------------- */

/* Height of the sheet `body` above (x, z), seen from above; false if it is not there. */
static bool height_at(const figure_run *run, const cipc_body *body, double x, double z, double *height)
{
    const cipc_model *m = run->scene->model;
    for (int t = body->first_triangle; t < body->first_triangle + body->triangle_count; t++) {
        const double *p[3];
        double w[3], area = 0;
        for (int k = 0; k < 3; k++) p[k] = run->end + 3 * m->triangles[t][k];
        for (int k = 0; k < 3; k++) {
            const double *a = p[(k + 1) % 3], *b = p[(k + 2) % 3];
            w[k] = (a[0] - x) * (b[2] - z) - (b[0] - x) * (a[2] - z);
            area += w[k];
        }
        if (area == 0 || w[0] / area < 0 || w[1] / area < 0 || w[2] / area < 0) continue;
        *height = (w[0] * p[0][1] + w[1] * p[1][1] + w[2] * p[2][1]) / area;
        return true;
    }
    return false;
}

/* How many nodes of the upper card lie over the lower one, and how many of these are above it. */
static void compare_cards(const figure_run *run, const cipc_body *lower, const cipc_body *upper, int *over, int *above)
{
    *over = *above = 0;
    for (int i = upper->first_node; i < upper->first_node + upper->node_count; i++) {
        double height;
        const double *x = run->end + 3 * i;
        if (!height_at(run, lower, x[0], x[2], &height)) continue;
        (*over)++;
        *above += x[1] > height;
    }
}

/* The card that is let go as number i, from 0: right, left, right, ... */
static const cipc_body *card(const figure_run *run, int i)
{
    char name[32];
    snprintf(name, sizeof name, "%s-%d", i % 2 == 0 ? "right" : "left", i / 2 + 1);
    return figure_body(run, name);
}

static double mean_height(const figure_run *run, const cipc_body *body)
{
    double centre[3];
    figure_centre(run, body, run->end, centre);
    return centre[1];
}

static void test_cards(void **state)
{
    (void)state;
    figure_run run = figure_run_of("cards", "cards", NULL);
    const int cards = run.scene->model->body_count - 3; /* ground and two handles */
    int ordered = 0;
    for (int i = 0; i + 1 < cards; i++) {
        int over, above;
        compare_cards(&run, card(&run, i), card(&run, i + 1), &over, &above);
        ordered += over > 0 && above == over;
    }
    claim_figure("C9 cards", "neighbours in the deck that lie on one another in the order in which they were let go, part of all", (double)ordered / (cards - 1), "1", CLAIM_EQUAL, 1);
    const double xi = 1e-4, dhat = 2e-4, top = mean_height(&run, card(&run, cards - 1));
    claim_within("C9 cards", "height of the top card over N (xi + dhat)", top / (cards * (xi + dhat)), "1", xi / (xi + dhat), 1);
    figure_run_free(&run);
}

/* ---- Fig. 10 and 21: bowls ---------------------------------------------------------------------------------------------------- */

/* Volume of rods of a diameter: cylinders with a half ball at each end of each of `count` rods. */
static double rod_volume(double length, double diameter, int count)
{
    return length * pi * diameter * diameter / 4 + count * pi * diameter * diameter * diameter / 6;
}

static double total_length(const figure_run *run, const cipc_body *body, const double *x)
{
    const cipc_model *m = run->scene->model;
    double sum = 0;
    for (int s = body->first_segment; s < body->first_segment + body->segment_count; s++) {
        const int *ends = m->edges[m->first_segment + s];
        const double *a = x + 3 * ends[0], *b = x + 3 * ends[1];
        sum += hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
    }
    return sum;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Height below which 95 of a hundred nodes of a body lie in the end. */
static double level_of(const figure_run *run, const cipc_body *body)
{
    double *height = cipc_alloc((size_t)body->node_count, sizeof *height);
    assert_non_null(height);
    for (int i = 0; i < body->node_count; i++) height[i] = run->end[3 * (body->first_node + i) + 1];
    qsort(height, (size_t)body->node_count, sizeof *height, by_size);
    const double level = height[(int)(0.95 * (body->node_count - 1))];
    cipc_free(height);
    return level;
}

typedef struct filling {
    double length; /* of the rods in the end over that at the start */
    double part;   /* their volume, as thick as xi, over the bowl's below their level and half a thickness */
    double soft;   /* the same, as thick as xi + dhat: what they keep one another apart by */
    double inside; /* part of the nodes that is in the bowl or over it */
} filling;

/* Volume of the bowl up to a height. */
static double bowl_room(double radius, double height)
{
    const double depth = fmin(height, 0) + radius;
    return pi * depth * depth * (radius - depth / 3) + pi * radius * radius * fmax(height, 0);
}

/* The bowl is half a ball about the origin, its rim at y = 0; above the rim it is taken to go on as a cylinder. */
static filling fill_of(const char *scene, double thickness, double dhat)
{
    figure_run run = figure_run_of(scene, scene, NULL);
    const cipc_body *rods = figure_body(&run, scene), *bowl = figure_body(&run, "bowl");
    double radius = 0;
    for (int i = bowl->first_node; i < bowl->first_node + bowl->node_count; i++) radius = fmax(radius, hypot(run.end[3 * i], run.end[3 * i + 2]));
    const double length = total_length(&run, rods, run.end), level = level_of(&run, rods);
    const int count = rods->node_count - rods->segment_count;
    int inside = 0;
    for (int i = rods->first_node; i < rods->first_node + rods->node_count; i++) inside += hypot(run.end[3 * i], run.end[3 * i + 2]) < radius && run.end[3 * i + 1] > -radius;
    const filling f = {length / total_length(&run, rods, run.scene->state->position), rod_volume(length, thickness, count) / bowl_room(radius, level + thickness / 2),
                       rod_volume(length, thickness + dhat, count) / bowl_room(radius, level + (thickness + dhat) / 2), (double)inside / rods->node_count};
    print_message("%s: level %.4g m, bowl %.4g m, part filled %.4g (as thick as xi), %.4g (xi + dhat), inside %.4g\n", scene, level, radius, f.part, f.soft, f.inside);
    figure_run_free(&run);
    return f;
}

/* Straight cylinders of one thickness fill at most pi / sqrt(12) of any room. */
static const double densest = 0.9068996821171089;
/* Rods thrown together at random, some ten of which are as wide as the bowl, and all of which keep apart by at most xi + dhat, fill more than this: half of what long rods do in a wide
 * vessel (0.5 to 0.6 at lengths of five diameters). A few of them at the bottom, as at size ci, do not make a heap. */
static const double loosest = 0.27;

/* So the bowls of size ci are what has to be told from a heap. */
static bool is_heap(const filling *f) { return f->soft > loosest; }
static bool is_small(void) { return strcmp(figure_size(), "ci") == 0; }

static void test_noodles(void **state)
{
    (void)state;
    const filling f = fill_of("noodles", 1e-3, 5e-4);
    claim_figure("C9 noodles", "noodles: part of them in the bowl", f.inside, "1", CLAIM_EQUAL, 1);
    claim_within("C9 noodles", "noodles: length in the end over that at the start (they are soft)", f.length, "1", 0.8, 1.2);
    claim_within("C9 noodles", "noodles of thickness xi: volume over the bowl's below their level", f.part, "1", 0, densest);
    if (is_small()) assert_false(is_heap(&f));
    else claim_figure("C9 noodles", "noodles of thickness xi + dhat: the same", f.soft, "1", CLAIM_MORE, loosest);
}

static void test_sprinkles(void **state)
{
    (void)state;
    const filling f = fill_of("sprinkles", 1.5e-3, 5e-4);
    claim_figure("C9 sprinkles", "sprinkles: part of them in the bowl", f.inside, "1", CLAIM_AT_LEAST, 0.95);
    claim_within("C9 sprinkles", "sprinkles: length in the end over that at the start", f.length, "1", 0.999, 1.001);
    claim_within("C9 sprinkles", "sprinkles of thickness xi: volume over the bowl's below their level", f.part, "1", 0, densest);
    if (is_small()) assert_false(is_heap(&f));
    else claim_figure("C9 sprinkles", "sprinkles of thickness xi + dhat: the same", f.soft, "1", CLAIM_MORE, loosest);
}

/* ---- Fig. 22: granules -------------------------------------------------------------------------------------------------------- */

static void test_granules_pass_no_cloth(void **state)
{
    (void)state;
    figure_run run = figure_run_of("granules", "granules", NULL);
    const cipc_body *cloth = figure_body(&run, "cloth"), *grains = figure_body(&run, "granules");
    int on = 0, under = 0;
    for (int i = grains->first_node; i < grains->first_node + grains->node_count; i++) {
        double height;
        const double *x = run.end + 3 * i;
        if (!height_at(&run, cloth, x[0], x[2], &height)) continue;
        on += x[1] > height;
        under += x[1] < height;
    }
    assert_true(on > 0);
    claim_figure("C12", "grains under the cloth that they fell on", under, "1", CLAIM_EQUAL, 0);
    figure_run_free(&run);
}

/* ---- Fig. 3: braids ----------------------------------------------------------------------------------------------------------- */

static void test_braid_keeps_its_thickness(void **state)
{
    (void)state;
    figure_run run = figure_run_of("braids", "braids", NULL);
    claim_figure("C3", "braid twisted by 540 degrees a second: smallest gap - xi", run.min_gap, "m", CLAIM_MORE, 0);
    figure_run_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tablecloth),
        cmocka_unit_test(test_cards),
        cmocka_unit_test(test_noodles),
        cmocka_unit_test(test_sprinkles),
        cmocka_unit_test(test_granules_pass_no_cloth),
        cmocka_unit_test(test_braid_keeps_its_thickness),
    };
    return cmocka_run_group_tests_name("figures", tests, NULL, NULL);
}
