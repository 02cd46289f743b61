#include "geometry/bodies/trims/seam_path.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

using Loops = std::vector<std::vector<LoopSide>>;

// Of one row, within one period. A row that no loop enters is one gap without ends.
using Gaps = std::vector<Interval>;

bool is_ring(const Interval& gap) { return gap.hi == kInfinity; }
bool is_ring(const Gaps& gaps) { return gaps.size() == 1 && is_ring(gaps[0]); }

class Rows {
 public:
  Rows(const Loops& loops, const ClosedBand& band, int count) : band_(band), covered_(count) {
    for (const auto& loop : loops) cover(loop);
    for (const auto& covered : covered_) gaps_.push_back(gaps_between(covered));
  }

  std::vector<Vec2> path() const;

 private:
  // What a side covers of a row, and whether it crosses the row's middle.
  struct Part {
    int row;
    Interval x;
    bool crosses;
  };
  // The way to a gap: from which other one, and through which place and part of their common side. Both, and the gap
  // itself, stand where the way has come to, maybe periods away.
  struct Node {
    int row;
    Interval gap, portal;
    double x, length;
    int from;
  };
  struct Corner {
    Vec2 at;
    Interval portal;  // where a straight way may pass at this height
  };

  double height(double row) const { return band_.y.lo + band_.y.width() * row / static_cast<double>(covered_.size()); }

  void cover(const std::vector<LoopSide>& loop);
  Gaps gaps_between(std::vector<Interval> covered) const;
  std::vector<Node> shortest_way() const;
  std::vector<Vec2> stretched(const std::vector<Corner>& corners) const;

  const ClosedBand& band_;
  std::vector<std::vector<Interval>> covered_;
  std::vector<Gaps> gaps_;
};

void Rows::cover(const std::vector<LoopSide>& loop) {
  std::vector<Part> parts;
  const int last = static_cast<int>(covered_.size()) - 1;
  const auto row_at = [&](double y) {
    return std::clamp(static_cast<int>(std::floor((y - band_.y.lo) / band_.y.width() * (last + 1))), 0, last);
  };
  for (const LoopSide& side : loop) {
    const auto [low, high] = side.a.y < side.b.y ? std::pair(side.a, side.b) : std::pair(side.b, side.a);
    for (int row = row_at(low.y - side.bulge); row <= row_at(high.y + side.bulge); ++row) {
      const auto x_at = [&](double y) {
        return high.y > low.y ? low.x + std::clamp((y - low.y) / (high.y - low.y), 0.0, 1.0) * (high.x - low.x) : low.x;
      };
      const double below = x_at(height(row) - side.bulge),
                   above = high.y > low.y ? x_at(height(row + 1) + side.bulge) : high.x, middle = height(row + 0.5);
      parts.push_back({row,
                       {std::min(below, above) - side.bulge, std::max(below, above) + side.bulge},
                       (low.y <= middle) != (high.y <= middle)});
    }
  }
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.row != b.row ? a.row < b.row : a.x.lo < b.x.lo; });
  // Between its sides lies the loop's inside where an odd number of them was crossed.
  bool inside = false;
  for (size_t k = 0; k < parts.size(); ++k) {
    const Part& part = parts[k];
    auto& covered = covered_[part.row];
    const bool joins = k > 0 && parts[k - 1].row == part.row && (inside || part.x.lo <= covered.back().hi);
    if (joins)
      covered.back().hi = std::max(covered.back().hi, part.x.hi);
    else
      covered.push_back(part.x);
    inside = inside != part.crosses;
  }
}

Gaps Rows::gaps_between(std::vector<Interval> covered) const {
  if (covered.empty()) return {{-kInfinity, kInfinity}};
  double end = -kInfinity;
  for (Interval& one : covered) {
    one = one - Interval(band_.period * std::floor(one.lo / band_.period));
    end = std::max(end, one.hi - band_.period);
  }
  std::sort(covered.begin(), covered.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
  Gaps gaps;
  for (const Interval& one : covered) {
    if (one.lo - end > kClosedCurve * band_.period) gaps.push_back({end, one.lo});
    end = std::max(end, one.hi);
  }
  return gaps;
}

// Dijkstra's search among the gaps, by how far the way turns and climbs.
std::vector<Rows::Node> Rows::shortest_way() const {
  const double period = band_.period, step = height(1) - height(0);
  const int last_row = static_cast<int>(gaps_.size()) - 1;
  std::vector<Node> nodes;
  std::vector<int> first_of_row;
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (int row = 0; row <= last_row; ++row) {
    first_of_row.push_back(static_cast<int>(nodes.size()));
    for (const Interval& gap : gaps_[row]) {
      const double x = is_ring(gap) ? 0 : gap.middle();
      if (row == 0) open.emplace(0, static_cast<int>(nodes.size()));
      nodes.push_back({row, gap, x, x, row == 0 ? 0 : kInfinity, -1});
    }
  }
  while (!open.empty()) {
    const auto [length, number] = open.top();
    const Node& here = nodes[number];
    open.pop();
    if (length > here.length) continue;
    if (here.row == last_row) {
      std::vector<Node> way;
      for (int k = number; k >= 0; k = nodes[k].from) way.push_back(nodes[k]);
      std::reverse(way.begin(), way.end());
      return way;
    }
    for (const int row : {here.row - 1, here.row + 1}) {
      if (row < 0) continue;
      for (size_t k = 0; k < gaps_[row].size(); ++k) {
        const Interval& gap = gaps_[row][k];
        // Its copies next to where the way is.
        const double turns = is_ring(gap) ? 0 : std::round((here.x - gap.middle()) / period);
        for (const double turn : {turns - 1, turns, turns + 1}) {
          const Interval there(gap.lo + turn * period, gap.hi + turn * period), common = intersect(there, here.gap);
          const double margin = 0.25 * std::min(common.width(), period);
          if (!(margin > kClosedCurve * period)) continue;
          const Interval portal(common.lo + margin, common.hi - margin);
          const double x = portal.hi < kInfinity ? portal.middle() : here.x, to = length + std::abs(x - here.x) + step;
          const int other = first_of_row[row] + static_cast<int>(k);
          if (to >= nodes[other].length) continue;
          nodes[other] = {row, there, portal, x, to, number};
          open.emplace(to, other);
        }
      }
    }
  }
  return {};
}

std::vector<Vec2> Rows::path() const {
  if (band_.closed_y && !(is_ring(gaps_.front()) && is_ring(gaps_.back()))) return {};
  const std::vector<Node> way = shortest_way();
  if (way.empty()) return {};
  const double start = way.front().x, end = band_.closed_y ? start : way.back().x;
  std::vector<Corner> corners{{{start, band_.y.lo}, start}};
  for (size_t k = 1; k < way.size(); ++k) {
    const Vec2 before = corners.back().at, at(way[k].x, height(std::max(way[k].row, way[k - 1].row)));
    // A way that turns back in a gap goes through its middle.
    const Vec2 middle(0.5 * (before.x + at.x), height(way[k - 1].row + 0.5));
    if (before.y == at.y) corners.push_back({middle, middle.x});
    corners.push_back({at, way[k].portal});
  }
  corners.push_back({{end, band_.y.hi}, end});
  return stretched(corners);
}

// From each corner straight to the last that can be seen through all portals between.
std::vector<Vec2> Rows::stretched(const std::vector<Corner>& corners) const {
  std::vector<Vec2> path{corners[0].at};
  for (size_t i = 0; i + 1 < corners.size();) {
    const Vec2 eye = corners[i].at;
    const bool up = corners[i + 1].at.y > eye.y;
    Interval view(-kInfinity, kInfinity);  // of changes in x for one in y
    size_t seen = i + 1;
    for (size_t k = i + 1; k < corners.size() && (corners[k].at.y > corners[k - 1].at.y) == up; ++k) {
      const double rise = std::abs(corners[k].at.y - eye.y);
      if (view.contains((corners[k].at.x - eye.x) / rise)) seen = k;
      view = intersect(view, {(corners[k].portal.lo - eye.x) / rise, (corners[k].portal.hi - eye.x) / rise});
      if (view.empty()) break;
    }
    path.push_back(corners[seen].at);
    i = seen;
  }
  return path;
}

}  // namespace

std::vector<Vec2> seam_path(const Loops& loops, const ClosedBand& band) {
  constexpr int kFewestRows = 64, kMaxRows = 16384;
  for (int count = kFewestRows; count <= kMaxRows; count *= 4)
    if (std::vector<Vec2> path = Rows(loops, band, count).path(); !path.empty()) return path;
  return {};
}

double periods_from_seam(const Vec2& p, const std::vector<Vec2>& seam, double period) {
  // To the left of the point the seam and its copies are crossed so often, those from their other side taken off.
  double periods = 0;
  for (size_t k = 0; k + 1 < seam.size(); ++k) {
    const Vec2 &a = seam[k], &b = seam[k + 1];
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    const double x = a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
    periods += (a.y <= p.y ? 1 : -1) * std::floor((p.x - x) / period);
  }
  return periods;
}

}  // namespace lekalo::geometry
