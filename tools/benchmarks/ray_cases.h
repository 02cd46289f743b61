// The models that tools/bench rays times.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "render/model/model.h"

namespace lekalo::benchmarks {

// A scene file, or one of the names
//   teapots          a field of 3,200 distinct teapots (102,400 patches), each its own geometry
//   quintics         32 random rational patches of degree 5 x 5
//   degree-N         32 random rational patches of degree N x N
//   mosaic-N         N x N distinct teapots that fill the picture as one does
// with a camera for a picture of this size. Throws std::invalid_argument for another name.
std::shared_ptr<render::Model> ray_case(const std::string& name, const std::filesystem::path& teapot, int width,
                                        int height);

}  // namespace lekalo::benchmarks
