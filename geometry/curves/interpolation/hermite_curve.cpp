// r(t) = a0 p_i + a1 p_{i+1} + h (b0 q_i + b1 q_{i+1}),  w = (t - t_i) / h, h = t_{i+1} - t_i   (Golovanov
// 2016, 2.3.10)
//   a0 = 1 - 3w^2 + 2w^3, a1 = 3w^2 - 2w^3, b0 = w - 2w^2 + w^3, b1 = -w^2 + w^3
//
// As a B-spline curve with double knots it has two control points beside each point, p_i -+ h q_i / 3 (2.14.3).
//
// With second derivatives a_i too the pieces are of degree 5 and the knots triple. The control points of t_i are values
// of its polar form at (t_i, t_i, t_i, x, y), with x and y of t_{i-1} and t_{i+1}:
//   p_i + q_i / 5 ((x - t_i) + (y - t_i)) + a_i / 20 (x - t_i) (y - t_i)
#include "geometry/curves/interpolation/hermite_curve.h"

#include <fmt/format.h>

#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/curves/interpolation/spline_curve.h"

namespace lekalo::geometry {

NurbsCurve hermite_curve(const PointSequence& data, std::span<const Vec3> tangents) {
  const int count = data.size(), last = count - 1;
  if (static_cast<int>(tangents.size()) != count)
    throw FieldError("tangents", fmt::format("{} points need {} tangents, not {}", count, count, tangents.size()),
                     "tangents_at gives those of some points, and 'estimate' the others");
  const auto before = [&](int i) { return data.point(i) - data.step(i - 1) / 3 * tangents[i]; };
  const auto after = [&](int i) { return data.point(i) + data.step(i) / 3 * tangents[i]; };
  std::vector<Vec3> points;
  std::vector<double> knots;
  if (data.closed) {
    for (int i = 0; i < count; ++i) points.insert(points.end(), {before(i), after(i)});
    for (int i = -1; i <= count + 2; ++i) knots.insert(knots.end(), 2, data.parameter(i));
    knots.pop_back();
    return NurbsCurve(SplineAxis(3, std::move(knots), Extension::periodic), points);
  }
  for (int i = 0; i <= last; ++i) {
    points.push_back(i == 0 ? data.point(0) : before(i));
    points.push_back(i == last ? data.point(last) : after(i));
    knots.insert(knots.end(), i == 0 || i == last ? 4 : 2, data.parameter(i));
  }
  return NurbsCurve(SplineAxis(3, std::move(knots), Extension::tangent), points);
}

NurbsCurve hermite_curve(const PointSequence& data, std::span<const Vec3> tangents, std::span<const Vec3> second) {
  const int count = data.size(), last = count - 1;
  for (const auto& [field, given] :
       {std::pair("tangents", tangents.size()), std::pair("second_derivatives", second.size())})
    if (static_cast<int>(given) != count)
      throw FieldError(field, fmt::format("{} points need as many vectors, not {}", count, given));
  std::vector<Vec3> points;
  std::vector<double> knots;
  for (int i = 0; i <= last; ++i) {
    const double before = !data.closed && i == 0 ? 0 : -data.step(i - 1),
                 after = !data.closed && i == last ? 0 : data.step(i);
    for (const auto& [x, y] : {std::pair(before, before), std::pair(before, after), std::pair(after, after)})
      points.push_back(data.point(i) + (x + y) / 5 * tangents[static_cast<size_t>(i)] +
                       x * y / 20 * second[static_cast<size_t>(i)]);
  }
  if (data.closed) {
    for (int i = -1; i <= count + 2; ++i) knots.insert(knots.end(), 3, data.parameter(i));
    knots.pop_back();
    return NurbsCurve(SplineAxis(5, std::move(knots), Extension::periodic), points);
  }
  for (int i = 0; i <= last; ++i) knots.insert(knots.end(), i == 0 || i == last ? 6 : 3, data.parameter(i));
  return NurbsCurve(SplineAxis(5, std::move(knots), Extension::tangent), points);
}

namespace {

std::vector<Vec3> unit_directions(const std::vector<Vec3>& vectors, int points) {
  if (static_cast<int>(vectors.size()) != points)
    throw FieldError("directions", fmt::format("{} points need {} directions, not {}", points, points, vectors.size()),
                     "one for each point, in their order");
  std::vector<Vec3> result;
  for (size_t i = 0; i < vectors.size(); ++i) {
    if (vectors[i] == Vec3(0))
      throw FieldError("directions", fmt::format("the vector of point {} is zero", i),
                       "give it a direction, of any length");
    result.push_back(glm::normalize(vectors[i]));
  }
  return result;
}

std::vector<Vec3> with_speeds(const PointSequence& data, std::vector<Vec3> directions, const std::string& rule) {
  const std::vector<double> speeds = rule == "least_energy" ? min_energy_speeds(data, directions) : local_speeds(data);
  for (int i = 0; i < data.size(); ++i) {
    if (!(speeds[i] > 0))
      throw FieldError("speeds", fmt::format("at point {} the derivative would not go along its direction", i),
                       "a direction should be less than 60 degrees away from the chords beside it");
    directions[i] *= speeds[i];
  }
  return directions;
}

std::vector<Vec3> tangents_of(const Fields& f, const PointSequence& data) {
  if (f.has("tangents") && f.has("directions"))
    throw FieldError("directions", "tangents say directions already", "leave one of them out");
  std::vector<Vec3> tangents =
      f.has("tangents")     ? f.points("tangents")
      : f.has("directions") ? with_speeds(data, unit_directions(f.points("directions"), data.size()), f.text("speeds"))
                            : estimated_tangents(f.text("estimate"), data);
  const std::vector<PointTangent> given = point_tangents(f, "tangents_at");
  check_tangents(given, data.size(), "tangents_at");
  for (const PointTangent& one : given)
    if (one.point < static_cast<int>(tangents.size())) tangents[one.point] = one.tangent;
  return tangents;
}

}  // namespace

TypeDeclaration hermite_curve_type() {
  return declare(Category::curve, "hermite_curve",
                 "Cubic pieces through points with given or estimated tangents, of class C1; with second derivatives "
                 "pieces "
                 "of degree 5, of class C2.")
      .example("points: [[0, 0], [1, 2], [3, 3], [4, 0], [6, 1]]")
      .field("points", points().count(2), "points of the curve; those of a closed one are not repeated")
      .field("knots", knots(), kPointKnots, "chord_length")
      .field("closed", boolean(), "smooth over its seam", "false")
      .optional("tangents", points(), "derivatives by t, one for each point")
      .optional("directions", points(), "vectors along the tangents, one for each point; their lengths do not count")
      .field("speeds", choice({"local", "least_energy"}),
             "lengths of the derivatives along `directions`: by the chords beside each point, or those of the smallest "
             "integral of the squared second derivative",
             "local")
      .field(
          "estimate", choice(tangent_estimates()),
          "derivatives where none are given: of the polynomial through two to five neighbours (bessel: three, with "
          "no second derivative at the ends), of a secant, by Akima, monotone in each coordinate, or along the circle "
          "through three or by five neighbours",
          "bessel")
      .optional("tangents_at", point_tangents(), "derivatives given at some points")
      .optional("second_derivatives", points(), "second derivatives by t, one for each point")
      .shows({"control_polygon", "knots", "de_boor"})
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& points = f.points("points");
        const bool closed = f.boolean("closed");
        const std::vector<double> parameters = point_parameters(f.knots("knots"), points, closed);
        const PointSequence data{points, parameters, closed};
        const std::vector<Vec3> tangents = tangents_of(f, data);
        if (f.has("second_derivatives")) return hermite_curve(data, tangents, f.points("second_derivatives"));
        return hermite_curve(data, tangents);
      });
}

}  // namespace lekalo::geometry
