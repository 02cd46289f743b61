// The control point of a cubic spline about the knot t_i, of its value, slope m and second derivative M there, is
//   b_i = f_i + (h_i - h_{i-1})/3 m - h_{i-1} h_i / 6 M,   b_{i+-1} alike  (Zavyalov et al. 1985, 89),
// h_i = t_{i+1} - t_i. Estimates of three neighbours for m, and for M (order 4) or 0 in its place (order 2), make a
// spline near the points. Beyond the ends steps go on as the last one.
//
// Of many noisy points the values at coarse knots T_j are those of the parabolas nearest to the points between T_{j-1}
// and T_{j+1} (the same, II.5, problem 7a).
#include "geometry/curves/interpolation/local_spline.h"

#include <fmt/format.h>

#include <Eigen/QR>

#include "geometry/curves/interpolation/fit_curve.h"
#include "geometry/curves/interpolation/lagrange_curve.h"
#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/curves/interpolation/smoothing_spline.h"

namespace lekalo::geometry {

namespace {

Vec3 inner_control_point(const PointSequence& data, int i, int order) {
  const double before = data.step(i - 1), after = data.step(i), both = before + after;
  const Vec3 slope = after / both * data.slope(i - 1) + before / both * data.slope(i);
  const Vec3 second = order == 2 ? Vec3(0) : 2.0 / both * (data.slope(i) - data.slope(i - 1));
  return data.point(i) + (after - before) / 3 * slope - before * after / 6 * second;
}

// Value, slope and second derivative at the first (or last) of four points, by the cubic through them.
CurveJet end_jet(const PointSequence& data, int first, double at) {
  return lagrange_curve(data.points.subspan(first, 4), data.parameters.subspan(first, 4)).evaluate(at, 2);
}

// The outermost control point b0 where the curve shall go through the end point f: there the B-spline about the point
// beyond has the value 1/6, that about the next point, whose coefficient is b2, the value h^2 / (2h (2h + next step)),
// that about the end itself the rest (Zavyalov et al. 1985, table 2).
Vec3 interpolating_end(const Vec3& f, const Vec3& b1, const Vec3& b2, double step, double next_step) {
  const double inner = step / (2 * (2 * step + next_step)), outer = 1.0 / 6;
  return (f - (1 - inner - outer) * b1 - inner * b2) / outer;
}

std::vector<Vec3> open_control_points(const PointSequence& data, int order) {
  const int last = data.size() - 1;
  std::vector<Vec3> b(data.size() + 2);
  for (int i = 1; i < last; ++i) b[i + 1] = inner_control_point(data, i, order);
  const double h = data.step(0), g = data.step(last - 1);
  if (order == 2) {
    b[1] = data.point(0);
    b[last + 1] = data.point(last);
    b[0] = interpolating_end(data.point(0), b[1], b[2], h, data.step(1));
    b[last + 2] = interpolating_end(data.point(last), b[last + 1], b[last], g, data.step(last - 2));
    return b;
  }
  const CurveJet first = end_jet(data, 0, data.parameter(0)), final = end_jet(data, last - 3, data.parameter(last));
  b[0] = first.d[0] - h * first.d[1] + h * h / 3 * first.d[2];
  b[1] = first.d[0] - h * h / 6 * first.d[2];
  b[last + 1] = final.d[0] - g * g / 6 * final.d[2];
  b[last + 2] = final.d[0] + g * final.d[1] + g * g / 3 * final.d[2];
  return b;
}

NurbsCurve closed_local_spline(const PointSequence& data, int order) {
  std::vector<Vec3> points;
  std::vector<double> knots;
  // Control point j belongs to the knot j + 2 of the axis, which begins at knot 3: the parameter of point j - 1.
  for (int j = 0; j < data.size(); ++j) points.push_back(inner_control_point(data, j - 1, order));
  for (int i = -3; i <= data.size() + 3; ++i) knots.push_back(data.parameter(i));
  return NurbsCurve(SplineAxis(3, std::move(knots), Extension::periodic), points);
}

// Value at t of the parabola nearest to the points from `begin` to before `end`.
Vec3 value_of_parabola(const PointSequence& data, int begin, int end, double t, double scale) {
  Eigen::MatrixX3d powers(end - begin, 3), right(end - begin, 3);
  const Vec3 origin = data.point(begin);
  for (int i = begin; i < end; ++i) {
    const double x = (data.parameter(i) - t) / scale;
    const Vec3 p = data.point(i) - origin;
    powers.row(i - begin) << 1, x, x * x;
    right.row(i - begin) << p.x, p.y, p.z;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> factors(powers);
  const Eigen::Matrix3d solution = factors.solve(right);
  return origin + Vec3(solution(0, 0), solution(0, 1), solution(0, 2));
}

}  // namespace

std::vector<Vec3> local_means(const PointSequence& data, std::span<const double> knots) {
  const int last = static_cast<int>(knots.size()) - 1, count = last + (data.closed ? 0 : 1);
  const double period = knots.back() - knots.front();
  const auto knot = [&](int j) {
    return data.closed && j < 0 ? knots[last + j] - period : knots[std::clamp(j, 0, last)];
  };
  std::vector<Vec3> values;
  int begin = data.closed ? -data.size() : 0;
  const int beyond = data.closed ? 2 * data.size() : data.size();
  for (int j = 0; j < count; ++j) {
    while (begin < beyond && data.parameter(begin) < knot(j - 1)) ++begin;
    int end = begin;
    while (end < beyond && data.parameter(end) <= knot(j + 1)) ++end;
    if (end - begin < 3)
      throw FieldError("spans",
                       fmt::format("a parabola needs 3 points: between t = {} and {} there are {}", knot(j - 1),
                                   knot(j + 1), end - begin),
                       "fewer spans");
    values.push_back(value_of_parabola(data, begin, end, knot(j), knot(j + 1) - knot(j - 1)));
  }
  return values;
}

namespace {

int min_points(int order, bool closed) { return order == 2 || closed ? 3 : 4; }

// Parameters where so many pieces meet, with both ends of the range.
std::vector<double> coarse_knots(const PointSequence& data, int spans, int order) {
  const int values = spans + (data.closed ? 0 : 1), needed = min_points(order, data.closed);
  if (values < needed)
    throw FieldError("spans",
                     fmt::format("{} spans have {} values where they meet; {} are needed", spans, values, needed),
                     "more spans");
  std::vector<double> knots = even_knots(data, spans);
  if (!data.closed) knots.insert(knots.begin(), data.parameters.front());
  knots.push_back(data.parameters.back());
  return knots;
}

}  // namespace

NurbsCurve local_spline(const PointSequence& data, int order) {
  const int needed = min_points(order, data.closed);
  if (data.size() < needed)
    throw FieldError("points", fmt::format("a local spline of order {} needs at least {} points, not {}", order, needed,
                                           data.size()));
  if (data.closed) return closed_local_spline(data, order);
  const int last = data.size() - 1;
  std::vector<double> knots;
  for (int i = 3; i > 0; --i) knots.push_back(data.parameter(0) - i * data.step(0));
  for (int i = 0; i <= last; ++i) knots.push_back(data.parameter(i));
  for (int i = 1; i <= 3; ++i) knots.push_back(data.parameter(last) + i * data.step(last - 1));
  return NurbsCurve(SplineAxis(3, std::move(knots), Extension::tangent), open_control_points(data, order));
}

std::vector<Vec3> smoothed_points(const PointSequence& data, int order, int passes,
                                  std::span<const double> half_widths) {
  if (!half_widths.empty()) check_corridor(half_widths, data.points.size());
  std::vector<Vec3> points(data.points.begin(), data.points.end());
  for (int pass = 0; pass < passes; ++pass) {
    const NurbsCurve curve = local_spline({points, data.parameters, data.closed}, order);
    for (int i = 0; i < data.size(); ++i) {
      points[i] = curve.point(data.parameter(i));
      if (half_widths.empty()) continue;
      const Vec3 limit(half_widths[i]);
      points[i] = glm::clamp(points[i], data.points[i] - limit, data.points[i] + limit);
    }
  }
  return points;
}

TypeDeclaration local_spline_type() {
  return declare(Category::curve, "local_spline",
                 "Cubic spline near points, each piece made of few neighbours; smooths in passes.")
      .example("points: [[0, 0], [1, 2], [3, 3], [4, 0], [6, 1]]")
      .field("points", points().count(3), "points that the curve passes by; those of a closed one are not repeated")
      .field("knots", knots(), kPointKnots, "chord_length")
      .field("closed", boolean(), "smooth over its seam", "false")
      .field(
          "order", choice({"second", "fourth"}),
          "second: smoother than its points, at the ends of open curves through them; fourth: as near as a cubic can "
          "be, exact for points of cubics",
          "fourth")
      .optional("spans", integer().at_least(2),
                "pieces, of about as many of the points each, which the curve then only passes by: in place of points "
                "it takes, where pieces meet, the values of parabolas by least squares through the points of the two "
                "pieces beside")
      .field("passes", integer().between(0, 100000), "how often points are replaced by points of the curve", "0")
      .optional(
          "corridor", numbers(),
          "how far each coordinate of a point may move in passes: one length, or one for each point; with 'spans' "
          "one for each place where pieces meet, ends of an open curve among them")
      .shows({"control_polygon", "knots"})
      .built_by([](const Fields& f) {
        std::vector<Vec3> points = f.points("points");
        const bool closed = f.boolean("closed");
        std::vector<double> parameters = point_parameters(f.knots("knots"), points, closed);
        const int order = f.text("order") == "second" ? 2 : 4;
        if (f.has("spans")) {
          const PointSequence all{points, parameters, closed};
          const std::vector<double> knots = coarse_knots(all, f.integer("spans"), order);
          points = local_means(all, knots);
          parameters = knots;
        }
        std::vector<double> half_widths = f.has("corridor") ? f.numbers("corridor") : std::vector<double>();
        if (half_widths.size() == 1) half_widths.assign(points.size(), half_widths[0]);
        const std::vector<Vec3> smooth =
            smoothed_points({points, parameters, closed}, order, f.integer("passes"), half_widths);
        return local_spline({smooth, parameters, closed}, order);
      });
}

}  // namespace lekalo::geometry
