#include "geometry/bodies/constructions/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/trims/trim_loops.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/operations/circle_of_curve.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/curves/splines/nurbs_operations.h"
#include "geometry/queries/intersections/self_intersections.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Tangents that differ by less, and curvatures times the size, go on smoothly.
constexpr double kSameTangent = 1e-9;
constexpr double kSameCurvature = 1e-6;
// Relative to its size a profile lies in its plane to this.
constexpr double kInPlane = 1e-9;

std::string text_of(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

struct EndState {
  Vec3 tangent, curvature;
};

EndState state_at(const Curve& curve, double t) {
  const CurveJet jet = curve.evaluate(t, 2);
  const double speed = glm::length(jet.d[1]);
  const Vec3 tangent = jet.d[1] / speed;
  return {tangent, (jet.d[2] - glm::dot(jet.d[2], tangent) * tangent) / (speed * speed)};
}

bool goes_on_smoothly(const Curve& a, const Curve& b, double size) {
  const EndState before = state_at(a, a.domain().hi), after = state_at(b, b.domain().lo);
  return glm::length(before.tangent - after.tangent) < kSameTangent &&
         size * glm::length(before.curvature - after.curvature) < kSameCurvature;
}

// The straight segment, where the control points of a part lie on one line in order.
CurvePtr as_segment(const NurbsCurveForm& form) {
  const auto point = [](const Vec4& p) { return Vec3(p) / p.w; };
  const Vec3 from = point(form.points.front()), to = point(form.points.back());
  const double length = glm::length(to - from);
  if (!(length > 0)) return nullptr;
  double before = 0;
  for (const Vec4& p : form.points) {
    const Vec3 off = point(p) - from;
    const double along = glm::dot(off, to - from) / length;
    if (glm::length(off - along / length * (to - from)) > 1e-14 * (length + glm::length(from)) || along < before)
      return nullptr;
    before = along;
  }
  return std::make_shared<Segment>(from, to);
}

// A part by the simplest curve that it is.
CurvePtr part_of(const NurbsCurveForm& form, const Interval& part) {
  const NurbsCurveForm clamped = clamped_part(form, part);
  if (CurvePtr segment = as_segment(clamped)) return segment;
  auto curve = std::make_shared<NurbsCurve>(clamped);
  if (auto circle = circle_of(*curve)) return circle;
  return curve;
}

// Cut at knots of full multiplicity, where the curve does not go on smoothly.
std::vector<CurvePtr> parts_of_spline(const CurvePtr& curve, const NurbsCurveForm& form) {
  const Interval domain = curve->domain();
  std::vector<double> cuts{domain.lo};
  for (size_t i = 0; i + form.degree <= form.knots.size(); ++i) {
    const double t = form.knots[i];
    if (t > cuts.back() && t < domain.hi && form.knots[i + form.degree - 1] == t) cuts.push_back(t);
  }
  cuts.push_back(domain.hi);
  const double size = bounds(*curve).diameter();
  std::vector<double> kept{domain.lo};
  for (size_t i = 1; i + 1 < cuts.size(); ++i)
    if (!goes_on_smoothly(*part_of(form, {cuts[i - 1], cuts[i]}), *part_of(form, {cuts[i], cuts[i + 1]}), size))
      kept.push_back(cuts[i]);
  kept.push_back(domain.hi);
  if (kept.size() == 2) {
    if (CurvePtr segment = as_segment(clamped_part(form, domain))) return {segment};
    if (auto circle = circle_of(*curve)) return {circle};
    return {curve};
  }
  std::vector<CurvePtr> parts;
  for (size_t i = 0; i + 1 < kept.size(); ++i) parts.push_back(part_of(form, {kept[i], kept[i + 1]}));
  return parts;
}

std::vector<CurvePtr> parts_at_corners(const CurvePtr& curve) {
  const std::vector<CurvePiece> pieces = curve->pieces();
  const Interval domain = curve->domain();
  std::vector<double> cuts{domain.lo};
  for (size_t i = 0; i + 1 < pieces.size(); ++i) {
    const double t = pieces[i].domain.hi;
    const Vec3 before = evaluate_within(*curve, pieces[i].domain, t, 1).d[1], after = curve->evaluate(t, 1).d[1];
    if (glm::length(glm::normalize(before) - glm::normalize(after)) > kSameTangent) cuts.push_back(t);
  }
  cuts.push_back(domain.hi);
  if (cuts.size() == 2) return {curve};
  std::vector<CurvePtr> parts;
  for (size_t i = 0; i + 1 < cuts.size(); ++i)
    parts.push_back(std::make_shared<CurvePart>(curve, Interval(cuts[i], cuts[i + 1])));
  return parts;
}

std::vector<Vec3> samples_of(const Curve& curve) {
  constexpr int kSamples = 16;
  std::vector<Vec3> result;
  for (const CurvePiece& piece : curve.pieces())
    for (int k = 0; k < kSamples; ++k)
      result.push_back(curve.point(piece.domain.lo + piece.domain.width() * k / kSamples));
  return result;
}

Vec3 area_of(const std::vector<Vec3>& polygon) {
  Vec3 sum(0);
  for (size_t i = 0; i < polygon.size(); ++i)
    sum += 0.5 * glm::cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return sum;
}

struct Outline {
  CurvePtr curve;
  std::vector<Vec3> polygon;
  Vec3 area;
  size_t source;
};

std::string name_of(size_t k, size_t count) {
  return count == 1 ? "the profile" : fmt::format("curve {} of the profile", k);
}

void check_simple(const Curve& curve, const std::string& name, const char* field) {
  const CurveSelfIntersections found = self_intersections(curve);
  if (!found.points.empty())
    throw FieldError(field,
                     fmt::format("{} meets itself at {}, t = {:.6g} and {:.6g}", name, text_of(found.points[0].point),
                                 found.points[0].s, found.points[0].t),
                     "a profile does not cross or touch itself");
  if (!found.common.empty())
    throw FieldError(
        field,
        fmt::format("{} runs twice along the same way, from {}", name, text_of(curve.point(found.common[0].s.lo))),
        "a profile does not cross or touch itself");
}

Outline outline_of(const CurvePtr& curve, size_t source, const std::string& name, const char* field) {
  if (!(curve->domain().width() < kInfinity)) throw FieldError(field, name + " is unbounded", "give it a domain");
  if (!curve->is_closed()) {
    const Vec3 begin = curve->point(curve->domain().lo), end = curve->point(curve->domain().hi);
    throw FieldError(field,
                     fmt::format("{} is open: it begins at {} and ends at {}, {:.6g} apart", name, text_of(begin),
                                 text_of(end), glm::length(end - begin)),
                     "close it, or give a thickness where the body has one");
  }
  Outline outline{curve, samples_of(*curve), {}, source};
  outline.area = area_of(outline.polygon);
  const double size = bounds(*curve).diameter();
  if (!(glm::length(outline.area) > 1e-12 * size * size)) {
    check_simple(*curve, name, field);  // the areas of the loops of an eight cancel out
    throw FieldError(field, name + " encloses no area", "a closed plane curve");
  }
  return outline;
}

void check_plane(const Outline& outline, const Frame& plane, double size, const std::string& name, const char* field) {
  for (const Vec3& p : outline.polygon) {
    const double off = std::abs(plane.to_local_point(p).z);
    if (off > kInPlane * size)
      throw FieldError(
          field, fmt::format("{} is not in the plane of the profile: {} lies {:.6g} off it", name, text_of(p), off),
          "a profile is plane");
  }
}

void check_apart(const std::vector<Outline>& outlines, const char* field) {
  for (size_t i = 0; i < outlines.size(); ++i)
    for (size_t j = i + 1; j < outlines.size(); ++j) {
      const CurveIntersections found = intersect(*outlines[i].curve, *outlines[j].curve);
      if (!found.points.empty() || !found.common.empty())
        throw FieldError(field,
                         fmt::format("curves {} and {} of the profile meet at {}", i, j,
                                     text_of(found.points.empty() ? outlines[i].curve->point(found.common[0].s.lo)
                                                                  : found.points[0].point)),
                         "holes lie inside of the outline and apart");
    }
}

}  // namespace

std::vector<CurvePtr> smooth_segments(const CurvePtr& curve) {
  if (const auto* composite = dynamic_cast<const CompositeCurve*>(curve.get())) {
    std::vector<CurvePtr> result;
    for (const CurvePtr& segment : composite->segments())
      for (CurvePtr& part : smooth_segments(segment)) result.push_back(std::move(part));
    return result;
  }
  if (const auto* image = dynamic_cast<const TransformedCurve*>(curve.get())) {
    std::vector<CurvePtr> result;
    for (const CurvePtr& part : smooth_segments(image->original())) result.push_back(transformed(part, image->map()));
    return result;
  }
  const auto form = curve->as_nurbs();
  if (form && form->maps.empty()) return parts_of_spline(curve, *form);
  return parts_at_corners(curve);
}

std::vector<Vec3> Profile::samples() const {
  std::vector<Vec3> result;
  for (const ProfileLoop& loop : loops)
    for (const CurvePtr& segment : loop.segments)
      for (const Vec3& p : samples_of(*segment)) result.push_back(p);
  return result;
}

Profile read_profile(const Fields& fields, const char* field) {
  std::vector<CurvePtr> curves;
  for (const std::any& one : fields.references(field)) curves.push_back(std::any_cast<CurvePtr>(one));
  if (curves.empty()) throw FieldError(field, "there is no profile", "give a closed plane curve");
  return profile_of(curves, field);
}

Profile profile_of(const std::vector<CurvePtr>& curves, const char* field) {
  const size_t count = curves.size();
  std::vector<Outline> outlines;
  Box3 box;
  for (size_t k = 0; k < count; ++k) {
    outlines.push_back(outline_of(curves[k], k, name_of(k, count), field));
    box.include(bounds(*curves[k]));
  }
  Profile profile;
  profile.plane = frame_about(outlines[0].polygon[0], glm::normalize(outlines[0].area));
  for (size_t k = 0; k < count; ++k) {
    check_plane(outlines[k], profile.plane, box.diameter(), name_of(k, count), field);
    check_simple(*outlines[k].curve, name_of(k, count), field);
  }
  check_apart(outlines, field);
  const auto flat = [&](const std::vector<Vec3>& polygon) {
    std::vector<Vec2> result;
    for (const Vec3& p : polygon) result.push_back(Vec2(profile.plane.to_local_point(p)));
    return result;
  };
  size_t outer = 0;
  for (size_t k = 1; k < count; ++k)
    if (glm::length(outlines[k].area) > glm::length(outlines[outer].area)) outer = k;
  const std::vector<Vec2> around = flat(outlines[outer].polygon);
  std::swap(outlines[0], outlines[outer]);
  for (size_t k = 0; k < count; ++k) {
    if (k > 0 && !is_in(flat(outlines[k].polygon)[0], around))
      throw FieldError(field, "the curves of the profile are not one outline with holes: two lie beside each other",
                       "make a body of each outline");
    for (size_t j = 1; j < count && k > 0; ++j)
      if (j != k && is_in(flat(outlines[k].polygon)[0], flat(outlines[j].polygon)))
        throw FieldError(field, "a hole of the profile lies inside of another", "make a body of each outline");
    profile.loops.push_back({smooth_segments(outlines[k].curve), outlines[k].area, k > 0, outlines[k].source});
  }
  return profile;
}

void face_along(Profile& profile, const Vec3& direction, const char* field) {
  const double cosine = glm::dot(profile.plane.z, direction) / glm::length(direction);
  if (!(std::abs(cosine) > 1e-9))
    throw FieldError(field, "the profile is moved within its own plane", "a direction across the plane of the profile");
  if (cosine < 0) profile.plane = {profile.plane.origin, profile.plane.y, profile.plane.x, -profile.plane.z};
}

}  // namespace lekalo::geometry
