#include "geometry/bodies/topology/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/bodies/topology/landmarks.h"
#include "geometry/describe.h"
#include "geometry/expression/nearest_name.h"
#include "geometry/queries/closest/closest_point.h"

namespace lekalo::geometry {

namespace {

constexpr size_t kMaxNames = 8;     // in hints
constexpr double kSameLine = 1e-9;  // of the body's size: what lies so near to an edge is on it
constexpr double kSameWay = 1e-9;   // radians
constexpr int kSamples = 16;        // of a smooth piece of an edge

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<std::string_view> parts_of(std::string_view name) {
  std::vector<std::string_view> parts;
  for (size_t begin = 0; begin <= name.size();) {
    const size_t end = std::min(name.find('.', begin), name.size());
    parts.push_back(name.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

const char* word(Element element) {
  return element == Element::face ? "face" : element == Element::edge ? "edge" : "vertex";
}

size_t count(const Body& body, Element element) {
  return element == Element::face   ? body.faces.size()
         : element == Element::edge ? body.edges.size()
                                    : body.vertices.size();
}

const Origin& origin(const Body& body, Element element, int index) {
  return element == Element::face   ? body.faces[index].origin
         : element == Element::edge ? body.edges[index].origin
                                    : body.vertices[index].origin;
}

// Those that can be asked for.
std::vector<int> candidates(const Body& body, Element element) {
  std::vector<int> all;
  for (int k = 0; k < static_cast<int>(count(body, element)); ++k)
    if (element != Element::edge || body.edges[k].kind == EdgeKind::regular) all.push_back(k);
  return all;
}

std::vector<Vec3> samples(const Body& body, Element element, int index) {
  if (element == Element::vertex) return {body.vertices[index].point};
  if (element == Element::edge) return points_along(*body.edges[index].curve, kSamples);
  return points_of_border(body, index, kSamples);
}

bool is_between(const Body& body, int edge, const std::set<int>& one, const std::set<int>& other) {
  const std::vector<int> beside = faces_beside(body, edge);
  if (beside.size() != 2) return false;
  return (one.count(beside[0]) && other.count(beside[1])) || (one.count(beside[1]) && other.count(beside[0]));
}

std::set<int> faces_around(const Body& body, Element element, int index) {
  std::set<int> faces;
  for (int e = 0; e < static_cast<int>(body.edges.size()); ++e) {
    const Edge& edge = body.edges[e];
    if (element == Element::edge ? e != index : edge.start != index && edge.end != index) continue;
    for (const int face : faces_beside(body, e)) faces.insert(face);
  }
  return faces;
}

bool is_parallel(const Body& body, Element element, int index, const Vec3& way) {
  const double length = glm::length(way);
  const auto across = [&](const Vec3& d) {
    return glm::length(glm::cross(d, way)) <= kSameWay * glm::length(d) * length;
  };
  if (element == Element::edge) {
    const std::vector<Vec3> points = points_along(*body.edges[index].curve, kSamples);
    const Vec3 chord = points.back() - points.front();
    return glm::length(chord) > 0 && std::all_of(points.begin() + 1, points.end(), [&](const Vec3& p) {
             return glm::length(glm::cross(p - points.front(), way)) <= kSameWay * glm::length(chord) * length;
           });
  }
  const Face& face = body.faces[index];
  for (const int loop : face.loops)
    for (const int coedge : body.loops[loop].coedges) {
      const Curve& image = *body.coedges[coedge].image;
      for (int k = 0; k <= kSamples; ++k) {
        const Vec3 uv = image.point(image.domain().lo + image.domain().width() * k / kSamples);
        if (!across(face.surface->normal(uv.x, uv.y))) return false;
      }
    }
  return true;
}

// Whether the points of an edge lie on one of the body's edges, or that of a vertex is one of its vertices.
bool has(const Body& body, Element element, const std::vector<Vec3>& points, double near) {
  if (element == Element::vertex)
    return std::any_of(body.vertices.begin(), body.vertices.end(),
                       [&](const Vertex& vertex) { return glm::length(vertex.point - points.front()) <= near; });
  return std::any_of(body.edges.begin(), body.edges.end(), [&](const Edge& edge) {
    if (edge.kind == EdgeKind::pole) return false;
    const Box3 box = bounds(*edge.curve).inflated(near);
    const auto inside = [&](const Vec3& p) {
      return glm::all(glm::lessThanEqual(box.lo, p)) && glm::all(glm::lessThanEqual(p, box.hi));
    };
    if (!std::all_of(points.begin(), points.end(), inside)) return false;
    const CurveProjector projector(edge.curve);
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& p) { return projector.foot_points(p).foot_points.front().distance <= near; });
  });
}

void keep_extreme(const Body& body, Element element, const Vec3& way, std::vector<int>& chosen) {
  std::vector<double> lowest;
  for (const int k : chosen) {
    double least = kInfinity;
    for (const Vec3& p : samples(body, element, k)) least = std::min(least, glm::dot(p, way));
    lowest.push_back(least);
  }
  if (chosen.empty()) return;
  const double farthest = *std::max_element(lowest.begin(), lowest.end());
  const double near = kSameLine * bounds(body).diameter() * glm::length(way);
  std::vector<int> kept;
  for (size_t k = 0; k < chosen.size(); ++k)
    if (lowest[k] >= farthest - near) kept.push_back(chosen[k]);
  chosen = std::move(kept);
}

void check(Element element, const Selector& selector) {
  const auto refuse = [&](const char* field) {
    throw FieldError(
        field, fmt::format("'{}' does not choose among {}", field, element == Element::face ? "faces" : "vertices"));
  };
  if (element != Element::edge && !selector.between.empty()) refuse("between");
  if (element == Element::face && !selector.of_face.empty()) refuse("of_face");
  if (element == Element::vertex && selector.parallel) refuse("parallel");
  if (element == Element::face && selector.new_to) refuse("new_in");
  if (!selector.between.empty() && selector.between.size() != 2)
    throw FieldError("between", "an edge lies between two faces", "between: [end, side]");
}

std::set<int> set_called(const Body& body, Element element, const std::vector<std::string>& names, const char* field) {
  const std::vector<int> all = all_called(body, element, names, field);
  return {all.begin(), all.end()};
}

}  // namespace

bool stands_for(std::string_view asked, std::string_view name) {
  const std::vector<std::string_view> wanted = parts_of(asked);
  size_t next = 0;
  for (const std::string_view part : parts_of(name)) {
    if (next == wanted.size()) break;
    if (part == wanted[next])
      ++next;
    else if (next == 0 || !is_number(part))
      return false;
  }
  return next == wanted.size();
}

std::string name_of(const Body& body, Element element, int index) {
  const std::string own = origin(body, element, index).text();
  return own.empty() ? fmt::format("{}.{}", word(element), index) : own;
}

std::vector<std::string> names_of(const Body& body, Element element) {
  std::vector<std::string> names;
  for (const int k : candidates(body, element)) names.push_back(name_of(body, element, k));
  return names;
}

std::vector<int> called(const Body& body, Element element, std::string_view name) {
  const std::vector<int> all = candidates(body, element);
  const auto where = [&](const auto& holds) {
    std::vector<int> chosen;
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), holds);
    return chosen;
  };
  const auto text = [&](int k) { return origin(body, element, k).text(); };
  std::vector<int> chosen = where([&](int k) { return text(k) == name; });
  if (chosen.empty()) chosen = where([&](int k) { return stands_for(name, text(k)); });
  // Without the name of the operand; the walls inside of a shell, inner.NAME, only where there is nothing else.
  for (const bool with_inner : {false, true})
    if (chosen.empty())
      chosen = where([&](int k) {
        const std::string full = text(k);
        for (size_t dot = full.find('.'); dot != std::string::npos; dot = full.find('.', dot + 1)) {
          if (!with_inner && parts_of(std::string_view(full).substr(0, dot)).back() == "inner") return false;
          if (stands_for(name, std::string_view(full).substr(dot + 1))) return true;
        }
        return false;
      });
  if (chosen.empty()) chosen = where([&](int k) { return name == fmt::format("{}.{}", word(element), k); });
  if (chosen.empty()) chosen = where([&](int k) { return name == std::to_string(k); });
  return chosen;
}

std::vector<int> all_called(const Body& body, Element element, const std::vector<std::string>& names,
                            const std::string& field) {
  std::set<int> chosen;
  for (const std::string& name : names) {
    const std::vector<int> some = called(body, element, name);
    if (some.empty()) {
      const std::vector<std::string> known = names_of(body, element), nearest = nearest_names(name, known, kMaxNames);
      throw FieldError(field, fmt::format("the body has no {} '{}'", word(element), name),
                       known.empty()
                           ? "it has none"
                           : fmt::format("{} {}", known.size() > nearest.size() ? "the nearest are" : "it has",
                                         fmt::join(nearest, ", ")));
    }
    chosen.insert(some.begin(), some.end());
  }
  return {chosen.begin(), chosen.end()};
}

int one_called(const Body& body, Element element, const std::string& name, const std::string& field) {
  const std::vector<int> all = all_called(body, element, {name}, field);
  if (all.size() == 1) return all.front();
  std::vector<std::string> names;
  for (size_t k = 0; k < all.size() && k < kMaxNames; ++k) names.push_back(described(body, element, all[k]));
  throw FieldError(field, fmt::format("'{}' stands for {} things; one is wanted here", name, all.size()),
                   fmt::format("they are {}{}", fmt::join(names, ", "), all.size() > kMaxNames ? ", ..." : ""));
}

std::vector<int> faces_beside(const Body& body, int edge) {
  std::set<int> faces;
  for (const int coedge : body.edges[edge].coedges) faces.insert(body.loops[body.coedges[coedge].loop].face);
  return {faces.begin(), faces.end()};
}

std::string described(const Body& body, Element element, int index) {
  if (element != Element::edge) return name_of(body, element, index);
  std::vector<std::string> faces;
  for (const int face : faces_beside(body, index)) faces.push_back(name_of(body, Element::face, face));
  return fmt::format("edge.{} ({})", index, fmt::join(faces, ", "));
}

std::vector<int> select(const Body& body, Element element, const Selector& selector) {
  check(element, selector);
  std::vector<int> chosen = candidates(body, element);
  const auto keep = [&](const auto& holds) { std::erase_if(chosen, [&](int k) { return !holds(k); }); };
  if (!selector.names.empty()) {
    const std::set<int> named = set_called(body, element, selector.names, word(element));
    keep([&](int k) { return named.count(k) > 0; });
  }
  if (!selector.between.empty()) {
    const std::set<int> one = set_called(body, Element::face, {selector.between[0]}, "between"),
                        other = set_called(body, Element::face, {selector.between[1]}, "between");
    keep([&](int k) { return is_between(body, k, one, other); });
  }
  if (!selector.of_face.empty()) {
    const std::set<int> faces = set_called(body, Element::face, selector.of_face, "of_face");
    keep([&](int k) {
      const std::set<int> around = faces_around(body, element, k);
      return std::any_of(around.begin(), around.end(), [&](int face) { return faces.count(face) > 0; });
    });
  }
  if (selector.parallel) keep([&](int k) { return is_parallel(body, element, k, *selector.parallel); });
  if (selector.new_to) {
    const double near = kSameLine * bounds(body).diameter();
    keep([&](int k) {
      const std::vector<Vec3> points = samples(body, element, k);
      return std::none_of(selector.new_to->begin(), selector.new_to->end(),
                          [&](const BodyPtr& old) { return has(*old, element, points, near); });
    });
  }
  for (const Selector& one : selector.all) {
    const std::vector<int> other = select(body, element, one);
    keep([&](int k) { return std::binary_search(other.begin(), other.end(), k); });
  }
  for (const Selector& one : selector.none) {
    const std::vector<int> other = select(body, element, one);
    keep([&](int k) { return !std::binary_search(other.begin(), other.end(), k); });
  }
  if (selector.extreme) keep_extreme(body, element, *selector.extreme, chosen);
  return chosen;
}

Body with_feature(const Body& body, const std::string& feature) {
  Body result = body;
  const auto name = [&](auto& entities) {
    for (auto& entity : entities)
      if (entity.origin.feature.empty() && !entity.origin.role.empty()) entity.origin.feature = feature;
  };
  name(result.faces);
  name(result.edges);
  name(result.vertices);
  return result;
}

}  // namespace lekalo::geometry
