#include "support/scene_table.h"

#include <stdio.h>
#include <string.h>

/* ---- The scenes: one line each ----------------------------------------------------------------------------------------------- */

/* One thread: other tests run on the other cores, and the results are those of any number (test_threads_change_nothing). */
#define SCENE(file_name, ...) {.file = "tests/scenes/" file_name ".json", .threads = 1, .overrides = {__VA_ARGS__}}
#define NO_LIMIT "bodies.cloth.strain_limit=false"
#define LIMIT(s) "bodies.cloth.strain_limit.limit=" #s
#define MEMBRANE(m) "bodies.cloth.membrane_factor=" #m
#define FLAT_CLOTH {"membrane of cloth", "the cloth stays flat", NULL}, {"bending of cloth", "the cloth stays flat", NULL}
#define NO_FOLD {"friction of cloth and cloth", "the cloth does not touch itself", NULL}
/* Buckles in its first step, and which way is left to the last bits; the variant with smaller steps feels all of these but NO_FOLD's. */
#define SMALLER_STEPS "drape-membrane-0.01-limit-1.001-h-0.01"
#define LOTTERY                                                                                                                      \
    {                                                                                                                                \
        {"friction of cloth and ball", "the last bits decide from the first step on", SMALLER_STEPS},                                \
        {"friction of cloth and cloth", "the last bits decide from the first step on", NULL},                                        \
        {"bending of cloth", "the last bits decide from the first step on", SMALLER_STEPS},                                          \
        {"strain limit of cloth", "the last bits decide from the first step on", SMALLER_STEPS},                                     \
    }
#define SHUFFLED "once the cards are let go the last bits decide; the variant whose friction begins less suddenly feels it"
#define UNTOUCHED "it touches no body"
#define UNBOUND {"bound", "no spring comes near it", NULL}
#define ONE_SEGMENT "rods of one segment do not bend"
#define FLAT_PLATE                                                                                                                   \
    {                                                                                                                                \
        {"membrane of plate", "contacts are weighted by area, as masses are: the plate stays flat", NULL},                           \
        {"bending of plate", "the plate stays flat", NULL},                                                                          \
    }

/* A new scene: a line here, then `make golden SCENES=name`. What its tests then call unfelt is either a weakness of the scene, or goes into
 * the line with the reason. Test program i of n runs every n-th. */
const scene_variant scene_variants[] = {
    {"drape-membrane-1", SCENE("drape", MEMBRANE(1), NO_LIMIT), {{0}}},
    {"drape-membrane-1-limit-1.0608", SCENE("drape", MEMBRANE(1), LIMIT(1.0608)),
     {{"friction of cloth and cloth", "begins in step 8, when picometres have become tenths of millimetres", NULL}}},
    {"drape-membrane-0.1", SCENE("drape", MEMBRANE(0.1), NO_LIMIT), {{0}}},
    {"drape-membrane-0.1-limit-1.0608", SCENE("drape", MEMBRANE(0.1), LIMIT(1.0608)), {{0}}},
    {"drape-membrane-0.01", SCENE("drape", MEMBRANE(0.01), NO_LIMIT), {NO_FOLD}},
    {"drape-membrane-0.01-limit-1.0608", SCENE("drape", MEMBRANE(0.01), LIMIT(1.0608)), {{0}}},
    {"drape-membrane-0.01-limit-1.01", SCENE("drape", MEMBRANE(0.01), LIMIT(1.01)), {{0}}},
    {"drape-membrane-0.01-limit-1.001", SCENE("drape", MEMBRANE(0.01), LIMIT(1.001)), LOTTERY},
    {SMALLER_STEPS, SCENE("drape", MEMBRANE(0.01), LIMIT(1.001), "time_step=0.01", "steps=20"), {NO_FOLD}},
    {"two-corner-hang-limit-1.0608", SCENE("two-corner-hang", LIMIT(1.0608)), {{0}}},
    {"two-corner-hang-limit-1.01", SCENE("two-corner-hang", LIMIT(1.01)), {{0}}},
    {"two-corner-hang-limit-1.001", SCENE("two-corner-hang", LIMIT(1.001)),
     {{"dhat", "it touches itself from step 11 to 13, when last bits move it by millimetres", NULL}}},
    {"orthotropic-drape", SCENE("orthotropic-drape", NULL), {{0}}},
    {"orthotropic-hang", SCENE("orthotropic-hang", NULL), {{0}}},
    {"rotating-sphere", SCENE("rotating-sphere", NULL), {{0}}},
    {"tablecloth", SCENE("tablecloth", NULL), {{0}}},
    {"twisted-cylinder", SCENE("twisted-cylinder", NULL), {{"dhat", "there is no contact before the mantle has buckled, which the last bits decide", NULL}}},
    {"braids", SCENE("braids", NULL), {{0}}},
    {"hairs", SCENE("hairs", NULL), {{"friction of ball and tuft", "hairs whip before they come to the ball, and the last bits decide where", NULL}}},
    {"reef-knot", SCENE("reef-knot", NULL), {{0}}},
    {"skirt", SCENE("skirt", NULL), {{0}}},
    {"dress", SCENE("dress", NULL), {{0}}},
    {"funnel", SCENE("funnel", NULL), {{0}}},
    {"cards", SCENE("cards", NULL), {{"friction of left and left", SHUFFLED, NULL}, {"friction of ground", SHUFFLED, NULL}}},
    {"cards-friction-velocity-3e-4", SCENE("cards", "contact.friction_velocity=3.1622776601683795e-4"), {{0}}},
    {"needles", SCENE("needles", NULL), {{0}}},
    {"noodles", SCENE("noodles", NULL), {{0}}},
    {"splitting", SCENE("splitting", NULL), {{0}}},
    {"stack", SCENE("stack", NULL), {{0}}},
    {"sprinkles", SCENE("sprinkles", NULL), {{"bending of sprinkles", ONE_SEGMENT, NULL}, {"friction of bowl", "they scatter within the step in which friction begins", NULL}}},
    {"sprinkles-h-0.002", SCENE("sprinkles", "time_step=0.002", "steps=34"), {{"bending of sprinkles", ONE_SEGMENT, NULL}}},
    {"granules", SCENE("granules", NULL), {{0}}},
    {"all-in", SCENE("all-in", NULL), {{0}}},
    {"falling-particle", SCENE("falling-particle", NULL), {{0}}},
    {"head-on", SCENE("head-on", NULL), {{0}}},
    {"curtains", SCENE("curtains", NULL), {{0}}},
    {"pulled-knot", SCENE("pulled-knot", NULL), {{0}}},
    {"jammed-knot", SCENE("jammed-knot", "steps=12"), {{0}}}, /* it stalls in step 17 (test_asynchronous_scenes.c) */
    {"trash-compactor", SCENE("trash-compactor", NULL), {{0}}},
    {"bed-of-nails", SCENE("bed-of-nails", NULL), {{0}}},
    {"nail-landing", SCENE("nail-landing", NULL), {{0}}},
    {"drape-asynchronous", SCENE("drape", "method=asynchronous", NO_LIMIT, "asynchronous.layer_factor=0.1", "steps=12"), {NO_FOLD}},
    {"cloth-hang", SCENE("cloth-hang", NULL), 
     {{"presliding", UNTOUCHED, NULL}, {"breakaway", UNTOUCHED, NULL}, {"damping ratio", UNTOUCHED, NULL}, {"band", UNTOUCHED, NULL}}},
    {"round-table", SCENE("round-table", NULL), {UNBOUND}},
    {"table-materials", SCENE("table-materials", NULL), {UNBOUND}},
    {"dress-on-body", SCENE("dress-on-body", NULL), {{"self distance", "no fold comes near another", NULL}, {"self friction", "no fold comes near another", NULL}}},
    {"cloth-ball", SCENE("cloth-ball", NULL), {UNBOUND}},
    {"free-fall", SCENE("free-fall", NULL), {{"dhat", "nothing comes near", NULL}, FLAT_CLOTH}},
    {"incline", SCENE("incline", NULL), FLAT_PLATE},
    {"incline-sticks", SCENE("incline", "friction.0.mu=0.5"), FLAT_PLATE},
    {"resting", SCENE("resting", NULL), FLAT_PLATE},
};
const int scene_variant_count = sizeof scene_variants / sizeof scene_variants[0];

/* ---- Looking them up --------------------------------------------------------------------------------------------------------- */

const scene_variant *scene_variant_of(const char *name)
{
    for (int i = 0; i < scene_variant_count; i++) {
        if (strcmp(scene_variants[i].name, name) == 0) {
            return &scene_variants[i];
        }
    }
    return NULL;
}

void scene_golden_path(const scene_variant *variant, char path[SCENE_PATH])
{
    snprintf(path, SCENE_PATH, "tests/golden/%s.json", variant->name);
}

void scene_command(const scene_variant *variant, char command[SCENE_COMMAND])
{
    size_t length = (size_t)snprintf(command, SCENE_COMMAND, "cipc run %s", variant->request.file);
    for (int i = 0; variant->request.overrides[i] != NULL; i++) {
        length += (size_t)snprintf(command + length, SCENE_COMMAND - length, " --set %s", variant->request.overrides[i]);
    }
}

/* ---- Recording --------------------------------------------------------------------------------------------------------------- */

static bool print_step(void *context, int step, const scene_frame *frame)
{
    (void)context;
    printf("%s\n[", step > 1 ? "," : "");
    for (int i = 0; i < SCENE_NUMBERS; i++) {
        printf("%s%.17g", i > 0 ? ", " : "", scene_frame_values(frame)[i]);
    }
    printf("]");
    return true;
}

bool scene_record(const scene_variant *variant, int threads, double jitter, unsigned long seed)
{
    char command[SCENE_COMMAND];
    scene_outcome outcome;
    cipc_error error;
    scene_request request = variant->request;
    request.threads = threads;
    request.jitter = jitter;
    request.jitter_seed = seed;
    request.watch = print_step;
    scene_command(variant, command);
    printf("{\"command\": \"%s\", \"quantities\": {", command);
    for (int q = 0; q < QUANTITY_COUNT; q++) {
        const scene_quantity which = (scene_quantity)q;
        printf("%s\"%s\": [%d, \"%s\"]", q > 0 ? ", " : "", scene_quantity_name(which), scene_quantity_numbers(which), scene_quantity_unit(which));
    }
    printf("}, \"steps\": [");
    const cipc_status status = scene_run(&request, &outcome, &error);
    printf("],\n\"probes\": [%d, %d, %d]}\n", outcome.probe[0], outcome.probe[1], outcome.probe[2]);
    if (status != CIPC_OK) {
        fprintf(stderr, "%s: %s: %s\n", variant->name, error.place, error.what);
    }
    scene_outcome_free(&outcome);
    return status == CIPC_OK;
}
