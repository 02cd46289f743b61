// Screw threads of ISO 68-1: a vintoid whose curve is one pitch of the basic profile. With the pitch P and
// H = sqrt(3) P/2 the flanks make 60 degrees, crests are P/8 wide at the nominal diameter d, roots P/4 at d - 5 H/4.
// Coarse pitches of the standard diameters are those of ISO 261.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "geometry/curves/analytic/polyline.h"
#include "geometry/describe.h"
#include "geometry/expression/expression.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

TypeDeclaration vintoid_type();

namespace {

// Nominal diameter and coarse pitch, millimetres.
constexpr std::pair<double, double> kCoarse[] = {
    {1, 0.25}, {1.2, 0.25}, {1.4, 0.3}, {1.6, 0.35}, {1.8, 0.35}, {2, 0.4},  {2.5, 0.45}, {3, 0.5}, {3.5, 0.6},
    {4, 0.7},  {5, 0.8},    {6, 1},     {7, 1},      {8, 1.25},   {10, 1.5}, {12, 1.75},  {14, 2},  {16, 2},
    {18, 2.5}, {20, 2.5},   {22, 2.5},  {24, 3},     {27, 3},     {30, 3.5}, {33, 3.5},   {36, 4},  {39, 4},
    {42, 4.5}, {45, 4.5},   {48, 5},    {52, 5},     {56, 5.5},   {60, 5.5}, {64, 6}};

double pitch_of(const Fields& f) {
  const double d = f.number("diameter");
  if (f.has("pitch")) return f.number("pitch");
  for (const auto& [diameter, pitch] : kCoarse)
    if (std::abs(diameter - d) <= 1e-9 * d) return pitch;
  throw FieldError("diameter", fmt::format("{:.6g} is no standard diameter of ISO 261", d), "give its pitch: number");
}

std::any thread_surface(const Fields& f) {
  const double d = f.number("diameter"), p = pitch_of(f), crest = 0.5 * d, root = crest - 5.0 / 16 * std::sqrt(3.0) * p;
  if (!(root > 0)) throw FieldError("pitch", "the thread is deeper than the radius", "give a smaller pitch");
  Fields screw;
  const std::vector<Vec3> profile{{root, 0, 0},           {root, p / 8, 0},     {crest, 7 * p / 16, 0},
                                  {crest, 9 * p / 16, 0}, {root, 7 * p / 8, 0}, {root, p, 0}};
  screw.set("of", CurvePtr(std::make_shared<NurbsCurve>(polyline(profile))));
  const double rise = f.text("hand") == "left" ? -p : p;
  const std::vector<Expression::Constant> constants{{"rise", rise}};
  screw.set("height", formula_of("rise*u/(2*pi)", {"u"}, constants));
  screw.set("range", Interval(0, kTwoPi * f.number("length") / p));
  static const TypeDeclaration type = vintoid_type();
  return type.build(screw);
}

}  // namespace

TypeDeclaration thread_surface_type() {
  return declare(
             Category::surface, "thread_surface",
             "Screw thread of the basic profile of ISO 68-1 about the axis z, one pitch wide and wound on: u is the "
             "angle, v runs along the profile. A scene unit is a millimetre where the pitch is left out.")
      .example("diameter: 10, length: 6")
      .field("diameter", length().positive(), "nominal: over the crests; 10 is M10")
      .optional("pitch", length().positive(), "rise of one turn; the coarse pitch of ISO 261 when left out")
      .field("length", length().positive(), "along the axis")
      .field("hand", choice({"right", "left"}), "which way it turns", "right")
      .built_by(thread_surface);
}

}  // namespace lekalo::geometry
