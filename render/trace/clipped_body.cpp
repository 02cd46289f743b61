#include "render/trace/clipped_body.h"

#include <algorithm>

#include "geometry/surfaces/plane.h"

namespace lekalo::render {

using geometry::Interval;
using geometry::Line;
using geometry::SurfaceHit;

ClippedBody::ClippedBody(geometry::BodyPtr body, std::vector<HalfSpace> planes)
    : body_(std::move(body)), planes_(std::move(planes)), intersector_(*body_), box_(geometry::bounds(*body_)) {
  for (const HalfSpace& plane : planes_)
    caps_.push_back(std::make_shared<geometry::Plane>(geometry::frame_about(plane.through, plane.normal)));
}

void ClippedBody::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  // What the planes leave of the line, and which planes bound it.
  double enter = -geometry::kInfinity, leave = geometry::kInfinity;
  int enter_plane = -1, leave_plane = -1;
  for (int k = 0; k < static_cast<int>(planes_.size()); ++k) {
    const double slope = glm::dot(planes_[k].normal, line.direction);
    const double height = glm::dot(planes_[k].normal, line.origin - planes_[k].through);
    if (slope == 0) {
      if (height > 0) return;
      continue;
    }
    const double at = -height / slope;
    if (slope < 0 && at > enter) enter = at, enter_plane = k;
    if (slope > 0 && at < leave) leave = at, leave_plane = k;
  }
  if (!(enter < leave)) return;
  const auto cap_hit = [&](double at, int plane) {
    const Vec3 p = line.at(at) - planes_[plane].through;
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
    if (!(std::max(in.t, enter) < std::min(out.t, leave))) continue;
    const SurfaceHit first = in.t >= enter ? in : cap_hit(enter, enter_plane);
    const SurfaceHit last = out.t <= leave ? out : cap_hit(leave, leave_plane);
    if (t.contains(first.t)) hits.push_back(first);
    if (t.contains(last.t)) hits.push_back(last);
  }
}

const geometry::Surface& ClippedBody::surface(int face) const {
  const int faces = static_cast<int>(body_->faces.size());
  return face < faces ? *body_->faces[face].surface : *caps_[face - faces];
}

double ClippedBody::sign(int face) const {
  const int faces = static_cast<int>(body_->faces.size());
  return face < faces ? (body_->faces[face].forward ? 1 : -1) : 1;
}

}  // namespace lekalo::render
