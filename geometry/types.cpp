#include <iterator>

#include "geometry/describe.h"

namespace lekalo::geometry {

std::vector<TypeDeclaration> curve_types();
std::vector<TypeDeclaration> surface_types();
std::vector<TypeDeclaration> body_types();
std::vector<TypeDeclaration> shape_types();

const std::vector<TypeDeclaration>& geometry_types() {
  static const std::vector<TypeDeclaration> types = [] {
    std::vector<TypeDeclaration> all;
    for (auto family : {curve_types, surface_types, body_types, shape_types}) {
      std::vector<TypeDeclaration> some = family();
      all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
    }
    return all;
  }();
  return types;
}

}  // namespace lekalo::geometry
