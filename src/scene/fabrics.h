/* Named orthotropic fabrics. */
#ifndef SCENE_FABRICS_H
#define SCENE_FABRICS_H

typedef struct scene_fabric {
    const char *name;
    double density;   /* kg/m^3 as the release uses it; see fabrics.c */
    double thickness; /* m */
    double moduli[4]; /* a11, a12, a22, G12, Pa, before the factor */
    double limits[3]; /* of the Green strains E11, E22, E12 */
} scene_fabric;

/* The table and its length. */
const scene_fabric *scene_fabrics(int *count);
/* The names, NULL-terminated, in the table's order. */
const char *const *scene_fabric_names(void);

#endif
