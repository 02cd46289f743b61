#include "geometry/curves/analytic/line_arc_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/analytic/polyline.h"

namespace lekalo::geometry {

namespace {

// Of lengths and angles: what is left of decimals in a file.
constexpr double kRounding = 1e-12;

// A side between two corners, and a corner between two sides.
struct Corner {
  Vec3 point, in, out;  // unit directions
  double turn = 0;      // angle between them
  double radius = 0;
  double tangent_length() const { return radius * std::tan(0.5 * turn); }
};

double turn_between(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

// Six digits, not above x.
std::string rounded_down(double x) {
  const std::string text = fmt::format("{:.6g}", x);
  return std::stod(text) <= x * (1 + kRounding) ? text : fmt::format("{:.6g}", x * (1 - 2e-6));
}

std::vector<Vec3> directions(std::span<const Vec3> points, bool closed) {
  std::vector<Vec3> result;
  const size_t sides = closed ? points.size() : points.size() - 1;
  for (size_t i = 0; i < sides; ++i) {
    const Vec3 side = points[(i + 1) % points.size()] - points[i];
    if (!(glm::length(side) > 0))
      throw FieldError("points", fmt::format("points {} and {} coincide", i, (i + 1) % points.size()),
                       "leave one of them out");
    result.push_back(glm::normalize(side));
  }
  return result;
}

std::vector<Corner> corners_of(std::span<const Vec3> points, std::span<const double> radii, bool closed,
                               const std::string& radius_field) {
  const std::vector<Vec3> along = directions(points, closed);
  std::vector<Corner> corners;
  for (size_t i = 0; i < points.size(); ++i) {
    Corner corner{points[i], Vec3(0), Vec3(0)};
    if (closed || (i > 0 && i + 1 < points.size())) {
      corner.in = along[(i + along.size() - 1) % along.size()];
      corner.out = along[i];
      corner.turn = turn_between(corner.in, corner.out);
      corner.radius = corner.turn > kRounding ? radii[i] : 0;
    }
    if (corner.radius > 0 && corner.turn > kPi - 1e-9)
      throw FieldError("points", fmt::format("at point {} the path turns right back: no arc can round that", i),
                       fmt::format("move point {}, or give it the {} 0", i, radius_field));
    corners.push_back(corner);
  }
  return corners;
}

// Both roundings of a side must find room on it.
void check_room(const std::vector<Corner>& corners, bool closed, const std::string& radius_field) {
  const size_t sides = closed ? corners.size() : corners.size() - 1;
  double radius = 0;
  for (const Corner& c : corners) radius = std::max(radius, c.radius);
  const bool equal =
      std::all_of(corners.begin(), corners.end(), [&](const Corner& c) { return c.radius == 0 || c.radius == radius; });
  double largest = kInfinity;  // factor of all radii
  size_t tightest = 0;
  for (size_t i = 0; i < sides; ++i) {
    const Corner &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double taken = a.tangent_length() + b.tangent_length();
    const double room = glm::length(b.point - a.point) / taken;
    if (taken > 0 && room < largest) largest = room, tightest = i;
  }
  if (!(largest < 1 - kRounding)) return;
  const Corner &a = corners[tightest], &b = corners[(tightest + 1) % corners.size()];
  const std::string side =
      fmt::format("the side from point {} to point {}, of length {:.6g}, has no room for its rounded corners", tightest,
                  (tightest + 1) % corners.size(), glm::length(b.point - a.point));
  if (equal)
    throw FieldError(radius_field, side,
                     fmt::format("the largest radius that fits is {}", rounded_down(largest * radius)));
  throw FieldError(radius_field, side,
                   fmt::format("radii {} times as large, {} and {}, fit there", rounded_down(largest),
                               rounded_down(largest * a.radius), rounded_down(largest * b.radius)));
}

void round_corner(LineArcPath& path, const Corner& c) {
  if (c.radius == 0) return path.line_to(c.point);
  const Vec3 normal = glm::normalize(glm::cross(c.in, c.out));
  const Vec3 begin = c.point - c.tangent_length() * c.in;
  path.line_to(begin);
  path.arc_to(begin + c.radius * glm::cross(normal, c.in), normal, c.turn, c.point + c.tangent_length() * c.out);
}

}  // namespace

void LineArcPath::line_to(const Vec3& point) {
  if (!(glm::length(point - end_) > kRounding * size_)) return;
  segments_.push_back({{end_, 1}, {0.5 * (end_ + point), 1}, {point, 1}});
  breaks_.push_back(breaks_.back() + 1);
  end_ = point;
}

void LineArcPath::arc_to(const Vec3& center, const Vec3& normal, double angle, const Vec3& point) {
  const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / (0.5 * kPi) - 1e-9)));
  const Vec3 from = end_ - center;
  const auto turned = [&](double by) { return std::cos(by) * from + std::sin(by) * glm::cross(normal, from); };
  const double weight = std::cos(0.5 * angle / parts), first = breaks_.back();
  for (int k = 0; k < parts; ++k) {
    // w p = w c + (p - c) w, of which the latter has the length of the radius.
    const Vec3 middle = weight * center + turned(angle * (k + 0.5) / parts);
    const Vec3 to = k + 1 == parts ? point : center + turned(angle * (k + 1) / parts);
    segments_.push_back({{end_, 1}, {middle, weight}, {to, 1}});
    breaks_.push_back(first + static_cast<double>(k + 1) / parts);
    end_ = to;
  }
  has_arcs_ = true;
}

NurbsCurve LineArcPath::curve(bool closed) const {
  if (has_arcs_) return closed ? closed_bezier_chain(segments_, breaks_) : NurbsCurve(bezier_chain(segments_, breaks_));
  std::vector<Vec3> points{start_};
  for (const BezierSegment& segment : segments_) points.push_back(Vec3(segment.back()));
  if (closed) points.pop_back();
  return polyline(points, closed);
}

NurbsCurve rounded_path(std::span<const Vec3> points, std::span<const double> radii, bool closed,
                        const std::string& radius_field) {
  if (points.size() < (closed ? 3u : 2u))
    throw FieldError("points",
                     fmt::format("{} points are too few: at least {} are needed", points.size(), closed ? 3 : 2));
  const std::vector<Corner> corners = corners_of(points, radii, closed, radius_field);
  check_room(corners, closed, radius_field);
  const Corner& first = corners.front();
  Box3 box;
  for (const Vec3& point : points) box.include(point);
  LineArcPath path(first.point + (closed ? first.tangent_length() : 0) * first.out, box.diameter());
  for (size_t i = 1; i < corners.size(); ++i) round_corner(path, corners[i]);
  if (closed) round_corner(path, first);
  return path.curve(closed);
}

TypeDeclaration& declare_corner_radii(TypeDeclaration& type) {
  return type
      .field("corner_radius", length().non_negative(), "of the arcs that round the corners; 0 leaves them sharp", "0")
      .optional("corner_radii", numbers().at_least(0), "one radius for each corner instead");
}

std::vector<double> read_corner_radii(const Fields& f, size_t corners) {
  if (!f.has("corner_radii")) return std::vector<double>(corners, f.number("corner_radius"));
  if (f.given("corner_radius"))
    throw FieldError("corner_radii", "'corner_radius' and 'corner_radii' say the same", "leave one of them out");
  const std::vector<double>& radii = f.numbers("corner_radii");
  if (radii.size() != corners)
    throw FieldError("corner_radii", fmt::format("{} radii for {} corners", radii.size(), corners),
                     "give one for each, 0 for a sharp corner");
  return radii;
}

NurbsCurve rounded_polygon(const Fields& f, std::span<const Vec3> corners) {
  return rounded_path(corners, read_corner_radii(f, corners.size()), true,
                      f.has("corner_radii") ? "corner_radii" : "corner_radius");
}

}  // namespace lekalo::geometry
