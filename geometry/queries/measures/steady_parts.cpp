#include "geometry/queries/measures/steady_parts.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Of the size: shorter parts are next to nothing.
constexpr double kNegligible = 1e-15;
// Of the parameter: nodes in narrower parts are moved too much by its rounding.
constexpr double kCoarsest = 0x1p-39;
// Halvings towards the ends of a piece that is not divided.
constexpr int kGrades = 64;
// Of the range: no part is narrower, however fine the parameter is next to zero.
constexpr double kNarrowest = 1e-30;

// The distance from the origin to the nearest and the farthest point of a box.
double min_length(const Box3& box) { return glm::length(glm::max(glm::max(box.lo, -box.hi), Vec3(0))); }
double max_length(const Box3& box) { return glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))); }

class Division {
 public:
  Division(const Curve& curve, const Interval& range) : curve_(curve), range_(range) {
    const Box3 all = bounds(curve);
    negligible_ = all.bounded() ? std::max(kNegligible * all.diameter(), 4 * kEpsilon * max_length(all)) : 0;
  }

  SteadyParts run() {
    result_.breaks = {range_.lo};
    for (const CurvePiece& piece : curve_.pieces()) {
      const Interval part = intersect(piece.domain, range_);
      if (part.width() > 0) divide_piece(part);
    }
    if (result_.breaks.back() < range_.hi) result_.breaks.push_back(range_.hi);
    walk();
    return std::move(result_);
  }

 private:
  void divide_piece(const Interval& piece) {
    if (result_.breaks.back() < piece.lo) result_.breaks.push_back(piece.lo);
    const SteadyParts before = result_;
    std::vector<Interval> open{piece};
    for (int visited = 0; !open.empty(); ++visited) {
      if (visited > 2 * kMaxSteadyParts) {
        result_ = before;
        return grade(piece);
      }
      const Interval part = open.back();
      open.pop_back();
      if (is_done(part)) {
        result_.breaks.push_back(part.hi);
      } else {
        open.push_back({part.middle(), part.hi});
        open.push_back({part.lo, part.middle()});
      }
    }
  }

  // Parts that get narrower to both ends, down to what is_done() counts as narrow.
  void grade(const Interval& piece) {
    const auto grades = [&](double end) {
      int k = 2;
      while (k < kGrades && std::ldexp(piece.width(), -k) > kCoarsest * std::abs(end)) ++k;
      return k;
    };
    is_done({piece.lo, piece.lo + std::ldexp(piece.width(), -grades(piece.lo))});
    for (int k = grades(piece.lo); k > 0; --k) result_.breaks.push_back(piece.lo + std::ldexp(piece.width(), -k));
    for (int k = 2; k <= grades(piece.hi); ++k) result_.breaks.push_back(piece.hi - std::ldexp(piece.width(), -k));
    is_done({result_.breaks.back(), piece.hi});
    result_.breaks.push_back(piece.hi);
  }

  bool is_done(const Interval& part) {
    const CurveEnclosure r = curve_.enclose(part, 2);
    if (0.5 * part.width() * max_length(r.d[2]) <= min_length(r.d[1])) return true;
    // Where derivatives have no bounds narrower parts have none either.
    const double narrowest = r.d[1].bounded() && r.d[2].bounded() ? kNarrowest : kCoarsest;
    const bool narrow = part.width() <= std::max(kCoarsest * magnitude(part), narrowest * range_.width());
    const Vec3 sides = r.d[0].size();
    const double longest = std::min(sides.x + sides.y + sides.z, part.width() * max_length(r.d[1]));
    if (!narrow && !(longest <= negligible_)) return false;
    if (std::isfinite(longest)) add_chord(part, longest);
    return true;
  }

  void add_chord(const Interval& part, double longest) {
    const Vec3 from = curve_.point(part.lo), to = curve_.point(part.hi);
    const double length = glm::distance(from, to);
    // The ends are known as far as their parameters are.
    const double ends =
        glm::distance(from, curve_.point(next_up(part.lo))) + glm::distance(to, curve_.point(next_down(part.hi)));
    if (std::isfinite(length)) result_.chords.push_back({part, length, std::max(0.0, longest - length) + ends});
  }

  // From break to break. The speed at a node is that at its rounded parameter.
  void walk() {
    CurveJet before;
    for (size_t k = 0; k < result_.breaks.size(); ++k) {
      const double t = result_.breaks[k];
      const CurveJet here = curve_.evaluate(t, 1);
      const double change = glm::length(here.d[1]) - glm::length(before.d[1]),
                   way = glm::distance(here.d[0], before.d[0]);
      const bool has_nodes = k > 0 && !result_.chord_at(0.5 * (t + result_.breaks[k - 1]));
      if (has_nodes && std::isfinite(change)) result_.rounding += kEpsilon * std::abs(t) * std::abs(change);
      if (k > 0 && std::isfinite(way)) result_.least += way;
      before = here;
    }
  }

  const Curve& curve_;
  const Interval range_;
  double negligible_ = 0;  // a length
  SteadyParts result_;
};

}  // namespace

const ChordPart* SteadyParts::chord_at(double t) const {
  const auto after = std::upper_bound(chords.begin(), chords.end(), t,
                                      [](double at, const ChordPart& chord) { return at < chord.t.lo; });
  if (after == chords.begin() || (after - 1)->t.hi < t) return nullptr;
  return &*(after - 1);
}

double SteadyParts::error(double found) const {
  double sum = rounding;
  for (const ChordPart& chord : chords) sum += chord.error;
  return std::max(sum, least - found);
}

SteadyParts steady_parts(const Curve& curve, const Interval& range) { return Division(curve, range).run(); }

}  // namespace lekalo::geometry
