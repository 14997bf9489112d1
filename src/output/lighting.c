/* Lambert's cosine law for a key light over the left shoulder and a weak fill light from the right, and a sky that is brighter than the
 * ground. All lights are white: a colour's hue survives. */
#include "output/lighting.h"

#include <math.h>
#include "base/vector.h"

static const double ambient_low = 0.20, ambient_high = 0.42, key_strength = 0.72, fill_strength = 0.16;

cipc_lighting cipc_lighting_of(const cipc_camera *camera)
{
    cipc_lighting lighting;
    for (int k = 0; k < 3; k++) {
        lighting.key[k] = -0.48 * camera->right[k] + 0.72 * camera->up[k] + 0.5 * camera->back[k];
        lighting.fill[k] = 0.80 * camera->right[k] + 0.10 * camera->up[k] + 0.59 * camera->back[k];
    }
    v3_scale(lighting.key, 1 / v3_norm(lighting.key), lighting.key);
    v3_scale(lighting.fill, 1 / v3_norm(lighting.fill), lighting.fill);
    return lighting;
}

cipc_shade cipc_shade_of(const cipc_lighting *lighting, const double n[3])
{
    const double sky = ambient_low + (ambient_high - ambient_low) * (0.5 + 0.5 * n[1]);
    const double key = key_strength * fmax(0, v3_dot(n, lighting->key));
    return (cipc_shade){sky + key + fill_strength * fmax(0, v3_dot(n, lighting->fill)), key};
}
