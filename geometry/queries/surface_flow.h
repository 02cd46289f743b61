// Follows a line on a surface that is given by a differential equation, over the surface's smooth pieces to its border.
//
// The state y = (u, v, ...) obeys y' = rates(y), the independent variable being the length of the line in space. It is
// integrated by collocation (geometry/numerics/collocation.h) with steps so short that the last coefficients are below
// the tolerance, seen in space. Steps end on the borders of the surface's pieces, across which derivatives may jump, so
// that the equation is smooth within each. Where the surface is closed (its period is its domain's width) the line goes
// on, and its image in the parameter plane is not wrapped.
//
// A Law has
//   static constexpr int kSize                           of the state
//   std::optional<State> rates(const SurfaceJet&, const State&, const Vec3& before) const
//     the jet of order 2; `before` is the direction in space at the beginning of the step. None where there is no rate.
//   bool is_singular(const SurfaceJet&) const            no rate here or very near
//   bool cross(const SurfaceJet& from, const SurfaceJet& to, bool along_u, State&, const Vec3& before) const
//     takes the state over a line along which u (or v) changes and the derivatives may jump; false where it ends there
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "geometry/curves/surface_curve.h"
#include "geometry/numerics/collocation.h"
#include "geometry/queries/smooth_pieces.h"
#include "geometry/queries/surface_lines.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

struct FlowOptions {
  double length = kInfinity;   // to be followed
  double size = 1;             // of the surface or the line
  double tolerance = 2e-15;    // of a step, relative to the size
  double longest_step = 0.25;  // relative to the size
  bool may_close = false;      // ends where it comes back to the beginning in the same direction
};

template <class Law>
class SurfaceFlow {
 public:
  static constexpr int N = Law::kSize;
  using State = std::array<double, N>;
  static_assert(CollocationStep<N>::kNodes + 1 == PolynomialCurve::kTerms);

  SurfaceFlow(const Surface& surface, const Law& law, const FlowOptions& options)
      : surface_(surface), law_(law), options_(options), domain_(surface.domain()) {
    for (const SurfacePiece& piece : surface.pieces()) pieces_.push_back(piece.domain);
    if (pieces_.empty()) pieces_.push_back(domain_);
    const Periods periods = closed_periods(surface);
    period_[0] = periods.u;
    period_[1] = periods.v;
  }

  struct Result {
    std::vector<PolynomialCurve::Part> parts;
    State end;  // u and v unwrapped
    double length = 0;
    LineEnd why = LineEnd::length;
  };

  // From a state with u and v in the domain. No parts where the line leaves the domain at once.
  Result run(const State& start) {
    result_ = {};
    y_ = start;
    offset_ = {0, 0};
    if (const auto rate = law_.rates(jet(whole(), y_), y_, Vec3(0))) {
      before_ = motion(jet(whole(), y_), *rate);
      begin_point_ = jet(whole(), y_).point();
      begin_direction_ = before_;
      result_.why = follow(*rate);
    } else {
      result_.why = LineEnd::singular;
    }
    result_.end = y_;
    result_.end[0] += offset_[0];
    result_.end[1] += offset_[1];
    return std::move(result_);
  }

 private:
  using Step = CollocationStep<N>;
  struct Crossing {
    double x = 1;  // in the step
    int axis = 0;
    bool above = false;
  };

  static const Interval& side(const Rectangle& box, int axis) { return axis == 0 ? box.u : box.v; }
  const Rectangle& whole() const { return domain_; }
  // At the border of the piece the derivatives are those inside of it. Beyond, where only steps that are cut afterwards
  // reach, the surface goes on as it does.
  SurfaceJet jet(const Rectangle& piece, const State& y) const {
    const auto inside = [](const Interval& range, double x) {
      const double room = 4 * slack(range);
      return x >= range.lo - room && x <= range.hi + room && range.width() < kInfinity ? within(range, x) : x;
    };
    return surface_.evaluate(inside(piece.u, y[0]), inside(piece.v, y[1]), 2);
  }
  static Vec3 motion(const SurfaceJet& at, const State& rate) { return rate[0] * at.du() + rate[1] * at.dv(); }
  // Numbers of a range that are one but for rounding.
  static double slack(const Interval& range) {
    const double largest = std::max(std::abs(range.lo), std::abs(range.hi));
    return largest < kInfinity ? 8e-16 * largest : 0;
  }
  static double value(const Step& step, int i, double x) {  // Clenshaw
    double b1 = 0, b2 = 0;
    for (std::size_t k = step.series[i].size(); k-- > 1;) {
      const double b0 = step.series[i][k] + 2 * x * b1 - b2;
      b2 = b1, b1 = b0;
    }
    return step.series[i][0] + x * b1 - b2;
  }

  LineEnd follow(State rate) {
    int piece = -1;
    const double shortest = 1e-9 * options_.size;
    double h = std::min(0.05, options_.longest_step) * options_.size;
    constexpr int kMostCuts = 40;
    int cuts = 0;
    double cut = kInfinity;  // the step to the border of the piece
    for (;;) {
      // Over borders of pieces, several at a corner.
      for (int times = 0; piece < 0 || leaves(pieces_[piece], rate); ++times) {
        if (times == 4) return LineEnd::border;
        if (const auto end = enter_next(piece, rate)) return *end;
        const auto next = law_.rates(jet(pieces_[piece], y_), y_, before_);
        if (!next) return LineEnd::singular;
        rate = *next;
      }
      const double left = options_.length - result_.length;
      if (!(left > 1e-15 * options_.length)) return LineEnd::length;
      const double now = std::min({h, left, cut});
      std::optional<Step> step =
          collocate<N>(y_, now, [&](const State& y) { return law_.rates(jet(pieces_[piece], y), y, before_); });
      if (const auto crossing = step ? first_crossing(pieces_[piece], *step) : std::nullopt) {
        cut = 0.5 * now * (1 + crossing->x);
        if (cut > 1e-15 * options_.size && ++cuts < kMostCuts) continue;
        // As good as on the border: that is said so that the next step begins there.
        const Interval& range = side(pieces_[piece], crossing->axis);
        y_[crossing->axis] = crossing->above ? range.hi : range.lo;
        if (cuts++ > 2 * kMostCuts) return LineEnd::jagged;
        cut = kInfinity;
        continue;
      }
      const double error = step ? error_of(pieces_[piece], *step) : kInfinity;
      if (!(error <= options_.tolerance * options_.size)) {
        h = 0.5 * now;
        if (h > std::min(shortest, 0.5 * left)) continue;
        return give_up(pieces_[piece], rate);
      }
      const bool free = now >= h;
      cuts = 0;
      cut = kInfinity;
      const auto end = options_.may_close && result_.length > 0 ? close(pieces_[piece], *step) : std::nullopt;
      accept(*step);
      if (end) return *end;
      const SurfaceJet here = jet(pieces_[piece], y_);
      const auto next = law_.rates(here, y_, before_);
      if (!next) return LineEnd::singular;
      rate = *next;
      before_ = motion(here, rate);
      const double growth = 0.9 * std::pow(options_.tolerance * options_.size / std::max(error, 1e-300), 1.0 / 15);
      if (free) h = std::min(h * std::clamp(growth, 0.5, 2.0), options_.longest_step * options_.size);
      h = std::max(h, shortest);
    }
  }

  // Of u and v, and of what their rates make of it, seen in space.
  double error_of(const Rectangle& piece, const Step& step) const {
    double u = 0, v = 0;
    for (const State& y : {y_, step.states[Step::kNodes / 2], step.end}) {
      const SurfaceJet at = surface_.evaluate(piece.u.clamp(y[0]), piece.v.clamp(y[1]), 1);
      u = std::max(u, glm::length(at.du()));
      v = std::max(v, glm::length(at.dv()));
    }
    double error = step.tail[0] * u + step.tail[1] * v;
    if constexpr (N >= 4) error += step.h * (step.tail[2] * u + step.tail[3] * v);
    return error / Step::kNodes;  // of the integral of the last terms
  }

  // Where the step first leaves the piece.
  std::optional<Crossing> first_crossing(const Rectangle& piece, const Step& step) const {
    const auto outside = [&](double u, double v, double room) -> std::optional<Crossing> {
      const double place[2] = {u, v};
      for (int axis = 0; axis < 2; ++axis) {
        const Interval& range = side(piece, axis);
        if (place[axis] > range.hi + room * slack(range)) return Crossing{1, axis, true};
        if (place[axis] < range.lo - room * slack(range)) return Crossing{1, axis, false};
      }
      return std::nullopt;
    };
    double lo = -1, hi = 1;
    std::optional<Crossing> found;
    for (int j = Step::kNodes - 1; j >= -1 && !found; --j) {
      const State& y = j >= 0 ? step.states[j] : step.end;
      hi = j >= 0 ? chebyshev_point(j, Step::kNodes) : 1;
      found = outside(y[0], y[1], 1);
      if (!found) lo = hi;
    }
    if (!found) return std::nullopt;
    for (int time = 0; time < 60; ++time) {
      const double middle = 0.5 * (lo + hi);
      if (const auto there = outside(value(step, 0, middle), value(step, 1, middle), 0)) {
        hi = middle;
        found = there;
      } else {
        lo = middle;
      }
    }
    found->x = hi;
    return found;
  }

  // The line stands on the border of the piece and leaves it. It is put onto the border exactly.
  bool leaves(const Rectangle& piece, const State& rate) {
    bool result = false;
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = side(piece, axis);
      const double room = 4 * slack(range);
      if (y_[axis] >= range.hi - room && rate[axis] > 0) {
        y_[axis] = range.hi;
        result = result || is_across(range, rate[axis]);
      } else if (y_[axis] <= range.lo + room && rate[axis] < 0) {
        y_[axis] = range.lo;
        result = result || is_across(range, rate[axis]);
      }
    }
    return result;
  }
  // A line along a border does not leave it by rounding.
  bool is_across(const Interval& range, double rate) const {
    return std::abs(rate) * options_.size > 1e-13 * range.width();
  }

  // Finds the piece that the line goes on in; an end where there is none.
  std::optional<LineEnd> enter_next(int& piece, State& rate) {
    int across = -1;  // of the border that is left
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = side(domain_, axis);
      const double room = 4 * slack(range);
      const bool above = rate[axis] > 0 && y_[axis] >= range.hi - room && is_across(range, rate[axis]);
      const bool below = rate[axis] < 0 && y_[axis] <= range.lo + room && is_across(range, rate[axis]);
      if (piece >= 0 &&
          (rate[axis] > 0 ? y_[axis] == side(pieces_[piece], axis).hi : y_[axis] == side(pieces_[piece], axis).lo))
        across = axis;
      if (!above && !below) continue;
      const DegenerateEdges edges = surface_.degenerate_edges();
      const bool pole = axis == 0 ? (above ? edges.u_max : edges.u_min) : (above ? edges.v_max : edges.v_min);
      if (pole) return LineEnd::pole;
      if (period_[axis] == 0) return LineEnd::border;
      across = axis;
      y_[axis] = above ? range.lo : range.hi;
      offset_[axis] += above ? period_[axis] : -period_[axis];
    }
    const int before = piece;
    const SurfaceJet from = before >= 0 ? jet(pieces_[before], y_before_crossing(before)) : SurfaceJet(2);
    piece = -1;
    for (size_t i = 0; i < pieces_.size() && piece < 0; ++i)
      if (holds_ahead(pieces_[i], rate)) piece = static_cast<int>(i);
    if (piece < 0) return LineEnd::border;
    if (before < 0 || across < 0) return std::nullopt;
    if (!law_.cross(from, jet(pieces_[piece], y_), across == 1, y_, before_)) return LineEnd::border;
    return std::nullopt;
  }
  // The same place seen from the piece that is left: at the other end of the range where it is closed.
  State y_before_crossing(int piece) const {
    State y = y_;
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = side(pieces_[piece], axis);
      if (period_[axis] == 0 || range.contains(y[axis])) continue;
      y[axis] += y[axis] < range.lo ? period_[axis] : -period_[axis];
    }
    return y;
  }
  bool holds_ahead(const Rectangle& piece, const State& rate) const {
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = side(piece, axis);
      const double room = 4 * slack(range);
      if (y_[axis] < range.lo - room || y_[axis] > range.hi + room) return false;
      const bool across = is_across(side(domain_, axis), rate[axis]);
      if (across && rate[axis] > 0 && y_[axis] >= range.hi - room) return false;
      if (across && rate[axis] < 0 && y_[axis] <= range.lo + room) return false;
    }
    return true;
  }

  void accept(const Step& step) {
    add_part(step.h, step.powers(0), step.powers(1));
    y_ = step.end;
  }
  template <class Powers>
  void add_part(double h, const Powers& u, const Powers& v) {
    PolynomialCurve::Part part;
    part.t = {result_.length, result_.length + h};
    part.scale = 2 / h;  // the parameters of long lines round more than short steps
    for (std::size_t k = 0; k < u.size(); ++k) part.powers[k] = Vec3(u[k], v[k], 0);
    part.powers[0] += Vec3(offset_[0], offset_[1], 0);
    result_.parts.push_back(part);
    result_.length += h;
  }

  // No step is short enough: next to a pole, the rest is a parameter line; next to a singular point it ends.
  LineEnd give_up(const Rectangle& piece, const State& rate) {
    const SurfaceJet here = jet(piece, y_);
    const DegenerateEdges edges = surface_.degenerate_edges();
    constexpr double kNear = 1e-6;  // a geodesic is this near a straight line there, squared
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = side(domain_, axis);
      const bool above = rate[axis] > 0;
      if (!(axis == 0 ? (above ? edges.u_max : edges.u_min) : (above ? edges.v_max : edges.v_min))) continue;
      const double to = above ? range.hi : range.lo;
      const Vec3 pole = axis == 0 ? surface_.point(to, y_[1]) : surface_.point(y_[0], to);
      const double rest = glm::length(pole - here.point());
      if (!(rest <= kNear * options_.size) || !(rest < options_.length - result_.length)) continue;
      std::array<double, Step::kNodes + 1> powers[2] = {};
      powers[0][0] = y_[0];
      powers[1][0] = y_[1];
      powers[axis][0] = 0.5 * (y_[axis] + to);
      powers[axis][1] = 0.5 * (to - y_[axis]);
      add_part(rest, powers[0], powers[1]);
      y_[axis] = to;
      return LineEnd::pole;
    }
    return law_.is_singular(here) ? LineEnd::singular : LineEnd::jagged;
  }

  // Cuts the step where it comes back to the beginning.
  std::optional<LineEnd> close(const Rectangle& piece, Step& step) const {
    const auto ahead = [&](double u, double v) {
      return glm::dot(surface_.point(u, v) - begin_point_, begin_direction_);
    };
    double lo = -1;
    bool before = ahead(y_[0], y_[1]) < 0;
    for (int j = Step::kNodes - 1; j >= -1; --j) {
      const State& y = j >= 0 ? step.states[j] : step.end;
      const double hi = j >= 0 ? chebyshev_point(j, Step::kNodes) : 1;
      const bool now = ahead(y[0], y[1]) < 0;
      if (before && !now && glm::length(surface_.point(y[0], y[1]) - begin_point_) < step.h) {
        double a = lo, b = hi;
        for (int time = 0; time < 60; ++time) {
          const double middle = 0.5 * (a + b);
          (ahead(value(step, 0, middle), value(step, 1, middle)) < 0 ? a : b) = middle;
        }
        const Vec3 there = surface_.point(value(step, 0, b), value(step, 1, b));
        if (glm::length(there - begin_point_) <= kClosedCurve * options_.size) {
          const auto cut = collocate<N>(y_, 0.5 * step.h * (1 + b),
                                        [&](const State& at) { return law_.rates(jet(piece, at), at, before_); });
          if (cut) {
            step = *cut;
            return LineEnd::closed;
          }
        }
      }
      before = now;
      lo = hi;
    }
    return std::nullopt;
  }

  const Surface& surface_;
  const Law& law_;
  const FlowOptions options_;
  const Rectangle domain_;
  std::vector<Rectangle> pieces_;
  double period_[2] = {0, 0};

  Result result_;
  State y_;
  std::array<double, 2> offset_{};
  Vec3 before_{0}, begin_point_{0}, begin_direction_{0};
};

}  // namespace lekalo::geometry
