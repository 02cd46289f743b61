#pragma once

#include "geometry/surfaces/analytic/meridian_surface.h"

namespace lekalo::geometry {

// r(u, v) = o + a v cos u x + b v sin u y + v^2 z; x^2/a^2 + y^2/b^2 = z. a, b are the semi-axes of the section z = 1
// (their unit is the root of a length). u in radians, v >= 0; the normal points to the convex side, downward at the
// vertex v = 0.
class EllipticParaboloid final : public MeridianFormula<EllipticParaboloid> {
 public:
  static constexpr Rectangle kUnbounded{{0, kTwoPi}, {0, kInfinity}};

  // a, b > 0, v >= 0; throws std::invalid_argument.
  EllipticParaboloid(const Frame& frame, double a, double b, const Rectangle& domain);
  Vec2 semi_axes() const { return {a_, b_}; }

  Sides convex_sides(double, double) const override { return {.front = true, .back = false}; }
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override;

  template <class T>
  MeridianPoint<T> meridian_at(const T& v) const {
    return {v, sqr(v)};
  }

 private:
  NurbsCurveForm meridian_form() const override;
};

// r(u, v) = o + a u x + b v y + (u^2 - v^2) z; x^2/a^2 - y^2/b^2 = z. The normal points upward (along z at the origin).
class HyperbolicParaboloid final : public Surface {
 public:
  static constexpr Rectangle kUnbounded{{-kInfinity, kInfinity}, {-kInfinity, kInfinity}};

  // a, b > 0; throws std::invalid_argument.
  HyperbolicParaboloid(const Frame& frame, double a, double b, const Rectangle& domain);
  const Frame& frame() const { return frame_; }
  Vec2 semi_axes() const { return {a_, b_}; }

  Rectangle domain() const override { return domain_; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  std::optional<NurbsSurfaceForm> as_nurbs() const override;
  bool bounded() const override;
  bool has_line_formula() const override { return true; }
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override { meet_line(line, t, hits); }

 private:
  void meet_line(const Line& line, const Interval& t, LineHits& hits) const;
  template <class T>
  Triple<T> at(const T& u, const T& v) const;
  Frame frame_;
  double a_, b_;
  Rectangle domain_;
};

}  // namespace lekalo::geometry
