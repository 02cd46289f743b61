// Grid lines by curvature, then by measurement.
//
// Over a cell du x dv a surface with second derivatives s_uu, s_uv, s_vv deviates from the two triangles of the cell
// by at most
//   (a du^2 + 2 b du dv + c dv^2) / 8,   a = |s_uu . m|, b = |s_uv . m|, c = |s_vv . m|
// (Filip, Magedson, Markot 1986, in its normal component). The mixed term is split between the directions,
// 2 b du dv <= b (r du^2 + dv^2 / r), with r near the ratio dv / du of the final cells, so that each direction has its
// own step:
//   (a + b r) du^2 <= 8 d w,   (c + b / r) dv^2 <= 8 d (1 - w),
// d the sag, w = 1/2 unless one direction does not use its share. For z = uv, a = c = 0, the twist alone sets both.
// The angle limits the steps by the derivatives of the normal (Weingarten).
//
// Lines are spread by the integral of the density 1/du (max over v) and 1/dv (max over u). Then every cell is measured
// and densities are raised where the surface bends faster than its samples showed; cells that it breaks in are left to
// breaks.h, since lines as dense as a kink asks for would run over the whole domain.
#include "geometry/tessellation/grid_lines.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "geometry/tessellation/breaks.h"

namespace lekalo::geometry {

namespace {

// Samples of the curvature over the whole range at least, and in every smooth piece at least, per direction.
constexpr int kSamples = 24;
constexpr int kSamplesOfPiece = 3;

// Densities in one direction, cut where a line must stand; `doubled[i]`: the normal jumps at the start of section i.
struct Direction {
  std::vector<LineDensity> sections;
  std::vector<char> doubled;

  double total() const {
    double sum = 0;
    for (const LineDensity& s : sections) sum += std::max(1.0, s.total());
    return sum;
  }
  std::vector<double> lines(int fewest) const {
    fewest = static_cast<int>((fewest + sections.size() - 1) / sections.size());
    std::vector<double> result;
    for (size_t i = 0; i < sections.size(); ++i) {
      const std::vector<double> part = sections[i].lines(fewest);
      result.insert(result.end(), part.begin() + (i > 0 && !doubled[i] ? 1 : 0), part.end());
    }
    return result;
  }
  // True where an excess is larger than 1.
  bool raise(const std::vector<double>& lines, const std::vector<double>& excess) {
    bool any = false;
    for (LineDensity& s : sections) any = s.raise(lines, excess) || any;
    return any;
  }
  // All intervals of constant density, in order.
  template <class Visit>
  void each(Visit visit) {
    int index = 0;
    for (LineDensity& s : sections)
      for (size_t k = 0; k < s.value.size(); ++k) visit(index++, s, k);
  }
};

bool normal_jumps(const Surface& surface, double at, double width, bool along_u, const Interval& other) {
  for (double fraction : {0.03, 0.29, 0.5, 0.71, 0.97}) {
    const double q = other.lo + fraction * other.width(), before = at - 1e-7 * width, after = at + 1e-7 * width;
    const Vec3 m = along_u ? surface.normal(before, q) : surface.normal(q, before);
    const Vec3 n = along_u ? surface.normal(after, q) : surface.normal(q, after);
    if (!(glm::dot(m, n) > 1 - 1e-8)) return true;
  }
  return false;
}

Direction make_direction(const Surface& surface, const Rectangle& box, bool along_u) {
  const Interval range = along_u ? box.u : box.v, other = along_u ? box.v : box.u;
  std::vector<double> cuts{range.lo};
  for (double joint : joints(surface, box, along_u)) cuts.push_back(joint);
  cuts.push_back(range.hi);
  const int parts = std::max(kSamplesOfPiece, kSamples / static_cast<int>(std::max<size_t>(1, cuts.size() - 1)));
  Direction result;
  for (size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double width = cuts[i + 1] - cuts[i];
    const bool jumps = i > 0 && normal_jumps(surface, cuts[i], std::min(width, cuts[i] - cuts[i - 1]), along_u, other);
    if (i == 0 || jumps) {
      result.sections.push_back({{cuts[i]}, {}});
      result.doubled.push_back(jumps);
    }
    LineDensity& density = result.sections.back();
    for (int k = 1; k <= parts; ++k) {
      density.at.push_back(k == parts ? cuts[i + 1] : cuts[i] + width * k / parts);
      density.value.push_back(0);
    }
  }
  return result;
}

// What one sample of the surface asks for.
struct Demand {
  double u = 0, v = 0;            // (a + b r) / (8 d), (c + b / r) / (8 d)
  double turn_u = 0, turn_v = 0;  // |m_u| / angle, |m_v| / angle
};

Demand demand_of(const SurfaceJet& s, const TessellationTolerance& tolerance) {
  const Vec3 cross = glm::cross(s.du(), s.dv());
  const double area = glm::length(cross);
  const double e = glm::dot(s.du(), s.du()), f = glm::dot(s.du(), s.dv()), g = glm::dot(s.dv(), s.dv());
  if (!(area > 1e-12 * std::sqrt(e * g))) return {};
  const Vec3 m = cross / area;
  const double l = glm::dot(s.duu(), m), n = glm::dot(s.duv(), m), p = glm::dot(s.dvv(), m);
  const double a = std::abs(l), b = std::abs(n), c = std::abs(p);
  Demand demand;
  // A little less than the sag, because the curvature may be larger between samples.
  const double scale = 8 * 0.99 * tolerance.sag_near(s.point());
  if (b > 0) {
    const double isotropic = std::sqrt(e / g);
    const double r = std::sqrt((a + b * isotropic) / (c + b / isotropic));
    demand.u = (a + b * r) / scale;
    demand.v = (c + b / r) / scale;
  } else {
    demand.u = a / scale;
    demand.v = c / scale;
  }
  // Weingarten: m_u = (f n - g l) / d s_u + (f l - e n) / d s_v, d = area^2, and the like for v.
  const double d = area * area;
  demand.turn_u = glm::length(((f * n - g * l) / d) * s.du() + ((f * l - e * n) / d) * s.dv()) / tolerance.angle;
  demand.turn_v = glm::length(((f * p - g * n) / d) * s.du() + ((f * n - e * p) / d) * s.dv()) / tolerance.angle;
  return demand;
}

// What the sides of the rectangle ask for that are borders of the surface: a chord's square of the parameter is at most
// 8 d / |s_uu x t|, t the unit tangent, since a side that bends within the surface leaves the triangles as well.
std::vector<double> side_demand(const Surface& surface, const Rectangle& box, bool along_u,
                                const std::vector<double>& middles, const TessellationTolerance& tolerance) {
  const Interval& across = along_u ? box.v : box.u;
  const auto at = [&](double t, double held, int order) {
    return along_u ? surface.evaluate(t, held, order) : surface.evaluate(held, t, order);
  };
  std::vector<double> result(middles.size(), 0.0);
  bool is_seam = true;
  for (const double t : middles) {
    const Vec3 a = at(t, across.lo, 0).point(), b = at(t, across.hi, 0).point();
    is_seam = is_seam && glm::length(a - b) <= 1e-9 * (glm::length(a) + glm::length(b));
  }
  if (is_seam) return result;
  for (size_t i = 0; i < middles.size(); ++i)
    for (const double held : {across.lo, across.hi}) {
      const SurfaceJet s = at(middles[i], held, 2);
      const Vec3 first = along_u ? s.du() : s.dv(), second = along_u ? s.duu() : s.dvv();
      const double speed = glm::length(first);
      const double bend = speed > 0 ? glm::length(glm::cross(second, first)) / speed : 0;
      if (std::isfinite(bend)) result[i] = std::max(result[i], bend / (8 * 0.99 * tolerance.sag_near(s.point())));
    }
  return result;
}

struct Densities {
  Direction u, v;
  // What the densities are made from.
  struct Sample {
    Vec2 uv;
    Vec3 point;
  };
  std::vector<Sample> samples;
};

// Share of the tolerance that a direction's lines use where they stand, given its demands without the share.
double used_share(Direction& direction, const std::vector<double>& demand, int fewest) {
  double used = 0;
  const int fewest_here = static_cast<int>((fewest + direction.sections.size() - 1) / direction.sections.size());
  direction.each([&](int index, const LineDensity& s, size_t k) {
    const double total = s.total();
    const double steps = std::max<double>(fewest_here, std::ceil(total * (1 - 1e-9)));
    const double spacing =
        total > 0 ? total / (steps * std::max(s.value[k], 1e-300)) : (s.at.back() - s.at.front()) / steps;
    const double step = std::min(spacing, s.at.back() - s.at.front());
    used = std::max(used, demand[index] * step * step);
  });
  return used;
}

Densities make_densities(const Surface& surface, const Rectangle& box, const TessellationTolerance& tolerance,
                         int fewest_u, int fewest_v) {
  Densities result{make_direction(surface, box, true), make_direction(surface, box, false), {}};
  std::vector<double> middle_u, middle_v;
  result.u.each([&](int, const LineDensity& s, size_t k) { middle_u.push_back(0.5 * (s.at[k] + s.at[k + 1])); });
  result.v.each([&](int, const LineDensity& s, size_t k) { middle_v.push_back(0.5 * (s.at[k] + s.at[k + 1])); });
  std::vector<double> sag_u(middle_u.size()), turn_u(middle_u.size()), sag_v(middle_v.size()), turn_v(middle_v.size());
  for (size_t i = 0; i < middle_u.size(); ++i) {
    for (size_t j = 0; j < middle_v.size(); ++j) {
      const SurfaceJet jet = surface.evaluate(middle_u[i], middle_v[j], 2);
      result.samples.push_back({{middle_u[i], middle_v[j]}, jet.point()});
      const Demand demand = demand_of(jet, tolerance);
      sag_u[i] = std::max(sag_u[i], demand.u);
      sag_v[j] = std::max(sag_v[j], demand.v);
      turn_u[i] = std::max(turn_u[i], demand.turn_u);
      turn_v[j] = std::max(turn_v[j], demand.turn_v);
    }
  }
  const std::vector<double> side_u = side_demand(surface, box, true, middle_u, tolerance),
                            side_v = side_demand(surface, box, false, middle_v, tolerance);
  const auto set = [](Direction& direction, const std::vector<double>& sag, const std::vector<double>& turn,
                      const std::vector<double>& side, double share) {
    direction.each([&](int index, LineDensity& s, size_t k) {
      s.value[k] = std::max({std::sqrt(sag[index] / share), turn[index], std::sqrt(side[index])});
    });
  };
  set(result.u, sag_u, turn_u, side_u, 0.5);
  set(result.v, sag_v, turn_v, side_v, 0.5);
  const double used_u = std::min(0.5, used_share(result.u, sag_u, fewest_u));
  const double used_v = std::min(0.5, used_share(result.v, sag_v, fewest_v));
  if (used_v <= used_u)
    set(result.u, sag_u, turn_u, side_u, 1 - used_v);
  else
    set(result.v, sag_v, turn_v, side_v, 1 - used_u);
  return result;
}

// Parameter for the normals of line i: the first of two equal lines belongs to what lies before it.
double normal_parameter(const std::vector<double>& lines, size_t i) {
  const bool before_crease = i > 0 && i + 1 < lines.size() && lines[i] == lines[i + 1];
  return before_crease ? lines[i] - 1e-8 * (lines[i] - lines[i - 1]) : lines[i];
}

// The normal from a jet of order 1. Where one derivative is small against the other over the whole grid the cross
// product may be nothing but rounding, and the surface finds the limit.
Vec3 normal_of(const Surface& surface, const SurfaceJet& jet, const Vec2& at, const Vec2& size) {
  const Vec3 du = size.x * jet.du(), dv = size.y * jet.dv();
  const Vec3 cross = glm::cross(du, dv);
  const double length = glm::length(cross), reach = std::max(glm::length(du), glm::length(dv));
  if (!(length > 1e-6 * reach * reach)) return surface.normal(at.x, at.y);
  return (surface.normal_sign() / length) * cross;
}

// Fills nodes and diagonals and measures the grid: for every column and row of cells, the largest deviation as a
// multiple of the tolerance, where that is more than 1. Where it is more than `suspicious`, or the normal turns too
// much, breaks are looked for: broken cells are marked, and ask for no more lines.
class GridCheck {
 public:
  GridCheck(const Surface& surface, const TessellationTolerance& tolerance, SurfaceGrid& grid, double suspicious = 1)
      : surface_(surface), tolerance_(tolerance), grid_(grid), suspicious_(suspicious) {}

  void run() {
    const size_t nu = grid_.u.size(), nv = grid_.v.size();
    grid_.points.resize(nu * nv);
    grid_.normals.resize(nu * nv);
    grid_.other_diagonal.assign((nu - 1) * (nv - 1), 0);
    grid_.broken.clear();
    excess_u_.assign(nu - 1, 0);
    excess_v_.assign(nv - 1, 0);
    fill_nodes();
    for (size_t i = 0; i < nu; ++i) measure_column(static_cast<int>(i));
  }

  const std::vector<double>& excess_u() const { return excess_u_; }
  const std::vector<double>& excess_v() const { return excess_v_; }

 private:
  void fill_nodes() {
    const size_t nv = grid_.v.size();
    std::vector<Vec2> places(nv);
    std::vector<SurfaceJet> jets(nv);
    const Vec2 size(grid_.u.back() - grid_.u.front(), grid_.v.back() - grid_.v.front());
    for (size_t i = 0; i < grid_.u.size(); ++i) {
      for (size_t j = 0; j < nv; ++j) places[j] = {grid_.u[i], grid_.v[j]};
      surface_.evaluate_many(places, 1, jets);
      for (size_t j = 0; j < nv; ++j) {
        const size_t node = i * nv + j;
        grid_.points[node] = jets[j].point();
        const double u = normal_parameter(grid_.u, i), v = normal_parameter(grid_.v, j);
        grid_.normals[node] = u == places[j].x && v == places[j].y ? normal_of(surface_, jets[j], places[j], size)
                                                                   : surface_.normal(u, v);
      }
    }
  }

  // Middles of the sides in column line i, and of the sides and cells between it and the next.
  void measure_column(int i) {
    const int rows = grid_.rows();
    const bool last = i == grid_.columns();
    places_.clear();
    for (int j = 0; j < rows; ++j) places_.push_back({grid_.u[i], 0.5 * (grid_.v[j] + grid_.v[j + 1])});
    if (!last) {
      const double u = 0.5 * (grid_.u[i] + grid_.u[i + 1]);
      for (int j = 0; j <= rows; ++j) places_.push_back({u, grid_.v[j]});
      for (int j = 0; j < rows; ++j) places_.push_back({u, 0.5 * (grid_.v[j] + grid_.v[j + 1])});
    }
    jets_.resize(places_.size());
    surface_.evaluate_many(places_, 0, jets_);
    // Sags of the sides along v in this column were needed by the column before as well.
    sides_v_before_.swap(sides_v_);
    sides_v_.resize(rows);
    for (int j = 0; j < rows; ++j)
      sides_v_[j] = side_excess(grid_.node(i, j), grid_.node(i, j + 1), jets_[j].point(), excess_v_[j]);
    if (i > 0)
      for (int j = 0; j < rows; ++j) judge_cell(i - 1, j);
    if (last) return;
    sides_u_.resize(rows + 1);
    centers_.resize(rows);
    for (int j = 0; j <= rows; ++j)
      sides_u_[j] = side_excess(grid_.node(i, j), grid_.node(i + 1, j), jets_[rows + j].point(), excess_u_[i]);
    for (int j = 0; j < rows; ++j) centers_[j] = jets_[2 * rows + 1 + j].point();
  }

  bool breaks_between(size_t a, size_t b) const {
    const auto place = [&](size_t node) {
      return Vec2(grid_.u[node / grid_.v.size()], grid_.v[node % grid_.v.size()]);
    };
    return find_break(surface_, place(a), place(b)).has_value();
  }

  // Deviation of the middle of a side in the direction of the normals, as a multiple of the sag, infinite where the
  // surface breaks; a turn of the normal beyond the angle is entered in `excess`, but for sides no longer than the sag:
  // across a singular point the normal turns however short they are.
  double side_excess(size_t a, size_t b, const Vec3& middle, double& excess) const {
    const Vec3 &m = grid_.normals[a], &n = grid_.normals[b];
    const double turn = glm::dot(m, n), limit = tolerance_.sag_near(middle);
    const bool is_short = glm::length(grid_.points[b] - grid_.points[a]) <= limit;
    const bool turns = turn < cosine_ && !is_short;
    const Vec3 offset = middle - 0.5 * (grid_.points[a] + grid_.points[b]);
    const double sag = turn > -0.5 ? std::abs(glm::dot(offset, m + n)) / glm::length(m + n) : glm::length(offset);
    if ((turns || sag > suspicious_ * (1 + 1e-6) * limit) && breaks_between(a, b)) return kInfinity;
    if (turns) excess = std::max(excess, sqr(std::acos(std::max(-1.0, turn)) / tolerance_.angle));
    return sag / limit;
  }

  void judge_cell(int i, int j) {
    if (grid_.is_empty_cell(i, j)) return;
    const size_t a = grid_.node(i, j), b = grid_.node(i + 1, j), c = grid_.node(i + 1, j + 1), d = grid_.node(i, j + 1);
    const auto& p = grid_.points;
    Vec3 m = grid_.normals[a] + grid_.normals[b] + grid_.normals[c] + grid_.normals[d];
    const double length = glm::length(m);
    m = length > 0.1 ? m / length : glm::normalize(glm::cross(p[c] - p[a], p[d] - p[b]));
    const double sag = tolerance_.sag_near(centers_[j]);
    double center;
    if (p[a] == p[b] || p[c] == p[d] || p[a] == p[d] || p[b] == p[c]) {
      center = std::abs(glm::dot(centers_[j] - 0.25 * (p[a] + p[b] + p[c] + p[d]), m)) / sag;
    } else {
      const double first = std::abs(glm::dot(centers_[j] - 0.5 * (p[a] + p[c]), m)) / sag;
      const double second = std::abs(glm::dot(centers_[j] - 0.5 * (p[b] + p[d]), m)) / sag;
      grid_.other_diagonal[grid_.cell(i, j)] = second < first * (1 - 1e-9);
      center = std::min(first, second);
    }
    const double along_u = std::max(sides_u_[j], sides_u_[j + 1]);
    const double along_v = std::max(sides_v_before_[j], sides_v_[j]);
    // What the sides do not explain is twist, which both directions share.
    const double twist = std::max(0.0, center - along_u - along_v);
    const double worst = std::max({center, along_u, along_v});
    if (worst == kInfinity || (worst > suspicious_ * (1 + 1e-6) && (breaks_between(a, c) || breaks_between(b, d)))) {
      grid_.broken.resize(grid_.other_diagonal.size(), 0);
      grid_.broken[grid_.cell(i, j)] = 1;
      return;
    }
    if (!(worst > 1 + 1e-6)) return;
    if (along_u + twist >= 0.25 * worst) excess_u_[i] = std::max(excess_u_[i], worst);
    if (along_v + twist >= 0.25 * worst) excess_v_[j] = std::max(excess_v_[j], worst);
  }

  static double sqr(double x) { return x * x; }

  const Surface& surface_;
  const TessellationTolerance& tolerance_;
  SurfaceGrid& grid_;
  const double suspicious_;
  const double cosine_ = std::cos(std::min(kPi, tolerance_.angle*(1 + 1e-6)));
  std::vector<double> excess_u_, excess_v_;
  std::vector<double> sides_u_, sides_v_, sides_v_before_;
  std::vector<Vec3> centers_;
  std::vector<Vec2> places_;
  std::vector<SurfaceJet> jets_;
};

// True if a grid that keeps its tolerance has a cell, not known to be broken, that a break in it takes from a sample by
// more than the sag: between few nodes kinks and steps may cancel out.
bool misses_break(const Surface& surface, const SurfaceGrid& grid, const std::vector<Densities::Sample>& samples,
                  const TessellationTolerance& tolerance) {
  const auto interval = [](const std::vector<double>& lines, double x) {
    return static_cast<int>(std::upper_bound(lines.begin() + 1, lines.end() - 1, x) - lines.begin()) - 1;
  };
  return std::any_of(samples.begin(), samples.end(), [&](const Densities::Sample& sample) {
    const int i = interval(grid.u, sample.uv.x), j = interval(grid.v, sample.uv.y);
    if (grid.is_broken(i, j)) return false;
    const Vec2 lo(grid.u[i], grid.v[j]), hi(grid.u[i + 1], grid.v[j + 1]), part = (sample.uv - lo) / (hi - lo);
    const auto point = [&](int a, int b) { return grid.points[grid.node(i + a, j + b)]; };
    const Vec3 flat = (1 - part.x) * ((1 - part.y) * point(0, 0) + part.y * point(0, 1)) +
                      part.x * ((1 - part.y) * point(1, 0) + part.y * point(1, 1));
    const Vec3 offset = sample.point - flat;
    if (!(glm::length(offset) > tolerance.sag_near(sample.point))) return false;
    const Vec3 normal = surface.normal(sample.uv.x, sample.uv.y);
    if (!(std::abs(glm::dot(offset, normal)) > tolerance.sag_near(sample.point))) return false;
    return find_break(surface, lo, sample.uv) || find_break(surface, hi, sample.uv);
  });
}

// How many steps a direction needs at least, so that triangles of a closed surface do not fall on each other.
int fewest_steps(const Surface& surface, const Rectangle& box, bool along_u) {
  const double period = along_u ? surface.periods().u : surface.periods().v;
  const double width = along_u ? box.u.width() : box.v.width();
  return period > 0 ? std::max(1, static_cast<int>(std::ceil(3 * width / period - 1e-9))) : 1;
}

}  // namespace

std::vector<double> joints(const Surface& surface, const Rectangle& box, bool along_u) {
  const Interval range = along_u ? box.u : box.v;
  const double period = along_u ? surface.periods().u : surface.periods().v;
  const double gap = 1e-9 * range.width();
  std::vector<double> found;
  for (const SurfacePiece& piece : surface.pieces()) {
    const Interval part = along_u ? piece.domain.u : piece.domain.v;
    for (double end : {part.lo, part.hi}) {
      const int first = period > 0 ? static_cast<int>(std::ceil((range.lo - end) / period)) : 0;
      const int last = period > 0 ? static_cast<int>(std::floor((range.hi - end) / period)) : 0;
      for (int k = first; k <= last; ++k) found.push_back(end + k * period);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<double> result;
  for (double t : found)
    if (t > range.lo + gap && t < range.hi - gap && (result.empty() || t > result.back() + gap)) result.push_back(t);
  return result;
}

bool SurfaceGrid::row_is_point(int j) const {
  for (int i = 1; i <= columns(); ++i)
    if (points[node(i, j)] != points[node(0, j)]) return false;
  return true;
}

bool SurfaceGrid::column_is_point(int i) const {
  for (int j = 1; j <= rows(); ++j)
    if (points[node(i, j)] != points[node(i, 0)]) return false;
  return true;
}

// Nodes of a pole differ by rounding; here they become one point. Where a column that is a pole meets a row that is one
// they are one point together.
static void gather_poles(SurfaceGrid& grid) {
  Box3 box;
  for (const Vec3& p : grid.points) box.include(p);
  const double small = 1e-12 * std::max(box.diameter(), glm::length(box.center()));
  const auto gather = [&](int count, int first, auto index) {
    for (int k = 0; k < count; ++k)
      if (glm::length(grid.points[index(k)] - grid.points[index(first)]) > small) return false;
    for (int k = 0; k < count; ++k) grid.points[index(k)] = grid.points[index(first)];
    return true;
  };
  int pole = 0;  // a row that is one
  for (int j = 0; j <= grid.rows(); ++j)
    if (gather(grid.columns() + 1, 0, [&](int i) { return grid.node(i, j); })) pole = j;
  for (int i = 0; i <= grid.columns(); ++i) gather(grid.rows() + 1, pole, [&](int j) { return grid.node(i, j); });
}

// The last look at a grid with breaks. In the middle between two nodes a kink shows no more than half of what it
// deviates by where it is.
static void finish(const Surface& surface, const TessellationTolerance& tolerance, SurfaceGrid& grid) {
  if (!grid.broken.empty()) GridCheck(surface, tolerance, grid, 0.5).run();
  gather_poles(grid);
}

SurfaceGrid grid_on(const Surface& surface, std::vector<double> u, std::vector<double> v,
                    const TessellationTolerance& tolerance) {
  SurfaceGrid grid;
  grid.u = std::move(u);
  grid.v = std::move(v);
  GridCheck(surface, tolerance, grid).run();
  finish(surface, tolerance, grid);
  return grid;
}

void refuse_mesh(double triangles) {
  throw std::invalid_argument(
      fmt::format("a mesh that keeps its sag and angle would need about {:.0e} triangles (at most {:.0e}): give a "
                  "larger sag, or leave the surface exact",
                  triangles, kMaxTriangles));
}

SurfaceGrid make_grid(const Surface& surface, const Rectangle& box, const TessellationTolerance& given) {
  TessellationTolerance tolerance = given;
  // Beyond a right angle the deviation along normals measures nothing.
  tolerance.angle = std::min(given.angle, 0.49 * kPi);
  int fewest_u = fewest_steps(surface, box, true), fewest_v = fewest_steps(surface, box, false);
  Densities densities = make_densities(surface, box, tolerance, fewest_u, fewest_v);
  SurfaceGrid grid;
  // Each makes steps that are too long up to half as long: after so many they are nothing but rounding.
  constexpr int kMaxRounds = 40;
  for (int round = 0; round < kMaxRounds; ++round) {
    const double triangles = 2 * densities.u.total() * densities.v.total();
    if (!(triangles < kMaxTriangles)) refuse_mesh(triangles);
    grid.u = densities.u.lines(fewest_u);
    grid.v = densities.v.lines(fewest_v);
    GridCheck check(surface, tolerance, grid);
    check.run();
    const bool raised_u = densities.u.raise(grid.u, check.excess_u());
    const bool raised_v = densities.v.raise(grid.v, check.excess_v());
    if (raised_u || raised_v) continue;
    if (fewest_u >= kSamples || !misses_break(surface, grid, densities.samples, tolerance)) break;
    fewest_u = fewest_v = kSamples;
  }
  finish(surface, tolerance, grid);
  return grid;
}

}  // namespace lekalo::geometry
