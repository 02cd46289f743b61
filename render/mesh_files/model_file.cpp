#include "render/mesh_files/model_file.h"

#include <mutex>

#include "geometry/point_formulas.h"
#include "render/image/module.h"
#include "render/mesh_files/mesh_files.h"

namespace lekalo::render {

FileModel read_model(const std::string& path) {
  static std::mutex mutex;
  static ModelRead* function = nullptr;
  const std::lock_guard lock(mutex);
  std::string tried;
  if (function == nullptr)
    function = reinterpret_cast<ModelRead*>(module_function(kModelModuleFile, kModelReadName, tried));
  if (function == nullptr)
    throw MeshFileError(path + ": the module that reads models cannot be loaded" + tried +
                        " (install libassimp5 and keep lekalo_assimp.so with the program)");
  FileModel model;
  std::string error;
  if (!function(path.c_str(), model, error)) throw MeshFileError(path + ": " + error);
  for (const FileModel::Part& part : model.parts)
    for (const geometry::Vec3& p : part.mesh.points)
      if (!geometry::is_finite(p))
        throw MeshFileError(path + ": a vertex of '" + part.name + "' has a coordinate that is no finite number");
  if (model.placed.empty()) throw MeshFileError(path + ": the model has no triangles");
  return model;
}

}  // namespace lekalo::render
