// Offset (equidistant) curves (Golovanov 2016, 2.15.5):
//
//   r(t) = c(t) + d n x c'/|c'|
//
// in a plane with the normal n, to the left of the curve as seen against it; in space c(t) + d w(t), w a direction
// across the curve (moving_frame.h). In a plane r' = (1 - k d) c', k the signed curvature: the offset has cusps where k
// d = 1 and runs backward where k d > 1. These loops meet the rest of the offset, and all of them is nearer to the
// curve than d.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/composition.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/moving_frame.h"
#include "geometry/describe.h"
#include "geometry/expression/scalar_law.h"
#include "geometry/no_longer.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/intersections/self_intersections.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

struct InPlane {
  CurvePtr of;
  Vec3 normal;
  ScalarLaw distance;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const Triple<T> along = curve_at(*of, t, 1);
    const T reach = distance(t);
    return curve_at(*of, t) + no_longer((reach / length(along)) * cross(triple(normal), along), reach);
  }
};

struct Across {
  CurvePtr of;
  std::shared_ptr<const PolynomialCurve> direction;
  ScalarLaw distance;

  template <class T>
  Triple<T> operator()(const T& t) const {
    return curve_at(*of, t) + distance(t) * curve_at(*direction, t);
  }
};

// Points of the offset are nearer than its distance by no more than this part of it.
constexpr double kNearer = 1e-7;

// The parts of a plane offset at constant distance that are not nearer to the curve, joined where they meet.
CurvePtr without_loops(const CurvePtr& offset, const Curve& curve, double distance) {
  const Interval domain = offset->domain();
  std::vector<double> ends{domain.lo, domain.hi};
  for (const CurveSelfIntersection& one : self_intersections(*offset).points) {
    ends.push_back(one.s);
    ends.push_back(one.t);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<CurvePtr> parts;
  bool joined = false;
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    const Interval t(ends[i], ends[i + 1]);
    const Vec3 point = offset->point(t.middle());
    const bool is_kept = project(point, curve).foot_points.front().distance >= (1 - kNearer) * std::abs(distance);
    if (!is_kept) {
      joined = false;
      continue;
    }
    const double from = joined ? parts.back()->domain().lo : t.lo;
    if (joined) parts.pop_back();
    parts.push_back(std::make_shared<CurvePart>(offset, Interval(from, t.hi)));
    joined = true;
  }
  if (parts.empty())
    throw FieldError("distance", "nothing is left of the offset: it is nearer to the curve everywhere",
                     "take a smaller distance, or loops: keep");
  if (parts.size() == 1 && parts.front()->domain() == domain) return offset;
  const bool closed = glm::length(parts.front()->point(parts.front()->domain().lo) -
                                  parts.back()->point(parts.back()->domain().hi)) <= 1e-7 * bounds(*offset).diameter();
  try {
    return std::make_shared<CompositeCurve>(std::move(parts), closed, 1e-7);
  } catch (const FieldError&) {
    throw FieldError("loops", "without its loops the offset falls apart into several curves",
                     "offset parts of the curve, or loops: keep");
  }
}

void check_speed(const Curve& curve) {
  const Interval domain = curve.domain();
  constexpr int kTried = 64;
  for (int i = 0; i <= kTried; ++i) {
    const double t = domain.lo + domain.width() * i / kTried;
    if (!(glm::length(curve.evaluate(t, 1).d[1]) > 0))
      throw FieldError("of", fmt::format("the curve rests at t = {:.6g}: there is no direction across it", t));
  }
}

}  // namespace

TypeDeclaration offset_curve_type() {
  return declare(Category::curve, "offset_curve",
                 "Curve at a distance from another: in a plane to its left as seen against the normal, or across it in "
                 "space. The parameter is the curve's.")
      .example("of: round, distance: 0.5")
      .field("of", reference({Category::curve}), "the curve")
      .field("distance", formula({"t"}), "to the left if positive; a number, or a formula of the curve's parameter")
      .field("normal", direction(), "of the plane, towards the viewer", "z")
      .optional("across", direction().or_word({"rotation_minimizing", "normal", "binormal"}),
                "in place of a plane: direction across the curve, as of ribbons")
      .field("loops", choice({"keep", "cut"}),
             "what is nearer to the curve than the distance: beyond the cusps where the radius of curvature is less",
             "keep")
      .built_by([](const Fields& f) {
        const CurvePtr of = f.curve("of");
        const ScalarLaw distance(f.get<Expression>("distance"));
        if (!(of->domain().width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a domain");
        check_speed(*of);
        if (f.has("across")) {
          if (f.given("normal") || f.given("loops"))
            throw FieldError("across", "across the curve in space there is no plane", "leave out 'normal' and 'loops'");
          const auto direction = direction_across(*of, read_frame_law(f));
          CurveProperties properties = properties_of(*of);
          add_operand(properties, *direction);
          return std::any(
              CurvePtr(std::make_shared<ComposedCurve<Across>>(Across{of, direction, distance}, properties)));
        }
        const CurvePtr offset =
            std::make_shared<ComposedCurve<InPlane>>(InPlane{of, f.vec3("normal"), distance}, properties_of(*of, 1));
        if (f.text("loops") == "keep") return std::any(offset);
        if (!distance.is_constant())
          throw FieldError("loops", "loops are cut of offsets at one distance", "give the distance as a number");
        return std::any(without_loops(offset, *of, distance(0.0)));
      });
}

}  // namespace lekalo::geometry
