#include "geometry/queries/intersections/curve_intersections.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "geometry/box_corners.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/implicit_curves/smooth_parts.h"
#include "geometry/queries/intersections/conic_intersections.h"
#include "geometry/queries/intersections/curve_pair.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

namespace {

// r(t) - s(u, v) = 0 (Golovanov 2016, (4.4.2)); unknowns t, u, v.
struct PierceSystem {
  const Curve& curve;
  const Surface& surface;
  Interval piece;
  Rectangle patch;

  SystemValue<Interval, 3, 3> enclose(const ParameterBox<3>& box) const {
    const CurveEnclosure r = curve.enclose(box[0], 1);
    const SurfaceEnclosure s = surface.enclose({box[1], box[2]}, 1);
    SystemValue<Interval, 3, 3> result;
    for (int k = 0; k < 3; ++k) {
      result.value[k] = along(r.d[0], k) - along(s.d(0, 0), k);
      result.derivative[k] = {along(r.d[1], k), -along(s.d(1, 0), k), -along(s.d(0, 1), k)};
    }
    return result;
  }
  SystemValue<double, 3, 3> evaluate(const ParameterPoint<3>& at) const {
    const CurveJet r = evaluate_within(curve, piece, at[0], 1);
    const SurfaceJet s = evaluate_within(surface, patch, at[1], at[2], 1);
    SystemValue<double, 3, 3> result;
    for (int k = 0; k < 3; ++k) {
      result.value[k] = r.d[0][k] - s.point()[k];
      result.derivative[k] = {r.d[1][k], -s.du()[k], -s.dv()[k]};
    }
    return result;
  }
  // (r - s) . s_u = (r - s) . s_v = 0 and r' . (s_u x s_v) = 0.
  ParameterPoint<3> contact_near(const ParameterPoint<3>& start, const ParameterPoint<3>& reach) const {
    return refined<3, 3>(start, reach, [&](const ParameterPoint<3>& at) {
      const CurveJet r = curve.evaluate(at[0], 2);
      const SurfaceJet s = surface.evaluate(at[1], at[2], 2);
      const Vec3 way = r.d[0] - s.point(), normal = glm::cross(s.du(), s.dv());
      const Vec3 normal_u = glm::cross(s.duu(), s.dv()) + glm::cross(s.du(), s.duv());
      const Vec3 normal_v = glm::cross(s.duv(), s.dv()) + glm::cross(s.du(), s.dvv());
      const double mixed = glm::dot(way, s.duv()) - glm::dot(s.du(), s.dv());
      SystemValue<double, 3, 3> f;
      f.value = {glm::dot(way, s.du()), glm::dot(way, s.dv()), glm::dot(r.d[1], normal)};
      f.derivative[0] = {glm::dot(r.d[1], s.du()), glm::dot(way, s.duu()) - glm::dot(s.du(), s.du()), mixed};
      f.derivative[1] = {glm::dot(r.d[1], s.dv()), mixed, glm::dot(way, s.dvv()) - glm::dot(s.dv(), s.dv())};
      f.derivative[2] = {glm::dot(r.d[2], normal), glm::dot(r.d[1], normal_u), glm::dot(r.d[1], normal_v)};
      return f;
    });
  }
};

constexpr auto is_contact = [](const auto& intersection) { return intersection.contact; };

// What of a piece is left without the common parts.
std::vector<Interval> without(const Interval& piece, const std::vector<Interval>& parts) {
  std::vector<Interval> rest;
  double from = piece.lo;
  for (const Interval& part : parts) {
    if (part.hi <= piece.lo || part.lo >= piece.hi) continue;
    if (part.lo > from) rest.push_back({from, part.lo});
    from = std::max(from, part.hi);
  }
  if (from < piece.hi) rest.push_back({from, piece.hi});
  return rest;
}

class CurvePair {
 public:
  CurvePair(const Curve& a, const Curve& b, double tolerance) : a_(a), b_(b) {
    box_a_ = bounds(a), box_b_ = bounds(b);
    Box3 all = box_a_;
    all.include(box_b_);
    tolerance_ = tolerance * std::max(all.diameter(), 1e-300);
    rounding_ = rounding_in(all);
    least_ = min_box(tolerance);
  }

  CurveIntersections run() {
    if (!are_near(box_a_, box_b_, tolerance_)) return {};
    if (auto known = line_conic_intersections(a_, b_, tolerance_)) return *std::move(known);
    pieces_a_ = a_.pieces(), pieces_b_ = b_.pieces();
    on_a_.emplace(CurvePtr(CurvePtr(), &a_), pieces_a_), on_b_.emplace(CurvePtr(CurvePtr(), &b_), pieces_b_);
    find_common();
    std::vector<std::pair<Interval, Box3>> parts_of_a;
    for (const CurvePiece& of_a : pieces_a_)
      for (const Interval& part : without(of_a.domain, parts_)) parts_of_a.emplace_back(part, a_.enclose(part, 0).d[0]);
    for (const CurvePiece& of_b : pieces_b_) {
      const Box3 box = b_.enclose(of_b.domain, 0).d[0];
      for (const auto& [part, box_of_part] : parts_of_a)
        if (are_near(box_of_part, box, tolerance_)) search({a_, b_, part, of_b.domain});
    }
    const auto are_one = [&](const CurveIntersection& one, const CurveIntersection& other, double by) {
      return holds_between(a_, one.s, other.s, [&](double s) { return place_on(*on_b_, a_.point(s), by).has_value(); });
    };
    tell_contacts_from_crossings(result_.points, tolerance_, rounding_, is_contact, are_one);
    std::sort(result_.points.begin(), result_.points.end(), [](const CurveIntersection& x, const CurveIntersection& y) {
      return x.s != y.s ? x.s < y.s : x.t < y.t;
    });
    return std::move(result_);
  }

 private:
  // The foot point of a point if it lies on the curve.
  static std::optional<double> place_on(const CurveProjector& curve, const Vec3& p, double tolerance) {
    const CurveFootPoints found = curve.foot_points(p, tolerance);
    return found.foot_points.empty() ? std::nullopt : std::optional(found.foot_points[0].t);
  }
  std::optional<double> place_on_a(const Vec3& p) const { return place_on(*on_a_, p, tolerance_); }
  std::optional<double> place_on_b(const Vec3& p) const { return place_on(*on_b_, p, tolerance_); }

  // Curves can part only at an end of a smooth piece of either.
  void find_common() {
    std::vector<double> places;
    const auto add = [&](const Vec3& p, double s) {
      if (box_b_.inflated(tolerance_).contains(p) && place_on_b(p)) places.push_back(s);
    };
    for (const CurvePiece& piece : pieces_a_) add(a_.point(piece.domain.lo), piece.domain.lo);
    add(a_.point(a_.domain().hi), a_.domain().hi);
    const auto add_of_b = [&](double t) {
      const Vec3 p = b_.point(t);
      if (!box_a_.inflated(tolerance_).contains(p)) return;
      for (const CurveFootPoint& foot_point : on_a_->foot_points(p, tolerance_).foot_points)
        places.push_back(foot_point.t);
    };
    for (const CurvePiece& piece : pieces_b_) add_of_b(piece.domain.lo);
    add_of_b(b_.domain().hi);
    parts_ = common_parts(places, least_ * a_.domain().width(),
                          [&](double s) { return place_on_b(a_.point(s)).has_value(); });
    for (const Interval& part : parts_) {
      CommonPart common{part, 0, 0};
      // Along the second curve step by step, across its seam.
      const double turn = b_.period() > 0 ? b_.period() : b_.domain().width();
      double t = place_on_b(a_.point(part.lo)).value_or(0);
      const double first = *place_on_b(a_.point(part.lo + part.width() * share_of_place(1)));
      // An end on the seam is on that side of it where the part goes.
      if (b_.is_closed() && std::abs(first - t) > 0.5 * turn) t += first > t ? turn : -turn;
      common.begin = t;
      for (int i = 1; i <= kPlacesOfCommonPart; ++i) {
        double next = place_on_b(a_.point(part.lo + part.width() * share_of_place(i))).value_or(t);
        if (b_.is_closed()) next += turn * std::round((t - next) / turn);
        t = next;
      }
      common.end = t;
      result_.common.push_back(common);
    }
  }

  void search(const PairSystem& system) {
    RootSearchOptions<2, 3> options;
    options.least = {least_ * a_.domain().width(), least_ * b_.domain().width()};
    options.slack = {slack_of(a_, system.piece_a, tolerance_), slack_of(b_, system.piece_b, tolerance_)};
    options.tolerance = {tolerance_, tolerance_, tolerance_};
    const ParameterBox<2> domain{system.piece_a, system.piece_b};
    auto found = search_roots<2, 3>(system, domain, options);
    isolate_crossings<2, 3>(system, domain, options, rounding_ / tolerance_, found);
    for (const auto& at : found.isolated) add(at, false);
    for (const auto& box : found.open) {
      ParameterPoint<2> middle, reach;
      for (int i = 0; i < 2; ++i) middle[i] = box[i].middle(), reach[i] = box[i].width() + 10 * options.least[i];
      const auto within = [&](const ParameterPoint<2>& at) -> ParameterPoint<2> {
        return {system.piece_a.clamp(at[0]), system.piece_b.clamp(at[1])};
      };
      // Where they do not touch they cross at an angle too small to tell, or at a cusp.
      if (!add(within(system.contact_near(middle, reach)), true) &&
          !add(within(refined<2, 3>(middle, reach, [&](const auto& at) { return system.evaluate(at); })), true))
        add_ends(system, box, reach);
    }
  }

  // Where a piece begins or ends with an infinite slope: no iteration comes there.
  void add_ends(const PairSystem& system, const ParameterBox<2>& box, const ParameterPoint<2>& reach) {
    const auto is_near = [&](int i, double end) { return end >= box[i].lo - reach[i] && end <= box[i].hi + reach[i]; };
    for (const double s : {system.piece_a.lo, system.piece_a.hi})
      if (is_near(0, s))
        if (const auto t = place_on_b(a_.point(s)); t && is_near(1, *t)) add({s, *t}, true);
    for (const double t : {system.piece_b.lo, system.piece_b.hi})
      if (is_near(1, t))
        if (const auto s = place_on_a(b_.point(t)); s && is_near(0, *s)) add({*s, t}, true);
  }

  // False if the curves are farther from each other there than the tolerance.
  bool add(const ParameterPoint<2>& at, bool contact) {
    const CurveJet ra = a_.evaluate(at[0], 1), rb = b_.evaluate(at[1], 1);
    CurveIntersection intersection{at[0], at[1], 0.5 * (ra.d[0] + rb.d[0]), glm::length(ra.d[0] - rb.d[0])};
    if (!(intersection.distance <= tolerance_)) return false;
    intersection.contact = contact && sine_between(ra.d[1], rb.d[1]) < kParallel;
    const double near_a = 4 * least_ * a_.domain().width(), near_b = 4 * least_ * b_.domain().width();
    if (is_within(parts_, at[0], near_a)) return true;
    for (CurveIntersection& other : result_.points)
      if (glm::length(other.point - intersection.point) <= 4 * tolerance_ && is_one_place(a_, other.s, at[0], near_a) &&
          is_one_place(b_, other.t, at[1], near_b))
        return true;
    result_.points.push_back(intersection);
    return true;
  }

  const Curve &a_, &b_;
  Box3 box_a_, box_b_;
  double tolerance_ = 0;  // a length
  double rounding_ = 0;   // likewise: what it leaves between curves that meet
  double least_ = 0;      // part of a domain
  std::vector<CurvePiece> pieces_a_, pieces_b_;
  std::optional<CurveProjector> on_a_, on_b_;
  std::vector<Interval> parts_;  // of the first, common
  CurveIntersections result_;
};

class CurveAndSurface {
 public:
  CurveAndSurface(const Curve& curve, const Surface& surface, double tolerance) : curve_(curve), surface_(surface) {
    box_ = bounds(curve);
    Box3 all = box_;
    if (surface.bounded()) surface_box_ = bounds(surface), all.include(surface_box_);
    relative_ = tolerance;
    tolerance_ = tolerance * std::max(all.diameter(), 1e-300);
    rounding_ = rounding_in(all);
    least_ = min_box(tolerance);
  }

  SurfaceIntersections run() {
    if (auto known = conic_intersections(curve_, surface_, tolerance_)) return *std::move(known);
    patches_ = patches();
    const std::vector<CurvePiece> pieces = curve_.pieces();
    // Along a common part no solution is isolated: such parts, which take long to find, are looked for only then.
    if (!search_all(pieces, true)) {
      result_ = {};
      find_parts_on_surface(pieces);
      search_all(pieces, false);
    }
    const auto are_one = [&](const SurfaceIntersection& one, const SurfaceIntersection& other, double by) {
      return holds_between(curve_, one.t, other.t, [&](double t) { return lies_on_surface(t, by); });
    };
    tell_contacts_from_crossings(result_.points, tolerance_, rounding_, is_contact, are_one);
    std::sort(result_.points.begin(), result_.points.end(),
              [](const SurfaceIntersection& a, const SurfaceIntersection& b) { return a.t < b.t; });
    return std::move(result_);
  }

 private:
  // The smooth patches; of an unbounded plane what the curve's box reaches.
  std::vector<Rectangle> patches() const {
    std::vector<Rectangle> result;
    if (surface_.bounded()) {
      for (const SurfacePiece& piece : surface_.pieces()) result.push_back(piece.domain);
      return result;
    }
    const auto* plane = dynamic_cast<const Plane*>(&surface_);
    if (!plane) throw std::invalid_argument("the surface is unbounded: give it a domain to intersect");
    Interval u{kInfinity, -kInfinity}, v = u;
    for (const Vec3& corner : corners(box_)) {
      const Vec3 local = plane->frame().to_local_point(corner);
      u = hull(u, Interval(local.x));
      v = hull(v, Interval(local.y));
    }
    const double more = box_.diameter();
    const Rectangle domain = plane->domain();
    const Rectangle near{intersect(Interval(u.lo - more, u.hi + more), domain.u),
                         intersect(Interval(v.lo - more, v.hi + more), domain.v)};
    if (!near.u.empty() && !near.v.empty()) result.push_back(near);
    return result;
  }

  double width_u() const {
    return width([](const Rectangle& r) { return r.u; });
  }
  double width_v() const {
    return width([](const Rectangle& r) { return r.v; });
  }
  template <class Side>
  double width(Side&& side) const {
    Interval all = side(patches_.front());
    for (const Rectangle& patch : patches_) all = hull(all, side(patch));
    return all.width();
  }

  bool lies_on_surface(double t, double tolerance) const {
    const Vec3 p = curve_.point(t);
    if (!surface_box_.inflated(tolerance).contains(p)) return false;
    const SurfaceFootPoints found = project(p, surface_);
    return !found.foot_points.empty() && found.foot_points[0].distance <= tolerance;
  }

  // A curve leaves a surface only at an end of a smooth piece of its own or at the border of a smooth patch.
  void find_parts_on_surface(const std::vector<CurvePiece>& pieces) {
    std::vector<double> places;
    for (const CurvePiece& piece : pieces) places.push_back(piece.domain.lo);
    places.push_back(curve_.domain().hi);
    if (surface_.bounded()) {
      const SurfacePtr surface(SurfacePtr(), &surface_);
      const Rectangle domain = surface_.domain();
      for (const auto& [held, at] :
           {std::pair(IsoDirection::u, domain.u.lo), std::pair(IsoDirection::u, domain.u.hi),
            std::pair(IsoDirection::v, domain.v.lo), std::pair(IsoDirection::v, domain.v.hi)}) {
        const ParameterLine edge(surface, held, at);
        if (bounds(edge).diameter() <= tolerance_) continue;
        const CurveIntersections met = intersect(curve_, edge, relative_);
        for (const CurveIntersection& one : met.points) places.push_back(one.s);
        for (const CommonPart& one : met.common) places.insert(places.end(), {one.s.lo, one.s.hi});
      }
    }
    result_.on_surface = common_parts(places, least_ * curve_.domain().width(),
                                      [&](double t) { return lies_on_surface(t, tolerance_); });
  }

  // False where all solutions are to be isolated and are not.
  bool search_all(const std::vector<CurvePiece>& pieces, bool isolated) {
    for (const Rectangle& patch : patches_) {
      const Box3 box = surface_.enclose(patch, 0).d(0, 0);
      for (const CurvePiece& piece : pieces)
        for (const Interval& part : without(piece.domain, result_.on_surface))
          if (are_near(curve_.enclose(part, 0).d[0], box, tolerance_) &&
              !search({curve_, surface_, part, patch}, isolated))
            return false;
    }
    return true;
  }

  // Whether curve and surface are within the tolerance somewhere in a box so small that both are straight.
  bool comes_near(const PierceSystem& system, const ParameterBox<3>& box) const {
    const SystemValue<double, 3, 3> there = system.evaluate({box[0].middle(), box[1].middle(), box[2].middle()});
    double apart = 0, reach = 0;
    for (int k = 0; k < 3; ++k) {
      apart = std::max(apart, std::abs(there.value[k]));
      for (int i = 0; i < 3; ++i) reach += std::abs(there.derivative[k][i]) * box[i].width();
    }
    return apart <= tolerance_ + reach;
  }

  bool search(const PierceSystem& system, bool isolated) {
    RootSearchOptions<3, 3> options;
    options.least = {least_ * curve_.domain().width(), least_ * width_u(), least_ * width_v()};
    options.slack = {slack_of(curve_, system.piece, tolerance_), kBorderSlack * width_u(), kBorderSlack * width_v()};
    options.tolerance = {tolerance_, tolerance_, tolerance_};
    const ParameterBox<3> domain{system.piece, system.patch.u, system.patch.v};
    auto found = search_roots<3, 3>(system, domain, options);
    isolate_crossings<3, 3>(system, domain, options, rounding_ / tolerance_, found);
    if (isolated && std::any_of(found.open.begin(), found.open.end(),
                                [&](const ParameterBox<3>& box) { return comes_near(system, box); }))
      return false;
    for (const auto& at : found.isolated) add(at, false);
    for (const auto& box : found.open) {
      ParameterPoint<3> middle, reach;
      for (int i = 0; i < 3; ++i) middle[i] = box[i].middle(), reach[i] = box[i].width() + 10 * options.least[i];
      const auto within = [&](const ParameterPoint<3>& at) -> ParameterPoint<3> {
        return {system.piece.clamp(at[0]), system.patch.u.clamp(at[1]), system.patch.v.clamp(at[2])};
      };
      if (!add(within(system.contact_near(middle, reach)), true))
        add(within(refined<3, 3>(middle, reach, [&](const auto& at) { return system.evaluate(at); })), true);
    }
    return true;
  }

  // False if the curve is farther from the surface there than the tolerance.
  bool add(const ParameterPoint<3>& at, bool contact) {
    const CurveJet r = curve_.evaluate(at[0], 1);
    const SurfaceJet s = surface_.evaluate(at[1], at[2], 1);
    SurfaceIntersection intersection{at[0], at[1], at[2], r.d[0], glm::length(r.d[0] - s.point())};
    if (!(intersection.distance <= tolerance_)) return false;
    const Vec3 normal = glm::cross(s.du(), s.dv());
    const double sine =
        std::abs(glm::dot(r.d[1], normal)) / std::max(glm::length(r.d[1]) * glm::length(normal), 1e-300);
    intersection.contact = contact && sine < kParallel;
    const double near = 4 * least_ * curve_.domain().width();
    if (is_within(result_.on_surface, at[0], near)) return true;
    for (const SurfaceIntersection& other : result_.points)
      if (glm::length(other.point - intersection.point) <= 4 * tolerance_ && is_one_place(curve_, other.t, at[0], near))
        return true;
    result_.points.push_back(intersection);
    return true;
  }

  const Curve& curve_;
  const Surface& surface_;
  Box3 box_, surface_box_ = Box3::everything();
  double relative_ = 0;   // the tolerance, as a part of the size
  double tolerance_ = 0;  // a length
  double rounding_ = 0;   // likewise: what it leaves between curve and surface where they meet
  double least_ = 0;      // part of a domain
  std::vector<Rectangle> patches_;
  SurfaceIntersections result_;
};

}  // namespace

CurveIntersections intersect(const Curve& a, const Curve& b, double tolerance) {
  return CurvePair(a, b, tolerance).run();
}

// Stretches of a common part whose places on a smooth part are on its right sides: cut where halving finds a change.
static void add_kept(const Interval& t, const Curve& curve, const SmoothPart& part, std::vector<Interval>& kept) {
  constexpr int kTried = 256;
  const auto keeps = [&](double at) {
    const SurfaceFootPoints found = project(curve.point(at), *part.surface);
    return !found.foot_points.empty() && is_in(part, found.foot_points[0].u, found.foot_points[0].v);
  };
  std::vector<double> cuts;
  double before = t.lo;
  for (int k = 1; k <= kTried; ++k) {
    const double now = t.lo + t.width() * k / kTried;
    double lo = before, hi = now;
    const bool first = keeps(lo);
    if (keeps(hi) != first) {
      for (double middle = 0.5 * (lo + hi); lo < middle && middle < hi; middle = 0.5 * (lo + hi))
        (keeps(middle) == first ? lo : hi) = middle;
      cuts.push_back(hi);
    }
    before = now;
  }
  each_kept(t, false, cuts, keeps, [&](const Interval& one) { kept.push_back(one); });
}

SurfaceIntersections intersect(const Curve& curve, const Surface& surface, double tolerance) {
  const SteppedParts stepped = parts_between_steps(SurfacePtr(SurfacePtr(), &surface));
  demand_known(stepped);
  if (stepped.parts.empty()) return CurveAndSurface(curve, surface, tolerance).run();
  SurfaceIntersections all;
  for (const SmoothPart& part : stepped.parts) {
    const SurfaceIntersections found = CurveAndSurface(curve, *part.surface, tolerance).run();
    std::copy_if(found.points.begin(), found.points.end(), std::back_inserter(all.points),
                 [&](const SurfaceIntersection& one) { return is_in(part, one.u, one.v); });
    for (const Interval& t : found.on_surface) add_kept(t, curve, part, all.on_surface);
  }
  const auto by_t = [](const auto& a, const auto& b) { return a.t < b.t; };
  std::sort(all.points.begin(), all.points.end(), by_t);
  std::sort(all.on_surface.begin(), all.on_surface.end(),
            [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
  return all;
}

}  // namespace lekalo::geometry
