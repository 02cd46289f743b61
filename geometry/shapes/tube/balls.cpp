#include "geometry/shapes/tube/balls.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/describe.h"
#include "geometry/queries/rays/line_spans.h"

namespace lekalo::geometry {

Balls::Balls(std::span<const Vec3> centers, std::span<const double> radii) {
  if (centers.empty()) throw FieldError("at", "there is no point");
  if (radii.size() != 1 && radii.size() != centers.size())
    throw FieldError("radius", fmt::format("{} radii for {} points", radii.size(), centers.size()),
                     "one for each point, or one for all");
  std::vector<Box3> boxes;
  for (size_t i = 0; i < centers.size(); ++i) {
    const double radius = radii[radii.size() == 1 ? 0 : i];
    if (!(radius > 0 && radius < kInfinity))
      throw FieldError("radius", fmt::format("the radius must be greater than 0, found {}", radius));
    balls_.push_back({centers[i], radius});
    boxes.push_back(box_of(i));
    box_.include(boxes.back());
  }
  tree_ = BoxTree(boxes);
}

void Balls::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  static thread_local LineSpans spans;  // its room is kept
  spans.clear();
  const double speed = glm::length(line.direction);
  const Vec3 d = line.direction / speed;
  tree_.along(line, t, [&](int i) {
    const Vec3 e = balls_[i].center - line.origin;
    const double a = glm::dot(e, d), R = balls_[i].radius;
    const Vec3 across = e - a * d;
    const double g = R * R - glm::dot(across, across);
    if (!(g > 0)) return;
    const double root = std::sqrt(g);
    spans.add({{a - root, 0, i, 0}, {a + root, 0, i, 0}});
  });
  for (const Span& span : spans)
    for (const SpanEnd* end : {&span.in, &span.out})
      if (const double at = end->s / speed; t.contains(at)) hits.push_back({at, 0, 0, 0, end->piece});
}

std::vector<SurfacePart> Balls::surface_parts() const {
  std::vector<SurfacePart> parts;
  for (size_t i = 0; i < balls_.size(); ++i) parts.push_back({box_of(i)});
  return parts;
}

ShapePoint Balls::point(const SurfaceHit& hit, const Vec3& near) const {
  const Ball& ball = balls_[hit.piece];
  ShapePoint at;
  at.normal = glm::normalize(near - ball.center);
  at.position = ball.center + ball.radius * at.normal;
  at.u = std::atan2(at.normal.y, at.normal.x);
  if (at.u < 0) at.u += kTwoPi;
  at.v = std::asin(std::clamp(at.normal.z, -1.0, 1.0));
  const double across = std::hypot(at.normal.x, at.normal.y);
  at.du = ball.radius * Vec3(-at.normal.y, at.normal.x, 0);
  at.dv = across > 0
              ? ball.radius * Vec3(-at.normal.z * at.normal.x / across, -at.normal.z * at.normal.y / across, across)
              : Vec3(0);
  return at;
}

std::optional<Mat3> Balls::shape_operator(const SurfaceHit& hit, const Vec3& near) const {
  const Ball& ball = balls_[hit.piece];
  const Vec3 m = glm::normalize(near - ball.center);
  return (-1 / ball.radius) * (Mat3(1) - glm::outerProduct(m, m));
}

TypeDeclaration balls_type() {
  return declare(Category::shape, "balls",
                 "Balls about points, in one shape: points as things to see. Where they overlap their union is seen.")
      .field("at", points().count(1), "the points")
      .field("radius", numbers().positive(), "one radius for all, or a list with one for each")
      .built_by(
          [](const Fields& f) -> ShapePtr { return std::make_shared<Balls>(f.points("at"), f.numbers("radius")); });
}

}  // namespace lekalo::geometry
