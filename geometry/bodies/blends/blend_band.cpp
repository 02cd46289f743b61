#include "geometry/bodies/blends/blend_band.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/blends/supports.h"
#include "geometry/describe.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/blends/blend_fields.h"
#include "geometry/surfaces/blends/exact_chamfer.h"
#include "geometry/surfaces/blends/exact_fillet.h"

namespace lekalo::geometry {

namespace {

constexpr double kSliver = 1e-12;  // of a domain: breaks that are nearer are one

const Coedge& coedge_on(const Body& body, const BlendEdge& edge, int side) {
  for (const int c : body.edges[edge.edge].coedges)
    if (body.coedges[c].forward == (side == 1)) return body.coedges[c];
  throw std::logic_error("an edge is used once in each direction");
}

// Of a face's support, seen along r_u x r_v, towards the ball.
double side_of_ball(const Body& body, int face, const SurfacePtr& support, const Vec2& at, bool convex) {
  const Vec3 outward = body.normal(face, at.x, at.y);
  const Vec2 place = foot_place_anywhere(support, body.faces[face].surface->point(at.x, at.y), at);
  const SurfaceJet jet = support->evaluate(place.x, place.y, 1);
  const bool along = glm::dot(glm::cross(jet.du(), jet.dv()), outward) > 0;
  return along == convex ? -1 : 1;
}

// Where a border turned back the sections would cross each other: the contact is beyond a center of curvature.
void require_forward(const Contacts& contacts, const Interval& domain, const std::string& field) {
  constexpr int kPlaces = 32;
  constexpr double kMinPace = 1e-6;  // of the edge's own pace
  Contact last = contacts.at(domain.lo);
  for (int k = 1; k <= kPlaces; ++k) {
    const double t = domain.lo + domain.width() * k / kPlaces;
    const Contact here = contacts.at(contacts.domain().clamp(t));
    const Vec3 along = contacts.law().guide->evaluate(t - 0.5 * domain.width() / kPlaces, 1).d[1];
    const double pace = glm::dot(along, along) * domain.width() / kPlaces;
    for (int side = 0; side < 2; ++side) {
      const Vec3 step = here.points[side] - last.points[side];
      if (glm::dot(step, along) > kMinPace * pace) continue;
      const Vec3& p = here.points[side];
      throw FieldError(field, fmt::format("its border shrinks to a point, or turns back, near [{:.4g}, {:.4g}, {:.4g}]",
                                          p.x, p.y, p.z));
    }
    last = here;
  }
}

// The same surface over another range of one of its parameters.
template <class Made>
std::function<SurfacePtr(const Interval&)> cutter(const Rectangle& domain, bool along_u, Made made) {
  return [domain, along_u, made](const Interval& along) -> SurfacePtr {
    Rectangle part = domain;
    (along_u ? part.u : part.v) = along;
    return made(part);
  };
}

}  // namespace

BlendBand::BlendBand(const Body& body, const BlendEdge& edge, const BlendRule& rule,
                     const std::array<double, 2>& reach) {
  const Edge& old = body.edges[edge.edge];
  BlendLaw law;
  law.kind = rule.kind;
  law.size_field = rule.field.c_str();
  for (int side = 0; side < 2; ++side) {
    const Vec2 at(coedge_on(body, edge, side).image->point(old.curve->domain().middle()));
    law.of[side] = support_of(body.faces[edge.faces[side]].surface);
    law.sides[side] = side_of_ball(body, edge.faces[side], law.of[side], at, edge.convex);
    law.sizes[side] = rule.sizes[(side == 0) == edge.first_is_left ? 1 : 0];
  }
  is_closed_ = old.start == old.end && is_closed_smoothly(*old.curve);
  const Interval domain = old.curve->domain();
  law.guide = is_closed_ ? old.curve : guide_beyond(old.curve, reach);
  law.measured = old.curve;
  law.period = is_closed_ ? domain.width() : 0;
  const double middle = domain.middle();
  const Vec3 p = old.curve->point(middle);
  std::array<Vec2, 2> starts;
  for (int side = 0; side < 2; ++side)
    starts[side] = foot_place_anywhere(law.of[side], p, Vec2(coedge_on(body, edge, side).image->point(middle)));
  const Contacts contacts(std::move(law), middle, starts);
  make(edge, rule, contacts, domain);
}

BlendBand::BlendBand(const Body& body, const BlendEdge& edge, const BlendRule& rule, int side, const CurvePtr& rim,
                     const std::array<Vec3, 2>& contacts) {
  const bool rests = rim != nullptr;
  from_left_ = rests && side == 0;
  BlendLaw law;
  law.kind = rests ? BlendKind::edge : rule.kind;
  law.size_field = rule.field.c_str();
  law.guide = rests ? rim : body.edges[edge.edge].curve;
  std::array<Vec2, 2> starts;
  for (int k = 0; k < 2; ++k) {
    const int of = from_left_ ? 1 - k : k;
    const SurfacePtr& surface = body.faces[edge.faces[of]].surface;
    const Rectangle domain = surface->domain();
    const Vec2 at = foot_place_anywhere(surface, contacts[of], {domain.u.middle(), domain.v.middle()});
    law.of[k] = support_of(surface);
    law.sides[k] = side_of_ball(body, edge.faces[of], law.of[k], at, edge.convex);
    law.sizes[k] = rule.sizes[(of == 0) == edge.first_is_left ? 1 : 0];
    starts[k] = foot_place_anywhere(law.of[k], contacts[of], at);
  }
  const Interval domain = law.guide->domain();
  make(edge, rule, Contacts(std::move(law), domain.lo, starts, true), domain);
}

void BlendBand::make(const BlendEdge& edge, const BlendRule& rule, const Contacts& contacts, const Interval& domain) {
  kind_ = contacts.law().kind;
  if (rule.is_plain_ball()) radius_ = rule.sizes[0](0.0);
  const double small = 1e-9 * domain.width();
  if (contacts.domain().lo > domain.lo + small || contacts.domain().hi < domain.hi - small)
    throw FieldError(rule.field, "the contacts leave the faces' surfaces before the end of the edge");
  require_forward(contacts, contacts.domain().contains(domain) ? domain : contacts.domain(), rule.field);
  is_exact_ = rule.kind == BlendKind::chamfer
                  ? rule.is_constant() && make_exact_chamfer(contacts)
                  : rule.is_plain_ball() && kind_ == BlendKind::ball && make_exact_fillet(contacts);
  if (!is_exact_) make_fitted(contacts, rule);
  const Contact first = contacts.at(contacts.domain().clamp(domain.lo)),
                last = contacts.at(contacts.domain().clamp(domain.hi));
  if (is_closed_)
    ends_ = {range().lo, range().hi};
  else if (is_exact_)
    ends_ = {along_of(first, range().lo), along_of(last, range().hi)};
  else
    ends_ = {domain.lo, domain.hi};
  // Out of the body: against the sum of the normals towards the ball in a convex edge.
  const double s = 0.5 * (ends_[0] + ends_[1]);
  const Contact at = contacts.at(domain.middle());
  const Vec3 out = (edge.convex ? -1.0 : 1.0) * (at.normals[0] + at.normals[1]);
  const SurfaceJet jet = surface_->evaluate(place(s, 0.5).x, place(s, 0.5).y, 1);
  outward_ = glm::dot(glm::cross(jet.du(), jet.dv()), out) > 0 ? 1 : -1;
  to_center_ = edge.convex ? -radius_ : radius_;
}

bool BlendBand::make_exact_fillet(const Contacts& contacts) {
  const auto exact = exact_fillet(contacts);
  if (!exact) return false;
  surface_ = exact;
  if (const auto* torus = dynamic_cast<const TorusSurface*>(exact.get())) {
    along_u_ = true, across_ = torus->domain().v;
    cut_ = cutter(torus->domain(), true,
                  [frame = torus->frame(), a = torus->major_radius(), b = torus->minor_radius()](
                      const Rectangle& part) { return std::make_shared<TorusSurface>(frame, a, b, part); });
  } else {
    const auto& cylinder = dynamic_cast<const CylinderSurface&>(*exact);
    along_u_ = false, across_ = cylinder.domain().u;
    cut_ = cutter(cylinder.domain(), false,
                  [frame = cylinder.frame(), r = cylinder.radius(), h = cylinder.height()](const Rectangle& part) {
                    return std::make_shared<CylinderSurface>(frame, r, h, part);
                  });
  }
  const Interval t = contacts.domain();
  const Contact at = contacts.at(t.lo + 0.25 * t.width()), next = contacts.at(t.lo + 0.26 * t.width());
  const auto z0 = [&](double along) { return along_u_ ? Vec2(along, across_.lo) : Vec2(across_.lo, along); };
  const auto found = foot_place_anywhere(surface_, at.points[0], z0(along_u_ ? surface_->domain().u.middle() : 0.5));
  const SurfaceJet jet = surface_->evaluate(found.x, found.y, 1);
  sign_ = glm::dot(along_u_ ? jet.du() : jet.dv(), next.points[0] - at.points[0]) > 0 ? 1 : -1;
  return true;
}

bool BlendBand::make_exact_chamfer(const Contacts& contacts) {
  const auto exact = exact_chamfer(contacts);
  if (!exact) return false;
  surface_ = exact;
  along_u_ = true, sign_ = 1, across_ = exact->domain().v;
  if (const auto* plane = dynamic_cast<const Plane*>(exact.get())) {
    cut_ = cutter(plane->domain(), true,
                  [frame = plane->frame()](const Rectangle& part) { return std::make_shared<Plane>(frame, part); });
  } else {
    const auto& cone = dynamic_cast<const ConeSurface&>(*exact);
    cut_ = cutter(cone.domain(), true,
                  [frame = cone.frame(), a = cone.radius(), b = cone.top_radius(), h = cone.height()](
                      const Rectangle& part) { return std::make_shared<ConeSurface>(frame, a, b, h, part); });
  }
  return true;
}

void BlendBand::make_fitted(const Contacts& contacts, const BlendRule& rule) {
  const BlendCurves curves = blend_curves(contacts, {rule.weight, false});
  const auto made = [&](auto sections) {
    surface_ = blend_surface(sections, contacts);
    SurfaceProperties properties = blend_properties(contacts, curves);
    properties.periods = surface_->periods();
    cut_ = [sections, properties](const Interval& along) -> SurfacePtr {
      SurfaceProperties part = properties;
      if (along.width() < properties.domain.u.width() * (1 - 1e-12)) part.periods.u = 0;
      part.domain.u = along;
      part.breaks_u = {along.lo};
      // A break as near to an end as rounding puts it is the end: no piece is a sliver.
      const double least = kSliver * properties.domain.u.width();
      for (const double t : properties.breaks_u)
        if (t > along.lo + least && t < along.hi - least) part.breaks_u.push_back(t);
      part.breaks_u.push_back(along.hi);
      return std::make_shared<ComposedSurface<decltype(sections)>>(sections, part);
    };
  };
  if (rule.kind == BlendKind::chamfer)
    made(StraightSections{curves, contacts.law().of});
  else
    made(ConicSections{curves, contacts.law().of, false});
}

double BlendBand::along_of(const Contact& contact, double near) const {
  const auto found = foot_place_anywhere(surface_, contact.points[0], place(near, 0));
  return s_of(found);
}

Interval BlendBand::range() const {
  const Rectangle domain = surface_->domain();
  const Interval along = along_u_ ? domain.u : domain.v;
  return sign_ > 0 ? along : Interval(-along.hi, -along.lo);
}

Vec2 BlendBand::place(double s, double z) const {
  const double x = from_left_ ? 1 - z : z;
  const double along = sign_ * s, across = x == 1 ? across_.hi : across_.lo + x * across_.width();
  return along_u_ ? Vec2(along, across) : Vec2(across, along);
}

double BlendBand::s_of(const Vec2& place) const { return sign_ * (along_u_ ? place.x : place.y); }
double BlendBand::z_of(const Vec2& place) const {
  const double x = ((along_u_ ? place.y : place.x) - across_.lo) / across_.width();
  return from_left_ ? 1 - x : x;
}

BlendBand::Local BlendBand::at(double s, double z) const {
  const Vec2 uv = place(s, z);
  const SurfaceJet jet = surface_->evaluate(uv.x, uv.y, 1);
  const double width = from_left_ ? -across_.width() : across_.width();
  return {jet.point(), sign_ * (along_u_ ? jet.du() : jet.dv()), width * (along_u_ ? jet.dv() : jet.du())};
}

Vec3 BlendBand::outward(double s, double z) const {
  const Vec2 uv = place(s, z);
  const SurfaceJet jet = surface_->evaluate(uv.x, uv.y, 1);
  return outward_ * glm::normalize(glm::cross(jet.du(), jet.dv()));
}

Vec3 BlendBand::center(double s) const { return at(s, 0).point + to_center_ * outward(s, 0); }

double BlendBand::section_at(const Vec3& center, double near) const {
  // The center's way has the derivative of a border of the section, of another length.
  constexpr int kMaxIterations = 50;
  double s = near;
  for (int i = 0; i < kMaxIterations; ++i) {
    const double h = 1e-5 * range().width();
    const Vec3 along = (this->center(s + h) - this->center(s - h)) / (2 * h);
    const double step = glm::dot(center - this->center(s), along) / glm::dot(along, along);
    s += step;
    if (!(std::abs(step) > 1e-15 * (std::abs(s) + range().width()))) break;
  }
  return s;
}

LineOnSurface BlendBand::section(double s, bool from_right) const {
  return line_between(surface_, place(s, from_right ? 0 : 1), place(s, from_right ? 1 : 0));
}

LineOnSurface BlendBand::border(double z, double from, double to) const {
  return line_between(surface_, place(from, z), place(to, z));
}

SurfacePtr BlendBand::cut(const Interval& s) const {
  const Interval all = range(), part(std::max(s.lo, all.lo), std::min(s.hi, all.hi));
  if (part == all) return surface_;
  return cut_(sign_ > 0 ? part : Interval(-part.hi, -part.lo));
}

}  // namespace lekalo::geometry
