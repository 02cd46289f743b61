#include "geometry/bodies/blends/blend_edges.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "geometry/bodies/topology/entity_names.h"

namespace lekalo::geometry {

namespace {

constexpr double kTangent = 2e-3;  // of directions: 0.1 degrees
constexpr double kSharp = 1e-6;    // sine between normals

// Outward normals beside an edge at t, and whether the edge is convex there: positive; smooth: near to zero.
double sharpness(const Body& body, int edge, double t) {
  const Edge& e = body.edges[edge];
  std::array<Vec3, 2> normals{Vec3(0), Vec3(0)};
  for (const int c : e.coedges) {
    const Vec2 at(body.coedges[c].image->point(t));
    normals[body.coedges[c].forward ? 1 : 0] = body.normal(face_of(body, c), at.x, at.y);
  }
  const Vec3 along = glm::normalize(e.curve->evaluate(t, 1).d[1]);
  return glm::dot(glm::cross(normals[1], normals[0]), along);
}

bool is_smooth_edge(const Body& body, int edge) {
  const Edge& e = body.edges[edge];
  if (e.kind == EdgeKind::seam) return true;
  if (e.coedges.size() != 2) return false;
  const Interval t = e.curve->domain();
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
    if (std::abs(sharpness(body, edge, t.lo + share * t.width())) > kTangent) return false;
  return true;
}

BlendEdge blend_edge(const Body& body, int edge, size_t rule) {
  const Edge& e = body.edges[edge];
  if (e.kind != EdgeKind::regular)
    throw BlendError(edge, "it is the seam or the pole of a face, which is smooth there", false);
  if (e.coedges.size() != 2) throw BlendError(edge, "it has one face only", false);
  BlendEdge result;
  result.edge = edge, result.rule = rule;
  for (const int c : e.coedges) result.faces[body.coedges[c].forward ? 1 : 0] = face_of(body, c);
  const Interval t = e.curve->domain();
  double least = kInfinity, most = -kInfinity;
  for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95}) {
    const double sharp = sharpness(body, edge, t.lo + share * t.width());
    least = std::min(least, sharp), most = std::max(most, sharp);
  }
  if (std::abs(sharpness(body, edge, t.middle())) < kSharp)
    throw BlendError(edge, "its faces meet smoothly: there is nothing to take off", false);
  if (least < -kSharp && most > kSharp)
    throw BlendError(edge, "it is convex in one part and concave in another: there is no ball that rolls through",
                     false);
  result.convex = most > kSharp;
  return result;
}

// The radius with which an edge goes on at one end, if that is another one than its own.
std::optional<double> radius_beyond(const Body& body, const std::map<int, size_t>& known,
                                    const std::vector<BlendEdge>& edges, const BlendEdge& edge, bool at_end,
                                    const std::vector<BlendRule>& rules) {
  const Fan fan = fan_from(body, {edge.edge, at_end});
  const size_t next = fan.edges.empty() ? 0 : continuation(body, fan);
  const auto found = next > 0 ? known.find(fan.edges[next].edge) : known.end();
  if (found == known.end()) return std::nullopt;
  const BlendRule& rule = rules[edges[found->second].rule];
  return rule.is_plain_ball() ? std::optional(rule.sizes[0](0.0)) : std::nullopt;
}

// An edge between two that have different radii leads from one to the other: r(s) = a + (b - a) (3 s^2 - 2 s^3), which
// has the sections of both at its ends.
void lead_over(const Body& body, const std::map<int, size_t>& known, std::vector<BlendEdge>& edges, size_t i,
               std::vector<BlendRule>& rules) {
  BlendEdge& edge = edges[i];
  if (!rules[edge.rule].is_plain_ball()) return;
  const auto a = radius_beyond(body, known, edges, edge, false, rules),
             b = radius_beyond(body, known, edges, edge, true, rules);
  if (!a || !b || *a == *b) return;
  auto parsed = Expression::parse(fmt::format("{:.17g} + ({:.17g})*(3*s^2 - 2*s^3)", *a, *b - *a));
  Expression law = std::get<Expression>(std::move(parsed));
  const Expression::Variable s{"s"};
  law.bind({&s, 1});
  BlendRule rule = rules[edge.rule];
  rule.sizes = {ScalarLaw(law), ScalarLaw(law)};
  edge.rule = rules.size();
  rules.push_back(std::move(rule));
}

}  // namespace

bool is_smooth_end(const Body& body, const HalfEdge& half) {
  return std::abs(sharpness(body, half.edge, parameter_of(body, half))) < kSharp;
}

size_t continuation(const Body& body, const Fan& fan) {
  const Vec3 from = direction_of(body, fan.edges[0]);
  size_t found = 0;
  for (size_t i = 1; i < fan.edges.size(); ++i) {
    if (body.edges[fan.edges[i].edge].kind != EdgeKind::regular || is_smooth_edge(body, fan.edges[i].edge)) continue;
    if (glm::length(from + direction_of(body, fan.edges[i])) < kTangent) {
      if (found > 0) return 0;
      found = i;
    }
  }
  if (found == 0 || found > 2 || fan.edges.size() - found > 2) return 0;
  for (size_t i = 1; i < fan.edges.size(); ++i)
    if (i != found && !is_smooth_edge(body, fan.edges[i].edge)) return 0;
  return found;
}

std::vector<BlendEdge> blend_edges(const Body& body, const std::vector<BlendRequest>& requests,
                                   std::vector<BlendRule>& rules) {
  for (const BlendRequest& one : requests) rules.push_back(one.rule);
  std::vector<BlendEdge> result;
  std::map<int, size_t> known;
  const auto add = [&](int edge, size_t rule) {
    const auto [found, is_new] = known.try_emplace(edge, result.size());
    if (!is_new && result[found->second].rule != rule) throw BlendError(edge, "it is asked for twice", false);
    if (is_new) result.push_back(blend_edge(body, edge, rule));
    return is_new;
  };
  for (size_t r = 0; r < requests.size(); ++r)
    for (const int edge : requests[r].edges) {
      if (!add(edge, r)) continue;
      const std::set<int>& first = requests[r].first_faces;
      result.back().first_is_left = first.count(result.back().faces[1]) && !first.count(result.back().faces[0]);
    }
  const size_t given = result.size();
  for (size_t i = 0; i < result.size(); ++i)
    for (const bool at_end : {false, true}) {
      const BlendEdge from = result[i];
      if (!requests[from.rule].goes_on) continue;
      const Fan fan = fan_from(body, {from.edge, at_end});
      const size_t next = fan.edges.empty() ? 0 : continuation(body, fan);
      if (next == 0 || known.count(fan.edges[next].edge)) continue;
      // Edges that go on are convex as long as the given one is.
      BlendEdge more = blend_edge(body, fan.edges[next].edge, from.rule);
      if (more.convex != from.convex) continue;
      add(more.edge, from.rule);
      const int first_side = from.first_is_left ? 1 : 0;
      const int side =
          first_side == side_after(fan.edges[0]) ? side_before(fan.edges[next]) : side_after(fan.edges[next]);
      result.back().first_is_left = side == 1;
    }
  for (size_t i = given; i < result.size(); ++i) lead_over(body, known, result, i, rules);
  return result;
}

}  // namespace lekalo::geometry
