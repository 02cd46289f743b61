// Lengths, areas, volumes, centres of mass and inertia (Golovanov 2016, 8.9-8.11), with the error of each.
//
// Densities are one: multiply volumes and moments by the density for masses. Values are exact up to the stated errors,
// which come from comparing two quadrature rules (usually much too large), or from rounding for meshes. Where
// derivatives are those of a fit (fit_distance()) they hold what its distance changes.
#pragma once

#include "geometry/body.h"
#include "geometry/curve.h"
#include "geometry/mesh.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// A value with an estimate of its absolute error.
struct Measured {
  double value = 0;
  double error = 0;
};

struct CurveMeasures {
  Measured length;
  Vec3 centroid{0};           // of the curve as a wire of constant thickness
  double centroid_error = 0;  // length
};

struct SurfaceMeasures {
  Measured area;
  Vec3 centroid{0};           // of the surface as a sheet of constant thickness
  double centroid_error = 0;  // length
};

struct MassProperties {
  Measured area;
  Measured volume;
  Vec3 centroid{0};
  double centroid_error = 0;  // length
  // Inertia tensor about the centroid along the world's axes: diagonal J_xx = integral of y^2 + z^2, others the
  // negative products of inertia.
  Mat3 inertia{0.0};
  double inertia_error = 0;
  // Eigenvalues of the tensor in increasing order and unit eigenvectors as the columns of a right-handed frame.
  Vec3 principal_moments{0};
  Mat3 principal_axes{1.0};
  // False for a body with free borders, whose volume means nothing.
  bool closed = true;
};

// Relative accuracy that the quadrature aims at.
inline constexpr double kMeasureAccuracy = 1e-12;

// These throw std::invalid_argument for what is unbounded, and where the length or area is infinite or cannot be told.
CurveMeasures measure(const Curve& curve);
// The length of the part from a to b (negative if b < a); no number where it cannot be told.
Measured arc_length(const Curve& curve, double a, double b);
SurfaceMeasures measure(const Surface& surface);
// False where the derivatives are parallel or zero wherever one looks: all points lie on one curve.
bool spans_area(const Surface& surface);
SurfaceMeasures measure_face(const Body& body, int face);
MassProperties measure(const Body& body, double accuracy = kMeasureAccuracy);
// Exact integrals over the polyhedron, except for rounding.
MassProperties measure(const Mesh& mesh);

// Volume enclosed by one shell, positive when its faces look outward.
double signed_volume(const Body& body, int shell, double accuracy);

// The tensor about another point (parallel axes).
Mat3 inertia_about(const MassProperties& properties, const Vec3& point);

// Eigenvalues (increasing) and right-handed unit eigenvectors (columns) of a symmetric matrix.
void principal_moments(const Mat3& inertia, Vec3& moments, Mat3& axes);

}  // namespace lekalo::geometry
