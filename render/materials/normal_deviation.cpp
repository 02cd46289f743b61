#include "render/materials/normal_deviation.h"

#include <cmath>

#include "render/materials/textured_color.h"

namespace lekalo::render {

using namespace geometry;

namespace {
// Uniform in [-1, 1).
double signed_unit(uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1p-52 - 1; }
}  // namespace

uint64_t deviation_cell(const SurfacePoint& point, const NormalDeviation& deviation) {
  if (deviation.amplitude == 0) return 0;
  const auto i = static_cast<int64_t>(std::floor(point.u / deviation.spacing.x));
  const auto j = static_cast<int64_t>(std::floor(point.v / deviation.spacing.y));
  return hash_combine(hash_combine(static_cast<uint64_t>(deviation.seed), static_cast<uint64_t>(i)),
                      static_cast<uint64_t>(j));
}

Vec3 deviated_normal(const SurfacePoint& point, const NormalDeviation& deviation) {
  if (deviation.amplitude == 0) return point.normal;
  const uint64_t cell = deviation_cell(point, deviation);
  const double xi1 = signed_unit(hash_combine(cell, 1));
  const double xi2 = signed_unit(hash_combine(cell, 2));
  const Vec3 along_u = point.du - glm::dot(point.du, point.normal) * point.normal;
  const double length = glm::length(along_u);
  const Vec3 t1 = length > 0 ? along_u / length : frame_about(Vec3(0), point.normal).x;
  const Vec3 t2 = glm::cross(point.normal, t1);
  return glm::normalize(point.normal + deviation.amplitude * (xi1 * t1 + xi2 * t2));
}

void declare_normal_deviation(TypeDeclaration& type) {
  type.optional(
      "normal_deviation",
      group({{"amplitude", number().non_negative(), "tangent of the largest deviation", true, {}},
             {"spacing", number().positive().for_each_direction(), "size of the grains in u and v", false, "0.01"},
             {"seed", integer(), "another number gives other grains", false, "0"}}),
      "rough surface: the normals deviate at random, the same in every run");
}

NormalDeviation normal_deviation(const Fields& fields) {
  if (!fields.has("normal_deviation")) return {};
  const Fields& f = fields.group("normal_deviation");
  return {f.number("amplitude"), {f.u<double>("spacing"), f.v<double>("spacing")}, f.integer("seed")};
}

}  // namespace lekalo::render
