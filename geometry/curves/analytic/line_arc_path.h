// Curves of straight lines and circular arcs, as exact NURBS curves.
//
// An arc of the angle d is the rational quadratic with the middle weight cos(d/2) and its middle point where the end
// tangents meet (Golovanov 2016, 2.5, 2.14); arcs of more than a right angle are several of them. A corner between
// directions that turn by the angle d is rounded by an arc of the radius r that begins r tan(d/2) before it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/curves/splines/bezier_chain.h"

namespace lekalo::geometry {

// A path that grows at its end. Lines without length, against the path's size, are left out.
class LineArcPath {
 public:
  LineArcPath(const Vec3& start, double size) : start_(start), end_(start), size_(size) {}

  void line_to(const Vec3& point);
  // About the axis through `center` along the unit vector `normal`, by an angle in radians (right-hand rule, at most a
  // turn); `point` is where that leads.
  void arc_to(const Vec3& center, const Vec3& normal, double angle, const Vec3& point);

  const Vec3& end() const { return end_; }
  // Each line and each arc takes 1 of the parameter t, which begins at 0. A closed path ends where it began.
  NurbsCurve curve(bool closed) const;

 private:
  Vec3 start_, end_;
  double size_;
  std::vector<BezierSegment> segments_;
  std::vector<double> breaks_{0};
  bool has_arcs_ = false;
};

// A polygon, or an open polyline, whose corners are rounded by arcs of the given radii (one for each point; 0 leaves a
// corner; those of the ends of an open polyline are 0). Points lie anywhere in space. A closed curve begins where the
// rounding of its first corner ends. Throws FieldError: `points` for coinciding neighbours and for a corner that turns
// right back, `radius_field` with the largest radius that fits where one does not.
NurbsCurve rounded_path(std::span<const Vec3> points, std::span<const double> radii, bool closed,
                        const std::string& radius_field);

// Declares `corner_radius` and `corner_radii`, and reads the radii of so many corners.
TypeDeclaration& declare_corner_radii(TypeDeclaration& type);
std::vector<double> read_corner_radii(const Fields& f, size_t corners);
// rounded_path with those of the fields.
NurbsCurve rounded_polygon(const Fields& f, std::span<const Vec3> corners);

}  // namespace lekalo::geometry
