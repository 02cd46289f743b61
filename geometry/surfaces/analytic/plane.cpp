// Plane and rectangle. A line o + t d hits it at t = (p - o).z / d.z, formed again from the line's point near the hit
// so that a distant origin costs no figures; u and v are the coordinates of that point.
#include "geometry/surfaces/analytic/plane.h"

#include <cmath>

#include "geometry/describe.h"
#include "geometry/formula.h"
#include "geometry/numerics/instruction_sets.h"
#include "geometry/surfaces/analytic/local_line.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {

const DomainRules kRules{{Interval::entire(), Interval::entire()}, false, false};

// A bound on the length that needs no root.
double taxicab(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

}  // namespace

Plane::Plane(const Frame& frame, const Rectangle& domain)
    : frame_(frame),
      domain_(domain),
      whole_(domain.u.lo == -kInfinity && domain.u.hi == kInfinity && domain.v.lo == -kInfinity &&
             domain.v.hi == kInfinity),
      distance_(taxicab(frame.origin)) {
  check_domain(domain, kRules);
}

bool Plane::bounded() const {
  return domain_.u.lo > -kInfinity && domain_.u.hi < kInfinity && domain_.v.lo > -kInfinity && domain_.v.hi < kInfinity;
}

SurfaceJet Plane::evaluate(double u, double v, int order) const {
  SurfaceJet jet(order);
  jet.d(0, 0) = frame_.origin + (u * frame_.x + v * frame_.y);
  if (order >= 1) {
    jet.d(1, 0) = frame_.x;
    jet.d(0, 1) = frame_.y;
  }
  return jet;
}

FootPoint Plane::foot_point(const Vec3& near) const {
  return {near - glm::dot(near - frame_.origin, frame_.z) * frame_.z, normal_sign() * frame_.z};
}

SurfaceEnclosure Plane::enclose(const Rectangle& box, int order) const {
  return enclose_surface_formula(
      [this](const auto& u, const auto& v) {
        return triple(frame_.origin) + (u * triple(frame_.x) + v * triple(frame_.y));
      },
      box, order);
}

std::optional<NurbsSurfaceForm> Plane::as_nurbs() const {
  if (!bounded()) return std::nullopt;
  NurbsSurfaceForm form;
  form.knots_u = {domain_.u.lo, domain_.u.lo, domain_.u.hi, domain_.u.hi};
  form.knots_v = {domain_.v.lo, domain_.v.lo, domain_.v.hi, domain_.v.hi};
  for (const double u : {domain_.u.lo, domain_.u.hi})
    for (const double v : {domain_.v.lo, domain_.v.hi}) form.points.push_back({point(u, v), 1});
  return form;
}

LEKALO_FUSED void Plane::meet_line(const Line& line, const Interval& range, LineHits& hits) const {
  const double speed = glm::dot(line.direction, frame_.z), length = taxicab(line.direction);
  constexpr double kParallel = 4 * std::numeric_limits<double>::epsilon();
  if (std::abs(speed) <= kParallel * length) return;
  const double inverse = 1 / speed;
  const double rough = glm::dot(frame_.origin - line.origin, frame_.z) * inverse;
  if (!range.contains(rough)) {
    // Behind the origin of a ray or beyond its end, and clearly so?
    const double slack = 2e-15 * (std::abs(rough) * length + distance_ + taxicab(line.origin)) * std::abs(inverse);
    if (rough < range.lo - slack || rough > range.hi + slack) return;
  }
  // Anew from the rough hit.
  const Vec3 from = fused_at(line, rough) - frame_.origin;
  const double s = -glm::dot(from, frame_.z) * inverse;
  const double t = rough + s;
  if (!range.contains(t)) return;
  if (whole_ && !hits.wants_parameters()) {
    hits.add({t, 0, 0});
    return;
  }
  const double along_x = glm::dot(line.direction, frame_.x), along_y = glm::dot(line.direction, frame_.y);
  const double x = glm::dot(from, frame_.x) + s * along_x;
  const double y = glm::dot(from, frame_.y) + s * along_y;
  if (domain_.contains(x, y))
    hits.add({t, x, y});
  else
    add_beside(t, {x, y}, inverse * Vec2(along_x, along_y), taxicab(from), hits);
}

// A hit at t, outside the domain in numbers. `lean`: how far it moves in u and v where the line is moved by a unit of
// length along the normal; `from_origin`: its distance from the frame's origin. (Not inline: what is rare would cost
// all others their registers.)
__attribute__((noinline)) void Plane::add_beside(double t, const Vec2& at, const Vec2& lean, double from_origin,
                                                 LineHits& hits) const {
  if (!bounded()) {
    const auto u = within(domain_.u, at.x), v = within(domain_.v, at.y);
    if (u && v) hits.add({t, *u, *v});
    return;
  }
  // Rounding of a line that the plane hardly turns against moves the hit far along it: through an edge it must meet
  // both faces. Inside is what comes within the rounding of the edge itself, which is the same for both.
  const Vec2 slack = kShallowSlack * (distance_ + from_origin) * glm::sqrt(1.0 + lean * lean);
  const auto u = within(domain_.u, at.x, slack.x), v = within(domain_.v, at.y, slack.y);
  if (u && v) hits.add({t, *u, *v});
}

TypeDeclaration plane_type() {
  return declare(
             Category::surface, "plane",
             "Plane, or a rectangle in it; u and v are lengths along x and y of its frame, the normal is z. Without "
             "a size or domain it is unbounded.")
      .example("size: [3, 2]")
      .field("frame", frame(), "placement: z is the normal", "{}")
      .optional("origin", point(), "origin of the frame, the center of the rectangle; in place of the frame's")
      .optional("size", numbers().count(2, 2).positive(),
                "width along x and height along y of a rectangle about origin")
      .optional("domain", rectangle(), "part of the plane, in place of size: ranges of u and v in scene units")
      .built_by([](const Fields& f) {
        Frame frame = f.frame();
        if (f.has("origin")) frame.origin = f.vec3("origin");
        Rectangle domain = read_domain(f, Plane::kUnbounded, kRules);
        if (f.has("size")) {
          if (f.has("domain")) throw FieldError("size", "a plane has a size or a domain, not both");
          const std::vector<double>& size = f.numbers("size");
          if (!(size[0] > 0 && size[1] > 0)) throw FieldError("size", "width and height must be positive");
          domain = {{-0.5 * size[0], 0.5 * size[0]}, {-0.5 * size[1], 0.5 * size[1]}};
        }
        return Plane(frame, domain);
      });
}

}  // namespace lekalo::geometry
