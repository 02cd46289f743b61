// Integrals over trimmed faces without a triangulation.
//
// By Green's theorem, with the domain on the left of its loops,
//
//   integral over the domain of f du dv = sum over the loops of  integral G(u(t), v(t)) v'(t) dt,
//   G(u, v) = integral from u_0 to u of f(s, v) ds,
//
// so that the trimming curves enter exactly. Both integrals are adaptive; sides of constant v cost nothing.
//
// A rectangle is divided into cells. Where derivatives jump along a curve that runs askew to them (z = max(0, 1/2 - x^2
// - y^2)) that takes as many cells as the curve is longer than the error: then G(v) is integrated instead, as above.
// Along a line the jump is a place, which halving finds; where the curve touches a line G has the root of a distance.
#include "geometry/queries/measures/face_integral.h"

#include <algorithm>
#include <cmath>

#include "geometry/tessellation/grid_lines.h"

namespace lekalo::geometry {

namespace {

std::vector<double> with_ends(const Interval& range, const std::vector<double>& between) {
  std::vector<double> breaks{range.lo};
  for (double t : between)
    if (t > breaks.back() && t < range.hi) breaks.push_back(t);
  breaks.push_back(range.hi);
  return breaks;
}

// The region's box, from points along its loops and a little more.
Rectangle loops_box(const Body& body, int face) {
  Box3 box;
  for (int loop : body.faces[face].loops)
    for (int coedge : body.loops[loop].coedges) box.include(bounds(*body.coedges[coedge].image));
  return {{box.lo.x, box.hi.x}, {box.lo.y, box.hi.y}};
}

// The goal of an inner integral, whose error must not be what the outer one sees.
IntegrationGoal inner_goal(IntegrationGoal goal) {
  goal.relative = std::max(1e-14, 0.1 * goal.relative);
  goal.absolute *= 0.1;
  return goal;
}

Integral integrate_along_u(const Surface& surface, double v, const std::vector<double>& breaks,
                           const SurfaceIntegrand& f, int count, const IntegrationGoal& goal) {
  return integrate([&](double u, std::span<double> values) { f(surface.evaluate(u, v, 1), values); }, count, breaks,
                   goal);
}

// Of G in place of cells: at most so many lines, and evaluations on each; an accuracy that these allow.
constexpr int kMaxLines = 4000;
constexpr int kMaxOnLine = 10000;
constexpr double kLineAccuracy = 1e-9;
// A line is divided beforehand, or nodes miss what it cuts off a curve that it nearly touches. What it misses all the
// same, an area that falls with the third power of the parts, is told by twice as many.
constexpr int kPartsOfLine = 32;

std::vector<double> divided(const std::vector<double>& breaks, int parts) {
  std::vector<double> result{breaks.front()};
  for (size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 1; k <= parts; ++k)
      result.push_back(k == parts ? breaks[i + 1] : breaks[i] + (breaks[i + 1] - breaks[i]) * k / parts);
  return result;
}

Integral integrate_by_lines(const Surface& surface, const std::vector<double>& breaks_u,
                            const std::vector<double>& breaks_v, const SurfaceIntegrand& f, int count,
                            IntegrationGoal goal) {
  goal.relative = std::max(goal.relative, kLineAccuracy);
  goal.absolute = std::max(goal.absolute, 0.1 * kLineAccuracy);
  goal.evaluations = kMaxLines;
  IntegrationGoal along = inner_goal(goal);
  along.evaluations = kMaxOnLine;
  const auto with_parts = [&](int parts) {
    const std::vector<double> breaks = divided(breaks_u, parts);
    std::vector<double> line_error(count, 0);  // the largest of a line
    Integral total = integrate(
        [&](double v, std::span<double> values) {
          const Integral line = integrate_along_u(surface, v, breaks, f, count, along);
          for (int k = 0; k < count; ++k) {
            values[k] = line.value[k];
            line_error[k] = std::max(line_error[k], line.error[k]);
          }
        },
        count, breaks_v, goal);
    for (int k = 0; k < count; ++k) total.error[k] += line_error[k] * (breaks_v.back() - breaks_v.front());
    return total;
  };
  const Integral coarse = with_parts(kPartsOfLine);
  Integral fine = with_parts(2 * kPartsOfLine);
  for (int k = 0; k < count; ++k) fine.error[k] += std::abs(fine.value[k] - coarse.value[k]);
  return fine;
}

}  // namespace

Integral integrate_over(const Surface& surface, const Rectangle& box, const SurfaceIntegrand& f, int count,
                        const IntegrationGoal& goal) {
  const std::vector<double> breaks_u = with_ends(box.u, joints(surface, box, true)),
                            breaks_v = with_ends(box.v, joints(surface, box, false));
  Integral by_cells =
      integrate([&](double u, double v, std::span<double> values) { f(surface.evaluate(u, v, 1), values); }, count,
                breaks_u, breaks_v, goal);
  if (by_cells.converged) return by_cells;
  Integral by_lines = integrate_by_lines(surface, breaks_u, breaks_v, f, count, goal);
  return by_lines.error[0] < by_cells.error[0] ? by_lines : by_cells;
}

Integral integrate_over(const Body& body, int face, const SurfaceIntegrand& f, int count, const IntegrationGoal& goal) {
  const Face& the_face = body.faces[face];
  const Surface& surface = *the_face.surface;
  if (!the_face.trimmed) return integrate_over(surface, surface.domain(), f, count, goal);

  const Rectangle box = loops_box(body, face);
  const std::vector<double> joints_u = joints(surface, box, true), joints_v = joints(surface, box, false);
  const double start = box.u.middle();
  Integral total;
  total.value.assign(count, 0);
  total.error.assign(count, 0);
  total.converged = true;
  for (int loop : the_face.loops) {
    for (int index : body.loops[loop].coedges) {
      const Coedge& coedge = body.coedges[index];
      const Curve& image = *coedge.image;
      std::vector<double> inner_error(count, 0);  // the largest of an inner integral, times the speed
      const auto along = [&](double t, std::span<double> values) {
        const CurveJet at = image.evaluate(t, 1);
        const double u = at.d[0].x, v = at.d[0].y, speed = at.d[1].y;
        std::fill(values.begin(), values.end(), 0.0);
        if (speed == 0 || u == start) return;
        const Interval range{std::min(u, start), std::max(u, start)};
        const Integral inner = integrate_along_u(surface, v, with_ends(range, joints_u), f, count, inner_goal(goal));
        const double factor = u > start ? speed : -speed;
        for (int k = 0; k < count; ++k) {
          values[k] = factor * inner.value[k];
          inner_error[k] = std::max(inner_error[k], std::abs(speed) * inner.error[k]);
        }
      };
      std::vector<double> breaks;
      for (const CurvePiece& piece : image.pieces()) breaks.push_back(piece.domain.lo);
      // Where the image crosses a joint of the surface in v, found to a part of its length: quadrature does the rest.
      const Interval domain = image.domain();
      for (double joint : joints_v) {
        double before = image.point(domain.lo).y - joint;
        for (int k = 1; k <= 16; ++k) {
          const double t = domain.lo + domain.width() * k / 16, after = image.point(t).y - joint;
          if (before * after < 0) {
            double a = t - domain.width() / 16, b = t;
            for (int step = 0; step < 60; ++step) {
              const double middle = 0.5 * (a + b);
              ((image.point(middle).y - joint) * before > 0 ? a : b) = middle;
            }
            breaks.push_back(0.5 * (a + b));
          }
          before = after;
        }
      }
      std::sort(breaks.begin(), breaks.end());
      const Integral part = integrate(along, count, with_ends(domain, breaks), goal);
      const double sign = coedge.forward ? 1 : -1;
      for (int k = 0; k < count; ++k) {
        total.value[k] += sign * part.value[k];
        total.error[k] += part.error[k] + inner_error[k] * domain.width();
      }
      total.evaluations += part.evaluations;
      total.converged = total.converged && part.converged;
    }
  }
  // Loops of a face that looks against its surface run the other way round.
  if (the_face.forward != (surface.normal_sign() > 0))
    for (double& value : total.value) value = -value;
  return total;
}

}  // namespace lekalo::geometry
