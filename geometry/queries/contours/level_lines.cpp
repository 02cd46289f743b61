// Marching squares: the sign of f - level at the corners of cells tells which sides of a cell a line crosses; in a cell
// with four crossings the sign in its middle tells which belong together. Crossings are found by bisection. A side of
// the polygon is halved by a crossing on the line across its middle, until that lies near enough to the side.
#include "geometry/queries/contours/level_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

constexpr int kCells = 64;
constexpr double kFlat = 1e-4;  // of the size
constexpr int kHalvings = 6;

class LevelSearch {
 public:
  LevelSearch(const Surface& surface, const FunctionOnSurface& function, double level)
      : surface_(surface), function_(function), level_(level), flat_(kFlat * bounds(surface).diameter()) {
    std::set<double> u, v;
    for (const SurfacePiece& piece : surface.pieces()) {
      u.insert({piece.domain.u.lo, piece.domain.u.hi});
      v.insert({piece.domain.v.lo, piece.domain.v.hi});
    }
    u_ = refined(u);
    v_ = refined(v);
  }

  std::vector<LevelLine> lines() {
    values_.resize(u_.size() * v_.size());
    for (size_t i = 0; i < u_.size(); ++i)
      for (size_t j = 0; j < v_.size(); ++j) values_[i * v_.size() + j] = value({u_[i], v_[j]});
    for (size_t i = 0; i + 1 < u_.size(); ++i)
      for (size_t j = 0; j + 1 < v_.size(); ++j) add_cell(i, j);
    return chained();
  }

 private:
  // A side of a cell: from (i, j) along u or v.
  struct Side {
    size_t i, j;
    bool along_u;
    auto operator<=>(const Side&) const = default;
  };

  static std::vector<double> refined(const std::set<double>& ends) {
    const double all = *ends.rbegin() - *ends.begin();
    std::vector<double> result;
    for (auto at = ends.begin(); std::next(at) != ends.end(); ++at) {
      const double width = *std::next(at) - *at;
      const int parts = std::max(2, static_cast<int>(std::ceil(kCells * width / all)));
      for (int k = 0; k < parts; ++k) result.push_back(*at + width * k / parts);
    }
    result.push_back(*ends.rbegin());
    return result;
  }

  double value(const Vec2& place) const { return function_(place.x, place.y) - level_; }
  Vec3 point(const Vec2& place) const { return surface_.point(place.x, place.y); }
  double at(size_t i, size_t j) const { return values_[i * v_.size() + j]; }
  Vec2 corner(size_t i, size_t j) const { return {u_[i], v_[j]}; }

  // Between places of opposite signs.
  std::optional<Vec2> crossing(Vec2 below, Vec2 above) const {
    const double far = std::max(std::abs(value(below)), std::abs(value(above)));
    for (int k = 0; k < 60; ++k) {
      const Vec2 middle = 0.5 * (below + above);
      const double there = value(middle);
      if (!std::isfinite(there)) return std::nullopt;
      (there < 0 ? below : above) = middle;
    }
    // A jump or a pole has none: the values do not go to zero there.
    constexpr double kNear = 1e-6;
    const double a = value(below), b = value(above);
    if (!std::isfinite(a) || !std::isfinite(b) || !(std::min(std::abs(a), std::abs(b)) <= kNear * far))
      return std::nullopt;
    return std::abs(a) < std::abs(b) ? below : above;
  }

  void add_cell(size_t i, size_t j) {
    const double c[4] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
    if (std::any_of(c, c + 4, [](double x) { return !std::isfinite(x); })) return;
    const Side side[4] = {{i, j, true}, {i + 1, j, false}, {i, j + 1, true}, {i, j, false}};
    std::vector<int> crossed;
    for (int k = 0; k < 4; ++k)
      if ((c[k] < 0) != (c[(k + 1) % 4] < 0)) crossed.push_back(k);
    if (crossed.size() == 2) return join(side[crossed[0]], side[crossed[1]]);
    if (crossed.size() != 4) return;
    const bool with_first = (value(0.5 * (corner(i, j) + corner(i + 1, j + 1))) < 0) == (c[0] < 0);
    // The middle belongs to the first and third corner, or to the others.
    join(side[0], side[with_first ? 1 : 3]);
    join(side[2], side[with_first ? 3 : 1]);
  }
  void join(const Side& a, const Side& b) {
    next_[a].push_back(b);
    next_[b].push_back(a);
  }

  std::optional<Vec2> place(const Side& side) const {
    const size_t i1 = side.i + (side.along_u ? 1 : 0), j1 = side.j + (side.along_u ? 0 : 1);
    const Vec2 a = corner(side.i, side.j), b = corner(i1, j1);
    return at(side.i, side.j) < 0 ? crossing(a, b) : crossing(b, a);
  }

  std::vector<LevelLine> chained() {
    std::set<Side> used;
    std::vector<LevelLine> result;
    const auto follow = [&](Side from) {
      std::vector<Side> chain{from};
      used.insert(from);
      for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (const Side& other : next_[chain.back()])
          if (used.insert(other).second) {
            chain.push_back(other);
            goes_on = true;
            break;
          }
      }
      return chain;
    };
    // Open lines from their ends first.
    for (const bool open : {true, false})
      for (const auto& [side, others] : next_)
        if ((others.size() == 1) == open && !used.contains(side)) add_line(follow(side), !open, result);
    return result;
  }

  // Without what crosses a jump; there a line ends.
  void add_line(const std::vector<Side>& chain, bool closed, std::vector<LevelLine>& result) const {
    LevelLine line;
    const auto finish = [&] {
      if (line.places.size() > 1) result.push_back(std::move(line));
      line = {};
    };
    bool whole = true;
    for (const Side& side : chain) {
      const auto here = place(side);
      if (!here) {
        whole = false;
        finish();
        continue;
      }
      if (!line.places.empty()) {
        if (line.places.back() == *here) continue;
        add_between(line.places.back(), *here, kHalvings, line.places);
      }
      line.places.push_back(*here);
    }
    line.closed = closed && whole && chain.size() > 2;
    if (line.closed && line.places.size() > 2) {
      const Vec2 last = line.places.back();
      add_between(last, line.places.front(), kHalvings, line.places);
    }
    finish();
  }

  void add_between(const Vec2& a, const Vec2& b, int halvings, std::vector<Vec2>& places) const {
    const auto middle = halvings > 0 ? place_across(a, b) : std::nullopt;
    if (!middle || glm::length(point(*middle) - 0.5 * (point(a) + point(b))) <= flat_) return;
    add_between(a, *middle, halvings - 1, places);
    places.push_back(*middle);
    add_between(*middle, b, halvings - 1, places);
  }

  // The crossing with the line across the middle of a side of the polygon, no farther off than a quarter of its length.
  std::optional<Vec2> place_across(const Vec2& a, const Vec2& b) const {
    const Vec2 range(u_.back() - u_.front(), v_.back() - v_.front());
    const Vec2 along = (b - a) / range, across = 0.25 * Vec2(-along.y, along.x) * range, middle = 0.5 * (a + b);
    const auto inside = [&](const Vec2& p) {
      return p.x >= u_.front() && p.x <= u_.back() && p.y >= v_.front() && p.y <= v_.back();
    };
    const Vec2 left = middle + across, right = middle - across;
    if (!inside(left) || !inside(right)) return std::nullopt;
    const double l = value(left), r = value(right);
    if (!std::isfinite(l) || !std::isfinite(r) || (l < 0) == (r < 0)) return std::nullopt;
    return l < 0 ? crossing(left, right) : crossing(right, left);
  }

  const Surface& surface_;
  const FunctionOnSurface& function_;
  double level_, flat_;
  std::vector<double> u_, v_;  // of the grid
  std::vector<double> values_;
  std::map<Side, std::vector<Side>> next_;
};

}  // namespace

std::vector<LevelLine> level_lines(const Surface& surface, const FunctionOnSurface& function, double level) {
  if (!surface.bounded()) throw std::invalid_argument("the surface is unbounded: give it a domain");
  return LevelSearch(surface, function, level).lines();
}

}  // namespace lekalo::geometry
