#include "geometry/queries/contours/common_points.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "geometry/bodies/trims/trim.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/queries/intersections/curve_pair.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

namespace {

// Of the parameters of a face's border.
constexpr double kOnBorder = 1e-9;
// Of the tolerance: points so near to an end of a common curve are that end.
constexpr double kNearEnd = 10;
constexpr double kContact = 10;

// A surface, or a face of a body.
struct Sheet {
  SurfacePtr surface;
  std::shared_ptr<const TrimRegion> trim;
  int face = -1;
  Box3 box;

  bool is_unbounded_plane() const { return !surface->bounded(); }
  bool holds(const Vec2& uv) const { return !trim || trim->contains(uv.x, uv.y, kOnBorder); }
};

std::vector<Sheet> sheets_of(const SurfaceOrBody& of) {
  std::vector<Sheet> sheets;
  if (const auto* body = std::get_if<BodyPtr>(&of)) {
    for (int k = 0; k < static_cast<int>((*body)->faces.size()); ++k)
      sheets.push_back({(*body)->faces[k].surface, trim_of(**body, k), k, {}});
  } else {
    sheets.push_back({std::get<SurfacePtr>(of), nullptr, -1, {}});
  }
  for (Sheet& sheet : sheets) {
    if (!sheet.surface->bounded() && !dynamic_cast<const Plane*>(sheet.surface.get()))
      throw std::invalid_argument("the surface is unbounded: give it a domain to intersect");
    sheet.box = bounds(*sheet.surface);
  }
  return sheets;
}

// The parameters of the point, which lies on the surface; nothing if it is farther away than `near`.
std::optional<Vec2> place_on(const Surface& surface, const Vec3& p, double near) {
  if (!surface.bounded()) {
    const Vec3 local = dynamic_cast<const Plane&>(surface).frame().to_local_point(p);
    if (std::abs(local.z) > near) return std::nullopt;
    return Vec2(local.x, local.y);
  }
  const SurfaceFootPoints found = project(p, surface);
  if (found.foot_points.empty() || found.foot_points[0].distance > near) return std::nullopt;
  return Vec2(found.foot_points[0].u, found.foot_points[0].v);
}

class ThreeSheets {
 public:
  ThreeSheets(const std::array<SurfaceOrBody, 3>& of, double tolerance) : relative_(tolerance) {
    Box3 all;
    for (int i = 0; i < 3; ++i) {
      sheets_[i] = sheets_of(of[i]);
      for (const Sheet& sheet : sheets_[i])
        if (sheet.surface->bounded()) all.include(sheet.box);
    }
    // Three planes have no size but that of their distances from the origin.
    for (int i = 0; all.empty() && i < 3; ++i)
      size_ = std::max(size_, glm::length(dynamic_cast<const Plane&>(*sheets_[i][0].surface).frame().origin));
    size_ = std::max({all.diameter(), size_, 1e-300});
    tolerance_ = tolerance * size_;
  }

  CommonPoints run() {
    for (const Sheet& a : sheets_[0])
      for (const Sheet& b : sheets_[1]) {
        if (!are_near(a.box, b.box, tolerance_)) continue;
        std::optional<Contours> of_pair;  // found once for all sheets of the third
        for (const Sheet& c : sheets_[2])
          if (are_near(a.box, c.box, tolerance_) && are_near(b.box, c.box, tolerance_)) meet({&a, &b, &c}, of_pair);
      }
    std::erase_if(result_.points, [&](const CommonPoint& one) {
      return std::any_of(result_.curves.begin(), result_.curves.end(), [&](const CommonCurve& common) {
        return glm::length(common.curve->point(common.t.lo) - one.point) <= kNearEnd * tolerance_ ||
               glm::length(common.curve->point(common.t.hi) - one.point) <= kNearEnd * tolerance_;
      });
    });
    std::sort(result_.points.begin(), result_.points.end(), [](const CommonPoint& a, const CommonPoint& b) {
      return std::array{a.point.x, a.point.y, a.point.z} < std::array{b.point.x, b.point.y, b.point.z};
    });
    return std::move(result_);
  }

 private:
  using Three = std::array<const Sheet*, 3>;

  void meet(const Three& of, std::optional<Contours>& of_first_pair) {
    if (std::all_of(of.begin(), of.end(), [](const Sheet* one) { return one->is_unbounded_plane(); }))
      return meet_planes(of);
    // Pairs whose intersections are no curves leave the point to another pair.
    bool complete = false;
    for (const std::array<int, 3>& order : {std::array{0, 1, 2}, std::array{0, 2, 1}, std::array{1, 2, 0}}) {
      const Sheet &first = *of[order[0]], &second = *of[order[1]];
      if (first.is_unbounded_plane() && second.is_unbounded_plane()) continue;
      const bool is_known = order[2] == 2;
      if (is_known && !of_first_pair) of_first_pair = intersect(first.surface, second.surface, relative_);
      const Contours found = is_known ? *of_first_pair : intersect(first.surface, second.surface, relative_);
      if (!found.complete || found.coincident) continue;
      complete = true;
      pierce(of, order, found);
      break;
    }
    result_.complete = result_.complete && complete;
  }

  // (4.5.2): the planes' equations are linear in the point.
  void meet_planes(const Three& of) {
    std::array<Vec3, 3> m;
    Vec3 height;
    for (int i = 0; i < 3; ++i) {
      const Frame& frame = dynamic_cast<const Plane&>(*of[i]->surface).frame();
      m[i] = frame.z, height[i] = glm::dot(frame.z, frame.origin);
    }
    const double volume = glm::dot(m[0], glm::cross(m[1], m[2]));
    if (std::abs(volume) < 1e-12) {
      result_.complete = false;
      return;
    }
    const Vec3 p =
        (height[0] * glm::cross(m[1], m[2]) + height[1] * glm::cross(m[2], m[0]) + height[2] * glm::cross(m[0], m[1])) /
        volume;
    std::array<Vec2, 3> places;
    for (int i = 0; i < 3; ++i) {
      const Vec3 local = dynamic_cast<const Plane&>(*of[i]->surface).frame().to_local_point(p);
      places[i] = {local.x, local.y};
    }
    add(of, p, places);
  }

  // The contours of the first two in the order with the third.
  void pierce(const Three& of, const std::array<int, 3>& order, const Contours& found) {
    const Sheet& third = *of[order[2]];
    // Where one of both is an unbounded plane the contour's only image is on the other.
    const bool plane_first = of[order[0]]->is_unbounded_plane();
    const auto places_at = [&](const Contour& contour, double t) {
      std::array<Vec2, 3> places;
      const Vec3 image = contour.images[0]->point(t);
      places[order[plane_first ? 1 : 0]] = {image.x, image.y};
      const int other = order[plane_first ? 0 : 1];
      if (contour.images.size() > 1) {
        const Vec3 of_other = contour.images[1]->point(t);
        places[other] = {of_other.x, of_other.y};
      } else {
        places[other] = place_on(*of[other]->surface, contour.curve->point(t), kInfinity).value();
      }
      return places;
    };
    for (const Contour& contour : found.branches) {
      if (!are_near(bounds(*contour.curve), third.box, tolerance_)) continue;
      const SurfaceIntersections met = intersect(*contour.curve, *third.surface, relative_);
      for (const SurfaceIntersection& one : met.points) {
        std::array<Vec2, 3> places = places_at(contour, one.t);
        places[order[2]] = {one.u, one.v};
        add(of, one.point, places);
      }
      for (const Interval& part : met.on_surface) {
        std::array<Vec2, 3> places = places_at(contour, part.middle());
        places[order[2]] =
            place_on(*third.surface, contour.curve->point(part.middle()), kInfinity).value_or(places[order[0]]);
        // What touches does so over about the square root of the tolerance.
        if (part.width() <= kContact * std::sqrt(relative_) * size_)
          add(of, contour.curve->point(part.middle()), places);
        else if (holds(of, places))
          result_.curves.push_back({contour.curve, part});
      }
    }
    // Contours shrink to a point, or are no more than their chords near it.
    for (const ContourPoint& point : found.points) {
      const std::optional<Vec2> on_third = place_on(*third.surface, point.point, tolerance_);
      if (!on_third) continue;
      std::array<Vec2, 3> places;
      places[order[plane_first ? 1 : 0]] = {point.parameters[0], point.parameters[1]};
      const int other = order[plane_first ? 0 : 1];
      places[other] = point.parameters.size() > 2 ? Vec2(point.parameters[2], point.parameters[3])
                                                  : place_on(*of[other]->surface, point.point, kInfinity).value();
      places[order[2]] = *on_third;
      add(of, point.point, places);
    }
  }

  static bool holds(const Three& of, const std::array<Vec2, 3>& places) {
    for (int i = 0; i < 3; ++i)
      if (!of[i]->holds(places[i])) return false;
    return true;
  }

  void add(const Three& of, const Vec3& p, const std::array<Vec2, 3>& places) {
    CommonPoint one{p, places, {of[0]->face, of[1]->face, of[2]->face}, 0, false};
    std::array<Vec3, 3> points, normals;
    for (int i = 0; i < 3; ++i) {
      points[i] = of[i]->surface->point(places[i].x, places[i].y);
      normals[i] = of[i]->surface->normal(places[i].x, places[i].y);
    }
    for (int i = 0; i < 3; ++i) one.distance = std::max(one.distance, glm::length(points[i] - points[(i + 1) % 3]));
    one.contact = !(std::abs(glm::dot(normals[0], glm::cross(normals[1], normals[2]))) > kParallel);
    // Curves that coincide nearly, and neighbouring faces, find the same point.
    if (!(one.distance <= 2 * tolerance_) || !holds(of, places)) return;
    for (CommonPoint& other : result_.points) {
      const bool touch = one.contact && other.contact;
      if (glm::length(other.point - p) > (touch ? std::sqrt(relative_) * size_ : 4 * tolerance_)) continue;
      if (one.distance < other.distance) other = one;
      return;
    }
    result_.points.push_back(one);
  }

  double relative_, size_ = 0, tolerance_ = 0;  // a part of the size; lengths
  std::array<std::vector<Sheet>, 3> sheets_;
  CommonPoints result_;
};

}  // namespace

CommonPoints common_points(const std::array<SurfaceOrBody, 3>& of, double tolerance) {
  return ThreeSheets(of, tolerance).run();
}

}  // namespace lekalo::geometry
