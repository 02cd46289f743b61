#include "geometry/queries/differential/curvature.h"

#include <array>
#include <cmath>
#include <optional>

#include "geometry/surface_normal.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// From the shape operator in an orthonormal frame of the tangent plane: symmetric, one Jacobi rotation, no cancellation
// of H +- sqrt(H^2 - K).
SurfaceCurvature of_shape_operator(double s11, double s12, double s22, const Vec3& e1, const Vec3& e2) {
  SurfaceCurvature c;
  c.regular = true;
  c.mean = 0.5 * (s11 + s22);
  c.gaussian = s11 * s22 - s12 * s12;
  const double angle = 0.5 * std::atan2(2 * s12, s11 - s22);
  const double half = std::hypot(0.5 * (s11 - s22), s12);
  c.principal[0] = c.mean + half;
  c.principal[1] = c.mean - half;
  c.directions[0] = std::cos(angle) * e1 + std::sin(angle) * e2;
  c.directions[1] = -std::sin(angle) * e1 + std::cos(angle) * e2;
  return c;
}

double largest(const Mat3& m) {
  double result = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result = std::isnan(m[i][j]) ? kInfinity : std::max(result, std::abs(m[i][j]));
  return result;
}

// Limits are taken from this part of the domain away, and from kLimitSteps - 1 halves of it.
constexpr double kLimitFrom = 1.0 / 32;
constexpr int kLimitSteps = 12;

// An area |r_u x r_v| this much smaller than that where the limit starts belongs to a place beside a singular one: a
// derivative along a circle about a pole loses 1e-16/d^2 of its curvature at the distance d.
constexpr double kSmallArea = 3e-3;

// A limit is one if its extrapolations agree to this part of the curvature.
constexpr double kLimitError = 1e-7;

// The limit of the shape operator, by Neville's extrapolation from halved distances; of all its results the one that
// agrees best with those it is made of (Ridders 1982). Nothing if that is worse than kLimitError.
std::optional<Mat3> limit_of_shape(const Surface& surface, double u, double v, double flat) {
  const Vec2 step = inward_step(surface.domain(), u, v);
  std::array<std::array<Mat3, kLimitSteps>, kLimitSteps> table;
  std::optional<Mat3> best;
  double least = kInfinity;
  for (int k = 0; k < kLimitSteps; ++k) {
    const double part = std::ldexp(kLimitFrom, -k);
    const Vec2 place = Vec2(u, v) + part * step;
    const SurfaceJet jet = surface.evaluate(place.x, place.y, 2);
    const SurfaceCurvature there = curvature(jet, surface.normal(place.x, place.y, jet));
    if (!there.regular) break;
    table[k][0] = shape_operator(there);
    for (int j = 1; j <= k; ++j) {
      table[k][j] = table[k][j - 1] + (table[k][j - 1] - table[k - 1][j - 1]) / (std::ldexp(1.0, j) - 1);
      const double error = std::max(largest(table[k][j] - table[k][j - 1]), largest(table[k][j] - table[k - 1][j - 1]));
      if (!(error < least)) continue;
      least = error;
      best = table[k][j];
    }
  }
  if (!best || !(least <= kLimitError * (largest(*best) + flat))) return std::nullopt;
  return best;
}

// Another place on the edge that is a pole, a part of the range away: round the end of the range.
double elsewhere(const Interval& range, double x, double part) {
  if (!(range.width() < kInfinity)) return x + part;
  const double y = x + part * range.width();
  return y <= range.hi ? y : y - range.width();
}

// What rounding leaves of a derivative that vanishes, over the range of its piece and in parts of its size.
constexpr double kRoundingOfJets = 1e-12;

// Of the smooth piece that holds t; beyond the domain of the one at the end. Of an unbounded curve of length 1.
Interval piece_at(const Curve& curve, double t) {
  if (!(curve.domain().width() < kInfinity)) return {t, t + 1};
  const std::vector<CurvePiece> pieces = curve.pieces();
  for (const CurvePiece& piece : pieces)
    if (t < piece.domain.hi) return piece.domain;
  return pieces.empty() ? curve.domain() : pieces.back().domain;
}

}  // namespace

CurveCurvature curvature(const CurveJet& jet) {
  CurveCurvature c;
  const Vec3 &r1 = jet.d[1], &r2 = jet.d[2], &r3 = jet.d[3];
  const double speed = glm::length(r1);
  if (!(speed > 0 && speed < kInfinity)) return c;
  c.has_tangent = c.has_curvature = true;
  c.tangent = r1 / speed;
  const Vec3 b = glm::cross(r1, r2);
  const double area = glm::length(b);
  c.curvature = area / (speed * speed * speed);
  // Parallel within rounding: a straightening point.
  if (!(area > 1e-14 * speed * glm::length(r2))) return c;
  c.has_normal = true;
  c.binormal = b / area;
  c.normal = glm::cross(c.binormal, c.tangent);
  c.torsion = glm::dot(b, r3) / (area * area);
  return c;
}

CurveCurvature curvature(const Curve& curve, double t) {
  constexpr int kOrder = 3;  // all curves have so many derivatives
  const CurveJet jet = curve.evaluate(t, kOrder);
  const Interval piece = piece_at(curve, t);
  // Derivatives over the piece's parameter range: lengths of the size of the piece, as their rounding is.
  std::array<Vec3, kOrder + 1> scaled;
  double size = glm::length(jet.d[0]);
  for (int k = 1; k <= kOrder; ++k) {
    scaled[k] = jet.d[k] * std::pow(piece.width(), k);
    size = std::max(size, glm::length(scaled[k]));
  }
  const double rounding = kRoundingOfJets * size;
  int first = 1;
  while (first <= kOrder && !(glm::length(scaled[first]) > rounding)) ++first;
  if (first > kOrder) return {};
  CurveCurvature c;
  c.has_tangent = true;
  c.tangent = glm::normalize(scaled[first]);
  if (first > 1) {
    if (t >= curve.domain().hi && first % 2 == 0) c.tangent = -c.tangent;
    return c;
  }
  const auto across = [&](const Vec3& v) { return glm::length(glm::cross(c.tangent, v)) > rounding; };
  if (across(scaled[2])) return curvature(jet);
  c.has_curvature = true;
  c.is_straight = !across(scaled[3]);
  for (int k = 0; k < 5; ++k) {  // inside: at the ends corners may begin
    const Vec3 elsewhere = curve.evaluate(piece.lo + piece.width() * (k + 0.5) / 5, 1).d[1];
    c.is_straight = c.is_straight && !across(elsewhere * piece.width());
  }
  return c;
}

SurfaceCurvature curvature(const SurfaceJet& jet, const Vec3& m) {
  const Vec3 &a = jet.du(), &b = jet.dv();
  const double area = glm::length(glm::cross(a, b));
  if (!(area > 1e-14 * glm::length(a) * glm::length(b)) || !(area > 0)) return {};
  const Vec3 e1 = glm::normalize(a), e2 = glm::cross(m, e1);
  const double j11 = glm::dot(a, e1), j12 = glm::dot(b, e1), j22 = glm::dot(b, e2);
  const double b11 = glm::dot(jet.duu(), m), b12 = glm::dot(jet.duv(), m), b22 = glm::dot(jet.dvv(), m);
  // S = J^-T B J^-1 with J upper triangular.
  const double s11 = b11 / (j11 * j11);
  const double s12 = (b12 - j12 * b11 / j11) / (j11 * j22);
  const double s22 = (b22 - 2 * b12 * j12 / j11 + b11 * (j12 / j11) * (j12 / j11)) / (j22 * j22);
  return of_shape_operator(s11, s12, s22, e1, e2);
}

SurfaceCurvature curvature(const Mat3& shape_operator, const Vec3& normal) {
  const Frame tangents = frame_about(Vec3(0), normal);
  const auto of = [&](const Vec3& a, const Vec3& b) { return glm::dot(a, shape_operator * b); };
  return of_shape_operator(of(tangents.x, tangents.x), of(tangents.x, tangents.y), of(tangents.y, tangents.y),
                           tangents.x, tangents.y);
}

// It knows nothing of the parameters.
Mat3 shape_operator(const SurfaceCurvature& c) {
  return c.principal[0] * glm::outerProduct(c.directions[0], c.directions[0]) +
         c.principal[1] * glm::outerProduct(c.directions[1], c.directions[1]);
}

std::optional<Mat3> shape_operator(const Surface& surface, double sign, double u, double v) {
  if (surface.max_order() < 2) return std::nullopt;
  const SurfaceJet jet = surface.evaluate(u, v, 2);
  const SurfaceCurvature c = curvature(jet, sign * surface.normal(u, v, jet));
  if (!c.regular || !std::isfinite(c.principal[0]) || !std::isfinite(c.principal[1])) return std::nullopt;
  return shape_operator(c);
}

SurfaceCurvature curvature(const Surface& surface, double u, double v) {
  const SurfaceJet jet = surface.evaluate(u, v, 2);
  const Vec3 normal = surface.normal(u, v);
  const SurfaceCurvature here = curvature(jet, normal);
  const Rectangle domain = surface.domain();
  const Vec2 step = inward_step(domain, u, v);
  const auto area = [](const SurfaceJet& at) { return glm::length(glm::cross(at.du(), at.dv())); };
  if (area(jet) > kSmallArea * area(surface.evaluate(u + kLimitFrom * step.x, v + kLimitFrom * step.y, 1))) return here;

  const double along_u = glm::length(jet.du() * step.x), along_v = glm::length(jet.dv() * step.y);
  const double reach = std::max(along_u, along_v), flat = 1 / reach;
  const bool singular = !(area(jet) * std::abs(step.x * step.y) > 10 * kNormalLimit * reach * reach);
  const std::optional<Mat3> limit = limit_of_shape(surface, u, v, flat);
  if (!limit) return singular ? SurfaceCurvature{} : here;
  // On a pole the limits from other sides are asked for too.
  const bool u_vanishes = along_u < kNormalLimit * reach, v_vanishes = along_v < kNormalLimit * reach;
  if (singular && u_vanishes != v_vanishes)
    for (const double part : {0.29, 0.63}) {
      const double other_u = u_vanishes ? elsewhere(domain.u, u, part) : u,
                   other_v = u_vanishes ? v : elsewhere(domain.v, v, part);
      const std::optional<Mat3> other = limit_of_shape(surface, other_u, other_v, flat);
      if (!other || !(largest(*other - *limit) <= 2 * kLimitError * (largest(*limit) + flat))) return {};
    }
  return curvature(*limit, normal);
}

}  // namespace lekalo::geometry
