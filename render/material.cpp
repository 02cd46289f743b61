#include "render/material.h"

#include "render/lobes/scattering.h"

namespace lekalo::render {

Spectrum Material::albedo(const SurfacePoint& point, const Wavelengths& wavelengths) const {
  return matt_reflectance(scattering(point, wavelengths));
}

}  // namespace lekalo::render
