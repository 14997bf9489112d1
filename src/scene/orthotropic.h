/* The membrane of orthotropic cloth. */
#ifndef SCENE_ORTHOTROPIC_H
#define SCENE_ORTHOTROPIC_H

#include "cipc/model.h"
#include "scene/fabrics.h"
#include "scene/reader.h"

/* Is the membrane said to be orthotropic, and of which fabric (NULL: of none)? */
bool scene_is_orthotropic(const scene_cursor *membrane);
const scene_fabric *scene_read_fabric(scene_reader *reader, const scene_cursor *membrane);
/* Read the rest of the membrane; in the tree the fabric and the factor are replaced by the numbers they stand for. */
void scene_read_orthotropic(scene_reader *reader, const scene_cursor *membrane, const scene_fabric *fabric,
                            cipc_orthotropic_material *material);

#endif
