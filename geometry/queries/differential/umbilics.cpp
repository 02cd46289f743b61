// In an orthonormal frame of the tangent plane with the first axis along r_u the shape operator is s; an umbilic is
// where both
//
//   w_1 = s_11 - s_22,   w_2 = 2 s_12     vanish; |w| = k_1 - k_2.
//
// A generic umbilic is a simple zero of w, found by Newton's iteration; the derivatives of w are differences, which
// only slows it. Where w vanishes on a whole neighbourhood there is no isolated umbilic.
#include "geometry/queries/differential/umbilics.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "geometry/queries/differential/curvature.h"

namespace lekalo::geometry {

namespace {

constexpr int kGrid = 24;             // places a side of a piece
constexpr int kSteps = 40;            // of Newton's iteration
constexpr double kDifference = 1e-6;  // of the range of a parameter
constexpr double kEqual = 1e-7;       // curvatures, of the larger or of 1 / size
constexpr double kRegion = 1e-5;      // so near to an umbilic others belong to a region of them
constexpr double kSame = 1e-5;        // places of the range of a parameter
constexpr double kBeyond = 0.1;       // of the range, on the way: umbilics lie on symmetry lines, where pieces end

struct Difference {
  Vec2 w{0};
  double size = 0;  // of the curvatures
};

class UmbilicSearch {
 public:
  UmbilicSearch(const Surface& surface, double flat) : surface_(surface), flat_(flat) {}

  std::optional<Difference> at(const Vec2& place) const {
    const SurfaceJet jet = surface_.evaluate(place.x, place.y, 2);
    const SurfaceCurvature c = curvature(jet, surface_.normal(place.x, place.y, jet));
    if (!c.regular || !(std::isfinite(c.principal[0]) && std::isfinite(c.principal[1]))) return std::nullopt;
    const Vec3 x = glm::normalize(jet.du());
    const Vec3 normal = glm::cross(c.directions[0], c.directions[1]), y = glm::cross(normal, x);
    // k_1 - k_2 at twice the angle of the first direction.
    const double cosine = glm::dot(c.directions[0], x), sine = glm::dot(c.directions[0], y);
    const double apart = c.principal[0] - c.principal[1];
    return Difference{apart * Vec2(cosine * cosine - sine * sine, 2 * cosine * sine),
                      std::max(std::abs(c.principal[0]), std::abs(c.principal[1]))};
  }
  bool is_zero(const Difference& d, double part) const { return glm::length(d.w) <= part * (d.size + flat_); }

  // From a place, within the piece.
  std::optional<Vec2> zero_near(Vec2 place, const Rectangle& piece) const {
    double least = kInfinity;
    Vec2 best = place;
    for (int step = 0; step < kSteps; ++step) {
      const auto here = at(place);
      if (!here) break;
      if (is_zero(*here, 0.01 * kEqual)) {
        // As near as rounding allows: until no step comes nearer.
        const double apart = glm::length(here->w);
        if (!(apart < least)) break;
        least = apart, best = place;
        if (apart == 0) break;
      }
      const Vec2 h(kDifference * piece.u.width(), kDifference * piece.v.width());
      const auto u1 = at(place + Vec2(h.x, 0)), u0 = at(place - Vec2(h.x, 0)), v1 = at(place + Vec2(0, h.y)),
                 v0 = at(place - Vec2(0, h.y));
      if (!u1 || !u0 || !v1 || !v0) break;
      const Vec2 du = (u1->w - u0->w) / (2 * h.x), dv = (v1->w - v0->w) / (2 * h.y);
      const double det = du.x * dv.y - du.y * dv.x;
      if (!(std::abs(det) > 0)) break;
      Vec2 by = -Vec2(here->w.x * dv.y - here->w.y * dv.x, du.x * here->w.y - du.y * here->w.x) / det;
      // Not farther than a few cells of the grid.
      const double far = std::max(std::abs(by.x) / piece.u.width(), std::abs(by.y) / piece.v.width()) * kGrid / 2;
      if (far > 1) by /= far;
      place += by;
      if (off(place.x, piece.u) > kBeyond || off(place.y, piece.v) > kBeyond) break;
    }
    if (least < kInfinity) place = best;
    if (off(place.x, piece.u) > kSame || off(place.y, piece.v) > kSame) return std::nullopt;
    place = {piece.u.clamp(place.x), piece.v.clamp(place.y)};
    const auto here = at(place);
    return here && is_zero(*here, kEqual) ? std::optional(place) : std::nullopt;
  }

  // No others around it.
  bool is_isolated(const Vec2& place, const Rectangle& piece) const {
    const double part = 0.25 / kGrid;
    for (const Vec2& side : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
      const auto beside = at(place + part * side * Vec2(piece.u.width(), piece.v.width()));
      if (beside && is_zero(*beside, kRegion)) return false;
    }
    return true;
  }

 private:
  // How far beyond a range, in parts of it.
  static double off(double x, const Interval& range) { return std::abs(x - range.clamp(x)) / range.width(); }

  const Surface& surface_;
  double flat_;
};

// Whether two places are one, where the surface is periodic too.
bool are_same(const Vec2& a, const Vec2& b, const Rectangle& domain, const Periods& periods) {
  const auto near = [](double x, double y, const Interval& range, double period) {
    double apart = std::abs(x - y);
    if (period > 0) apart = std::min(apart, std::abs(apart - period));
    return apart <= kSame * range.width();
  };
  return near(a.x, b.x, domain.u, periods.u) && near(a.y, b.y, domain.v, periods.v);
}

}  // namespace

std::vector<Vec2> umbilics(const Surface& surface) {
  if (!surface.bounded()) throw std::invalid_argument("the surface is unbounded: give it a domain");
  if (surface.max_order() < 2) return {};
  const UmbilicSearch search(surface, 1 / std::max(bounds(surface).diameter(), 1e-300));
  std::vector<Vec2> found;
  for (const SurfacePiece& piece : surface.pieces()) {
    const Rectangle& range = piece.domain;
    const auto place = [&](int i, int j) {
      return Vec2(range.u.lo + range.u.width() * (i + 0.5) / kGrid, range.v.lo + range.v.width() * (j + 0.5) / kGrid);
    };
    std::vector<double> apart(kGrid * kGrid, kInfinity);
    for (int i = 0; i < kGrid; ++i)
      for (int j = 0; j < kGrid; ++j)
        if (const auto here = search.at(place(i, j))) apart[i * kGrid + j] = glm::length(here->w);
    const auto is_least = [&](int i, int j) {
      for (int a = std::max(0, i - 1); a <= std::min(kGrid - 1, i + 1); ++a)
        for (int b = std::max(0, j - 1); b <= std::min(kGrid - 1, j + 1); ++b)
          if (apart[a * kGrid + b] < apart[i * kGrid + j]) return false;
      return apart[i * kGrid + j] < kInfinity;
    };
    for (int i = 0; i < kGrid; ++i)
      for (int j = 0; j < kGrid; ++j) {
        if (!is_least(i, j)) continue;
        const auto zero = search.zero_near(place(i, j), range);
        if (!zero || !search.is_isolated(*zero, range)) continue;
        if (std::none_of(found.begin(), found.end(), [&](const Vec2& other) {
              return are_same(*zero, other, surface.domain(), surface.periods());
            }))
          found.push_back(*zero);
      }
  }
  return found;
}

}  // namespace lekalo::geometry
