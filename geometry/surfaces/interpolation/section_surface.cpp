// Surfaces from sections with different numbers of points, and from lines without order (Zavyalov et al. 1985, II.6,
// problems 6 and 7): a spline runs through each section by normalised chord length and is cut at common nodes, those of
// the section with the most points; the grid that comes of it has a smooth spline through it. Lines that lie on the
// surface are cut by parallel planes; what lies in one plane is a section.
#include <fmt/format.h>

#include <algorithm>

#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/curves/interpolation/spline_curve.h"
#include "geometry/curves/operations/curve_sign_changes.h"
#include "geometry/describe.h"
#include "geometry/surfaces/interpolation/point_grid.h"

namespace lekalo::geometry {

namespace {

using Section = std::vector<Vec3>;

NurbsCurve spline_through(std::span<const Vec3> points, const std::vector<double>& at, bool closed) {
  const int degree = std::min(3, static_cast<int>(points.size()) - 1);
  return closed ? closed_spline_curve(points, at, degree) : spline_curve(points, at, degree, {}, {});
}

// Chord lengths as shares of the whole.
std::vector<double> shares(const Section& section, bool closed, size_t number) {
  try {
    std::vector<double> at = point_parameters({"chord_length", {}}, section, closed);
    for (double& t : at) t /= at.back();
    at.back() = 1;
    return at;
  } catch (const FieldError& error) {
    throw FieldError("sections", fmt::format("section {}: {}", number, error.what()), error.hint);
  }
}

std::vector<Section> given_sections(const Fields& f) {
  std::vector<Section> sections;
  for (const Fields& one : f.groups("sections")) sections.push_back(one.points("points"));
  return sections;
}

// Where the lines meet the plane n r = distance, in order along a direction.
Section cut(const std::vector<std::any>& lines, const Vec3& n, double distance, const Vec3& along) {
  Section section;
  for (const std::any& one : lines) {
    const CurvePtr line = std::any_cast<CurvePtr>(one);
    if (!(line->domain().width() < kInfinity)) throw FieldError("lines", "a curve is unbounded", "give it a domain");
    const auto range = [&](const Box3& box) {
      const auto along_axis = [&](int k) { return Interval(n[k]) * Interval(box.lo[k], box.hi[k]); };
      return along_axis(0) + along_axis(1) + along_axis(2) - Interval(distance);
    };
    const auto value = [&](const Vec3& p) { return glm::dot(n, p) - distance; };
    for (const double t : sign_changes(*line, line->is_closed(), range, value)) section.push_back(line->point(t));
    for (const double t : {line->domain().lo, line->domain().hi})  // an end that lies in the plane
      if (const Vec3 p = line->point(t); std::abs(value(p)) <= 1e-9 * (1 + std::abs(distance))) section.push_back(p);
  }
  std::sort(section.begin(), section.end(),
            [&](const Vec3& a, const Vec3& b) { return glm::dot(along, a) < glm::dot(along, b); });
  // Lines that meet in the plane give one point.
  const double size = section.empty() ? 0 : glm::length(section.back() - section.front());
  section.erase(std::unique(section.begin(), section.end(),
                            [&](const Vec3& a, const Vec3& b) { return glm::length(a - b) <= 1e-7 * size; }),
                section.end());
  return section;
}

std::vector<Section> sections_of_lines(const Fields& f) {
  for (const char* field : {"across", "at", "along"})
    if (!f.has(field))
      throw FieldError(field, "lines are cut by planes: 'across' them, 'at' distances, points 'along'");
  std::vector<Section> sections;
  for (const double distance : f.numbers("at")) {
    sections.push_back(cut(f.references("lines"), f.vec3("across"), distance, f.vec3("along")));
    if (sections.back().size() < 2)
      throw FieldError("at", fmt::format("the plane at {:.6g} meets the lines in {} point{}, two are needed at least",
                                         distance, sections.back().size(), sections.back().size() == 1 ? "" : "s"));
  }
  return sections;
}

std::vector<double> common_nodes(const Fields& f, const std::vector<Section>& sections, bool closed) {
  if (!f.has("nodes")) {
    const auto most = std::max_element(sections.begin(), sections.end(),
                                       [](const Section& a, const Section& b) { return a.size() < b.size(); });
    return shares(*most, closed, static_cast<size_t>(most - sections.begin()));
  }
  const int count = f.integer("nodes") + (closed ? 1 : 0);
  std::vector<double> nodes;
  for (int k = 0; k < count; ++k) nodes.push_back(static_cast<double>(k) / (count - 1));
  return nodes;
}

std::vector<double> values_of_v(const Fields& f, const Grid<Vec3>& grid) {
  if (f.has("at_v")) {
    const std::vector<double>& values = f.numbers("at_v");
    if (static_cast<int>(values.size()) != grid.columns)
      throw FieldError("at_v", fmt::format("{} values for {} sections", values.size(), grid.columns));
    for (size_t j = 1; j < values.size(); ++j)
      if (!(values[j] > values[j - 1]))
        throw FieldError("at_v", fmt::format("value {} is not above the one before", j));
    return values;
  }
  std::vector<double> values{0};
  for (int j = 1; j < grid.columns; ++j) {
    double sum = 0;
    for (int i = 0; i < grid.rows; ++i) sum += glm::length(grid.at(i, j) - grid.at(i, j - 1)) / grid.rows;
    if (!(sum > 0)) throw FieldError("sections", fmt::format("sections {} and {} are the same", j - 1, j));
    values.push_back(values.back() + sum);
  }
  return values;
}

NurbsSurface build(const Fields& f) {
  if (f.has("sections") == f.has("lines"))
    throw FieldError(f.has("lines") ? "lines" : "sections",
                     "the surface is given by sections, or by lines that are cut", "give 'sections' or 'lines'");
  const bool closed = f.boolean("closed");
  if (closed && f.has("lines"))
    throw FieldError("closed", "points of lines are ordered along a direction: they do not close");
  const std::vector<Section> sections = f.has("sections") ? given_sections(f) : sections_of_lines(f);
  if (sections.size() < 2) throw FieldError(f.has("lines") ? "at" : "sections", "two sections are needed at least");
  const std::vector<double> nodes = common_nodes(f, sections, closed);
  Grid<Vec3> grid{static_cast<int>(nodes.size()) - (closed ? 1 : 0), static_cast<int>(sections.size()), {}};
  grid.values.resize(static_cast<size_t>(grid.rows) * grid.columns);
  for (size_t j = 0; j < sections.size(); ++j) {
    const NurbsCurve spline = spline_through(sections[j], shares(sections[j], closed, j), closed);
    for (int i = 0; i < grid.rows; ++i) grid.at(i, static_cast<int>(j)) = spline.point(nodes[i]);
  }
  const std::vector<double> at_v = values_of_v(f, grid);
  return tensor_surface(
      grid, [&](std::span<const Vec3> line) { return spline_through(line, nodes, closed); },
      [&](std::span<const Vec3> line) { return spline_through(line, at_v, false); });
}

}  // namespace

TypeDeclaration section_surface_type() {
  return declare(
             Category::surface, "section_surface",
             "Smooth surface through sections that have points of their own, as many as each needs; or through lines "
             "on it without order, cut by parallel planes. u runs along the sections in 0..1, v from section to "
             "section.")
      .example(
          "sections: [{ points: [[0, 0, 0], [1, 0, 1], [2, 0, 0]] }, { points: [[0, 1, 0], [0.5, 1, 1], [1.5, 1, 1.2], "
          "[2, 1, 0]] }]")
      .optional("sections",
                groups({{"points", points().count(2), "along the section; not repeated where closed", true, {}}}),
                "the sections in their order; all run the same way")
      .optional("lines", references({Category::curve}), "or lines on the surface")
      .optional("across", direction(), "of lines: the normal of the planes that cut them")
      .optional("at", numbers(), "of lines: distances of the planes from the origin")
      .optional("along", direction(), "of lines: the order of the points in a plane")
      .field("closed", boolean(), "the sections are closed", "false")
      .optional("nodes", integer().between(2, 1000),
                "so many common nodes, evenly spaced; else as the section with the most points has them")
      .optional("at_v", numbers(), "values of v at the sections; else by their mean distances")
      .shows({"control_net", "knots"})
      .built_by(build);
}

}  // namespace lekalo::geometry
