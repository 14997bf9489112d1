#include "support/golden.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int golden_next_frame(int frame)
{
    return frame + (frame + 1) / 2;
}

__attribute__((format(printf, 2, 3))) static bool reject(char why[GOLDEN_REASON], const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(why, GOLDEN_REASON, format, arguments);
    va_end(arguments);
    return false;
}

/* ---- Reading: a band, a quantity, a frame, all of them ----------------------------------------------------------------------- */

static bool read_band(json_t *band, double *low, double *high)
{
    json_t *first = json_array_get(band, 0), *second = json_array_get(band, 1);
    *low = json_number_value(first);
    *high = json_number_value(second);
    return json_array_size(band) == 2 && json_is_number(first) && json_is_number(second) && *low <= *high;
}

/* One band of a quantity of one number, an array of bands of others. */
static bool read_quantity(json_t *entry, scene_quantity q, double *low, double *high)
{
    const int count = scene_quantity_numbers(q);
    if (count == 1) {
        return read_band(entry, low, high);
    }
    bool good = json_array_size(entry) == (size_t)count;
    for (int k = 0; good && k < count; k++) {
        good = read_band(json_array_get(entry, (size_t)k), low + k, high + k);
    }
    return good;
}

static bool read_frame(json_t *entry, const bool wanted[QUANTITY_COUNT], golden *bands, int index, char why[GOLDEN_REASON])
{
    const int frame = bands->frames[index];
    size_t known = 0;
    for (int i = 0; i < QUANTITY_COUNT; i++) {
        const scene_quantity q = (scene_quantity)i;
        json_t *numbers = json_object_get(entry, scene_quantity_name(q));
        const int first = scene_quantity_first(q);
        if ((numbers != NULL) != wanted[i]) {
            return reject(why, "frame %d %s %s, unlike the first frame", frame, wanted[i] ? "lacks" : "has", scene_quantity_name(q));
        }
        if (numbers != NULL &&
            !read_quantity(numbers, q, scene_frame_numbers(&bands->low[index]) + first, scene_frame_numbers(&bands->high[index]) + first)) {
            return reject(why, "frame %d: %s: not %d of [low, high]", frame, scene_quantity_name(q), scene_quantity_numbers(q));
        }
        known += numbers != NULL;
    }
    if (known != json_object_size(entry)) {
        return reject(why, "frame %d has quantities that are not known", frame);
    }
    return true;
}

/* The frames' numbers, in the file's order. */
static bool read_frame_list(json_t *all, golden *bands, char why[GOLDEN_REASON])
{
    const char *key;
    json_t *entry;
    int due = 1;
    if (json_object_size(all) == 0 || json_object_size(all) > GOLDEN_FRAMES) {
        return reject(why, "has %zu frames, not 1 to %d", json_object_size(all), GOLDEN_FRAMES);
    }
    json_object_foreach(all, key, entry)
    {
        char *end;
        const long frame = strtol(key, &end, 10);
        if (*end != '\0' || end == key || frame > bands->steps || (bands->frame_count > 0 && frame <= bands->frames[bands->frame_count - 1])) {
            return reject(why, "frame \"%.20s\" is none of steps 1 to %d in ascending order", key, bands->steps);
        }
        if (frame > due) {
            return reject(why, "lacks frame %d", due);
        }
        due = frame == due ? golden_next_frame(due) : due;
        bands->frames[bands->frame_count++] = (int)frame;
    }
    return bands->frames[bands->frame_count - 1] == bands->steps || reject(why, "lacks the last frame, %d", bands->steps);
}

static bool read_bands(json_t *root, const char *command, golden *bands, char why[GOLDEN_REASON])
{
    const char *made_by = json_string_value(json_object_get(root, "command"));
    json_t *all = json_object_get(root, "frames"), *probes = json_object_get(root, "probes");
    bool wanted[QUANTITY_COUNT];
    if (made_by == NULL || strcmp(made_by, command) != 0) {
        return reject(why, "is of another run: %.200s", made_by != NULL ? made_by : "(no command)");
    }
    bands->steps = (int)json_integer_value(json_object_get(root, "steps"));
    if (json_array_size(probes) != SCENE_PROBES) {
        return reject(why, "has %zu probes, not %d", json_array_size(probes), SCENE_PROBES);
    }
    for (size_t k = 0; k < SCENE_PROBES; k++) {
        bands->probe[k] = (int)json_integer_value(json_array_get(probes, k));
    }
    if (!read_frame_list(all, bands, why)) {
        return false;
    }
    for (int q = 0; q < QUANTITY_COUNT; q++) {
        wanted[q] = json_object_get(json_object_get(all, "1"), scene_quantity_name((scene_quantity)q)) != NULL;
    }
    for (int i = 0; i < bands->frame_count; i++) {
        char key[16];
        snprintf(key, sizeof key, "%d", bands->frames[i]);
        if (!read_frame(json_object_get(all, key), wanted, bands, i, why)) {
            return false;
        }
    }
    return true;
}

bool golden_read(const char *path, const char *command, golden *bands, char why[GOLDEN_REASON])
{
    json_error_t at;
    char reason[GOLDEN_REASON - 128];
    memset(bands, 0, sizeof *bands);
    json_t *root = json_load_file(path, JSON_REJECT_DUPLICATES, &at);
    if (root == NULL) {
        return reject(why, "%.100s:%d: %s", path, at.line, at.text);
    }
    const bool good = read_bands(root, command, bands, why);
    json_decref(root);
    if (!good) {
        snprintf(reason, sizeof reason, "%.300s", why);
        snprintf(why, GOLDEN_REASON, "%.100s: %s", path, reason);
    }
    return good;
}

/* ---- The check --------------------------------------------------------------------------------------------------------------- */

bool golden_accepts(const golden *bands, int index, const scene_frame *frame, char why[GOLDEN_REASON])
{
    const double *low = scene_frame_values(&bands->low[index]), *high = scene_frame_values(&bands->high[index]);
    for (int i = 0; i < SCENE_NUMBERS; i++) {
        const double number = scene_frame_values(frame)[i];
        if (!(number >= low[i] && number <= high[i])) {
            const scene_quantity q = scene_quantity_of(i);
            return reject(why, "frame %d: %s[%d] is %.12g %s, outside its band [%.12g, %.12g]", bands->frames[index], scene_quantity_name(q),
                          i - scene_quantity_first(q), number, scene_quantity_unit(q), low[i], high[i]);
        }
    }
    return true;
}

bool golden_watch(void *context, int step, const scene_frame *frame)
{
    golden_check *check = context;
    if (check->seen < check->bands->frame_count && step == check->bands->frames[check->seen]) {
        check->outside = !golden_accepts(check->bands, check->seen, frame, check->why);
        check->seen += !check->outside;
    }
    return !check->outside;
}

bool golden_verdict(golden_check *check, int steps, const int probe[SCENE_PROBES])
{
    const golden *bands = check->bands;
    if (check->outside) {
        return false;
    }
    if (steps != bands->steps || check->seen != bands->frame_count) {
        return reject(check->why, "the run has %d steps and %d of the file's frames; the file has %d steps and %d frames", steps, check->seen,
                      bands->steps, bands->frame_count);
    }
    for (int k = 0; k < SCENE_PROBES; k++) {
        if (probe[k] != bands->probe[k]) {
            return reject(check->why, "probe %d is node %d, in the file node %d", k, probe[k], bands->probe[k]);
        }
    }
    return true;
}
