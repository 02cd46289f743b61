#include "geometry/shapes/csg/csg_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

namespace lekalo::geometry {

namespace {

// Half the side of the square, of the size: more than lines are off the boundary and than the solid takes for one
// crossing (kSameHit), and no more, as a surface that goes on smoothly in another (a ball in a cylinder) is covered by
// little there; where surfaces touch, of the reach.
constexpr double kBeside = 1e-9, kAsideOfContact = 1e-3;
// Normals that differ by less are those of one smooth face. Across a contact both bend.
constexpr double kSharp = 1e-3, kSharpAtContact = 0.5;
// Of the reach: how far heights are asked for; and of its inverse: bends that differ by less are one.
constexpr double kHeightsAside = 1e-3, kSameBend = 1e-3;
// An angle by which the square is turned, so that no face of a solid with right angles runs along a side.
constexpr double kTurn = 0.3179;

class Asking {
 public:
  Asking(const Csg& solid, double size, const CsgBoundaryQuestion& question)
      : solid_(solid), size_(size), question_(question) {
    const Frame about = frame_about(question.point, glm::normalize(question.tangent));
    x_ = std::cos(kTurn) * about.x + std::sin(kTurn) * about.y;
    y_ = std::cos(kTurn) * about.y - std::sin(kTurn) * about.x;
  }

  CsgPlace answer() {
    const CsgBoundary found = boundary();
    return {found, faces_, normals_};
  }

 private:
  CsgBoundary boundary() {
    if (question_.touching && on_square(kAsideOfContact * question_.reach, kSharpAtContact) == CsgBoundary::sharp_edge)
      return CsgBoundary::sharp_edge;
    // So large that the solid takes the sides of a thin wedge for two crossings too.
    const double half = kBeside * size_ / (question_.sine > kSharp ? question_.sine : 1);
    const CsgBoundary found = on_square(half, kSharp);
    return found == CsgBoundary::face && question_.smooth && bends_change() ? CsgBoundary::smooth_edge : found;
  }

  CsgBoundary on_square(double half, double sharp) {
    normals_.clear(), faces_.clear();
    const std::array<Vec3, 4> corners{half * (x_ + y_), half * (y_ - x_), -half * (x_ + y_), half * (x_ - y_)};
    for (int k = 0; k < 4; ++k) {
      const Vec3 from = question_.point + corners[k];
      const Line side{from, glm::normalize(corners[(k + 1) % 4] - corners[k])};
      hits_.clear();
      solid_.all_hits(side, {0, 2 * half}, hits_);
      for (const SurfaceHit& hit : hits_) {
        const Vec3 near = side.origin + hit.t * side.direction;
        normals_.push_back(solid_.bare_point(hit, near).normal);
        faces_.insert(hit.face);
      }
    }
    if (normals_.empty()) return CsgBoundary::none;
    for (const Vec3& normal : normals_)
      if (glm::length(normal - normals_[0]) > sharp) return CsgBoundary::sharp_edge;
    return CsgBoundary::face;
  }

  // The boundary along a normal, so far to both sides of a place: the hit nearest to that.
  struct Height {
    double value = 0;
    Vec3 normal{0};
  };
  std::optional<Height> height(const Vec3& place, const Vec3& normal, double way) {
    hits_.clear();
    const Line line{place - way * normal, normal};
    solid_.all_hits(line, {0, 2 * way}, hits_);
    if (hits_.empty()) return std::nullopt;
    const SurfaceHit& nearest = *std::min_element(hits_.begin(), hits_.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.t - way) < std::abs(b.t - way);
    });
    return Height{nearest.t - way, solid_.bare_point(nearest, line.origin + nearest.t * normal).normal};
  }

  // By z = a h^2 + b h^3: 8 z(h) - z(2 h) = 4 a h^2.
  bool bends_change() {
    const double h = kHeightsAside * question_.reach;
    // On the line itself: those of the square are turned by the bending. But there a way may meet another side of a
    // part that has an edge here; then in the middle of those.
    const auto here = height(question_.point, normals_[0], h);
    const bool agrees = here && glm::length(here->normal - normals_[0]) <= kSharp;
    const Vec3 normal =
        agrees ? here->normal : glm::normalize(std::accumulate(normals_.begin(), normals_.end(), Vec3(0)));
    const Vec3 across = glm::normalize(glm::cross(question_.tangent, normal));
    std::array<double, 2> bends{};
    for (const int side : {0, 1}) {
      const Vec3 lateral_offset = (side == 0 ? h : -h) * across;
      const auto near = height(question_.point + lateral_offset, normal, h),
                 far = height(question_.point + 2.0 * lateral_offset, normal, 2 * h);
      if (!near || !far) return false;
      bends[side] = (8 * near->value - far->value) / (2 * h * h);
    }
    return std::abs(bends[0] - bends[1]) * question_.reach > kSameBend;
  }

  const Csg& solid_;
  const double size_;
  const CsgBoundaryQuestion& question_;
  Vec3 x_, y_;
  std::vector<SurfaceHit> hits_;
  std::vector<Vec3> normals_;
  std::set<int> faces_;
};

}  // namespace

CsgPlace boundary_at(const Csg& solid, double size, const CsgBoundaryQuestion& question) {
  return Asking(solid, size, question).answer();
}

}  // namespace lekalo::geometry
