/* Faults of 1 %, derived from a scene as resolved: the physics that golden bands have to notice. One fault changes one coefficient wherever
 * it stands: gravity; the barrier's range dhat; each distinct coefficient of friction; of the bodies that are not fixed each distinct modulus
 * of membrane, bending, strain limit, rods and volumes, and each distinct time of stiffness damping; each distinct stiffness of stitches. Of the
 * method asynchronous not dhat, but eta(1), r(1) if it is given, restitution, and each distinct load; of mass-spring the stiffness of bending springs, the bound
 * on deformation, the pressure of wind, the displacement before sliding, and each distinct friction of colliders. */
#ifndef SUPPORT_SCENE_FAULT_H
#define SUPPORT_SCENE_FAULT_H

#include <stdbool.h>

enum { SCENE_FAULTS = 32, SCENE_FAULT_NAME = 96 };
typedef struct scene_fault {
    char name[SCENE_FAULT_NAME]; /* "gravity", "dhat", "friction of cloth and ball", "membrane of cloth": the first place where it stands */
    const char *kind;
    double value; /* of the coefficient; of several numbers the first that is not 0 */
} scene_fault;

/* The faults of a resolved scene (JSON text), at most SCENE_FAULTS. -1: no JSON, or more than that. */
int scene_faults(const char *resolved, scene_fault faults[SCENE_FAULTS]);
/* The scene with that coefficient multiplied by `factor` goes to a new file, path = "/tmp/cipc-fault-XXXXXX" filled in; the caller removes it. */
enum { SCENE_FAULT_PATH = 32 };
bool scene_fault_write(const char *resolved, const scene_fault *fault, double factor, char path[SCENE_FAULT_PATH]);

#endif
