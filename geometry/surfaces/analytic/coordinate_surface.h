// Surfaces of curvilinear coordinates of space (Golovanov 2016, A.1).
#pragma once

#include <optional>
#include <vector>

#include "geometry/surfaces/analytic/formula_surface.h"

namespace lekalo::geometry {

// Coordinates u, v, w of space by the Cartesian ones as formulas of them, and what is said of them: a scalar field,
// vector fields by their contravariant components, a tensor field by its nine (row by row), other coordinates as
// formulas of these, a curve as formulas of t with a vector that it carries. Those that are not given are empty.
struct CurvilinearSystem {
  std::vector<Expression> point;
  std::optional<Expression> scalar;
  std::vector<Expression> vector, second_vector, tensor, change;
  std::vector<Expression> path, carried;
};

// u, v or w held; the parameters are the other two in their order.
class CoordinateSurface final : public FormulaSurface {
 public:
  CoordinateSurface(std::shared_ptr<const CurvilinearSystem> system, PointFormulas point, const Rectangle& domain)
      : FormulaSurface(std::move(point), domain, {}), system_(std::move(system)) {}
  const CurvilinearSystem& system() const { return *system_; }

 private:
  std::shared_ptr<const CurvilinearSystem> system_;
};

}  // namespace lekalo::geometry
