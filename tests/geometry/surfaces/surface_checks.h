// Checks that every family of surfaces must pass, each against something computed in another way:
//   derivatives  the family's formula, written out again in the test, on Taylor jets of 113-bit numbers
//   differences  Richardson-extrapolated central differences (surfaces without a formula of their own)
//   normals      r_u x r_v, and its limit from inside the domain at collapsed edges
//   enclosures   random parts of the domain against samples
//   NURBS form   the Cox-de Boor recursion in long double at mapped parameters
//   pieces       de Casteljau in long double; areas of the domains add up
//   free sides   pairs of points and tangent planes
//   line hits    points of hits lie on line and surface; lines aimed at points of the surface find them; origins up to
//                a million sizes away (everything about the line in 113 bits)
#pragma once

#include "geometry/curves/curve_checks.h"
#include "geometry/numerics/jet2.h"
#include "geometry/surface.h"

namespace lekalo::geometry::checks {

inline Vec2 random_place(const Rectangle& r, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  return {r.u.clamp(r.u.lo + uniform(random) * r.u.width()), r.v.clamp(r.v.lo + uniform(random) * r.v.width())};
}

inline Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(Vec3(normal(random), normal(random), normal(random)));
}

// formula(T u, T v) -> Triple<T> for T = Jet2<Quad, 4>, in world coordinates.
template <class Formula>
void check_derivatives(const Surface& surface, const Formula& formula, const Rectangle& range,
                       double tolerance = 1e-14) {
  std::mt19937_64 random(21);
  for (int sample = 0; sample < 40; ++sample) {
    Vec2 p = random_place(range, random);
    if (sample < 4) p = {sample & 1 ? range.u.hi : range.u.lo, sample & 2 ? range.v.hi : range.v.lo};
    const auto exact = formula(Jet2<Quad, kMaxSurfaceOrder>::u_variable(Quad(p.x)),
                               Jet2<Quad, kMaxSurfaceOrder>::v_variable(Quad(p.y)));
    for (int order = 0; order <= kMaxSurfaceOrder; ++order) {
      const SurfaceJet jet = surface.evaluate(p.x, p.y, order);
      ASSERT_EQ(jet.order, order);
      double scale = 0;
      for (int n = 0; n <= order; ++n) {
        for (int j = 0; j <= n; ++j) {
          const Vec3 d(static_cast<double>(exact.x.derivative(n - j, j)),
                       static_cast<double>(exact.y.derivative(n - j, j)),
                       static_cast<double>(exact.z.derivative(n - j, j)));
          scale = std::max(scale, glm::length(d));
          ASSERT_LE(distance(jet.d(n - j, j), d), tolerance * scale)
              << "derivative " << n - j << ", " << j << " at " << p.x << ", " << p.y;
        }
      }
    }
  }
}

// Each derivative against differences of the one below it, in both directions. `rounding`: what is left of derivatives
// that vanish, of the order n times the range's width to that power.
inline void check_differences(const Surface& surface, const Rectangle& range, int order = 3, double tolerance = 1e-7,
                              double rounding = 0) {
  std::mt19937_64 random(22);
  const Vec2 h(1e-2 * range.u.width(), 1e-2 * range.v.width());
  const Rectangle inner{{range.u.lo + h.x, range.u.hi - h.x}, {range.v.lo + h.y, range.v.hi - h.y}};
  for (int sample = 0; sample < 25; ++sample) {
    const Vec2 p = random_place(inner, random);
    const SurfaceJet jet = surface.evaluate(p.x, p.y, order);
    for (int n = 0; n < order; ++n) {
      for (int j = 0; j <= n; ++j) {
        for (const bool by_u : {true, false}) {
          const Vec2 step = by_u ? Vec2(h.x, 0) : Vec2(0, h.y);
          const auto difference = [&](double s) {
            const Vec2 a = p + s * step, b = p - s * step;
            return (surface.evaluate(a.x, a.y, n).d(n - j, j) - surface.evaluate(b.x, b.y, n).d(n - j, j)) /
                   (2 * s * (step.x + step.y));
          };
          const Vec3 d0 = difference(1), d1 = difference(0.5), d2 = difference(0.25);
          const Vec3 e0 = (4.0 * d1 - d0) / 3.0, e1 = (4.0 * d2 - d1) / 3.0;
          const Vec3 d = (16.0 * e1 - e0) / 15.0;
          const Vec3 own = by_u ? jet.d(n - j + 1, j) : jet.d(n - j, j + 1);
          const double scale =
              glm::length(own) + glm::length(jet.d(n - j, j)) / (by_u ? range.u.width() : range.v.width());
          const double vanishing = rounding / (std::pow(range.u.width(), n - j + (by_u ? 1 : 0)) *
                                               std::pow(range.v.width(), j + (by_u ? 0 : 1)));
          ASSERT_LE(distance(own, d), tolerance * scale + vanishing)
              << "derivative " << n - j + by_u << ", " << j + !by_u << " at " << p.x << ", " << p.y;
        }
      }
    }
  }
}

// Inside: r_u x r_v. On collapsed edges: the same a little further in.
inline void check_normals(const Surface& surface, const Rectangle& range) {
  std::mt19937_64 random(23);
  for (int sample = 0; sample < 200; ++sample) {
    const Vec2 p = random_place(range, random);
    const SurfaceJet jet = surface.evaluate(p.x, p.y, 1);
    const Vec3 n = glm::cross(jet.du(), jet.dv());
    const double sine = glm::length(n) / (glm::length(jet.du()) * glm::length(jet.dv()));
    if (!(sine > 1e-6)) continue;
    ASSERT_LE(distance(surface.normal(p.x, p.y), surface.normal_sign() * n / glm::length(n)), 1e-14 / sine)
        << "normal at " << p.x << ", " << p.y;
  }
  const DegenerateEdges edges = surface.degenerate_edges();
  const Rectangle d = surface.domain();
  const auto compare = [&](const Vec2& edge, const Vec2& inside) {
    const Vec3 n = surface.normal(edge.x, edge.y), near = surface.normal(inside.x, inside.y);
    ASSERT_NEAR(glm::length(n), 1, 1e-12);
    ASSERT_LE(distance(n, near), 2e-3) << "normal at the collapsed edge at " << edge.x << ", " << edge.y;
  };
  for (int i = 0; i <= 16; ++i) {
    const double u = d.u.lo + d.u.width() * i / 16, v = d.v.lo + d.v.width() * i / 16;
    const double du = 1e-6 * d.u.width(), dv = 1e-6 * d.v.width();
    if (edges.v_min) compare({u, d.v.lo}, {u, d.v.lo + dv});
    if (edges.v_max) compare({u, d.v.hi}, {u, d.v.hi - dv});
    if (edges.u_min) compare({d.u.lo, v}, {d.u.lo + du, v});
    if (edges.u_max) compare({d.u.hi, v}, {d.u.hi - du, v});
  }
}

// The jet and the normal at a point that is known to lie somewhere are those of the parameters.
inline void check_near(const Surface& surface, const Rectangle& range) {
  std::mt19937_64 random(29);
  for (int sample = 0; sample < 500; ++sample) {
    const Vec2 p = random_place(range, random);
    const int order = sample % 3;
    const SurfaceJet exact = surface.evaluate(p.x, p.y, std::max(order, 1));
    const double size = glm::length(exact.point()) + glm::length(exact.du()) + glm::length(exact.dv());
    const Vec3 moved = exact.point() + 1e-15 * size * random_direction(random);
    const SurfaceJet near = surface.evaluate_near(moved, p.x, p.y, order);
    for (int k = 0; k < (order + 1) * (order + 2) / 2; ++k)
      ASSERT_LE(distance(near.values[k], exact.values[k]), 1e-11 * (size + glm::length(exact.values[k])))
          << "derivative " << k << " at " << p.x << ", " << p.y;
    ASSERT_LE(distance(near.point(), exact.point()), 1e-14 * size);
    ASSERT_LE(distance(surface.normal(p.x, p.y, exact), surface.normal(p.x, p.y)), 1e-9);
  }
}

// An edge is called degenerate exactly when it shrinks to a point.
inline void check_degenerate_edges(const Surface& surface) {
  const Rectangle d = surface.domain();
  const double size = size_of(bounds(surface));
  const auto collapsed = [&](bool along_u, double at) {
    double reach = 0;
    for (int i = 1; i <= 8; ++i) {
      const double f = i / 8.0;
      const Vec3 a = along_u ? surface.point(d.u.lo, at) : surface.point(at, d.v.lo);
      const Vec3 b =
          along_u ? surface.point(d.u.lo + f * d.u.width(), at) : surface.point(at, d.v.lo + f * d.v.width());
      reach = std::max(reach, distance(a, b));
    }
    return reach <= 1e-12 * size;
  };
  const DegenerateEdges edges = surface.degenerate_edges();
  EXPECT_EQ(edges.v_min, collapsed(true, d.v.lo));
  EXPECT_EQ(edges.v_max, collapsed(true, d.v.hi));
  EXPECT_EQ(edges.u_min, collapsed(false, d.u.lo));
  EXPECT_EQ(edges.u_max, collapsed(false, d.u.hi));
}

// 2000 samples in 40 random parts of the range.
inline void check_enclosures(const Surface& surface, const Rectangle& range) {
  std::mt19937_64 random(24);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto part_of = [&](const Interval& all) {
    const double width = all.width() * std::pow(10.0, -4 * uniform(random));
    const double lo = all.lo + uniform(random) * (all.width() - width);
    return Interval(lo, std::min(lo + width, all.hi));
  };
  for (int part = 0; part < 40; ++part) {
    const Rectangle box{part_of(range.u), part_of(range.v)};
    const SurfaceEnclosure enclosure = surface.enclose(box, 2);
    const Box3 point_only = surface.enclose(box, 0).values[0];
    double reach = 0;
    for (int i = 0; i < 50; ++i) {
      Vec2 p = random_place(box, random);
      if (i < 4) p = {i & 1 ? box.u.hi : box.u.lo, i & 2 ? box.v.hi : box.v.lo};
      const SurfaceJet jet = surface.evaluate(p.x, p.y, 2);
      for (int k = 0; k < 6; ++k)
        ASSERT_TRUE(enclosure.values[k].contains(jet.values[k])) << "value " << k << " at " << p.x << ", " << p.y;
      ASSERT_TRUE(point_only.contains(jet.values[0])) << "point at " << p.x << ", " << p.y;
      reach = std::max(reach, glm::length(jet.du()) * box.u.width() + glm::length(jet.dv()) * box.v.width());
    }
    // An enclosure is of use only if it shrinks with its rectangle.
    reach += glm::length(enclosure.values[1].size()) * box.u.width() * 1e-3 +
             glm::length(enclosure.values[2].size()) * box.v.width() * 1e-3;
    ASSERT_LE(point_only.diameter(), 50 * reach + 1e-12 * size_of(point_only));
  }
}

inline void check_nurbs(const Surface& surface, double tolerance = 1e-13) {
  const auto form = surface.as_nurbs();
  ASSERT_TRUE(form.has_value());
  ASSERT_EQ(form->points.size(), static_cast<size_t>(form->count_u()) * form->count_v());
  const Rectangle d = surface.domain();
  const double size = size_of(bounds(surface));
  for (int a = 0; a <= 40; ++a) {
    const double u = a == 40 ? d.u.hi : d.u.lo + d.u.width() * a / 40;
    const double s = map_at(form->degree_u, form->knots_u, form->maps_u, u).rational(u);
    const std::vector<long double> nu = basis(form->degree_u, form->knots_u, s);
    for (int b = 0; b <= 40; ++b) {
      const double v = b == 40 ? d.v.hi : d.v.lo + d.v.width() * b / 40;
      const double t = map_at(form->degree_v, form->knots_v, form->maps_v, v).rational(v);
      const std::vector<long double> nv = basis(form->degree_v, form->knots_v, t);
      Homogeneous sum{};
      for (int i = 0; i < form->count_u(); ++i)
        for (int j = 0; j < form->count_v(); ++j)
          sum = mix(1, sum, nu[i] * nv[j], widened(form->points[static_cast<size_t>(i) * form->count_v() + j]));
      ASSERT_LE(distance(projected(sum), surface.point(u, v)), tolerance * size) << "at " << u << ", " << v;
    }
  }
}

inline void check_pieces(const Surface& surface, double tolerance = 1e-13) {
  const std::vector<SurfacePiece> pieces = surface.pieces();
  ASSERT_FALSE(pieces.empty());
  const Rectangle d = surface.domain();
  const double size = size_of(bounds(surface));
  double area = 0;
  for (size_t k = 0; k < pieces.size(); ++k) {
    const SurfacePiece& piece = pieces[k];
    ASSERT_TRUE(d.u.contains(piece.domain.u) && d.v.contains(piece.domain.v));
    area += piece.domain.u.width() * piece.domain.v.width();
    if (!piece.is_rational()) continue;
    for (int a = 0; a <= 8; ++a) {
      for (int b = 0; b <= 8; ++b) {
        const double u = piece.domain.u.clamp(piece.domain.u.lo + piece.domain.u.width() * a / 8);
        const double v = piece.domain.v.clamp(piece.domain.v.lo + piece.domain.v.width() * b / 8);
        std::vector<Homogeneous> column;
        for (int i = 0; i <= piece.degree_u; ++i) {
          std::vector<Homogeneous> row;
          for (int j = 0; j <= piece.degree_v; ++j)
            row.push_back(widened(piece.points[static_cast<size_t>(i) * (piece.degree_v + 1) + j]));
          column.push_back(de_casteljau(row, piece.map_v.bezier(v)));
        }
        const Vec3 p = projected(de_casteljau(column, piece.map_u.bezier(u)));
        ASSERT_LE(distance(p, surface.point(u, v)), tolerance * size) << "piece " << k << " at " << u << ", " << v;
      }
    }
  }
  EXPECT_NEAR(area, d.u.width() * d.v.width(), 1e-12 * area);
}

inline void check_periods(const Surface& surface, const Rectangle& range) {
  std::mt19937_64 random(25);
  const Periods periods = surface.periods();
  for (int i = 0; i < 20; ++i) {
    const Vec2 p = random_place(range, random);
    const Vec3 r = surface.point(p.x, p.y);
    const double slack = 1e-13 * (1 + glm::length(r));
    for (const int turns : {-2, 1, 3}) {
      EXPECT_LE(distance(surface.point(p.x + turns * periods.u, p.y), r), slack);
      EXPECT_LE(distance(surface.point(p.x, p.y + turns * periods.v), r), slack);
    }
  }
}

// o + t d in 113 bits, and its distance from a point.
inline double distance_at(const Line& line, double t, const Vec3& p) {
  Quad sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Quad difference = Quad(line.origin[i]) + Quad(t) * Quad(line.direction[i]) - Quad(p[i]);
    sum += difference * difference;
  }
  return static_cast<double>(sqrt(sum));
}

// Distance of the point from the whole line.
inline double distance_from(const Line& line, const Vec3& p) {
  Quad w[3], along = 0, square = 0, dd = 0;
  for (int i = 0; i < 3; ++i) {
    w[i] = Quad(p[i]) - Quad(line.origin[i]);
    along += w[i] * Quad(line.direction[i]);
    dd += Quad(line.direction[i]) * Quad(line.direction[i]);
  }
  for (int i = 0; i < 3; ++i) {
    const Quad across = w[i] - along / dd * Quad(line.direction[i]);
    square += across * across;
  }
  return static_cast<double>(sqrt(square));
}

struct LineChecks {
  bool closed = false;  // a closed surface: an even number of hits
  double tolerance = 1e-12;
};

// Every reported hit is a point of the line and of the surface.
inline void check_hits(const Surface& surface, const Line& line, const Interval& t, double size, LineHits& hits,
                       const LineChecks& checks) {
  hits.clear();
  surface.line_hits(line, t, hits);
  const Rectangle d = surface.domain();
  const double reach = glm::length(line.direction);
  for (int i = 0; i < hits.size(); ++i) {
    ASSERT_TRUE(t.contains(hits[i].t));
    ASSERT_TRUE(d.contains(hits[i].u, hits[i].v)) << hits[i].u << ", " << hits[i].v;
    const Vec3 p = surface.point(hits[i].u, hits[i].v);
    const double scale = std::max(size, glm::length(p));
    ASSERT_LE(distance_from(line, p), checks.tolerance * scale) << "at " << hits[i].u << ", " << hits[i].v;
    ASSERT_LE(distance_at(line, hits[i].t, p), checks.tolerance * scale + 3e-16 * std::abs(hits[i].t) * reach);
  }
  if (checks.closed && t == Interval::entire()) {
    ASSERT_EQ(hits.size() % 2, 0);
  }
}

// No point of the surface lies beyond a tangent plane on a side that is said to be free.
inline void check_convex_sides(const Surface& surface, const Rectangle& range) {
  std::mt19937_64 random(27);
  double size = 0, front = 0, back = 0;  // farthest beyond a plane on either side
  for (int sample = 0; sample < 2000; ++sample) {
    const Vec2 p = random_place(range, random), q = random_place(range, random);
    const Vec3 at = surface.point(p.x, p.y), to = surface.point(q.x, q.y) - at;
    const double height = surface.normal_sign() * glm::dot(surface.normal(p.x, p.y), to);
    const Sides free = surface.convex_sides(p.x, p.y);
    size = std::max({size, glm::length(to), 1e-3 * glm::length(at)});
    if (free.front) front = std::max(front, height);
    if (free.back) back = std::max(back, -height);
  }
  ASSERT_LE(front, 1e-12 * size);
  ASSERT_LE(back, 1e-12 * size);
}

// `range` is the part of the domain aimed at (all of it for bounded surfaces).
inline void check_line_hits(const Surface& surface, const Rectangle& range, const LineChecks& checks = {}) {
  ASSERT_TRUE(surface.has_line_formula());
  check_convex_sides(surface, range);
  std::mt19937_64 random(26);
  std::uniform_real_distribution<double> uniform(0, 1);
  Box3 box;
  for (int i = 0; i < 200; ++i) {
    const Vec2 p = random_place(range, random);
    box.include(surface.point(p.x, p.y));
  }
  const double size = std::max(box.diameter(), 1e-3 * size_of(box));
  LineHits hits;
  for (int sample = 0; sample < 1500; ++sample) {
    // Aimed at a point of the surface, from distances of 0 to 10^6 sizes, with directions of any length.
    const Vec2 p = random_place(range, random);
    const Vec3 target = surface.point(p.x, p.y);
    const Vec3 direction = random_direction(random) * std::pow(10.0, 4 * uniform(random) - 2);
    const double away = sample % 5 == 0 ? 0 : std::pow(10.0, 8 * uniform(random) - 2) * size;
    Line line{target, direction};
    line.origin -= away / glm::length(direction) * direction;
    check_hits(surface, line, Interval::entire(), size, hits, checks);
    if (testing::Test::HasFatalFailure()) return;
    const Vec3 n = surface.normal(p.x, p.y);
    const double cosine = std::abs(glm::dot(n, direction)) / glm::length(direction);
    if (cosine < 1e-3) continue;  // grazing: the rounding of the origin may lose it
    // On the border the rounding of a distant origin may do so as well.
    const auto inside = [](const Interval& all, double x, double slack) {
      return all.width() > 6.28 || (x > all.lo + slack * all.width() && x < all.hi - slack * all.width());
    };
    if (!inside(range.u, p.x, 1e-6) || !inside(range.v, p.y, 1e-6)) continue;
    double nearest = kInfinity;
    for (int i = 0; i < hits.size(); ++i)
      nearest = std::min(nearest, distance(surface.point(hits[i].u, hits[i].v), target));
    ASSERT_LE(nearest, (1e-12 * std::max(size, glm::length(target)) + 4e-16 * away) / (cosine * cosine))
        << "lost the point at " << p.x << ", " << p.y << " from " << away << " away";
    // The interval is closed and complete.
    if (hits.size() > 0) {
      const double t0 = hits[0].t;
      const int all = hits.size();
      LineHits part;
      surface.line_hits(line, {-kInfinity, t0}, part);
      const int before = part.size();
      part.clear();
      surface.line_hits(line, {next_up(t0), kInfinity}, part);
      ASSERT_EQ(before + part.size(), all);
    }
  }
  for (int sample = 0; sample < 500; ++sample) {
    const auto coordinate = [&](int i) { return box.lo[i] + (1.4 * uniform(random) - 0.2) * (box.hi[i] - box.lo[i]); };
    const Line line{{coordinate(0), coordinate(1), coordinate(2)}, random_direction(random)};
    check_hits(surface, line, Interval::entire(), size, hits, checks);
    check_hits(surface, line, {-0.3 * size, 0.5 * size}, size, hits, checks);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// All checks that need no formula of the family.
inline void check_surface(const Surface& surface, const LineChecks& checks = {}) {
  const Rectangle d = surface.domain();
  check_differences(surface, d);
  check_normals(surface, d);
  check_near(surface, d);
  check_degenerate_edges(surface);
  check_enclosures(surface, d);
  if (surface.as_nurbs()) check_nurbs(surface);
  check_pieces(surface);
  check_periods(surface, d);
  if (surface.has_line_formula())
    check_line_hits(surface, d, checks);
  else
    check_convex_sides(surface, d);
}

}  // namespace lekalo::geometry::checks
