// Bicubic Hermite splines of a surface to a tolerance (Zavyalov et al. 1985, I.5, algorithm C; II.6, problem 1):
// points, derivatives and twists are the surface's own at the nodes of a grid. The error of a cell is, up to smaller
// terms, the sum of those of the cubics along u and along v on its characteristic lines; the steps of the worse
// direction are halved.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "geometry/composition.h"
#include "geometry/curves/operations/hermite_span.h"
#include "geometry/describe.h"
#include "geometry/surfaces/interpolation/hermite_surface.h"

namespace lekalo::geometry {

namespace {

constexpr int kMaxNodes = 400;  // in one direction
constexpr int kChecked = 8;     // places of a cell in each direction are so many parts apart

struct NodeLines {
  std::vector<double> u, v;
};

std::vector<double> first_lines(const Surface& of, bool along_u, bool closed) {
  std::vector<double> lines;
  for (const SurfacePiece& piece : of.pieces())
    for (const double t :
         along_u ? std::array{piece.domain.u.lo, piece.domain.u.hi} : std::array{piece.domain.v.lo, piece.domain.v.hi})
      lines.push_back(t);
  std::sort(lines.begin(), lines.end());
  const double near = 1e-9 * (lines.back() - lines.front());
  std::vector<double> apart{lines.front()};
  for (const double t : lines)
    if (t - apart.back() > near) apart.push_back(t);
  while (closed && apart.size() < 4)  // a closed direction has three nodes at least
    for (size_t k = apart.size() - 1; k > 0; --k)
      apart.insert(apart.begin() + static_cast<std::ptrdiff_t>(k), 0.5 * (apart[k - 1] + apart[k]));
  return apart;
}

NurbsSurface spline_on(const Surface& of, const NodeLines& lines, bool closed_u, bool closed_v) {
  PointGrid grid{{}, lines.u, lines.v, closed_u, closed_v};
  NodeDerivatives d;
  const int rows = static_cast<int>(lines.u.size()) - (closed_u ? 1 : 0),
            columns = static_cast<int>(lines.v.size()) - (closed_v ? 1 : 0);
  for (Grid<Vec3>* one : {&grid.points, &d.u, &d.v, &d.uv}) *one = {rows, columns, {}};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const SurfaceJet jet = of.evaluate(lines.u[i], lines.v[j], 2);
      grid.points.values.push_back(jet.point());
      d.u.values.push_back(jet.du());
      d.v.values.push_back(jet.dv());
      d.uv.values.push_back(jet.duv());
    }
  return hermite_surface(grid, d);
}

// The largest error of the cubic between two places of a line of the surface.
double error_of_span(const Surface& of, const Vec2& from, const Vec2& to) {
  const bool along_u = from.y == to.y;
  const SurfaceJet a = of.evaluate(from.x, from.y, 1), b = of.evaluate(to.x, to.y, 1);
  const Interval range = along_u ? Interval{from.x, to.x} : Interval{from.y, to.y};
  const HermiteSpan span{range, a.point(), b.point(), along_u ? a.du() : a.dv(), along_u ? b.du() : b.dv()};
  double largest = 0;
  for (int k = 1; k < kChecked; ++k) {
    const Vec2 at = from + static_cast<double>(k) / kChecked * (to - from);
    largest = std::max(largest, glm::length(span.point(along_u ? at.x : at.y) - of.point(at.x, at.y)));
  }
  return largest;
}

std::vector<double> halved(const std::vector<double>& lines, const std::vector<bool>& wrong) {
  std::vector<double> result;
  for (size_t k = 0; k + 1 < lines.size(); ++k) {
    result.push_back(lines[k]);
    if (wrong[k]) result.push_back(0.5 * (lines[k] + lines[k + 1]));
  }
  result.push_back(lines.back());
  return result;
}

NurbsSurface spline_of_surface(const Surface& of, double tolerance, bool equal) {
  if (!of.bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
  const bool closed_u = is_closed_along(of, Along::u), closed_v = is_closed_along(of, Along::v);
  NodeLines lines{first_lines(of, true, closed_u), first_lines(of, false, closed_v)};
  while (true) {
    const NurbsSurface spline = spline_on(of, lines, closed_u, closed_v);
    std::vector<bool> wrong_u(lines.u.size() - 1), wrong_v(lines.v.size() - 1);
    bool good = true;
    for (size_t i = 0; i + 1 < lines.u.size(); ++i)
      for (size_t j = 0; j + 1 < lines.v.size(); ++j) {
        const Vec2 lo(lines.u[i], lines.v[j]), hi(lines.u[i + 1], lines.v[j + 1]), step = hi - lo;
        double largest = 0;
        for (int k = 0; k <= kChecked; ++k)
          for (int l = 0; l <= kChecked; ++l) {
            const Vec2 at = lo + Vec2(step.x * k / kChecked, step.y * l / kChecked);
            largest = std::max(largest, glm::length(spline.point(at.x, at.y) - of.point(at.x, at.y)));
          }
        if (largest <= tolerance) continue;
        good = false;
        double along_u = 0, along_v = 0;
        for (const double x : {0.0, 0.5, 1.0}) {
          along_u = std::max(along_u, error_of_span(of, {lo.x, lo.y + x * step.y}, {hi.x, lo.y + x * step.y}));
          along_v = std::max(along_v, error_of_span(of, {lo.x + x * step.x, lo.y}, {lo.x + x * step.x, hi.y}));
        }
        if (along_u >= along_v) wrong_u[i] = true;
        if (along_v >= along_u) wrong_v[j] = true;
      }
    if (good) return spline;
    if (equal)
      for (std::vector<bool>* wrong : {&wrong_u, &wrong_v})
        if (std::find(wrong->begin(), wrong->end(), true) != wrong->end()) wrong->assign(wrong->size(), true);
    lines = {halved(lines.u, wrong_u), halved(lines.v, wrong_v)};
    if (std::max(lines.u.size(), lines.v.size()) > kMaxNodes)
      throw FieldError("tolerance", fmt::format("more than {} nodes in one direction are needed", kMaxNodes),
                       "a larger tolerance");
  }
}

}  // namespace

TypeDeclaration spline_of_surface_type() {
  return declare(Category::surface, "spline_of_surface",
                 "Bicubic spline of class C1 near a surface, with its points, derivatives and twists at the nodes of a "
                 "grid that is made fine enough: at places of each cell the two are nowhere farther apart than the "
                 "tolerance.")
      .example("of: { type: torus_surface, major_radius: 2, minor_radius: 1 }, tolerance: 0.01")
      .field("of", reference({Category::surface}), "the surface")
      .field("tolerance", length().positive(), "largest distance of points at the same parameters")
      .field("steps", choice({"halved", "equal"}),
             "halved where needed, or equal in the parameters between the lines of the surface's pieces", "halved")
      .shows({"control_net", "knots"})
      .built_by([](const Fields& f) {
        return spline_of_surface(*f.surface("of"), f.number("tolerance"), f.text("steps") == "equal");
      });
}

}  // namespace lekalo::geometry
