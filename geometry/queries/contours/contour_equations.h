// Equations whose solutions are curves on surfaces: where two surfaces meet, r(u, v) = s(a, b) (Golovanov 2016,
// (4.7.2)), and where a function of one surface's point and tangents vanishes: silhouettes (4.6.5), isophotes,
// reflection lines, sections. N unknowns, N - 1 equations; geometry/queries/contours finds the curves.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>

#include "geometry/numerics/root_search.h"
#include "geometry/surface_series.h"

namespace lekalo::geometry {

// Derivatives of contours are known to this order; a function of the tangents costs one.
inline constexpr int kMaxContourOrder = 4;

// Along the way x(t): the equations and the point in space.
template <class S, int K, int N, int M = N - 1>
struct ContourSeries {
  std::array<Jet<S, K>, M> equations;
  Triple<Jet<S, K>> point;
};

// What a search has asked for of one surface, to the first order: it halves the same rectangles again and again, with
// other rectangles of the other surface.
class KnownEnclosures {
 public:
  struct First {
    Box3 point, du, dv;
  };
  struct FirstOfMiddle {
    Vec3 point, du, dv;
  };
  KnownEnclosures() = default;
  KnownEnclosures(const KnownEnclosures&) = delete;
  KnownEnclosures& operator=(const KnownEnclosures&) = delete;

  const First& of(const Surface& surface, const Rectangle& box);
  const FirstOfMiddle& of_middle(const Surface& surface, const Rectangle& piece, const Rectangle& box);

 private:
  using Key = std::array<double, 4>;
  struct Hash {
    size_t operator()(const Key& key) const;
  };
  struct Entry {
    First first;
    FirstOfMiddle middle;
    bool knows_first = false, knows_middle = false;
  };
  Entry& entry(const Rectangle& box);

  std::unordered_map<Key, Entry, Hash> known_;
  std::pair<const Key, Entry>* last_ = nullptr;  // asked for
};

// A system at a place beyond its domain: as at the border, continued linearly.
template <int N, int M, class Evaluate>
SystemValue<double, N, M> continued(const ParameterBox<N>& domain, const ParameterPoint<N>& place,
                                    const Evaluate& evaluate) {
  ParameterPoint<N> inside;
  for (int i = 0; i < N; ++i) inside[i] = domain[i].clamp(place[i]);
  SystemValue<double, N, M> there = evaluate(inside);
  for (int i = 0; i < N; ++i)
    if (inside[i] != place[i])
      for (int k = 0; k < M; ++k) there.value[k] += there.derivative[k][i] * (place[i] - inside[i]);
  return there;
}

// Derivatives of a surface to the third order over a box of a piece. Surfaces that enclose only two have the third
// taken from places of the box, with as much again around it: that is not certified. It reaches the second derivative
// of contours alone.
SurfaceEnclosure enclosure_to_third(const Surface& surface, const Rectangle& piece, const Rectangle& box);

// Equations, point in space and how each parameter moves it.
template <int N>
struct ContourPlace {
  SystemValue<double, N, N - 1> equations;
  Vec3 point;
  std::array<Vec3, N> motion;
};

template <int N>
class TouchingEquations;

// Over one smooth piece of the surface, or of each of both. Immutable; safe to use from many threads.
template <int N>
class ContourEquations {
 public:
  virtual ~ContourEquations() = default;

  virtual ParameterBox<N> domain() const = 0;
  // A search brings what it knows of the first and the second surface.
  virtual SystemValue<Interval, N, N - 1> enclose(const ParameterBox<N>& box,
                                                  std::array<KnownEnclosures, 2>* known = nullptr) const = 0;
  // Beyond the borders of the piece it goes on as there, linearly.
  SystemValue<double, N, N - 1> evaluate(const ParameterPoint<N>& place) const;
  // In the middle of a box of the piece.
  virtual SystemValue<double, N, N - 1> evaluate_middle(const ParameterBox<N>& box,
                                                        std::array<KnownEnclosures, 2>& known) const;
  // How far each parameter moves a point in space over a box, at most.
  virtual std::array<double, N> extents(const ParameterBox<N>& box, std::array<KnownEnclosures, 2>& known) const = 0;
  // Whether the border of the piece at that side of a parameter is one point in space: a pole.
  virtual bool is_pole(int parameter, bool at_upper_end) const = 0;
  // Of the first surface; inside the piece.
  virtual Vec3 point(const ParameterPoint<N>& place) const = 0;
  virtual Vec3 motion(const ParameterPoint<N>& place, const ParameterPoint<N>& by) const = 0;
  // All of it at once.
  ContourPlace<N> at(const ParameterPoint<N>& place) const;
  // How far a place is from a solution, a length: the distance of the surfaces, or the Newton step.
  virtual double distance(const ParameterPoint<N>& place) const = 0;
  // The error of an equation's value by rounding.
  virtual double rounding() const = 0;

  // x_i(t) as Taylor polynomials about a place of the piece, or over a box.
  virtual ContourSeries<double, kMaxContourOrder, N> series(
      const std::array<Jet<double, kMaxContourOrder>, N>& x) const = 0;
  virtual ContourSeries<Interval, 2, N> series(const std::array<Jet<Interval, 2>, N>& x) const = 0;
  // The highest derivative of the contour that series() gives.
  virtual int highest_order() const = 0;

  // The equations of contact (geometry/queries/contours/contour_touching.h) of what `self` points to; none where they
  // are not known.
  virtual std::unique_ptr<TouchingEquations<N>> touching(std::shared_ptr<const ContourEquations<N>> self) const;

 protected:
  virtual SystemValue<double, N, N - 1> evaluate_inside(const ParameterPoint<N>& place) const = 0;
  virtual ContourPlace<N> at_inside(const ParameterPoint<N>& place) const;
};

// A function of a surface's point and tangents, for each kind of number, that vanishes on the contour. One of the point
// alone is a distance. One of the tangents vanishes at poles too.
struct SurfaceFunction {
  template <class T>
  using Of = std::function<T(const Triple<T>& s, const Triple<T>& s_u, const Triple<T>& s_v)>;
  bool needs_tangents;
  std::optional<Vec3> plane;  // of a height over a plane: its unit normal
  Of<Jet<double, 1>> slopes;
  Of<Jet<Interval, 1>> slope_ranges;
  Of<Jet<double, kMaxContourOrder>> series;
  Of<Jet<Interval, 2>> series_ranges;

  // From one formula for all: a callable with a template parameter list, [](const auto& s, const auto& s_u, ...).
  template <class Formula>
  SurfaceFunction(bool needs_tangents, const Formula& formula)
      : needs_tangents(needs_tangents),
        slopes(formula),
        slope_ranges(formula),
        series(formula),
        series_ranges(formula) {}
};

std::unique_ptr<ContourEquations<2>> function_equations(SurfacePtr surface, const Rectangle& piece,
                                                        SurfaceFunction function);
std::unique_ptr<ContourEquations<4>> intersection_equations(SurfacePtr r, const Rectangle& piece_r, SurfacePtr s,
                                                            const Rectangle& piece_s);

}  // namespace lekalo::geometry
