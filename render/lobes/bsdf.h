// The lobes of a point as one function of directions in space, to be evaluated and sampled together.
#pragma once

#include "render/lobes/scattering.h"

namespace lekalo::render {

struct BsdfSample {
  Vec3 in{0, 0, 1};    // unit, to where the light comes from
  bool sharp = false;  // of a mirror or smooth boundary: density means nothing to light sources
  double density = 0;  // per solid angle, of all lobes
  Spectrum share;      // f |cos| / density: what the light from there is multiplied with
};

class Bsdf {
 public:
  // `normal`: unit, of the shading, `geometric_normal` of the surface, both on the viewer's side; `along` a tangent,
  // the long direction of stretched lobes, or zero; `out` the unit direction to the viewer.
  Bsdf(const Scattering& scattering, const Vec3& normal, const Vec3& geometric_normal, const Vec3& along,
       const Vec3& out, const Sides& sides);

  bool is_black() const { return total_ <= 0; }
  // False: all light is mirrored or refracted sharply; then evaluate() brings nothing.
  bool has_spread() const;
  // f |cos| for light from `in`, without sharp lobes.
  Spectrum evaluate(const Vec3& in) const;
  // The share of evaluate() that matt bodies and nap bring, lane by lane; coats over them do not count.
  Spectrum matt_share(const Vec3& in) const;
  // Of sample() for that direction.
  double density(const Vec3& in) const;
  // Nothing if the choice fell on a direction that brings no light. Four random numbers in [0, 1).
  std::optional<BsdfSample> sample(const Vec2& choice, const Vec2& square) const;
  const Vec3& normal() const { return frame_.z; }

 private:
  template <class Evaluate>
  Spectrum sum_over(const Vec3& in, const Evaluate& evaluate) const;
  // Light from a side of the shading normal that is another one of the surface is none.
  bool is_possible(const Vec3& in, const Vec3& local_in) const {
    return (glm::dot(in, geometric_normal_) > 0) == (local_in.z > 0);
  }

  const Scattering& scattering_;
  geometry::Frame frame_;
  Vec3 geometric_normal_, out_;  // out_ in the frame
  Sides sides_;
  std::array<double, LobeList::kMaxLobes> importance_;
  double total_ = 0;
  float scale_;
};

// Share of light that goes straight on: through thin panes, and boundaries of equal indices. `cosine`: of the angle
// from the normal.
Spectrum straight_share(const Scattering& scattering, double cosine, const Sides& sides);

}  // namespace lekalo::render
