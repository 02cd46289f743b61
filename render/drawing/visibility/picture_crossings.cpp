#include "render/drawing/visibility/picture_crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lekalo::render {

using geometry::Interval;

namespace {

constexpr double kLargestBin = 16, kMinBin = 2;  // pixels
constexpr double kCellsOfBin = 2;                // about
constexpr double kTouching = 1e-4;               // pixels
constexpr double kCellTurn = 0.27;  // how far directions of a cell are from its chord's, radians; projected_curve.cpp
constexpr double kAnyTurn = 4;      // nothing is known
constexpr double kLastStep = 1e-8;  // of a part: Newton's iteration has come to rounding behind it
constexpr double kOneLine = 1e-7;   // pixels: what is no farther from one another touches
constexpr double kEndSlack = 1e-9;  // of a cell: a crossing at its end is its own too

// A part of a cell: within `bulge` of its chord, its directions within `turn` of it.
struct Part {
  Part(const ProjectedCurve& curve, const Interval& t, const Vec2& begin, const Vec2& end, double bulge, double bow,
       double max_turn)
      : curve(&curve),
        t(t),
        begin(begin),
        end(end),
        chord(end - begin),
        length(glm::length(chord)),
        bulge(bulge),
        bow(bow),
        turn(max_turn) {
    // P' differs from the chord by the width by at most |P''| h = 2 bow/h, the chord being 2 h long by that. (A part so
    // short that a chord may stand for it where widths are asked for may bend all the same, or have a cusp.)
    const double sine = 4 * bow / length;
    if (sine < std::min(1.0, max_turn)) turn = std::min(std::asin(sine), max_turn);
  }
  const ProjectedCurve* curve;
  Interval t;
  Vec2 begin, end, chord;
  double length, bulge, bow, turn;  // bow: as ProjectedCurve::Cell's
  int halves = -1;                  // where they are kept: this and the next
};

// The parts of a cell, kept as they are made: a cell is asked for with many others.
class Parts {
 public:
  void begin(const ProjectedCurve& curve, const ProjectedCurve::Cell& cell) {
    parts_.clear();
    parts_.emplace_back(curve, cell.t, cell.begin, cell.end, cell.bulge, cell.bow,
                        cell.is_chord ? kAnyTurn : kCellTurn);
    cell_ = &cell;
  }
  const Part& operator[](int index) const { return parts_[index]; }
  int halves(int index) {
    const Part part = parts_[index];
    if (part.halves >= 0) return part.halves;
    const double middle = part.t.middle();
    const Vec2 at = part.curve->point(middle);
    // Where no bound of P'' is worth something the bulge is that of the box, which is half as large at least.
    const double bow = 0.25 * part.bow, bulge = std::min(0.5 * part.bulge, bow),
                 turn = part.turn < 0.5 ? 0.5 * part.turn / (1 - part.turn) : kAnyTurn;
    const int first = parts_[index].halves = static_cast<int>(parts_.size());
    parts_.emplace_back(*part.curve, Interval(part.t.lo, middle), part.begin, at, bulge, bow, turn);
    parts_.emplace_back(*part.curve, Interval(middle, part.t.hi), at, part.end, bulge, bow, turn);
    return first;
  }
  const ProjectedCurve::Cell& cell() const { return *cell_; }

 private:
  std::vector<Part> parts_;
  const ProjectedCurve::Cell* cell_ = nullptr;
};

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

// Whether the thick chord `b` lies to one side of the line of the thick chord `a`, or beyond its ends.
bool is_apart(const Part& a, const Part& b) {
  const Vec2 along = a.length > 0 ? a.chord / a.length : Vec2(1, 0), across(-along.y, along.x);
  const double reach = a.bulge + b.bulge;
  const auto beyond = [&](const Vec2& axis, double lo, double hi) {
    const double p = glm::dot(axis, b.begin - a.begin), q = glm::dot(axis, b.end - a.begin);
    return std::max(p, q) < lo - reach || std::min(p, q) > hi + reach;
  };
  return beyond(across, 0, 0) || beyond(along, 0, a.length);
}

bool is_beyond(const Interval& range, double x, double ahead, double most) {
  return (x == range.hi && ahead > most) || (x == range.lo && -ahead > most);
}

// Newton's iteration for P_a(s) = P_b(t), of which there is at most one, the directions of both parts being apart.
//
// From a place (s, t) to the crossing (s', t') there are chords of the parts, P_b(t) - P_a(s) = (s' - s) A - (t' - t)
// B, so that (s' - s) (A x B) = (P_b(t) - P_a(s)) x B, B being within the turn of b's chord. If that points out of the
// part at its end, there is no crossing.
bool solve(const Part& a, const Part& b, PictureCrossing& crossing) {
  const Vec2 u = a.chord, v = b.chord, off = b.begin - a.begin;
  const double area = cross(u, v), orientation = area < 0 ? -1 : 1;
  const double u_length = a.length, v_length = b.length, sin_a = std::sin(a.turn), sin_b = std::sin(b.turn);
  double s = a.t.lo + a.t.width() * (area != 0 ? cross(off, v) / area : 0.5),
         t = b.t.lo + b.t.width() * (area != 0 ? cross(off, u) / area : 0.5);
  // At a break the curve's own place is that from the right.
  const Interval of_a{a.t.lo, geometry::next_down(a.t.hi)}, of_b{b.t.lo, geometry::next_down(b.t.hi)};
  constexpr int kSteps = 30;
  for (int step = 0; step < kSteps; ++step) {
    s = of_a.clamp(s), t = of_b.clamp(t);
    const auto at_a = a.curve->place(s), at_b = b.curve->place(t);
    const Vec2 apart = at_b.p - at_a.p;
    if (is_beyond(of_a, s, orientation * cross(apart, v) / v_length,
                  glm::length(apart) * sin_b + kEndSlack * u_length) ||
        is_beyond(of_b, t, orientation * cross(apart, u) / u_length, glm::length(apart) * sin_a + kEndSlack * v_length))
      return false;
    const double determinant = cross(at_a.tangent, at_b.tangent);
    if (determinant == 0 || !std::isfinite(determinant)) return false;
    const double by_s = cross(apart, at_b.tangent) / determinant, by_t = cross(apart, at_a.tangent) / determinant;
    s += by_s, t += by_t;
    // Both parts turn by less than the angle between them: the error after a step is about its square.
    if (std::abs(by_s) <= kLastStep * a.t.width() && std::abs(by_t) <= kLastStep * b.t.width()) break;
  }
  const auto inside = [](const Interval& range, double x) {
    const double slack = kEndSlack * range.width();
    return x >= range.lo - slack && x <= range.hi + slack;
  };
  if (!inside(a.t, s) || !inside(b.t, t)) return false;
  crossing = {a.t.clamp(s), b.t.clamp(t), false};
  return true;
}

// How a cell runs and bends along an axis: y' = Y'/X', y'' = (X' Y'' - Y' X'')/X'^3, X along the axis, Y across it.
struct Bend {
  Interval x, second;
  struct End {
    double x, y, slope;
  };
  End begin, end;

  // y there, by Taylor's formula from the nearer end.
  Interval at(double place) const {
    const End& from = std::abs(place - begin.x) < std::abs(place - end.x) ? begin : end;
    const double by = place - from.x;
    return from.y + by * from.slope + Interval(0.5 * by * by) * second;
  }
};
std::optional<Bend> bend_along(const Vec2& axis, const ProjectedCurve::Cell& cell) {
  const Vec2 across(-axis.y, axis.x), mean = (cell.end - cell.begin) / cell.t.width();
  const auto second = [&](const Vec2& way) {
    return Interval(way.x) * Interval(cell.second_lo.x, cell.second_hi.x) +
           Interval(way.y) * Interval(cell.second_lo.y, cell.second_hi.y);
  };
  const Interval x2 = second(axis), y2 = second(across);
  // P' differs from its mean by at most half the width times P''.
  const auto first = [&](const Vec2& way, const Interval& of_second) {
    const double middle = glm::dot(way, mean), reach = 0.5 * cell.t.width() * magnitude(of_second);
    return Interval(middle - reach, middle + reach);
  };
  const Interval x1 = first(axis, x2), y1 = first(across, y2);
  if (!(x1.lo > 0 || x1.hi < 0)) return std::nullopt;
  const auto end = [&](const Vec2& p, const Vec2& tangent) {
    return Bend::End{glm::dot(axis, p), glm::dot(across, p), glm::dot(across, tangent) / glm::dot(axis, tangent)};
  };
  const Bend::End from = end(cell.begin, cell.begin_tangent), to = end(cell.end, cell.end_tangent);
  return Bend{{std::min(from.x, to.x), std::max(from.x, to.x)}, (x1 * y2 - y1 * x2) / (x1 * x1 * x1), from, to};
}

// Whether one lies to one side of the other where both are, y_a - y_b being known at the ends and, to bounds of its
// second derivative, between them.
bool is_beside(const Bend& a, const Bend& b, const Interval& both) {
  const Interval at_lo = a.at(both.lo) - b.at(both.lo), at_hi = a.at(both.hi) - b.at(both.hi);
  const Interval second = a.second - b.second;
  const double sag = both.width() * both.width() / 8;
  return std::min(at_lo.lo, at_hi.lo) - sag * std::max(0.0, second.hi) > kTouching ||
         std::max(at_lo.hi, at_hi.hi) - sag * std::min(0.0, second.lo) < -kTouching;
}

// Whether two parts that meet at ends, whose directions are within `turn` of the chords, lead away from there to sides
// that have nothing else in common.
bool parts_ways(const Part& a, const Part& b, PictureCrossing& joint) {
  if (!(a.turn + b.turn < geometry::kPi)) return false;
  for (const bool at_end_of_a : {false, true})
    for (const bool at_end_of_b : {false, true}) {
      if (glm::length((at_end_of_a ? a.end : a.begin) - (at_end_of_b ? b.end : b.begin)) > kOneLine) continue;
      const double both = at_end_of_a == at_end_of_b ? glm::dot(a.chord, b.chord) : -glm::dot(a.chord, b.chord);
      if (!(both < std::cos(a.turn + b.turn) * a.length * b.length)) return false;
      joint = {at_end_of_a ? a.t.hi : a.t.lo, at_end_of_b ? b.t.hi : b.t.lo, true};
      return true;
    }
  return false;
}

// Two cells that run side by side, one bending more than the other: y_a - y_b is convex along the axis, or concave. It
// has one extremum where both are parallel, found by Newton's iteration on y_a' = y_b' kept where both are. If they are
// apart there, so they are everywhere, and if they touch there, then nowhere else. Otherwise nothing is told.
enum class Kiss { unknown, apart, touching };
Kiss kiss_of(const ProjectedCurve& a, const ProjectedCurve::Cell& of_a, const ProjectedCurve& b,
             const ProjectedCurve::Cell& of_b, PictureCrossing& found) {
  if (of_a.is_chord || of_b.is_chord) return Kiss::unknown;
  const Vec2 axis = glm::normalize(of_a.end - of_a.begin), across(-axis.y, axis.x);
  const std::optional<Bend> bend_a = bend_along(axis, of_a);
  if (!bend_a) return Kiss::unknown;
  const std::optional<Bend> bend_b = bend_along(axis, of_b);
  if (!bend_b) return Kiss::unknown;
  const Interval both = intersect(bend_a->x, bend_b->x);
  if (both.width() < -kTouching) return Kiss::apart;
  if (!(both.width() > kTouching)) return Kiss::unknown;
  if (is_beside(*bend_a, *bend_b, both)) return Kiss::apart;
  const bool convex = bend_a->second.lo > bend_b->second.hi;
  if (!convex && !(bend_a->second.hi < bend_b->second.lo)) return Kiss::unknown;
  // Of a place on either: x, y, y', y''.
  struct Graph {
    double t, speed, x, y, slope, second;
  };
  const auto graph = [&](const ProjectedCurve& curve, double t) {
    const auto [p, p1, p2] = curve.jet(t);
    const double x1 = glm::dot(axis, p1);
    return Graph{
        t, x1, glm::dot(axis, p), glm::dot(across, p), glm::dot(across, p1) / x1, cross(p1, p2) / (x1 * x1 * x1)};
  };
  // At a break the curve's own place is that from the right.
  const Interval range_a{of_a.t.lo, geometry::next_down(of_a.t.hi)}, range_b{of_b.t.lo, geometry::next_down(of_b.t.hi)};
  const auto at = [&](const ProjectedCurve::Cell& cell, double x) {
    const double begin = glm::dot(axis, cell.begin), end = glm::dot(axis, cell.end);
    return cell.t.lo + cell.t.width() * (x - begin) / (end - begin);
  };
  double s = at(of_a, both.middle()), t = at(of_b, both.middle());
  constexpr int kSteps = 12;
  constexpr double kNear = 1e-3;  // pixels: from there the series tells the rest
  for (int step = 0; step < kSteps; ++step) {
    const Graph p = graph(a, range_a.clamp(s)), q = graph(b, range_b.clamp(t));
    const double parallel = (q.slope - p.slope + p.second * p.x - q.second * q.x) / (p.second - q.second);
    const double x = both.clamp(parallel), of_p = x - p.x, of_q = x - q.x;
    s = p.t + of_p / p.speed, t = q.t + of_q / q.speed;
    if (!(std::abs(of_p) <= kNear && std::abs(of_q) <= kNear)) continue;
    const double gap = p.y - q.y + of_p * (p.slope + 0.5 * of_p * p.second) - of_q * (q.slope + 0.5 * of_q * q.second),
                 apart = convex ? gap : -gap;
    if (apart > kOneLine) return Kiss::apart;
    // The two crossings are about as far from the extremum.
    const double reach = std::sqrt(2 * std::max(0.0, -apart) / std::abs(p.second - q.second));
    if (std::abs(parallel - x) > kTouching || reach > 0.5 * kTouching) return Kiss::unknown;
    found = {range_a.clamp(s), range_b.clamp(t), true};
    return Kiss::touching;
  }
  return Kiss::unknown;
}

// The crossings of two cells. Cells that run along one another would touch everywhere: then none is told.
class CellPair {
 public:
  CellPair(Parts& parts_a, Parts& parts_b) : parts_a_(parts_a), parts_b_(parts_b) {
    cross_parts(0, 0);
    if (!runs_along_) return;
    common_ = common_part(parts_a[0], parts_b[0]);
    if (common_) return;
    common_ = parts_a[0].t;
    change_sides(parts_a[0], parts_b[0]);
  }
  // Where the first runs along the second.
  const std::optional<Interval>& common() const { return common_; }
  // Calls visit(crossing).
  template <class Visit>
  void each(Visit&& visit) const {
    for (const PictureCrossing& one : found_)
      if (!one.touching || !runs_along_) visit(one);
  }

 private:
  void cross_parts(int of_a, int of_b) {
    const Part &a = parts_a_[of_a], &b = parts_b_[of_b];
    if (runs_along_ || is_apart(a, b) || is_apart(b, a)) return;
    const double lengths = a.length * b.length;
    // The angle between the lines of both chords.
    const double sine = lengths > 0 ? std::abs(cross(a.chord, b.chord)) / lengths : 0;
    if (a.turn + b.turn < 0.5 * geometry::kPi && sine > std::sin(a.turn + b.turn) + 1e-9) {
      if (PictureCrossing crossing; solve(a, b, crossing)) found_.push_back(crossing);
      return;
    }
    if (!asked_) {
      asked_ = true;
      PictureCrossing touch;
      if (parts_ways(a, b, touch)) {
        found_.push_back(touch);
        return;
      }
      const Kiss kiss = kiss_of(*a.curve, parts_a_.cell(), *b.curve, parts_b_.cell(), touch);
      if (kiss == Kiss::touching) found_.push_back(touch);
      if (kiss != Kiss::unknown) return;
      runs_along_ = common_part(a, b).has_value();
      if (runs_along_) return;
    }
    const double of_first = a.length + a.bulge, of_second = b.length + b.bulge;
    if (std::max(of_first, of_second) < kTouching) {
      found_.push_back({a.t.middle(), b.t.middle(), true});
      ++touching_;
      runs_along_ = touching_ > kMaxTouching;
      return;
    }
    runs_along_ = runs_along_ || ++steps_ > kMaxSteps;
    if (of_first > of_second) {
      const int first = parts_a_.halves(of_a);
      cross_parts(first, of_b);
      cross_parts(first + 1, of_b);
    } else {
      const int first = parts_b_.halves(of_b);
      cross_parts(of_a, first);
      cross_parts(of_a, first + 1);
    }
  }
  // The place of a part nearest to q, and how far q is to the left of it; none if q lies beyond its ends, or farther
  // beside it than `most`.
  struct FootPoint {
    double t, beside;
  };
  static std::optional<FootPoint> foot_point_on(const Part& part, const Vec2& q, double most) {
    constexpr int kSteps = 6;
    const double square = glm::dot(part.chord, part.chord);
    double t = part.t.lo + part.t.width() * (square > 0 ? glm::dot(q - part.begin, part.chord) / square : 0.5);
    for (int step = 0; step < kSteps; ++step) {
      t = part.t.clamp(t);
      const auto at = part.curve->place(t);
      const Vec2 off = q - at.p;
      const double speed = glm::length(at.tangent);
      if (!(speed > 0)) return glm::length(off) <= kOneLine ? std::optional(FootPoint{t, 0}) : std::nullopt;
      const double ahead = glm::dot(off, at.tangent) / speed, beside = cross(at.tangent, off) / speed;
      // The part turns little: it does not come nearer to a place that is farther beside it than ahead.
      if (std::abs(beside) > most + 2 * std::abs(ahead)) break;
      if (std::abs(ahead) <= kOneLine) return FootPoint{t, beside};
      if ((t == part.t.lo && ahead < 0) || (t == part.t.hi && ahead > 0)) break;
      t += ahead / speed;
    }
    return std::nullopt;
  }
  static std::optional<double> parameter_at(const Part& part, const Vec2& q) {
    const std::optional<FootPoint> foot_point = foot_point_on(part, q, kOneLine);
    return foot_point && std::abs(foot_point->beside) <= kOneLine ? std::optional(foot_point->t) : std::nullopt;
  }

  // The stretch of one part that lies on the other: its ends, which are ends of either, and its middle do.
  static std::optional<Interval> common_part(const Part& a, const Part& b) {
    Interval common{geometry::kInfinity, -geometry::kInfinity};
    if (parameter_at(b, a.begin)) common = hull(common, Interval(a.t.lo));
    if (parameter_at(b, a.end)) common = hull(common, Interval(a.t.hi));
    for (const Vec2& end : {b.begin, b.end})
      if (const auto t = parameter_at(a, end)) common = hull(common, Interval(*t));
    if (common.width() > kMinCommon * a.t.width() && parameter_at(b, a.curve->point(common.middle()))) return common;
    return std::nullopt;
  }

  // The crossings of parts that are nearly one, or run side by side for long: where the first goes over to the other
  // side.
  void change_sides(const Part& a, const Part& b) {
    constexpr int kPlaces = 256, kHalvings = 50;
    constexpr double kNoSide = 1e-9;  // pixels
    const auto foot_point_of = [&](double t) { return foot_point_on(b, a.curve->point(t), geometry::kInfinity); };
    // At a break the curve's own place is that from the right.
    const Interval range{a.t.lo, geometry::next_down(a.t.hi)};
    std::optional<double> left, right;  // the last place there, since it changed sides
    for (int k = 0; k <= kPlaces; ++k) {
      const double t = range.lo + range.width() * k / kPlaces;
      const std::optional<FootPoint> foot_point = foot_point_of(t);
      if (!foot_point) left = right = std::nullopt;
      if (!foot_point || std::abs(foot_point->beside) <= kNoSide) continue;
      const bool is_left = foot_point->beside > 0;
      std::optional<double>&here = is_left ? left : right, &before = is_left ? right : left;
      if (before) {
        Interval change{*before, t};
        for (int halving = 0; halving < kHalvings; ++halving) {
          const std::optional<FootPoint> middle = foot_point_of(change.middle());
          (middle && (middle->beside > 0) == is_left ? change.hi : change.lo) = change.middle();
        }
        const std::optional<FootPoint> there = foot_point_of(change.hi);
        if (there && std::abs(there->beside) <= kOneLine) found_.push_back({change.hi, there->t, false});
      }
      here = t, before = std::nullopt;
    }
  }

  static constexpr int kMaxTouching = 16, kMaxSteps = 4000;
  static constexpr double kMinCommon = 1e-3;
  Parts &parts_a_, &parts_b_;
  std::vector<PictureCrossing> found_;
  int touching_ = 0, steps_ = 0;
  bool asked_ = false, runs_along_ = false;
  std::optional<Interval> common_;
};

}  // namespace

PictureCrossings::PictureCrossings(std::vector<const ProjectedCurve*> curves, double width, double height)
    : curves_(std::move(curves)) {
  size_t cells = 0;
  for (const ProjectedCurve* curve : curves_) cells += curve->cells().size();
  bin_ = std::clamp(std::sqrt(kCellsOfBin * width * height / static_cast<double>(std::max<size_t>(cells, 1))), kMinBin,
                    kLargestBin);
  columns_ = std::max(1, static_cast<int>(std::ceil(width / bin_)));
  rows_ = std::max(1, static_cast<int>(std::ceil(height / bin_)));
  bins_.resize(static_cast<size_t>(columns_) * rows_);
  for (size_t k = 0; k < curves_.size(); ++k)
    for (size_t i = 0; i < curves_[k]->cells().size(); ++i) {
      const ProjectedCurve::Cell& cell = curves_[k]->cells()[i];
      const Item item{static_cast<int>(k), static_cast<int>(i), glm::min(cell.begin, cell.end) - cell.bulge,
                      glm::max(cell.begin, cell.end) + cell.bulge};
      each_bin(item.lo, item.hi, [&](size_t bin) { bins_[bin].push_back(item); });
    }
}

size_t PictureCrossings::bin_of(const Vec2& place) const {
  const int i = std::clamp(static_cast<int>(place.x / bin_), 0, columns_ - 1),
            j = std::clamp(static_cast<int>(place.y / bin_), 0, rows_ - 1);
  return static_cast<size_t>(j) * columns_ + i;
}

template <class Visit>
void PictureCrossings::each_bin(const Vec2& lo, const Vec2& hi, Visit&& visit) const {
  const size_t first = bin_of(lo), last = bin_of(hi);
  for (size_t j = first / columns_; j <= last / columns_; ++j)
    for (size_t i = first % columns_; i <= last % columns_; ++i) visit(j * columns_ + i);
}

void PictureCrossings::collect(const ProjectedCurve& curve, const std::function<bool(int)>& skip,
                               std::vector<Hit>& hits) const {
  std::vector<Run> runs;
  Parts parts, parts_of_other;
  for (const ProjectedCurve::Cell& cell : curve.cells()) {
    parts.begin(curve, cell);
    const Vec2 lo = glm::min(cell.begin, cell.end) - cell.bulge, hi = glm::max(cell.begin, cell.end) + cell.bulge;
    each_bin(lo, hi, [&](size_t bin) {
      for (const Item& item : bins_[bin]) {
        if (item.lo.x > hi.x || lo.x > item.hi.x || item.lo.y > hi.y || lo.y > item.hi.y) continue;
        if (bin_of(glm::max(lo, item.lo)) != bin) continue;  // both are in several bins: once is enough
        if (skip(item.curve)) continue;
        const ProjectedCurve::Cell& of_other = curves_[item.curve]->cells()[item.cell];
        if (curves_[item.curve] == &curve &&
            (&of_other == &cell || of_other.t.lo == cell.t.hi || of_other.t.hi == cell.t.lo))
          continue;
        parts_of_other.begin(*curves_[item.curve], of_other);
        const CellPair pair(parts, parts_of_other);
        pair.each([&](const PictureCrossing& crossing) { hits.push_back({item.curve, crossing}); });
        if (pair.common()) runs.push_back({item.curve, *pair.common()});
      }
    });
  }
  if (!runs.empty()) drop_joints(curve, runs, hits);
}

// Where a curve runs along another each cell touches those before and behind its fellow at its ends.
void PictureCrossings::drop_joints(const ProjectedCurve& curve, std::vector<Run>& runs, std::vector<Hit>& hits) {
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return a.curve != b.curve ? a.curve < b.curve : a.t.lo < b.t.lo; });
  std::vector<Run> joined;
  for (const Run& run : runs) {
    const bool goes_on = !joined.empty() && joined.back().curve == run.curve &&
                         run.t.lo <= joined.back().t.hi + kEndSlack * run.t.width();
    if (goes_on)
      joined.back().t.hi = std::max(joined.back().t.hi, run.t.hi);
    else
      joined.push_back(run);
  }
  std::erase_if(hits, [&](const Hit& hit) {
    if (!hit.crossing.touching) return false;
    const Vec2 place = curve.point(hit.crossing.t);
    return std::any_of(joined.begin(), joined.end(), [&](const Run& run) {
      const auto is_end = [&](double t) { return glm::length(curve.point(t) - place) <= 2 * kTouching; };
      return run.curve == hit.curve && run.t.contains(hit.crossing.t) && !is_end(run.t.lo) && !is_end(run.t.hi);
    });
  });
}

}  // namespace lekalo::render
