/* Kuhn's subdivision: a tetrahedron for each order in which the three axes can be walked from one corner of a cell to the opposite one.
 * Every face of a cell is cut along the diagonal between its own first and last corner, so all cells conform, whatever their number; five
 * tetrahedra a cell would conform only if mirrored from cell to cell. Mirroring a whole half keeps the faces in the middle alike. */
#include "scene/cell_cuts.h"

static void place_nodes(cipc_mesh *mesh, const int cells[3])
{
    double *x = mesh->nodes;
    for (int j = 0; j <= cells[1]; j++) {
        for (int k = 0; k <= cells[2]; k++) {
            for (int i = 0; i <= cells[0]; i++, x += 3) {
                x[0] = (2.0 * i - cells[0]) / cells[0];
                x[1] = (2.0 * j - cells[1]) / cells[1];
                x[2] = (2.0 * k - cells[2]) / cells[2];
            }
        }
    }
}

/* Walks from `corner`, one step along each axis in turn. A walk of the other handedness, or mirrored an odd number of times, has its first two nodes exchanged. */
static void cut_cell(int (*tetrahedra)[4], int corner, const int step[3], bool turned)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int p = 0; p < 6; p++) {
        int walk[4] = {corner};
        for (int s = 0; s < 3; s++) walk[s + 1] = walk[s] + step[orders[p][s]];
        bool exchange = (p >= 3) != turned;
        tetrahedra[p][0] = walk[exchange];
        tetrahedra[p][1] = walk[!exchange];
        tetrahedra[p][2] = walk[2];
        tetrahedra[p][3] = walk[3];
    }
}

static void cut_all(cipc_mesh *mesh, const int cells[3], const bool mirrored[3])
{
    const int stride[3] = {1, (cells[0] + 1) * (cells[2] + 1), cells[0] + 1};
    int at[3], count = 0;
    for (at[1] = 0; at[1] < cells[1]; at[1]++) {
        for (at[2] = 0; at[2] < cells[2]; at[2]++) {
            for (at[0] = 0; at[0] < cells[0]; at[0]++, count += 6) {
                int corner = 0, step[3];
                bool turned = false;
                for (int a = 0; a < 3; a++) {
                    bool low = mirrored[a] && 2 * at[a] < cells[a];
                    corner += stride[a] * (low ? at[a] + 1 : at[a]);
                    step[a] = low ? -stride[a] : stride[a];
                    turned ^= low;
                }
                cut_cell(mesh->tetrahedra + count, corner, step, turned);
            }
        }
    }
}

cipc_status scene_cut_cells(cipc_mesh *mesh, const int cells[3], const bool mirrored[3], const char *place, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    for (int a = 0; a < 3; a++) {
        if (cells[a] < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d by %d by %d cells", cells[0], cells[1], cells[2]);
        if (mirrored[a] && cells[a] % 2 != 0) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d cells across; an even number is needed", cells[a]);
        }
    }
    long long nodes = scene_mesh_product(scene_mesh_product(cells[0] + 1LL, cells[1] + 1LL), cells[2] + 1LL);
    long long count = scene_mesh_product(scene_mesh_product(cells[0], cells[1]), cells[2]);
    scene_mesh_sizes sizes = {.nodes = nodes, .tetrahedra = 6 * count};
    cipc_status status = scene_mesh_allocate_sizes(mesh, &sizes, place, error);
    if (status != CIPC_OK) return status;
    place_nodes(mesh, cells);
    cut_all(mesh, cells, mirrored);
    return CIPC_OK;
}
