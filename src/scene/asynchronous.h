/* The numbers of asynchronous contact mechanics. */
#ifndef SCENE_ASYNCHRONOUS_H
#define SCENE_ASYNCHRONOUS_H

#include "cipc/asynchronous.h"
#include "cipc/implicit.h"
#include "scene/reader.h"

/* Read the block "asynchronous", whatever the method, so that one file serves both; `implicit` has the time step and dhat, the default of the thickness. */
void scene_read_asynchronous(scene_reader *reader, const scene_cursor *root, const cipc_implicit_options *implicit, cipc_asynchronous_options *options);

#endif
