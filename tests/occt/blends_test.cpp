// Fillets and chamfers beside OCCT's: the same edges of the same bodies, which it reads from our STEP files. Ours must
// be valid, with borders that touch both faces and sections of balls. Where volumes differ, or of polyhedra in any
// case, points are counted in what is taken off.
#include <gtest/gtest.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <map>
#include <optional>

#include "geometry/bodies/blends/blend_checks.h"
#include "geometry/bodies/blends/blend_models.h"
#include "geometry/bodies/blends/spandrels.h"
#include "geometry/queries/measures/mass_properties.h"
#include "occt/occt_body.h"
#include "occt/step_reader.h"
#include "render/step/step_export.h"
#include "support/tier.h"

namespace lekalo::render::blends_test {
namespace {

using geometry::BlendModel;
using geometry::Body;
using geometry::Vec3;

// Planes, cylinders, cones, spheres and tori.
bool is_elementary(const TopoDS_Shape& shape) {
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next())
    if (BRepAdaptor_Surface(TopoDS::Face(it.Current())).GetType() > GeomAbs_Torus) return false;
  return true;
}

// The edges of its shape that are those of ours.
std::vector<TopoDS_Edge> edges_in(const TopoDS_Shape& shape, const BlendModel& model) {
  std::vector<TopoDS_Edge> result;
  for (const int e : model.edges) {
    const geometry::Curve& curve = *model.body.edges[e].curve;
    const Vec3 p = curve.point(curve.domain().middle());
    const TopoDS_Vertex place = BRepBuilderAPI_MakeVertex(gp_Pnt(p.x, p.y, p.z));
    double least = 1e-6;
    TopoDS_Edge nearest;
    for (TopExp_Explorer it(shape, TopAbs_EDGE); it.More(); it.Next()) {
      if (BRep_Tool::Degenerated(TopoDS::Edge(it.Current()))) continue;
      const BRepExtrema_DistShapeShape distance(place, it.Current());
      if (distance.Value() < least) least = distance.Value(), nearest = TopoDS::Edge(it.Current());
    }
    EXPECT_FALSE(nearest.IsNull()) << model.kind << ", edge " << e;
    if (!nearest.IsNull()) result.push_back(nearest);
  }
  return result;
}

struct Answer {
  double volume = 0;
  bool is_elementary = false;
  std::string fault;
};

Answer answer_of(const TopoDS_Shape& shape) {
  if (!BRepCheck_Analyzer(shape).IsValid()) return {0, false, "not valid"};
  return {tests::occt_volume(shape), is_elementary(shape), ""};
}

template <class Algorithm>
std::optional<TopoDS_Shape> built(Algorithm& algorithm, const BlendModel& model,
                                  const std::vector<TopoDS_Edge>& edges) {
  for (const TopoDS_Edge& edge : edges) algorithm.Add(model.size, edge);
  algorithm.Build();
  if (!algorithm.IsDone()) return std::nullopt;
  return algorithm.Shape();
}

// The time that it takes to build is added to `seconds`.
Answer of_occt(const TopoDS_Shape& shape, const BlendModel& model, double& seconds) {
  const std::vector<TopoDS_Edge> edges = edges_in(shape, model);
  const std::clock_t start = std::clock();
  const auto stop = [&] { seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; };
  try {
    std::optional<TopoDS_Shape> result;
    if (model.is_chamfer) {
      BRepFilletAPI_MakeChamfer chamfer(shape);
      result = built(chamfer, model, edges);
    } else {
      BRepFilletAPI_MakeFillet fillet(shape);
      result = built(fillet, model, edges);
    }
    stop();
    return result ? answer_of(*result) : Answer{0, false, "an error"};
  } catch (const Standard_Failure& failure) {
    stop();
    return {0, false, fmt::format("thrown: {}", failure.DynamicType()->Name())};
  }
}

// The centers p -+ r n of the balls that touch a fillet in a section are one: the surface is a pipe of the radius.
void expect_balls(const Body& body, double radius, const std::string& name) {
  const double size = bounds(body).diameter();
  for (size_t f = 0; f < body.faces.size(); ++f) {
    const geometry::Face& face = body.faces[f];
    if (!geometry::blend_checks::is_blend(body, static_cast<int>(f))) continue;
    geometry::Box3 box;
    for (const int loop : face.loops)
      for (const int c : body.loops[loop].coedges) {
        const geometry::Interval t = body.coedges[c].image->domain();
        for (int k = 0; k <= 8; ++k) box.include(Vec3(body.coedges[c].image->point(t.lo + t.width() * k / 8)));
      }
    std::array<double, 2> worst{0, 0};
    for (const bool inside : {false, true}) {
      std::array<double, 2> spread{0, 0};
      for (int along = 0; along < 2; ++along)
        for (int i = 0; i < 5; ++i) {
          Vec3 first(0);
          for (int j = 0; j < 5; ++j) {
            Vec3 share(0.0);
            share[along] = 0.1 + 0.2 * i, share[1 - along] = 0.1 + 0.2 * j;
            const Vec3 at = box.lo + share * (box.hi - box.lo);
            const Vec3 center = face.surface->point(at.x, at.y) +
                                (inside ? -radius : radius) * body.normal(static_cast<int>(f), at.x, at.y);
            if (j == 0) first = center;
            spread[along] = std::max(spread[along], glm::length(center - first));
          }
        }
      worst[inside] = std::min(spread[0], spread[1]);
    }
    EXPECT_LE(std::min(worst[0], worst[1]), 1e-9 * size) << name << ", " << face.origin.text();
  }
}

// "cylinder_on_plate,_foot"
std::string key_of(std::string kind) {
  std::replace(kind.begin(), kind.end(), ' ', '_');
  return kind;
}

struct Beside {
  double seconds = 0, seconds_of_occt = 0;
  int refused = 0, equal = 0;
  std::map<std::string, int> failed, other;  // in OCCT, by kind
};

// Where OCCT's volume is another one, it must be known otherwise that ours is right.
void compare(const BlendModel& model, const std::string& name, Beside& beside) {
  ASSERT_FALSE(model.edges.empty()) << name;
  const TopoDS_Shape shape = tests::occt_body(model.body);
  const double whole = measure(model.body).volume.value;
  EXPECT_NEAR(tests::occt_volume(shape), whole, 1e-6 * whole) << name;
  const Answer answer = of_occt(shape, model, beside.seconds_of_occt);
  if (!answer.fault.empty()) {
    ++beside.failed[model.kind];
    std::cerr << name << ", OCCT: " << answer.fault << "\n";
  }
  Body body;
  std::string refusal;
  const std::clock_t start = std::clock();
  try {
    body = blended(model.body, model.requests());
  } catch (const std::invalid_argument& error) {
    refusal = error.what();
  }
  beside.seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (!refusal.empty()) {
    ++beside.refused;
    std::cerr << name << ", refused: " << refusal << ", OCCT: " << fmt::format("{:.9g}", answer.volume) << "\n";
    return;
  }
  EXPECT_EQ(geometry::blend_checks::violations_of(body), "") << name;
  geometry::blend_checks::expect_smooth_borders(body);
  if (!model.is_chamfer) expect_balls(body, model.size, name);
  const Answer own = answer_of(tests::occt_body(body));
  EXPECT_EQ(own.fault, "") << name;
  const double volume = measure(body).volume.value;
  EXPECT_NEAR(own.volume, volume, 1e-6 * whole) << name;
  const auto taken = geometry::taken_off(model);
  if (taken) {
    EXPECT_NEAR(whole - volume, *taken, 3e-3 * *taken) << name;
  }
  if (!answer.fault.empty()) return;
  const double within = own.is_elementary && answer.is_elementary ? 1e-6 : 1e-3;
  if (std::abs(volume - answer.volume) <= within * whole) {
    ++beside.equal;
    return;
  }
  ++beside.other[model.kind];
  std::cerr << fmt::format("{}: {:.9g} is taken off, by OCCT {:.9g}, by points {:.9g}\n", name, whole - volume,
                           whole - answer.volume, taken.value_or(std::nan("")));
  EXPECT_TRUE(taken) << name << ": nothing tells which volume is right";
}

TEST(BlendsBesideOcct, Volumes) {
  const int models = tests::tier_count(100, 10);
  // Prime to the number of kinds, so that few models are of many kinds.
  constexpr int kStep = 7;
  Beside beside;
  for (int i = 0; i < models; ++i) {
    const int k = i * kStep % 100;
    const BlendModel model = geometry::BlendModels(2000u + static_cast<unsigned>(k)).model(k);
    compare(model, fmt::format("{}, {}{}, size {:.4g}", k, model.kind, model.is_chamfer ? ", chamfer" : "", model.size),
            beside);
  }
  tests::report_figure("refused", beside.refused);
  tests::report_figure("equal", beside.equal);
  for (const auto& [kind, count] : beside.failed) tests::report_figure("failed_in_OCCT,_" + key_of(kind), count);
  for (const auto& [kind, count] : beside.other) tests::report_figure("other_in_OCCT,_" + key_of(kind), count);
  std::cerr << fmt::format("{} models: {:.2f} s of processor time, OCCT {:.2f} s\n", models, beside.seconds,
                           beside.seconds_of_occt);
  EXPECT_EQ(beside.refused, 0);
}

// Its fillets are cut where one of their breaks is, but for rounding: a piece between the two was a knot span that OCCT
// does not take.
TEST(BlendsBesideOcct, ARoundedLoftKeepsItsFaces) {
  const BlendModel model = geometry::BlendModels(9210).model(210);
  const auto body = std::make_shared<const geometry::Body>(geometry::blended(model.body, model.requests()));
  for (const geometry::Face& face : body->faces)
    for (const geometry::SurfacePiece& piece : face.surface->pieces())
      EXPECT_GT(piece.domain.u.width(), 1e-9 * face.surface->domain().u.width()) << face.origin.text();
  const TopoDS_Shape shape = tests::read_step(step_file({{"b", body, {}, {}}}, "b", "mm", 1e-9).text);
  int faces = 0;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) ++faces;
  EXPECT_EQ(faces, static_cast<int>(body->faces.size()));
}

}  // namespace
}  // namespace lekalo::render::blends_test
