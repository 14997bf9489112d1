/* cipc scenes: the catalogue, as a table or as JSON. */
#include "cli/command.h"

#include <jansson.h>
#include <stdio.h>
#include <string.h>
#include "cipc/scene.h"

static cipc_status take(void *input, int key, char *value, cipc_error *error)
{
    if (key == 'j') {
        *(bool *)input = true;
        return CIPC_OK;
    }
    return cipc_fail(error, CIPC_E_USAGE, "scenes", "surplus argument '%s'", value);
}

static const char *const sizes[] = {"ci", "desk", "paper"};
enum { SIZES = 3 };

/* 7 s, 12 min, 3.4 h, 2 days; "?" if it was not measured. */
static void describe_time(const cipc_scene_cost *cost, char text[32])
{
    static const struct {
        double unit, from;
        const char *name;
    } units[] = {{86400, 2 * 86400, "days"}, {3600, 5400, "h"}, {60, 90, "min"}, {1, 0, "s"}};
    int u = 0;
    while (cost->seconds < units[u].from) u++;
    const double value = cost->seconds / units[u].unit;
    if (cost->seconds > 0)
        snprintf(text, 32, "%s%.*f %s", cost->extrapolated ? "> " : "", value < 10 ? 1 : 0, value, units[u].name);
    else
        snprintf(text, 32, "?");
}

static void print_cost(const cipc_scene_cost *cost)
{
    char time[32], memory[32] = "?";
    describe_time(cost, time);
    if (cost->megabytes > 0) snprintf(memory, sizeof memory, "%d MB", cost->megabytes);
    printf("    %-5s %7d nodes  %5d steps  %10s  %9s\n", cost->size, cost->nodes, cost->steps, time, memory);
}

/* A scene and, under it, what it costs at each size. */
static void print_table(const cipc_scene_entry *entries, int count)
{
    int name = 0;
    for (int i = 0; i < count; i++) name = (int)strlen(entries[i].name) > name ? (int)strlen(entries[i].name) : name;
    for (int i = 0; i < count; i++) {
        const cipc_scene_entry *e = &entries[i];
        printf("%-*s  %s (%s; %s)\n", name, e->name, e->title, e->source, e->file);
        if (e->ends != CIPC_OK) printf("    ends as %s (exit status %d): that is what it is to show\n", cipc_status_name(e->ends), cipc_status_exit(e->ends));
        for (int k = 0; k < SIZES; k++) {
            const cipc_scene_cost *cost = cipc_scene_cost_of(e->name, sizes[k]);
            if (cost != NULL) print_cost(cost);
        }
    }
}

static json_t *cost_object(const cipc_scene_cost *cost)
{
    return json_pack("{s:i, s:i, s:o, s:o, s:b}", "nodes", cost->nodes, "steps", cost->steps, "seconds", cost->seconds > 0 ? json_real(cost->seconds) : json_null(), "megabytes",
                     cost->megabytes > 0 ? json_integer(cost->megabytes) : json_null(), "extrapolated", cost->extrapolated);
}

static json_t *entry_object(const cipc_scene_entry *e)
{
    json_t *object = json_pack("{s:s, s:s, s:s, s:s, s:s}", "name", e->name, "title", e->title, "source", e->source, "file", e->file, "ends", cipc_status_name(e->ends));
    json_t *all = json_object();
    for (int k = 0; k < SIZES; k++) {
        const cipc_scene_cost *cost = cipc_scene_cost_of(e->name, sizes[k]);
        if (cost != NULL) json_object_set_new(all, sizes[k], cost_object(cost));
    }
    json_object_set_new(object, "sizes", all);
    return object;
}

static int print_json(const cipc_scene_entry *entries, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++) json_array_append_new(list, entry_object(&entries[i]));
    int exit_status = 0;
    if (json_array_size(list) != (size_t)count) {
        cipc_error error;
        cipc_fail(&error, CIPC_E_OUT_OF_MEMORY, "scenes", "no memory for the catalogue");
        exit_status = cipc_say(&error);
    } else {
        json_dumpf(list, stdout, JSON_INDENT(2));
        printf("\n");
    }
    json_decref(list);
    return exit_status;
}

int cipc_command_scenes(int argc, char **argv)
{
    static const struct argp_option options[] = {{"json", 'j', NULL, 0, "As JSON", 0}, {0}};
    static const cipc_arguments arguments = {"cipc scenes", options, NULL,
                                             "List the scenes of the catalogue: name, title, source and file, and for each size nodes, steps, time and memory as measured once on one thread with all monitors ('>': at least so long, extrapolated from the first steps); and as what a run ends, if not well.", take};
    cipc_error error;
    bool as_json = false, answered = false;
    if (cipc_parse_arguments(&arguments, argc, argv, &as_json, &answered, &error) != CIPC_OK) {
        return cipc_say(&error);
    }
    if (answered) {
        return 0;
    }
    int count = 0;
    const cipc_scene_entry *entries = cipc_scene_catalogue(&count);
    if (as_json) {
        return print_json(entries, count);
    }
    print_table(entries, count);
    return 0;
}
