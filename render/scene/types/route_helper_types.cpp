// Helpers of planned paths (render/lines/route_figures.h): their fields.
#include "render/scene/types/helper_types.h"

namespace lekalo::render {

using namespace geometry;
using namespace helpers;

namespace {

TypeDeclaration graph_helper(const char* name, const char* description) {
  TypeDeclaration type = helper(name, description, "thin");
  type.field("marker", marker(), "sign at the vertices", "dot")
      .field("labels", choice({"numbers", "roman", "none"}), "what stands at the vertices", "numbers")
      .field("first", integer(), "number of the first vertex", "1")
      .field("weights", boolean(), "the weights beside the edges", "false");
  return finish(type);
}

TypeDeclaration& with_distance(TypeDeclaration& type) {
  return type.optional("distance", length(), "from the edges, to the right; a small part of the graph's size without");
}

TypeDeclaration added_edges() {
  TypeDeclaration type = helper(
      "added_edges", "The edges that a closed way takes a second time (Zavyalov et al. 1985, V.2).", "construction");
  return finish(with_distance(type));
}

TypeDeclaration matching() {
  TypeDeclaration type =
      helper("matching", "The vertices of an odd number of edges in pairs of the least distances.", "construction");
  type.field("marker", marker(), "sign at the vertices", "dot");
  return finish(type);
}

TypeDeclaration walk() {
  TypeDeclaration type =
      helper("walk", "The steps of a way, with heads; those of edges that are walked twice beside the edge.", "thin");
  type.field("numbers", boolean(), "the numbers of the steps", "false");
  return finish(with_distance(type));
}

TypeDeclaration region() {
  TypeDeclaration type =
      helper("region", "The polygons in which the center of the tool that clears a pocket runs.", "thin");
  type.field("marker", marker(), "sign at the corners", "none");
  return finish(type);
}

TypeDeclaration trapezoids() {
  TypeDeclaration type = helper("trapezoids", "The lines that divide a pocket, from corners to the next rims.", "thin");
  type.field("numbers", boolean(), "the numbers of the trapezoids", "true")
      .field("first", integer(), "number of the first", "1");
  return finish(type);
}

TypeDeclaration finishing() {
  TypeDeclaration type = helper("finishing", "The paths of the tool that runs along the contours of a pocket.", "thin");
  return finish(type);
}

TypeDeclaration feed_points() {
  TypeDeclaration type = helper(
      "feed_points", "Places of the tool along a profile, and the allowance before each along the normal.", "hairline");
  type.field("marker", marker(), "sign at the places", "dot");
  return finish(type);
}

TypeDeclaration drilling() {
  TypeDeclaration type = helper("drilling", "Holes in the order in which they are drilled.", "thin");
  type.field("marker", marker(), "sign at the holes", "circle")
      .field("numbers", boolean(), "their places in the order, from 1", "true");
  return finish(type);
}

}  // namespace

std::vector<TypeDeclaration> route_helper_types() {
  return {graph_helper("graph", "The vertices and edges of a graph (Zavyalov et al. 1985, V.2)."),
          graph_helper("reduced_graph", "What is left of a graph without its vertices of two edges."),
          added_edges(),
          matching(),
          walk(),
          region(),
          trapezoids(),
          finishing(),
          feed_points(),
          drilling()};
}

}  // namespace lekalo::render
