// Blends of edges that meet in a corner but not in one ball, one after the other (Golovanov 2016, 6.9, algorithm step
// 7): where a first edge has run out its end is an arc, with which the others continue each other.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "geometry/bodies/blends/blending.h"
#include "geometry/bodies/local/crossing_faces.h"
#include "geometry/bodies/topology/entity_names.h"

namespace lekalo::geometry {

namespace {

struct Asked {
  bool convex;
  double radius;  // 0: no ball of constant radius
};

// Which of the blended edges of a corner goes first: the only one of its convexity, else the one with the largest
// radius. None where they meet in another way, or one does not know which.
std::optional<int> first_of(const Fan& fan, const std::map<int, Asked>& asked, Corners corners) {
  if (fan.edges.size() != 3) return std::nullopt;
  std::vector<int> convex, concave, all;
  for (const HalfEdge& half : fan.edges) {
    const auto found = asked.find(half.edge);
    if (found == asked.end()) continue;
    all.push_back(half.edge);
    (found->second.convex ? convex : concave).push_back(half.edge);
  }
  if (convex.size() == 1 && !concave.empty()) return concave.size() == 1 ? concave[0] : convex[0];
  if (concave.size() == 1 && !convex.empty()) return concave[0];
  if (all.size() < 3 || corners == Corners::mitred) return std::nullopt;
  const auto radius = [&](int edge) { return asked.at(edge).radius; };
  std::sort(all.begin(), all.end(), [&](int a, int b) { return radius(a) > radius(b); });
  if (radius(all[2]) > 0 && radius(all[0]) > radius(all[1])) return all[0];
  return std::nullopt;
}

// The edges that go first in a corner, and last in none.
std::set<int> first_stage(const Body& body, const std::vector<BlendRequest>& requests, Corners corners) {
  std::vector<BlendRule> rules;
  std::map<int, Asked> asked;
  for (const BlendEdge& edge : blend_edges(body, requests, rules)) {
    const BlendRule& rule = rules[edge.rule];
    asked[edge.edge] = {edge.convex, rule.is_plain_ball() ? rule.sizes[0](0.0) : 0};
  }
  std::set<int> first, later;
  for (const auto& [edge, one] : asked)
    for (const bool at_end : {false, true}) {
      const Fan fan = fan_from(body, {edge, at_end});
      const auto leader = first_of(fan, asked, corners);
      if (!leader) continue;
      for (const HalfEdge& half : fan.edges)
        if (asked.count(half.edge)) (half.edge == *leader ? first : later).insert(half.edge);
    }
  for (const int edge : later) first.erase(edge);
  return first;
}

// The part of the requests that is done first, or what is left of them.
std::vector<BlendRequest> part_of(const std::vector<BlendRequest>& requests, const std::set<int>& edges, bool inside) {
  std::vector<BlendRequest> result = requests;
  for (BlendRequest& one : result)
    std::erase_if(one.edges, [&](int edge) { return (edges.count(edge) > 0) != inside; });
  return result;
}

std::vector<BlendRequest> renumbered(std::vector<BlendRequest> requests, const std::vector<int>& edges) {
  for (BlendRequest& one : requests) {
    for (int& edge : one.edges) edge = edges[edge];
    std::erase(one.edges, -1);
  }
  return requests;
}

bool is_of_role(const Origin& origin, const std::string& role) {
  return origin.role == role || origin.role.starts_with(role + ".");
}

// Numbers where several have one name.
template <class Entity>
void number_equals(std::vector<Entity>& entities, const std::set<std::string>& roles) {
  std::map<std::string, int> count, next;
  const auto is_new = [&](const Entity& one) {
    return std::any_of(roles.begin(), roles.end(),
                       [&](const std::string& role) { return is_of_role(one.origin, role); });
  };
  for (const Entity& one : entities) ++count[one.origin.role];
  for (Entity& one : entities)
    if (is_new(one)) one.origin.index = count[one.origin.role] > 1 ? next[one.origin.role]++ : -1;
}

// Blends keep clear of the faces that are no neighbours of their edges.
void check_room(const Body& made, const Body& body, const std::vector<BlendRequest>& requests) {
  const auto is_new = [&](int face) { return face >= static_cast<int>(body.faces.size()); };
  const auto pair = crossing_faces(made, is_new);
  if (!pair) return;
  const Origin& blend = made.faces[is_new(pair->first) ? pair->first : pair->second].origin;
  int edge = -1;
  for (const BlendRequest& one : requests)
    if (!one.edges.empty() && (edge < 0 || is_of_role(blend, one.rule.role))) edge = one.edges.front();
  throw BlendError(edge, fmt::format("the faces {} and {} run into each other", name_of_face(made, pair->first),
                                     name_of_face(made, pair->second)));
}

}  // namespace

Body blended(const Body& body, const std::vector<BlendRequest>& requests, Corners corners, Room room) {
  Stage stage{body, {}};
  std::vector<BlendRequest> left = requests;
  for (;;) {
    const std::set<int> first = first_stage(stage.body, left, corners);
    if (first.empty()) break;
    const std::vector<BlendRequest> later = part_of(left, first, false);
    stage = blended_at_once(stage.body, part_of(left, first, true), corners);
    left = renumbered(later, stage.edges);
  }
  stage = blended_at_once(stage.body, left, corners);
  std::set<std::string> roles;
  for (const BlendRequest& one : requests) roles.insert(one.rule.role);
  number_equals(stage.body.faces, roles);
  number_equals(stage.body.edges, roles);
  if (room == Room::checked) check_room(stage.body, body, requests);
  return std::move(stage.body);
}

}  // namespace lekalo::geometry
