#include "geometry/external/spline_fit.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/describe.h"
#include "geometry/external/external_function.h"

namespace lekalo::geometry {

namespace {

// Parts of a piece at which fit and function are compared: neither its ends nor places where sites are likely.
constexpr double kChecked[] = {0.12, 0.31, 0.47, 0.68, 0.89};

// Pieces below this part of the domain are halved no more.
constexpr double kNarrowest = 1e-5;

constexpr size_t kFirstSpans = 4;

}  // namespace

std::vector<double> fitting_knots(const std::vector<double>& breaks) {
  std::vector<double> knots(kFitDegree, breaks.front());
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), kFitDegree, breaks.back());
  return knots;
}

std::vector<double> fitting_sites(const std::vector<double>& knots) {
  std::vector<double> sites;
  const size_t count = knots.size() - kFitDegree - 1;
  for (size_t i = 0; i < count; ++i) {
    double sum = 0;
    for (int k = 1; k <= kFitDegree; ++k) sum += knots[i + k];
    sites.push_back(sum / kFitDegree);
  }
  sites.front() = knots.front();
  sites.back() = knots.back();
  return sites;
}

std::vector<Vec3> interpolate(const std::vector<double>& knots, const std::vector<Vec3>& points, size_t curves) {
  const std::vector<double> sites = fitting_sites(knots);
  const auto count = static_cast<Eigen::Index>(sites.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int span = find_span(kFitDegree, knots, sites[i]);
    double basis[kFitDegree + 1];
    basis_derivative(kFitDegree, knots, span, sites[i], 0, basis);
    for (int k = 0; k <= kFitDegree; ++k) matrix(i, span - kFitDegree + k) = basis[k];
  }
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows values(count, static_cast<Eigen::Index>(3 * curves));
  for (size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) values.data()[3 * i + c] = points[i][c];
  const Rows solved = matrix.partialPivLu().solve(values);
  std::vector<Vec3> control(points.size());
  for (size_t i = 0; i < control.size(); ++i)
    for (int c = 0; c < 3; ++c) control[i][c] = solved.data()[3 * i + c];
  // The ends are taken exactly, so that what meets there still does.
  std::copy_n(points.begin(), curves, control.begin());
  std::copy_n(points.end() - static_cast<std::ptrdiff_t>(curves), curves,
              control.end() - static_cast<std::ptrdiff_t>(curves));
  return control;
}

std::vector<double> halved(const std::vector<double>& breaks, const std::vector<bool>& wrong) {
  const double narrowest = kNarrowest * (breaks.back() - breaks.front());
  std::vector<double> result;
  for (size_t i = 0; i + 1 < breaks.size(); ++i) {
    result.push_back(breaks[i]);
    if (wrong[i] && breaks[i + 1] - breaks[i] > 2 * narrowest) result.push_back(0.5 * (breaks[i] + breaks[i + 1]));
  }
  result.push_back(breaks.back());
  return result;
}

std::vector<double> checking_places(const std::vector<double>& breaks) {
  std::vector<double> places{breaks.front()};
  for (size_t i = 0; i + 1 < breaks.size(); ++i)
    for (const double part : kChecked) places.push_back(breaks[i] + part * (breaks[i + 1] - breaks[i]));
  places.push_back(breaks.back());
  return places;
}

std::vector<double> fitting_breaks(const CurveSamples& samples, size_t curves, const Interval& domain,
                                   double tolerance) {
  std::vector<double> breaks;
  for (size_t i = 0; i <= kFirstSpans; ++i)
    breaks.push_back(i == kFirstSpans ? domain.hi : domain.lo + domain.width() * i / kFirstSpans);
  for (;;) {
    const std::vector<double> knots = fitting_knots(breaks);
    const std::vector<Vec3> control = interpolate(knots, samples(fitting_sites(knots)), curves);
    const std::vector<double> places = checking_places(breaks);
    const std::vector<Vec3> expected = samples(places);
    std::vector<bool> wrong(breaks.size() - 1, false);
    for (size_t i = 0; i < places.size(); ++i) {
      const int span = find_span(kFitDegree, knots, places[i]);
      double basis[kFitDegree + 1];
      basis_derivative(kFitDegree, knots, span, places[i], 0, basis);
      for (size_t curve = 0; curve < curves; ++curve) {
        Vec3 point(0);
        for (int k = 0; k <= kFitDegree; ++k) point += basis[k] * control[(span - kFitDegree + k) * curves + curve];
        if (!(glm::length(point - expected[i * curves + curve]) <= tolerance)) wrong[span - kFitDegree] = true;
      }
    }
    std::vector<double> finer = halved(breaks, wrong);
    if (finer.size() == breaks.size() || finer.size() > kMaxFitSpans + 1) return breaks;
    breaks = std::move(finer);
  }
}

void judge(FitReport& report, std::span<const std::vector<double>> breaks) {
  const Deviation& points = report.deviations.front();
  if (!(points.largest <= report.tolerance * report.size))
    throw FieldError(
        "tolerance",
        fmt::format("no spline comes nearer to the function than {:.2g} of its size ({} pieces, at {})",
                    points.largest / report.size, report.spans, place_text({points.at.data(), breaks.size()})),
        "the function is not smooth there, or its numbers are not that exact: cut the domain there, or allow more with "
        "'tolerance'");
  std::vector<double> narrowest;
  for (const std::vector<double>& ends : breaks) {
    narrowest.push_back(kInfinity);
    for (size_t i = 0; i + 1 < ends.size(); ++i) narrowest.back() = std::min(narrowest.back(), ends[i + 1] - ends[i]);
  }
  // Markov's inequality: a polynomial of degree p below e on a piece of width h has derivatives below 2 p^2 e / h, and
  // second ones below p^2 (p^2 - 1) / 3 (2 / h)^2 e. The difference is no polynomial, but as smooth; the factor of ten
  // is for that and for the places between those that were sampled. Rounding is what is left of a perfect fit.
  constexpr double kSquare = kFitDegree * kFitDegree, kRoom = 10, kRounding = 1e-13;
  const double error = std::max(report.distance(), kRounding * report.size);
  for (size_t i = 1; i < report.deviations.size(); ++i) {
    const Deviation& one = report.deviations[i];
    const bool of_curve = breaks.size() == 1;
    double allowed = kRoom * error;
    int order = 0;
    const auto by = [&](double width) {
      allowed *= 2 / width * (order == 0 ? kSquare : (kSquare - 1) / 3);
      ++order;
    };
    if (of_curve)
      for (char n = '0'; n < one.quantity[1]; ++n) by(narrowest[0]);
    else
      for (const char c : one.quantity.substr(1)) by(narrowest[c == 'u' ? 0 : 1]);
    if (one.largest <= allowed) continue;
    const std::span<const double> place(one.at.data(), breaks.size());
    report.doubts.push_back(
        fmt::format("{} is not the derivative of the points: ({:.9g}, {:.9g}, {:.9g}) at {}, where the points have "
                    "({:.9g}, {:.9g}, {:.9g})",
                    one.quantity, one.first.x, one.first.y, one.first.z, place_text(place), one.second.x, one.second.y,
                    one.second.z));
  }
}

std::string FitReport::text() const {
  std::string result = fmt::format(
      "rays meet a spline of degree {} with {} pieces in place of the function; of {} sampled places none is "
      "farther than {:.2g} from it ({:.2g} of its size, tolerance {:.2g})",
      kFitDegree, spans, places, distance(), distance() / size, tolerance);
  for (size_t i = 1; i < deviations.size(); ++i)
    result += fmt::format("{} {} {:.2g}", i == 1 ? "; derivatives differ by" : ",", deviations[i].quantity,
                          deviations[i].largest);
  return result + "; sampled, not proven";
}

}  // namespace lekalo::geometry
