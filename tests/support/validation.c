#include "support/validation.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void validation_row(const char *scene, const char *quantity, double expected, double measured, double tolerance)
{
    double error = fabs(measured - expected) / fabs(expected);
    const char *path = getenv("CIPC_VALIDATION");
    FILE *file = path ? fopen(path, "a") : NULL;
    if (path && !file) fail_msg("cannot append to %s", path);
    if (file) {
        fprintf(file, "%s\t%s\t%.6g\t%.6g\t%.2g\t%.2g\n", scene, quantity, expected, measured, error, tolerance);
        fclose(file);
    }
    if (!(error <= tolerance)) fail_msg("%s: %s is %.9g, expected %.9g: off by %.3g, allowed %.3g", scene, quantity, measured, expected, error, tolerance);
}
