#include "geometry/shapes/tube.h"

#include <cmath>

#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

// Unit vector of the first derivative that is not zero; `backward` seen towards smaller t.
Vec3 direction_at(const Curve& curve, double t, bool backward) {
  const CurveJet jet = curve.evaluate(t, 3);
  double largest = 0;
  for (int k = 1; k <= 3; ++k) largest = std::max(largest, glm::length(jet.d[k]));
  for (int k = 1; k <= 3; ++k)
    if (const double length = glm::length(jet.d[k]); length > 1e-9 * largest)
      return (backward && k % 2 == 1 ? -1.0 : 1.0) / length * jet.d[k];
  return {0, 0, 0};
}

// The reference direction carried from one place of a curve to another by two mirrors (Wang et al. 2008, 3): the plane
// between the points, then that between the tangents.
Vec3 carried(const Vec3& reference, const Vec3& tangent, const Vec3& step, const Vec3& next_tangent) {
  const auto mirrored = [](const Vec3& v, const Vec3& normal) {
    const double square = glm::dot(normal, normal);
    return square > 0 ? v - 2 * glm::dot(normal, v) / square * normal : v;
  };
  const Vec3 left = mirrored(reference, step), left_tangent = mirrored(tangent, step);
  const Vec3 result = mirrored(left, next_tangent - left_tangent);
  const Vec3 across = result - glm::dot(result, next_tangent) * next_tangent;
  const double length = glm::length(across);
  return length > 1e-6 ? across / length : frame_about(Vec3(0), next_tangent).x;
}

}  // namespace

Tube::Tube(CurvePtr curve, RadiusLaw radius, Caps caps)
    : sweep_(std::move(curve), std::move(radius)), caps_(sweep_.curve().is_closed() ? Caps::round : caps) {
  std::vector<Box3> boxes;
  for (const BallSweep::Cell& cell : sweep_.cells()) {
    boxes.push_back(cell.box);
    box_.include(cell.box);
  }
  tree_ = BoxTree(boxes);
  center_ = box_.center();
  if (caps_ != Caps::round) find_ends();

  starts_.reserve(boxes.size());
  for (const BallSweep::Cell& cell : sweep_.cells()) {
    const Vec3 point = sweep_.curve().point(cell.t.lo);
    Vec3 tangent = direction_at(sweep_.curve(), cell.t.lo, false);
    if (starts_.empty()) {
      if (tangent == Vec3(0)) tangent = {0, 0, 1};
      starts_.push_back({point, tangent, frame_about(point, tangent).x});
      continue;
    }
    const Start& before = starts_.back();
    if (tangent == Vec3(0)) tangent = before.tangent;
    starts_.push_back({point, tangent, carried(before.reference, before.tangent, point - before.point, tangent)});
  }
}

void Tube::find_ends() {
  const Interval domain = sweep_.curve().domain();
  const auto& cells = sweep_.cells();
  const int count = static_cast<int>(cells.size());
  for (int side = 0; side < 2; ++side) {
    End& end = ends_[side];
    const double t = side == 0 ? domain.lo : domain.hi, forward = side == 0 ? 1 : -1;
    end.point = sweep_.curve().point(t);
    end.inward = direction_at(sweep_.curve(), t, side == 1);
    int reached = 0;
    for (; reached < count; ++reached) {
      const BallSweep::Cell& cell = cells[side == 0 ? reached : count - 1 - reached];
      // The farthest corner of the box behind the plane.
      const Vec3 back = glm::mix(cell.box.hi, cell.box.lo, glm::greaterThan(end.inward, Vec3(0)));
      if (glm::dot(back - end.point, end.inward) >= 0) break;
      if (reached > 0 && !(forward * glm::dot(cell.middle.center[1], end.inward) > 0)) break;
    }
    end.begin = side == 0 ? 0 : count - reached;
    end.end = side == 0 ? reached : count;
  }
}

SpanLimit Tube::limit(int cell, const Line& line) const {
  SpanLimit limit;
  for (int side = 0; side < 2; ++side) {
    const End& end = ends_[side];
    if (cell < end.begin || cell >= end.end) continue;
    const double slope = glm::dot(line.direction, end.inward);
    const double height = glm::dot(line.origin - end.point, end.inward), at = -height / slope;
    if (slope > 0 && at > limit.lo)
      limit.lo = at, limit.face_lo = side + 1;
    else if (slope < 0 && at < limit.hi)
      limit.hi = at, limit.face_hi = side + 1;
    else if (slope == 0 && height < 0)
      limit.hi = -kInfinity;
  }
  return limit;
}

void Tube::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  static thread_local LineSpans spans;  // its room is kept
  spans.clear();
  // A unit direction, and the origin where the line passes the tube.
  const double speed = glm::length(line.direction);
  const double start = glm::dot(center_ - line.origin, line.direction) / (speed * speed);
  const Line near{line.at(start), line.direction / speed};
  tree_.along(line, t, [&](int cell) { sweep_.add_spans(cell, near, limit(cell, near), spans); });
  const auto add = [&](SpanEnd end, bool is_in) {
    if (end.face == 0) sweep_.finish(end, is_in, near);
    const double at = start + end.s / speed;
    if (t.contains(at) && (end.face == 0 || caps_ != Caps::none)) hits.push_back({at, end.u, 0, end.face, end.piece});
  };
  for (const Span& span : spans) {
    add(span.in, true);
    add(span.out, false);
  }
}

bool Tube::holds(const Vec3& p) const {
  static thread_local LineSpans spans;
  spans.clear();
  const Line line{p, glm::normalize(Vec3(0.5377, -0.7391, 0.4057))};  // along which no curve runs, most likely
  tree_.along(line, {-kInfinity, kInfinity}, [&](int cell) { sweep_.add_spans(cell, line, limit(cell, line), spans); });
  return std::any_of(spans.begin(), spans.end(), [](const Span& span) { return span.in.s < 0 && span.out.s > 0; });
}

bool Tube::is_cut_off(const Vec3& p, double t) const {
  if (caps_ == Caps::round) return false;
  const auto& cells = sweep_.cells();
  for (const End& end : ends_)
    if (end.begin < end.end && t >= cells[end.begin].t.lo && t <= cells[end.end - 1].t.hi &&
        glm::dot(p - end.point, end.inward) < 0)
      return true;
  return false;
}

Vec3 Tube::reference(int cell, double t, const Vec3& tangent) const {
  const Start& start = starts_[cell];
  return carried(start.reference, start.tangent, sweep_.curve().point(t) - start.point, tangent);
}

ShapePoint Tube::point(const SurfaceHit& hit, const Vec3& near) const {
  const BallJet ball = sweep_.ball(hit.u);
  const auto& [r, r1, r2] = ball.center;
  const auto& [R, R1, R2] = ball.radius;
  const double rho = glm::length(r1);
  const Vec3 tangent = rho > 0 ? r1 / rho : starts_[hit.piece].tangent;
  const Vec3 x = reference(hit.piece, hit.u, tangent), y = glm::cross(tangent, x);
  ShapePoint at;
  at.u = hit.u;
  at.v = std::atan2(glm::dot(near - r, y), glm::dot(near - r, x));
  if (hit.face != 0) {
    const End& end = ends_[hit.face - 1];
    at.position = near - glm::dot(near - end.point, end.inward) * end.inward;
    at.normal = -end.inward;
    return at;
  }
  at.normal = glm::normalize(near - r);
  at.position = r + R * at.normal;
  at.dv = R * glm::cross(tangent, at.normal);
  // On the wall n = -k T + c m: m turns about the curve no more than it must, m' = -(m . T') T.
  const double k = rho > 0 ? R1 / rho : 0, c = std::sqrt(std::max(0.0, 1 - k * k));
  if (rho > 0 && c > 0 && std::abs(glm::dot(at.normal, tangent) + k) < 1e-6) {
    const Vec3 turn = (r2 - glm::dot(r2, tangent) * tangent) / rho;  // T'
    const double k1 = (R2 - k * glm::dot(r2, tangent)) / rho;
    const Vec3 m = (at.normal + k * tangent) / c;
    const Vec3 n1 = -k1 * tangent - k * turn - k * k1 / c * m - c * glm::dot(m, turn) * tangent;
    at.du = r1 + R1 * at.normal + R * n1;
  }
  return at;
}

TypeDeclaration tube_type() {
  return declare(
             Category::shape, "tube",
             "Round tube about a curve: all that a ball sweeps whose center moves along it. What lies inside, where "
             "it meets itself or bends more than its radius allows, is not seen. Parameters: u is that of the "
             "curve, v the angle about it.")
      .example("of: my_curve, radius: 0.1")
      .field("of", reference({Category::curve}), "the curve in the middle")
      .field("radius", formula({"s"}),
             "radius of the tube, a length or a formula of s, which runs from 0 to 1 with the length of the curve")
      .field("caps", choice({"round", "flat", "none"}),
             "ends of the tube: half a ball, a disk, or open; that of a closed curve has none", "round")
      .built_by([](const Fields& f) -> ShapePtr {
        const CurvePtr of = f.curve("of");
        const Interval domain = of->domain();
        if (!(domain.lo > -kInfinity && domain.hi < kInfinity))
          throw FieldError("of", "the curve is unbounded", "give it a domain");
        const std::string& caps = f.text("caps");
        return std::make_shared<Tube>(of, RadiusLaw(f.get<Expression>("radius"), *of),
                                      caps == "flat"   ? Caps::flat
                                      : caps == "none" ? Caps::none
                                                       : Caps::round);
      });
}

}  // namespace lekalo::geometry
