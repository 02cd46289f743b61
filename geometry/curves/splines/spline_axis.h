// One parameter direction of a spline: degree, knots, domain, and what happens outside it.
#pragma once

#include <string>
#include <vector>

#include "geometry/curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

// What a spline does outside its domain.
enum class Extension {
  tangent,   // continues along its end tangent
  analytic,  // a single polynomial piece: continues as itself
  periodic   // repeats
};

class SplineAxis {
 public:
  // The full knot vector; the domain is knots[degree] .. knots[knots.size() - 1 - degree]. A periodic axis has its
  // first `degree` control points repeated at the end (count() counts them). Throws FieldError (fields degree, knots)
  // for a degree outside 1..kMaxDegree, decreasing knots, a multiplicity above degree + 1, an empty domain; for a
  // periodic axis unless t_{k+n} = t_k + T for n distinct points, k = 0..2 degree. Knots closer than kSameKnot of their
  // range become equal.
  SplineAxis(int degree, std::vector<double> knots, Extension extension);

  // The axis restricted to a part of its domain; on a periodic axis any part not longer than the period, over the seam
  // too: then the knots are unrolled over two periods, and count() grows.
  // Throws FieldError (field domain).
  void restrict_to(const Interval& part);

  int degree() const { return degree_; }
  const std::vector<double>& knots() const { return knots_; }
  int count() const { return static_cast<int>(knots_.size()) - degree_ - 1; }  // control points, repeated ones included
  const Interval& domain() const { return domain_; }
  double period() const { return period_; }
  bool periodic() const { return extension_ == Extension::periodic; }
  // Distinct control points of a periodic axis (point i is point i modulo distinct()); count() of an open one.
  int distinct() const { return distinct_; }

  // Where a parameter falls: t is evaluated on `span`, the curve continues `beyond` further along its tangent.
  struct Place {
    int span;
    double t;
    double beyond;
  };
  Place place(double t) const;

  // The non-empty spans (indices) that overlap an interval of the domain; one that only touches its upper end does not.
  std::vector<int> spans_over(const Interval& t) const;

 private:
  int degree_;
  std::vector<double> knots_;
  Extension extension_;
  Interval domain_;
  Interval whole_;  // one period, or the whole of an open axis
  double period_ = 0;
  int distinct_ = 0;
};

// The knots that a rule makes for control points at the given places (cumulated distances of their polygon, from 0;
// used by chord_length and centripetal only):
//   clamped       0 (degree + 1 times), 1, 2, .., n - degree, then n - degree + 1 (degree + 1 times); points 0..n
//   uniform       0, 1, 2, ..; the curve does not reach its end points
//   chord_length  clamped; interior knots are means of `degree` neighbouring places (Piegl, Tiller 1997, 9.2.1)
//   centripetal   the same with square roots of distances
// Closed: t_i = i - degree for clamped and uniform (a closed curve has no ends to clamp), means of places otherwise;
// the domain begins at 0. `places` then has one entry more than points: the closing distance included.
std::vector<double> knots_by_rule(const std::string& rule, int degree, int points, bool closed,
                                  const std::vector<double>& places);

// The axis of a scene's `degree`, `knots` and `closed`, for `points` unrepeated control points. `steps` are the
// distances between neighbouring control points, the closing one included (points of them) when closed. Throws
// FieldError for too few points, and for a knot vector of a wrong length, saying the right one.
SplineAxis make_axis(int degree, const Knots& knots, bool closed, int points, const std::vector<double>& steps);

}  // namespace lekalo::geometry
