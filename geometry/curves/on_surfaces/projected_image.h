// The projection of a curve on a surface as a curve in the parameter plane (Golovanov 2016, 4.6; capability 4.6d).
//
// With w = c(t) - S(u, v) the parameters obey
//
//   w . S_u = w . S_v = 0      along normals: S(u, v) is a foot point of c(t)
//   w . a = w . b = 0          along a direction, a and b two vectors across it
//
// They are solved by Newton's iteration where the curve is evaluated, from a stored polynomial; the Taylor series of
// the equations gives the derivatives, Krawczyk's operator about the polynomial the enclosures.
#pragma once

#include <optional>

#include "geometry/curves/splines/polynomial_curve.h"
#include "geometry/numerics/jet.h"
#include "geometry/numerics/triple.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// The equations for one curve and surface.
class ProjectionEquations {
 public:
  // `direction` of unit length, or none: along normals.
  ProjectionEquations(CurvePtr curve, SurfacePtr surface, std::optional<Vec3> direction);

  const Curve& curve() const { return *curve_; }
  const Surface& surface() const { return *surface_; }
  bool is_along_normals() const { return !direction_; }
  // By which distances are judged.
  double size() const { return size_; }

  // The solution at t near to a place; none where Newton's iteration does not converge or its matrix is singular.
  std::optional<Vec2> solve(double t, const Vec2& start) const;

  static constexpr int kOrder = kMaxSurfaceOrder;
  // Of u and v as functions of t. Along normals derivatives above the third are not known: the equations contain those
  // of the surface up to one order more.
  int highest_order() const { return is_along_normals() ? kOrder - 1 : kOrder; }
  // Taylor polynomials of u and v about t where the solution is known.
  std::array<Jet<double, kOrder>, 2> series(double t, const Vec2& solution, int order) const;
  // Along normals: the foot point is a minimum of the distance.
  bool is_nearest(double t, const Vec2& solution) const;

  struct Ranges {
    std::array<std::array<Interval, 3>, 2> x;  // [parameter][derivative]
  };
  // Certified to hold the solution that `about` approaches for all t, and its derivatives (up to `order`); none where
  // the interval is too long for that. The second derivative of foot points needs third derivatives of the surface:
  // where it does not enclose these, they are taken from nine places, with as much again around.
  std::optional<Ranges> enclose(const PolynomialCurve::Part& about, const Interval& t, int order) const;

 private:
  template <class S>
  using Matrix = std::array<std::array<S, 2>, 2>;
  template <class S, class Derivatives>
  Matrix<S> matrix(const Derivatives& surface, const Triple<S>& curve) const;
  template <class S, int N, class Derivatives>
  std::array<Jet<S, N>, 2> residual(const Derivatives& surface, const Triple<Jet<S, N>>& curve,
                                    const std::array<Jet<S, N>, 2>& x) const;
  SurfaceEnclosure surface_over(const std::array<Interval, 2>& x, int order) const;

  CurvePtr curve_;
  SurfacePtr surface_;
  std::optional<Vec3> direction_;
  Vec3 across_[2]{Vec3(0), Vec3(0)};
  double size_ = 1;
};

class ProjectedImage final : public Curve {
 public:
  // `starts`: polynomials that are near to the solution, over the image's domain.
  ProjectedImage(std::shared_ptr<const ProjectionEquations> equations, PolynomialCurve starts);

  Interval domain() const override { return starts_.domain(); }
  double period() const override { return period_; }
  // Derivatives up to the fourth along a direction, the third along normals; throws std::invalid_argument beyond.
  CurveJet evaluate(double t, int order) const override;
  int max_order() const override { return equations_->highest_order(); }
  CurveEnclosure enclose(const Interval& t, int order) const override;
  std::vector<CurvePiece> pieces() const override { return starts_.pieces(); }

 private:
  void enclose_part(const PolynomialCurve::Part& part, const Interval& t, int order, int depth,
                    CurveEnclosure& result) const;

  std::shared_ptr<const ProjectionEquations> equations_;
  PolynomialCurve starts_;
  double period_ = 0;
};

}  // namespace lekalo::geometry
