/* The scenes that come with the project. Rows are those of the papers' table of scenes; titles are those of the files. */
#include "cipc/scene.h"

static const cipc_scene_entry entries[] = {
    {"drape", "Cloth falls on a sphere and a floor", "C-IPC fig. 11 and 12a; rows 11, 12a", "tests/scenes/drape.json"},
    {"two-corner-hang", "Cloth hung by two opposite corners under a strain limit", "C-IPC fig. 12b; row 12b",
     "tests/scenes/two-corner-hang.json"},
    {"orthotropic-drape", "Orthotropic cloth falls on a sphere and a floor", "C-IPC fig. 13; row 13", "tests/scenes/orthotropic-drape.json"},
    {"orthotropic-hang", "Orthotropic cloth hung by two opposite corners", "C-IPC fig. 12b with the fabrics of fig. 13", "tests/scenes/orthotropic-hang.json"},
    {"rotating-sphere", "Cloth on a sphere that starts to spin", "C-IPC fig. 6; row 6", "tests/scenes/rotating-sphere.json"},
    {"tablecloth", "A tablecloth pulled from under the dinnerware", "C-IPC fig. 1; row 1", "tests/scenes/tablecloth.json"},
    {"twisted-cylinder", "Cylinder of cloth twisted by its two ends", "C-IPC fig. 2; row 2", "tests/scenes/twisted-cylinder.json"},
    {"braids", "Two bundles of strands twisted into a braid", "C-IPC fig. 3a; row 3a", "tests/scenes/braids.json"},
    {"hairs", "A tuft of hair falls across a bundle held at both ends and a ball", "C-IPC fig. 3b; row 3b", "tests/scenes/hairs.json"},
    {"funnel", "Three sheets pushed through a funnel", "C-IPC fig. 7; row 7", "tests/scenes/funnel.json"},
    {"cards", "Precision shuffle of a deck of cards", "C-IPC fig. 8; row 8", "tests/scenes/cards.json"},
    {"needles", "Cloth dragged over a bed of needles", "C-IPC fig. 9; row 9", "tests/scenes/needles.json"},
    {"noodles", "Noodles fall into a bowl", "C-IPC fig. 10; row 10", "tests/scenes/noodles.json"},
    {"splitting", "Strain limits applied after the step, for comparison", "C-IPC fig. 14", "tests/scenes/splitting.json"},
    {"stack", "A ball falls on a stack of cloths", "C-IPC fig. 18; row 18", "tests/scenes/stack.json"},
    {"sprinkles", "Sprinkles fall into a bowl", "C-IPC fig. 21; row 21", "tests/scenes/sprinkles.json"},
    {"granules", "Granules fall on a cloth held by its corners", "C-IPC fig. 22; row 22", "tests/scenes/granules.json"},
    {"skirt", "Skirt of three layers on a dancer", "C-IPC fig. 5; row 5", "tests/scenes/skirt.json"},
    {"dress", "Knife-pleat dress on a dancer who kicks", "C-IPC fig. 5; row 5", "tests/scenes/dress.json"},
    {"reef-knot", "Reef knot of two ribbons, pulled tight", "C-IPC fig. 4; row 4", "tests/scenes/reef-knot.json"},
    {"all-in", "A figure, sand and a cloth fall into a net", "C-IPC fig. 23; row 23", "tests/scenes/all-in.json"},
    {"free-fall", "Cloth in free fall", "known answer E1", "tests/scenes/free-fall.json"},
    {"incline", "Plate on a slope", "known answer E3", "tests/scenes/incline.json"},
    {"resting", "Plate at rest on a floor", "known answer E4", "tests/scenes/resting.json"},
};

const cipc_scene_entry *cipc_scene_catalogue(int *count)
{
    *count = (int)(sizeof entries / sizeof entries[0]);
    return entries;
}
