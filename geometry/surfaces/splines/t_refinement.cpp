#include "geometry/surfaces/splines/t_refinement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace lekalo::geometry {

namespace {

constexpr size_t kMaxVertices = 3000;
constexpr int kChecked = 6;  // places of a cell in each direction are so many parts apart

// A cell in numbers of the first mesh's lines. Those of even level are as wide as high, those of odd level half as
// wide.
struct Cell {
  Interval u, v;
  int level = 0;
};

// Cells of lower level whose middles are as near as this to that of a cell are halved before it.
Vec2 reach(int level, int degree) {
  const double less = degree / 2, more = (degree + 1) / 2;
  return level % 2 == 0 ? std::ldexp(1, -level / 2) * Vec2(less + 0.5, more + 0.5)
                        : std::ldexp(1, -(level + 1) / 2) * Vec2(more + 0.5, 2 * less + 1);
}

void add_coarser_neighbours(const std::vector<Cell>& cells, int degree, std::vector<bool>& marked) {
  for (bool grows = true; grows;) {
    grows = false;
    for (size_t i = 0; i < cells.size(); ++i) {
      if (!marked[i]) continue;
      const Vec2 near = reach(cells[i].level, degree);
      for (size_t j = 0; j < cells.size(); ++j)
        if (!marked[j] && cells[j].level < cells[i].level &&
            std::abs(cells[j].u.middle() - cells[i].u.middle()) <= near.x &&
            std::abs(cells[j].v.middle() - cells[i].v.middle()) <= near.y)
          marked[j] = grows = true;
    }
  }
}

std::vector<Cell> halved(const std::vector<Cell>& cells, const std::vector<bool>& marked) {
  std::vector<Cell> result;
  for (size_t i = 0; i < cells.size(); ++i) {
    Cell a = cells[i], b = a;
    if (marked[i]) {
      a.level = b.level = cells[i].level + 1;
      Interval &low = cells[i].level % 2 == 0 ? a.u : a.v, &high = cells[i].level % 2 == 0 ? b.u : b.v;
      low.hi = high.lo = low.middle();
      result.push_back(b);
    }
    result.push_back(a);
  }
  return result;
}

// Cells with vertices in the middle of two opposite sides: those are to be joined.
std::vector<bool> between_vertices(const std::vector<Cell>& cells) {
  std::set<std::pair<double, double>> vertices;
  for (const Cell& cell : cells)
    for (const double x : {cell.u.lo, cell.u.hi})
      for (const double y : {cell.v.lo, cell.v.hi}) vertices.insert({x, y});
  std::vector<bool> found;
  for (const Cell& cell : cells) {
    const double x = cell.u.middle(), y = cell.v.middle();
    found.push_back(cell.level % 2 == 0 ? vertices.count({x, cell.v.lo}) && vertices.count({x, cell.v.hi})
                                        : vertices.count({cell.u.lo, y}) && vertices.count({cell.u.hi, y}));
  }
  return found;
}

bool any(const std::vector<bool>& marked) { return std::find(marked.begin(), marked.end(), true) != marked.end(); }

// The first mesh: the cells of the domain and (degree - 1)/2 rings of cells around them.
class Refinement {
 public:
  Refinement(const Surface& of, int degree, int cells_u, int cells_v)
      : of_(of), degree_(degree), counts_(cells_u, cells_v), rings_((degree - 1) / 2) {
    for (int i = -rings_; i < cells_u + rings_; ++i)
      for (int j = -rings_; j < cells_v + rings_; ++j) cells_.push_back({Interval(i, i + 1), Interval(j, j + 1), 0});
  }

  // The T-spline on the cells as they are.
  TSpline fitted() const {
    std::map<std::pair<double, double>, int> numbers;
    std::vector<Vec3> at;
    const auto vertex = [&](double x, double y) {
      const auto [found, is_new] = numbers.insert({{x, y}, static_cast<int>(at.size())});
      if (is_new) at.emplace_back(parameters(Vec2(x, y)), 0);
      return found->second;
    };
    std::vector<std::vector<int>> lines;
    for (const Cell& cell : cells_) {
      const int a = vertex(cell.u.lo, cell.v.lo), b = vertex(cell.u.hi, cell.v.lo), c = vertex(cell.u.hi, cell.v.hi),
                d = vertex(cell.u.lo, cell.v.hi);
      lines.push_back({a, b, c, d, a});
    }
    if (at.size() > kMaxVertices)
      throw FieldError("tolerance", fmt::format("more than {} points are needed", kMaxVertices), "a larger tolerance");
    const TMesh mesh = t_mesh(at, lines);
    std::vector<LocalKnots> functions = inferred_knots(mesh, degree_);
    std::vector<Vec3> points = fitted_points(functions, {}, of_.domain(), of_);
    return TSpline(std::move(functions), std::move(points), {}, of_.domain(), mesh.edges);
  }

  // Halves the cells in which the spline is too far from the surface; false if there are none.
  bool refine(const TSpline& spline, double tolerance) {
    std::vector<bool> marked(cells_.size());
    for (size_t i = 0; i < cells_.size(); ++i)
      marked[i] = is_in_domain(cells_[i]) && distance_in(cells_[i], spline) > tolerance;
    if (!any(marked)) return false;
    for (; any(marked); marked = between_vertices(cells_)) {
      add_coarser_neighbours(cells_, degree_, marked);
      cells_ = halved(cells_, marked);
    }
    return true;
  }

 private:
  Vec2 parameters(const Vec2& p) const {
    const Rectangle domain = of_.domain();
    const auto at = [](const Interval& range, double share) {
      return share == 1 ? range.hi : range.lo + share * range.width();
    };
    return {at(domain.u, p.x / counts_.x), at(domain.v, p.y / counts_.y)};
  }
  bool is_in_domain(const Cell& cell) const {
    return cell.u.lo >= 0 && cell.u.hi <= counts_.x && cell.v.lo >= 0 && cell.v.hi <= counts_.y;
  }
  double distance_in(const Cell& cell, const TSpline& spline) const {
    double largest = 0;
    for (int k = 0; k <= kChecked; ++k)
      for (int l = 0; l <= kChecked; ++l) {
        const Vec2 p =
            parameters({cell.u.lo + cell.u.width() * k / kChecked, cell.v.lo + cell.v.width() * l / kChecked});
        largest = std::max(largest, glm::length(spline.point(p.x, p.y) - of_.point(p.x, p.y)));
      }
    return largest;
  }

  const Surface& of_;
  int degree_;
  Vec2 counts_;
  int rings_;
  std::vector<Cell> cells_;
};

}  // namespace

TSpline t_spline_within(const Surface& of, int degree, int cells_u, int cells_v, double tolerance) {
  if (!of.bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
  Refinement refinement(of, degree, cells_u, cells_v);
  while (true) {
    TSpline spline = refinement.fitted();
    if (!refinement.refine(spline, tolerance)) return spline;
  }
}

}  // namespace lekalo::geometry
