#include "geometry/queries/csg_contours.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/curves/curve_part.h"
#include "geometry/curves/segment.h"
#include "geometry/queries/body_contours.h"
#include "geometry/queries/contour_approximation.h"
#include "geometry/queries/curve_intersections.h"
#include "geometry/shapes/body_shape.h"
#include "geometry/shapes/half_space.h"
#include "geometry/surfaces/plane.h"

namespace lekalo::geometry {

namespace {

// How far from a line the solid is asked, of its size.
constexpr double kAside = 1e-6;
// Normals that differ by less are those of one smooth surface.
constexpr double kSmooth = 1e-6;
// Parts of a line shorter than this, of its domain, are none.
constexpr double kShortest = 1e-9;
// A direction along which no edge of a drawing lies.
const Vec3 kProbe = glm::normalize(Vec3(0.5377, -0.7391, 0.4057));

// A leaf in the solid's coordinates.
struct Leaf {
  BodyPtr body;  // or else the half-space behind the plane
  std::shared_ptr<const Plane> plane;
  Box3 box = Box3::everything();
};

void collect(const ShapePtr& shape, const Affine& map, std::vector<Leaf>& leaves, bool& complete) {
  if (const auto* moved = dynamic_cast<const TransformedShape*>(shape.get()))
    return collect(moved->original(), map * moved->map(), leaves, complete);
  if (const auto* csg = dynamic_cast<const Csg*>(shape.get())) {
    for (const ShapePtr& operand : csg->operands()) collect(operand, map, leaves, complete);
  } else if (const auto* body = dynamic_cast<const BodyShape*>(shape.get())) {
    Leaf leaf;
    leaf.body = std::make_shared<const Body>(transformed(*body->body(), map));
    leaf.box = bounds(*leaf.body);
    leaves.push_back(std::move(leaf));
  } else if (const auto* half = dynamic_cast<const HalfSpaceShape*>(shape.get())) {
    const Frame& frame = half->frame();
    const Vec3 normal = glm::normalize(glm::cross(map.direction(frame.x), map.direction(frame.y)));
    leaves.push_back({nullptr,
                      std::make_shared<Plane>(frame_from(map.point(frame.origin), normal, map.direction(frame.x))),
                      Box3::everything()});
  } else {
    complete = false;
  }
}

class Lines {
 public:
  explicit Lines(const Csg& solid) : solid_(solid), box_(solid.bounds()), size_(box_.diameter()) {
    for (const ShapePtr& operand : solid.operands()) collect(operand, Affine(), leaves_, result_.complete);
  }

  CsgLines find(const ViewOf& view) {
    add_edges();
    for (size_t k = 0; k < leaves_.size(); ++k)
      if (leaves_[k].body)
        add(silhouette(*leaves_[k].body, view), *leaves_[k].body, nullptr, {static_cast<int>(k)}, false);
    return std::move(result_);
  }

  // Of each leaf, as far as its side of the section is the solid's.
  CsgLines section(const Vec3& origin, const Vec3& normal) {
    const auto plane = std::make_shared<Plane>(frame_about(origin, glm::normalize(normal)));
    for (size_t k = 0; k < leaves_.size(); ++k) {
      const int own = static_cast<int>(k);
      if (leaves_[k].body)
        add(plane_section(*leaves_[k].body, origin, normal), *leaves_[k].body, nullptr, {own}, false);
      else
        add_planes(leaves_[k].plane, plane, {own}, false);
    }
    return std::move(result_);
  }

 private:
  void add_edges() {
    for (size_t k = 0; k < leaves_.size(); ++k) {
      if (!leaves_[k].body) continue;
      const Body& body = *leaves_[k].body;
      for (const Edge& edge : body.edges) {
        if (edge.kind != EdgeKind::regular || !edge.curve) continue;
        CsgLine line{edge.curve, true, {}, {}};
        for (const int c : edge.coedges) {
          const Coedge& coedge = body.coedges[c];
          line.hosts.push_back({body.faces[body.loops[coedge.loop].face].surface, coedge.image});
        }
        add(std::move(line), {static_cast<int>(k)});
      }
      for (size_t m = k + 1; m < leaves_.size(); ++m) add_meeting(static_cast<int>(k), static_cast<int>(m));
    }
    for (size_t k = 0; k < leaves_.size(); ++k)
      for (size_t m = k + 1; m < leaves_.size(); ++m)
        if (!leaves_[k].body) add_meeting(static_cast<int>(m), static_cast<int>(k));
  }

  static bool apart(const Box3& a, const Box3& b) {
    for (int axis = 0; axis < 3; ++axis)
      if (a.lo[axis] > b.hi[axis] || b.lo[axis] > a.hi[axis]) return true;
    return false;
  }

  // Where the boundaries of two leaves meet; the first is a body, or both are half-spaces.
  void add_meeting(int first, int second) {
    const Leaf &a = leaves_[first], &b = leaves_[second];
    if (apart(a.box, b.box)) return;
    if (!a.body) return add_planes(a.plane, b.plane, {first, second}, true);
    try {
      if (b.body)
        add(intersect(*a.body, *b.body), *a.body, b.body.get(), {first, second}, true);
      else
        add(plane_section(*a.body, b.plane->frame().origin, b.plane->frame().z), *a.body, nullptr, {first, second},
            true, b.plane);
    } catch (const std::invalid_argument&) {
      result_.complete = false;
    }
  }

  // The line of two planes within the solid's box.
  void add_planes(const std::shared_ptr<const Plane>& first, const std::shared_ptr<const Plane>& second,
                  const std::vector<int>& own, bool edge) {
    const Frame &a = first->frame(), &b = second->frame();
    const Vec3 along = glm::cross(a.z, b.z);
    const double square = glm::dot(along, along);
    if (!(square > kSmooth * kSmooth) || !box_.bounded()) return;
    // The point of both planes nearest to the box's middle.
    const Vec3 middle = 0.5 * (box_.lo + box_.hi);
    const double da = glm::dot(a.origin - middle, a.z), db = glm::dot(b.origin - middle, b.z);
    const Vec3 through = middle + (da * glm::cross(b.z, along) + db * glm::cross(along, a.z)) / square;
    const Vec3 reach = 0.51 * size_ / std::sqrt(square) * along;
    CsgLine line{std::make_shared<Segment>(through - reach, through + reach), edge, {{first, nullptr}}, {}};
    if (edge) line.hosts.push_back({second, nullptr});
    add(std::move(line), own);
  }

  void add(const BodyContours& contours, const Body& body, const Body* other, const std::vector<int>& own, bool edge,
           const std::shared_ptr<const Plane>& plane = nullptr) {
    if (!contours.complete) result_.complete = false;
    for (const BodyContour& branch : contours.branches)
      for (const BodyContourPart& part : branch.parts) {
        const Interval all = part.contour.curve->domain();
        const auto add_part = [&](const Interval& t) {
          if (!(t.width() > kShortest * all.width())) return;
          CsgLine line;
          line.curve =
              t.width() == all.width() ? part.contour.curve : std::make_shared<CurvePart>(part.contour.curve, t);
          line.edge = edge;
          line.hosts.push_back({body.faces[part.face].surface, part.contour.images[0]});
          if (other && part.other_face >= 0 && part.contour.images.size() > 1)
            line.hosts.push_back({other->faces[part.other_face].surface, part.contour.images[1]});
          if (plane) line.hosts.push_back({plane, nullptr});
          for (const double cusp : part.contour.cusps)
            if (t.contains(cusp)) line.cusps.push_back(cusp);
          add(std::move(line), own);
        };
        add_part({part.t.lo, std::min(part.t.hi, all.hi)});
        if (part.t.hi > all.hi) add_part({all.lo, part.t.hi - all.width()});
      }
  }

  // What of the line is on the solid's boundary. `own`: the leaves on which it lies.
  void add(CsgLine line, const std::vector<int>& own) {
    const Interval domain = line.curve->domain();
    std::vector<double> cuts{domain.lo, domain.hi};
    for (CsgLine::Host& host : line.hosts)
      if (host.image) host.image = contour_approximation(line.curve, *host.surface, host.image);
    line.curve = contour_approximation(line.curve);
    const Box3 box = bounds(*line.curve);
    for (size_t k = 0; k < leaves_.size(); ++k) {
      if (std::find(own.begin(), own.end(), static_cast<int>(k)) != own.end() || apart(leaves_[k].box, box)) continue;
      const auto meet = [&](const Surface& surface) {
        const SurfaceMeetings meetings = intersect(*line.curve, surface);
        for (const SurfaceMeeting& one : meetings.points) cuts.push_back(one.t);
        for (const Interval& on : meetings.on_surface) cuts.push_back(on.lo), cuts.push_back(on.hi);
      };
      if (leaves_[k].plane) meet(*leaves_[k].plane);
      if (leaves_[k].body)
        for (const Face& face : leaves_[k].body->faces) meet(*face.surface);
    }
    std::sort(cuts.begin(), cuts.end());
    // Stretches that follow one another on the boundary are one line.
    double from = 0;
    bool on = false;
    for (size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (cuts[i + 1] - cuts[i] <= kShortest * domain.width()) continue;
      const bool here = is_on_boundary(line, 0.5 * (cuts[i] + cuts[i + 1]));
      if (here && !on) from = cuts[i];
      if (!here && on) put(line, {from, cuts[i]});
      on = here;
    }
    if (on) put(line, {from, domain.hi});
  }

  void put(const CsgLine& line, const Interval& t) {
    CsgLine part = line;
    if (t.width() < line.curve->domain().width()) part.curve = std::make_shared<CurvePart>(line.curve, t);
    std::erase_if(part.hosts, [](const CsgLine::Host& host) { return !host.image; });
    std::erase_if(part.cusps, [&](double cusp) { return !t.contains(cusp); });
    result_.lines.push_back(std::move(part));
  }

  static Vec3 normal_of(const CsgLine::Host& host, double t) {
    if (!host.image) return host.surface->normal(0, 0);
    const Vec3 uv = host.image->point(t);
    return host.surface->normal(uv.x, uv.y);
  }

  bool is_on_boundary(const CsgLine& line, double t) const {
    const Vec3 p = line.curve->point(t);
    if (line.hosts.empty()) return false;
    const Vec3 first = normal_of(line.hosts[0], t);
    const Vec3 second = line.hosts.size() > 1 ? normal_of(line.hosts[1], t) : first;
    const double e = kAside * size_;
    if (glm::length(glm::cross(first, second)) < kSmooth)
      return !line.edge && is_inside(p + e * first) != is_inside(p - e * first);
    const bool pp = is_inside(p + e * first + e * second), pm = is_inside(p + e * first - e * second),
               mp = is_inside(p - e * first + e * second), mm = is_inside(p - e * first - e * second);
    const bool by_first = pp == pm && mp == mm, by_second = pp == mp && pm == mm;
    return !by_first && !by_second;
  }

  bool is_inside(const Vec3& p) const {
    std::vector<SurfaceHit> hits;
    const Line line{p, kProbe};
    solid_.all_hits(line, {0, kInfinity}, hits);
    // Beyond all hits a line is inside of what reaches to infinity there.
    const bool at_infinity = solid_.begins_inside({p, -kProbe});
    return (hits.size() % 2 == 1) != at_infinity;
  }

  const Csg& solid_;
  Box3 box_;
  double size_;
  std::vector<Leaf> leaves_;
  CsgLines result_;
};

}  // namespace

CsgLines csg_lines(const Csg& solid, const ViewOf& view) { return Lines(solid).find(view); }

CsgLines csg_section(const Csg& solid, const Vec3& origin, const Vec3& normal) {
  return Lines(solid).section(origin, normal);
}

}  // namespace lekalo::geometry
