#include "geometry/surfaces/swept/moved_sections.h"

#include <cmath>

#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Polynomials agree with a product of a function and an axis to this share of it.
constexpr double kSameAxis = 1e-13;
// A section this near to the plane of its x and y, relative to its size, lies in it.
constexpr double kPlane = 1e-15;

struct Scaled {
  CurvePtr function, of;
  template <class T>
  Triple<T> operator()(const T& t) const {
    return curve_at(*function, t).x * curve_at(*of, t);
  }
};

CurvePtr scaled(const CurvePtr& function, const CurvePtr& axis) {
  CurveProperties properties = properties_of(*axis);
  add_operand(properties, *function);
  return as_polynomials(std::make_shared<ComposedCurve<Scaled>>(Scaled{function, axis}, std::move(properties)),
                        kSameAxis);
}

// The k-th coordinate as the first.
CurvePtr coordinate(const CurvePtr& curve, int k) {
  Affine map{Mat3(0.0), Vec3(0)};
  map.linear[k][0] = 1;
  return transformed(curve, map);
}

}  // namespace

Family moved_sections(const CurvePtr& path, const std::array<CurvePtr, 3>& axes, const Family& sections) {
  Family family{{path}, {one_function(sections.curves.front()->domain())}};
  for (size_t i = 0; i < sections.curves.size(); ++i) {
    const Box3 box = bounds(*sections.curves[i]);
    for (int k = 0; k < 3; ++k) {
      if (std::max(std::abs(box.lo[k]), std::abs(box.hi[k])) <= kPlane * box.diameter()) continue;
      family.curves.push_back(sections.curves.size() == 1 ? axes[k] : scaled(sections.functions[i], axes[k]));
      family.functions.push_back(coordinate(sections.curves[i], k));
    }
  }
  return family;
}

}  // namespace lekalo::geometry
