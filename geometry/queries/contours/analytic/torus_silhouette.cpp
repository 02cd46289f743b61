#include "geometry/queries/contours/analytic/torus_silhouette.h"

#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/surface_curve.h"
#include "geometry/formula.h"
#include "geometry/numerics/root_search.h"

namespace lekalo::geometry {

namespace {

// The torus is a ring by more than that, and the view is as far from where the curves meet or end: relative.
constexpr double kClear = 0.02;
// Beside the tube's radius, so far is the eye above the torus.
constexpr double kAbove = 1.02;

// v of the outline by u, and what the picture's direction there is.
struct Outline {
  double major, minor;
  bool central;
  Vec3 from;    // the direction or the eye
  double side;  // 1 or -1: which of the two curves

  template <class T>
  T parameter(const T& u) const {
    using std::acos;
    using std::atan;
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T across = from.x * cos(u) + from.y * sin(u);
    if (!central) return atan(-across / from.z) + (side > 0 ? 0 : kPi);
    // p cos v + q sin v = r has v = atan2(q, p) -+ acos(r / |(p, q)|), and q = w_z does not vanish.
    const T p = across - major;
    const T middle = (from.z > 0 ? 0.5 : -0.5) * kPi - atan(p / from.z);
    return middle + side * acos(minor / sqrt(p * p + from.z * from.z));
  }

  template <class T>
  Triple<T> operator()(const T& u) const {
    return {u, parameter(u), T(0)};
  }

  // m . (r' x i), which vanishes at cusps of the picture, and its derivative. (That of i is 0 or r'.)
  template <class S>
  std::array<S, 2> turn(const S& at) const {
    using J = Jet<S, 2>;
    const J u = J::variable(at), v = parameter(u);
    const J cos_v = cos(v), sin_v = sin(v), cos_u = cos(u), sin_u = sin(u), rho = major + minor * cos_v;
    const Triple<J> point{rho * cos_u, rho * sin_u, minor * sin_v}, normal{cos_v * cos_u, cos_v * sin_u, sin_v};
    const auto derivative = [](const Triple<J>& r, int k) {
      return Triple<S>{r.x.derivative(k), r.y.derivative(k), r.z.derivative(k)};
    };
    Triple<S> sight{S(from.x), S(from.y), S(from.z)};
    if (central) sight = derivative(point, 0) - sight;
    const Triple<S> across = cross(derivative(point, 1), sight);
    return {dot(derivative(normal, 0), across),
            dot(derivative(normal, 1), across) + dot(derivative(normal, 0), cross(derivative(point, 2), sight))};
  }
};

struct TurnSystem {
  const Outline& outline;
  SystemValue<double, 1, 1> evaluate(const ParameterPoint<1>& u) const {
    const auto [value, slope] = outline.turn(u[0]);
    return {{value}, {{{slope}}}};
  }
  SystemValue<Interval, 1, 1> enclose(const ParameterBox<1>& u) const {
    const auto [value, slope] = outline.turn(u[0]);
    return {{value}, {{{slope}}}};
  }
};

class OutlineImage final : public Curve {
 public:
  OutlineImage(const Outline& outline, const Interval& domain) : outline_(outline), domain_(domain) {}

  Interval domain() const override { return domain_; }
  CurveJet evaluate(double t, int order) const override { return evaluate_curve_formula(outline_, t, order); }
  CurveEnclosure enclose(const Interval& t, int order) const override {
    return enclose_curve_centered(outline_, t, order);
  }
  // Parts on which it turns little.
  std::vector<CurvePiece> pieces() const override {
    constexpr int kParts = 8;
    std::vector<CurvePiece> result;
    for (int k = 0; k < kParts; ++k) {
      CurvePiece piece;
      piece.domain = {domain_.lo + domain_.width() * k / kParts,
                      k + 1 == kParts ? domain_.hi : domain_.lo + domain_.width() * (k + 1) / kParts};
      piece.map = {ParameterMap::Kind::affine, piece.domain.lo, piece.domain.hi};
      result.push_back(piece);
    }
    return result;
  }

 private:
  Outline outline_;
  Interval domain_;
};

}  // namespace

std::optional<Contours> torus_silhouette(const CanonicalSurface& torus, const ViewOf& view) {
  if (torus.kind != CanonicalSurface::Kind::torus || !(torus.major > (1 + kClear) * torus.minor)) return std::nullopt;
  const Periods periods = closed_periods(*torus.surface);
  if (!(periods.u > 0 && periods.v > 0)) return std::nullopt;
  const Vec3 from = view.central ? torus.local(view.direction_or_eye) : torus.to_local * view.direction_or_eye;
  if (!(std::abs(from.z) > kClear * std::hypot(from.x, from.y))) return std::nullopt;
  if (view.central && !(std::abs(from.z) > kAbove * torus.minor)) return std::nullopt;

  Contours result;
  result.closed_form = true;
  const Interval domain = torus.surface->domain().u;
  for (const double side : {1.0, -1.0}) {
    const Outline outline{torus.major, torus.minor, view.central, from, side};
    RootSearchOptions<1, 1> options;
    options.slack = {1e-13 * domain.width()};
    options.least = {1e-9 * domain.width()};
    const auto cusps = search_roots<1, 1>(TurnSystem{outline}, ParameterBox<1>{domain}, options);
    if (!cusps.open.empty() || !cusps.complete) return std::nullopt;  // two cusps that meet
    Contour contour;
    const auto image = std::make_shared<OutlineImage>(outline, domain);
    contour.curve = std::make_shared<SurfaceCurve>(torus.surface, image);
    contour.images = {image};
    contour.closed = true;
    for (const auto& root : cusps.isolated) contour.cusps.push_back(root[0]);
    std::sort(contour.cusps.begin(), contour.cusps.end());
    contour.error = 1e-15 * bounds(*torus.surface).diameter();
    result.branches.push_back(std::move(contour));
  }
  return result;
}

}  // namespace lekalo::geometry
