// Bodies cut by sheets, and turned inside out (Golovanov 2016, 6.2 and 6.4).
#include <gtest/gtest.h>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/topology/sew.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry::cut_test {
namespace {

double volume(const Body& body) { return measure(body).volume.value; }

Frame at(double x, double y, double z) {
  Frame frame;
  frame.origin = {x, y, z};
  return frame;
}

SurfacePtr plane_piece(const Frame& frame, double width, double height) {
  return std::make_shared<Plane>(frame, Rectangle{{0, width}, {0, height}});
}

// A box with two holes, the stepped sheet through the axes of both: 45 of 72 less half of each hole.
TEST(CutBody, SteppedSection) {
  Body body = box(at(0, 0, 0), {6, 4, 3});
  body = boolean(BooleanOperation::subtract, body, cylinder_body(at(1.5, 2, -1), 0.5, 5));
  body = boolean(BooleanOperation::subtract, body, cylinder_body(at(4.5, 1, -1), 0.5, 5));
  const Frame left = frame_from({-1, 2, -1}, {0, -1, 0}, {1, 0, 0}),
              middle = frame_from({3, 2, -1}, {-1, 0, 0}, {0, -1, 0}),
              right = frame_from({3, 1, -1}, {0, -1, 0}, {1, 0, 0});
  const Body sheet = sew(std::array{plane_piece(left, 4, 5), plane_piece(middle, 1, 5), plane_piece(right, 4, 5)});
  const Body inner = cut(body, sheet, true), outer = cut(body, sheet, false);
  EXPECT_NEAR(volume(inner), 45 - 0.75 * kPi, 1e-9);
  EXPECT_NEAR(volume(inner) + volume(outer), volume(body), 1e-9);
}

TEST(CutBody, SheetThatEndsInside) {
  const Body sheet = sew(std::array{plane_piece(at(-1, -1, 1), 3, 9)});
  EXPECT_THROW(cut(box(at(0, 0, 0), {6, 4, 3}), sheet, true), BooleanError);
}

TEST(InvertedBody, TwiceIsTheSame) {
  const Body body = cylinder_body(at(0, 0, 0), 1, 2), inside_out = inverted(body);
  EXPECT_NEAR(volume(inside_out), -2 * kPi, 1e-12);
  EXPECT_TRUE(inverted(inside_out).is_valid());
}

}  // namespace
}  // namespace lekalo::geometry::cut_test
