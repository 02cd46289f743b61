// Bumps by a texture (Blinn 1978): the normal of the surface moved by h along its normal m is, for small h,
//
//   m' = norm(m - grad h),  grad h = (h_u (r_v x m) + h_v (m x r_u)) / (m, r_u, r_v)
//
// (Mikkelsen, "Bump mapping unparametrized surfaces on the GPU", 2010); h_u, h_v by differences over a pixel. A map of
// normals holds (m' + 1) / 2 in the frame of r_u, a tangent across it on the side of r_v, and m.
#include "render/materials/surface_detail.h"

#include <algorithm>
#include <cmath>

#include "render/lobes/scattering.h"

namespace lekalo::render {

using namespace geometry;

namespace {

double grey(const Spectrum& color) { return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]; }

// A place beside the point, by steps of its parameters.
SurfacePoint beside(const SurfacePoint& point, double du, double dv) {
  SurfacePoint moved = point;
  moved.u += du;
  moved.v += dv;
  moved.position += du * point.du + dv * point.dv;
  return moved;
}

// What the height grows by per unit of a parameter.
double rise(const Texture& texture, const SurfacePoint& point, const Vec2& along, double speed) {
  constexpr double kMinStep = 1e-6;
  const double step = std::max(0.5 * point.pixel_size, kMinStep) / speed;
  const SurfacePoint after = beside(point, step * along.x, step * along.y),
                     before = beside(point, -step * along.x, -step * along.y);
  return (grey(texture.at(after)) - grey(texture.at(before))) / (2 * step);
}

Vec3 bumped(const Vec3& normal, const SurfacePoint& point, const SurfaceDetail& detail) {
  const double volume = glm::dot(normal, glm::cross(point.du, point.dv));
  const double speed_u = glm::length(point.du), speed_v = glm::length(point.dv);
  if (!(std::fabs(volume) > 1e-12 * speed_u * speed_v)) return normal;  // at a pole
  const double h_u = detail.height * rise(*detail.bump, point, {1, 0}, speed_u);
  const double h_v = detail.height * rise(*detail.bump, point, {0, 1}, speed_v);
  const Vec3 gradient = (h_u * glm::cross(point.dv, normal) + h_v * glm::cross(normal, point.du)) / volume;
  const Vec3 moved = normal - gradient;
  return glm::dot(moved, moved) < kInfinity ? glm::normalize(moved) : normal;
}

Vec3 mapped(const Vec3& normal, const SurfacePoint& point, const SurfaceDetail& detail) {
  const Spectrum map = detail.normal_map->at(point);
  const Vec3 along_u = point.du - glm::dot(point.du, normal) * normal;
  const double length = glm::length(along_u);
  if (!(length > 0)) return normal;
  const Vec3 x = along_u / length;
  Vec3 y = glm::cross(normal, x);
  if (glm::dot(y, point.dv) < 0) y = -y;
  const Vec3 moved = detail.strength * (2 * map[0] - 1) * x + detail.strength * (2 * map[1] - 1) * y +
                     std::max(1e-3, static_cast<double>(2 * map[2] - 1)) * normal;
  return glm::normalize(moved);
}

class DetailedMaterial final : public Material {
 public:
  DetailedMaterial(MaterialPtr plain, SurfaceDetail detail) : plain_(std::move(plain)), detail_(std::move(detail)) {}

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    const Scattering plain = plain_->scattering(point, wavelengths);
    if (!detail_.has_holes) return plain;
    const Spectrum opacity = detail_.opacity.share_at(point, wavelengths), all = whole(wavelengths);
    Scattering s = plain;
    s.lobes = {};
    // Light goes straight through the holes. They count as a lobe (LobeList::kMaxLobes) where there are none, too.
    s.lobes.add(BoundaryLobe{Spectrum(), all}, all - opacity + Spectrum(1e-20f));
    s.lobes.append(plain.lobes, opacity);
    s.emission = opacity * plain.emission;
    if (plain.ambient) s.ambient = opacity * *plain.ambient;
    return s;
  }
  std::optional<Medium> interior(const Wavelengths& wavelengths) const override {
    return plain_->interior(wavelengths);
  }
  bool transmits() const override { return detail_.has_holes || plain_->transmits(); }
  Vec3 shading_normal(const SurfacePoint& point) const override {
    Vec3 normal = plain_->shading_normal(point);
    if (detail_.normal_map) normal = mapped(normal, point, detail_);
    return detail_.bump ? bumped(normal, point, detail_) : normal;
  }
  Spectrum albedo(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    return plain_->albedo(point, wavelengths);
  }
  uint64_t cell(const SurfacePoint& point) const override {
    return hash_combine(plain_->cell(point), detail_.opacity.cell(point));
  }

 private:
  MaterialPtr plain_;
  SurfaceDetail detail_;
};

MaterialPtr detailed(MaterialPtr plain, const Fields& f) {
  SurfaceDetail detail;
  if (f.has("bump")) {
    const Fields& bump = f.group("bump");
    detail.bump = bump.get<TexturePtr>("texture");
    detail.height = bump.number("height");
  }
  if (f.has("normal_map")) {
    const Fields& map = f.group("normal_map");
    detail.normal_map = map.get<TexturePtr>("texture");
    detail.strength = map.number("strength");
  }
  if (f.has("opacity")) {
    detail.opacity = color_texture(f, "opacity");
    detail.has_holes = true;
    if (plain->interior(Wavelengths{}))
      throw FieldError("opacity", "a clear body has no opacity",
                       "leave it out: panes (dielectric, thin: true) have one; a mix with an opaque material makes "
                       "part of a body opaque");
  }
  return with_surface_detail(std::move(plain), detail);
}

}  // namespace

MaterialPtr with_surface_detail(MaterialPtr plain, const SurfaceDetail& detail) {
  if (!detail.bump && !detail.normal_map && !detail.has_holes) return plain;
  return std::make_shared<DetailedMaterial>(std::move(plain), detail);
}

TypeDeclaration with_surface_detail(TypeDeclaration type) {
  type.optional("bump",
                group({{"texture", reference({Category::texture}), "the heights, by its brightness", true, {}},
                       {"height", length(), "of white over black", false, "0.1"}}),
                "shaded as if the surface were higher where the texture is bright; its outline stays")
      .optional("normal_map",
                group({{"texture",
                        reference({Category::texture}),
                        "normals as colours, x along u, y along v, (c + 1) / 2; an image of them is read with "
                        "`values: data`",
                        true,
                        {}},
                       {"strength", number().non_negative(), "multiplies their slopes", false, "1"}}),
                "shaded by normals from a texture")
      .optional(
          "opacity", textured_share(),
          "share of the surface that is there; light goes straight through the rest; not of clear bodies but of panes");
  return type.built_by(
      [plain = type.build](const Fields& f) { return detailed(std::any_cast<MaterialPtr>(plain(f)), f); });
}

}  // namespace lekalo::render
