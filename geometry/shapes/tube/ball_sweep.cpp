#include "geometry/shapes/tube/ball_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/describe.h"
#include "geometry/numerics/chebyshev.h"
#include "geometry/numerics/halving.h"

namespace lekalo::geometry {

namespace {

// A cell's derivatives r' differ from the one in its middle by at most this part of it: larger cells make larger boxes
// and need halving for lines that see them from their ends, smaller ones are more for each line. Nor does the slope of
// the radius, R'/|r'|, change by more.
constexpr double kStraight = 0.3;
// The same for the slope of a law that is made of branches: it is cut at kinks and jumps.
constexpr double kEven = 0.05;
// Where the curve bends more than the tube, or has a cusp, cells have this part of the radius.
constexpr double kSmall = 0.25;
// Balls that differ by less than this part of the size are one.
constexpr double kSamePlace = 1e-13;
// A model agrees with its curve to this part of the size: unions are decided on it.
constexpr double kModelError = 2e-15;
// The longest last step of the search, of the radius: what it leaves is the square of that on s, and of no account.
constexpr double kLastStep = 1e-6;
// Longer steps, of the same, are not Newton's.
constexpr double kNewtonStep = 0.1;
// Enough for any curve that can be drawn.
constexpr size_t kMaxCells = size_t{1} << 20;

double farthest(const Box3& box, const Vec3& from) { return glm::length(glm::max(box.hi - from, from - box.lo)); }

double farthest(const Interval& range, double from) { return std::max(range.hi - from, from - range.lo); }

// Of a curve over a finite domain that is unbounded all the same: where its bounds stay infinite in ever shorter parts.
double unbounded_at(const Curve& curve) {
  Interval t = curve.domain();
  constexpr int kHalvings = 30;
  const double narrow = std::ldexp(t.width(), -kHalvings);
  for (int step = 0; step < kHalvings; ++step) {
    const Interval below{t.lo, t.middle()};
    t = curve.enclose(below, 0).d[0].bounded() ? Interval{below.hi, t.hi} : below;
  }
  return narrow * std::round(t.middle() / narrow) + 0.0;  // zero is no -4e-10
}

// Pieces of a curve leave its poles out.
bool has_pole(const Curve& curve) {
  const Interval domain = curve.domain();
  double end = domain.lo;
  for (const CurvePiece& piece : curve.pieces()) {
    if (piece.domain.lo > end) return true;
    end = piece.domain.hi;
  }
  return end < domain.hi;
}

}  // namespace

BallSweep::BallSweep(CurvePtr curve, RadiusLaw law) : curve_(std::move(curve)), law_(std::move(law)) {
  if (!(curve_->domain().width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a domain");
  const Box3 box = bounds(*curve_);
  if (!box.bounded() || has_pole(*curve_))
    throw FieldError(
        "of", fmt::format("the curve has no bounds or no value near its parameter {:.6g}", unbounded_at(*curve_)),
        "a pole, or a place such as 0/0: end the domain before it");
  size_ = box.diameter();
  if (!(size_ > 0)) throw FieldError("of", "the curve has no length");
  narrowest_ = 1e-15 * curve_->domain().width();
  for (const CurvePiece& piece : curve_->pieces()) cut(piece.domain);
}

BallJet BallSweep::ball(double t) const {
  const CurveJet jet = curve_->evaluate(t, 2);
  return {{jet.d[0], jet.d[1], jet.d[2]}, law_.at(t, jet)};
}

Interval BallSweep::moving(Interval range) const {
  const double inset = 1e-11 * range.width();
  const auto rests = [&](double t) { return !(glm::length(curve_->evaluate(t, 1).d[1]) > 0); };
  const bool at_begin = rests(range.lo), at_end = rests(range.hi);
  if (at_begin) range.lo += inset;
  if (at_end) range.hi -= inset;
  return range;
}

void BallSweep::cut(const Interval& t) {
  const CurveEnclosure boxes = curve_->enclose(t, 2);
  const std::array<Interval, 3> radius = law_.over(t, boxes);
  const double middle = t.middle(), h = 0.5 * t.width();
  Cell cell;
  cell.t = t;
  cell.middle = ball(middle);
  const auto& [r0, r1, r2] = cell.middle.center;
  const auto& [R0, R1, R2] = cell.middle.radius;
  if (!(R0 > 0 && R0 < kInfinity)) law_.refuse(middle, R0);
  cell.variation_bound = farthest(boxes.d[2], r2);
  cell.radius_variation_bound = farthest(radius[2], R2);
  cell.min_radius = radius[0].lo;
  const double speed = glm::length(r1), most = glm::length(r2) + cell.variation_bound, turn = most * h;
  const double extent = std::min(boxes.d[0].diameter(), 2 * h * (speed + 0.5 * turn)) + radius[0].width();

  cell.is_place = extent <= kSamePlace * size_ || t.width() <= narrowest_ || !can_be_halved(t);
  const bool positive = radius[0].lo > 0 && radius[0].hi < kInfinity;
  const double uneven = (law_.has_branches() ? kEven : kStraight) * speed;
  const bool even = radius[1].width() <= uneven && radius[0].width() <= 2 * h * (std::abs(R1) + uneven);
  // At a critical point (p - r) . r' = -R R', so that only the part of r'' across r' counts in full.
  const double along = speed > 0 ? glm::dot(r2, r1) / (speed * speed) : 0;
  const double across = glm::length(r2 - along * r1) + cell.variation_bound + std::abs(along) * turn;
  const double slope = magnitude(radius[1]), R = radius[0].hi;
  const double slowest = std::max(0.0, speed - turn);
  const double d =
      slowest * slowest - slope * slope - (radius[0] * radius[2]).hi - std::abs(along) * R * slope - R * across;
  // Where one ball holds all others there is no critical point.
  cell.regular = d > 0 || mignitude(radius[1]) > speed + turn;
  const bool straight = turn <= kStraight * speed;
  const bool small = extent <= kSmall * cell.min_radius &&
                     (cell.variation_bound <= 0.25 * glm::length(r2) || extent <= 0.01 * kSmall * cell.min_radius);
  bool is_good = cell.is_place || (positive && even && ((straight && cell.regular) || (small && most < kInfinity)));
  if (is_good) {
    add_model(cell);
    // Where two halves may have models they are worth more than the whole without one.
    is_good = cell.is_modelled || cell.is_place || extent < cell.min_radius;
  }
  if (!is_good) {
    if (cells_.size() >= kMaxCells)
      throw FieldError("of", "the curve takes more than a million pieces", "make it simpler, or its domain smaller");
    cut({t.lo, middle});
    cut({middle, t.hi});
    return;
  }
  if (!positive) law_.refuse(middle, radius[0].lo > 0 ? radius[0].hi : radius[0].lo);
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * (farthest(boxes.d[0], Vec3(0)) + R);
  cell.box = boxes.d[0].inflated(R + rounding);
  size_ = std::max(size_, 2 * R);
  cells_.push_back(cell);
}

void BallSweep::add_model(Cell& cell) const {
  const auto at = [&](double x) {
    const BallJet ball = this->ball(cell.t.middle() + 0.5 * cell.t.width() * x);
    return Vec4(ball.center[0] - cell.middle.center[0], ball.radius[0]);
  };
  std::array<Vec4, kModelTerms> values;
  for (int j = 0; j < kModelTerms; ++j) values[j] = at(chebyshev_point(j, kModelTerms));
  cell.model = powers_of_chebyshev(chebyshev_coefficients(values));
  cell.is_modelled = true;
  for (const double x : {-0.999, -0.6, -0.2, 0.35, 0.8, 0.999}) {
    Vec4 sum(0);
    for (int k = kModelTerms; k-- > 0;) sum = sum * x + cell.model[k];
    cell.is_modelled = cell.is_modelled && glm::length(sum - at(x)) <= kModelError * size_;
  }
}

BallJet BallSweep::ball(const Cell& cell, double t) const {
  const double scale = 2 / cell.t.width(), x = (t - cell.t.middle()) * scale;
  Vec4 f(0), f1(0), f2(0);
  for (int k = kModelTerms; k-- > 0;) {
    f2 = f2 * x + f1;
    f1 = f1 * x + f;
    f = f * x + cell.model[k];
  }
  f1 *= scale;
  f2 *= 2 * scale * scale;
  return {{cell.middle.center[0] + Vec3(f), Vec3(f1), Vec3(f2)}, {f.w, f1.w, f2.w}};
}

namespace {

// a and g with their derivatives at one parameter.
struct Profile {
  double a, a1, a2, g, g1, g2;
  Vec3 across, across1, across2;  // f and its derivatives

  Profile(const Line& line, const BallJet& ball) {
    const auto& [r0, r1, r2] = ball.center;
    const auto& [R0, R1, R2] = ball.radius;
    const Vec3 e = r0 - line.origin;
    a = glm::dot(e, line.direction), a1 = glm::dot(r1, line.direction), a2 = glm::dot(r2, line.direction);
    across = e - a * line.direction, across1 = r1 - a1 * line.direction, across2 = r2 - a2 * line.direction;
    g = R0 * R0 - glm::dot(across, across);
    g1 = 2 * (R0 * R1 - glm::dot(across, across1));
    g2 = 2 * (R1 * R1 + R0 * R2 - glm::dot(across1, across1) - glm::dot(across, across2));
  }
};

// The search for the minimum of b - sqrt(g), b = sign a, from one parameter.
struct Critical {
  int sign;
  double root, n, d, speed;

  Critical(const Profile& p, int sign)
      : sign(sign),
        root(std::sqrt(std::max(0.0, p.g))),
        n(sign * p.a1 * root - 0.5 * p.g1),
        d(p.a1 * p.a1 - 0.5 * p.g2 + sign * p.a2 * root),
        speed(glm::length(p.across1) + std::abs(p.a1)) {}

  // Newton's, or all the way down.
  double step(double to_lo, double to_hi) const { return d > 0 ? -n / d : n > 0 ? to_lo : to_hi; }
  // True if the square of the step is of no account.
  bool is_close(double step, double radius) const { return is_within(kLastStep, step, radius); }
  // True if Newton's iteration converges from here.
  bool is_near(double step, double radius) const { return is_within(kNewtonStep, step, radius); }
  bool is_within(double part, double step, double radius) const {
    return d > 0 && root > 0 && std::abs(step) * speed <= part * std::min(radius, root);
  }
  // The end of the ball's interval, moved by a step of Newton's iteration.
  double s(const Profile& p, double step) const {
    return p.a - sign * root + (step != 0 ? sign * 0.5 * n * step / root : 0);
  }
};

// The step to the minimum of b - sqrt(g) for the parabola and the straight line that touch g and a; none for a parabola
// that opens upward.
double step_to_model(const Profile& p, int sign) {
  const double k = -0.5 * p.g2;
  if (!(k > 0)) return 0;
  const double top = std::max(0.0, p.g + p.g1 * p.g1 / (4 * k));
  return p.g1 / (2 * k) - sign * p.a1 * std::sqrt(top / (k * (k + p.a1 * p.a1)));
}

// How far above its value a function can get within `width`, from its slope there and its largest second derivative.
double farthest_up(double slope, double second, double width) {
  return second < 0 && slope < -second * width ? -0.5 * slope * slope / second : (slope + 0.5 * second * width) * width;
}

// That of g far from the line, where g is known by its top: beside it a thin tube's R^2 may be nothing.
double rounding_of_g(double distance) { return 16 * std::numeric_limits<double>::epsilon() * distance * distance; }

// Bounds on them over the parameters within h of there.
struct Range {
  Interval a, a1, a2, g, g1, g2, root;

  Range(const Profile& p, const BallJet& ball, double h, const BallSweep::Cell& cell) {
    const auto about = [](double x, double by) { return Interval(x - by, x + by); };
    const double w = cell.variation_bound, v = cell.radius_variation_bound;
    const double max_a2 = std::abs(p.a2) + w;
    a2 = about(p.a2, w);
    a1 = about(p.a1, max_a2 * h);
    a = about(p.a, (std::abs(p.a1) + 0.5 * max_a2 * h) * h);
    // The terms of g''/2 = R'^2 + R R'' - f' . f' - f . f''.
    const double f0 = glm::length(p.across), f1 = glm::length(p.across1), f2 = glm::length(p.across2) + w;
    const double off1 = f2 * h, off0 = (f1 + 0.5 * off1) * h;
    const auto& [R0, R1, R2] = ball.radius;
    const double max_R2 = std::abs(R2) + v, off_R1 = max_R2 * h, off_R0 = (std::abs(R1) + 0.5 * off_R1) * h;
    const double middle = R0 * R2 - glm::dot(p.across, p.across2);
    const double off = off0 * f2 + f0 * w + off_R0 * max_R2 + R0 * v;
    const auto square = [](double x, double by) {
      const double lo = std::max(0.0, x - by);
      return Interval(lo * lo, (x + by) * (x + by));
    };
    const Interval bend = square(f1, off1), widen = square(std::abs(R1), off_R1);
    g2 = {2 * (middle - off + widen.lo - bend.hi), 2 * (middle + off + widen.hi - bend.lo)};
    const double max_g2 = std::max(-g2.lo, g2.hi);
    g1 = about(p.g1, max_g2 * h);
    // Below the parabola of the largest g'' that touches in the middle, above that of the least.
    const double slope = std::abs(p.g1);
    const double rounding = rounding_of_g(f0 + off0);
    g = {p.g - farthest_up(slope, -g2.lo, h) - rounding, p.g + farthest_up(slope, g2.hi, h) + rounding};
    root = {std::sqrt(std::max(0.0, g.lo)), std::sqrt(std::max(0.0, g.hi))};
  }

  // True if a - sqrt(g) (a + sqrt(g) for the sign -1) certainly has at most one critical point.
  bool is_simple(int sign) const {
    const Interval b1 = sign > 0 ? a1 : -a1, b2 = sign > 0 ? a2 : -a2;
    if ((sqr(a1) - 0.5 * g2 + b2 * root).lo > 0) return true;
    return !(b1 * root - 0.5 * g1).contains(0);
  }
};

class CellSolver {
 public:
  CellSolver(const BallSweep& sweep, int index, const Line& line, const SpanLimit& limit, LineSpans& spans)
      : sweep_(sweep),
        cell_(sweep.cells()[index]),
        index_(index),
        // At a break the curve's derivatives are those from the right.
        last_(next_down(cell_.t.hi)),
        same_(kSamePlace * sweep.size()),
        line_(line),
        limit_(limit),
        spans_(spans) {}

  void solve(const Interval& t, const BallJet& middle) {
    const Profile p(line_, middle);
    if (cell_.is_place) return add_ball(t.middle(), p);
    const double h = 0.5 * t.width();
    const Range range(p, middle, h, cell_);
    if (range.g.hi < 0) return;
    if (spans_.cover(range.a.lo - range.root.hi, range.a.hi + range.root.hi, same_)) return;
    const double extent =
        (glm::length(middle.center[1]) + (glm::length(middle.center[2]) + cell_.variation_bound) * h) * h;
    if (extent <= same_) return add_ball(t.middle(), p);
    const bool one_stretch = range.g.lo > 0 || range.g2.hi <= 0 || !range.g1.contains(0);
    const bool certain = one_stretch && (cell_.regular || (range.is_simple(1) && range.is_simple(-1)));
    if (!certain && !cell_.regular) add_ball(t.middle(), p);  // covers much of what follows
    if (certain || left_ == 0) {
      SpanEnd in, out;
      if (extreme(1, t, p, range.g2.hi, in) && extreme(-1, t, p, range.g2.hi, out)) add({in, out});
      return;
    }
    --left_;
    for (const Interval& half : {Interval(t.lo, t.middle()), Interval(t.middle(), t.hi)})
      solve(half, ball(half.middle()));
  }

 private:
  // Halvings of one cell for one line. A line along a valley of equal balls (the axis of a ring that has no hole) never
  // gets certain; after so many halvings one search a part is enough.
  static constexpr int kMaxHalvings = 1000;

  BallJet ball(double t) const { return cell_.is_modelled ? sweep_.ball(cell_, t) : sweep_.ball(t); }

  void add(Span span) {
    if (span.in.s < limit_.lo) span.in.s = limit_.lo, span.in.face = limit_.face_lo;
    if (span.out.s > limit_.hi) span.out.s = limit_.hi, span.out.face = limit_.face_hi;
    if (span.in.s < span.out.s) spans_.add(span);
  }

  void add_ball(double t, const Profile& p) {
    if (!(p.g >= 0)) return;
    const double root = std::sqrt(p.g);
    add({{p.a - root, t, index_, 0}, {p.a + root, t, index_, 0}});
  }

  // The minimum of b - sqrt(g), b = sign a, over the one stretch in t: the place where N = b' sqrt(g) - g'/2 changes
  // its sign, which is that of -g' where g < 0. Steps inside a bracket: near the place Newton's; else those to the
  // minimum of a model, for Newton's are far too short where a line nearly runs along the curve. False if there is no
  // stretch. second: the largest g''.
  bool extreme(int sign, const Interval& t, const Profile& at_middle, double second, SpanEnd& end) const {
    double lo = t.lo, hi = std::min(t.hi, last_), x = std::clamp(t.middle() + step_to_model(at_middle, sign), lo, hi);
    bool lo_tried = false, hi_tried = false;
    constexpr int kMaxSteps = 200, kHalving = 10;  // every tenth step halves the bracket, if all others fail
    for (int step = 0; step < kMaxSteps; ++step) {
      const Profile p(line_, ball(x));
      if (p.g < 0 &&
          p.g + farthest_up(std::abs(p.g1), second, p.g1 > 0 ? hi - x : x - lo) < -rounding_of_g(glm::length(p.across)))
        return false;
      const Critical critical(p, sign);
      const bool at_end = (x == lo && !lo_tried && critical.n >= 0) || (x == hi && !hi_tried && critical.n <= 0);
      const bool narrow = lo_tried && hi_tried && !(hi - lo > 4e-16 * (std::abs(lo) + std::abs(hi)));
      double next = x + critical.step(lo - x, hi - x);
      const bool close = next > lo && next < hi && critical.is_close(next - x, cell_.min_radius);
      if (at_end || close || critical.n == 0 || narrow || step + 1 == kMaxSteps) {
        if (!(p.g >= 0)) return false;
        end = {critical.s(p, close && !at_end ? next - x : 0), close && !at_end ? next : x, index_, 0};
        return true;
      }
      if (critical.n < 0)
        lo = x, lo_tried = true;
      else
        hi = x, hi_tried = true;
      if (p.g2 < 0 && !critical.is_near(next - x, cell_.min_radius)) next = x + step_to_model(p, sign);
      if (step % kHalving == kHalving - 1) next = 0.5 * lo + 0.5 * hi;
      next = std::clamp(next, lo, hi);
      if ((next == lo && lo_tried) || (next == hi && hi_tried)) next = 0.5 * lo + 0.5 * hi;
      x = next;
    }
    return false;
  }

  const BallSweep& sweep_;
  const BallSweep::Cell& cell_;
  int index_;
  double last_;
  double same_;
  const Line& line_;
  const SpanLimit& limit_;
  LineSpans& spans_;
  int left_ = kMaxHalvings;
};

}  // namespace

void BallSweep::add_spans(int cell, const Line& line, const SpanLimit& limit, LineSpans& spans) const {
  CellSolver(*this, cell, line, limit, spans).solve(cells_[cell].t, cells_[cell].middle);
}

void BallSweep::finish(SpanEnd& end, bool is_in, const Line& line) const {
  const Cell& cell = cells_[end.piece];
  const Profile p(line, ball(end.u));
  if (!(p.g > 0)) return;  // a touch, which the model sees by a hair
  const Critical critical(p, is_in ? 1 : -1);
  // At an end of its cell a minimum need not be critical.
  const double step = critical.step(0, 0);
  const bool moves = end.u + step > cell.t.lo && end.u + step < cell.t.hi && critical.is_close(step, cell.min_radius);
  end.s = critical.s(p, moves ? step : 0);
  if (moves) end.u += step;
}

}  // namespace lekalo::geometry
