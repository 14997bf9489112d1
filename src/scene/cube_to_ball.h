/* From the square onto the disc and from the cube onto the ball. */
#ifndef SCENE_CUBE_TO_BALL_H
#define SCENE_CUBE_TO_BALL_H

/* A point of [-1, 1]^n, n = 2 or 3, moves to the unit ball: the surface of each cube |x|_max = s to the sphere of radius s, and a regular lattice on a face to points that
 * lie evenly in angle. The axes stay where they are. */
void scene_cube_to_ball(int dimensions, double *x);

#endif
