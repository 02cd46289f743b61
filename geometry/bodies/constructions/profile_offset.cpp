// Segments of lines stay lines and those of circles concentric circles; others are c + d n x c'/|c'|. At a corner the
// offsets of both neighbours are cut, or continued by their own law, where they meet: o_a(s) = o_b(t), by Newton's
// method from the corner.
#include "geometry/bodies/constructions/profile_offset.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/composition.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/circle_of_curve.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/no_longer.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

struct PlaneOffset {
  CurvePtr of;
  Vec3 normal;
  double distance;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const Triple<T> along = curve_at(*of, t, 1);
    return curve_at(*of, t) + no_longer((distance / length(along)) * cross(triple(normal), along), T(distance));
  }
};

// Whether the parameter goes on as the angle of an arc does.
bool runs_evenly(const Curve& curve) {
  constexpr int kSamples = 12;
  const Interval domain = curve.domain();
  const double speed = glm::length(curve.evaluate(domain.lo, 1).d[1]);
  for (int k = 1; k <= kSamples; ++k) {
    const double t = domain.clamp(domain.lo + domain.width() * k / kSamples);
    if (!(std::abs(glm::length(curve.evaluate(t, 1).d[1]) - speed) <= 1e-12 * speed)) return false;
  }
  return true;
}

class Mitre {
 public:
  Mitre(const std::vector<CurvePtr>& segments, const Vec3& normal, double distance, bool closed, const char* field)
      : segments_(segments), normal_(normal), distance_(distance), closed_(closed), field_(field) {}

  std::vector<CurvePtr> build() {
    const size_t count = segments_.size();
    for (const CurvePtr& segment : segments_) ranges_.push_back(segment->domain());
    for (size_t i = closed_ ? 0 : 1; i < count; ++i) meet((i + count - 1) % count, i);
    std::vector<CurvePtr> result;
    for (size_t i = 0; i < count; ++i) result.push_back(offset(i));
    return result;
  }

 private:
  // Point of the offset and its derivative, by the law of the curve beyond its ends too.
  std::array<Vec3, 2> at(size_t i, double t) const {
    const CurveJet c = segments_[i]->evaluate(t, 2);
    const double speed = glm::length(c.d[1]);
    const Vec3 tangent = c.d[1] / speed, left = glm::cross(normal_, tangent);
    const double curvature = glm::dot(c.d[2], left) / (speed * speed);
    return {c.d[0] + distance_ * left, (1 - distance_ * curvature) * c.d[1]};
  }

  void meet(size_t a, size_t b) {
    double s = ranges_[a].hi, t = ranges_[b].lo;
    const double size = std::abs(distance_);
    for (int step = 0; step < 60; ++step) {
      const auto p = at(a, s), q = at(b, t);
      const Vec3 gap = q[0] - p[0];
      if (glm::length(gap) <= 1e-15 * (size + glm::length(p[0]))) break;
      // p' ds - q' dt = gap in the plane.
      const double det = -glm::dot(normal_, glm::cross(p[1], q[1]));
      if (!(std::abs(det) > 1e-12 * glm::length(p[1]) * glm::length(q[1]))) {
        // Neighbours that go on in one direction meet as they are, or never.
        if (glm::length(gap) > 1e-7 * size) throw no_meeting(a, b);
        break;
      }
      s += -glm::dot(normal_, glm::cross(gap, q[1])) / det;
      t += -glm::dot(normal_, glm::cross(gap, p[1])) / det;
    }
    if (!(glm::length(at(a, s)[0] - at(b, t)[0]) <= 1e-9 * size)) throw no_meeting(a, b);
    ranges_[a].hi = s;
    ranges_[b].lo = t;
  }

  FieldError no_meeting(size_t a, size_t b) const {
    return FieldError(field_, fmt::format("the offsets of segments {} and {} of the profile do not meet", a, b),
                      "a smaller distance, or a corner that is rounded");
  }

  CurvePtr offset(size_t i) const {
    const CurvePtr& segment = segments_[i];
    const Interval domain = segment->domain();
    Interval range = ranges_[i];
    // A joint that is smooth moves by rounding alone.
    for (auto [end, own] : {std::pair(&range.lo, domain.lo), std::pair(&range.hi, domain.hi)})
      if (std::abs(*end - own) <= 1e-12 * domain.width()) *end = own;
    if (!(range.width() > 1e-9 * domain.width()))
      throw FieldError(field_, fmt::format("segment {} of the profile vanishes in the offset by {:.6g}", i, distance_),
                       "a smaller distance");
    if (dynamic_cast<const Segment*>(segment.get()))
      return std::make_shared<Segment>(at(i, range.lo)[0], at(i, range.hi)[0]);
    CurvePtr whole = segment;
    if (const auto circle = circle_of(*segment)) {
      const double side = glm::dot(circle->frame().z, normal_) > 0 ? 1 : -1;
      const double factor = 1 - side * distance_ / circle->radius();
      if (!(factor > 1e-9))
        throw FieldError(
            field_,
            fmt::format("the arc of radius {:.6g} (segment {} of the profile) vanishes in the offset by {:.6g}",
                        circle->radius(), i, distance_),
            "a smaller distance, or a larger radius");
      if (range == domain) return transformed(segment, Affine::scaling(Vec3(factor), circle->frame().origin));
      if (runs_evenly(*segment)) {
        // Angles go on beyond the arc.
        const double turn = circle->domain().width() / domain.width();
        const Interval angles((range.lo - domain.lo) * turn, (range.hi - domain.lo) * turn);
        return with_domain(std::make_shared<Circle>(circle->frame(), factor * circle->radius(), angles), domain);
      }
    }
    if (range.lo < domain.lo || range.hi > domain.hi) {
      whole = segment->continued({std::min(range.lo, domain.lo), std::max(range.hi, domain.hi)});
      if (!whole)
        throw FieldError(field_, fmt::format("segment {} of the profile cannot be continued to meet its neighbour", i),
                         "a smooth joint there, or the distance to the other side");
    }
    CurveProperties properties = properties_of(*whole, 1);
    cut_to(properties, range);
    if (range != whole->domain()) properties.period = 0;
    const CurvePtr result =
        std::make_shared<ComposedCurve<PlaneOffset>>(PlaneOffset{whole, normal_, distance_}, std::move(properties));
    for (int k = 0; k <= 32; ++k) {
      const double t = range.lo + range.width() * k / 32;
      if (!(glm::dot(at(i, t)[1], segment->evaluate(t, 1).d[1]) > 0))
        throw FieldError(
            field_,
            fmt::format("the offset by {:.6g} turns back where the profile is curved more, in segment {} at "
                        "t = {:.6g}",
                        distance_, i, t),
            "a smaller distance");
    }
    return range == domain ? result : with_domain(result, domain);
  }

  const std::vector<CurvePtr>& segments_;
  Vec3 normal_;
  double distance_;
  bool closed_;
  const char* field_;
  std::vector<Interval> ranges_;
};

// The normal of a plane curve's plane that has a positive component along the motion.
Vec3 normal_of(const Curve& curve, const Vec3& motion) {
  const Interval domain = curve.domain();
  const Vec3 chord = curve.point(domain.hi) - curve.point(domain.lo);
  Vec3 area(0);
  constexpr int kSamples = 256;
  const Vec3 o = curve.point(domain.lo);
  for (int k = 1; k < kSamples; ++k)
    area += 0.5 * glm::cross(curve.point(domain.lo + domain.width() * k / kSamples) - o,
                             curve.point(domain.lo + domain.width() * (k + 1) / kSamples) - o);
  const double size = bounds(curve).diameter();
  if (glm::length(area) > 1e-9 * size * size) return glm::normalize(glm::dot(area, motion) < 0 ? -area : area);
  const Vec3 direction = glm::normalize(chord), across = motion - glm::dot(motion, direction) * direction;
  return glm::normalize(across);
}

std::vector<CurvePtr> segments_of(const std::vector<CurvePtr>& curves, const char* field) {
  if (curves.size() != 1)
    throw FieldError(field, "a thin wall is made of one open curve", "or leave out the thickness");
  const CurvePtr& curve = curves[0];
  if (!(curve->domain().width() < kInfinity)) throw FieldError(field, "the profile is unbounded", "give it a domain");
  return smooth_segments(curve);
}

}  // namespace

std::vector<CurvePtr> mitred_offset(const std::vector<CurvePtr>& segments, const Vec3& normal, double distance,
                                    bool closed, const char* field) {
  if (distance == 0) return segments;
  return Mitre(segments, normal, distance, closed, field).build();
}

void declare_thickness(TypeDeclaration& type) {
  type.optional("thickness", length().positive(),
                "makes a wall of an open curve: the profile is what lies between it and its offset")
      .field("thickness_side", choice({"left", "right", "both"}),
             "where the wall stands as one runs along the curve, seen against the motion", "both");
}

Profile read_thick_profile(const Fields& f, const char* field, const Vec3& motion) {
  if (!f.has("thickness")) {
    if (f.given("thickness_side"))
      throw FieldError("thickness_side", "there is no wall without a thickness", "leave it out, or give a thickness");
    return read_profile(f, field);
  }
  std::vector<CurvePtr> curves;
  for (const std::any& one : f.references(field)) curves.push_back(std::any_cast<CurvePtr>(one));
  const std::vector<CurvePtr> segments = segments_of(curves, field);
  if (curves[0]->is_closed())
    throw FieldError("thickness", "the profile is closed: a thickness is for open curves",
                     "leave it out, or give the inner curve as a hole");
  const double h = f.number("thickness");
  const std::string& side = f.text("thickness_side");
  const double left = side == "left" ? h : side == "both" ? 0.5 * h : 0.0, right = left - h;
  const Vec3 normal = normal_of(*curves[0], motion);
  std::vector<CurvePtr> loop = mitred_offset(segments, normal, right, false, "thickness");
  std::vector<CurvePtr> back = mitred_offset(segments, normal, left, false, "thickness");
  const auto begin = [](const CurvePtr& c) { return c->point(c->domain().lo); };
  const auto end = [](const CurvePtr& c) { return c->point(c->domain().hi); };
  loop.push_back(std::make_shared<Segment>(end(loop.back()), end(back.back())));
  for (size_t i = back.size(); i-- > 0;) loop.push_back(reversed_curve(back[i]));
  loop.push_back(std::make_shared<Segment>(begin(back.front()), begin(loop.front())));
  try {
    return profile_of({std::make_shared<CompositeCurve>(std::move(loop), true, 1e-9)}, "thickness");
  } catch (const FieldError& error) {
    throw FieldError("thickness", std::string("the wall is no profile: ") + error.what(), "a smaller thickness");
  }
}

}  // namespace lekalo::geometry
