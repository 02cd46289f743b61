// Surfaces of straight lines (Zavyalov, Leus, Skorospelov 1985, II.3):
//
//   r(u, v) = rho(u) + v l(u)                            by a directrix and directions; l = rho': tangent surface
//   r(u, v) = (1 - v) c_1(u) + v c_2(w(u)),   (c_1'(u), c_2'(w), c_2(w) - c_1(u)) = 0
//
// The second is developable: at both ends of a line the tangent plane is the same. w(u) solves the equation for one u
// and is followed from there by w' = -F_u/F_w; it is kept as polynomials that agree with the solution to 1e-13.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/describe.h"
#include "geometry/surfaces/nets/boolean_sum.h"

namespace lekalo::geometry {

namespace {

// Places where the beginning is searched, and steps by which it is followed.
constexpr int kPlaces = 720;
// A step of w beyond this part of the second curve is a jump.
constexpr double kJump = 0.1;
// F below this part of its terms everywhere: the curves lie in one plane.
constexpr double kFlat = 1e-12;

double det(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::dot(a, glm::cross(b, c)); }

class Matching {
 public:
  Matching(const Curve& first, const Curve& second) : first_(first), second_(second) {}

  // F(t, w); F_w; -F_t/F_w.
  struct Value {
    double f, by_w, slope;
  };
  Value at(double t, double w) const {
    const CurveJet a = first_.evaluate(t, 2), b = second_.evaluate(w, 2);
    const Vec3 apart = b.d[0] - a.d[0];
    const double by_w = det(a.d[1], b.d[2], apart);
    return {det(a.d[1], b.d[1], apart), by_w, -det(a.d[2], b.d[1], apart) / by_w};
  }

  // Newton's iteration from w; none where it does not converge.
  std::optional<double> solve(double t, double w) const {
    const double width = second_.domain().width();
    for (int i = 0; i < 30; ++i) {
      const Value v = at(t, w);
      const double by = v.f / v.by_w;
      if (!(std::abs(by) < width)) return std::nullopt;
      w -= by;
      if (std::abs(by) <= 1e-15 * width) return w;
    }
    return std::nullopt;
  }

  // All w for one t.
  std::vector<double> roots(double t) const {
    std::vector<double> result;
    const Interval domain = second_.domain();
    const auto place = [&](int i) { return domain.lo + domain.width() * i / kPlaces; };
    double before = at(t, domain.lo).f;
    if (before == 0) result.push_back(domain.lo);
    for (int i = 1; i <= kPlaces; ++i) {
      const double here = at(t, place(i)).f;
      if (here == 0) {
        result.push_back(place(i));
      } else if ((before < 0) != (here < 0) && before != 0) {
        double lo = place(i - 1), hi = place(i);
        for (int k = 0; k < 60; ++k) ((at(t, 0.5 * (lo + hi)).f < 0) == (before < 0) ? lo : hi) = 0.5 * (lo + hi);
        result.push_back(0.5 * (lo + hi));
      }
      before = here;
    }
    return result;
  }

  bool is_flat() const {
    double largest = 0, size = 0;
    for (int i = 0; i < 16; ++i)
      for (int j = 0; j < 16; ++j) {
        const CurveJet a = first_.evaluate(place(first_, i), 1), b = second_.evaluate(place(second_, j), 1);
        const Vec3 apart = b.d[0] - a.d[0];
        largest = std::max(largest, std::abs(det(a.d[1], b.d[1], apart)));
        size = std::max(size, glm::length(a.d[1]) * glm::length(b.d[1]) * glm::length(apart));
      }
    return !(largest > kFlat * size);
  }

 private:
  static double place(const Curve& curve, int i) { return curve.domain().lo + curve.domain().width() * (i + 0.4) / 16; }
  const Curve &first_, &second_;
};

// w at even steps of t from the beginning to where it leaves the second curve.
struct Followed {
  double begin, step;
  std::vector<double> w;
  double end() const { return begin + step * static_cast<double>(w.size() - 1); }
};

Followed follow(const Matching& matching, const Curve& first, const Curve& second, double from) {
  const Interval t = first.domain(), domain = second.domain();
  Followed result{t.lo, t.width() / kPlaces, {from}};
  const double slack = 1e-12 * domain.width();
  for (int i = 1; i <= kPlaces; ++i) {
    const double before = result.end(), w = result.w.back();
    const double guess = w + result.step * matching.at(before, w).slope;
    const auto next = matching.solve(before + result.step, guess);
    if (!next || !(std::abs(*next - w) <= kJump * domain.width()))
      throw FieldError("of",
                       fmt::format("behind u = {:.6g} no line follows smoothly: the tangents at its ends become "
                                   "parallel to it, or a curve is straight",
                                   before),
                       "take parts of the curves");
    if (!second.is_closed() && !Interval(domain.lo - slack, domain.hi + slack).contains(*next)) break;
    result.w.push_back(*next);
  }
  if (result.w.size() < 2)
    throw FieldError("of", "the lines leave the second curve at once", "take parts of the curves that face each other");
  return result;
}

struct Matched {
  CurvePtr of;
  std::shared_ptr<const PolynomialCurve> w;
  template <class T>
  Triple<T> operator()(const T& t) const {
    return curve_at(*of, curve_at(*w, t).x);
  }
};

std::any developable_surface(const Fields& f) {
  const auto& given = f.references("of");
  if (given.size() != 2)
    throw FieldError("of", fmt::format("a developable surface has two curves, not {}", given.size()));
  const CurvePtr first = std::any_cast<CurvePtr>(given[0]), second = std::any_cast<CurvePtr>(given[1]);
  for (const CurvePtr& curve : {first, second})
    if (!(curve->domain().width() < kInfinity)) throw FieldError("of", "a curve is unbounded", "give it a domain");
  const Matching matching(*first, *second);
  if (matching.is_flat())
    throw FieldError("of", "the curves lie in one plane, or one is straight to the other: every line will do",
                     "ruled_surface joins them");
  const double t0 = first->domain().lo, near = f.has("begin") ? f.number("begin") : second->domain().lo;
  std::vector<double> roots = matching.roots(t0);
  if (roots.empty())
    throw FieldError("of", "no point of the second curve has a common tangent plane with the first curve's beginning",
                     "trim the first curve so that it begins where there is one");
  const double from = *std::min_element(roots.begin(), roots.end(),
                                        [&](double a, double b) { return std::abs(a - near) < std::abs(b - near); });
  const Followed followed = follow(matching, *first, *second, from);
  const Interval range(t0, followed.w.size() == kPlaces + 1 ? first->domain().hi : followed.end());
  const auto w_at = [&](double t) {
    const size_t i =
        std::min(static_cast<size_t>(std::max(0.0, std::round((t - t0) / followed.step))), followed.w.size() - 1);
    const auto w = matching.solve(t, followed.w[i]);
    return Vec3(w.value_or(followed.w[i]), 0, 0);
  };
  std::vector<Interval> stretches;
  for (const CurvePiece& piece : first->pieces())
    if (const Interval part = intersect(piece.domain, range); !part.empty()) stretches.push_back(part);
  const auto w = polynomial_approximation(w_at, stretches, 1e-13 * second->domain().width());
  if (!w) throw FieldError("of", "the lines do not follow smoothly: a curve is not smooth enough", "take smooth parts");
  CurveProperties properties = properties_of(*w);
  properties.max_order = std::min(properties.max_order, second->max_order());
  properties.enclosure_order = std::min(properties.enclosure_order, second->enclosure_order());
  BooleanSum sum;
  sum.along_u = {{first, std::make_shared<ComposedCurve<Matched>>(Matched{second, w}, properties)},
                 lagrange_functions({0, 1})};
  const Rectangle domain{range, {0, 1}};
  auto surface = std::make_shared<BlendedSurface>(blended_surface(std::move(sum), domain));
  if (first->is_closed() && range == first->domain() && is_closed_along(*surface, Along::u))
    surface->close(Along::u, range.width());
  return std::any(SurfacePtr(surface));
}

struct Tangents {
  CurvePtr of;
  template <class T>
  Triple<T> operator()(const T& t) const {
    return curve_at(*of, t, 1);
  }
};

std::any line_surface(const Fields& f) {
  const CurvePtr rho = f.curve("of");
  if (!(rho->domain().width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a domain");
  CurvePtr directions;
  if (f.has("directions")) {
    directions = f.curve("directions");
    if (directions->domain() != rho->domain())
      throw FieldError("directions", "the curve of directions has another domain than the directrix",
                       fmt::format("it is {:.6g} to {:.6g}", rho->domain().lo, rho->domain().hi));
  } else {
    directions = std::make_shared<ComposedCurve<Tangents>>(Tangents{rho}, properties_of(*rho, 1));
  }
  const Interval& v = f.range("range");
  BooleanSum sum;
  sum.along_u = {{rho, directions},
                 {one_function(v), std::make_shared<NurbsCurve>(NurbsCurveForm{
                                       1, {v.lo, v.lo, v.hi, v.hi}, {Vec4(v.lo, 0, 0, 1), Vec4(v.hi, 0, 0, 1)}, {}})}};
  const double period = directions->period() == rho->period() ? rho->period() : 0;
  return std::any(
      SurfacePtr(std::make_shared<BlendedSurface>(blended_surface(std::move(sum), {rho->domain(), v}, {period, 0}))));
}

}  // namespace

TypeDeclaration developable_surface_type() {
  return declare(Category::surface, "developable_surface",
                 "Straight lines between two curves whose tangents at the ends of a line lie in one plane with it: a "
                 "surface that can be unrolled. u is the first curve's parameter, as far as there are such lines; v "
                 "runs from 0 at the first to 1 at the second.")
      .example(
          "of: [{ type: ellipse, semi_axes: [2, 1] }, { type: ellipse, semi_axes: [1, 2], frame: { origin: [0, 0, 1.5] "
          "} }]")
      .field("of", references({Category::curve}), "the two curves; smooth, and not in one plane")
      .optional("begin", number(),
                "parameter of the second curve near which the first line ends; its beginning when left out")
      .built_by(developable_surface);
}

TypeDeclaration line_surface_type() {
  return declare(Category::surface, "line_surface",
                 "Straight lines from the points of a curve along given directions, or along its tangents: r(u) + v "
                 "l(u). u is the curve's parameter.")
      .example("of: { type: helix, radius: 1, pitch: 1, turns: 1 }, range: [0.2, 1]")
      .field("of", reference({Category::curve}), "the directrix")
      .optional("directions", reference({Category::curve}),
                "a curve over the same parameters whose points are the directions l; the tangents r' when left out")
      .field("range", range(), "of v", "[0, 1]")
      .built_by(line_surface);
}

}  // namespace lekalo::geometry
