#include "geometry/surfaces/blends/blend_fields.h"

#include <fmt/format.h>

#include "geometry/curves/on_surfaces/branch_choice.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/surfaces/derived/offset.h"

namespace lekalo::geometry {

namespace {

// A guide, and parameters on both surfaces near to its point at t.
struct Start {
  CurvePtr guide;
  double period = 0, t = 0;
  std::array<Vec2, 2> places{Vec2(0), Vec2(0)};
};

Vec2 foot_point(const Vec3& p, const SurfacePtr& of) {
  const SurfaceFootPoints found = SurfaceProjector(of).foot_points(p);
  if (found.foot_points.empty()) throw FieldError("of", "a surface has no foot point of the guide");
  return {found.foot_points.front().u, found.foot_points.front().v};
}

double start_of(const Curve& guide) {
  const Interval domain = guide.domain();
  if (!(domain.width() < kInfinity)) throw FieldError("guide", "the guide is unbounded", "give it a domain");
  return domain.middle();
}

Start along(const CurvePtr& guide, const std::array<SurfacePtr, 2>& of) {
  Start start{guide, guide->period(), start_of(*guide), {}};
  const Vec3 p = guide->point(start.t);
  for (int k = 0; k < 2; ++k) start.places[k] = foot_point(p, of[k]);
  return start;
}

Contours meeting(const SurfacePtr& a, const SurfacePtr& b) {
  try {
    return intersect(a, b);
  } catch (const std::invalid_argument& error) {
    throw FieldError("of", error.what());
  }
}

Start along_branch(const Contours& found, const Fields& f) {
  const CurvePtr curve = chosen_branch(found.branches, f, "of");
  Start start{contour_approximation(curve), curve->period(), start_of(*curve), {}};
  for (const Contour& branch : found.branches)
    if (branch.curve == curve)
      for (int k = 0; k < 2; ++k) start.places[k] = Vec2(branch.images[k]->point(start.t));
  return start;
}

// Where the surfaces meet; of a ball of constant radius between surfaces that do not, the way of its center, in which
// their offsets meet.
Start along_intersection(const BlendLaw& law, const Fields& f) {
  const Contours found = meeting(law.of[0], law.of[1]);
  if (!found.branches.empty()) return along_branch(found, f);
  if (law.kind == BlendKind::ball && law.sizes[0].is_constant() && law.sizes[1].is_constant()) {
    const auto moved = [&](int k) {
      return offset_surface(law.of[k], law.sides[k] * law.of[k]->normal_sign() * law.sizes[k](0.0));
    };
    const Contours centers = meeting(moved(0), moved(1));
    if (!centers.branches.empty()) return along_branch(centers, f);
  }
  throw FieldError("of", "the surfaces do not meet, so that there is nothing to go along",
                   "give a `guide`, a curve beside which the blend runs");
}

}  // namespace

TypeDeclaration& blend_fields(TypeDeclaration& type) {
  type.field("of", references({Category::surface}).count(2, 2), "both surfaces")
      .field("sides", words({"front", "back"}).count(2, 2),
             "the sides of both surfaces between which the blend lies: the front is where the normal points",
             "[front, front]")
      .optional("guide", reference({Category::curve}),
                "the curve beside which the blend runs, each section in a plane across it; else where the surfaces "
                "meet (of a ball of constant radius also the way of its center)");
  return choose_branch(type);
}

std::array<ScalarLaw, 2> blend_sizes(const Fields& f, const char* field) {
  const auto& given = f.get<std::vector<Expression>>(field);
  return {ScalarLaw(given.front()), ScalarLaw(given.back())};
}

Contacts blend_contacts(BlendLaw law, const Fields& f) {
  const auto& words = f.get<std::vector<std::string>>("sides");
  for (int k = 0; k < 2; ++k) {
    law.of[k] = std::any_cast<SurfacePtr>(f.references("of")[k]);
    law.sides[k] = law.of[k]->normal_sign() * (words[k] == "front" ? 1 : -1);
  }
  if (law.guide && f.has("guide"))
    throw FieldError("guide", "along an edge the edge itself is the guide", "leave it out");
  const Start start = law.guide        ? along(law.guide, law.of)
                      : f.has("guide") ? along(f.curve("guide"), law.of)
                                       : along_intersection(law, f);
  law.guide = start.guide, law.period = start.period;
  return Contacts(std::move(law), start.t, start.places);
}

}  // namespace lekalo::geometry
