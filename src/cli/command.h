/* What the subcommands share: how they are called, how they take their arguments, how they speak. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include <argp.h>
#include <stdbool.h>
#include "cipc/base.h"

/* Each runs a subcommand; argv[0] is its name. Returns the program's exit status. */
int cipc_command_run(int argc, char **argv);    /* cli/run.c */
int cipc_command_scenes(int argc, char **argv); /* cli/scenes.c */
int cipc_command_verify(int argc, char **argv); /* cli/verify.c */
int cipc_command_vectors(int argc, char **argv); /* cli/vectors.c */
int cipc_command_eval(int argc, char **argv);   /* cli/eval.c */
int cipc_command_judge(int argc, char **argv);  /* cli/judge.c */
int cipc_command_ccd(int argc, char **argv);    /* cli/ccd.c */

/* One line on stderr, "cipc: where: CIPC-number: what: how to mend it"; returns the exit status that goes with the error. */
int cipc_say(const cipc_error *error);

/* How a command takes its arguments; --help, --usage and --version are added to its options. */
typedef struct cipc_arguments {
    const char *name;                  /* "cipc run" */
    const struct argp_option *options; /* of argp, ended by {0} */
    const char *operands;              /* "SCENE.json" */
    const char *doc;                   /* of argp: text before the options, '\v', text after them */
    /* Called for each option (its key and value) and operand (key 0), in order. */
    cipc_status (*take)(void *input, int key, char *value, cipc_error *error);
} cipc_arguments;

/* CIPC_OK; or CIPC_E_USAGE, or what `take` returned. *answered: help or version was asked for and has been printed to stdout. */
cipc_status cipc_parse_arguments(const cipc_arguments *arguments, int argc, char **argv, void *input, bool *answered, cipc_error *error);

/* An integer argument in [least, most]. */
cipc_status cipc_parse_integer(const char *place, const char *text, long least, long most, long *value, cipc_error *error);

/* JUnit XML with one case, the command itself, which ended with this error: no earlier file of verdicts may stay for this call's. path NULL: nothing. Returns exit_status. */
int cipc_junit_refused(const char *path, const char *command, const cipc_error *error, int exit_status);

/* Print "cipc 0.1.0" to stdout. */
void cipc_print_version(void);

#endif
