// What the surfaces with circular or elliptical parallels share: all of Golovanov 2016, 3.2, but the plane and the
// hyperbolic paraboloid.
#pragma once

#include "geometry/formula.h"
#include "geometry/surface.h"
#include "geometry/surfaces/analytic/local_line.h"
#include "geometry/surfaces/analytic/quadric_line.h"

namespace lekalo::geometry {

// A point of a meridian: distance from the axis (signed) and height along it.
template <class T>
struct MeridianPoint {
  T rho, z;
};

// Its derivatives by v: rho[k], z[k] for k = 0..order.
template <class T>
struct MeridianJet {
  std::array<T, kMaxSurfaceOrder + 1> rho{}, z{};
};

// The meridian (rho(v), z(v)) turned about the axis z of a frame, the parallels stretched by a and b:
//
//   r(u, v) = o + a rho(v) cos u x + b rho(v) sin u y + z(v) z,   u in radians.
//
// r_u x r_v = rho (b z' cos u, a z' sin u, -a b rho'): away from the axis where rho > 0 and z' > 0. Where rho = 0
// (pole, apex) the normal is the limit from inside the domain.
class MeridianSurface : public Surface {
 public:
  const Frame& frame() const { return frame_; }

  Rectangle domain() const override { return domain_; }
  Periods periods() const override { return {kTwoPi, 0}; }
  SurfaceJet evaluate(double u, double v, int order) const override;
  SurfaceJet evaluate_near(const Vec3& near, double u, double v, int order) const override;
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override;
  Vec3 normal(double u, double v) const override;
  std::optional<NurbsSurfaceForm> as_nurbs() const override;
  DegenerateEdges degenerate_edges() const override;
  bool bounded() const override { return domain_.v.lo > -kInfinity && domain_.v.hi < kInfinity; }
  bool has_line_formula() const override { return true; }
  bool has_closest_point() const override { return has_closest_point_; }
  FootPoint foot_point(const Vec3& near) const override;

 protected:
  MeridianSurface(const Frame& frame, double a, double b, const Rectangle& domain)
      : frame_(frame), a_(a), b_(b), domain_(domain), upright_(frame.x == Vec3(1, 0, 0) && frame.y == Vec3(0, 1, 0)) {}

  // The line about its point nearest to `center` (in world coordinates), in the coordinates of the frame.
  MovedLine local_line(const Line& line, const Vec3& center) const {
    return upright_ ? moved_near(line, center).shifted(frame_.origin) : moved_near(line, center, frame_);
  }

  virtual MeridianJet<double> meridian(double v, int order) const = 0;
  virtual MeridianJet<Interval> meridian(const Interval& v, int order) const = 0;
  // The meridian and its first derivative where its point is known to lie at `near`, rho >= 0, but for rounding.
  struct MeridianTangent {
    double rho, z, rho_v, z_v;
  };
  virtual MeridianTangent meridian_near(const MeridianPoint<double>& /*near*/, double v) const {
    const MeridianJet<double> m = meridian(v, 1);
    return {m.rho[0], m.z[0], m.rho[1], m.z[1]};
  }
  // (rho, z) as x and y, over domain().v, which is bounded.
  virtual NurbsCurveForm meridian_form() const = 0;

  // Adds the hit at angle u (of atan2) and v if both lie in the domain.
  void add_hit(LineHits& hits, const Line& line, double t, double u, double v) const;

  // For constructors, once meridian() can be asked: the surface is a part of this quadric, whose coordinates are those
  // of the frame times `scale`, and the height z tells which part. So it knows its foot points if it goes all round.
  void set_quadric(const Quadric& quadric, const Vec3& scale);

  // Adds the hits of a line with that quadric. `parameter` is v of a scaled point on it, or nothing where the point
  // belongs to another sheet.
  void add_quadric_hits(const Line& line, const Interval& range, LineHits& hits,
                        std::optional<double> (*parameter)(const Vec3&)) const;

  // What the height alone, in scaled coordinates, tells of a hit on a surface that knows its foot points.
  enum class Place { inside, outside, at_border };
  Place place_by_height(double z) const {
    if (inside_.contains(z)) return Place::inside;
    return around_.contains(z) ? Place::at_border : Place::outside;
  }

  // True if the hits need no parameters: they are not wanted, and none would lie outside the domain.
  bool needs_no_parameters(const LineHits& hits) const { return whole_ && !hits.wants_parameters(); }

  Frame frame_;
  double a_, b_;  // stretch of the parallels along x and y
  Rectangle domain_;
  bool whole_ = false;  // a closed surface, all of it
  bool has_closest_point_ = false;
  Vec3 scale_{1};  // of set_quadric

 private:
  Quadric quadric_;
  double side_ = 1;  // -1: where r_u x r_v points the quadric falls
  // Scaled heights at which a hit certainly lies in the domain, and outside of which it certainly does not.
  Interval inside_, around_;
  bool is_pole(double v) const;
  // Half the quadric's gradient in the frame, at a scaled point.
  Vec3 half_gradient(const Vec3& p) const {
    return scale_ * (quadric_.squares * p + Vec3(0, 0, 0.5 * quadric_.linear_z));
  }
  Vec3 direction(const Vec3& local) const { return upright_ ? local : frame_.direction(local); }
  bool upright_;  // the frame's axes are the world's
};

// Supplies the meridian and its derivatives from a formula over any number type,
//   template <class T> MeridianPoint<T> meridian_at(const T& v) const;   a public member of Shape.
template <class Shape>
class MeridianFormula : public MeridianSurface {
 protected:
  using MeridianSurface::MeridianSurface;

  int enclosure_order() const override { return kMaxSurfaceOrder; }
  MeridianJet<double> meridian(double v, int order) const override {
    MeridianJet<double> jet;
    switch (order) {
      case 0: {
        const auto p = shape().meridian_at(v);
        jet.rho[0] = p.rho;
        jet.z[0] = p.z;
        return jet;
      }
      case 1:
        return derivatives<1>(v);
      case 2:
        return derivatives<2>(v);
      default:
        return derivatives<kMaxSurfaceOrder>(v);
    }
  }
  MeridianJet<Interval> meridian(const Interval& v, int order) const override {
    switch (order) {
      case 0:
        return derivatives<0>(v);
      case 1:
        return derivatives<1>(v);
      case 2:
        return derivatives<2>(v);
      default:
        return derivatives<kMaxSurfaceOrder>(v);
    }
  }

 private:
  const Shape& shape() const { return static_cast<const Shape&>(*this); }
  template <int N, class T>
  MeridianJet<T> derivatives(const T& v) const {
    const auto p = shape().meridian_at(Jet<T, N>::variable(v));
    MeridianJet<T> jet;
    for (int k = 0; k <= N; ++k) {
      jet.rho[k] = p.rho.derivative(k);
      jet.z[k] = p.z.derivative(k);
    }
    return jet;
  }
};

}  // namespace lekalo::geometry
