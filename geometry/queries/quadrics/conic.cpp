#include "geometry/queries/quadrics/conic.h"

#include <algorithm>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/hyperbola.h"
#include "geometry/curves/analytic/parabola.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/numerics/polynomial.h"

namespace lekalo::geometry {

namespace {

// Parts of a function's size.
constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();

// c + a cos t + b sin t = 0 where cos (t - angle of (a, b)) = -c / |(a, b)|.
void trigonometric_roots(double c, double a, double b, std::vector<double>& roots) {
  const double size = std::hypot(a, b);
  const double cosine = -c / size;
  if (!(std::abs(cosine) <= 1 + kRounding)) return;
  const double middle = std::atan2(b, a), off = std::acos(std::clamp(cosine, -1.0, 1.0));
  for (double t : {middle - off, middle + off}) {
    // One step of Newton's iteration takes out what the arc cosine lost.
    const double slope = b * std::cos(t) - a * std::sin(t);
    if (std::abs(slope) > 1e-3 * size) t -= (c + a * std::cos(t) + b * std::sin(t)) / slope;
    t -= kTwoPi * std::floor(t / kTwoPi);
    roots.push_back(t < kTwoPi ? t : 0);
  }
}

}  // namespace

std::vector<double> plane_roots(const Conic& conic, const Vec3& normal, double height) {
  const double c = glm::dot(normal, conic.origin) - height, a = glm::dot(normal, conic.x),
               b = glm::dot(normal, conic.y);
  const double length = glm::length(normal), whole_a = length * glm::length(conic.x),
               whole_b = length * glm::length(conic.y);
  std::vector<double> roots;
  if (std::abs(a) <= kRounding * whole_a && std::abs(b) <= kRounding * whole_b) return roots;
  switch (conic.kind) {
    case Conic::Kind::ellipse:
      trigonometric_roots(c, a, b, roots);
      break;
    case Conic::Kind::hyperbola:
      // With e = exp t: (a + b) e^2 + 2 c e + (a - b) = 0.
      for (const PolynomialRoot& root : quadratic_roots({a - b, 2 * c, a + b}))
        if (root.x > 0) roots.push_back(std::log(root.x));
      break;
    case Conic::Kind::parabola:
      for (const PolynomialRoot& root : quadratic_roots({c, b, a})) roots.push_back(root.x);
      break;
    case Conic::Kind::line:
      roots.push_back(-c / b);
      break;
  }
  std::sort(roots.begin(), roots.end());
  return roots;
}

CurvePtr as_curve(const Conic& conic, const Interval& t) {
  if (conic.kind == Conic::Kind::line) {
    // A segment runs over [0, 1].
    return std::make_shared<Segment>(conic.point(t.lo), conic.point(t.hi));
  }
  Frame frame;
  frame.origin = conic.origin;
  const double a = glm::length(conic.x), b = glm::length(conic.y);
  frame.x = conic.x / a;
  frame.z = glm::normalize(glm::cross(frame.x, conic.y));
  frame.y = glm::cross(frame.z, frame.x);
  if (conic.kind == Conic::Kind::hyperbola) return std::make_shared<Hyperbola>(frame, a, b, t);
  if (conic.kind == Conic::Kind::parabola) return std::make_shared<Parabola>(frame, a, t);
  if (std::abs(a - b) <= kRounding * a) return std::make_shared<Circle>(frame, a, t);
  return std::make_shared<Ellipse>(frame, a, b, t);
}

}  // namespace lekalo::geometry
