// Rolled sections: angle, tee, I-section and channel (Grezdov, Filippenko 2010: technical profiles).
//
// A sharp polygon whose inner corners at the web get the root radius and whose inner corners at the tips of flanges the
// toe radius. The lower left corner of the box about it is the origin, y points up. Flanges with a taper s are
// thinner towards their tips; the given thickness is that at a quarter of the width of an I-section, half of the width
// of a channel from the tip (as DIN 1025-1 and DIN 1026-1 measure it).
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/analytic/line_arc_path.h"

namespace lekalo::geometry {

namespace {

struct Sizes {
  double height, width, web, flange, root, toe, taper;
};

struct Corners {
  std::vector<Vec3> points;
  std::vector<double> radii;
  void add(double x, double y, double radius = 0) {
    points.push_back({x, y, 0});
    radii.push_back(radius);
  }
};

Corners angle_section(const Sizes& s) {
  Corners c;
  c.add(0, 0);
  c.add(s.width, 0);
  c.add(s.width, s.flange, s.toe);
  c.add(s.web, s.flange, s.root);
  c.add(s.web, s.height, s.toe);
  c.add(0, s.height);
  return c;
}

Corners tee_section(const Sizes& s) {
  const double left = 0.5 * (s.width - s.web), right = 0.5 * (s.width + s.web), below = s.height - s.flange;
  Corners c;
  c.add(left, 0);
  c.add(right, 0);
  c.add(right, below, s.root);
  c.add(s.width, below, s.toe);
  c.add(s.width, s.height);
  c.add(0, s.height);
  c.add(0, below, s.toe);
  c.add(left, below, s.root);
  return c;
}

Corners i_section(const Sizes& s) {
  const double left = 0.5 * (s.width - s.web), right = 0.5 * (s.width + s.web);
  const double tip = s.flange - s.taper * 0.25 * s.width, root = s.flange + s.taper * (left - 0.25 * s.width);
  Corners c;
  c.add(0, 0);
  c.add(s.width, 0);
  c.add(s.width, tip, s.toe);
  c.add(right, root, s.root);
  c.add(right, s.height - root, s.root);
  c.add(s.width, s.height - tip, s.toe);
  c.add(s.width, s.height);
  c.add(0, s.height);
  c.add(0, s.height - tip, s.toe);
  c.add(left, s.height - root, s.root);
  c.add(left, root, s.root);
  c.add(0, tip, s.toe);
  return c;
}

Corners channel(const Sizes& s) {
  const double tip = s.flange - s.taper * 0.5 * s.width, root = s.flange + s.taper * (0.5 * s.width - s.web);
  Corners c;
  c.add(0, 0);
  c.add(s.width, 0);
  c.add(s.width, tip, s.toe);
  c.add(s.web, root, s.root);
  c.add(s.web, s.height - root, s.root);
  c.add(s.width, s.height - tip, s.toe);
  c.add(s.width, s.height);
  c.add(0, s.height);
  return c;
}

Sizes read_sizes(const Fields& f) {
  Sizes s;
  s.height = f.number("height");
  s.width = f.has("width") ? f.number("width") : s.height;
  s.web = f.number("web_thickness");
  s.flange = f.has("flange_thickness") ? f.number("flange_thickness") : s.web;
  s.root = f.number("root_radius");
  s.toe = f.number("toe_radius");
  s.taper = f.number("taper");
  if (!(s.web < s.width))
    throw FieldError("web_thickness", fmt::format("the web is not thinner than the width, {:.6g}", s.width));
  const bool two_flanges = f.text("preset") == "I" || f.text("preset") == "U";
  if (s.taper > 0 && !two_flanges) throw FieldError("taper", "only I and U have tapered flanges here", "leave it out");
  const double lever = (f.text("preset") == "I" ? 0.25 : 0.5) * s.width;
  if (!(s.flange > s.taper * lever))
    throw FieldError("taper", "the flanges end in nothing before their tips",
                     fmt::format("it must be below {:.6g}", s.flange / lever));
  const double thickest = s.flange + s.taper * lever;
  if (!(thickest < (two_flanges ? 0.5 : 1.0) * s.height))
    throw FieldError("flange_thickness", fmt::format("no height is left for the web between the flanges: {:.6g} is "
                                                     "{} of the height",
                                                     s.flange, two_flanges ? "at least half" : "all"));
  return s;
}

}  // namespace

TypeDeclaration profile_type() {
  return declare(Category::curve, "profile",
                 "Outline of a rolled section in the x, y plane of its frame, counterclockwise: angle (L), tee (T), "
                 "I-section (I) or channel (U). The frame's origin is the lower left corner of the box about it.")
      .example("preset: I, height: 10, width: 5.5, web_thickness: 0.41, flange_thickness: 0.57, root_radius: 0.7")
      .field("preset", choice({"L", "T", "I", "U"}), "which section")
      .field("frame", frame(), "placement; y points up along the web", "{}")
      .field("height", length().positive(), "over all, along y")
      .optional("width", length().positive(), "over all, along x; as the height when left out")
      .field("web_thickness", length().positive(), "of the web, or of the upright leg of L")
      .optional("flange_thickness", length().positive(), "of the flanges; as the web's when left out")
      .field("root_radius", length().non_negative(), "of the fillets between web and flanges", "0")
      .field("toe_radius", length().non_negative(), "of the rounded inner edges of the flanges' tips", "0")
      .field("taper", number().between(0, 0.5),
             "slope of the inner faces of the flanges of I and U: 0.14 and 0.08 in the old standards", "0")
      .built_by([](const Fields& f) {
        const Sizes sizes = read_sizes(f);
        const std::string& preset = f.text("preset");
        Corners c = preset == "L"   ? angle_section(sizes)
                    : preset == "T" ? tee_section(sizes)
                    : preset == "I" ? i_section(sizes)
                                    : channel(sizes);
        for (Vec3& point : c.points) point = f.frame().point(point);
        return rounded_path(c.points, c.radii, true, sizes.root > 0 ? "root_radius" : "toe_radius");
      });
}

}  // namespace lekalo::geometry
