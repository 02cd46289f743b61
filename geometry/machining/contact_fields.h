// What the paths of cutters over surfaces have in common in scene files.
#pragma once

#include "geometry/machining/cutter_place.h"
#include "geometry/machining/tool_path.h"

namespace lekalo::geometry {

// `cutter`, `allowance`, `side`, `gouging` and the axis.
void declare_contact(TypeDeclaration& type);
// Without its line, but for the surface.
SurfaceContact read_contact(const Fields& fields);

// Throws FieldError (field `cutter`) where the cutter cuts into the part and the fields do not allow it.
void check_gouging(const Fields& fields, const ToolPathFacts::Bend& bend);

// Throws FieldError (field `of`) where the cutter would jump at a corner of its line. A path that does not end where it
// begins, because there is a corner, has no period.
void check_joints(const Curve& on, const std::function<CutterPose(double)>& pose, const Cutter& cutter,
                  CurveProperties& properties);

// The path of the cutter along the contact's line, which is `on` with its domain, breaks and period. Throws FieldError
// where the corner does not touch along it.
ToolMove contact_move(const SurfaceContact& contact, const Curve& on, ToolMove::Kind kind, PathPoint point);

// About the contact's line, whose image this is.
CoverageBand band_of(const SurfaceContact& contact, const CurvePtr& image, double height);

FieldType cutter_field();

}  // namespace lekalo::geometry
