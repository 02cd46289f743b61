#include "geometry/surfaces/analytic/plane.h"

#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::plane_test {
namespace {

using checks::kSkewFrame;

TEST(Plane, MeetsTheGeneralChecks) {
  checks::check_surface(Plane(kSkewFrame, {{-2, 3}, {0.5, 4}}));
  checks::check_surface(Plane(frame_about({1e5, -1e6, 3}, {1, 0, 0}), {{-1, 1}, {-1, 1}}));
  const Plane unbounded(kSkewFrame);
  EXPECT_FALSE(unbounded.bounded());
  EXPECT_FALSE(unbounded.as_nurbs().has_value());
  checks::check_line_hits(unbounded, {{-10, 20}, {-30, 5}});
  checks::check_derivatives(unbounded,
                            checks::placed(kSkewFrame,
                                           [](auto u, auto v) {
                                             return Triple{u, v, Quad(0) * u};
                                           }),
                            {{-3, 3}, {-3, 3}});
}

TEST(Plane, BorderBelongsToTheRectangleAndAParallelLineDoesNotHit) {
  const Plane square(Frame(), {{0, 1}, {0, 1}});
  LineHits hits;
  for (const Vec2& p : {Vec2(0, 0), Vec2(1, 1), Vec2(0.5, 1), Vec2(0, 0.25)})
    square.line_hits({{p.x, p.y, 7}, {0, 0, -3}}, Interval::entire(), hits);
  EXPECT_EQ(hits.size(), 4);
  EXPECT_DOUBLE_EQ(hits[0].t, 7.0 / 3);
  hits.clear();
  // Within kHitSlack of the border: a hit on the border, so that a line through an edge meets both faces there.
  square.line_hits({{1 + 1e-13, 0.5, 7}, {0, 0, -3}}, Interval::entire(), hits);
  ASSERT_EQ(hits.size(), 1);
  EXPECT_EQ(hits[0].u, 1);
  hits.clear();
  square.line_hits({{1 + 1e-12, 0.5, 7}, {0, 0, -3}}, Interval::entire(), hits);
  square.line_hits({{-1, 0.5, 0}, {1, 0, 0}}, Interval::entire(), hits);
  EXPECT_EQ(hits.size(), 0);
}

}  // namespace
}  // namespace lekalo::geometry::plane_test
