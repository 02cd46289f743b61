// Contours along which surfaces touch: the equations of a contour lose their rank there, those of contact do not
// (Patrikalakis, Maekawa 2002, 5.3; Golovanov 2016, 4.7).
//
// Where r(u, v) = s(a, b) and the normals agree, n = r_u x r_v is across s_a and s_b too; where a section's plane
// touches the surface, the height's derivatives vanish with it. That are N + 1 equations for N unknowns, of rank N - 1
// along a curve of contact: the search follows it as their solution by least squares. N of them would be too many for a
// contour that solves its equations again where it is evaluated, so that each of its segments takes those N - 1
// combinations that change most there.
#pragma once

#include "geometry/queries/contours/contour_equations.h"

namespace lekalo::geometry {

// Immutable; safe to use from many threads.
template <int N>
class TouchingEquations {
 public:
  static constexpr int kEquations = N + 1;
  virtual ~TouchingEquations() = default;

  // The contour's own equations, then those of contact; all are lengths.
  virtual SystemValue<Interval, N, N + 1> enclose(const ParameterBox<N>& box) const = 0;
  // Beyond the borders of the piece it goes on as there, linearly.
  SystemValue<double, N, N + 1> evaluate(const ParameterPoint<N>& place) const;
  // As ContourEquations::series, of all equations.
  virtual ContourSeries<double, kMaxContourOrder, N, N + 1> series(
      const std::array<Jet<double, kMaxContourOrder>, N>& x) const = 0;
  virtual ContourSeries<Interval, 2, N, N + 1> series(const std::array<Jet<Interval, 2>, N>& x) const = 0;
  const ContourEquations<N>& contour() const { return *contour_; }
  std::shared_ptr<const ContourEquations<N>> shared_contour() const { return contour_; }
  // Whether the surfaces coincide at the point of the first that is next to `target`, beyond the borders of the pieces
  // too; to the tolerance, a length.
  virtual bool coincide_at(const Vec3& target, double tolerance) const = 0;

 protected:
  explicit TouchingEquations(std::shared_ptr<const ContourEquations<N>> contour) : contour_(std::move(contour)) {}
  virtual SystemValue<double, N, N + 1> evaluate_inside(const ParameterPoint<N>& place) const = 0;

 private:
  const std::shared_ptr<const ContourEquations<N>> contour_;
};

// Of two surfaces.
std::unique_ptr<TouchingEquations<4>> surfaces_touching(std::shared_ptr<const ContourEquations<4>> intersection,
                                                        SurfacePtr r, const Rectangle& piece_r, SurfacePtr s,
                                                        const Rectangle& piece_s);
// Of a surface and a plane with the unit normal.
std::unique_ptr<TouchingEquations<2>> plane_touching(std::shared_ptr<const ContourEquations<2>> section,
                                                     SurfacePtr surface, const Rectangle& piece, const Vec3& normal);

// Where surfaces coincide: the border of a piece, one of the parameters at its end, as far as it lies on the other
// surface.
template <int N>
std::unique_ptr<TouchingEquations<N>> border_of(std::shared_ptr<const TouchingEquations<N>> touching, int parameter,
                                                bool at_upper_end);

// The N - 1 combinations of the equations that change most at a place. Derivatives of the contour are known to the
// third order.
template <int N>
std::shared_ptr<const ContourEquations<N>> strongest_at(std::shared_ptr<const TouchingEquations<N>> touching,
                                                        const ParameterPoint<N>& place);

}  // namespace lekalo::geometry
