// Curves that a plane curve c(t) makes by its tangents and normals (Grezdov, Filippenko 2010), n the plane's normal:
//
//   evolute    c + n x c' |c'|^2 / (n . (c' x c''))     the centers of curvature; infinite at inflections
//   involute   c - (s - s_0) c'/|c'|                    the end of a thread that is unwound from s_0 on
//   pedal      c + c' ((o - c) . c') / |c'|^2           the feet of perpendiculars from a pole o to the tangents
//   conchoid   c + l (c - o) / |c - o|                  longer by l as seen from the pole o
//
// The evolute has cusps where the curvature has extrema, the involute one at s_0; its evolute is the curve again.
#include <fmt/format.h>

#include <cmath>

#include "geometry/composition.h"
#include "geometry/curves/derived/corners.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/describe.h"
#include "geometry/no_longer.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

constexpr int kTried = 512;
constexpr double kStill = 1e-12;  // of the size: no distance, no speed

struct Evolute {
  CurvePtr of;
  Vec3 normal;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const Triple<double> n = triple(normal);
    const Triple<T> first = curve_at(*of, t, 1), second = curve_at(*of, t, 2);
    return curve_at(*of, t) + (dot(first, first) / dot(n, cross(first, second))) * cross(n, first);
  }
};

// `of` by its arc length.
struct Involute {
  CurvePtr of;
  double start;

  template <class T>
  Triple<T> operator()(const T& s) const {
    return curve_at(*of, s) - (s - start) * curve_at(*of, s, 1);
  }
};

struct Pedal {
  CurvePtr of;
  Vec3 pole;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const Triple<T> point = curve_at(*of, t), along = curve_at(*of, t, 1);
    return point + (dot(triple(pole) - point, along) / dot(along, along)) * along;
  }
};

struct Conchoid {
  CurvePtr of;
  Vec3 pole;
  double distance;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const Triple<T> off = curve_at(*of, t) - triple(pole);
    return curve_at(*of, t) + no_longer((distance / length(off)) * off, T(distance));
  }
};

template <class Visit>
void try_all(const Curve& curve, int order, const Visit& visit) {
  const Interval domain = curve.domain();
  if (!(domain.width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a domain");
  for (int i = 0; i <= kTried; ++i) {
    const double t = i == kTried ? domain.hi : domain.lo + domain.width() * i / kTried;
    visit(t, curve.evaluate(t, order));
  }
}

void demand_speed(const Curve& curve) {
  const double size = bounds(curve).diameter();
  try_all(curve, 1, [&](double t, const CurveJet& jet) {
    if (!(glm::length(jet.d[1]) * curve.domain().width() > kStill * size))
      throw FieldError("of", fmt::format("the curve rests at t = {:.6g}: it has no tangent there", t),
                       "take a part of it by trimmed_curve");
  });
}

void demand_curvature(const Curve& curve, const Vec3& normal) {
  double before = 0;
  try_all(curve, 2, [&](double t, const CurveJet& jet) {
    const double bend = glm::dot(normal, glm::cross(jet.d[1], jet.d[2])),
                 all = glm::length(jet.d[1]) * glm::length(jet.d[2]);
    if (!(std::abs(bend) > kStill * all) || bend * before < 0)
      throw FieldError("of", fmt::format("the curve is straight near t = {:.6g}: its evolute is infinite there", t),
                       "take a part between its inflections by trimmed_curve");
    before = bend;
  });
}

void demand_distance(const Curve& curve, const Vec3& pole) {
  const double size = bounds(curve).diameter();
  try_all(curve, 0, [&](double t, const CurveJet& jet) {
    if (!(glm::length(jet.d[0] - pole) > kStill * size))
      throw FieldError("pole", fmt::format("the curve passes through the pole, at t = {:.6g}", t),
                       "move the pole, or take a part of the curve by trimmed_curve");
  });
}

void demand_size(const Curve& curve, double size, const char* field, const char* message) {
  Box3 box;
  try_all(curve, 0, [&](double, const CurveJet& jet) { box.include(jet.d[0]); });
  if (!(box.diameter() > kStill * size)) throw FieldError(field, message);
}

template <class Formula>
CurvePtr made(Formula formula, int derivatives) {
  const CurveProperties properties = properties_of(*formula.of, derivatives);
  return std::make_shared<ComposedCurve<Formula>>(std::move(formula), properties);
}

}  // namespace

TypeDeclaration evolute_curve_type() {
  return declare(Category::curve, "evolute_curve",
                 "The centers of curvature of a plane curve, over the curve's parameter.")
      .example("of: { type: ellipse, semi_axes: [2, 1] }")
      .field("of", reference({Category::curve}), "the curve, without inflections")
      .field("normal", direction(), "of its plane", "z")
      .built_by([](const Fields& f) {
        demand_speed(*f.curve("of"));
        demand_curvature(*f.curve("of"), f.vec3("normal"));
        const CurvePtr evolute = made(Evolute{f.curve("of"), f.vec3("normal")}, 2);
        demand_size(*evolute, bounds(*f.curve("of")).diameter(), "of", "the evolute of a circle is a point");
        return std::any(evolute);
      });
}

TypeDeclaration involute_curve_type() {
  return declare(Category::curve, "involute_curve",
                 "The end of a taut thread that is unwound from a curve; the parameter is the curve's arc length.")
      .example("of: round")
      .field("of", reference({Category::curve}), "the curve")
      .field("start", number(), "arc length on the curve where the thread has no length", "0")
      .built_by([](const Fields& f) {
        if (const auto corner = first_corner(*f.curve("of")); corner && *corner < f.curve("of")->domain().hi)
          throw FieldError("of",
                           fmt::format("the curve has a corner at t = {:.6g}: the thread would turn about it", *corner),
                           "round the corner, or take a part of the curve by trimmed_curve");
        // Past the end of a closed curve the thread is as long as it was: the involute is no closed curve.
        Involute involute{by_arc_length(f.curve("of")), f.number("start")};
        CurveProperties properties = properties_of(*involute.of, 1);
        properties.period = 0;
        return std::any(CurvePtr(std::make_shared<ComposedCurve<Involute>>(std::move(involute), properties)));
      });
}

TypeDeclaration pedal_curve_type() {
  return declare(Category::curve, "pedal_curve",
                 "The feet of the perpendiculars from a pole to the tangents of a curve, over the curve's parameter.")
      .example("of: round, pole: [1, 0]")
      .field("of", reference({Category::curve}), "the curve")
      .field("pole", point(), "where the perpendiculars come from", "[0, 0, 0]")
      .built_by([](const Fields& f) {
        demand_speed(*f.curve("of"));
        const CurvePtr pedal = made(Pedal{f.curve("of"), f.vec3("pole")}, 1);
        demand_size(*pedal, bounds(*f.curve("of")).diameter(), "of", "the pedal curve of a straight line is a point");
        return std::any(pedal);
      });
}

TypeDeclaration conchoid_curve_type() {
  return declare(Category::curve, "conchoid_curve",
                 "The points of a curve moved away from a pole by one distance, over the curve's parameter.")
      .example("of: round, pole: [3, 0], distance: 0.5")
      .field("of", reference({Category::curve}), "the curve; it does not pass through the pole")
      .field("pole", point(), "from where they are moved away", "[0, 0, 0]")
      .field("distance", length(), "by how much; towards the pole and beyond it where negative")
      .built_by([](const Fields& f) {
        demand_distance(*f.curve("of"), f.vec3("pole"));
        const CurvePtr conchoid = made(Conchoid{f.curve("of"), f.vec3("pole"), f.number("distance")}, 0);
        demand_size(*conchoid, bounds(*f.curve("of")).diameter(), "distance", "all points are moved to the pole");
        return std::any(conchoid);
      });
}

}  // namespace lekalo::geometry
