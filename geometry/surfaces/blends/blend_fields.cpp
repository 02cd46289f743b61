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

void check_edge(const Curve& edge, const SurfacePtr& of) {
  constexpr double kOn = 1e-6;  // of the edge's size
  const Interval t = edge.domain();
  if (!(t.width() < kInfinity)) throw FieldError("edge", "the edge is unbounded", "give it a domain");
  const SurfaceProjector projector(of);
  constexpr int kTried = 8;
  for (int k = 0; k <= kTried; ++k) {
    const Vec3 p = edge.point(t.lo + t.width() * k / kTried);
    const SurfaceFootPoints found = projector.foot_points(p);
    const double distance = found.foot_points.empty() ? 0 : found.foot_points.front().distance;
    if (distance > kOn * bounds(edge).diameter())
      throw FieldError("edge",
                       fmt::format("the edge is {:.4g} from the second surface at [{:.4g}, {:.4g}, {:.4g}]", distance,
                                   p.x, p.y, p.z),
                       "it lies on the second surface");
  }
}

Contours meeting(const SurfacePtr& a, const SurfacePtr& b) {
  try {
    return intersect(a, b);
  } catch (const std::invalid_argument& error) {
    throw FieldError("of", error.what());
  }
}

// An unbounded plane has no image of the branch.
Start along_branch(const Contours& found, const std::array<SurfacePtr, 2>& of, const Fields& f) {
  const CurvePtr curve = chosen_branch(found.branches, f, "of");
  Start start{contour_approximation(curve), curve->period(), start_of(*curve), {}};
  for (const Contour& branch : found.branches)
    if (branch.curve == curve)
      for (size_t k = 0; k < 2; ++k)
        start.places[k] = k < branch.images.size() && branch.images[k] ? Vec2(branch.images[k]->point(start.t))
                                                                       : foot_point(curve->point(start.t), of[k]);
  return start;
}

// Where the surfaces meet; of a ball of constant radius between surfaces that do not, the way of its center, in which
// their offsets meet.
Start along_intersection(const BlendLaw& law, const Fields& f) {
  const Contours found = meeting(law.of[0], law.of[1]);
  if (found.coincident || !found.complete)
    throw FieldError("of", "the surfaces coincide in part, or nearly, and have no edge between them there",
                     "take surfaces that cross each other, or give a `guide`");
  if (!found.branches.empty()) return along_branch(found, law.of, f);
  if (law.kind == BlendKind::ball && law.sizes[0].is_constant() && law.sizes[1].is_constant()) {
    const auto moved = [&](int k) {
      return offset_surface(law.of[k], law.sides[k] * law.of[k]->normal_sign() * law.sizes[k](0.0));
    };
    const Contours centers = meeting(moved(0), moved(1));
    if (!centers.branches.empty()) return along_branch(centers, {moved(0), moved(1)}, f);
  }
  throw FieldError("of", "the surfaces do not meet, so that there is nothing to go along",
                   "give a `guide`, a curve beside which the blend runs");
}

}  // namespace

TypeDeclaration& blend_fields(TypeDeclaration& type) {
  type.field("of", references({Category::surface}).count(2, 2), "both surfaces")
      .field("sides", words({"front", "back"}).count(1, 2),
             "the sides of both surfaces between which the blend lies, or one word for both: the front is where the "
             "normal points",
             "front")
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
    law.sides[k] = law.of[k]->normal_sign() * ((k == 0 ? words.front() : words.back()) == "front" ? 1 : -1);
  }
  if (law.guide && f.has("guide"))
    throw FieldError("guide", "along an edge the edge itself is the guide", "leave it out");
  if (law.guide) check_edge(*law.guide, law.of[1]);
  const Start start = law.guide        ? along(law.guide, law.of)
                      : f.has("guide") ? along(f.curve("guide"), law.of)
                                       : along_intersection(law, f);
  law.guide = start.guide, law.period = start.period;
  return Contacts(std::move(law), start.t, start.places);
}

}  // namespace lekalo::geometry
