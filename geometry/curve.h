// What every curve is: a smooth map from a parameter interval to space (Golovanov 2016, 2.1).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/numerics/interval.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

inline constexpr int kMaxCurveOrder = 6;
inline constexpr int kMaxCurveEnclosureOrder = 4;

// Point and derivatives r, r', r'', ... at one parameter; d[0..order] are set.
struct CurveJet {
  int order = 0;
  std::array<Vec3, kMaxCurveOrder + 1> d{};
  const Vec3& point() const { return d[0]; }
  const Vec3& derivative(int k) const { return d[k]; }
};

// Boxes that contain r, r', r'', ... for every parameter of an interval; d[0..order] are set.
struct CurveEnclosure {
  std::array<Box3, kMaxCurveEnclosureOrder + 1> d{};
};

// Monotone map between the parameter of a rational piece and the curve's own parameter. Both run from lo to hi; they
// differ where a transcendental parametrisation has an exact rational form.
//   affine      t = s
//   half_angle  tan((t - m)/2)  = tan(d/4) (2q - 1), q = (s - lo)/(hi - lo), m the middle, d = hi - lo: conic arcs
//   hyperbolic  tanh((t - m)/2) = tanh(d/4) (2q - 1): hyperbolas                 (Golovanov 2016, 2.5)
//
// A Bezier piece may be cut from the middle of the map's interval: it then covers q in [from, to] only, and its own
// parameter x in [0, 1] is q = from + x (to - from). An affine map is never cut so; it gets a smaller interval.
struct ParameterMap {
  enum class Kind { affine, half_angle, hyperbolic };
  Kind kind = Kind::affine;
  double lo = 0;
  double hi = 1;
  double from = 0;
  double to = 1;

  double natural(double s) const;     // t
  double rational(double t) const;    // s
  double derivative(double s) const;  // dt/ds

  // The same for the Bezier piece's parameter x in [0, 1].
  double natural_of_bezier(double x) const;
  double bezier(double t) const;
  double derivative_of_bezier(double x) const;  // dt/dx

  // The map of the piece cut to the natural parameters [t0, t1].
  ParameterMap cut(double t0, double t1) const;
};

// A smooth part of a curve. Where `points` is not empty it is exactly the rational Bezier curve with these homogeneous
// control points, x = map.bezier(t) being its parameter; `domain` is the part in the curve's own parameter.
struct CurvePiece {
  Interval domain;
  ParameterMap map;
  std::vector<Vec4> points;  // degree + 1
  bool is_rational() const { return !points.empty(); }
  int degree() const { return static_cast<int>(points.size()) - 1; }
};

// An exact NURBS form: knots are in the curve's own parameter at every distinct knot; between knots `maps` (one per
// non-empty span of the form's domain, in order; none at all where every span is affine) tell the two parameters apart.
// The form covers at least the curve's domain.
struct NurbsCurveForm {
  int degree = 1;
  std::vector<double> knots;
  std::vector<Vec4> points;  // homogeneous; knots.size() - degree - 1
  std::vector<ParameterMap> maps;
  Interval domain() const { return {knots[degree], knots[knots.size() - 1 - degree]}; }
};

// A parametric curve r(t). Immutable; safe to use from many threads.
// Outside the domain a periodic curve wraps, an analytic one continues, any other continues along its end tangent
// (Golovanov 2016, 2.15).
class Curve {
 public:
  virtual ~Curve() = default;

  virtual Interval domain() const = 0;
  // Smallest p > 0 with r(t + p) = r(t); 0 where the curve is not periodic.
  virtual double period() const { return 0; }
  // True when the end points coincide to kClosedCurve of the curve's box (a periodic curve over less than its period is
  // not closed).
  virtual bool is_closed() const;

  // Point and derivatives up to `order` (0..kMaxCurveOrder) in closed form or by jets, never by differences; those
  // beyond max_order() are NaN. At a break in smoothness the derivatives are those from the right (from the left at the
  // domain's end).
  virtual CurveJet evaluate(double t, int order) const = 0;
  // Less than kMaxCurveOrder of a curve that is made of the derivatives of another.
  virtual int max_order() const { return kMaxCurveOrder; }
  virtual void evaluate_many(std::span<const double> t, int order, std::span<CurveJet> result) const;
  // Where the first derivatives are those of a fit to the points: how far it was seen to be from them, a length. 0
  // where they are the points' own.
  virtual double fit_distance() const { return 0; }

  // Certified enclosure of the point and derivatives up to `order` (0..enclosure_order()) over an interval inside the
  // domain. At a break in smoothness that is the interval's upper end the derivatives from the left count.
  virtual CurveEnclosure enclose(const Interval& t, int order) const = 0;
  // 2, or up to kMaxCurveEnclosureOrder of a curve that encloses more derivatives.
  virtual int enclosure_order() const { return 2; }

  // The smooth pieces in order of the parameter, covering the domain without gaps.
  virtual std::vector<CurvePiece> pieces() const;
  virtual std::optional<NurbsCurveForm> as_nurbs() const { return std::nullopt; }
  // The same curve over a wider domain by its own law, where it has one that goes on there; else null.
  virtual std::shared_ptr<const Curve> continued(const Interval& /*domain*/) const { return nullptr; }

  Vec3 point(double t) const { return evaluate(t, 0).d[0]; }
};

using CurvePtr = std::shared_ptr<const Curve>;

// A box around the whole curve from its enclosures or control points (exact to the convex hull, not to the curve).
Box3 bounds(const Curve& curve);

// Box of the convex hull of homogeneous control points, a few rounding errors wider; false unless all weights are
// positive (then the hull bounds nothing).
bool control_point_box(std::span<const Vec4> points, Box3& box);

// A curve in a parameter plane: a curve whose third coordinate is zero. (u, v) = (x, y).
using Curve2Ptr = CurvePtr;

// Splits the part of a NURBS form over `domain` (inside the form's domain) into its rational Bezier pieces, one for
// each non-empty span, cut where the domain ends inside a span (knot insertion, Golovanov 2016, 2.11), and on until all
// weights of a piece are positive, as they are sooner or later where the denominator is. Neighbours share their end
// points bit for bit. Clamped or not, any multiplicity; a knot of multiplicity degree + 1 is a break.
std::vector<CurvePiece> bezier_pieces(const NurbsCurveForm& form, const Interval& domain);

}  // namespace lekalo::geometry
