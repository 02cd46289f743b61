// Parameter lines of solids that are put together, against an oracle of closed forms (support/sight_oracle.h): what is
// seen of them; that they lie on the outside of the whole; and that none are missing, at random places of the lines of
// each part.
#include "geometry/queries/contours/parameter_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/curves/analytic/segment.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/tube/tube.h"
#include "render/drawing/line_truth.h"
#include "render/drawing/random_solids.h"
#include "support/curve_places.h"
#include "support/sight_oracle.h"
#include "support/tier.h"

namespace lekalo::render::parameter_lines_test {
namespace {

using namespace geometry;
using oracle::sight::PairSolid;
using oracle::sight::Solid;

constexpr int kLines = 5;  // of each direction
const ParameterNet kNet{{kLines, {}}, {kLines, {}}};

// Whether the solid's boundary passes a point, as asked so far to both sides along a direction; nothing where that is
// not clear.
std::optional<bool> is_boundary(const Solid& solid, const Vec3& p, const Vec3& n) {
  std::optional<bool> found;
  for (const double off : {1e-7, 1e-5, 1e-4}) {
    const auto inside = [&](double by) {
      const Vec3 at = p + by * n;
      return solid.contains({at.x, at.y, at.z});
    };
    const bool here = inside(off) != inside(-off);
    if (found && *found != here) return std::nullopt;
    found = here;
  }
  return found;
}

double distance_of(const std::vector<Stroke>& strokes, const Vec3& p) {
  double least = kInfinity;
  for (const Stroke& stroke : strokes)
    if (stroke.kind == "parameter") least = std::min(least, lekalo::checks::distance_to(*stroke.curve, p));
  return least;
}

// The same all about a place of a face that fills its surface's domain: not on the border itself, where the oracle's
// bodies end.
std::optional<bool> is_boundary(const Solid& solid, const Surface& surface, const Vec2& uv) {
  const Rectangle domain = surface.domain();
  std::optional<bool> found;
  for (const double du : {-1e-5, 1e-5})
    for (const double dv : {-1e-5, 1e-5}) {
      const double u = uv.x + du * domain.u.width(), v = uv.y + dv * domain.v.width();
      if (!domain.contains(u, v)) continue;
      const auto here = is_boundary(solid, surface.point(u, v), surface.normal(u, v));
      if (!here || (found && *found != *here)) return std::nullopt;
      found = here;
    }
  return found;
}

struct Counts {
  int on = 0, off = 0, unclear = 0;
};

// A place of a line of a part, and whether it is on the boundary.
void judge_place(const std::optional<bool>& on, const std::vector<Stroke>& strokes, const Vec3& p, Counts& counts) {
  if (!on) {
    ++counts.unclear;
    return;
  }
  ++(*on ? counts.on : counts.off);
  if (*on)
    EXPECT_LT(distance_of(strokes, p), 1e-8);
  else
    EXPECT_GT(distance_of(strokes, p), 1e-8);
}

void judge_body(const Body& body, const Solid& truth, const std::vector<Stroke>& strokes, Views& views,
                Counts& counts) {
  for (const NetLine& line : parameter_lines(body, kNet))
    for (int k = 0; k < 3; ++k) {
      const double t = views.number(line.along.lo, line.along.hi);
      const Vec2 uv = line.held == IsoDirection::u ? Vec2(line.at, t) : Vec2(t, line.at);
      judge_place(is_boundary(truth, *line.surface, uv), strokes, line.surface->point(uv.x, uv.y), counts);
    }
}

// Of a rod of this radius along z of the frame: circles, and lines at even angles.
void judge_rod(const Tube& rod, const Frame& frame, double radius, double length, const Solid& truth,
               const std::vector<Stroke>& strokes, Views& views, Counts& counts) {
  const double first = rod.point({0, 0, 0, 0, 0}, frame.point({radius, 0, 0})).v;
  for (int i = 0; i < kLines; ++i)
    for (const bool circle : {true, false}) {
      const double angle = circle ? views.number(0, kTwoPi) : kTwoPi * i / kLines - first,
                   height = circle ? length * i / (kLines - 1) : views.number(0, length);
      const Vec3 normal = frame.direction({std::cos(angle), std::sin(angle), 0});
      const auto place = [&](double z) { return frame.origin + z * frame.z + radius * normal; };
      // A little inside of an end.
      const auto on = is_boundary(truth, place(std::clamp(height, 1e-5, length - 1e-5)), normal);
      judge_place(on, strokes, place(height), counts);
    }
}

TEST(ParameterLines, OfSolidsPutTogether) {
  Views views(211);
  Found found;
  Counts counts;
  for (int k = 0; k < tests::tier_count(300, tests::min_of_slow(8)); ++k) {
    SmallScene scene;
    const Part a = random_part(views, k, 0.5), b = random_part(views, k + 1 + k / 5, 0.8);
    const Frame frame = anywhere(views, 0.4);
    const double radius = views.number(0.3, 0.6), length = views.number(1, 3);
    const Vec3 end = frame.origin + length * frame.z;
    const auto rod =
        std::make_shared<Tube>(std::make_shared<Segment>(frame.origin, end), RadiusLaw(radius), Caps::flat);
    const auto of_rod = std::make_shared<oracle::sight::FrustumSolid>(frame, radius, radius, length);
    const auto shape = [](const Body& body) { return std::make_shared<BodyShape>(std::make_shared<Body>(body)); };
    const bool cuts = k % 2;
    ShapePtr solid;
    try {
      const ShapePtr first = std::make_shared<Csg>(cuts ? Csg::Operation::intersect : Csg::Operation::subtract,
                                                   std::vector<ShapePtr>{shape(a.body), shape(b.body)});
      solid = std::make_shared<Csg>(k % 3 ? Csg::Operation::unite : Csg::Operation::subtract,
                                    std::vector<ShapePtr>{first, rod});
    } catch (const std::invalid_argument&) {
      continue;
    }
    const SolidPtr truth = std::make_shared<PairSolid>(
        k % 3 ? PairSolid::Kind::unite : PairSolid::Kind::subtract,
        std::make_shared<PairSolid>(cuts ? PairSolid::Kind::intersect : PairSolid::Kind::subtract, a.solid, b.solid),
        of_rod);
    show(scene, solid, {"parameter"}, kLines);
    views.look(scene, k % 2);
    const auto world = scene.world();
    const LineWork work = drawing_work(*world);
    EXPECT_TRUE(work.left_out.empty());
    judge_body(a.body, *truth, work.strokes, views, counts);
    judge_body(b.body, *truth, work.strokes, views, counts);
    judge_rod(*rod, frame, radius, length, *truth, work.strokes, views, counts);
    for (const Stroke& stroke : work.strokes) {
      if (stroke.kind != "parameter" || stroke.supporting_surfaces.empty()) continue;
      const double t = views.number(stroke.curve->domain().lo, stroke.curve->domain().hi);
      const Vec3 uv = stroke.supporting_surfaces[0].image->point(t), p = stroke.curve->point(t);
      EXPECT_NEAR(glm::length(stroke.supporting_surfaces[0].surface->point(uv.x, uv.y) - p), 0, 1e-11);
      const auto on = is_boundary(*truth, *stroke.supporting_surfaces[0].surface, Vec2(uv));
      EXPECT_TRUE(!on || *on);
    }
    Truth(*world, sheets_of(std::vector<SolidPtr>{truth}), views, found, 3);
  }
  expect_right(found, "parameter lines of csg");
  EXPECT_GT(counts.on, 20 * found.views);
  EXPECT_GT(counts.off, 10 * found.views);
  EXPECT_LT(counts.unclear, 1 + (counts.on + counts.off) / 20);
}

}  // namespace
}  // namespace lekalo::render::parameter_lines_test
