#include "geometry/curves/operations/moving_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/numerics/chebyshev.h"
#include "geometry/numerics/halving.h"
#include "geometry/numerics/quadrature.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

namespace {

constexpr int kTerms = PolynomialCurve::kTerms;
using Part = PolynomialCurve::Part;

// The polynomials agree with the direction meant to this.
constexpr double kModelError = 1e-13;
// Parts of a domain that are not divided, relative to it: there the direction jumps or is not defined.
constexpr double kNarrowest = 1e-9;
// Directions on both sides of a break that differ by no more than this are one.
constexpr double kSameDirection = 1e-8;
// A direction is not defined where what is left of it across the curve is below this part of it.
constexpr double kAcross = 1e-6;
// A curve this near a surface lies on it, relative to the surface's size.
constexpr double kOnSurface = 1e-6;
// Points each way among which the search for the foot point of a point begins.
constexpr int kGrid = 48;
// On a part the tangent stays this near (cosine) to that in the middle.
constexpr double kTurned = 0.7;

struct Tangent {
  Vec3 unit;
  Vec3 turn;  // derivative by t
  double speed;
};

// The normal of a surface at the points of a curve that lies on it.
class Base {
 public:
  explicit Base(SurfacePtr surface)
      : surface_(std::move(surface)), domain_(surface_->domain()), periods_(closed_periods(*surface_)) {
    if (!(domain_.u.width() < kInfinity && domain_.v.width() < kInfinity))
      throw FieldError("on", "the surface is unbounded", "give it a domain");
    size_ = bounds(*surface_).diameter();
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; j <= kGrid; ++j) {
        const Vec2 uv(domain_.u.lo + domain_.u.width() * i / kGrid, domain_.v.lo + domain_.v.width() * j / kGrid);
        grid_.push_back({uv, surface_->point(uv.x, uv.y)});
      }
  }

  // None where the point does not lie on the surface.
  std::optional<Vec3> normal(const Vec3& point) const {
    const auto distance = [&](const Start& start) { return glm::dot(start.point - point, start.point - point); };
    Vec2 uv = std::min_element(grid_.begin(), grid_.end(), [&](const Start& a, const Start& b) {
                return distance(a) < distance(b);
              })->uv;
    // Gauss and Newton: of the second order, as nothing is left of the distance in the end.
    for (int i = 0; i < 50; ++i) {
      const SurfaceJet at = surface_->evaluate(uv.x, uv.y, 1);
      const Vec3 off = point - at.point();
      const double e = glm::dot(at.du(), at.du()), f = glm::dot(at.du(), at.dv()), g = glm::dot(at.dv(), at.dv());
      const double det = e * g - f * f;
      if (!(det > 0)) break;
      const double a = glm::dot(at.du(), off), b = glm::dot(at.dv(), off);
      const Vec2 next(inside(uv.x + (g * a - f * b) / det, domain_.u, periods_.u),
                      inside(uv.y + (e * b - f * a) / det, domain_.v, periods_.v));
      const bool stays = glm::length((next - uv) / Vec2(domain_.u.width(), domain_.v.width())) <= 1e-15;
      uv = next;
      if (stays) break;
    }
    if (!(glm::length(surface_->point(uv.x, uv.y) - point) <= kOnSurface * size_)) return std::nullopt;
    return surface_->normal(uv.x, uv.y);
  }

 private:
  struct Start {
    Vec2 uv;
    Vec3 point;
  };
  // Over a seam to the other side.
  static double inside(double x, const Interval& range, double period) {
    return period > 0 ? wrapped(x, range) : range.clamp(x);
  }

  SurfacePtr surface_;
  Rectangle domain_;
  Periods periods_;
  double size_ = 0;
  std::vector<Start> grid_;
};

class Builder {
 public:
  Builder(const Curve& curve, const FrameLaw& direction) : curve_(curve), law_(direction), domain_(curve.domain()) {
    if (direction.kind == FrameKind::on_surface) base_.emplace(direction.on);
  }

  std::vector<Part> build() {
    if (law_.kind != FrameKind::rotation_minimizing) {
      each_piece([&](const Interval& piece) { cut(piece, [&](double t) { return direct(t); }); });
      return std::move(parts_);
    }
    start_ =
        across(domain_.lo, law_.start == Vec3(0) ? frame_about({}, tangent(domain_.lo).unit).x : law_.start, "start");
    length_ = 0;
    carry();
    const double length = length_;
    double turn = law_.twist;
    const Tangent first = tangent(domain_.lo), last = tangent(next_down(domain_.hi));
    if (curve_.is_closed() && glm::length(first.unit - last.unit) <= kSameDirection)
      turn += std::atan2(glm::dot(start_, glm::cross(last.unit, end_)), glm::dot(start_, end_));
    if (turn == 0) return std::move(parts_);
    twist_ = turn / length;
    parts_.clear();
    carry();
    return std::move(parts_);
  }

 private:
  [[noreturn]] void refuse(const char* what, double t, const char* hint, const char* field = "of") const {
    throw FieldError(field, fmt::format("{} at t = {:.6g}", what, t), hint);
  }

  Tangent tangent(double t) const {
    const CurveJet at = curve_.evaluate(t, 2);
    const double speed = glm::length(at.d[1]);
    if (!(speed > 0)) refuse("the curve rests", t, "what goes along it needs a tangent everywhere");
    if (!(speed < kInfinity)) refuse("the derivative has no bounds", t, "what goes along it needs a smooth curve");
    const Vec3 unit = at.d[1] / speed;
    return {unit, (at.d[2] - glm::dot(at.d[2], unit) * unit) / speed, speed};
  }

  Vec3 across(double t, const Vec3& direction, const char* field) const {
    const Vec3 unit = tangent(t).unit;
    const Vec3 rest = direction - glm::dot(direction, unit) * unit;
    if (!(glm::length(rest) > kAcross * glm::length(direction)))
      refuse("the curve runs along this direction", t, "choose one across the curve", field);
    return glm::normalize(rest);
  }
  // Near t too little is left of the fixed direction for the figures of the part across the curve. Newton's iteration
  // leads to where the least is.
  [[noreturn]] void refuse_near_along(double t) const {
    const Vec3& d = law_.fixed;
    for (int i = 0; i < 20; ++i) {
      const Tangent at = tangent(t);
      const Vec3 off = glm::cross(at.unit, d), change = glm::cross(at.turn, d);
      if (const double square = glm::dot(change, change); square > 0)
        t = domain_.clamp(t - glm::dot(off, change) / square);
    }
    across(t, d, "across");
    refuse("the curve runs nearly along this direction", t, "choose one across the curve", "across");
  }

  // The kinds that are known at each place by itself.
  Vec3 direct(double t) const {
    if (law_.kind == FrameKind::fixed) return across(t, law_.fixed, "across");
    const Tangent at = tangent(t);
    if (base_) {
      const auto normal = base_->normal(curve_.point(t));
      if (!normal) refuse("the curve does not lie on the surface", t, "to lie flat it must lie on it", "on");
      return across(t, glm::cross(*normal, at.unit), "on");
    }
    if (!(glm::length(at.turn) > 0)) refuse_straight(t);
    const Vec3 normal = glm::normalize(at.turn);
    return law_.kind == FrameKind::normal ? normal : glm::cross(at.unit, normal);
  }
  [[noreturn]] void refuse_straight(double t) const {
    refuse("the curve is straight and has no normal", t, "across: rotation_minimizing suits any smooth curve",
           "across");
  }

  // Calls visit(piece) for the curve's smooth pieces; they must meet without corners.
  template <class Visit>
  void each_piece(const Visit& visit) {
    Vec3 before(0);
    for (const CurvePiece& piece : curve_.pieces()) {
      const Vec3 begin = tangent(piece.domain.lo).unit;
      if (before != Vec3(0) && glm::length(begin - before) > kSameDirection)
        refuse("the curve has a corner", piece.domain.lo, "what goes along it needs a smooth curve");
      before = tangent(next_down(piece.domain.hi)).unit;
      visit(piece.domain);
    }
    // The normals of pieces that meet smoothly may still jump.
    for (size_t i = 1; i < parts_.size(); ++i)
      if (glm::length(parts_[i - 1].value(1) - parts_[i].value(-1)) > kSameDirection)
        refuse("the curve's normal jumps", parts_[i].t.lo, "across: rotation_minimizing suits any smooth curve",
               "across");
  }

  // Adds the interpolating polynomial of w(t); false if it is not good enough.
  template <class Direction>
  bool add_part(const Interval& t, const Direction& w) {
    const auto at = [&](double x) { return w(t.middle() + 0.5 * t.width() * x); };
    std::array<Vec3, kTerms> values;
    for (int j = 0; j < kTerms; ++j) values[j] = at(chebyshev_point(j, kTerms));
    const Part part{t, 2 / t.width(), powers_of_chebyshev(chebyshev_coefficients(values))};
    for (const double x : {-0.9999, -0.6, -0.2, 0.35, 0.8, 0.9999})
      if (!(glm::length(part.value(x) - at(x)) <= kModelError)) return false;
    parts_.push_back(part);
    return true;
  }

  template <class Direction>
  void cut(const Interval& t, const Direction& w) {
    if (add_part(t, w)) return;
    if (t.width() <= kNarrowest * domain_.width() || !can_be_halved(t)) {
      if (base_)
        refuse("the surface has a crease or a pole", t.middle(), "a ribbon lies flat on smooth surfaces", "on");
      if (law_.kind == FrameKind::fixed) refuse_near_along(t.middle());
      refuse_straight(t.middle());
    }
    cut({t.lo, t.middle()}, w);
    cut({t.middle(), t.hi}, w);
  }

  void carry() {
    end_ = start_;
    each_piece([&](const Interval& piece) { carry(piece); });
  }

  // Rotation-minimizing over an interval, beginning with end_. With e1 the part of a fixed vector e across the tangent
  // T, e2 = T x e1, w = cos(a) e1 + sin(a) e2 turns no more than it must if
  //
  //   a' = -e1' . e2 = (e . T)(T' . e2)/|e - (e . T) T|,   to which the twist adds its share of the length.
  void carry(const Interval& t) {
    const Tangent middle = tangent(t.middle());
    const Vec3 e = frame_about({}, middle.unit).x;
    bool even = true;
    const auto frame = [&](const Vec3& T) {
      even = even && glm::dot(T, middle.unit) >= kTurned;
      const Vec3 e1 = glm::normalize(e - glm::dot(e, T) * T);
      return std::pair(e1, glm::cross(T, e1));
    };
    struct Rates {
      double angle, length;
    };
    const auto rates = [&](double x) -> Rates {
      const Tangent at = tangent(x);
      const Vec3 e2 = frame(at.unit).second;
      const double along = glm::dot(e, at.unit);
      return {along * glm::dot(at.turn, e2) / std::sqrt(std::max(1 - along * along, 1e-300)) + twist_ * at.speed,
              at.speed};
    };
    static const GaussRule rule = gauss_legendre(16);
    const auto integral = [&](double from, double to) {
      Rates sum{0, 0};
      const double half = 0.5 * (to - from);
      for (size_t i = 0; i < rule.nodes.size(); ++i) {
        const Rates at = rates(from + half * (1 + rule.nodes[i]));
        sum.angle += rule.weights[i] * half * at.angle;
        sum.length += rule.weights[i] * half * at.length;
      }
      return sum;
    };
    const auto [a1, a2] = frame(tangent(t.lo).unit);
    const double begin = std::atan2(glm::dot(end_, a2), glm::dot(end_, a1));
    const auto w = [&](double x) {
      const auto [e1, e2] = frame(tangent(x).unit);
      const double angle = begin + integral(t.lo, x).angle;
      return std::cos(angle) * e1 + std::sin(angle) * e2;
    };
    // The integral is good where its halves make the same of it. The middle is rounded: of a short piece that alone is
    // more than the error, so both halves go by the same middle.
    const Rates all = integral(t.lo, t.hi), first = integral(t.lo, t.middle()), second = integral(t.middle(), t.hi);
    const bool good = even && std::abs(first.angle + second.angle - all.angle) <= kModelError &&
                      std::abs(first.length + second.length - all.length) <= 1e-13 * all.length;
    if (good && add_part(t, w)) {
      end_ = w(next_down(t.hi));
      length_ += all.length;
      return;
    }
    if (t.width() <= kNarrowest * domain_.width())
      refuse("the curve turns too fast to be followed", t.middle(), "what goes along it needs a smooth curve");
    carry({t.lo, t.middle()});
    carry({t.middle(), t.hi});
  }

  const Curve& curve_;
  const FrameLaw& law_;
  std::optional<Base> base_;
  Interval domain_;
  std::vector<Part> parts_;
  Vec3 start_{0}, end_{0};
  double length_ = 0, twist_ = 0;
};

}  // namespace

std::shared_ptr<const PolynomialCurve> direction_across(const Curve& curve, const FrameLaw& law) {
  if (!(curve.domain().width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a domain");
  return std::make_shared<PolynomialCurve>(Builder(curve, law).build());
}

FrameLaw read_frame_law(const Fields& f) {
  FrameLaw law;
  const std::string word = f.word("across");
  law.kind = word == "normal"                ? FrameKind::normal
             : word == "binormal"            ? FrameKind::binormal
             : word == "rotation_minimizing" ? FrameKind::rotation_minimizing
                                             : FrameKind::fixed;
  if (law.kind == FrameKind::fixed) law.fixed = f.vec3("across");
  if (f.has("on")) {
    if (f.given("across"))
      throw FieldError("across", "the frame follows a direction or a surface, not both", "leave out 'across' or 'on'");
    law.kind = FrameKind::on_surface;
    law.on = f.surface("on");
  }
  for (const char* field : {"start", "twist"})
    if (f.given(field) && law.kind != FrameKind::rotation_minimizing)
      throw FieldError(field, fmt::format("'{}' is of frames that turn no more than they must", field),
                       "leave it out, or across: rotation_minimizing");
  if (f.has("start")) law.start = f.vec3("start");
  if (f.has("twist")) law.twist = f.number("twist");
  return law;
}

}  // namespace lekalo::geometry
