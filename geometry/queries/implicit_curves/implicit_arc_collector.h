// What searches of curves on implicit surfaces (implicit_arcs.h) have in common, whatever their unknowns.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>

#include "geometry/numerics/solution_curves.h"
#include "geometry/queries/implicit_curves/implicit_arcs.h"
#include "geometry/queries/implicit_curves/implicit_nodes.h"

namespace lekalo::geometry {

namespace implicit_arc {

// Of the region's diameter: boxes as small may stay undecided, and what their hulls may be without something being
// missing.
inline constexpr double kMinBox = 1e-6, kLargeOpen = 1e-3;
inline constexpr double kBorder = 1e-12;  // of the domain's sides
inline constexpr int kMaxBoxes = 40000;

// A value of F over a box that excludes it.
inline constexpr double kNowhere = std::numeric_limits<double>::max();

SecondOrder<Interval> thin(const ImplicitFormula& formula, const Vec3& p);

// A bound on rounding: twice the largest width at places of the box.
double rounding_in(const Box3& box, const std::function<double(const Vec3&)>& width);

template <int N>
std::array<double, N> widths(const ParameterBox<N>& box) {
  std::array<double, N> result;
  for (int i = 0; i < N; ++i) result[i] = box[i].width();
  return result;
}
template <int N>
ParameterPoint<N> middle(const ParameterBox<N>& box) {
  ParameterPoint<N> result;
  for (int i = 0; i < N; ++i) result[i] = box[i].middle();
  return result;
}

// The end of an arc at a singular point, by its directions at both ends: unit vectors.
struct LastBit {
  Vec3 begin{0}, end{0};
  Vec3 point(const Vec3& from, const Vec3& to, double share) const;
};

class Collector {
 public:
  Collector(const ImplicitBranch& branch, const ImplicitRegion& region, const ImplicitCondition& condition,
            std::span<const ImplicitNode> nodes);

  // `system` has what search_solution_curves() asks for, and
  //   kUnknowns
  //   Vec3 point(const ParameterPoint<kUnknowns>&) const
  //   std::array<double, kUnknowns - 1> rounding() const      of the equations' values
  template <class System>
  ImplicitArcs find(const System& system, const ParameterBox<System::kUnknowns>& domain) {
    constexpr int N = System::kUnknowns;
    SolutionCurveOptions<N> options;
    options.least = kMinBox * size_;
    options.max_boxes = kMaxBoxes;
    options.divides_hard_boxes = true;
    options.rounding = system.rounding();
    for (int i = 0; i < N; ++i) options.slack[i] = kBorder * domain[i].width();
    const SolutionCurves<N> found = search_solution_curves<N>(system, domain, options);
    result_.complete = found.complete && formula_.smoothness() == Expression::Smoothness::smooth;
    if (found.complete)
      for (const ParameterBox<N>& open : found.open) {
        Box3 hull;
        for (int corner = 0; corner < 1 << N; ++corner) {
          ParameterPoint<N> at;
          for (int i = 0; i < N; ++i) at[i] = corner >> i & 1 ? open[i].hi : open[i].lo;
          hull.include(system.point(at));
        }
        if (region_.misses(hull) || !may_hold(branch_.sides, hull) || node_around(hull)) continue;
        open_.push_back(hull);
        if (hull.diameter() > kLargeOpen * size_) result_.complete = false;
      }
    for (const SolutionArc<N>& arc : found.arcs) {
      std::vector<Vec3> nodes;
      for (const auto& node : arc.nodes) nodes.push_back(system.point(node));
      add(std::move(nodes), arc.closed, arc.begins_singular, arc.ends_singular);
    }
    return std::move(result_);
  }

 private:
  void add(std::vector<Vec3> nodes, bool closed, bool begins_singular, bool ends_singular);
  // What of it the sides of the branch leave.
  void add(ImplicitArc arc);
  // From the last node on to the singular point next to it; none if there is none.
  std::optional<LastBit> lead_on(std::vector<Vec3>& nodes);
  std::optional<LastBit> lead_into(const ImplicitNode& node, std::vector<Vec3>& nodes);
  double rounding_at(const Vec3& p) const;
  Vec3 tangent(const Vec3& p, const Vec3& onward) const;
  // The known node whose cube meets a box.
  const ImplicitNode* node_around(const Box3& box) const;
  // A singular point of the surface, in or next to a box: grad F = 0 and F = level.
  std::optional<Vec3> singular_point(const Box3& box) const;

  const ImplicitBranch& branch_;
  const ImplicitFormula& formula_;
  const ImplicitRegion& region_;
  const ImplicitCondition& condition_;
  std::span<const ImplicitNode> nodes_;
  double size_;
  std::vector<Box3> open_;
  ImplicitArcs result_;
};

}  // namespace implicit_arc

}  // namespace lekalo::geometry
