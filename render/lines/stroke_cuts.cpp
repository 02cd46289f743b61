// Lines of objects that are cut by planes, and of faces: what of a curve is kept; and the edges that the cuts make.
#include <algorithm>
#include <cmath>

#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/curve_sign_changes.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/transformed.h"
#include "render/lines/stroke_collector.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// What lies so near to a plane, of its own size, lies in it.
constexpr double kInPlane = 1e-9;
// Parts of a curve that are shorter, of its domain, are none.
constexpr double kMinPart = 1e-9;

// Interval arithmetic for n . (p - o).
Interval height(const Vec3& normal, const Vec3& origin, const Box3& box) {
  Interval sum(0);
  for (int k = 0; k < 3; ++k) sum += Interval(normal[k]) * (Interval(box.lo[k], box.hi[k]) - Interval(origin[k]));
  return sum;
}

}  // namespace

StrokeCollector::Cutter StrokeCollector::cut_where(const Affine& to_world,
                                                   const std::function<Interval(const Box3&)>& range,
                                                   const std::function<double(const Vec3&)>& value) {
  const Affine back = to_world.inverse();
  Cutter cutter;
  cutter.add_cuts = [=](const Stroke& stroke, std::vector<double>& cuts) {
    const CurvePtr curve = transformed(stroke.curve, back * stroke.to_world);
    // Where it keeps to zero there are no changes to look for.
    constexpr int kPlaces = 8;
    const Interval domain = curve->domain();
    const double near = kInPlane * bounds(*curve).diameter();
    bool keeps_to_zero = true;
    for (int k = 0; k <= kPlaces && keeps_to_zero; ++k)
      keeps_to_zero = std::abs(value(curve->point(domain.lo + domain.width() * k / kPlaces))) <= near;
    if (keeps_to_zero) return;
    const std::vector<double> found = sign_changes(*curve, false, range, value);
    cuts.insert(cuts.end(), found.begin(), found.end());
  };
  cutter.keeps = [=](const Stroke& stroke, double t, double size) {
    return value(back.point(stroke.to_world.point(stroke.curve->point(t)))) <= kInPlane * size;
  };
  return cutter;
}

StrokeCollector::Cutter StrokeCollector::cutter_of(const ClipPlane& plane) {
  const Vec3 origin = plane.through, normal = glm::normalize(plane.normal);
  return cut_where(
      Affine(), [=](const Box3& box) { return height(normal, origin, box); },
      [=](const Vec3& point) { return glm::dot(normal, point - origin); });
}

StrokeCollector::Cutter StrokeCollector::cutter_of(const SmoothPart& part) {
  const auto original = [](const SurfacePtr& surface) {
    const auto* moved = dynamic_cast<const TransformedSurface*>(surface.get());
    return moved ? moved->original() : surface;
  };
  const SurfacePtr surface = original(part.surface);
  const auto image_in = [=](const Stroke& stroke) -> const Curve* {
    for (const Stroke::SupportingSurface& supporting_surface : stroke.supporting_surfaces)
      if (original(supporting_surface.surface) == surface) return supporting_surface.image.get();
    return nullptr;
  };
  Cutter cutter;
  cutter.add_cuts = [=, sides = part.sides](const Stroke& stroke, std::vector<double>& cuts) {
    const Curve* image = image_in(stroke);
    if (!image) return;
    for (const ImplicitSide& side : sides) {
      const std::vector<double> found = sign_changes(
          *image, false, [&](const Box3& box) { return side.range(box); },
          [&](const Vec3& p) { return side.value(p); });
      cuts.insert(cuts.end(), found.begin(), found.end());
    }
  };
  cutter.keeps = [=, sides = part.sides](const Stroke& stroke, double t, double) {
    const Curve* image = image_in(stroke);
    return image && hold(sides, image->point(t));
  };
  return cutter;
}

const std::vector<SmoothPart>& StrokeCollector::smooth_parts_of(const SurfacePtr& surface) {
  const auto known = parts_.find(surface);
  return known != parts_.end() ? known->second : parts_.emplace(surface, smooth_parts(surface)).first->second;
}

void StrokeCollector::each_smooth_part(const SurfacePtr& surface, const std::function<void(const SurfacePtr&)>& visit) {
  const std::vector<SmoothPart>& parts = smooth_parts_of(surface);
  // Renders show no kinks that a line runs over, but what bridges a step.
  if (parts.size() == 1 || (!drawing_ && parts_between_steps(surface).parts.empty())) return visit(surface);
  for (const SmoothPart& part : parts) {
    cutters_.push_back(cutter_of(part));
    visit(part.surface);
    cutters_.pop_back();
  }
}

std::vector<Interval> StrokeCollector::kept_parts(const Stroke& whole) const {
  const Interval domain = whole.curve->domain();
  if (cutters_.empty()) return {domain};
  // Contours that solve their equations at every point are asked too often for that.
  Stroke stroke = whole;
  for (Stroke::SupportingSurface& supporting_surface : stroke.supporting_surfaces)
    supporting_surface.image =
        contour_approximation(stroke.curve, *supporting_surface.surface, supporting_surface.image);
  stroke.curve = contour_approximation(stroke.curve);
  const double size = bounds(*transformed(stroke.curve, stroke.to_world)).diameter();
  std::vector<double> cuts{domain.lo, domain.hi};
  for (const Cutter& cutter : cutters_) cutter.add_cuts(stroke, cuts);
  std::sort(cuts.begin(), cuts.end());
  std::vector<Interval> parts;
  for (size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Interval t{cuts[k], cuts[k + 1]};
    if (!(t.width() > kMinPart * domain.width())) continue;
    if (!std::all_of(cutters_.begin(), cutters_.end(),
                     [&](const Cutter& cutter) { return cutter.keeps(stroke, place_inside(t), size); }))
      continue;
    if (!parts.empty() && parts.back().hi >= t.lo - kMinPart * domain.width())
      parts.back().hi = t.hi;
    else
      parts.push_back(t);
  }
  return parts;
}

void StrokeCollector::add_part(const Stroke& whole, const Interval& t) {
  Stroke stroke = whole;
  if (t.width() < whole.curve->domain().width()) {
    stroke.curve = std::make_shared<CurvePart>(whole.curve, t);
    std::erase_if(stroke.cusps, [&](double cusp) { return !t.contains(cusp); });
  }
  work_.strokes.push_back(std::move(stroke));
}

SurfacePtr StrokeCollector::cap_of(const ClipPlane& plane) const {
  const Affine back = to_world_.inverse();
  const Frame frame = frame_about(back.point(plane.through), glm::transpose(to_world_.linear) * plane.normal);
  Box3 box;
  each_face([&](const SurfacePtr& surface) { box.include(bounds(*surface)); });
  const Vec3 middle = box.center() - frame.origin;
  const Vec2 at(glm::dot(middle, frame.x), glm::dot(middle, frame.y));
  const double reach = 0.5 * box.diameter();
  return std::make_shared<Plane>(frame, Rectangle{{at.x - reach, at.x + reach}, {at.y - reach, at.y + reach}});
}

void StrokeCollector::lies_on_cap(const CurvePtr& curve, const SurfacePtr& cap) {
  const Frame& frame = dynamic_cast<const Plane&>(*cap).frame();
  Affine to_plane;
  to_plane.linear = glm::transpose(Mat3(frame.x, frame.y, Vec3(0)));
  to_plane.offset = -(to_plane.linear * frame.origin);
  supporting_surfaces_.push_back({cap, transformed(curve, to_plane)});
}

void StrokeCollector::add_cut_edges(std::string_view kind, const Style& style, const HiddenLines& hidden) {
  const std::vector<ClipPlane>& planes = planes_;
  for (const ClipPlane& plane : planes) {
    if (kind != (plane.cap ? "sharp" : "boundary")) continue;
    if (plane.cap) cap_ = cap_of(plane);
    add_section(object_->shape, {plane.through, plane.normal}, style, hidden);
    cap_ = nullptr;
  }
  const auto* body = std::get_if<BodyPtr>(&object_->shape);
  if (!body || planes.size() < 2) return;
  // Where two planes meet inside of it, along the line through p.
  const LineIntersector intersector(**body);
  for (size_t i = 0; i < planes.size(); ++i)
    for (size_t k = i + 1; k < planes.size(); ++k) {
      const ClipPlane &a = planes[i], &b = planes[k];
      if (!(a.cap || b.cap) || kind != (a.cap && b.cap ? "sharp" : "boundary")) continue;
      const SurfacePtr cap_a = cap_of(a), cap_b = cap_of(b);
      const Frame &f = dynamic_cast<const Plane&>(*cap_a).frame(), &g = dynamic_cast<const Plane&>(*cap_b).frame();
      const Vec3 along = glm::cross(f.z, g.z);
      const double square = glm::dot(along, along);
      if (!(square > kInPlane * kInPlane)) continue;
      const Vec3 p = f.origin + glm::dot(g.z, g.origin - f.origin) / square * glm::cross(along, f.z);
      const std::vector<SurfaceHit> hits = intersector.all_hits({p, along});
      for (size_t h = 0; h + 1 < hits.size(); h += 2) {
        const auto edge = std::make_shared<Segment>(p + hits[h].t * along, p + hits[h + 1].t * along);
        if (a.cap) lies_on_cap(edge, cap_a);
        if (b.cap) lies_on_cap(edge, cap_b);
        stroke(edge, style, hidden);
      }
    }
}

}  // namespace lekalo::render
