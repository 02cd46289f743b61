// Splines through points (Golovanov 2016, 2.3.7 to 2.3.9, 2.14.1; Zavyalov et al. 1985, I.6, I.8).
//
// r is polynomial of degree p between knots and of class C^(p-1). n points and p - 1 (p even: p) conditions at the ends
// determine it: given derivatives, derivatives that vanish, or knots left out there ("not a knot").
#include "geometry/curves/interpolation/spline_curve.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/curves/interpolation/collocation.h"
#include "geometry/curves/interpolation/point_parameters.h"
#include "geometry/curves/splines/bspline_basis.h"

namespace lekalo::geometry {

namespace {

// Conditions of one end beside its point, and how many knots next to it are left out for those that lack.
struct EndConditions {
  std::vector<SplineCondition> conditions;
  int left_out = 0;
};

void check_end(int degree, const SplineEnd& end, int given) {
  if (given > degree / 2)
    throw FieldError("ends",
                     fmt::format("a spline of degree {} has room for {} derivative{} at an end, not {}", degree,
                                 degree / 2, degree / 2 == 1 ? "" : "s", given),
                     "a higher degree has room for more");
  if (given == degree / 2) return;
  if (end.rule == EndRule::natural && (degree % 2 == 0 || degree > kMaxCurveOrder + 1))
    throw FieldError(
        "ends", fmt::format("natural ends are those of odd degrees up to {}, not of {}", kMaxCurveOrder + 1, degree),
        "ends: not_a_knot");
  if (end.rule == EndRule::parabolic && degree != 3)
    throw FieldError("ends", fmt::format("parabolic ends are those of degree 3, not of {}", degree),
                     "ends: not_a_knot");
}

bool is_parabolic(const EndConditions& end) { return end.conditions.size() == 1 && end.conditions[0].order == 3; }

EndConditions end_conditions(int degree, const SplineEnd& end, double t) {
  EndConditions result;
  std::vector<bool> given(degree + 3, false);
  const auto give = [&](int order, const Vec3& value) {
    result.conditions.push_back({t, order, value});
    given[order] = true;
  };
  if (end.tangent) give(1, *end.tangent);
  if (end.second) give(2, *end.second);
  const int count = static_cast<int>(result.conditions.size());
  check_end(degree, end, count);
  if (end.rule == EndRule::natural) {
    for (int k = 1; k <= degree / 2; ++k)
      if (!given[k] && !given[degree - k]) give(degree - k, Vec3(0));
  } else if (end.rule == EndRule::parabolic && count == 0) {
    give(3, Vec3(0));
  }
  result.left_out = degree / 2 - static_cast<int>(result.conditions.size());
  return result;
}

void check_degree(int degree) {
  if (degree < 1 || degree > kMaxDegree)
    throw FieldError("degree", fmt::format("degree {} is not between 1 and {}", degree, kMaxDegree));
}

// Points and inner tangents, in the order of their parameters.
std::vector<SplineCondition> inner_conditions(std::span<const Vec3> points, std::span<const double> parameters,
                                              std::span<const PointTangent> tangents) {
  std::vector<SplineCondition> result;
  for (size_t i = 0; i < points.size(); ++i) result.push_back({parameters[i], 0, points[i]});
  for (const PointTangent& one : tangents) result.push_back({parameters[one.point], 1, one.tangent});
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  return result;
}

// Knots that belong to the point at t, with the steps before and after it.
void add_knots_of(double t, double before, double after, bool has_tangent, int degree, std::vector<double>& knots) {
  if (degree % 2 == 0) {
    if (has_tangent) knots.push_back(t);
    knots.push_back(t + after / 2);
  } else if (has_tangent) {
    knots.push_back(t - before / 3);
    knots.push_back(t + after / 3);
  } else {
    knots.push_back(t);
  }
}

bool has_tangent(std::span<const PointTangent> tangents, size_t point) {
  return std::any_of(tangents.begin(), tangents.end(), [&](const auto& one) { return one.point == int(point); });
}

// Of an open spline.
std::vector<double> inner_knots(std::span<const double> parameters, int degree,
                                std::span<const PointTangent> tangents) {
  std::vector<double> knots;
  if (degree % 2 == 0) knots.push_back((parameters[0] + parameters[1]) / 2);
  for (size_t i = 1; i + 1 < parameters.size(); ++i)
    add_knots_of(parameters[i], parameters[i] - parameters[i - 1], parameters[i + 1] - parameters[i],
                 has_tangent(tangents, i), degree, knots);
  return knots;
}

SplineEnd with_tangent(SplineEnd end, std::span<const PointTangent> tangents, int point) {
  for (const PointTangent& one : tangents)
    if (one.point == point && end.tangent)
      throw FieldError("tangents", fmt::format("point {} has two tangents", point));
    else if (one.point == point)
      end.tangent = one.tangent;
  return end;
}

}  // namespace

void check_tangents(std::span<const PointTangent> tangents, int points, const std::string& field) {
  std::vector<bool> has(points, false);
  for (const PointTangent& one : tangents) {
    if (one.point < 0 || one.point >= points)
      throw FieldError(field,
                       fmt::format("there is no point {}: the {} points are numbered from 0", one.point, points));
    if (has[one.point]) throw FieldError(field, fmt::format("point {} has two tangents", one.point));
    has[one.point] = true;
  }
}

FieldType point_tangents() {
  return groups({{"point", integer().at_least(0), "number of the point, from 0", true, ""},
                 {"vector", vector(), "derivative by t there", true, ""}});
}

std::vector<PointTangent> point_tangents(const Fields& f, std::string_view field) {
  std::vector<PointTangent> tangents;
  if (!f.has(field)) return tangents;
  for (const Fields& one : f.groups(field)) tangents.push_back({one.integer("point"), one.vec3("vector")});
  return tangents;
}

NurbsCurve spline_curve(std::span<const Vec3> points, std::span<const double> parameters, int degree,
                        const SplineEnd& start, const SplineEnd& end, std::span<const PointTangent> tangents) {
  const int last = static_cast<int>(points.size()) - 1;
  check_degree(degree);
  check_tangents(tangents, last + 1);
  std::vector<PointTangent> inner_tangents;
  for (const PointTangent& one : tangents)
    if (one.point != 0 && one.point != last) inner_tangents.push_back(one);
  const double lo = parameters.front(), hi = parameters.back();
  EndConditions first = end_conditions(degree, with_tangent(start, tangents, 0), lo);
  EndConditions final = end_conditions(degree, with_tangent(end, tangents, last), hi);
  if (last == 1 && is_parabolic(first) && is_parabolic(final)) first = final = {{}, 1};  // both say the same
  std::vector<SplineCondition> conditions = inner_conditions(points, parameters, inner_tangents);
  conditions.insert(conditions.begin() + 1, first.conditions.begin(), first.conditions.end());
  conditions.insert(conditions.end(), final.conditions.begin(), final.conditions.end());
  std::vector<double> knots = inner_knots(parameters, degree, inner_tangents);
  const int left_out = first.left_out + final.left_out;
  if (left_out >= static_cast<int>(knots.size())) {  // one polynomial, of a lower degree where there are fewer points
    degree = std::min(degree, static_cast<int>(conditions.size()) - 1);
    knots.clear();
  } else {
    knots.erase(knots.begin(), knots.begin() + first.left_out);
    knots.erase(knots.end() - final.left_out, knots.end());
  }
  return spline_with(clamped_axis(degree, lo, hi, knots), conditions);
}

NurbsCurve closed_spline_curve(std::span<const Vec3> points, std::span<const double> parameters, int degree,
                               std::span<const PointTangent> tangents) {
  const size_t count = points.size();
  check_degree(degree);
  check_tangents(tangents, static_cast<int>(count));
  const double lo = parameters.front(), period = parameters.back() - lo;
  std::vector<double> inner;
  for (size_t i = 0; i < count; ++i) {
    const double before = i > 0 ? parameters[i] - parameters[i - 1] : period - (parameters[count - 1] - lo);
    add_knots_of(parameters[i], before, parameters[i + 1] - parameters[i], has_tangent(tangents, i), degree, inner);
  }
  SplineAxis axis = periodic_axis(degree, inner, period);
  axis.restrict_to({lo, lo + period});
  return spline_with(std::move(axis), inner_conditions(points, parameters, tangents));
}

namespace {

EndRule end_rule(const std::string& word) {
  return word == "natural" ? EndRule::natural : word == "parabolic" ? EndRule::parabolic : EndRule::not_a_knot;
}

SplineEnd spline_end(const Fields& f, const std::string& which, const std::string& rule) {
  SplineEnd end;
  end.rule = end_rule(rule);
  if (f.has(which + "_tangent")) end.tangent = f.vec3(which + "_tangent");
  if (f.has(which + "_second_derivative")) end.second = f.vec3(which + "_second_derivative");
  return end;
}

void refuse_ends_of_closed(const Fields& f) {
  for (const char* field : {"start_tangent", "end_tangent", "start_second_derivative", "end_second_derivative"})
    if (f.has(field)) throw FieldError(field, "a closed curve has no ends", "tangents: gives one to any point");
}

}  // namespace

TypeDeclaration spline_curve_type() {
  return declare(Category::curve, "spline_curve",
                 "Smooth spline through points, of any degree: cubic, natural, clamped, periodic, ...")
      .example("points: [[0, 0], [1, 2], [3, 3], [4, 0], [6, 1]], ends: natural")
      .field("points", points().count(2), "points of the curve; those of a closed one are not repeated")
      .field("degree", integer().between(1, kMaxDegree), "degree of the polynomial pieces", "3")
      .field("knots", knots(), kPointKnots, "chord_length")
      .field("closed", boolean(), "periodic curve, smooth over its seam", "false")
      .field("ends", words({"natural", "parabolic", "not_a_knot"}).count(1, 2),
             "what holds at the ends (one word for both, or one for each) where derivatives are not given: natural (no "
             "second derivative; odd degrees), parabolic (no third derivative; cubics), not_a_knot (the knot next to "
             "the end is none)",
             "not_a_knot")
      .optional("start_tangent", vector(), "derivative by t at the first point")
      .optional("end_tangent", vector(), "derivative by t at the last point")
      .optional("start_second_derivative", vector(), "second derivative by t at the first point")
      .optional("end_second_derivative", vector(), "second derivative by t at the last point")
      .optional("tangents", point_tangents(), "derivatives at any points")
      .shows({"control_polygon", "knots", "de_boor"})
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& points = f.points("points");
        const bool closed = f.boolean("closed");
        const std::vector<double> parameters = point_parameters(f.knots("knots"), points, closed);
        std::vector<PointTangent> tangents;
        if (f.has("tangents"))
          for (const Fields& one : f.groups("tangents")) tangents.push_back({one.integer("point"), one.vec3("vector")});
        if (closed) {
          refuse_ends_of_closed(f);
          return closed_spline_curve(points, parameters, f.integer("degree"), tangents);
        }
        const auto& ends = f.get<std::vector<std::string>>("ends");
        return spline_curve(points, parameters, f.integer("degree"), spline_end(f, "start", ends.front()),
                            spline_end(f, "end", ends.back()), tangents);
      });
}

}  // namespace lekalo::geometry
