// The body of a milling cutter (Zavyalov, Leus, Skorospelov 1985, V.1, figures 46 and 47): its meridian turned about
// its axis, as revolution_body turns a profile.
#include <fmt/format.h>

#include "geometry/body.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/machining/tool_path.h"

namespace lekalo::geometry {

TypeDeclaration revolution_body_type();

namespace {

// Joints of the parts differ by rounding alone.
constexpr double kJoint = 1e-9;

constexpr const char* kOwn[] = {"frame", "radius", "corner_radius", "length", "angle"};

struct Placed {
  Cutter cutter;
  Frame frame;
};

// The cutter of a path where it has it at a parameter.
Placed on_path(const Fields& f) {
  const auto* path = dynamic_cast<const ToolPath*>(f.curve("path").get());
  if (!path)
    throw FieldError("path", "the curve is no path of a cutter, or one that was moved",
                     "a cutter_path, flank_path, tool_path or tool_program");
  for (const char* field : kOwn)
    if (f.given(field))
      throw FieldError(field, "the cutter is that of the path, where the path has it", "leave it out");
  if (!f.has("t")) throw FieldError("path", "the place on the path is missing", "t, a parameter of the path");
  if (!path->domain().contains(f.number("t")))
    throw FieldError("t", fmt::format("the path has t in [{:.6g}, {:.6g}]", path->domain().lo, path->domain().hi));
  return {path->cutter(), frame_of(path->pose(f.number("t")))};
}

Placed placed(const Fields& f) {
  if (f.has("path")) return on_path(f);
  if (f.has("t")) throw FieldError("t", "there is no path on which this place would be", "path");
  for (const char* field : {"radius", "length"})
    if (!f.has(field))
      throw FieldError(field, fmt::format("the {} of the cutter is missing", field), "or give a 'path'");
  return {read_cutter(f), f.frame()};
}

BodyPtr milling_cutter(const Fields& f) {
  const auto [cutter, frame] = placed(f);
  std::vector<CurvePtr> profile;
  std::vector<const char*> names;
  for (const MeridianPart& part : meridian(cutter, frame)) {
    profile.push_back(part.curve);
    names.push_back(part.name);
  }
  static const TypeDeclaration revolution = revolution_body_type();
  Fields turned;
  turned.set("of", std::vector<std::any>{CurvePtr(std::make_shared<CompositeCurve>(profile, false, kJoint))});
  turned.set("axis", Axis{frame.origin, frame.z});
  turned.set("angle", f.number("sector"));
  Body body = *std::any_cast<BodyPtr>(revolution.build(turned));
  // The profile's parts are the first sides; the axis itself makes none.
  for (Face& face : body.faces) {
    const Origin& was = face.origin;
    if (was.role == "side" && was.index < static_cast<int>(names.size()))
      face.origin = {"", names[static_cast<size_t>(was.index)]};
    else
      face.origin = {"", "cut", was.role == "start" ? 0 : 1};
  }
  return std::make_shared<Body>(std::move(body));
}

}  // namespace

TypeDeclaration milling_cutter_type() {
  TypeDeclaration type = declare(Category::body, "milling_cutter",
                                 "Milling cutter: the body of revolution of its meridian. Faces: end, corner, flank, "
                                 "top, those that it has; cut.0 and cut.1 where the turn is not whole.");
  type.example("radius: 1, corner_radius: 0.3, length: 3, angle: 5")
      .field("frame", frame(), "placement: the reference point at the middle of the end, z towards the spindle", "{}");
  for (Field& field : cutter_fields()) {
    field.required = false;  // where the cutter is that of a path
    type.fields.push_back(std::move(field));
  }
  return type
      .optional("path", reference({Category::curve}),
                "of a cutter, which stands where the path has it; in place of all above")
      .optional("t", number(), "the place on the path, by its parameter")
      .field("sector", angle().positive().at_most(kTwoPi), "how much of a turn is there, from the frame's x", "360")
      .built_by(milling_cutter);
}

}  // namespace lekalo::geometry
