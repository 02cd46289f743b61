// The exact NURBS form of a curve: what it is made of, and its rational Bezier pieces.
#include <fmt/format.h>

#include "command.h"
#include "geometry/curves/splines/rational_cubic.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Vec3;
using geometry::Vec4;

Vec3 place(const Vec4& p) { return Vec3(p) / p.w; }

void put_points(ordered_json& out, const std::vector<Vec4>& points) {
  ordered_json places = ordered_json::array(), weights = ordered_json::array();
  for (const Vec4& p : points) {
    places.push_back(p.w == 0 ? ordered_json(nullptr) : to_json(place(p)));
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
  for (const auto& x : numbers) text += (text.empty() ? "" : " ") + (x.is_null() ? "-" : digits(x.get<double>()));
  return text;
}

void print_points(const ordered_json& of) {
  for (size_t i = 0; i < of["points"].size(); ++i)
    fmt::print("  point {:<3} weight {:<22} {}\n", i, digits(of["weights"][i].get<double>()), listed(of["points"][i]));
}

}  // namespace

ordered_json form_of(const std::string& name, const render::Entity& entity) {
  const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
  const auto form = curve ? (*curve)->as_nurbs() : std::nullopt;
  if (!form) throw UsageError(fmt::format("'{}' is not a curve with an exact NURBS form", name));
  ordered_json out;
  out["name"] = name;
  out["degree"] = form->degree;
  out["knots"] = form->knots;
  put_points(out, form->points);
  out["pieces"] = ordered_json::array();
  for (const geometry::CurvePiece& piece : geometry::bezier_pieces(*form, (*curve)->domain()))
    out["pieces"].push_back(piece_json(piece));
  return out;
}

void print_form(const ordered_json& found) {
  fmt::print("curve '{}', degree {}\nknots  {}\n", found["name"].get<std::string>(), found["degree"].get<int>(),
             listed(found["knots"]));
  print_points(found);
  for (const ordered_json& piece : found["pieces"]) {
    fmt::print("Bezier piece over {}\n", listed(piece["domain"]));
    print_points(piece);
    if (piece.contains("invariants"))
      fmt::print("  invariants {}, weights in standard form {}\n", listed(piece["invariants"]),
                 listed(piece["standard_weights"]));
  }
}

}  // namespace lekalo::command
