// The visible and hidden pieces of all lines of solids against an oracle of closed forms (support/sight_oracle.h):
// at random places of each line, and on both sides of every transition, a ten-millionth of the line away.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/point_formulas.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/implicit/implicit_surface.h"
#include "geometry/shapes/tube/balls.h"
#include "geometry/shapes/tube/tube.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/transformed.h"
#include "render/drawing/line_truth.h"
#include "render/drawing/random_solids.h"
#include "render/scene/build/load.h"
#include "support/implicit_oracle.h"
#include "support/sight_oracle.h"
#include "support/tier.h"

namespace lekalo::render::drawing_truth_test {
namespace {

using namespace geometry;
const std::vector<std::string> kAll = {"sharp", "smooth", "silhouette", "parameter"};

TEST(DrawingTruth, SingleSolids) {
  constexpr const char* kNames[] = {"box", "cylinder", "cone", "ball", "torus"};
  for (int kind = 0; kind < 5; ++kind) {
    Views views(11 + static_cast<unsigned>(kind));
    Found found;
    for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
      SmallScene scene;
      const Part part = random_part(views, kind, 0.5);
      show(scene, std::make_shared<Body>(part.body), kAll, 5);
      views.look(scene, k % 2);
      Truth(*scene.world(), sheets_of(std::vector<SolidPtr>{part.solid}), views, found);
    }
    expect_right(found, kNames[kind]);
  }
}

// Solids that pierce one another, each an object of its own.
TEST(DrawingTruth, ManySolids) {
  Views views(29);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    std::vector<SolidPtr> solids;
    for (int i = 0; i < 4; ++i) {
      const Part part = random_part(views, k + i, 1.2);
      show(scene, std::make_shared<Body>(part.body), kAll, 2);
      solids.push_back(part.solid);
    }
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets_of(solids), views, found);
  }
  expect_right(found, "many");
}

TEST(DrawingTruth, TwoCrossingTori) {
  Views views(31);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    std::vector<SolidPtr> solids;
    for (int i = 0; i < 2; ++i) {
      const Part part = random_part(views, 4, 0.6);
      show(scene, std::make_shared<Body>(part.body), {"silhouette", "parameter"}, 6);
      solids.push_back(part.solid);
    }
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets_of(solids), views, found);
  }
  expect_right(found, "tori");
}

// A body minus one, and another united with it.
TEST(DrawingTruth, Csg) {
  Views views(37);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    const Part a = random_part(views, k, 0.3), b = random_part(views, k + 1 + k / 5, 0.7),
               c = random_part(views, k / 3, 0.9);
    const auto shape = [](const Part& part) -> ShapePtr {
      return std::make_shared<BodyShape>(std::make_shared<Body>(part.body));
    };
    ShapePtr solid;
    try {
      const auto rest = std::make_shared<Csg>(Csg::Operation::subtract, std::vector<ShapePtr>{shape(a), shape(b)});
      solid = std::make_shared<Csg>(Csg::Operation::unite, std::vector<ShapePtr>{rest, shape(c)});
    } catch (const std::invalid_argument&) {
      continue;
    }
    show(scene, solid, {"sharp", "silhouette"});
    using Kind = oracle::sight::PairSolid::Kind;
    const auto rest = std::make_shared<oracle::sight::PairSolid>(Kind::subtract, a.solid, b.solid);
    views.look(scene, k % 2);
    Truth(*scene.world(),
          sheets_of(std::vector<SolidPtr>{std::make_shared<oracle::sight::PairSolid>(Kind::unite, rest, c.solid)}),
          views, found);
  }
  expect_right(found, "csg");
}

// A tube about a helix that goes through the slot of a plate.
TEST(DrawingTruth, HelixThroughASlottedPlate) {
  Views views(53);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    const double radius = views.number(0.12, 0.25), pitch = views.number(0.09, 0.16), turns = 2;
    const auto helix = std::make_shared<FormulaCurve>(
        point_formulas({"cos(t)", "sin(t)", "(t - 2*pi)*" + std::to_string(pitch)}, {"t"}),
        Interval{0, turns * kTwoPi});
    const double law = std::stod(std::to_string(pitch));
    show(scene, ShapePtr(std::make_shared<Tube>(helix, RadiusLaw(radius), Caps::round)),
         {"sharp", "silhouette", "section"}, 0, {{0.5 * views.direction(), views.direction()}});
    Frame plate = frame_from({-2, -1.8, -0.1}, {0, 0, 1}, {1, 0, 0}), slot = plate;
    slot.origin = {-1.4, -0.4, -0.2};
    const Vec3 size(4, 3.6, 0.2), hole(2.8, 0.8, 0.4);
    const auto shape = [](const Body& body) -> ShapePtr {
      return std::make_shared<BodyShape>(std::make_shared<Body>(body));
    };
    show(scene,
         ShapePtr(std::make_shared<Csg>(Csg::Operation::subtract,
                                        std::vector<ShapePtr>{shape(box(plate, size)), shape(box(slot, hole))})),
         {"sharp", "silhouette"});
    views.look(scene, k % 2);
    using oracle::sight::Real;
    const auto tube = std::make_shared<oracle::sight::TubeSolid>(
        [law](Real t) {
          return oracle::sight::Real3{std::cos(t), std::sin(t), (t - 2 * std::acos(-1.0L)) * Real(law)};
        },
        turns * kTwoPi, radius);
    const auto cut = std::make_shared<oracle::sight::PairSolid>(oracle::sight::PairSolid::Kind::subtract,
                                                                std::make_shared<oracle::sight::BoxSolid>(plate, size),
                                                                std::make_shared<oracle::sight::BoxSolid>(slot, hole));
    Truth(*scene.world(), sheets_of(std::vector<SolidPtr>{tube, cut}), views, found, 4);
  }
  expect_right(found, "helix");
}

// Balls in one shape.
TEST(DrawingTruth, Balls) {
  Views views(59);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(25)); ++k) {
    SmallScene scene;
    std::vector<Vec3> centers;
    std::vector<double> radii;
    SolidPtr all;
    for (int i = 0; i < 5; ++i) {
      const Frame frame = anywhere(views, 1.2);
      centers.push_back(frame.origin), radii.push_back(views.number(0.4, 1));
      const SolidPtr one = std::make_shared<oracle::sight::BallSolid>(frame, radii.back());
      using oracle::sight::PairSolid;
      all = all ? std::make_shared<PairSolid>(PairSolid::Kind::unite, all, one) : one;
    }
    show(scene, ShapePtr(std::make_shared<Balls>(centers, radii)), {"sharp", "silhouette", "section"}, 0,
         {{0.3 * views.direction(), views.direction()}, {centers[0], views.direction()}});
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets_of(std::vector<SolidPtr>{all}), views, found);
  }
  expect_right(found, "balls");
}

// Implicit surfaces by formulas that are written twice, whole and cut off by a box or a ball, open and closed, each
// moved with its object or as a shape.
struct Sphere {
  static constexpr const char* text = "x^2 + y^2 + z^2 - 1.44";
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return x * x + y * y + z * z - T(1.44);
  }
};
struct Ring {
  static constexpr const char* text = "(x^2 + y^2 + z^2 + 0.84)^2 - 4*(x^2 + y^2)";
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T a = x * x + y * y + z * z + T(0.84);
    return a * a - T(4.0) * (x * x + y * y);
  }
};
struct TwoRings {
  static constexpr const char* text = "((x + 1)*x^2*(x - 1) + y^2)^2 + z^2 - 0.02";
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T a = (x + T(1.0)) * x * x * (x - T(1.0)) + y * y;
    return a * a + z * z - T(0.02);
  }
};
struct Clebsch {
  static constexpr const char* text =
      "81*(x^3 + y^3 + z^3) - 189*(x^2*(y + z) + y^2*(x + z) + z^2*(x + y)) + 54*x*y*z + 126*(x*y + y*z + z*x)"
      " - 9*(x^2 + y^2 + z^2) - 9*(x + y + z) + 1";
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return T(81.0) * (x * x * x + y * y * y + z * z * z) -
           T(189.0) * (x * x * (y + z) + y * y * (x + z) + z * z * (x + y)) + T(54.0) * x * y * z +
           T(126.0) * (x * y + y * z + z * x) - T(9.0) * (x * x + y * y + z * z) - T(9.0) * (x + y + z) + T(1.0);
  }
};

// Of a surface that bounds nothing every crossing counts.
Sheets sheets_of_open(const oracle::sight::Solid& surface) {
  return [&surface](const Vec3& from, const Vec3& point, double contact) {
    using oracle::sight::Real;
    const oracle::sight::Real3 o{from.x, from.y, from.z};
    const oracle::sight::Real3 d{Real(point.x) - o.x, Real(point.y) - o.y, Real(point.z) - o.z};
    const Real length = std::sqrt(oracle::sight::dot(d, d));
    std::vector<Real> t;
    surface.crossings(o, d, contact / length, t);
    const auto before = [&](double free) {
      return std::count_if(t.begin(), t.end(), [&](Real at) { return at > 0 && at < 1 - free / length; });
    };
    const auto layers = before(kOwn);
    return layers == before(kOwnToo) ? static_cast<int>(layers) : -1;
  };
}

template <class F>
void expect_implicit(const char* name, const Vec3& half, bool is_ball, bool closed, unsigned seed, int least = 12) {
  auto formula = std::get<Expression>(Expression::parse(F::text));
  const std::vector<Expression::Variable> variables{{"x"}, {"y"}, {"z"}};
  ASSERT_FALSE(formula.bind(variables));
  const ShapePtr surface =
      std::make_shared<ImplicitSurface>(formula, 0, ImplicitRegion{{-half, half}, is_ball}, closed);
  const auto truth = std::make_shared<oracle::sight::ImplicitSheets<F>>(-half, half, is_ball, closed);
  Views views(seed);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(least)); ++k) {
    SmallScene scene;
    const Affine map = Affine::translation(0.5 * views.direction());
    Look look;
    look.lines.emplace();
    for (const char* kind : {"sharp", "boundary", "silhouette", "section"}) look.lines->styles[kind] = Style();
    look.lines->planes.push_back({0.3 * views.direction(), views.direction()});
    ClassicLook white;
    scene.add(k % 3 == 0 ? transformed(surface, map) : surface, make_material(white));
    if (k % 3 == 1) scene.model.objects.back().transform = map;
    scene.model.objects.back().look = std::make_shared<const Look>(look);
    views.look(scene, k % 2);
    const Affine back = k % 3 < 2 ? map.inverse() : Affine();
    const Sheets own = closed ? sheets_of(std::vector<SolidPtr>{truth}) : sheets_of_open(*truth);
    Truth(
        *scene.world(),
        [&](const Vec3& from, const Vec3& point, double contact) {
          return own(back.point(from), back.point(point), contact);
        },
        views, found, 6);
  }
  expect_right(found, name);
}

TEST(DrawingTruth, ImplicitSphere) { expect_implicit<Sphere>("sphere", Vec3(1.5), false, false, 61); }
TEST(DrawingTruth, ImplicitSphereInASmallerBox) { expect_implicit<Sphere>("cut sphere", Vec3(0.9), false, true, 67); }
TEST(DrawingTruth, ImplicitRing) { expect_implicit<Ring>("ring", Vec3(1.5), false, false, 71); }
TEST(DrawingTruth, ImplicitRingInABall) { expect_implicit<Ring>("ring in a ball", Vec3(1.2), true, true, 73); }
TEST(DrawingTruth, OpenImplicitRing) { expect_implicit<Ring>("open ring", Vec3(1.6, 1.1, 0.3), false, false, 79); }
TEST(DrawingTruth, ImplicitTwoRings) { expect_implicit<TwoRings>("two rings", Vec3(1.3, 0.9, 0.1), false, true, 83); }
TEST(DrawingTruth, ImplicitCubic) { expect_implicit<Clebsch>("cubic", Vec3(2), true, false, 89); }
TEST(DrawingTruth, ClosedImplicitCubic) { expect_implicit<Clebsch>("closed cubic", Vec3(1.2), false, true, 97); }

// A bicubic sheet that hides parts of itself, with its net of parameter lines.
TEST(DrawingTruth, Saddles) {
  Views views(41);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    Grid<Vec3> net{4, 4, {}};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        net.values.push_back(
            {i - 1.5 + views.number(-0.3, 0.3), j - 1.5 + views.number(-0.3, 0.3),
             (i == 0 || i == 3) == (j == 0 || j == 3) ? views.number(0.5, 1.5) : views.number(-1.5, -0.5)});
    const SurfaceSet sheet{std::make_shared<NurbsSurface>(bezier_surface(net))};
    show(scene, sheet, {"boundary", "silhouette", "parameter"}, 4);
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets_of_patches(sheet), views, found, 4);
  }
  expect_right(found, "saddle", true);
}

// The picture of a border turns back within a third of a pixel and crosses itself there; a parameter line runs along
// it.
TEST(DrawingTruth, ParameterLineAlongABorderThatCrossesItself) {
  Views views(41);
  Found found;
  SmallScene scene;
  Grid<Vec3> net{4,
                 4,
                 {{-1.6589285356373071, -1.6457253639416174, 0.57582357546722995},
                  {-1.7027181940974576, -0.24870666857087226, -1.0551306815721824},
                  {-1.5786541464464161, 0.48882805168822224, -0.64048852956151903},
                  {-1.7948879513651992, 1.5461084006902204, 0.73184986694783138},
                  {-0.64826928535226258, -1.6790149401260273, -0.69335505388366359},
                  {-0.4728611338405308, -0.78956406957263736, 1.2815017226622354},
                  {-0.43781584761993797, 0.78320519319708604, 1.4034384736006482},
                  {-0.25432127206778116, 1.6375164566195983, -1.1588961631817256},
                  {0.43359365456615467, -1.7658198171444655, -0.81934099378674607},
                  {0.35186288835679391, -0.2563709166633486, 0.50466402317217041},
                  {0.78054932376677266, 0.52604537005052121, 1.0390500098128399},
                  {0.53666055023025439, 1.5004761934054613, -0.87697347749439591},
                  {1.6406767933813751, -1.5130872232880335, 0.82974620759265627},
                  {1.2948489346251837, -0.49422913909938704, -0.79583334523390148},
                  {1.7747342109983022, 0.75219442620819188, -0.64779042291505418},
                  {1.3253326983605545, 1.2486561616228182, 0.64144977974442607}}};
  const SurfaceSet sheet{std::make_shared<NurbsSurface>(bezier_surface(net))};
  show(scene, sheet, {"boundary", "silhouette", "parameter"}, 4);
  scene.model.film.width = 600;
  scene.model.film.height = 500;
  const Vec3 from(-0.45412173569972791, -12.711111028054633, -1.0767748210944461),
      lower(-0.45614273787320864, -12.71237905228244, -1.060953706570732);
  scene.model.camera = make_camera(ParallelView{from, {0, 0, 0}, from - lower, 8}, 600, 500);
  Truth(*scene.world(), sheets_of_patches(sheet), views, found, 40);
  expect_right(found, "border", true);
}

// Two sheets that pierce one another.
TEST(DrawingTruth, CrossingSheets) {
  Views views(43);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    SurfaceSet all;
    for (int n = 0; n < 2; ++n) {
      all.push_back(sheet_through_the_middle(views, n == 0));
      show(scene, SurfaceSet{all.back()}, {"boundary", "silhouette", "parameter"}, 4);
    }
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets_of_patches(all), views, found, 4);
  }
  expect_right(found, "sheets", true);
}

// A picture of a small part of them: lines come into it and leave it, and cross one another outside of it.
TEST(DrawingTruth, LinesThatLeaveThePicture) {
  Views views(49);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    SurfaceSet all;
    for (int n = 0; n < 3; ++n) {
      all.push_back(sheet_through_the_middle(views, n == 0));
      show(scene, SurfaceSet{all.back()}, {"boundary", "silhouette", "parameter"}, 4);
    }
    views.look(scene, k % 2);
    const Vec3 from = 9.0 * views.direction(), at = 0.8 * views.direction(), up = views.direction();
    scene.model.camera = k % 2 ? make_camera(PerspectiveView{from, at, up, 0.08}, 600, 500)
                               : make_camera(ParallelView{from, at, up, 0.7}, 600, 500);
    Truth(*scene.world(), sheets_of_patches(all), views, found, 4);
  }
  expect_right(found, "leaving", true);
}

SurfaceSet teapot() {
  const auto file = std::filesystem::path(LEKALO_SOURCE_DIR) / "tools/benchmarks/scenes/teapot_lines.yaml";
  return std::get<SurfaceSet>(load_scene(file).model->objects.front().shape);
}

// Its borders begin in corners of other patches and leave them flatly: within kOwn they cannot be told from these.
constexpr double kOwnOfTeapot = 1e-10;

TEST(DrawingTruth, Teapot) {
  const SurfaceSet patches = teapot();
  Views views(47);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::min_of_slow(50)); ++k) {
    SmallScene scene;
    show(scene, patches, {"boundary", "silhouette"});
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets_of_patches(patches, kOwnOfTeapot), views, found, 2);
  }
  expect_right(found, "teapot", true);
}

// Views in which a border goes round the patches on both of its sides within a tenth of a pixel, and the sheet before
// it is hardly farther from it than rounding.
TEST(DrawingTruth, BordersThatGoRoundBothPatches) {
  const SurfaceSet patches = teapot();
  Views views(48);
  Found found;
  const auto parallel = [](const Vec3& from, const Vec3& up) {
    return make_camera(ParallelView{from, {0, 0, 0}, up, 8}, 600, 500);
  };
  const CameraPtr looks[] = {
      parallel({-2.3881252886757931, 0.053492772792936398, 8.3183028872178575},
               {0.89759782110730879, -0.21234445094578325, 0.3863003827281889}),
      parallel({-0.63754637014392401, -3.2642124343280052, 12.534762215298167},
               {-0.018027148372679158, -0.57222453054955569, -0.81989884044245986}),
      parallel({4.259357131986147, -2.7276068707000864, 5.0691975375063798},
               {-0.6546759361853034, -0.35223679148883635, 0.66882633119633295}),
      // Two borders run within 1e-4 pixels from a corner of patches to where they cross.
      make_camera(PerspectiveView{{-1.0124405364578373, -5.5687574570734331, -6.7529161476931652},
                                  {0, 0, 0},
                                  {-0.46861062856179164, -0.76549182463477961, -0.44093802877075411},
                                  1},
                  600, 500),
      // A border begins in a corner of other patches, tangent to them, and goes inside: hidden from there on, though no
      // farther behind them than 1e-8 for a twentieth of a pixel (it is at x = -2 + 0.3 t^2, y = -0.9 t, they are at
      // x = -2 + 0.234 y^2 there).
      make_camera(PerspectiveView{{-7.9012506249502632, 0.6630499635197481, -0.066248264033258425},
                                  {0, 0, 0},
                                  {0.013180450839370583, 0.16991162733213933, 0.12857473319112817},
                                  1},
                  600, 500),
      make_camera(PerspectiveView{{-6.1213221197165977, 2.1158066111313802, 3.715907418745243},
                                  {0, 0, 0},
                                  {-0.054117921339510877, 0.12801811343022479, -0.16204246550151991},
                                  1},
                  600, 500),
  };
  for (const CameraPtr& look : looks) {
    SmallScene scene;
    show(scene, patches, {"boundary", "silhouette"});
    scene.model.film.width = 600;
    scene.model.film.height = 500;
    scene.model.camera = look;
    Truth(*scene.world(), sheets_of_patches(patches, kOwnOfTeapot), views, found, 2);
  }
  expect_right(found, "borders", true);
}

}  // namespace
}  // namespace lekalo::render::drawing_truth_test
