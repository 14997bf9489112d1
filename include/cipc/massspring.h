/* cipc/massspring.h - mass-spring cloth with Dahl friction (SPEC B; docs/theory/massspring.md): springs on equilateral triangles, a bound on their deformation, friction laws with
 * memory, collision with bodies given by formulas, semi-implicit Euler. Parts of the source are lost; what is a reconstruction is marked [R]. Floor 5.
 * This method does not guarantee that nothing intersects. */
#ifndef CIPC_MASSSPRING_H
#define CIPC_MASSSPRING_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/base.h"
#include "cipc/model.h"

/* ---- Friction laws (SPEC B.3, B.4) ---------------------------------------------------------------------------------------------------------- */

typedef enum cipc_friction_law {
    CIPC_LAW_COULOMB = 0,          /* Fc sgn v; 0 at v = 0: what is asked for then, up to Fs, only the caller knows. z is not used */
    CIPC_LAW_DAHL,                 /* dz/dt = v - sigma0 |v| z / Fc, F = sigma0 z; neither Fs nor sigma1 */
    CIPC_LAW_BIDIRECTIONAL,        /* R1 [R]: Fc replaced by h(|v|) = Fs for |v| <= dv, Fc beyond; F = sigma0 z + sigma1 dz/dt */
    CIPC_LAW_BIDIRECTIONAL_SMOOTH, /* R1s [R]: h = Fc + (Fs - Fc) exp(-(v/dv)^2) */
    CIPC_LAW_CLAMPED,              /* R2 [R]: dz/dt = v, but 0 where |z| >= h/sigma0 and z v > 0; in motion z is brought within h/sigma0 at once when h falls */
    CIPC_LAW_COUNT
} cipc_friction_law;
const char *cipc_friction_law_name(cipc_friction_law law); /* "coulomb", "dahl", "bidirectional", "bidirectional-smooth", "clamped"; of none of them "unknown" */

typedef struct cipc_friction_force {
    cipc_friction_law law;
    double sigma0;                 /* N/m, > 0: stiffness before sliding; not of Coulomb */
    double sigma1;                 /* N s/m: differential coefficient; limited so that the law stays passive: min(sigma1, 4 h/|v|) */
    double coulomb, breakaway;     /* Fc <= Fs, N */
    double band;                   /* dv, m/s: of static friction */
} cipc_friction_force;

/* One step of dt > 0 at constant relative velocity v, exact in z (unconditionally stable). z: internal state, m, changed in place; at v = 0 it stays. Returns F, N, which resists: what acts
 * on the body is -F, and F on the other body. F is sigma0 z' + sigma1 (z' - z)/dt with z' after the step; a fall of the bound of the clamped law is not part of z' - z.
 * |z| <= Fs/sigma0 (Dahl: Fc/sigma0) stays so, to rounding, while the forces stay the same. */
double cipc_friction_step(const cipc_friction_force *force, double v, double dt, double *z);
/* h(|v|), N. Coulomb: Fs at rest, so that a load up to cipc_friction_level(force, 0) sticks, Fc in motion. Dahl: Fc. */
double cipc_friction_level(const cipc_friction_force *force, double speed);
/* In the contact plane of unit normal n: z is first carried into the plane (z - n (n.z), its length kept; 0 if z is along n), v is the relative velocity, of which the tangential part counts.
 * f[3]: resists. Whoever makes a new contact sets z to 0; z of a contact that is lost is forgotten. On a line it is cipc_friction_step. */
void cipc_friction_step_plane(const cipc_friction_force *force, const double normal[3], const double v[3], double dt, double z[3], double f[3]);

/* ---- Springs (SPEC B.1) ------------------------------------------------------------------------------------------------------------------------ */

typedef enum cipc_spring_form {
    CIPC_SPRING_LINEAR = 0,        /* k (|x| - d) along the spring */
    CIPC_SPRING_TENSION,           /* the same in tension, nothing in compression (Choi and Ko's type 1) [L] */
    CIPC_SPRING_BUCKLING           /* Choi and Ko's type 2 [L]: linear in tension; in compression a beam of stiffness k_b that buckles at once into an arc, and the linear spring
                                    * where that pushes less: near d, where the arc would jump to -12 k_b/d^2 */
} cipc_spring_form;

typedef struct cipc_spring {
    cipc_spring_form form;
    double length;                 /* d, m */
    double stiffness;              /* k_s, N/m */
    double damping;                /* c_s, N s/m */
    double bending;                /* k_b, N m^2: of the buckling form */
} cipc_spring;

/* Signed force along the spring at distance r >= 0, N: positive pulls the ends together, negative pushes them apart; without damping. Continuous; the slope of an energy in every form.
 * To a few roundings of its value, of r - d near d. */
double cipc_spring_tension(const cipc_spring *spring, double r);
/* Energy at distance r > 0, J: 0 at d, its slope is the tension. */
double cipc_spring_energy(const cipc_spring *spring, double r);
/* Force on the first end, x = x0, x1 and v = v0, v1 (6 numbers each): tension and damping; that on the second is its opposite. Damping resists both lengthening and shortening, whatever
 * the form and its state. Ends at the same place: 0, there is no direction. */
void cipc_spring_force(const cipc_spring *spring, const double x[6], const double v[6], double f[3]);
/* (sqrt(3)/2) E t: a sheet of equilateral triangles then has Young's modulus E, Poisson's ratio 1/3 [L]. */
double cipc_spring_stiffness_of_sheet(double young, double thickness);
/* A step up to which semi-implicit Euler (v += h M^-1 (-K x - C v), then x += h v) is stable, s: h^2 k + 2 h c = 4, that is (2/omega) (sqrt(1 + zeta^2) - zeta), with the bounds of
 * Gershgorin for K and C over the mass at the worst node: twice the sum of its springs' stiffness or damping over its mass, once where the other end is held (inverse mass 0). Exact for two
 * equal masses, or one, and a spring; on the safe side otherwise. `push`, N/m, is stiffness that acts on every node besides, of what does not move, `drag`, 1/s, damping over mass;
 * 0: none. INFINITY: nothing can oscillate;
 * 0: the sums are beyond all numbers; NAN: no memory. */
double cipc_spring_stable_step(const cipc_spring *springs, const int (*ends)[2], int count, double push, double drag, const double *inverse_mass, int node_count);

/* ---- Deformation coefficient (SPEC B.2) ---------------------------------------------------------------------------------------------------------- */

typedef enum cipc_deformation_reading {
    CIPC_DEFORMATION_PROJECT = 0,  /* [R]: the ends are moved until B = Bmax (Provot) */
    CIPC_DEFORMATION_REST_LENGTH   /* the literal reading: the rest length is changed; caps the force, a kind of plasticity */
} cipc_deformation_reading;

/* max over the springs of B = ||x| - d| / d. */
double cipc_deformation_greatest(const cipc_spring *springs, const int (*ends)[2], int count, const double *x);
/* Gauss-Seidel sweeps, to and fro, over the springs: those with B > Bmax are brought to B = Bmax, until all are within Bmax (1 + tolerance), at most `sweeps`. Ends move along the spring in
 * proportion to their inverse masses (0: held, not touched), velocities change by displacement / dt (dt 0: left alone, v may be NULL). Linear momentum and centre of mass of what is free
 * are unchanged but by springs to held nodes. A spring of no length has no direction and stays, as does one with both ends held. Returns the number of sweeps, 0 if there was nothing to do;
 * *greatest (may be NULL): B afterwards, above Bmax (1 + tolerance) only if the sweeps were used up. Bmax = 0 asks for all springs to be rigid. */
int cipc_deformation_project(const cipc_spring *springs, const int (*ends)[2], int count, double bound, double tolerance, int sweeps, const double *inverse_mass, double dt, double *x,
                             double *v, double *greatest);
/* The literal reading: lengths of springs with B > Bmax become |x| / (1 + Bmax) if stretched, |x| / (1 - Bmax) if compressed, so that B = Bmax; for good, like plasticity. The force of a
 * linear spring is then at most k Bmax times its new length. A spring of no length keeps its own. Returns how many changed. */
int cipc_deformation_adjust(cipc_spring *springs, const int (*ends)[2], int count, double bound, const double *x);

/* ---- Bodies given by formulas, and bisection (SPEC B.6) ------------------------------------------------------------------------------------------- */

typedef enum cipc_collider_kind { CIPC_COLLIDER_PLANE = 0, CIPC_COLLIDER_SPHERE, CIPC_COLLIDER_BOX, CIPC_COLLIDER_DISC, CIPC_COLLIDER_CAPSULE } cipc_collider_kind;

/* Solid and convex. Box: a square table, its edges along the coordinate axes; disc: a round table, a cylinder about its axis; capsule: two balls and the cone that touches both, or the larger
 * ball if the other is in it. */
typedef struct cipc_collider {
    cipc_collider_kind kind;
    double center[3];              /* a point of the plane; of sphere, box, disc; first end of a capsule */
    double axis[3];                /* outward unit normal of a plane; unit axis of a disc; second end of a capsule */
    double half[3];                /* box: half its extents along x, y, z; disc: radius, half its height; sphere: radius; capsule: radii at both ends */
    double friction;               /* mu */
} cipc_collider;

/* Signed distance, m, negative inside, exact on both sides but for rounding, and the outward unit normal at the nearest point of the surface (normal may be NULL): the gradient of the distance.
 * Where several points are nearest, as for the centre of a ball, it is the normal at one of them. */
double cipc_collider_distance(const cipc_collider *collider, const double x[3], double normal[3]);

typedef enum cipc_bisection_method { CIPC_BISECTION_PLAIN = 0, CIPC_BISECTION_IMPROVED /* [R]: interpolated, Illinois rule */ } cipc_bisection_method;
typedef struct cipc_bisection_result {
    bool hit;                      /* the end of the way, x + d, is inside. Only the end is looked at [S]: what goes in and out again is not seen */
    double t;                      /* in [0, 1): where on the way the node is to stop; 1 without a hit */
    double distance;               /* at x + t d, m: after a hit 0 <= distance < threshold; else that of the end, >= 0 */
    int iterations;                /* evaluations of the distance between the ends of the way, of which each costs one more */
} cipc_bisection_result;
/* x is outside, distance >= 0; threshold > 0, m. After a hit that begins below the threshold t = 0. Plain bisection takes at most
 * N = ceil(log2(|d|/threshold)) iterations, the improved one at most N + 5 + 3 log3(2 N - 1) and far fewer as a rule. Both always end: with a threshold below what
 * numbers near x + t d can tell apart, at the last outside point found, whose distance may then not be below it.
 * Against the contract, with x inside: t = 0 and distance < 0 after a hit. `distance` is bit for bit that of the point x[k] + t * d[k], so that it can be the next x. */
cipc_bisection_result cipc_bisection(cipc_bisection_method method, const cipc_collider *collider, const double x[3], const double d[3], double threshold);

/* Repulsion [R], N: k (threshold - distance)_+ n for spheres and capsules, k threshold n while distance < threshold for tables and planes; nothing while the velocity is separating, v.n > 0.
 * k: stiffness, N/m. Acts inside as well. f[3] is overwritten. */
void cipc_collider_repulsion(const cipc_collider *collider, double stiffness, double threshold, const double x[3], const double v[3], double f[3]);

/* Wind on a triangle [R]: q A (n.w) n with w the wind minus the mean velocity of the corners, q in N s/m^3; a third of it on each, f[3]: on one corner. Both sides are alike; a triangle of
 * no area feels none. */
void cipc_wind_force(double q, const double wind[3], const double x[9], const double v[9], double f[3]);

/* ---- The integrator ---------------------------------------------------------------------------------------------------------------------------------- */

typedef struct cipc_massspring_options {
    double frame;                  /* s: what one cipc_massspring_step advances */
    double step;                   /* s: of semi-implicit Euler; 0: the longest frame / k that is stable */
    bool refuse;                   /* a step that is too long is refused; false: it is divided */
    cipc_spring_form structural, bending_form;
    double bending_stiffness;      /* N/m: of the springs across edges; 0: none */
    double buckling;               /* k_b, N m^2: of the buckling form */
    double deformation;            /* Bmax; 0: no bound */
    cipc_deformation_reading reading;
    int sweeps;                    /* at most, of the projection */
    double wind[3], wind_pressure; /* m/s; q, kg/(m^2 s): of the air */
    cipc_bisection_method bisection;
    double threshold;              /* m: of bisection and repulsion */
    double repulsion;              /* N/m; 0: none */
    cipc_friction_law law;
    double presliding;             /* m: Fc / sigma0, the displacement before sliding, by order */
    double breakaway;              /* Fs / Fc >= 1 */
    double damping_ratio;          /* zeta of sigma1 = 2 zeta sqrt(sigma0 m) */
    double band;                   /* dv, m/s */
    double self_distance;          /* m: nodes of a cloth that no spring joins are kept so far apart, or 1/sqrt(2) of what they are at rest if that is less; 0: cloth passes through itself */
    double self_friction;          /* mu of cloth on itself */
} cipc_massspring_options;
/* frame 1/60 s, linear springs, Bmax 0.1 projected in at most 2000 sweeps, improved bisection to 1 mm, repulsion 0, R1 with presliding 1e-4 m, breakaway 1.2, damping ratio 0.5,
 * band 1e-3 m/s, no collision of cloth with itself. */
cipc_massspring_options cipc_massspring_options_default(void);

/* What one step did. */
typedef struct cipc_massspring_report {
    int substeps;
    double substep;                /* s */
    int contacts;                  /* nodes in contact with a body, in the last substep */
    long hits, arrivals, iterations; /* ways cut at a body; of these, begun farther away than the threshold, so that bisection had to look; its evaluations */
    int self_contacts;             /* pairs, in the last substep */
    int sweeps, beyond_bound;      /* of the projection, in all; substeps after which a spring was beyond Bmax (1 + 1e-3), for want of sweeps */
    int inside;                    /* nodes inside of a body at the end: bodies that overlap may keep one */
    double deformation;            /* B, at the end */
    double kinetic, gravitational, elastic; /* J, at the end */
    long reversals;                /* sign changes of tangential velocity of nodes in contact: chatter */
} cipc_massspring_report;

/* How many numbers a state has to remember for this method (cipc_state_remember), so that a run can go on from it as if it had never ended: the friction of every node, and with the reading
 * CIPC_DEFORMATION_REST_LENGTH lengths of springs. Of a state without, the integrator itself remembers. */
int cipc_massspring_memory(const cipc_model *model, const cipc_massspring_options *options);

typedef struct cipc_massspring cipc_massspring;
/* Shells whose material has springs are cloth; other bodies that move are refused (CIPC_E_WRONG_TYPE). colliders are copied. CIPC_E_OUT_OF_RANGE on options out of range, on a step
 * that is too long if it is to be refused (the error tells the longest), and on frames of more than a million substeps. The model must outlive it. */
cipc_status cipc_massspring_create(cipc_massspring **integrator, const cipc_model *model, const cipc_collider *colliders, int collider_count, const cipc_massspring_options *options,
                                   cipc_error *error);
void cipc_massspring_destroy(cipc_massspring *integrator);
/* Advance the state by one frame. CIPC_E_NO_PROGRESS: a position is no longer finite. */
cipc_status cipc_massspring_step(cipc_massspring *integrator, cipc_state *state, cipc_massspring_report *report, cipc_error *error);

#endif
