#include "render/drawing/annotations/cutting_plane.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "geometry/box_corners.h"
#include "render/drawing/annotations/page_shapes.h"
#include "render/model/section.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Millimetres.
constexpr double kFree = 3;   // between what is cut and the thick ends
constexpr double kThick = 6;  // length of the thick ends
constexpr double kBend = 3;   // of each side of a bend
constexpr double kArrow = 7;
constexpr double kTextOff = 0.8;
constexpr double kEdgeOn = 1e-6;  // radians

// The line on the page, from its first end to its last, and the side of what is taken away.
struct CuttingLine {
  std::vector<Vec3> points;
  Vec3 away{0};
};

bool is_edge_on(const Vec3& normal, const Vec3& sight) { return std::abs(glm::dot(normal, sight)) <= kEdgeOn; }

// The line of a section whose planes are seen from their edges; none of others.
CuttingLine line_of(const Section& section, const Vec3& sight, const Box3& box) {
  if (!section.path.empty()) {
    if (glm::length(glm::cross(section.along, sight)) > kEdgeOn) return {};
    return {section.path, section.towards};
  }
  std::vector<SectionPlane> planes;
  for (const SectionPlane& plane : section.planes)
    if (is_edge_on(plane.normal, sight)) planes.push_back({plane.through, glm::normalize(plane.normal)});
  if (planes.empty() || planes.size() > 2) return {};
  const Vec3 n = planes[0].normal, along = glm::cross(n, sight);
  const double reach = 0.5 * box.diameter();
  const Vec3 middle = box.center() - glm::dot(box.center() - planes[0].through, n) * n;
  if (planes.size() == 1) return {{middle - reach * along, middle + reach * along}, n};
  // Two planes bound a corner that is taken away; its edge lies in both.
  const Vec3 m = planes[1].normal, across = glm::cross(m, sight);
  const double share = glm::dot(m, along);
  if (std::abs(share) <= kEdgeOn) return {};
  const Vec3 edge = middle + glm::dot(planes[1].through - middle, m) / share * along;
  const Vec3 first = share > 0 ? along : -along, second = glm::dot(n, across) > 0 ? across : -across;
  return {{edge + reach * first, edge, edge + reach * second}, n + m};
}

// How far along a line from `from` what is shown goes.
double reach_of(const View& view, const Box3& box, const Vec2& from, const Vec2& way) {
  double reach = 0;
  for (const Vec3& corner : corners(box)) reach = std::max(reach, glm::dot(view.place(corner) - from, way));
  return reach;
}

}  // namespace

void add_cutting_plane(AnnotationWork& work) {
  const View& view = work.view();
  using SectionPtr = std::shared_ptr<const Section>;
  if (!work.fields().holds<SectionPtr>("section")) return work.leave_out("of a panel without a section");
  const Section& section = *work.fields().get<SectionPtr>("section");
  const Box3 box = bounds(view.model);
  const CuttingLine line = line_of(section, view.camera.view_direction(), box);
  if (!view.camera.is_parallel() || line.points.size() < 2)
    return work.leave_out("whose planes are not seen from their edges");
  std::vector<Vec2> places;
  for (const Vec3& point : line.points) places.push_back(view.place(point));
  const Vec2 away = view.place(line.points[0] + line.away) - places[0];
  for (const bool last : {false, true}) {
    Vec2& end = last ? places.back() : places.front();
    const Vec2 inner = last ? places[places.size() - 2] : places[1];
    const Vec2 way = glm::normalize(end - inner);
    end = inner + (reach_of(view, box, inner, way) + kFree + kThick) * way;
    work.page_line(end, end - kThick * way, false, false);
    Vec2 out(way.y, -way.x);
    if (glm::dot(out, away) < 0) out = -out;
    const Vec2 tip = end - 0.5 * kThick * way, tail = tip + kArrow * out;
    work.page_line(tail, tip, false, true);
    Label letter = work.page_label(section.title, tail);
    // Behind the arrow or, where a dimension runs there, beside it or farther off.
    for (const Vec2& beside : {out, way, -way}) letter.spots.push_back({tail, side_towards(beside), kTextOff});
    for (const double farther : {3.0, 6.0}) letter.spots.push_back({tail, side_towards(out), kTextOff + farther});
    if (!section.title.empty()) work.add(std::move(letter));
  }
  for (size_t k = 1; k + 1 < places.size(); ++k)
    for (const Vec2& other : {places[k - 1], places[k + 1]})
      work.page_line(places[k], places[k] + kBend * glm::normalize(other - places[k]), false, false);
  const LineLook axis = drawn_look(view.model.styles.at("axis"));
  for (size_t k = 0; k + 1 < places.size(); ++k) work.shape({drawn(straight_path({places[k], places[k + 1]}), axis)});
}

}  // namespace lekalo::render
