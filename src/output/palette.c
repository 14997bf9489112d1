/* Colours of bodies and curves. */
#include "output/palette.h"

#include <math.h>

#define HEX(code) {((code) >> 16) / 255.0, ((code) >> 8 & 0xff) / 255.0, ((code) & 0xff) / 255.0}
static const cipc_colour moving[] = {
    HEX(0xc8443f), HEX(0x2f7fb5), HEX(0xe3a32b), HEX(0x3f9b6c), HEX(0x8a5fb0), HEX(0xd9734a), HEX(0x2aa5a0), HEX(0xb8568f),
};
static const cipc_colour fixed[] = {HEX(0xa9a59d), HEX(0x8b96a3), HEX(0xc4b596), HEX(0x93a08f)};

static cipc_colour pick(const cipc_colour *colours, int count, int i)
{
    return colours[i % count];
}

cipc_colour cipc_body_colour(const cipc_model *model, int body)
{
    int before = 0; /* bodies of the same sort before this one */
    for (int b = 0; b < body; b++) {
        before += model->bodies[b].fixed == model->bodies[body].fixed;
    }
    return model->bodies[body].fixed ? pick(fixed, sizeof fixed / sizeof fixed[0], before)
                                     : pick(moving, sizeof moving / sizeof moving[0], before);
}

cipc_colour cipc_curve_colour(int i)
{
    static const cipc_colour curves[] = {HEX(0x2f7fb5), HEX(0xc8443f), HEX(0x3f9b6c), HEX(0x333333)};
    return pick(curves, sizeof curves / sizeof curves[0], i);
}

double cipc_srgb_to_linear(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

double cipc_linear_to_srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

cipc_colour cipc_colour_to_linear(cipc_colour srgb)
{
    return (cipc_colour){cipc_srgb_to_linear(srgb.r), cipc_srgb_to_linear(srgb.g), cipc_srgb_to_linear(srgb.b)};
}
