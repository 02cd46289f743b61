// A line along a loop of a face, inside of it and in the loop's direction: the face lies to its left, seen against its
// outward normal (Golovanov 2016, 5.5). It is the image of an offset of the loop in the parameter plane, whose u and v
// are stretched to the lengths that they have in the middle of the face.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "geometry/bodies/constructions/profile_offset.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/bodies/topology/selection.h"
#include "geometry/body.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

CurvePtr line_along(const Fields& f) {
  const Body& body = *f.body("of");
  const int number = one_called(body, Element::face, f.text("face"), "face");
  const Face& face = body.faces[number];
  const size_t loop = static_cast<size_t>(f.integer("loop"));
  if (loop >= face.loops.size())
    throw FieldError("loop", fmt::format("face '{}' has {} loops", f.text("face"), face.loops.size()),
                     "0 is the outer one");
  std::vector<CurvePtr> segments;
  Box3 box;
  for (const int c : body.loops[face.loops[loop]].coedges) {
    const Coedge& use = body.coedges[c];
    std::vector<CurvePtr> parts = smooth_segments(use.image);
    if (!use.forward) {
      std::reverse(parts.begin(), parts.end());
      for (CurvePtr& part : parts) part = reversed_curve(part);
    }
    segments.insert(segments.end(), parts.begin(), parts.end());
    box.include(bounds(*use.image));
  }
  const Vec3 middle = box.center();
  const SurfaceJet s = face.surface->evaluate(middle.x, middle.y, 1);
  const Vec3 lengths(glm::length(s.du()), glm::length(s.dv()), 1);
  if (!(lengths.x > 0 && lengths.y > 0))
    throw FieldError("face", "the face has a pole in the middle of its parameters", "another face");
  for (CurvePtr& segment : segments) segment = transformed(segment, Affine::scaling(lengths));
  // In the parameter plane the face lies to the left where its normal is r_u x r_v.
  const bool left = outward_side(face) > 0;
  const double inset = f.number("inset");
  std::vector<CurvePtr> moved = mitred_offset(segments, {0, 0, 1}, left ? inset : -inset, true, "inset");
  const Affine back = Affine::scaling(1.0 / lengths);
  for (CurvePtr& segment : moved) segment = transformed(segment, back);
  return std::make_shared<SurfaceCurve>(face.surface, std::make_shared<CompositeCurve>(std::move(moved), true, 1e-7));
}

}  // namespace

TypeDeclaration face_loop_type() {
  return declare(Category::curve, "face_loop",
                 "Line along a loop of a body's face, a little inside of it and in the loop's direction, which has the "
                 "face on its left seen from outside. With an arrow it shows the loop.")
      .example("of: { type: box, size: [3, 2, 1] }, face: z_max, inset: 0.2")
      .field("of", reference({Category::body}), "the body")
      .field("face", text(), "name or number of the face, as 'lekalo measure --topology' gives them")
      .field("loop", integer().at_least(0), "which of its loops; 0 is the outer one", "0")
      .field("inset", length().positive(), "about how far from the edges")
      .built_by([](const Fields& f) { return std::any(line_along(f)); });
}

}  // namespace lekalo::geometry
