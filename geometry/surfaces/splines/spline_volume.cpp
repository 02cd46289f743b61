// B-splines of three variables (Zavyalov et al. 1985, I.8): a volume
//
//   r(u, v, w) = sum N_i(u) N_j(v) N_k(w) p_ijk
//
// shown by the surface on which one of the three is held. The sum over that index first leaves a B-spline surface.
#include <fmt/format.h>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/describe.h"
#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

namespace {

SplineAxis axis_along(const Fields& f, const char* name, int count) {
  const std::string degree_field = fmt::format("degree_{}", name), knots_field = fmt::format("knots_{}", name);
  const int degree = std::min(f.integer(degree_field), count - 1);
  const Knots& knots = f.knots(knots_field);
  if (knots.rule == "chord_length" || knots.rule == "centripetal")
    throw FieldError(knots_field, fmt::format("'{}' is not a rule for volumes", knots.rule), "clamped or uniform");
  try {
    return make_axis(degree, knots, false, count, {});
  } catch (const FieldError& error) {
    throw FieldError(knots_field, error.what(), error.hint);
  }
}

// The sum over the index of the parameter that is held.
NurbsSurface build(const Fields& f) {
  std::vector<Grid<Vec3>> layers;
  for (const Fields& layer : f.groups("layers")) layers.push_back(layer.net("points"));
  if (layers.size() < 2) throw FieldError("layers", fmt::format("{} layer: two are needed at least", layers.size()));
  const int rows = layers[0].rows, columns = layers[0].columns, height = static_cast<int>(layers.size());
  if (rows < 2 || columns < 2) throw FieldError("layers", "a layer has two rows and two columns at least");
  for (int k = 1; k < height; ++k)
    if (layers[k].rows != rows || layers[k].columns != columns)
      throw FieldError("layers", fmt::format("layer {} has {} x {} points, the first {} x {}", k, layers[k].rows,
                                             layers[k].columns, rows, columns));
  const SplineAxis axes[] = {axis_along(f, "u", rows), axis_along(f, "v", columns), axis_along(f, "w", height)};
  const std::string& held = f.text("hold");
  const int which = held == "u" ? 0 : held == "v" ? 1 : 2, first = which == 0 ? 1 : 0, second = which == 2 ? 1 : 2;
  const double at = f.number("at");
  const SplineAxis& axis = axes[which];
  if (!axis.domain().contains(at))
    throw FieldError(
        "at", fmt::format("{} = {:.6g} is outside of {:.6g}..{:.6g}", held, at, axis.domain().lo, axis.domain().hi));
  const int p = axis.degree();
  const SplineAxis::Place place = axis.place(at);
  std::vector<double> basis(p + 1);
  basis_derivative(p, axis.knots(), place.span, place.t, 0, basis);
  std::vector<Vec3> points;
  int index[3];
  for (index[first] = 0; index[first] < axes[first].count(); ++index[first])
    for (index[second] = 0; index[second] < axes[second].count(); ++index[second]) {
      Vec3 sum(0);
      for (int m = 0; m <= p; ++m) {
        index[which] = place.span - p + m;
        sum += basis[m] * layers[index[2]].at(index[0], index[1]);
      }
      points.push_back(sum);
    }
  return NurbsSurface(axes[first], axes[second], points);
}

}  // namespace

TypeDeclaration spline_volume_face_type() {
  TypeDeclaration type =
      declare(Category::surface, "spline_volume_face",
              "Surface of a trivariate B-spline volume r(u, v, w) on which one of the three parameters is held; the "
              "other two are its u and v, in their order.");
  type.field("layers", groups({{"points", net(), "control points: points[i][j], i runs with u, j with v", true, {}}}),
             "nets of control points of one shape, in the order of w");
  for (const char* name : {"u", "v", "w"})
    type.field(fmt::format("degree_{}", name), integer().between(1, kMaxDegree),
               fmt::format("degree in {}; less where there are not so many points", name), "3");
  for (const char* name : {"u", "v", "w"})
    type.field(fmt::format("knots_{}", name), knots(),
               fmt::format("of {}: the full vector, or a rule: clamped, uniform", name), "clamped");
  return type.field("hold", choice({"u", "v", "w"}), "the parameter that is held", "w")
      .field("at", number(), "its value")
      .shows({"control_net", "knots"})
      .example(
          "at: 0.5, layers: [{ points: [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]] }, { points: [[[0, 0, 1], [0, "
          "1, "
          "2]], [[1, 0, 1], [1, 1, 1]]] }]")
      .built_by(build);
}

}  // namespace lekalo::geometry
