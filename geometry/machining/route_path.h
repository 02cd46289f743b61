// A path together with what it was planned from, which helpers draw and measures tell.
#pragma once

#include <optional>

#include "geometry/machining/route_postman.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

// A graph, the closed way through all its edges where it was needed, and the way that is taken.
struct RoutePlan {
  RouteGraph graph;
  ReducedGraph reduced;
  std::optional<PostmanRoute> postman;
  Walk walk;
  int start = 0;  // of the walk, where it has no step
};

template <class Plan>
class PlannedPath final : public Curve {
 public:
  PlannedPath(CurvePtr path, Plan plan) : path_(std::move(path)), plan_(std::move(plan)) {}
  const Plan& plan() const { return plan_; }

  Interval domain() const override { return path_->domain(); }
  double period() const override { return path_->period(); }
  bool is_closed() const override { return path_->is_closed(); }
  CurveJet evaluate(double t, int order) const override { return path_->evaluate(t, order); }
  int max_order() const override { return path_->max_order(); }
  double fit_distance() const override { return path_->fit_distance(); }
  CurveEnclosure enclose(const Interval& t, int order) const override { return path_->enclose(t, order); }
  int enclosure_order() const override { return path_->enclosure_order(); }
  std::vector<CurvePiece> pieces() const override { return path_->pieces(); }
  std::optional<NurbsCurveForm> as_nurbs() const override { return path_->as_nurbs(); }

 private:
  CurvePtr path_;
  Plan plan_;
};

// The plan behind a curve, and where it was moved from; null where there is none.
template <class Plan>
struct PlacedPlan {
  const Plan* plan = nullptr;
  Affine map;
};
template <class Plan>
PlacedPlan<Plan> plan_of(const Curve& curve) {
  if (const auto* path = dynamic_cast<const PlannedPath<Plan>*>(&curve)) return {&path->plan(), Affine()};
  const auto* moved = dynamic_cast<const TransformedCurve*>(&curve);
  if (!moved) return {};
  PlacedPlan<Plan> inner = plan_of<Plan>(*moved->original());
  inner.map = moved->map() * inner.map;
  return inner;
}

// Straight sides; of points that repeat the one before one is kept. Throws FieldError (field points) where only one is
// left.
CurvePtr path_through(std::vector<Vec3> points);

// The points of a walk: its vertices, and the bends of its edges.
std::vector<Vec3> points_of(const Walk& walk, const RouteGraph& graph);
// The same of one edge, beginning at a vertex of it.
std::vector<Vec3> points_of(const RouteEdge& edge, const RouteGraph& graph, int from);

}  // namespace lekalo::geometry
