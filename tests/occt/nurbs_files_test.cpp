// Files of `lekalo export --format json` read back by OCCT: its splines have the points of our curves and surfaces.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Geom_BezierSurface.hxx>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "geometry/curves/analytic/formula_curve.h"
#include "occt/occt_shapes.h"
#include "render/every_surface/examples.h"
#include "render/scene/build/load.h"

namespace lekalo::render::nurbs_files_test {
namespace {

using namespace geometry;
using nlohmann::json;

constexpr double kSame = 1e-12;

constexpr const char* kCurves = R"(
  open: { type: nurbs_curve, knots: [0, 0, 0, 0, 1, 2, 2, 4, 4, 4, 4], points: [[0, 0], [1, 2], [2, -1, 3], [3, 3], [4, 0], [5, 2], [6, 1]], weights: [1, 2, 1, 0.5, 1, 3, 1] }
  floating: { type: nurbs_curve, knots: uniform, points: [[0, 0], [1, 2], [2, -1, 3], [3, 3], [4, 0]] }
  closed: { type: nurbs_curve, closed: true, points: [[0, 0], [2, 0], [3, 2], [1, 3], [-1, 2]] }
  bezier: { type: bezier_curve, points: [[0, 0], [1, 2, 1], [3, 1], [4, 0]], weights: [1, 3, 0.5, 1] }
  rim: { type: circle, radius: 2, center: [1, 2, 3] }
  arc: { type: ellipse, semi_axes: [3, 1], arc: [20, 200] }
  branch: { type: hyperbola, semi_axes: [1, 2], range: [-1, 2] }
  strophoid: { type: named_curve, preset: strophoid }
  cardioid: { type: named_curve, preset: cardioid }
  lemniscate: { type: named_curve, preset: lemniscate_of_bernoulli }
  astroid: { type: named_curve, preset: astroid }
  epicycloid: { type: named_curve, preset: epicycloid }
  smooth: { type: smoothing_spline, points: [[0, 0], [1, 1], [2, 0], [3, 1]], corridor: 0.2, start_tangent: [1, 0] }
  near: { type: fit_curve, points: [[0, 0], [1, 1.2], [2, 0.9], [3, 1.1], [4, 0.2], [5, 0], [6, 1]], spans: 2, jump_weights: 0.1 }
  spring: { type: helix, radius: 2, pitch: 1, turns: 3 }
)";

constexpr const char* kSurfaces = R"(
  net: { type: nurbs_surface, degree: { u: 1, v: 2 }, points: [[[0, 0, 0], [0, 1, 1], [0, 2, 0]], [[1, 0, 1], [1, 1, 0], [1, 2, 2]]], weights: [[1, 2, 1], [1, 1, 3]] }
  ball: { type: sphere_surface, radius: 2 }
  ring: { type: torus_surface, major_radius: 3, minor_radius: 1 }
  wall: { type: extrusion_surface, of: { type: named_curve, preset: cardioid }, along: [0, 1, 2] }
  vase: { type: revolution_surface, of: { type: bezier_curve, points: [[1, 0, 0], [2, 0, 1], [0.5, 0, 2], [1, 0, 3]] }, axis: z }
  loft: { type: spline_surface, points: [[[0, 0, 0], [0, 1, 1], [0, 2, 0]], [[1, 0, 1], [1, 1, 0], [1, 2, 2]], [[2, 0, 0], [2, 1, 0], [2, 2, 0]]] }
  wave: { type: formula_surface, point: [u, v, sin(u)*cos(v)], domain: { u: [0, 2], v: [0, 1] } }
)";

// A scene, and what the program writes of all that it names.
struct Exported {
  LoadedScene scene;
  json file;
};

Exported exported(const std::string& geometry) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("lekalo_nurbs_files_{}", getpid());
  std::filesystem::create_directories(folder);
  const std::filesystem::path scene = folder / "scene.yaml", out = folder / "out.json";
  std::ofstream(scene) << "lekalo: 1\nlights: {}\ngeometry:" << geometry;
  Exported result{load_scene(scene), {}};
  std::string names;
  for (const auto& [name, entity] : result.scene.model->geometry) names += " " + name;
  const std::string command =
      fmt::format("{} export {}{} -o {} --quiet", LEKALO_PROGRAM, scene.string(), names, out.string());
  EXPECT_EQ(std::system(command.c_str()), 0);
  result.file = json::parse(std::ifstream(out));
  std::filesystem::remove_all(folder);
  return result;
}

OcctKnots knots_of(const std::vector<double>& knots) {
  std::vector<double> distinct;
  std::vector<int> times;
  for (const double knot : knots) {
    if (distinct.empty() || knot != distinct.back()) distinct.push_back(knot), times.push_back(0);
    ++times.back();
  }
  const int n = static_cast<int>(distinct.size());
  OcctKnots result{TColStd_Array1OfReal(1, n), TColStd_Array1OfInteger(1, n)};
  for (int i = 0; i < n; ++i) result.knots(i + 1) = distinct[i], result.multiplicities(i + 1) = times[i];
  return result;
}

gp_Pnt point_of(const json& p) { return {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()}; }

Handle(Geom_BSplineCurve) read_curve(const json& form) {
  const int n = static_cast<int>(form["points"].size());
  TColgp_Array1OfPnt poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 0; i < n; ++i) poles(i + 1) = point_of(form["points"][i]), weights(i + 1) = form["weights"][i];
  const OcctKnots knots = knots_of(form["knots"]);
  return new Geom_BSplineCurve(poles, weights, knots.knots, knots.multiplicities, form["degree"].get<int>(), false);
}

struct Net {
  TColgp_Array2OfPnt poles;
  TColStd_Array2OfReal weights;
};
Net net_of(const json& form) {
  const int m = static_cast<int>(form["points"].size()), n = static_cast<int>(form["points"][0].size());
  Net net{TColgp_Array2OfPnt(1, m, 1, n), TColStd_Array2OfReal(1, m, 1, n)};
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      net.poles(i + 1, j + 1) = point_of(form["points"][i][j]);
      net.weights(i + 1, j + 1) = form["weights"][i][j];
    }
  return net;
}

Handle(Geom_BSplineSurface) read_surface(const json& form) {
  const Net net = net_of(form);
  const OcctKnots u = knots_of(form["knots_u"]), v = knots_of(form["knots_v"]);
  return new Geom_BSplineSurface(net.poles, net.weights, u.knots, v.knots, u.multiplicities, v.multiplicities,
                                 form["degree"][0].get<int>(), form["degree"][1].get<int>(), false, false);
}

double natural(const std::vector<ParameterMap>& maps, double s) {
  for (const ParameterMap& map : maps)
    if (map.lo <= s && s <= map.hi) return map.natural(s);
  return s;
}

double natural(const Curve& curve, double s) {
  const auto* formula = dynamic_cast<const FormulaCurve*>(&curve);
  if (formula && formula->rational()) {
    const double speed = formula->rational()->speed;
    return natural(formula->rational()->form.maps, speed * s) / speed;
  }
  const auto form = curve.as_nurbs();
  return form ? natural(form->maps, s) : s;
}

TEST(NurbsFiles, CurvesReadBackByOcct) {
  const Exported read = exported(kCurves);
  ASSERT_EQ(read.file["curves"].size(), 15);
  for (const json& form : read.file["curves"]) {
    const std::string name = form["name"];
    SCOPED_TRACE(name);
    EXPECT_EQ(form["exact"].get<bool>(), name != "spring");
    const Curve& own = *std::get<CurvePtr>(read.scene.model->geometry.at(name));
    const Handle(Geom_BSplineCurve) theirs = read_curve(form);
    const int degree = form["degree"];
    const std::vector<double> knots = form["knots"];
    const Interval domain(knots[degree], knots[knots.size() - 1 - degree]);
    const double same = kSame * bounds(own).diameter() + form["deviation"].get<double>() * 1.1;
    for (int k = 0; k <= 200; ++k) {
      const double s = k == 200 ? domain.hi : domain.lo + domain.width() * k / 200;
      EXPECT_LE(glm::length(from_occt(theirs->Value(s).XYZ()) - own.point(natural(own, s))), same) << s;
    }
  }
}

// The last place just before the end, where OCCT looks beyond the poles if the knots float and the last one is double.
double place(const Interval& t, int i, int count) {
  return i == count ? t.hi - 1e-13 * t.width() : t.lo + t.width() * i / count;
}

void expect_points_of_form(const json& form, const NurbsSurfaceForm& known, const Surface& own, double same) {
  const Handle(Geom_BSplineSurface) theirs = read_surface(form);
  const Rectangle domain = known.domain();
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j) {
      const double u = place(domain.u, i, 20), v = place(domain.v, j, 20);
      const Vec3 there = own.point(natural(known.maps_u, u), natural(known.maps_v, v));
      EXPECT_LE(glm::length(from_occt(theirs->Value(u, v).XYZ()) - there), same) << u << ", " << v;
    }
}

// `maps`: of the pieces where they are the surface's own.
void expect_points_of_pieces(const json& pieces, const std::vector<SurfacePiece>& maps, const Surface& own,
                             double same) {
  for (size_t k = 0; k < pieces.size(); ++k) {
    const Net net = net_of(pieces[k]);
    const Handle(Geom_BezierSurface) theirs = new Geom_BezierSurface(net.poles, net.weights);
    const json &u = pieces[k]["domain"][0], &v = pieces[k]["domain"][1];
    const double u0 = u[0], u1 = u[1], v0 = v[0], v1 = v[1];
    for (const double x : {0., 0.3, 0.6, 1.})
      for (const double y : {0., 0.2, 0.7, 1.}) {
        const Vec2 at = maps.empty() ? Vec2(u0 + x * (u1 - u0), v0 + y * (v1 - v0))
                                     : Vec2(maps[k].map_u.natural_of_bezier(x), maps[k].map_v.natural_of_bezier(y));
        EXPECT_LE(glm::length(from_occt(theirs->Value(x, y).XYZ()) - own.point(at.x, at.y)), same) << "piece " << k;
      }
  }
}

// Of the surfaces those that are rational are exact.
void expect_read_back(const Exported& read) {
  for (const json& form : read.file["surfaces"]) {
    const std::string name = form["name"];
    SCOPED_TRACE(name);
    const Surface& own = *std::get<SurfacePtr>(read.scene.model->geometry.at(name));
    const double same = kSame * bounds(own).diameter() + form["deviation"].get<double>() * 1.1;
    std::vector<SurfacePiece> pieces = own.pieces();
    const bool is_rational =
        std::all_of(pieces.begin(), pieces.end(), [](const SurfacePiece& piece) { return piece.is_rational(); });
    EXPECT_EQ(form["exact"].get<bool>(), is_rational);
    if (const auto known = own.as_nurbs()) {
      expect_points_of_form(form, *known, own, same);
    } else {
      if (!is_rational) pieces.clear();
      expect_points_of_pieces(form["pieces"], pieces, own, same);
    }
  }
}

TEST(NurbsFiles, SurfacesReadBackByOcct) {
  const Exported read = exported(kSurfaces);
  ASSERT_EQ(read.file["surfaces"].size(), 7);
  expect_read_back(read);
}

// The example of each: exact forms, Bezier pieces of triangles and T-splines, fits of the others.
TEST(NurbsFiles, SurfacesOfEveryTypeReadBackByOcct) {
  std::string geometry = every_surface::kNamed;
  const std::vector<std::string> names = every_surface::surface_type_names();
  for (const TypeDeclaration& type : every_surface::surface_types())
    geometry += fmt::format("  {}: {}\n", type.name, example_of(type));
  const Exported read = exported(geometry);
  ASSERT_EQ(read.file["surfaces"].size(), names.size());
  expect_read_back(read);
}

}  // namespace
}  // namespace lekalo::render::nurbs_files_test
