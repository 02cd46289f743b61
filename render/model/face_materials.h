// Materials of faces: a body of one material whose faces may have others, which show on both their sides.
#pragma once

#include <map>
#include <vector>

#include "render/material.h"
#include "render/model/model.h"

namespace lekalo::render {

// The material of an object some faces of which have their own, by the face's number. Whoever knows the point asks it
// as any other; what only a face can tell, as the substance behind it, is asked of the material at the point.
class FaceMaterials final : public Material {
 public:
  FaceMaterials(MaterialPtr body, std::map<int, MaterialPtr> faces);

  const MaterialPtr& body() const { return body_; }
  const std::map<int, MaterialPtr>& faces() const { return faces_; }
  // Of a face that has its own; null: the body's.
  const Material* own(int face) const;
  const Material& at(const SurfacePoint& point) const;

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override;
  // Behind the faces that have none of their own.
  std::optional<Medium> interior(const Wavelengths& wavelengths) const override { return body_->interior(wavelengths); }
  bool transmits() const override;
  bool uses_parameters() const override;
  Vec3 shading_normal(const SurfacePoint& point) const override { return at(point).shading_normal(point); }
  Spectrum albedo(const SurfacePoint& point, const Wavelengths& wavelengths) const override;
  uint64_t cell(const SurfacePoint& point) const override { return at(point).cell(point); }
  // For exporters, which know one material of an object: the body's.
  std::any made_from() const override { return body_->made_from(); }

 private:
  MaterialPtr body_;
  std::map<int, MaterialPtr> faces_;
};

// Null for an object all of whose faces have one material.
const FaceMaterials* face_materials(const Object& object);
// Of the faces that have none of their own; null where the object has none.
MaterialPtr body_material(const Object& object);
// All that an object and its faces are made of: front, back, faces.
std::vector<const Material*> materials_of(const Object& object);

}  // namespace lekalo::render
