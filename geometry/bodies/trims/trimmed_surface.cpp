#include "geometry/bodies/trims/trimmed_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/trims/seam_path.h"
#include "geometry/bodies/trims/trim_loops.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/tolerances.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

class Trimming {
 public:
  Trimming(const SurfacePtr& surface, const std::vector<Curve2Ptr>& curves, bool outside)
      : surface_(surface), curves_(curves), given_as_(curves.size()) {
    std::iota(given_as_.begin(), given_as_.end(), 0);
    for (const Curve2Ptr& curve : curves_) size_ = std::max(size_, bounds(*curve).diameter());
    for (size_t k = 0; k < curves_.size(); ++k) check_place(k);
    chain();
    if (!join_rings(outside) && outside) add_border();
    for (TrimLoop& loop : loops_) outline(loop);
    const auto name_of = [this](size_t curve) { return name(curve); };
    check_loops(loops_, size_, name_of);
    nest(loops_, name_of);
  }

  Body body() const;

 private:
  std::string name(size_t curve) const {
    return given_as_[curve] >= 0 ? fmt::format("curve {}", given_as_[curve]) : "the surface's border";
  }
  // One more: a part of a given one, or of the border or a seam.
  Body::Use add_curve(Curve2Ptr curve, bool forward, int given_as = -1) {
    curves_.push_back(std::move(curve));
    given_as_.push_back(given_as);
    return {static_cast<int>(curves_.size()) - 1, forward, curves_.back()};
  }
  Vec2 begin(size_t k) const { return Vec2(curves_[k]->point(curves_[k]->domain().lo)); }
  Vec2 end(size_t k) const { return Vec2(curves_[k]->point(curves_[k]->domain().hi)); }
  bool coincide(const Vec2& a, const Vec2& b) const { return glm::length(a - b) <= kClosedCurve * size_; }

  // The border of the domain as one more loop. Where the surface is closed it is cut open between the loops, and these
  // are moved by whole periods to lie between the seam and its copy.
  void add_border() {
    if (!surface_->bounded()) throw no_border();
    Rectangle d = surface_->domain();
    const Periods periods = surface_->periods();
    const bool closed_u = is_closed(0), closed_v = is_closed(1);
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
    TrimLoop& border = loops_.emplace_back();
    if (closed_v) border.seams.push_back({0, 2});
    if (closed_u) border.seams.push_back({1, 3});
    for (int k = 0; k < 4; ++k) {
      // A seam has one direction for both of its sides.
      const bool backward = (k == 2 && closed_v) || (k == 3 && closed_u);
      if (k >= 2 && !backward) std::reverse(sides[k].begin(), sides[k].end());
      border.uses.push_back(add_curve(chain_of_lines(sides[k]), !backward));
    }
  }

  static TrimError no_border() {
    return {"the surface is unbounded: it has no border for its outside to end at",
            "keep the inside, or give the surface a domain"};
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

  void move(TrimLoop& loop, int axis, double by) {
    if (by == 0) return;
    Vec3 offset(0);
    offset[axis] = by;
    for (Body::Use& use : loop.uses)
      curves_[use.edge] = use.image = transformed(use.image, Affine::translation(offset));
  }

  // Straight beside all loops, if there is such a line.
  bool cut_straight(int axis, double period, Interval& range) {
    const std::optional<double> at = straight_cut(loops_, axis, period, range.lo);
    if (!at) return false;
    range = {*at, *at + period};
    // The boxes are a little wide.
    for (TrimLoop& loop : loops_) move(loop, axis, -period * std::floor((box_of(loop).lo[axis] - *at) / period + 1e-9));
    return true;
  }

  // A parameter at which no loop lies: the start if nothing lies across it, else the middle of the widest gap.
  static std::optional<double> straight_cut(const std::vector<TrimLoop>& loops, int axis, double period, double start) {
    // From the start on, what the loops cover.
    std::vector<Interval> covered;
    for (const TrimLoop& loop : loops) {
      const Box3 box = box_of(loop);
      const double lo = box.lo[axis] - period * std::floor((box.lo[axis] - start) / period);
      covered.push_back({lo, lo + box.hi[axis] - box.lo[axis]});
    }
    std::sort(covered.begin(), covered.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
    double end = start, at = start, widest = 0;
    for (const Interval& one : covered) end = std::max(end, one.hi - period);
    if (!(end > start)) return start;
    for (const Interval& one : covered) {
      if (one.lo - end > widest) {
        widest = one.lo - end;
        at = 0.5 * (one.lo + end);
      }
      end = std::max(end, one.hi);
    }
    return widest > 0 ? std::optional(at) : std::nullopt;
  }

  // Along a chain of lines between the loops. The band has the axis that is cut for its x.
  std::vector<Vec2> cut_along_path(int axis, const ClosedBand& band) {
    const auto across = [&](const Vec2& p) { return axis == 0 ? p : Vec2(p.y, p.x); };
    std::vector<std::vector<LoopSide>> loops;
    for (TrimLoop& loop : loops_) {
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

  // --- Rings: two that follow each other across the surface bound a band, which a seam makes a loop.

  bool is_closed(int axis) const {
    const Periods periods = surface_->periods();
    const double period = axis == 0 ? periods.u : periods.v;
    const Rectangle domain = surface_->domain();
    return period > 0 && (axis == 0 ? domain.u : domain.v).width() >= period * (1 - kDomainSlack);
  }
  double period(int axis) const { return axis == 0 ? surface_->periods().u : surface_->periods().v; }

  static void turn_round(std::vector<Body::Use>& uses) {
    std::reverse(uses.begin(), uses.end());
    for (Body::Use& use : uses) use.forward = !use.forward;
  }

  // Whether a chain from one place to another goes once round.
  bool make_ring(TrimLoop& loop, const Vec2& from, const Vec2& to) const {
    for (const int axis : {0, 1}) {
      Vec2 turn(0);
      turn[axis] = period(axis);
      if (turn[axis] == 0 || !(coincide(to, from + turn) || coincide(to, from - turn))) continue;
      loop.winds = axis;
      if (to[axis] < from[axis]) turn_round(loop.uses);
      return true;
    }
    return false;
  }

  static Vec2 start_of(const TrimLoop& loop) {
    const Body::Use& first = loop.uses.front();
    const Interval t = first.image->domain();
    return Vec2(first.image->point(first.forward ? t.lo : t.hi));
  }

  // Of the other parameter, over the ring: rings that do not cross have the order of these.
  double mean_of(const TrimLoop& ring) const {
    double sum = 0;
    for (const Body::Use& use : ring.uses) {
      const Interval t = use.image->domain();
      constexpr int kParts = 256;
      for (int i = 0; i < kParts; ++i) {
        const Vec2 a(use.image->point(t.lo + t.width() * i / kParts)),
            b(use.image->point(t.lo + t.width() * (i + 1) / kParts));
        const double way = b[ring.winds] - a[ring.winds];
        sum += 0.5 * (use.forward ? way : -way) * (a[1 - ring.winds] + b[1 - ring.winds]);
      }
    }
    return sum / period(ring.winds);
  }

  // A border of the domain as a ring.
  TrimLoop ring_at(int axis, double other) {
    Vec2 a(0);
    a[axis] = axis == 0 ? surface_->domain().u.lo : surface_->domain().v.lo;
    a[1 - axis] = other;
    Vec2 b = a;
    b[axis] += period(axis);
    TrimLoop ring;
    ring.winds = axis;
    ring.uses.push_back(add_curve(image_line({0, 1}, a, b), true));
    return ring;
  }

  // False if there are none.
  bool join_rings(bool outside) {
    std::vector<TrimLoop> rings;
    const auto is_ring = [](const TrimLoop& loop) { return loop.winds >= 0; };
    std::copy_if(loops_.begin(), loops_.end(), std::back_inserter(rings), is_ring);
    if (rings.empty()) return false;
    loops_.erase(std::remove_if(loops_.begin(), loops_.end(), is_ring), loops_.end());
    const int axis = rings[0].winds;
    const std::string first = name(rings[0].uses[0].edge);
    for (const TrimLoop& ring : rings)
      if (ring.winds != axis)
        throw TrimError(fmt::format("the loops that begin with {} and {} go round the closed surface both ways", first,
                                    name(ring.uses[0].edge)),
                        "they cross");
    const auto sort = [&] {
      std::sort(rings.begin(), rings.end(),
                [&](const TrimLoop& a, const TrimLoop& b) { return mean_of(a) < mean_of(b); });
    };
    if (outside && is_closed(1 - axis)) {
      sort();
      move(rings[0], 1 - axis, period(1 - axis));
    } else if (outside) {
      const Interval range = axis == 0 ? surface_->domain().v : surface_->domain().u;
      if (!(range.width() < kInfinity)) throw no_border();
      for (const double end : {range.lo, range.hi}) {
        // A ring that runs there leaves nothing beyond.
        const auto there = std::find_if(rings.begin(), rings.end(), [&](const TrimLoop& ring) {
          return std::abs(mean_of(ring) - end) <= 1e-9 * range.width();
        });
        if (there != rings.end())
          rings.erase(there);
        else
          rings.push_back(ring_at(axis, end));
      }
      if (rings.empty()) throw TrimError("the loops leave nothing of the surface", "keep their inside");
    }
    sort();
    if (rings.size() % 2 != 0)
      throw TrimError(
          fmt::format("the loop that begins with {} goes all round the closed surface: alone it encloses nothing",
                      first),
          "two that go round have a band between them: give another one, a segment along the border of the domain if "
          "all is meant up to there");
    for (TrimLoop& loop : loops_) outline(loop);
    std::vector<TrimLoop> bands;
    for (size_t k = 0; k < rings.size(); k += 2) bands.push_back(band(rings[k], rings[k + 1]));
    loops_.insert(loops_.end(), bands.begin(), bands.end());
    return true;
  }

  // Makes a ring begin where its parameter is `at`, but for whole periods.
  void begin_at(TrimLoop& ring, double at) {
    const int axis = ring.winds;
    const double whole = period(axis);
    at += whole * std::ceil((start_of(ring)[axis] - at) / whole - 1e-12);
    const auto place = [&](const Body::Use& use, double t) { return use.image->point(t)[axis]; };
    for (size_t k = 0; k < ring.uses.size(); ++k) {
      const Body::Use use = ring.uses[k];
      const Interval t = use.image->domain();
      const double first = place(use, use.forward ? t.lo : t.hi), last = place(use, use.forward ? t.hi : t.lo);
      if (std::abs(first - at) > 1e-12 * whole && !(first < at && at < last)) continue;
      std::vector<Body::Use> begun(ring.uses.begin() + static_cast<std::ptrdiff_t>(k), ring.uses.end()),
          left(ring.uses.begin(), ring.uses.begin() + static_cast<std::ptrdiff_t>(k));
      if (first < at && at - first > 1e-12 * whole) {
        double before = use.forward ? t.lo : t.hi, behind = use.forward ? t.hi : t.lo;
        while (true) {
          const double middle = 0.5 * (before + behind);
          if (middle == before || middle == behind) break;
          (place(use, middle) < at ? before : behind) = middle;
        }
        const auto part = [&](double a, double b) {
          return add_curve(std::make_shared<CurvePart>(use.image, Interval(std::min(a, b), std::max(a, b))),
                           use.forward, given_as_[static_cast<size_t>(use.edge)]);
        };
        begun[0] = part(behind, use.forward ? t.hi : t.lo);
        left.push_back(part(use.forward ? t.lo : t.hi, behind));
      }
      ring.uses = std::move(begun);
      TrimLoop rest;
      rest.uses = std::move(left);
      move(rest, axis, whole);
      ring.uses.insert(ring.uses.end(), rest.uses.begin(), rest.uses.end());
      return;
    }
  }

  // Cut open across. Loops that lie in it are moved by whole periods to lie between the seam and its copy.
  TrimLoop band(TrimLoop lower, TrimLoop upper) {
    const int axis = lower.winds;
    const double whole = period(axis);
    const Interval across{box_of(lower).lo[1 - axis], box_of(upper).hi[1 - axis]};
    std::vector<TrimLoop> near;
    std::copy_if(loops_.begin(), loops_.end(), std::back_inserter(near), [&](const TrimLoop& loop) {
      return loop.box.hi[1 - axis] >= across.lo && loop.box.lo[1 - axis] <= across.hi;
    });
    const std::optional<double> cut = straight_cut(near, axis, whole, start_of(lower)[axis]);
    if (!cut)
      throw TrimError(fmt::format("no straight line leads between the other loops from the one that begins with {} to "
                                  "the one that begins with {}",
                                  name(lower.uses[0].edge), name(upper.uses[0].edge)),
                      "take fewer loops between them");
    begin_at(lower, *cut);
    begin_at(upper, *cut);
    const Vec2 p = start_of(lower);
    move(upper, axis, whole * std::round((p - start_of(upper))[axis] / whole));
    const Vec2 q = start_of(upper);
    Vec2 turn(0);
    turn[axis] = whole;
    TrimLoop result;
    result.uses = lower.uses;
    result.uses.push_back(add_curve(image_line({0, 1}, p + turn, q + turn), true));
    turn_round(upper.uses);
    result.uses.insert(result.uses.end(), upper.uses.begin(), upper.uses.end());
    result.uses.push_back(add_curve(image_line({0, 1}, p, q), false));
    result.seams.push_back({lower.uses.size(), result.uses.size() - 1});
    outline(result);
    for (TrimLoop& loop : loops_) {
      const double by = -whole * std::floor((loop.box.lo[axis] - p[axis]) / whole + 1e-9);
      Vec2 at = loop.polygon[0];
      at[axis] += by;
      if (by == 0 || !is_in(at, result.polygon)) continue;
      move(loop, axis, by);
      outline(loop);
    }
    return result;
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

  void chain() {
    for (size_t k = 0; k < curves_.size();) {
      TrimLoop& loop = loops_.emplace_back();
      const size_t first = k;
      loop.uses.push_back({static_cast<int>(k), true, curves_[k]});
      Vec2 start = begin(k), at = end(k);
      ++k;
      while (!coincide(start, at)) {
        const auto meets = [&](const Vec2& p) {
          return k < curves_.size() && (coincide(begin(k), p) || coincide(end(k), p));
        };
        if (!meets(at) && k == first + 1 && meets(start)) {
          std::swap(start, at);  // the first runs backwards
          loop.uses[0].forward = false;
        }
        if (!meets(at)) {
          if (make_ring(loop, start, at)) break;
          if (k == curves_.size())
            throw TrimError(fmt::format("the loop that begins with {} is open: it ends at {} and began at {}",
                                        name(first), text_of(at), text_of(start)),
                            "close it, or let the next curve begin where it ends");
          throw TrimError(fmt::format("the loop that begins with {} is open: {} does not go on at {}", name(first),
                                      name(k), text_of(at)),
                          "close it, or let the next curve begin where it ends");
        }
        const bool forward = coincide(begin(k), at);
        loop.uses.push_back({static_cast<int>(k), forward, curves_[k]});
        at = forward ? end(k) : begin(k);
        ++k;
      }
    }
  }

  SurfacePtr surface_;
  std::vector<Curve2Ptr> curves_;
  std::vector<int> given_as_;  // which of the given ones each of them is or is a part of; -1: none
  double size_ = 0;
  std::vector<TrimLoop> loops_;
};

Body Trimming::body() const {
  Body result;
  std::vector<int> edge_of(curves_.size());
  const Box3 box = bounds(*surface_);
  const double length = box.bounded() ? box.diameter() : 0;
  const auto add_edges = [&](const TrimLoop& loop) {
    const auto place = [&](const Body::Use& use) {
      const Interval t = use.image->domain();
      return Vec2(use.image->point(use.forward ? t.lo : t.hi));
    };
    // Along a pole the surface stays at one point.
    std::vector<char> is_pole;
    std::vector<int> vertices;
    // Corners that seams make one, by the first of them: one side of a seam runs back beside the other.
    const size_t count = loop.uses.size();
    std::vector<size_t> same_corner(count);
    std::iota(same_corner.begin(), same_corner.end(), size_t{0});
    const auto join = [&](size_t a, size_t b) {
      const size_t kept = std::min(same_corner[a], same_corner[b]), gone = std::max(same_corner[a], same_corner[b]);
      std::replace(same_corner.begin(), same_corner.end(), gone, kept);
    };
    std::vector<size_t> seam_of(count, count);  // of the second side its first one
    std::vector<char> is_seam(count, 0);
    for (const auto& [i, j] : loop.seams) {
      join(i, (j + 1) % count);
      join(i + 1, j);
      seam_of[j] = i;
      is_seam[i] = 1;
    }
    for (const Body::Use& use : loop.uses) {
      const Vec2 p = place(use);
      const Vec3 at = surface_->point(p.x, p.y);
      const bool after_pole = !is_pole.empty() && is_pole.back() != 0;
      const size_t corner = same_corner[vertices.size()];
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
      if (seam_of[i] < count) {
        edge_of[use.edge] = edge_of[loop.uses[seam_of[i]].edge];
        continue;
      }
      const int from = vertices[i], to = vertices[(i + 1) % vertices.size()];
      const Origin origin{"", "edge", use.edge};
      edge_of[use.edge] = is_pole[i] ? result.add_edge(point_curve(use.image->domain(), result.vertices[from].point),
                                                       from, from, origin, EdgeKind::pole)
                                     : result.add_edge(std::make_shared<SurfaceCurve>(surface_, use.image),
                                                       use.forward ? from : to, use.forward ? to : from, origin,
                                                       is_seam[i] ? EdgeKind::seam : EdgeKind::regular);
    }
  };
  for (const TrimLoop& loop : loops_) add_edges(loop);
  const auto add_loop = [&](int face, const TrimLoop& loop, bool counterclockwise) {
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
    for (const TrimLoop& hole : loops_)
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
      .field(
          "loops", references({Category::curve}).count(1),
          "curves of the parameter plane, x being u and y being v: closed ones, and chains of curves of which each "
          "goes on where the one before ends; in any order and sense. Curves that go all round a closed surface have "
          "bands between them, the first and the second, the third and the fourth")
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
