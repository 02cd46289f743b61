// Subjects without rational pieces, and closed bodies: formulas, implicit surfaces, tubes, balls, CSG, bodies.
#pragma once

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/shapes/implicit/implicit_surface.h"
#include "geometry/shapes/tube/balls.h"
#include "geometry/shapes/tube/tube.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "render/completeness/patch_entries.h"
#include "render/every_surface/examples.h"
#include "support/interpolated_patches.h"
#include "support/sweep_oracle.h"

namespace lekalo::render::completeness {

// -------------------------------------------------------------------------------- formulas

// A surface that lies near the origin, moved by its object's transform; its seams, poles and edges are those of the
// domain.
inline Subject moved_subject(const SurfacePtr& surface, const Vec3& offset, const Truth& truth) {
  Subject subject;
  subject.entity = surface;
  subject.transform = Affine::translation(offset);
  subject.box = transformed(bounds(*surface), subject.transform);
  subject.truth = moved(offset, truth);
  subject.special = [=, at_origin = borders_of({surface})](Random& random) {
    const auto [first, second] = at_origin(random);
    return std::pair(first + offset, second + offset);
  };
  return subject;
}

inline Subject formula_subject(const std::array<std::string, 3>& point, const Rectangle& domain,
                               FormulaSurface::Closed closing, const Vec3& offset, const Truth& truth) {
  return moved_subject(std::make_shared<FormulaSurface>(point_formulas(point, {"u", "v"}), domain, closing), offset,
                       truth);
}

// F of x, y, z for the sign oracle, over Interval and Quad.
struct TorusSigns {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T s = x * x + y * y + z * z + T(3.51);  // R = 2, r = 0.7: R^2 - r^2
    return s * s - T(16.0) * (x * x + y * y);
  }
};
struct WavesSigns {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return z - T(0.4) * sin(T(3.0) * x) * exp(-(y * y)) - T(0.1) * cos(T(5.0) * y);
  }
};

inline std::vector<Entry> formula_entries() {
  const auto polynomial = [](const std::string& name, const std::array<std::string, 3>& point, int p, int q,
                             const Rectangle& domain, const std::function<Vec3(double, double)>& at) {
    return Entry{name, [=](const Vec3& offset) {
                   const SurfacePtr patch = tests::interpolated(p, q, domain, at);
                   return formula_subject(point, domain, {}, offset, truth_of({patch}, bounds(*patch).diameter()));
                 }};
  };
  return {
      {"formula_torus",
       [](const Vec3& offset) {
         return formula_subject({"(2 + 0.7*cos(v))*cos(u)", "(2 + 0.7*cos(v))*sin(u)", "0.7*sin(v)"},
                                {{0, kTwoPi}, {-kPi, kPi}}, {true, true}, offset,
                                truth_of_signs<TorusSigns>({Vec3(-2.8, -2.8, -0.8), Vec3(2.8, 2.8, 0.8)}, false));
       },
       true},
      polynomial("formula_enneper", {"u - u^3/3 + u*v^2", "v - v^3/3 + v*u^2", "u^2 - v^2"}, 3, 3,
                 {{-1.8, 1.8}, {-1.8, 1.8}},
                 [](double u, double v) {
                   return Vec3(u - u * u * u / 3 + u * v * v, v - v * v * v / 3 + v * u * u, u * u - v * v);
                 }),
      polynomial("formula_ruled_cubic", {"u*v", "u", "v^2 + u"}, 1, 2, {{0.2, 1}, {-1, 1}},
                 [](double u, double v) { return Vec3(u * v, u, v * v + u); }),
      // Whitney's umbrella: through itself along a ray, a pinch point at its end.
      polynomial("formula_umbrella", {"u*v", "u", "v^2"}, 1, 2, {{-1.2, 1.2}, {-1.2, 1.2}},
                 [](double u, double v) { return Vec3(u * v, u, v * v); }),
      {"formula_waves",
       [](const Vec3& offset) {
         return formula_subject({"u", "v", "0.4*sin(3*u)*exp(-v^2) + 0.1*cos(5*v)"}, {{-1.5, 1.5}, {-1.5, 1.5}}, {},
                                offset,
                                truth_of_signs<WavesSigns>({Vec3(-1.5, -1.5, -0.75), Vec3(1.5, 1.5, 0.75)}, false));
       }},
  };
}

// -------------------------------------------------------------------------------- surfaces made of others

// As a scene makes them of curves and surfaces without rational forms, each beside an oracle of what it is.
inline std::vector<Entry> composed_entries() {
  const auto torus = [](const std::string& name, const std::string& fields) {
    return Entry{name,
                 [=](const Vec3& offset) {
                   return moved_subject(
                       every_surface::surface_of(fields), offset,
                       truth_of_signs<TorusSigns>({Vec3(-2.8, -2.8, -0.8), Vec3(2.8, 2.8, 0.8)}, false));
                 },
                 true};
  };
  const auto polynomial = [](const std::string& name, const std::string& fields, int p, int q, const Rectangle& domain,
                             const std::function<Vec3(double, double)>& at) {
    return Entry{name, [=](const Vec3& offset) {
                   const SurfacePtr patch = tests::interpolated(p, q, domain, at);
                   return moved_subject(every_surface::surface_of(fields), offset,
                                        truth_of({patch}, bounds(*patch).diameter()));
                 }};
  };
  const auto graph = [](const std::string& point) {
    return "{ type: formula_curve, point: [" + point + "], domain: [0, 1] }";
  };
  return {
      torus("sweep_along_a_circle",
            "{ type: sweep_surface, path: { type: circle, radius: 2 }, section: { type: circle, radius: 0.7 } }"),
      torus("mid_surface_of_tori",
            "{ type: mid_surface, of: { type: torus_surface, major_radius: 2, minor_radius: 0.5 }, to: { type: "
            "torus_surface, major_radius: 2, minor_radius: 0.9 } }"),
      torus("toroid", "{ type: vintoid, preset: toroid, a: 2, b: 0.7, c: 0.7 }"),
      torus(
          "offset_of_a_formula",
          "{ type: offset_surface, distance: 0.2, of: { type: formula_surface, domain: { u: [0, 2*pi], v: [0, 2*pi] }, "
          "closed: true, point: [(2 + 0.5*cos(v))*cos(u), (2 + 0.5*cos(v))*sin(u), 0.5*sin(v)] } }"),
      polynomial("coons_of_formulas",
                 "{ type: coons_surface, u_lines: [" + graph("t, 0, 4*t*(1 - t)") + ", " + graph("t, 1, 4*t^2") +
                     "], v_lines: [" + graph("0, t, 0") + ", " + graph("1, t, 4*t") + "] }",
                 2, 1, {{0, 1}, {0, 1}},
                 [](double u, double v) { return Vec3(u, v, 4 * ((1 - v) * u * (1 - u) + v * u * u)); }),
      polynomial("loft_of_formulas",
                 "{ type: loft_surface, method: lagrange, at_v: [0, 1, 2], of: [" + graph("2*t, 0, 3*t - 3*t^2") +
                     ", " + graph("2*t, 1, 4.5*t^2 - 0.6") + ", " + graph("2*t, 2, 0.9 + 3*t") + "] }",
                 2, 2, {{0, 1}, {0, 2}},
                 [](double u, double v) {
                   const double l0 = (v - 1) * (v - 2) / 2, l1 = v * (2 - v), l2 = v * (v - 1) / 2;
                   return Vec3(2 * u, v, 3 * (l0 * (u - u * u) + l1 * (1.5 * u * u - 0.2) + l2 * (0.3 + u)));
                 }),
      polynomial(
          "extended_formula",
          "{ type: extended_surface, mode: tangent, before: 0.5, after: 1, of: { type: formula_surface, point: [u, "
          "v, 2*u*v], domain: { u: [0, 1], v: [0, 1] } } }",
          1, 1, {{-0.5, 2}, {-0.5, 2}}, [](double u, double v) { return Vec3(u, v, 2 * u * v); }),
      polynomial("deformed_formula",
                 "{ type: deformed_surface, degree: 2, count: 3, moves: { at: [1, 1], height: 3 }, of: { type: "
                 "formula_surface, point: [u, v, 0*u], domain: { u: [0, 1], v: [0, 1] } } }",
                 2, 2, {{0, 1}, {0, 1}}, [](double u, double v) { return Vec3(u, v, 12 * u * (1 - u) * v * (1 - v)); }),
      {"fillet_with_even_sections",
       [](const Vec3& offset) {
         const SurfacePtr part = every_surface::surface_of(
             "{ type: torus_surface, major_radius: 1.4, minor_radius: 0.4, frame: { origin: [0, 0, 0.4] }, domain: { "
             "u: "
             "[0, 2*pi], v: [-pi, -pi/2] } }");
         return moved_subject(
             every_surface::surface_of(
                 "{ type: fillet_surface, even: true, radius: 0.4, of: [{ type: plane, size: [8, 8] }, { "
                 "type: cylinder_surface, radius: 1, height: 2 }] }"),
             offset, truth_of({part}, bounds(*part).diameter()));
       }},
      // Weights that are one function of u change nothing.
      polynomial("loft_with_weights",
                 "{ type: loft_surface, method: bezier, weight_functions: [2 + u, 2 + u, 2 + u], of: [" +
                     graph("2*t, 0, 3*t - 3*t^2") + ", " + graph("2*t, 1, 4.5*t^2 - 0.6") + ", " +
                     graph("2*t, 2, 0.9 + 3*t") + "] }",
                 2, 2, {{0, 1}, {0, 1}},
                 [](double u, double v) {
                   const double b0 = (1 - v) * (1 - v), b1 = 2 * v * (1 - v), b2 = v * v;
                   return Vec3(2 * u, b1 + 2 * b2, 3 * (b0 * (u - u * u) + b1 * (1.5 * u * u - 0.2) + b2 * (0.3 + u)));
                 }),
      // Over parabolas z = ab + bc + ca + 3abc, with a pole.
      polynomial("triangle_on_formulas",
                 "{ type: transfinite_triangle, of: [" + graph("0*sin(t), t, t*(1 - t)") + ", " +
                     graph("1 - t, 0, t*(1 - t)") + ", " + graph("t, 1 - t, t*(1 - t)") + "] }",
                 3, 2, {{0, 1}, {0, 1}},
                 [](double u, double v) {
                   const double b = (1 - u) * v, c = (1 - u) * (1 - v);
                   return Vec3(u, b, u * b + b * c + c * u + 3 * u * b * c);
                 }),
  };
}

// -------------------------------------------------------------------------------- implicit surfaces

struct BarthSigns {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T a(2.618033988749895), b(4.23606797749979), one(1.0);
    const T xx = x * x, yy = y * y, zz = z * z, r = xx + yy + zz - one;
    return T(4.0) * (a * xx - yy) * (a * yy - zz) * (a * zz - xx) - b * r * r;
  }
};
struct GyroidSigns {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
  }
};
struct HeartSigns {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T a = x * x + T(2.25) * y * y + z * z - T(1.0);
    return a * a * a - (x * x + T(0.1125) * y * y) * z * z * z;
  }
};

template <class F>
Entry implicit_entry(const std::string& name, const std::string& formula, const Vec3& half, bool is_closed) {
  return {name,
          [=](const Vec3& offset) {
            Expression f = std::get<Expression>(Expression::parse(formula));
            const std::vector<Expression::Variable> variables{{"x"}, {"y"}, {"z"}};
            if (const auto error = f.bind(variables)) throw std::invalid_argument(error->message);
            const Box3 box{-half, half};
            return subject_of(std::make_shared<ImplicitSurface>(f, 0.0, ImplicitRegion{box}, is_closed), offset,
                              truth_of_signs<F>(box, is_closed));
          },
          is_closed};
}

inline std::vector<Entry> implicit_entries() {
  const std::string torus = "(x^2 + y^2 + z^2 + 3.51)^2 - 16*(x^2 + y^2)";
  return {
      implicit_entry<TorusSigns>("implicit_torus", torus, Vec3(3, 3, 1), true),
      implicit_entry<TorusSigns>("implicit_torus_by_cells", torus + " + 0*sin(x)", Vec3(3, 3, 1), true),
      implicit_entry<BarthSigns>("implicit_barth_sextic",
                                 "4*(2.618033988749895*x^2 - y^2)*(2.618033988749895*y^2 - z^2)"
                                 "*(2.618033988749895*z^2 - x^2) - 4.23606797749979*(x^2 + y^2 + z^2 - 1)^2",
                                 Vec3(2), true),
      implicit_entry<GyroidSigns>("implicit_gyroid", "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)", Vec3(4), false),
      implicit_entry<HeartSigns>("implicit_heart", "(x^2 + 2.25*y^2 + z^2 - 1)^3 - (x^2 + 0.1125*y^2)*z^3",
                                 Vec3(1.5, 1, 1.5), true)};
}

// -------------------------------------------------------------------------------- tubes and balls

inline Subject tube_subject(const CurvePtr& curve, double radius, const Vec3& offset,
                            const std::function<oracle::SweptBall(long double)>& ball, std::vector<double> breaks) {
  const auto tube = std::make_shared<Tube>(curve, RadiusLaw(radius), Caps::round);
  const Box3 box = tube->bounds();
  const auto sweep = std::make_shared<oracle::SweepOracle>(ball, std::move(breaks), 200);
  const Truth about_center = moved(box.center(), [=](const Line& line, bool&) {
    const double size = box.diameter();
    if (glm::length(line.origin) > 0.6 * size) return std::vector<double>();
    const Line at{line.origin + box.center(), line.direction};
    return sweep->crossings(at, -0.6 * size, 0.6 * size, size);
  });
  return subject_of(tube, offset, about_center);
}

inline std::vector<Entry> sweep_entries() {
  return {
      {"tube_helix",
       [](const Vec3& offset) {
         const CurvePtr curve = std::make_shared<FormulaCurve>(point_formulas({"cos(t)", "sin(t)", "0.2*t"}, {"t"}),
                                                               Interval{0, 6}, false);
         return tube_subject(curve, 0.2, offset,
                             [](long double t) {
                               return oracle::SweptBall{std::cos(t), std::sin(t), 0.2L * t, 0.2L};
                             },
                             {0, 6});
       },
       true},
      {"balls",
       [](const Vec3& offset) {
         Random random(70);
         std::vector<Vec3> centers;
         std::vector<double> radii;
         std::vector<oracle::Solid> solids;
         for (int k = 0; k < 20; ++k) {
           const double x = unit(random), y = unit(random);
           centers.emplace_back(x, y, unit(random));
           radii.push_back(0.05 + 0.2 * unit(random));
           solids.push_back(oracle::Solid::ball(centers.back(), radii.back()));
         }
         const auto solid = oracle::Solid::of(oracle::Solid::Kind::unite, solids);
         return subject_of(std::make_shared<Balls>(centers, radii), offset,
                           [=](const Line& line, bool& undecided) { return solid.crossings(line, 1e-9, undecided); });
       },
       true},
  };
}

// -------------------------------------------------------------------------------- CSG and bodies

// The product's shape of an oracle's solid.
inline ShapePtr shape_of(const oracle::Solid& solid) {
  using Kind = oracle::Solid::Kind;
  const auto of_body = [](Body body) -> ShapePtr {
    return std::make_shared<BodyShape>(std::make_shared<Body>(std::move(body)));
  };
  Csg::Operation operation = Csg::Operation::unite;
  switch (solid.kind) {
    case Kind::ball:
      return of_body(ball(Frame{solid.a}, solid.radius));
    case Kind::box:
      return of_body(box(Frame{solid.a}, solid.b - solid.a));
    case Kind::half_space:
      return std::make_shared<HalfSpaceShape>(solid.a, solid.b);
    case Kind::unite:
      break;
    case Kind::intersect:
      operation = Csg::Operation::intersect;
      break;
    case Kind::subtract:
      operation = Csg::Operation::subtract;
      break;
  }
  std::vector<ShapePtr> operands;
  for (const oracle::Solid& one : solid.operands) operands.push_back(shape_of(one));
  return std::make_shared<Csg>(operation, operands);
}

inline Entry csg_entry(const std::string& name, const oracle::Solid& solid) {
  return {name, [=](const Vec3& offset) {
            const ShapePtr shape = shape_of(solid);
            const double size = shape->bounds().diameter();
            return subject_of(shape, offset, [=](const Line& line, bool& undecided) {
              return solid.crossings(line, 1e-9 * size, undecided);
            });
          }};
}

// A body moved by its own coordinates, or by its object's transform.
inline Subject body_subject(const Body& body, const Vec3& offset, const Truth& truth) {
  const auto placed = std::make_shared<const Body>(body);
  Subject subject;
  subject.entity = BodyPtr(placed);
  subject.transform = Affine::translation(offset);
  subject.box = transformed(bounds(body), subject.transform);
  subject.truth = moved(offset, truth);
  subject.special = [=](Random& random) {
    const Edge& edge = placed->edges[static_cast<size_t>(unit(random) * placed->edges.size())];
    const Interval range = edge.curve->domain();
    const double t = unit(random) < 0.2 ? range.lo : range.lo + unit(random) * range.width();
    const Vec3 place = edge.curve->point(t) + offset;
    return std::pair(place, edge.curve->point(range.lo + unit(random) * range.width()) + offset);
  };
  return subject;
}

inline std::vector<Entry> solid_entries() {
  using oracle::Solid;
  using Kind = Solid::Kind;
  const Solid die =
      Solid::of(Kind::subtract, {Solid::of(Kind::intersect, {Solid::box(Vec3(-1), Vec3(1)), Solid::ball(Vec3(0), 1.4)}),
                                 Solid::ball({0, 0, 1.1}, 0.3), Solid::ball({1.1, 0.4, 0.4}, 0.25),
                                 Solid::ball({1.1, -0.4, -0.4}, 0.25), Solid::ball({0.3, -1.05, 0.2}, 0.4)});
  std::vector<Entry> entries{
      csg_entry("csg_lens", Solid::of(Kind::intersect, {Solid::ball({0, 0, 0.8}, 1), Solid::ball({0, 0, -0.8}, 1)})),
      csg_entry("csg_die", die),
      csg_entry(
          "csg_tree",
          Solid::of(Kind::unite,
                    {Solid::of(Kind::subtract, {Solid::box({-1.2, -0.5, -0.4}, {1.1, 0.6, 0.5}), die}),
                     Solid::of(Kind::intersect, {Solid::ball({0.2, 0.1, 1.5}, 0.8),
                                                 Solid::half_space({0, 0, 1.6}, glm::normalize(Vec3(1, 2, 3)))})})),
      {"body_box", [](const Vec3& offset) {
         const Solid solid = Solid::box({-0.4, 0.1, 0.2}, {0.6, 2.1, 3.2});
         return body_subject(box(Frame{{-0.4, 0.1, 0.2}}, {1, 2, 3}), offset,
                             [=](const Line& line, bool& undecided) { return solid.crossings(line, 1e-9, undecided); });
       }}};
  // Convex, so an intersection of half-spaces.
  const std::vector<Vec2> base{{0, 0}, {2, 0}, {2.5, 1}, {1, 2}, {-0.5, 1}};
  std::vector<Solid> walls{Solid::half_space({0, 0, 0}, {0, 0, -1}), Solid::half_space({0, 0, 2}, {0, 0, 1})};
  for (size_t k = 0; k < base.size(); ++k) {
    const Vec2 a = base[k], d = base[(k + 1) % base.size()] - a;
    walls.push_back(Solid::half_space({a.x, a.y, 0}, glm::normalize(Vec3(d.y, -d.x, 0))));
  }
  entries.push_back({"body_prism", [=](const Vec3& offset) {
                       const Solid solid = Solid::of(Kind::intersect, walls);
                       return body_subject(prism(Frame(), base, 2), offset, [=](const Line& line, bool& undecided) {
                         return solid.crossings(line, 1e-9, undecided);
                       });
                     }});
  for (Entry& entry : entries) entry.closed = true;
  return entries;
}

// Closed subjects for which only the number of crossings is asked.
inline std::vector<Entry> closed_entries() {
  const auto body = [](const std::string& name, const Body& made) {
    return Entry{name, [=](const Vec3& offset) { return body_subject(made, offset, {}); }};
  };
  const auto tube = [](const std::string& name, const CurvePtr& curve, double radius, Caps caps) {
    return Entry{name, [=](const Vec3& offset) {
                   return subject_of(std::make_shared<Tube>(curve, RadiusLaw(radius), caps), offset, {});
                 }};
  };
  const Frame frame = frame_at(Vec3(0));
  const std::vector<Vec3> tight{{0, 0, 0}, {2, 0.2, 0.3}, {-1, 0.4, 0.1}, {1, 0.7, 0}};
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0.1, 0}, {0.1, 0.2, 0.1}, {0.5, 1, 0.9}, {0.5, 0.9, -0.4}};
  return {body("ball", ball(frame, 1.5)),
          body("cylinder", cylinder_body(frame, 1, 2)),
          body("cone", frustum(frame, 2, 0, 3)),
          body("frustum", frustum(frame, 2, 1, 3)),
          body("torus", torus_body(frame, 3, 1)),
          body("wedge", wedge(frame, {3, 2, 1.5}, 1)),
          body("pyramid", pyramid(frame, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0, 0, 2})),
          tube("tube_with_flat_ends", std::make_shared<NurbsCurve>(bezier_curve(tight)), 0.2, Caps::flat),
          tube("tube_along_corners", std::make_shared<NurbsCurve>(polyline(corners)), 0.07, Caps::round)};
}

}  // namespace lekalo::render::completeness
