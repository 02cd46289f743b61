// Subjects with rational pieces: Bezier patches of all kinds, NURBS surfaces, swept and elementary surfaces.
#pragma once

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/ellipsoid.h"
#include "geometry/surfaces/analytic/hyperboloid.h"
#include "geometry/surfaces/analytic/paraboloid.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/splines/patches.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "render/completeness/subject.h"

namespace lekalo::render::completeness {

// A control point in space and its weight, for the shares of the net.
using ControlPoint = std::function<Vec4(double s, double t, Random& random)>;

inline NurbsSurfaceForm patch_form(int p, int q, unsigned seed, const ControlPoint& at) {
  Random random(seed);
  NurbsSurfaceForm form;
  form.degree_u = p;
  form.degree_v = q;
  form.knots_u.assign(2 * (p + 1), 0.0);
  form.knots_v.assign(2 * (q + 1), 0.0);
  std::fill(form.knots_u.begin() + p + 1, form.knots_u.end(), 1.0);
  std::fill(form.knots_v.begin() + q + 1, form.knots_v.end(), 1.0);
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Vec4 c = at(i / double(p), j / double(q), random);
      form.points.push_back(Vec4(c.w * Vec3(c), c.w));
    }
  return form;
}

inline SurfacePtr placed(NurbsSurfaceForm form, const Vec3& offset) {
  for (Vec4& c : form.points) c += Vec4(c.w * offset, 0);
  return std::make_shared<NurbsSurface>(form);
}

inline Entry patch(const std::string& name, int p, int q, unsigned seed, const ControlPoint& at) {
  return {name, [=](const Vec3& offset) { return subject_of(SurfaceSet{placed(patch_form(p, q, seed, at), offset)}); }};
}

// Where weights differ by six decades the oracle's plane equations lose digits, and points move by up to 1e3 sizes a
// parameter, so that the solver's slack at borders (kBorderSlack of a cell) is up to 1e-8 of the size.
inline Entry with_extreme_weights(const Entry& entry) {
  return {entry.name, [=](const Vec3& offset) {
            Subject subject = entry.make(offset);
            subject.same = 1e-6;
            subject.band = 1e-8;
            return subject;
          }};
}

// A bumpy height field over the unit square; `spread` is the ratio of the largest to the smallest weight.
inline ControlPoint bumpy(double spread = 1, double size = 1) {
  return [=](double s, double t, Random& random) {
    const double w = std::pow(spread, unit(random) - 0.5);
    const double x = s + 0.3 * (unit(random) - 0.5), y = t + 0.3 * (unit(random) - 0.5);
    return Vec4(size * Vec3(x, y, unit(random)), w);
  };
}

// With the points of which `pole` is 1 or 2 moved to one place each.
inline ControlPoint with_poles(const ControlPoint& at, const std::function<int(double s, double t)>& pole) {
  return [=](double s, double t, Random& random) {
    const Vec4 c = at(s, t, random);
    const Vec3 places[] = {{0.1, 0.5, 0.4}, {0.9, 0.4, 0.7}};
    const int k = pole(s, t);
    return k == 0 ? c : Vec4(places[k - 1], c.w);
  };
}

// Spread along z times `factor`.
inline ControlPoint flattened(const ControlPoint& at, double factor) {
  return [=](double s, double t, Random& random) {
    Vec4 c = at(s, t, random);
    c.z *= factor;
    return c;
  };
}

// Anywhere in the cube: it goes through itself.
inline ControlPoint anywhere(double spread = 1) {
  return [=](double, double, Random& random) {
    const double w = std::pow(spread, unit(random) - 0.5), x = unit(random), y = unit(random);
    return Vec4(x, y, unit(random), w);
  };
}

inline std::vector<Entry> bezier_entries() {
  std::vector<Entry> entries;
  for (int p = 1; p <= 7; ++p)
    entries.push_back(patch(fmt::format("bezier_{}_{}", p, 8 - p), p, 8 - p, 10 + p, bumpy()));
  for (int p = 1; p <= 7; ++p) entries.push_back(patch(fmt::format("rational_{}_{}", p, p), p, p, 20 + p, bumpy(10)));
  const std::pair<int, int> degrees[] = {{2, 3}, {3, 3}, {5, 1}, {7, 4}};
  for (const auto& [p, q] : degrees)
    entries.push_back(with_extreme_weights(patch(fmt::format("weights_1e6_{}_{}", p, q), p, q, 30 + p, bumpy(1e6))));
  entries.push_back(patch("heavy_corner", 3, 4, 40, [](double s, double t, Random& random) {
    const Vec4 c = bumpy()(s, t, random);
    return Vec4(Vec3(c), s == 1 && t == 0 ? 1e3 : 1);
  }));
  // The longer arcs of conics in one direction: out of the hull of the control points with positive weights.
  entries.push_back(patch("negative_weights", 2, 3, 71, [](double s, double t, Random& random) {
    const Vec4 c = bumpy()(s, t, random);
    return Vec4(Vec3(c), s == 0.5 ? -0.4 : 1);
  }));
  const auto first = [](double s, double) { return s == 0 ? 1 : 0; };
  const auto both = [](double s, double) { return s == 0 ? 1 : s == 1 ? 2 : 0; };
  const auto corner = [](double s, double t) { return s == 0 || t == 0 ? 1 : 0; };
  entries.push_back(patch("collapsed_edge", 3, 3, 41, with_poles(bumpy(), first)));
  entries.push_back(patch("two_collapsed_edges", 5, 3, 42, with_poles(bumpy(), both)));
  entries.push_back(patch("two_edges_in_one_point", 4, 4, 43, with_poles(bumpy(), corner)));
  entries.push_back(patch("rational_collapsed_edge", 2, 6, 44, with_poles(bumpy(1e3), first)));
  entries.push_back(patch("near_flat_1e-3", 3, 2, 45, flattened(bumpy(), 1e-3)));
  entries.push_back(patch("near_flat_1e-9", 3, 3, 46, flattened(bumpy(), 1e-9)));
  entries.push_back(patch("flat_rational", 3, 3, 47, flattened(bumpy(3), 0)));
  entries.push_back(patch("folded_1e-6_thick", 3, 3, 48, flattened(anywhere(), 1e-6)));
  entries.push_back(patch("through_itself_3_3", 3, 3, 49, anywhere()));
  entries.push_back(patch("through_itself_6_5", 6, 5, 50, anywhere(10)));
  entries.push_back(patch("size_1e-6", 4, 2, 51, bumpy(5, 1e-6)));
  entries.push_back(patch("size_1e6", 2, 5, 52, bumpy(5, 1e6)));
  entries.push_back(patch("sliver", 3, 3, 53, [](double s, double t, Random& random) {
    const Vec4 c = bumpy(3)(s, t, random);
    return Vec4(c.x, 1e-6 * c.y, c.z, c.w);
  }));
  // Rows of control points that coincide: derivatives vanish inside and on the border.
  entries.push_back(patch("cusps", 5, 4, 54, [](double s, double t, Random& random) {
    const Vec4 c = bumpy()(s, t, random);
    return Vec4(s > 0.1 && s < 0.9 ? 0.5 : s, t < 0.4 ? 0 : c.y, s > 0.1 && s < 0.5 ? 0.2 : c.z, c.w);
  }));
  return entries;
}

inline Frame frame_at(const Vec3& offset) {
  return frame_from(offset + Vec3(0.1, 0.2, -0.3), {0.2, -0.3, 0.9}, {1, 0.1, 0});
}

// The surface's NURBS form.
inline SurfacePtr as_spline(const Surface& surface, const Vec3& offset) { return placed(*surface.as_nurbs(), offset); }

inline Subject nurbs_with_creases(const Vec3& offset) {
  Random random(60);
  NurbsSurfaceForm form;
  form.degree_u = 3;
  form.degree_v = 2;
  form.knots_u = {0, 0, 0, 0, 1, 1, 1, 2, 3, 3, 3, 3};
  form.knots_v = {0, 0, 0, 0.3, 0.3, 1, 1, 1};
  for (int i = 0; i < form.count_u(); ++i)
    for (int j = 0; j < form.count_v(); ++j) {
      const double w = std::pow(10, unit(random) - 0.5), x = i / 7.0 + 0.1 * unit(random);
      form.points.push_back(Vec4(w * Vec3(x, j / 4.0, 0.6 * unit(random)), w));
    }
  return subject_of(SurfaceSet{placed(form, offset)});
}

// A tube around a ring, closed in both directions.
inline Subject periodic_nurbs(const Vec3& offset) {
  Random random(61);
  const int m = 7, n = 6;
  std::vector<Vec3> points;
  std::vector<double> weights;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = kTwoPi * i / m, b = kTwoPi * j / n, r = 0.5 + 0.3 * unit(random);
      points.push_back(offset +
                       Vec3((2 + r * std::cos(b)) * std::cos(a), (2 + r * std::cos(b)) * std::sin(a), r * std::sin(b)));
      weights.push_back(0.5 + unit(random));
    }
  const auto axis = [](int degree, int count) {
    return SplineAxis(degree, knots_by_rule("uniform", degree, count, true, {}), Extension::periodic);
  };
  return subject_of(SurfaceSet{std::make_shared<NurbsSurface>(axis(3, m), axis(2, n), points, weights)});
}

inline Subject teapot(const Vec3& offset) {
  std::ifstream file(LEKALO_SOURCE_DIR "/scenes/data/newell_teapot.txt");
  std::stringstream text;
  text << file.rdbuf();
  SurfaceSet patches;
  for (const SurfacePtr& one : parse_patches(text.str())) patches.push_back(as_spline(*one, offset));
  return subject_of(patches);
}

inline CurvePtr wavy_curve(const Vec3& offset) {
  std::vector<Vec3> points{{0, 0, 0}, {1.2, 0.1, 0.2}, {-0.4, 0.3, 0.9}, {0.9, 0, 1}, {0.5, -0.2, 1.6}};
  for (Vec3& p : points) p += offset;
  const double weights[] = {1, 2, 0.5, 1, 1};
  return std::make_shared<NurbsCurve>(bezier_curve(points, weights));
}

// Closed: the curve begins and ends on the axis.
inline Subject spindle(const Vec3& offset) {
  std::vector<Vec3> points{{0, 0, -1}, {0.9, 0, -1}, {0.1, 0, 0.1}, {1.2, 0, 0.6}, {0, 0, 1}};
  for (Vec3& p : points) p += offset;
  return subject_of(SurfaceSet{std::make_shared<RevolutionSurface>(std::make_shared<NurbsCurve>(bezier_curve(points)),
                                                                   Axis{offset, {0, 0, 1}})});
}

// One surface of a closed form, in the frame.
template <class Make>
Entry formula_entry(const std::string& name, bool is_closed, const Make& make) {
  return {name, [=](const Vec3& offset) { return subject_of(SurfaceSet{make(frame_at(offset))}); }, is_closed};
}

inline std::vector<Entry> surface_entries() {
  std::vector<Entry> entries{{"nurbs_with_creases", nurbs_with_creases},
                             {"periodic_nurbs", periodic_nurbs, true},
                             {"teapot", teapot},
                             {"spindle", spindle, true}};
  const auto add = [&](const Entry& entry) { entries.push_back(entry); };
  add({"nurbs_sphere",
       [](const Vec3& offset) {
         return subject_of(SurfaceSet{as_spline(SphereSurface(frame_at(Vec3(0)), 1.3), offset)});
       },
       true});
  add({"nurbs_torus",
       [](const Vec3& offset) {
         return subject_of(SurfaceSet{as_spline(TorusSurface(frame_at(Vec3(0)), 3, 1), offset)});
       },
       true});
  add({"extrusion", [](const Vec3& offset) {
         return subject_of(SurfaceSet{std::make_shared<ExtrusionSurface>(wavy_curve(offset), Vec3(0.3, 1.5, -0.2))});
       }});
  add({"revolution_of_half_a_turn", [](const Vec3& offset) {
         const Axis axis{offset + Vec3(2, 0, 0), glm::normalize(Vec3(0.1, 0.2, 1))};
         return subject_of(SurfaceSet{std::make_shared<RevolutionSurface>(wavy_curve(offset), axis, 4.0)});
       }});
  add(formula_entry("sphere", true, [](const Frame& f) { return std::make_shared<SphereSurface>(f, 1.3); }));
  add(formula_entry("part_of_a_sphere", false, [](const Frame& f) {
    return std::make_shared<SphereSurface>(f, 1.3, Rectangle{{-0.5, 3}, {-0.4, 1.2}});
  }));
  add(formula_entry("ellipsoid", true,
                    [](const Frame& f) { return std::make_shared<Ellipsoid>(f, Vec3(1, 2.5, 0.4)); }));
  add(formula_entry("cone", false, [](const Frame& f) { return std::make_shared<ConeSurface>(f, 1.2, 0, 2); }));
  add(formula_entry("double_cone", false,
                    [](const Frame& f) { return std::make_shared<ConeSurface>(f, 1.2, -0.7, 2); }));
  add(formula_entry("part_of_a_cylinder", false, [](const Frame& f) {
    return std::make_shared<CylinderSurface>(f, 0.8, 2, Rectangle{{1, 5}, {0, 1}});
  }));
  add(formula_entry("hyperboloid", false, [](const Frame& f) {
    return std::make_shared<HyperboloidOneSheet>(f, Vec3(1, 0.7, 0.8), Rectangle{{0, kTwoPi}, {-1.2, 1}});
  }));
  add(formula_entry("saddle", false, [](const Frame& f) {
    return std::make_shared<HyperbolicParaboloid>(f, 1, 0.6, Rectangle{{-1, 1}, {-1.3, 1}});
  }));
  add(formula_entry("horn_torus", true, [](const Frame& f) { return std::make_shared<TorusSurface>(f, 1, 1); }));
  add(formula_entry("lemon", true, [](const Frame& f) { return std::make_shared<TorusSurface>(f, -0.5, 1); }));
  return entries;
}

}  // namespace lekalo::render::completeness
