// The surfaces that the faces of a body lie on, seen beyond the faces' borders.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/bodies/topology/entity_names.h"
#include "geometry/bodies/topology/near_foot.h"
#include "geometry/body.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

// Of a surface that is plane: a frame of the plane with z along r_u x r_v, a Plane's own; of others nothing.
std::optional<Frame> plane_of(const SurfacePtr& surface);

// The surface at a distance along r_u x r_v with the parameters of the old one. The offset of a cone with its apex is
// the cone moved along its axis, that of an extrusion or a revolution the one of its curve's offset; else as
// offset_surface, to which conditions and errors belong. A mitred offset of a curve may throw FieldError (that field).
SurfacePtr offset_support(const SurfacePtr& surface, double distance, const char* field);

// The surface under a map; one that keeps angles makes a cylinder, a cone or an extrusion of one of them, a rigid one a
// plane too.
SurfacePtr moved_support(const SurfacePtr& surface, const Affine& map);
// A surface that has been moved, mirrored or scaled evenly, as one of its own kind likewise; others as they are.
SurfacePtr unwrapped(const SurfacePtr& surface);

// Of all faces.
std::vector<SurfacePtr> surfaces_of(const Body& body);
// Those at the distances of the faces along their outward normals.
std::vector<SurfacePtr> offset_surfaces(const Body& body, const std::vector<double>& distances, const char* field);

// Twice the area that a loop of images encloses in the parameter plane, by chords; negative where it runs clockwise.
double area_of_loop(const std::vector<Body::Use>& uses);
// Half the way between the ends of a face's loops in its parameter plane.
Vec2 middle_of_face(const Body& body, int face);

// The faces called by a field of texts, by their names (those of families too) or numbers; FieldError with those that
// there are.
std::vector<int> faces_named(const Body& body, const Fields& fields, const char* field);

}  // namespace lekalo::geometry
