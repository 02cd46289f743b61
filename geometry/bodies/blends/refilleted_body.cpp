// Fillets with another radius (Golovanov 2016, 6.12): those between planes are moved and scaled; chains of others are
// taken away, the faces beside them continued to edges, and these filleted again.
#include <fmt/format.h>

#include <algorithm>

#include "geometry/bodies/blends/blending.h"
#include "geometry/bodies/local/face_replacement.h"
#include "geometry/bodies/local/fillet_chains.h"
#include "geometry/bodies/local/plane_fillets.h"
#include "geometry/bodies/topology/edge_selection.h"
#include "geometry/bodies/topology/selection.h"

namespace lekalo::geometry {

namespace {

std::vector<FilletChain> chosen_chains(const Body& body, const Fields& f) {
  std::vector<FilletChain> all = fillet_chains(body);
  if (!f.has("faces")) {
    if (all.empty()) throw FieldError("of", "the body has no fillets");
    return all;
  }
  std::vector<FilletChain> chosen;
  std::vector<char> is_taken(all.size(), 0);
  for (const int k : faces_named(body, f, "faces")) {
    const auto has_it = [&](const FilletChain& chain) {
      return std::find(chain.faces.begin(), chain.faces.end(), k) != chain.faces.end() ||
             std::find(chain.corners.begin(), chain.corners.end(), k) != chain.corners.end();
    };
    const auto found = std::find_if(all.begin(), all.end(), has_it);
    if (found == all.end())
      throw FieldError("faces", fmt::format("the face {} is no fillet", name_of_face(body, k)),
                       "a face with circles of one radius across, smooth with the faces on both sides");
    char& taken = is_taken[static_cast<size_t>(found - all.begin())];
    if (!taken) chosen.push_back(*found);
    taken = 1;
  }
  return chosen;
}

// Cylinders between planes that end at other faces; nothing where one of them is something else.
std::vector<PlaneFillet> plain_ones(const Body& body, const std::vector<FilletChain>& chains) {
  std::vector<PlaneFillet> result;
  for (const FilletChain& chain : chains)
    for (const int k : chain.faces) {
      const auto fillet = plane_fillet(body, k);
      if (!fillet || !chain.corners.empty() || ends_in_corner(body, *fillet)) return {};
      result.push_back(*fillet);
    }
  return result;
}

Body scaled(const Body& body, const std::vector<PlaneFillet>& fillets, double radius) {
  std::vector<SurfacePtr> surfaces = surfaces_of(body);
  for (const PlaneFillet& fillet : fillets) surfaces[fillet.face] = with_radius(body, fillet, radius);
  FaceReplacement made = replace_faces(body, surfaces, "radius");
  check_replacement(made, "radius", "a smaller radius");
  return std::move(made.body);
}

Vec3 middle_of(const Edge& edge) { return edge.curve->point(edge.curve->domain().middle()); }

// The sharp edges between two faces of the healed body that the old one has not.
std::vector<int> new_edges(const Body& old, const FaceReplacement& healed, const std::array<int, 2>& between) {
  const double near = 1e-6 * bounds(old).diameter();
  std::vector<Vec3> known;
  const auto are_beside = [](const std::vector<int>& faces, int a, int b) {
    return faces.size() == 2 && std::minmax(faces[0], faces[1]) == std::minmax(a, b);
  };
  for (size_t e = 0; e < old.edges.size(); ++e)
    if (are_beside(faces_beside(old, static_cast<int>(e)), between[0], between[1]))
      known.push_back(middle_of(old.edges[e]));
  std::vector<int> result;
  for (size_t e = 0; e < healed.body.edges.size(); ++e) {
    const auto number = static_cast<int>(e);
    if (healed.body.edges[e].kind != EdgeKind::regular) continue;
    std::vector<int> faces = faces_beside(healed.body, number);
    for (int& face : faces) face = healed.faces[static_cast<size_t>(face)];
    if (!are_beside(faces, between[0], between[1]) || !is_sharp(healed.body, number)) continue;
    const Vec3 middle = middle_of(healed.body.edges[e]);
    if (std::none_of(known.begin(), known.end(), [&](const Vec3& p) { return glm::length(p - middle) <= near; }))
      result.push_back(number);
  }
  return result;
}

// Named as the fillets were where a fillet_body made them.
std::string role_of(const Body& body, const FilletChain& chain, size_t number) {
  const std::string& role = body.faces[chain.faces.front()].origin.role;
  return role.starts_with("fillets") ? role : fmt::format("fillets.{}", number);
}

Body made_again(const Body& body, const std::vector<FilletChain>& chains, double radius) {
  const FaceReplacement healed = without_fillets(body, chains, "faces");
  std::vector<BlendRequest> requests;
  bool is_round = false;
  std::vector<int> taken;
  for (size_t k = 0; k < chains.size(); ++k) {
    BlendRequest request;
    request.goes_on = false;
    request.rule.sizes = {ScalarLaw(radius), ScalarLaw(radius)};
    request.rule.role = role_of(body, chains[k], k), request.rule.field = "radius";
    // A fillet along another goes round its corner.
    is_round |= !chains[k].corners.empty();
    for (const FilletChain& other : chains) is_round |= &other != &chains[k] && is_along(chains[k], other);
    for (const auto& between : chains[k].between)
      for (const int edge : new_edges(body, healed, between)) {
        if (std::find(taken.begin(), taken.end(), edge) != taken.end()) continue;
        taken.push_back(edge), request.edges.push_back(edge);
      }
    if (!request.edges.empty()) requests.push_back(std::move(request));
  }
  if (requests.empty())
    throw FieldError("faces", "the faces beside the fillets do not meet in an edge without them", "other fillets");
  try {
    return blended(healed.body, requests, is_round ? Corners::round : Corners::mitred);
  } catch (const BlendError& error) {
    throw FieldError("radius", fmt::format("{}: {}", name_of_edge(healed.body, error.edge), error.what()),
                     error.too_large ? "a smaller radius" : "other fillets");
  }
}

Body refilleted(const Fields& f) {
  const Body& body = *f.body("of");
  const std::vector<FilletChain> chains = chosen_chains(body, f);
  const std::vector<PlaneFillet> plain = plain_ones(body, chains);
  return plain.empty() ? made_again(body, chains, f.number("radius")) : scaled(body, plain, f.number("radius"));
}

}  // namespace

TypeDeclaration refilleted_body_type() {
  return declare(
             Category::body, "refilleted_body",
             "A body whose fillets get another radius. Faces that have circles of one radius across and are smooth "
             "with the faces on both sides are recognised as fillets, whoever made them: cylinders, tori, surfaces of "
             "rolling balls; those that follow one another smoothly change together, with the balls at their corners. "
             "(deleted_faces with chain removes them.)")
      .example(
          "of: { type: extrusion_body, of: { type: rectangle, size: [3, 2], corner_radius: 0.5 }, along: [0, 0, "
          "1] }, radius: 0.2")
      .field("of", reference({Category::body}), "the body; closed")
      .optional("faces", texts().count(1), "names or numbers of the fillets; all that there are where left out")
      .field("radius", length().positive(), "their radius")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(refilleted(f)); });
}

}  // namespace lekalo::geometry
