// Random solids and sheets for tests of drawings, with their closed forms.
#pragma once

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "render/drawing/random_views.h"
#include "support/sight_oracle.h"

namespace lekalo::render {

inline geometry::Frame anywhere(Views& views, double reach) {
  geometry::Frame frame = geometry::frame_from({0, 0, 0}, views.direction(), views.direction());
  frame.origin = {views.number(-reach, reach), views.number(-reach, reach), views.number(-reach, reach)};
  return frame;
}

// Of five kinds: box, cylinder, cone, ball, torus.
struct Part {
  geometry::Body body;
  oracle::sight::SolidPtr solid;
};
inline Part random_part(Views& views, int kind, double reach) {
  using namespace geometry;
  const Frame frame = anywhere(views, reach);
  const double r = views.number(0.6, 1.4), h = views.number(0.8, 2.5);
  switch (kind % 5) {
    case 0: {
      const Vec3 size(r, h, views.number(0.7, 2));
      return {box(frame, size), std::make_shared<oracle::sight::BoxSolid>(frame, size)};
    }
    case 1:
      return {frustum(frame, r, r, h), std::make_shared<oracle::sight::FrustumSolid>(frame, r, r, h)};
    case 2: {
      const double top = r * views.number(0.2, 0.8);
      return {frustum(frame, r, top, h), std::make_shared<oracle::sight::FrustumSolid>(frame, r, top, h)};
    }
    case 3:
      return {ball(frame, r), std::make_shared<oracle::sight::BallSolid>(frame, r)};
    default: {
      const double minor = r * views.number(0.2, 0.7);
      return {torus_body(frame, r, minor), std::make_shared<oracle::sight::TorusSolid>(frame, r, minor)};
    }
  }
}

// A sheet through the origin, lying or standing: two of them pierce one another.
inline geometry::SurfacePtr sheet_through_the_middle(Views& views, bool lies) {
  geometry::Grid<Vec3> net{4, 3, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vec3 p(i - 1.5, j - 1.0, views.number(-1, 1));
      net.values.push_back(lies ? p : Vec3(p.z, p.x, p.y));
    }
  return std::make_shared<geometry::NurbsSurface>(geometry::bezier_surface(net));
}

}  // namespace lekalo::render
