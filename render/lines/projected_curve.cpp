#include "render/lines/projected_curve.h"

#include <algorithm>
#include <cmath>

#include "geometry/numerics/halving.h"
#include "geometry/numerics/quadrature.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// See the head of the header.
constexpr double kTurn = 0.25;
constexpr double kBend = 0.5;
// Where a chord stands for a cell, in pixels: of one that runs straight, and of any.
constexpr double kShort = 0.05;
constexpr double kPlace = 0.01;
// Parts of a domain that are not divided, relative to it: there the enclosures tell nothing.
constexpr double kNarrowest = 1e-13;
// At depths that are a smaller part of the numbers of which they are the sum, places in the picture are told by
// rounding.
constexpr double kMinDepth = 1e-10;
// Enough for any curve that can be told from a blot; what is left then are chords.
constexpr size_t kMaxCells = size_t{1} << 20;
// Cells are joined where they meet, in pixels.
constexpr double kMeet = 1e-6;

// Cells are so short and even that this many places give the length of one to far less than a pixel.
constexpr int kPlacesOfLength = 4;

Interval range(const Box3& box, int axis) { return {box.lo[axis], box.hi[axis]}; }

// form . (p, at_points) for all p of the box; at_points is 0 for derivatives.
Interval over(const Vec4& form, const Box3& box, double at_points) {
  Interval sum = form.w * at_points;
  for (int k = 0; k < 3; ++k) sum += form[k] * range(box, k);
  return sum;
}

double apply(const Vec4& form, const Vec3& p, double at_points) { return glm::dot(Vec3(form), p) + form.w * at_points; }

// The largest of these terms over the box.
double largest_term(const Vec4& form, const Box3& box) {
  double largest = std::abs(form.w);
  for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(form[k]) * magnitude(range(box, k)));
  return largest;
}

double hypotenuse(const Interval& x, const Interval& y) { return std::hypot(magnitude(x), magnitude(y)); }

double distance_from_segment(const Vec2& q, const Vec2& a, const Vec2& b) {
  const Vec2 chord = b - a;
  const double square = glm::dot(chord, chord);
  const double x = square > 0 ? std::clamp(glm::dot(q - a, chord) / square, 0.0, 1.0) : 0;
  return glm::length(q - (a + x * chord));
}

}  // namespace

ProjectedCurve::ProjectedCurve(CurvePtr curve, const Affine& to_world, const Camera& camera, double reach)
    : curve_(std::move(curve)), to_world_(to_world), reach_(reach), picture_(camera.width(), camera.height()) {
  const PictureMap map = camera.picture_map();
  for (int k = 0; k < 3; ++k) {
    const Vec3 linear(map.row[k]);
    map_.row[k] = Vec4(glm::transpose(to_world.linear) * linear, glm::dot(linear, to_world.offset) + map.row[k].w);
  }
  narrowest_ = kNarrowest * curve_->domain().width();
  for (const CurvePiece& piece : curve_->pieces()) cut(piece.domain);
  link();
}

ProjectedCurve::Place ProjectedCurve::place_of(const CurveJet& at, double w, double w1) const {
  const auto& [row_x, row_y, row_w] = map_.row;
  const Vec2 p = Vec2(apply(row_x, at.d[0], 1), apply(row_y, at.d[0], 1)) / w;
  return {p, (Vec2(apply(row_x, at.d[1], 0), apply(row_y, at.d[1], 0)) - w1 * p) / w};
}

Vec2 ProjectedCurve::point(double t) const {
  const Vec3 r = curve_->point(t);
  return Vec2(apply(map_.row[0], r, 1), apply(map_.row[1], r, 1)) / apply(map_.row[2], r, 1);
}

ProjectedCurve::Place ProjectedCurve::place(double t) const {
  const CurveJet at = curve_->evaluate(t, 1);
  return place_of(at, apply(map_.row[2], at.d[0], 1), apply(map_.row[2], at.d[1], 0));
}

ProjectedCurve::Jet ProjectedCurve::jet(double t) const {
  const CurveJet at = curve_->evaluate(t, 2);
  const auto& [row_x, row_y, row_w] = map_.row;
  const double w = apply(row_w, at.d[0], 1), w1 = apply(row_w, at.d[1], 0), w2 = apply(row_w, at.d[2], 0);
  const auto [p, p1] = place_of(at, w, w1);
  return {p, p1, (Vec2(apply(row_x, at.d[2], 0), apply(row_y, at.d[2], 0)) - 2 * w1 * p1 - w2 * p) / w};
}

void ProjectedCurve::cut(const Interval& t) {
  const CurveEnclosure boxes = curve_->enclose(t, 2);
  const auto& [row_x, row_y, row_w] = map_.row;
  const Interval w = over(row_w, boxes.d[0], 1);
  const double least = kMinDepth * largest_term(row_w, boxes.d[0]);
  if (w.hi <= least) return;
  // Outside: x < -reach w, x > (width + reach) w, and the same of y, for points before the eye.
  const auto is_beyond = [&](const Vec4& row, double size) {
    return over(row + reach_ * row_w, boxes.d[0], 1).hi < 0 ||
           over(row - (size + reach_) * row_w, boxes.d[0], 1).lo > 0;
  };
  if (is_beyond(row_x, picture_.x) || is_beyond(row_y, picture_.y)) return;
  const bool is_narrow = t.width() <= narrowest_ || !can_be_halved(t) || cells_.size() >= kMaxCells;
  const double middle = t.middle(), h = 0.5 * t.width();
  const auto halve = [&] {
    cut({t.lo, middle});
    cut({middle, t.hi});
  };
  if (w.lo <= least) {  // through the eye's own plane: what is left of it in the end is nothing
    if (!is_narrow) halve();
    return;
  }
  // About the middle's own place, so that the terms do not cancel.
  const Jet at = jet(middle);
  const Vec4 form_x = row_x - at.p.x * row_w, form_y = row_y - at.p.y * row_w;
  const Interval w1 = over(row_w, boxes.d[1], 0), w2 = over(row_w, boxes.d[2], 0);
  const auto axis = [&](const Vec4& form, Interval& p, Interval& p1, Interval& p2) {
    p = over(form, boxes.d[0], 1) / w;
    p1 = (over(form, boxes.d[1], 0) - p * w1) / w;
    p2 = (over(form, boxes.d[2], 0) - 2 * p1 * w1 - p * w2) / w;
  };
  Interval x, x1, x2, y, y1, y2;
  axis(form_x, x, x1, x2);
  axis(form_y, y, y1, y2);
  const double most2 = hypotenuse(x2, y2), speed = glm::length(at.p1), turn = most2 * h;
  const double extent = std::min(std::hypot(x.width(), y.width()), 2 * h * (speed + turn));
  const bool is_straight = turn <= kTurn * speed;
  const double slowest = speed - turn;
  const bool is_open = is_straight && reach_ * most2 < kBend * slowest * slowest;
  const double bow = 0.5 * most2 * h * h;
  const bool is_short = extent <= kLongest && is_open;
  if (!is_short && !(extent <= kPlace || (is_straight && extent <= kShort) || is_narrow)) return halve();
  Cell& cell = is_short ? add(t, false, bow, bow) : add(t, true, std::min(extent, bow), bow);
  cell.second_lo = {x2.lo, y2.lo}, cell.second_hi = {x2.hi, y2.hi};
}

ProjectedCurve::Cell& ProjectedCurve::add(const Interval& t, bool is_chord, double bulge, double bow) {
  // At a break the curve's own derivatives are those from the right.
  const Place begin = place(t.lo), end = place(t.hi), inside = place(next_down(t.hi));
  Cell cell;
  cell.t = t;
  cell.begin = begin.p;
  // Nor need the point be that of the left.
  cell.end = glm::length(end.p - inside.p) <= kMeet ? end.p : inside.p;
  cell.begin_tangent = is_chord ? cell.end - cell.begin : begin.tangent;
  cell.end_tangent = is_chord ? cell.begin_tangent : inside.tangent;
  cell.bulge = bulge;
  cell.bow = bow;
  cell.is_chord = is_chord;
  return cells_.emplace_back(cell);
}

void ProjectedCurve::link() {
  const size_t n = cells_.size();
  const Interval domain = curve_->domain();
  double length = 0;
  for (size_t i = 0; i < n; ++i) {
    Cell& cell = cells_[i];
    Cell& before = cells_[i > 0 ? i - 1 : n - 1];
    const bool next = i > 0 ? before.t.hi == cell.t.lo
                            : n > 1 && cell.t.lo == domain.lo && before.t.hi == domain.hi && curve_->is_closed();
    if (next && glm::length(before.end - cell.begin) <= kMeet) {
      cell.follows = before.is_followed = true;
      // A smooth joint has one tangent, whatever the rounding: no place is nearest to both cells or to neither.
      const Vec2 a = before.end_tangent, b = cell.begin_tangent;
      if (!before.is_chord && !cell.is_chord && glm::length(a - b) <= 1e-9 * glm::length(a)) before.end_tangent = b;
      before.end = cell.begin;
    }
    cell.length_before = length;
    length += this->length(cell.t);
  }
}

double ProjectedCurve::length(const Interval& t) const {
  static const GaussRule rule = gauss_legendre(kPlacesOfLength);
  double sum = 0;
  for (int i = 0; i < kPlacesOfLength; ++i)
    sum += rule.weights[i] * glm::length(place(t.middle() + 0.5 * t.width() * rule.nodes[i]).tangent);
  return 0.5 * t.width() * sum;
}

Line ProjectedCurve::tangent(double t) const {
  const CurveJet at = curve_->evaluate(t, 1);
  return {to_world_.point(at.d[0]), to_world_.direction(at.d[1])};
}

double ProjectedCurve::length_up_to(int cell, double t) const {
  return cells_[cell].length_before + length({cells_[cell].t.lo, t});
}

std::optional<ProjectedCurve::Nearest> ProjectedCurve::nearest(int index, const Vec2& q) const {
  const Cell& cell = cells_[index];
  if (distance_from_segment(q, cell.begin, cell.end) > reach_ + cell.bulge) return std::nullopt;
  const double g_begin = glm::dot(cell.begin - q, cell.begin_tangent), g_end = glm::dot(cell.end - q, cell.end_tangent);
  const auto unit = [](const Vec2& v) { return glm::length(v) > 0 ? glm::normalize(v) : Vec2(0); };
  if (g_begin >= 0) {
    if (cell.follows) return std::nullopt;  // the cell before knows
    return Nearest{cell.t.lo, cell.begin, unit(cell.begin_tangent), glm::length(q - cell.begin), -1};
  }
  if (g_end < 0) {
    if (cell.is_followed) {
      const Cell& next = cells_[index + 1 < static_cast<int>(cells_.size()) ? index + 1 : 0];
      if (glm::dot(next.begin - q, next.begin_tangent) < 0) return std::nullopt;  // goes on to fall there
    }
    return Nearest{cell.t.hi, cell.end, unit(cell.end_tangent), glm::length(q - cell.end), cell.is_followed ? 0 : 1};
  }
  if (cell.is_chord) {
    const double x = -g_begin / (g_end - g_begin);
    const Vec2 place = cell.begin + x * (cell.end - cell.begin);
    return Nearest{cell.t.lo + x * cell.t.width(), place, unit(cell.begin_tangent), glm::length(q - place), 0};
  }
  // Newton's iteration on g, kept inside a bracket.
  constexpr double kClose = 1e-7;  // pixels
  double lo = cell.t.lo, hi = cell.t.hi, t = lo + cell.t.width() * (-g_begin / (g_end - g_begin));
  Jet at;
  for (int i = 0; i < 60; ++i) {
    at = jet(t);
    const double g = glm::dot(at.p - q, at.p1), slope = glm::dot(at.p1, at.p1) + glm::dot(at.p - q, at.p2);
    (g < 0 ? lo : hi) = t;
    double next = slope > 0 ? t - g / slope : lo - 1;
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    const double step = next - t;
    if (std::abs(step) * glm::length(at.p1) <= kClose || next == t) break;
    t = next;
  }
  return Nearest{t, at.p, unit(at.p1), glm::length(q - at.p), 0};
}

}  // namespace lekalo::render
