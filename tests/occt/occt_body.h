// Our bodies in OCCT, by the STEP text that `export` writes.
#pragma once

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>

#include <memory>

#include "geometry/body.h"
#include "occt/step_reader.h"
#include "render/step/step_export.h"

namespace lekalo::tests {

inline TopoDS_Shape occt_body(const geometry::Body& body) {
  return read_step(
      render::step_file({{"b", std::make_shared<geometry::Body>(body), {}, geometry::Vec3(0.5)}}, "b", "mm", 1e-9)
          .text);
}

inline double occt_volume(const TopoDS_Shape& shape) {
  GProp_GProps volume;
  BRepGProp::VolumeProperties(shape, volume, 1e-9);
  return volume.Mass();
}

}  // namespace lekalo::tests
