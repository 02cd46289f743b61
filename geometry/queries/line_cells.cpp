#include "geometry/queries/line_cells.h"

#include <algorithm>
#include <cmath>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/lanes.h"
#include "geometry/queries/line_net.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Contraction factor up to which Newton's iteration is sure to converge: with |J^-1| r = q the derivative matrices of
// two places of the cell differ by at most 2 q / (1 - q) of either, which is 2/3 < 1 for q = 1/4.
constexpr double kContraction = 0.25;

// Row sums of |J^-1| r below 1 make the two functions one-to-one on the cell: a root that Newton's iteration finds
// there is the only one. Where it finds none, nothing is known.
constexpr double kInjective = 0.9;

// Undecided cells along one line and piece after which the search gives up: only lines that run inside the surface
// (tangent along a curve) get there.
constexpr int kMostCells = 20000;

// A cell of a rational Bezier patch.
struct PatchCells {
  PatchView patch;
  CellPlace place;

  PatchPoint at(double x, double y) const {
    PatchPoint p = evaluate(patch, 0.5 * (place.x + place.hx * x + 1), 0.5 * (place.y + place.hy * y + 1));
    p.ds *= 0.5 * place.hx;
    p.dt *= 0.5 * place.hy;
    return p;
  }
};

// Cells of any surface: rectangles of its parameters.
struct SurfaceCells {
  const Surface* surface;
  Rectangle box;

  PatchPoint at(double x, double y) const {
    const double hu = 0.5 * box.u.width(), hv = 0.5 * box.v.width();
    const SurfaceJet jet = surface->evaluate(box.u.middle() + hu * x, box.v.middle() + hv * y, 1);
    return {jet.point(), hu * jet.du(), hv * jet.dv()};
  }
  CellModel model() const { return model_of(*surface, box); }
  bool excluded(const LineBasis& line) const {
    const Box3 hull = surface->enclose(box, 0).values[0];
    const Vec3 r = hull.center() - line.line.origin;
    const Vec3 half = 0.5 * hull.size();
    const double e = 1e-15 * glm::length(r);
    return std::abs(glm::dot(line.n1, r)) > glm::dot(glm::abs(line.n1), half) + e ||
           std::abs(glm::dot(line.n2, r)) > glm::dot(glm::abs(line.n2), half) + e;
  }
};

enum class Verdict { none, one, unsure };

// `t`: roots certainly outside this interval need not be found.
template <class Cells>
Verdict decide(const Cells& cells, const CellModel& m, const LineBasis& line, const Interval& t, CellHit& hit) {
  const Vec3 r = m.point - line.line.origin;
  double a = glm::dot(line.n1, m.dx), b = glm::dot(line.n1, m.dy);
  double c = glm::dot(line.n2, m.dx), d = glm::dot(line.n2, m.dy);
  const double f = glm::dot(line.n1, r), g = glm::dot(line.n2, r);
  double determinant = a * d - b * c;
  if (determinant == 0 || !(m.shift_x < kInfinity)) return Verdict::unsure;
  const double inverse = 1 / determinant;
  const double x0 = -(d * f - b * g) * inverse, y0 = -(a * g - c * f) * inverse;
  // How far a root may lie from the linear guess.
  const double n1 = glm::dot(line.n1, m.normal), n2 = glm::dot(line.n2, m.normal);
  const double ex = m.shift_x + std::abs((d * n1 - b * n2) * inverse) * m.bend;
  const double ey = m.shift_y + std::abs((a * n2 - c * n1) * inverse) * m.bend;
  const double reach = 1 + kBorderSlack;
  if (std::abs(x0) > reach + ex || std::abs(y0) > reach + ey) return Verdict::none;
  // How far along the line.
  const double along_x = glm::dot(line.line.direction, m.dx), along_y = glm::dot(line.line.direction, m.dy);
  const double place = (glm::dot(line.line.direction, r) + along_x * x0 + along_y * y0) * line.inverse_length2;
  const double spread = (std::abs(along_x) * (ex + m.shift_x + 1e-6) + std::abs(along_y) * (ey + m.shift_y + 1e-6) +
                         std::abs(glm::dot(line.line.direction, m.normal)) * m.bend) *
                        line.inverse_length2;
  if (place + spread < t.lo || place - spread > t.hi) return Verdict::none;
  if (!(ex <= kInjective && ey <= kInjective)) return Verdict::unsure;
  const bool contracts = ex <= kContraction && ey <= kContraction;

  double x = std::clamp(x0, -1.0, 1.0), y = std::clamp(y0, -1.0, 1.0);
  bool settled = false;
  const int most = contracts ? 40 : 8;
  for (int iteration = 0; iteration < most; ++iteration) {
    const PatchPoint p = cells.at(x, y);
    const Vec3 q = p.point - line.line.origin;
    a = glm::dot(line.n1, p.ds), b = glm::dot(line.n1, p.dt);
    c = glm::dot(line.n2, p.ds), d = glm::dot(line.n2, p.dt);
    const double f1 = glm::dot(line.n1, q), g1 = glm::dot(line.n2, q);
    determinant = a * d - b * c;
    if (determinant == 0) return Verdict::unsure;
    const double sx = -(d * f1 - b * g1) / determinant, sy = -(a * g1 - c * f1) / determinant;
    const double nx = std::clamp(x + sx, -1.0, 1.0), ny = std::clamp(y + sy, -1.0, 1.0);
    // A root lies within the contraction factor times the way still to go, at most the cell's width 2, of the step's
    // end: a step that ends farther outside means none.
    constexpr double farthest = 1 + 2 * (2 * kContraction / (1 - kContraction)) + kBorderSlack;
    if (std::max(std::abs(x + sx), std::abs(y + sy)) > farthest) return contracts ? Verdict::none : Verdict::unsure;
    const double moved = std::max(std::abs(nx - x), std::abs(ny - y));
    if (moved < 1e-7) {
      // The remaining error is of the order of the square of the step. What the projection cut off must be rounding.
      if (std::max(std::abs(x + sx - nx), std::abs(y + sy - ny)) > kBorderSlack) {
        if (!contracts) return Verdict::unsure;
        if (settled) return Verdict::none;
        settled = true;
      } else {
        hit.x = nx;
        hit.y = ny;
        const Vec3 end = q + (nx - x) * p.ds + (ny - y) * p.dt;
        hit.t = glm::dot(end, line.line.direction) * line.inverse_length2;
        return Verdict::one;
      }
    }
    x = nx;
    y = ny;
  }
  return Verdict::unsure;
}

// At a pole one derivative, or the cross product, vanishes faster than the cell.
bool is_singular(const CellModel& m, double whole_x, double whole_y) {
  const double lx = glm::length(m.dx), ly = glm::length(m.dy);
  return lx <= 1e-6 * whole_x || ly <= 1e-6 * whole_y || glm::length(glm::cross(m.dx, m.dy)) <= 1e-6 * lx * ly;
}

// How far the cell reaches along x and y, at most.
Vec2 extent(const CellModel& m) { return {glm::length(m.dx) + m.variation, glm::length(m.dy) + m.variation}; }

// Cells are halved across their longer side in space: at a pole, where the sectors of a shrinking cap never become
// simpler by being made narrower, that is the side towards the pole.
bool halve_across_x(const CellModel& m, double hx, double hy) {
  const Vec2 e = extent(m);
  if (!(e.x + e.y < kInfinity)) return hx >= hy;
  return e.x >= e.y;
}

struct Search {
  const LineBasis& line;
  CellHits& hits;
  Vec2 whole;  // extent of the whole piece
  int cells = 0;

  // A neighbour in the same piece may have found the same root on the common border.
  void add(const CellHit& hit) {
    for (int i = 0; i < hits.size(); ++i)
      if (std::abs(hits[i].x - hit.x) <= 4 * kBorderSlack && std::abs(hits[i].y - hit.y) <= 4 * kBorderSlack) return;
    hits.add(hit);
  }
  // The undecided remains of a singular point: cells around it differ in the parameter that does not matter.
  void add_singular(const CellHit& hit) {
    const double size = whole.x + whole.y;
    const double near = size < kInfinity ? 1e-9 * size * std::sqrt(line.inverse_length2) : 0;
    for (int i = 0; i < hits.size(); ++i)
      if (std::abs(hits[i].t - hit.t) <= near) return;
    hits.add(hit);
  }
  bool is_smallest(const CellModel& m, double hx, double hy) const {
    const Vec2 e = extent(m);
    const double size = whole.x + whole.y;
    return (size < kInfinity && e.x + e.y < kSmallestCell * size) || std::max(hx, hy) < kSmallestCell;
  }
};

// Decides the cell if it can be: without a root, with one, or too small to be halved. False: to be halved.
bool is_settled(Search& s, const SurfaceCells& cells, const CellModel& m, double x0, double y0, double hx, double hy) {
  if (++s.cells > kMostCells) return true;
  CellHit hit;
  const Verdict verdict = decide(cells, m, s.line, {-kInfinity, kInfinity}, hit);
  if (verdict == Verdict::none) return true;
  if (verdict == Verdict::one) {
    s.add({hit.t, x0 + hx * hit.x, y0 + hy * hit.y});
    return true;
  }
  if (!s.is_smallest(m, hx, hy)) return false;
  if (is_singular(m, s.whole.x * hx, s.whole.y * hy))
    s.add_singular({glm::dot(m.point - s.line.line.origin, s.line.line.direction) * s.line.inverse_length2, x0, y0});
  return true;
}

// The surface over a rectangle, behind its proxy; keeps what the proxy leaves open.
class BehindProxy final : public NearSurface {
 public:
  struct Cell {
    double x, y, hx, hy;
  };
  BehindProxy(const SurfaceCells& cells, const ProxyPatch& proxy) : cells_(cells) {
    off = proxy.off;
    off_x = proxy.off_x;
    off_y = proxy.off_y;
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

void search(Search& s, const Surface& surface, const Part& part, const CellModel& m, const ProxyPatch* proxy) {
  if (is_settled(s, SurfaceCells{&surface, part.box}, m, part.x0, part.y0, part.hx, part.hy)) return;
  const auto go_on = [&](const Part& smaller) {
    if (SurfaceCells{&surface, smaller.box}.excluded(s.line)) return;
    search(s, surface, smaller, model_of(surface, smaller.box), nullptr);
  };
  ProxyPatch own;
  if (!proxy) {
    own = proxy_of(surface, part.box);
    proxy = &own;
  }
  if (proxy->off <= kWorthwhileProxy * (glm::length(m.dx) + glm::length(m.dy))) {
    BehindProxy behind(SurfaceCells{&surface, part.box}, *proxy);
    CellHits found;
    search_net(proxy->view(), behind, s.line, found);
    for (int i = 0; i < found.size(); ++i)
      s.add({found[i].t, part.x0 + part.hx * found[i].x, part.y0 + part.hy * found[i].y});
    const std::vector<BehindProxy::Cell>& open = behind.open();
    if (open.empty()) return;
    if (open.size() > 1 || std::max(open[0].hx, open[0].hy) < 0.9) {
      for (const BehindProxy::Cell& cell : open) go_on(part.cell(cell.x, cell.y, cell.hx, cell.hy));
      return;
    }
  }
  const bool along_x = halve_across_x(m, part.hx, part.hy);
  for (const double side : {-0.5, 0.5}) go_on(along_x ? part.cell(side, 0, 0.5, 1) : part.cell(0, side, 1, 0.5));
}

}  // namespace

namespace {

// A vector in a cell's own directions: shares of dx and dy, and the part along the normal.
struct CellFrame {
  Vec3 dual_x{0}, dual_y{0}, normal{0};
  bool regular = false;
  CellFrame(const Vec3& dx, const Vec3& dy) {
    const Vec3 n = glm::cross(dx, dy);
    const double area2 = glm::dot(n, n);
    regular = area2 > 1e-24 * glm::dot(dx, dx) * glm::dot(dy, dy) && area2 > 1e-290;
    if (!regular) return;
    dual_x = glm::cross(dy, n) / area2;
    dual_y = glm::cross(n, dx) / area2;
    normal = n / std::sqrt(area2);
  }
};

// Largest parts of the vectors included, in the directions of a cell and of space.
class LargestParts {
 public:
  explicit LargestParts(const CellFrame& frame) {
    for (int k = 0; k < 3; ++k) load(Vec4(frame.dual_x[k], frame.dual_y[k], frame.normal[k], 0), column_[k]);
  }
  // The fourth lane counts in space only.
  void include(const Lanes& v) {
    const Lanes of_cell = v[0] * column_[0] + v[1] * column_[1] + v[2] * column_[2];
    raise(of_cell_, of_cell);
    raise(of_space_, v);
  }
  void add_to(CellModel& m, double factor) const {
    m.shift_x += factor * of_cell_[0];
    m.shift_y += factor * of_cell_[1];
    m.bend += factor * of_cell_[2];
    m.variation += factor * glm::length(Vec3(of_space_[0], of_space_[1], of_space_[2]));
  }
  double fourth() const { return of_space_[3]; }

 private:
  static void raise(Lanes& largest, const Lanes& v) {
    largest = v > largest ? v : largest;
    largest = -v > largest ? -v : largest;
  }
  Lanes column_[3];
  Lanes of_cell_{}, of_space_{};
};

}  // namespace

LEKALO_WIDE CellModel model_of(const PatchView& patch) {
  CellModel m;
  const PatchPoint center = evaluate(patch, 0.5, 0.5);
  m.point = center.point;
  m.dx = 0.5 * center.ds;
  m.dy = 0.5 * center.dt;
  const CellFrame frame(m.dx, m.dy);
  m.normal = frame.normal;
  double least_weight = kInfinity, most_weight = -kInfinity;
  for (int k = 0; k < patch.count(); ++k) {
    least_weight = std::min(least_weight, patch.points[k].w);
    most_weight = std::max(most_weight, patch.points[k].w);
  }
  if (!(least_weight > 0)) {
    m.shift_x = m.shift_y = m.bend = m.variation = kInfinity;
    return m;
  }
  // With X~ = X - w S0 the derivative is S_x = (X~_x - S~ w_x) / w, S~ = S - S0 = X~ / w. All in Bernstein form: the
  // derivative of X~ raised to the patch's own degree, less w dx, has coefficients K; then
  //   |S_x - dx| <= max|K| / min w + max|S~| max|w_x| / min w
  // holds for every part of the vectors. The fourth lane holds w_x.
  const bool polynomial = least_weight == most_weight;
  const int p = patch.degree_u, q = patch.degree_v;
  LargestParts along_x(frame), along_y(frame), reach(frame);
  Lanes middle, dx, dy;
  load(Vec4(m.point, 0), middle);
  load(Vec4(m.dx, 0), dx);
  load(Vec4(m.dy, 0), dy);
  // Coefficient k of a derivative of degree n raised by one degree, times 1/2 for x = 2 s - 1.
  const auto include = [&](int k, int n, const Vec4& before, const Lanes& c, const Vec4& after, const Lanes& mean,
                           LargestParts& parts) {
    Lanes a, b;
    load(before, a);
    load(after, b);
    const Lanes d = 0.5 * (static_cast<double>(k) * (c - a) + static_cast<double>(n - k) * (b - c));
    parts.include(d - d[3] * middle - c[3] * mean);
  };
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Vec4& at = patch.at(i, j);
      Lanes c;
      load(at, c);
      include(i, p, i > 0 ? patch.at(i - 1, j) : at, c, i < p ? patch.at(i + 1, j) : at, dx, along_x);
      include(j, q, j > 0 ? patch.at(i, j - 1) : at, c, j < q ? patch.at(i, j + 1) : at, dy, along_y);
      if (!polynomial) reach.include(c / c[3] - middle);
    }
  along_x.add_to(m, 1 / least_weight);
  along_y.add_to(m, 1 / least_weight);
  if (!polynomial) reach.add_to(m, (along_x.fourth() + along_y.fourth()) / least_weight);
  if (!frame.regular) m.shift_x = m.shift_y = kInfinity;
  return m;
}

CellModel model_of(const Surface& surface, const Rectangle& box) {
  CellModel m;
  const double hu = 0.5 * box.u.width(), hv = 0.5 * box.v.width();
  const SurfaceJet jet = surface.evaluate(box.u.middle(), box.v.middle(), 1);
  m.point = jet.point();
  m.dx = hu * jet.du();
  m.dy = hv * jet.dv();
  const CellFrame frame(m.dx, m.dy);
  m.normal = frame.normal;
  const SurfaceEnclosure hull = surface.enclose(box, 1);
  const auto include = [&](const Box3& derivative, const Vec3& mean, double h) {
    // The box's support in each direction.
    const Vec3 d = h * glm::max(glm::abs(derivative.lo - mean), glm::abs(derivative.hi - mean));
    m.shift_x += glm::dot(d, glm::abs(frame.dual_x));
    m.shift_y += glm::dot(d, glm::abs(frame.dual_y));
    m.bend += glm::dot(d, glm::abs(frame.normal));
    m.variation += glm::length(d);
  };
  include(hull.d(1, 0), jet.du(), hu);
  include(hull.d(0, 1), jet.dv(), hv);
  if (!frame.regular || !(m.variation < kInfinity)) m.shift_x = m.shift_y = kInfinity;
  if (!(m.variation < kInfinity)) m.bend = m.variation = kInfinity;
  return m;
}

CellModel in_floats(const CellModel& model) {
  const auto rounded = [](const Vec3& p) { return Vec3(static_cast<glm::vec3>(p)); };
  const auto upward = [](double x) {
    const float f = static_cast<float>(x);
    return static_cast<double>(f >= x ? f : std::nextafter(f, INFINITY));
  };
  CellModel m = model;
  m.point = rounded(model.point);
  m.dx = rounded(model.dx);
  m.dy = rounded(model.dy);
  m.normal = rounded(model.normal);
  const CellFrame frame(m.dx, m.dy);
  if (!frame.regular || !(model.shift_x < kInfinity)) {
    m.shift_x = m.shift_y = kInfinity;
  } else {
    const double of_x = glm::length(m.dx - model.dx), of_y = glm::length(m.dy - model.dy);
    const double off = glm::length(m.point - model.point) + (1 + model.shift_x) * of_x + (1 + model.shift_y) * of_y +
                       glm::length(m.normal - model.normal) * model.bend;
    m.shift_x = upward(model.shift_x + off * glm::length(frame.dual_x));
    m.shift_y = upward(model.shift_y + off * glm::length(frame.dual_y));
    // The part along the true normal is at most all of it; the normal kept differs from that by its own rounding.
    m.bend = upward((model.bend + off) * (1 + 1e-6));
  }
  m.variation = upward(model.variation);
  return m;
}

bool flattens_across_u(const PatchView& patch, double x, double y) {
  const int p = patch.degree_u, q = patch.degree_v;
  const auto size = [](const Vec4& d) { return std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + std::abs(d.w); };
  double bend_u = 0, bend_v = 0, twist = 0;
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Vec4& at = patch.at(i, j);
      if (i > 0 && i < p) bend_u = std::max(bend_u, size(patch.at(i - 1, j) - at - at + patch.at(i + 1, j)));
      if (j > 0 && j < q) bend_v = std::max(bend_v, size(patch.at(i, j - 1) - at - at + patch.at(i, j + 1)));
      if (i > 0 && j > 0)
        twist = std::max(twist, size(patch.at(i - 1, j - 1) - patch.at(i - 1, j) - patch.at(i, j - 1) + at));
    }
  bend_u *= p * (p - 1);
  bend_v *= q * (q - 1);
  twist *= p * q;
  return twist >= std::max(bend_u, bend_v) ? x >= y : bend_u >= bend_v;
}

bool meets_once(const CellModel& m, const Vec3& direction) {
  // The normal is alpha dx + beta dy + gamma direction: what `decide` has of the line's two planes.
  const Vec3 across_x = glm::cross(direction, m.dx), across_y = glm::cross(m.dy, direction);
  const double determinant = glm::dot(across_x, m.dy);
  if (determinant == 0 || !(m.shift_x < kInfinity)) return false;
  const double bend = m.bend / std::abs(determinant);
  return m.shift_x + std::abs(glm::dot(m.normal, across_y)) * bend <= kInjective &&
         m.shift_y + std::abs(glm::dot(m.normal, across_x)) * bend <= kInjective;
}

double roughness(const CellModel& m) {
  const double shorter = std::min(glm::length(m.dx), glm::length(m.dy));
  const double r = std::max(m.shift_x, m.shift_y) + m.bend / shorter;
  return r < kInfinity ? r : kInfinity;
}

void intersect(const PatchView& patch, const CellPlace& place, const CellModel& model, const LineBasis& line,
               const Interval& t, CellHits& hits) {
  // Most cells are decided at once; the search's bookkeeping starts only if not.
  CellHit hit;
  const Verdict verdict = decide(PatchCells{patch, place}, model, line, t, hit);
  if (verdict == Verdict::none) return;
  if (verdict == Verdict::one) {
    hits.add(hit);
    return;
  }
  const Vec2 reach = extent(model);
  search_net(patch, place, reach.x, reach.y, line, hits);
}

void intersect(const Surface& surface, const Rectangle& box, const CellModel& model, const ProxyPatch& proxy,
               const LineBasis& line, CellHits& hits) {
  Search s{line, hits, extent(model)};
  search(s, surface, {box}, model, &proxy);
}

}  // namespace lekalo::geometry
