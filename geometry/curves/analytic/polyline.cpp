#include "geometry/curves/analytic/polyline.h"

#include <fmt/format.h>

namespace lekalo::geometry {

NurbsCurve polyline(std::span<const Vec3> points, bool closed) {
  const int count = static_cast<int>(points.size());
  if (count < (closed ? 3 : 2))
    throw FieldError("points", fmt::format("a {}polyline needs at least {} points, not {}", closed ? "closed " : "",
                                           closed ? 3 : 2, count));
  for (int i = 0; i + 1 < count; ++i)
    if (points[i] == points[i + 1])
      throw FieldError("points", fmt::format("points {} and {} coincide", i, i + 1), "leave one of them out");
  if (closed && points.front() == points.back())
    throw FieldError("points", "the last point repeats the first", "closed: true takes unrepeated points");
  const Extension extension = closed ? Extension::periodic : Extension::tangent;
  return NurbsCurve(SplineAxis(1, knots_by_rule("clamped", 1, count, closed, {}), extension), points);
}

TypeDeclaration polyline_type() {
  return declare(Category::curve, "polyline", "Straight sides through points; side i has t in i..i + 1.")
      .field("points", points().count(2), "corners in order; those of a closed polyline are not repeated")
      .field("closed", boolean(), "joins the last point with the first", "false")
      .shows({"control_polygon"})
      .built_by([](const Fields& f) { return polyline(f.points("points"), f.boolean("closed")); });
}

}  // namespace lekalo::geometry
