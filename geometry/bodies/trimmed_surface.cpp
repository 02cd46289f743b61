#include "geometry/bodies/trimmed_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/bodies/construct.h"
#include "geometry/bodies/seam_path.h"
#include "geometry/curves/polyline.h"
#include "geometry/curves/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/tessellation/predicates.h"
#include "geometry/tolerances.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Sides of the polygon that stands for a smooth piece where loops are looked at for crossings and for which lies in
// which.
constexpr int kSides = 32;

std::string text_of(const Vec2& p) { return fmt::format("({:.6g}, {:.6g})", p.x, p.y); }

// A part of a curve of the parameter plane.
struct Arc {
  Arc(const Curve& curve, const Interval& t) : curve(&curve), t(t), a(curve.point(t.lo)), b(curve.point(t.hi)) {
    // A curve lies no farther from its chord than by max |r''| (t1 - t0)^2 / 8.
    const Box3 second = curve.enclose(t, 2).d[2];
    const Vec3 most = glm::max(glm::abs(second.lo), glm::abs(second.hi));
    bulge = std::hypot(most.x, most.y) * t.width() * t.width() / 8;
    if (!std::isfinite(bulge)) bulge = curve.enclose(t, 0).d[0].diameter();
  }

  const Curve* curve;
  Interval t;
  Vec2 a, b;     // its ends
  double bulge;  // it lies this near its chord
};

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 side = b - a;
  const double square = glm::dot(side, side);
  const double share = square > 0 ? std::clamp(glm::dot(p - a, side) / square, 0.0, 1.0) : 0;
  return glm::length(p - a - share * side);
}

// Whether p and q lie on different sides of a line.
bool parts(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  const double at_p = orient2d(a, b, p), at_q = orient2d(a, b, q);
  return (at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0);
}

// True if the arcs certainly cross. Those that only touch do not, nor those that part again within `touch`; `depth`
// halvings of both tell nearly all others. Arcs cross if their chords do, and no end of one comes as near to the chord
// of the other as that one's arc.
bool cross(const Arc& s, const Arc& r, double touch, int depth) {
  const double of_s = distance(s.a, r.a, r.b), of_s_end = distance(s.b, r.a, r.b), of_r = distance(r.a, s.a, s.b),
               of_r_end = distance(r.b, s.a, s.b);
  const bool chords_cross = parts(s.a, s.b, r.a, r.b) && parts(r.a, r.b, s.a, s.b);
  if (!chords_cross && std::min(std::min(of_s, of_s_end), std::min(of_r, of_r_end)) > s.bulge + r.bulge) return false;
  if (chords_cross && std::min(of_s, of_s_end) > r.bulge + touch && std::min(of_r, of_r_end) > s.bulge + touch)
    return true;
  if (depth == 0 || s.bulge + r.bulge == 0) return false;
  const auto halves = [](const Arc& arc) {
    const double middle = arc.t.middle();
    return std::array{Arc(*arc.curve, {arc.t.lo, middle}), Arc(*arc.curve, {middle, arc.t.hi})};
  };
  const auto of_r_halves = halves(r);
  for (const Arc& first : halves(s))
    for (const Arc& second : of_r_halves)
      if (cross(first, second, touch, depth - 1)) return true;
  return false;
}

struct Loop2 {
  std::vector<Body::Use> uses;  // edges are numbers of curves
  std::vector<Vec2> polygon;    // closed: the last goes on with the first
  std::vector<Arc> arcs;        // that the sides of the polygon stand for
  Box3 box;                     // of the polygon
  double area = 0;              // positive where it runs counterclockwise
  int depth = 0;                // loops around it
  int around = -1;              // the innermost of them
  // Of the border: opposite sides are one seam where the surface is closed.
  bool closed_u = false, closed_v = false;
};

class Trimming {
 public:
  Trimming(const SurfacePtr& surface, const std::vector<Curve2Ptr>& curves, bool outside)
      : surface_(surface), curves_(curves), given_(curves.size()) {
    for (const Curve2Ptr& curve : curves_) size_ = std::max(size_, bounds(*curve).diameter());
    for (size_t k = 0; k < curves_.size(); ++k) check_place(k);
    chain();
    if (outside) add_border();
    for (Loop2& loop : loops_) outline(loop);
    check_crossings();
    check_areas();
    nest();
  }

  Body body() const;

 private:
  std::string name(size_t curve) const {
    return curve < given_ ? fmt::format("curve {}", curve) : "the surface's border";
  }
  Vec2 begin(size_t k) const { return Vec2(curves_[k]->point(curves_[k]->domain().lo)); }
  Vec2 end(size_t k) const { return Vec2(curves_[k]->point(curves_[k]->domain().hi)); }
  bool coincide(const Vec2& a, const Vec2& b) const { return glm::length(a - b) <= kClosedCurve * size_; }

  // The border of the domain as one more loop. Where the surface is closed it is cut open between the loops, and these
  // are moved by whole periods to lie between the seam and its copy.
  void add_border() {
    if (!surface_->bounded())
      throw TrimError("the surface is unbounded: it has no border for its outside to end at",
                      "keep the inside, or give the surface a domain");
    Rectangle d = surface_->domain();
    const Periods periods = surface_->periods();
    const auto is_closed = [](const Interval& range, double period) {
      return period > 0 && range.width() >= period * (1 - kDomainSlack);
    };
    const bool closed_u = is_closed(d.u, periods.u), closed_v = is_closed(d.v, periods.v);
    const bool straight_u = !closed_u || cut_straight(0, periods.u, d.u),
               straight_v = !closed_v || cut_straight(1, periods.v, d.v);
    // Below, to the right, above and to the left, each from the lower to the higher parameter.
    const Vec2 a(d.u.lo, d.v.lo), b(d.u.hi, d.v.lo), c(d.u.hi, d.v.hi), e(d.u.lo, d.v.hi);
    std::array<std::vector<Vec2>, 4> sides{{{a, b}, {b, c}, {e, c}, {a, e}}};
    if (!straight_u && straight_v) {
      const std::vector<Vec2> seam = cut_along_path(0, {periods.u, d.v, closed_v});
      const Vec2 turn(periods.u, 0);
      sides = {{{seam.front(), seam.front() + turn}, moved(seam, turn), {seam.back(), seam.back() + turn}, seam}};
    } else if (!straight_v) {
      if (!straight_u) throw no_gap();
      const std::vector<Vec2> seam = cut_along_path(1, {periods.v, d.u, closed_u});
      const Vec2 turn(0, periods.v);
      sides = {{seam, {seam.back(), seam.back() + turn}, moved(seam, turn), {seam.front(), seam.front() + turn}}};
    }
    Loop2& border = loops_.emplace_back();
    border.closed_u = closed_u, border.closed_v = closed_v;
    for (int k = 0; k < 4; ++k) {
      // A seam has one direction for both of its sides.
      const bool backward = (k == 2 && closed_v) || (k == 3 && closed_u);
      if (k >= 2 && !backward) std::reverse(sides[k].begin(), sides[k].end());
      curves_.push_back(chain_of_lines(sides[k]));
      border.uses.push_back({static_cast<int>(curves_.size()) - 1, !backward, curves_.back()});
    }
  }

  static TrimError no_gap() {
    return {"the loops leave no gap where the closed surface could be cut open for its outside",
            "keep the inside, with a loop for the outer border"};
  }

  static std::vector<Vec2> moved(std::vector<Vec2> points, const Vec2& by) {
    for (Vec2& p : points) p += by;
    return points;
  }

  static Curve2Ptr chain_of_lines(const std::vector<Vec2>& points) {
    if (points.size() == 2) return image_line({0, 1}, points[0], points[1]);
    std::vector<Vec3> in_space;
    for (const Vec2& p : points) in_space.emplace_back(p, 0);
    return std::make_shared<NurbsCurve>(polyline(in_space));
  }

  void move(Loop2& loop, int axis, double by) {
    if (by == 0) return;
    Vec3 offset(0);
    offset[axis] = by;
    for (Body::Use& use : loop.uses)
      curves_[use.edge] = use.image = transformed(use.image, Affine::translation(offset));
  }

  // Straight beside all loops, if there is such a line.
  bool cut_straight(int axis, double period, Interval& range) {
    const auto box_of = [](const Loop2& loop) {
      Box3 box;
      for (const Body::Use& use : loop.uses) box.include(bounds(*use.image));
      return box;
    };
    // From the start of the range on, what the loops cover.
    std::vector<Interval> covered;
    for (const Loop2& loop : loops_) {
      const Box3 box = box_of(loop);
      const double lo = box.lo[axis] - period * std::floor((box.lo[axis] - range.lo) / period);
      covered.push_back({lo, lo + box.hi[axis] - box.lo[axis]});
    }
    std::sort(covered.begin(), covered.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
    // The start itself if nothing lies across it, else the middle of the widest gap.
    double end = range.lo, at = range.lo, widest = 0;
    for (const Interval& one : covered) end = std::max(end, one.hi - period);
    if (end > range.lo) {
      for (const Interval& one : covered) {
        if (one.lo - end > widest) {
          widest = one.lo - end;
          at = 0.5 * (one.lo + end);
        }
        end = std::max(end, one.hi);
      }
      if (!(widest > 0)) return false;
    }
    range = {at, at + period};
    // The boxes are a little wide.
    for (Loop2& loop : loops_) move(loop, axis, -period * std::floor((box_of(loop).lo[axis] - at) / period + 1e-9));
    return true;
  }

  // Along a chain of lines between the loops. The band has the axis that is cut for its x.
  std::vector<Vec2> cut_along_path(int axis, const ClosedBand& band) {
    const auto across = [&](const Vec2& p) { return axis == 0 ? p : Vec2(p.y, p.x); };
    std::vector<std::vector<LoopSide>> loops;
    for (Loop2& loop : loops_) {
      outline(loop);
      auto& sides = loops.emplace_back();
      for (size_t i = 0; i < loop.polygon.size(); ++i)
        sides.push_back(
            {across(loop.polygon[i]), across(loop.polygon[(i + 1) % loop.polygon.size()]), loop.arcs[i].bulge});
    }
    std::vector<Vec2> seam = seam_path(loops, band);
    if (seam.empty()) throw no_gap();
    for (size_t k = 0; k < loops.size(); ++k) {
      // The steepest side stands for the loop: its middle is at no end of the seam.
      const LoopSide& side = *std::max_element(loops[k].begin(), loops[k].end(), [](const auto& s, const auto& r) {
        return std::abs(s.b.y - s.a.y) < std::abs(r.b.y - r.a.y);
      });
      move(loops_[k], axis, -band.period * periods_from_seam(0.5 * (side.a + side.b), seam, band.period));
    }
    for (Vec2& p : seam) p = across(p);
    return seam;
  }

  void check_place(size_t k) const {
    const Curve& curve = *curves_[k];
    const Box3 box = bounds(curve);
    if (!box.bounded()) throw TrimError(name(k) + " is unbounded", "give it a domain");
    if (std::max(std::abs(box.lo.z), std::abs(box.hi.z)) > 1e-12 * box.diameter())
      throw TrimError(name(k) + " does not lie in the parameter plane", "its points are (u, v): z must be 0");
    const Rectangle domain = surface_->domain();
    const Periods periods = surface_->periods();
    check_range(curve, k, 0, domain.u, periods.u, "u");
    check_range(curve, k, 1, domain.v, periods.v, "v");
  }

  void check_range(const Curve& curve, size_t k, int axis, const Interval& domain, double period,
                   const char* name_of_axis) const {
    if (period > 0) {
      const Box3 box = bounds(curve);
      if (box.hi[axis] - box.lo[axis] > period * (1 + 1e-9))
        throw TrimError(fmt::format("{} is wider in {} than the period {:.9g}", name(k), name_of_axis, period),
                        "a loop may stand anywhere in a periodic direction, but must not overlap itself");
      return;
    }
    const double slack = kDomainSlack * (domain.width() < kInfinity ? domain.width() : 0) + 1e-15 * std::abs(domain.lo);
    const auto check = [&](auto&& self, const Interval& t, int depth) -> void {
      const Box3 box = curve.enclose(t, 0).d[0];
      if (box.lo[axis] >= domain.lo - slack && box.hi[axis] <= domain.hi + slack) return;
      const Vec3 middle = curve.point(t.middle());
      if (middle[axis] < domain.lo - slack || middle[axis] > domain.hi + slack)
        throw TrimError(fmt::format("{} leaves the domain of the surface at {}", name(k), text_of(Vec2(middle))),
                        fmt::format("{} goes from {:.9g} to {:.9g}", name_of_axis, domain.lo, domain.hi));
      if (depth == 0) return;
      self(self, {t.lo, t.middle()}, depth - 1);
      self(self, {t.middle(), t.hi}, depth - 1);
    };
    constexpr int kDeepest = 12;
    for (const CurvePiece& piece : curve.pieces()) check(check, piece.domain, kDeepest);
  }

  // Once round a closed surface a curve ends where it began, but not in the parameter plane.
  void check_turns(size_t first, const Vec2& from, const Vec2& to) const {
    const auto without_turns = [](double x, double period) { return period > 0 ? std::remainder(x, period) : x; };
    const Periods periods = surface_->periods();
    const Vec2 off(without_turns(to.x - from.x, periods.u), without_turns(to.y - from.y, periods.v));
    if (coincide(off, Vec2(0)))
      throw TrimError(fmt::format("the loop that begins with {} goes all round the closed surface, from {} to {}: it "
                                  "encloses nothing in the parameter plane",
                                  name(first), text_of(from), text_of(to)),
                      "give the surface a domain that ends there, or let the loop go on to the border of the domain, "
                      "along that and back");
  }

  void chain() {
    for (size_t k = 0; k < curves_.size();) {
      Loop2& loop = loops_.emplace_back();
      const size_t first = k;
      loop.uses.push_back({static_cast<int>(k), true, curves_[k]});
      Vec2 start = begin(k), at = end(k);
      ++k;
      while (!coincide(start, at)) {
        if (k == curves_.size()) {
          check_turns(first, start, at);
          throw TrimError(fmt::format("the loop that begins with {} is open: it ends at {} and began at {}",
                                      name(first), text_of(at), text_of(start)),
                          "close it, or let the next curve begin where it ends");
        }
        bool forward = coincide(begin(k), at);
        const bool backward = coincide(end(k), at);
        if (!forward && !backward && k == first + 1) {
          // The first may have to run backwards.
          std::swap(start, at);
          loop.uses[0].forward = false;
          forward = coincide(begin(k), at);
          if (!forward && !coincide(end(k), at)) std::swap(start, at);
        }
        if (!forward && !coincide(end(k), at)) {
          check_turns(first, start, at);
          throw TrimError(fmt::format("the loop that begins with {} is open: {} does not go on at {}", name(first),
                                      name(k), text_of(at)),
                          "close it, or let the next curve begin where it ends");
        }
        loop.uses.push_back({static_cast<int>(k), forward, curves_[k]});
        at = forward ? end(k) : begin(k);
        ++k;
      }
    }
  }

  void outline(Loop2& loop) const {
    loop.polygon.clear(), loop.arcs.clear();
    loop.box = {}, loop.area = 0;
    for (const Body::Use& use : loop.uses) {
      std::vector<Arc> arcs;
      for (const CurvePiece& piece : use.image->pieces()) {
        const int sides = piece.is_rational() && piece.degree() == 1 ? 1 : kSides;
        const auto at = [&](int i) {
          return i == sides ? piece.domain.hi : piece.domain.lo + piece.domain.width() * i / sides;
        };
        for (int i = 0; i < sides; ++i) arcs.emplace_back(*use.image, Interval{at(i), at(i + 1)});
      }
      if (!use.forward) std::reverse(arcs.begin(), arcs.end());
      for (const Arc& arc : arcs) {
        loop.polygon.push_back(use.forward ? arc.a : arc.b);
        loop.arcs.push_back(arc);
      }
    }
    for (const Vec2& p : loop.polygon) loop.box.include(Vec3(p, 0));
    const Vec2 o = loop.polygon[0];
    for (size_t i = 0; i < loop.polygon.size(); ++i) {
      const Vec2 a = loop.polygon[i] - o, b = loop.polygon[(i + 1) % loop.polygon.size()] - o;
      loop.area += 0.5 * (a.x * b.y - a.y * b.x);
    }
  }

  // Arcs in the order of u; those that overlap in u are compared.
  void check_crossings() const {
    struct Side {
      const Arc* arc;
      size_t loop, number;
      Box3 box;
    };
    std::vector<Side> sides;
    for (size_t k = 0; k < loops_.size(); ++k)
      for (size_t i = 0; i < loops_[k].arcs.size(); ++i) {
        const Arc& arc = loops_[k].arcs[i];
        Box3 box;
        box.include(Vec3(arc.a, 0));
        box.include(Vec3(arc.b, 0));
        sides.push_back({&arc, k, i, box.inflated(arc.bulge)});
      }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.box.lo.x < b.box.lo.x; });
    constexpr int kHalvings = 8;  // to arcs of a thousandth of a circle
    const double touch = kClosedCurve * size_;
    for (size_t i = 0; i < sides.size(); ++i) {
      const Side& s = sides[i];
      for (size_t j = i + 1; j < sides.size() && sides[j].box.lo.x <= s.box.hi.x; ++j) {
        const Side& r = sides[j];
        if (r.box.lo.y > s.box.hi.y || r.box.hi.y < s.box.lo.y) continue;
        // Neighbours touch where one goes on with the other: no halving would part them.
        const size_t apart = s.number > r.number ? s.number - r.number : r.number - s.number;
        if (s.loop == r.loop && (apart == 1 || apart + 1 == loops_[s.loop].arcs.size())) continue;
        if (!cross(*s.arc, *r.arc, touch, kHalvings)) continue;
        const std::string place = text_of(0.25 * (s.arc->a + s.arc->b + r.arc->a + r.arc->b));
        const auto loop_name = [&](const Side& side) { return name(loops_[side.loop].uses[0].edge); };
        if (s.loop == r.loop)
          throw TrimError(fmt::format("the loop that begins with {} crosses itself near {}", loop_name(s), place), "");
        const bool in_order = s.loop < r.loop;
        throw TrimError(fmt::format("the loops that begin with {} and {} cross near {}", loop_name(in_order ? s : r),
                                    loop_name(in_order ? r : s), place),
                        "loops lie inside or beside each other");
      }
    }
  }

  static bool is_in(const Vec2& p, const std::vector<Vec2>& polygon) {
    bool inside = false;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.y <= p.y) == (b.y <= p.y)) continue;
      if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) inside = !inside;
    }
    return inside;
  }

  void check_areas() const {
    for (const Loop2& loop : loops_)
      if (!(std::abs(loop.area) > 1e-14 * size_ * size_))
        throw TrimError(fmt::format("the loop that begins with {} encloses nothing", name(loop.uses[0].edge)), "");
  }

  // As far as it matters: at most `most`.
  static double distance_of(const Vec2& p, const std::vector<Vec2>& polygon, double most) {
    double least = most;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if (std::max(std::min(a.y, b.y) - p.y, p.y - std::max(a.y, b.y)) < least)
        least = std::min(least, distance(p, a, b));
    }
    return least;
  }

  // Loops may touch, also along sides: of the corners and middles of sides of one that do not lie on the other's border
  // most decide. Those on different sides of it, farther from it than chords are from arcs, tell of loops that cross
  // where they touch, in a corner or along sides: check_crossings() has found all others. Loops without any are the
  // same.
  bool lies_in(const Loop2& inner, const Loop2& outer) const {
    const double diameter = inner.box.diameter(), on_border = 1e-9 * diameter, clear = 1e-2 * diameter;
    size_t inside = 0, outside = 0;
    bool clearly_inside = false, clearly_outside = false;
    for (size_t i = 0; i < inner.polygon.size(); ++i) {
      const Vec2 &a = inner.polygon[i], &b = inner.polygon[(i + 1) % inner.polygon.size()];
      for (const Vec2& p : {a, 0.5 * (a + b)}) {
        const double off = distance_of(p, outer.polygon, 2 * clear);
        if (off <= on_border) continue;
        const bool in = is_in(p, outer.polygon);
        ++(in ? inside : outside);
        if (off > clear) (in ? clearly_inside : clearly_outside) = true;
      }
    }
    const auto names = [&] {
      const int a = inner.uses[0].edge, b = outer.uses[0].edge;
      return fmt::format("the loops that begin with {} and {}", name(std::min(a, b)), name(std::max(a, b)));
    };
    if (inside + outside == 0) throw TrimError(names() + " are the same", "a loop is given once");
    if (clearly_inside && clearly_outside)
      throw TrimError(names() + " cross where they touch", "loops lie inside or beside each other");
    return inside > outside;
  }

  void nest() {
    for (size_t k = 0; k < loops_.size(); ++k)
      for (size_t j = 0; j < loops_.size(); ++j) {
        const Loop2 &inner = loops_[k], &outer = loops_[j];
        if (j == k || Box3{glm::max(inner.box.lo, outer.box.lo), glm::min(inner.box.hi, outer.box.hi)}.empty())
          continue;
        const double of_inner = std::abs(inner.area), of_outer = std::abs(outer.area);
        if (of_inner > of_outer || (of_inner == of_outer && k < j) || !lies_in(inner, outer)) continue;
        ++loops_[k].depth;
        int& around = loops_[k].around;
        if (around < 0 || of_outer < std::abs(loops_[around].area)) around = static_cast<int>(j);
      }
  }

  SurfacePtr surface_;
  std::vector<Curve2Ptr> curves_;
  size_t given_;  // of them; then those of the surface's own border
  double size_ = 0;
  std::vector<Loop2> loops_;
};

Body Trimming::body() const {
  Body result;
  std::vector<int> edge_of(curves_.size());
  const Box3 box = bounds(*surface_);
  const double length = box.bounded() ? box.diameter() : 0;
  const auto add_edges = [&](const Loop2& loop) {
    const auto place = [&](const Body::Use& use) {
      const Interval t = use.image->domain();
      return Vec2(use.image->point(use.forward ? t.lo : t.hi));
    };
    // Along a pole the surface stays at one point.
    std::vector<char> is_pole;
    std::vector<int> vertices;
    // Corners of the border that a seam makes one.
    const auto same_corner = [&](size_t k) -> size_t {
      constexpr size_t kAcrossU[] = {0, 0, 2, 2}, kAcrossV[] = {0, 1, 1, 0};
      if (loop.closed_u) k = kAcrossU[k];
      return loop.closed_v ? kAcrossV[k] : k;
    };
    for (const Body::Use& use : loop.uses) {
      const Vec2 p = place(use);
      const Vec3 at = surface_->point(p.x, p.y);
      const bool after_pole = !is_pole.empty() && is_pole.back() != 0;
      const size_t corner = same_corner(vertices.size());
      vertices.push_back(corner < vertices.size() ? vertices[corner]
                         : after_pole             ? vertices.back()
                                                  : result.add_vertex(at));
      bool pole = true;
      for (const double part : {0.13, 0.31, 0.5, 0.69, 0.87, 1.0}) {
        const Interval t = use.image->domain();
        const Vec3 q = use.image->point(t.lo + part * t.width());
        pole = pole && glm::length(surface_->point(q.x, q.y) - at) <= kCollapsedEdge * length;
      }
      is_pole.push_back(pole);
    }
    if (is_pole.back()) vertices.back() = vertices.front();
    for (size_t i = 0; i < loop.uses.size(); ++i) {
      const Body::Use& use = loop.uses[i];
      const bool is_seam = i % 2 == 0 ? loop.closed_v : loop.closed_u;
      if (is_seam && i >= 2) {
        edge_of[use.edge] = edge_of[loop.uses[i - 2].edge];
        continue;
      }
      const int from = vertices[i], to = vertices[(i + 1) % vertices.size()];
      const Origin origin{"", "edge", use.edge};
      edge_of[use.edge] =
          is_pole[i] ? result.add_edge(point_curve(use.image->domain(), result.vertices[from].point), from, from,
                                       origin, EdgeKind::pole)
                     : result.add_edge(std::make_shared<SurfaceCurve>(surface_, use.image), use.forward ? from : to,
                                       use.forward ? to : from, origin, is_seam ? EdgeKind::seam : EdgeKind::regular);
    }
  };
  for (const Loop2& loop : loops_) add_edges(loop);
  const auto add_loop = [&](int face, const Loop2& loop, bool counterclockwise) {
    std::vector<Body::Use> uses = loop.uses;
    if ((loop.area > 0) != counterclockwise) {
      std::reverse(uses.begin(), uses.end());
      for (Body::Use& use : uses) use.forward = !use.forward;
    }
    for (Body::Use& use : uses) use.edge = edge_of[use.edge];
    result.add_loop(face, uses);
  };
  // The face lies on the left of its loops, seen against its normal.
  const bool upright = surface_->normal_sign() > 0;
  for (size_t k = 0; k < loops_.size(); ++k) {
    if (loops_[k].depth % 2 != 0) continue;
    const int face = result.add_face(surface_, true, {"", "face", static_cast<int>(result.faces.size())});
    add_loop(face, loops_[k], upright);
    for (const Loop2& hole : loops_)
      if (hole.around == static_cast<int>(k) && hole.depth % 2 != 0) add_loop(face, hole, !upright);
  }
  result.close_shell(false);
  return result;
}

}  // namespace

Body trimmed_surface(const SurfacePtr& surface, const std::vector<Curve2Ptr>& curves, bool outside) {
  return Trimming(surface, curves, outside).body();
}

TypeDeclaration trimmed_surface_type() {
  return declare(Category::body, "trimmed_surface",
                 "The part of a surface inside loops of its parameter plane: an outer border, holes in it, islands in "
                 "these. Faces: face.0, face.1, ...")
      .example(
          "of: { type: cylinder_surface, radius: 1, height: 2 }, loops: [{ type: circle, center: [3, 0.5], radius: 0.4 "
          "}, "
          "{ type: circle, center: [3, 0.5], radius: 0.1 }]")
      .field("of", reference({Category::surface}), "the surface")
      .field("loops", references({Category::curve}).count(1),
             "curves of the parameter plane, x being u and y being v: closed ones, and chains of curves of which each "
             "goes on where the one before ends; in any order and sense")
      .field("keep", choice({"inside", "outside"}),
             "what to keep: inside the outermost loops, or outside of them up to the surface's own border", "inside")
      .built_by([](const Fields& f) -> BodyPtr {
        std::vector<Curve2Ptr> curves;
        for (const std::any& one : f.references("loops")) curves.push_back(std::any_cast<const CurvePtr&>(one));
        try {
          return std::make_shared<Body>(trimmed_surface(f.surface("of"), curves, f.text("keep") == "outside"));
        } catch (const TrimError& error) {
          throw FieldError("loops", error.what(), error.hint);
        }
      });
}

}  // namespace lekalo::geometry
