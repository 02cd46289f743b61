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
//   static constexpr bool kPassesPoles                   goes on straight where it meets a pole
//   bool cross(const SurfaceJet& from, const SurfaceJet& to, bool along_u, State&, const Vec3& before) const
//     takes the state over a line along which u (or v) changes and the derivatives may jump; false where it ends there
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/numerics/collocation.h"
#include "geometry/queries/surface_lines/flow_domain.h"
#include "geometry/queries/surface_lines/surface_lines.h"
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
      : surface_(surface), law_(law), options_(options), domain_(surface) {}

  struct Result {
    std::vector<PolynomialCurve::Part> parts;
    State end;  // u and v unwrapped
    double length = 0;
    double beside = 0;  // the largest distance at which it passes a pole whose zone it crosses
    LineEnd why = LineEnd::length;
  };

  // From a state with u and v in the domain. No parts where the line leaves the domain at once.
  Result run(const State& start) {
    result_ = {};
    y_ = start;
    offset_ = {0, 0};
    if (const auto rate = law_.rates(jet(domain_.whole, y_), y_, Vec3(0))) {
      before_ = motion(jet(domain_.whole, y_), *rate);
      begin_point_ = jet(domain_.whole, y_).point();
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
  using Pole = FlowDomain::Pole;
  // How near to a pole steps get shorter, and where a line is taken to be straight, both of the size. There polar
  // coordinates are bad ones. It leaves the zone where a straight line would, right but for the zone's square; in
  // between the image runs through the pole, off by how far the line passes beside it.
  static constexpr double kPoleView = 0.2, kPoleZone = 1e-7;

  struct Crossing {
    double x = 1;  // in the step
    int axis = 0;
    bool above = false;
  };

  // At the border of the piece the derivatives are those inside of it. Beyond, where only steps that are cut afterwards
  // reach, the surface goes on as it does, but not beyond the domain: there it may be without curvature.
  SurfaceJet jet(const Rectangle& piece, const State& y) const {
    double x[2] = {y[0], y[1]};
    for (int axis = 0; axis < 2; ++axis) {
      const Interval &range = side(piece, axis), &all = side(domain_.whole, axis);
      const double room = 4 * slack(range);
      if (x[axis] >= range.lo - room && x[axis] <= range.hi + room && range.width() < kInfinity)
        x[axis] = within(range, x[axis]);
      else if (domain_.period[axis] == 0)
        x[axis] = all.width() < kInfinity ? within(all, x[axis]) : all.clamp(x[axis]);
    }
    return surface_.evaluate(x[0], x[1], 2);
  }
  static Vec3 motion(const SurfaceJet& at, const State& rate) { return rate[0] * at.du() + rate[1] * at.dv(); }
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
    double h = std::min(0.05, options_.longest_step) * options_.size;
    for (;;) {
      // Over borders of pieces, several at a corner.
      for (int times = 0; piece < 0 || leaves(domain_.pieces[piece], rate); ++times) {
        if (times == 4) return LineEnd::border;
        if (const auto end = enter_next(piece, rate)) return *end;
        if (!update(domain_.pieces[piece], rate)) return LineEnd::singular;
      }
      const double left = options_.length - result_.length;
      if (!(left > 1e-15 * options_.length)) return LineEnd::length;
      double longest = left;
      if (const Pole* pole = pole_ahead(domain_.pieces[piece], rate)) {
        const double distance = glm::length(pole->point - jet(domain_.pieces[piece], y_).point());
        if (distance <= kPoleZone * options_.size) {
          if (const auto end = cross_zone(*pole, domain_.pieces[piece], rate)) return *end;
          if (!update(domain_.whole, rate)) return LineEnd::pole;
          piece = -1;
          continue;
        }
        longest = std::min(longest, 0.7 * distance);
      }
      std::optional<Step> step = longest_step(domain_.pieces[piece], h, longest);
      if (!step) return law_.is_singular(jet(domain_.pieces[piece], y_)) ? LineEnd::singular : LineEnd::jagged;
      const auto end = options_.may_close && result_.length > 0 ? close(domain_.pieces[piece], *step) : std::nullopt;
      add_part(step->h, step->powers(0), step->powers(1));
      y_ = step->end;
      if (end) return *end;
      if (!update(domain_.pieces[piece], rate)) return LineEnd::singular;
      before_ = motion(jet(domain_.pieces[piece], y_), rate);
    }
  }

  bool update(const Rectangle& piece, State& rate) const {
    const auto next = law_.rates(jet(piece, y_), y_, before_);
    if (next) rate = *next;
    return next.has_value();
  }

  // A step of the length h, or `longest`, or to the border of the piece, or shorter: such that its error is small. h
  // becomes the length of the next one. None where no step is short enough.
  std::optional<Step> longest_step(const Rectangle& piece, double& h, double longest) const {
    constexpr int kMaxCuts = 30;
    const double shortest = 1e-11 * options_.size, allowed = options_.tolerance * options_.size;
    double cut = kInfinity;
    std::optional<Crossing> aim;  // at which the cut step should end
    for (int cuts = 0;;) {
      const double now = std::min({h, longest, cut});
      std::optional<Step> step = try_step(piece, now);
      if (const auto crossing = step ? first_crossing(piece, *step) : std::nullopt; crossing && cuts < kMaxCuts) {
        // A polynomial that reaches beyond the border is not quite the line: so the end is sought in turns.
        aim = crossing;
        cut = std::max(0.5 * now * (1 + crossing->x), 1e-16 * options_.size);
        ++cuts;
        continue;
      }
      const double error = step ? error_of(piece, *step) : kInfinity;
      if (!(error <= allowed)) {
        h = 0.5 * now;
        cut = kInfinity;
        aim.reset();
        if (h > std::min(shortest, 0.5 * longest)) continue;
        return std::nullopt;
      }
      if (aim && now == cut && cuts < kMaxCuts) {
        const Interval& range = side(piece, aim->axis);
        const double rest = (aim->above ? range.hi : range.lo) - step->end[aim->axis];
        const double speed = (step->end[aim->axis] - value(*step, aim->axis, 0.99)) / (0.005 * now);
        if (std::abs(rest) > 2 * slack(range) && std::abs(rest / speed) < 0.1 * now) {
          cut = now + rest / speed;
          ++cuts;
          continue;
        }
      }
      const double growth = std::clamp(0.9 * std::pow(allowed / std::max(error, 1e-300), 1.0 / 15), 0.5, 2.0);
      if (now >= h) h = std::max(std::min(h * growth, options_.longest_step * options_.size), shortest);
      return step;
    }
  }

  std::optional<Step> try_step(const Rectangle& piece, double h) const {
    return collocate<N>(y_, h, [&](const State& y) { return law_.rates(jet(piece, y), y, before_); });
  }

  // Of u and v, and of what a wrong direction makes of it later, seen in space.
  double error_of(const Rectangle& piece, const Step& step) const {
    double u = 0, v = 0;
    for (const State& y : {y_, step.states[Step::kNodes / 2], step.end}) {
      const SurfaceJet at = surface_.evaluate(piece.u.clamp(y[0]), piece.v.clamp(y[1]), 1);
      u = std::max(u, glm::length(at.du()));
      v = std::max(v, glm::length(at.dv()));
    }
    double error = step.tail[0] * std::max(u, domain_.speeds[0]) + step.tail[1] * std::max(v, domain_.speeds[1]);
    if constexpr (N >= 4) error += options_.size * (step.tail[2] * u + step.tail[3] * v);
    // Next to a pole the rounding of u and v turns the direction; no step is better than that.
    for (int k = 0; k < 2; ++k)
      if (domain_.speeds[k] > 0) error *= std::min(1.0, 10 * (k == 0 ? u : v) / domain_.speeds[k]);
    return error / Step::kNodes;  // of the integral of the last terms
  }

  // Where the step first leaves the piece; not where a line along a border is beyond it by rounding.
  std::optional<Crossing> first_crossing(const Rectangle& piece, const Step& step) const {
    std::optional<Crossing> first;
    for (int axis = 0; axis < 2; ++axis)
      for (const bool above : {false, true}) {
        const Interval& range = side(piece, axis);
        const double border = above ? range.hi : range.lo;
        if (!(std::abs(border) < kInfinity)) continue;
        const auto beyond = [&](double x) { return above ? x - border : border - x; };
        const double room = range.width() < kInfinity ? 1e-14 * range.width() : 0;
        double lo = -1;
        for (int j = Step::kNodes - 1; j >= -1; --j) {
          double hi = j >= 0 ? chebyshev_point(j, Step::kNodes) : 1;
          if (!(beyond((j >= 0 ? step.states[j] : step.end)[axis]) > room)) {
            lo = hi;
            continue;
          }
          for (int time = 0; time < 60; ++time) {
            const double middle = 0.5 * (lo + hi);
            (beyond(value(step, axis, middle)) > 0 ? hi : lo) = middle;
          }
          if (!first || hi < first->x) first = Crossing{hi, axis, above};
          break;
        }
      }
    return first;
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
      const Interval& range = side(domain_.whole, axis);
      const double room = 4 * slack(range);
      const bool above = rate[axis] > 0 && y_[axis] >= range.hi - room && is_across(range, rate[axis]);
      const bool below = rate[axis] < 0 && y_[axis] <= range.lo + room && is_across(range, rate[axis]);
      if (piece >= 0 && (rate[axis] > 0 ? y_[axis] == side(domain_.pieces[piece], axis).hi
                                        : y_[axis] == side(domain_.pieces[piece], axis).lo))
        across = axis;
      if (!above && !below) continue;
      const DegenerateEdges edges = surface_.degenerate_edges();
      const bool pole = axis == 0 ? (above ? edges.u_max : edges.u_min) : (above ? edges.v_max : edges.v_min);
      if (pole) return LineEnd::pole;
      if (domain_.period[axis] == 0) return LineEnd::border;
      across = axis;
      y_[axis] = above ? range.lo : range.hi;
      offset_[axis] += above ? domain_.period[axis] : -domain_.period[axis];
    }
    const int before = piece;
    const SurfaceJet from = before >= 0 ? jet(domain_.pieces[before], y_before_crossing(before)) : SurfaceJet(2);
    piece = -1;
    for (size_t i = 0; i < domain_.pieces.size() && piece < 0; ++i)
      if (holds_ahead(domain_.pieces[i], rate)) piece = static_cast<int>(i);
    if (piece < 0) return LineEnd::border;
    if (before < 0 || across < 0) return std::nullopt;
    if (!law_.cross(from, jet(domain_.pieces[piece], y_), across == 1, y_, before_)) return LineEnd::border;
    return std::nullopt;
  }
  // The same place seen from the piece that is left: at the other end of the range where it is closed.
  State y_before_crossing(int piece) const {
    State y = y_;
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = side(domain_.pieces[piece], axis);
      if (domain_.period[axis] == 0 || range.contains(y[axis])) continue;
      y[axis] += y[axis] < range.lo ? domain_.period[axis] : -domain_.period[axis];
    }
    return y;
  }
  bool holds_ahead(const Rectangle& piece, const State& rate) const {
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = side(piece, axis);
      const double room = 4 * slack(range);
      if (y_[axis] < range.lo - room || y_[axis] > range.hi + room) return false;
      const bool across = is_across(side(domain_.whole, axis), rate[axis]);
      if (across && rate[axis] > 0 && y_[axis] >= range.hi - room) return false;
      if (across && rate[axis] < 0 && y_[axis] <= range.lo + room) return false;
    }
    return true;
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

  // A pole that the line comes nearer to.
  const Pole* pole_ahead(const Rectangle& piece, const State& rate) const {
    if (domain_.poles.empty()) return nullptr;
    const SurfaceJet here = jet(piece, y_);
    const Vec3 direction = motion(here, rate);
    for (const Pole& pole : domain_.poles) {
      const Vec3 way = pole.point - here.point();
      if (glm::length(way) <= kPoleView * options_.size && glm::dot(way, direction) > 0) return &pole;
    }
    return nullptr;
  }

  // Goes through the zone of a pole, or as far as the line goes.
  std::optional<LineEnd> cross_zone(const Pole& pole, const Rectangle& piece, const State& rate) {
    const SurfaceJet here = jet(piece, y_);
    const Vec3 direction = motion(here, rate), way = pole.point - here.point();
    const double half = glm::dot(way, direction);  // of the chord
    const double left = options_.length - result_.length;
    result_.beside = std::max(result_.beside, glm::length(glm::cross(way, direction)));
    enter(pole, half, std::min(1.0, left / half));
    if (left <= half) return LineEnd::length;
    if constexpr (Law::kPassesPoles)
      if (leave(pole, half, 2 * half * direction - way, direction)) return std::nullopt;
    return LineEnd::pole;
  }

  // The line runs to a pole, or that part of the way, along a parameter line.
  void enter(const Pole& pole, double length, double part) {
    const double edge = domain_.edge(pole);
    const double to = part < 1 ? y_[pole.axis] + part * (edge - y_[pole.axis]) : edge;
    add_straight(length * part, pole.axis, y_[pole.axis], to);
    y_[pole.axis] = to;
  }

  // Where the pole is a smooth point of the surface the line goes on along the parameter line to a place that lies
  // `out` from it, in the direction there.
  bool leave(const Pole& pole, double length, const Vec3& out, const Vec3& direction) {
    const auto place = domain_.beyond(pole, out);
    if (!place) return false;
    y_[0] = place->x;
    y_[1] = place->y;
    add_straight(length, pole.axis, domain_.edge(pole), y_[pole.axis]);
    law_.turn(surface_.evaluate(y_[0], y_[1], 1), direction, y_);
    before_ = direction;
    return true;
  }

  void add_straight(double length, int axis, double from, double to) {
    std::array<double, Step::kNodes + 1> powers[2] = {};
    powers[1 - axis][0] = y_[1 - axis];
    powers[axis][0] = 0.5 * (from + to);
    powers[axis][1] = 0.5 * (to - from);
    add_part(length, powers[0], powers[1]);
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
          const auto cut = try_step(piece, 0.5 * step.h * (1 + b));
          if (cut) {
            step = *cut;
            return LineEnd::closed;
          }
        }
      }
      before = now;
      lo = hi;
    }
    // On a border of the domain steps end at the beginning itself.
    if (glm::length(surface_.point(step.end[0], step.end[1]) - begin_point_) <= 1e-12 * options_.size)
      return LineEnd::closed;
    return std::nullopt;
  }

  const Surface& surface_;
  const Law& law_;
  const FlowOptions options_;
  const FlowDomain domain_;

  Result result_;
  State y_;
  std::array<double, 2> offset_{};
  Vec3 before_{0}, begin_point_{0}, begin_direction_{0};
};

}  // namespace lekalo::geometry
