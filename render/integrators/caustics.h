// The explicit estimator of caustics: photons are sent from lamps through mirrors and smooth boundaries to surfaces
// that spread light. Which paths they bring is said in path_tracer.h.
#pragma once

#include <memory>

#include "render/integrators/photon_map.h"
#include "render/trace/world.h"

namespace lekalo::render {

struct CausticOptions {
  int photons = 0;          // to send, at least 1
  int max_depth = 64;       // mirrors and boundaries of a photon's path
  bool dispersion = false;  // as PathOptions
};

// Whether mirrors or smooth boundaries of the object, which is no group, may throw light in one direction. Of a
// textured one some places are asked.
bool throws_caustics(const Object& object);

struct Caustics {
  PhotonMap photons;
  std::vector<char> of_lamp;  // whether photons bring the light of World::lamps(); all but surroundings, and lamps
                              // whose light passes through everything
};

// The same photons for any number of threads. Null where no lamp sends any, nothing throws them, or something without
// bounds does: no ball holds that.
//
// A photon begins by its lamp and a place x on a ball that holds something that throws light: the lamp is
// asked for its light at x, as for any other place, which gives the direction w and the irradiance E. Photons that
// arrive at the ball's surface at the angle a have the flux E cos(a) / p, p the density of their places, shared among
// all that are sent; of photons that come from within the ball those are taken that leave it. So every lamp can send
// photons, and none are sent where nothing throws them. A ray that meets several balls belongs to the first of their
// list. Photons thin out as the square of their way; of lamps whose light does not fall off (decay: none) they gain as
// much, so that a thin pane or a plane mirror leaves the light as it would be without it.
std::shared_ptr<const Caustics> trace_caustics(const World& world, const CausticOptions& options);

}  // namespace lekalo::render
