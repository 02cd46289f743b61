#include "geometry/curves/operations/arc_blend_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/arc_fraction.h"
#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/describe.h"
#include "geometry/formula.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

namespace {

// Segments tried for a tolerance, each time twice as many.
constexpr int kMaxSegments = 1 << 14;
// Cosine of half an arc's angle: nearer to a half circle its ends are too steep over the chord.
constexpr double kHalfCircle = 1e-5;
// Sine of the angle between tangents of neighbouring pieces that are one.
constexpr double kCorner = 1e-6;

// The vector a of the circle through A, P and Q = P + l e.
Vec3 bend_from(const Vec3& a, const Vec3& p, const Vec3& q, const Vec3& along) {
  const Vec3 way = p - a;
  return 2 / (glm::length(way) * glm::length(q - a)) * (way - glm::dot(way, along) * along);
}

void check_arc(const Vec3& a, const Vec3& p, const Vec3& q, int from, int to) {
  if (glm::dot(p - a, q - a) > kHalfCircle * glm::length(p - a) * glm::length(q - a)) return;
  throw FieldError(
      "points",
      fmt::format("the arc from node {} to node {} that a neighbour prescribes is a half circle or more", from, to),
      "put a node between them");
}

// What is known of the curve over one segment.
struct SegmentBounds {
  double chord = 0, length = 0;
  double lowest = kInfinity, highest = -kInfinity;  // curvature, signed of plane curves
  double torsion = 0;                               // integral of its size
};

constexpr int kPlaces = 32;

struct Frenet {
  Vec3 bend;  // r' x r'' / |r'|^3
  double speed, torsion;
};

Frenet frenet(const CurveJet& jet) {
  const Vec3 area = glm::cross(jet.d[1], jet.d[2]);
  const double speed = glm::length(jet.d[1]), square = glm::dot(area, area);
  const double torsion = square > 0 ? glm::dot(area, jet.d[3]) / square : 0;
  return {area / (speed * speed * speed), speed, torsion};
}

// The plane's normal where the curve lies in one.
std::optional<Vec3> normal_of_plane(const Curve& curve, const std::vector<double>& parameters) {
  Vec3 normal(0);
  double out = 0, size = 0;
  for (const double t : parameters) {
    const Vec3 bend = frenet(curve.evaluate(t, 3)).bend;
    if (glm::length(bend) > glm::length(normal)) normal = bend;
  }
  if (!(glm::length(normal) > 0)) return Vec3(0, 0, 1);
  normal = glm::normalize(normal);
  const Vec3 first = curve.point(parameters.front());
  for (size_t i = 0; i + 1 < parameters.size(); ++i)
    for (const double share : {0.0, 0.37, 0.71}) {
      const Vec3 p = curve.point(parameters[i] + share * (parameters[i + 1] - parameters[i])) - first;
      out = std::max(out, std::abs(glm::dot(p, normal)));
      size = std::max(size, glm::length(p));
    }
  if (out <= 1e-9 * size) return normal;
  return std::nullopt;
}

SegmentBounds segment_bounds(const Curve& curve, double from, double to, const std::optional<Vec3>& normal) {
  SegmentBounds result;
  result.chord = glm::length(curve.point(to) - curve.point(from));
  for (int k = 0; k <= kPlaces; ++k) {
    const Frenet f = frenet(curve.evaluate(k == kPlaces ? to : from + (to - from) * k / kPlaces, 3));
    const double curvature = normal ? glm::dot(f.bend, *normal) : glm::length(f.bend);
    result.lowest = std::min(result.lowest, curvature);
    result.highest = std::max(result.highest, curvature);
    const double step = (to - from) / kPlaces * (k == 0 || k == kPlaces ? 0.5 : 1) * f.speed;
    result.length += step;
    result.torsion += std::abs(f.torsion) * step;
  }
  return result;
}

// The height of an arc of the signed curvature k over a chord; 1 - sqrt(1 - x) = x/(1 + sqrt(1 - x)).
double height(double k, double chord) {
  const double x = 0.25 * k * k * chord * chord;
  return 0.25 * k * chord * chord / (1 + std::sqrt(1 - x));
}

std::optional<ArcBlendBounds> plane_bounds(const SegmentBounds& three, double chord) {
  const double most = std::max(std::abs(three.lowest), std::abs(three.highest)), half = 0.5 * chord * most;
  if (!(half < 1)) return std::nullopt;
  return ArcBlendBounds{height(three.highest, chord) - height(three.lowest, chord),
                        2 * half / std::sqrt(1 - half * half)};
}

std::optional<ArcBlendBounds> space_bounds(const SegmentBounds& three, double chord, double length) {
  const double turn = three.highest * length, twist = three.torsion;
  if (!(turn < 0.5 * kPi && twist < kPi)) return std::nullopt;
  const double cosine = std::cos(turn), highest = three.highest / (cosine * cosine);
  const double lowest = twist <= 0.5 * kPi ? three.lowest * std::cos(twist) : -highest;
  if (!(0.5 * chord * highest < 1)) return std::nullopt;
  const double h1 = height(highest, chord), h2 = height(lowest, chord);
  const double between = 2 * std::atan(std::tan(0.5 * twist) / cosine);
  const double position = std::sqrt(std::max(0.0, h1 * h1 + h2 * h2 - 2 * h1 * h2 * std::cos(between)));
  return ArcBlendBounds{position, turn + std::atan(position / (chord * cosine))};
}

ArcBlendCurve through_curve(const Curve& curve, const ArcFraction& lengths, int count) {
  const std::vector<double> parameters = parameters_at_even_lengths(lengths, curve.domain(), count);
  const bool closed = curve.is_closed();
  std::vector<Vec3> nodes;
  for (size_t i = 0; i + (closed ? 1 : 0) < parameters.size(); ++i) nodes.push_back(curve.point(parameters[i]));
  ArcBlendCurve result(std::move(nodes), closed);
  if (const auto bounds = arc_blend_bounds(curve, parameters)) result.set_bounds(*bounds);
  return result;
}

ArcBlendCurve within(const Curve& curve, const ArcFraction& lengths, double tolerance) {
  for (int count = 4; count <= kMaxSegments; count *= 2) {
    try {
      ArcBlendCurve result = through_curve(curve, lengths, count);
      if (result.bounds() && result.bounds()->position <= tolerance) return result;
    } catch (const FieldError&) {  // arcs of a half circle: too few
    }
  }
  throw FieldError("tolerance", fmt::format("{} segments are not enough for {:.3g}", kMaxSegments, tolerance),
                   "ask for less, or cut the curve at its corners");
}

// The bounds know nothing of corners between their places.
void check_smooth(const Curve& curve) {
  const std::vector<CurvePiece> pieces = curve.pieces();
  for (size_t i = 1; i < pieces.size(); ++i) {
    const Vec3 before = evaluate_within(curve, pieces[i - 1].domain, pieces[i - 1].domain.hi, 1).d[1];
    const Vec3 after = evaluate_within(curve, pieces[i].domain, pieces[i].domain.lo, 1).d[1];
    if (glm::length(glm::cross(before, after)) > kCorner * glm::length(before) * glm::length(after) ||
        glm::dot(before, after) < 0)
      throw FieldError("of", fmt::format("the curve has a corner at t = {:.6g}", pieces[i].domain.lo),
                       "interpolate its smooth parts, one by one");
  }
}

CurvePtr smooth_curve(const Fields& f) {
  const CurvePtr curve = f.curve("of");
  if (!(curve->domain().width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a range");
  check_smooth(*curve);
  return curve;
}

ArcBlendCurve build(const Fields& f) {
  if (f.has("points") == f.has("of"))
    throw FieldError(f.has("of") ? "of" : "points", "the nodes are either `points` or those of a curve, `of`");
  if (f.has("points")) {
    for (const char* field : {"count", "tolerance"})
      if (f.has(field)) throw FieldError(field, "it belongs to nodes of a curve, `of`", "leave it out");
    return ArcBlendCurve(f.points("points"), f.boolean("closed"));
  }
  if (f.given("closed")) throw FieldError("closed", "the curve of `of` is closed or not by itself", "leave it out");
  if (f.has("count") == f.has("tolerance"))
    throw FieldError(f.has("count") ? "count" : "of", "nodes of a curve need either `count` or `tolerance`");
  const CurvePtr curve = smooth_curve(f);
  const ArcFraction lengths(*curve);
  return f.has("count") ? through_curve(*curve, lengths, f.integer("count"))
                        : within(*curve, lengths, f.number("tolerance"));
}

}  // namespace

ArcBlendCurve::ArcBlendCurve(std::vector<Vec3> nodes, bool closed) : closed_(closed), breaks_{0} {
  const int count = static_cast<int>(nodes.size()), segments = closed ? count : count - 1;
  if (count < (closed ? 3 : 2))
    throw FieldError("points", fmt::format("{} nodes are too few: at least {} are needed", count, closed ? 3 : 2));
  // Before arcs are asked, which coinciding nodes bend in any way.
  for (int i = 0; i < segments; ++i)
    if (const int next = (i + 1) % count; !(glm::length(nodes[next] - nodes[i]) > 0))
      throw FieldError("points", fmt::format("nodes {} and {} coincide", i, next),
                       next == 0 ? "closed: true takes unrepeated points" : "leave one of them out");
  for (int i = 0; i < segments; ++i) {
    const int next = (i + 1) % count;
    Segment s;
    s.from = nodes[i];
    s.length = glm::length(nodes[next] - nodes[i]);
    s.along = (nodes[next] - nodes[i]) / s.length;
    const auto bend = [&](int other) {
      const Vec3& a = nodes[(other + count) % count];
      // The circle's curvature does not depend on which of the chord's ends the third node follows.
      check_arc(a, nodes[i], nodes[next], i, next);
      return bend_from(a, nodes[i], nodes[next], s.along);
    };
    const bool has_before = closed || i > 0, has_behind = closed || i + 2 < count;
    if (has_before) s.first = bend(i - 1);
    if (has_behind) s.second = bend(i + 2);
    if (!has_before) s.first = s.second;
    if (!has_behind) s.second = s.first;
    segments_.push_back(s);
    breaks_.push_back(breaks_.back() + s.length);
  }
}

template <class T>
auto ArcBlendCurve::formula(const Segment& s, const T& x) const {
  using std::sqrt;
  const auto rise = [&](const Vec3& bend) {
    const double square = glm::dot(bend, bend);
    const double at_ends = std::sqrt(std::max(0.0, 1 - 0.25 * square * s.length * s.length));
    const T off = x - T(0.5 * s.length);
    return x * (T(s.length) - x) / (T(at_ends) + sqrt(T(1) - T(square) * (off * off)));
  };
  const T share = x * T(1 / s.length);
  return triple(s.from) + x * triple(s.along) + ((T(1) - share) * rise(s.first)) * triple(s.first) +
         (share * rise(s.second)) * triple(s.second);
}

int ArcBlendCurve::segment_at(double t) const {
  const auto above = std::upper_bound(breaks_.begin(), breaks_.end(), t);
  return std::clamp(static_cast<int>(above - breaks_.begin()) - 1, 0, segments() - 1);
}

CurveJet ArcBlendCurve::evaluate(double t, int order) const {
  if (closed_) t = wrapped(t, domain());
  const double inside = domain().clamp(t);
  const int i = segment_at(inside);
  const int evaluated = inside == t ? order : std::max(order, 1);
  CurveJet jet =
      evaluate_curve_formula([&](const auto& x) { return formula(segments_[i], x); }, inside - breaks_[i], evaluated);
  if (inside == t) return jet;
  jet.order = order;
  jet.d[0] += (t - inside) * jet.d[1];
  for (int k = 2; k <= order; ++k) jet.d[k] = Vec3(0);
  return jet;
}

CurveEnclosure ArcBlendCurve::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  const int first = segment_at(t.lo), last = t.hi > t.lo ? segment_at(std::max(t.lo, next_down(t.hi))) : first;
  for (int i = first; i <= last; ++i) {
    const Interval part(std::max(t.lo, breaks_[i]), std::min(t.hi, breaks_[i + 1]));
    Interval x = part - Interval(breaks_[i]);
    x = {std::max(x.lo, 0.0), std::min(x.hi, segments_[i].length)};
    const CurveEnclosure piece =
        enclose_curve_centered([&](const auto& y) { return formula(segments_[i], y); }, x, order);
    for (int k = 0; k <= order; ++k) result.d[k].include(piece.d[k]);
  }
  return result;
}

std::vector<CurvePiece> ArcBlendCurve::pieces() const {
  std::vector<CurvePiece> result;
  for (int i = 0; i < segments(); ++i) {
    CurvePiece piece;
    piece.domain = {breaks_[i], breaks_[i + 1]};
    piece.map = {ParameterMap::Kind::affine, breaks_[i], breaks_[i + 1]};
    result.push_back(piece);
  }
  return result;
}

std::optional<ArcBlendBounds> arc_blend_bounds(const Curve& curve, const std::vector<double>& parameters) {
  const std::optional<Vec3> normal = normal_of_plane(curve, parameters);
  const bool closed = curve.is_closed();
  const int count = static_cast<int>(parameters.size()) - 1;
  std::vector<SegmentBounds> segments;
  for (int i = 0; i < count; ++i) segments.push_back(segment_bounds(curve, parameters[i], parameters[i + 1], normal));
  ArcBlendBounds worst;
  for (int i = 0; i < count; ++i) {
    SegmentBounds three;
    double length = 0;
    for (int j = i - 1; j <= i + 1; ++j) {
      if (!closed && (j < 0 || j >= count)) continue;
      const SegmentBounds& one = segments[(j + count) % count];
      three.lowest = std::min(three.lowest, one.lowest);
      three.highest = std::max(three.highest, one.highest);
      three.torsion += one.torsion;
      length = std::max(length, one.length);
    }
    const double chord = segments[i].chord;
    const auto bounds = normal ? plane_bounds(three, chord) : space_bounds(three, chord, length);
    if (!bounds) return std::nullopt;
    worst.position = std::max(worst.position, bounds->position);
    worst.angle = std::max(worst.angle, bounds->angle);
  }
  return worst;
}

TypeDeclaration arc_blend_curve_type() {
  return declare(Category::curve, "arc_blend_curve",
                 "Smooth curve through nodes, in each segment a mean of the two circles through it and a neighbour: "
                 "circles come out exactly. t is the sum of the chords.")
      .example("points: [[0, 0], [1, 0.8], [2.2, 0.9], [3, 0], [4.2, -0.4]]")
      .optional("points", points().count(2), "the nodes; those of a closed curve are not repeated")
      .field("closed", boolean(), "goes on from the last node to the first", "false")
      .optional("of", reference({Category::curve}),
                "a smooth curve whose points are the nodes instead, evenly spaced in length; `lekalo measure` then "
                "tells how far the interpolant may be from it")
      .optional("count", integer().between(2, kMaxSegments), "of segments, with `of`")
      .optional(
          "tolerance", length().positive(),
          "as many segments, 4, 8, 16 .., as make the bound on the distance from the curve at most this, with `of`")
      .built_by(build);
}

}  // namespace lekalo::geometry
