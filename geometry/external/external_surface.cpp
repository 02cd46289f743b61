#include "geometry/external/external_surface.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/describe.h"
#include "geometry/point_formulas.h"
#include "geometry/surfaces/analytic/parameter_range.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Places along each direction where the size is taken and edges are compared.
constexpr int kTried = 32;

// Lines of the surface, as parts of the domain, whose fits say how many pieces each direction needs.
constexpr double kLines[] = {0, 0.13, 0.29, 0.5, 0.61, 0.83, 1};

// Room for what the other direction adds to the distance.
constexpr double kShareOfLines = 0.25;

constexpr int kMaxRounds = 8;

double at(const Interval& range, double part) { return part == 1 ? range.hi : range.lo + range.width() * part; }

std::vector<Vec2> all_pairs(const std::vector<double>& u, const std::vector<double>& v) {
  std::vector<Vec2> result;
  result.reserve(u.size() * v.size());
  for (const double a : u)
    for (const double b : v) result.emplace_back(a, b);
  return result;
}

std::vector<Vec3> points_of(const ExternalFunction& function, std::span<const Vec2> uv) {
  std::vector<Vec3> points;
  points.reserve(uv.size());
  for (const SurfaceJet& jet : surface_jets(function, uv, 0)) points.push_back(jet.point());
  return points;
}

}  // namespace

ExternalSurface::ExternalSurface(std::shared_ptr<const ExternalFunction> function, const Rectangle& domain,
                                 Closed closed, int order, double tolerance)
    : function_(std::move(function)), domain_(domain), closed_(closed), order_(order) {
  for (const Interval& side : {domain.u, domain.v})
    if (!(side.width() > 0 && side.width() < kInfinity))
      throw FieldError("domain", "the domain of an external surface must be finite and not empty");
  std::vector<double> along_u, along_v;
  for (int i = 0; i <= kTried; ++i) {
    along_u.push_back(at(domain.u, static_cast<double>(i) / kTried));
    along_v.push_back(at(domain.v, static_cast<double>(i) / kTried));
  }
  const std::vector<Vec3> points = points_of(*function_, all_pairs(along_u, along_v));
  Box3 box;
  for (const Vec3& p : points) box.include(p);
  report_.size = box.diameter();
  report_.tolerance = tolerance;
  if (!(report_.size > 0)) throw FieldError("domain", "the function gives the same point everywhere in its domain");
  const auto meet = [&](bool of_u) {
    for (int i = 0; i <= kTried; ++i) {
      const int first = of_u ? i : i * (kTried + 1), last = of_u ? kTried * (kTried + 1) + i : first + kTried;
      if (glm::length(points[first] - points[last]) > kClosedCurve * report_.size)
        throw FieldError("closed", std::string("the surface is not closed along ") + (of_u ? "u" : "v") +
                                       ": its edges there are not the same");
    }
  };
  if (closed.u) meet(true);
  if (closed.v) meet(false);
  fit();
}

NurbsSurface ExternalSurface::fitted(const std::vector<double>& breaks_u, const std::vector<double>& breaks_v) const {
  const std::vector<double> knots_u = fitting_knots(breaks_u), knots_v = fitting_knots(breaks_v);
  const std::vector<double> sites_u = fitting_sites(knots_u), sites_v = fitting_sites(knots_v);
  const size_t rows = sites_u.size(), columns = sites_v.size();
  std::vector<Vec3> points = points_of(*function_, all_pairs(sites_u, sites_v));
  // Closed means closed to the last bit, or rays slip between the edges.
  for (size_t j = 0; closed_.u && j < columns; ++j) points[(rows - 1) * columns + j] = points[j];
  for (size_t i = 0; closed_.v && i < rows; ++i) points[i * columns + columns - 1] = points[i * columns];
  const auto transposed = [](const std::vector<Vec3>& net, size_t count, size_t each) {
    std::vector<Vec3> result(net.size());
    for (size_t i = 0; i < count; ++i)
      for (size_t j = 0; j < each; ++j) result[j * count + i] = net[i * each + j];
    return result;
  };
  points = interpolate(knots_u, points, columns);
  points = transposed(interpolate(knots_v, transposed(points, rows, columns), rows), columns, rows);
  return NurbsSurface({kFitDegree, knots_u, Extension::tangent}, {kFitDegree, knots_v, Extension::tangent}, points);
}

void ExternalSurface::fit() {
  const double allowed = report_.tolerance * report_.size;
  const auto breaks_along = [&](bool u) {
    const Interval &range = u ? domain_.u : domain_.v, &across = u ? domain_.v : domain_.u;
    const auto samples = [&](std::span<const double> x) {
      std::vector<Vec2> uv;
      for (const double a : x)
        for (const double part : kLines) {
          const double b = at(across, part);
          uv.push_back(u ? Vec2(a, b) : Vec2(b, a));
        }
      return points_of(*function_, uv);
    };
    return fitting_breaks(samples, std::size(kLines), range, kShareOfLines * allowed);
  };
  std::vector<double> breaks_u = breaks_along(true), breaks_v = breaks_along(false);
  const auto patches = [](const std::vector<double>& u, const std::vector<double>& v) {
    return (u.size() - 1) * (v.size() - 1);
  };
  if (patches(breaks_u, breaks_v) > kMaxFitPatches)
    throw FieldError(
        "tolerance",
        fmt::format("a spline so near to the function needs more than {} x {} pieces", breaks_u.size() - 1,
                    breaks_v.size() - 1),
        "the function is not smooth, or its numbers are not that exact: allow more with 'tolerance', or cut "
        "the domain");
  const int order = std::min(order_, 2);
  for (int round = 0;; ++round) {
    fit_ = std::make_shared<NurbsSurface>(fitted(breaks_u, breaks_v));
    const std::vector<Vec2> uv = all_pairs(checking_places(breaks_u), checking_places(breaks_v));
    const std::vector<SurfaceJet> expected = surface_jets(*function_, uv, order);
    std::vector<SurfaceJet> found(uv.size());
    fit_->evaluate_many(uv, order, found);
    report_.deviations = deviations(expected, found, uv, order);
    report_.places = uv.size();
    report_.spans = fmt::format("{} x {}", breaks_u.size() - 1, breaks_v.size() - 1);
    if (report_.distance() <= allowed) break;
    std::vector<bool> wrong_u(breaks_u.size() - 1, false), wrong_v(breaks_v.size() - 1, false);
    const auto mark = [](const std::vector<double>& breaks, double x, std::vector<bool>& wrong) {
      const auto after = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, x);
      wrong[static_cast<size_t>(after - breaks.begin()) - 1] = true;
    };
    for (size_t i = 0; i < uv.size(); ++i)
      if (!(glm::length(expected[i].point() - found[i].point()) <= allowed)) {
        mark(breaks_u, uv[i].x, wrong_u);
        mark(breaks_v, uv[i].y, wrong_v);
      }
    std::vector<double> finer_u = halved(breaks_u, wrong_u), finer_v = halved(breaks_v, wrong_v);
    if (round == kMaxRounds || patches(finer_u, finer_v) > kMaxFitPatches ||
        finer_u.size() + finer_v.size() == breaks_u.size() + breaks_v.size())
      break;
    breaks_u = std::move(finer_u);
    breaks_v = std::move(finer_v);
  }
  const std::vector<double> breaks[] = {std::move(breaks_u), std::move(breaks_v)};
  judge(report_, breaks);
}

SurfaceJet ExternalSurface::evaluate(double u, double v, int order) const {
  const Vec2 place(u, v);
  SurfaceJet jet;
  evaluate_many({&place, 1}, order, {&jet, 1});
  return jet;
}

void ExternalSurface::evaluate_many(std::span<const Vec2> uv, int order, std::span<SurfaceJet> result) const {
  std::vector<Vec2> asked;
  std::vector<size_t> answered;
  for (size_t i = 0; i < uv.size(); ++i) {
    const double u = closed_.u ? wrapped(uv[i].x, domain_.u) : uv[i].x;
    const double v = closed_.v ? wrapped(uv[i].y, domain_.v) : uv[i].y;
    const auto inside_u = within(domain_.u, u), inside_v = within(domain_.v, v);
    const bool inside = inside_u && inside_v;
    if (!inside || order > order_) result[i] = fit_->evaluate(u, v, order);
    if (!inside) continue;
    asked.emplace_back(*inside_u, *inside_v);
    answered.push_back(i);
  }
  const int known = std::min(order, order_);
  const std::vector<SurfaceJet> jets = surface_jets(*function_, asked, known);
  for (size_t k = 0; k < answered.size(); ++k) {
    SurfaceJet& jet = result[answered[k]];
    jet.order = order;
    std::copy_n(jets[k].values.begin(), (known + 1) * (known + 2) / 2, jet.values.begin());
  }
}

SurfaceEnclosure ExternalSurface::enclose(const Rectangle& box, int order) const {
  SurfaceEnclosure result = fit_->enclose(box, order);
  for (size_t k = 0; k < report_.deviations.size() && k < result.values.size(); ++k)
    result.values[k] = result.values[k].inflated(report_.deviations[k].largest);
  return result;
}

}  // namespace lekalo::geometry
