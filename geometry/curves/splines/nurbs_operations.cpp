#include "geometry/curves/splines/nurbs_operations.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "geometry/curves/splines/blossom.h"
#include "geometry/curves/splines/bspline_basis.h"

namespace lekalo::geometry {

namespace {

void require_affine(const NurbsCurveForm& form) {
  for (const ParameterMap& map : form.maps)
    if (map.kind != ParameterMap::Kind::affine)
      throw std::invalid_argument("this NURBS form has a transcendental parameter, which knots cannot express");
}

void require_inside(const NurbsCurveForm& form, double t) {
  const Interval domain = form.domain();
  if (!(t > domain.lo && t < domain.hi)) throw std::invalid_argument("the parameter is not inside the curve's domain");
}

// The polar form of the span's polynomial at `degree` arguments.
Vec4 blossom(const NurbsCurveForm& form, int span, const std::vector<double>& arguments) {
  const int p = form.degree;
  std::vector<Vec4> level(form.points.begin() + (span - p), form.points.begin() + (span + 1));
  for (int k = 1; k <= p; ++k) {
    const double x = arguments[k - 1];
    for (int j = p; j >= k; --j) {
      const double left = form.knots[span - p + j], right = form.knots[span + 1 + j - k];
      level[j] = affine_mix((right - x) / (right - left), level[j - 1], (x - left) / (right - left), level[j]);
    }
  }
  return level[p];
}

NurbsCurveForm elevated_once(const NurbsCurveForm& form) {
  const int p = form.degree;
  NurbsCurveForm result;
  result.degree = p + 1;
  for (size_t i = 0; i < form.knots.size(); ++i) {
    result.knots.push_back(form.knots[i]);
    if (i + 1 == form.knots.size() || form.knots[i + 1] != form.knots[i]) result.knots.push_back(form.knots[i]);
  }
  // Knots before and after the domain that no basis function of the new degree needs any more.
  const auto extra = [&](auto begin, auto end, double domain_end) {
    int count = 0;
    for (auto knot = begin; knot != end && *knot != domain_end; ++knot) ++count;
    int multiplicity = 0;
    for (auto knot = begin + count; knot != end && *knot == domain_end; ++knot) ++multiplicity;
    return std::max(0, count + multiplicity - (p + 2));
  };
  const Interval domain = form.domain();
  const int before = extra(result.knots.begin(), result.knots.end(), domain.lo);
  const int after = extra(result.knots.rbegin(), result.knots.rend(), domain.hi);
  result.knots.erase(result.knots.end() - after, result.knots.end());
  result.knots.erase(result.knots.begin(), result.knots.begin() + before);

  const int count = static_cast<int>(result.knots.size()) - result.degree - 1;
  std::vector<double> arguments(p);
  for (int j = 0; j < count; ++j) {
    // Any span of the point's support will do; the middle one extrapolates least.
    const double middle = 0.5 * (std::max(result.knots[j], domain.lo) + std::min(result.knots[j + p + 2], domain.hi));
    const int span = find_span(p, form.knots, middle);
    Vec4 sum(0);
    for (int skipped = 0; skipped <= p; ++skipped) {
      for (int k = 0, from = 0; k <= p; ++k)
        if (k != skipped) arguments[from++] = result.knots[j + 1 + k];
      sum += blossom(form, span, arguments);
    }
    result.points.push_back(sum / static_cast<double>(p + 1));
  }
  return result;
}

}  // namespace

NurbsCurveForm insert_knot(const NurbsCurveForm& form, double t, int times) {
  require_affine(form);
  require_inside(form, t);
  NurbsCurveForm result{form.degree, form.knots, form.points, {}};
  const int p = form.degree;
  for (int n = 0; n < times; ++n) {
    const auto& knots = result.knots;
    const auto [first, next] = std::equal_range(knots.begin(), knots.end(), t);
    const int multiplicity = static_cast<int>(next - first);
    if (multiplicity >= p) throw std::invalid_argument("the knot's multiplicity would exceed the degree");
    const int span = static_cast<int>(next - knots.begin()) - 1;
    std::vector<Vec4> points(result.points.begin(), result.points.begin() + (span - p + 1));
    for (int j = span - p + 1; j <= span - multiplicity; ++j) {
      const double width = knots[j + p] - knots[j];
      points.push_back(
          affine_mix((knots[j + p] - t) / width, result.points[j - 1], (t - knots[j]) / width, result.points[j]));
    }
    points.insert(points.end(), result.points.begin() + (span - multiplicity), result.points.end());
    result.points = std::move(points);
    result.knots.insert(result.knots.begin() + (span + 1), t);
  }
  return result;
}

NurbsCurveForm elevate_degree(const NurbsCurveForm& form, int by) {
  require_affine(form);
  if (by < 0 || form.degree + by > kMaxDegree)
    throw std::invalid_argument("the degree would exceed " + std::to_string(kMaxDegree));
  NurbsCurveForm result{form.degree, form.knots, form.points, {}};
  for (int n = 0; n < by; ++n) result = elevated_once(result);
  return result;
}

NurbsCurveForm in_bezier_form(const NurbsCurveForm& form) {
  NurbsCurveForm result{form.degree, form.knots, form.points, {}};
  const Interval domain = form.domain();
  for (auto knot = form.knots.begin(); knot != form.knots.end();
       knot = std::upper_bound(knot, form.knots.end(), *knot)) {
    const auto copies = static_cast<int>(std::upper_bound(knot, form.knots.end(), *knot) - knot);
    if (domain.lo < *knot && *knot < domain.hi && copies < form.degree)
      result = insert_knot(result, *knot, form.degree - copies);
  }
  return result;
}

// Point j is the polar form at the knots t_(j+1) .. t_(j+p), of any span that is part of its support.
NurbsCurveForm clamped_part(const NurbsCurveForm& form, const Interval& part) {
  require_affine(form);
  const Interval domain = form.domain();
  if (!(part.width() > 0 && domain.lo <= part.lo && part.hi <= domain.hi))
    throw std::invalid_argument("the range is empty or not inside the curve's domain");
  const auto p = static_cast<size_t>(form.degree);
  if (form.knots.front() == part.lo && form.knots.back() == part.hi) return {form.degree, form.knots, form.points, {}};
  NurbsCurveForm result{form.degree, std::vector<double>(p + 1, part.lo), {}, {}};
  for (const double knot : form.knots)
    if (part.lo < knot && knot < part.hi) result.knots.push_back(knot);
  result.knots.insert(result.knots.end(), p + 1, part.hi);
  for (size_t j = 0; j + p + 1 < result.knots.size(); ++j) {
    const int span = find_span(form.degree, form.knots, 0.5 * (result.knots[j] + result.knots[j + p + 1]));
    const auto first = result.knots.begin() + static_cast<std::ptrdiff_t>(j) + 1;
    result.points.push_back(blossom(form, span, {first, first + form.degree}));
  }
  return result;
}

std::pair<NurbsCurveForm, NurbsCurveForm> split(const NurbsCurveForm& form, double t) {
  require_inside(form, t);
  const int p = form.degree;
  const int multiplicity = static_cast<int>(std::count(form.knots.begin(), form.knots.end(), t));
  const NurbsCurveForm whole = insert_knot(form, t, std::max(0, p - multiplicity));
  const int first = static_cast<int>(std::lower_bound(whole.knots.begin(), whole.knots.end(), t) - whole.knots.begin());
  // At a break (multiplicity degree + 1) each side has its own point already.
  const bool broken = multiplicity > p;
  NurbsCurveForm before{p, {whole.knots.begin(), whole.knots.begin() + (first + p)}, {}, {}};
  before.knots.push_back(t);
  before.points.assign(whole.points.begin(), whole.points.begin() + first);
  NurbsCurveForm after{p, {whole.knots.begin() + (first + (broken ? 1 : 0)), whole.knots.end()}, {}, {}};
  after.knots.insert(after.knots.begin(), t);
  after.points.assign(whole.points.begin() + (first - (broken ? 0 : 1)), whole.points.end());
  return {before, after};
}

NurbsCurveForm reversed(const NurbsCurveForm& form) {
  require_affine(form);
  const Interval domain = form.domain();
  NurbsCurveForm result{form.degree, {}, {form.points.rbegin(), form.points.rend()}, {}};
  for (auto knot = form.knots.rbegin(); knot != form.knots.rend(); ++knot)
    result.knots.push_back(*knot == domain.lo   ? domain.hi
                           : *knot == domain.hi ? domain.lo
                                                : domain.lo + (domain.hi - *knot));
  return result;
}

NurbsCurveForm reparametrized(const NurbsCurveForm& form, const Interval& domain) {
  require_affine(form);
  if (!(domain.width() > 0)) throw std::invalid_argument("the new domain is empty");
  const Interval old = form.domain();
  NurbsCurveForm result{form.degree, form.knots, form.points, {}};
  for (double& knot : result.knots)
    knot = affine_mix((old.hi - knot) / old.width(), domain.lo, (knot - old.lo) / old.width(), domain.hi);
  return result;
}

std::vector<Vec4> elevated_bezier(std::vector<Vec4> points, int degree) {
  while (static_cast<int>(points.size()) <= degree) {
    const int n = static_cast<int>(points.size());
    points.push_back(points.back());
    for (int i = n - 1; i > 0; --i) {
      const double share = static_cast<double>(i) / n;
      points[i] = affine_mix(share, points[i - 1], 1 - share, points[i]);
    }
  }
  return points;
}

std::optional<NurbsCurveForm> form_of_pieces(std::vector<CurvePiece> pieces) {
  NurbsCurveForm form;
  for (const CurvePiece& piece : pieces) {
    const bool is_cut = piece.map.from != 0 || piece.map.to != 1;
    if (!piece.is_rational() || (is_cut && piece.map.kind != ParameterMap::Kind::affine)) return std::nullopt;
    form.degree = std::max(form.degree, piece.degree());
  }
  bool is_affine = true;
  for (CurvePiece& piece : pieces) {
    piece.points = elevated_bezier(std::move(piece.points), form.degree);
    form.knots.insert(form.knots.end(), form.knots.empty() ? form.degree + 1 : form.degree, piece.domain.lo);
    const double scale = form.points.empty() ? 1 : form.points.back().w / piece.points.front().w;
    for (size_t i = form.points.empty() ? 0 : 1; i < piece.points.size(); ++i)
      form.points.push_back(scale * piece.points[i]);
    form.maps.push_back(piece.map);
    is_affine = is_affine && piece.map.kind == ParameterMap::Kind::affine;
  }
  form.knots.insert(form.knots.end(), form.degree + 1, pieces.back().domain.hi);
  if (is_affine) form.maps.clear();
  return form;
}

}  // namespace lekalo::geometry
