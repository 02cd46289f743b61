// Where a cutter stands that touches a part, and which way its axis leads (Zavyalov, Leus, Skorospelov 1985, V.1,
// VII.4).
//
// Contact of the corner with a surface, r the point, n its normal on the cutter's side, tau the unit tangent of the
// line of contact, d the allowance, R and rho the cutter's radii:
//
//   P = r + (rho + d) n + (R - rho) m - rho q,   m = <q x n x q>
//
// m is not defined where q is along n, and needed unless R = rho. The axis q is fixed, or by an angle b
//
//   q = cos b n + sin b tau             leaning along the line (lead)
//   q = cos b <tau x n> + sin b n       over the tangent plane, beside the line (elevation)
//
// Contact of the flank with a curve r(t) along its generatrix l, h from the end, a the cutter's angle:
//
//   n = <l x r'>,   P = r + (d + R cos a) n - (h + R sin a) l,   q = n sin a + l cos a
//
// where R is the radius of the flank carried on to the end. n points from the part to the cutter: to the left of the
// curve seen against l; on the other side it is -n. To keep P in the plane (x - r_0) N = 0
//
//   h = [r - r_0 + (d + R cos a) n - R sin a l] N / (l N).
#pragma once

#include <optional>

#include "geometry/composition.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/expression/scalar_law.h"
#include "geometry/machining/cutter.h"
#include "geometry/queries/differential/tool_axis.h"

namespace lekalo::geometry {

// Of numbers of any type. The axis, the normal and the tangent `feed` have the length 1.
template <class T>
struct CutterPlace {
  Triple<T> contact, normal, feed, axis, reference;
};

template <class T>
Triple<T> unit(const Triple<T>& a) {
  return (T(1) / length(a)) * a;
}

inline Vec3 vec(const Triple<double>& a) { return {a.x, a.y, a.z}; }

// Which way the axis leads.
struct ToolAxis {
  enum class Kind { fixed, lead, elevation };
  Kind kind = Kind::fixed;
  Vec3 direction{0, 0, 1};  // of a fixed one
  ScalarLaw angle{0};       // radians, of the others

  template <class T>
  Triple<T> at(const T& t, const Triple<T>& n, const Triple<T>& feed) const {
    using std::cos;
    using std::sin;
    if (kind == Kind::fixed) return {T(direction.x), T(direction.y), T(direction.z)};
    const T b = angle(t);
    return kind == Kind::lead ? cos(b) * n + sin(b) * feed : tool_axis(feed, n, b);
  }
};

// A line of a surface: u or v held, or the image of a curve of the parameter plane.
struct LineOfSurface {
  SurfacePtr of;
  IsoDirection held = IsoDirection::u;
  double at = 0;
  CurvePtr image;  // null: a line on which one parameter is held

  template <class T>
  struct Place {
    T u, v, du, dv;
  };
  template <class T>
  Place<T> operator()(const T& t) const {
    if (image) {
      const Triple<T> place = curve_at(*image, t), way = curve_at(*image, t, 1);
      return {place.x, place.y, way.x, way.y};
    }
    if (held == IsoDirection::u) return {T(at), t, T(0), T(1)};
    return {t, T(at), T(1), T(0)};
  }
};

// The corner touches a surface along a line of it.
struct SurfaceContact {
  LineOfSurface line;
  Cutter cutter;
  ToolAxis axis;
  double allowance = 0;
  double side = 1;  // times r_u x r_v: the normal n

  template <class T>
  CutterPlace<T> at(const T& t) const {
    const auto [u, v, du, dv] = line(t);
    const Triple<T> r_u = surface_at(*line.of, u, v, 1, 0), r_v = surface_at(*line.of, u, v, 0, 1);
    CutterPlace<T> place;
    place.contact = surface_at(*line.of, u, v);
    place.normal = T(side) * unit(cross(r_u, r_v));
    place.feed = unit(du * r_u + dv * r_v);
    place.axis = axis.at(t, place.normal, place.feed);
    const Triple<T>&n = place.normal, &q = place.axis;
    const double rho = cutter.rounding();
    place.reference = place.contact + T(rho + allowance) * n - T(rho) * q;
    if (!cutter.has_ball_end()) place.reference += T(cutter.ring_radius()) * unit(n - dot(n, q) * q);
    return place;
  }
};

// The flank touches a curve.
struct FlankContact {
  CurvePtr of;
  CurvePtr directions;  // null: the generatrix has the one direction
  Vec3 direction{0, 0, 1};
  Cutter cutter;
  double allowance = 0;
  double side = 1;  // 1 left, -1 right, 0: the axis runs through the curve
  ScalarLaw height{0};
  struct Plane {
    Vec3 origin, normal;
  };
  std::optional<Plane> plane;  // in which P stays, in place of the height

  template <class T>
  Triple<T> generatrix(const T& t) const {
    if (directions) return unit(curve_at(*directions, t));
    return {T(direction.x), T(direction.y), T(direction.z)};
  }
  // Of the point P from the curve across it.
  double reach() const { return side == 0 ? 0 : allowance + cutter.flank_radius() * std::cos(cutter.angle); }

  template <class T>
  T height_at(const T& t, const Triple<T>& r, const Triple<T>& n, const Triple<T>& l) const {
    if (!plane) return height(t);
    const double slip = side == 0 ? 0 : cutter.flank_radius() * std::sin(cutter.angle);
    const Triple<T> foot = r - triple(plane->origin) + T(reach()) * n - T(slip) * l;
    return dot(foot, triple(plane->normal)) / dot(l, triple(plane->normal));
  }

  template <class T>
  CutterPlace<T> at(const T& t) const {
    CutterPlace<T> place;
    const Triple<T> l = generatrix(t);
    place.contact = curve_at(*of, t);
    place.feed = unit(curve_at(*of, t, 1));
    place.normal = T(side < 0 ? -1 : 1) * unit(cross(l, place.feed));
    const double c = std::cos(cutter.angle), s = std::sin(cutter.angle);
    const Triple<T>& n = place.normal;
    const T h = height_at(t, place.contact, n, l);
    const double slip = side == 0 ? 0 : cutter.flank_radius() * s;
    place.axis = side == 0 ? l : T(s) * n + T(c) * l;
    place.reference = place.contact + T(reach()) * n - (h + T(slip)) * l;
    return place;
  }
};

// What of the cutter follows the path.
enum class PathPoint { reference, contact, center };

// The path of the cutter of a contact, as a formula.
template <class Contact>
struct ContactPath {
  Contact contact;
  PathPoint point = PathPoint::reference;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const CutterPlace<T> place = contact.at(t);
    if (point == PathPoint::contact) return place.contact;
    if (point == PathPoint::center) return place.reference + T(contact.cutter.rounding()) * place.axis;
    return place.reference;
  }
};

// The fields `axis`, `lead`, `elevation` and what they say. Throws FieldError where more than one is given.
void declare_axis_of_tool(TypeDeclaration& type);
ToolAxis read_axis_of_tool(const Fields& fields);

// Throws FieldError where the corner does not touch as it should at one of some places along the line: fields `of`,
// `axis`, `lead` or `elevation`.
void check_contact(const SurfaceContact& contact, const Interval& range);
// The same of the flank: fields `of`, `direction`, `h`, `plane`.
void check_contact(const FlankContact& contact, const Interval& range);

}  // namespace lekalo::geometry
