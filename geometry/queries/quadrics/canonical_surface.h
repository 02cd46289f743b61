// Surfaces that are known by their equation as well as by their parameters: planes, quadrics and tori, also under
// affine maps (Golovanov 2016, 3.2). In coordinates of their own, q = to_local (p - origin), they are
//
//   plane         (u, v, 0)                                cone        ((r + w v) e(u), h v)
//   saddle        (u, v, u^2 - v^2)                        torus       ((R + r cos v) e(u), r sin v)
//   ellipsoid     (cos v e(u), sin v)                      one sheet   (cosh v e(u), sinh v)
//   paraboloid    (v e(u), v^2)                            two sheets  (sinh v e(u), cosh v),    e(u) = (cos u, sin u)
//
// so that parameters are found from points without a search.
#pragma once

#include <optional>
#include <vector>

#include "geometry/queries/quadrics/conic.h"
#include "geometry/queries/quadrics/quadric_sections.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

struct CanonicalSurface {
  enum class Kind { plane, saddle, ellipsoid, one_sheet, two_sheets, paraboloid, cone, torus };
  SurfacePtr surface;
  Kind kind = Kind::plane;
  Mat3 to_local{1.0};
  Vec3 origin{0};
  double radius = 0, widening = 0, height = 0;  // r, w, h of a cone
  double major = 0, minor = 0;                  // of a torus

  // Parameters are coordinates, not an angle and a place on a meridian.
  bool is_affine() const { return kind == Kind::plane || kind == Kind::saddle; }
  bool has_poles() const { return !is_affine() && !(kind == Kind::torus && major > minor); }

  Vec3 local(const Vec3& p) const { return to_local * (p - origin); }
  Conic local(const Conic& conic) const { return mapped(conic, to_local, local(conic.origin)); }

  // v of the point of a meridian at the signed distance rho from the axis; of a torus in [-pi, pi]. Double or jets.
  template <class T>
  T parameter(const T& rho, const T& z) const {
    using std::asinh;
    using std::atan2;
    switch (kind) {
      case Kind::ellipsoid:
        return atan2(z, rho);
      case Kind::one_sheet:
        return asinh(z);
      case Kind::two_sheets:
        return asinh(rho);
      case Kind::paraboloid:
        return rho;
      case Kind::cone:
        // The foot point on the meridian: a flat cone's z, a steep one's rho tell little.
        return (widening * (rho - radius) + height * z) / (widening * widening + height * height);
      case Kind::torus:
        return atan2(z, rho - major);
      default:
        return z;
    }
  }
  // -1 at points of a cone whose meridian is beyond the apex, where u counts the other side.
  double side(double z) const { return kind == Kind::cone && radius + widening / height * z < 0 ? -1 : 1; }

  // Planes in q on which the surface's borders lie; intersections with more than the borders may lie on them too.
  struct Border {
    Vec3 normal;
    double height;
  };
  std::vector<Border> borders() const;
  // u, v of a point that is no farther than `near` from the surface; nothing where that has no such point.
  std::optional<Vec2> parameters(const Vec3& p, double near) const;

  // For points about `center`; none for planes and tori.
  std::optional<QuadricForm> quadric(const Vec3& center, double size) const;
  // Of a map that keeps angles: what lengths are to be divided by.
  std::optional<double> scale() const;
  // Of what turns about an axis: its direction, of unit length.
  Vec3 axis() const;
  // Of a plane.
  Vec3 normal() const { return axis(); }
};

std::optional<CanonicalSurface> canonical(const SurfacePtr& surface);

}  // namespace lekalo::geometry
