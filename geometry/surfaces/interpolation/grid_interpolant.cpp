// Local interpolation of an evenly spaced grid, sixteen nodes at a time (Grezdov, Filippenko 2010, formula 3):
//
//   r(d, g) = sum over j, k = -1..2 of r(D + j, G + k) sigma_j(beta_d, x) sigma_k(beta_g, y)
//
// x, y in [0, 1] within the cell from node (D, G), sigma the kernels of local_interpolant.h. Each cell is a bicubic
// Bezier patch. Beyond an open border a node is missing: it is that of a polynomial, or where a row of the border is
// one point (a pole) that on the opposite meridian.
#include <fmt/format.h>

#include "geometry/composition.h"
#include "geometry/curves/interpolation/local_interpolant.h"
#include "geometry/describe.h"
#include "geometry/surfaces/interpolation/point_grid.h"

namespace lekalo::geometry {

namespace {

constexpr int kMaxCells = 2000;

struct Direction {
  int cells = 0;
  bool closed = false;
  bool mirrored = false;
  double beta = 1;
  LocalKernel kernel = LocalKernel::cardinal;
  GhostNodes ghosts = GhostNodes::quadratic;
  Interval domain;

  // Of a mirrored line the first and last nodes lie beyond the poles.
  NurbsCurve operator()(std::span<const Vec3> line) const {
    if (!mirrored) return local_interpolant(line, closed, kernel, beta, ghosts, domain);
    const double step = domain.width() / cells;
    const NurbsCurve all = local_interpolant(line, false, kernel, beta, ghosts, {domain.lo - step, domain.hi + step});
    NurbsCurveForm inner{3, {domain.lo}, {all.points().begin() + 3, all.points().end() - 3}, {}};
    for (int i = 0; i <= cells; ++i)
      inner.knots.insert(inner.knots.end(), 3, i == cells ? domain.hi : domain.lo + domain.width() * i / cells);
    inner.knots.push_back(domain.hi);
    return NurbsCurve(inner);
  }
};

template <class T>
const T& of_direction(const Fields& f, const char* field, bool along_u) {
  return along_u ? f.u<T>(field) : f.v<T>(field);
}

const char* name(bool along_u) { return along_u ? "u" : "v"; }

double read_beta(const Fields& f, bool along_u, const Direction& direction) {
  const std::string word = f.word(along_u ? "beta.u" : "beta.v");
  if (word.empty()) return of_direction<double>(f, "beta", along_u);
  if (word == "linear") return 0;
  if (word == "quadratic") return 1;
  if (!f.has("cells_per_turn.u") && !direction.closed && !direction.mirrored)
    throw FieldError("beta",
                     fmt::format("'{}' along {} needs to know how many cells a full turn has", word, name(along_u)),
                     "give cells_per_turn, or close the surface");
  const int cells = f.has("cells_per_turn.u") ? of_direction<int>(f, "cells_per_turn", along_u)
                                              : direction.cells * (direction.mirrored ? 2 : 1);
  return word == "circle" ? circle_beta(cells) : rose_beta(cells);
}

Grid<Vec3> sampled(const Surface& of, int cells_u, int cells_v, bool closed_u, bool closed_v) {
  const Rectangle domain = of.domain();
  const auto at = [](const Interval& range, int i, int cells) {
    return i == cells ? range.hi : range.lo + range.width() * i / cells;
  };
  Grid<Vec3> nodes{cells_u + (closed_u ? 0 : 1), cells_v + (closed_v ? 0 : 1), {}};
  for (int i = 0; i < nodes.rows; ++i)
    for (int j = 0; j < nodes.columns; ++j)
      nodes.values.push_back(of.point(at(domain.u, i, cells_u), at(domain.v, j, cells_v)));
  return nodes;
}

// With a node beyond each pole on every line of the direction: the one beside the pole on the line half a turn away.
Grid<Vec3> with_mirrored(const Grid<Vec3>& nodes, bool along_u) {
  const int count = along_u ? nodes.rows : nodes.columns, lines = along_u ? nodes.columns : nodes.rows;
  const auto at = [&](int k, int line) { return along_u ? nodes.at(k, line) : nodes.at(line, k); };
  Grid<Vec3> result{nodes.rows + (along_u ? 2 : 0), nodes.columns + (along_u ? 0 : 2), {}};
  result.values.resize(static_cast<size_t>(result.rows) * result.columns);
  for (int line = 0; line < lines; ++line) {
    const int opposite = (line + lines / 2) % lines;
    for (int k = -1; k <= count; ++k) {
      const Vec3 node = k < 0 ? at(1, opposite) : k == count ? at(count - 2, opposite) : at(k, line);
      (along_u ? result.at(k + 1, line) : result.at(line, k + 1)) = node;
    }
  }
  return result;
}

struct SampledGrid {
  Grid<Vec3> nodes;
  Rectangle domain;
  bool closed_u = false, closed_v = false;
};

SampledGrid read_grid(const Fields& f) {
  if (f.has("points") == f.has("of"))
    throw FieldError(f.has("of") ? "of" : "points", "the nodes are either `points` or those of a surface, `of`");
  SampledGrid grid;
  grid.closed_u = f.u<bool>("closed"), grid.closed_v = f.v<bool>("closed");
  if (!f.has("of")) {
    if (f.given("cells"))
      throw FieldError("cells", "the points are the nodes: there is nothing to cut", "leave it out");
    grid.nodes = f.net("points");
    grid.domain = {{0, static_cast<double>(grid.nodes.rows - (grid.closed_u ? 0 : 1))},
                   {0, static_cast<double>(grid.nodes.columns - (grid.closed_v ? 0 : 1))}};
    return grid;
  }
  const Surface& of = *f.surface("of");
  if (!of.bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
  if (!f.has("cells.u")) throw FieldError("cells", "into how many cells the surface is cut is not said");
  for (const bool along_u : {true, false}) {
    const bool closes = is_closed_along(of, along_u ? Along::u : Along::v);
    if (!f.given("closed"))
      (along_u ? grid.closed_u : grid.closed_v) = closes;
    else if ((along_u ? grid.closed_u : grid.closed_v) && !closes)
      throw FieldError("closed", fmt::format("the surface is not closed along {}", name(along_u)));
  }
  grid.nodes = sampled(of, f.u<int>("cells"), f.v<int>("cells"), grid.closed_u, grid.closed_v);
  grid.domain = of.domain();
  return grid;
}

Direction read_direction(const Fields& f, const SampledGrid& grid, bool along_u) {
  Direction direction;
  direction.closed = along_u ? grid.closed_u : grid.closed_v;
  const int count = along_u ? grid.nodes.rows : grid.nodes.columns,
            others = along_u ? grid.nodes.columns : grid.nodes.rows;
  direction.cells = count - (direction.closed ? 0 : 1);
  if (count < (direction.closed ? 3 : 2))
    throw FieldError(f.has("of") ? "cells" : "points",
                     fmt::format("along {} there are {} nodes: {} are needed at least", name(along_u), count,
                                 direction.closed ? 3 : 2));
  const std::string& ends = of_direction<std::string>(f, "ends", along_u);
  direction.mirrored = ends == "poles" && !direction.closed;
  if (direction.mirrored && (!(along_u ? grid.closed_v : grid.closed_u) || others % 2 == 1))
    throw FieldError("ends", fmt::format("poles along {} need an even number of closed meridians", name(along_u)),
                     "close the other direction, with an even number of cells");
  direction.ghosts = ends == "linear" ? GhostNodes::linear : GhostNodes::quadratic;
  direction.kernel = local_kernel(f.text("kernel"));
  direction.domain = along_u ? grid.domain.u : grid.domain.v;
  direction.beta = read_beta(f, along_u, direction);
  return direction;
}

NurbsSurface build(const Fields& f) {
  const SampledGrid grid = read_grid(f);
  const Direction u = read_direction(f, grid, true), v = read_direction(f, grid, false);
  Grid<Vec3> nodes = u.mirrored ? with_mirrored(grid.nodes, true) : grid.nodes;
  if (v.mirrored) nodes = with_mirrored(nodes, false);
  return tensor_surface(nodes, u, v);
}

}  // namespace

TypeDeclaration grid_interpolant_type() {
  return declare(Category::surface, "grid_interpolant",
                 "Piecewise bicubic surface through an evenly spaced grid of nodes; each cell knows its sixteen "
                 "nearest, and one number for each direction shapes all: from flat facets over a parabola's or a "
                 "circle's roundness on. What is sampled may be any surface.")
      .example("points: [[[0, 0], [0, 1, 1], [0, 2]], [[1, 0, 1], [1, 1], [1, 2, 1]], [[2, 0], [2, 1, 1], [2, 2]]]")
      .optional("points", net(), "the nodes: points[i][j], i runs with u, j with v; of a closed direction not repeated")
      .optional("of", reference({Category::surface}),
                "a surface whose points are the nodes instead; u and v are its parameters")
      .optional("cells", integer().between(1, kMaxCells).for_each_direction(),
                "into how many equal parts its domain is cut")
      .field("closed", boolean().for_each_direction(),
             "goes on from the last node to the first; a closed surface of `of` does so by itself", "false")
      .field(
          "beta", number().between(-1e6, 1e6).or_word({"linear", "quadratic", "circle", "rose"}).for_each_direction(),
          "0 (linear): chords; 1 (quadratic): exact for parabolas; circle: nearest to one, when the nodes are evenly "
          "spaced on it; rose: the middles of the cells in its center",
          "quadratic")
      .optional("cells_per_turn", integer().between(3, 100000).for_each_direction(),
                "cells of a full circle, for circle and rose; else of a closed direction all, between poles twice all")
      .field("kernel", choice({"cardinal", "linear_core", "quadratic"}),
             "cardinal: smooth for every beta; linear_core: linear in u and v at beta 0, smooth at 1; quadratic: of "
             "the second degree, with creases",
             "cardinal")
      .field("ends", choice({"quadratic", "linear", "poles"}).for_each_direction(),
             "how open lines of nodes are thought to go on beyond their ends; poles: over the point where all meet, "
             "along the opposite one",
             "quadratic")
      .shows({"control_net", "knots"})
      .built_by(build);
}

}  // namespace lekalo::geometry
