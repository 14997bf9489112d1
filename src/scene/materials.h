/* Named isotropic fabrics. */
#ifndef SCENE_MATERIALS_H
#define SCENE_MATERIALS_H

typedef struct scene_material {
    const char *name;
    double density;   /* kg/m^3 */
    double thickness; /* m */
    double young;     /* Pa, membrane and bending alike, before the factors */
    double poisson;
    double strain_limit; /* s */
    const char *source;
} scene_material;

/* The table and its length. */
const scene_material *scene_materials(int *count);
/* The names, NULL-terminated, in the table's order. */
const char *const *scene_material_names(void);

#endif
