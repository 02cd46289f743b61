#include "geometry/curves/interpolation/local_interpolant.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/splines/bezier_chain.h"

namespace lekalo::geometry {

namespace {

struct Nodes {
  std::span<const Vec3> f;
  bool closed;
  GhostNodes ghosts;

  int count() const { return static_cast<int>(f.size()); }
  int cells() const { return closed ? count() : count() - 1; }
  Vec3 at(int i) const {
    if (closed) return f[(i + count()) % count()];
    if (i < 0) return beyond(f[0], f[1], f[std::min(2, count() - 1)]);
    if (i >= count()) return beyond(f[count() - 1], f[count() - 2], f[std::max(0, count() - 3)]);
    return f[i];
  }

 private:
  Vec3 beyond(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return ghosts == GhostNodes::linear || count() < 3 ? 2.0 * a - b : 3.0 * (a - b) + c;
  }
};

// m_0 and m_1 of the cell from node i.
std::pair<Vec3, Vec3> end_derivatives(const Nodes& nodes, int i, LocalKernel kernel, double beta) {
  const Vec3 before = nodes.at(i - 1), from = nodes.at(i), to = nodes.at(i + 1), after = nodes.at(i + 2);
  const Vec3 chord = to - from, bend = before - 2.0 * from + to, bend_after = from - 2.0 * to + after;
  switch (kernel) {
    case LocalKernel::cardinal:
      return {0.5 * beta * (to - before), 0.5 * beta * (after - from)};
    case LocalKernel::linear_core:
      return {chord - 0.5 * beta * bend, chord + 0.5 * beta * bend_after};
    case LocalKernel::quadratic:
      break;
  }
  const Vec3 both = 0.25 * beta * (bend + bend_after);
  return {chord - both, chord + both};
}

double read_beta(const Fields& f, const Nodes& nodes) {
  const std::string word = f.word("beta");
  if (word.empty()) return f.number("beta");
  if (word == "linear") return 0;
  if (word == "quadratic") return 1;
  if (!f.has("cells_per_turn") && !nodes.closed)
    throw FieldError("beta", fmt::format("'{}' needs to know how many cells a full turn has", word),
                     "give cells_per_turn, or close the curve");
  const int cells = f.has("cells_per_turn") ? f.integer("cells_per_turn") : nodes.cells();
  return word == "circle" ? circle_beta(cells) : rose_beta(cells);
}

// Nodes of a curve at evenly spaced parameters.
std::vector<Vec3> sampled(const Curve& curve, int cells, bool closed) {
  const Interval domain = curve.domain();
  if (!(domain.width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a range");
  std::vector<Vec3> nodes;
  for (int i = 0; i < cells + (closed ? 0 : 1); ++i)
    nodes.push_back(curve.point(i == cells ? domain.hi : domain.lo + domain.width() * i / cells));
  return nodes;
}

NurbsCurve build(const Fields& f) {
  if (f.has("points") == f.has("of"))
    throw FieldError(f.has("of") ? "of" : "points",
                     "the nodes are either `points` or those of a curve, `of` and `cells`");
  if (f.has("of") != f.has("cells"))
    throw FieldError(f.has("of") ? "of" : "cells", "'of' and 'cells' belong together",
                     "say into how many cells it is cut");
  const bool closed = f.given("closed") || !f.has("of") ? f.boolean("closed") : f.curve("of")->is_closed();
  if (closed && f.has("of") && !f.curve("of")->is_closed())
    throw FieldError("closed", "the curve of `of` is not closed", "leave `closed` out");
  const std::vector<Vec3> points =
      f.has("of") ? sampled(*f.curve("of"), f.integer("cells"), closed) : f.points("points");
  if (static_cast<int>(points.size()) < (closed ? 3 : 2))
    throw FieldError(f.has("of") ? "cells" : "points",
                     fmt::format("a closed curve needs at least 3 nodes, not {}", points.size()));
  if (closed && f.has("points") && points.front() == points.back())
    throw FieldError("points", "the last point repeats the first", "closed: true takes unrepeated points");
  const GhostNodes ghosts = f.text("ends") == "quadratic" ? GhostNodes::quadratic : GhostNodes::linear;
  const Nodes nodes{points, closed, ghosts};
  const Interval domain = f.has("of") ? f.curve("of")->domain() : Interval(0, nodes.cells());
  return local_interpolant(points, closed, local_kernel(f.text("kernel")), read_beta(f, nodes), ghosts, domain);
}

}  // namespace

LocalKernel local_kernel(const std::string& word) {
  if (word == "cardinal") return LocalKernel::cardinal;
  return word == "linear_core" ? LocalKernel::linear_core : LocalKernel::quadratic;
}

double circle_beta(int cells) {
  const double c = std::cos(kPi / cells);
  return 2 / (c * (1 + c));
}

double rose_beta(int cells) {
  const double s = std::sin(kPi / cells);
  return -2 / (s * s);
}

NurbsCurve local_interpolant(std::span<const Vec3> points, bool closed, LocalKernel kernel, double beta,
                             GhostNodes ghosts, const Interval& domain) {
  const Nodes nodes{points, closed, ghosts};
  std::vector<BezierSegment> segments;
  std::vector<double> breaks{domain.lo};
  for (int i = 0; i < nodes.cells(); ++i) {
    const auto [begin, end] = end_derivatives(nodes, i, kernel, beta);
    const Vec3 from = nodes.at(i), to = nodes.at(i + 1);
    segments.push_back({{from, 1}, {from + begin / 3.0, 1}, {to - end / 3.0, 1}, {to, 1}});
    breaks.push_back(i + 1 == nodes.cells() ? domain.hi : domain.lo + domain.width() * (i + 1) / nodes.cells());
  }
  return closed ? closed_bezier_chain(segments, breaks) : NurbsCurve(bezier_chain(segments, breaks));
}

TypeDeclaration local_interpolant_type() {
  return declare(Category::curve, "local_interpolant",
                 "Piecewise cubic through evenly spaced nodes; each cell knows its four nearest, and one number shapes "
                 "all: from straight chords over a parabola's or a circle's roundness to the petals of a rose.")
      .example("points: [[0, 0], [1, 1], [2, 0], [3, 1]], beta: 1")
      .optional("points", points().count(2), "the nodes; those of a closed curve are not repeated; t counts them")
      .optional("of", reference({Category::curve}), "a curve whose points are the nodes instead; t is its parameter")
      .optional("cells", integer().between(1, 100000), "into how many equal parts its domain is cut")
      .field("closed", boolean(), "goes on from the last node to the first; a closed curve of `of` does so by itself",
             "false")
      .field(
          "beta", number().between(-1e6, 1e6).or_word({"linear", "quadratic", "circle", "rose"}),
          "0 (linear): chords; 1 (quadratic): exact for parabolas; circle: nearest to one, when the nodes are evenly "
          "spaced on it; rose: the middles of the cells in its center",
          "quadratic")
      .optional("cells_per_turn", integer().between(3, 100000),
                "cells of a full circle, for circle and rose; of a closed curve all")
      .field("kernel", choice({"cardinal", "linear_core", "quadratic"}),
             "cardinal: smooth for every beta; linear_core: linear in t at beta 0, smooth at 1; quadratic: of the "
             "second degree, with corners",
             "cardinal")
      .field("ends", choice({"quadratic", "linear"}), "how an open row of nodes is thought to go on beyond its ends",
             "quadratic")
      .shows({"control_polygon", "knots"})
      .built_by(build);
}

}  // namespace lekalo::geometry
