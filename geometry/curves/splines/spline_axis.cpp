#include "geometry/curves/splines/spline_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

void check_degree(int degree) {
  if (degree < 1 || degree > kMaxDegree)
    throw FieldError("degree", fmt::format("degree {} is not between 1 and {}", degree, kMaxDegree),
                     "practical degrees are 2 to 7");
}

// Makes nearly equal knots equal, and checks order and multiplicity.
void check_knots(int degree, std::vector<double>& knots) {
  const int size = static_cast<int>(knots.size());
  if (size < 2 * degree + 2)
    throw FieldError("knots", fmt::format("{} knots are too few for degree {}: at least {} are needed", size, degree,
                                          2 * degree + 2));
  for (int i = 0; i + 1 < size; ++i) {
    if (!std::isfinite(knots[i]) || !std::isfinite(knots[i + 1])) throw FieldError("knots", "a knot is not finite");
    if (knots[i + 1] < knots[i])
      throw FieldError("knots", fmt::format("knots must not decrease, but knot {} is {} and knot {} is {}", i, knots[i],
                                            i + 1, knots[i + 1]));
  }
  const double snap = kSameKnot * (knots.back() - knots.front());
  int first = 0;  // of a run of equal knots
  for (int i = 1; i < size; ++i) {
    if (knots[i] - knots[first] <= snap)
      knots[i] = knots[first];
    else
      first = i;
    if (i - first + 1 > degree + 1)
      throw FieldError("knots", fmt::format("the knot {} stands {} times; degree {} allows at most {}", knots[i],
                                            i - first + 1, degree, degree + 1));
  }
  if (!(knots[degree] < knots[size - 1 - degree]))
    throw FieldError("knots", fmt::format("the domain is empty: knot {} and knot {} are both {}", degree,
                                          size - 1 - degree, knots[degree]));
}

void check_periodic(int degree, std::vector<double>& knots, int distinct) {
  const double period = knots[degree + distinct] - knots[degree];
  for (int k = 0; k <= 2 * degree; ++k) {
    const double expected = knots[k] + period;
    if (std::abs(knots[k + distinct] - expected) > kKnotPeriod * period)
      throw FieldError("knots",
                       fmt::format("the knots of a closed curve must repeat after the period {}: knot {} should be {}, "
                                   "not {}",
                                   period, k + distinct, expected, knots[k + distinct]),
                       "name a rule instead: knots: uniform");
    knots[k + distinct] = expected;
  }
}

}  // namespace

SplineAxis::SplineAxis(int degree, std::vector<double> knots, Extension extension)
    : degree_(degree), knots_(std::move(knots)), extension_(extension) {
  check_degree(degree_);
  check_knots(degree_, knots_);
  distinct_ = count();
  if (periodic()) {
    distinct_ -= degree_;
    if (distinct_ < 1) throw FieldError("knots", "a closed curve needs more knots than that");
    check_periodic(degree_, knots_, distinct_);
  }
  whole_ = domain_ = {knots_[degree_], knots_[count()]};
  if (periodic()) period_ = whole_.width();
}

void SplineAxis::restrict_to(const Interval& part) {
  const double slack = kDomainSlack * whole_.width();
  if (!(part.width() > 0)) throw FieldError("domain", "the domain is empty");
  if (!periodic()) {
    if (part.lo < whole_.lo - slack || part.hi > whole_.hi + slack)
      throw FieldError("domain", fmt::format("[{}, {}] is not inside the knots' domain [{}, {}]", part.lo, part.hi,
                                             whole_.lo, whole_.hi));
    domain_ = intersect(part, whole_);
    return;
  }
  if (part.width() > period_ + slack)
    throw FieldError("domain", fmt::format("[{}, {}] is longer than the period {}", part.lo, part.hi, period_));
  // Move the knots by whole periods until the part begins in the first one, and unroll them if it ends in the second.
  const double shift = period_ * std::floor((part.lo - whole_.lo) / period_);
  for (double& knot : knots_) knot += shift;
  whole_ = {knots_[degree_], knots_[degree_ + distinct_]};
  domain_ = {std::max(part.lo, whole_.lo), part.hi};
  if (domain_.hi > whole_.hi + slack)
    for (int k = 0; k < distinct_; ++k) knots_.push_back(knots_[knots_.size() - distinct_] + period_);
  else
    domain_.hi = std::min(domain_.hi, whole_.hi);
}

SplineAxis::Place SplineAxis::place(double t) const {
  if (t == domain_.hi) {  // derivatives from the left
    int span = find_span(degree_, knots_, t);
    while (span > degree_ && !(knots_[span] < t && knots_[span] < knots_[span + 1])) --span;
    return {span, t, 0};
  }
  switch (extension_) {
    case Extension::periodic:
      if (!whole_.contains(t)) {
        t -= period_ * std::floor((t - whole_.lo) / period_);
        t = whole_.clamp(t);
      }
      return {find_span(degree_, knots_, t), t, 0};
    case Extension::tangent:
      if (!whole_.contains(t)) {
        const double end = whole_.clamp(t);
        return {find_span(degree_, knots_, end), end, t - end};
      }
      break;
    case Extension::analytic:
      break;
  }
  return {find_span(degree_, knots_, t), t, 0};
}

std::vector<int> SplineAxis::spans_over(const Interval& t) const {
  std::vector<int> spans;
  const int first = find_span(degree_, knots_, t.lo);
  for (int span = first; span < count() && (span == first || knots_[span] < t.hi); ++span)
    if (knots_[span] < knots_[span + 1]) spans.push_back(span);
  return spans;
}

std::vector<double> knots_by_rule(const std::string& rule, int degree, int points, bool closed,
                                  const std::vector<double>& places) {
  const bool spaced = rule == "chord_length" || rule == "centripetal";
  std::vector<double> knots;
  if (closed) {
    const int size = points + 2 * degree + 1;
    if (!spaced) {
      for (int i = 0; i < size; ++i) knots.push_back(i - degree);
      return knots;
    }
    const double period = places[points];
    auto place = [&](int i) {  // continued periodically
      const int turns = static_cast<int>(std::floor(static_cast<double>(i) / points));
      return places[i - turns * points] + turns * period;
    };
    auto mean = [&](int first) {
      double sum = 0;
      for (int i = first; i < first + degree; ++i) sum += place(i);
      return sum / degree;
    };
    const double start = mean(0);
    for (int i = 0; i < size; ++i) knots.push_back(mean(i - degree) - start);
    return knots;
  }
  if (rule == "uniform") {
    for (int i = 0; i < points + degree + 1; ++i) knots.push_back(i);
    return knots;
  }
  knots.assign(degree + 1, 0.0);
  for (int j = 1; j < points - degree; ++j) {
    double knot = j;
    if (spaced) {
      knot = 0;
      for (int i = j; i < j + degree; ++i) knot += places[i] / degree;
    }
    knots.push_back(knot);
  }
  knots.insert(knots.end(), degree + 1, spaced ? places[points - 1] : static_cast<double>(points - degree));
  return knots;
}

SplineAxis make_axis(int degree, const Knots& knots, bool closed, int points, const std::vector<double>& steps) {
  check_degree(degree);
  const int needed = closed ? 3 : degree + 1;
  if (points < needed)
    throw FieldError("points", fmt::format("{} of degree {} needs at least {} points, not {}",
                                           closed ? "a closed spline" : "a spline", degree, needed, points));
  const Extension extension = closed ? Extension::periodic : Extension::tangent;
  if (!knots.rule.empty()) {
    std::vector<double> places{0.0};
    for (const double step : steps)
      places.push_back(places.back() + (knots.rule == "centripetal" ? std::sqrt(step) : step));
    return SplineAxis(degree, knots_by_rule(knots.rule, degree, points, closed, places), extension);
  }
  const int size = static_cast<int>(knots.values.size());
  const int right = closed ? points + 2 * degree + 1 : points + degree + 1;
  if (size != right) {
    std::string message = fmt::format("{} points of degree {}{} need {} knots, not {}", points, degree,
                                      closed ? ", closed," : "", right, size);
    const bool repeated = closed && size == points + degree + 1;
    throw FieldError("knots", message,
                     repeated ? "closed: true takes unrepeated points and degree more knots at each end"
                              : "knots are counted with their multiplicity, or name a rule: knots: clamped");
  }
  return SplineAxis(degree, knots.values, extension);
}

}  // namespace lekalo::geometry
