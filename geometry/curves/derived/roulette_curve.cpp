// Roulettes: the path of a point that one curve carries as it rolls along another without slipping (Grezdov,
// Filippenko 2010). With both curves f and m of a plane by their arc length s, the point p of the moving plane is at
//
//   r(s) = f(s) + R (p - m(s)),   R the rotation that turns m' to f':   R v = (m'.f') v + (n . (m' x f')) n x v
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/composition.h"
#include "geometry/curves/derived/corners.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

constexpr double kFlat = 1e-9;  // of the size
constexpr int kMaxTurns = 1000;

// A curve by its arc length, again and again if it is closed.
struct Track {
  CurvePtr curve;
  double length;

  template <class T>
  Triple<T> at(const T& s, int k) const {
    return curve_at(*curve, s - turns_before(s) * length, k);
  }

 private:
  static double middle(double s) { return s; }
  static double middle(const Interval& s) { return s.middle(); }
  template <class J>
  requires requires(const J& j) { j.c[0]; }
  static double middle(const J& s) { return middle(s.c[0]); }
  // An end belongs to the stretch on whose side it is asked for: rounding leaves it at the end.
  template <class T>
  double turns_before(const T& s) const {
    const double turns = middle(s) / length;
    return std::max(0.0, std::floor(turns - 1e-14 * (1 + turns)));
  }
};

struct Roulette {
  Track fixed, moving;
  Vec3 normal, point;

  template <class T>
  Triple<T> operator()(const T& s) const {
    const Triple<double> n = triple(normal);
    const Triple<T> f = fixed.at(s, 1), m = moving.at(s, 1), off = triple(point) - moving.at(s, 0);
    return fixed.at(s, 0) + dot(m, f) * off + dot(n, cross(m, f)) * cross(n, off);
  }
};

Track track_of(const CurvePtr& curve, const char* field, const Vec3& normal, bool passes_seam) {
  if (const auto corner = first_corner(*curve); corner && (passes_seam || *corner < curve->domain().hi))
    throw FieldError(
        field, fmt::format("the curve has a corner at t = {:.6g}: the rolling curve would turn about it", *corner),
        "round its corners");
  CurvePtr even;
  try {
    even = by_arc_length(curve);
  } catch (const FieldError& error) {
    throw FieldError(field, error.what(), error.hint);
  }
  const double length = even->domain().hi;
  constexpr int kTried = 64;
  for (int i = 0; i <= kTried; ++i)
    if (std::abs(glm::dot(normal, even->point(length * i / kTried) - even->point(0))) > kFlat * length)
      throw FieldError(field, "the curve does not lie in a plane across the normal", "give the normal of its plane");
  return {even, length};
}

void add_breaks(CurveProperties& properties, const Track& track) {
  const std::vector<double> once = properties_of(*track.curve).breaks;
  for (double begin = 0; begin < properties.domain.hi; begin += track.length)
    for (const double s : once) properties.breaks.push_back(begin + s);
}

CurveProperties properties_of_both(const Roulette& roulette, double length) {
  CurveProperties properties = properties_of(*roulette.fixed.curve, 1);
  add_operand(properties, *roulette.moving.curve, 1);
  properties.period = 0;
  properties.domain = {0, length};
  properties.breaks.clear();
  add_breaks(properties, roulette.fixed);
  add_breaks(properties, roulette.moving);
  std::sort(properties.breaks.begin(), properties.breaks.end());
  properties.breaks.erase(std::unique(properties.breaks.begin(), properties.breaks.end(),
                                      [&](double a, double b) { return b - a <= 1e-13 * length; }),
                          properties.breaks.end());
  cut_to(properties, {0, length});
  return properties;
}

}  // namespace

TypeDeclaration roulette_curve_type() {
  return declare(Category::curve, "roulette_curve",
                 "The path of a point that a curve carries as it rolls along another without slipping. The parameter "
                 "is the length rolled.")
      .example("base: round, of: { type: circle, radius: 0.25 }")
      .field("base", reference({Category::curve}), "the curve that rests")
      .field("of", reference({Category::curve}),
             "the curve that rolls; it begins with its start on the other's start, and both tangents agree")
      .optional("point", point(), "that is carried along, in the place of `of` as it is given; its start when left out")
      .field("backward", boolean(),
             "run through the rolling curve against its direction: a closed one rolls on the other side then", "false")
      .field("turns", number().positive(), "how often a closed curve that rests is gone around", "1")
      .field("normal", direction(), "of the plane", "z")
      .built_by([](const Fields& f) {
        const CurvePtr on = f.curve("base"), of = f.curve("of");
        const Vec3 normal = f.vec3("normal");
        const CurvePtr rolling = f.boolean("backward") ? reversed_curve(of) : of;
        const double turns = f.number("turns");
        Roulette roulette{track_of(on, "base", normal, turns > 1), track_of(rolling, "of", normal, true), normal,
                          Vec3(0)};
        roulette.point = f.has("point") ? f.vec3("point") : rolling->point(rolling->domain().lo);
        if (turns > 1 && !on->is_closed()) throw FieldError("turns", "the curve that rests is not closed");
        if (turns > kMaxTurns) throw FieldError("turns", fmt::format("there are at most {} turns", kMaxTurns));
        const double length = turns * roulette.fixed.length;
        if (!of->is_closed() && length > roulette.moving.length * (1 + 1e-9))
          throw FieldError("of",
                           fmt::format("the rolling curve is shorter, {:.6g}, than what it is to roll along, {:.6g}",
                                       roulette.moving.length, length),
                           "make it longer, or trim the other");
        CurveProperties properties = properties_of_both(roulette, length);
        return std::any(CurvePtr(std::make_shared<ComposedCurve<Roulette>>(std::move(roulette), properties)));
      });
}

}  // namespace lekalo::geometry
