// The visible and hidden pieces of all lines of solids against an oracle of closed forms (support/sight_oracle.h):
// at random places of each line, and on both sides of every transition, a ten-millionth of the line away.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "geometry/bodies/primitives.h"
#include "geometry/curves/formula_curve.h"
#include "geometry/point_formulas.h"
#include "geometry/shapes/balls.h"
#include "geometry/shapes/body_shape.h"
#include "geometry/shapes/csg.h"
#include "geometry/shapes/implicit_surface.h"
#include "geometry/shapes/tube.h"
#include "geometry/surfaces/bezier_surface.h"
#include "geometry/transformed.h"
#include "render/drawing/random_solids.h"
#include "render/drawing/visible_lines.h"
#include "render/scene/load.h"
#include "support/implicit_oracle.h"
#include "support/line_oracle.h"
#include "support/sight_oracle.h"
#include "support/tier.h"

namespace lekalo::render {
namespace {

using namespace geometry;
using oracle::sight::SolidPtr;

constexpr double kBisected = 1e-7;   // of a line's domain
constexpr double kSpeck = 0.05;      // pixels: pieces that need not be right
constexpr double kInPicture = 0.01;  // pixels: else no piece is wrong for longer than that
// Sheets nearer than this before a point are its own; where the two bounds tell apart, a nearly touching sheet is near,
// and the oracle does not know. Of outlines, where rounding of 1e-16 makes two crossings 1e-8
// apart of the one contact, also two so near as that; so an outline can be told from its surface only so far (part of
// the line) from a cusp.
constexpr double kOwn = 3e-9, kOwnToo = 3e-8, kContact = 3e-6, kFromCusp = 1e-4;

struct Found {
  int views = 0, lines = 0, places = 0, transitions = 0, incomplete = 0;
  int unclear = 0, unclear_outlines = 0, wrong_places = 0, wrong_transitions = 0;
  int near = 0;  // transitions that are right beside kInPicture alone
};

// How many sheets lie before a point as seen from another; -1: it is not clear. With `contact`, sheets as near together
// or to the point as that only touch the way.
using Sheets = std::function<int(const Vec3& from, const Vec3& point, double contact)>;

Sheets sheets_of(std::vector<SolidPtr> solids) {
  return [solids](const Vec3& from, const Vec3& point, double contact) {
    const int layers = oracle::sight::layers_before(solids, from, point, kOwn, contact);
    return layers == oracle::sight::layers_before(solids, from, point, kOwnToo, contact) ? layers : -1;
  };
}

// Of rational Bezier patches, by halving (support/line_oracle.h).
Sheets sheets_of(const SurfaceSet& surfaces) {
  std::vector<oracle::PatchOracle> patches;
  for (const SurfacePtr& surface : surfaces)
    for (const SurfacePiece& piece : surface->pieces())
      patches.emplace_back(piece.points, piece.degree_u, piece.degree_v);
  return [patches](const Vec3& from, const Vec3& point, double contact) {
    const double length = glm::length(point - from);
    const Line line{from, (point - from) / length};
    int layers = 0;
    for (const oracle::PatchOracle& patch : patches) {
      bool undecided = false;
      for (const oracle::Root& root : patch.roots(line, &undecided)) {
        const double before = length - root.t;
        if (root.t <= 0 || before < (contact > 0 ? contact : kOwn)) continue;
        if (before < kOwnToo) return -1;
        ++layers;
      }
      if (undecided) return -1;
    }
    return layers;
  };
}

class Truth {
 public:
  Truth(const World& world, Sheets sheets, Views& random, Found& found, int places = 12)
      : camera_(*world.model().camera), sheets_(std::move(sheets)), random_(random), found_(found), places_(places) {
    const VisibleLines drawing = visible_lines(world, drawing_work(world));
    ++found_.views;
    if (drawing.incomplete > 0) {
      ++found_.incomplete;
      return;
    }
    for (const VisibleLine& line : drawing.lines) check(line);
  }

 private:
  // -1: it is not clear.
  int layers(const VisibleLine& line, double t) const {
    const Vec3 p = line.curve->tangent(t).origin;
    const PicturePoint at = camera_.project(p);
    const Ray ray = camera_.ray(at.x, at.y);
    const Vec3 from = camera_.is_parallel() ? p - (at.depth + 5) * ray.direction : ray.origin;
    const double contact = line.stroke.kind == "silhouette" ? kContact : 0;
    return sheets_(from, p, contact);
  }

  void check(const VisibleLine& line) {
    ++found_.lines;
    const double width = line.stroke.curve->domain().width();
    for (size_t k = 0; k < line.pieces.size(); ++k) {
      const VisiblePiece& piece = line.pieces[k];
      const double margin = std::min(kBisected * width, 0.25 * piece.t.width());
      for (int i = 0; i < places_; ++i) {
        const double t = random_.number(piece.t.lo + margin, piece.t.hi - margin);
        if (near_cusp(line, t)) continue;
        ++found_.places;
        const int truth = layers(line, t);
        if (truth < 0) ++unclear_of(line);
        if (truth < 0 || truth == piece.layers || is_speck(line, piece) || is_at_end(line, piece, t)) continue;
        ++found_.wrong_places;
        if (found_.wrong_places <= 5) report(line, piece, t, "place");
      }
      if (k + 1 == line.pieces.size() || line.pieces[k + 1].t.lo != piece.t.hi) continue;
      ++found_.transitions;
      const VisiblePiece& next = line.pieces[k + 1];
      const double away = (near_cusp(line, piece.t.hi) ? 2 * kFromCusp : kBisected) * width;
      const int before = layers(line, piece.t.hi - std::min(away, 0.5 * piece.t.width())),
                behind = layers(line, next.t.lo + std::min(away, 0.5 * next.t.width()));
      if (before < 0 || behind < 0) ++unclear_of(line);
      if ((before < 0 || before == piece.layers) && (behind < 0 || behind == next.layers)) continue;
      if (is_right_beside(line, piece, next, kInPicture)) {
        ++found_.near;
        continue;
      }
      ++found_.wrong_transitions;
      if (found_.wrong_transitions <= 5) report(line, piece, piece.t.hi, "transition");
    }
  }

  static bool is_at_end(const VisibleLine& line, const VisiblePiece& piece, double t) {
    const auto from = [&](double end) { return glm::length(line.curve->place(end).p - line.curve->place(t).p); };
    return std::min(from(piece.t.lo), from(piece.t.hi)) < kInPicture;
  }

  // Shorter than a twentieth of a pixel.
  static bool is_speck(const VisibleLine& line, const VisiblePiece& piece) {
    return glm::length(line.curve->place(piece.t.hi).p - line.curve->place(piece.t.lo).p) < kSpeck;
  }

  int& unclear_of(const VisibleLine& line) const {
    return line.stroke.kind == "silhouette" ? found_.unclear_outlines : found_.unclear;
  }

  // Whether both pieces are right from so many pixels away on.
  bool is_right_beside(const VisibleLine& line, const VisiblePiece& piece, const VisiblePiece& next, double off) const {
    const Vec2 place = line.curve->place(piece.t.hi).p;
    const auto right = [&](const VisiblePiece& one, double other) {
      // Towards the piece's middle, to where the picture has moved on so far.
      double lo = 0, hi = 0.5;
      const auto at = [&](double x) { return piece.t.hi + x * (other - piece.t.hi); };
      if (glm::length(line.curve->place(at(hi)).p - place) < off) return true;  // shorter than that
      for (int k = 0; k < 60; ++k) {
        const double x = 0.5 * (lo + hi);
        (glm::length(line.curve->place(at(x)).p - place) < off ? lo : hi) = x;
      }
      const int truth = layers(line, at(hi));
      return truth < 0 || truth == one.layers;
    };
    return right(piece, piece.t.lo) && right(next, next.t.hi);
  }

  static bool near_cusp(const VisibleLine& line, double t) {
    for (const double cusp : line.stroke.cusps)
      if (std::abs(t - cusp) < kFromCusp * line.stroke.curve->domain().width()) return true;
    // Outlines of tubes end at them.
    const Interval domain = line.stroke.curve->domain();
    return line.stroke.aside && std::min(t - domain.lo, domain.hi - t) < kFromCusp * domain.width();
  }

  void report(const VisibleLine& line, const VisiblePiece& piece, double t, const char* what) const {
    const double width = line.stroke.curve->domain().width();
    std::string pieces;
    for (const VisiblePiece& one : line.pieces)
      pieces += " [" + std::to_string(one.t.lo) + " " + std::to_string(one.t.hi) + "]:" + std::to_string(one.layers);
    ADD_FAILURE() << "view " << found_.views << (camera_.is_parallel() ? " parallel " : " central ") << what << " of a "
                  << line.stroke.kind << " at t = " << t << ": " << piece.layers << " layers found, there are "
                  << layers(line, t) << " (before " << layers(line, t - kBisected * width) << ", behind "
                  << layers(line, t + kBisected * width) << ", 1e-5 away " << layers(line, t - 1e-5 * width) << ", "
                  << layers(line, t + 1e-5 * width) << "); pieces" << pieces;
  }

  const Camera& camera_;
  Sheets sheets_;
  Views& random_;
  Found& found_;
  int places_;  // asked for on each piece
};

void expect_right(const Found& found, const char* name, bool by_halving = false) {
  EXPECT_EQ(found.wrong_places, 0);
  EXPECT_EQ(found.wrong_transitions, 0);
  EXPECT_EQ(found.incomplete, 0);
  // Halving cannot tell where a way touches a sheet, as all to an outline do, and hardly where it nearly does.
  const int asked = found.places + found.transitions;
  EXPECT_LE(found.unclear + (by_halving ? 0 : found.unclear_outlines), 1 + asked / (by_halving ? 10 : 100));
  EXPECT_LE(found.near, 1 + found.transitions / (by_halving ? 30 : 100));
  tests::report_figure(std::string(name) + " right_within_a_hundredth_of_a_pixel", found.near);
  tests::report_figure(std::string(name) + " unclear", found.unclear);
  tests::report_figure(std::string(name) + " unclear_on_outlines", found.unclear_outlines);
  tests::report_figure(std::string(name) + " views", found.views);
  tests::report_figure(std::string(name) + " lines", found.lines);
  tests::report_figure(std::string(name) + " places", found.places);
  tests::report_figure(std::string(name) + " transitions", found.transitions);
}

const std::vector<std::string> kAll = {"sharp", "smooth", "silhouette", "parameter"};

TEST(DrawingTruth, SingleSolids) {
  constexpr const char* kNames[] = {"box", "cylinder", "cone", "ball", "torus"};
  for (int kind = 0; kind < 5; ++kind) {
    Views views(11 + static_cast<unsigned>(kind));
    Found found;
    for (int k = 0; k < tests::tier_count(500, tests::least_of_slow(50)); ++k) {
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
  for (int k = 0; k < tests::tier_count(500, tests::least_of_slow(25)); ++k) {
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
  for (int k = 0; k < tests::tier_count(500, tests::least_of_slow(25)); ++k) {
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
  for (int k = 0; k < tests::tier_count(500, tests::least_of_slow(25)); ++k) {
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
  for (int k = 0; k < tests::tier_count(500, tests::least_of_slow(12)); ++k) {
    SmallScene scene;
    const double radius = views.number(0.12, 0.25), pitch = views.number(0.09, 0.16), turns = 2;
    const auto helix = std::make_shared<FormulaCurve>(
        point_formulas({"cos(t)", "sin(t)", "(t - 2*pi)*" + std::to_string(pitch)}, {"t"}),
        Interval{0, turns * kTwoPi});
    const double law = std::stod(std::to_string(pitch));
    show(scene, ShapePtr(std::make_shared<Tube>(helix, RadiusLaw(radius), Caps::round)), {"sharp", "silhouette"});
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
  for (int k = 0; k < tests::tier_count(500, tests::least_of_slow(25)); ++k) {
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
    show(scene, ShapePtr(std::make_shared<Balls>(centers, radii)), {"sharp", "silhouette"});
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
  for (int k = 0; k < tests::tier_count(500, tests::least_of_slow(least)); ++k) {
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
  for (int k = 0; k < tests::tier_count(500, tests::least_of_slow(12)); ++k) {
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
    Truth(*scene.world(), sheets_of(sheet), views, found, 4);
  }
  expect_right(found, "saddle", true);
}

// Two sheets that pierce one another.
TEST(DrawingTruth, CrossingSheets) {
  Views views(43);
  Found found;
  for (int k = 0; k < tests::tier_count(500, tests::least_of_slow(12)); ++k) {
    SmallScene scene;
    SurfaceSet all;
    for (int n = 0; n < 2; ++n) {
      all.push_back(sheet_through_the_middle(views, n == 0));
      show(scene, SurfaceSet{all.back()}, {"boundary", "silhouette", "parameter"}, 4);
    }
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets_of(all), views, found, 4);
  }
  expect_right(found, "sheets", true);
}

TEST(DrawingTruth, Teapot) {
  const auto file = std::filesystem::path(LEKALO_SOURCE_DIR) / "tools/benchmarks/scenes/teapot_lines.yaml";
  const auto loaded = load_scene(file);
  const SurfaceSet teapot = std::get<SurfaceSet>(loaded.model->objects.front().shape);
  Views views(47);
  Found found;
  for (int k = 0; k < tests::tier_count(100, tests::least_of_slow(2)); ++k) {
    SmallScene scene;
    show(scene, teapot, {"boundary", "silhouette"});
    views.look(scene, k % 2);
    Truth(*scene.world(), sheets_of(teapot), views, found, 2);
  }
  expect_right(found, "teapot", true);
}

}  // namespace
}  // namespace lekalo::render
