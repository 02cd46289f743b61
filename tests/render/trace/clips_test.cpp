// Planes that cut objects: where they stand in groups, and faces that lie in them.
#include <gtest/gtest.h>

#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/surfaces/analytic/plane.h"
#include "render/trace/world.h"

namespace lekalo::render::clips_test {
namespace {

using namespace geometry;

size_t hits(const World& world, const Vec3& origin, const Vec3& direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.t_min = 0;
  return world.all_hits(ray).size();
}

struct RandomPlaces {
  std::mt19937_64 random{3};
  std::uniform_real_distribution<double> unit{-1, 1};
  Vec3 next() {
    const double x = unit(random), y = unit(random);
    return {x, y, unit(random)};
  }
};

// A ball that the plane x = 0 of its group cuts, moved in the group by its own transform; the group in two places, in
// either order. Lines along the group's y meet what is left of the ball.
TEST(Clips, StandInTheGroup) {
  const Affine moved = Affine::translation({0.3, 0, 0});
  const Affine places[] = {Affine::translation({0.5, 0, 0}),
                           Affine::translation({10, 2, 1}) * Affine::rotation(2.0, {0, 0, 1})};
  for (const bool cap : {false, true})
    for (const Representation representation : {Representation::direct, Representation::mesh})
      for (const bool backwards : {false, true}) {
        auto group = std::make_shared<Group>();
        Object member;
        member.shape = std::make_shared<Body>(ball(Frame(), 1));
        member.transform = moved;
        member.representation = representation;
        member.sag = 1e-4;
        member.clips = {{Vec3(0), {2, 0, 0}, cap}};
        group->objects.push_back(member);
        auto model = std::make_shared<Model>();
        for (const int k : {0, 1}) {
          Object object;
          object.shape = GroupPtr(group);
          object.transform = places[backwards ? 1 - k : k];
          model->objects.push_back(object);
        }
        const World world(model);
        RandomPlaces random;
        for (int i = 0; i < 300; ++i) {
          const Vec3 p = 1.2 * random.next();
          const double off = glm::length(p - Vec3(0.3, p.y, 0));
          if (std::abs(off - 1) < 1e-3 || std::abs(p.x) < 1e-9) continue;
          for (const Affine& place : places)
            EXPECT_EQ(hits(world, place.point({p.x, -3, p.z}), place.direction({0, 1, 0})),
                      off < 1 && p.x < 0 ? 2u : 0u)
                << cap << backwards << " " << p.x << " " << p.z;
        }
      }
}

// A box turned in space, a side of which lies in the plane: all of it is left if it lies on the side that is, nothing
// if it lies beyond. Whole surfaces in the plane are left.
TEST(Clips, OfFacesInThePlane) {
  const Frame frame = frame_about({3.7, -1.3, 0.9}, {0.3, -0.8, 0.5});
  const Vec3 top = frame.origin + 2.0 * frame.z;
  const auto body = std::make_shared<Body>(box(frame, {1, 1, 2}));
  const auto below = std::make_shared<Body>(box(frame, {1, 1, 1}));
  const ShapePtr united = std::make_shared<Csg>(
      Csg::Operation::unite,
      std::vector<ShapePtr>{std::make_shared<BodyShape>(body), std::make_shared<BodyShape>(below)});
  const SurfacePtr sheet = std::make_shared<Plane>(frame, Rectangle{{0, 1}, {0, 1}});
  struct Case {
    Entity shape;
    Representation representation;
    Vec3 through;
    bool cap, open;
  };
  const Case cases[] = {{body, Representation::direct, top, false, false},
                        {body, Representation::mesh, top, false, false},
                        {body, Representation::direct, top, true, false},
                        {united, Representation::direct, top, false, false},
                        {sheet, Representation::direct, frame.origin, false, true},
                        {sheet, Representation::mesh, frame.origin, false, true}};
  for (const Case& one : cases)
    for (const double side : {0.0, 1.0, -1.0}) {
      auto model = std::make_shared<Model>();
      Object object;
      object.shape = one.shape;
      object.representation = one.representation;
      if (side != 0) object.clips = {{one.through, 3 * side * frame.z, one.cap}};
      model->objects.push_back(object);
      const World world(model);
      RandomPlaces random;
      for (int i = 0; i < 2000; ++i) {
        const Vec3 aim = frame.origin + 0.5 * (frame.x + frame.y) +
                         Mat3(frame.x, frame.y, frame.z) * (random.next() * Vec3(0.4, 0.4, 0)),
                   from = frame.origin + frame.z + 9.0 * glm::normalize(random.next());
        // Through the sheet, or the bottom of the box and a side or its top.
        EXPECT_EQ(hits(world, from, aim - from), one.open ? 1u : side < 0 ? 0u : 2u) << i << " side " << side;
      }
    }
}

}  // namespace
}  // namespace lekalo::render::clips_test
