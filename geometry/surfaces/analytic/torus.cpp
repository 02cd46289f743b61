// Torus (Golovanov 2016, 3.2): (sqrt(x^2 + y^2) - R)^2 + z^2 = r^2, N = rho r (cos u cos v, sin u cos v, sin v).
//
// Hits of a line: with g = x^2 + y^2 + z^2 + R^2 - r^2, F = g^2 - 4 R^2 (x^2 + y^2) is a quartic in t whose zeros with
// g >= 0 belong to the ring, horn or apple, those with g <= 0 to the lemon. Where the two sheets meet, at the tips, the
// sign of g is only rounding; but where g = 0 on the line, F <= 0: so each stretch before the first and after the
// second zero of g has an odd number of apple hits, the stretch between an even number of lemon hits, and a hit that
// rounding hides at a tip is put back at the end of its stretch.
#include "geometry/surfaces/analytic/torus.h"

#include "geometry/curves/analytic/conic_forms.h"
#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/polynomial.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {

DomainRules rules(double major, double minor) {
  DomainRules result;
  result.v_is_angle = true;
  if (major < minor) result.limits.v = TorusSurface::full_domain(major, minor).v;
  return result;
}

// At most four crossings in a stretch, increasing; a line that touches does not count.
struct Crossings {
  int count = 0;
  std::array<double, 5> s{};
  void add(double x) {
    int i = count++;
    for (; i > 0 && s[i - 1] > x; --i) s[i] = s[i - 1];
    s[i] = x;
  }
};

// Good enough for the two steps of Newton's iteration on the torus itself that follow.
constexpr double kLastStep = 1e-7;

Crossings crossings(const std::array<double, 5>& quartic, const Interval& stretch,
                    const Interval& wanted = Interval::entire()) {
  Crossings result;
  for (const auto& root : quartic_roots(quartic, stretch, 0, wanted, kLastStep))
    if (!root.tangent) result.add(root.x);
  return result;
}

double value(const std::array<double, 5>& c, double s) {
  return (((c[4] * s + c[3]) * s + c[2]) * s + c[1]) * s + c[0];
}

}  // namespace

Rectangle TorusSurface::full_domain(double major, double minor) {
  if (major >= minor) return {{0, kTwoPi}, {-kPi, kPi}};
  const double v = kPi - std::acos(std::max(-1.0, major / minor));
  return {{0, kTwoPi}, {-v, v}};
}

TorusSurface::TorusSurface(const Frame& frame, double major, double minor, const Rectangle& domain)
    : MeridianFormula(frame, 1, 1, domain), major_(major), minor_(minor) {
  if (!(minor > 0)) throw std::invalid_argument("the minor radius of a torus must be positive");
  if (!(major > -minor)) throw std::invalid_argument("the major radius of a torus must be greater than -minor radius");
  check_domain(domain, rules(major, minor));
  whole_ = covers(domain, full_domain(major, minor));
  if (major == 0) set_quadric({{1, 1, 1}, 0, -1}, Vec3(1 / minor));
}

NurbsCurveForm TorusSurface::meridian_form() const {
  NurbsCurveForm form = circle_form(domain_.v);
  for (Vec4& p : form.points) p = {major_ * p.w + minor_ * p.x, minor_ * p.y, 0, p.w};
  return form;
}

TorusSurface::MeridianTangent TorusSurface::meridian_near(const MeridianPoint<double>& near, double v) const {
  const double out = near.rho - major_, distance = std::sqrt(out * out + near.z * near.z);
  if (distance == 0) return MeridianSurface::meridian_near(near, v);
  const double scale = minor_ / distance;
  return {major_ + scale * out, scale * near.z, -scale * near.z, scale * out};
}

LEKALO_FUSED void TorusSurface::meet_line(const Line& line, const Interval& range, LineHits& hits) const {
  if (major_ == 0) {
    add_quadric_hits(line, range, hits, [](const Vec3& p) {
      return std::optional<double>(std::atan2(p.z, std::sqrt(p.x * p.x + p.y * p.y)));
    });
    return;
  }
  // In units of R + r, the direction a unit vector, s measured from the point nearest to the center.
  const MovedLine moved = local_line(line, frame_.origin);
  const double size = std::abs(major_) + minor_, speed = glm::length(moved.direction);
  const double major = major_ / size, minor = minor_ / size;
  const Vec3 o = moved.origin / size, d = moved.direction / speed;
  const double square = glm::dot(o, o);
  if (!(square <= 1 + 1e-9)) return;
  const double reach = std::sqrt(std::max(0.0, 1 - square)) + 1e-6;

  const double b = glm::dot(o, d), k = square + (major - minor) * (major + minor), four = 4 * major * major;
  const double alpha = d.x * d.x + d.y * d.y, beta = o.x * d.x + o.y * d.y, gamma = o.x * o.x + o.y * o.y;
  const std::array<double, 5> quartic{k * k - four * gamma, 4 * b * k - 2 * four * beta,
                                      4 * b * b + 2 * k - four * alpha, 4 * b, 1};
  constexpr double kLargestStep = 1e-6;
  const double unit = size / speed, room = 4 * kLargestStep + 1e-15 * std::abs(moved.start) / unit;
  // Where a root of the quartic may still become a hit in the range.
  const Interval wanted{(range.lo - moved.start) / unit - room, (range.hi - moved.start) / unit + room};
  // Half the derivative by s of f = (rho - R)^2 + z^2 - r^2, which has less rounding than the quartic, and f.
  const auto half_slope = [&](double s, double& f) {
    const Vec3 p = o + s * d;
    const double rho = std::sqrt(p.x * p.x + p.y * p.y), across = rho - major;
    f = across * across + (p.z - minor) * (p.z + minor);
    return across * (p.x * d.x + p.y * d.y) / rho + p.z * d.z;
  };
  const auto refined = [&](double s) {
    for (int step = 0; step < 2; ++step) {
      double f = 0;
      const double slope = half_slope(s, f), change = -0.5 * f / slope;
      if (!(std::abs(change) <= kLargestStep)) break;
      s += change;
    }
    return s;
  };
  const auto add = [&](double root) {
    if (!wanted.contains(root)) return;
    const double s = refined(root);
    const double t = moved.start + s * unit;
    if (!range.contains(t)) return;
    if (needs_no_parameters(hits)) {
      hits.add({t, 0, 0});
      return;
    }
    const Vec3 p = o + s * d;
    const auto u = angle_within(domain_.u, std::atan2(p.y, p.x));
    const double angle = std::atan2(p.z, std::sqrt(p.x * p.x + p.y * p.y) - major);
    const auto v = angle_within(domain_.v, angle);
    if (u && v) hits.add({t, *u, *v});
  };
  const auto add_all = [&](const Crossings& found) {
    for (int i = 0; i < found.count && !hits.is_enough(); ++i) {
      // Beside a tip Newton's iteration may end twice at one of two crossings, which it cannot tell apart: a line that
      // passes the tip.
      double f = 0;
      const bool close = major < minor && i + 1 < found.count && found.s[i + 1] - found.s[i] < 2 * kLargestStep;
      if (close && half_slope(refined(found.s[i]), f) * half_slope(refined(found.s[i + 1]), f) > 0)
        ++i;
      else
        add(found.s[i]);
    }
  };

  const double discriminant = b * b - k;
  if (major >= minor || !(discriminant > 0)) {  // g >= 0 everywhere: no lemon
    if (!(major > 0)) return;
    // Only in the tube's slab |z| <= r. (Not only in the range: the same hit is the same number whatever the range.)
    constexpr double kRoom = 1e-6;
    Interval stretch{-reach, reach};
    const auto keep = [&](double from, double to) {
      stretch.lo = std::max(stretch.lo, std::min(from, to) - kRoom);
      stretch.hi = std::min(stretch.hi, std::max(from, to) + kRoom);
    };
    if (std::abs(d.z) > 1e-3)
      keep((-minor - o.z) / d.z, (minor - o.z) / d.z);
    else if (std::abs(o.z) > minor + 2 * std::abs(d.z) + kRoom)
      return;
    if (stretch.lo < stretch.hi) add_all(crossings(quartic, stretch, wanted));
    return;
  }
  const double first = -b - std::sqrt(discriminant), second = -b + std::sqrt(discriminant);
  if (major > 0) {
    Crossings before = crossings(quartic, {-reach, first}), after = crossings(quartic, {second, reach});
    if (before.count % 2 == 0) before.add(first);
    if (after.count % 2 == 0) after.add(second);
    add_all(before);
    add_all(after);
  } else {
    Crossings inside = crossings(quartic, {first, second});
    if (inside.count % 2 != 0)
      inside.add(std::abs(value(quartic, first)) < std::abs(value(quartic, second)) ? first : second);
    // From tip to tip along the axis both crossings stand at the ends.
    if (inside.count == 0 && value(quartic, 0.5 * (first + second)) > 0) {
      inside.add(first);
      inside.add(second);
    }
    add_all(inside);
  }
}

TypeDeclaration torus_surface_type() {
  return declare(Category::surface, "torus_surface",
                 "Ring, horn, apple or lemon torus about the axis z of its frame; the normal points away from the "
                 "center line of the tube.")
      .example("major_radius: 2, minor_radius: 0.5")
      .field("frame", frame(), "placement: the center, the axis of symmetry z, x at the angle 0", "{}")
      .field(
          "major_radius", length(),
          "radius R of the center circle: R > minor_radius a ring, equal a horn, smaller an apple (outer sheet), 0 a "
          "sphere, negative a lemon (inner sheet)")
      .field("minor_radius", length().positive(), "radius r of the tube")
      .optional("domain", rectangle(),
                "part of the surface, in radians: u around the axis, v around the tube from its outside; "
                "{ u: [0, 2*pi], v: [-pi, pi] } by default, of apple and lemon the part between the tips")
      .check("major_radius > -minor_radius", "the sheet is empty: major_radius must be greater than -minor_radius")
      .built_by([](const Fields& f) {
        const double major = f.number("major_radius"), minor = f.number("minor_radius");
        if (!(major > -minor)) throw FieldError("major_radius", "must be greater than -minor_radius");
        const Rectangle full = TorusSurface::full_domain(major, minor);
        return TorusSurface(f.frame(), major, minor, read_domain(f, full, rules(major, minor)));
      });
}

}  // namespace lekalo::geometry
