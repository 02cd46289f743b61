// The elements that distances are measured between: points, lines and patches of a curve, surface or body, each with
// the ways that lead from it into its neighbours.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/bodies/trims/trim.h"
#include "geometry/queries/closest/distance.h"

namespace lekalo::geometry {

struct DistanceElement;

// A way off an element into one of more dimensions beside it, in the parameters of that one: `direction` in parts of
// its `scale`.
struct DistanceStep {
  const DistanceElement* into = nullptr;
  std::array<double, 2> at{}, direction{};
  // The place so far from `at`, within `into`.
  std::array<double, 2> moved(double by) const;
};
// Steps of that size stay in what they lead into.
inline constexpr double kSmallStep = 1e-4;

// Point and derivatives by the element's one or two parameters; second: by uu, uv, vv.
struct ElementJet {
  Vec3 point{0};
  std::array<Vec3, 2> first{};
  std::array<Vec3, 3> second{};
};
struct ElementRange {
  Box3 point;
  std::array<Box3, 2> first{};
  std::array<Box3, 3> second{};
};

struct DistanceElement {
  int dimension = 0;
  std::array<Interval, 2> domain{};          // of its parameters
  std::array<double, 2> scale{1, 1};         // their range on the whole curve or surface
  std::array<bool, 2> ends_lo{}, ends_hi{};  // where that border is an element of its own
  DistancePlace place;                       // what it is of; of a point: where
  CurvePtr curve;                            // dimension 1
  SurfacePtr surface;                        // dimension 2
  std::shared_ptr<const TrimRegion> trim;
  std::optional<double> held_u, held_v;  // of a parameter line of a surface
  Box3 box;
  bool flat = false;  // straight or plane:
  Vec3 axis{0};       // unit direction of the line, unit normal of the plane
  std::function<std::vector<DistanceStep>(const std::array<double, 2>&)> steps;  // none of an inner element

  ElementJet jet(const std::array<double, 2>& at) const;
  ElementRange range(const std::array<Interval, 2>& over) const;
  Vec3 at(const std::array<double, 2>& parameters) const;
  DistancePlace place_at(const std::array<double, 2>& parameters) const;
  // Whether the place is of the element: inside of its trim.
  bool keeps(const std::array<double, 2>& parameters) const;
  // `slack` is a part of the range.
  bool is_on_border(const std::array<double, 2>& parameters, double slack) const;
};

using DistanceElements = std::vector<std::unique_ptr<DistanceElement>>;

// `near`: an unbounded surface is cut to what can be nearest to a thing in that box.
DistanceElements distance_elements(const Distant& thing, const Box3& near);

Box3 bounds(const Distant& thing);

}  // namespace lekalo::geometry
