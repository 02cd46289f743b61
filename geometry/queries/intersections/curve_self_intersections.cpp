// The curve is cut into parts. Two parts that do not follow each other are two curves. On one part, and on two that
// follow each other, r(s) = r(t) is divided by t - s (no solution s = t is left but where the curve stops, r' = 0):
//
//   q(s, t) = (r(t) - r(s)) / (t - s) = 0,   q in the hull of r' over [s, t],
//   q_s = (q - r'(s)) / (t - s),  q_t = (r'(t) - q) / (t - s),  both in r'' / 2 over [s, t] where r' does not jump.
//
// At a corner between two parts q is seen in a frame whose first axis halves the angle of the tangents: that component
// is positive near the corner, unless the curve turns back there.
#include <algorithm>
#include <cmath>

#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/intersections/curve_pair.h"
#include "geometry/queries/intersections/self_intersections.h"

namespace lekalo::geometry {

namespace {

// Of the domain: from places so near the quotient is taken from the Taylor polynomial between them.
constexpr double kNearDiagonal = 1e-4;

// Axes of the frame in which the components of q are taken.
using Axes = std::array<Vec3, 3>;
constexpr Axes kSpace{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

Interval component(const Box3& box, const Vec3& axis) {
  return Interval(axis.x) * along(box, 0) + Interval(axis.y) * along(box, 1) + Interval(axis.z) * along(box, 2);
}

// The quotient q, s on the first part, t + turn on the second, which is the first or follows it.
struct QuotientSystem {
  const Curve& curve;
  Interval first, second;
  double turn = 0;  // where the second part follows across the seam of a closed curve: the width of the domain
  Axes axes = kSpace;
  bool is_one() const { return first == second; }

  SystemValue<Interval, 2, 3> enclose(const ParameterBox<2>& box) const {
    const Interval s = box[0], t = box[1], apart = t + Interval(turn) - s;
    const bool is_apart = !apart.contains(0);
    const CurveEnclosure at_s = curve.enclose(s, 1), at_t = curve.enclose(t, 1);
    Box3 slope, slope_behind, change;
    if (is_one()) {
      const CurveEnclosure between = curve.enclose(hull(s, t), 2);
      slope = slope_behind = between.d[1], change = between.d[2];
    } else {
      slope = curve.enclose({s.lo, first.hi}, 1).d[1];
      slope_behind = curve.enclose({second.lo, t.hi}, 1).d[1];
    }
    SystemValue<Interval, 2, 3> q;
    for (int k = 0; k < 3; ++k) {
      const Vec3& axis = axes[k];
      q.value[k] = hull(component(slope, axis), component(slope_behind, axis));
      q.derivative[k] = {Interval::entire(), Interval::entire()};
      if (is_one()) q.derivative[k].fill(Interval(0.5) * component(change, axis));
      if (!is_apart) continue;
      const Interval quotient = (component(at_t.d[0], axis) - component(at_s.d[0], axis)) / apart;
      // Where the ends of a closed curve join only to its tolerance both may be apart; then the curve is not seen
      // closed.
      const Interval both = intersect(q.value[k], quotient);
      q.value[k] = both.empty() ? quotient : both;
      narrow(q.derivative[k][0], (q.value[k] - component(at_s.d[1], axis)) / apart);
      narrow(q.derivative[k][1], (component(at_t.d[1], axis) - q.value[k]) / apart);
    }
    return q;
  }

  SystemValue<double, 2, 3> evaluate(const ParameterPoint<2>& at) const {
    const double s = at[0], t = at[1], apart = t + turn - s;
    Vec3 value, by_s, by_t;
    if (is_one() && std::abs(apart) <= kNearDiagonal * curve.domain().width()) {
      const CurveJet r = evaluate_within(curve, first, 0.5 * (s + t), 4);
      value = r.d[1] + apart * apart / 24 * r.d[3];
      const Vec3 both = 0.5 * (r.d[2] + apart * apart / 24 * r.d[4]);
      by_s = both - apart / 12 * r.d[3], by_t = both + apart / 12 * r.d[3];
    } else {
      const CurveJet at_s = evaluate_within(curve, first, s, 1), at_t = evaluate_within(curve, second, t, 1);
      value = apart != 0 ? (at_t.d[0] - at_s.d[0]) / apart : at_t.d[1];
      by_s = apart != 0 ? (value - at_s.d[1]) / apart : Vec3(0);
      by_t = apart != 0 ? (at_t.d[1] - value) / apart : Vec3(0);
    }
    SystemValue<double, 2, 3> q;
    for (int k = 0; k < 3; ++k) {
      q.value[k] = glm::dot(axes[k], value);
      q.derivative[k] = {glm::dot(axes[k], by_s), glm::dot(axes[k], by_t)};
    }
    return q;
  }

 private:
  static void narrow(Interval& x, const Interval& by) {
    if (const Interval both = intersect(x, by); !both.empty()) x = both;
  }
};

// r' = 0, three equations for one unknown.
struct StopSystem {
  const Curve& curve;
  Interval piece;

  SystemValue<Interval, 1, 3> enclose(const ParameterBox<1>& t) const {
    const CurveEnclosure r = curve.enclose(t[0], 2);
    SystemValue<Interval, 1, 3> f;
    for (int k = 0; k < 3; ++k) f.value[k] = along(r.d[1], k), f.derivative[k] = {along(r.d[2], k)};
    return f;
  }
  SystemValue<double, 1, 3> evaluate(const ParameterPoint<1>& t) const {
    const CurveJet r = evaluate_within(curve, piece, t[0], 2);
    SystemValue<double, 1, 3> f;
    for (int k = 0; k < 3; ++k) f.value[k] = r.d[1][k], f.derivative[k] = {r.d[2][k]};
    return f;
  }
};

// Of the mean speed: slower is a stop.
constexpr double kStopped = 1e-6;

class SelfIntersections {
 public:
  SelfIntersections(const Curve& curve, double tolerance)
      : curve_(curve),
        domain_(curve.domain()),
        projector_(CurvePtr(CurvePtr(), &curve)),
        is_closed_(curve.is_closed() || (curve.period() > 0 && domain_.width() >= curve.period())) {
    const Box3 box = bounds(curve);
    tolerance_ = tolerance * std::max(box.diameter(), 1e-300);
    slowest_ = kStopped * box.diameter() / domain_.width();
    rounding_ = rounding_in(box);
    least_ = min_box(tolerance) * domain_.width();
  }

  CurveSelfIntersections run() {
    find_stops();
    find_common();
    for (const double t : stops_) add_cusp(t);
    cut();
    for (size_t a = 0; a < parts_.size(); ++a)
      for (size_t b = a; b < parts_.size(); ++b)
        if (may_meet(a, b) && !is_common(parts_[a], parts_[b])) meet(a, b);
    tell_contacts_from_crossings(
        result_.points, tolerance_, rounding_,
        [](const CurveSelfIntersection& one) { return one.kind == SelfIntersectionKind::contact; },
        [&](const CurveSelfIntersection& one, const CurveSelfIntersection& other, double by) {
          return one.kind != SelfIntersectionKind::cusp && other.kind != SelfIntersectionKind::cusp &&
                 holds_between(curve_, one.s, other.s, [&](double s) { return !others_at(s, by).empty(); });
        });
    std::erase_if(result_.points,
                  [&, known = result_.points](const CurveSelfIntersection& one) { return is_beside_cusp(one, known); });
    std::sort(result_.points.begin(), result_.points.end(),
              [](const CurveSelfIntersection& x, const CurveSelfIntersection& y) {
                return x.s != y.s ? x.s < y.s : x.t < y.t;
              });
    return std::move(result_);
  }

 private:
  double near() const { return 4 * least_; }

  // Where r' vanishes, inside of smooth pieces or at their ends.
  void find_stops() {
    for (const CurvePiece& piece : curve_.pieces()) {
      RootSearchOptions<1, 3> options;
      options.least = {least_};
      options.slack = {kBorderSlack * domain_.width()};
      options.tolerance.fill(tolerance_ / domain_.width());
      const auto found = search_roots<1, 3>(StopSystem{curve_, piece.domain}, ParameterBox<1>{piece.domain}, options);
      for (const auto& t : found.isolated) stops_.push_back(t[0]);
      for (const auto& t : found.open)
        if (t[0].width() <= near() && !goes_on(t[0].lo, t[0].hi)) stops_.push_back(t[0].middle());
    }
  }

  // Between two places so near that enclosures tell nothing: neither stops nor turns back, by the tangents beside them.
  bool goes_on(double from, double to) const {
    const Vec3 before = curve_.evaluate(domain_.clamp(from - 2 * least_), 1).d[1],
               behind = curve_.evaluate(domain_.clamp(to + 2 * least_), 1).d[1];
    return glm::dot(before, behind) > 0 && glm::length(before) > slowest_ && glm::length(behind) > slowest_;
  }

  // Where else the curve goes through its point at s, to the tolerance.
  std::vector<double> others_at(double s) const { return others_at(s, tolerance_); }
  std::vector<double> others_at(double s, double tolerance) const {
    std::vector<double> places;
    for (const CurveFootPoint& foot_point : projector_.foot_points(curve_.point(s), tolerance).foot_points)
      if (!is_one(foot_point.t, s)) places.push_back(foot_point.t);
    return places;
  }

  // Parts can begin and end only at the ends of smooth pieces, where the curve stops and turns back, or where it goes
  // through one of these again.
  void find_common() {
    std::vector<double> places;
    for (const CurvePiece& piece : curve_.pieces()) places.push_back(piece.domain.lo);
    places.push_back(domain_.hi);
    places.insert(places.end(), stops_.begin(), stops_.end());
    const size_t ends = places.size();
    for (size_t k = 0; k < ends; ++k)
      for (const double t : others_at(places[k])) places.push_back(t);
    std::sort(places.begin(), places.end());
    for (size_t k = 0; k + 1 < places.size(); ++k) {
      const Interval part{places[k], places[k + 1]};
      if (!(part.width() > near())) continue;
      for (const double t : others_at(part.middle()))
        if (t > part.middle()) follow(part, t);
    }
  }

  // Adds the part if the curve runs along it again, at t where it is at its middle.
  void follow(const Interval& part, double t) {
    CommonPart common{part, t, t};
    for (const bool forwards : {false, true}) {
      double at = t;
      for (int i = 1; 2 * i <= kPlacesOfCommonPart; ++i) {
        const double share = 0.5 * share_of_place(2 * i);
        const double s = part.middle() + (forwards ? share : -share) * part.width();
        double next = kInfinity;
        for (const CurveFootPoint& foot_point : projector_.foot_points(curve_.point(s), tolerance_).foot_points) {
          if (2 * i < kPlacesOfCommonPart && is_one(foot_point.t, s)) continue;
          if (std::abs(foot_point.t - at) < std::abs(next - at)) next = foot_point.t;
          // A foot point on the seam of a closed curve is at both ends.
          const double other_end =
              foot_point.t + (foot_point.t < domain_.middle() ? domain_.width() : -domain_.width());
          if (is_closed_ && std::abs(domain_.clamp(other_end) - other_end) <= near() &&
              std::abs(other_end - at) < std::abs(next - at))
            next = domain_.clamp(other_end);
        }
        if (next == kInfinity) return;
        at = next;
      }
      (forwards ? common.end : common.begin) = at;
    }
    if (!result_.common.empty()) {
      CommonPart& before = result_.common.back();
      if (std::abs(before.s.hi - part.lo) <= near() && std::abs(before.end - common.begin) <= near()) {
        before.s.hi = part.hi, before.end = common.end;
        return;
      }
    }
    result_.common.push_back(common);
  }

  static Interval image(const CommonPart& common) {
    return {std::min(common.begin, common.end), std::max(common.begin, common.end)};
  }
  bool is_common(const Interval& a, const Interval& b) const {
    return std::any_of(result_.common.begin(), result_.common.end(), [&](const CommonPart& common) {
      const Interval of_b = image(common);
      return a.lo >= common.s.lo - near() && a.hi <= common.s.hi + near() && b.lo >= of_b.lo - near() &&
             b.hi <= of_b.hi + near();
    });
  }

  // Smooth pieces, cut at the ends of common parts; at least three of a closed curve, so that none follows another at
  // both ends.
  void cut() {
    std::vector<double> cuts;
    for (const CommonPart& common : result_.common)
      cuts.insert(cuts.end(), {common.s.lo, common.s.hi, common.begin, common.end});
    const std::vector<CurvePiece> pieces = curve_.pieces();
    if (is_closed_ && pieces.size() < 3)
      for (const CurvePiece& piece : pieces)
        for (const double share : {0.31, 0.64}) cuts.push_back(piece.domain.lo + share * piece.domain.width());
    std::sort(cuts.begin(), cuts.end());
    for (const CurvePiece& piece : pieces) {
      double from = piece.domain.lo;
      for (const double at : cuts)
        if (at > from + near() && at < piece.domain.hi - near()) parts_.push_back({from, at}), from = at;
      parts_.push_back({from, piece.domain.hi});
    }
    for (const Interval& part : parts_) boxes_.push_back(curve_.enclose(part, 0).d[0]);
  }

  // Parts that follow each other, the last and the first of a closed curve too, are searched wherever they lie.
  bool follow_each_other(size_t a, size_t b) const {
    return b <= a + 1 || (is_closed_ && a == 0 && b + 1 == parts_.size());
  }
  bool may_meet(size_t a, size_t b) const {
    return follow_each_other(a, b) || are_near(boxes_[a], boxes_[b], tolerance_);
  }

  void meet(size_t a, size_t b) {
    const Interval &first = parts_[a], &second = parts_[b];
    if (a == b) return search(QuotientSystem{curve_, first, second}, first, second, tolerance_ / domain_.width());
    if (b == a + 1) return search(joined(first, second, 0), first, second, tolerance_ / domain_.width());
    if (is_closed_ && a == 0 && b + 1 == parts_.size())
      return search(joined(second, first, domain_.width()), second, first, tolerance_ / domain_.width());
    search(PairSystem{curve_, curve_, first, second}, first, second, tolerance_);
  }

  QuotientSystem joined(const Interval& first, const Interval& second, double turn) const {
    QuotientSystem system{curve_, first, second, turn};
    const Vec3 before = evaluate_within(curve_, first, first.hi, 1).d[1], behind = curve_.evaluate(second.lo, 1).d[1];
    const double of_before = glm::length(before), of_behind = glm::length(behind);
    if (!(of_before > 0 && of_behind > 0)) return system;
    const Vec3 middle = before / of_before + behind / of_behind;
    if (!(glm::length(middle) > kParallel)) return system;
    const Frame frame = frame_about(Vec3(0), glm::normalize(middle));
    system.axes = {frame.z, frame.x, frame.y};
    return system;
  }

  template <class System>
  void search(const System& system, const Interval& first, const Interval& second, double tolerance) {
    RootSearchOptions<2, 3> options;
    options.least = {least_, least_};
    options.slack = {slack_of(curve_, first, tolerance_), slack_of(curve_, second, tolerance_)};
    options.tolerance = {tolerance, tolerance, tolerance};
    const ParameterBox<2> domain{first, second};
    auto found = search_roots<2, 3>(system, domain, options);
    // Nearer than that two places are one: only a cusp is asked for.
    if (hull(first, second).width() > near())
      isolate_crossings<2, 3>(system, domain, options, rounding_ / tolerance_, found);
    for (const auto& at : found.isolated) add(at[0], at[1], false);
    for (const auto& box : found.open) {
      if (may_be_cusp(box)) {
        // Where r' does not vanish the curve turns back at a corner, or stops but for less than the least box. Where it
        // goes on, nothing is known but that its enclosures are wide, as those of intersections beside poles.
        const Interval both = intersect(box[0], box[1]);
        const bool at_seam = box[0].lo > box[1].hi + 2 * least_;
        if (at_seam ? !goes_on(box[0].lo, box[1].hi)
                    : !goes_on(std::min(box[0].lo, box[1].lo), std::max(box[0].hi, box[1].hi)))
          add_cusp(both.width() > 0 ? both.middle() : box[0].hi);
        continue;
      }
      ParameterPoint<2> middle, reach;
      for (int i = 0; i < 2; ++i) middle[i] = box[i].middle(), reach[i] = box[i].width() + 10 * least_;
      const ParameterPoint<2> touching = PairSystem{curve_, curve_, first, second}.contact_near(middle, reach);
      if (add(first.clamp(touching[0]), second.clamp(touching[1]), true)) continue;
      const ParameterPoint<2> crossing =
          refined<2, 3>(middle, reach, [&](const auto& at) { return system.evaluate(at); });
      add(first.clamp(crossing[0]), second.clamp(crossing[1]), true);
    }
  }

  // An open box at s = t, or at both sides of the seam.
  bool may_be_cusp(const ParameterBox<2>& box) const {
    const double by = 2 * least_;
    return (box[0].lo - by <= box[1].hi && box[1].lo - by <= box[0].hi) ||
           (is_closed_ && box[0].hi >= domain_.hi - by && box[1].lo <= domain_.lo + by);
  }

  void add_cusp(double at) {
    const double t = on_one_side(domain_.clamp(at));
    const CurveSelfIntersection cusp{SelfIntersectionKind::cusp, t, t, curve_.point(t), 0};
    if (!is_known(cusp)) result_.points.push_back(cusp);
  }

  // Whether a cusp lies between both parameters, from which both arms stay within the tolerance of each other.
  bool is_beside_cusp(const CurveSelfIntersection& one, const std::vector<CurveSelfIntersection>& known) const {
    if (one.kind == SelfIntersectionKind::cusp) return false;
    return std::any_of(known.begin(), known.end(), [&](const CurveSelfIntersection& cusp) {
      if (cusp.kind != SelfIntersectionKind::cusp) return false;
      const auto from_cusp = [&](double t) {
        const double by = t - cusp.s;
        return is_closed_ ? by - domain_.width() * std::round(by / domain_.width()) : by;
      };
      const double arm = from_cusp(one.s), other_arm = from_cusp(one.t);
      if (!(arm * other_arm < 0)) return false;
      return holds_between(curve_, cusp.s, one.s, [&](double s) {
        const std::vector<double> others = others_at(s);
        return std::any_of(others.begin(), others.end(), [&](double t) {
          return from_cusp(t) * other_arm > 0 && std::abs(from_cusp(t)) <= std::abs(other_arm) + near();
        });
      });
    });
  }

  // The seam of a closed curve is its begin.
  double on_one_side(double t) const { return is_closed_ && t >= domain_.hi - near() ? domain_.lo : t; }

  bool is_known(const CurveSelfIntersection& one) const {
    for (const CommonPart& common : result_.common) {
      const Interval of_t = image(common);
      if (is_within({common.s}, one.s, near()) && is_within({of_t}, one.t, near())) return true;
      for (const auto& [s, t] : {std::pair(common.s.lo, common.begin), std::pair(common.s.hi, common.end)})
        if ((is_one(s, one.s) && is_one(t, one.t)) || (is_one(s, one.t) && is_one(t, one.s))) return true;
    }
    return std::any_of(result_.points.begin(), result_.points.end(), [&](const CurveSelfIntersection& other) {
      return glm::length(other.point - one.point) <= 4 * tolerance_ && is_one(other.s, one.s) && is_one(other.t, one.t);
    });
  }
  bool is_one(double a, double b) const { return is_one_place(curve_, a, b, near()); }

  // False if the places are farther from each other than the tolerance.
  bool add(double s, double t, bool open) {
    s = on_one_side(s), t = on_one_side(t);
    if (s > t) std::swap(s, t);
    const CurveJet at_s = curve_.evaluate(s, 1), at_t = curve_.evaluate(t, 1);
    CurveSelfIntersection intersection{SelfIntersectionKind::crossing, s, t, 0.5 * (at_s.d[0] + at_t.d[0]),
                                       glm::length(at_s.d[0] - at_t.d[0])};
    if (!(intersection.distance <= tolerance_) || is_one(s, t)) return false;
    if (open && sine_between(at_s.d[1], at_t.d[1]) < kParallel) intersection.kind = SelfIntersectionKind::contact;
    if (!is_known(intersection)) result_.points.push_back(intersection);
    return true;
  }

  const Curve& curve_;
  const Interval domain_;
  const CurveProjector projector_;
  const bool is_closed_;
  double tolerance_ = 0;  // a length
  double slowest_ = 0;    // speed that is none
  double rounding_ = 0;   // likewise: what it leaves between places where the curve meets itself
  double least_ = 0;      // of the parameter
  std::vector<double> stops_;
  std::vector<Interval> parts_;
  std::vector<Box3> boxes_;  // of the parts
  CurveSelfIntersections result_;
};

}  // namespace

CurveSelfIntersections self_intersections(const Curve& curve, double tolerance) {
  return SelfIntersections(curve, tolerance).run();
}

}  // namespace lekalo::geometry
