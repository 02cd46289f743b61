#include "geometry/queries/rays/line_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/lanes.h"
#include "geometry/queries/rays/cell_newton.h"
#include "geometry/queries/rays/line_net.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Cells that one line may ask of one cell of a surface before the search gives up: only lines that run inside the
// surface (tangent along a curve) get there. Roots are found with a quarter of that, at cusps and poles too. Where a
// formula has a fractional power of zero the doubles near zero have to be gone through, a hundred halvings.
constexpr int kMaxCells = 256, kMaxUnboundedCells = 1024;

// A vector's parts along a line's n1, n2 and the line.
inline void see(const LineBasis& line, const Vec3& v, Lanes& parts) { geometry::see(line.axes, v.x, v.y, v.z, parts); }

using SeenPoint = SeenPlace<double, Lanes>;

template <int kP, int kQ>
struct PatchCells {
  static constexpr double slack_x = kBorderSlack, slack_y = kBorderSlack;
  const PatchView& patch;
  const CellPlace cell;
  Lanes origin;  // the line's, as it sees it

  PatchCells(const PatchView& of, const PatchCell& place, const LineBasis& line) : patch(of), cell(place.place()) {
    see(line, line.line.origin, origin);
  }
  void see_at(double x, double y, const LineBasis& line, SeenPoint& p) const {
    see_patch<kP, kQ, double, Lanes, Lanes>(patch, cell.x, cell.y, cell.hx, cell.hy, line.axes, origin, x, y, p);
  }
};

// Whether the line misses a box, which may have no bounds in some directions, but for its rounding.
bool passes_by(const Line& line, const Box3& box) {
  double begin = -kInfinity, end = kInfinity;
  for (int k = 0; k < 3; ++k) {
    const double slack = 1e-14 * (std::abs(line.origin[k]) + std::max(std::abs(box.lo[k]), std::abs(box.hi[k])));
    if (!(slack < kInfinity)) continue;
    const double lo = box.lo[k] - slack - line.origin[k], hi = box.hi[k] + slack - line.origin[k];
    if (line.direction[k] == 0) {
      if (lo > 0 || hi < 0) return true;
      continue;
    }
    const double a = lo / line.direction[k], b = hi / line.direction[k];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin > end;
}

// Cells of any surface: rectangles of its parameters. The slacks are those of the whole cell that was asked, in shares
// of this part of it: however small parts get, lines do not slip through between two cells.
struct SurfaceCells {
  const Surface* surface;
  Rectangle box;
  double slack_x = kBorderSlack, slack_y = kBorderSlack;

  PatchPoint at(double x, double y) const {
    const double hu = 0.5 * box.u.width(), hv = 0.5 * box.v.width();
    const SurfaceJet jet = surface->evaluate(box.u.middle() + hu * x, box.v.middle() + hv * y, 1);
    return {jet.point(), hu * jet.du(), hv * jet.dv()};
  }
  void see_at(double x, double y, const LineBasis& line, SeenPoint& p) const {
    const PatchPoint here = at(x, y);
    see(line, here.point - line.line.origin, p.from_origin);
    see(line, here.ds, p.dx);
    see(line, here.dt, p.dy);
    p.scale = 1;
  }
  CellModel model() const { return model_of(*surface, box); }
  // How near to the line the hull of the cell comes, and how far from it it reaches, across n1 and n2; the hull's
  // diameter.
  struct Distance {
    double least, most, hull;
  };
  // `may_be_thin`: the hull may be a wall, long in one direction alone, of which n1 and n2 see a square.
  Distance distance(const LineBasis& line, bool may_be_thin, double slack) const {
    const Box3 hull = surface->enclose(box, 0).values[0];
    if (may_be_thin && passes_by(line.line, hull.inflated(slack))) return {kInfinity, kInfinity, hull.diameter()};
    if (!hull.bounded()) return {0, kInfinity, kInfinity};
    const Vec3 r = hull.center() - line.line.origin;
    const Vec3 half = 0.5 * hull.size();
    const double rounding = 1e-15 * glm::length(r);
    Distance d{0, 0, hull.diameter()};
    for (const Vec3& n : {line.n1, line.n2}) {
      const double middle = std::abs(glm::dot(n, r)), reach = glm::dot(glm::abs(n), half) + rounding;
      d.least = std::max(d.least, middle - reach);
      d.most = std::max(d.most, middle + reach);
    }
    return d;
  }
};

template <class Cells>
inline Verdict iterate(const Cells& cells, const Guess& guess, const LineBasis& line, CellHit& hit) {
  double x = std::clamp(guess.x, -1.0, 1.0), y = std::clamp(guess.y, -1.0, 1.0);
  NewtonProgress progress(guess);
  for (;;) {
    SeenPoint p;
    cells.see_at(x, y, line, p);
    NewtonStep<double> step;
    step_from(x, y, p, step);
    switch (progress.after(x, y, step, cells.slack_x, cells.slack_y)) {
      case NewtonProgress::State::one:
        way_to(x, y, p, step, hit.t);
        hit = {hit.t * line.inverse_length, step.next_x, step.next_y};
        return Verdict::one;
      case NewtonProgress::State::none:
        return Verdict::none;
      case NewtonProgress::State::unsure:
        return Verdict::unsure;
      case NewtonProgress::State::goes_on:
        break;
    }
    x = step.next_x;
    y = step.next_y;
  }
}

Verdict decide(const SurfaceCells& cells, const CellModel& m, const LineBasis& line, CellHit& hit) {
  const Vec3 r = m.point - line.line.origin;
  const double a = glm::dot(line.n1, m.dx), b = glm::dot(line.n1, m.dy);
  const double c = glm::dot(line.n2, m.dx), d = glm::dot(line.n2, m.dy);
  const double f = glm::dot(line.n1, r), g = glm::dot(line.n2, r);
  const double determinant = a * d - b * c;
  if (determinant == 0 || !(m.shift_x < kInfinity)) return Verdict::unsure;
  const double inverse = 1 / determinant;
  const double n1 = glm::dot(line.n1, m.normal), n2 = glm::dot(line.n2, m.normal);
  const Guess guess{-(d * f - b * g) * inverse, -(a * g - c * f) * inverse,
                    m.shift_x + std::abs((d * n1 - b * n2) * inverse) * m.bend,
                    m.shift_y + std::abs((a * n2 - c * n1) * inverse) * m.bend};
  if (judge(guess, cells.slack_x, cells.slack_y) == Verdict::none) return Verdict::none;
  return is_certain(guess) ? iterate(cells, guess, line, hit) : Verdict::unsure;
}

inline void widen(const PatchCell::Four& floats, Lanes& lanes) {
  using Floats = float __attribute__((vector_size(16)));
  Floats four;
  std::memcpy(&four, floats.data(), sizeof four);
  lanes = __builtin_convertvector(four, Lanes);
}

inline void widen(const PatchCell::FourHalves& halves, Lanes& lanes) {
  using Halves = uint16_t __attribute__((vector_size(8)));
  using Words = uint32_t __attribute__((vector_size(16)));
  using Floats = float __attribute__((vector_size(16)));
  Halves four;
  std::memcpy(&four, halves.data(), sizeof four);
  lanes = __builtin_convertvector((Floats)(__builtin_convertvector(four, Words) << 16), Lanes);
}

// A vector's parts in the frame of a cell; the fourth lane means nothing.
struct LocalFrame {
  Lanes x, y, z;
  explicit LocalFrame(const PatchCell& cell) {
    widen(cell.frame[0], x);
    widen(cell.frame[1], y);
    widen(cell.frame[2], z);
  }
  void parts(const Vec3& v, Lanes& result) const { result = v.x * x + v.y * y + v.z * z; }
};

LEKALO_WIDE Verdict decide(const PatchView& patch, const PatchCell& cell, const LineBasis& line, const Interval& t,
                           CellHit& hit) {
  const LocalFrame frame(cell);
  Lanes from, along, lo, hi;
  frame.parts(line.line.origin - Vec3(frame.x[3], frame.y[3], frame.z[3]), from);
  frame.parts(line.line.direction, along);
  widen(cell.lo, lo);
  widen(cell.hi, hi);
  // When the line is in the box; what is no number (a line in the plane of a side) excludes nothing.
  const Lanes per = 1 / along, at_lo = (lo - from) * per, at_hi = (hi - from) * per;
  const Lanes enters = at_lo < at_hi ? at_lo : at_hi, leaves = at_lo < at_hi ? at_hi : at_lo;
  if (std::max(std::max(std::max(t.lo, enters[0]), enters[1]), enters[2]) >
      std::min(std::min(std::min(t.hi, leaves[0]), leaves[1]), leaves[2]))
    return Verdict::none;

  const double shift_x = lo[3], shift_y = hi[3], lean_x = along[0] * per[2], lean_y = along[1] * per[2];
  const Guess guess{from[0] - from[2] * lean_x, from[1] - from[2] * lean_y, shift_x + std::abs(lean_x) * cell.bend,
                    shift_y + std::abs(lean_y) * cell.bend};
  if (judge(guess, kBorderSlack, kBorderSlack) == Verdict::none) return Verdict::none;
  if (!is_certain(guess)) return Verdict::unsure;
  return for_degrees(
      patch, [&]<int kP, int kQ>() { return iterate(PatchCells<kP, kQ>(patch, cell, line), guess, line, hit); });
}

// At a pole one derivative, or the cross product, vanishes faster than the cell; where a formula has a root of zero one
// has no bounds.
bool is_singular(const CellModel& m, double whole_x, double whole_y) {
  if (!m.is_bounded()) return true;
  const double lx = glm::length(m.dx), ly = glm::length(m.dy);
  return lx <= 1e-6 * whole_x || ly <= 1e-6 * whole_y || glm::length(glm::cross(m.dx, m.dy)) <= 1e-6 * lx * ly;
}

// The parameter along which a line runs: parallel to its derivative, which does not vanish.
enum class Along { neither, x, y };
Along parameter_along(const Vec3& direction, const CellModel& m, double whole_x, double whole_y) {
  const auto is_parallel = [&](const Vec3& d, double variation, double whole) {
    const double length = glm::length(d);
    return variation < kInfinity && length > 1e-6 * whole &&
           glm::length(glm::cross(direction, d)) <= 1e-6 * glm::length(direction) * length;
  };
  if (is_parallel(m.dx, m.variation_x, whole_x)) return Along::x;
  return is_parallel(m.dy, m.variation_y, whole_y) ? Along::y : Along::neither;
}

Vec2 extent(const CellModel& m) { return {m.reach_x(), m.reach_y()}; }

// Cells are halved across their longer side in space: at a pole, where the sectors of a shrinking cap never become
// simpler by being made narrower, that is the side towards the pole. Along a parameter of the line itself only what
// leaves the line counts. Without bounds both are made shorter by turns; without bounds along one of them it is what of
// the hull the other one does not explain.
bool halve_across_x(const CellModel& m, Along along, double hull, double hx, double hy) {
  const double x = along == Along::x ? m.variation_x : m.reach_x(), y = along == Along::y ? m.variation_y : m.reach_y();
  const bool x_known = x < kInfinity, y_known = y < kInfinity;
  if (x_known && y_known) return x >= y;
  if (x_known == y_known) return hx >= hy;
  const double explained = std::sqrt(2.0) * (x_known ? x : y);
  return (0.5 * hull >= explained) == y_known;
}

// Where the bounds on the derivatives say nothing, from the hull; zero, which no part is smaller than and no line near
// to, where that is without bounds too.
Vec2 whole_extent(const CellModel& m, const Box3& hull) {
  if (m.is_bounded()) return extent(m);
  return Vec2(hull.bounded() ? 0.25 * hull.diameter() : 0);
}

// Whether doubles have hardly anything between the ends.
bool is_exhausted(const Interval& range) {
  return range.width() <= 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(range.lo), std::abs(range.hi));
}

struct Search {
  const LineBasis& line;
  CellHits& hits;
  Vec2 whole;  // extent of the whole piece
  const Surface& surface;
  const Rectangle& box;
  // The derivatives of the whole have no bounds: where a fractional power of zero rises, parts far smaller than others
  // are still long.
  bool unbounded;
  int cells = 0;

  int max_cells() const { return unbounded ? kMaxUnboundedCells : kMaxCells; }
  double size() const { return whole.x + whole.y; }
  // The slack at borders as a length.
  double slack() const { return kBorderSlack * size(); }

  // A neighbour in the same piece may have found the same root on the common border.
  void add(const CellHit& hit) {
    for (int i = 0; i < hits.size(); ++i)
      if (std::abs(hits[i].x - hit.x) <= 4 * kBorderSlack && std::abs(hits[i].y - hit.y) <= 4 * kBorderSlack) return;
    hits.add(hit);
  }
  // The undecided remains of a singular point, if it is on the line: a cell that has no bounds on its derivatives may
  // be long in space however small it is. Of its places the nearest to the line counts: mostly the point is a corner.
  // Cells around the point differ in the parameter that does not matter.
  void add_singular(const SurfaceCells& cells, double x0, double y0, double hx, double hy) {
    double least = kInfinity, x = x0, y = y0, t = 0;
    for (const double px : {0., -1., 1.})
      for (const double py : {0., -1., 1.}) {
        const Vec3 from = cells.at(px, py).point - line.line.origin;
        const double off = std::hypot(glm::dot(line.n1, from), glm::dot(line.n2, from));
        if (!(off < least)) continue;
        least = off, x = x0 + hx * px, y = y0 + hy * py;
        t = glm::dot(from, line.line.direction) * line.inverse_length2;
      }
    if (!(least <= kSameHit * size()) || runs_along(x, y)) return;
    const double near = 1e-9 * size() * std::sqrt(line.inverse_length2);
    for (int i = 0; i < hits.size(); ++i)
      if (std::abs(hits[i].t - t) <= near) return;
    hits.add({t, x, y});
  }
  // Whether a line through a place of the piece runs on along a parameter there: then all of it are such places.
  bool runs_along(double x, double y) const {
    const SurfaceCells piece{&surface, box};
    const auto from_origin = [&](double px, double py) { return piece.at(px, py).point - line.line.origin; };
    const Vec3 here = from_origin(x, y);
    const auto is_on_line = [&](const Vec3& there) {
      const double off = std::hypot(glm::dot(line.n1, there), glm::dot(line.n2, there));
      return off <= kSameHit * size() && glm::length(there - here) > 1e-6 * size();
    };
    return is_on_line(from_origin(x > 0 ? x - 0.5 : x + 0.5, y)) ||
           is_on_line(from_origin(x, y > 0 ? y - 0.5 : y + 0.5));
  }
  Along along(const CellModel& m, double hx, double hy) const {
    return parameter_along(line.line.direction, m, whole.x * hx, whole.y * hy);
  }
  // `hull`: the part's diameter.
  bool is_smallest(const CellModel& m, const Rectangle& part, double hull, double hx, double hy) const {
    const Vec2 e = extent(m);
    if (e.x + e.y < kSmallestCell * size()) return true;
    if (!unbounded) return std::max(hx, hy) < kSmallestCell;
    return hull <= kSmallestCell * size() || (is_spent(part.u, m.reach_x(), hx) && is_spent(part.v, m.reach_y(), hy));
  }
  // Whether making a part shorter along one parameter, of which it has a share, tells nothing more. About a step at
  // zero doubles would go on for a thousand halvings; |x|^0.2 is as small as the smallest cell at 1e-60.
  bool is_spent(const Interval& range, double reach, double share) const {
    constexpr double kMinShare = 1e-60;
    return reach <= slack() || share <= kMinShare || is_exhausted(range);
  }
};

// Decides the cell if it can be: without a root, with one, or too small to be halved. False: to be halved.
bool is_settled(Search& s, const SurfaceCells& cells, const CellModel& m, double hull, double x0, double y0, double hx,
                double hy) {
  if (++s.cells > s.max_cells()) return true;
  CellHit hit;
  const Verdict verdict = decide(cells, m, s.line, hit);
  if (verdict == Verdict::none) return true;
  if (verdict == Verdict::one) {
    s.add({hit.t, x0 + hx * hit.x, y0 + hy * hit.y});
    return true;
  }
  if (!s.is_smallest(m, cells.box, hull, hx, hy)) return false;
  if (is_singular(m, s.whole.x * hx, s.whole.y * hy)) s.add_singular(cells, x0, y0, hx, hy);
  return true;
}

// The surface over a rectangle, behind its proxy; keeps what the proxy leaves open.
class ProxiedSurface final : public NearSurface {
 public:
  struct Cell {
    double x, y, hx, hy;
  };
  // `length_of_slack`: that of the cells as a length.
  ProxiedSurface(const SurfaceCells& cells, double length_of_slack, const ProxyPatch& proxy) : cells_(cells) {
    off = proxy.off;
    off_x = proxy.off_x;
    off_y = proxy.off_y;
    rounding = proxy.rounding;
    slack_x = cells.slack_x;
    slack_y = cells.slack_y;
    slack = length_of_slack;
  }
  PatchPoint at(double x, double y) const override { return cells_.at(x, y); }
  void undecided(double x, double y, double hx, double hy) override { open_.push_back({x, y, hx, hy}); }
  const std::vector<Cell>& open() const { return open_; }

 private:
  SurfaceCells cells_;
  std::vector<Cell> open_;
};

// A rectangle of the piece with its place [x0 - hx, x0 + hx] times [y0 - hy, y0 + hy] in the piece.
struct Part {
  Rectangle box;
  double x0 = 0, y0 = 0, hx = 1, hy = 1;
  // Where derivatives have no bounds a length of a share of the parameters may be any: the slack is one in space, too.
  SurfaceCells cells(const Search& s, const CellModel& m) const {
    const auto slack = [&](double half, const Vec3& derivative) {
      const double share = kBorderSlack / half;
      return s.unbounded ? std::min(share, std::max(kBorderSlack, s.slack() / glm::length(derivative))) : share;
    };
    return {&s.surface, box, slack(hx, m.dx), slack(hy, m.dy)};
  }
  Part cell(double x, double y, double wx, double wy) const {
    const auto cut = [](const Interval& range, double at, double half) {
      const double middle = range.middle(), reach = 0.5 * range.width();
      return Interval{at - half <= -1 ? range.lo : middle + (at - half) * reach,
                      at + half >= 1 ? range.hi : middle + (at + half) * reach};
    };
    return {{cut(box.u, x, wx), cut(box.v, y, wy)}, x0 + hx * x, y0 + hy * y, hx * wx, hy * wy};
  }
};

// Proxies that are farther from the surface than this share of the cell tell too little to be worth their making.
constexpr double kWorthwhileProxy = 0.05;

// `hull`: the diameter of a box around the part.
void search(Search& s, const Part& part, const CellModel& m, const ProxyPatch* proxy, double hull) {
  const SurfaceCells cells = part.cells(s, m);
  if (is_settled(s, cells, m, hull, part.x0, part.y0, part.hx, part.hy)) return;
  const auto along = [&] { return s.along(m, part.hx, part.hy); };
  const auto go_on = [&](const Part& smaller) {
    const SurfaceCells::Distance d = SurfaceCells{&s.surface, smaller.box}.distance(s.line, s.unbounded, s.slack());
    // Along a line that runs in the surface, be it by its singular points, every place is a root: a tangent.
    if (d.least > s.slack() || (d.most <= s.slack() && along() != Along::neither)) return;
    search(s, smaller, model_of(s.surface, smaller.box), nullptr, d.hull);
  };
  // Across a line that runs in the surface parts get thin long before they get short.
  const bool is_thin = !s.unbounded && std::min(part.hx, part.hy) < kSmallestCell,
             has_proxy = !is_thin && m.is_bounded();
  if (is_thin && along() != Along::neither) return;
  ProxyPatch own;
  if (!proxy && has_proxy) {
    own = proxy_of(s.surface, part.box);
    proxy = &own;
  }
  if (has_proxy && proxy->off <= kWorthwhileProxy * (glm::length(m.dx) + glm::length(m.dy))) {
    ProxiedSurface behind(cells, s.slack(), *proxy);
    CellHits found;
    search_net(proxy->view(), behind, s.line, found);
    for (int i = 0; i < found.size(); ++i)
      s.add({found[i].t, part.x0 + part.hx * found[i].x, part.y0 + part.hy * found[i].y});
    const std::vector<ProxiedSurface::Cell>& open = behind.open();
    if (open.empty()) return;
    if (open.size() > 1 || std::max(open[0].hx, open[0].hy) < 0.9) {
      for (const ProxiedSurface::Cell& cell : open) go_on(part.cell(cell.x, cell.y, cell.hx, cell.hy));
      return;
    }
  }
  bool across_x = is_thin ? part.hx >= part.hy : halve_across_x(m, along(), hull, part.hx, part.hy);
  if (s.unbounded &&
      (across_x ? s.is_spent(part.box.u, m.reach_x(), part.hx) : s.is_spent(part.box.v, m.reach_y(), part.hy)))
    across_x = !across_x;
  for (const double side : {-0.5, 0.5}) go_on(across_x ? part.cell(side, 0, 0.5, 1) : part.cell(0, side, 1, 0.5));
}

}  // namespace

bool meets_once(const CellModel& m, const Vec3& direction) {
  // The normal is alpha dx + beta dy + gamma direction: what `decide` has of the line's two planes.
  const Vec3 across_x = glm::cross(direction, m.dx), across_y = glm::cross(m.dy, direction);
  const double determinant = glm::dot(across_x, m.dy);
  if (determinant == 0 || !(m.shift_x < kInfinity)) return false;
  const double bend = m.bend / std::abs(determinant);
  return m.shift_x + std::abs(glm::dot(m.normal, across_y)) * bend <= kInjective &&
         m.shift_y + std::abs(glm::dot(m.normal, across_x)) * bend <= kInjective;
}

bool meets_once(const PatchCell& cell, const Vec3& direction) {
  const LocalFrame frame(cell);
  Lanes along;
  frame.parts(direction, along);
  const double bend = cell.bend / std::abs(along[2]);
  return cell.lo[3] + std::abs(along[0]) * bend <= kInjective && cell.hi[3] + std::abs(along[1]) * bend <= kInjective;
}

void intersect(const PatchView& patch, const PatchCell& cell, const LineBasis& line, const Interval& t,
               CellHits& hits) {
  // Most cells are decided at once; the search's bookkeeping starts only if not.
  CellHit hit;
  const Verdict verdict = decide(patch, cell, line, t, hit);
  if (verdict == Verdict::none) return;
  if (verdict == Verdict::one) {
    hits.add(hit);
    return;
  }
  search_net(patch, cell.place(), cell.reach_x, cell.reach_y, line, hits);
}

void intersect(const Surface& surface, const Rectangle& box, const CellModel& model, const ProxyPatch& proxy,
               const Box3& hull, const LineBasis& line, CellHits& hits) {
  Search s{line, hits, whole_extent(model, hull), surface, box, !model.is_bounded()};
  search(s, {box}, model, &proxy, hull.bounded() ? hull.diameter() : kInfinity);
}

}  // namespace lekalo::geometry
