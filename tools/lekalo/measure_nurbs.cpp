// lekalo measure --nurbs and export --format json: a curve as a NURBS curve, exactly or fitted, and its Bezier pieces
// (of surfaces in measure_nurbs_surface.cpp).
#include <fmt/format.h>

#include "command.h"
#include "geometry/curves/operations/nurbs_of.h"
#include "geometry/curves/splines/periodic_curve.h"
#include "geometry/curves/splines/rational_cubic.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Vec3;
using geometry::Vec4;

// A fit is this near to its curve, of the curve's size.
constexpr double kFit = 1e-9;

// A periodic spline as it was given, anything else clamped.
geometry::NurbsOfCurve form_of(const geometry::Curve& curve) {
  const auto* spline = dynamic_cast<const geometry::NurbsCurve*>(&curve);
  if (spline && geometry::is_whole_period(*spline)) return {*curve.as_nurbs(), true, 0};
  return geometry::nurbs_of(curve, curve.domain(), kFit * geometry::bounds(curve).diameter());
}

// A point at infinity is its direction.
Vec3 place(const Vec4& p) { return p.w != 0 ? Vec3(p) / p.w : Vec3(p); }

void put_points(ordered_json& out, const std::vector<Vec4>& points) {
  ordered_json places = ordered_json::array(), weights = ordered_json::array();
  for (const Vec4& p : points) {
    places.push_back(to_json(place(p)));
    weights.push_back(p.w);
  }
  out["points"] = places;
  out["weights"] = weights;
}

// What the weights of a cubic do to its shape, apart from its parameter.
void put_invariants(ordered_json& out, const std::vector<Vec4>& points) {
  geometry::RationalCubic cubic;
  for (int i = 0; i < 4; ++i) {
    if (!(points[i].w > 0)) return;
    cubic.points[i] = place(points[i]);
    cubic.weights[i] = points[i].w;
  }
  const double start = cubic.start_invariant(), end = cubic.end_invariant();
  out["invariants"] = ordered_json::array({start, end});
  out["standard_weights"] = geometry::weights_of_invariants(start, end);
}

ordered_json piece_json(const geometry::CurvePiece& piece) {
  ordered_json out;
  out["domain"] = ordered_json::array({piece.domain.lo, piece.domain.hi});
  put_points(out, piece.points);
  if (piece.degree() == 3) put_invariants(out, piece.points);
  return out;
}

std::string listed(const ordered_json& numbers) {
  std::string text;
  for (const auto& x : numbers) text += fmt::format("{}{}", text.empty() ? "" : " ", digits(x.get<double>()));
  return text;
}

void print_points(const ordered_json& of) {
  for (size_t i = 0; i < of["points"].size(); ++i)
    fmt::print("  {}  weight {}\n", digits(vector_of(of["points"][i])), digits(of["weights"][i].get<double>()));
}

}  // namespace

ordered_json nurbs_form(const std::string& name, const render::Entity& entity) {
  if (const auto* surface = std::get_if<geometry::SurfacePtr>(&entity)) return nurbs_surface_form(name, **surface);
  const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
  if (!curve) throw UsageError(fmt::format("'{}' is no curve or surface: only those have a NURBS form", name));
  geometry::NurbsOfCurve found;
  try {
    found = form_of(**curve);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}' has no NURBS form: {}", name, error.what()));
  }
  ordered_json out{{"name", name}, {"kind", "curve"}, {"degree", found.form.degree}, {"knots", found.form.knots}};
  put_points(out, found.form.points);
  out["exact"] = found.exact;
  out["deviation"] = found.deviation;
  out["pieces"] = ordered_json::array();
  for (const geometry::CurvePiece& piece : geometry::bezier_pieces(found.form, found.form.domain()))
    out["pieces"].push_back(piece_json(piece));
  return out;
}

void print_nurbs_form(const ordered_json& form) {
  if (form["kind"] == "surface") return print_nurbs_surface_form(form);
  fmt::print("curve '{}': NURBS curve of degree {}, {}\n", form["name"].get<std::string>(), form["degree"].get<int>(),
             form["exact"].get<bool>() ? "exact" : fmt::format("a fit, {:.2g} away", form["deviation"].get<double>()));
  fmt::print("knots {}\n", listed(form["knots"]));
  print_points(form);
  for (const ordered_json& piece : form["pieces"]) {
    fmt::print("Bezier piece over {}\n", listed(piece["domain"]));
    print_points(piece);
    if (piece.contains("invariants"))
      fmt::print("  invariants {}, weights in standard form {}\n", listed(piece["invariants"]),
                 listed(piece["standard_weights"]));
  }
}

}  // namespace lekalo::command
