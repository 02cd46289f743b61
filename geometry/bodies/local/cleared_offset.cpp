#include "geometry/bodies/local/cleared_offset.h"

#include <algorithm>
#include <cmath>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/local/corners.h"
#include "geometry/bodies/local/crossing_faces.h"
#include "geometry/bodies/local/face_replacement.h"
#include "geometry/bodies/local/fillet_chains.h"
#include "geometry/bodies/local/support.h"
#include "geometry/queries/closest/distance.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

namespace {

constexpr int kDepth = 6;         // steps one after another
constexpr double kSame = 1e-9;    // of volumes, relative
constexpr double kNearer = 1e-9;  // of the size: rounding of a distance

const char* const kField = "distance";

bool is_sound(const FaceReplacement& made) {
  try {
    check_replacement(made, kField, "");
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

// r_u x r_v of the offset, (1 + h k_1)(1 + h k_2) times that of the face, has turned wherever one looks; k is positive
// where the face is convex.
bool vanishes(const Body& body, int f, double distance) {
  const Face& face = body.faces[f];
  const double side = face.forward ? -1 : 1;
  bool has_place = false;
  for (const int l : face.loops)
    for (const int c : body.loops[l].coedges)
      for (const double share : {0.1, 0.5, 0.8}) {
        const Curve& image = *body.coedges[c].image;
        const Vec3 uv = image.point(image.domain().lo + share * image.domain().width());
        const SurfaceCurvature found = curvature(*face.surface, uv.x, uv.y);
        if (!found.regular) continue;
        has_place = true;
        if (1 + distance * side * found.principal[0] > 1e-9 && 1 + distance * side * found.principal[1] > 1e-9)
          return false;
      }
  return has_place;
}

// With the faces that would be left without neighbours: the cap of a boss, the bottom of a hole.
void add_islands(const Body& body, std::vector<char>& group) {
  for (bool has_grown = true; has_grown;) {
    has_grown = false;
    for (size_t f = 0; f < body.faces.size(); ++f) {
      if (group[f]) continue;
      const std::vector<int>& outer = body.loops[body.faces[f].loops.front()].coedges;
      const bool is_island = std::all_of(outer.begin(), outer.end(), [&](int c) {
        const Edge& edge = body.edges[body.coedges[c].edge];
        if (edge.kind != EdgeKind::regular || edge.coedges.size() != 2) return true;
        return group[face_of_coedge(body, coedge_partner(body, c))] != 0;
      });
      if (is_island) group[f] = 1, has_grown = true;
    }
  }
}

std::optional<Body> healed_without(const Body& body, const std::vector<char>& group) {
  if (std::all_of(group.begin(), group.end(), [](char one) { return one != 0; })) return std::nullopt;
  std::vector<SurfacePtr> surfaces;
  for (size_t f = 0; f < body.faces.size(); ++f) surfaces.push_back(group[f] ? nullptr : body.faces[f].surface);
  try {
    FaceReplacement made = replace_faces(body, surfaces, kField);
    made.turned_edges.clear();
    check_replacement(made, kField, "");
    return std::move(made.body);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::vector<char> vanishing_faces(const Body& body, double distance) {
  std::vector<char> faces(body.faces.size(), 0);
  for (size_t f = 0; f < faces.size(); ++f) faces[f] = vanishes(body, static_cast<int>(f), distance);
  return faces;
}

// Fillets first, by their chains; else other faces with their islands.
std::optional<Body> without_vanishing(const Body& body, std::vector<char> group) {
  std::vector<FilletChain> chains = fillet_chains(body);
  std::erase_if(chains, [&](const FilletChain& chain) {
    return std::none_of(chain.faces.begin(), chain.faces.end(), [&](int f) { return group[f] != 0; });
  });
  if (!chains.empty()) {
    try {
      return without_fillets(body, chains, kField).body;
    } catch (const std::invalid_argument&) {
      // Perhaps as other faces.
    }
  }
  add_islands(body, group);
  return healed_without(body, group);
}

// Two faces of the old body whose new ones run into each other.
std::optional<std::pair<int, int>> crossing_pair(const FaceReplacement& made) {
  try {
    const auto pair = crossing_faces(made.body, [](int) { return true; });
    if (!pair) return std::nullopt;
    return std::pair(made.faces[static_cast<size_t>(pair->first)], made.faces[static_cast<size_t>(pair->second)]);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::optional<Body> put_together(BooleanOperation operation, const Body& a, const Body& b) {
  try {
    return boolean(operation, a, b);
  } catch (const BooleanError&) {
    return std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::optional<Body> cleared(const Body& body, double distance, int depth) {
  if (depth == 0) return std::nullopt;
  const std::vector<char> vanishing = vanishing_faces(body, distance);
  if (std::find(vanishing.begin(), vanishing.end(), 1) != vanishing.end()) {
    const auto rest = without_vanishing(body, vanishing);
    return rest ? cleared(*rest, distance, depth - 1) : std::nullopt;
  }
  FaceReplacement made;
  try {
    const std::vector<double> distances(body.faces.size(), distance);
    made = replace_faces(body, offset_surfaces(body, distances, kField), kField);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  if (is_sound(made)) return std::move(made.body);
  const auto pair = crossing_pair(made);
  if (!pair) return std::nullopt;
  std::array<std::optional<Body>, 2> parts;
  for (int k = 0; k < 2; ++k) {
    std::vector<char> group(body.faces.size(), 0);
    group[static_cast<size_t>(k == 0 ? pair->first : pair->second)] = 1;
    add_islands(body, group);
    parts[k] = healed_without(body, group);
    if (!parts[k]) return std::nullopt;
  }
  const auto operation = distance > 0 ? BooleanOperation::unite : BooleanOperation::intersect;
  const auto whole = put_together(operation, *parts[0], *parts[1]);
  const double volume = measure(body).volume.value;
  if (!whole || !(std::abs(measure(*whole).volume.value - volume) <= kSame * volume)) return std::nullopt;
  const auto first = cleared(*parts[0], distance, depth - 1), second = cleared(*parts[1], distance, depth - 1);
  return first && second ? put_together(operation, *first, *second) : std::nullopt;
}

bool keeps_distance(const Body& body, const Body& made, double distance) {
  const double least = std::abs(distance) - kNearer * bounds(body).diameter();
  for (const Edge& edge : made.edges) {
    const Interval t = edge.curve->domain();
    for (const double share : {0.0, 0.37, 0.71})
      if (!(geometry::distance(edge.curve->point(t.lo + share * t.width()), &body, DistanceMinima::nearest).distance >=
            least))
        return false;
  }
  return true;
}

}  // namespace

bool has_vanishing_face(const Body& body, double distance) {
  const std::vector<char> faces = vanishing_faces(body, distance);
  return std::find(faces.begin(), faces.end(), 1) != faces.end();
}

std::optional<Body> cleared_offset(const Body& body, double distance) {
  if (!body.is_closed()) return std::nullopt;
  auto made = cleared(body, distance, kDepth);
  if (!made || made->faces.empty() || !made->is_valid() || !keeps_distance(body, *made, distance)) return std::nullopt;
  return made;
}

}  // namespace lekalo::geometry
