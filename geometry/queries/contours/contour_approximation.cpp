#include "geometry/queries/contours/contour_approximation.h"

#include <algorithm>
#include <unordered_map>

#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/queries/contours/contour_curve.h"

namespace lekalo::geometry {

namespace {

constexpr double kRounding = 4e-15;  // of coordinates: points of searched contours are no better

// Of contours that are searched, and of curves on surfaces, each point takes long.
bool takes_long(const Curve& curve) {
  const auto* part = dynamic_cast<const CurvePart*>(&curve);
  const Curve& whole = part ? *part->of() : curve;
  return is_searched(whole) || dynamic_cast<const SurfaceCurve*>(&whole);
}

// Point and both images of an intersection, each place solved once.
class SolvedOnce {
 public:
  explicit SolvedOnce(std::shared_ptr<const ContourSolution<4>> solution) : solution_(std::move(solution)) {}
  const std::array<Vec3, 3>& at(double t) {
    const auto [found, is_new] = known_.try_emplace(t);
    if (is_new) {
      const auto series = solution_->at(solution_->domain().clamp(t), 0);
      const auto& [x, point] = series;
      found->second = {Vec3(point.x.c[0], point.y.c[0], point.z.c[0]), Vec3(x[0].c[0], x[1].c[0], 0),
                       Vec3(x[2].c[0], x[3].c[0], 0)};
    }
    return found->second;
  }

 private:
  std::shared_ptr<const ContourSolution<4>> solution_;
  std::unordered_map<double, std::array<Vec3, 3>> known_;
};

// The solution that all three curves of an intersection are of; else none.
std::shared_ptr<const ContourSolution<4>> common_solution(const Contour& contour) {
  const auto* curve = dynamic_cast<const ContourCurve<4>*>(contour.curve.get());
  if (!curve) return nullptr;
  std::shared_ptr<const ContourSolution<4>> common;
  for (size_t k = 0; k < contour.images.size(); ++k) {
    const auto* image = dynamic_cast<const ContourImage<4>*>(contour.images[k].get());
    if (!image || image->solution().get() != &curve->solution() || image->first() != 2 * static_cast<int>(k))
      return nullptr;
    common = image->solution();
  }
  return common;
}

// The diameter of its box and the greatest of its coordinates, as far as a few points tell.
struct Extent {
  double diameter, farthest;
};
Extent extent_of(const std::function<Vec3(double)>& point, const Interval& t) {
  constexpr int kPlaces = 8;
  Box3 box;
  for (int k = 0; k <= kPlaces; ++k) box.include(point(t.lo + t.width() * k / kPlaces));
  const Vec3 farthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  return {box.diameter(), std::max({farthest.x, farthest.y, farthest.z})};
}

}  // namespace

CurvePtr contour_approximation(const CurvePtr& curve, double coarsest, double finest) {
  if (!dynamic_cast<const ParameterLine*>(curve.get()) && !takes_long(*curve)) return curve;
  // Its box from a few points: bounds of a searched curve take as long as all else.
  const Extent extent = extent_of([&](double t) { return curve->point(t); }, curve->domain());
  const double rounding = kRounding * extent.farthest;
  const auto nearer_than = [&](double share) {
    return polynomial_approximation(*curve, std::max(share * extent.diameter, rounding), coarsest > finest);
  };
  if (auto simple = nearer_than(finest)) return simple;
  auto simple = coarsest > finest ? nearer_than(coarsest) : nullptr;
  return simple ? simple : curve;
}

Curve2Ptr contour_approximation(const CurvePtr& curve, const Surface& surface, const Curve2Ptr& image, double coarsest,
                                double finest) {
  const Rectangle domain = surface.domain();
  const double size = std::max(domain.u.width(), domain.v.width());
  if (!takes_long(*curve) || !(size < kInfinity)) return image;
  const CurvePart part(image, curve->domain());
  auto simple = polynomial_approximation(part, finest * size, coarsest > finest);
  if (!simple && coarsest > finest) simple = polynomial_approximation(part, coarsest * size, true);
  return simple ? simple : image;
}

CurvePtr contour_approximation_within(const CurvePtr& curve, double length) {
  if (!takes_long(*curve)) return curve;
  const CurvePtr simple = polynomial_approximation(*curve, length, true);
  return simple ? simple : curve;
}

Curve2Ptr contour_approximation_within(const CurvePtr& curve, const Surface& surface, const Curve2Ptr& image,
                                       double length) {
  if (!takes_long(*curve)) return image;
  constexpr int kPlaces = 8;
  double fastest = 0;
  for (int k = 0; k <= kPlaces; ++k) {
    const Vec3 uv = image->point(curve->domain().lo + curve->domain().width() * k / kPlaces);
    const SurfaceJet jet = surface.evaluate(uv.x, uv.y, 1);
    fastest = std::max({fastest, glm::length(jet.du()), glm::length(jet.dv())});
  }
  if (!(fastest > 0)) return image;
  const Curve2Ptr simple = polynomial_approximation(CurvePart(image, curve->domain()), length / fastest, true);
  return simple ? simple : image;
}

ContourApproximation contour_approximation(const Contour& contour, const std::array<const Surface*, 2>& surfaces,
                                           double coarsest, double finest) {
  // Beside a singular place there are thousands of pieces, which are joined: see below.
  constexpr size_t kMaxPieces = 200;
  const CurvePtr& curve = contour.curve;
  const std::vector<CurvePiece> pieces = curve->pieces();
  if (const auto solution = pieces.size() <= kMaxPieces ? common_solution(contour) : nullptr) {
    SolvedOnce solved(solution);
    std::vector<Interval> stretches;
    for (const CurvePiece& piece : pieces) stretches.push_back(piece.domain);
    const auto part = [&](int k, double tolerance) {
      return polynomial_approximation([&](double t) { return solved.at(t)[k]; }, stretches, tolerance);
    };
    const Extent extent = extent_of([&](double t) { return solved.at(t)[0]; }, curve->domain());
    ContourApproximation result;
    result.curve = part(0, std::max(finest * extent.diameter, kRounding * extent.farthest));
    for (const int k : {0, 1}) {
      const Rectangle domain = surfaces[k]->domain();
      const double size = std::max(domain.u.width(), domain.v.width());
      if (result.curve && size < kInfinity) result.images[k] = part(k + 1, finest * size);
    }
    if (result.curve && result.images[0] && result.images[1]) return result;
  }
  return {contour_approximation(curve),
          {contour_approximation(curve, *surfaces[0], contour.images[0], coarsest, finest),
           contour_approximation(curve, *surfaces[1], contour.images[1], coarsest, finest)}};
}

}  // namespace lekalo::geometry
