// The types of bodies with blended edges (Golovanov 2016, 6.9, 6.11).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/bodies/blends/blending.h"
#include "geometry/bodies/topology/edge_selection.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/bodies/topology/selection.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

// To five digits.
double rounded_down(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 4);
  return std::floor(x / unit) * unit;
}

// The largest first size of a request, five digits, with which the body can be made, the others in proportion; 0 where
// there is none.
double largest_size(const Body& body, const std::vector<BlendRequest>& requests, Corners corners, size_t which) {
  const auto works = [&](double share, Room room) {
    std::vector<BlendRequest> smaller = requests;
    for (ScalarLaw& size : smaller[which].rule.sizes) size = ScalarLaw(share * size(0.0));
    try {
      blended(body, smaller, corners, room);
      return true;
    } catch (const std::invalid_argument&) {
      return false;
    }
  };
  constexpr int kHalvings = 24;
  const double size = requests[which].rule.sizes[0](0.0);
  const auto largest = [&](Room room) {
    double lo = 0, hi = 1;
    const auto is_known = [&] { return lo > 0 && rounded_down(lo * size) == rounded_down(hi * size); };
    for (int k = 0; k < kHalvings && !is_known(); ++k) (works(0.5 * (lo + hi), room) ? lo : hi) = 0.5 * (lo + hi);
    return lo > 0 ? rounded_down(lo * size) : 0;
  };
  // Whether faces run into each other is looked for once, with the size that is told: it takes long where they nearly
  // touch.
  const double found = largest(Room::assumed);
  return found > 0 && works(found / size, Room::checked) ? found : largest(Room::checked);
}

// A formula of parameters alone is a constant.
ScalarLaw law_of(const Expression& size) {
  const auto& names = size.names();
  const bool varies = std::find(names.begin(), names.end(), "s") != names.end();
  return varies ? ScalarLaw(size) : ScalarLaw(size(0.0));
}

// The edges that an item of the list means.
std::vector<int> edges_of(const Body& body, const Fields& item, const char* list, size_t number) {
  try {
    return selected_edges(body, item.group("edges"));
  } catch (const FieldError& error) {
    throw FieldError(list, fmt::format("item {}: {}", number, error.what()), error.hint);
  }
}

void require_positive(const BlendRule& rule, const char* list, size_t number) {
  for (const ScalarLaw& size : rule.sizes)
    if (size.is_constant() && !(size(0.0) > 0))
      throw FieldError(list, fmt::format("item {}: the {} is {:.6g}", number, rule.field, size(0.0)),
                       "a positive number");
}

BodyPtr made(const Body& body, const std::vector<BlendRequest>& requests, Corners corners, const char* list) {
  try {
    return std::make_shared<Body>(blended(body, requests, corners));
  } catch (const BlendError& error) {
    std::string message =
        fmt::format("{}: {}", error.name.empty() ? name_of_edge(body, error.edge) : error.name, error.what());
    std::string hint = "a smaller size, or other edges with it";
    for (size_t r = 0; r < requests.size() && error.too_large; ++r) {
      const BlendRule& rule = requests[r].rule;
      if (!rule.is_constant()) continue;
      const double size = largest_size(body, requests, corners, r);
      if (!(size > 0)) continue;
      hint = fmt::format("the largest {} that fits is {:.5g} ({})", rule.field, size, rule.role);
      break;
    }
    throw FieldError(list, message, hint);
  }
}

std::set<int> faces_of_first(const Body& body, const Fields& selector) {
  std::set<int> faces;
  if (selector.has("between"))
    for (const int f : all_called(body, Element::face, {selector.get<std::vector<std::string>>("between")[0]}, "edges"))
      faces.insert(f);
  return faces;
}

BlendRequest fillet_request(const Body& body, const Fields& f, size_t number) {
  BlendRequest request;
  request.edges = edges_of(body, f, "fillets", number);
  request.first_faces = faces_of_first(body, f.group("edges"));
  request.goes_on = f.boolean("chain");
  BlendRule& rule = request.rule;
  rule.role = fmt::format("fillets.{}", number);
  if (f.has("radius") == f.has("chord"))
    throw FieldError("fillets", fmt::format("item {}: a fillet has a radius, or a chord instead", number),
                     "give one of them");
  rule.field = f.has("radius") ? "radius" : "chord";
  if (f.has("chord")) {
    rule.kind = BlendKind::chord;
    rule.sizes[0] = rule.sizes[1] = law_of(f.get<Expression>("chord"));
  } else {
    const auto& given = f.get<std::vector<Expression>>("radius");
    rule.sizes = {law_of(given.front()), law_of(given.back())};
  }
  const std::string word = f.word("section");
  rule.overflow = f.text("overflow") == "edge" ? Overflow::edge : Overflow::cut;
  require_positive(rule, "fillets", number);
  rule.weight = word == "circle" ? 0 : word == "parabola" ? 1 : f.number("section");
  return request;
}

BodyPtr filleted(const Fields& f) {
  const Body& body = *f.body("of");
  std::vector<BlendRequest> requests;
  for (const Fields& one : f.groups("fillets")) requests.push_back(fillet_request(body, one, requests.size()));
  return made(body, requests, f.text("corners") == "round" ? Corners::round : Corners::mitred, "fillets");
}

// Between the faces of an edge, in the sector that is cut off or filled, all along it.
double sector_angle(const Body& body, int edge) {
  const Edge& e = body.edges[edge];
  const Interval t = e.curve->domain();
  double least = kInfinity, most = -kInfinity;
  for (const double share : {0.0, 0.2, 0.5, 0.7, 1.0}) {
    std::array<Vec3, 2> normals;
    for (int k = 0; k < 2; ++k) {
      const Vec2 at(body.coedges[e.coedges[k]].image->point(t.lo + share * t.width()));
      normals[k] = body.normal(face_of(body, e.coedges[k]), at.x, at.y);
    }
    const double angle =
        kPi - std::atan2(glm::length(glm::cross(normals[0], normals[1])), glm::dot(normals[0], normals[1]));
    least = std::min(least, angle), most = std::max(most, angle);
  }
  if (most - least > 1e-9)
    throw FieldError("chamfers",
                     fmt::format("{}: the angle between its faces changes from {:.5g} to {:.5g} degrees",
                                 name_of_edge(body, edge), least * 180 / kPi, most * 180 / kPi),
                     "give two `lengths` instead of `length` and `angle`");
  return 0.5 * (least + most);
}

// The second length of a triangle with the first, the angle at its end and that of the sector (Golovanov 2016, 6.11).
double second_length(const Body& body, int edge, double length, double angle) {
  const double sector = sector_angle(body, edge);
  if (!(angle + sector < kPi))
    throw FieldError(
        "chamfers",
        fmt::format("{}: under this angle the chamfer never meets the second face", name_of_edge(body, edge)),
        fmt::format("less than {:.5g} degrees", (kPi - sector) * 180 / kPi));
  return length * std::sin(angle) / std::sin(sector + angle);
}

// One for each second length: edges between other angles have others.
void add_chamfers(const Body& body, const Fields& f, size_t number, std::vector<BlendRequest>& requests) {
  BlendRequest request;
  request.edges = edges_of(body, f, "chamfers", number);
  request.first_faces = faces_of_first(body, f.group("edges"));
  if (f.has("face")) {
    request.first_faces.clear();
    for (const int face : all_called(body, Element::face, {f.text("face")}, "face")) request.first_faces.insert(face);
    const bool is_beside = std::any_of(request.edges.begin(), request.edges.end(), [&](int edge) {
      const std::vector<int> beside = faces_beside(body, edge);
      return std::any_of(beside.begin(), beside.end(), [&](int k) { return request.first_faces.count(k) > 0; });
    });
    if (!is_beside)
      throw FieldError("chamfers",
                       fmt::format("item {}: the face '{}' lies beside none of the edges", number, f.text("face")),
                       "one of the two faces that meet in such an edge");
  }
  request.goes_on = f.boolean("chain");
  BlendRule& rule = request.rule;
  rule.kind = BlendKind::chamfer, rule.role = fmt::format("chamfers.{}", number), rule.field = "length";
  if (f.has("lengths") == f.has("length"))
    throw FieldError("chamfers", fmt::format("item {}: a chamfer has lengths, or a length and an angle", number),
                     "give one of lengths: [a, b] and length: a, angle: 30");
  if (f.has("lengths") && f.given("angle"))
    throw FieldError("chamfers", fmt::format("item {}: lengths leave no choice of the angle", number),
                     "lengths alone, or length: a, angle: 30");
  if (f.has("lengths")) {
    const auto& given = f.get<std::vector<Expression>>("lengths");
    rule.sizes = {law_of(given.front()), law_of(given.back())};
    require_positive(rule, "chamfers", number);
    requests.push_back(std::move(request));
    return;
  }
  const double length = f.number("length");
  std::map<double, std::vector<int>> by_second;
  for (const int edge : request.edges) {
    const double second = second_length(body, edge, length, f.number("angle"));
    auto near = by_second.lower_bound(second * (1 - 1e-12));
    if (near == by_second.end() || near->first > second * (1 + 1e-12))
      near = by_second.emplace(second, std::vector<int>()).first;
    near->second.push_back(edge);
  }
  for (auto& [second, edges] : by_second) {
    request.edges = std::move(edges);
    request.rule.sizes = {ScalarLaw(length), ScalarLaw(second)};
    requests.push_back(request);
  }
}

BodyPtr chamfered(const Fields& f) {
  const Body& body = *f.body("of");
  std::vector<BlendRequest> requests;
  size_t number = 0;
  for (const Fields& one : f.groups("chamfers")) add_chamfers(body, one, number++, requests);
  return made(body, requests, Corners::mitred, "chamfers");
}

const char* kWhichEdges =
    "the edges: by the faces between which they are; all that meet every condition given, all sharp edges where none "
    "is";
const char* kChain = "go on along edges that continue the given ones smoothly";

}  // namespace

TypeDeclaration chamfer_body_type() {
  return declare(
             Category::body, "chamfer_body",
             "A body with bevelled edges, convex ones cut off and concave ones filled. Lengths are measured from the "
             "edge, on curved faces along their tangent planes. Faces keep their names; those of item k of the list "
             "are called chamfers.k.")
      .example("of: { type: box, size: [3, 2, 1] }, chamfers: { edges: { between: [x_max, z_max] }, lengths: 0.3 }")
      .field("of", reference({Category::body}), "the body")
      .field("chamfers",
             groups({{"edges", edge_selector(), kWhichEdges, false, "{}"},
                     {"lengths",
                      formulas({"s"}, 1, 2),
                      "how much is taken off: a number, a formula of the fraction s of each edge's length, or two for "
                      "the faces named first and second",
                      false,
                      {}},
                     {"length", length().positive(), "in place of lengths: that on the first face", false, {}},
                     {"angle", angle().above(0).below(kPi), "with length: between the first face and the chamfer",
                      false, "45"},
                     {"face", text(), "the face, or family of faces, on which the first length counts", false, {}},
                     {"chain", boolean(), kChain, false, "true"}})
                 .count(1),
             "which edges, and how")
      .built_by(chamfered);
}

TypeDeclaration fillet_body_type() {
  return declare(Category::body, "fillet_body",
                 "A body with rounded edges: the surface that a ball leaves as it rolls along both faces, inside of "
                 "convex edges and outside of concave ones. Faces keep their names; those of item k of the list are "
                 "called fillets.k.")
      .example("of: { type: box, size: [3, 2, 1] }, fillets: { edges: { between: [x_max, z_max] }, radius: 0.3 }")
      .field("of", reference({Category::body}), "the body")
      .field("fillets",
             groups({{"edges", edge_selector(), kWhichEdges, false, "{}"},
                     {"radius",
                      formulas({"s"}, 1, 2),
                      "of the ball: a number, a formula of the fraction s of each edge's length, or two for the faces "
                      "named first and second, which make ellipses",
                      false,
                      {}},
                     {"chord", formula({"s"}), "in place of a radius: the distance of the borders", false, {}},
                     {"section", number().positive().or_word({"circle", "parabola"}),
                      "a circle (with two radii, an ellipse), or the middle weight of another conic: below 1 an "
                      "ellipse, 1 a parabola, above a hyperbola",
                      false, "circle"},
                     {"chain", boolean(), kChain, false, "true"},
                     {"overflow", choice({"cut", "edge"}),
                      "where there is no room on a face and the next one does not go on smoothly: that one cuts the "
                      "fillet, or the ball rests on the edge between them",
                      false, "cut"}})
                 .count(1),
             "which edges, and how")
      .field("corners", choice({"round", "mitred"}),
             "where all edges of a corner are filleted with one radius: a piece of a sphere, or edges in which the "
             "fillets meet",
             "round")
      .built_by(filleted);
}

}  // namespace lekalo::geometry
