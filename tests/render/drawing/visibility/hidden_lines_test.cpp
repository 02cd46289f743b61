// What is seen of lines, against what is known of convex bodies, spheres and discs in any view.
#include "render/drawing/visibility/hidden_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/segment.h"
#include "render/drawing/paths/paths.h"
#include "render/drawing/random_views.h"
#include "render/scene/scene_text.h"
#include "render/small_scene.h"
#include "support/tier.h"

namespace lekalo::render::hidden_lines_test {
namespace {

using namespace geometry;

// Towards the viewer from a point.
Vec3 towards(const Camera& camera, const Vec3& p) {
  if (camera.is_parallel()) return -camera.view_direction();
  return glm::normalize(camera.ray(0.5 * camera.width(), 0.5 * camera.height()).origin - p);
}

// An edge of a box is hidden, by one face for each of its own that look at the viewer elsewhere, where both of its
// faces look away.
TEST(VisibleLines, EdgesOfBoxes) {
  Views views(3);
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    const Vec3 size(views.number(1, 3), views.number(1, 3), views.number(1, 3));
    Frame frame = frame_from({0, 0, 0}, views.direction(), views.direction());
    frame.origin = -frame.direction(0.5 * size);
    show(scene, std::make_shared<Body>(box(frame, size)), {"sharp"});
    views.look(scene, k % 2);
    const auto world = scene.world();
    const VisibleLines found = visible_lines(*world, drawing_work(*world));
    ASSERT_EQ(found.lines.size(), 12u);
    for (const VisibleLine& line : found.lines) {
      ASSERT_EQ(line.pieces.size(), 1u);
      const Interval domain = line.stroke.curve->domain();
      EXPECT_EQ(line.pieces[0].t.lo, domain.lo);
      EXPECT_EQ(line.pieces[0].t.hi, domain.hi);
      const Vec3 middle = line.stroke.curve->point(domain.middle());
      bool seen = false;
      for (const Stroke::SupportingSurface& supporting_surface : line.stroke.supporting_surfaces) {
        Vec3 normal = supporting_surface.surface->normal(0, 0);
        if (glm::dot(normal, middle) < 0) normal = -normal;  // outward: the box stands about the origin
        seen = seen || glm::dot(normal, towards(*world->model().camera, middle)) > 0;
      }
      EXPECT_EQ(line.pieces[0].layers, seen ? 0 : 1);
    }
  }
}

// Of a sphere's outline all is seen, of its parameter lines what looks at the viewer: the change is where the normal
// stands across the line of sight.
TEST(VisibleLines, ParameterLinesOfSpheres) {
  Views views(5);
  int changes = 0;
  const int count = tests::tier_count(500, tests::min_of_slow(50));
  for (int k = 0; k < count; ++k) {
    SmallScene scene;
    const double radius = views.number(1, 2.5);
    const auto ball =
        std::make_shared<SphereSurface>(frame_from({0, 0, 0}, views.direction(), views.direction()), radius);
    show(scene, SurfacePtr(ball), {"silhouette", "parameter"}, 5);
    views.look(scene, k % 2);
    const auto world = scene.world();
    const Camera& camera = *world->model().camera;
    const VisibleLines found = visible_lines(*world, drawing_work(*world));
    EXPECT_EQ(found.incomplete, 0);
    for (const VisibleLine& line : found.lines) {
      const auto facing = [&](double t) {
        const Vec3 p = line.stroke.curve->point(t);
        return glm::dot(p / radius, towards(camera, p));
      };
      if (line.stroke.kind == "silhouette") {
        for (const VisiblePiece& piece : line.pieces) EXPECT_EQ(piece.layers, 0);
        continue;
      }
      for (const VisiblePiece& piece : line.pieces) {
        EXPECT_EQ(piece.layers, facing(piece.t.middle()) > 0 ? 0 : 1);
        const Interval domain = line.stroke.curve->domain();
        for (const double t : {piece.t.lo, piece.t.hi})
          if (t != domain.lo && t != domain.hi) {
            ++changes;
            EXPECT_NEAR(facing(t), 0, 1e-7);
          }
      }
    }
  }
  EXPECT_GT(changes, 2 * count);
  tests::report_figure("changes", changes);
}

// A needle through a ball, one behind it and one before it.
TEST(VisibleLines, NeedlesAndABall) {
  SmallScene scene;
  show(scene, sphere({0, 0, 0}, 1), {});
  for (const double y : {0.0, 2.0, -2.0})
    show(scene, CurvePtr(std::make_shared<Segment>(Vec3(-3, y, 0.6), Vec3(3, y, 0.6))), {"curve"});
  scene.model.film.width = 600, scene.model.film.height = 500;
  scene.model.camera = make_camera(ParallelView{{0, -10, 0}, {0, 0, 0}, {0, 0, 1}, 8}, 600, 500);
  const auto world = scene.world();
  const VisibleLines found = visible_lines(*world, drawing_work(*world));
  ASSERT_EQ(found.lines.size(), 3u);
  // They enter at x = -0.8, of [-3, 3]. Inside of the ball one sheet is before them, behind it two.
  for (int k = 0; k < 2; ++k) {
    const auto& pieces = found.lines[k].pieces;
    ASSERT_EQ(pieces.size(), 3u);
    EXPECT_NEAR(pieces[0].t.hi, 2.2 / 6, 1e-9);
    EXPECT_NEAR(pieces[1].t.hi, 3.8 / 6, 1e-9);
    EXPECT_EQ(pieces[0].layers, 0);
    EXPECT_EQ(pieces[1].layers, k == 0 ? 1 : 2);
    EXPECT_EQ(pieces[2].layers, 0);
  }
  ASSERT_EQ(found.lines[2].pieces.size(), 1u);
  EXPECT_EQ(found.lines[2].pieces[0].layers, 0);
}

// A line of 22 pixels, of which 2 are in the picture, and a box before it that ends one pixel outside of the picture:
// its edges are not followed there.
TEST(VisibleLines, InThePictureWhateverIsOutside) {
  SmallScene scene;
  show(scene, CurvePtr(std::make_shared<Segment>(Vec3(-320, 0, 0), Vec3(-298, 0, 0))), {"curve"});
  const Frame corner{{-325, -10, 5}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  show(scene, std::make_shared<Body>(box(corner, {24, 20, 3})), {"sharp"});
  scene.model.film.width = 600, scene.model.film.height = 500;
  scene.model.camera = make_camera(ParallelView{{0, 0, 1000}, {0, 0, 0}, {0, 1, 0}, 500}, 600, 500);
  const auto world = scene.world();
  const VisibleLines found = visible_lines(*world, drawing_work(*world));
  for (const VisibleLine& line : found.lines) {
    if (line.stroke.kind != "curve") continue;
    EXPECT_NEAR(line.curve->place(1).p.x, 2, 1e-9);
    EXPECT_EQ(line.pieces.back().layers, 0);
    EXPECT_LT(line.curve->place(line.pieces.back().t.lo).p.x, 0);
  }
}

// Pixels of each kind of lines behind so many sheets.
std::map<std::pair<std::string, int>, double> lengths_of(const std::string& scene) {
  const BuiltText text = build_text(scene);
  EXPECT_EQ(text.said, "");
  const World world(std::make_shared<Model>(text.model));
  std::map<std::pair<std::string, int>, double> lengths;
  for (const VisibleLine& line : visible_lines(world, drawing_work(world)).lines)
    for (const VisiblePiece& piece : line.pieces) {
      constexpr int kParts = 64;
      for (int k = 0; k < kParts; ++k) {
        const auto at = [&](int i) { return line.curve->place(piece.t.lo + piece.t.width() * i / kParts).p; };
        lengths[{line.stroke.kind, piece.layers}] += glm::length(at(k + 1) - at(k));
      }
    }
  return lengths;
}

// A box and a torus that go through one another, twice: as a group shown twice and as four objects.
TEST(VisibleLines, OfAGroupShownTwice) {
  const std::string shapes = R"(geometry:
  b: { type: box, size: [1, 1, 1], center: [0, 0, 0] }
  t: { type: torus_body, major_radius: 0.8, minor_radius: 0.2 }
camera: { type: parallel, from: [6, -9, 5], at: [0, 0, 0], height: 6 }
image: { size: [600, 500] }
drawing: { lines: { sharp: thin, silhouette: thin, hidden: dashed } }
objects:
)";
  const std::string moved = "transform: [{ rotate: 70, axis: [1, 1, 1] }, { translate: [1.8, 0.6, 0.3] }] }\n";
  const std::string group = "  - { shape: { type: group, of: [{ shape: b }, { shape: t }] }";
  const auto twice = lengths_of(shapes + group + " }\n" + group + ", " + moved);
  const auto flat =
      lengths_of(shapes + "  - { shape: b }\n  - { shape: t }\n  - { shape: b, " + moved + "  - { shape: t, " + moved);
  ASSERT_EQ(twice.size(), flat.size());
  for (const auto& [kind, length] : flat) {
    const auto found = twice.find(kind);
    ASSERT_NE(found, twice.end()) << kind.first << " " << kind.second;
    EXPECT_NEAR(found->second, length, 1e-6) << kind.first << " " << kind.second;
  }
}

// Cylinders that touch along lines, seen across the plane of their axes: nothing lies before these lines.
TEST(VisibleLines, OutlinesAlongWhichOthersTouch) {
  for (const char* camera : {"type: parallel, from: [0, -10, 1], at: [0, 0, 1], height: 3",
                             "type: parallel, from: [0, 10, 4], at: [0, 0, 1], height: 3",
                             "type: perspective, from: [0.4, -10, 1], at: [0.4, 0, 1], field_of_view: 20"}) {
    const auto lengths = lengths_of(R"(geometry:
  p: { type: cylinder_body, radius: 0.4, height: 2 }
  q: { type: cylinder_body, radius: 0.4, height: 2, center: [0.8, 0, 0] }
image: { size: [600, 500] }
drawing: { lines: { silhouette: thick, hidden: dashed } }
objects: [{ shape: p }, { shape: q }]
camera: { )" + std::string(camera) + " }\n");
    for (const auto& [kind, length] : lengths)
      if (kind.first == "silhouette" && kind.second > 0) {
        EXPECT_LT(length, 0.1) << camera;
      }
  }
}

TEST(FittedPaths, LieOnThePictures) {
  SmallScene scene;
  show(scene, sphere({0, 0, 0}, 2), {"silhouette", "parameter"}, 7);
  Views views(11);
  views.look(scene, true);
  const auto world = scene.world();
  for (const VisibleLine& line : visible_lines(*world, drawing_work(*world)).lines)
    for (const VisiblePiece& piece : line.pieces) {
      const Path path = fitted_path(*line.curve, piece.t, {}, 0.01);
      Vec2 from = path.from;
      for (const PathStep& step : path.steps) {
        for (const double s : {0.1, 0.3, 0.5, 0.7, 0.9}) {
          const Vec2 p = point_on(from, step, s);
          double nearest = kInfinity;
          for (size_t cell = 0; cell < line.curve->cells().size(); ++cell) {
            const auto& of = line.curve->cells()[cell];
            if (glm::length(0.5 * (of.begin + of.end) - p) > 60) continue;
            for (int i = 0; i <= 200; ++i)
              nearest = std::min(nearest, glm::length(line.curve->place(of.t.lo + of.t.width() * i / 200).p - p));
          }
          EXPECT_LT(nearest, 0.07);  // between places that are 0.12 pixels apart
        }
        from = step.to;
      }
    }
}

}  // namespace
}  // namespace lekalo::render::hidden_lines_test
