#include "support/golden_bands.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A band reaches this many spreads of the runs beyond the smallest and the largest of them. The spread of eight normal deviates is about
 * 2.8 standard deviations, so the band ends about 7 from the mean: another run as good as these misses it hardly ever, even where the
 * spread was underestimated by half. */
static const double widening = 2;
/* Floors, for quantities in which the runs hardly differ. A stretch: this part of its excess over 1. */
static const double stretch_floor = 0.01;
/* Contacts: this part of them, and this many; they come and go at the edge of the barrier's range. */
static const double contact_floor = 0.1, contact_floor_count = 2;
/* Newton iterations are a cost, not a result: half and double. */
static const double newton_factor = 2;
static const double gravity = 9.81; /* m/s^2: makes a length an energy */

/* ---- The rule --------------------------------------------------------------------------------------------------------------- */

static void range(int runs, const double (*quantity)[QUANTITY_COUNT], int q, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int r = 0; r < runs; r++) {
        *low = fmin(*low, quantity[r][q]);
        *high = fmax(*high, quantity[r][q]);
    }
}

/* What the solver does not promise even of a single step: a node may be h * tolerance from where a converged step would have put it. */
static double floor_of(int q, double high, golden_scale scale)
{
    const double length = scale.time_step * scale.tolerance;
    switch ((scene_quantity)q) {
    case QUANTITY_energy:
    case QUANTITY_elastic_energy: return scale.mass * gravity * length;
    case QUANTITY_largest_stretch: return stretch_floor * fabs(high - 1) + length;
    case QUANTITY_contacts: return contact_floor * high + contact_floor_count;
    default: return length;
    }
}

golden_bands golden_derive(int runs, const double (*quantity)[QUANTITY_COUNT], golden_scale scale)
{
    golden_bands bands;
    for (int q = 0; q < QUANTITY_COUNT; q++) {
        double low, high;
        range(runs, quantity, q, &low, &high);
        const double more = widening * (high - low) + floor_of(q, high, scale);
        const bool cost = q == QUANTITY_newton_iterations;
        bands.low[q] = cost ? floor(low / newton_factor) : low - more;
        bands.high[q] = cost ? ceil(high * newton_factor) : high + more;
        if (q == QUANTITY_contacts || q == QUANTITY_elastic_energy) {
            bands.low[q] = fmax(bands.low[q], 0);
        }
    }
    return bands;
}

/* ---- The check ------------------------------------------------------------------------------------------------------------- */

bool golden_accepts(const golden_bands *bands, const double quantity[QUANTITY_COUNT], char why[GOLDEN_REASON])
{
    for (int q = 0; q < QUANTITY_COUNT; q++) {
        if (!(quantity[q] >= bands->low[q] && quantity[q] <= bands->high[q])) {
            const scene_quantity which = (scene_quantity)q;
            snprintf(why, GOLDEN_REASON, "%s is %.9g %s, outside its band [%.9g, %.9g]", scene_quantity_name(which), quantity[q],
                     scene_quantity_unit(which), bands->low[q], bands->high[q]);
            return false;
        }
    }
    return true;
}

/* ---- Files ------------------------------------------------------------------------------------------------------------------ */

static bool read_band(json_t *entry, double *low, double *high)
{
    json_t *band = json_object_get(entry, "band"), *first = json_array_get(band, 0), *second = json_array_get(band, 1);
    *low = json_number_value(first);
    *high = json_number_value(second);
    return json_array_size(band) == 2 && json_is_number(first) && json_is_number(second) && *low <= *high &&
           json_is_string(json_object_get(entry, "comment"));
}

static bool read_bands(json_t *root, const char *command, golden_bands *bands, char why[GOLDEN_REASON])
{
    const char *made_by = json_string_value(json_object_get(root, "command"));
    json_t *all = json_object_get(root, "bands");
    if (made_by == NULL || strcmp(made_by, command) != 0) {
        snprintf(why, GOLDEN_REASON, "is of another run: %.200s", made_by != NULL ? made_by : "(no command)");
        return false;
    }
    if (json_object_size(all) != QUANTITY_COUNT) {
        snprintf(why, GOLDEN_REASON, "has %zu bands, not %d", json_object_size(all), QUANTITY_COUNT);
        return false;
    }
    for (int q = 0; q < QUANTITY_COUNT; q++) {
        const char *name = scene_quantity_name((scene_quantity)q);
        if (!read_band(json_object_get(all, name), &bands->low[q], &bands->high[q])) {
            snprintf(why, GOLDEN_REASON, "has no band [low, high] with a comment for %s", name);
            return false;
        }
    }
    return true;
}

bool golden_read(const char *path, const char *command, golden_bands *bands, char why[GOLDEN_REASON])
{
    json_error_t error;
    char reason[GOLDEN_REASON];
    json_t *root = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    if (root == NULL) {
        snprintf(why, GOLDEN_REASON, "%.150s: line %d: %.150s", path, error.line, error.text);
        return false;
    }
    const bool good = read_bands(root, command, bands, reason);
    json_decref(root);
    if (!good) {
        snprintf(why, GOLDEN_REASON, "%.150s: %.300s", path, reason);
    }
    return good;
}

/* Outwards to five digits of the band's width, so that files stay readable: a band may grow by 1e-4 of itself. */
static double rounded(double value, double width, bool up)
{
    const double unit = width > 0 ? pow(10, floor(log10(width)) - 4) : 0;
    return unit > 0 ? unit * (up ? ceil(value / unit) : floor(value / unit)) : value;
}

static json_t *band_entry(int q, double low, double high, int runs, const double (*quantity)[QUANTITY_COUNT], golden_scale scale)
{
    char comment[256];
    double least, most;
    range(runs, quantity, q, &least, &most);
    if (q == QUANTITY_newton_iterations) {
        snprintf(comment, sizeof comment, "%d runs took %g to %g; half and double", runs, least, most);
    } else {
        snprintf(comment, sizeof comment, "%s; run as it is %.7g; %d runs %.7g to %.7g; beyond them %g times their spread and %.3g",
                 scene_quantity_unit((scene_quantity)q), quantity[0][q], runs, least, most, widening, floor_of(q, most, scale));
    }
    return json_pack("{s:[f,f], s:s}", "band", rounded(low, high - low, false), rounded(high, high - low, true), "comment", comment);
}

bool golden_write(const char *path, const char *command, int runs, const double (*quantity)[QUANTITY_COUNT], golden_scale scale,
                  char why[GOLDEN_REASON])
{
    enum { DIGITS = 12 };
    const golden_bands bands = golden_derive(runs, quantity, scale);
    json_t *all = json_object();
    for (int q = 0; q < QUANTITY_COUNT; q++) {
        json_object_set_new(all, scene_quantity_name((scene_quantity)q), band_entry(q, bands.low[q], bands.high[q], runs, quantity, scale));
    }
    json_t *root = json_pack("{s:s, s:s, s:o}", "command", command, "comment", "made by --regenerate; see README.md", "bands", all);
    const bool good = root != NULL && json_dump_file(root, path, JSON_INDENT(2) | JSON_REAL_PRECISION(DIGITS)) == 0;
    json_decref(root);
    if (!good) {
        snprintf(why, GOLDEN_REASON, "%.300s: cannot be written", path);
    }
    return good;
}
