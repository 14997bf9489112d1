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

static void print_table(const cipc_scene_entry *entries, int count)
{
    int name = 0, title = 0, source = 0;
    for (int i = 0; i < count; i++) {
        name = (int)strlen(entries[i].name) > name ? (int)strlen(entries[i].name) : name;
        title = (int)strlen(entries[i].title) > title ? (int)strlen(entries[i].title) : title;
        source = (int)strlen(entries[i].source) > source ? (int)strlen(entries[i].source) : source;
    }
    for (int i = 0; i < count; i++) {
        printf("%-*s  %-*s  %-*s  %s\n", name, entries[i].name, title, entries[i].title, source, entries[i].source, entries[i].file);
    }
}

static int print_json(const cipc_scene_entry *entries, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++) {
        const cipc_scene_entry *e = &entries[i];
        json_array_append_new(list,
                              json_pack("{s:s, s:s, s:s, s:s}", "name", e->name, "title", e->title, "source", e->source, "file", e->file));
    }
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
                                             "List the scenes of the catalogue: name, title, source and file.", take};
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
