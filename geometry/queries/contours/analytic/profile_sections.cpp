#include "geometry/queries/contours/analytic/profile_sections.h"

#include <algorithm>
#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/curve_parts.h"
#include "geometry/formula.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/queries/intersections/self_intersections.h"
#include "geometry/queries/quadrics/canonical_surface.h"
#include "geometry/surfaces/analytic/parameter_range.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

constexpr double kRounding = 32 * std::numeric_limits<double>::epsilon();
// Planes that are less than this from parallel to a direction, but not within rounding, are the search's.
constexpr double kNearlyParallel = 1e-6;
// Of the size: shorter parts are the search's.
constexpr double kShort = 1e-6;

// linear c(t) + t rate + offset over a part of c.
class AffineImage final : public Curve {
 public:
  AffineImage(CurvePtr of, const Interval& t, const Affine& map, const Vec3& rate = Vec3(0))
      : of_(std::move(of)), t_(t), map_(map), rate_(rate) {}

  Interval domain() const override { return t_; }
  CurveJet evaluate(double t, int order) const override {
    CurveJet jet = of_->evaluate(t, order);
    jet.d[0] = map_.point(jet.d[0]) + t * rate_;
    for (int k = 1; k <= order; ++k) jet.d[k] = map_.direction(jet.d[k]);
    if (order >= 1) jet.d[1] += rate_;
    return jet;
  }
  CurveEnclosure enclose(const Interval& t, int order) const override {
    CurveEnclosure result = TransformedCurve(of_, map_).enclose(t, order);
    result.d[0] = box_of(triple(result.d[0]) + t * triple(rate_));
    if (order >= 1) result.d[1] = box_of(triple(result.d[1]) + triple(rate_));
    return result;
  }
  std::vector<CurvePiece> pieces() const override {
    std::vector<CurvePiece> result;
    for (const Interval& part : parts_of(*of_, t_)) {
      CurvePiece piece;
      piece.domain = part;
      piece.map = {ParameterMap::Kind::affine, part.lo, part.hi};
      result.push_back(piece);
    }
    return result;
  }

 private:
  CurvePtr of_;
  Interval t_;
  Affine map_;
  Vec3 rate_;
};

// p -> (row_x . p + offset.x, row_y . p + offset.y, 0).
Affine functionals(const Vec3& row_x, const Vec3& row_y, const Vec3& offset) {
  return {glm::transpose(Mat3(row_x, row_y, Vec3(0))), offset};
}

bool keeps_angles(const Mat3& m) {
  const Mat3 square = glm::transpose(m) * m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(square[i][j] - (i == j ? square[0][0] : 0)) > kRounding * square[0][0]) return false;
  return true;
}

// The axis of a moved surface of revolution; a mirror turns the other way round.
Frame frame_of(const Axis& axis, const Affine& map) {
  const Vec3 along = glm::normalize(map.direction(axis.along));
  return frame_about(map.point(axis.through), map.determinant() > 0 ? along : -along);
}

// From the axis towards a profile that is plane with it and does not meet it.
std::optional<Vec3> direction_to_profile(const Curve& curve, const Frame& frame, double size) {
  const auto form = curve.as_nurbs();
  if (!form) return std::nullopt;
  Vec3 out(0);
  for (const Vec4& p : form->points) {
    const Vec3 off = Vec3(p) / p.w - frame.origin, across = off - glm::dot(off, frame.z) * frame.z;
    if (glm::length(across) > glm::length(out)) out = across;
  }
  const Vec3 x = glm::normalize(out), side = glm::cross(frame.z, x);
  for (const Vec4& p : form->points) {
    const Vec3 off = Vec3(p) / p.w - frame.origin;
    if (std::abs(glm::dot(off, side)) > kRounding * size) return std::nullopt;
    // On the axis both halves would be one.
    if (!(std::abs(glm::dot(off, x)) > kShort * size)) return std::nullopt;
  }
  return x;
}

// Of a point that turns about the axis; none near to it.
std::shared_ptr<Circle> circle_through(const Vec3& point, const Frame& frame, const Interval& angles, double size) {
  const Vec3 from = point - frame.origin;
  const Vec3 out = from - glm::dot(from, frame.z) * frame.z;
  const double radius = glm::length(out);
  if (!(radius > kShort * size)) return nullptr;
  Frame at;
  at.origin = frame.origin + (from - out);
  at.x = out / radius;
  at.z = frame.z;
  at.y = glm::cross(at.z, at.x);
  return std::make_shared<Circle>(at, radius, angles);
}

// A surface and how it was moved.
struct Moved {
  const Surface* original;
  Affine map;
  explicit Moved(const SurfacePtr& surface) : original(surface.get()) {
    const auto* moved = dynamic_cast<const TransformedSurface*>(original);
    if (!moved) return;
    original = moved->original().get();
    map = moved->map();
  }
};

// The coordinates of a bounded plane.
struct PlaneCoordinates {
  Affine map{Mat3(0.0), Vec3(0)};
  Rectangle domain;
  explicit PlaneCoordinates(const CanonicalSurface& plane) : domain(plane.surface->domain()) {
    const Mat3 rows = glm::transpose(plane.to_local);
    map = functionals(rows[0], rows[1], -(plane.to_local * plane.origin));
    map.offset.z = 0;
  }
  bool holds(const Vec3& p) const {
    const Vec3 q = map.point(p);
    return within(domain.u, q.x) && within(domain.v, q.y);
  }
};

class Section {
 public:
  // `v_range` of the surface.
  Section(const CuttingPlane& plane, const Interval& v_range, double size)
      : plane_(plane), v_range_(v_range), size_(size) {
    height_ = glm::dot(plane.normal, plane.origin);
    if (plane.bounded)
      if (const auto known = canonical(plane.bounded)) coordinates_.emplace(*known);
  }

  bool of(const ExtrusionSurface& surface, const Affine& map) {
    const CurvePtr curve = transformed(surface.curve(), map);
    const Vec3 d = map.direction(surface.along());
    const Rectangle domain = surface.domain();
    const double slope = glm::dot(plane_.normal, d), sine = std::abs(slope) / glm::length(d);
    if (sine <= kRounding)
      return each_intersection(*curve, domain.u, [&](double u, ContourKind kind) {
        const Vec3 from = curve->point(u);
        // The segment's parameter is the share of [v.lo, v.hi].
        const auto line = std::make_shared<Segment>(from + domain.v.lo * d, from + domain.v.hi * d);
        return add_parts(line, line->domain(), Affine(), functionals(Vec3(0), Vec3(0), {u, domain.v.lo, 0}),
                         {0, domain.v.width(), 0}, {}, false, kind);
      });
    if (sine < kNearlyParallel) return false;
    // p - d (n . p - h)/(n . d), and v = (h - n . c)/(n . d).
    const Vec3 n = plane_.normal;
    Mat3 linear(1.0);
    for (int column = 0; column < 3; ++column) linear[column] -= d * (n[column] / slope);
    const Affine along{linear, d * (height_ / slope)};
    const std::vector<Limit> limits{{n, height_ - domain.v.lo * slope}, {n, height_ - domain.v.hi * slope}};
    const bool closed = is_whole(*curve, domain.u);
    return add_parts(curve, domain.u, along, functionals(Vec3(0), -n / slope, {0, height_ / slope, 0}), {1, 0, 0},
                     limits, closed, ContourKind::crossing);
  }

  bool of(const RevolutionSurface& surface, const Affine& map) {
    if (!keeps_angles(map.linear)) return false;
    const CurvePtr curve = transformed(surface.curve(), map);
    const Frame frame = frame_of(surface.axis(), map);
    const Rectangle domain = surface.domain();
    const double cosine = std::abs(glm::dot(plane_.normal, frame.z));
    const double sine = glm::length(glm::cross(plane_.normal, frame.z));
    if (sine <= kRounding)
      return each_intersection(*curve, domain.u, [&](double u, ContourKind kind) {
        const auto circle = circle_through(curve->point(u), frame, domain.v, size_);
        if (!circle) return false;
        return add_parts(circle, domain.v, Affine(), functionals(Vec3(0), Vec3(0), {u, 0, 0}), {0, 1, 0}, {},
                         domain.v.width() >= kTwoPi, kind);
      });
    if (cosine > kRounding || std::abs(height_ - glm::dot(plane_.normal, frame.origin)) > kRounding * size_)
      return false;
    return turned_profiles(curve, frame, domain);
  }

  Contours found;

 private:
  // normal . c(t) = height bounds a part.
  struct Limit {
    Vec3 normal;
    double height;
  };

  static bool is_whole(const Curve& curve, const Interval& t) {
    return curve.period() > 0 && t.width() >= curve.period() * (1 - 1e-15);
  }

  // Where the profile meets the plane.
  template <class Use>
  bool each_intersection(const Curve& curve, const Interval& u, Use&& use) {
    const Plane plane(frame_about(height_ * plane_.normal, plane_.normal));
    const SurfaceIntersections intersections = intersect(curve, plane);
    if (!intersections.on_surface.empty()) return false;
    for (const SurfaceIntersection& intersection : intersections.points) {
      const auto inside = within(u, intersection.t);
      if (!inside) continue;
      if (intersection.contact && intersection.distance > kRounding * size_) return false;
      if (!use(*inside, intersection.contact ? ContourKind::touching : ContourKind::crossing)) return false;
    }
    return true;
  }

  // The profile is plane with the axis: turned into the plane it is the section, on both sides of the axis.
  bool turned_profiles(const CurvePtr& curve, const Frame& frame, const Rectangle& domain) {
    const auto x = direction_to_profile(*curve, frame, size_);
    if (!x) return false;
    const Vec3 side = glm::cross(frame.z, *x);
    const Vec3 target = glm::normalize(glm::cross(plane_.normal, frame.z));
    const double angle = std::atan2(glm::dot(target, side), glm::dot(target, *x));
    for (const double turn : {angle, angle > 0 ? angle - kPi : angle + kPi}) {
      const auto v = angle_within(domain.v, turn);
      if (!v) continue;
      const Affine rotation = Affine::rotation(*v, frame.z, frame.origin);
      if (!add_parts(curve, domain.u, rotation, functionals(Vec3(0), Vec3(0), {0, *v, 0}), {1, 0, 0}, {},
                     is_whole(*curve, domain.u), ContourKind::crossing))
        return false;
    }
    return true;
  }

  // Adds the parts of map(curve) between the limits and inside of the bounded plane; `image` and `rate` give u and v
  // from the curve.
  bool add_parts(const CurvePtr& curve, const Interval& t, const Affine& map, const Affine& image, const Vec3& rate,
                 std::vector<Limit> limits, bool closed, ContourKind kind) {
    if (coordinates_) {
      const Mat3 rows = glm::transpose(coordinates_->map.linear);
      for (int axis = 0; axis < 2; ++axis) {
        // row . (map c) + offset = border.
        const Vec3 row = glm::transpose(map.linear) * rows[axis];
        const double fixed = glm::dot(rows[axis], map.offset) + coordinates_->map.offset[axis];
        const Interval& range = axis == 0 ? coordinates_->domain.u : coordinates_->domain.v;
        for (const double border : {range.lo, range.hi}) limits.push_back({row, border - fixed});
      }
    }
    const auto parts = between(*curve, t, limits, closed, [&](double at) {
      const Vec3 place = image.point(curve->point(at)) + at * rate;
      return within(v_range_, place.y) && (!coordinates_ || coordinates_->holds(map.point(curve->point(at))));
    });
    if (!parts) return false;
    for (const Interval& part : *parts) {
      const bool whole = part.lo == t.lo && part.hi == t.hi;
      Contour branch;
      branch.kind = kind;
      branch.closed = whole && closed;
      branch.curve = whole && part.width() == curve->domain().width() ? transformed(curve, map)
                                                                      : std::make_shared<AffineImage>(curve, part, map);
      branch.images.push_back(std::make_shared<AffineImage>(curve, part, image, rate));
      if (coordinates_) branch.images.push_back(std::make_shared<AffineImage>(curve, part, coordinates_->map * map));
      found.branches.push_back(std::move(branch));
    }
    return true;
  }

  // The parts of t, cut where the limits are met, whose middles are inside.
  template <class Inside>
  std::optional<std::vector<Interval>> between(const Curve& curve, const Interval& t, const std::vector<Limit>& limits,
                                               bool closed, Inside&& inside) const {
    std::vector<double> cuts{t.lo, t.hi};
    for (const Limit& limit : limits) {
      const double length = glm::length(limit.normal);
      if (!(length > kNearlyParallel)) continue;
      const Vec3 n = limit.normal / length;
      const Plane plane(frame_about(limit.height / length * n, n));
      const SurfaceIntersections intersections = intersect(curve, plane);
      for (const SurfaceIntersection& intersection : intersections.points) {
        if (intersection.contact) return std::nullopt;
        if (intersection.t > t.lo && intersection.t < t.hi) cuts.push_back(intersection.t);
      }
      if (!intersections.on_surface.empty()) return std::nullopt;
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<Interval> kept;
    for (size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Interval part{cuts[k], cuts[k + 1]};
      if (!(part.width() > 0) || !inside(part.middle())) continue;
      if (!kept.empty() && kept.back().hi == part.lo)
        kept.back().hi = part.hi;
      else
        kept.push_back(part);
    }
    // A branch over the seam of a closed profile.
    if (closed && kept.size() > 1 && kept.front().lo == t.lo && kept.back().hi == t.hi) return std::nullopt;
    for (const Interval& part : kept)
      if (!(glm::length(curve.point(part.hi) - curve.point(part.middle())) > kShort * size_)) return std::nullopt;
    return kept;
  }

  const CuttingPlane& plane_;
  Interval v_range_;
  double size_, height_ = 0;
  std::optional<PlaneCoordinates> coordinates_;
};

// Where the profile meets itself as it is seen along the extrusion, or in its plane.
class ProfileSelfIntersection {
 public:
  ProfileSelfIntersection(const Curve& flat, double tolerance) : crossings_(self_intersections(flat, tolerance)) {
    found.complete = crossings_.common.empty();
  }

  bool of(const ExtrusionSurface& surface, const Curve& curve, const Vec3& d) {
    const Rectangle domain = surface.domain();
    return each([&](double s, double t, Contour& branch) {
      const double apart = glm::dot(curve.point(s) - curve.point(t), d) / glm::dot(d, d);
      const Interval v = intersect(domain.v, {domain.v.lo - apart, domain.v.hi - apart});
      if (std::abs(std::abs(apart) - domain.v.width()) <= kShort * domain.v.width()) return false;
      if (!(v.width() > 0)) return true;
      const Vec3 from = curve.point(s);
      const auto line = std::make_shared<Segment>(from + v.lo * d, from + v.hi * d);
      add(branch, line, line->domain(), {s, v.lo, 0}, {t, v.lo + apart, 0}, {0, v.width(), 0});
      return true;
    });
  }

  bool of(const RevolutionSurface& surface, const Curve& curve, const Frame& frame, double size) {
    const Interval angles = surface.domain().v;
    return each([&](double s, double t, Contour& branch) {
      const auto circle = circle_through(curve.point(s), frame, angles, size);
      if (!circle) return false;
      branch.closed = angles.width() >= kTwoPi;
      add(branch, circle, angles, {s, 0, 0}, {t, 0, 0}, {0, 1, 0});
      return true;
    });
  }

  Contours found;

 private:
  // Cuspidal edges are left out.
  template <class Use>
  bool each(Use&& use) {
    for (const CurveSelfIntersection& one : crossings_.points) {
      if (one.kind == SelfIntersectionKind::cusp) {
        found.complete = false;
        continue;
      }
      Contour branch;
      branch.kind = one.kind == SelfIntersectionKind::contact ? ContourKind::touching : ContourKind::crossing;
      branch.error = one.distance;
      if (!use(one.s, one.t, branch)) return false;
    }
    found.closed_form = true;
    return true;
  }

  void add(Contour branch, const CurvePtr& curve, const Interval& t, const Vec3& first, const Vec3& second,
           const Vec3& rate) {
    branch.curve = curve;
    for (const Vec3& begin : {first, second})
      branch.images.push_back(std::make_shared<AffineImage>(curve, t, functionals(Vec3(0), Vec3(0), begin), rate));
    found.branches.push_back(std::move(branch));
  }

  CurveSelfIntersections crossings_;
};

}  // namespace

std::optional<Contours> profile_section(const SurfacePtr& surface, const CuttingPlane& plane, double size) {
  const Moved moved(surface);
  Section section(plane, surface->domain().v, size);
  bool known = false;
  if (const auto* extrusion = dynamic_cast<const ExtrusionSurface*>(moved.original))
    known = section.of(*extrusion, moved.map);
  else if (const auto* revolution = dynamic_cast<const RevolutionSurface*>(moved.original))
    known = section.of(*revolution, moved.map);
  if (!known) return std::nullopt;
  return std::move(section.found);
}

std::optional<Contours> profile_self_intersection(const SurfacePtr& surface, double tolerance) {
  const Moved moved(surface);
  const Interval u = surface->domain().u;
  if (const auto* extrusion = dynamic_cast<const ExtrusionSurface*>(moved.original)) {
    const CurvePtr curve = transformed(extrusion->curve(), moved.map);
    const Vec3 d = moved.map.direction(extrusion->along());
    const Frame frame = frame_about(Vec3(0), glm::normalize(d));
    ProfileSelfIntersection lines(AffineImage(curve, u, functionals(frame.x, frame.y, Vec3(0))), tolerance);
    if (lines.of(*extrusion, *curve, d)) return std::move(lines.found);
  } else if (const auto* revolution = dynamic_cast<const RevolutionSurface*>(moved.original)) {
    if (!keeps_angles(moved.map.linear)) return std::nullopt;
    const CurvePtr curve = transformed(revolution->curve(), moved.map);
    const Frame frame = frame_of(revolution->axis(), moved.map);
    const double size = bounds(*surface).diameter();
    const auto out = direction_to_profile(*curve, frame, size);
    if (!out) return std::nullopt;
    const Vec3 offset(-glm::dot(*out, frame.origin), -glm::dot(frame.z, frame.origin), 0);
    ProfileSelfIntersection lines(AffineImage(curve, u, functionals(*out, frame.z, offset)), tolerance);
    if (lines.of(*revolution, *curve, frame, size)) return std::move(lines.found);
  }
  return std::nullopt;
}

}  // namespace lekalo::geometry
