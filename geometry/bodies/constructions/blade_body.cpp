// Blades as bodies (Zavyalov et al. 1985, VII.3): the two sides from the leading edge to the trailing edge, and between
// them, at equal shares of their lengths, ruled faces over the first and the last section and over a blunt trailing
// edge.
#include <fmt/format.h>

#include "geometry/bodies/topology/sew.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/describe.h"
#include "geometry/surfaces/blades/blade_wrap.h"
#include "geometry/surfaces/nets/lofts.h"

namespace lekalo::geometry {

namespace {

constexpr double kSharp = 1e-9;  // distance of the sides at a sharp trailing edge, of the blade's size

CurvePtr border(const SurfacePtr& side, IsoDirection held, double at) {
  return with_domain(std::make_shared<ParameterLine>(side, held, at), {0, 1});
}

SurfacePtr between(const SurfacePtr& a, const SurfacePtr& b, IsoDirection held, double at_a, double at_b) {
  return ruled_surface(border(a, held, at_a), border(b, held, at_b));
}

bool is_sharp(const BladeWrap& wrap) {
  const Rectangle domain = wrap.whole.domain();
  const double size = bounds(wrap.whole).diameter();
  constexpr int kTried = 16;
  for (int i = 0; i <= kTried; ++i) {
    const double v = domain.v.lo + domain.v.width() * i / kTried;
    if (glm::length(wrap.whole.point(domain.u.lo, v) - wrap.whole.point(domain.u.hi, v)) > kSharp * size) return false;
  }
  return true;
}

Body blade_body(const Fields& f) {
  const BladeWrap wrap = wrap_of(*f.surface("of"));
  const SurfacePtr pressure = std::make_shared<NurbsSurface>(pressure_side(wrap, 0)),
                   suction = std::make_shared<NurbsSurface>(suction_side(wrap, 0));
  const Interval v = wrap.whole.domain().v;
  std::vector<SurfacePtr> faces{pressure, suction, between(pressure, suction, IsoDirection::v, v.lo, v.lo),
                                between(pressure, suction, IsoDirection::v, v.hi, v.hi)};
  std::vector<const char*> names{"pressure", "suction", "start", "end"};
  if (!is_sharp(wrap)) {
    faces.push_back(between(pressure, suction, IsoDirection::u, 1, 1));
    names.push_back("trailing");
  }
  try {
    Body body = enclosed_by(faces);
    for (size_t i = 0; i < names.size(); ++i) body.faces[i].origin = {"", names[i], -1};
    return body;
  } catch (const FieldError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw FieldError("of", fmt::format("the blade does not enclose a body: {}", error.what()));
  }
}

}  // namespace

TypeDeclaration blade_body_type() {
  return declare(Category::body, "blade_body",
                 "Blade of a turbine or pump: a blade_surface closed by ruled faces over its first and last section. "
                 "Faces: pressure, suction, start, end, and trailing where the trailing edge is blunt.")
      .example(
          "of: { type: blade_surface, sections: [{ points: [[2, 0], [1, -0.15], [0.2, -0.12], [0, 0.05], [0.3, 0.3], "
          "[1, 0.35], [2, 0]] }, { points: [[2, 0, 2], [1.2, 0, 2], [0.5, 0.05, 2], [0.3, 0.2, 2], [0.6, 0.4, 2], "
          "[1.2, 0.4, 2], [2, 0, 2]] }] }")
      .field("of", reference({Category::surface}), "the whole blade: a blade_surface")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(blade_body(f)); });
}

}  // namespace lekalo::geometry
