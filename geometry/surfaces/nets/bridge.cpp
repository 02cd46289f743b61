// Transition surfaces between the edges of two surfaces (Golovanov 2016, 3.4.4), w in 0..1:
//
//   r = a(u) alpha_0(w) + b(u) alpha_1(w) + k_a a_n(u) beta_0(w) + k_b b_n(u) beta_1(w)
//
// a_n and b_n are the derivatives across the edges, out of the first surface and into the second; k_a = mean distance
// of the edges/mean |a_n|. With second derivatives the functions are those of degree five, and k enters squared.
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/describe.h"
#include "geometry/surfaces/nets/boolean_sum.h"

namespace lekalo::geometry {

namespace {

// The derivative of a surface across an edge, or a parameter line, times a factor.
struct AcrossEdge {
  SurfacePtr of;
  bool at_u;  // u is held
  double held;
  int order;
  double factor;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const T fixed(held);
    return factor * (at_u ? surface_at(*of, fixed, t, order, 0) : surface_at(*of, t, fixed, 0, order));
  }
};

struct Edge {
  SurfacePtr of;
  bool at_u = false, at_end = false;

  double held() const {
    const Interval range = at_u ? of->domain().u : of->domain().v;
    return at_end ? range.hi : range.lo;
  }
  CurvePtr curve() const {
    return std::make_shared<ParameterLine>(of, at_u ? IsoDirection::u : IsoDirection::v, held());
  }
  // Positive derivatives lead out of the surface at its end; `leaves` where that is wanted.
  CurvePtr across(int order, bool leaves, double scale) const {
    const double sign = order % 2 == 1 && at_end != leaves ? -1 : 1;
    const CurvePtr line = curve();
    CurveProperties properties = properties_of(*line);
    properties.max_order = std::min(properties.max_order, of->max_order() - order);
    properties.enclosure_order = std::min(properties.enclosure_order, of->enclosure_order() - order);
    return std::make_shared<ComposedCurve<AcrossEdge>>(AcrossEdge{of, at_u, held(), order, sign * scale}, properties);
  }
};

Edge read_edge(const Fields& f, const char* field) {
  const SurfacePtr of = f.surface(field);
  if (!of->bounded()) throw FieldError(field, "the surface is unbounded", "give it a domain");
  const std::string& edge = f.text(fmt::format("{}_edge", field));
  return {of, edge[0] == 'u', edge == "u_max" || edge == "v_max"};
}

constexpr int kSamples = 16;

double mean(const std::function<double(double)>& value) {
  double sum = 0;
  for (int k = 0; k <= kSamples; ++k) sum += value(static_cast<double>(k) / kSamples);
  return sum / (kSamples + 1);
}

double mean_length(const Curve& curve) {
  const Interval t = curve.domain();
  return mean([&](double x) { return glm::length(curve.point(t.lo + t.width() * x)); });
}

std::any bridge(const Fields& f) {
  const Edge a = read_edge(f, "from"), b = read_edge(f, "to");
  const int n = f.integer("continuity");
  const bool turned = f.boolean("reversed");
  const auto unit = [&](const CurvePtr& curve, bool turn) {
    const CurvePtr same = curve->domain() == Interval(0, 1) ? curve : with_domain(curve, {0, 1});
    return turn ? reversed_curve(same) : same;
  };
  const CurvePtr first = unit(a.curve(), false), second = unit(b.curve(), turned);
  const double apart = mean([&](double x) { return glm::length(second->point(x) - first->point(x)); });
  if (!(apart > 0)) throw FieldError("to", "the two edges are one");
  BooleanSum sum;
  sum.along_u = {{first, second}, end_functions(n, {0, 1})};
  double k_a = 1, k_b = 1;
  for (int k = 1; k <= n; ++k) {
    if (k == 1) {
      k_a = f.number("tension") * apart / mean_length(*a.across(1, true, 1));
      k_b = f.number("tension") * apart / mean_length(*b.across(1, false, 1));
      if (!std::isfinite(k_a) || !std::isfinite(k_b))
        throw FieldError(std::isfinite(k_a) ? "to" : "from", "the surface has no tangents across this edge");
    }
    sum.along_u.curves.push_back(unit(a.across(k, true, std::pow(k_a, k)), false));
    sum.along_u.curves.push_back(unit(b.across(k, false, std::pow(k_b, k)), turned));
  }
  Periods periods;
  if (first->period() > 0 && first->period() == second->period()) periods.u = first->period();
  return std::any(
      SurfacePtr(std::make_shared<BlendedSurface>(blended_surface(std::move(sum), {{0, 1}, {0, 1}}, periods))));
}

}  // namespace

TypeDeclaration bridge_surface_type() {
  const std::vector<std::string> edges{"u_min", "u_max", "v_min", "v_max"};
  return declare(Category::surface, "bridge_surface",
                 "Transition from an edge of one surface to an edge of another, joined to both without a gap (0), with "
                 "their "
                 "tangent planes (1), or their curvatures across the edges too (2). u runs along the edges, v from the "
                 "first "
                 "to the second, both in 0..1.")
      .example(
          "from: { type: cylinder_surface, radius: 1, height: 1 }, from_edge: v_max, to: { type: cylinder_surface, "
          "radius: 2, height: 1, frame: { origin: [0, 0, 3] } }, to_edge: v_min")
      .field("from", reference({Category::surface}), "the surface that it leaves")
      .field("from_edge", choice(edges), "at which edge", "v_max")
      .field("to", reference({Category::surface}), "the surface that it enters")
      .field("to_edge", choice(edges), "at which edge", "v_min")
      .field("continuity", integer().between(0, 2), "order up to which derivatives across the edges go on", "1")
      .field("tension", number().positive(),
             "length of the tangents across the edges, relative to the distance between them", "1")
      .field("reversed", boolean(), "the second edge runs the other way", "false")
      .built_by(bridge);
}

}  // namespace lekalo::geometry
