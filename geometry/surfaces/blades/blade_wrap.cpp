// Blades from sections (Zavyalov et al. 1985, VII.3; II.6, problem 6): where all sections have as many points on each
// side they are the nodes of the surface, else splines through the sections are cut at common shares of their sides, of
// the section with the most points there. Through the nodes runs one smooth tensor spline, over mean chord lengths.
#include "geometry/surfaces/blades/blade_wrap.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/curves/interpolation/spline_curve.h"
#include "geometry/surfaces/blades/blade_sections.h"
#include "geometry/surfaces/interpolation/point_grid.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

namespace {

NurbsCurve spline_through(std::span<const Vec3> points, const std::vector<double>& at) {
  return spline_curve(points, at, std::min(3, static_cast<int>(points.size()) - 1), {}, {});
}

std::vector<double> chord_lengths(const BladeSection& section, size_t number) {
  try {
    return point_parameters({"chord_length", {}}, section.points, false);
  } catch (const FieldError& error) {
    throw FieldError("sections", fmt::format("section {}: {}", number, error.what()), error.hint);
  }
}

bool have_common_nodes(const std::vector<BladeSection>& sections) {
  return std::all_of(sections.begin(), sections.end(), [&](const BladeSection& one) {
    return one.points.size() == sections[0].points.size() && one.leading == sections[0].leading;
  });
}

// Parameters of the nodes on one section: as on the sections with the most points before and after the leading edge.
class CommonNodes {
 public:
  CommonNodes(const std::vector<BladeSection>& sections, const std::vector<std::vector<double>>& at)
      : sections_(sections), at_(at) {
    for (size_t j = 0; j < sections.size(); ++j) {
      if (sections[j].leading > sections[before_].leading) before_ = j;
      if (points_after(j) > points_after(after_)) after_ = j;
    }
  }

  int leading() const { return sections_[before_].leading; }
  std::vector<double> on(size_t j) const {
    const double middle = at_[j][sections_[j].leading], end = at_[j].back();
    const std::vector<double>&before = at_[before_], &after = at_[after_];
    std::vector<double> nodes;
    for (int i = 0; i < leading(); ++i) nodes.push_back(middle * before[i] / before[leading()]);
    const int first = sections_[after_].leading;
    for (size_t i = first; i < after.size(); ++i)
      nodes.push_back(middle + (end - middle) * (after[i] - after[first]) / (after.back() - after[first]));
    return nodes;
  }

 private:
  size_t points_after(size_t j) const { return sections_[j].points.size() - sections_[j].leading; }

  const std::vector<BladeSection>& sections_;
  const std::vector<std::vector<double>>& at_;
  size_t before_ = 0, after_ = 0;
};

struct BladeNodes {
  Grid<Vec3> points;
  int leading = 0;
};

BladeNodes nodes_of(const Fields& f, const std::vector<BladeSection>& sections) {
  std::vector<std::vector<double>> at;
  for (const BladeSection& section : sections) at.push_back(chord_lengths(section, at.size()));
  const bool given = have_common_nodes(sections);
  const CommonNodes common(sections, at);
  const Axis& axis = f.axis("axis");
  const Frame about = frame_about(axis.through, axis.along);
  BladeNodes nodes;
  nodes.leading = common.leading();
  nodes.points.rows = static_cast<int>(common.on(0).size()), nodes.points.columns = static_cast<int>(sections.size());
  nodes.points.values.resize(static_cast<size_t>(nodes.points.rows) * nodes.points.columns);
  for (size_t j = 0; j < sections.size(); ++j) {
    const NurbsCurve spline = spline_through(sections[j].points, at[j]);
    const std::vector<double> cuts = common.on(j);
    for (int i = 0; i < nodes.points.rows; ++i)
      nodes.points.at(i, static_cast<int>(j)) =
          wound_up(sections[j], about, given ? sections[j].points[i] : spline.point(cuts[i]));
  }
  return nodes;
}

// Mean chord lengths along the sections, 0 at the leading edge.
std::vector<double> lengths_from_leading_edge(const BladeNodes& nodes) {
  std::vector<double> at{0};
  for (const double step : mean_steps(nodes.points, true, false)) at.push_back(at.back() + step);
  const double leading = at[nodes.leading];
  for (double& u : at) u -= leading;
  return at;
}

std::vector<double> values_of_v(const Fields& f, const Grid<Vec3>& p) {
  const char* field = f.has("levels") ? "levels" : "at_v";
  if (f.has(field)) {
    const std::vector<double>& values = f.numbers(field);
    if (static_cast<int>(values.size()) != p.columns)
      throw FieldError(field, fmt::format("{} values for {} sections", values.size(), p.columns));
    for (size_t j = 1; j < values.size(); ++j)
      if (!(values[j] > values[j - 1])) throw FieldError(field, fmt::format("value {} is not above the one before", j));
    return values;
  }
  std::vector<double> values{0};
  for (const double step : mean_steps(p, false, false)) {
    if (!(step > 0))
      throw FieldError("sections", fmt::format("sections {} and {} are the same", values.size() - 1, values.size()));
    values.push_back(values.back() + step);
  }
  for (double& v : values) v /= values.back();
  return values;
}

// The normal looks from one side away from the other.
bool looks_inward(const NurbsSurface& whole) {
  const Rectangle domain = whole.domain();
  const double v = domain.v.middle();
  const SurfaceJet suction = whole.evaluate(0.5 * domain.u.hi, v, 1);
  const Vec3 across = suction.point() - whole.evaluate(0.5 * domain.u.lo, v, 0).point();
  return glm::dot(glm::cross(suction.du(), suction.dv()), across) < 0;
}

// A strip of the surface, u = from + w (to - from) with w over `domain`; backwards where to < from.
NurbsSurface strip(const NurbsSurface& of, double from, double to, const Interval& domain) {
  const NurbsSurfaceForm& form = of.form();
  const double factor = domain.width() / (to - from);
  const auto place = [&](double u) { return u == to ? domain.hi : domain.lo + factor * (u - from); };
  std::vector<double> knots;
  for (const double u : form.knots_u) knots.push_back(place(u));
  std::vector<Vec3> points;
  for (int k = 0; k < form.count_u(); ++k) {
    const int i = factor > 0 ? k : form.count_u() - 1 - k;
    for (int j = 0; j < form.count_v(); ++j) points.emplace_back(form.points[i * form.count_v() + j]);
  }
  if (factor < 0) std::reverse(knots.begin(), knots.end());
  SplineAxis axis(form.degree_u, std::move(knots), Extension::tangent);
  axis.restrict_to(domain);
  NurbsSurface result(std::move(axis), of.axis_v(), points);
  result.set_reversed(of.reversed() != (factor < 0));
  return result;
}

BladeWrap blade_wrap(const Fields& f) {
  if (f.has("of")) {
    for (const char* other : {"sections", "pressure", "suction", "leading_edge", "rims", "levels", "at_v"})
      if (f.has(other)) throw FieldError(other, "the blade has sections of its own already", "leave one of them out");
    return wrap_of(*f.surface("of"));
  }
  const std::vector<BladeSection> sections = blade_sections(f);
  if (sections.size() < 2)
    throw FieldError(f.has("levels") ? "levels" : "sections", "two sections are needed at least");
  const BladeNodes nodes = nodes_of(f, sections);
  const std::vector<double> at_u = lengths_from_leading_edge(nodes), at_v = values_of_v(f, nodes.points);
  NurbsSurface whole = tensor_surface(
      nodes.points, [&](std::span<const Vec3> line) { return spline_through(line, at_u); },
      [&](std::span<const Vec3> line) { return spline_through(line, at_v); });
  whole.set_reversed(looks_inward(whole));
  return {std::move(whole), -at_u.front(), at_u.back()};
}

}  // namespace

BladeWrap wrap_of(const Surface& surface) {
  const auto* whole = dynamic_cast<const NurbsSurface*>(&surface);
  const auto is_weighted = [&] {
    const std::vector<Vec4>& points = whole->form().points;
    return std::any_of(points.begin(), points.end(), [](const Vec4& p) { return p.w != 1; });
  };
  if (!whole || !(whole->domain().u.lo < 0 && whole->domain().u.hi > 0) || is_weighted())
    throw FieldError("of", "the surface is no whole blade, with its leading edge at u = 0 within the domain",
                     "a blade_surface with part: whole, not moved; what is made of it can be");
  return {*whole, -whole->domain().u.lo, whole->domain().u.hi};
}

NurbsSurface pressure_side(const BladeWrap& wrap, double from) {
  return strip(wrap.whole, -from, -wrap.pressure_length, {0, 1});
}

NurbsSurface suction_side(const BladeWrap& wrap, double from) {
  return strip(wrap.whole, from, wrap.suction_length, {0, 1});
}

namespace {

NurbsSurface part_of(const Fields& f, const BladeWrap& wrap) {
  const std::string& part = f.text("part");
  const double entry = f.has("entry") ? f.number("entry") : 0;
  if (!(entry < std::min(wrap.pressure_length, wrap.suction_length)))
    throw FieldError("entry",
                     fmt::format("the sides are {:.6g} and {:.6g} long: nothing is left beside an entry surface of {}",
                                 wrap.pressure_length, wrap.suction_length, entry),
                     "less than both");
  if (part == "pressure") return pressure_side(wrap, entry);
  if (part == "suction") return suction_side(wrap, entry);
  if (part == "whole") {
    if (entry > 0) throw FieldError("entry", "the whole blade is not parted", "give another part, or leave it out");
    return wrap.whole;
  }
  if (entry == 0) throw FieldError("entry", "the size of the entry surface is missing", "its length on each side");
  return strip(wrap.whole, -entry, entry, {-entry, entry});
}

void declare_sections(TypeDeclaration& type) {
  type.optional(
          "sections",
          groups({{"points", points().count(4), "along the section", true, {}},
                  {"leading",
                   integer().at_least(1),
                   "number of the point on the leading edge, from 0; else the one farthest from the trailing edge",
                   false,
                   {}},
                  {"radius",
                   length().positive(),
                   "of a cylinder about the axis: the points are places on its development, x along the "
                   "circumference, y along the axis",
                   false,
                   {}}}),
          "sections in their order, each from the trailing edge along the pressure side, about the leading edge "
          "and along the suction side back to the trailing edge")
      .optional("pressure", references({Category::curve}),
                "or lines on the pressure side, mostly plane sections, in their order from the leading edge to the "
                "trailing edge")
      .optional("suction", references({Category::curve}), "lines on the suction side, in the same order")
      .optional("leading_edge", reference({Category::curve}), "of lines: the leading edge")
      .optional("rims", references({Category::curve}),
                "of lines: profiles of the upper and the lower rim of the wheel, beside its axis")
      .optional("levels", numbers().between(0, 1),
                "of lines: they are cut by the surfaces of revolution that share the distance between the rims so: 0 "
                "upper rim, 1 lower rim")
      .field("axis", axis(), "of the wheel", "z")
      .optional("at_v", numbers(), "values of v at the sections; else by their mean distances, 0 to 1");
}

}  // namespace

TypeDeclaration blade_surface_type() {
  TypeDeclaration type =
      declare(Category::surface, "blade_surface",
              "Blade of a turbine or pump: one smooth sheet wrapped about the leading edge, or a part of it. On the "
              "whole blade and its entry surface u is the mean length along the sections from the leading edge, "
              "negative on the pressure side; on a side it is the share of the way to the trailing edge, 0 to 1. v "
              "runs from section to section. The normal looks out of the blade.");
  declare_sections(type);
  return type.optional("of", reference({Category::surface}), "or the whole blade, of which this is a part")
      .field("part", choice({"whole", "pressure", "suction", "entry"}), "which part", "whole")
      .optional("entry", length().positive(),
                "size of the entry surface: its length along the sections on each side of the leading edge; the sides "
                "begin there, without it at the leading edge")
      .shows({"control_net", "knots"})
      .example(
          "sections: [{ points: [[2, 0], [1, -0.15], [0.2, -0.12], [0, 0.05], [0.3, 0.3], [1, 0.35], [2, 0]] }, { "
          "points: [[2, 0, 2], [1.2, 0, 2], [0.5, 0.05, 2], [0.3, 0.2, 2], [0.6, 0.4, 2], [1.2, 0.4, 2], [2, 0, 2]] "
          "}]")
      .built_by([](const Fields& f) { return part_of(f, blade_wrap(f)); });
}

}  // namespace lekalo::geometry
