#include "geometry/queries/measures/curve_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/numerics/quadrature.h"

namespace lekalo::geometry {

namespace {

constexpr int kPlaces = 400;       // of a smooth piece, where vertices are searched for
constexpr double kNarrow = 1e-7;   // parts of a piece are not divided further
constexpr int kMaxParts = 20000;   // a function that may vanish in more does so all along
constexpr double kFlat = 1e-9;     // of the size, from a plane
constexpr double kNoSpeed = 1e-9;  // of the largest speed of a piece
constexpr double kBeside = 1e-5;   // of a piece, where the sides of a joint are looked at
constexpr double kSmooth = 1e-7;   // radians, between the tangents of pieces

using Function = std::function<double(double)>;
using RangeOf = std::function<Interval(const Interval&)>;

// Halves [lo, hi], at whose ends f has different signs.
double root_between(const Function& f, double lo, double hi) {
  const bool rises = f(lo) < 0;
  const double rounding = 1e-17 * std::max(std::abs(lo), std::abs(hi));
  for (double middle = 0.5 * (lo + hi); lo < middle && middle < hi && hi - lo > rounding; middle = 0.5 * (lo + hi))
    ((f(middle) < 0) == rises ? lo : hi) = middle;
  return 0.5 * (lo + hi) + 0.0;  // no negative zero
}

// The parts in which the range does not exclude zero, no wider than kNarrow of the piece; none if they are too many.
std::vector<Interval> undecided(const RangeOf& range, const Interval& piece) {
  std::vector<Interval> parts{piece}, next;
  const double narrow = kNarrow * piece.width();
  while (!parts.empty() && parts.front().width() > narrow) {
    next.clear();
    for (const Interval& part : parts)
      for (const Interval& half : {Interval(part.lo, part.middle()), Interval(part.middle(), part.hi)})
        if (const Interval values = range(half); !(values.lo > 0 || values.hi < 0)) next.push_back(half);
    parts.swap(next);
    if (static_cast<int>(parts.size()) > kMaxParts) return {};
  }
  for (size_t i = 1; i < parts.size();) {  // neighbours are one
    if (parts[i].lo > parts[i - 1].hi) {
      ++i;
      continue;
    }
    parts[i - 1].hi = parts[i].hi;
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return parts;
}

class Features {
 public:
  explicit Features(const Curve& curve) : curve_(curve) {
    if (!(curve.domain().width() < kInfinity)) throw std::invalid_argument("the curve is not bounded");
    for (const CurvePiece& piece : curve.pieces()) pieces_.push_back(piece.domain);
    find_plane();
    found_.closed = curve.is_closed();
  }

  CurveFeatures run() {
    for (const Interval& piece : pieces_) add_piece(piece);
    for (size_t k = 0; k + 1 < pieces_.size(); ++k) add_joint(pieces_[k], pieces_[k + 1]);
    if (found_.closed) add_joint(pieces_.back(), pieces_.front());
    std::sort(found_.points.begin(), found_.points.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
    add_totals();
    return std::move(found_);
  }

  bool plane() const { return found_.plane; }
  const Vec3& normal() const { return found_.normal; }
  double size() const { return size_; }

 private:
  void find_plane() {
    std::vector<Vec3> points;
    Box3 box;
    for (const Interval& piece : pieces_)
      for (int k = 0; k <= kPlaces; ++k) {
        points.push_back(curve_.point(piece.lo + piece.width() * k / kPlaces));
        box.include(points.back());
      }
    size_ = box.diameter();
    Vec3 x(0), normal(0);
    for (const Vec3& p : points)
      if (glm::length(p - points[0]) > glm::length(x)) x = p - points[0];
    for (const Vec3& p : points)
      if (const Vec3 across = glm::cross(x, p - points[0]); glm::length(across) > glm::length(normal)) normal = across;
    found_.plane = true;
    if (!(glm::length(normal) > kFlat * size_ * size_)) return;  // a straight line
    normal = glm::normalize(normal);
    int largest = 2;
    for (const int axis : {1, 0})
      if (std::abs(normal[axis]) > std::abs(normal[largest]) * (1 + kFlat)) largest = axis;
    found_.normal = normal[largest] < 0 ? -normal : normal;
    for (const Vec3& p : points)
      found_.plane = found_.plane && std::abs(glm::dot(p - points[0], normal)) <= kFlat * size_;
  }

  // r' x r'' along the normal of a plane curve; its length in space.
  double bend(double t) const {
    const CurveJet jet = curve_.evaluate(t, 2);
    const Vec3 across = glm::cross(jet.d[1], jet.d[2]);
    return found_.plane ? glm::dot(across, found_.normal) : glm::length(across);
  }

  std::array<Interval, 3> bend_range(const Interval& t) const {
    const CurveEnclosure over = curve_.enclose(t, 2);
    const auto a = [&](int i) { return along(over.d[1], i); };
    const auto b = [&](int i) { return along(over.d[2], i); };
    return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
  }

  // The derivative of the curvature by t, times a positive number: the signed one of plane curves.
  double growth(const Interval& piece, double t) const {
    const CurveJet jet = evaluate_within(curve_, piece, t, 3);
    const Vec3 &r1 = jet.d[1], &r2 = jet.d[2], &r3 = jet.d[3];
    const Vec3 across = glm::cross(r1, r2), grows = glm::cross(r1, r3);
    const double square_of_speed = glm::dot(r1, r1), slows = 3 * glm::dot(r1, r2);
    if (found_.plane) return glm::dot(grows, found_.normal) * square_of_speed - slows * glm::dot(across, found_.normal);
    return glm::dot(across, grows) * square_of_speed - slows * glm::dot(across, across);
  }

  // What growth() would be if the curvature changed by itself along the piece.
  double growth_scale(const Interval& piece) const {
    const CurveJet middle = evaluate_within(curve_, piece, piece.middle(), 2);
    const double speed = glm::length(middle.d[1]), bend = glm::length(glm::cross(middle.d[1], middle.d[2]));
    return speed * speed * (found_.plane ? bend : bend * bend) / piece.width();
  }

  double curvature_at(const Interval& piece, double t) const {
    const CurveJet jet = evaluate_within(curve_, piece, t, 2);
    const double speed = glm::length(jet.d[1]);
    const Vec3 across = glm::cross(jet.d[1], jet.d[2]);
    return (found_.plane ? glm::dot(across, found_.normal) : glm::length(across)) / (speed * speed * speed);
  }

  // An end of the piece, if t is one but for rounding.
  static double at_end(const Interval& piece, double t) {
    const double rounding = 1e-15 * piece.width();
    return t - piece.lo <= rounding ? piece.lo : piece.hi - t <= rounding ? piece.hi : t;
  }

  void add(CurveFeature::Kind kind, double t, double curvature = 0, double angle = 0) {
    found_.points.push_back({kind, t, curve_.point(t) + Vec3(0.0), curvature, angle});
  }

  void add_piece(const Interval& piece) {
    double speed = 0, bending = 0;
    for (int k = 0; k <= kPlaces; ++k) {
      const CurveJet jet = evaluate_within(curve_, piece, piece.lo + piece.width() * k / kPlaces, 2);
      if (const double v = glm::length(jet.d[1]); v < kInfinity) speed = std::max(speed, v);
      if (const double w = glm::length(glm::cross(jet.d[1], jet.d[2])); w < kInfinity) bending = std::max(bending, w);
    }
    add_rests(piece, speed);
    if (!(bending > kFlat * speed * speed / piece.width())) return;  // straight
    straight_ = false;
    add_inflections(piece, bending);
    add_vertices(piece);
  }

  void add_rests(const Interval& piece, double speed) {
    const auto range = [&](const Interval& t) {
      const Box3 slope = curve_.enclose(t, 1).d[1];
      return slope.bounded() ? square(slope) : Interval(0, kInfinity);
    };
    for (const Interval& part : undecided(range, piece)) {
      // The least speed: r' . r'' changes its sign there, or it is an end.
      const auto slope = [&](double t) {
        const CurveJet jet = evaluate_within(curve_, piece, t, 2);
        return glm::dot(jet.d[1], jet.d[2]);
      };
      const Interval wide(std::max(piece.lo, part.lo - kNarrow * piece.width()),
                          std::min(piece.hi, part.hi + kNarrow * piece.width()));
      double t = slope(wide.lo) < 0 && slope(wide.hi) > 0 ? root_between(slope, wide.lo, wide.hi) : part.middle();
      for (const double end : {piece.lo, piece.hi})
        if (part.contains(end)) t = end;
      const CurveJet jet = evaluate_within(curve_, piece, t, 3);
      if (!(glm::length(jet.d[1]) <= kNoSpeed * speed)) continue;
      rests_.push_back(t);
      if (!(t > piece.lo && t < piece.hi)) continue;  // an end: a corner tells
      const bool turns = glm::length(jet.d[2]) > kNoSpeed * speed / piece.width();
      add(turns ? CurveFeature::Kind::cusp : CurveFeature::Kind::rest, t, 0, turns ? kPi : 0);
    }
  }

  bool is_rest(double t, double near) const {
    return std::any_of(rests_.begin(), rests_.end(), [&](double rest) { return std::abs(rest - t) <= near; });
  }

  void add_inflections(const Interval& piece, double bending) {
    const auto range = [&](const Interval& t) {
      const std::array<Interval, 3> across = bend_range(t);
      if (!found_.plane) return sqr(across[0]) + sqr(across[1]) + sqr(across[2]);
      return Interval(found_.normal.x) * across[0] + Interval(found_.normal.y) * across[1] +
             Interval(found_.normal.z) * across[2];
    };
    const double near = kNarrow * piece.width();
    for (const Interval& part : undecided(range, piece)) {
      const double lo = std::max(piece.lo, part.lo - near), hi = std::min(piece.hi, part.hi + near);
      if (is_rest(part.middle(), 4 * near) || is_rest(part.lo, 4 * near) || is_rest(part.hi, 4 * near)) continue;
      const auto f = [&](double t) { return bend(within(piece, t)); };
      if (!found_.plane) {
        // Least where c . c' changes its sign, c = r' x r''.
        const auto falls = [&](double t) {
          const CurveJet jet = evaluate_within(curve_, piece, t, 3);
          return glm::dot(glm::cross(jet.d[1], jet.d[2]), glm::cross(jet.d[1], jet.d[3]));
        };
        const double t = falls(lo) < 0 && falls(hi) > 0 ? root_between(falls, lo, hi) : part.middle();
        if (f(t) <= kFlat * bending) add(CurveFeature::Kind::inflection, t);
      } else if ((f(lo) < 0) != (f(hi) < 0)) {
        add(CurveFeature::Kind::inflection, at_end(piece, root_between(f, lo, hi)));
      }
    }
  }

  void add_vertices(const Interval& piece) {
    const auto f = [&](double t) { return growth(piece, t); };
    std::vector<double> values;
    double largest = 0;
    const auto at = [&](int k) { return piece.lo + piece.width() * k / kPlaces; };
    for (int k = 0; k <= kPlaces; ++k) {
      values.push_back(f(at(k)));
      if (std::isfinite(values.back())) largest = std::max(largest, std::abs(values.back()));
    }
    // Else the curvature is constant, as that of arcs, but for rounding.
    if (!(largest > 1e-10 * growth_scale(piece))) return;
    const double noise = 1e-13 * largest;
    int before = -1;  // the last place where the sign is known
    for (int k = 0; k <= kPlaces; ++k) {
      if (!(std::abs(values[static_cast<size_t>(k)]) > noise)) continue;
      if (before >= 0 && (values[static_cast<size_t>(before)] < 0) != (values[static_cast<size_t>(k)] < 0)) {
        const double t = at_end(piece, root_between(f, at(before), at(k)));
        if (!is_rest(t, 2 * piece.width() / kPlaces)) add_vertex(piece, t);
      }
      before = k;
    }
  }

  void add_vertex(const Interval& piece, double t) {
    if (!is_found(CurveFeature::Kind::vertex, t, kNarrow * piece.width()))
      add(CurveFeature::Kind::vertex, t, curvature_at(piece, t));
  }

  bool is_found(CurveFeature::Kind kind, double t, double near) const {
    return std::any_of(found_.points.begin(), found_.points.end(),
                       [&](const CurveFeature& one) { return one.kind == kind && std::abs(one.t - t) <= near; });
  }

  // The unit tangent at an end, the limit where r' vanishes.
  Vec3 tangent(const Interval& piece, bool at_end) const {
    const double t = at_end ? piece.hi : piece.lo;
    const CurveJet jet = evaluate_within(curve_, piece, t, 3);
    for (int k = 1; k <= 3; ++k) {
      const double length = glm::length(jet.d[k]);
      if (length > kNoSpeed * size_ / std::pow(piece.width(), k))
        return jet.d[k] / (at_end && k % 2 == 0 ? -length : length);
    }
    return Vec3(0);
  }

  // Where pieces meet: a corner, a cusp, or a change of sign that neither piece has inside.
  void add_joint(const Interval& before, const Interval& after) {
    const Vec3 a = tangent(before, true), b = tangent(after, false);
    const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    if (angle > kSmooth) {
      const bool cusp = angle > kPi - kSmooth;
      const double turn = found_.plane && glm::dot(glm::cross(a, b), found_.normal) < 0 ? -angle : angle;
      return add(cusp ? CurveFeature::Kind::cusp : CurveFeature::Kind::corner, after.lo, 0, cusp ? kPi : turn);
    }
    const double last = before.hi - kBeside * before.width(), first = after.lo + kBeside * after.width();
    const auto is_near = [&](CurveFeature::Kind kind) {
      return is_found(kind, before.hi, 2 * kBeside * before.width()) ||
             is_found(kind, after.lo, 2 * kBeside * after.width());
    };
    if (is_rest(before.hi, 2 * kBeside * before.width()) || is_rest(after.lo, 2 * kBeside * after.width())) return;
    if (found_.plane && bend(last) * bend(first) < 0 && !is_near(CurveFeature::Kind::inflection))
      add(CurveFeature::Kind::inflection, after.lo);
    const double grows = growth(before, last), then = growth(after, first);
    const double noise = 1e-10 * std::max(growth_scale(before), growth_scale(after));
    if (std::abs(grows) > noise && std::abs(then) > noise && (grows < 0) != (then < 0) &&
        !is_near(CurveFeature::Kind::vertex))
      add(CurveFeature::Kind::vertex, after.lo, curvature_at(after, after.lo));
  }

  void add_totals() {
    double curvature = 0, curvature_error = 0, torsion = 0, torsion_error = 0, turning = 0, area = 0, area_error = 0;
    const Vec3 origin = curve_.point(curve_.domain().lo);
    for (const Interval& piece : pieces_) {
      std::vector<double> breaks{piece.lo};
      for (const double rest : rests_)
        if (rest > piece.lo && rest < piece.hi) breaks.push_back(rest);
      std::sort(breaks.begin(), breaks.end());
      breaks.push_back(piece.hi);
      const Integral whole = integrate(
          [&](double t, std::span<double> values) {
            const CurveJet jet = evaluate_within(curve_, piece, t, 3);
            const Vec3 across = glm::cross(jet.d[1], jet.d[2]);
            const double speed = glm::length(jet.d[1]), square = glm::dot(across, across);
            const double bend = glm::dot(across, found_.normal) / (speed * speed);
            values[0] = std::sqrt(square) / (speed * speed);
            values[1] = 0.5 * glm::dot(glm::cross(jet.d[0] - origin, jet.d[1]), found_.normal);
            values[2] = bend;
            values[3] = !found_.plane && square > 0 ? glm::dot(across, jet.d[3]) / square * speed : 0;
          },
          4, breaks, {0, 1e-12, 200000, 0});
      curvature += whole.value[0], curvature_error += whole.error[0];
      area += whole.value[1], area_error += whole.error[1];
      turning += whole.value[2];
      torsion += whole.value[3], torsion_error += whole.error[3];
    }
    bool cusps = false, flexes = false;
    for (const CurveFeature& point : found_.points) {
      curvature += std::abs(point.angle), turning += point.angle;
      cusps = cusps || point.kind == CurveFeature::Kind::cusp;
      flexes = flexes || point.kind == CurveFeature::Kind::inflection;
    }
    found_.total_curvature = {curvature, curvature_error};
    if (!found_.plane && !cusps && !flexes && std::isfinite(torsion))
      found_.total_torsion = Measured{torsion, torsion_error};
    if (!found_.plane || !found_.closed || straight_) return;
    // A whole number, but for the error of the integral.
    const double turns = turning / kTwoPi, whole = std::nearbyint(turns);
    if (!cusps) found_.turning_number = std::abs(turns - whole) < 1e-6 ? whole + 0.0 : turns;
    found_.area = Measured{area, area_error};
  }

  const Curve& curve_;
  std::vector<Interval> pieces_;
  CurveFeatures found_;
  std::vector<double> rests_;
  double size_ = 0;
  bool straight_ = true;
};

}  // namespace

std::string_view name(CurveFeature::Kind kind) {
  switch (kind) {
    case CurveFeature::Kind::inflection:
      return "inflection";
    case CurveFeature::Kind::vertex:
      return "vertex";
    case CurveFeature::Kind::cusp:
      return "cusp";
    case CurveFeature::Kind::rest:
      return "rest";
    default:
      return "corner";
  }
}

CurveFeatures curve_features(const Curve& curve) { return Features(curve).run(); }

// The angle at the point between neighbours that are so near that it cannot go round: their arc stays on one side.
int winding_number(const Curve& curve, const Vec3& point) {
  const Features features(curve);
  if (!curve.is_closed()) throw std::invalid_argument("the curve is not closed: it goes round nothing");
  if (!features.plane()) throw std::invalid_argument("the curve is not plane");
  const Vec3 normal = features.normal();
  if (std::abs(glm::dot(point - curve.point(curve.domain().lo), normal)) > kFlat * features.size())
    throw std::invalid_argument("the point is not in the plane of the curve");
  double sum = 0;
  const std::function<void(const Interval&, int)> add = [&](const Interval& t, int halvings) {
    const Box3 box = curve.enclose(t, 0).d[0];
    // No box that holds the point; and none that is larger than its distance, seen under less than half a turn.
    const Vec3 nearest = glm::clamp(point, box.lo, box.hi);
    if (!(glm::length(nearest - point) > 0.5 * box.diameter())) {
      if (halvings == 60) throw std::invalid_argument("the point lies on the curve");
      add({t.lo, t.middle()}, halvings + 1), add({t.middle(), t.hi}, halvings + 1);
      return;
    }
    const Vec3 a = curve.point(t.lo) - point, b = curve.point(t.hi) - point;
    sum += std::atan2(glm::dot(glm::cross(a, b), normal), glm::dot(a, b));
  };
  for (const CurvePiece& piece : curve.pieces()) add(piece.domain, 0);
  return static_cast<int>(std::lround(sum / kTwoPi));
}

}  // namespace lekalo::geometry
