/* Numbers that steer the integrator. Defaults are the integrator's own; "compat": "released" changes some of them (docs/scene.md). */
#include "scene/settings.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "scene/asynchronous.h"
#include "scene/massspring.h"
#include "scene/method.h"

static const double gravity_default[3] = {0, -9.81, 0};            /* m/s^2 */
static const double released_tolerance = 1e-3;                     /* m/s (SPEC C.7) */
static const double camera_azimuth = 0.7, camera_elevation = 0.35; /* rad */

static const scene_range open_unit = {0, 1, true, true};

static char *copy_text(scene_reader *r, const scene_cursor *cursor, const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = cipc_alloc(size, 1);
    if (copy == NULL)
        scene_reject_memory(r, cursor);
    else
        memcpy(copy, text, size);
    return copy;
}

static void read_weights(scene_reader *r, const scene_cursor *cursor, cipc_integrator *integrator)
{
    static const char *const keys[] = {"alpha", "beta", "gamma", NULL};
    if (!scene_is_object(r, cursor, keys)) return;
    integrator->alpha = scene_number(r, cursor, "alpha", SCENE_REQUIRED_NUMBER, scene_positive);
    integrator->beta = scene_number(r, cursor, "beta", SCENE_REQUIRED_NUMBER, scene_positive);
    integrator->gamma = scene_number(r, cursor, "gamma", SCENE_REQUIRED_NUMBER, scene_any);
}

/* By name, or by its weights (SPEC C.1). */
static void read_integrator(scene_reader *r, const scene_cursor *root, cipc_integrator *integrator)
{
    static const char *const names[] = {"implicit-euler", "implicit-midpoint", NULL};
    static const cipc_integrator named[] = {{1, 1, 0}, {1, 0.5, 0.5}};
    scene_cursor member = scene_member(root, "integrator");
    if (json_is_object(member.value))
        read_weights(r, &member, integrator);
    else
        *integrator = named[scene_choice(r, root, "integrator", "integrator", names, 0)];
}

static void read_newton(scene_reader *r, const scene_cursor *root, cipc_implicit_options *options)
{
    static const char *const keys[] = {"tolerance", "norm", "iterations", "line_search_halvings", NULL};
    static const char *const norms[] = {"max", "rms", NULL}; /* in the order of cipc_newton_norm */
    scene_cursor newton = scene_object_member(r, root, "newton");
    if (!scene_is_object(r, &newton, keys)) return;
    double tolerance = options->released ? released_tolerance : options->newton_tolerance;
    cipc_newton_norm norm = options->released ? CIPC_NORM_RMS : options->newton_norm;
    options->newton_tolerance = scene_number(r, &newton, "tolerance", tolerance, scene_positive);
    options->newton_norm = (cipc_newton_norm)scene_choice(r, &newton, "norm", "norm", norms, (int)norm);
    options->newton_iterations = scene_integer(r, &newton, "iterations", options->newton_iterations, 1, INT_MAX);
    options->line_search_halvings = scene_integer(r, &newton, "line_search_halvings", options->line_search_halvings, 1, INT_MAX);
}

static void read_contact(scene_reader *r, const scene_cursor *root, cipc_implicit_options *options)
{
    static const char *const keys[] = {"dhat",
                                       "area_weights",
                                       "barrier_stiffness",
                                       "friction_iterations",
                                       "friction_cap",
                                       "friction_velocity",
                                       "ccd",
                                       "ccd_refine",
                                       "slackness",
                                       "ccd_iterations",
                                       NULL};
    static const char *const ccds[] = {"certified", "additive", "cubic", "minimum-separation", NULL}; /* in the order of cipc_ccd_method */
    options->ccd.method = options->released ? CIPC_CCD_ADDITIVE : CIPC_CCD_CERTIFIED;
    scene_cursor contact = scene_object_member(r, root, "contact");
    if (!scene_is_object(r, &contact, keys)) return;
    bool area_weights = options->contact.area_weights && !options->released;
    options->contact.dhat = scene_number(r, &contact, "dhat", options->contact.dhat, scene_positive);
    options->contact.area_weights = scene_boolean(r, &contact, "area_weights", area_weights);
    options->barrier_stiffness = scene_number(r, &contact, "barrier_stiffness", options->barrier_stiffness, scene_not_negative);
    options->friction_iterations = scene_integer(r, &contact, "friction_iterations", options->friction_iterations, 0, INT_MAX);
    options->friction_cap = scene_integer(r, &contact, "friction_cap", options->friction_cap, 1, INT_MAX);
    options->friction_velocity = scene_number(r, &contact, "friction_velocity", options->friction_velocity, scene_positive);
    options->ccd.method = (cipc_ccd_method)scene_choice(r, &contact, "ccd", "method of continuous collision detection", ccds, (int)options->ccd.method);
    options->ccd.refine = scene_boolean(r, &contact, "ccd_refine", options->ccd.refine);
    options->ccd.slackness = scene_number(r, &contact, "slackness", options->ccd.slackness, open_unit);
    options->ccd.max_iterations = scene_integer(r, &contact, "ccd_iterations", options->ccd.max_iterations, 1, INT_MAX);
}

/* How far the contact of the scene's method reaches, m. */
static double contact_range(const cipc_scene *scene)
{
    if (scene->method == CIPC_METHOD_MASS_SPRING) return scene->massspring.threshold;
    return scene->method == CIPC_METHOD_ASYNCHRONOUS ? scene->asynchronous.thickness : scene->options.contact.dhat;
}

static void read_monitor(scene_reader *r, const scene_cursor *root, cipc_scene *scene)
{
    static const char *const keys[] = {"enabled", "swept", "reach", NULL};
    scene_cursor monitor = scene_object_member(r, root, "monitor");
    if (!scene_is_object(r, &monitor, keys)) return;
    scene->monitor = scene_boolean(r, &monitor, "enabled", true);
    scene->monitor_swept = scene_boolean(r, &monitor, "swept", true);
    scene->monitor_reach = scene_number(r, &monitor, "reach", contact_range(scene), scene_not_negative);
}

static void read_output(scene_reader *r, const scene_cursor *root, cipc_scene *scene)
{
    static const char *const keys[] = {"obj", "camera", NULL}, *const camera_keys[] = {"azimuth", "elevation", "zoom", "subject", NULL};
    scene_cursor output = scene_object_member(r, root, "output");
    if (!scene_is_object(r, &output, keys)) return;
    scene->write_obj = scene_boolean(r, &output, "obj", false);
    scene_cursor camera = scene_object_member(r, &output, "camera");
    if (!scene_is_object(r, &camera, camera_keys)) return;
    scene->camera_azimuth = scene_number(r, &camera, "azimuth", camera_azimuth, scene_any);
    scene->camera_elevation = scene_number(r, &camera, "elevation", camera_elevation, scene_any);
    scene->camera_zoom = scene_number(r, &camera, "zoom", 1, scene_positive);
}

static void read_size(scene_reader *r, const scene_cursor *root, cipc_scene *scene)
{
    scene_cursor member = scene_member(root, "size");
    if (member.value == NULL) return;
    const char *size = scene_string_at(r, &member);
    if (strlen(size) >= sizeof scene->size) {
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "a name of %zu bytes; at most %zu are allowed", strlen(size), sizeof scene->size - 1);
    }
    snprintf(scene->size, sizeof scene->size, "%s", size);
}

void scene_read_settings(scene_reader *r, const scene_cursor *root, cipc_scene *scene, double gravity[3])
{
    static const char *const compats[] = {"none", "released", NULL};
    static const char *const couplings[] = {"coupled", "split", NULL}; /* in the order of cipc_strain_coupling */
    cipc_implicit_options *options = &scene->options;
    *options = cipc_implicit_options_default();
    scene->method = scene_read_method(r, root);
    scene->title = copy_text(r, root, scene_string(r, root, "title", ""));
    read_size(r, root, scene);
    options->released = scene_choice(r, root, "compat", "compat", compats, 0) == 1;
    options->time_step = scene_number(r, root, "time_step", SCENE_REQUIRED_NUMBER, scene_positive);
    scene->steps = scene_integer(r, root, "steps", SCENE_REQUIRED, 0, INT_MAX);
    scene_vector(r, root, "gravity", gravity_default, gravity);
    scene->seed = (unsigned long)scene_integer(r, root, "seed", 1, 0, INT_MAX);
    options->quasistatic = scene_boolean(r, root, "quasistatic", false);
    options->strain_coupling = (cipc_strain_coupling)scene_choice(r, root, "strain_coupling", "coupling of strain limits", couplings, 0);
    read_integrator(r, root, &options->integrator);
    read_newton(r, root, options);
    read_contact(r, root, options);
    scene_read_asynchronous(r, root, options, &scene->asynchronous);
    scene_read_massspring(r, root, options->time_step, &scene->massspring);
    scene_read_colliders(r, root, scene);
    read_monitor(r, root, scene);
    read_output(r, root, scene);
}
