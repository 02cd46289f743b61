// Of measure --nurbs and export --format json: a surface as a NURBS surface where it is one, else as Bezier pieces.
#include <fmt/format.h>

#include <algorithm>

#include "command.h"
#include "geometry/queries/rays/bezier_patch.h"
#include "geometry/queries/rays/fitted_pieces.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Surface;
using geometry::SurfacePiece;
using geometry::Vec3;
using geometry::Vec4;

// Rows along v of a net, one for each u. A point at infinity is its direction.
void put_net(ordered_json& out, const std::vector<Vec4>& points, int count_v) {
  ordered_json places = ordered_json::array(), weights = ordered_json::array();
  for (size_t i = 0; i < points.size(); i += count_v) {
    ordered_json row = ordered_json::array(), row_weights = ordered_json::array();
    for (size_t j = i; j < i + count_v; ++j) {
      row.push_back(to_json(points[j].w != 0 ? Vec3(points[j]) / points[j].w : Vec3(points[j])));
      row_weights.push_back(points[j].w);
    }
    places.push_back(row);
    weights.push_back(row_weights);
  }
  out["points"] = places;
  out["weights"] = weights;
}

ordered_json piece_json(const SurfacePiece& piece) {
  const geometry::Rectangle& box = piece.domain;
  ordered_json out{{"domain", {{box.u.lo, box.u.hi}, {box.v.lo, box.v.hi}}},
                   {"degree", {piece.degree_u, piece.degree_v}}};
  put_net(out, piece.points, piece.degree_v + 1);
  return out;
}

// The largest distance seen between a polynomial piece and the surface, in the middle of the parts of a grid.
double deviation(const Surface& surface, const SurfacePiece& piece) {
  constexpr int kPlaces = 3;
  const geometry::PatchView patch{piece.points.data(), piece.degree_u, piece.degree_v};
  double most = 0;
  for (int i = 0; i < kPlaces; ++i)
    for (int j = 0; j < kPlaces; ++j) {
      const double s = (i + 0.5) / kPlaces, t = (j + 0.5) / kPlaces;
      const Vec3 there =
          surface.point(piece.domain.u.lo + s * piece.domain.u.width(), piece.domain.v.lo + t * piece.domain.v.width());
      most = std::max(most, glm::length(geometry::evaluate(patch, s, t).point - there));
    }
  return most;
}

void put_pieces(ordered_json& out, const std::vector<SurfacePiece>& pieces) {
  out["pieces"] = ordered_json::array();
  for (const SurfacePiece& piece : pieces) out["pieces"].push_back(piece_json(piece));
}

// Polynomials in place of a surface that is no NURBS surface; what they leave out beside singular places.
void put_fit(ordered_json& out, const Surface& surface) {
  std::vector<geometry::Rectangle> boxes;
  for (const SurfacePiece& piece : surface.pieces()) boxes.push_back(piece.domain);
  const geometry::FittedPieces fitted = geometry::fitted_pieces(surface, boxes);
  double most = 0;
  for (const SurfacePiece& piece : fitted.patches) most = std::max(most, deviation(surface, piece));
  out["exact"] = false;
  out["deviation"] = most;
  put_pieces(out, fitted.patches);
  out["left_out"] = ordered_json::array();
  for (const geometry::Rectangle& box : fitted.rest)
    out["left_out"].push_back({{box.u.lo, box.u.hi}, {box.v.lo, box.v.hi}});
}

}  // namespace

ordered_json nurbs_surface_form(const std::string& name, const Surface& surface) {
  if (!surface.bounded())
    throw UsageError(fmt::format("'{}' has no bounds, and so no NURBS form: give it a domain", name));
  ordered_json out{{"name", name}, {"kind", "surface"}};
  const std::vector<SurfacePiece> pieces = surface.pieces();
  if (const auto form = surface.as_nurbs()) {
    out["degree"] = {form->degree_u, form->degree_v};
    out["knots_u"] = form->knots_u;
    out["knots_v"] = form->knots_v;
    put_net(out, form->points, form->count_v());
  } else if (!std::all_of(pieces.begin(), pieces.end(), [](const SurfacePiece& one) { return one.is_rational(); })) {
    put_fit(out, surface);
    return out;
  }
  out["exact"] = true;
  out["deviation"] = 0.0;
  put_pieces(out, pieces);
  return out;
}

void print_nurbs_surface_form(const ordered_json& form) {
  const std::string name = form["name"];
  const size_t pieces = form["pieces"].size();
  if (form.contains("degree"))
    fmt::print("surface '{}': NURBS surface of degrees {} and {}, {} by {} points, {} Bezier piece{}\n", name,
               form["degree"][0].get<int>(), form["degree"][1].get<int>(), form["points"].size(),
               form["points"][0].size(), pieces, pieces == 1 ? "" : "s");
  else if (form["exact"])
    fmt::print("surface '{}': {} exact Bezier pieces\n", name, pieces);
  else
    fmt::print("surface '{}': {} fitted polynomial pieces, {:.2g} away; --json has their points\n", name, pieces,
               form["deviation"].get<double>());
}

}  // namespace lekalo::command
