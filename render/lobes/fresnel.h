// Fresnel's reflectance of smooth boundaries for unpolarised light (Born and Wolf 1999, 1.5.2 and 14.4).
#pragma once

#include "render/spectrum.h"

namespace lekalo::render {

// Between dielectrics: cos_incident in [0, 1] on the side of index n0, n1 behind; 1 beyond the critical angle.
double fresnel_dielectric(double cos_incident, double n0, double n1);

// Of both faces of a thin pane, by that of one.
inline double pane_reflectance(double of_a_face) { return 2 * of_a_face / (1 + of_a_face); }

// From air onto a conductor of complex index n - i k.
double fresnel_conductor(double cos_incident, double n, double k);

// The same for each lane.
Spectrum fresnel_dielectric(double cos_incident, const Spectrum& n1);
Spectrum fresnel_conductor(double cos_incident, const Spectrum& n, const Spectrum& k);

}  // namespace lekalo::render
