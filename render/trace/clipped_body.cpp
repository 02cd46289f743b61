#include "render/trace/clipped_body.h"

#include <algorithm>
#include <limits>

#include "geometry/queries/differential/curvature.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/tolerances.h"

namespace lekalo::render {

using geometry::Interval;
using geometry::Line;
using geometry::SurfaceHit;

ClippedBody::ClippedBody(geometry::BodyPtr body, std::vector<CutPlane> planes, bool caps_only)
    : body_(std::move(body)),
      planes_(std::move(planes)),
      caps_only_(caps_only),
      intersector_(*body_),
      box_(geometry::bounds(*body_)) {
  for (const CutPlane& plane : planes_)
    caps_.push_back(
        std::make_shared<geometry::Plane>(geometry::frame_about(plane.half_space.through, plane.half_space.normal)));
}

void ClippedBody::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  // What the planes leave of the line, and which planes bound it.
  double enter = -geometry::kInfinity, leave = geometry::kInfinity;
  // Faces nearer to a plane lie in it: along the line, as near as these.
  const double near =
      geometry::kSameHit * box_.diameter() + 4 * std::numeric_limits<double>::epsilon() * glm::length(line.origin);
  double near_enter = 0, near_leave = 0;
  int enter_plane = -1, leave_plane = -1;
  for (int k = 0; k < static_cast<int>(planes_.size()); ++k) {
    const HalfSpace& half_space = planes_[k].half_space;
    const double slope = glm::dot(half_space.normal, line.direction);
    const double height = glm::dot(half_space.normal, line.origin - half_space.through);
    if (slope == 0) {
      if (height > 0) return;
      continue;
    }
    const double at = -height / slope;
    if (slope < 0 && at > enter) enter = at, enter_plane = k, near_enter = near / -slope;
    if (slope > 0 && at < leave) leave = at, leave_plane = k, near_leave = near / slope;
  }
  if (!(enter < leave)) return;
  const auto cap_hit = [&](double at, int plane) {
    const Vec3 p = line.at(at) - planes_[plane].half_space.through;
    const geometry::SurfaceJet jet = caps_[plane]->evaluate(0, 0, 1);
    SurfaceHit hit;
    hit.t = at;
    hit.u = glm::dot(p, jet.du());
    hit.v = glm::dot(p, jet.dv());
    hit.face = static_cast<int>(body_->faces.size()) + plane;
    return hit;
  };
  const std::vector<SurfaceHit> crossings = intersector_.all_hits(line);
  for (size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const SurfaceHit& in = crossings[k];
    const SurfaceHit& out = crossings[k + 1];
    const bool enters_body = in.t >= enter - near_enter, leaves_body = out.t <= leave + near_leave;
    // A face in a plane from which the body lies beyond leaves nothing.
    const double least = enters_body ? (leaves_body ? 0 : near_leave) : (leaves_body ? near_enter : 0);
    if (!((leaves_body ? out.t : leave) - (enters_body ? in.t : enter) > least)) continue;
    const auto add = [&](bool on_body, const SurfaceHit& crossing, double at, int plane) {
      if (on_body ? caps_only_ : !planes_[plane].cap) return;
      const SurfaceHit hit = on_body ? crossing : cap_hit(at, plane);
      if (t.contains(hit.t)) hits.push_back(hit);
    };
    add(enters_body, in, enter, enter_plane);
    add(leaves_body, out, leave, leave_plane);
  }
}

bool ClippedBody::is_closed() const {
  return !caps_only_ && std::all_of(planes_.begin(), planes_.end(), [](const CutPlane& plane) { return plane.cap; });
}

geometry::ShapePoint ClippedBody::point(const SurfaceHit& hit, const geometry::Vec3& near) const {
  const int faces = static_cast<int>(body_->faces.size());
  if (hit.face >= faces) return geometry::point_on(*caps_[hit.face - faces], 1, hit.u, hit.v, near);
  const geometry::Face& face = body_->faces[hit.face];
  return geometry::point_on(*face.surface, face.forward ? 1 : -1, hit.u, hit.v, near);
}

std::optional<geometry::Mat3> ClippedBody::shape_operator(const geometry::SurfaceHit& hit,
                                                          const geometry::Vec3&) const {
  if (hit.face >= static_cast<int>(body_->faces.size())) return geometry::Mat3(0);
  const geometry::Face& face = body_->faces[hit.face];
  return geometry::shape_operator(*face.surface, face.forward ? 1 : -1, hit.u, hit.v);
}

}  // namespace lekalo::render
