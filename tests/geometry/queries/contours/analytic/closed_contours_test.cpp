// Closed forms of intersections against the search, which shares nothing with them: it sees the surfaces as rational
// splines. Each kind of pair in random places, turned and moved, with parts of domains.
#include "geometry/queries/contours/analytic/closed_contours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/hyperbola.h"
#include "geometry/curves/analytic/parabola.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/contour_length.h"
#include "geometry/queries/contours/plane_section.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/quadrics/conic_image.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/ellipsoid.h"
#include "geometry/surfaces/analytic/hyperboloid.h"
#include "geometry/surfaces/analytic/paraboloid.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/tolerances.h"
#include "geometry/transformed.h"
#include "support/tier.h"

namespace lekalo::geometry::closed_contours_test {
namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  bool coin() { return number(0, 1) < 0.5; }
  Vec3 vector(double reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }
  Vec3 unit() {
    Vec3 v = vector(1);
    while (glm::length(v) > 1 || glm::length(v) < 0.1) v = vector(1);
    return glm::normalize(v);
  }
  // A part of an angle or all of it.
  Interval part(const Interval& whole) {
    if (coin()) return whole;
    const double lo = number(whole.lo, whole.middle());
    return {lo, number(lo + 0.2 * whole.width(), whole.hi)};
  }
  Rectangle part(const Rectangle& whole) { return {part(whole.u), part(whole.v)}; }
  Frame frame(double reach) { return frame_from(vector(reach), unit(), unit()); }

 private:
  std::mt19937 engine_;
};

struct Two {
  SurfacePtr a, b;
};

SurfacePtr plate(const Frame& frame, double reach) {
  return std::make_shared<Plane>(frame, Rectangle{{-reach, reach}, {-0.8 * reach, reach}});
}
Frame moved(Frame frame, const Vec3& by) {
  frame.origin += frame.direction(by);
  return frame;
}
Frame at(const Vec3& origin) {
  Frame frame;
  frame.origin = origin;
  return frame;
}
// Frames with the same axis, turned about it and upside down.
Frame coaxial(Dice& dice, double height) {
  const double angle = dice.number(-3, 3);
  const Vec3 x(std::cos(angle), std::sin(angle), 0);
  return frame_from({0, 0, height}, {0, 0, dice.coin() ? 1.0 : -1.0}, x);
}

SurfacePtr sphere(Dice& dice, const Frame& frame, double radius) {
  return std::make_shared<SphereSurface>(frame, radius, dice.part(SphereSurface::kFull));
}
SurfacePtr tube(Dice& dice, const Frame& frame, double radius, double height) {
  return std::make_shared<CylinderSurface>(moved(frame, {0, 0, -0.5 * height}), radius, height,
                                           dice.part(ConeSurface::kFull));
}
// About a cone's apex, to both sides.
SurfacePtr cone(Dice& dice, const Frame& apex, double slope, double height) {
  return std::make_shared<ConeSurface>(moved(apex, {0, 0, -height}), -slope * height, slope * height, 2 * height,
                                       dice.part(ConeSurface::kFull));
}
SurfacePtr torus(Dice& dice, const Frame& frame, double major, double minor) {
  return std::make_shared<TorusSurface>(frame, major, minor, dice.part(TorusSurface::full_domain(major, minor)));
}

// A Bezier curve of degree 5: in the plane x, z on the side of x > 0, or anywhere.
CurvePtr profile(Dice& d, bool beside_axis) {
  NurbsCurveForm form;
  form.degree = 5;
  form.knots = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  for (int k = 0; k <= 5; ++k) {
    const double w = d.number(0.5, 2), along = 0.4 * k - 1;
    const Vec3 p = beside_axis ? Vec3(d.number(0.5, 2), 0, along + d.number(-0.5, 0.5))
                               : Vec3(along, d.number(-0.8, 0.8), d.number(-0.4, 0.4));
    form.points.push_back({w * p, w});
  }
  return std::make_shared<NurbsCurve>(form);
}
Rectangle part_of_extrusion(Dice& d) { return {d.part(Interval(0, 1)), d.part(Interval(-0.5, 1.5))}; }
SurfacePtr turned_profile(Dice& d) {
  return std::make_shared<RevolutionSurface>(profile(d, true), Axis{{0, 0, 0}, {0, 0, 1}},
                                             Rectangle{{0, 1}, d.part(Interval(0, kTwoPi))});
}

struct Kind {
  const char* name;
  std::function<Two(Dice&)> made;
  bool keeps_angles = false;  // has no closed form under affine maps
};

std::vector<Kind> kinds() {
  const auto with_plane = [](const std::function<SurfacePtr(Dice&)>& quadric, double reach) {
    return [=](Dice& dice) { return Two{quadric(dice), plate(dice.frame(0.5), reach)}; };
  };
  std::vector<Kind> all{
      {"plane and plane", with_plane([](Dice& d) { return plate(d.frame(0.5), 1); }, 1.2)},
      {"plane and sphere", with_plane([](Dice& d) { return sphere(d, Frame(), 1); }, 2)},
      {"plane and cylinder", with_plane([](Dice& d) { return tube(d, Frame(), 1, 3); }, 2)},
      {"plane and cone", with_plane([](Dice& d) { return cone(d, Frame(), 0.7, 2); }, 2)},
      {"plane and ellipsoid",
       with_plane(
           [](Dice& d) { return std::make_shared<Ellipsoid>(Frame(), Vec3(1, 1.5, 0.7), d.part(Ellipsoid::kFull)); },
           2)},
      {"plane and hyperboloid of one sheet",
       with_plane(
           [](Dice& d) {
             return std::make_shared<HyperboloidOneSheet>(Frame(), Vec3(1, 0.8, 0.7), d.part({{0, kTwoPi}, {-1.2, 1}}));
           },
           2)},
      {"plane and hyperboloid of two sheets", with_plane(
                                                  [](Dice& d) {
                                                    return std::make_shared<HyperboloidTwoSheets>(
                                                        Frame(), Vec3(1, 0.8, d.coin() ? 0.7 : -0.7),
                                                        d.part({{0, kTwoPi}, {0, 1.5}}));
                                                  },
                                                  2)},
      {"plane and paraboloid",
       with_plane(
           [](Dice& d) {
             return std::make_shared<EllipticParaboloid>(Frame(), 1, 0.8, d.part({{0, kTwoPi}, {0, 1.5}}));
           },
           2)},
      {"plane and saddle",
       with_plane(
           [](Dice& d) {
             return std::make_shared<HyperbolicParaboloid>(Frame(), 1, 0.8, d.part({{-1, 1.2}, {-1, 1}}));
           },
           2)},
      {"parallel section of a cone",
       [](Dice& d) {
         // Along a generatrix: a parabola.
         const double slope = d.number(0.4, 1.5);
         return Two{cone(d, Frame(), slope, 2), plate(frame_from(d.vector(0.4), {1, 0, slope}, d.unit()), 2)};
       },
       true},
      {"axial section of a cylinder",
       [](Dice& d) {
         return Two{tube(d, Frame(), 1, 2), plate(frame_from(d.vector(0.4), {d.number(-1, 1), 1, 0}, d.unit()), 2)};
       }},
      {"section of a torus across its axis",
       [](Dice& d) {
         return Two{torus(d, Frame(), 2, 0.7),
                    plate(frame_from({0.1, 0.2, d.number(-0.65, 0.65)}, {0, 0, 1}, d.unit()), 3)};
       },
       true},
      {"section of a torus through its axis",
       [](Dice& d) {
         return Two{torus(d, Frame(), 2, 0.7), plate(frame_from({0, 0, 0.1}, {1, d.number(-1, 1), 0}, d.unit()), 3)};
       },
       true},
      {"spheres",
       [](Dice& d) {
         return Two{sphere(d, d.frame(0.3), 1), sphere(d, d.frame(0.8), d.number(0.5, 1.5))};
       },
       true},
      {"parallel cylinders",
       [](Dice& d) {
         return Two{tube(d, Frame(), 1, 2), tube(d, at(Vec3(d.number(0.6, 0.8), 0.3, 0.2)), d.number(0.9, 1.2), 3)};
       },
       true},
      {"sphere and cylinder about one axis",
       [](Dice& d) {
         return Two{sphere(d, d.frame(0), 1), tube(d, coaxial(d, d.number(-0.2, 0.2)), d.number(0.3, 0.9), 3)};
       },
       true},
      {"sphere and cone about one axis",
       [](Dice& d) {
         return Two{sphere(d, d.frame(0), 1), cone(d, coaxial(d, d.number(-0.5, 0.5)), d.number(0.3, 1.5), 2)};
       },
       true},
      {"cylinder and cone about one axis",
       [](Dice& d) {
         return Two{tube(d, coaxial(d, 0), 1, 4), cone(d, coaxial(d, d.number(-0.5, 0.5)), d.number(0.8, 1.5), 2)};
       },
       true},
      {"cones about one axis",
       [](Dice& d) {
         return Two{cone(d, coaxial(d, 0), 0.6, 3), cone(d, coaxial(d, d.number(0.5, 1)), d.number(0.8, 1.5), 2)};
       },
       true},
      {"ellipsoid and hyperboloid about one axis",
       [](Dice& d) {
         return Two{
             std::make_shared<Ellipsoid>(coaxial(d, 0), Vec3(1, 1, 2), d.part(Ellipsoid::kFull)),
             std::make_shared<HyperboloidOneSheet>(coaxial(d, d.number(-0.3, 0.3)), Vec3(0.6, 0.6, d.number(0.5, 2)),
                                                   d.part({{0, kTwoPi}, {-1.2, 1}}))};
       },
       true},
      {"torus and sphere about one axis",
       [](Dice& d) {
         return Two{torus(d, coaxial(d, 0), 2, 0.7), sphere(d, at({0, 0, d.number(-0.5, 0.5)}), d.number(1.7, 2.3))};
       },
       true},
      {"torus and cylinder about one axis",
       [](Dice& d) {
         return Two{torus(d, coaxial(d, 0), 2, 0.7), tube(d, coaxial(d, 0.2), d.number(1.5, 2.5), 3)};
       },
       true},
      {"torus and cone about one axis",
       [](Dice& d) {
         return Two{torus(d, coaxial(d, 0), 2, 0.7), cone(d, coaxial(d, d.number(-1, 1)), d.number(0.8, 2.5), 4)};
       },
       true},
      {"tori about one axis",
       [](Dice& d) {
         return Two{torus(d, coaxial(d, 0), 2, 0.7),
                    torus(d, coaxial(d, d.number(-0.3, 0.3)), d.number(1.8, 2.4), d.number(0.5, 0.8))};
       },
       true},
      {"equal cylinders with crossing axes",
       [](Dice& d) {
         const Vec3 across(std::cos(0.3), 0, std::sin(d.number(0.3, 1)));
         return Two{tube(d, Frame(), 1, 6), tube(d, frame_from({0, 0, 0}, across, {0, 1, 0}), 1, 6)};
       },
       true},
      {"cylinder and cone about one sphere",
       [](Dice& d) {
         // A cone with the sine of its half-angle 1/distance of the apex from a unit sphere.
         const double distance = d.number(1.8, 3), sine = 1 / distance, slope = sine / std::sqrt(1 - sine * sine);
         const Frame apex = frame_from({0, 0, distance}, {0, 0, 1}, d.unit());
         const Vec3 across(1, 0, d.number(-0.3, 0.3));
         return Two{cone(d, apex, slope, 4), tube(d, frame_from({0, 0, 0}, across, {0, 1, 0}), 1, 5)};
       },
       true},
      {"section across an extrusion",
       [](Dice& d) {
         return Two{std::make_shared<ExtrusionSurface>(profile(d, false), Vec3(0.3, -0.2, 2), part_of_extrusion(d)),
                    plate(frame_from({0, 0, d.number(0.3, 1.5)}, {d.number(-0.5, 0.5), 0.2, 1}, d.unit()), 1.5)};
       }},
      {"section along an extrusion",
       [](Dice& d) {
         const Vec3 along(0.3, -0.2, 2);
         const Vec3 normal = glm::normalize(glm::cross(along, {d.number(-0.5, 0.5), 1, 0}));
         return Two{std::make_shared<ExtrusionSurface>(profile(d, false), along, part_of_extrusion(d)),
                    plate(frame_from({0, 0, 0}, normal, d.unit()), 2)};
       }},
      {"section of a turned profile across its axis",
       [](Dice& d) {
         return Two{turned_profile(d), plate(frame_from({0, 0, d.number(-0.5, 0.5)}, {0, 0, 1}, d.unit()), 2.5)};
       },
       true},
      {"section of a turned profile through its axis",
       [](Dice& d) {
         return Two{turned_profile(d), plate(frame_from({0, 0, 0}, {d.number(-1, 1), 1, 0}, d.unit()), 2.5)};
       },
       true},
  };
  return all;
}

// Forms cover at least the domain: where that is one patch, it is what is taken.
SurfacePtr as_spline(const SurfacePtr& surface) {
  NurbsSurfaceForm form = surface->as_nurbs().value();
  if (const auto pieces = surface->pieces(); pieces.size() == 1) {
    const auto clamped = [](int degree) {
      std::vector<double> knots(degree + 1, 0.0);
      knots.insert(knots.end(), degree + 1, 1.0);
      return knots;
    };
    form = {pieces[0].degree_u,
            pieces[0].degree_v,
            clamped(pieces[0].degree_u),
            clamped(pieces[0].degree_v),
            pieces[0].points,
            {},
            {}};
  }
  return std::make_shared<NurbsSurface>(form);
}

// What all closed forms keep: both images lead to the curve with its derivatives, boxes hold what they should.
void check_promises(const Contour& contour, const Two& two, double size) {
  const Interval t = contour.curve->domain();
  const SurfacePtr on[2] = {two.a, two.b};
  for (int k = 0; k < 12; ++k) {
    const double place = t.lo + t.width() * (k + 0.37) / 12;
    const CurveJet c = contour.curve->evaluate(place, 2);
    for (size_t side = 0; side < contour.images.size(); ++side) {
      const CurveJet x = contour.images[side]->evaluate(place, 2);
      const SurfaceJet s = on[side]->evaluate(x.d[0].x, x.d[0].y, 2);
      EXPECT_LT(glm::length(s.point() - c.d[0]), 1e-14 * size);
      const Vec3 first = s.du() * x.d[1].x + s.dv() * x.d[1].y;
      EXPECT_LT(glm::length(first - c.d[1]), 1e-12 * (size + glm::length(c.d[1])));
      const Vec3 second = s.duu() * (x.d[1].x * x.d[1].x) + s.duv() * (2 * x.d[1].x * x.d[1].y) +
                          s.dvv() * (x.d[1].y * x.d[1].y) + s.du() * x.d[2].x + s.dv() * x.d[2].y;
      EXPECT_LT(glm::length(second - c.d[2]), 1e-9 * (size + glm::length(c.d[2])));
      const double reach = 0.01 * t.width();
      const CurveEnclosure box = contour.images[side]->enclose({t.clamp(place - reach), t.clamp(place + reach)}, 2);
      for (int order = 0; order <= 2; ++order) EXPECT_TRUE(box.d[order].contains(x.d[order]));
    }
  }
}

// The small tier asks the search of one in eight.
TEST(ClosedContours, AreThoseOfTheSearch) {
  const int runs = tests::is_full_tier() ? 40 : 4;
  int closed = 0, left = 0, unclear = 0, branches = 0;
  unsigned seed = 1;
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    int here = 0;
    for (int run = 0; run < runs; ++run) {
      SCOPED_TRACE(run);
      Dice dice(seed++);
      Two two = kind.made(dice);
      const Frame to = dice.frame(3);
      Affine map{Mat3(to.x, to.y, to.z), to.origin};
      if (!kind.keeps_angles && dice.coin()) map.linear = map.linear * Mat3({1, 0.2, 0}, {0, 1.3, 0.1}, {0.3, 0, 0.8});
      two = {transformed(two.a, map), transformed(two.b, map)};
      if (dice.coin()) std::swap(two.a, two.b);
      Box3 box = bounds(*two.a);
      box.include(bounds(*two.b));
      const double size = box.diameter();
      const auto exact = closed_intersection(two.a, two.b, kSamePoint * size);
      if (!exact) {
        ++left;
        continue;
      }
      ++closed, ++here;
      for (const Contour& contour : exact->branches) check_promises(contour, two, size + glm::length(to.origin));
      if (!tests::is_full_tier() && seed % 8 != 0) continue;
      const Contours searched = intersect(as_spline(two.a), as_spline(two.b));
      ASSERT_FALSE(searched.closed_form);
      if (!searched.complete) {
        ++unclear;
        continue;
      }
      EXPECT_EQ(exact->branches.size(), searched.branches.size());
      EXPECT_EQ(exact->points.size(), searched.points.size());
      const auto length = [](const Contours& all) {
        Measured sum;
        for (const Contour& one : all.branches) {
          const Measured of_one = contour_length(one);
          sum.value += of_one.value, sum.error += of_one.error;
        }
        return sum;
      };
      const Measured own = length(*exact), other = length(searched);
      EXPECT_NEAR(own.value, other.value, 1e-9 * size + own.error + other.error);
      const auto loops = [](const Contours& all) {
        return std::count_if(all.branches.begin(), all.branches.end(), [](const Contour& c) { return c.closed; });
      };
      EXPECT_EQ(loops(*exact), loops(searched));
      for (const Contour& one : exact->branches) {
        ++branches;
        const Interval t = one.curve->domain();
        for (const double share : {0.11, 0.52, 0.93}) {
          const Vec3 p = one.curve->point(t.lo + share * t.width());
          double nearest = kInfinity;
          for (const Contour& candidate : searched.branches)
            nearest = std::min(nearest, project(p, *candidate.curve).foot_points.front().distance);
          // Rounding moves a curve by more where the surfaces meet at a small angle.
          const Vec3 on_a = one.images[0]->point(t.lo + share * t.width()),
                     on_b = one.images[1]->point(t.lo + share * t.width());
          const double sine = glm::length(glm::cross(two.a->normal(on_a.x, on_a.y), two.b->normal(on_b.x, on_b.y)));
          EXPECT_LT(nearest * sine, 1e-12 * (size + glm::length(to.origin)));
        }
      }
    }
    // Nearly all have a closed form.
    EXPECT_GE(here, runs - runs / 4);
  }
  tests::report_figure("closed", closed);
  tests::report_figure("branches", branches);
  tests::report_figure("left_to_the_search", left);
  tests::report_figure("unclear_to_the_search", unclear);
}

template <class Type>
bool all_are(const Contours& found, size_t count) {
  return found.branches.size() == count && std::all_of(found.branches.begin(), found.branches.end(), [](const auto& b) {
           return dynamic_cast<const Type*>(b.curve.get()) != nullptr;
         });
}

TEST(ClosedContours, AreCurvesOfTheirKind) {
  const auto ball = std::make_shared<SphereSurface>(Frame(), 1);
  const auto tube = std::make_shared<CylinderSurface>(at({0, 0, -2}), 1, 4);
  const auto cone = std::make_shared<ConeSurface>(at({0, 0, -2}), -1, 1, 4);
  const auto cut = [](const SurfacePtr& surface, const Vec3& through, const Vec3& normal) {
    const Contours found = plane_section(surface, through, normal);
    EXPECT_TRUE(found.closed_form && found.complete);
    for (const Contour& one : found.branches) EXPECT_EQ(one.images.size(), 1u);
    return found;
  };
  EXPECT_TRUE(all_are<Circle>(cut(ball, {0.1, 0.2, 0.3}, {1, 2, 3}), 1));
  EXPECT_TRUE(all_are<Circle>(cut(tube, {0.1, 0.2, 0.3}, {0, 0, 1}), 1));
  EXPECT_TRUE(all_are<Ellipse>(cut(tube, {0.1, 0.2, 0.3}, {0, 1, 1}), 1));
  EXPECT_TRUE(all_are<Segment>(cut(tube, {0.1, 0.2, 0.3}, {0, 1, 0}), 2));
  EXPECT_TRUE(all_are<Parabola>(cut(cone, {0, 0.2, 0.3}, {2, 0, 1}), 1));
  EXPECT_TRUE(all_are<Hyperbola>(cut(cone, {0, 0.2, 0.3}, {0, 1, 0}), 2));
  EXPECT_TRUE(all_are<Segment>(cut(cone, {0, 0, 0}, {0, 1, 0}), 2));
}

// Golovanov 2016, 4.7b: r_0 = s_0 + s_3, where the printed base point divides zero.
TEST(ClosedContours, PlanesOfTheTextbook) {
  const Vec3 s3(0, std::sin(1.0), std::cos(1.0));
  const auto first = std::make_shared<Plane>(frame_about(s3, {0, 0, 1}), Rectangle{{-3, 3}, {-3, 3}});
  const auto second = std::make_shared<Plane>(frame_about({0, 0, 0}, s3), Rectangle{{-3, 3}, {-3, 3}});
  const Contours found = intersect(first, second);
  ASSERT_TRUE(found.closed_form);
  ASSERT_TRUE(all_are<Segment>(found, 1));
  for (const double t : {0.0, 0.3, 1.0}) {
    const Vec3 p = found.branches[0].curve->point(t);
    EXPECT_NEAR(p.z, s3.z, 1e-15);
    EXPECT_NEAR(glm::dot(p, s3), 0, 1e-15);
  }
}

// Through poles and apexes angles jump; on both sides all derivatives are known.
TEST(ClosedContours, PassThroughPoles) {
  const auto ball = std::make_shared<SphereSurface>(Frame(), 1);
  const auto half = std::make_shared<SphereSurface>(Frame(), 1, Rectangle{{-0.5, 2.9}, {-0.4, 0.5 * kPi}});
  const auto cone = std::make_shared<ConeSurface>(at({0, 0, -1}), -1, 1, 2);
  const auto bowl = std::make_shared<EllipticParaboloid>(Frame(), 1, 0.7, Rectangle{{0, kTwoPi}, {0, 1.2}});
  const auto upper = std::make_shared<HyperboloidTwoSheets>(Frame(), Vec3(1, 0.7, 1), Rectangle{{0, kTwoPi}, {0, 1.2}});
  const SurfacePtr slanted = plate(frame_from({0, 0, 0}, {0.7, 1, 0}, {0, 0, 1}), 3);
  for (const SurfacePtr& surface :
       {SurfacePtr(ball), SurfacePtr(half), SurfacePtr(cone), SurfacePtr(bowl), SurfacePtr(upper)}) {
    const Two two{surface, slanted};
    const Contours found = intersect(two.a, two.b);
    EXPECT_TRUE(found.closed_form);
    EXPECT_FALSE(found.branches.empty());
    for (const Contour& one : found.branches) check_promises(one, two, 3);
  }
  // Not along a meridian: a circle through one pole.
  const Two two{ball, plate(frame_from({0, 0, 1}, {0.4, 0.3, 1}, {1, 0, 0}), 3)};
  const Contours found = intersect(two.a, two.b);
  ASSERT_TRUE(found.closed_form);
  ASSERT_TRUE(all_are<Circle>(found, 1));
  EXPECT_TRUE(found.branches[0].closed);
  check_promises(found.branches[0], two, 3);
}

TEST(ClosedContours, ContactsHaveTheirPlaces) {
  const auto ball = std::make_shared<SphereSurface>(Frame(), 1);
  const Contours found = intersect(ball, std::make_shared<SphereSurface>(at({0, 3, 0}), 2));
  ASSERT_TRUE(found.closed_form);
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_TRUE(found.branches.empty());
  EXPECT_EQ(found.points[0].kind, ContourPointKind::contact);
  EXPECT_LT(glm::length(found.points[0].point - Vec3(0, 1, 0)), 1e-15);
  ASSERT_EQ(found.points[0].parameters.size(), 4u);
  EXPECT_NEAR(found.points[0].parameters[0], 0.5 * kPi, 1e-15);
  EXPECT_NEAR(found.points[0].parameters[2], 1.5 * kPi, 1e-15);
}

TEST(ClosedContours, SaysThatClosedSurfacesAreTheSame) {
  const auto ball = std::make_shared<SphereSurface>(Frame(), 1);
  const auto again = std::make_shared<SphereSurface>(frame_from({0, 0, 0}, {1, 1, 1}, {0, 1, 0}), 1);
  const Contours found = intersect(ball, again);
  EXPECT_TRUE(found.closed_form && found.coincident && found.complete);
  EXPECT_TRUE(found.branches.empty());
}

// Pipes of one radius about one axis, one upright and one upside down, both around the seam of the other: what they
// have in common ends in circles where one of them ends.
TEST(ClosedContours, CommonPartOfCylinders) {
  const auto pipe = [](double from, double to) {
    return std::make_shared<CylinderSurface>(at({1, 2, from}), 2, to - from);
  };
  const auto turned = [](double from, double to) {
    return std::make_shared<CylinderSurface>(Frame{{1, 2, to}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, 2, to - from);
  };
  const auto check = [](const SurfacePtr& a, const SurfacePtr& b, ContourKind kind,
                        const std::vector<double>& heights) {
    const Contours found = intersect(a, b);
    EXPECT_TRUE(found.closed_form && found.complete);
    EXPECT_EQ(found.coincident, kind == ContourKind::border);
    ASSERT_EQ(found.branches.size(), heights.size());
    for (size_t k = 0; k < heights.size(); ++k) {
      const Contour& ring = found.branches[k];
      EXPECT_EQ(ring.kind, kind);
      EXPECT_TRUE(ring.closed);
      EXPECT_NEAR(contour_length(ring).value, 4 * kPi, 1e-12);
      const Interval t = ring.curve->domain();
      for (const double part : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        const Vec3 p = ring.curve->point(t.lo + part * t.width());
        EXPECT_NEAR(p.z, heights[k], 1e-13);
        EXPECT_NEAR(std::hypot(p.x - 1, p.y - 2), 2, 1e-13);
        for (size_t i = 0; i < 2; ++i) {
          const Vec3 uv = ring.images[i]->point(t.lo + part * t.width());
          EXPECT_LT(glm::length((i == 0 ? a : b)->point(uv.x, uv.y) - p), 1e-13);
        }
      }
    }
  };
  check(pipe(0, 10), pipe(5, 25), ContourKind::border, {5, 10});
  check(pipe(0, 10), turned(3, 7), ContourKind::border, {3, 7});
  check(pipe(0, 10), turned(0, 10), ContourKind::border, {0, 10});
  check(pipe(0, 10), pipe(10, 12), ContourKind::touching, {10});
  check(pipe(0, 10), turned(-3, 0), ContourKind::touching, {0});
  check(pipe(0, 10), pipe(11, 12), ContourKind::crossing, {});
}

// Where rounding or the tolerance would decide, the search has its say.
TEST(ClosedContours, LeaveWhatIsNearlySpecial) {
  const auto left = [](const SurfacePtr& a, const SurfacePtr& b) {
    Box3 box = bounds(*a);
    box.include(bounds(*b));
    return !closed_intersection(a, b, kSamePoint * box.diameter());
  };
  const auto tube = [](const Frame& frame, double radius) {
    return std::make_shared<CylinderSurface>(moved(frame, {0, 0, -2}), radius, 4);
  };
  const auto ball = std::make_shared<SphereSurface>(Frame(), 1);
  const Vec3 tilted(1, 0, 1e-10);
  // Axes that are hardly parallel, radii that are hardly equal.
  EXPECT_TRUE(left(tube(Frame(), 1), tube(frame_about({0.3, 0, 0}, glm::normalize(Vec3(1e-10, 0, 1))), 1)));
  EXPECT_TRUE(left(tube(Frame(), 1), tube(frame_about({0, 0, 0}, {1, 0, 0}), 1 + 1e-12)));
  EXPECT_TRUE(left(ball, tube(at({1e-11, 0, 0}), 0.5)));
  // Nearly coincident.
  EXPECT_TRUE(left(ball, std::make_shared<SphereSurface>(at({0, 0, 1e-10}), 1)));
  EXPECT_TRUE(left(tube(Frame(), 1), tube(Frame(), 1 + 1e-10)));
  EXPECT_TRUE(left(tube(Frame(), 1), tube(at({0, 0, 1e-10}), 1)));
  EXPECT_TRUE(left(plate(Frame(), 1), plate(frame_about({0, 0, 0}, glm::normalize(Vec3(1e-10, 0, 1))), 1)));
  EXPECT_TRUE(left(plate(Frame(), 1), plate(at({0.5, 0, 0}), 1)));
  // Nearly touching along a line.
  EXPECT_TRUE(left(tube(Frame(), 1), plate(frame_about({1 + 1e-10, 0, 0}, {1, 0, 0}), 3)));
  // Beside a pole; at a corner of a plate; a crossing at an end.
  EXPECT_TRUE(left(ball, plate(frame_about({1e-11, 0, 0}, glm::normalize(tilted)), 3)));
  EXPECT_TRUE(left(tube(Frame(), 1), std::make_shared<Plane>(Frame(), Rectangle{{1 - 1e-15, 2}, {-1, 1}})));
  // What has no closed form.
  EXPECT_TRUE(left(ball, tube(at({0.5, 0, 0}), 0.5)));
  EXPECT_TRUE(left(std::make_shared<TorusSurface>(Frame(), 3, 1), plate(frame_about({0.2, 0, 0}, {1, 0, 0}), 5)));
}

// Golovanov 2016, 4.7c, with an oblique direction: the base z = 0, d = (1, 0, 1), the cut z = 2 at v = 2.
TEST(ClosedContours, ObliqueExtrusionOfTheTextbook) {
  const auto base = std::make_shared<Ellipse>(Frame(), 1.5, 1);
  const auto surface = std::make_shared<ExtrusionSurface>(base, Vec3(1, 0, 1), Rectangle{{0, kTwoPi}, {0, 3}});
  const Contours found = plane_section(surface, {0, 0, 2}, {0, 0, 1});
  ASSERT_TRUE(found.closed_form);
  ASSERT_EQ(found.branches.size(), 1u);
  EXPECT_TRUE(found.branches[0].closed);
  for (const double t : {0.1, 2.0, 5.0}) {
    EXPECT_EQ(found.branches[0].images[0]->point(t), Vec3(t, 2, 0));
    EXPECT_LT(glm::length(found.branches[0].curve->point(t) - base->point(t) - Vec3(2, 0, 2)), 1e-15);
  }
}

}  // namespace
}  // namespace lekalo::geometry::closed_contours_test
