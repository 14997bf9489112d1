/* What the figures of the paper show, as numbers: dinnerware that stays when its cloth is pulled away fast, a shuffled deck in order and no higher than its gaps, bowls filled by the volume
 * of what is in them, grains that no cloth lets through, strands that keep their thickness when twisted. At the size $CIPC_SIZE, "ci" by default (tests/support/figure_run.h). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/claim.h"
#include "support/figure_run.h"

static const double pi = 3.14159265358979323846;

static bool is_ci(void)
{
    return strcmp(figure_size(), "ci") == 0;
}

/* ---- Fig. 1: the tablecloth --------------------------------------------------------------------------------------------------- */

/* Mean way of the dinnerware along the table, from the start to 0.1 s after the pull. */
static double way_of_dinnerware(double speed)
{
    static const char *const dishes[] = {"meat-plate", "meat", "butter-plate", "butter", "glass", "bottle", "fork", "knife"};
    enum { DISHES = sizeof dishes / sizeof dishes[0] };
    const double begin = is_ci() ? 0.1 : 1, length = 1, after = 0.1, h = 0.01;
    char name[32], velocity[64], end[64], steps[32];
    snprintf(name, sizeof name, "tablecloth-%g", speed);
    snprintf(velocity, sizeof velocity, "dirichlet.pull.motion.0.velocity=[%g,0,0]", -speed);
    snprintf(end, sizeof end, "dirichlet.pull.motion.0.end=%.17g", begin + length / speed);
    snprintf(steps, sizeof steps, "steps=%d", (int)ceil((begin + length / speed + after) / h));
    figure_run run = figure_run_of(name, "tablecloth", (const char *[]){velocity, end, steps, NULL});
    double sum = 0;
    for (int i = 0; i < DISHES; i++) {
        double from[3], to[3];
        const cipc_body *body = figure_body(&run, dishes[i]);
        figure_centre(&run, body, run.scene->state->position, from);
        figure_centre(&run, body, run.end, to);
        sum += hypot(to[0] - from[0], to[2] - from[2]);
    }
    figure_run_free(&run);
    return sum / DISHES;
}

/* Friction acts for a shorter time, so the dinnerware moves less. */
static void test_tablecloth(void **state)
{
    (void)state;
    static const double speeds[] = {2, 4, 8};
    double before = INFINITY;
    for (int i = 0; i < 3; i++) {
        char figure[96];
        const double way = way_of_dinnerware(speeds[i]);
        snprintf(figure, sizeof figure, "mean way of the dinnerware at %g m/s", speeds[i]);
        claim_figure("C11 tablecloth", figure, way, "m", CLAIM_LESS, before);
        before = way;
    }
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
    claim_figure("C9 cards", "neighbours of the deck that lie one on the other in the order in which they were let go, of those there are", (double)ordered / (cards - 1), "1", CLAIM_EQUAL, 1);
    const double xi = 1e-4, dhat = 2e-4, top = mean_height(&run, card(&run, cards - 1));
    claim_within("C9 cards", "height of the top card over the deck's largest", top / (cards * (xi + dhat)), "1", xi / (xi + dhat), 1);
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

/* Nothing has left the bowl, and all of it has come down. */
static void assert_inside_the_bowl(const figure_run *run, const cipc_body *body, double radius)
{
    for (int i = body->first_node; i < body->first_node + body->node_count; i++) {
        const double *x = run->end + 3 * i;
        assert_true(hypot(x[0], x[2]) < radius && x[1] > -radius);
    }
}

static void test_bowls(void **state)
{
    (void)state;
    static const struct {
        const char *scene;
        double thickness;  /* xi, m */
        double longest;    /* how much longer the rods may be in the end: soft noodles hang from what they lie on */
    } bowls[] = {{"noodles", 1e-3, 0.2}, {"sprinkles", 1.5e-3, 1e-3}};
    for (int i = 0; i < 2; i++) {
        char claim[32];
        snprintf(claim, sizeof claim, "C9 %s", bowls[i].scene);
        figure_run run = figure_run_of(bowls[i].scene, bowls[i].scene, NULL);
        const cipc_body *body = figure_body(&run, bowls[i].scene);
        const int rods = body->node_count - body->segment_count;
        const double length = total_length(&run, body, run.end), before = total_length(&run, body, run.scene->state->position);
        assert_inside_the_bowl(&run, body, 0.07);
        claim_within(claim, "length of the rods in the end over that at the start", length / before, "1", 1 - bowls[i].longest, 1 + bowls[i].longest);
        claim_figure(claim, "volume of the rods of their thickness", rod_volume(length, bowls[i].thickness, rods), "m^3", CLAIM_MORE, 0);
        figure_run_free(&run);
    }
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
    claim_figure("C12 granules", "grains under the cloth", under, "1", CLAIM_EQUAL, 0);
    figure_run_free(&run);
}

/* ---- Fig. 3: braids ----------------------------------------------------------------------------------------------------------- */

static void test_braid_keeps_its_thickness(void **state)
{
    (void)state;
    figure_run run = figure_run_of("braids", "braids", NULL);
    claim_figure("C3 braids", "smallest gap less thickness while twisted by 540 degrees a second", run.min_gap, "m", CLAIM_MORE, 0);
    figure_run_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tablecloth),
        cmocka_unit_test(test_cards),
        cmocka_unit_test(test_bowls),
        cmocka_unit_test(test_granules_pass_no_cloth),
        cmocka_unit_test(test_braid_keeps_its_thickness),
    };
    return cmocka_run_group_tests_name("figures", tests, NULL, NULL);
}
