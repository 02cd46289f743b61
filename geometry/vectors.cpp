#include "geometry/vectors.h"

#include <cmath>
#include <stdexcept>

namespace lekalo::geometry {

Frame frame_from(const Vec3& origin, const Vec3& z, const Vec3& x_hint) {
  const double z_length = glm::length(z);
  if (!(z_length > 0) || !std::isfinite(z_length)) throw std::invalid_argument("the direction of z has no length");
  const Vec3 unit_z = z / z_length;
  const Vec3 in_plane = x_hint - glm::dot(x_hint, unit_z) * unit_z;
  const double length = glm::length(in_plane);
  if (!(length > 1e-12 * glm::length(x_hint))) throw std::invalid_argument("x is parallel to z");
  Frame frame;
  frame.origin = origin;
  frame.z = unit_z;
  frame.x = in_plane / length;
  frame.y = glm::cross(frame.z, frame.x);
  return frame;
}

Frame frame_about(const Vec3& origin, const Vec3& z) {
  const double length = glm::length(z);
  if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument("the direction of z has no length");
  const bool near_x = std::abs(z.x) > 0.99 * length;
  return frame_from(origin, z, near_x ? Vec3(0, 1, 0) : Vec3(1, 0, 0));
}

Affine Affine::rotation(double angle, const Vec3& axis, const Vec3& about) {
  const double length = glm::length(axis);
  if (!(length > 0)) throw std::invalid_argument("the rotation axis has no length");
  const Vec3 v = axis / length;
  double c = std::cos(angle), s = std::sin(angle);
  const double quarter_turns = angle / (0.5 * kPi);
  const double nearest = std::nearbyint(quarter_turns);
  if (std::abs(quarter_turns - nearest) < 1e-14 * (1 + std::abs(nearest))) {
    constexpr double cosines[4] = {1, 0, -1, 0};
    const int k = static_cast<int>(((static_cast<long long>(nearest) % 4) + 4) % 4);
    c = cosines[k];
    s = cosines[(k + 3) % 4];
  }
  const Mat3 cross(Vec3(0, v.z, -v.y), Vec3(-v.z, 0, v.x), Vec3(v.y, -v.x, 0));
  const Mat3 a = (1 - c) * glm::outerProduct(v, v) + c * Mat3(1.0) + s * cross;
  return {a, about - a * about};
}

Affine Affine::scaling(const Vec3& factors, const Vec3& about) {
  Mat3 a(0.0);
  for (int i = 0; i < 3; ++i) a[i][i] = factors[i];
  return {a, about - a * about};
}

Affine Affine::mirror(const Vec3& normal, const Vec3& about) {
  const double length = glm::length(normal);
  if (!(length > 0)) throw std::invalid_argument("the mirror plane's normal has no length");
  const Vec3 n = normal / length;
  const Mat3 a = Mat3(1.0) - 2.0 * glm::outerProduct(n, n);
  return {a, about - a * about};
}

Affine operator*(const Affine& then, const Affine& first) {
  return {then.linear * first.linear, then.linear * first.offset + then.offset};
}

Box3 transformed(const Box3& box, const Affine& map) {
  if (box.empty()) return box;
  if (!box.bounded()) return Box3::everything();
  Box3 result;
  for (int corner = 0; corner < 8; ++corner)
    result.include(map.point(
        {corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z}));
  return result;
}

}  // namespace lekalo::geometry
