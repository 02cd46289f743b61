// Sections of blades: given points; places on the developments of cylinders (Kaplan blades); or lines on both sides,
// mostly plane sections, cut by surfaces of revolution between the rims of the wheel (Zavyalov et al. 1985, VII.3),
//
//   r_j(s) = (1 - t_j) r_up(s) + t_j r_low(s),   s the share of each profile's domain, turned about the axis.
#include "geometry/surfaces/blades/blade_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/surfaces/nets/lofts.h"
#include "geometry/surfaces/swept/revolution.h"

namespace lekalo::geometry {

namespace {

// The point farthest from the trailing edge.
int farthest_point(const std::vector<Vec3>& points) {
  const Vec3 trailing = 0.5 * (points.front() + points.back());
  int best = 0;
  for (size_t i = 1; i < points.size(); ++i)
    if (glm::length(points[i] - trailing) > glm::length(points[best] - trailing)) best = static_cast<int>(i);
  return best;
}

BladeSection given_section(const Fields& f, size_t number) {
  BladeSection section;
  section.points = f.points("points");
  const int last = static_cast<int>(section.points.size()) - 1;
  section.leading = f.has("leading") ? f.integer("leading") : farthest_point(section.points);
  if (section.leading < 1 || section.leading >= last)
    throw FieldError("sections",
                     fmt::format("section {}: the leading edge is point {}, between the ends 0 and {} it has to be",
                                 number, section.leading, last),
                     "points run from the trailing edge about the leading edge and back; 'leading' says which it is");
  if (f.has("radius")) {
    section.radius = f.number("radius");
    for (const Vec3& p : section.points)
      if (p.z != 0)
        throw FieldError("sections", fmt::format("section {}: a place on a development has no z", number),
                         "x along the circumference, y along the axis");
  }
  return section;
}

std::vector<CurvePtr> curves_of(const Fields& f, const char* field) {
  std::vector<CurvePtr> curves;
  for (const std::any& one : f.references(field)) {
    curves.push_back(std::any_cast<CurvePtr>(one));
    if (!(curves.back()->domain().width() < kInfinity))
      throw FieldError(field, fmt::format("curve {} is unbounded", curves.size() - 1), "give it a domain");
  }
  return curves;
}

// Profiles between those of the rims: lines of constant v.
SurfacePtr between_rims(const Fields& f) {
  const std::vector<CurvePtr> rims = curves_of(f, "rims");
  if (rims.size() != 2) throw FieldError("rims", fmt::format("two profiles are the rims, not {}", rims.size()));
  return ruled_surface(with_domain(rims[0], {0, 1}), with_domain(rims[1], {0, 1}));
}

// Where lines meet a surface, in their order; lines that do not reach it are left out.
std::vector<Vec3> cut(const std::vector<CurvePtr>& lines, const Surface& surface, const char* field, double level) {
  std::vector<Vec3> points;
  for (size_t i = 0; i < lines.size(); ++i) {
    const SurfaceIntersections met = intersect(*lines[i], surface);
    if (!met.on_surface.empty() || met.points.size() > 1)
      throw FieldError(field, fmt::format("line {} meets the surface at level {:.6g} more than once", i, level),
                       "lines that run from rim to rim, in parts if need be");
    if (!met.points.empty()) points.push_back(met.points.front().point);
  }
  if (points.empty())
    throw FieldError(field, fmt::format("nothing reaches the surface at level {:.6g}", level),
                     "lines that run from rim to rim, or a little beyond");
  return points;
}

std::vector<BladeSection> sections_of_lines(const Fields& f) {
  for (const char* field : {"pressure", "suction", "leading_edge", "rims", "levels"})
    if (!f.has(field))
      throw FieldError(field, "a blade of lines has 'pressure', 'suction', 'leading_edge', 'rims' and 'levels'");
  const std::vector<CurvePtr> pressure = curves_of(f, "pressure"), suction = curves_of(f, "suction"),
                              leading = {f.curve("leading_edge")};
  const SurfacePtr profiles = between_rims(f);
  std::vector<BladeSection> sections;
  for (const double level : f.numbers("levels")) {
    const RevolutionSurface surface(std::make_shared<ParameterLine>(profiles, IsoDirection::v, level), f.axis("axis"));
    BladeSection section;
    section.points = cut(pressure, surface, "pressure", level);
    std::reverse(section.points.begin(), section.points.end());
    section.leading = static_cast<int>(section.points.size());
    section.points.push_back(cut(leading, surface, "leading_edge", level).front());
    const std::vector<Vec3> others = cut(suction, surface, "suction", level);
    section.points.insert(section.points.end(), others.begin(), others.end());
    sections.push_back(std::move(section));
  }
  return sections;
}

}  // namespace

std::vector<BladeSection> blade_sections(const Fields& f) {
  if (!f.has("sections") && !f.has("levels"))
    throw FieldError("sections", "the blade has no sections",
                     "'sections'; or lines: 'pressure', 'suction', 'leading_edge', 'rims' and 'levels'; or 'of'");
  if (!f.has("sections")) return sections_of_lines(f);
  for (const char* field : {"pressure", "suction", "leading_edge", "rims", "levels"})
    if (f.has(field)) throw FieldError(field, "the blade has sections already", "leave one of them out");
  std::vector<BladeSection> sections;
  for (const Fields& one : f.groups("sections")) sections.push_back(given_section(one, sections.size()));
  return sections;
}

Vec3 wound_up(const BladeSection& section, const Frame& about, const Vec3& place) {
  if (!section.radius) return place;
  const double r = *section.radius, angle = place.x / r;
  return about.origin + r * std::cos(angle) * about.x + r * std::sin(angle) * about.y + place.y * about.z;
}

}  // namespace lekalo::geometry
