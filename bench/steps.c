/* Time per step of a scene, and the first steps' potentials. Prints one tab-separated row: seconds per step mean and max, Newton iterations per step mean and
 * max, seconds per Newton iteration, contacts at the end and at most, smallest gap minus thickness, largest stretch, peak memory, the monitors' share,
 * symbolic analyses, then milliseconds per Newton iteration by phase. With --potentials: one line a step instead.
 * Usage: steps SCENE THREADS MONITOR(0|1) STEPS(0: the scene's) [PATH=VALUE ...] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "cipc/cipc.h"

typedef struct watch {
    cipc_monitor *monitor;
    cipc_invariant_report report;
    double min_gap, max_stretch;
} watch;

static cipc_status look(void *context, const cipc_accepted_point *point, cipc_error *error)
{
    watch *w = context;
    cipc_status status = CIPC_OK;
    if (point->energy_valid) status = cipc_monitor_energy(point->energy_before, point->energy_after, point->energy_noise, error);
    if (!status) status = cipc_monitor_check(w->monitor, point->x, &w->report, error);
    w->min_gap = fmin(w->min_gap, w->report.min_gap);
    w->max_stretch = fmax(w->max_stretch, w->report.max_stretch);
    return status;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int fail(const cipc_error *error)
{
    fprintf(stderr, "steps: %s: %s: %s\n", error->place, error->what, error->remedy);
    return 1;
}

int main(int argc, char **argv)
{
    bool potentials = argc > 1 && strcmp(argv[1], "--potentials") == 0;
    if (potentials) {
        argv++;
        argc--;
    }
    if (argc < 5) {
        fputs("usage: steps [--potentials] SCENE THREADS MONITOR STEPS [PATH=VALUE ...]\n", stderr);
        return 2;
    }
    cipc_error error = {0};
    cipc_scene *scene = NULL;
    if (cipc_scene_load(&scene, argv[1], argc - 5, (const char *const *)(argv + 5), &error)) return fail(&error);
    scene->options.threads = atoi(argv[2]);
    bool monitored = atoi(argv[3]) != 0;
    int steps = atoi(argv[4]) > 0 ? atoi(argv[4]) : scene->steps;
    cipc_stepper *stepper = NULL;
    watch w = {.min_gap = INFINITY};
    cipc_invariant_options options = cipc_invariant_options_default();
    options.reach = scene->monitor_reach;
    options.threads = scene->options.threads;
    if (cipc_stepper_create(&stepper, scene->model, &scene->options, &error)) return fail(&error);
    if (monitored) {
        if (cipc_monitor_create(&w.monitor, scene->model, &options, &error)) return fail(&error);
        cipc_stepper_set_monitor(stepper, look, &w);
    }
    double all = 0, slowest = 0, phases[CIPC_PHASE_COUNT] = {0};
    int newton = 0, most_newton = 0, contacts = 0, most_contacts = 0, analyses = 0;
    for (int i = 0; i < steps; i++) {
        cipc_step_report r;
        double begin = now();
        if (cipc_step(stepper, scene->state, &r, &error)) return fail(&error);
        double seconds = now() - begin;
        all += seconds;
        slowest = fmax(slowest, seconds);
        newton += r.newton_iterations;
        most_newton = r.newton_iterations > most_newton ? r.newton_iterations : most_newton;
        contacts = r.contacts;
        most_contacts = r.max_contacts > most_contacts ? r.max_contacts : most_contacts;
        analyses += r.symbolic_analyses;
        for (int p = 0; p < CIPC_PHASE_COUNT; p++) phases[p] += r.seconds[p];
        if (!monitored) w.min_gap = fmin(w.min_gap, r.min_gap);
        if (potentials) printf("%d\t%d\t%d\t%.6e\t%.6g\n", i + 1, r.newton_iterations, r.contacts, r.incremental.total, r.barrier_stiffness);
    }
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    if (!potentials) {
        printf("%.4f\t%.3f\t%.2f\t%d\t%.4f\t%d\t%d\t%.2g\t%.5f\t%ld\t%.3f\t%d", all / steps, slowest, (double)newton / steps, most_newton, all / newton, contacts,
               most_contacts, w.min_gap, w.max_stretch, usage.ru_maxrss / 1024, phases[CIPC_PHASE_MONITOR] / all, analyses);
        for (int p = 0; p < CIPC_PHASE_COUNT; p++) printf("\t%s %.2f", cipc_phase_name((cipc_phase)p), 1e3 * phases[p] / newton);
        putchar('\n');
    }
    cipc_monitor_destroy(w.monitor);
    cipc_stepper_destroy(stepper);
    cipc_scene_destroy(scene);
    return 0;
}
