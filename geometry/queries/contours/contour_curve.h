// A contour as a curve: it carries solutions of its equations as nodes and solves them again where it is evaluated
// (Golovanov 2016, 4.7; capabilities 4.7a, 4.7d).
//
// Its parameter is the length of the polygon of its nodes. Between two nodes the point at t lies in the plane across
// the chord through the chord's point at t; with the equations these are N equations for N unknowns. Their Taylor
// series gives the derivatives, their intervals the enclosures.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "geometry/contour.h"
#include "geometry/curve.h"
#include "geometry/queries/contours/contour_equations.h"

namespace lekalo::geometry {

// The part of a contour between two nodes.
template <int N>
struct ContourSegment {
  std::shared_ptr<const ContourEquations<N>> equations;
  ParameterPoint<N> begin{}, end{};
  // Holds the part and nothing else that solves the equations; empty intervals next to a singular solution, where no
  // such box is known and the part is as good as its chord.
  ParameterBox<N> tube{};
  // What the parameters are to be increased by so that they go on from the segment before: multiples of periods.
  ParameterPoint<N> shift{};
  Vec3 from{0}, to{0};
  Interval t;
  bool is_certified() const { return !tube[0].empty(); }
};

// The parameters of a contour as functions of its own. Immutable; safe to use from many threads.
template <int N>
class ContourSolution {
 public:
  // Segments in order, each beginning where the one before ends; t is set here. At least one, none of length zero.
  ContourSolution(std::vector<ContourSegment<N>> segments, bool closed);

  const std::vector<ContourSegment<N>>& segments() const { return segments_; }
  Interval domain() const { return {0, segments_.back().t.hi}; }
  bool is_closed() const { return closed_; }
  int highest_order() const { return segments_.front().equations->highest_order(); }

  struct Series {
    std::array<Jet<double, kMaxContourOrder>, N> x;
    Triple<Jet<double, kMaxContourOrder>> point;
  };
  // Taylor polynomials about t, with coefficients up to `order`; throws std::invalid_argument beyond highest_order().
  // Where the contour is closed t wraps, else it is moved to the domain.
  Series at(double t, int order) const;

  struct Ranges {
    std::array<std::array<Interval, 3>, N> x;  // [parameter][derivative]
    std::array<Box3, 3> point;
  };
  // Certified, up to `order` 2; t inside the domain.
  Ranges over(const Interval& t, int order) const;

  double wrap(double t) const;

 private:
  const ContourSegment<N>& segment_at(double t) const;
  ParameterPoint<N> solve(const ContourSegment<N>& segment, double t) const;
  Ranges over_segment(const ContourSegment<N>& segment, const Interval& t, int order) const;
  const std::vector<Ranges>& over_whole_segments(int order) const;

  std::vector<ContourSegment<N>> segments_;
  bool closed_ = false;
  // Of whole segments, which searches ask for again and again; without and with second derivatives.
  mutable std::array<std::once_flag, 2> asked_;
  mutable std::array<std::vector<Ranges>, 2> over_whole_segments_;
};

// In space.
template <int N>
class ContourCurve final : public SearchedCurve {
 public:
  explicit ContourCurve(std::shared_ptr<const ContourSolution<N>> solution) : solution_(std::move(solution)) {}

  Interval domain() const override { return solution_->domain(); }
  double period() const override { return solution_->is_closed() ? domain().width() : 0; }
  bool is_closed() const override { return solution_->is_closed(); }
  // Derivatives up to the fourth, the third of silhouettes, isophotes and reflection lines; throws
  // std::invalid_argument beyond. Outside of the domain it goes on along its end tangent.
  CurveJet evaluate(double t, int order) const override;
  int max_order() const override { return solution_->highest_order(); }
  CurveEnclosure enclose(const Interval& t, int order) const override;
  std::vector<CurvePiece> pieces() const override;
  const ContourSolution<N>& solution() const { return *solution_; }

 private:
  std::shared_ptr<const ContourSolution<N>> solution_;
};

// Two of the parameters, as a curve in a parameter plane with the same parameter.
template <int N>
class ContourImage final : public Curve {
 public:
  ContourImage(std::shared_ptr<const ContourSolution<N>> solution, int first)
      : solution_(std::move(solution)), first_(first) {}

  Interval domain() const override { return solution_->domain(); }
  CurveJet evaluate(double t, int order) const override;
  int max_order() const override { return solution_->highest_order(); }
  CurveEnclosure enclose(const Interval& t, int order) const override;
  std::vector<CurvePiece> pieces() const override;
  const std::shared_ptr<const ContourSolution<N>>& solution() const { return solution_; }
  int first() const { return first_; }

 private:
  std::shared_ptr<const ContourSolution<N>> solution_;
  int first_;  // 0 or 2
};

}  // namespace lekalo::geometry
