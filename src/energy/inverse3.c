/* Gauss-Jordan elimination with complete pivoting of a 3x3 matrix. */
#include "energy/inverse3.h"

#include <math.h>

/* A in the first three columns, the unit matrix in the others; order[j] is the column of A that stands in column j. */
typedef struct tableau {
    double m[3][6];
    int order[3];
    double determinant;
} tableau;

static void swap_rows(tableau *t, int a, int b)
{
    if (a == b) return;
    for (int j = 0; j < 6; j++) {
        double kept = t->m[a][j];
        t->m[a][j] = t->m[b][j];
        t->m[b][j] = kept;
    }
    t->determinant = -t->determinant;
}

static void swap_columns(tableau *t, int a, int b)
{
    if (a == b) return;
    for (int i = 0; i < 3; i++) {
        double kept = t->m[i][a];
        t->m[i][a] = t->m[i][b];
        t->m[i][b] = kept;
    }
    int kept = t->order[a];
    t->order[a] = t->order[b];
    t->order[b] = kept;
    t->determinant = -t->determinant;
}

/* The largest entry that is left comes to (k, k). */
static void choose_pivot(tableau *t, int k)
{
    int row = k, column = k;
    for (int i = k; i < 3; i++) {
        for (int j = k; j < 3; j++) {
            if (fabs(t->m[i][j]) > fabs(t->m[row][column])) {
                row = i;
                column = j;
            }
        }
    }
    swap_rows(t, k, row);
    swap_columns(t, k, column);
}

static void eliminate(tableau *t, int k)
{
    double pivot = t->m[k][k];
    for (int j = 0; j < 6; j++) t->m[k][j] /= pivot;
    for (int i = 0; i < 3; i++) {
        double factor = t->m[i][k];
        if (i == k) continue;
        for (int j = 0; j < 6; j++) t->m[i][j] -= factor * t->m[k][j];
    }
}

double energy_inverse3(const double A[9], double inverse[9])
{
    tableau t = {.order = {0, 1, 2}, .determinant = 1};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) t.m[i][j] = A[3 * i + j];
        t.m[i][3 + i] = 1;
    }
    for (int k = 0; k < 3; k++) {
        choose_pivot(&t, k);
        t.determinant *= t.m[k][k];
        if (t.m[k][k] == 0) return 0;
        eliminate(&t, k);
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) inverse[3 * t.order[i] + j] = t.m[i][3 + j];
    }
    return t.determinant;
}
