#include "geometry/bodies/local/new_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/local/plane_seams.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/derived/extended.h"

namespace lekalo::geometry {

namespace {

// Normals that differ by less are those of a smooth edge.
constexpr double kSmooth = 1e-6;

constexpr int kSamples = 8;

bool is_line(const Curve& image) {
  const Interval t = image.domain();
  const Vec3 a = image.point(t.lo), b = image.point(t.hi);
  for (int k = 1; k < kSamples; ++k)
    if (glm::length(image.point(t.lo + t.width() * k / kSamples) - (a + (b - a) * (double(k) / kSamples))) >
        1e-12 * glm::length(b - a))
      return false;
  return true;
}

// A surface that goes on beyond its borders as extended_to() continues it, so that what is found there stays on it.
SurfacePtr continued(const SurfacePtr& surface, double size) {
  if (!surface->bounded()) return surface;
  const Rectangle d = surface->domain();
  const Periods periods = surface->periods();
  const auto inflated = [](const Interval& own, double period) {
    return period > 0 ? own : Interval(own.lo - 0.5 * own.width(), own.hi + 0.5 * own.width());
  };
  try {
    const SurfacePtr longer = extended_to(surface, {inflated(d.u, periods.u), inflated(d.v, periods.v)});
    const Rectangle wide = longer->domain();
    for (const Vec2& at : {Vec2(wide.u.lo, d.v.middle()), Vec2(wide.u.hi, d.v.middle()), Vec2(d.u.middle(), wide.v.lo),
                           Vec2(d.u.middle(), wide.v.hi)})
      if (!(glm::length(longer->point(at.x, at.y) - surface->point(at.x, at.y)) <= 1e-12 * size)) return longer;
  } catch (const std::invalid_argument&) {
    // It ends there.
  }
  return surface;
}

}  // namespace

NewFaces::NewFaces(const Body& body, const std::vector<SurfacePtr>& surfaces, const char* field)
    : old_(without_plane_seams(body)), field_(field), size_(bounds(body).diameter()) {
  if (!body.is_closed()) throw FieldError(field_, "the body is open: it has no inside", "a closed body");
  for (size_t f = 0; f < old_.faces.size(); ++f) {
    const SurfacePtr& surface = surfaces[f];
    removed_.push_back(surface == nullptr);
    changed_.push_back(surface != body.faces[f].surface);
    planes_.push_back(surface ? plane_of(surface) : std::nullopt);
    const SurfacePtr plane = planes_[f] ? std::make_shared<Plane>(*planes_[f]) : nullptr;
    supports_.push_back(plane || !surface ? plane : continued(surface, size_));
    plane_ = plane_ && (!surface || planes_[f]);
  }
  for (size_t e = 0; e < old_.edges.size(); ++e) carriers_.push_back(found_carrier(static_cast<int>(e)));
}

Vec2 NewFaces::near(int coedge, bool at_end, bool along_loop) const {
  const int face = face_of(coedge);
  const Coedge& c = use(coedge);
  const Interval t = c.image->domain();
  const bool hi = (c.forward || !along_loop) == at_end;
  if (planes_[face]) return Vec2(planes_[face]->to_local_point(old_.edges[c.edge].curve->point(hi ? t.hi : t.lo)));
  return Vec2(c.image->point(hi ? t.hi : t.lo));
}

SurfaceNear NewFaces::near_surface(const Sector& s) const {
  return {supports_[s.face], planes_[s.face], near(s.out, false)};
}

int NewFaces::found_carrier(int e) const {
  const Edge& edge = old_.edges[e];
  if (edge.kind == EdgeKind::pole || edge.coedges.size() != 2) return -1;
  int a = edge.coedges[0], b = edge.coedges[1];
  if (removed_[face_of(a)] || removed_[face_of(b)]) return -1;
  if (face_of(a) == face_of(b)) return a;
  if (planes_[face_of(a)]) std::swap(a, b);
  if (planes_[face_of(a)]) return -1;
  const Interval t = edge.curve->domain();
  for (int k = 0; k <= 4; ++k) {
    const double at = t.lo + t.width() * k / 4;
    const Vec3 p = use(a).image->point(at), q = use(b).image->point(at);
    const Vec3 m = old_.normal(face_of(a), p.x, p.y), n = old_.normal(face_of(b), q.x, q.y);
    if (!(glm::length(glm::cross(m, n)) < kSmooth && glm::dot(m, n) > 0)) return -1;
    const int other = face_of(b);
    const Vec3 point = supports_[face_of(a)]->point(p.x, p.y);
    const Vec2 at_other = planes_[other] ? Vec2(planes_[other]->to_local_point(point)) : Vec2(q);
    if (distance_from({supports_[other], planes_[other], at_other}, point) > 1e-9 * size_) return -1;
  }
  return a;
}

Vec3 NewFaces::normal_at(const Sector& s) const {
  const Face& face = old_.faces[s.face];
  const Vec2 at = near(s.out, false);
  const Vec3 n =
      planes_[s.face] ? planes_[s.face]->z : supports_[s.face]->normal_sign() * supports_[s.face]->normal(at.x, at.y);
  return outward_side(face) * n;
}

bool NewFaces::is_changed(const Corner& corner) const {
  return std::any_of(corner.sectors.begin(), corner.sectors.end(), [&](const Sector& s) { return changed_[s.face]; });
}

std::string NewFaces::names_of(const Corner& corner) const {
  std::string text;
  std::vector<int> told;
  for (const Sector& s : corner.sectors) {
    if (std::find(told.begin(), told.end(), s.face) != told.end()) continue;
    told.push_back(s.face);
    text += (text.empty() ? "" : ", ") + name_of_face(old_, s.face);
  }
  return text;
}

// A vertex at an end of a smooth edge or seam, where that meets another face; or a pole.
std::optional<Vec3> NewFaces::carried_point(const Corner& corner) const {
  for (const Sector& s : corner.sectors)
    if (old_.edges[use(s.in).edge].kind == EdgeKind::pole) return point_on(s, s.in);
  int best = -1;
  const Sector* other = nullptr;
  double widest = 1e-3;
  std::optional<Vec3> touching;
  for (const Sector& s : corner.sectors) {
    const int carried = carriers_[use(s.in).edge];
    if (carried < 0) continue;
    const int a = face_of(carried), b = face_of(coedge_partner(old_, carried));
    const Sector& of = s.face == a ? s
                                   : *std::find_if(corner.sectors.begin(), corner.sectors.end(),
                                                   [&](const Sector& x) { return x.face == a; });
    if (!touching) touching = point_on(of, s.face == a ? s.in : coedge_partner(old_, s.in), s.face != a);
    for (const Sector& x : corner.sectors) {
      if (x.face == a || x.face == b) continue;
      const double angle = glm::length(glm::cross(normal_at(of), normal_at(x)));
      if (angle > widest) widest = angle, best = s.face == a ? s.in : coedge_partner(old_, s.in), other = &x;
    }
  }
  if (best < 0) return touching;
  const Coedge& c = use(best);
  // Of the carrier's use that ends here.
  const bool arrives =
      std::any_of(corner.sectors.begin(), corner.sectors.end(), [&](const Sector& s) { return s.in == best; });
  const Interval t = c.image->domain();
  return piercing_point(*supports_[face_of(best)], *c.image, c.forward == arrives ? t.hi : t.lo, near_surface(*other),
                        size_);
}

Vec3 NewFaces::point_on(const Sector& s, int coedge, bool at_begin) const {
  const Vec2 at = near(coedge, !at_begin);
  return supports_[s.face]->point(at.x, at.y);
}

std::optional<Vec3> NewFaces::point_of_few_planes(const Corner& corner) const {
  std::vector<const Sector*> distinct;
  for (const Sector& s : corner.sectors) {
    if (!planes_[s.face]) return std::nullopt;
    const Frame& plane = *planes_[s.face];
    const bool known = std::any_of(distinct.begin(), distinct.end(), [&](const Sector* x) {
      const Frame& other = *planes_[x->face];
      return glm::length(glm::cross(plane.z, other.z)) < 1e-9 &&
             std::abs(glm::dot(plane.origin - other.origin, other.z)) < 1e-9 * size_;
    });
    if (!known) distinct.push_back(&s);
  }
  if (distinct.size() == corner.sectors.size()) return std::nullopt;
  if (distinct.size() == 1) return point_on(*distinct[0], distinct[0]->in);
  if (distinct.size() == 2) return nearest_common_point(near_surface(*distinct[0]), near_surface(*distinct[1]), size_);
  if (distinct.size() != 3) return std::nullopt;
  return common_point({near_surface(*distinct[0]), near_surface(*distinct[1]), near_surface(*distinct[2])}, size_);
}

CornerTree NewFaces::tree_of(const Corner& corner) const {
  const size_t count = corner.sectors.size();
  CornerTree one{{}, std::vector<int>(count, 0), {}};
  if (corner.vertex >= 0 && !is_changed(corner)) {
    one.points = {old_.vertices[corner.vertex].point};
    return one;
  }
  std::optional<Vec3> point = carried_point(corner);
  const bool is_carried = point || std::any_of(corner.sectors.begin(), corner.sectors.end(),
                                               [&](const Sector& s) { return carriers_[use(s.in).edge] >= 0; });
  if (!point && !is_carried && corner.vertex >= 0) point = point_of_few_planes(corner);
  if (!point && !is_carried && count == 2)
    point = nearest_common_point(near_surface(corner.sectors[0]), near_surface(corner.sectors[1]), size_);
  if (point) {
    one.points = {*point};
    return one;
  }
  std::vector<SectorSurface> sectors;
  for (const Sector& s : corner.sectors)
    sectors.push_back({s.face, near_surface(s), normal_at(s), old_.vertices[vertex_before(old_, s.in)].point});
  std::optional<CornerTree> tree = is_carried ? std::nullopt : corner_tree(sectors, size_);
  if (!tree)
    throw FieldError(field_, fmt::format("the faces {} do not come together in a corner any more", names_of(corner)),
                     "a smaller change, or one of the neighbours too");
  return *tree;
}

bool NewFaces::may_slide(const Corner& corner) const {
  return corner.vertex >= 0 && corner.sectors.size() == 2 && corner.sectors[0].face != corner.sectors[1].face &&
         std::all_of(corner.sectors.begin(), corner.sectors.end(), [&](const Sector& s) {
           return carriers_[use(s.in).edge] < 0 && old_.edges[use(s.in).edge].kind == EdgeKind::regular;
         });
}

Vec2 NewFaces::near_middle(int face, int edge) const {
  const double middle = old_.edges[edge].curve->domain().middle();
  if (planes_[face]) return Vec2(planes_[face]->to_local_point(old_.edges[edge].curve->point(middle)));
  const std::vector<int>& uses = old_.edges[edge].coedges;
  return Vec2(use(face_of(uses[0]) == face ? uses[0] : uses[1]).image->point(middle));
}

CornerTree NewFaces::tree_along(const Corner& corner, int edge) const {
  const auto on = [&](const Sector& s) {
    return SurfaceNear{supports_[s.face], planes_[s.face], near_middle(s.face, edge)};
  };
  const auto point = nearest_common_point(on(corner.sectors[0]), on(corner.sectors[1]), size_);
  return point ? CornerTree{{*point}, {0, 0}, {}} : tree_of(corner);
}

EdgeSide NewFaces::side_of(int coedge) const {
  const int face = face_of(coedge);
  return {supports_[face], planes_[face], {near(coedge, false, false), near(coedge, true, false)}};
}

std::optional<EdgeCurve> NewFaces::carried_edge(int e, const Vec3& from, const Vec3& to) const {
  const Edge& old = old_.edges[e];
  const int a = carriers_[e], b = coedge_partner(old_, a);
  const bool swapped = a != old.coedges[0];
  std::optional<EdgeCurve> edge;
  if (old_.edges[e].kind == EdgeKind::seam || is_line(*use(a).image))
    edge = parameter_edge({side_of(a), side_of(b)}, from, to, size_);
  if (!edge) {
    const SurfacePtr& surface = supports_[face_of(a)];
    const auto curve = std::make_shared<SurfaceCurve>(surface, use(a).image);
    const Interval t = curve->domain();
    if (glm::length(curve->point(t.lo) - from) > 1e-10 * size_ || glm::length(curve->point(t.hi) - to) > 1e-10 * size_)
      return std::nullopt;
    const int other = face_of(b);
    std::array<Curve2Ptr, 2> images{use(a).image, use(b).image};
    CurvePtr whole = curve;
    if (const auto circle = even_circle(*curve, size_)) {
      whole = circle;
      for (Curve2Ptr& image : images) image = with_domain(image, circle->domain());
    }
    if (planes_[other]) images[1] = image_in(*planes_[other], whole);
    edge = EdgeCurve{whole, images};
  }
  if (swapped) std::swap(edge->images[0], edge->images[1]);
  return edge;
}

}  // namespace lekalo::geometry
