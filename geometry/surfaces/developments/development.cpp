// Developments: surfaces of straight lines unrolled into a plane (Zavyalov, Leus, Skorospelov 1985, IV.4). With s the
// parameter along the lines, counted from the directrix rho, and t the other,
//
//   r = rho(t) + s l(t)   ->   R = P(t) + s L(t),   P' = |rho'| (cos a, sin a),   a' = |rho'| k,
//
//   k |rho'|^4 |l| sin b = (rho'' . l) rho'^2 - (rho'' . rho')(rho' . l)      the directrix's geodesic curvature
//   L = |l| (cos(a + b), sin(a + b)),   b the angle from rho' to l, 0 < b < pi
//
// (The printed k has |rho'|^3 below.) Lengths and angles stay where (rho', l, l') = 0: the surface is developable.
// Of others the map keeps the directrix, the lines and the angles between; it is exact on the directrix:
//
//   conditional   as above
//   improved      R = (1 + q) P + s (L + q L_1),   L_1 = L turned by 90 degrees, times cot b
//   quasi         of a surface that is not ruled: l = r_s on the directrix, and R = P + s L + s^2/2 L_1, L_1 the image
//                 of the part of r_ss in the tangent plane
//
// P, L and L_1 are polynomials on parts that agree with the integrals to 1e-13 of the size.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/describe.h"
#include "geometry/numerics/quadrature.h"
#include "geometry/surfaces/nets/boolean_sum.h"

namespace lekalo::geometry {

namespace {

// Polynomials agree with what they stand for to this, of the size.
constexpr double kSame = 1e-13;
// A surface is ruled, and developable, where what must vanish does to this part of its terms.
constexpr double kRuled = 1e-9;
// Places each way where that is looked at.
constexpr int kTried = 24;
// The line and the directrix are one direction below this sine of the angle between them.
constexpr double kAlong = 1e-6;

using Function = std::function<Vec3(double)>;
using Polynomials = std::shared_ptr<const PolynomialCurve>;

Polynomials approximated(const Function& f, const std::vector<Interval>& stretches, double tolerance) {
  auto result = polynomial_approximation(f, stretches, tolerance);
  if (!result) throw FieldError("of", "the surface is not smooth enough across its lines", "develop a part of it");
  return result;
}

// The integral of f from the beginning, plus `start`.
Polynomials integral_of(const Function& f, const std::vector<Interval>& stretches, const Vec3& start,
                        double tolerance) {
  const Polynomials slope = approximated(f, stretches, tolerance);
  static const GaussRule rule = gauss_legendre(9);  // exact for the polynomials
  const auto over = [&](const Interval& t) {
    Vec3 sum(0);
    for (size_t i = 0; i < rule.nodes.size(); ++i)
      sum += 0.5 * t.width() * rule.weights[i] * slope->point(t.middle() + 0.5 * t.width() * rule.nodes[i]);
    return sum;
  };
  std::vector<double> begins;
  std::vector<Vec3> before{start};
  for (const auto& part : slope->parts()) {
    begins.push_back(part.t.lo);
    before.push_back(before.back() + over(part.t));
  }
  const auto at = [&](double t) {
    const auto k = std::max<std::ptrdiff_t>(std::upper_bound(begins.begin(), begins.end(), t) - begins.begin() - 1, 0);
    return before[k] + over({begins[k], t});
  };
  return approximated(at, stretches, tolerance);
}

// The surface by t and s.
class Strip {
 public:
  Strip(SurfacePtr surface, bool lines_along_v, double directrix)
      : surface_(std::move(surface)), along_v_(lines_along_v), directrix_(directrix) {
    const Rectangle domain = surface_->domain();
    across_ = along_v_ ? domain.u : domain.v;
    along_ = along_v_ ? domain.v : domain.u;
    for (const SurfacePiece& piece : surface_->pieces())
      breaks_.push_back((along_v_ ? piece.domain.u : piece.domain.v).lo);
    breaks_.push_back(across_.hi);
    std::sort(breaks_.begin(), breaks_.end());
    breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
  }

  const Interval& across() const { return across_; }
  const Interval& along() const { return along_; }
  double directrix() const { return directrix_; }
  bool lines_along_v() const { return along_v_; }
  std::vector<Interval> stretches() const {
    std::vector<Interval> result;
    for (size_t i = 0; i + 1 < breaks_.size(); ++i) result.push_back({breaks_[i], breaks_[i + 1]});
    return result;
  }
  // The derivative i times by t and j times by s.
  Vec3 d(double t, double s, int i, int j) const {
    const SurfaceJet jet = along_v_ ? surface_->evaluate(t, s, i + j) : surface_->evaluate(s, t, i + j);
    return along_v_ ? jet.d(i, j) : jet.d(j, i);
  }
  // On the directrix.
  Vec3 rho(double t, int k) const { return d(t, directrix_, k, 0); }
  Vec3 line(double t) const { return d(t, directrix_, 0, 1); }

  // |rho'| k
  double turning(double t) const {
    const Vec3 r1 = rho(t, 1), r2 = rho(t, 2), l = line(t);
    const double across = glm::length(glm::cross(r1, l)), square = glm::dot(r1, r1);
    if (!(across > kAlong * std::sqrt(square) * glm::length(l)))
      throw FieldError("directrix",
                       fmt::format("the directrix runs along the line at {} = {:.6g}, or shrinks to a point",
                                   along_v_ ? "u" : "v", t),
                       "choose another value of the parameter along the lines");
    return (glm::dot(r2, l) * square - glm::dot(r2, r1) * glm::dot(r1, l)) / (square * across);
  }
  // Of a vector of the tangent plane its coordinates along rho' and across, to the side of l.
  Vec2 local(double t, const Vec3& vector) const {
    const Vec3 e1 = glm::normalize(rho(t, 1)), l = line(t);
    return {glm::dot(vector, e1), glm::dot(vector, glm::normalize(l - glm::dot(l, e1) * e1))};
  }

 private:
  SurfacePtr surface_;
  bool along_v_;
  double directrix_;
  Interval across_, along_;
  std::vector<double> breaks_;
};

template <class Visit>
void visit_places(const Strip& strip, const Visit& visit) {
  for (int i = 0; i < kTried; ++i)
    for (int j = 0; j < kTried; ++j)
      visit(strip.across().lo + (i + 0.5) / kTried * strip.across().width(),
            strip.along().lo + (j + 0.5) / kTried * strip.along().width());
}

bool is_ruled(const Strip& strip) {
  bool result = true;
  visit_places(strip, [&](double t, double s) {
    const double bend = glm::length(strip.d(t, s, 0, 2)) * strip.along().width();
    result = result && bend <= kRuled * glm::length(strip.d(t, s, 0, 1));
  });
  return result;
}

void check_developable(const Strip& strip) {
  visit_places(strip, [&](double t, double) {
    const Vec3 r1 = strip.rho(t, 1), l = strip.line(t), l1 = strip.d(t, strip.directrix(), 1, 1);
    const double volume = std::abs(glm::dot(r1, glm::cross(l, l1))), reach = strip.along().width();
    if (!(volume * reach <= kRuled * glm::dot(r1, r1) * glm::length(l) +
                                kRuled * reach * glm::length(r1) * glm::length(l) * glm::length(l1)))
      throw FieldError(
          "of",
          fmt::format("the surface is not developable: its tangent plane turns about the line at {} = {:.6g}",
                      strip.lines_along_v() ? "u" : "v", t),
          "method: conditional keeps lines and directrix and stretches the rest");
  });
}

Strip read_strip(const Fields& f) {
  const SurfacePtr surface = f.surface("of");
  if (!surface->bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
  const Rectangle domain = surface->domain();
  const auto strip_along = [&](bool along_v) {
    const Interval along = along_v ? domain.v : domain.u;
    const double directrix = f.has("directrix") ? f.number("directrix") : along.middle();
    if (!along.contains(directrix))
      throw FieldError("directrix", fmt::format("the lines' parameter runs from {:.6g} to {:.6g}", along.lo, along.hi));
    return Strip(surface, along_v, directrix);
  };
  if (f.given("lines")) return strip_along(f.text("lines") == "v");
  const Strip first = strip_along(true);
  if (f.text("method") == "quasi" || is_ruled(first)) return first;
  const Strip second = strip_along(false);
  return is_ruled(second) ? second : first;
}

CurvePtr line_function(const Interval& s, double zero) {
  return std::make_shared<NurbsCurve>(
      NurbsCurveForm{1, {s.lo, s.lo, s.hi, s.hi}, {Vec4(s.lo - zero, 0, 0, 1), Vec4(s.hi - zero, 0, 0, 1)}, {}});
}

// (s - zero)^2/2
CurvePtr square_function(const Interval& s, double zero) {
  const double a = s.lo - zero, b = s.hi - zero;
  return std::make_shared<NurbsCurve>(
      NurbsCurveForm{2,
                     {s.lo, s.lo, s.lo, s.hi, s.hi, s.hi},
                     {Vec4(a * a / 2, 0, 0, 1), Vec4(a * b / 2, 0, 0, 1), Vec4(b * b / 2, 0, 0, 1)},
                     {}});
}

std::any development(const Fields& f) {
  const Strip strip = read_strip(f);
  const std::string& method = f.text("method");
  if (method != "quasi" && !is_ruled(strip))
    throw FieldError(
        "of", fmt::format("the surface is not ruled: its {} lines are not straight", strip.lines_along_v() ? "v" : "u"),
        "lines: u or v says which parameter runs along straight lines; method: quasi takes any surface");
  if (method == "exact") check_developable(strip);
  if (f.has("widening") != (method == "improved"))
    throw FieldError(f.has("widening") ? "widening" : "method", "a widening of the directrix is of method: improved",
                     f.has("widening") ? "leave it out" : "give widening: the number q");
  const double q = f.has("widening") ? f.number("widening") : 0;
  const Frame& frame = f.frame();
  const auto in_plane = [&](const Vec2& p) { return p.x * frame.x + p.y * frame.y; };
  const double size = bounds(*f.surface("of")).diameter();
  const std::vector<Interval> stretches = strip.stretches();

  const Polynomials angle =
      integral_of([&](double t) { return Vec3(strip.turning(t), 0, 0); }, stretches, Vec3(0), kSame);
  // A vector of the tangent plane on the directrix, laid out.
  const auto laid = [&](double t, const Vec3& vector) {
    const Vec2 p = strip.local(t, vector);
    const double a = angle->point(t).x, c = std::cos(a), s = std::sin(a);
    return in_plane({c * p.x - s * p.y, s * p.x + c * p.y});
  };
  const auto widened = [&](double t) {
    const Vec3 l = strip.line(t), image = laid(t, l);
    const Vec2 p = strip.local(t, l);
    return image + q * p.x / p.y * glm::cross(frame.z, image);
  };
  const Polynomials path =
      integral_of([&](double t) { return (1 + q) * laid(t, strip.rho(t, 1)); }, stretches, frame.origin, kSame * size);
  const double per_line = kSame * size / strip.along().width();
  Family family{{path, approximated(widened, stretches, per_line)},
                {one_function(strip.along()), line_function(strip.along(), strip.directrix())}};
  if (method == "quasi") {
    const auto bent = [&](double t) { return laid(t, strip.d(t, strip.directrix(), 0, 2)); };
    family.curves.push_back(approximated(bent, stretches, per_line));
    family.functions.push_back(square_function(strip.along(), strip.directrix()));
  }
  BooleanSum sum;
  (strip.lines_along_v() ? sum.along_u : sum.along_v) = std::move(family);
  return std::any(
      SurfacePtr(std::make_shared<BlendedSurface>(blended_surface(std::move(sum), f.surface("of")->domain()))));
}

}  // namespace

TypeDeclaration development_type() {
  return declare(
             Category::surface, "development",
             "A surface of straight lines unrolled into the plane x, y of a frame, with its parameters. Developable "
             "surfaces (cylinders, cones, tangent surfaces) keep all lengths and angles; others are stretched, and "
             "'lekalo measure --stretch' says by how much.")
      .example("of: { type: cone_surface, radius: 1, top_radius: 0.4, height: 2 }")
      .field("of", reference({Category::surface}), "the surface; bounded")
      .field(
          "method", choice({"exact", "conditional", "improved", "quasi"}),
          "exact: of developable surfaces alone; conditional: of any ruled one, true on the directrix; improved: the "
          "same with a wider directrix; quasi: of any surface, by its tangents along the directrix",
          "exact")
      .optional("lines", choice({"u", "v"}), "the parameter that runs along the straight lines; found where left out")
      .optional(
          "directrix", number(),
          "value of that parameter on the line across the lines that is laid out first; the middle where left out")
      .optional("widening", number().above(-1).at_most(1),
                "of method improved: the directrix becomes 1 + q times as long")
      .field("frame", frame(), "the directrix begins at its origin and along its x", "{}")
      .built_by(development);
}

}  // namespace lekalo::geometry
