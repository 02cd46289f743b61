// Rays through the World, Embree's hierarchy included, against the halving oracle: no missing and no extra hit, each
// within 1e-9 of the size. A million rays for each shape and place in the full tier.
//
// A ray counts as tangent where the oracle's own number of hits changes with one of eight shifts of 1e-9 of the size;
// such rays are at most 1e-5 of the random ones. Beside random rays some are aimed at the shape's singular point (the
// apex of a cone, the centre of a horn torus), past it by 1e-6 to 1 of the size. Origins lie in, on and outside the
// bounds. Meshes: rays from inside a closed mesh meet it, also where they are aimed at its edges.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/splines/patches.h"
#include "geometry/tessellation/tessellate.h"
#include "render/trace/world.h"
#include "support/line_oracle.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::render::world_rays_test {
namespace {

using namespace geometry;

constexpr double kSame = 1e-9;  // of the size

std::shared_ptr<const Model> model_of(Entity shape, const Affine& transform = {}) {
  auto model = std::make_shared<Model>();
  Object object;
  object.shape = std::move(shape);
  object.transform = transform;
  model->objects.push_back(std::move(object));
  return model;
}

struct Subject {
  SurfaceSet surfaces;
  Vec3 singular{0};  // aimed at, where there is such a point
  bool has_singular = false;
  Affine transform;  // of the object that shows the surfaces
};

class WorldRays : public testing::Test {
 protected:
  std::mt19937_64 random_{17};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> unit_{0, 1};

  Vec3 any_direction() {
    const double x = normal_(random_), y = normal_(random_);
    return glm::normalize(Vec3(x, y, normal_(random_)));
  }
  Vec3 any_point(const Box3& box) {
    const double x = unit_(random_), y = unit_(random_);
    return box.lo + Vec3(x, y, unit_(random_)) * box.size();
  }

  // Every third from the surface, from inside the bounds, and from up to two diameters away; with `distance` from so
  // many diameters away.
  // The ray's t_min keeps off the hit at an origin on the surface.
  Ray any_ray(const Subject& subject, const Box3& box, double distance) {
    const double size = box.diameter();
    Ray ray;
    Vec3 target = any_point(box);
    if (subject.has_singular && unit_(random_) < 0.5)
      target = subject.singular + size * std::pow(10.0, -6 * unit_(random_)) * any_direction();
    ray.direction = any_direction();
    ray.t_min = kSame * size;
    const int kind = static_cast<int>(3 * unit_(random_));
    if (distance > 0) {
      ray.origin = target - distance * size * ray.direction;
    } else if (kind == 0) {
      const Surface& surface = *subject.surfaces[static_cast<size_t>(unit_(random_) * subject.surfaces.size())];
      const Rectangle d = surface.domain();
      const double u = d.u.lo + unit_(random_) * d.u.width(), v = d.v.lo + unit_(random_) * d.v.width();
      ray.origin = subject.transform.point(surface.point(u, v));
      ray.t_min = 1e-4 * size;
      target = any_point(box);  // at the singular point such a ray would run along the surface
      if (glm::length(target - ray.origin) > 1e-3 * size) ray.direction = glm::normalize(target - ray.origin);
    } else {
      ray.origin = kind == 1 ? target : target - 2 * size * unit_(random_) * ray.direction;
    }
    return ray;
  }

  static bool same(const std::vector<double>& a, const std::vector<double>& b, double size, double& worst) {
    if (a.size() != b.size()) return false;
    for (size_t i = 0; i < a.size(); ++i) {
      if (std::abs(a[i] - b[i]) > kSame * size) return false;
      worst = tests::worse(worst, std::abs(a[i] - b[i]) / size);
    }
    return true;
  }

  void expect_complete(const Subject& subject, const std::string& name, double distance = 0) {
    std::vector<oracle::PatchOracle> patches;
    Box3 box;
    for (const SurfacePtr& surface : subject.surfaces) {
      for (SurfacePiece piece : surface->pieces()) {
        for (Vec4& h : piece.points) h = Vec4(h.w * subject.transform.point(Vec3(h) / h.w), h.w);
        patches.emplace_back(piece.points, piece.degree_u, piece.degree_v);
      }
      box.include(transformed(bounds(*surface), subject.transform));
    }
    const double size = box.diameter();
    bool undecided = false;
    const auto roots_of = [&](const Ray& ray) {
      std::vector<double> t;
      for (const oracle::PatchOracle& patch : patches) {
        bool full = false;
        for (const oracle::Root& root : patch.roots({ray.origin, ray.direction}, &full)) t.push_back(root.t);
        undecided = undecided || full;
      }
      std::sort(t.begin(), t.end());
      // A root on the border of two patches is found by both.
      t.erase(std::unique(t.begin(), t.end(), [&](double a, double b) { return b - a <= kSame * size; }), t.end());
      std::erase_if(t, [&](double x) { return x < ray.t_min; });
      return t;
    };
    const World world(model_of(subject.surfaces.size() == 1 ? Entity(subject.surfaces[0]) : Entity(subject.surfaces),
                               subject.transform));

    const int count = tests::tier_count(1000000, 2000);
    int hits = 0, wrong = 0, tangent = 0, nearest_wrong = 0, occlusion_wrong = 0;
    double worst = 0;
    for (int k = 0; k < count; ++k) {
      Ray ray = any_ray(subject, box, distance);
      undecided = false;
      const std::vector<double> truth = roots_of(ray);
      hits += static_cast<int>(truth.size());
      std::vector<double> found;
      for (const Hit& hit : world.all_hits(ray)) found.push_back(hit.t);
      if (!same(found, truth, size, worst)) {
        bool changes = undecided;
        for (int copy = 0; copy < 8 && !changes; ++copy) {
          Ray shifted = ray;
          shifted.origin += kSame * size * Vec3(copy & 1 ? 1 : -1, copy & 2 ? 1 : -1, copy & 4 ? 1 : -1);
          changes = roots_of(shifted).size() != truth.size();
        }
        (changes ? tangent : wrong) += 1;
        continue;
      }
      // The nearest hit and shadows are decided on paths of their own.
      Hit nearest;
      const bool met = world.nearest(ray, nearest);
      nearest_wrong += met != !found.empty() || (met && nearest.t != found[0]);
      Ray shadow = ray;
      shadow.kind = RayKind::shadow;
      occlusion_wrong += world.occluded(shadow) != met;
      if (met) {
        shadow.t_max = found[0] * (1 - 1e-9);
        occlusion_wrong += shadow.t_max > shadow.t_min && world.occluded(shadow);
      }
    }
    EXPECT_EQ(wrong, 0) << name << ": of " << count << " rays";
    EXPECT_EQ(nearest_wrong, 0) << name;
    EXPECT_EQ(occlusion_wrong, 0) << name;
    EXPECT_LE(tangent, 1 + count / 100000) << name;
    EXPECT_GT(hits, count / 4) << name;
    tests::report_figure(name + "_rays", count);
    tests::report_figure(name + "_hits", hits);
    tests::report_figure(name + "_missing_or_extra", wrong);
    tests::report_figure(name + "_tangent_rays", tangent);
    tests::report_figure(name + "_largest_error_of_t", worst);
  }

  // Near the origin, moved away from it, and seen from 1000 radii.
  void expect_complete_everywhere(const std::function<Subject(const Vec3&)>& placed) {
    expect_complete(placed(Vec3(0)), "near");
    expect_complete(placed(Vec3(600, -700, 387)), "moved_1000_away");
    expect_complete(placed(Vec3(0)), "from_1000_radii", 500);
  }
};

// The surface's NURBS form, moved.
SurfacePtr as_spline(const Surface& surface, const Vec3& offset) {
  NurbsSurfaceForm form = *surface.as_nurbs();
  for (Vec4& h : form.points) h += Vec4(h.w * offset, 0);
  return std::make_shared<NurbsSurface>(form);
}

Frame frame_at(const Vec3& offset) { return frame_from(offset + Vec3(0.1, 0.2, -0.3), {0.2, -0.3, 0.9}, {1, 0.1, 0}); }

TEST_F(WorldRays, NurbsSphere) {
  expect_complete_everywhere(
      [](const Vec3& offset) { return Subject{{as_spline(SphereSurface(frame_at(Vec3(0)), 1.3), offset)}}; });
}

TEST_F(WorldRays, NurbsTorus) {
  expect_complete_everywhere(
      [](const Vec3& offset) { return Subject{{as_spline(TorusSurface(frame_at(Vec3(0)), 3, 1), offset)}}; });
}

TEST_F(WorldRays, Teapot) {
  std::ifstream file(LEKALO_SOURCE_DIR "/scenes/data/newell_teapot.txt");
  std::stringstream text;
  text << file.rdbuf();
  const std::vector<SurfacePtr> patches = parse_patches(text.str());
  expect_complete_everywhere([&](const Vec3& offset) {
    Subject subject;
    for (const SurfacePtr& patch : patches) subject.surfaces.push_back(as_spline(*patch, offset));
    return subject;
  });
}

TEST_F(WorldRays, RandomRationalBiquintic) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  NurbsSurfaceForm form;
  form.degree_u = form.degree_v = 5;
  form.knots_u = form.knots_v = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double w = std::exp(3 * (unit(random) - 0.5));
      form.points.push_back(Vec4(w * Vec3(i / 5.0, j / 5.0, unit(random)), w));
    }
  form.maps_u = form.maps_v = {ParameterMap{}};
  expect_complete_everywhere([&](const Vec3& offset) { return Subject{{as_spline(NurbsSurface(form), offset)}}; });
}

TEST_F(WorldRays, ConeAtItsApex) {
  expect_complete_everywhere([](const Vec3& offset) {
    const Frame frame = frame_at(offset);
    return Subject{{std::make_shared<ConeSurface>(frame, 1.2, 0, 2)}, frame.point({0, 0, 2}), true};
  });
}

TEST_F(WorldRays, HornTorus) {
  expect_complete_everywhere([](const Vec3& offset) {
    const Frame frame = frame_at(offset);
    return Subject{{std::make_shared<TorusSurface>(frame, 1, 1)}, frame.origin, true};
  });
}

// The surface stays near the origin; its object is stretched, turned, mirrored and moved.
// So many pieces that two of them are one primitive to Embree, and one of an odd number alone: a net of degree 1 in a
// plane, met once by every line through it, at its knots and between them.
TEST_F(WorldRays, ManyPieces) {
  constexpr int kSide = 513;  // 513^2 = 263,169 pieces
  std::vector<double> knots = {0};
  for (int i = 0; i <= kSide; ++i) knots.push_back(i);
  knots.push_back(kSide);
  std::vector<Vec3> points;
  for (int i = 0; i <= kSide; ++i)
    for (int k = 0; k <= kSide; ++k) points.emplace_back(i, k, 0.25 * i + 0.5 * k);
  const SplineAxis axis(1, knots, Extension::tangent);
  const World world(model_of(SurfacePtr(std::make_shared<NurbsSurface>(axis, axis, points))));
  ASSERT_EQ(world.statistics().pieces, static_cast<size_t>(kSide) * kSide);
  int wrong = 0;
  for (int k = 0; k < tests::tier_count(1000000); ++k) {
    double x = kSide * unit_(random_), y = kSide * unit_(random_);
    if (k % 4 == 1) x = std::floor(x) + 1;
    if (k % 4 >= 2) x = y = kSide - 0.5 * unit_(random_);  // the last piece
    Ray ray;
    ray.direction = any_direction();
    if (std::abs(glm::dot(ray.direction, Vec3(0.25, 0.5, -1))) < 0.1) continue;
    const double t = 1000 * unit_(random_);
    ray.origin = Vec3(x, y, 0.25 * x + 0.5 * y) - t * ray.direction;
    const std::vector<Hit> hits = world.all_hits(ray);
    Hit nearest;
    Ray shadow = ray;
    shadow.kind = RayKind::shadow;
    const bool good = hits.size() == 1 && std::abs(hits[0].t - t) < 1e-9 && world.nearest(ray, nearest) &&
                      nearest.t == hits[0].t && nearest.piece == hits[0].piece && world.occluded(shadow);
    wrong += !good;
  }
  EXPECT_EQ(wrong, 0);
}

TEST_F(WorldRays, TransformedTorus) {
  Subject subject{{as_spline(TorusSurface(frame_at(Vec3(0)), 3, 1), Vec3(0))}};
  subject.transform = Affine::translation({50, -20, 10}) * Affine::rotation(0.7, glm::normalize(Vec3(1, 2, 0.5))) *
                      Affine::scaling({2, -0.5, 0.3});
  expect_complete(subject, "near");
  expect_complete(subject, "from_1000_radii", 500);
}

// Every ray that begins outside a closed body meets it an even number of times, entering and leaving in turn.
TEST_F(WorldRays, ClosedBodiesAreMetInPairs) {
  const Vec3 away(600, -700, 387);
  const std::pair<const char*, Body> bodies[] = {{"box", box(frame_at(Vec3(0)), {1, 2, 3})},
                                                 {"ball", ball(frame_at(Vec3(0)), 1.5)},
                                                 {"cone", frustum(frame_at(Vec3(0)), 2, 0, 3)},
                                                 {"moved_frustum", frustum(frame_at(away), 2, 1, 3)},
                                                 {"moved_torus", torus_body(frame_at(away), 3, 1)}};
  for (const auto& [name, body] : bodies) {
    const Box3 room = bounds(body);
    const World world(model_of(std::make_shared<const Body>(body)));
    const int count = tests::tier_count(1000000);
    int unpaired = 0, hits = 0;
    for (int k = 0; k < count; ++k) {
      Ray ray;
      ray.direction = any_direction();
      ray.origin = any_point(room) - 1.1 * room.diameter() * ray.direction;
      const std::vector<Hit> found = world.all_hits(ray);
      bool in_turn = found.size() % 2 == 0;
      for (size_t i = 0; i < found.size(); ++i)
        in_turn = in_turn &&
                  (glm::dot(body.normal(found[i].face, found[i].u, found[i].v), ray.direction) < 0) == (i % 2 == 0);
      unpaired += !in_turn;
      hits += static_cast<int>(found.size());
    }
    EXPECT_EQ(unpaired, 0) << name << ": of " << count << " rays";
    EXPECT_GT(hits, count / 4) << name;
    tests::report_figure(std::string(name) + "_rays", count);
    tests::report_figure(std::string(name) + "_unpaired", unpaired);
  }
}

// Surfaces of unlike kinds in one plane, some of them in a group that is turned: everywhere the last listed of those
// that are there is met, from both sides and at angles down to five degrees.
TEST_F(WorldRays, OfSurfacesThatLieOnOneAnotherTheLastListedIsMet) {
  const Frame frame = frame_about({0.3, -2, 7}, glm::normalize(Vec3(1, 2, 3)));
  const auto patch = [&](int degree) {
    const double step = 2.0 / degree;
    Grid<Vec3> points{degree + 1, degree + 1, std::vector<Vec3>((degree + 1) * (degree + 1))};
    for (int i = 0; i <= degree; ++i)
      for (int k = 0; k <= degree; ++k)
        points.at(i, k) =
            frame.point({step * (i + 0.15 * unit_(random_)) - 1, step * (k + 0.15 * unit_(random_)) - 1, 0});
    return std::make_shared<NurbsSurface>(bezier_surface(points));
  };
  Frame below = frame;
  below.origin -= 0.5 * frame.z;
  const std::vector<Entity> shapes = {SurfacePtr(std::make_shared<Plane>(frame)), SurfacePtr(patch(2)),
                                      BodyPtr(std::make_shared<Body>(box(below, {1.5, 1.5, 0.5}))),
                                      SurfacePtr(std::make_shared<Plane>(frame, Rectangle{{-0.5, 2}, {-0.7, 0.9}})),
                                      SurfacePtr(patch(5))};
  const Affine turn = Affine::rotation(0.9, glm::normalize(Vec3(3, -1, 2)), {1, 1, 1});
  std::vector<int> order = {0, 1, 2, 3, 4};
  int wrong = 0, together = 0;
  for (int round = 0; round < 10; ++round) {
    std::shuffle(order.begin(), order.end(), random_);
    auto model = std::make_shared<Model>();
    for (const int k : order) {
      Object object;
      object.shape = shapes[static_cast<size_t>(k)];
      if (k % 2 == round % 2) {
        object.transform = turn.inverse();
        Group group;
        group.objects = {object};
        object.shape = std::make_shared<const Group>(group);
        object.transform = turn;
      }
      model->objects.push_back(object);
    }
    const World world(model);
    for (int i = 0; i < tests::tier_count(200000); ++i) {
      Ray ray;
      ray.direction = any_direction();
      if (std::abs(glm::dot(ray.direction, frame.z)) < 0.09) continue;
      ray.origin =
          frame.point({2 * unit_(random_) - 1, 2 * unit_(random_) - 1, 0}) - (1 + 20 * unit_(random_)) * ray.direction;
      Hit hit;
      ASSERT_TRUE(world.nearest(ray, hit));
      const std::vector<Hit> all = world.all_hits(ray);
      int64_t last = 0;
      int there = 0;
      for (const Hit& h : all)
        if (h.t <= all.front().t + 1e-10) last = std::max(last, h.instance), ++there;
      together += there > 1;
      wrong += hit.instance != last;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(together, tests::tier_count(200000));
  tests::report_figure("together", together);
  tests::report_figure("wrong", wrong);
}

class MeshRays : public WorldRays {
 protected:
  // Inside: anywhere near `inside` up to `reach`. Random rays, and a tenth as many aimed at edges.
  void expect_no_miss(const Body& body, const Vec3& inside, double reach, const std::string& name) {
    const auto mesh = std::make_shared<Mesh>(tessellate(body, {2e-3 * bounds(body).diameter()}));
    ASSERT_TRUE(is_closed(*mesh));
    const World world(model_of(MeshPtr(mesh)));
    const int count = tests::tier_count(5000000), aimed = tests::tier_count(500000);
    int missed = 0, missed_edges = 0;
    Ray ray;
    Hit hit;
    for (int k = 0; k < count + aimed; ++k) {
      ray.origin = inside + reach * unit_(random_) * any_direction();
      if (k < count) {
        ray.direction = any_direction();
        missed += !world.nearest(ray, hit);
        continue;
      }
      const auto& corner = mesh->triangles[static_cast<size_t>(unit_(random_) * mesh->triangles.size())].point;
      const int side = static_cast<int>(3 * unit_(random_));
      const Vec3 target = glm::mix(mesh->points[corner[side]], mesh->points[corner[(side + 1) % 3]], unit_(random_));
      ray.direction = glm::normalize(target - ray.origin);
      missed_edges += !world.nearest(ray, hit);
    }
    EXPECT_EQ(missed, 0) << name << ": of " << count;
    EXPECT_EQ(missed_edges, 0) << name << ": of " << aimed;
    tests::report_figure(name + "_triangles", static_cast<double>(mesh->triangles.size()));
    tests::report_figure(name + "_random_rays", count);
    tests::report_figure(name + "_missed", missed);
    tests::report_figure(name + "_edge_aimed_rays", aimed);
    tests::report_figure(name + "_edge_aimed_missed", missed_edges);
  }
};

// Bundles that run together, and lists of rays that do not, find what each ray finds alone; from inside none misses.
TEST_F(MeshRays, TogetherAsAlone) {
  const Frame frame = frame_at({300, -200, 100});
  const auto mesh = std::make_shared<Mesh>(tessellate(torus_body(frame, 3, 1), {2e-3}));
  const auto closed = std::make_shared<Model>(*model_of(MeshPtr(mesh))), open = std::make_shared<Model>(*closed);
  Object ground;  // unbounded: not in the hierarchy
  ground.shape = SurfacePtr(std::make_shared<Plane>(frame_from(frame.point({0, 0, -1.2}), {0.1, 0.2, 1}, {1, 0, 0})));
  open->objects.push_back(ground);
  const int count = tests::tier_count(2000000);
  for (const auto& model : {closed, open}) {
    const World world(model);
    int done = 0, hits = 0, others = 0, missed = 0;
    while (done < count) {
      const bool inside = unit_(random_) < 0.5, bundle = unit_(random_) < 0.7;
      const double width = std::pow(10, -5 * unit_(random_));
      const Vec3 from = inside ? frame.point({3, 0, 0}) + 0.8 * unit_(random_) * any_direction()
                               : frame.origin + 20 * unit_(random_) * any_direction();
      const Vec3 target = frame.origin + 4 * unit_(random_) * any_direction();
      std::vector<Ray> rays(1 + static_cast<size_t>(70 * unit_(random_)));
      for (Ray& ray : rays) {
        const auto& corner = mesh->triangles[static_cast<size_t>(unit_(random_) * mesh->triangles.size())].point;
        ray.origin = from;
        ray.direction =
            glm::normalize(bundle ? target + width * any_direction() - from
                                  : glm::mix(mesh->points[corner[0]], mesh->points[corner[1]], unit_(random_)) - from);
        if (unit_(random_) < 0.1) ray.t_max = 5 * unit_(random_);
        if (unit_(random_) < 0.1) ray.t_min = 5 * unit_(random_);
      }
      std::vector<Hit> together(rays.size());
      world.nearest(rays, together);
      const auto hidden = std::make_unique<bool[]>(rays.size());
      world.occluded(rays, {}, {hidden.get(), rays.size()});
      for (size_t i = 0; i < rays.size(); ++i) {
        Hit alone;
        const bool met = world.nearest(rays[i], alone);
        const Hit& hit = together[i];
        hits += met;
        others += hidden[i] != world.occluded(rays[i]);
        const bool free = rays[i].t_min == 0 && rays[i].t_max == kInfinity;
        missed += inside && free && hit.instance < 0;
        // The same but for what float cannot tell: at the sides of triangles, and where the range of t ends.
        if (met && hit.instance == alone.instance && hit.piece == alone.piece) {
          ASSERT_EQ(hit.t, alone.t);
          ASSERT_EQ(hit.b, alone.b);
          ASSERT_EQ(hit.u, alone.u);
        } else if (met != (hit.instance >= 0) || (met && std::abs(hit.t - alone.t) > 1e-4)) {
          ++others;
        }
      }
      done += static_cast<int>(rays.size());
    }
    EXPECT_EQ(missed, 0);
    EXPECT_GT(hits, done / 2);
    EXPECT_LE(others, done / 10000);
  }
}

TEST_F(MeshRays, FromInsideAlwaysHit) {
  expect_no_miss(ball(frame_at(Vec3(0)), 1.5), frame_at(Vec3(0)).origin, 1.2, "ball");
  const Frame moved = frame_at({600, -700, 387});
  expect_no_miss(torus_body(moved, 3, 1), moved.point({3, 0, 0}), 0.8, "moved_torus");
}

}  // namespace
}  // namespace lekalo::render::world_rays_test
