/* Measured against expected: what the tests of closed forms assert, and what `make validation` makes a table of. */
#ifndef SUPPORT_VALIDATION_H
#define SUPPORT_VALIDATION_H

/* Fails the test unless |measured - expected| <= tolerance * |expected|. With CIPC_VALIDATION=FILE in the environment, appends the row to that file: case, quantity, expected,
 * measured, relative error, tolerance, tab-separated. */
void validation_row(const char *scene, const char *quantity, double expected, double measured, double tolerance);

/* Fails the test unless low < measured < high. The row has "low to high" for the expected value and no error. */
void validation_range(const char *scene, const char *quantity, double low, double high, double measured);

/* A point of a curve of a plot, for those who would rather look: appended to the same file, as plot, curve, x, y after the word "point". Asserts nothing. */
void validation_point(const char *plot, const char *curve, double x, double y);

#endif
