// The body of a milling cutter (Zavyalov, Leus, Skorospelov 1985, V.1, figures 46 and 47): its meridian turned about
// its axis, as revolution_body turns a profile.
#include <map>

#include "geometry/body.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/machining/cutter.h"

namespace lekalo::geometry {

TypeDeclaration revolution_body_type();

namespace {

// Joints of the parts differ by rounding alone.
constexpr double kJoint = 1e-9;

BodyPtr milling_cutter(const Fields& f) {
  const Frame& frame = f.frame();
  std::vector<CurvePtr> profile;
  std::vector<const char*> names;
  for (const MeridianPart& part : meridian(read_cutter(f), frame)) {
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
  for (Field& field : cutter_fields()) type.fields.push_back(std::move(field));
  return type
      .field("sector", angle().positive().at_most(kTwoPi), "how much of a turn is there, from the frame's x", "360")
      .built_by(milling_cutter);
}

}  // namespace lekalo::geometry
