#include "support/validation.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void append(const char *format, ...)
{
    const char *path = getenv("CIPC_VALIDATION");
    if (!path) return;
    FILE *file = fopen(path, "a");
    if (!file) fail_msg("cannot append to %s", path);
    va_list arguments;
    va_start(arguments, format);
    vfprintf(file, format, arguments);
    va_end(arguments);
    fclose(file);
}

void validation_row(const char *scene, const char *quantity, double expected, double measured, double tolerance)
{
    double error = fabs(measured - expected) / fabs(expected);
    append("row\t%s\t%s\t%.6g\t%.6g\t%.2g\t%.2g\n", scene, quantity, expected, measured, error, tolerance);
    if (!(error <= tolerance)) fail_msg("%s: %s is %.9g, expected %.9g: off by %.3g, allowed %.3g", scene, quantity, measured, expected, error, tolerance);
}

void validation_range(const char *scene, const char *quantity, double low, double high, double measured)
{
    append("row\t%s\t%s\t%.6g to %.6g\t%.6g\t\t\n", scene, quantity, low, high, measured);
    if (!(measured > low && measured < high)) fail_msg("%s: %s is %.9g, not between %.9g and %.9g", scene, quantity, measured, low, high);
}

void validation_point(const char *plot, const char *curve, double x, double y) { append("point\t%s\t%s\t%.9g\t%.9g\n", plot, curve, x, y); }
