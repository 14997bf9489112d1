/* cipc: the first word is a command. */
#include "cli/command.h"

#include <hdf5.h>
#include <stdio.h>
#include <string.h>
#include "scene/nearest_name.h"

typedef struct command {
    const char *name, *purpose;
    int (*run)(int argc, char **argv);
} command;

static const command commands[] = {
    {"run", "simulate a scene and write what happened to a folder", cipc_command_run},
    {"scenes", "list the catalogue of scenes", cipc_command_scenes},
    {"verify", "hold the solver's functions against exact arithmetic", cipc_command_verify},
    {"vectors", "write inputs of a function with right answers", cipc_command_vectors},
    {"eval", "answer queries with the solver's functions", cipc_command_eval},
    {"judge", "judge a port's answers", cipc_command_judge},
    {"ccd", "compare methods of collision detection on recorded queries", cipc_command_ccd},
};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static void print_help(void)
{
    printf("Usage: cipc COMMAND [ARGUMENT...]\n"
           "Codimensional incremental potential contact, simulated and verified.\n\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        printf("  %-10s %s\n", commands[i].name, commands[i].purpose);
    }
    printf("  %-10s %s\n\n", "help", "explain a command: cipc help run, or cipc run --help");
    printf("cipc --version prints the version. Exit status: 0 all well; 1 the computation failed;\n"
           "2 bad usage or bad input; 3 an invariant or a verdict failed.\n");
}

static const command *find_command(const char *name)
{
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(commands[i].name, name) == 0) {
            return &commands[i];
        }
    }
    return NULL;
}

static int reject(const char *what, const char *word)
{
    cipc_error error;
    const char *names[COMMAND_COUNT];
    for (int i = 0; i < COMMAND_COUNT; i++) {
        names[i] = commands[i].name;
    }
    cipc_fail(&error, CIPC_E_USAGE, "command line", "%s '%s'", what, word);
    cipc_fail_remedy(&error, "the nearest command is %s; see cipc --help", scene_nearest_name(word, names, COMMAND_COUNT));
    return cipc_say(&error);
}

static int help(int argc, char **argv)
{
    if (argc < 3) {
        print_help();
        return 0;
    }
    const command *chosen = find_command(argv[2]);
    if (chosen == NULL) {
        return reject("there is no help on the unknown command", argv[2]);
    }
    char word[] = "--help";
    char *words[] = {argv[2], word, NULL};
    return chosen->run(2, words);
}

static int dispatch(int argc, char **argv)
{
    cipc_error error;
    if (argc < 2) {
        cipc_fail(&error, CIPC_E_USAGE, "command line", "no command is given");
        return cipc_say(&error);
    }
    const char *word = argv[1];
    if (strcmp(word, "--help") == 0 || strcmp(word, "-?") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "--usage") == 0) {
        print_help();
        return 0;
    }
    if (strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0) {
        cipc_print_version();
        return 0;
    }
    if (strcmp(word, "help") == 0) {
        return help(argc, argv);
    }
    if (word[0] == '-') {
        cipc_fail(&error, CIPC_E_USAGE, "command line", "unknown option '%s' before a command", word);
        return cipc_say(&error);
    }
    const command *chosen = find_command(word);
    return chosen != NULL ? chosen->run(argc - 1, argv + 1) : reject("unknown command", word);
}

int main(int argc, char **argv)
{
    /* HDF5 1.10 crashes in its exit handler when a file could not be closed for lack of disk space. Every file is closed, and the result
     * checked, before the end: there is nothing for the handler to do. */
    H5dont_atexit();
    int exit_status = dispatch(argc, argv);
    if ((fflush(stdout) != 0 || ferror(stdout)) && exit_status == 0) {
        cipc_error error;
        cipc_fail(&error, CIPC_E_IO, "standard output", "cannot write to it");
        exit_status = cipc_say(&error);
    }
    return exit_status;
}
