#include "geometry/surfaces/blends/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

constexpr double kAgree = 1e-13;
constexpr double kRounding = 4e-15;  // of coordinates
constexpr double kMinWeight = 1e-4;

// The weight of a circle between the contacts: the cosine of half of the angle at its center.
double circle_weight(const Contact& at) {
  return std::sqrt(std::max(0.0, 0.5 * (1 + glm::dot(at.normals[0], at.normals[1]))));
}

// Where the tangent planes at the contacts and the plane of the section meet (Golovanov 2016, 4.9.4, 4.5).
Vec3 middle_of(const Contact& at) {
  const Vec3 &a = at.points[0], &b = at.points[1], &m = at.normals[0], &k = at.normals[1];
  const double to_a = glm::length(at.center - a), to_b = glm::length(at.center - b), w = circle_weight(at);
  if (std::abs(to_a - to_b) <= 1e-12 * to_a)
    return 0.5 * (a + b - (1 - w * w) / (w * w) * ((at.center - a) + (at.center - b)));
  const Vec3 across = glm::cross(m, k), along = glm::cross(across, m);
  return a + glm::dot(k, b - a) / glm::dot(across, across) * along;
}

// The Bezier points of a polynomial over an interval inside of a part, elevated to the degree.
std::vector<Vec3> bezier_points(const PolynomialCurve::Part& part, const Interval& t, int degree) {
  const double from = part.local(t.lo), width = part.local(t.hi) - from;
  // Powers of q in [0, 1], x = from + width q (Horner's scheme again and again).
  std::vector<Vec3> powers(part.powers.begin(), part.powers.begin() + part.terms);
  const int n = part.terms - 1;
  for (int m = 0; m <= n; ++m)
    for (int i = n - 1; i >= m; --i) powers[i] += from * powers[i + 1];
  double scale = 1;
  for (Vec3& power : powers) power *= scale, scale *= width;
  // b_j = sum over i of C(j, i)/C(degree, i) powers_i.
  std::vector<Vec3> points(degree + 1, Vec3(0));
  for (int j = 0; j <= degree; ++j) {
    double share = 1;
    for (int i = 0; i <= std::min(j, n); ++i) {
      points[j] += share * powers[i];
      share *= static_cast<double>(j - i) / (degree - i);
    }
  }
  points.front() = part.value(from), points.back() = part.value(part.local(t.hi));
  return points;
}

int highest_degree(const std::vector<PolynomialPtr>& curves) {
  int degree = 1;
  for (const PolynomialPtr& one : curves)
    for (const auto& part : one->parts()) degree = std::max(degree, part.terms - 1);
  return degree;
}

// One patch over each part, of one degree for all; `add_row` adds the points of row k from those of the curves.
template <class AddRow>
std::vector<SurfacePiece> patches(const std::vector<PolynomialPtr>& curves, const std::vector<double>& breaks,
                                  int degree_z, const AddRow& add_row) {
  const int degree = highest_degree(curves);
  std::vector<SurfacePiece> result;
  for (size_t i = 0; i + 1 < breaks.size(); ++i) {
    const Interval t(breaks[i], breaks[i + 1]);
    SurfacePiece piece = plain_piece({t, {0, 1}});
    piece.degree_u = degree, piece.degree_v = degree_z;
    std::vector<std::vector<Vec3>> points;
    for (const PolynomialPtr& one : curves)
      points.push_back(bezier_points(part_at(one->parts(), t.middle()), t, degree));
    for (int k = 0; k <= degree; ++k) add_row(points, k, piece.points);
    // Neighbours share their border.
    if (i > 0) std::copy(result.back().points.end() - degree_z - 1, result.back().points.end(), piece.points.begin());
    result.push_back(std::move(piece));
  }
  return result;
}

// Its parts end at the points of the function themselves, so that they meet.
PolynomialPtr fitted(const std::function<Vec3(double)>& point, const std::vector<Interval>& stretches,
                     double tolerance) {
  const PolynomialPtr fit = polynomial_approximation(point, stretches, tolerance);
  if (!fit)
    throw FieldError("of", "the contacts with the surfaces are not smooth enough along the guide",
                     "take smoother surfaces, or a part of the guide");
  std::vector<PolynomialCurve::Part> parts = fit->parts();
  for (PolynomialCurve::Part& part : parts) {
    const Vec3 at_lo = point(part.t.lo) - part.value(part.local(part.t.lo)),
               at_hi = point(part.t.hi) - part.value(part.local(part.t.hi));
    part.powers[0] += 0.5 * (at_lo + at_hi);
    if (at_lo != at_hi) part.powers[1] += 0.5 * (at_hi - at_lo), part.terms = std::max(part.terms, 2);
  }
  return std::make_shared<PolynomialCurve>(std::move(parts));
}

// Between the joints of the guide and the breaks of the contacts. A break as near to a joint as rounding puts it is the
// same place.
std::vector<Interval> stretches_of(const Contacts& contacts) {
  const Interval domain = contacts.domain();
  const double least = 1e-11 * domain.width();
  std::vector<double> ends{domain.lo, domain.hi};
  const auto add = [&](double t) {
    const bool is_new = std::all_of(ends.begin(), ends.end(), [&](double end) { return std::abs(end - t) > least; });
    if (is_new && domain.contains(t)) ends.push_back(t);
  };
  for (const CurvePiece& piece : contacts.law().guide->pieces()) add(piece.domain.lo);
  for (const double t : contacts.breaks()) add(t);
  std::sort(ends.begin(), ends.end());
  std::vector<Interval> result;
  for (size_t i = 0; i + 1 < ends.size(); ++i) result.emplace_back(ends[i], ends[i + 1]);
  return result;
}

double width_of(const Surface& surface) {
  const Rectangle domain = surface.domain();
  const double width = std::max(domain.u.width(), domain.v.width());
  return width < kInfinity ? width : 1;
}

}  // namespace

std::vector<SurfacePiece> ConicSections::rational_pieces(const std::vector<double>& breaks_t,
                                                         const std::vector<double>&) const {
  if (is_even) return {};
  return patches({curves.first, curves.middle, curves.second, curves.weight}, breaks_t, 2,
                 [](const std::vector<std::vector<Vec3>>& of, int k, std::vector<Vec4>& points) {
                   points.emplace_back(of[0][k], 1);
                   points.emplace_back(of[1][k], of[3][k].x);
                   points.emplace_back(of[2][k], 1);
                 });
}

std::vector<SurfacePiece> StraightSections::rational_pieces(const std::vector<double>& breaks_t,
                                                            const std::vector<double>&) const {
  return patches({curves.first, curves.second}, breaks_t, 1,
                 [](const std::vector<std::vector<Vec3>>& of, int k, std::vector<Vec4>& points) {
                   points.emplace_back(of[0][k], 1);
                   points.emplace_back(of[1][k], 1);
                 });
}

BlendCurves blend_curves(const Contacts& contacts, const SectionShape& shape) {
  const std::vector<Interval> stretches = stretches_of(contacts);
  std::map<double, Contact> known;
  const auto at = [&](double t) -> const Contact& {
    const auto found = known.find(t);
    return found != known.end() ? found->second : known.emplace(t, contacts.at(t)).first->second;
  };
  Box3 box;
  for (const Interval& stretch : stretches)
    for (int k = 0; k <= 8; ++k)
      for (const Vec3& p : at(stretch.lo + stretch.width() * k / 8).points) box.include(p);
  const Vec3 farthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  const double tolerance =
      std::max(kAgree * contacts.size(), kRounding * std::max({farthest.x, farthest.y, farthest.z}));
  const auto fit = [&](auto&& value, double within) {
    return fitted([&](double t) { return value(at(t)); }, stretches, within);
  };
  BlendCurves curves;
  curves.first = fit([](const Contact& c) { return c.points[0]; }, tolerance);
  curves.second = fit([](const Contact& c) { return c.points[1]; }, tolerance);
  curves.center = fit([](const Contact& c) { return c.center; }, tolerance);
  const auto image = [&](int k) {
    return fit([k](const Contact& c) { return Vec3(c.places[k], 0); },
               std::max(kAgree * width_of(*contacts.law().of[k]), tolerance));
  };
  curves.first_image = image(0);
  if (contacts.law().kind != BlendKind::edge) curves.second_image = image(1);
  if (contacts.law().kind == BlendKind::chamfer) return curves;
  const auto weight = [&](const Contact& c) { return shape.weight > 0 ? shape.weight : circle_weight(c); };
  for (const auto& [t, contact] : known)
    if (circle_weight(contact) < kMinWeight)
      throw FieldError(contacts.law().size_field,
                       fmt::format("the ball touches both surfaces at opposite points at the guide's t = {:.6g}", t),
                       "take another size, or a part of the guide");
  curves.middle = fit([&](const Contact& c) { return weight(c) * middle_of(c); }, tolerance);
  curves.weight = fit([&](const Contact& c) { return Vec3(weight(c), 0, 0); }, kAgree);
  return curves;
}

CurvePtr as_spline(const PolynomialCurve& curve) {
  NurbsCurveForm form;
  for (const auto& part : curve.parts()) form.degree = std::max(form.degree, part.terms - 1);
  form.knots.assign(1, curve.domain().lo);
  for (const auto& part : curve.parts()) {
    form.knots.insert(form.knots.end(), form.degree, part.t.lo);
    if (!form.points.empty()) form.points.pop_back();
    for (const Vec3& p : bezier_points(part, part.t, form.degree)) form.points.emplace_back(p, 1);
  }
  form.knots.insert(form.knots.end(), form.degree + 1, curve.domain().hi);
  return std::make_shared<NurbsCurve>(form);
}

SurfaceProperties blend_properties(const Contacts& contacts, const BlendCurves& curves) {
  SurfaceProperties properties;
  properties.domain = {contacts.domain(), {0, 1}};
  properties.breaks_u = {contacts.domain().lo, contacts.domain().hi};
  properties.breaks_v = {0, 1};
  for (const PolynomialPtr& curve : {curves.first, curves.second, curves.middle, curves.weight})
    if (curve) add_operand(properties, *curve, Along::u);
  return properties;
}

}  // namespace lekalo::geometry
