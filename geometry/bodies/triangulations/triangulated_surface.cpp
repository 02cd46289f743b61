// Surfaces on triangulations (Golovanov 2016, 3.17): a curved triangle on each.
#include <fmt/format.h>

#include "geometry/bodies/topology/sew.h"
#include "geometry/bodies/triangulations/triangulation.h"
#include "geometry/surfaces/triangles/curved_triangles.h"

namespace lekalo::geometry {

namespace {

SpatialTriangulation triangulation_of(const Fields& f) {
  if (f.has("of") == f.has("points"))
    throw FieldError(f.has("of") ? "points" : "of", "it is made of points, or of a surface",
                     "give 'points', or 'of' with 'cells'");
  if (f.has("points")) {
    if (f.has("cells")) throw FieldError("cells", "cells are those of a surface", "leave it out");
    return triangulation_of_points(f);
  }
  for (const char* field : {"triangles", "normals", "parameters", "longest"})
    if (f.has(field)) throw FieldError(field, "the surface has its own", "leave it out");
  for (const char* field : {"joined_by", "largest_hole", "flattened"})
    if (f.given(field)) throw FieldError(field, "it is for 'points'", "leave it out");
  if (!f.has("cells.u")) throw FieldError("of", "how many cells?", "cells: { u: 24, v: 16 }");
  const SurfacePtr surface = f.surface("of");
  if (!surface->bounded()) throw FieldError("of", "the surface is unbounded", "take a part of it");
  return triangulation_of_surface(*surface, f.u<int>("cells"), f.v<int>("cells"));
}

void move_points(const Fields& f, SpatialTriangulation& t) {
  if (!f.has("moved")) return;
  for (const Fields& one : f.groups("moved")) {
    const int index = one.integer("index");
    if (index >= static_cast<int>(t.points.size()))
      throw FieldError("moved", fmt::format("there is no point {}", index),
                       fmt::format("there are points 0 to {}", t.points.size() - 1));
    t.points[static_cast<size_t>(index)] += one.vec3("by");
  }
  if (f.text("normals_of_moved") == "mean") set_mean_normals(t);
}

std::vector<SurfacePtr> patches(const SpatialTriangulation& t, const std::string& kind, EdgeTangents tangents) {
  std::vector<SurfacePtr> result;
  const auto add = [&](TriangularNet net, const std::array<Vec2, 3>& uv) {
    result.push_back(std::make_shared<BezierTriangle>(std::move(net), ParameterTriangle{uv}));
  };
  for (size_t k = 0; k < t.triangles.size(); ++k) {
    std::array<TriangleCorner, 3> corners;
    const std::array<Vec2, 3>& uv = t.parameters[k];
    for (size_t i = 0; i < 3; ++i) {
      const auto at = static_cast<size_t>(t.triangles[k][i]);
      corners[i] = {t.points[at], t.normals[at], uv[i]};
      if (t.is_parametrized) corners[i].du = t.du[at], corners[i].dv = t.dv[at];
    }
    if (kind == "clough_tocher") {
      const std::array<TriangularNet, 3> nets = clough_tocher(corners);
      const Vec2 middle = (uv[0] + uv[1] + uv[2]) / 3.0;
      for (size_t i = 0; i < 3; ++i) add(nets[i], {uv[i], uv[(i + 1) % 3], middle});
    } else if (kind == "flat") {
      add(net_of_points(1, {corners[0].point, corners[1].point, corners[2].point}), uv);
    } else {
      const CurvedTriangle curved = kind == "hermite"    ? CurvedTriangle::hermite
                                    : kind == "balanced" ? CurvedTriangle::balanced
                                                         : CurvedTriangle::pn;
      add(curved_triangle(corners, curved, tangents), uv);
    }
  }
  return result;
}

}  // namespace

TypeDeclaration triangulated_surface_type() {
  return declare(Category::body, "triangulated_surface",
                 "Curved triangles on a triangulation of points with normals, sewn to a shell (Golovanov 2016, 3.17). "
                 "'lekalo evaluate --uv' finds the triangle at parameters.")
      .optional("points", points().count(3), "the points, or with 'of' those of a surface")
      .optional("triangles", indices(),
                "the numbers of the corners of each, counterclockwise seen from outside; without them Delaunay's "
                "triangles of the parameters")
      .optional("normals", points(), "one for each point, of any length; means of the triangles' when left out")
      .optional("parameters", parameter_points(),
                "(u, v) of each point; when left out x and y without 'triangles', else each triangle has its own")
      .optional("longest", length().positive(), "of Delaunay's triangles those with a longer side are left out")
      .field("joined_by", choice({"parameters", "neighbours"}),
             "how points without 'triangles' are: Delaunay's of their parameters; or neighbours as they lie in space, "
             "by the shortest edges first, also round closed shapes. A shape is turned so that its highest point looks "
             "up",
             "parameters")
      .field("largest_hole", integer().between(3, 100),
             "of neighbours: openings between them with so many sides are closed, larger ones are borders", "8")
      .field("flattened", boolean(),
             "of neighbours that make one sheet: its border goes round the unit circle and the parameters inside keep "
             "angles as well as can be (mean value coordinates)",
             "false")
      .optional("of", reference({Category::surface}), "a bounded surface, whose points and normals are taken")
      .optional("cells", integer().between(1, 1000).for_each_direction(), "of the surface's rectangle along u and v")
      .field("patch", choice({"pn", "balanced", "hermite", "clough_tocher", "flat"}),
             "pn: cubic; hermite: the surface on the three edge curves, which bulges; balanced: without the bulge; "
             "clough_tocher: three cubics each, smooth everywhere, of points with parameters; flat: facets",
             "pn")
      .field("tangents", choice({"projected", "arc"}),
             "of the edge curves at their ends: the chord without its part along the normal; or as long as arcs of "
             "circles have them, which halves the error on a torus",
             "projected")
      .optional("moved",
                groups({{"index", integer().at_least(0),
                         "number of the point, from 0; of a surface its rows "
                         "follow one another along u"},
                        {"by", vector(), "how far"}}),
                "points that are moved")
      .field("normals_of_moved", choice({"kept", "mean"}), "mean: all normals are those of the triangles then", "kept")
      .example(
          "points: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], triangles: [[0, 1, 2]], normals: [[1, 0, 0], [0, 1, 0], [0, "
          "0, 1]]")
      .built_by([](const Fields& f) -> BodyPtr {
        SpatialTriangulation t = triangulation_of(f);
        const std::string& kind = f.text("patch");
        if (kind == "clough_tocher" && !t.is_parametrized)
          throw FieldError("patch", "Clough's and Tocher's triangles need parameters", "give 'parameters'");
        const auto tangents = f.text("tangents") == "arc" ? EdgeTangents::arc : EdgeTangents::projected;
        if (f.given("tangents") && (kind == "clough_tocher" || kind == "flat"))
          throw FieldError("tangents", fmt::format("triangles '{}' have no edge curves of normals", kind),
                           "leave it out, or patch: pn");
        move_points(f, t);
        return std::make_shared<Body>(sew(patches(t, kind, tangents)));
      });
}

}  // namespace lekalo::geometry
