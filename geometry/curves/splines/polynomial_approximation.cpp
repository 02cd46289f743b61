#include "geometry/curves/splines/polynomial_approximation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/numerics/chebyshev.h"

namespace lekalo::geometry {

namespace {

constexpr int kNodes = static_cast<int>(PolynomialCurve::kTerms);
constexpr size_t kMaxParts = 4096;
constexpr int kMaxHalvings = 24;  // of a piece
constexpr double kLeftOut = 0.1;  // of the tolerance: terms as small together

class Fitting {
 public:
  Fitting(const std::function<Vec3(double)>& point, double tolerance, const OwnPace* pace)
      : point_(point), tolerance_(tolerance), pace_(pace) {}

  // Stretches that one polynomial serves become one part: a contour's pieces are steps of its search, thousands of them
  // beside a place where it crosses itself.
  bool add(std::span<const Interval> pieces) {
    if (pieces.empty()) return true;
    if (pieces.size() == 1) return add(pieces.front(), 0);
    if (add_one({pieces.front().lo, pieces.back().hi}, pieces.subspan(1))) return parts.size() <= kMaxParts;
    const double middle = Interval{pieces.front().lo, pieces.back().hi}.middle();
    const auto behind =
        std::find_if(pieces.begin() + 1, pieces.end() - 1, [&](const Interval& piece) { return piece.lo >= middle; });
    const auto count = static_cast<size_t>(behind - pieces.begin());
    return add(pieces.first(count)) && add(pieces.subspan(count));
  }

  bool add(const Interval& t, int depth) {
    if (add_one(t)) return parts.size() <= kMaxParts;
    return depth < kMaxHalvings && add({t.lo, t.middle()}, depth + 1) && add({t.middle(), t.hi}, depth + 1);
  }

  std::vector<PolynomialCurve::Part> parts;

 private:
  // Short pieces tell where to look besides.
  bool add_one(const Interval& t, std::span<const Interval> pieces = {}) {
    PolynomialCurve::Part part;
    std::array<Vec3, kNodes> values;
    // At a break the curve's own point is that from the right.
    const double last = next_down(t.hi);
    const auto place = [&](double x) { return std::min(t.middle() + 0.5 * t.width() * x, last); };
    const auto point = [&](double x) { return point_(place(x)); };
    for (int j = 0; j < kNodes; ++j) values[j] = point(chebyshev_point(j, kNodes));
    auto coefficients = chebyshev_coefficients(values);
    // A cubic is one again: what is rounding, or as little, is left out.
    double left_out = 0;
    int terms = kNodes;
    while (terms > 1 && left_out + glm::length(coefficients[terms - 1]) <= kLeftOut * tolerance_)
      left_out += glm::length(coefficients[--terms]), coefficients[terms] = Vec3(0);
    part = {t, 2 / t.width(), powers_of_chebyshev(coefficients), terms};
    bool good = true;
    const auto look_at = [&](double x) {
      const Vec3 value = part.value(x);
      const double off = good ? glm::length(value - point(x)) : 0;
      good = good && (off <= tolerance_ || (pace_ && off <= pace_->tolerance && pace_->is_on_line(place(x), value)));
    };
    for (const double x : {-1.0, -0.97, -0.6, -0.1, 0.3, 0.85, 1.0}) look_at(x);
    for (const Interval& piece : pieces)
      if (good) look_at((piece.lo - t.middle()) * (2 / t.width()));
    if (good) parts.push_back(part);
    return good;
  }

  const std::function<Vec3(double)>& point_;
  double tolerance_;
  const OwnPace* pace_;
};

}  // namespace

std::shared_ptr<const PolynomialCurve> polynomial_approximation(const std::function<Vec3(double)>& point,
                                                                std::span<const Interval> pieces, double tolerance,
                                                                const OwnPace* pace) {
  Fitting fitting(point, tolerance, pace);
  for (const Interval& t : pieces)
    if (!t.empty() && t.width() > 0 && !fitting.add(t, 0)) return nullptr;
  return std::make_shared<const PolynomialCurve>(std::move(fitting.parts));
}

std::shared_ptr<const PolynomialCurve> polynomial_approximation(const Curve& curve, double tolerance,
                                                                bool joins_pieces) {
  const std::function<Vec3(double)> point = [&](double t) { return curve.point(t); };
  Fitting fitting(point, tolerance, nullptr);
  std::vector<Interval> pieces;
  for (const CurvePiece& piece : curve.pieces()) {
    const Interval t = intersect(piece.domain, curve.domain());
    if (!t.empty() && t.width() > 0) pieces.push_back(t);
  }
  const bool is_done = joins_pieces ? fitting.add(pieces)
                                    : std::all_of(pieces.begin(), pieces.end(),
                                                  [&](const Interval& piece) { return fitting.add(piece, 0); });
  if (!is_done) return nullptr;
  return std::make_shared<const PolynomialCurve>(std::move(fitting.parts));
}

CurvePtr as_polynomials(const CurvePtr& curve, double share) {
  constexpr int kPlaces = 16;
  const Interval domain = curve->domain();
  double largest = 0;
  for (int k = 0; k <= kPlaces; ++k) {
    const Vec3 p = glm::abs(curve->point(domain.lo + domain.width() * k / kPlaces));
    largest = std::max({largest, p.x, p.y, p.z});
  }
  auto polynomials = polynomial_approximation(*curve, share * largest);
  return polynomials ? polynomials : curve;
}

}  // namespace lekalo::geometry
