/* The progress line: rewritten in place on a terminal. */
#include "cipc/output.h"

#include <math.h>

/* "1:02:03", "4:05", or "-" when unknown. */
static void format_duration(char *text, size_t size, double seconds)
{
    const double longest = 1e6 * 3600;
    if (!(seconds >= 0 && seconds < longest)) {
        snprintf(text, size, "-");
        return;
    }
    long s = lround(seconds);
    if (s >= 3600) {
        snprintf(text, size, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    } else {
        snprintf(text, size, "%ld:%02ld", s / 60, s % 60);
    }
}

/* A length or a time; "-" when there is none. */
static void format_measure(char *text, size_t size, double value, const char *unit)
{
    if (isfinite(value)) {
        snprintf(text, size, "%.2e %s", value, unit);
    } else {
        snprintf(text, size, "-");
    }
}

void cipc_asynchronous_progress_line(FILE *terminal, int step, int steps, double time, const cipc_asynchronous_report *report, double min_gap, double seconds_left)
{
    char left[32], gap[32], least[32];
    format_duration(left, sizeof left, seconds_left);
    format_measure(gap, sizeof gap, min_gap, "m");
    format_measure(least, sizeof least, report->smallest_step, "s");
    fprintf(terminal, "\r\033[Kstep %d/%d  t %.4g s  events %ld  layers %d  contacts %d  least step %s  gap %s  left %s", step, steps, time, report->total_events, report->layers,
            report->contacts, least, gap, left);
    fflush(terminal);
}

void cipc_massspring_progress_line(FILE *terminal, int step, int steps, double time, const cipc_massspring_report *report, const cipc_massspring_times *times, double seconds_left)
{
    char left[32], factor[32];
    format_duration(left, sizeof left, seconds_left);
    format_measure(factor, sizeof factor, times->step > 0 ? times->frame / times->step : (double)NAN, "x");
    fprintf(terminal, "\r\033[Kstep %d/%d  t %.4g s  substeps %d  contacts %d  hits %ld  deformation %.4f  real time %s  left %s", step, steps, time, report->substeps, report->contacts,
            report->hits, report->deformation, factor, left);
    fflush(terminal);
}

void cipc_progress_line(FILE *terminal, int step, int steps, double time, int newton_iterations, int contacts, double min_gap,
                        double max_stretch, double seconds_left)
{
    char left[32], gap[32], stretch[32];
    format_duration(left, sizeof left, seconds_left);
    format_measure(gap, sizeof gap, min_gap, "m");
    if (max_stretch > 0) {
        snprintf(stretch, sizeof stretch, "%.4f", max_stretch);
    } else { /* nothing that could be stretched, or nobody looked */
        snprintf(stretch, sizeof stretch, "-");
    }
    fprintf(terminal, "\r\033[Kstep %d/%d  t %.4g s  newton %d  contacts %d  gap %s  stretch %s  left %s", step, steps, time,
            newton_iterations, contacts, gap, stretch, left);
    fflush(terminal);
}

void cipc_progress_clear(FILE *terminal)
{
    fputs("\r\033[K", terminal);
    fflush(terminal);
}
