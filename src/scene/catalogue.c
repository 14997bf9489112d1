/* The scenes that come with the project. Rows are those of the papers' table of scenes; titles are those of the files. */
#include "cipc/scene.h"

static const cipc_scene_entry entries[] = {
    {"drape", "Cloth falls on a sphere and a floor", "C-IPC fig. 11 and 12a; rows 11, 12a", "tests/scenes/drape.json"},
    {"two-corner-hang", "Cloth hung by two opposite corners under a strain limit", "C-IPC fig. 12b; row 12b",
     "tests/scenes/two-corner-hang.json"},
    {"orthotropic-drape", "Orthotropic cloth falls on a sphere and a floor", "C-IPC fig. 13; row 13", "tests/scenes/orthotropic-drape.json"},
    {"orthotropic-hang", "Orthotropic cloth hung by two opposite corners", "C-IPC fig. 12b with the fabrics of fig. 13", "tests/scenes/orthotropic-hang.json"},
    {"rotating-sphere", "Cloth on a sphere that starts to spin", "C-IPC fig. 6; row 6", "tests/scenes/rotating-sphere.json"},
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
