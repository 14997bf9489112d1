/* Kinds of primitive pairs and their features: a table of names and node lists. */
#include "cipc/base.h"

typedef struct feature_entry {
    const char *name;
    cipc_feature feature;
} feature_entry;

typedef struct kind_entry {
    const char *name;
    int nodes, first_nodes, feature_count;
    feature_entry features[CIPC_FEATURE_LIMIT];
} kind_entry;

#define POINTS(i, j) {CIPC_POINT_POINT, 2, {(i), (j), 0, 0}}
#define EDGE(i, j, k) {CIPC_POINT_EDGE, 3, {(i), (j), (k), 0}}

static const kind_entry kinds[CIPC_PAIR_KIND_COUNT] = {
    {"point_point", 2, 1, 1, {{"p-q", POINTS(0, 1)}}},
    {"point_edge", 3, 1, 3, {{"p-e0", POINTS(0, 1)}, {"p-e1", POINTS(0, 2)}, {"p-e", EDGE(0, 1, 2)}}},
    {"point_triangle",
     4,
     1,
     7,
     {{"p-t0", POINTS(0, 1)},
      {"p-t1", POINTS(0, 2)},
      {"p-t2", POINTS(0, 3)},
      {"p-t0t1", EDGE(0, 1, 2)},
      {"p-t1t2", EDGE(0, 2, 3)},
      {"p-t2t0", EDGE(0, 3, 1)},
      {"p-t", {CIPC_POINT_TRIANGLE, 4, {0, 1, 2, 3}}}}},
    {"edge_edge",
     4,
     2,
     9,
     {{"a0-b0", POINTS(0, 2)},
      {"a0-b1", POINTS(0, 3)},
      {"a1-b0", POINTS(1, 2)},
      {"a1-b1", POINTS(1, 3)},
      {"a0-b", EDGE(0, 2, 3)},
      {"a1-b", EDGE(1, 2, 3)},
      {"b0-a", EDGE(2, 0, 1)},
      {"b1-a", EDGE(3, 0, 1)},
      {"a-b", {CIPC_EDGE_EDGE, 4, {0, 1, 2, 3}}}}},
};

const char *cipc_pair_name(cipc_pair_kind kind) { return kinds[kind].name; }

int cipc_pair_nodes(cipc_pair_kind kind) { return kinds[kind].nodes; }

int cipc_pair_first_nodes(cipc_pair_kind kind) { return kinds[kind].first_nodes; }

cipc_pair_kind cipc_mesh_pair(bool edge_edge) { return edge_edge ? CIPC_EDGE_EDGE : CIPC_POINT_TRIANGLE; }

int cipc_feature_count(cipc_pair_kind kind) { return kinds[kind].feature_count; }

cipc_feature cipc_feature_at(cipc_pair_kind kind, int index) { return kinds[kind].features[index].feature; }

const char *cipc_feature_name(cipc_pair_kind kind, int index) { return kinds[kind].features[index].name; }

/* Bit i for local node i: a feature is known by its kind, its first node and the set of all its nodes. */
static unsigned node_set(const cipc_feature *feature)
{
    unsigned set = 0;
    for (int i = 0; i < feature->count; i++) set |= 1u << feature->local[i];
    return set;
}

int cipc_feature_index(cipc_pair_kind kind, const cipc_feature *feature)
{
    for (int i = 0; i < kinds[kind].feature_count; i++) {
        const cipc_feature *other = &kinds[kind].features[i].feature;
        if (other->kind == feature->kind && other->local[0] == feature->local[0] && node_set(other) == node_set(feature)) return i;
    }
    return -1;
}
