/* Measured against expected: what the tests of closed forms assert, and what `make validation` makes a table of. */
#ifndef SUPPORT_VALIDATION_H
#define SUPPORT_VALIDATION_H

/* Fails the test unless |measured - expected| <= tolerance * |expected|. With CIPC_VALIDATION=FILE in the environment, appends the row to that file: case, quantity, expected,
 * measured, relative error, tolerance, tab-separated. */
void validation_row(const char *scene, const char *quantity, double expected, double measured, double tolerance);

#endif
