#include "geometry/shapes/tube/tube.h"

#include <bit>
#include <cmath>

#include "geometry/describe.h"
#include "geometry/queries/contours/contour_approximation.h"

namespace lekalo::geometry {

namespace {

// Of the size of a contour: a tube about it may be that far from its place.
constexpr double kNearContour = 1e-9;

// Of a cell. However thin a tube: its coordinates have no more figures.
constexpr double kMaxPieces = 1e16;

// Pieces are looked at one by one where their boxes have less than this of the whole's area.
constexpr double kThin = 0.02;

// Cells along a line of which some may be filled by others.
constexpr size_t kMany = 8;
constexpr double kAbout = 1e-9;      // of its size: more than rounding of places
constexpr double kRounding = 1e-15;  // of places on lines near the tube, of its size

// Unit vector of the first derivative that is not zero; `backward` seen towards smaller t.
Vec3 direction_at(const Curve& curve, double t, bool backward) {
  const CurveJet jet = curve.evaluate(t, 3);
  double largest = 0;
  for (int k = 1; k <= 3; ++k) largest = std::max(largest, glm::length(jet.d[k]));
  for (int k = 1; k <= 3; ++k)
    if (const double length = glm::length(jet.d[k]); length > 1e-9 * largest)
      return (backward && k % 2 == 1 ? -1.0 : 1.0) / length * jet.d[k];
  return {0, 0, 0};
}

// The reference direction carried from one place of a curve to another by two mirrors (Wang et al. 2008, 3): the plane
// between the points, then that between the tangents.
Vec3 carried(const Vec3& reference, const Vec3& tangent, const Vec3& step, const Vec3& next_tangent) {
  const auto mirrored = [](const Vec3& v, const Vec3& normal) {
    const double square = glm::dot(normal, normal);
    return square > 0 ? v - 2 * glm::dot(normal, v) / square * normal : v;
  };
  const Vec3 left = mirrored(reference, step), left_tangent = mirrored(tangent, step);
  const Vec3 result = mirrored(left, next_tangent - left_tangent);
  const Vec3 across = result - glm::dot(result, next_tangent) * next_tangent;
  const double length = glm::length(across);
  return length > 1e-6 ? across / length : frame_about(Vec3(0), next_tangent).x;
}

}  // namespace

Tube::Tube(CurvePtr curve, RadiusLaw radius, Caps caps)
    : sweep_(std::move(curve), std::move(radius)), caps_(sweep_.curve().is_closed() ? Caps::round : caps) {
  std::vector<Box3> boxes;
  for (const BallSweep::Cell& cell : sweep_.cells()) {
    boxes.push_back(cell.box);
    box_.include(cell.box);
  }
  tree_ = BoxTree(boxes);
  center_ = box_.center();
  double area = 0;
  for (const BallSweep::Cell& cell : sweep_.cells()) {
    const double length = glm::length(cell.middle.center[1]) * cell.t.width();
    const double pieces = std::clamp(std::ceil(length / cell.middle.radius[0]), 1.0, kMaxPieces);
    first_piece_.push_back(first_piece_.back() + static_cast<int64_t>(pieces));
    area += pieces * sqr(length / pieces + 2 * cell.middle.radius[0]);
  }
  const Vec3 d = box_.size();
  is_thin_ = area < kThin * (d.x * d.y + d.y * d.z + d.z * d.x);
  if (caps_ != Caps::round) find_ends();

  starts_.reserve(boxes.size());
  for (const BallSweep::Cell& cell : sweep_.cells()) {
    const Vec3 point = sweep_.curve().point(cell.t.lo);
    Vec3 tangent = direction_at(sweep_.curve(), cell.t.lo, false);
    if (starts_.empty()) {
      if (tangent == Vec3(0)) tangent = {0, 0, 1};
      starts_.push_back({point, tangent, frame_about(point, tangent).x});
      continue;
    }
    const Start& before = starts_.back();
    if (tangent == Vec3(0)) tangent = before.tangent;
    starts_.push_back({point, tangent, carried(before.reference, before.tangent, point - before.point, tangent)});
  }
}

void Tube::find_ends() {
  const Interval domain = sweep_.curve().domain();
  const auto& cells = sweep_.cells();
  const int count = static_cast<int>(cells.size());
  for (int side = 0; side < 2; ++side) {
    End& end = ends_[side];
    const double t = side == 0 ? domain.lo : domain.hi, forward = side == 0 ? 1 : -1;
    end.point = sweep_.curve().point(t);
    end.inward = direction_at(sweep_.curve(), t, side == 1);
    int reached = 0;
    for (; reached < count; ++reached) {
      const BallSweep::Cell& cell = cells[side == 0 ? reached : count - 1 - reached];
      // The farthest corner of the box behind the plane.
      const Vec3 back = glm::mix(cell.box.hi, cell.box.lo, glm::greaterThan(end.inward, Vec3(0)));
      if (glm::dot(back - end.point, end.inward) >= 0) break;
      if (reached > 0 && !(forward * glm::dot(cell.middle.center[1], end.inward) > 0)) break;
    }
    end.begin = side == 0 ? 0 : count - reached;
    end.end = side == 0 ? reached : count;
  }
}

SpanLimit Tube::limit(int cell, const Line& line) const {
  SpanLimit limit;
  for (int side = 0; side < 2; ++side) {
    const End& end = ends_[side];
    if (cell < end.begin || cell >= end.end) continue;
    const double slope = glm::dot(line.direction, end.inward);
    const double height = glm::dot(line.origin - end.point, end.inward), at = -height / slope;
    if (slope > 0 && at > limit.lo)
      limit.lo = at, limit.face_lo = side + 1;
    else if (slope < 0 && at < limit.hi)
      limit.hi = at, limit.face_hi = side + 1;
    else if (slope == 0 && height < 0)
      limit.hi = -kInfinity;
  }
  return limit;
}

void Tube::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  static thread_local LineSpans spans;  // its room is kept
  spans.clear();
  // A unit direction, and the origin where the line passes the tube.
  const double speed = glm::length(line.direction);
  const double start = glm::dot(center_ - line.origin, line.direction) / (speed * speed);
  const Line near{line.at(start), line.direction / speed};
  static thread_local std::vector<int> cells;
  cells.clear();
  tree_.along(line, t, [&](int cell) { cells.push_back(cell); });
  // Most of many cells fill nothing of the line but what those about them do: first every second of every second of
  // them and so on, then what lies between. A ball around all of a cell's tells it: its box holds the centers' with
  // their radius to spare.
  const auto is_filled = [&](const BallSweep::Cell& cell) {
    const double radius = cell.middle.radius[0];
    const double around = radius + glm::length(0.5 * cell.box.size() - Vec3(radius)) + kRounding * sweep_.size();
    const Vec3 e = cell.box.center() - near.origin;
    const double middle = glm::dot(e, near.direction);
    const Vec3 across = e - middle * near.direction;
    const double half = std::sqrt(std::max(0.0, around * around - glm::dot(across, across)));
    return spans.cover(middle - half, middle + half, 0);
  };
  for (size_t step = std::bit_floor(cells.size()); step > 0; step /= 2)
    for (size_t i = step - 1; i < cells.size(); i += 2 * step)
      if (const int cell = cells[i]; cells.size() < kMany || !is_filled(sweep_.cells()[cell]))
        sweep_.add_spans(cell, near, limit(cell, near), spans);
  const auto add = [&](SpanEnd end, bool is_in) {
    if (end.face == 0) sweep_.finish(end, is_in, near);
    const double at = start + end.s / speed;
    if (t.contains(at) && (end.face == 0 || caps_ != Caps::none)) hits.push_back({at, end.u, 0, end.face, end.piece});
  };
  for (const Span& span : spans) {
    add(span.in, true);
    add(span.out, false);
  }
}

bool Tube::holds(const Vec3& p) const {
  static thread_local LineSpans spans;
  spans.clear();
  const Line line{p, glm::normalize(Vec3(0.5377, -0.7391, 0.4057))};  // along which no curve runs, most likely
  // What fills the line at p is of cells whose boxes are there.
  const Interval about{-kAbout * sweep_.size(), kAbout * sweep_.size()};
  tree_.along(line, about, [&](int cell) { sweep_.add_spans(cell, line, limit(cell, line), spans); });
  return std::any_of(spans.begin(), spans.end(), [](const Span& span) { return span.in.s < 0 && span.out.s > 0; });
}

bool Tube::is_cut_off(const Vec3& p, double t) const {
  if (caps_ == Caps::round) return false;
  const auto& cells = sweep_.cells();
  for (const End& end : ends_)
    if (end.begin < end.end && t >= cells[end.begin].t.lo && t <= cells[end.end - 1].t.hi &&
        glm::dot(p - end.point, end.inward) < 0)
      return true;
  return false;
}

Vec3 Tube::reference(int cell, double t, const Vec3& tangent) const {
  const Start& start = starts_[cell];
  return carried(start.reference, start.tangent, sweep_.curve().point(t) - start.point, tangent);
}

std::vector<SurfacePart> Tube::surface_parts() const {
  if (!is_thin_) return {{box_}};
  std::vector<SurfacePart> parts{{box_, first_piece_.back(), true}};
  if (caps_ == Caps::flat) parts.resize(3, {box_, 1, true});
  return parts;
}

// The box about the middle ball of the piece that no other leaves: |r'' - r''(middle of the cell)| <= wander.
Box3 Tube::box_of_balls(int cell_number, int64_t piece) const {
  const BallSweep::Cell& cell = sweep_.cells()[cell_number];
  const double h = 0.5 * cell.t.width() / static_cast<double>(pieces_in(cell_number));
  const BallJet ball = sweep_.ball(cell.t.lo + (2 * static_cast<double>(piece) + 1) * h);
  const double bend = glm::length(cell.middle.center[2]) + cell.variation_bound,
               widen = std::abs(cell.middle.radius[2]) + cell.radius_variation_bound;
  const double reach = h * (std::abs(ball.radius[1]) + h * (widen + bend));
  Box3 box{ball.center[0], ball.center[0]};
  const Vec3 along = h * glm::abs(ball.center[1]) + Vec3(reach + ball.radius[0]);
  box = {box.lo - along, box.hi + along};
  return {glm::max(box.lo, cell.box.lo), glm::min(box.hi, cell.box.hi)};
}

Box3 Tube::piece_box(const PieceOfSurface& piece) const {
  if (!is_thin_) return box_;
  if (piece.part == 0) {
    const auto after = std::upper_bound(first_piece_.begin(), first_piece_.end(), piece.piece);
    const int cell = static_cast<int>(after - first_piece_.begin()) - 1;
    return box_of_balls(cell, piece.piece - first_piece_[cell]);
  }
  // The balls that reach behind the plane of the end, up to the first that does not.
  const int side = piece.part - 1;
  const End& end = ends_[side];
  Box3 box{end.point, end.point};
  for (int k = 0; k < end.end - end.begin; ++k) {
    const int cell = side == 0 ? k : end.end - 1 - k;
    const int64_t count = pieces_in(cell);
    for (int64_t i = 0; i < count; ++i) {
      const Box3 balls = box_of_balls(cell, side == 0 ? i : count - 1 - i);
      const Vec3 back = glm::mix(balls.hi, balls.lo, glm::greaterThan(end.inward, Vec3(0)));
      if (glm::dot(back - end.point, end.inward) > 0) return box;
      box.include(balls);
    }
  }
  return box;
}

PieceOfSurface Tube::piece_of(const SurfaceHit& hit) const {
  if (!is_thin_) return {};
  if (hit.face != 0) return {hit.face};
  const Interval& t = sweep_.cells()[hit.piece].t;
  const int64_t count = pieces_in(hit.piece);
  const auto piece = static_cast<int64_t>((hit.u - t.lo) / t.width() * static_cast<double>(count));
  return {0, first_piece_[hit.piece] + std::clamp<int64_t>(piece, 0, count - 1)};
}

ShapePoint Tube::point(const SurfaceHit& hit, const Vec3& near) const {
  const BallJet ball = sweep_.ball(hit.u);
  const auto& [r, r1, r2] = ball.center;
  const auto& [R, R1, R2] = ball.radius;
  const double rho = glm::length(r1);
  const Vec3 tangent = rho > 0 ? r1 / rho : starts_[hit.piece].tangent;
  const Vec3 x = reference(hit.piece, hit.u, tangent), y = glm::cross(tangent, x);
  ShapePoint at;
  at.u = hit.u;
  at.v = std::atan2(glm::dot(near - r, y), glm::dot(near - r, x));
  if (hit.face != 0) {
    const End& end = ends_[hit.face - 1];
    at.position = near - glm::dot(near - end.point, end.inward) * end.inward;
    at.normal = -end.inward;
    return at;
  }
  at.normal = glm::normalize(near - r);
  at.position = r + R * at.normal;
  at.dv = R * glm::cross(tangent, at.normal);
  // On the wall n = -k T + c m: m turns about the curve no more than it must, m' = -(m . T') T.
  const double k = rho > 0 ? R1 / rho : 0, c = std::sqrt(std::max(0.0, 1 - k * k));
  if (rho > 0 && c > 0 && std::abs(glm::dot(at.normal, tangent) + k) < 1e-6) {
    const Vec3 turn = (r2 - glm::dot(r2, tangent) * tangent) / rho;  // T'
    const double k1 = (R2 - k * glm::dot(r2, tangent)) / rho;
    const Vec3 m = (at.normal + k * tangent) / c;
    const Vec3 n1 = -k1 * tangent - k * turn - k * k1 / c * m - c * glm::dot(m, turn) * tangent;
    at.du = r1 + R1 * at.normal + R * n1;
  }
  return at;
}

std::optional<Mat3> Tube::shape_operator(const SurfaceHit& hit, const Vec3& near) const {
  if (hit.face != 0) return Mat3(0);
  const ShapePoint at = point(hit, near);
  const BallJet ball = sweep_.ball(hit.u);
  const double R = ball.radius[0];
  if (at.du == Vec3(0)) return (-1 / R) * (Mat3(1) - glm::outerProduct(at.normal, at.normal));
  const Vec3 around = glm::normalize(at.dv), along = glm::cross(at.normal, around);
  const Vec3 turn = (at.du - ball.center[1] - ball.radius[1] * at.normal) / R;  // of the normal along du
  const double step = glm::dot(at.du, along);
  if (!(std::abs(step) > 1e-9 * glm::length(at.du))) return std::nullopt;  // the wall has an edge here
  return -(1 / R) * glm::outerProduct(around, around) - glm::dot(turn, along) / step * glm::outerProduct(along, along);
}

TypeDeclaration tube_type() {
  return declare(
             Category::shape, "tube",
             "Round tube about a curve: all that a ball sweeps whose center moves along it. What lies inside, where "
             "it meets itself or bends more than its radius allows, is not seen. Parameters: u is that of the "
             "curve, v the angle about it.")
      .example("of: my_curve, radius: 0.1")
      .field("of", reference({Category::curve}), "the curve in the middle")
      .field("radius", formula({"s"}),
             "radius of the tube, a length or a formula of s, which runs from 0 to 1 with the length of the curve")
      .field("caps", choice({"round", "flat", "none"}),
             "ends of the tube: half a ball, a disk, or open; that of a closed curve has none", "round")
      .built_by([](const Fields& f) -> ShapePtr {
        const CurvePtr of = contour_approximation(f.curve("of"), kNearContour);
        const std::string& caps = f.text("caps");
        return std::make_shared<Tube>(of, RadiusLaw(f.get<Expression>("radius"), *of),
                                      caps == "flat"   ? Caps::flat
                                      : caps == "none" ? Caps::none
                                                       : Caps::round);
      });
}

}  // namespace lekalo::geometry
