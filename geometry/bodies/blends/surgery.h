// A body on its way from sharp edges to blended ones (Golovanov 2016, 6.9, 6.10): what is known of each blended edge,
// of edges that get shorter, and of corners of faces where new edges come in.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "geometry/bodies/blends/blend_edges.h"
#include "geometry/bodies/blends/body_draft.h"

namespace lekalo::geometry {

// A border that crosses a smooth edge of its face near to one of its ends: the piece beyond, or all of it, belongs to
// the face on the other side, where it follows what arrives along a half-edge.
struct Straddle {
  bool is_whole = false;  // else it crosses at s, in the vertex
  double s = 0;
  int vertex = -1;
  HalfEdge after;
  int place = 0;  // of several that follow there
  int face = -1;
  Vec2 near{0};  // a place of the face beside the piece
};

struct EdgeBlend {
  BlendEdge edge;
  BlendBand band;
  // At the edge's start and end, on its right and left side: where the border ends, and the new vertex there.
  std::array<std::array<double, 2>, 2> s{};
  std::array<std::array<int, 2>, 2> vertices{{{-1, -1}, {-1, -1}}};
  std::array<std::array<std::optional<Straddle>, 2>, 2> straddles;
  // From the right to the left side, with images on the band.
  std::array<std::vector<Body::Use>, 2> sections;
};

// What is left of an edge: the parameters and vertices at its ends that have moved.
struct EdgeTrim {
  std::array<std::optional<double>, 2> t;
  std::array<int, 2> vertices{-1, -1};
  int by = -1;  // the blended edge that was the last to take something away
};

struct Surgery {
  const Body& body;
  const std::vector<BlendRule>& rules;
  BodyDraft draft;
  double size = 1;
  std::vector<EdgeBlend> blends;
  std::map<int, size_t> blend_of;  // of an edge
  std::map<int, EdgeTrim> trims;   // of edges that stay
  std::vector<DraftFace> corner_faces;
  std::vector<int> fixed_vertices;  // at which borders begin and end
  // Uses to insert in the loop that arrives along a half-edge, with images on its face.
  std::map<HalfEdge, std::vector<Body::Use>> corners;

  bool is_blended(const HalfEdge& half) const { return blend_of.count(half.edge) > 0; }
  EdgeBlend& blend(const HalfEdge& half) { return blends[blend_of.at(half.edge)]; }
  const BlendRule& rule_of(const EdgeBlend& blend) const { return rules[blend.edge.rule]; }
  Origin origin(const EdgeBlend& blend, const char* what) const { return {"", rule_of(blend).role + "." + what, -1}; }
  // One of the fixed vertices, or a new one.
  int vertex_at(const Vec3& point);
  // The border of a side ends at s, in a vertex.
  void end_border(const HalfEdge& half, int side, double s, int vertex);
  // The edges in which the band of a half-edge ends, from the side before it to the side after it.
  void end_section(const HalfEdge& half, std::vector<Body::Use> path);
  void trim(const HalfEdge& half, double t, int vertex, int by);
};

// The parameters of a point of an edge in one of its faces.
Vec2 place_on(const Body& body, int face, const HalfEdge& half, double t);
// About where the border z of a band meets an edge near to its section s.
double start_on(const Body& body, const HalfEdge& half, const BlendBand& band, double s, double z);

// The ends of the blended edges of a fan whose first edge is blended. All throw BlendError.

// One blended edge, which ends at the faces between its two neighbours.
void run_out(Surgery& surgery, const Fan& fan);
// Two that continue each other: they have a section in common.
void join(Surgery& surgery, const Fan& fan, size_t other);
// Two of three edges, or all three, that meet in a corner: their bands meet in edges.
void mitre(Surgery& surgery, const Fan& fan);
// Edges that become smooth in the vertex (Golovanov 2016, figure 6.9.4): both borders of each run together there.
void run_to_point(Surgery& surgery, const Fan& fan);
// All edges of the vertex, with one ball that touches all faces: a piece of a sphere.
void round_corner(Surgery& surgery, const Fan& fan);

}  // namespace lekalo::geometry
