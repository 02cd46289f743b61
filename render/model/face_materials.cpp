#include "render/model/face_materials.h"

#include <algorithm>
#include <utility>

#include "render/lobes/scattering.h"

namespace lekalo::render {

FaceMaterials::FaceMaterials(MaterialPtr body, std::map<int, MaterialPtr> faces)
    : body_(std::move(body)), faces_(std::move(faces)) {}

const Material* FaceMaterials::own(int face) const {
  const auto found = faces_.find(face);
  return found == faces_.end() ? nullptr : found->second.get();
}

const Material& FaceMaterials::at(const SurfacePoint& point) const {
  const Material* of_face = own(point.face);
  return of_face ? *of_face : *body_;
}

Scattering FaceMaterials::scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const {
  return at(point).scattering(point, wavelengths);
}

bool FaceMaterials::transmits() const {
  return body_->transmits() ||
         std::any_of(faces_.begin(), faces_.end(), [](const auto& face) { return face.second->transmits(); });
}

bool FaceMaterials::uses_parameters() const {
  return body_->uses_parameters() ||
         std::any_of(faces_.begin(), faces_.end(), [](const auto& face) { return face.second->uses_parameters(); });
}

Spectrum FaceMaterials::albedo(const SurfacePoint& point, const Wavelengths& wavelengths) const {
  return at(point).albedo(point, wavelengths);
}

const FaceMaterials* face_materials(const Object& object) {
  return dynamic_cast<const FaceMaterials*>(object.material.get());
}

MaterialPtr body_material(const Object& object) {
  const FaceMaterials* faced = face_materials(object);
  return faced ? faced->body() : object.material;
}

std::vector<const Material*> materials_of(const Object& object) {
  std::vector<const Material*> all;
  for (const Material* one : {body_material(object).get(), object.back_material.get()})
    if (one) all.push_back(one);
  if (const FaceMaterials* faced = face_materials(object))
    for (const auto& [face, one] : faced->faces()) all.push_back(one.get());
  return all;
}

}  // namespace lekalo::render
