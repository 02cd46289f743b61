// How near two curves are as a whole: Hausdorff's and Frechet's distance (Zavyalov et al. 1985, II.2), certified.
//
//   Hausdorff  max( max_(x in A) dist(x, B), max_(x in B) dist(x, A) )
//   Frechet    inf over monotone reparametrisations of max_t |f(t) - g(t)|; of curves with their ends as they are given
//
// Frechet's is never less than Hausdorff's.
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

// The distance lies in [lower, upper]. The bracket is made no wider than kNearness of it, if that can be had: not where
// the curves coincide (then it ends below 1e-8 of their size), and of Frechet's not where it is very small beside the
// curves.
struct Nearness {
  double lower = 0, upper = 0;
};
inline constexpr double kNearness = 1e-6;

struct HausdorffDistance : Nearness {
  bool of_first = true;       // the farthest point seen is one of the first curve, else of the second
  double t = 0;               // it is there on its curve
  Vec3 point{0}, nearest{0};  // it, and the nearest point of the other
};

// Both throw std::invalid_argument for a curve that is unbounded or jumps. Branch and bound: a part of a curve is left
// out where its farthest possible point is not above the farthest seen, by the enclosures of A(t) - B(s(t)) about a
// foot point; with so many parts of each curve, at most.
HausdorffDistance hausdorff_distance(const CurvePtr& a, const CurvePtr& b, int max_parts = 30000);

// By the free-space diagram of polylines (Alt, Godau 1995) whose deviation from the curves, bounded by h^2/8 |r''|, is
// added; made finer until the bracket is narrow.
Nearness frechet_distance(const Curve& a, const Curve& b);

}  // namespace lekalo::geometry
