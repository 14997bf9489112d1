/* Random numbers of mesh generators. */
#ifndef SCENE_RANDOM_H
#define SCENE_RANDOM_H

#include <stdint.h>

/* splitmix64 (Steele, Lea, Flood 2014): uniform in [0, 1), the same bits everywhere; the state starts as the seed. */
double scene_random(uint64_t *state);

#endif
