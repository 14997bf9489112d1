/* Arguments by argp, errors by cipc: one line that names the argument and the option that may have been meant. */
#include "cli/command.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "scene/nearest_name.h"

enum { MOST_OPTIONS = 32, KEY_HELP = '?', KEY_VERSION = 'V', KEY_USAGE = 0x1001 };

static const struct argp_option common_options[] = {
    {"help", KEY_HELP, NULL, 0, "Explain the command's options and leave", -1},
    {"usage", KEY_USAGE, NULL, 0, "Show the command's options in short and leave", -1},
    {"version", KEY_VERSION, NULL, 0, "Print the version and leave", -1},
};
enum { COMMON_COUNT = sizeof common_options / sizeof common_options[0] };

/* One parse: what argp hands from call to call. */
typedef struct parse {
    const cipc_arguments *arguments;
    struct argp argp;
    struct argp_option options[MOST_OPTIONS];
    int option_count;
    void *input;
    bool *answered;
    cipc_error *error;
    cipc_status status;
} parse;

/* A message begins with the program's name anyway. */
static const char *place(const cipc_arguments *arguments)
{
    const char *space = strchr(arguments->name, ' ');
    return space != NULL ? space + 1 : arguments->name;
}

static const struct argp_option *find_option(const parse *p, const char *word)
{
    const size_t length = strcspn(word, "=");
    for (int i = 0; i < p->option_count; i++) {
        const struct argp_option *o = &p->options[i];
        const bool is_long = length > 2 && strncmp(word, "--", 2) == 0 && o->name != NULL && strlen(o->name) == length - 2 &&
                             strncmp(word + 2, o->name, length - 2) == 0;
        const bool is_short = word[0] == '-' && word[1] == o->key && word[2] == '\0';
        if (is_long || is_short) {
            return o;
        }
    }
    return NULL;
}

static void reject_unknown(parse *p, const char *word)
{
    p->status = cipc_fail(p->error, CIPC_E_USAGE, place(p->arguments), "unknown option '%s'", word);
    if (strncmp(word, "--", 2) != 0) {
        cipc_fail_remedy(p->error, "see %s --help", p->arguments->name);
        return;
    }
    const char *names[MOST_OPTIONS];
    int count = 0;
    for (int i = 0; i < p->option_count; i++) {
        if (p->options[i].name != NULL) {
            names[count++] = p->options[i].name;
        }
    }
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
    cipc_fail_remedy(p->error, "the nearest option is --%s; see %s --help", scene_nearest_name(name, names, count), p->arguments->name);
}

/* getopt has refused a word: why? It stands before the next one to be read, or is that one if it is a cluster of short options. */
static void explain(parse *p, const struct argp_state *state)
{
    const char *word = state->argv[state->next - 1];
    const struct argp_option *option = find_option(p, word);
    const bool innocent = word[0] != '-' || (option != NULL && option->arg == NULL && strchr(word, '=') == NULL);
    if (innocent && state->next < state->argc) {
        word = state->argv[state->next];
        option = find_option(p, word);
    }
    if (option == NULL) {
        reject_unknown(p, word);
    } else if (option->arg != NULL) {
        p->status = cipc_fail(p->error, CIPC_E_USAGE, place(p->arguments), "option '%s' needs a value", word);
        cipc_fail_remedy(p->error, "give %s %s", word, option->arg);
    } else {
        p->status = cipc_fail(p->error, CIPC_E_USAGE, place(p->arguments), "option '--%s' takes no value", option->name);
        cipc_fail_remedy(p->error, "give --%s alone", option->name);
    }
}

static void answer(parse *p, struct argp_state *state, unsigned help_flags)
{
    char name[64];
    snprintf(name, sizeof name, "%s", p->arguments->name);
    if (help_flags != 0) {
        argp_help(&p->argp, stdout, help_flags, name);
    } else {
        cipc_print_version();
    }
    *p->answered = true;
    state->next = state->argc; /* nothing after it matters */
}

static error_t take(int key, char *value, struct argp_state *state)
{
    parse *p = state->input;
    switch (key) {
    case KEY_HELP: answer(p, state, ARGP_HELP_STD_HELP); return 0;
    case KEY_USAGE: answer(p, state, ARGP_HELP_USAGE); return 0;
    case KEY_VERSION: answer(p, state, 0); return 0;
    case ARGP_KEY_ERROR:
        if (p->status == CIPC_OK) {
            explain(p, state);
        }
        return 0;
    case ARGP_KEY_INIT: case ARGP_KEY_ARGS: case ARGP_KEY_NO_ARGS: case ARGP_KEY_END: case ARGP_KEY_SUCCESS: case ARGP_KEY_FINI:
        return ARGP_ERR_UNKNOWN;
    default:
        p->status = *p->answered ? CIPC_OK : p->arguments->take(p->input, key, value, p->error);
        return p->status == CIPC_OK ? 0 : EINVAL;
    }
}

cipc_status cipc_parse_arguments(const cipc_arguments *arguments, int argc, char **argv, void *input, bool *answered, cipc_error *error)
{
    parse p = {.arguments = arguments, .input = input, .answered = answered, .error = error};
    *answered = false;
    for (const struct argp_option *o = arguments->options; o->name != NULL && p.option_count < MOST_OPTIONS - COMMON_COUNT - 1; o++) {
        p.options[p.option_count++] = *o;
    }
    memcpy(p.options + p.option_count, common_options, sizeof common_options);
    p.option_count += COMMON_COUNT;
    p.argp = (struct argp){.options = p.options, .parser = take, .args_doc = arguments->operands, .doc = arguments->doc};
    const error_t parsed = argp_parse(&p.argp, argc, argv, ARGP_NO_ERRS | ARGP_NO_HELP, NULL, &p);
    if (parsed == ENOMEM) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place(arguments), "no memory to read the arguments");
    }
    if (parsed != 0 && p.status == CIPC_OK && !*answered) {
        return cipc_fail(error, CIPC_E_USAGE, place(arguments), "the arguments make no sense");
    }
    return p.status;
}

cipc_status cipc_parse_integer(const char *place, const char *text, long least, long most, long *value, cipc_error *error)
{
    char *end = NULL;
    errno = 0;
    *value = strtol(text, &end, 10);
    if (end == text || *end != '\0') {
        cipc_fail(error, CIPC_E_USAGE, place, "'%s' is not a whole number", text);
        return cipc_fail_remedy(error, "give a whole number from %ld to %ld", least, most);
    }
    if (errno == ERANGE || *value < least || *value > most) {
        cipc_fail(error, CIPC_E_USAGE, place, "%s is out of range", text);
        return cipc_fail_remedy(error, "give a whole number from %ld to %ld", least, most);
    }
    return CIPC_OK;
}
