#include "geometry/shapes/implicit/implicit_surface.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "geometry/numerics/crossings.h"
#include "geometry/shapes/implicit/sign_changes.h"

namespace lekalo::geometry {

namespace {

constexpr int kTried = 16;            // places along each axis where F must have a value
constexpr int kMaxCells = 4096;       // with models
constexpr int kMaxBoundCells = 1024;  // that only bound a polynomial's surface
// The computed place of a point is never further from the surface, of the region's size: at singular points the
// formula's rounding is all that is known.
constexpr double kWorstPlace = 1e-7;
constexpr double kGoodPlace = 1e-11;
// How near to a change of sign the line's own place is, of the region's size: what cells and halving leave.
constexpr double kPlaceOnLine = 1e-13;

// A bound on the errors of F - level in Bernstein form, halvings included, on segments in the box.
double noise_of(const LinePolynomial& polynomial, double level, const Box3& box) {
  return 2 * (polynomial.rounding(box) + 0x1p-53 * std::abs(level));
}

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
bool has_value(const Vec3& v) { return !(std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z)); }

// Whether a gradient is infinite, or as good as that: its square is.
bool is_steep(const Vec3& gradient) { return has_value(gradient) && largest(gradient) > 1e150; }

// The direction of a gradient; of one that is infinite along some axes that of these alone, its limit. Zero where it is
// zero or has no value.
Vec3 direction_of(const Vec3& gradient) {
  const double most = largest(gradient);
  if (!has_value(gradient) || most == 0) return Vec3(0);
  Vec3 share = gradient / most;
  if (most == kInfinity)
    for (int k = 0; k < 3; ++k) share[k] = std::isinf(gradient[k]) ? std::copysign(1.0, gradient[k]) : 0;
  return glm::normalize(share);
}

// F - level between two places.
class OnChord final : public BernsteinSource {
 public:
  // `noise` bounds the errors on all chords of the region.
  OnChord(const LinePolynomial& polynomial, const ImplicitFormula& formula, double noise, const Vec3& from,
          const Vec3& to)
      : polynomial_(polynomial), formula_(formula), noise_(noise), from_(from), to_(to) {}

  double coefficients(double s0, double s1, double* b) const override {
    const bool whole = s0 == 0 && s1 == 1;
    const Vec3 p = whole ? from_ : at(s0), q = whole ? to_ : at(s1);
    polynomial_.along(p, q, b);
    for (int i = 0; i <= polynomial_.degree(); ++i) b[i] -= formula_.level();
    return whole ? noise_ : noise_of(polynomial_, formula_.level(), {glm::min(p, q), glm::max(p, q)});
  }
  bool is_touched(double s, bool positive) const override { return formula_.has_sheets(at(s), positive); }

 private:
  Vec3 at(double s) const { return (1 - s) * from_ + s * to_; }

  const LinePolynomial& polynomial_;
  const ImplicitFormula& formula_;
  double noise_;
  Vec3 from_, to_;
};

void require_values(const ImplicitFormula& formula, const ImplicitRegion& region) {
  const Vec3 center = region.box.center(), size = region.box.size();
  for (int i = 0; i <= kTried; ++i)
    for (int j = 0; j <= kTried; ++j)
      for (int k = 0; k <= kTried; ++k) {
        const Vec3 p = region.box.lo + size * Vec3(i, j, k) / double(kTried);
        if (region.is_ball && glm::length(p - center) > region.radius()) continue;
        if (!std::isnan(formula(p))) continue;
        throw FieldError("formula",
                         fmt::format("the formula has no value at x = {:g}, y = {:g}, z = {:g}", p.x, p.y, p.z),
                         "choose a region where every root, logarithm and the like has a value");
      }
}

}  // namespace

ImplicitSurface::ImplicitSurface(Expression expression, double level, const ImplicitRegion& region, bool closed)
    : formula_(std::move(expression), level), region_(region), size_(glm::length(region.box.size())), closed_(closed) {
  const Box3& box = region.box;
  const Vec3 size = box.size();
  const char* const field = region.is_ball ? "ball" : "box";
  if (!box.bounded() || !(size.x > 0 && size.y > 0 && size.z > 0))
    throw FieldError(field, "the region is empty", "every coordinate of max must be larger than that of min");
  require_values(formula_, region_);
  polynomial_ = LinePolynomial::of(formula_.expression());
  if (polynomial_ && polynomial_->degree() == 0)
    throw FieldError("formula", "the formula is constant: it names none of x, y, z");
  const auto outside = [&](const Box3& cell) { return region.is_ball && region.misses(cell); };
  ImplicitCells cells(formula_, box, outside, polynomial_ ? kMaxBoundCells : kMaxCells, !polynomial_);
  if (cells.where_zero().empty()) {
    const bool above = formula_(box.center()) > 0;
    throw FieldError(field,
                     fmt::format("the surface does not meet the region: the formula is {} than the level there",
                                 above ? "larger" : "smaller"),
                     "choose another level or region");
  }
  // The solid may fill what has no zero.
  bounds_ = closed ? box : cells.where_zero();
  ends_at_bounds_ = bounds_.lo != box.lo || bounds_.hi != box.hi;
  if (polynomial_)
    noise_ = noise_of(*polynomial_, level, box);
  else
    cells_ = std::move(cells);
}

bool ImplicitSurface::find_chord(const Line& line, Chord& chord) const {
  // The border of the region, then the box of what is shown of it: where that cuts off more there is nothing.
  chord = {-kInfinity, kInfinity};
  const auto clip = [&](const Box3& box, bool is_border) {
    for (int k = 0; k < 3; ++k) {
      const double o = line.origin[k], d = line.direction[k];
      if (d == 0) {
        if (o < box.lo[k] || o > box.hi[k]) return false;
        continue;
      }
      const double lo = (box.lo[k] - o) / d, hi = (box.hi[k] - o) / d;
      const double from = d > 0 ? lo : hi, to = d > 0 ? hi : lo;
      const int from_face = 1 + 2 * k + (d > 0 ? 0 : 1), to_face = 1 + 2 * k + (d > 0 ? 1 : 0);
      if (from > chord.t0) chord.t0 = from, chord.enter = is_border ? from_face : -1;
      if (to < chord.t1) chord.t1 = to, chord.leave = is_border ? to_face : -1;
    }
    return chord.t0 < chord.t1;
  };
  if (!region_.is_ball) return clip(region_.box, true) && (!ends_at_bounds_ || clip(bounds_, false));
  // |o + t d - c|^2 = r^2, from the place nearest to the centre.
  const Vec3 off = region_.box.center() - line.origin;
  const double square = glm::dot(line.direction, line.direction), foot_point = glm::dot(off, line.direction) / square;
  const Vec3 across = off - foot_point * line.direction;
  const double rest = region_.radius() * region_.radius() - glm::dot(across, across);
  if (!(rest > 0)) return false;
  const double half = std::sqrt(rest / square);
  chord = {foot_point - half, foot_point + half, 1, 1};
  return !ends_at_bounds_ || clip(bounds_, false);
}

void ImplicitSurface::find(const Line& given, const Interval& t, bool first_only, std::vector<SurfaceHit>& hits) const {
  // From an origin near the region: a line that begins far away loses no digits beyond those of its t.
  const double foot_point =
      glm::dot(region_.box.center() - given.origin, given.direction) / glm::dot(given.direction, given.direction);
  if (!std::isfinite(foot_point)) return;  // neither is the line
  const Line line{given.at(foot_point), given.direction};
  Chord chord;
  if (!find_chord(line, chord)) return;
  if (t.lo - foot_point > chord.t0) chord.t0 = t.lo - foot_point, chord.enter = -1;
  if (t.hi - foot_point < chord.t1) chord.t1 = t.hi - foot_point, chord.leave = -1;
  if (!(chord.t0 < chord.t1)) return;
  const Vec3 from = line.at(chord.t0), to = line.at(chord.t1);
  const auto meet_border = [&](double at, int face, bool inside) {
    if (closed_ && inside && face > 0) hits.push_back({at + foot_point, 0, 0, face, 0});
  };
  if (!polynomial_) {
    SignChanges changes(hits, foot_point, first_only, closed_);
    if (closed_) {
      changes.begin(is_positive(formula_(from)));
      meet_border(chord.t0, chord.enter, !changes.positive());
      if (first_only && !hits.empty()) return;
    }
    cells_->follow(line, chord.t0, chord.t1, changes);
    if (changes.is_done() || !closed_) return;
    changes.pass(chord.t1, is_positive(formula_(to)));
    meet_border(chord.t1, chord.leave, !changes.positive());
    return;
  }
  const OnChord on_chord(*polynomial_, formula_, noise_, from, to);
  Crossings crossings;
  find_crossings(on_chord, polynomial_->degree(), first_only, crossings);
  meet_border(chord.t0, chord.enter, !crossings.begins_positive);
  if (first_only && !hits.empty()) return;
  for (int i = 0; i < crossings.count; ++i)
    hits.push_back({foot_point + chord.t0 + crossings.s[i] * (chord.t1 - chord.t0)});
  if (first_only && !hits.empty()) return;
  meet_border(chord.t1, chord.leave, !crossings.ends_positive);
}

void ImplicitSurface::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  find(line, t, false, hits);
}

bool ImplicitSurface::first_hit(const Line& line, const Interval& t, SurfaceHit& hit) const {
  static thread_local std::vector<SurfaceHit> hits;  // its room is kept
  hits.clear();
  find(line, t, true, hits);
  if (hits.empty()) return false;
  hit = hits.front();
  return true;
}

ShapePoint ImplicitSurface::border_point(int face, const Vec3& near) const {
  ShapePoint at;
  at.position = near;
  if (region_.is_ball) {
    const Vec3 center = region_.box.center();
    at.normal = glm::normalize(near - center);
    at.position = center + region_.radius() * at.normal;
    return at;
  }
  const int axis = (face - 1) / 2;
  const bool upper = (face - 1) % 2 == 1;
  at.position[axis] = upper ? region_.box.hi[axis] : region_.box.lo[axis];
  at.normal = Vec3(0);
  at.normal[axis] = upper ? 1 : -1;
  return at;
}

// One step of Newton's iteration along the gradient leads from the line's own place to the surface.
ShapePoint ImplicitSurface::point(const SurfaceHit& hit, const Vec3& near) const {
  if (hit.face > 0) return border_point(hit.face, near);
  const double worst = kWorstPlace * size_;
  ShapePoint at;
  at.position = near;
  Vec3 slope;
  double value;
  if (polynomial_) {
    const Vec4 both = polynomial_->at(near);
    slope = Vec3(both);
    value = both.w - formula_.level();
  } else {
    const auto both = formula_.with_gradient(near.x, near.y, near.z);
    slope = {both.c[1], both.c[2], both.c[3]};
    value = both.c[0];
  }
  const double square = glm::dot(slope, slope), length = std::sqrt(square);
  if (square > 0 && square < kInfinity) {
    if (std::abs(value) <= worst * length) at.position -= value / square * slope;
    // The bound for the whole region is mostly good enough.
    double rounding = polynomial_ ? noise_ : cells_->rounding();
    if (polynomial_ && rounding > kGoodPlace * size_ * length)
      rounding = noise_of(*polynomial_, formula_.level(), {near, near});
    at.error = std::min(2 * rounding / length, worst);
    at.normal = slope / length;
  } else if (is_steep(slope)) {
    at.error = kPlaceOnLine * size_;
    at.normal = direction_of(slope);
  } else {
    // A singular point: a normal of its surroundings.
    at.error = worst;
    for (const Vec3& by : {Vec3(1, 0.3, 0.1), Vec3(0.1, 1, 0.3), Vec3(0.3, 0.1, 1)}) {
      const Vec3 beside = direction_of(gradient(near + worst * by));
      if (beside == Vec3(0)) continue;
      at.normal = beside;
      break;
    }
  }
  return at;
}

std::optional<Mat3> ImplicitSurface::shape_operator(const SurfaceHit& hit, const Vec3& near) const {
  const Vec3 m = point(hit, near).normal;
  const Mat3 along = Mat3(1) - glm::outerProduct(m, m);
  if (hit.face > 0) return region_.is_ball ? (-1 / region_.radius()) * along : Mat3(0);
  const auto at = formula_.with_second(near.x, near.y, near.z);
  const double length = glm::length(Vec3(at.c[1], at.c[2], at.c[3]));
  // Coefficients of Jet3 are derivatives by the factorials: x^2, xy, xz, y^2, yz, z^2.
  const Mat3 second(2 * at.c[4], at.c[5], at.c[6], at.c[5], 2 * at.c[7], at.c[8], at.c[6], at.c[8], 2 * at.c[9]);
  const Mat3 result = (-1 / length) * (along * second * along);
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(result[k].x + result[k].y + result[k].z)) return std::nullopt;
  return result;
}

TypeDeclaration implicit_type() {
  return declare(
             Category::shape, "implicit",
             "Surface F(x, y, z) = level inside a box or a ball, met by lines directly: no triangles. The normal is "
             "the gradient of F, so F < level is the inner side. Polynomials up to degree 24 are fastest; any "
             "formula goes, and the surface may meet itself and have singular points. It has no parameters: to "
             "textures u = v = 0.")
      .example("formula: x^4 + y^4 + z^4 - 1, ball: { radius: 1.5 }")
      .field("formula", formula({"x", "y", "z"}), "F, a formula of x, y and z")
      .field("level", number(), "value of F on the surface", "0")
      .optional("box",
                group({{"min", point(), "corner of least coordinates", true, {}},
                       {"max", point(), "corner of largest coordinates", true, {}}}),
                "region: what lies outside is cut off")
      .optional("ball",
                group({{"center", point(), "center", false, "[0, 0, 0]"},
                       {"radius", length().positive(), "radius", true, {}}}),
                "region, in place of box")
      .field("closed", boolean(), "the border of the solid F <= level: the region's own border closes it where it cuts",
             "false")
      .built_by([](const Fields& f) -> ShapePtr {
        if (f.has("box") == f.has("ball"))
          throw FieldError(f.has("box") ? "ball" : "",
                           f.has("box") ? "both 'box' and 'ball' are given" : "an implicit surface needs a region",
                           f.has("box") ? "leave one out"
                                        : "write box: { min: [-1, -1, -1], max: [1, 1, 1] }, or ball: { radius: 1 }");
        ImplicitRegion region;
        if (f.has("box"))
          region.box = {f.group("box").vec3("min"), f.group("box").vec3("max")};
        else
          region = ImplicitRegion::ball(f.group("ball").vec3("center"), f.group("ball").number("radius"));
        return std::make_shared<ImplicitSurface>(f.get<Expression>("formula"), f.number("level"), region,
                                                 f.boolean("closed"));
      });
}

}  // namespace lekalo::geometry
