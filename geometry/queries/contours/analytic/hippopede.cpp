#include "geometry/queries/contours/analytic/hippopede.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/composition.h"
#include "geometry/surfaces/analytic/parameter_range.h"

namespace lekalo::geometry {

namespace {

constexpr double kTouching = 32 * std::numeric_limits<double>::epsilon();  // of the size
// Of the sphere's radius: cylinders thinner than that, or nearer to the sphere everywhere; poles nearer to the curve.
constexpr double kThin = 1e-3, kBesidePole = 1e-3;
constexpr int kPartsOnSphere = 32;
constexpr double kWhole = 2 * kTwoPi;  // both loops

struct Eight {
  Vec3 center, contact, across, along;  // center + d n, r n, r m, 2 sqrt(r d) a
  template <class T>
  Triple<T> operator()(const T& t) const {
    using std::cos;
    using std::sin;
    return triple(center) + cos(t) * triple(contact) + sin(t) * triple(across) + sin(0.5 * t) * triple(along);
  }
};

struct OnCylinder {
  double u, v, rise;
  template <class T>
  Triple<T> operator()(const T& t) const {
    using std::sin;
    return {u + t, v + rise * sin(0.5 * t), T(0.0)};
  }
};

// By the sphere's inverse formulas; angles go on beyond its domain where they have to.
class OnSphere final : public Curve {
 public:
  // The curve as the unit sphere's.
  OnSphere(const Eight& eight, const Interval& u) : eight_(eight) {
    for (int k = 0; k < kPartsOnSphere; ++k) {
      Part part{{kWhole * k / kPartsOnSphere, kWhole * (k + 1) / kPartsOnSphere}, {1, 0}, 0};
      const Triple<double> q = eight_(part.t.middle());
      const double angle = std::atan2(q.y, q.x);
      part.direction = Vec2(q.x, q.y) / std::hypot(q.x, q.y);
      part.u = k == 0 ? angle_within(u, angle).value_or(angle)
                      : angle + kTwoPi * std::round((parts_.back().u - angle) / kTwoPi);
      parts_.push_back(part);
    }
  }

  Interval domain() const override { return {0, kWhole}; }
  bool is_closed() const override { return false; }
  CurveJet evaluate(double t, int order) const override {
    const int k = std::clamp(static_cast<int>(t / kWhole * kPartsOnSphere), 0, kPartsOnSphere - 1);
    return evaluate_curve_formula([&](const auto& x) { return place(parts_[k], x); }, t, order);
  }
  CurveEnclosure enclose(const Interval& t, int order) const override {
    CurveEnclosure result;
    for (const Part& part : parts_) {
      const Interval common = intersect(part.t, t);
      if (common.empty() || (common.width() == 0 && t.width() > 0)) continue;
      const CurveEnclosure one = enclose_curve_formula([&](const auto& x) { return place(part, x); }, common, order);
      for (int k = 0; k <= order; ++k) result.d[k].include(one.d[k]);
    }
    return result;
  }
  std::vector<CurvePiece> pieces() const override {
    std::vector<CurvePiece> result;
    for (const Part& part : parts_) result.push_back(detail::plain_curve_piece(part.t));
    return result;
  }

 private:
  struct Part {
    Interval t;
    Vec2 direction;  // as seen from the axis at the middle, and u there
    double u;
  };
  template <class T>
  Triple<T> place(const Part& part, const T& t) const {
    using std::atan2;
    using std::hypot;
    const Triple<T> q = eight_(t);
    const T along = part.direction.x * q.x + part.direction.y * q.y,
            across = part.direction.x * q.y - part.direction.y * q.x;
    return {part.u + atan2(across, along), atan2(q.z, hypot(along, across)), T(0.0)};
  }

  Eight eight_;
  std::vector<Part> parts_;
};

bool passes_beside_pole(const Eight& on_unit_sphere) {
  constexpr int kPlaces = 512;
  for (int k = 0; k <= kPlaces; ++k) {
    const Triple<double> q = on_unit_sphere(kWhole * k / kPlaces);
    if (std::hypot(q.x, q.y) < kBesidePole + kWhole / kPlaces) return true;
  }
  return false;
}

CurveProperties smooth(double period) {
  CurveProperties properties;
  properties.domain = {0, kWhole};
  properties.period = period;
  constexpr int kPieces = 8;
  for (int k = 0; k <= kPieces; ++k) properties.breaks.push_back(kWhole * k / kPieces);
  return properties;
}

// Where the branch begins.
void add_contact(Contours& found, const Vec3& point, double distance) {
  ContourPoint contact;
  contact.kind = ContourPointKind::crossing;
  contact.point = point;
  for (const Curve2Ptr& image : found.branches.front().images) {
    const Vec3 at = image->point(0);
    contact.parameters.insert(contact.parameters.end(), {at.x, at.y});
  }
  contact.distance = distance;
  found.points.push_back(contact);
}

// Of a sphere and a cylinder, in either order.
std::optional<Contours> on_cylinder_and_sphere(const CanonicalSurface& a, const CanonicalSurface& b, double size) {
  using Kind = CanonicalSurface::Kind;
  const bool swapped = a.kind == Kind::cone;
  const CanonicalSurface &sphere = swapped ? b : a, &cylinder = swapped ? a : b;
  if (sphere.kind != Kind::ellipsoid || cylinder.kind != Kind::cone || cylinder.widening != 0) return std::nullopt;
  const auto of_sphere = sphere.scale(), of_cylinder = cylinder.scale();
  if (!of_sphere || !of_cylinder) return std::nullopt;
  const Rectangle on_sphere = sphere.surface->domain(), on_cylinder = cylinder.surface->domain();
  if (on_sphere.u.width() < kTwoPi || on_sphere.v.width() < kPi || on_cylinder.u.width() < kTwoPi) return std::nullopt;

  const double radius = 1 / *of_sphere, r = cylinder.radius / *of_cylinder;
  const Mat3 from_local = glm::inverse(cylinder.to_local);
  const Vec3 center = cylinder.local(sphere.origin);  // in q
  const double d = std::hypot(center.x, center.y) / *of_cylinder;
  if (!(std::abs(radius - r - d) <= kTouching * size && std::min(r, d) > kThin * radius)) return std::nullopt;
  const double rise = 2 * std::sqrt(r * d);
  const double angle = std::atan2(-center.y, -center.x), u = angle_within(on_cylinder.u, angle).value_or(angle);
  const Vec3 n = *of_cylinder * (from_local * Vec3(std::cos(angle), std::sin(angle), 0)),
             m = *of_cylinder * (from_local * Vec3(-std::sin(angle), std::cos(angle), 0)),
             axis = *of_cylinder * (from_local * Vec3(0, 0, 1));
  const double v = center.z / cylinder.height, share = *of_cylinder * rise / cylinder.height;
  const Interval reached{v - std::abs(share), v + std::abs(share)};
  const double margin = kThin * std::abs(share);
  if (reached.lo - margin < on_cylinder.v.lo || reached.hi + margin > on_cylinder.v.hi) return std::nullopt;

  const Eight eight{sphere.origin + d * n, r * n, r * m, rise * axis};
  const Eight on_unit_sphere{sphere.local(eight.center), sphere.to_local * eight.contact,
                             sphere.to_local * eight.across, sphere.to_local * eight.along};
  if (passes_beside_pole(on_unit_sphere)) return std::nullopt;
  Contours found;
  found.closed_form = true;
  Contour branch;
  branch.closed = true;
  branch.curve = std::make_shared<ComposedCurve<Eight>>(eight, smooth(kWhole));
  branch.images = {std::make_shared<OnSphere>(on_unit_sphere, on_sphere.u),
                   std::make_shared<ComposedCurve<OnCylinder>>(OnCylinder{u, v, share}, smooth(0))};
  if (swapped) std::swap(branch.images[0], branch.images[1]);
  found.branches.push_back(std::move(branch));
  add_contact(found, sphere.origin + radius * n, std::abs(radius - r - d));
  return found;
}

struct Spiric {
  Vec3 base, across, up;  // center + (R - r) n, sqrt(2 r) m, -r a
  double major, minor;
  template <class T>
  T height(const T& t) const {  // along `across`
    using std::cos;
    using std::sin;
    using std::sqrt;
    return sin(0.5 * t) * sqrt(2 * major - minor - minor * cos(t));
  }
  template <class T>
  Triple<T> operator()(const T& t) const {
    using std::sin;
    return triple(base) + height(t) * triple(across) + sin(t) * triple(up);
  }
};

struct OnTorus {
  Spiric spiric;
  double u, v;
  template <class T>
  Triple<T> operator()(const T& t) const {
    using std::atan2;
    const double inner = spiric.major - spiric.minor;
    return {u + atan2(std::sqrt(2 * spiric.minor) * spiric.height(t), T(inner)), v + t, T(0.0)};
  }
};

// `plane`: the plane, where its own parameters are asked for.
std::optional<Contours> on_torus_and_plane(const CanonicalSurface& torus, const Vec3& origin, const Vec3& normal,
                                           const CanonicalSurface* plane, double size) {
  const auto scale = torus.scale();
  if (torus.kind != CanonicalSurface::Kind::torus || !scale) return std::nullopt;
  const Rectangle on_torus = torus.surface->domain();
  if (on_torus.u.width() < kTwoPi || on_torus.v.width() < kTwoPi) return std::nullopt;
  const double major = torus.major / *scale, minor = torus.minor / *scale;
  const double height = glm::dot(normal, origin - torus.origin);
  const Vec3 local = (height < 0 ? -1.0 : 1.0) * (torus.to_local * normal) / *scale;
  if (!(std::abs(local.z) <= kTouching && std::abs(std::abs(height) - (major - minor)) <= kTouching * size &&
        std::min(minor, major - minor) > kThin * major))
    return std::nullopt;
  const double angle = std::atan2(local.y, local.x), u = angle_within(on_torus.u, angle).value_or(angle),
               v = angle_within(on_torus.v, kPi).value_or(kPi);
  const Mat3 from_local = *scale * glm::inverse(torus.to_local);
  const Vec3 n = from_local * Vec3(std::cos(angle), std::sin(angle), 0),
             m = from_local * Vec3(-std::sin(angle), std::cos(angle), 0), axis = from_local * Vec3(0, 0, 1);
  const Spiric spiric{torus.origin + (major - minor) * n, std::sqrt(2 * minor) * m, -minor * axis, major, minor};

  Contours found;
  found.closed_form = true;
  Contour branch;
  branch.closed = true;
  branch.curve = std::make_shared<ComposedCurve<Spiric>>(spiric, smooth(kWhole));
  branch.images = {std::make_shared<ComposedCurve<OnTorus>>(OnTorus{spiric, u, v}, smooth(0))};
  if (plane) {
    const auto flat = [](const Vec3& q) { return Vec3(q.x, q.y, 0); };
    const Spiric on_plane{flat(plane->local(spiric.base)), flat(plane->to_local * spiric.across),
                          flat(plane->to_local * spiric.up), major, minor};
    const Vec3 reach = std::sqrt(2 * major) * glm::abs(on_plane.across) + glm::abs(on_plane.up);
    const Rectangle domain = plane->surface->domain();
    for (const double side : {-1.0 - kThin, 1.0 + kThin})
      if (const Vec3 corner = on_plane.base + side * reach; !domain.contains(corner.x, corner.y)) return std::nullopt;
    branch.images.push_back(std::make_shared<ComposedCurve<Spiric>>(on_plane, smooth(kWhole)));
  }
  found.branches.push_back(std::move(branch));
  add_contact(found, spiric.base, std::abs(std::abs(height) - (major - minor)));
  return found;
}

}  // namespace

std::optional<Contours> hippopede(const CanonicalSurface& a, const CanonicalSurface& b, double size) {
  if (b.kind == CanonicalSurface::Kind::plane) return on_torus_and_plane(a, b.origin, b.normal(), &b, size);
  return on_cylinder_and_sphere(a, b, size);
}

std::optional<Contours> hippopede_section(const CanonicalSurface& torus, const Vec3& origin, const Vec3& normal,
                                          double size) {
  return on_torus_and_plane(torus, origin, normal, nullptr, size);
}

}  // namespace lekalo::geometry
