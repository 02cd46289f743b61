// Where implicit surfaces and balls meet other shapes: part by part. An implicit surface consists of its formula, kept
// inside of the region, and where it is closed of the region's border, kept inside of the formula; balls consist of
// spheres, each kept outside of the others.
#include <cmath>

#include "geometry/queries/contours/level_section.h"
#include "geometry/queries/contours/silhouette_crossings.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/implicit_curves/implicit_arcs.h"
#include "geometry/spatial/box_tree.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/transformed.h"
#include "render/lines/stroke_collector.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// How deep in a ball the points of a box are.
Interval depth_in(const Vec3& center, double radius, const Box3& box) {
  Interval sum(0);
  for (int k = 0; k < 3; ++k) sum += sqr(Interval(box.lo[k], box.hi[k]) - Interval(center[k]));
  return Interval(radius) - sqrt(sum);
}

SurfacePtr sphere_about(const Vec3& center, double radius) {
  Frame frame;
  frame.origin = center;
  return std::make_shared<SphereSurface>(frame, radius);
}

// The side of a box that looks along an axis.
SurfacePtr side_of(const Box3& box, int axis, bool upper) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Frame frame;
  frame.x = frame.y = frame.z = Vec3(0);
  frame.x[u] = frame.y[v] = frame.z[axis] = 1;
  frame.origin = box.lo;
  if (upper) frame.origin[axis] = box.hi[axis];
  const Vec3 size = box.size();
  return std::make_shared<Plane>(frame, Rectangle{{0, size[u]}, {0, size[v]}});
}

}  // namespace

StrokeCollector::Cutter StrokeCollector::cut_in_ball(const Affine& to_world, const Vec3& center, double radius) {
  return cut_where(
      to_world, [=](const Box3& box) { return depth_in(center, radius, box); },
      [=](const Vec3& p) { return radius - glm::length(p - center); });
}

bool StrokeCollector::has_parts(const Entity& shape) {
  return solid_of<ImplicitSurface>(shape) || solid_of<Balls>(shape);
}

void StrokeCollector::each_part(const PlacedShape& solid, const Box3& near,
                                const std::function<void(const Part&)>& visit) {
  const Affine& to_world = solid.to_world;
  const size_t before = cutters_.size();
  if (const auto* balls = solid_of<Balls>(solid.shape)) {
    for (size_t k = 0; k < balls->balls().size(); ++k) {
      const Balls::Ball& ball = balls->balls()[k];
      if (!BoxTree::meets(Box3{ball.center, ball.center}.inflated(ball.radius), near)) continue;
      balls->near(k, [&](size_t i) {
        const Balls::Ball& other = balls->balls()[i];
        if (i != k) cutters_.push_back(cut_in_ball(to_world, other.center, other.radius));
      });
      visit({nullptr, sphere_about(ball.center, ball.radius)});
      cutters_.resize(before);
    }
    return;
  }
  const auto* implicit = solid_of<ImplicitSurface>(solid.shape);
  if (!BoxTree::meets(implicit->bounds(), near)) return;
  const ImplicitRegion& region = implicit->region();
  const Vec3 center = region.box.center();
  const double radius = region.radius();
  const auto cut_by_sides = [&](int but_of, bool but_upper) {
    for (int axis = 0; axis < 3 && !region.is_ball; ++axis)
      for (const bool upper : {false, true}) {
        if (axis == but_of && upper == but_upper) continue;
        Vec3 normal(0);
        normal[axis] = upper ? 1 : -1;
        const Vec3& corner = upper ? region.box.hi : region.box.lo;
        cutters_.push_back(
            cutter_of(ClipPlane{to_world.point(corner), glm::normalize(to_world.normal(normal)), false}));
      }
  };
  cut_by_sides(-1, false);
  if (region.is_ball)
    cutters_.push_back(cut_where(
        to_world, [=](const Box3& box) { return -depth_in(center, radius, box); },
        [=](const Vec3& p) { return glm::length(p - center) - radius; }));
  visit({implicit, nullptr});
  cutters_.resize(before);
  if (!implicit->is_closed()) return;
  const ImplicitFormula formula = implicit->formula();
  cutters_.push_back(cut_where(
      to_world, [formula](const Box3& box) { return formula.enclose(box); },
      [formula](const Vec3& p) { return formula(p); }));
  if (region.is_ball) visit({nullptr, sphere_about(center, radius)});
  for (int axis = 0; axis < 3 && !region.is_ball; ++axis)
    for (const bool upper : {false, true}) {
      cut_by_sides(axis, upper);
      visit({nullptr, side_of(region.box, axis, upper)});
      cutters_.resize(before + 1);
    }
  cutters_.resize(before);
}

void StrokeCollector::meets_parts(const Meets& meets, const PlacedShape& solid) {
  each_part(solid, meets.box,
            [&](const Part& part) { part.formula ? meets.formula(*part.formula) : meets.surface(part.surface); });
}

StrokeCollector::Meets StrokeCollector::meets_of_face(const SurfacePtr& face, const Affine& to_world,
                                                      const Affine& solid_to_world, const Style& style,
                                                      const HiddenLines& hidden) {
  const SurfacePtr moved = transformed(face, solid_to_world.inverse() * to_world);
  to_world_ = solid_to_world;
  return {moved->bounded() ? bounds(*moved) : Box3::everything(),
          [=, this](const ImplicitSurface& other) {
            if (moved->bounded()) add(level_section(moved, other.formula()), {moved}, style, hidden);
          },
          [=, this](const SurfacePtr& surface) {
            if (const auto* plane = dynamic_cast<const Plane*>(surface.get()))
              add(plane_section(moved, plane->frame().origin, plane->frame().z), {moved}, style, hidden);
            else
              add(intersect(moved, surface), {moved, surface}, style, hidden);
          }};
}

StrokeCollector::Meets StrokeCollector::meets_of_formula(const ImplicitSurface& implicit, const Affine& to_world,
                                                         const Affine& solid_to_world, const Style& style,
                                                         const HiddenLines& hidden) {
  to_world_ = to_world;
  const Affine to_solid = solid_to_world.inverse() * to_world, from_solid = to_solid.inverse();
  const ViewOf view = view_from(to_world.inverse()), view_of_solid = view_from(solid_to_world.inverse());
  const ImplicitSurface* one = &implicit;
  return {transformed(one->bounds(), to_solid),
          [=, this](const ImplicitSurface& other) {
            // Where both are.
            Box3 box = transformed(other.bounds(), from_solid);
            box.lo = glm::max(box.lo, one->bounds().lo), box.hi = glm::min(box.hi, one->bounds().hi);
            if (!glm::all(glm::lessThan(box.lo, box.hi))) return;
            const ImplicitArcs found =
                implicit_arcs(one->formula(), one->region(), ImplicitCondition::other(other.formula(), to_solid), box);
            if (!found.complete) is_incomplete();
            for (const ImplicitArc& arc : found.arcs) {
              cusps_ = silhouette_crossings(*arc.curve, arc.closed, *arc.formula, view);
              const std::vector<double> turns =
                  silhouette_crossings(*transformed(arc.curve, to_solid), arc.closed, other.formula(), view_of_solid);
              cusps_.insert(cusps_.end(), turns.begin(), turns.end());
              stroke(arc.curve, style, hidden);
            }
          },
          [=, this](const SurfacePtr& surface) {
            const SurfacePtr moved = transformed(surface, from_solid);
            add(level_section(moved, one->formula()), {moved}, style, hidden);
          }};
}

bool StrokeCollector::add_intersection_of_parts(const PlacedShape& a, const PlacedShape& b, const Style& style,
                                                const HiddenLines& hidden) {
  if (!has_parts(a.shape) || !has_parts(b.shape)) return false;
  const Box3 near = transformed(bounds(b.shape), a.to_world.inverse() * b.to_world);
  each_part(a, near, [&](const Part& part) {
    meets_parts(part.formula ? meets_of_formula(*part.formula, a.to_world, b.to_world, style, hidden)
                             : meets_of_face(part.surface, a.to_world, b.to_world, style, hidden),
                b);
  });
  return true;
}

}  // namespace lekalo::render
