// Surfaces made of others, each with its formula written out over jets of 113-bit numbers. Their operands are chosen
// so that nothing has to be solved: circles for paths, curves by formulas.
#pragma once

#include <array>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "geometry/numerics/jet2.h"
#include "geometry/numerics/triple.h"
#include "geometry/quad.h"
#include "geometry/surface.h"

namespace lekalo::render::every_surface {

using geometry::Interval;
using geometry::Jet2;
using geometry::kMaxSurfaceOrder;
using geometry::Rectangle;
using geometry::Triple;

using J = Jet2<Quad, kMaxSurfaceOrder>;
using Point = Triple<J>;

// Largest differences of the derivatives of orders 0 to 4, of the size of the surface's derivatives up to there.
using Tolerances = std::array<double, kMaxSurfaceOrder + 1>;
inline constexpr Tolerances kRounding{1e-14, 1e-14, 1e-14, 1e-14, 1e-14};
// Directions across paths are polynomials that agree with those meant to 1e-13 (operations/moving_frame.h): each
// derivative loses about two digits.
inline constexpr Tolerances kByPolynomials{1e-13, 1e-11, 1e-9, 2e-8, 2e-6};

struct Reference {
  std::string type, fields;
  std::function<Point(const J& u, const J& v)> formula;
  Rectangle range;  // a smooth part of the domain
  Tolerances tolerances = kRounding;
};

inline std::ostream& operator<<(std::ostream& out, const Reference& one) { return out << one.type; }
inline std::string described(const Reference& one) { return "{ type: " + one.type + ", " + one.fields + " }"; }

inline const Quad kPi113 = acos(Quad(-1));

inline Point mix(const J& w, const Point& a, const Point& b) { return (1.0 - w) * a + w * b; }

// A curve by formulas over 0..1.
inline std::string graph(const std::string& point) {
  return "{ type: formula_curve, point: [" + point + "], domain: [0, 1] }";
}

// The graph z = sin x cos y over the unit square, its tangents, and a unit normal.
inline const char* const kHill =
    "{ type: formula_surface, point: [u, v, sin(u)*cos(v)], domain: { u: [0, 1], v: [0, 1] } }";
inline Point hill(const J& u, const J& v) { return {u, v, sin(u) * cos(v)}; }
inline Point hill_u(const J& u, const J& v) { return {J(1), J(0), cos(u) * cos(v)}; }
inline Point hill_v(const J& u, const J& v) { return {J(0), J(1), -(sin(u) * sin(v))}; }
inline Point hill_normal(const J& u, const J& v) {
  const Point n = cross(hill_u(u, v), hill_v(u, v));
  return (1.0 / sqrt(dot(n, n))) * n;
}

// From the direction of a towards that of b.
inline void turn(const J& angle, J& a, J& b) {
  const J before = a;
  a = cos(angle) * before - sin(angle) * b;
  b = sin(angle) * before + cos(angle) * b;
}

// A point of a section in the frame of a circle of radius 2 about the axis z, x of it along z, y outwards.
inline Point on_ring(const J& turns, const J& x, const J& y, const J& along = J(0)) {
  const J a = 2.0 * kPi113 * turns, far = 2.0 + y;
  return {far * cos(a) - along * sin(a), far * sin(a) + along * cos(a), x};
}

inline std::vector<Reference> references_of_sweeps() {
  const std::string ring = "path: { type: circle, radius: 2 }, frame: { fixed: z }";
  return {
      {"translation_surface",
       "of: { type: bezier_curve, points: [[-1.5, -1, 0], [0, -1, 2], [2, -1, 0]] }, along: { type: formula_curve, "
       "point: [0, t, 0.3*sin(t)], domain: [0, 3] }",
       [](const J& u, const J& v) {
         const J b0 = (1.0 - u) * (1.0 - u), b1 = 2.0 * u * (1.0 - u), b2 = u * u;
         return Point{-1.5 * b0 + 2.0 * b2, -1.0 + v, 2.0 * b1 + 0.3 * sin(v)};
       },
       {{0, 1}, {0, 3}}},
      {"sweep_surface",
       ring + ", section: { type: circle, radius: 0.5 }, scale: 1 + 0.3*s, twist: 90 deg*s, pitch: 20 deg*s, yaw: 30 "
              "deg*s",
       [](const J& u, const J& v) {
         J x = (1.0 + 0.3 * v) * 0.5 * cos(u), y = (1.0 + 0.3 * v) * 0.5 * sin(u), z(0);
         turn(kPi113 / 6.0 * v, z, x);
         turn(kPi113 / 9.0 * v, y, z);
         turn(kPi113 / 2.0 * v, x, y);
         return on_ring(v, x, y, z);
       },
       {{0, geometry::kTwoPi}, {0, 1}},
       kByPolynomials},
      // Beside the ring another, farther out and higher by 1: a frame that looks at it, and a section that reaches it.
      {"sweep_surface",
       "path: { type: circle, radius: 2 }, section: { type: circle, radius: 0.5 }, frame: { given: { type: circle, "
       "radius: 3, center: [0, 0, 1] } }",
       [](const J& u, const J& v) {
         const J x = 0.5 * cos(u) / sqrt(Quad(2)), y = 0.5 * sin(u) / sqrt(Quad(2));
         return on_ring(v, x - y, x + y);
       },
       {{0, geometry::kTwoPi}, {0, 1}},
       kByPolynomials},
      {"sweep_surface",
       "path: { type: circle, radius: 2 }, section: { type: circle, radius: 0.5 }, rail: { type: circle, radius: 3, "
       "center: [0, 0, 1] }",
       [](const J& u, const J& v) {
         const J x = 0.5 * cos(u), y = 0.5 * sin(u);
         return on_ring(v, x - y, x + y);
       },
       {{0, geometry::kTwoPi}, {0, 1}},
       kByPolynomials},
      {"serpentine",
       "preset: bellows, b: 0.3, e: 0.15, k: 2, " + ring,
       [](const J& u, const J& v) {
         const J radius = 0.3 * (1.0 + 0.15 * cos(4.0 * kPi113 * v));
         return on_ring(v, radius * cos(u), radius * sin(u));
       },
       {{0, geometry::kTwoPi}, {0, 1}},
       kByPolynomials},
      {"guided_loft",
       "of: [{ type: formula_curve, point: [2 + 0.5*cos(t), 0, 0.5*sin(t)], domain: [0, 2*pi] }, { type: "
       "formula_curve, "
       "point: [0, 2 + cos(t), sin(t)], domain: [0, 2*pi] }], along: { type: circle, radius: 2 }, at_v: [0, 90 deg], "
       "frame: { fixed: z }",
       [](const J& u, const J& v) {
         const J w = v / (kPi113 / 2.0), radius = 0.5 + 0.5 * w * w * (3.0 - 2.0 * w);
         return on_ring(w / 4.0, radius * sin(u), radius * cos(u));
       },
       {{0, geometry::kTwoPi}, {0, geometry::kTwoPi / 4}},
       kByPolynomials},
      {"ribbon",
       "of: { type: formula_curve, point: [2*cos(t), 2*sin(t), 0.5*t], domain: [0, 4] }, width: 0.6, across: normal",
       [](const J& u, const J& v) {
         return Point{(2.0 - v) * cos(u), (2.0 - v) * sin(u), 0.5 * u};
       },
       {{0, 4}, {-0.3, 0.3}},
       kByPolynomials},
      {"vintoid",
       "of: { type: formula_curve, point: [0.5*cos(t), 0.3*sin(t), 0], domain: [0, 2*pi] }, distance: 2 + 0.1*u, "
       "height: "
       "0.2*u, turn: 30*u, scale: [1 + 0.1*u, 1 + 0.2*u]",
       [](const J& u, const J& v) {
         const J x = (1.0 + 0.1 * u) * 0.5 * cos(v), y = (1.0 + 0.2 * u) * 0.3 * sin(v), a = kPi113 / 6.0 * u;
         const J far = 2.0 + 0.1 * u + cos(a) * x + sin(a) * y, high = 0.2 * u - sin(a) * x + cos(a) * y;
         return Point{far * cos(u), far * sin(u), high};
       },
       {{0, geometry::kTwoPi}, {0, geometry::kTwoPi}}},
      // A flank.
      {"thread_surface",
       "diameter: 10, length: 6",
       [](const J& u, const J& v) {
         const Quad p = 1.5, crest = 5, root = crest - 5.0 / Quad(16) * sqrt(Quad(3)) * p;
         const J w = v - 1.0, far = root + w * (crest - root), high = p / 8.0 + w * (5.0 * p / 16.0);
         return Point{far * cos(u), far * sin(u), high + p / (2.0 * kPi113) * u};
       },
       {{0, 25}, {1, 1.999}}},
      {"weld_groove",
       "seam: { type: circle, radius: 2 }, normal: z, thickness: 0.6, gap: 0.1, root_face: 0.1, angle: 60 + "
       "20*sin(2*pi*s)",
       [](const J& u, const J& v) {
         const J half = kPi113 / 360.0 * (60.0 + 20.0 * sin(2.0 * kPi113 * v));
         const J out = -0.05 - (1.0 - u) * (Quad(0.6) - Quad(0.1)) * sin(half) / cos(half);
         return on_ring(v, Quad(0.6) + u * (Quad(0.1) - Quad(0.6)), out);
       },
       {{0, 0.999}, {0, 1}},
       kByPolynomials},
  };
}

inline std::vector<Reference> references_of_nets() {
  const Rectangle square{{0, 1}, {0, 1}};
  return {
      {"ruled_surface", "of: [" + graph("t, 0, sin(t)") + ", " + graph("t, exp(t), t") + "]",
       [](const J& u, const J& v) {
         return mix(v, Point{u, J(0), sin(u)}, Point{u, exp(u), u});
       },
       square},
      {"sector_surface", "of: " + graph("t, exp(t), sin(t)") + ", apex: [0.5, 0.5, 2]",
       [](const J& u, const J& v) {
         return mix(v, Point{u, exp(u), sin(u)}, Point{J(0.5), J(0.5), J(2)});
       },
       square},
      {"loft_surface",
       "method: bezier, weight_functions: [2 + u, 2 - u, 2 + u^2], of: [" + graph("t, 0, sin(t)") + ", " +
           graph("t, 1, exp(t)") + ", " + graph("t, 2, cos(t)") + "]",
       [](const J& u, const J& v) {
         const J b0 = (1.0 - v) * (1.0 - v) * (2.0 + u), b1 = 2.0 * v * (1.0 - v) * (2.0 - u),
                 b2 = v * v * (2.0 + u * u);
         return (1.0 / (b0 + b1 + b2)) *
                Point{(b0 + b1 + b2) * u, b1 + 2.0 * b2, b0 * sin(u) + b1 * exp(u) + b2 * cos(u)};
       },
       square},
      {"coons_surface",
       "u_lines: [" + graph("t, 0, sin(t)*(1 - t)") + ", " + graph("t, 1, exp(t) - 1") + "], v_lines: [" +
           graph("0, t, t*(1 - t)") + ", " + graph("1, t, (exp(1) - 1)*t^3") + "]",
       [](const J& u, const J& v) {
         const Quad corner = exp(Quad(1)) - 1.0;
         const J along_u = (1.0 - v) * sin(u) * (1.0 - u) + v * (exp(u) - 1.0),
                 along_v = (1.0 - u) * v * (1.0 - v) + u * corner * v * v * v;
         return Point{u, v, along_u + along_v - corner * u * v};
       },
       square},
      {"gordon",
       "u_lines: [" + graph("t, 0, sin(t)") + ", " + graph("t, 0.5, sin(t) + t/4") + ", " +
           graph("t, 1, sin(t) + t*exp(t - 1)") + "], v_lines: [" + graph("0, t, 0") + ", " +
           graph("1, t, sin(1) + t^2") + "]",
       [](const J& u, const J& v) {
         const J l1 = 4.0 * v * (1.0 - v), l2 = v * (2.0 * v - 1.0);
         const J along_u = sin(u) + l1 * u / 4.0 + l2 * u * exp(u - 1.0);
         const J along_v = u * (sin(Quad(1)) + v * v);
         const J points = u * (sin(Quad(1)) + l1 / 4.0 + l2);
         return Point{u, v, along_u + along_v - points};
       },
       square},
      {"bridge_surface",
       "continuity: 1, tension: 1, from: { type: cylinder_surface, radius: 1, height: 1 }, from_edge: v_max, to: { "
       "type: "
       "cylinder_surface, radius: 2, height: 1, frame: { origin: [0, 0, 3] } }, to_edge: v_min",
       [](const J& u, const J& v) {
         const J w2 = v * v, w3 = w2 * v, a1 = 3.0 * w2 - 2.0 * w3, b = v - 3.0 * w2 + 2.0 * w3;
         const J angle = 2.0 * kPi113 * u, far = 1.0 + a1;
         return Point{far * cos(angle), far * sin(angle), 1.0 + 2.0 * a1 + sqrt(Quad(5)) * b};
       },
       square},
      {"transfinite_triangle",
       "of: [" + graph("0*t, t, t*(1 - t)*exp(t)") + ", " + graph("1 - t, 0, sin(t)*(1 - t)") + ", " +
           graph("t, 1 - t, t - t^2") + "]",
       [](const J& u, const J& v) {
         const J a = u, b = (1.0 - u) * v, c = (1.0 - u) * (1.0 - v);
         const auto c1 = [](const J& t) { return Point{J(0), t, t * (1.0 - t) * exp(t)}; };
         const auto c2 = [](const J& t) { return Point{1.0 - t, J(0), sin(t) * (1.0 - t)}; };
         const auto c3 = [](const J& t) { return Point{t, 1.0 - t, t - t * t}; };
         return a * (c3(1.0 - b) + c2(c) - Point{J(1), J(0), J(0)}) +
                b * (c1(1.0 - c) + c3(a) - Point{J(0), J(1), J(0)}) + c * (c2(1.0 - a) + c1(b));
       },
       square},
      {"line_surface",
       "of: " + graph("t, exp(t), sin(t)") + ", directions: " + graph("cos(t), 1, t^2") + ", range: [-1, 2]",
       [](const J& u, const J& v) {
         return Point{u, exp(u), sin(u)} + v * Point{cos(u), J(1), u * u};
       },
       {{0, 1}, {-1, 2}}},
      // Parabolas whose tangents are parallel at t and t/2.
      {"developable_surface",
       "of: [{ type: formula_curve, point: [t, t^2, 0], domain: [-1, 1] }, { type: formula_curve, point: [t, 2*t^2, "
       "1], "
       "domain: [-1, 1] }]",
       [](const J& u, const J& v) {
         return mix(v, Point{u, u * u, J(0)}, Point{u / 2.0, u * u / 2.0, J(1)});
       },
       {{-1, 1}, {0, 1}},
       kByPolynomials},
      // A sector: radii and angle from the cone's slant height.
      {"development",
       "of: { type: cone_surface, radius: 1, top_radius: 0.4, height: 2 }",
       [](const J& u, const J& v) {
         const Quad less = Quad(1) - Quad(0.4), slant = sqrt(less * less + 4.0), apex = slant / less;
         const J far = apex - slant * v, angle = less / slant * u;
         return Point{far * sin(angle), apex - slant / 2.0 - far * cos(angle), J(0)};
       },
       {{0, geometry::kTwoPi}, {0, 1}},
       kByPolynomials},
  };
}

inline std::vector<Reference> references_on_surfaces() {
  const Rectangle square{{0, 1}, {0, 1}};
  const std::string of = std::string("of: ") + kHill;
  return {
      {"formula_surface",
       "point: ['(2 + cos(v))*cos(u)', '(2 + cos(v))*sin(u)', sin(v) + 0.3*sin(3*u)], domain: { u: [0, 6], v: [0, 6] }",
       [](const J& u, const J& v) {
         return Point{(2.0 + cos(v)) * cos(u), (2.0 + cos(v)) * sin(u), sin(v) + 0.3 * sin(3.0 * u)};
       },
       {{0, 6}, {0, 6}}},
      {"coordinate_surface",
       "point: [u*cos(v)*sin(w), u*sin(v)*sin(w), 1.3*u*cos(w)], hold: u, at: 1.2, domain: { u: [0.2, 2], v: [0.5, "
       "2.5] "
       "}",
       [](const J& u, const J& v) {
         return 1.2 * Point{cos(u) * sin(v), sin(u) * sin(v), 1.3 * cos(v)};
       },
       {{0.2, 2}, {0.5, 2.5}}},
      {"offset_surface", of + ", distance: 0.1 + 0.05*u*v",
       [](const J& u, const J& v) { return hill(u, v) + (0.1 + 0.05 * u * v) * hill_normal(u, v); }, square},
      // Behind a corner of its base, and behind an edge.
      {"extended_surface",
       of + ", mode: tangent, before: 0.5, after: 1",
       [](const J& u, const J& v) {
         const J p = u - 1.0, q = v - 1.0, one(1);
         return Point{u, v,
                      hill(one, one).z + p * hill_u(one, one).z + q * hill_v(one, one).z - p * q * cos(one) * sin(one)};
       },
       {{1.01, 2}, {1.01, 2}}},
      {"extended_surface",
       of + ", mode: tangent, before: 0.5, after: 1",
       [](const J& u, const J& v) {
         const J one(1);
         return Point{u, v, hill(one, v).z + (u - 1.0) * hill_u(one, v).z};
       },
       {{1.01, 2}, {0, 0.99}}},
      {"deformed_surface", of + ", degree: 2, count: 3, moves: { at: [1, 1], height: 0.5 }",
       [](const J& u, const J& v) { return hill(u, v) + (2.0 * u * (1.0 - u) * v * (1.0 - v)) * hill_normal(u, v); },
       square},
      {"mid_surface",
       of + ", share: 0.25, to: { type: formula_surface, point: [u, v, 2 + u*v], domain: { u: [0, 2], v: [0, 3] } }",
       [](const J& u, const J& v) {
         return 0.75 * hill(u, v) + 0.25 * Point{2.0 * u, 3.0 * v, 2.0 + 6.0 * u * v};
       },
       square},
      {"reparametrized_surface",
       of + ", swap: true, domain: { u: [0, 1], v: [0, 1] }, u: w^2, v: sin(pi/2*w)",
       [](const J& u, const J& v) { return hill(v * v, sin(kPi113 / 2.0 * u)); },
       {{0.01, 1}, {0, 0.99}}},
      {"extrusion_surface", "of: " + graph("t, exp(t), sin(t)") + ", along: [0, 1, 3]",
       [](const J& u, const J& v) {
         return Point{u, exp(u) + v, sin(u) + 3.0 * v};
       },
       square},
      {"revolution_surface",
       "of: " + graph("1 + t, 0, sin(t)") + ", axis: z",
       [](const J& u, const J& v) {
         return Point{(1.0 + u) * cos(v), (1.0 + u) * sin(v), sin(u)};
       },
       {{0, 1}, {0, geometry::kTwoPi}}},
  };
}

inline std::vector<Reference> references() {
  std::vector<Reference> all = references_of_sweeps();
  for (const auto& more : {references_of_nets(), references_on_surfaces()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace lekalo::render::every_surface
