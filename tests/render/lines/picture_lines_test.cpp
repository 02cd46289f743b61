// Lines of constant width: their area in each pixel, where they are seen on surfaces and hidden behind others.
#include "render/lines/picture_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/tube/tube.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/torus.h"
#include "render/film/render.h"
#include "render/model/look.h"
#include "render/small_scene.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::render::picture_lines_test {
namespace {

using namespace geometry;

constexpr double kMillimetre = 96 / 25.4;  // in pixels, of a picture without a size on paper

// A white picture; lines are black.
struct LineScene : SmallScene {
  LineScene(int width, int height, int samples) {
    model.background = {1, 1, 1};
    model.film.width = width;
    model.film.height = height;
    model.film.samples = samples;
    light(AmbientLight{.intensity = 1});
  }

  static Style style(double pixels, const std::string& cap = "butt") {
    Style style;
    style.width = pixels / kMillimetre;
    style.cap = cap;
    return style;
  }
  // A shape whose lines of one kind are drawn.
  LineScene& draw(Entity shape, const std::string& kind, const Style& style, HiddenLines hidden = {}) {
    Lines lines;
    lines.styles[kind] = style;
    lines.hidden = hidden;
    return show(std::move(shape), lines);
  }
  LineScene& show(Entity shape, const Lines& lines) {
    Look look;
    look.lines = lines;
    add(std::move(shape), white());
    model.objects.back().look = std::make_shared<const Look>(look);
    return *this;
  }
  static MaterialPtr white() {
    ClassicLook look;
    look.color = 1.0;
    look.ambient = 1.0;
    look.diffuse = 0.0;
    look.specular = 0.0;
    return make_material(look);
  }
  // One unit of the plane y = 0 is one pixel, the origin in the middle; x goes right and z up.
  LineScene& plain_view() {
    model.camera = make_camera(ParallelView{{0, -1000, 0}, {0, 0, 0}, {0, 0, 1}, 1.0 * model.film.height},
                               model.film.width, model.film.height);
    return *this;
  }
  Image picture() const { return render(*world(), {}).image; }
};

double ink(const Image& image, int x, int y) {
  return 1 - image.channels[0].values[static_cast<size_t>(y) * image.width + x];
}

// Area of the pixel for whose places inside(place) holds, by a fine lattice; exact to about 1/n^1.5.
template <class Inside>
double area(int x, int y, const Inside& inside) {
  constexpr int n = 32;
  int count = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) count += inside(Vec2(x + (i + 0.5) / n, y + (j + 0.5) / n));
  return 1.0 * count / (n * n);
}

struct Difference {
  double largest = 0, sum = 0;
};
template <class Inside>
Difference compare(const Image& image, const Inside& inside) {
  Difference result;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double off = ink(image, x, y) - area(x, y, inside);
      result.largest = tests::worse(result.largest, std::abs(off));
      result.sum += off;
    }
  return result;
}

Vec2 picture_of(const Camera& camera, const Vec3& p) {
  const PicturePoint at = camera.project(p);
  return {at.x, at.y};
}

TEST(PictureLines, StraightLineCoversItsStrip) {
  for (const double width : {1.0, 2.7, 6.0})
    for (const double angle : {0.0, 0.3, 0.9}) {
      LineScene scene(60, 50, 256);
      const Vec3 along(std::cos(angle), 0, std::sin(angle));
      scene.plain_view().draw(CurvePtr(std::make_shared<Segment>(-18.0 * along, 15.0 * along)), "curve",
                              LineScene::style(width));
      const Vec2 a = picture_of(*scene.model.camera, -18.0 * along), b = picture_of(*scene.model.camera, 15.0 * along);
      const Vec2 unit = glm::normalize(b - a);
      const Difference d = compare(scene.picture(), [&](const Vec2& q) {
        const Vec2 off = q - a;
        const double s = glm::dot(off, unit);
        return s >= 0 && s <= glm::length(b - a) && std::abs(unit.x * off.y - unit.y * off.x) <= 0.5 * width;
      });
      EXPECT_LT(d.largest, 0.05) << width << " " << angle;
      EXPECT_LT(std::abs(d.sum), 0.01 * 33 * width) << width << " " << angle;
    }
}

TEST(PictureLines, CapsEndTheStrip) {
  for (const char* cap : {"round", "square"}) {
    LineScene scene(40, 30, 256);
    scene.plain_view().draw(CurvePtr(std::make_shared<Segment>(Vec3(-8, 0, -3), Vec3(7, 0, 5))), "curve",
                            LineScene::style(7, cap));
    const Vec2 a = picture_of(*scene.model.camera, {-8, 0, -3}), b = picture_of(*scene.model.camera, {7, 0, 5});
    const Vec2 unit = glm::normalize(b - a);
    const bool round = cap == std::string("round");
    const Difference d = compare(scene.picture(), [&](const Vec2& q) {
      const double s = glm::dot(q - a, unit), length = glm::length(b - a);
      const double across = std::abs(unit.x * (q - a).y - unit.y * (q - a).x);
      const double beyond = std::max({0.0, -s, s - length});
      return round ? std::hypot(beyond, across) <= 3.5 : beyond <= 3.5 && across <= 3.5;
    });
    EXPECT_LT(d.largest, 0.05) << cap;
  }
}

TEST(PictureLines, CircleCoversItsRing) {
  for (const double radius : {0.4, 1.5, 11.0, 21.0}) {
    LineScene scene(60, 60, 256);
    Frame frame = frame_about({3, 0, 2}, {0, 1, 0});
    scene.plain_view().draw(CurvePtr(std::make_shared<Circle>(frame, radius)), "curve", LineScene::style(2.2));
    const Vec2 middle = picture_of(*scene.model.camera, {3, 0, 2});
    const Difference d =
        compare(scene.picture(), [&](const Vec2& q) { return std::abs(glm::length(q - middle) - radius) <= 1.1; });
    EXPECT_LT(d.largest, 0.06) << radius;
  }
}

TEST(PictureLines, CornersAreRound) {
  LineScene scene(60, 60, 256);
  const std::vector<Vec3> corners{{-15, 0, -10}, {0, 0, 14}, {3, 0, -12}, {18, 0, -8}};
  scene.plain_view().draw(CurvePtr(std::make_shared<NurbsCurve>(polyline(corners))), "curve",
                          LineScene::style(5, "round"));
  const Camera& camera = *scene.model.camera;
  const Difference d = compare(scene.picture(), [&](const Vec2& q) {
    for (size_t i = 0; i + 1 < corners.size(); ++i) {
      const Vec2 a = picture_of(camera, corners[i]), b = picture_of(camera, corners[i + 1]);
      const double s = std::clamp(glm::dot(q - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
      if (glm::length(q - (a + s * (b - a))) <= 2.5) return true;
    }
    return false;
  });
  EXPECT_LT(d.largest, 0.05);
}

// A hairline has the ink of its width in every column, with one sample a pixel and with many.
TEST(PictureLines, HairlinesHaveNoGaps) {
  for (const int samples : {1, 16}) {
    LineScene scene(80, 40, samples);
    scene.model.film.contrast = samples > 1 ? 0.03 : 0;
    scene.plain_view().draw(CurvePtr(std::make_shared<Segment>(Vec3(-50, 0, -11), Vec3(50, 0, 14))), "curve",
                            LineScene::style(0.3));
    const Image image = scene.picture();
    const double expected = 0.3 * std::hypot(1, 0.25);
    double sum = 0;
    for (int x = 0; x < 80; ++x) {
      double column = 0;
      for (int y = 0; y < 40; ++y) column += ink(image, x, y);
      sum += column;
      EXPECT_GT(column, 0.9 * 0.3) << x;
      EXPECT_LT(column, samples == 1 ? 0.61 : 1.2 * expected) << x;
    }
    EXPECT_NEAR(sum / 80, expected, samples == 1 ? 0.02 : 0.005);
  }
}

TEST(PictureLines, DashesHaveTheirLengths) {
  LineScene scene(100, 20, 64);
  Style style = LineScene::style(4);
  style.dash = {10 / kMillimetre, 5 / kMillimetre};
  scene.plain_view().draw(CurvePtr(std::make_shared<Segment>(Vec3(-40, 0, 0), Vec3(35, 0, 0))), "curve", style);
  const Image image = scene.picture();
  for (int x = 0; x < 100; ++x) {
    const double s = x + 0.5 - 10;
    const bool drawn = s > 0 && s < 75 && std::fmod(s, 15) < 10;
    EXPECT_NEAR(ink(image, x, 10), drawn ? 1 : 0, 1e-6) << x;
  }
}

// Circles of latitude on a sphere, of which the front half is seen, from the side and nearly along them.
TEST(PictureLines, LinesOnASphereAreSeenToTheOutline) {
  for (const double elevation : {0.02, 0.4, 1.2}) {
    LineScene scene(160, 160, 64);
    const Vec3 to_viewer(0, -std::cos(elevation), std::sin(elevation));
    const Vec3 up(0, std::sin(elevation), std::cos(elevation));
    scene.model.camera = make_camera(ParallelView{1000.0 * to_viewer, {}, up, 160}, 160, 160);
    Lines lines;
    lines.styles["parameter"] = LineScene::style(1.5);
    lines.at_v.values = {0.5};
    scene.show(sphere({}, 60), lines);
    const double radius = 60 * std::cos(0.5), height = 60 * std::sin(0.5);
    const Camera& camera = *scene.model.camera;
    // The circle is the picture of points (r cos t, r sin t, h), seen where n . to_viewer > 0.
    std::vector<Vec2> seen;
    for (int i = 0; i < 20000; ++i) {
      const double t = kTwoPi * i / 20000;
      const Vec3 p(radius * std::cos(t), radius * std::sin(t), height);
      if (glm::dot(p, to_viewer) > 0) seen.push_back(picture_of(camera, p));
    }
    double ink_sum = 0, expected = 0;
    const Image image = scene.picture();
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 160; ++x) ink_sum += ink(image, x, y);
    for (size_t i = 1; i < seen.size(); ++i) {
      const double step = glm::length(seen[i] - seen[i - 1]);
      if (step < 1) expected += 1.5 * step;
    }
    // Interaction from 0.02 the front and the ends of the strip lie over one another.
    EXPECT_NEAR(ink_sum, expected, elevation < 0.1 ? 8 : 0.02 * expected) << elevation;
    // Without a gap: the middle of the line is black wherever it is seen, but for its ends.
    for (const Vec2& p : seen) {
      const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
      double near = 0;
      for (int k = -1; k <= 1; ++k) near = std::max(near, ink(image, x, y + k));
      EXPECT_GT(near, 0.4) << elevation << ": " << x << ", " << y;
    }
  }
}

// Lines of a plane seen at a tenth of a degree, all of them complete.
TEST(PictureLines, LinesOnAPlaneAreSeenAtGrazingAngles) {
  for (const double degrees : {0.1, 2.0, 30.0}) {
    const double angle = degrees * kPi / 180;
    LineScene scene(120, 60, 64);
    scene.model.camera =
        make_camera(ParallelView{1000.0 * Vec3(0, -std::cos(angle), std::sin(angle)), {}, {0, 0, 1}, 60}, 120, 60);
    Lines lines;
    lines.styles["parameter"] = LineScene::style(3);
    lines.at_v.values = {0};
    const double deep = 25 / std::sin(angle);
    scene.show(plane_part(Frame(), {-50, 50}, {-deep, deep}), lines);
    const Image image = scene.picture();
    for (int x = 11; x < 109; ++x) {
      double column = 0;
      for (int y = 0; y < 60; ++y) column += ink(image, x, y);
      EXPECT_NEAR(column, 3, 0.02) << degrees << ": " << x;
    }
  }
}

TEST(PictureLines, AreHiddenBehindThinThings) {
  // A sheet a thousandth of a pixel before the line hides it at right angles only if it is before it by more than
  // nobody sees: a tenth of a pixel is enough.
  LineScene scene(60, 60, 64);
  scene.plain_view();
  scene.draw(CurvePtr(std::make_shared<Segment>(Vec3(-25, 0, 0), Vec3(25, 0, 0))), "curve", LineScene::style(5));
  scene.add(plane_part(Frame{{0, -0.1, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {-10, 30}, {-10, 10}),
            LineScene::white());
  const Image image = scene.picture();
  for (int x = 0; x < 60; ++x) {
    double column = 0;
    for (int y = 0; y < 60; ++y) column += ink(image, x, y);
    EXPECT_NEAR(column, x >= 5 && x < 20 ? 5 : 0, 1e-6) << x;
  }
}

// The outline of a ball in front cuts the line: no place of the ball shows it.
TEST(PictureLines, OutlinesInFrontCutThem) {
  LineScene scene(80, 80, 64);
  scene.plain_view();
  scene.draw(CurvePtr(std::make_shared<Segment>(Vec3(-35, 0, 18), Vec3(35, 0, 18))), "curve", LineScene::style(8));
  scene.add(sphere({0, -300, 0}, 20), LineScene::white());
  const Difference d = compare(scene.picture(), [](const Vec2& q) {
    const Vec2 off = q - Vec2(40, 40);
    // Where the middle of the line is hidden the whole width is.
    const bool hidden = glm::length(off) < 20 || std::abs(off.x) < std::sqrt(20.0 * 20 - 18 * 18);
    return std::abs(off.y + 18) <= 4 && std::abs(off.x) <= 35 && !hidden;
  });
  EXPECT_LT(d.largest, 0.06);
}

TEST(PictureLines, HiddenPartsHaveTheirOwnLook) {
  HiddenLines faded;
  faded.way = HiddenLines::Way::faded;
  LineScene scene(60, 20, 16);
  scene.plain_view();
  scene.draw(CurvePtr(std::make_shared<Segment>(Vec3(-30, 0, 0), Vec3(30, 0, 0))), "curve", LineScene::style(4), faded);
  scene.add(plane_part(Frame{{0, -5, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {0, 30}, {-10, 10}), LineScene::white());
  const Image image = scene.picture();
  EXPECT_NEAR(ink(image, 15, 10), 1, 1e-6);
  EXPECT_NEAR(ink(image, 45, 10), 1.0 / 3, 1e-6);
  EXPECT_NEAR(ink(image, 45, 2), 0, 1e-6);
}

TEST(PictureLines, LaterLinesLieOnTop) {
  LineScene scene(40, 40, 4);
  Style red = LineScene::style(4);
  red.color = {1, 0, 0};
  scene.plain_view();
  // In one plane that the camera sees at an angle.
  const Vec3 u = glm::normalize(Vec3(1, 2, 0)), v = glm::normalize(Vec3(0, 3, 1));
  scene.draw(CurvePtr(std::make_shared<Segment>(-15.0 * u, 15.0 * u)), "curve", LineScene::style(4));
  scene.draw(CurvePtr(std::make_shared<Segment>(-30.0 * v, 30.0 * v)), "curve", red);
  const Image image = scene.picture();
  for (int y = 12; y < 28; ++y)
    for (int x = 19; x <= 20; ++x) EXPECT_EQ(image.channels[0].values[static_cast<size_t>(y) * 40 + x], 1) << x << y;
}

TEST(PictureLines, LayersDescribeTheLine) {
  LineScene scene(60, 40, 4);
  scene.plain_view();
  Lines lines;
  lines.styles["parameter"] = LineScene::style(6);
  lines.at_v.values = {0};
  scene.add(sphere({0, 500, 0}, 1), LineScene::white());
  scene.show(plane_part(frame_about({0, 7, 0}, {0, -1, 0}), {-50, 50}, {-50, 50}), lines);
  const Image image = scene.picture();
  const size_t i = 20 * 60 + 30;
  const auto value = [&](const char* name) {
    for (const Channel& channel : image.channels)
      if (channel.name == name) return channel.ids.empty() ? 1.0 * channel.values[i] : 1.0 * channel.ids[i];
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_NEAR(value("Z"), 1007, 1e-3);
  EXPECT_NEAR(value("P.Y"), 7, 1e-6);
  EXPECT_NEAR(value("N.Y"), -1, 1e-6);
  EXPECT_EQ(value("id.object"), 2);
  EXPECT_EQ(value("id.material"), 0);
  EXPECT_EQ(value("albedo.R"), 0);
}

TEST(PictureLines, PointsAreDots) {
  LineScene scene(40, 40, 256);
  Style style = LineScene::style(1);
  style.marker_size = 9 / kMillimetre;
  scene.plain_view().draw(Vec3(2, 0, 3), "curve", style);
  const Difference d = compare(scene.picture(), [](const Vec2& q) { return glm::length(q - Vec2(22, 17)) <= 4.5; });
  EXPECT_LT(d.largest, 0.05);
  style.marker = "none";
  const Image none = LineScene(40, 40, 1).plain_view().draw(Vec3(2, 0, 3), "curve", style).picture();
  EXPECT_EQ(compare(none, [](const Vec2&) { return false; }).largest, 0);
}

TEST(PictureLines, MeetTheExactSurfaceOnItsMesh) {
  LineScene scene(120, 120, 16);
  scene.model.camera = make_camera(ParallelView{{0, -1000, 700}, {}, {0, 0, 1}, 120}, 120, 120);
  Lines lines;
  lines.styles["parameter"] = LineScene::style(2);
  lines.at_u.count = lines.at_v.count = 12;
  scene.show(SurfacePtr(std::make_shared<TorusSurface>(Frame(), 35, 15)), lines);
  const Image exact = scene.picture();
  scene.model.objects.back().representation = Representation::mesh;
  const Image mesh = scene.picture();
  double a = 0, b = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) a += ink(exact, x, y), b += ink(mesh, x, y);
  // A mesh lies a quarter of a pixel off, and lines that run along an outline are seen as much beyond it.
  EXPECT_NEAR(a, b, 0.03 * a);
}

// Random cubics before all kinds of cameras, by the least distance of many points that Camera::project() gives.
TEST(ProjectedCurve, FindsTheNearestPoint) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  const CameraPtr cameras[] = {make_camera(PerspectiveView{{0.3, -2.2, 0.8}, {}, {0, 0, 1}, 0.9}, 200, 150),
                               make_camera(ParallelView{{1, -3, 2}, {}, {0, 0, 1}, 2.0}, 200, 150),
                               make_camera(ParallelView{{0, -3, 0}, {}, {0, 0, 1}, 2.0, {-0.3, 1, -0.2}}, 200, 150)};
  size_t found = 0;
  for (int trial = 0; trial < static_cast<int>(tests::tier_count(20000)); ++trial) {
    const auto vector = [&] { return Vec3(number(random), number(random), number(random)); };
    const std::vector<Vec3> points{vector(), vector(), vector(), vector()};
    const std::vector<double> weights{1, std::exp(number(random)), std::exp(number(random)), 1};
    const CurvePtr curve = std::make_shared<NurbsCurve>(bezier_curve(points, weights));
    const Affine map = Affine::rotation(3 * number(random), {1, 2, 3}, vector());
    const Camera& camera = *cameras[trial % 3];
    const double reach = 3 + 2.5 * number(random);
    const ProjectedCurve projected(curve, map, camera, reach);
    constexpr int n = 20000;
    std::vector<Vec2> places;
    for (int i = 0; i <= n; ++i) {
      const PicturePoint at = camera.project(map.point(curve->point(1.0 * i / n)));
      if (at.visible_side) places.push_back({at.x, at.y});
    }
    if (places.empty()) continue;
    for (int k = 0; k < 20; ++k) {
      // Near the curve, in the picture.
      const Vec2 q = places[std::uniform_int_distribution<size_t>(0, places.size() - 1)(random)] +
                     1.5 * reach * Vec2(number(random), number(random));
      if (q.x < 0 || q.y < 0 || q.x > 200 || q.y > 150) continue;
      double least = kInfinity;
      for (size_t i = 0; i + 1 < places.size(); ++i) {
        const Vec2 chord = places[i + 1] - places[i];
        if (glm::length(chord) > 5) continue;  // past the eye
        const double s = std::clamp(glm::dot(q - places[i], chord) / std::max(glm::dot(chord, chord), 1e-300), 0., 1.);
        least = std::min(least, glm::length(q - (places[i] + s * chord)));
      }
      double ours = kInfinity;
      for (size_t cell = 0; cell < projected.cells().size(); ++cell)
        if (const auto near = projected.nearest(static_cast<int>(cell), q)) {
          ours = std::min(ours, near->distance);
          const PicturePoint at = camera.project(projected.tangent(near->t).origin);
          EXPECT_LT(glm::length(Vec2(at.x, at.y) - near->place), 0.02);
        }
      if (least > reach - 1e-3 && ours > reach - 1e-3) continue;
      ++found;
      EXPECT_NEAR(ours, least, 0.006) << trial << " reach " << reach << " at " << q.x << ", " << q.y;
    }
  }
  EXPECT_GT(found, 100u);
}

TEST(ProjectedCurve, MapsAgreeWithProject) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const CameraPtr& camera : {make_camera(PerspectiveView{{3, -7, 2}, {1, 0, 0}, {0, 0.2, 1}, 0.7}, 90, 160),
                                  make_camera(ParallelView{{1, -3, 2}, {}, {0, 0, 1}, 3.0, {-0.3, 1, -0.2}}, 90, 70)})
    for (int i = 0; i < 100; ++i) {
      const Vec3 p(number(random), number(random), number(random));
      const PictureMap map = camera->picture_map();
      const double w = glm::dot(map.row[2], Vec4(p, 1));
      const PicturePoint at = camera->project(p);
      EXPECT_EQ(w > 0, at.visible_side);
      EXPECT_NEAR(glm::dot(map.row[0], Vec4(p, 1)) / w, at.x, 1e-10);
      EXPECT_NEAR(glm::dot(map.row[1], Vec4(p, 1)) / w, at.y, 1e-10);
    }
}

// Of a solid put together they are those of its parts, and of a tube those of a body like it.
TEST(PictureLines, ParameterLinesOfSolids) {
  const auto picture = [](const Entity& shape, const ParameterValues& at_u, const ParameterValues& at_v) {
    LineScene scene(200, 160, 4);
    Lines lines;
    lines.styles["parameter"] = LineScene::style(2);
    lines.at_u = at_u, lines.at_v = at_v;
    scene.show(shape, lines);
    scene.model.camera = make_camera(PerspectiveView{{4, 3, 5}, {0, 0, 0.5}, {0, 0, 1}, 0.6}, 200, 160);
    return scene.picture();
  };
  const auto expect_same = [](const Image& a, const Image& b) {
    double all = 0, off = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) all += ink(a, x, y), off += std::abs(ink(a, x, y) - ink(b, x, y));
    EXPECT_GT(all, 500);
    EXPECT_LT(off, 1e-3 * all);
  };
  const auto pin = std::make_shared<Body>(cylinder_body(Frame(), 0.6, 1.5));
  const auto shape_of = [](const BodyPtr& body) { return std::make_shared<BodyShape>(body); };
  const auto core = std::make_shared<Body>(cylinder_body(frame_from({0, 0, 0.2}, {0, 0, 1}, {1, 0, 0}), 0.3, 1));
  expect_same(picture(BodyPtr(pin), {6, {}}, {4, {}}),
              picture(ShapePtr(std::make_shared<Csg>(Csg::Operation::unite,
                                                     std::vector<ShapePtr>{shape_of(pin), shape_of(core)})),
                      {6, {}}, {4, {}}));
  const auto axis = std::make_shared<Segment>(Vec3(0, 0, 0), Vec3(0, 0, 1.5));
  expect_same(picture(SurfacePtr(std::make_shared<CylinderSurface>(Frame(), 0.6, 1.5)), {6, {}}, {4, {}}),
              picture(ShapePtr(std::make_shared<Tube>(axis, RadiusLaw(0.6), Caps::none)), {4, {}}, {6, {}}));
}

// With adaptive sampling a line is the same picture as with all samples everywhere, however thin and wherever it lies:
// no centre of a pixel need be in it.
TEST(PictureLines, ThinLinesAmongThePixelsOfAdaptivePictures) {
  for (const double width : {0.2, 0.6, 1.0, 9.0})
    for (const double offset : {0.0, 0.25, 0.5})
      for (const double slope : {0.0, 0.1, 1e3}) {
        const Vec3 middle(offset, 0, offset), along = glm::normalize(Vec3(1, 0, slope));
        const auto picture = [&](double contrast) {
          LineScene scene(64, 64, 16);
          scene.plain_view();
          scene.model.film.contrast = contrast;
          scene.draw(std::make_shared<Segment>(middle - 20.0 * along, middle + 20.0 * along), "curve",
                     LineScene::style(width));
          return scene.picture();
        };
        const Image adaptive = picture(0.03), even = picture(0);
        double all = 0, off = 0;
        for (int y = 0; y < 64; ++y)
          for (int x = 0; x < 64; ++x) {
            all += ink(adaptive, x, y);
            off = tests::worse(off, std::abs(ink(adaptive, x, y) - ink(even, x, y)));
          }
        EXPECT_LT(off, 1e-6) << width << " " << offset << " " << slope;
        EXPECT_NEAR(all, 40 * width, 0.05 * 40 * width + 2) << width << " " << offset << " " << slope;
      }
}

// Lines of which a clip plane leaves nothing have a number still.
TEST(PictureLines, ClippedAway) {
  LineScene scene(60, 60, 1);
  Lines lines;
  lines.styles["parameter"] = LineScene::style(2);
  lines.at_u.count = lines.at_v.count = 40;
  scene.show(std::make_shared<Body>(ball(Frame(), 1)), lines);
  scene.model.objects.back().clips.push_back({{0, 0, 0.9}, {0, 0, -1}, false});
  scene.model.camera = make_camera(ParallelView{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 2.4}, 60, 60);
  const Image image = scene.picture();
  double all = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) all += ink(image, x, y);
  EXPECT_GT(all, 10);
}

}  // namespace
}  // namespace lekalo::render::picture_lines_test
