#include "geometry/bodies/trims/trim_loops.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/trims/trimmed_surface.h"
#include "geometry/tessellation/predicates.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

Arc::Arc(const Curve& curve, const Interval& t) : curve(&curve), t(t), a(curve.point(t.lo)), b(curve.point(t.hi)) {
  // A curve lies no farther from its chord than by max |r''| (t1 - t0)^2 / 8.
  const Box3 second = curve.enclose(t, 2).d[2];
  const Vec3 most = glm::max(glm::abs(second.lo), glm::abs(second.hi));
  bulge = std::hypot(most.x, most.y) * t.width() * t.width() / 8;
  if (!std::isfinite(bulge)) bulge = curve.enclose(t, 0).d[0].diameter();
}

std::string text_of(const Vec2& p) { return fmt::format("({:.6g}, {:.6g})", p.x, p.y); }

namespace {

// Sides of the polygon that stands for a smooth piece where loops are looked at for crossings and for which lies in
// which.
constexpr int kSides = 32;

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

}  // namespace

void outline(TrimLoop& loop) {
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

Box3 box_of(const TrimLoop& loop) {
  Box3 box;
  for (const Body::Use& use : loop.uses) box.include(bounds(*use.image));
  return box;
}

bool is_in(const Vec2& p, const std::vector<Vec2>& polygon) {
  bool inside = false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) inside = !inside;
  }
  return inside;
}

namespace {

// Arcs in the order of u; those that overlap in u are compared.
void check_crossings(const std::vector<TrimLoop>& loops, double size, const NameOfCurve& name) {
  struct Side {
    const Arc* arc;
    size_t loop, number;
    Box3 box;
  };
  std::vector<Side> sides;
  for (size_t k = 0; k < loops.size(); ++k)
    for (size_t i = 0; i < loops[k].arcs.size(); ++i) {
      const Arc& arc = loops[k].arcs[i];
      Box3 box;
      box.include(Vec3(arc.a, 0));
      box.include(Vec3(arc.b, 0));
      sides.push_back({&arc, k, i, box.inflated(arc.bulge)});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.box.lo.x < b.box.lo.x; });
  constexpr int kHalvings = 8;  // to arcs of a thousandth of a circle
  const double touch = kClosedCurve * size;
  for (size_t i = 0; i < sides.size(); ++i) {
    const Side& s = sides[i];
    for (size_t j = i + 1; j < sides.size() && sides[j].box.lo.x <= s.box.hi.x; ++j) {
      const Side& r = sides[j];
      if (r.box.lo.y > s.box.hi.y || r.box.hi.y < s.box.lo.y) continue;
      // Neighbours touch where one goes on with the other: no halving would part them.
      const size_t apart = s.number > r.number ? s.number - r.number : r.number - s.number;
      if (s.loop == r.loop && (apart == 1 || apart + 1 == loops[s.loop].arcs.size())) continue;
      if (!cross(*s.arc, *r.arc, touch, kHalvings)) continue;
      const std::string place = text_of(0.25 * (s.arc->a + s.arc->b + r.arc->a + r.arc->b));
      const auto loop_name = [&](const Side& side) { return name(loops[side.loop].uses[0].edge); };
      if (s.loop == r.loop)
        throw TrimError(fmt::format("the loop that begins with {} crosses itself near {}", loop_name(s), place), "");
      const bool in_order = s.loop < r.loop;
      throw TrimError(fmt::format("the loops that begin with {} and {} cross near {}", loop_name(in_order ? s : r),
                                  loop_name(in_order ? r : s), place),
                      "loops lie inside or beside each other");
    }
  }
}

void check_areas(const std::vector<TrimLoop>& loops, double size, const NameOfCurve& name) {
  for (const TrimLoop& loop : loops)
    if (!(std::abs(loop.area) > 1e-14 * size * size))
      throw TrimError(fmt::format("the loop that begins with {} encloses nothing", name(loop.uses[0].edge)), "");
}

// As far as it matters: at most `most`.
double distance_of(const Vec2& p, const std::vector<Vec2>& polygon, double most) {
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
bool lies_in(const TrimLoop& inner, const TrimLoop& outer, const NameOfCurve& name) {
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

}  // namespace

void check_loops(const std::vector<TrimLoop>& loops, double size, const NameOfCurve& name) {
  check_crossings(loops, size, name);
  check_areas(loops, size, name);
}

void nest(std::vector<TrimLoop>& loops, const NameOfCurve& name) {
  for (size_t k = 0; k < loops.size(); ++k)
    for (size_t j = 0; j < loops.size(); ++j) {
      const TrimLoop &inner = loops[k], &outer = loops[j];
      if (j == k || Box3{glm::max(inner.box.lo, outer.box.lo), glm::min(inner.box.hi, outer.box.hi)}.empty()) continue;
      const double of_inner = std::abs(inner.area), of_outer = std::abs(outer.area);
      if (of_inner > of_outer || (of_inner == of_outer && k < j) || !lies_in(inner, outer, name)) continue;
      ++loops[k].depth;
      int& around = loops[k].around;
      if (around < 0 || of_outer < std::abs(loops[around].area)) around = static_cast<int>(j);
    }
}

}  // namespace lekalo::geometry
