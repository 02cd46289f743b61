#include "render/drawing/picture_crossings.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

using geometry::Interval;

namespace {

constexpr double kBin = 16;         // pixels
constexpr double kTouching = 1e-4;  // pixels
constexpr double kCellTurn = 0.27;  // how far directions of a cell are from its chord's, radians; projected_curve.cpp
constexpr double kEndSlack = 1e-9;  // of a cell: a crossing at its end is its own too

// A part of a cell: within `bulge` of its chord, its directions within `turn` of it.
struct Part {
  const ProjectedCurve* curve;
  Interval t;
  Vec2 begin, end;
  double bulge, turn;

  Vec2 chord() const { return end - begin; }
  double length() const { return glm::length(chord()); }
};

Part part_of(const ProjectedCurve& curve, const ProjectedCurve::Cell& cell) {
  return {&curve, cell.t, cell.begin, cell.end, cell.bulge, cell.is_chord ? 0 : kCellTurn};
}

std::pair<Part, Part> halves(const Part& part) {
  const double middle = part.t.middle();
  const Vec2 at = part.curve->place(middle).p;
  const double turn = part.turn > 0 ? 0.5 * part.turn / (1 - part.turn) : 0;
  return {{part.curve, {part.t.lo, middle}, part.begin, at, 0.25 * part.bulge, turn},
          {part.curve, {middle, part.t.hi}, at, part.end, 0.25 * part.bulge, turn}};
}

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

// Whether the thick chord `b` lies to one side of the line of the thick chord `a`, or beyond its ends.
bool is_apart(const Part& a, const Part& b) {
  const Vec2 chord = a.chord();
  const double length = glm::length(chord);
  const Vec2 along = length > 0 ? chord / length : Vec2(1, 0), across(-along.y, along.x);
  const double reach = a.bulge + b.bulge;
  const auto beyond = [&](const Vec2& axis, double lo, double hi) {
    const double p = glm::dot(axis, b.begin - a.begin), q = glm::dot(axis, b.end - a.begin);
    return std::max(p, q) < lo - reach || std::min(p, q) > hi + reach;
  };
  return beyond(across, 0, 0) || beyond(along, 0, length);
}

// Newton's iteration for P_a(s) = P_b(t), of which there is at most one.
bool solve(const Part& a, const Part& b, PictureCrossing& crossing) {
  const Vec2 u = a.chord(), v = b.chord(), off = b.begin - a.begin;
  const double area = cross(u, v);
  double s = a.t.lo + a.t.width() * (area != 0 ? cross(off, v) / area : 0.5),
         t = b.t.lo + b.t.width() * (area != 0 ? cross(off, u) / area : 0.5);
  constexpr int kSteps = 30;
  for (int step = 0; step < kSteps; ++step) {
    s = a.t.clamp(s), t = b.t.clamp(t);
    const auto at_a = a.curve->place(s), at_b = b.curve->place(t);
    const Vec2 apart = at_b.p - at_a.p;
    const double determinant = cross(at_a.tangent, at_b.tangent);
    if (determinant == 0 || !std::isfinite(determinant)) return false;
    const double by_s = cross(apart, at_b.tangent) / determinant, by_t = cross(apart, at_a.tangent) / determinant;
    s += by_s, t += by_t;
    if (std::abs(by_s) <= 1e-14 * a.t.width() && std::abs(by_t) <= 1e-14 * b.t.width()) break;
  }
  const auto inside = [](const Interval& range, double x) {
    const double slack = kEndSlack * range.width();
    return x >= range.lo - slack && x <= range.hi + slack;
  };
  if (!inside(a.t, s) || !inside(b.t, t)) return false;
  crossing = {a.t.clamp(s), b.t.clamp(t), false};
  return true;
}

// The crossings of two cells. Cells that run along one another would touch everywhere: then none is told.
class CellPair {
 public:
  void cross_parts(const Part& a, const Part& b) {
    if (runs_along_ || is_apart(a, b) || is_apart(b, a)) return;
    const Vec2 u = a.chord(), v = b.chord();
    const double lengths = glm::length(u) * glm::length(v);
    // The angle between the lines of both chords.
    const double sine = lengths > 0 ? std::abs(cross(u, v)) / lengths : 0;
    if (sine > std::sin(std::min(a.turn + b.turn, 1.5)) + 1e-9) {
      if (PictureCrossing crossing; solve(a, b, crossing)) found_.push_back(crossing);
      return;
    }
    if (std::max(a.length() + a.bulge, b.length() + b.bulge) < kTouching) {
      found_.push_back({a.t.middle(), b.t.middle(), true});
      ++touching_;
      runs_along_ = touching_ > kMostTouching;
      return;
    }
    runs_along_ = runs_along_ || ++steps_ > kMostSteps;
    if (a.length() + a.bulge > b.length() + b.bulge) {
      const auto [first, second] = halves(a);
      cross_parts(first, b);
      cross_parts(second, b);
    } else {
      const auto [first, second] = halves(b);
      cross_parts(a, first);
      cross_parts(a, second);
    }
  }
  std::vector<PictureCrossing> found() const {
    std::vector<PictureCrossing> result;
    for (const PictureCrossing& one : found_)
      if (!one.touching || !runs_along_) result.push_back(one);
    return result;
  }

 private:
  static constexpr int kMostTouching = 16, kMostSteps = 4000;
  std::vector<PictureCrossing> found_;
  int touching_ = 0, steps_ = 0;
  bool runs_along_ = false;
};

}  // namespace

PictureCrossings::PictureCrossings(std::vector<const ProjectedCurve*> curves, double width, double height)
    : curves_(std::move(curves)),
      columns_(std::max(1, static_cast<int>(std::ceil(width / kBin)))),
      rows_(std::max(1, static_cast<int>(std::ceil(height / kBin)))),
      bins_(static_cast<size_t>(columns_) * rows_) {
  for (size_t k = 0; k < curves_.size(); ++k)
    for (size_t i = 0; i < curves_[k]->cells().size(); ++i)
      each_bin(curves_[k]->cells()[i], [&](size_t bin) {
        bins_[bin].push_back({static_cast<int>(k), static_cast<int>(i)});
      });
}

template <class Visit>
void PictureCrossings::each_bin(const ProjectedCurve::Cell& cell, Visit&& visit) const {
  const Vec2 lo = glm::min(cell.begin, cell.end) - cell.bulge, hi = glm::max(cell.begin, cell.end) + cell.bulge;
  const auto column = [&](double x) { return std::clamp(static_cast<int>(std::floor(x / kBin)), 0, columns_ - 1); };
  const auto row = [&](double y) { return std::clamp(static_cast<int>(std::floor(y / kBin)), 0, rows_ - 1); };
  for (int j = row(lo.y); j <= row(hi.y); ++j)
    for (int i = column(lo.x); i <= column(hi.x); ++i) visit(static_cast<size_t>(j) * columns_ + i);
}

void PictureCrossings::collect(const ProjectedCurve& curve, std::vector<Hit>& hits) const {
  std::vector<std::pair<int, int>> near;  // curve and cell, each once
  for (const ProjectedCurve::Cell& cell : curve.cells()) {
    near.clear();
    each_bin(cell, [&](size_t bin) {
      for (const Item& item : bins_[bin]) near.emplace_back(item.curve, item.cell);
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const auto& [other, index] : near) {
      const ProjectedCurve::Cell& of_other = curves_[other]->cells()[index];
      if (curves_[other] == &curve && (&of_other == &cell || of_other.t.lo == cell.t.hi || of_other.t.hi == cell.t.lo))
        continue;
      CellPair pair;
      pair.cross_parts(part_of(curve, cell), part_of(*curves_[other], of_other));
      for (const PictureCrossing& crossing : pair.found()) hits.push_back({other, crossing});
    }
  }
}

}  // namespace lekalo::render
