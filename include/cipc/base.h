/* cipc/base.h - status codes, error text, checked memory, the words for pairs of primitives and for methods.
 * Floor 0. Everything above uses these; they use nothing of cipc. */
#ifndef CIPC_BASE_H
#define CIPC_BASE_H

#include <stdbool.h>
#include <stddef.h>

/* Every diagnostic of cipc, once: name, number, default remedy.
 * The thousands digit is the exit status of the program: 1 the computation failed, 2 bad usage or bad input, 3 a verdict failed. */
#define CIPC_DIAGNOSTICS(X)                                                                                            \
    X(OUT_OF_MEMORY, 1001, "use a smaller scene or a machine with more memory")                                       \
    X(IO, 1002, "check that the path exists, is writable and has space left")                                         \
    X(NOT_CONVERGED, 1003, "raise the iteration cap, loosen newton.tolerance or shorten time_step")                   \
    X(FACTORIZATION, 1004, "check masses and stiffnesses for extreme ratios")                                         \
    X(NO_PROGRESS, 1005, "shorten time_step, or check the scripted motion for an impossible squeeze")                 \
    X(USAGE, 2001, "see cipc --help")                                                                                 \
    X(SYNTAX, 2002, "mend the JSON at the place named")                                                               \
    X(UNKNOWN_KEY, 2003, "remove the key or use the name suggested")                                                  \
    X(WRONG_TYPE, 2004, "give a value of the type named")                                                             \
    X(OUT_OF_RANGE, 2005, "give a value inside the range named")                                                      \
    X(MISSING_KEY, 2006, "add the key named")                                                                         \
    X(MISSING_FILE, 2007, "check the path; it is taken relative to the scene file")                                   \
    X(BAD_MESH, 2008, "mend the mesh at the line named")                                                              \
    X(INITIAL_INTERSECTION, 2009, "move the bodies apart in the scene")                                               \
    X(INITIAL_GAP, 2010, "move the bodies apart, lower their offset, or within one body make the elements longer than it") \
    X(INITIAL_STRAIN, 2011, "start from a less stretched shape or raise the limit")                                   \
    X(BAD_QUERY, 2013, "mend the query at the line named; docs/conformance.md has the format")                        \
    X(NOT_RESUMABLE, 2012, "start afresh in another output folder")                                                   \
    X(VIOLATED_INTERSECTION, 3001, "a defect of the solver: please report it with the state written")                 \
    X(VIOLATED_GAP, 3002, "a defect of the solver: please report it with the state written")                          \
    X(VIOLATED_STRAIN, 3003, "a defect of the solver: please report it with the state written")                       \
    X(VIOLATED_INVERSION, 3004, "a defect of the solver: please report it with the state written")                    \
    X(VIOLATED_SWEPT, 3005, "a defect of the solver: please report it with the state written")                        \
    X(VIOLATED_ENERGY, 3006, "a defect of the solver: please report it with the state written")                       \
    X(VIOLATED_MOMENTUM, 3007, "a defect of the solver: please report it with the state written")                     \
    X(VIOLATED_FINITE, 3008, "a defect of the solver: please report it with the state written")                       \
    X(FAILED_VERDICT, 3010, "look at the worst cases named; cipc eval and cipc judge replay them")                    \
    X(INDETERMINATE, 3009, "the exact arithmetic gave up at its precision cap: please report the state written")

typedef enum cipc_status {
    CIPC_OK = 0,
#define CIPC_X(name, number, remedy) CIPC_E_##name = (number),
    CIPC_DIAGNOSTICS(CIPC_X)
#undef CIPC_X
} cipc_status;

/* What went wrong, where, and how to mend it. Caller-owned; a function that returns a status other than CIPC_OK has filled it.
 * A NULL cipc_error* is allowed everywhere: the status alone then tells. */
typedef struct cipc_error {
    cipc_status status;
    char place[512];  /* "file.json:12:7 bodies.cloth.thickness", "step 12", ... */
    char what[768];   /* one clause, no newline */
    char remedy[256]; /* one clause, no newline */
} cipc_error;

/* Name ("OUT_OF_RANGE"), default remedy and exit status (0..3) of a status. Never NULL. */
const char *cipc_status_name(cipc_status status);
const char *cipc_status_remedy(cipc_status status);
int cipc_status_exit(cipc_status status);

/* Fill *error (if not NULL) with the status, its default remedy, a place and a printf-formatted text, and return the status.
 * Newlines and control characters in the text are replaced by spaces, so that a message stays one line. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
cipc_status cipc_fail(cipc_error *error, cipc_status status, const char *place, const char *format, ...);

/* Replace the remedy of an error that cipc_fail has just filled. Returns error->status. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
cipc_status cipc_fail_remedy(cipc_error *error, const char *format, ...);

/* Zeroed array of count elements of the given size; NULL on overflow or lack of memory. count 0 gives a valid pointer.
 * All memory of the library comes from these three (base/memory.c is the only caller of malloc and friends), so a test that
 * links with -Wl,--wrap=calloc,--wrap=realloc can let the N-th one fail. */
void *cipc_alloc(size_t count, size_t size);
/* Resize to count elements (new ones are not zeroed); NULL on failure, then the old block stays valid. */
void *cipc_realloc(void *block, size_t count, size_t size);
void cipc_free(void *block);

/* ---- Pairs of primitives: the words in which solver, judge and verification speak of them. Types and names only, no arithmetic. ---------- */

/* The kinds of primitive pairs, and of the closest features between two primitives. A stencil is the concatenation of its nodes' positions, m,
 * point or first edge first: point-point x[6] = p, q; point-edge x[9] = p, e0, e1; point-triangle x[12] = p, t0, t1, t2; edge-edge x[12] = a0,
 * a1, b0, b1. */
typedef enum cipc_pair_kind { CIPC_POINT_POINT = 0, CIPC_POINT_EDGE, CIPC_POINT_TRIANGLE, CIPC_EDGE_EDGE, CIPC_PAIR_KIND_COUNT } cipc_pair_kind;

/* The closest features of a stencil: their kind and which local nodes of the stencil span them, in the order of that kind's stencil.
 * For example a point-triangle whose closest feature is the edge t1 t2: {CIPC_POINT_EDGE, 3, {0, 2, 3, 0}}. Unused entries are 0. */
typedef struct cipc_feature {
    cipc_pair_kind kind;
    int count;    /* nodes of the feature pair: 2, 3 or 4 */
    int local[4]; /* indices into the stencil */
} cipc_feature;

/* "point_point", "point_edge", "point_triangle", "edge_edge"; nodes of its stencil (2, 3, 4, 4); nodes of its first primitive (1, 1, 1, 2). */
const char *cipc_pair_name(cipc_pair_kind kind);
int cipc_pair_nodes(cipc_pair_kind kind);
int cipc_pair_first_nodes(cipc_pair_kind kind);
/* The two kinds of pairs of a triangle mesh. */
cipc_pair_kind cipc_mesh_pair(bool edge_edge);

/* The features a kind can have, numbered; a set of them is an unsigned with bit i for feature i. Names as in the conformance protocol:
 *   point_point     p-q
 *   point_edge      p-e0 p-e1 p-e
 *   point_triangle  p-t0 p-t1 p-t2  p-t0t1 p-t1t2 p-t2t0  p-t
 *   edge_edge       a0-b0 a0-b1 a1-b0 a1-b1  a0-b a1-b b0-a b1-a  a-b */
enum { CIPC_FEATURE_LIMIT = 9 };
int cipc_feature_count(cipc_pair_kind kind);
cipc_feature cipc_feature_at(cipc_pair_kind kind, int index);
const char *cipc_feature_name(cipc_pair_kind kind, int index);
/* Number of a feature, or -1: not one of that kind's. The ends of an edge may come in either order. */
int cipc_feature_index(cipc_pair_kind kind, const cipc_feature *feature);

/* A stencil in straight motion, t in [0, 1]. to_end false: x + t p with the displacements p, m. to_end true: p holds the positions at t = 1, and the
 * displacements are the exact differences p - x, which need not be doubles. Only the first 3 * cipc_pair_nodes(kind) numbers are looked at. */
typedef struct cipc_stencil_path {
    cipc_pair_kind kind;
    bool to_end;
    double x[12], p[12];
} cipc_stencil_path;

/* The methods that take the steps of a run, by the names they have in scenes and summaries. */
#define CIPC_METHODS(X) X(C_IPC, "c-ipc") X(ASYNCHRONOUS, "asynchronous") X(MASS_SPRING, "mass-spring")
typedef enum cipc_method {
#define CIPC_X(name, text) CIPC_METHOD_##name,
    CIPC_METHODS(CIPC_X)
#undef CIPC_X
    CIPC_METHOD_COUNT
} cipc_method;
/* Never NULL. */
const char *cipc_method_name(cipc_method method);

/* Version of the library, "0.1.0". */
const char *cipc_version(void);

#endif
