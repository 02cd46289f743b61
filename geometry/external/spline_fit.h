// Splines through the points of functions that are known by their values only (Golovanov 2016, 2.12; de Boor 2001,
// XIII: interpolation at the knots' means).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "geometry/queries/differential/deviation.h"

namespace lekalo::geometry {

// High enough that 1e-9 of the size takes few pieces of a smooth function (the error falls with the 8th power of their
// width), low enough that a ray's Newton step on a piece is cheap.
inline constexpr int kFitDegree = 7;

// More pieces in one direction, or of a surface, mean a function that is not smooth, or noise.
inline constexpr size_t kMaxFitSpans = 512;
inline constexpr size_t kMaxFitPatches = 1 << 15;

// The points of several curves at the same parameters: that of curve k at t[i] stands at [i * curves + k].
using CurveSamples = std::function<std::vector<Vec3>(std::span<const double> t)>;

// Ends of pieces over the domain such that splines of kFitDegree on them are nearer than `tolerance` (a length) to
// `curves` curves wherever they were sampled. Where that cannot be had there are as many pieces as are sensible.
std::vector<double> fitting_breaks(const CurveSamples& samples, size_t curves, const Interval& domain,
                                   double tolerance);

// Ends of pieces with those pieces halved that `wrong` names (wrong[i]: the piece that begins at breaks[i]), unless
// they are narrower than any function that is smooth needs.
std::vector<double> halved(const std::vector<double>& breaks, const std::vector<bool>& wrong);

// Knots clamped at the ends, and the parameters at which a spline on them takes given points.
std::vector<double> fitting_knots(const std::vector<double>& breaks);
std::vector<double> fitting_sites(const std::vector<double>& knots);

// Control points of the splines that take the given points at fitting_sites(knots); both are laid out as CurveSamples.
std::vector<Vec3> interpolate(const std::vector<double>& knots, const std::vector<Vec3>& points, size_t curves);

// Where a fit is compared with its function: so many places in each piece, and the domain's ends.
std::vector<double> checking_places(const std::vector<double>& breaks);

// What is known of a fit.
struct FitReport {
  std::string spans;                  // "24", "24 x 12"
  size_t places = 0;                  // where fit and function were compared
  double size = 0;                    // diameter of the function's points
  double tolerance = 0;               // what `distance` was to be below, as part of the size
  std::vector<Deviation> deviations;  // of the function from the fit: the point first
  // Derivatives that cannot be those of the points: they differ from the fit's by more than a fit so near allows.
  std::vector<std::string> doubts;

  double distance() const { return deviations.front().largest; }
  // One line for the reader.
  std::string text() const;
};

// Throws FieldError (field tolerance) if the distance is above the tolerance; else fills the doubts. `breaks`: the ends
// of the pieces in each direction.
void judge(FitReport& report, std::span<const std::vector<double>> breaks);

}  // namespace lekalo::geometry
