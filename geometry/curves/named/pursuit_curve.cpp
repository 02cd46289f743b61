// Curve of pursuit (Grezdov, Filippenko 2010): a pursuer always moves towards its prey c(t),
//
//   p' = (|c'| / k) (c - p) / |c - p|,   p(t_0) = start,
//
// k the prey's speed by the pursuer's. For k < 1 the prey is caught if its path is long enough; the curve ends there.
//
// Integrated by the classical method of Runge and Kutta of order 4 in steps so short that its error is below rounding,
// near the capture ever shorter ones; between them by Hermite's cubics, then fitted by polynomials.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

constexpr int kSteps = 20000;             // at least
constexpr double kStepByDistance = 2e-3;  // the pursuer goes no more of the distance in a step
constexpr double kCaught = 1e-9;          // of the first distance
constexpr double kTolerance = 1e-11;      // of the size
constexpr int kMaxSteps = 2000000;

struct Node {
  double t;
  Vec3 point, velocity;
};

class Chase {
 public:
  Chase(const Curve& prey, const Vec3& start, double ratio) : prey_(prey), ratio_(ratio) {
    const double first = glm::length(prey.point(prey.domain().lo) - start);
    Vec3 from = start;
    for (const CurvePiece& piece : prey.pieces()) {
      if (!follow(piece.domain, from, kCaught * first)) break;
      from = nodes_.back().point;
    }
  }

  Interval domain() const { return {nodes_.front().t, nodes_.back().t}; }

  Vec3 point(double t) const {
    auto after =
        std::upper_bound(nodes_.begin(), nodes_.end(), t, [](double x, const Node& node) { return x < node.t; });
    if (after == nodes_.end()) --after;
    const Node &b = *after, &a = *(after - 1);
    const double h = b.t - a.t, w = (t - a.t) / h, v = 1 - w;
    return v * v * (1 + 2 * w) * a.point + w * w * (1 + 2 * v) * b.point +
           h * w * v * (v * a.velocity - w * b.velocity);
  }

 private:
  // Along a piece of the prey's path, whose derivatives at its end are those from inside. False once it is caught.
  bool follow(const Interval& piece, const Vec3& from, double caught) {
    inside_ = {piece.lo, next_down(piece.hi)};
    for (Node now{piece.lo, from, velocity(piece.lo, from)};;) {
      nodes_.push_back(now);
      const double distance = glm::length(prey_.point(now.t) - now.point);
      if (distance <= caught) return false;
      if (now.t >= piece.hi) return true;
      if (nodes_.size() > kMaxSteps)
        throw FieldError("start", "the pursuer keeps so near to its prey that its path cannot be computed",
                         "let it begin farther away, or take a shorter part of the prey's path");
      const double speed = glm::length(now.velocity) * (1 + ratio_),
                   longest = std::min(prey_.domain().width() / kSteps, piece.hi - now.t),
                   step = speed > 0 ? std::min(longest, kStepByDistance * distance / speed) : longest;
      if (!(now.t + step > now.t)) return false;
      now = next(now, step, piece.hi);
    }
  }
  Vec3 velocity(double t, const Vec3& at) const {
    const CurveJet prey = prey_.evaluate(inside_.clamp(t), 1);
    const Vec3 way = prey.d[0] - at;
    const double distance = glm::length(way);
    return distance > 0 ? glm::length(prey.d[1]) / (ratio_ * distance) * way : Vec3(0);
  }
  Node next(const Node& now, double h, double last) const {
    const Vec3 &k1 = now.velocity, k2 = velocity(now.t + h / 2, now.point + h / 2 * k1),
               k3 = velocity(now.t + h / 2, now.point + h / 2 * k2), k4 = velocity(now.t + h, now.point + h * k3);
    const double end = std::min(now.t + h, last);
    const Vec3 point = now.point + h / 6 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    return {end, point, velocity(end, point)};
  }

  const Curve& prey_;
  double ratio_;
  Interval inside_;
  std::vector<Node> nodes_;  // two where pieces of the prey's path meet
};

}  // namespace

TypeDeclaration pursuit_curve_type() {
  return declare(Category::curve, "pursuit_curve",
                 "The path of a pursuer that always moves towards its prey, which runs along a curve. The parameter is "
                 "the prey's; the curve ends where the prey is caught.")
      .example("of: round, start: [3, 0], ratio: 1.2")
      .field("of", reference({Category::curve}), "the path of the prey")
      .field("start", point(), "where the pursuer begins")
      .field("ratio", number().positive(), "speed of the prey by that of the pursuer; below 1 it may be caught", "0.5")
      .built_by([](const Fields& f) {
        const CurvePtr prey = f.curve("of");
        if (!(prey->domain().width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a domain");
        const double first = glm::length(prey->point(prey->domain().lo) - f.vec3("start"));
        if (!(first > 0)) throw FieldError("start", "the pursuer begins where the prey is");
        const Chase chase(*prey, f.vec3("start"), f.number("ratio"));
        std::vector<Interval> stretches;
        for (const CurvePiece& piece : prey->pieces()) {
          const Interval t = intersect(piece.domain, chase.domain());
          if (t.width() > 0) stretches.push_back(t);
        }
        const auto path = polynomial_approximation([&](double t) { return chase.point(t); }, stretches,
                                                   kTolerance * (first + bounds(*prey).diameter()));
        if (!path)
          throw FieldError("of", "the pursuer's path is too crooked", "take a shorter part of the prey's path");
        return std::any(CurvePtr(std::make_shared<PolynomialCurve>(*path)));
      });
}

}  // namespace lekalo::geometry
