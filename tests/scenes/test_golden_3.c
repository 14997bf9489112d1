/* Part 3 of the scenes that are held against golden files (tests/support/scene_table.c): parts run beside each other. */
#include "support/golden_program.h"

int main(void)
{
    return golden_program(3);
}
