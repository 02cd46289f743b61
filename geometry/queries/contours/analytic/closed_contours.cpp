#include "geometry/queries/contours/analytic/closed_contours.h"

#include <algorithm>
#include <cmath>

#include "geometry/queries/contours/analytic/hippopede.h"
#include "geometry/queries/contours/analytic/profile_sections.h"
#include "geometry/queries/contours/analytic/torus_silhouette.h"
#include "geometry/queries/quadrics/canonical_surface.h"
#include "geometry/queries/quadrics/conic_image.h"
#include "geometry/queries/quadrics/torus_sections.h"

namespace lekalo::geometry {

namespace {

using Kind = CanonicalSurface::Kind;

// Parts of the size: how far a closed form may be from the surfaces, what the search decides instead: parts of conics
// so short that they may be none, crossings so near to an end.
constexpr double kResidual = 1e-14, kShort = 1e-6;
constexpr int kSamples = 32;
constexpr double kRounding = 32 * std::numeric_limits<double>::epsilon();

// Two intersections of the same surfaces.
void append(PlaneIntersection& all, const PlaneIntersection& more) {
  all.conics.insert(all.conics.end(), more.conics.begin(), more.conics.end());
  all.contacts.insert(all.contacts.end(), more.contacts.begin(), more.contacts.end());
  all.crossings.insert(all.crossings.end(), more.crossings.begin(), more.crossings.end());
  all.touching = all.touching || more.touching;
}

// The places of two surfaces, or of a surface and a plane, that meet in conics: coordinates about `middle`.
struct Pair {
  CanonicalSurface a;
  std::optional<CanonicalSurface> b;  // none: an unbounded plane
  PlaneEquation plane;                // then
  Vec3 middle{0};
  SectionScale scale;

  PlaneEquation plane_of(const CanonicalSurface& surface) const {
    const Vec3 n = surface.normal();
    return {n, glm::dot(n, surface.origin - middle)};
  }
  bool b_is_plane() const { return !b || b->kind == Kind::plane; }
  PlaneEquation plane_b() const { return b ? plane_of(*b) : plane; }
};

std::optional<PlaneIntersection> planes(const PlaneEquation& a, const PlaneEquation& b, const SectionScale& scale) {
  const Vec3 along = glm::cross(a.normal, b.normal);
  const double sine2 = glm::dot(along, along);
  PlaneIntersection result;
  constexpr double kUnclear = 10;
  if (std::sqrt(sine2) * scale.size <= kUnclear * scale.tolerance) {
    const double apart = std::abs(a.height - (glm::dot(a.normal, b.normal) > 0 ? b.height : -b.height));
    if (apart <= 2 * kUnclear * scale.tolerance) return std::nullopt;
    return result;
  }
  const Vec3 base = glm::cross(a.height * b.normal - b.height * a.normal, along) / sine2;
  result.conics = {{Conic::Kind::line, base, Vec3(0), along / std::sqrt(sine2)}};
  return result;
}

TorusForm torus_of(const CanonicalSurface& surface, double scale, const Vec3& middle) {
  return {surface.origin - middle, surface.axis(), surface.major / scale, surface.minor / scale};
}

// Planes, spheres, cylinders, cones and tori about the torus's axis.
std::optional<PlaneIntersection> with_torus(const CanonicalSurface& surface, const CanonicalSurface& other,
                                            const Pair& pair) {
  const std::optional<double> scale = surface.scale(), of_other = other.scale();
  if (!scale || !of_other) return std::nullopt;
  const TorusForm torus = torus_of(surface, *scale, pair.middle);
  const Vec3 off = other.origin - surface.origin, axis = other.axis();
  if (other.kind == Kind::ellipsoid)  // a sphere
    return sphere_section(torus, other.origin - pair.middle, 1 / *of_other, pair.scale);
  const double height = glm::dot(off, torus.axis), turn = glm::dot(axis, torus.axis) > 0 ? 1 : -1;
  if (glm::length(glm::cross(axis, torus.axis)) > kRounding ||
      glm::length(off - height * torus.axis) > kRounding * pair.scale.size)
    return std::nullopt;
  if (other.kind == Kind::torus) {
    const CoaxialMeridian circle{false, {other.major / *of_other, height}, other.minor / *of_other};
    return coaxial_section(torus, circle, pair.scale);
  }
  if (other.kind != Kind::cone) return std::nullopt;
  // rho = r + w z/h and, of the other nappe, its negative; z from `height` on.
  const double radius = other.radius / *of_other, slope = turn * other.widening / other.height;
  const double length = std::hypot(1.0, slope);
  PlaneIntersection all;
  for (const double nappe : {1.0, -1.0}) {
    if (nappe < 0 && slope == 0) break;
    const CoaxialMeridian line{true, Vec2(1, -nappe * slope) / length, nappe * (radius - slope * height) / length};
    const auto one = coaxial_section(torus, line, pair.scale);
    if (!one || (one->touching && !all.conics.empty()) || (all.touching && !one->conics.empty())) return std::nullopt;
    append(all, *one);
  }
  return all;
}

// Where conics of one plane cross those of the other: on the planes' common line.
bool add_crossings(const std::vector<Conic>& conics, const PlaneEquation& other, double size,
                   PlaneIntersection& intersection) {
  for (const Conic& conic : conics) {
    const std::vector<double> roots = plane_roots(conic, other.normal, other.height);
    for (size_t k = 0; k < roots.size(); ++k) {
      const Vec3 p = conic.point(roots[k]);
      // They touch each other, or nearly.
      if (k > 0 && glm::length(p - conic.point(roots[k - 1])) < 1e-3 * size) return false;
      intersection.crossings.push_back(p);
    }
  }
  return true;
}

std::optional<PlaneIntersection> quadrics(const CanonicalSurface& a, const CanonicalSurface& b, const Pair& pair,
                                          bool& coincident) {
  const auto first = a.quadric(pair.middle, pair.scale.size), second = b.quadric(pair.middle, pair.scale.size);
  if (!first || !second) return std::nullopt;
  const std::optional<CommonPlanes> common = common_planes(*first, *second, pair.scale);
  if (!common) return std::nullopt;
  PlaneIntersection all;
  coincident = common->coincident;
  std::vector<std::vector<Conic>> conics;
  for (const PlaneEquation& plane : common->planes) {
    const auto one = plane_section(*first, plane, pair.scale);
    if (!one) return std::nullopt;
    // Lines along which the quadrics touch: only where one plane is all.
    if (one->touching && common->planes.size() > 1) return std::nullopt;
    conics.push_back(one->conics);
    append(all, *one);
  }
  all.touching = all.touching || common->touching;
  if (common->planes.size() == 2) {
    // A point of both planes where the first conic is a point or a pair of lines is singular in another way.
    if (!all.contacts.empty() || !all.crossings.empty()) return std::nullopt;
    if (!add_crossings(conics[0], common->planes[1], pair.scale.size, all)) return std::nullopt;
  }
  return all;
}

std::optional<PlaneIntersection> intersection_of(const Pair& pair, bool& coincident) {
  if (pair.b_is_plane()) {
    const PlaneEquation plane = pair.plane_b();
    if (pair.a.kind == Kind::plane) return planes(pair.plane_of(pair.a), plane, pair.scale);
    if (pair.a.kind == Kind::torus) {
      const std::optional<double> scale = pair.a.scale();
      if (!scale) return std::nullopt;
      return plane_section(torus_of(pair.a, *scale, pair.middle), plane, pair.scale);
    }
    const auto quadric = pair.a.quadric(pair.middle, pair.scale.size);
    if (!quadric) return std::nullopt;
    return plane_section(*quadric, plane, pair.scale);
  }
  if (pair.a.kind == Kind::torus) return with_torus(pair.a, *pair.b, pair);
  if (pair.b->kind == Kind::torus) return with_torus(*pair.b, pair.a, pair);
  return quadrics(pair.a, *pair.b, pair, coincident);
}

// Measures how far a branch is from its surfaces, from the plane too if there is one surface only, whose heights count
// from `middle`; false where that is too far.
bool lies_on(Contour& branch, const std::vector<SurfacePtr>& surfaces, const PlaneEquation& plane, const Vec3& middle,
             double size) {
  const Interval t = branch.curve->domain();
  for (int k = 0; k <= kSamples; ++k) {
    const double at = t.lo + t.width() * k / kSamples;
    const Vec3 p = branch.curve->point(at);
    for (size_t s = 0; s < surfaces.size(); ++s) {
      const Vec3 uv = branch.images[s]->point(at);
      branch.error = std::max(branch.error, glm::length(surfaces[s]->point(uv.x, uv.y) - p));
    }
    if (surfaces.size() == 1)
      branch.error = std::max(branch.error, std::abs(glm::dot(plane.normal, p - middle) - plane.height));
  }
  return branch.error <= kResidual * (size + glm::length(middle));
}

// What of the conics lies on both surfaces, with images.
class Cutting {
 public:
  explicit Cutting(const Pair& pair) : pair_(pair) {
    surfaces_.push_back(&pair.a);
    if (pair.b) surfaces_.push_back(&*pair.b);
  }

  // False where the search has to decide.
  bool add(Conic conic, ContourKind kind) {
    conic.origin += pair_.middle;
    const auto parts = inside(conic);
    if (!parts) return false;
    for (const Interval& t : *parts)
      if (!add_branch(conic, t, kind)) return false;
    return true;
  }
  bool add_point(Vec3 point, ContourPointKind kind) {
    point += pair_.middle;
    ContourPoint result;
    result.kind = kind;
    result.point = point;
    std::vector<Vec3> on;
    for (const CanonicalSurface* surface : surfaces_) {
      const auto uv = surface->parameters(point, 2 * pair_.scale.tolerance);
      if (!uv) return true;
      result.parameters.insert(result.parameters.end(), {uv->x, uv->y});
      on.push_back(surface->surface->point(uv->x, uv->y));
    }
    const PlaneEquation plane = pair_.plane;
    result.distance = on.size() == 2 ? glm::length(on[0] - on[1])
                                     : std::abs(glm::dot(plane.normal, on[0] - pair_.middle) - plane.height);
    if (kind == ContourPointKind::crossing && ends_near(point)) return false;
    found_.points.push_back(result);
    return true;
  }
  Contours found() { return std::move(found_); }

 private:
  bool lies_inside(const Vec3& p) const {
    return std::all_of(surfaces_.begin(), surfaces_.end(), [&](const CanonicalSurface* surface) {
      return surface->parameters(p, 1e-10 * pair_.scale.size).has_value();
    });
  }

  // The stretches of a conic inside of both domains; of a line or a hyperbola between its outermost cuts.
  std::optional<std::vector<Interval>> inside(const Conic& conic) const {
    std::vector<double> cuts;
    for (const CanonicalSurface* surface : surfaces_) {
      const Conic local = surface->local(conic);
      for (const auto& [normal, height] : surface->borders())
        for (const double t : plane_roots(local, normal, height)) cuts.push_back(t);
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<Interval> kept;
    if (conic.is_closed()) {
      constexpr double kAnywhere = 1;
      if (cuts.empty()) cuts.push_back(kAnywhere);
      cuts.push_back(cuts.front() + kTwoPi);
    }
    for (size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Interval t{cuts[k], cuts[k + 1]};
      if (!lies_inside(conic.point(t.middle()))) continue;
      if (!kept.empty() && kept.back().hi == t.lo)
        kept.back().hi = t.hi;
      else
        kept.push_back(t);
    }
    if (conic.is_closed() && !kept.empty() && kept.back().hi == cuts.back() && kept.front().lo == cuts.front()) {
      if (kept.size() == 1) return std::vector<Interval>{{0, kTwoPi}};
      kept.front().lo = kept.back().lo - kTwoPi;
      kept.pop_back();
    }
    for (const Interval& t : kept)
      if (glm::length(conic.point(t.lo) - conic.point(t.middle())) < kShort * pair_.scale.size &&
          (!conic.is_closed() || t.width() < kPi))
        return std::nullopt;
    return kept;
  }

  bool add_branch(Conic conic, Interval t, ContourKind kind) {
    if (conic.kind == Conic::Kind::line) {
      // A segment's parameter.
      const Vec3 from = conic.point(t.lo);
      conic.y *= t.width();
      conic.origin = from;
      t = {0, 1};
    }
    Contour branch;
    branch.kind = kind;
    branch.closed = conic.is_closed() && t.width() >= kTwoPi;
    branch.curve = as_curve(conic, t);
    for (const CanonicalSurface* surface : surfaces_) {
      auto image = std::make_shared<ConicImage>(*surface, conic, t);
      if (image->passes_beside_pole()) return false;
      branch.images.push_back(std::move(image));
    }
    std::vector<SurfacePtr> surfaces;
    for (const CanonicalSurface* surface : surfaces_) surfaces.push_back(surface->surface);
    if (!lies_on(branch, surfaces, pair_.plane, pair_.middle, pair_.scale.size)) return false;
    found_.branches.push_back(std::move(branch));
    return true;
  }

  // Near, but not there, as lines end in the apex of a cone.
  bool ends_near(const Vec3& p) const {
    const auto is_near = [&](const Vec3& end) {
      const double apart = glm::length(end - p);
      return apart < kShort * pair_.scale.size && apart > kResidual * (pair_.scale.size + glm::length(p));
    };
    return std::any_of(found_.branches.begin(), found_.branches.end(), [&](const Contour& branch) {
      const Interval t = branch.curve->domain();
      return !branch.closed && (is_near(branch.curve->point(t.lo)) || is_near(branch.curve->point(t.hi)));
    });
  }

  const Pair& pair_;
  std::vector<const CanonicalSurface*> surfaces_;
  Contours found_;
};

// A surface without borders.
bool is_whole(const CanonicalSurface& surface) {
  const Rectangle domain = surface.surface->domain();
  const bool whole_u = domain.u.width() >= kTwoPi, whole_v = domain.v.width() >= kTwoPi;
  return (surface.kind == Kind::ellipsoid && whole_u && domain.v.width() >= kPi) ||
         (surface.kind == Kind::torus && surface.major > surface.minor && whole_u && whole_v);
}

bool is_round_cylinder(const CanonicalSurface& surface) {
  return surface.kind == Kind::cone && surface.widening == 0 && surface.scale() &&
         surface.surface->domain().u.width() >= kTwoPi;
}

// What cylinders about one axis with one radius have in common ends in circles, where one of them ends; it may be one
// circle.
std::optional<Contours> same_cylinder(const Pair& pair) {
  if (!is_round_cylinder(pair.a) || !is_round_cylinder(*pair.b)) return std::nullopt;
  const Vec3 axis = pair.a.axis(), base = pair.a.origin - pair.middle;
  const auto heights = [&](const CanonicalSurface& surface) {
    const Interval v = surface.surface->domain().v;
    const auto at = [&](double v) {
      const Vec3 center = glm::inverse(surface.to_local) * Vec3(0, 0, surface.height * v);
      return glm::dot(axis, surface.origin + center - pair.middle);
    };
    return hull(Interval(at(v.lo)), Interval(at(v.hi)));
  };
  const Interval of_a = heights(pair.a), of_b = heights(*pair.b);
  const double size = pair.scale.size + glm::length(pair.middle);
  for (const double end : {of_a.lo, of_a.hi})
    for (const double other : {of_b.lo, of_b.hi})
      if (const double apart = std::abs(end - other); apart > kRounding * size && apart < kShort * size)
        return std::nullopt;
  const double from = std::max(of_a.lo, of_b.lo), to = std::min(of_a.hi, of_b.hi);
  const bool touching = std::abs(to - from) <= kRounding * size;
  Cutting cutting(pair);
  const Mat3 around = glm::inverse(pair.a.to_local) * pair.a.radius;
  const auto add_circle = [&](double height, ContourKind kind) {
    return cutting.add({Conic::Kind::ellipse, base + (height - glm::dot(axis, base)) * axis, around[0], around[1]},
                       kind);
  };
  if (touching ? !add_circle(from, ContourKind::touching)
               : from < to && !(add_circle(from, ContourKind::border) && add_circle(to, ContourKind::border)))
    return std::nullopt;
  Contours all = cutting.found();
  all.coincident = from < to && !touching;
  all.closed_form = true;
  return all;
}

std::optional<Contours> closed_form(const Pair& pair) {
  bool coincident = false;
  const std::optional<PlaneIntersection> intersection = intersection_of(pair, coincident);
  if (!intersection) return std::nullopt;
  if (coincident) {
    if (!pair.b) return std::nullopt;
    // Closed surfaces that are the same have no borders; those of other regions are the search's, but of cylinders.
    if (!is_whole(pair.a) || !is_whole(*pair.b)) return same_cylinder(pair);
    Contours all;
    all.coincident = all.closed_form = true;
    return all;
  }
  Cutting cutting(pair);
  const ContourKind kind = intersection->touching ? ContourKind::touching : ContourKind::crossing;
  for (const Conic& conic : intersection->conics)
    if (!cutting.add(conic, kind)) return std::nullopt;
  for (const Vec3& point : intersection->contacts)
    if (!cutting.add_point(point, ContourPointKind::contact)) return std::nullopt;
  for (const Vec3& point : intersection->crossings)
    if (!cutting.add_point(point, ContourPointKind::crossing)) return std::nullopt;
  Contours found = cutting.found();
  found.closed_form = true;
  return found;
}

}  // namespace

namespace {

// Of a surface that is no canonical one.
std::optional<Contours> profile_form(const SurfacePtr& surface, const CuttingPlane& plane, const Box3& box) {
  auto found = profile_section(surface, plane, box.diameter());
  if (!found) return std::nullopt;
  std::vector<SurfacePtr> surfaces{surface};
  if (plane.bounded) surfaces.push_back(plane.bounded);
  const PlaneEquation equation{plane.normal, glm::dot(plane.normal, plane.origin - box.center())};
  for (Contour& branch : found->branches)
    if (!lies_on(branch, surfaces, equation, box.center(), box.diameter())) return std::nullopt;
  found->closed_form = true;
  return found;
}

// Of surfaces that meet in no conics.
std::optional<Contours> hippopede_form(const Pair& pair) {
  auto found = pair.b ? hippopede(pair.a, *pair.b, pair.scale.size)
                      : hippopede_section(pair.a, pair.middle + pair.plane.height * pair.plane.normal,
                                          pair.plane.normal, pair.scale.size);
  if (!found) return std::nullopt;
  std::vector<SurfacePtr> surfaces{pair.a.surface};
  if (pair.b) surfaces.push_back(pair.b->surface);
  for (Contour& branch : found->branches)
    if (!lies_on(branch, surfaces, pair.plane, pair.middle, pair.scale.size)) return std::nullopt;
  return found;
}

void swap_surfaces(Contours& found) {
  for (Contour& branch : found.branches) std::swap(branch.images[0], branch.images[1]);
  for (ContourPoint& point : found.points)
    std::rotate(point.parameters.begin(), point.parameters.begin() + 2, point.parameters.end());
}

}  // namespace

std::optional<Contours> closed_intersection(const SurfacePtr& a, const SurfacePtr& b, double tolerance) {
  const auto of_a = canonical(a), of_b = canonical(b);
  const bool a_is_plane = of_a && of_a->kind == Kind::plane, b_is_plane = of_b && of_b->kind == Kind::plane;
  if (!(of_a && of_b) && !a_is_plane && !b_is_plane) return std::nullopt;
  Box3 box = bounds(*a);
  box.include(bounds(*b));
  // The plane is the second.
  const bool swap = a_is_plane && !b_is_plane;
  std::optional<Contours> found;
  if (of_a && of_b) {
    const Pair pair{swap ? *of_b : *of_a, swap ? *of_a : *of_b, {}, box.center(), {box.diameter(), tolerance}};
    found = closed_form(pair);
    if (!found) found = hippopede_form(pair);
  } else {
    const CanonicalSurface& plane = swap ? *of_a : *of_b;
    found = profile_form(swap ? b : a, {plane.origin, plane.normal(), plane.surface}, box);
  }
  if (found && swap) swap_surfaces(*found);
  return found;
}

std::optional<Contours> closed_section(const SurfacePtr& surface, const Vec3& origin, const Vec3& normal,
                                       double tolerance) {
  const Box3 box = bounds(*surface);
  const auto first = canonical(surface);
  if (!first) return profile_form(surface, {origin, normal, nullptr}, box);
  const PlaneEquation plane{normal, glm::dot(normal, origin - box.center())};
  const Pair pair{*first, std::nullopt, plane, box.center(), {box.diameter(), tolerance}};
  auto found = closed_form(pair);
  return found ? found : hippopede_form(pair);
}

// Where (a p + b) . i = 0 for the line of sight i; of an eye, i = p - e, with the surface's own p . a p + 2 b . p + c =
// 0: (a e + b) . p + b . e + c = 0.
std::optional<Contours> closed_silhouette(const SurfacePtr& surface, const ViewOf& view, double tolerance) {
  const auto known = canonical(surface);
  if (!known) return std::nullopt;
  if (known->kind == Kind::torus) return torus_silhouette(*known, view);
  const Box3 box = bounds(*surface);
  const auto form = known->quadric(box.center(), box.diameter());
  if (!form) return std::nullopt;
  const Vec3 from = view.central ? view.direction_or_eye - box.center() : view.direction_or_eye;
  const Vec3 normal = view.central ? form->a * from + form->b : form->a * from;
  const double height = view.central ? -(glm::dot(form->b, from) + form->c) : -glm::dot(form->b, from);
  // Far from the surface the plane is ill known: the search tells that there is none, or finds it.
  const double length = glm::length(normal);
  if (!(std::abs(height) <= length * box.diameter())) return std::nullopt;
  const PlaneEquation plane{normal / length, height / length};
  auto found = closed_form({*known, std::nullopt, plane, box.center(), {box.diameter(), tolerance}});
  if (found && !found->points.empty()) return std::nullopt;
  return found;
}

}  // namespace lekalo::geometry
