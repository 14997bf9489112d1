/* Edit distance by dynamic programming over three rows of the table. */
#include "scene/nearest_name.h"

#include <ctype.h>
#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum { LONGEST = 63 };

static int least(int a, int b, int c)
{
    int ab = a < b ? a : b;
    return ab < c ? ab : c;
}

static bool same(char a, char b)
{
    return tolower((unsigned char)a) == tolower((unsigned char)b);
}

static int counted_length(const char *text)
{
    size_t length = strlen(text);
    return length < LONGEST ? (int)length : LONGEST;
}

/* rows[i % 3][j] is the distance of the first i letters of a and the first j of b. */
int scene_edit_distance(const char *a, const char *b)
{
    int rows[3][LONGEST + 1];
    int m = counted_length(a), n = counted_length(b);
    for (int j = 0; j <= n; j++) rows[0][j] = j;
    for (int i = 1; i <= m; i++) {
        int *row = rows[i % 3];
        const int *above = rows[(i + 2) % 3], *two_above = rows[(i + 1) % 3];
        row[0] = i;
        for (int j = 1; j <= n; j++) {
            int replaced = above[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
            row[j] = least(replaced, above[j] + 1, row[j - 1] + 1);
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]) && two_above[j - 2] + 1 < row[j]) {
                row[j] = two_above[j - 2] + 1;
            }
        }
    }
    return rows[m % 3][n];
}

const char *scene_nearest_name(const char *name, const char *const *names, int count)
{
    const char *nearest = NULL;
    int smallest = INT_MAX;
    for (int i = 0; i < count; i++) {
        int distance = scene_edit_distance(name, names[i]);
        if (distance < smallest) {
            smallest = distance;
            nearest = names[i];
        }
    }
    return nearest;
}
