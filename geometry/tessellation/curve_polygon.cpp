// Polygons of curves with a bound on the sag (Golovanov 2016, 8.3).
//
// The step that gives sag d on the osculating circle of radius rho is
//   dt = 2 rho arccos(1 - d/rho) / |c'|,   rho = |c'|^3 / |c' x c''|                                (8.3.1, exact form)
// Its inverse is the density of polygon points. Points are spread so that every chord takes the same share of the
// integral of the density; then the sag of every chord is measured, and the density raised where it is too large.
// A chord whose bound dt^2 max|c''| / 8 (Filip, Magedson, Markot 1986) from a certified enclosure is within the
// tolerance needs no measuring.
#include "geometry/tessellation/curve_polygon.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/tessellation/density.h"

namespace lekalo::geometry {

namespace {

// The largest number of chords of one curve; a tolerance that needs more is a mistake.
constexpr double kMaxChords = 4e6;

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

double largest_length(const Box3& box) { return glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))); }

// Distance of p from the segment a b.
double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double squared = glm::dot(ab, ab);
  const double t = squared > 0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + t * ab));
}

double density_at(const Curve& curve, double t, const TessellationTolerance& tolerance) {
  const CurveJet jet = curve.evaluate(t, 2);
  const double speed = glm::length(jet.d[1]);
  const double bend = glm::length(glm::cross(jet.d[1], jet.d[2]));
  if (!(speed > 0) || !(bend > 0)) return 0;
  const double radius = speed * speed * speed / bend;
  const double sag = std::min(tolerance.sag_near(jet.d[0]) / radius, 1.0);
  // arccos(1 - x), which loses all figures of a small x: on a curve straight but for rounding.
  const double turn = std::min(4 * std::asin(std::sqrt(0.5 * sag)), tolerance.angle);
  return speed / (radius * turn);
}

}  // namespace

std::vector<double> corner_parameters(const Curve& curve) {
  const Interval domain = curve.domain();
  if (!(domain.lo > -kInfinity && domain.hi < kInfinity))
    throw std::invalid_argument("an unbounded curve has no polygon; give it a range");
  std::vector<double> result{domain.lo};
  const std::vector<CurvePiece> pieces = curve.pieces();
  for (size_t i = 1; i < pieces.size(); ++i) {
    const double t = pieces[i].domain.lo;
    if (!(t > result.back() && t < domain.hi)) continue;
    // A difference of direction across the joint beyond what curvature makes over this short a way.
    const double before = t - 1e-7 * pieces[i - 1].domain.width(), after = t + 1e-7 * pieces[i].domain.width();
    const Vec3 arriving = curve.evaluate(before, 1).d[1], leaving = curve.evaluate(after, 1).d[1];
    const bool defined = glm::length(arriving) > 0 && glm::length(leaving) > 0;
    if (!defined || angle_between(arriving, leaving) > 1e-4) result.push_back(t);
  }
  result.push_back(domain.hi);
  return result;
}

double chord_excess(const Curve& curve, double a, double b, const TessellationTolerance& tolerance) {
  const CurveJet first = curve.evaluate(a, 1), last = curve.evaluate(b, 1);
  const double sag_limit = tolerance.sag_near(curve.point(0.5 * (a + b)));
  // Tangents are taken a little inside, where they belong to this chord even if it ends in a corner.
  const double inset = 1e-6 * (b - a);
  const Vec3 start = curve.evaluate(a + inset, 1).d[1], end = curve.evaluate(b - inset, 1).d[1];
  // In a cusp it turns however short the chord is.
  const bool is_short = glm::length(last.d[0] - first.d[0]) <= sag_limit;
  const double turn = is_short ? 0 : angle_between(start, end) / tolerance.angle;

  const double bound = (b - a) * (b - a) * largest_length(curve.enclose({a, b}, 2).d[2]) / 8;
  if (bound <= sag_limit) return turn;
  double sag = 0;
  for (int k = 1; k < 8; ++k)
    sag = std::max(sag, distance_to_segment(curve.point(a + (b - a) * k / 8), first.d[0], last.d[0]));
  return std::max(sag / sag_limit, turn);
}

std::vector<double> smooth_polygon(const Curve& curve, double a, double b, const TessellationTolerance& tolerance) {
  // Where the density is sampled: parts of the smooth pieces, more of them where there are few pieces.
  std::vector<Interval> spans;
  for (const CurvePiece& piece : curve.pieces()) {
    const Interval span = intersect(piece.domain, {a, b});
    if (span.width() > 0) spans.push_back(span);
  }
  const int parts = std::max(4, 32 / static_cast<int>(std::max<size_t>(1, spans.size())));
  LineDensity density;
  density.at.push_back(a);
  for (const Interval& span : spans) {
    for (int k = 0; k < parts; ++k) {
      const double width = span.width() / parts, start = span.lo + k * width;
      double value = 0;
      for (double inside : {0.05, 0.5, 0.95})
        value = std::max(value, density_at(curve, start + inside * width, tolerance));
      density.at.push_back(k + 1 == parts ? span.hi : start + width);
      density.value.push_back(value);
    }
  }
  density.at.back() = b;
  // A chord of a closed curve must not fall on another one.
  const bool round = curve.is_closed() && b - a >= curve.domain().width();
  for (int round_number = 0; round_number < 12; ++round_number) {
    if (density.total() > kMaxChords)
      throw std::invalid_argument("the sag is too small: a curve would need more than 4 million chords");
    std::vector<double> result = density.lines(round ? 3 : 1);
    std::vector<double> excess;
    for (size_t i = 0; i + 1 < result.size(); ++i)
      excess.push_back(chord_excess(curve, result[i], result[i + 1], tolerance));
    if (!density.raise(result, excess) || round_number == 11) return result;
  }
  return {a, b};
}

std::vector<double> polygon_parameters(const Curve& curve, const TessellationTolerance& tolerance) {
  const std::vector<double> corners = corner_parameters(curve);
  std::vector<double> result{corners.front()};
  for (size_t i = 0; i + 1 < corners.size(); ++i) {
    const std::vector<double> part = smooth_polygon(curve, corners[i], corners[i + 1], tolerance);
    result.insert(result.end(), part.begin() + 1, part.end());
  }
  return result;
}

}  // namespace lekalo::geometry
