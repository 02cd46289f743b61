// The surface u^k = const of coordinates x(u, v, w): the formulas with the number in the place of that coordinate
// (Golovanov 2016, A.1).
#include "geometry/surfaces/analytic/coordinate_surface.h"

#include <fmt/format.h>

#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

const std::vector<std::string> kCoordinates{"u", "v", "w"};

std::vector<Expression> optional_formulas(const Fields& f, const char* name) {
  return f.has(name) ? f.get<std::vector<Expression>>(name) : std::vector<Expression>();
}

CoordinateSurface build(const Fields& f) {
  auto system = std::make_shared<CurvilinearSystem>();
  system->point = f.get<std::vector<Expression>>("point");
  if (f.has("scalar")) system->scalar = f.get<Expression>("scalar");
  system->vector = optional_formulas(f, "vector");
  system->second_vector = optional_formulas(f, "second_vector");
  system->tensor = optional_formulas(f, "tensor");
  system->change = optional_formulas(f, "change");
  system->path = optional_formulas(f, "path");
  system->carried = optional_formulas(f, "carried");
  if (!system->carried.empty() && system->path.empty())
    throw FieldError("carried", "there is no path that carries the vector", "give path: [u(t), v(t), w(t)] too");
  const std::string& held = f.text("hold");
  std::vector<Expression> places;
  size_t next = 0;  // of the parameters
  for (const std::string& name : kCoordinates) {
    const bool is_held = name == held;
    places.push_back(formula_of(is_held ? fmt::format("{:.17g}", f.number("at")) : kCoordinates[next++], {"u", "v"}));
  }
  std::array<Expression, 3> point;
  for (size_t k = 0; k < 3; ++k) point[k] = system->point[k].of(places);
  return {std::move(system), PointFormulas(point, Coordinates::cartesian, {"u", "v"}), f.rectangle("domain")};
}

}  // namespace

TypeDeclaration coordinate_surface_type() {
  return declare(Category::surface, "coordinate_surface",
                 "Surface of curvilinear coordinates u, v, w of space on which one of them is held; its own parameters "
                 "are the other two, in their order. 'lekalo evaluate --at U,V,W' tells the local basis there, the "
                 "metric, Christoffel's symbols, and what becomes of fields given in these coordinates.")
      .example("point: [u*cos(v), u*sin(v), w], hold: u, at: 1, domain: { u: [0, pi], v: [0, 1] }")
      .field("point", formulas(kCoordinates, 3, 3), "x, y, z as formulas of u, v and w; angles are in radians")
      .field("hold", choice({"u", "v", "w"}), "the coordinate that is held", "w")
      .field("at", number(), "its value", "0")
      .field("domain", rectangle(), "of the other two, in their order")
      .optional("scalar", formula(kCoordinates), "a scalar field: its gradient and Laplacian are told")
      .optional(
          "vector", formulas(kCoordinates, 3, 3),
          "contravariant components of a vector field: its covariant derivative, divergence, curl, and its strain "
          "as displacements")
      .optional("second_vector", formulas(kCoordinates, 3, 3), "of another: dot and cross product with the first")
      .optional("tensor", formulas(kCoordinates, 9, 9),
                "contravariant components of a tensor field, row by row: its covariant derivative")
      .optional("change", formulas(kCoordinates, 3, 3),
                "other coordinates as formulas of these: metric and components in them")
      .optional("path", formulas({"t"}, 3, 3), "u, v, w of a curve: 'lekalo evaluate --at T' tells its derivatives")
      .optional("carried", formulas({"t"}, 3, 3), "contravariant components of a vector along the path")
      .built_by(build);
}

}  // namespace lekalo::geometry
