#include "support/impact_scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

const double impact_thickness = 0.1, impact_stiffness = 1000, impact_mass = 1;

double impact_layer_factor(double gamma) { return sqrt(2) * gamma; }

/* Rows of 40 above one of the two triangles of the floor (x < z in its corner's frame), 0.5 m from its edges and from each other: one pair each. */
void impact_scene_init(asynchronous_scene *s, int count, const double *gaps, double speed, double gamma)
{
    enum { ROW = 40 };
    static double x[3 * IMPACT_MOST];
    const double pitch = 0.5, half = pitch * (ROW + 1);
    assert_true(count <= IMPACT_MOST);
    asynchronous_scene_init(s);
    for (int i = 0; i < count; i++) {
        x[3 * i] = -half + pitch * (1 + i % ROW);
        x[3 * i + 1] = gaps[i];
        x[3 * i + 2] = pitch * (1 + i / ROW);
    }
    asynchronous_add_particles(s, "particles", count, x, (double[3]){0, -speed, 0}, impact_mass);
    asynchronous_add_floor(s, 0, half);
    s->options.thickness = impact_thickness;
    s->options.stiffness = impact_stiffness;
    s->options.layer_factor = impact_layer_factor(gamma);
    s->options.restitution = 1;
}

double impact_gap(const asynchronous_scene *s, int i) { return s->sheet.state->position[3 * i + 1]; }
double impact_speed(const asynchronous_scene *s, int i) { return s->sheet.state->velocity[3 * i + 1]; }
