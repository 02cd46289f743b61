// Light along one path that is followed from the eye (Kajiya 1986): what the integrators `path` and `direct_lighting`
// share.
//
// At each surface one lamp is asked for its light (next-event estimation), and one direction is drawn from the lobes;
// light that both would bring counts by the power heuristic (Veach 1997). Which estimator brings which light, D a
// surface or lobe that spreads light, S a mirror or smooth boundary, L a lamp that has a size, P one that has none, A
// ambient light, E an object that glows, from the eye:
//
//   any path that ends D L      both, weighted
//   any path that ends D P      the lamp
//   any path that ends S L      the drawn direction
//   any path that ends D E      both, weighted (E is looked for within a ball that holds it)
//   any path that ends S E      the drawn direction
//   any path that ends A        the drawn direction
//   any path that ends S P      nothing: mirrors and lenses would have to find a point; the light is left out
//
// With photons (caustics.h), whatever comes before, and + for one and more:
//
//   any path with D S+ L, D S+ P at its end   the photons, D being a surface
//   any path with M S+ L at its end           the drawn direction, M a scattering in a substance: photons never land
//                                             there
//   paths S+ L alone                          the drawn direction: lamps seen in mirrors
//   paths S+ P alone                          nothing: a point has no picture
//   any path that ends D S+ E, D S+ sky       the drawn direction
//
// Spectral paths (spectra/hero_wavelengths.h) divide their light among the estimators in the same way. Photons carry
// red, green and blue all the same, with one wavelength where glass parts colours: what they bring counts as the smooth
// spectrum of its colour (LinearUpsampling), so that caustics are right in colour on white and grey surfaces, and near
// to it on others. Densities do not depend on the wavelength but for refraction where colours part: so four wavelengths
// of equal weight are the balance heuristic among them.
//
// Radiance is that over the square of the refractive index of the place.
#pragma once

#include "render/integrator.h"
#include "render/integrators/boundary.h"

namespace lekalo::render {

class Bsdf;
class LightTree;
struct Caustics;

struct PathOptions {
  int max_depth = 64;          // reflections and refractions of a path after the first, in [0, 1000]
  int max_scatterings = 1000;  // those of them that are no mirrors and smooth boundaries
  double clamp = 0;         // light that reached the eye over two and more surfaces is at most so bright; 0: as it is
  bool dispersion = false;  // paths that meet a substance whose index depends on the wavelength take one
  bool spectral = false;    // paths carry four wavelengths in place of red, green and blue, and keep one of them there
  int photons = 0;          // for caustics, to be traced before the picture (trace_caustics); 0: none
  bool background_shines = false;  // the background lights the scene from everywhere
};

// `tell_parts`: where the light comes from (RaySample::parts).
// `caustics`: the photons of the scene; null: there are none, and their light comes as the first table says.
// `tree`: of the world's lamps; null: they are looked at one by one.
RaySample trace_path(const World& world, const Ray& ray, const Hit& first, SampleStream& random,
                     const PathOptions& options, const Caustics* caustics = nullptr, const LightTree* tree = nullptr,
                     bool tell_parts = false);

}  // namespace lekalo::render
