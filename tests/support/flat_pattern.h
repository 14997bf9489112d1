/* What a garment's flat pattern must be. */
#ifndef SUPPORT_FLAT_PATTERN_H
#define SUPPORT_FLAT_PATTERN_H

#include "cipc/scene.h"

/* Over all sides of all triangles, the largest |length in space / length in the pattern - 1|. */
double pattern_strain(const cipc_mesh *mesh);
/* Seen from above, the top row of all panels is a closed line: the least distance of two of its columns that do not meet, m. Columns of length 0
 * (from panel to panel) are skipped. */
double plan_clearance(const cipc_mesh *mesh);

#endif
