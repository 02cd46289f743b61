// Lines that drawings show of surfaces and what is cut from them, against the same shapes put together of others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/trims/trimmed_surface.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/point_formulas.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/shapes/implicit/implicit_surface.h"
#include "geometry/surfaces/analytic/formula_surface.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"
#include "render/drawing/random_views.h"
#include "render/drawing/visibility/hidden_lines.h"
#include "support/tier.h"

namespace lekalo::render::lines_of_surfaces_test {
namespace {

using namespace geometry;

SurfacePtr turned(const std::vector<Vec3>& points) {
  return std::make_shared<RevolutionSurface>(std::make_shared<NurbsCurve>(polyline(points, false)),
                                             Axis{{0, 0, 0}, {0, 0, 1}}, kTwoPi);
}

int layers_at(const VisibleLine& line, double t) {
  for (const VisiblePiece& piece : line.pieces)
    if (piece.t.contains(t)) return piece.layers;
  return -1;
}

// A turned polyline is a stack of cones: its rings at the corners are the cones' borders, and hide as those do.
TEST(LinesOfSurfaces, CreasesAreBordersOfTheirPieces) {
  Views views(17);
  int compared = 0, hidden = 0;
  const int all = tests::tier_count(100, tests::min_of_slow(10));
  for (int k = 0; k < all; ++k) {
    std::vector<Vec3> points;
    SurfaceSet parts;
    for (int i = 0; i < 5; ++i) points.push_back({views.number(0.5, 2), 0, views.number(i - 2.4, i - 1.6)});
    for (int i = 0; i < 4; ++i) parts.push_back(turned({points[i], points[i + 1]}));
    SmallScene whole, stack;
    show(whole, turned(points), {"sharp", "silhouette"});
    show(stack, parts, {"boundary", "silhouette"});
    Views same(100 + k);
    same.look(whole, k % 2);
    stack.model.film = whole.model.film, stack.model.camera = whole.model.camera;
    const auto world = whole.world(), world_of_stack = stack.world();
    const VisibleLines found = visible_lines(*world, drawing_work(*world)),
                       expected = visible_lines(*world_of_stack, drawing_work(*world_of_stack));
    EXPECT_EQ(found.incomplete, 0);
    const auto count = [](const VisibleLines& lines, const std::string& kind) {
      return std::count_if(lines.lines.begin(), lines.lines.end(),
                           [&](const VisibleLine& line) { return line.stroke.kind == kind; });
    };
    EXPECT_EQ(count(found, "sharp"), 3);
    EXPECT_EQ(count(found, "silhouette"), count(expected, "silhouette"));
    for (const VisibleLine& line : found.lines)
      for (const VisibleLine& other : expected.lines) {
        const Interval t = line.stroke.curve->domain(), t_other = other.stroke.curve->domain();
        const auto meets = [&](double share) {
          return glm::length(line.stroke.curve->point(t.lo + share * t.width()) -
                             other.stroke.curve->point(t_other.lo + share * t_other.width())) < 1e-9;
        };
        if (!meets(0) || !meets(0.3) || !meets(0.8)) continue;
        for (int i = 0; i < 50; ++i) {
          const double share = views.number(0, 1);
          const int layers = layers_at(line, t.lo + share * t.width());
          EXPECT_EQ(layers, layers_at(other, t_other.lo + share * t_other.width())) << k << " " << share;
          ++compared, hidden += layers > 0;
        }
      }
  }
  EXPECT_GT(hidden, compared / 10);
  EXPECT_GT(compared, 300 * all);
}

// Parameter lines and borders of a part of a sphere are the same wherever it lies, over the seam too.
TEST(LinesOfSurfaces, PartsOverTheSeam) {
  std::vector<double> lengths;
  for (const double at : {3.0, 0.2, 5.9}) {
    Frame frame;
    frame.origin = {at, 0.2, 0};
    SmallScene scene;
    show(scene, std::make_shared<Body>(trimmed_surface(sphere({0, 0, 0}, 1), {std::make_shared<Circle>(frame, 1)})),
         {"boundary", "parameter"}, 5);
    scene.model.objects.back().transform = Affine::rotation(-at, {0, 0, 1});
    Views views(1);
    views.look(scene, false);
    double length = 0;
    for (const Stroke& stroke : drawing_work(*scene.world()).strokes)
      if (stroke.drawn) length += arc_length(*stroke.curve, stroke.curve->domain().lo, stroke.curve->domain().hi).value;
    lengths.push_back(length);
  }
  EXPECT_GT(lengths[0], 15);
  EXPECT_NEAR(lengths[0], lengths[1], 1e-6);
  EXPECT_NEAR(lengths[0], lengths[2], 1e-6);
}

// Of the world, how long the lines are behind so many layers.
std::map<int, double> lengths_of(const VisibleLines& found) {
  std::map<int, double> lengths;
  for (const VisibleLine& line : found.lines) {
    const CurvePtr curve = transformed(line.stroke.curve, line.stroke.to_world);
    for (const VisiblePiece& piece : line.pieces)
      lengths[piece.layers] += arc_length(*curve, piece.t.lo, piece.t.hi).value;
  }
  return lengths;
}

// A box that planes along its sides cut, with caps, is a smaller box; a ball beside it goes through the caps.
TEST(LinesOfSurfaces, CappedCutsMakeASmallerBox) {
  Views views(23);
  for (int k = 0; k < tests::tier_count(100, tests::min_of_slow(10)); ++k) {
    const Vec3 size(views.number(1, 3), views.number(1, 3), views.number(1, 3));
    Frame frame = frame_from({0, 0, 0}, views.direction(), views.direction());
    frame.origin = -frame.direction(0.5 * size);
    SmallScene cut, small;
    show(cut, std::make_shared<Body>(box(frame, 1.5 * size)), {"sharp"});
    const Affine moved = Affine::translation({0.2, 0.1, -0.3});
    Object& object = cut.model.objects.back();
    object.transform = moved;
    for (const Vec3& axis : {frame.x, frame.y, frame.z})
      object.clips.push_back({moved.point(frame.origin + frame.direction(size)), axis, true});
    show(small, std::make_shared<Body>(box(frame, size)), {"sharp"});
    small.model.objects.back().transform = moved;
    Frame corner = frame;
    corner.origin = frame.origin + frame.direction(size);
    for (SmallScene* scene : {&cut, &small}) show(*scene, std::make_shared<Body>(ball(corner, 0.4)), {"silhouette"});
    views.look(cut, k % 2);
    small.model.film = cut.model.film, small.model.camera = cut.model.camera;
    const auto world = cut.world(), world_of_small = small.world();
    const std::map<int, double> found = lengths_of(visible_lines(*world, drawing_work(*world))),
                                expected = lengths_of(visible_lines(*world_of_small, drawing_work(*world_of_small)));
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [layers, length] : expected) EXPECT_NEAR(found.at(layers), length, 1e-6) << k << " " << layers;
  }
}

// What an open cut leaves of a sphere ends at a circle, a border.
TEST(LinesOfSurfaces, OpenCutsAreBorders) {
  SmallScene scene;
  show(scene, sphere({0, 0, 0}, 2), {"boundary", "parameter", "silhouette"}, 6);
  const ClipPlane plane{{0, 0, 1}, glm::normalize(Vec3(1, 2, 2)), false};
  scene.model.objects.back().clips = {plane};
  Views views(5);
  views.look(scene, false);
  const auto world = scene.world();
  const VisibleLines found = visible_lines(*world, drawing_work(*world));
  double length = 0;
  for (const VisibleLine& line : found.lines)
    for (const VisiblePiece& piece : line.pieces) {
      if (line.stroke.kind == "boundary") length += arc_length(*line.stroke.curve, piece.t.lo, piece.t.hi).value;
      for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        const Vec3 point = line.stroke.curve->point(piece.t.lo + share * piece.t.width());
        EXPECT_LT(glm::dot(point - plane.through, plane.normal), 1e-9);
      }
    }
  const double height = glm::dot(plane.through, plane.normal);
  EXPECT_NEAR(length, kTwoPi * std::sqrt(4 - height * height), 1e-6);
}

// Solids and sheets by formulas with kinks hide as the bodies and patches that they are.
TEST(LinesOfSurfaces, FormulasWithKinks) {
  const auto implicit = [](const char* text, double half, bool closed) -> ShapePtr {
    auto formula = std::get<Expression>(Expression::parse(text));
    const std::vector<Expression::Variable> variables{{"x"}, {"y"}, {"z"}};
    EXPECT_FALSE(formula.bind(variables));
    return std::make_shared<ImplicitSurface>(std::move(formula), 0, ImplicitRegion{{Vec3(-half), Vec3(half)}}, closed);
  };
  const auto sheet = [](const char* z, const Rectangle& domain) -> SurfacePtr {
    return std::make_shared<FormulaSurface>(point_formulas({"u", "v", z}, {"u", "v"}), domain,
                                            FormulaSurface::Closed{});
  };
  const Rectangle all{{-2, 2}, {-2, 2}};
  // Four quarters of a saddle, two of them turned over.
  SurfaceSet quarters;
  for (const Interval& u : {Interval(-2, 0), Interval(0, 2)})
    for (const Interval& v : {Interval(-2, 0), Interval(0, 2)})
      quarters.push_back(sheet(u.lo == v.lo ? "0.3*u*v" : "-0.3*u*v", {u, v}));
  const BodyPtr block = std::make_shared<Body>(box(frame_from({-1, -1, -1}, {0, 0, 1}, {1, 0, 0}), Vec3(2)));
  const std::pair<Entity, Entity> pairs[] = {
      {implicit("max(abs(x), abs(y), abs(z)) - 1", 1.2, true), block},
      {sheet("0.3*abs(u*v)", all), quarters},
      {implicit("z - 0.3*abs(x*y)", 2, false), quarters},
  };
  Views views(23);
  const int count = tests::tier_count(50, tests::min_of_slow(6));
  for (const auto& [kinked, plain] : pairs)
    for (int k = 0; k < count; ++k) {
      std::map<int, double> lengths[2];  // in the picture, by layers, without what lies on other lines
      for (const bool expected : {false, true}) {
        SmallScene scene;
        const bool is_sheet = !std::holds_alternative<BodyPtr>(plain);
        show(scene, expected ? plain : kinked, {"silhouette", "sharp", "boundary"});
        Views same(300 + k);
        same.look(scene, k % 2);
        const auto world = scene.world();
        const VisibleLines lines = visible_lines(*world, drawing_work(*world));
        EXPECT_EQ(lines.incomplete, 0);
        for (const VisibleLine& line : lines.lines) {
          // Quarters join in two borders for one crease.
          const Vec3 middle = line.stroke.curve->point(line.stroke.curve->domain().middle());
          const bool is_joint = expected && is_sheet && line.stroke.kind == "boundary" &&
                                std::min(std::abs(middle.x), std::abs(middle.y)) < 1e-9;
          for (const VisiblePiece& piece : line.pieces) {
            constexpr int kSteps = 200;
            double length = 0;
            for (int i = 0; i < kSteps; ++i)
              length += glm::length(line.curve->place(piece.t.lo + piece.t.width() * (i + 1) / kSteps).p -
                                    line.curve->place(piece.t.lo + piece.t.width() * i / kSteps).p);
            lengths[expected][piece.layers] += is_joint ? 0.5 * length : length;
          }
        }
      }
      for (int layers = 0; layers < 6; ++layers)
        EXPECT_NEAR(lengths[0][layers], lengths[1][layers], 0.02) << k << " behind " << layers;
    }
}

}  // namespace
}  // namespace lekalo::render::lines_of_surfaces_test
