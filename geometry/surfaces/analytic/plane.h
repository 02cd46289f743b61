#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// r(u, v) = o + u x + v y in a frame (o; x, y, z): lengths along x and y; the normal is z.
class Plane final : public Surface {
 public:
  static constexpr Rectangle kUnbounded{{-kInfinity, kInfinity}, {-kInfinity, kInfinity}};

  explicit Plane(const Frame& frame, const Rectangle& domain = kUnbounded);
  const Frame& frame() const { return frame_; }

  Rectangle domain() const override { return domain_; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  int enclosure_order() const override { return kMaxSurfaceOrder; }
  Vec3 normal(double, double) const override { return normal_sign() * frame_.z; }
  Vec3 normal(double, double, const SurfaceJet&) const override { return normal_sign() * frame_.z; }
  std::optional<NurbsSurfaceForm> as_nurbs() const override;
  bool bounded() const override;
  bool is_whole() const { return whole_; }
  bool has_closest_point() const override { return true; }
  FootPoint foot_point(const Vec3& near) const override;
  Sides convex_sides(double, double) const override { return {true, true}; }
  bool has_line_formula() const override { return true; }
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override { meet_line(line, t, hits); }

 private:
  void meet_line(const Line& line, const Interval& t, LineHits& hits) const;
  void add_beside(double t, const Vec2& at, const Vec2& lean, double from_origin, LineHits& hits) const;
  Frame frame_;
  Rectangle domain_;
  bool whole_;       // unbounded in all directions
  double distance_;  // a bound on that of the origin
};

}  // namespace lekalo::geometry
