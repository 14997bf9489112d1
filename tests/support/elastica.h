/* The heavy elastica (SPEC E9), the reference for cantilevers of any deflection. */
#ifndef SUPPORT_ELASTICA_H
#define SUPPORT_ELASTICA_H

/* Deflection of the tip, over the length, of an inextensible beam clamped level, of weight w a length and rigidity EI; gamma = w L^3/EI. Integrated to 1e-13 a step. */
double elastica_tip(double gamma);

#endif
