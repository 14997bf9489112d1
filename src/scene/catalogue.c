/* The scenes that come with the project. Rows are those of the papers' table of scenes; titles are those of the files. The last column: as what a run ends. */
#include "cipc/scene.h"

static const cipc_scene_entry entries[] = {
    {"drape", "Cloth falls on a sphere and a floor", "C-IPC fig. 11 and 12a; rows 11, 12a", "tests/scenes/drape.json", CIPC_OK},
    {"two-corner-hang", "Cloth hung by two opposite corners under a strain limit", "C-IPC fig. 12b; row 12b",
     "tests/scenes/two-corner-hang.json", CIPC_OK},
    {"orthotropic-drape", "Orthotropic cloth falls on a sphere and a floor", "C-IPC fig. 13; row 13", "tests/scenes/orthotropic-drape.json", CIPC_OK},
    {"orthotropic-hang", "Orthotropic cloth hung by two opposite corners", "C-IPC fig. 12b with the fabrics of fig. 13", "tests/scenes/orthotropic-hang.json", CIPC_OK},
    {"rotating-sphere", "Cloth on a sphere that starts to spin", "C-IPC fig. 6; row 6", "tests/scenes/rotating-sphere.json", CIPC_OK},
    {"tablecloth", "A tablecloth pulled from under the dinnerware", "C-IPC fig. 1; row 1", "tests/scenes/tablecloth.json", CIPC_OK},
    {"twisted-cylinder", "Cylinder of cloth twisted by its two ends", "C-IPC fig. 2; row 2", "tests/scenes/twisted-cylinder.json", CIPC_OK},
    {"braids", "Two bundles of strands twisted into a braid", "C-IPC fig. 3a; row 3a", "tests/scenes/braids.json", CIPC_OK},
    {"hairs", "A tuft of hair falls across a bundle held at both ends and a ball", "C-IPC fig. 3b; row 3b", "tests/scenes/hairs.json", CIPC_OK},
    {"funnel", "Three sheets pushed through a funnel", "C-IPC fig. 7; row 7", "tests/scenes/funnel.json", CIPC_OK},
    {"cards", "Precision shuffle of a deck of cards", "C-IPC fig. 8; row 8", "tests/scenes/cards.json", CIPC_OK},
    {"needles", "Cloth dragged over a bed of needles", "C-IPC fig. 9; row 9", "tests/scenes/needles.json", CIPC_OK},
    {"noodles", "Noodles fall into a bowl", "C-IPC fig. 10; row 10", "tests/scenes/noodles.json", CIPC_OK},
    {"splitting", "Strain limits applied after the step, for comparison", "C-IPC fig. 14", "tests/scenes/splitting.json", CIPC_OK},
    {"stack", "A ball falls on a stack of cloths", "C-IPC fig. 18; row 18", "tests/scenes/stack.json", CIPC_OK},
    {"sprinkles", "Sprinkles fall into a bowl", "C-IPC fig. 21; row 21", "tests/scenes/sprinkles.json", CIPC_OK},
    {"granules", "Granules fall on a cloth held by its corners", "C-IPC fig. 22; row 22", "tests/scenes/granules.json", CIPC_OK},
    {"skirt", "Skirt of three layers on a dancer", "C-IPC fig. 5; row 5", "tests/scenes/skirt.json", CIPC_OK},
    {"dress", "Knife-pleat dress on a dancer who kicks", "C-IPC fig. 5; row 5", "tests/scenes/dress.json", CIPC_OK},
    {"reef-knot", "Reef knot of two ribbons, pulled tight", "C-IPC fig. 4; row 4", "tests/scenes/reef-knot.json", CIPC_OK},
    {"all-in", "A figure, sand and a cloth fall into a net", "C-IPC fig. 23; row 23", "tests/scenes/all-in.json", CIPC_OK},
    {"falling-particle", "A particle falls on a floor and comes to rest", "ACM fig. 6", "tests/scenes/falling-particle.json", CIPC_OK},
    {"head-on", "A particle meets a plane head-on", "SPEC A.9, T-A1", "tests/scenes/head-on.json", CIPC_OK},
    {"curtains", "A particle goes through two curtains, slowly and then very fast", "ACM fig. 1 and 2", "tests/scenes/curtains.json", CIPC_OK},
    {"pulled-knot", "Reef knot tied by forces at the ends of two ribbons", "ACM fig. 8", "tests/scenes/pulled-knot.json", CIPC_OK},
    {"jammed-knot", "Reef knot whose ends are driven until it jams", "ACM fig. 9; ends as NO_PROGRESS, by design", "tests/scenes/jammed-knot.json", CIPC_E_NO_PROGRESS},
    {"trash-compactor", "Trash compactor: walls close on hollow balls and a sheet", "ACM fig. 10", "tests/scenes/trash-compactor.json", CIPC_OK},
    {"bed-of-nails", "Two cloths on a bed of nails, dragged over the points", "ACM fig. 11", "tests/scenes/bed-of-nails.json", CIPC_OK},
    {"nail-landing", "Projectiles of several sizes land on a bed of nails", "ACM fig. 11, second part", "tests/scenes/nail-landing.json", CIPC_OK},
    {"cloth-hang", "Cloth hung by two corners, its springs bounded", "Dahl fig. 4", "tests/scenes/cloth-hang.json", CIPC_OK},
    {"round-table", "Silk on a round table in the wind", "Dahl fig. 5a", "tests/scenes/round-table.json", CIPC_OK},
    {"table-materials", "Silk, brocade and cotton-linen on round tables in the same wind", "Dahl fig. 5b", "tests/scenes/table-materials.json", CIPC_OK},
    {"dress-on-body", "A dress let down on a mannequin", "Dahl fig. 6", "tests/scenes/dress-on-body.json", CIPC_OK},
    {"cloth-ball", "A cloth falls on a ball", "Dahl fig. 7", "tests/scenes/cloth-ball.json", CIPC_OK},
    {"free-fall", "Cloth in free fall", "known answer E1", "tests/scenes/free-fall.json", CIPC_OK},
    {"incline", "Plate on a slope", "known answer E3", "tests/scenes/incline.json", CIPC_OK},
    {"resting", "Plate at rest on a floor", "known answer E4", "tests/scenes/resting.json", CIPC_OK},
};

const cipc_scene_entry *cipc_scene_catalogue(int *count)
{
    *count = (int)(sizeof entries / sizeof entries[0]);
    return entries;
}
