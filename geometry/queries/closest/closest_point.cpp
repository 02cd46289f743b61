#include "geometry/queries/closest/closest_point.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/numerics/root_search.h"
#include "geometry/queries/closest/foot_point_polynomials.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Boxes are not halved below this part of the domain: a double foot point shows as a few of them.
constexpr double kMinBox = 1e-8;
// A derivative below this part of the size over the width of the domain vanishes: a cusp.
constexpr double kNoDerivative = 1e-9;
// So far inside of a piece, as part of it, an infinite slope at its end has a direction.
constexpr double kBesideSteep = 1e-14;
// The cosine of the angle between way and curve of what is no foot point.
constexpr double kAcross = 0.01;
// Foot points nearer than this part of the size are one, seen from both sides of a seam.
constexpr double kSameFootPoint = 1e-11;

// f(t) = (p - r) . r' on a smooth piece (Golovanov 2016, (4.1.3)).
struct CurveSystem {
  const Vec3& p;
  const Curve& curve;
  Interval piece;

  CurveJet jet(double t) const { return evaluate_within(curve, piece, t, 2); }
  SystemValue<Interval, 1, 1> enclose(const ParameterBox<1>& box) const {
    const CurveEnclosure r = curve.enclose(box[0], 2);
    return {{product(p, r.d[0], r.d[1])}, {{{product(p, r.d[0], r.d[2]) - square(r.d[1])}}}};
  }
  SystemValue<double, 1, 1> evaluate(const ParameterPoint<1>& at) const {
    const CurveJet r = jet(at[0]);
    const Vec3 way = p - r.d[0];
    return {{glm::dot(way, r.d[1])}, {{{glm::dot(way, r.d[2]) - glm::dot(r.d[1], r.d[1])}}}};
  }
};

// True if all of a piece has the same distance from the point: f vanishes at more places than its numerator has zeros.
bool is_arc_about(const CurveSystem& system, int degree) {
  const int places = degree > 0 ? 3 * degree + 2 : 24;
  for (int k = 0; k <= places; ++k) {
    const CurveJet r = system.jet(system.piece.lo + system.piece.width() * k / places);
    const Vec3 way = system.p - r.d[0];
    if (!(std::abs(glm::dot(way, r.d[1])) <= 1e-13 * glm::length(way) * glm::length(r.d[1]))) return false;
  }
  return true;
}

}  // namespace

struct CurveProjector::Prepared {
  // A piece, with its polynomial where it has one, and what stands at its ends.
  struct Piece {
    Interval domain;
    ParameterMap map;
    int degree;  // 0 for a piece that is not rational
    std::optional<FootPointPolynomial> polynomial;
    CurveJet begin, end;
    Box3 box;
  };
  CurvePtr curve;
  Interval domain;
  double size;
  bool closed;
  std::vector<Piece> pieces;

  Prepared(CurvePtr given, const std::vector<CurvePiece>& given_pieces)
      : curve(std::move(given)), domain(curve->domain()) {
    Box3 all;
    // An arc of a periodic curve has ends.
    closed = curve->is_closed() ||
             (curve->period() > 0 && std::abs(curve->period() - domain.width()) <= kDomainSlack * domain.width());
    for (const CurvePiece& piece : given_pieces) {
      Piece& own =
          pieces.emplace_back(Piece{piece.domain, piece.map, piece.is_rational() ? piece.degree() : 0, {}, {}, {}, {}});
      if (own.degree > 0 && own.degree <= FootPointPolynomial::kMaxDegree)
        own.polynomial.emplace(piece.points, Vec3(piece.points[0]) / piece.points[0].w);
      own.begin = jet_at_end(piece.domain, piece.domain.lo);
      own.end = jet_at_end(piece.domain, piece.domain.hi);
      if (!piece.is_rational() || !control_point_box(piece.points, own.box))
        own.box = curve->enclose(piece.domain, 0).d[0];
      all.include(own.box);
    }
    size = std::max(all.diameter(), 1e-300);
  }

 private:
  // Where the slope is infinite, that beside it.
  CurveJet jet_at_end(const Interval& piece, double t) const {
    const CurveJet at = evaluate_within(*curve, piece, t, 1);
    const double speed = glm::length(at.d[1]), inside = t == piece.lo ? kBesideSteep : 1 - kBesideSteep;
    return speed < kInfinity ? at : curve->evaluate(piece.lo + inside * piece.width(), 1);
  }
};

namespace {

// The foot points of one point, gathered.
template <class Prepared>
class CurveProjection {
 public:
  using Piece = typename Prepared::Piece;
  CurveProjection(const Vec3& p, const Prepared& on, double within)
      : p_(p), on_(on), within_(within), domain_(on.domain), size_(on.size) {}

  CurveFootPoints run() {
    for (const Piece& piece : on_.pieces)
      if (within_ == kInfinity || piece.box.inflated(within_).contains(p_)) search(piece);
    for (const Interval& arc : result_.arcs) add(arc.middle(), FootPointKind::degenerate);
    add_joints();
    std::erase_if(result_.foot_points, [&](const CurveFootPoint& one) { return one.distance > within_; });
    std::sort(result_.foot_points.begin(), result_.foot_points.end(),
              [](const CurveFootPoint& a, const CurveFootPoint& b) {
                return a.distance != b.distance ? a.distance < b.distance : a.t < b.t;
              });
    return std::move(result_);
  }

 private:
  void add(double t, FootPointKind kind) {
    const Vec3 at = on_.curve->point(t);
    for (const CurveFootPoint& other : result_.foot_points)
      if (glm::length(other.point - at) <= kSameFootPoint * size_ &&
          (std::abs(other.t - t) <= kSameFootPoint * domain_.width() ||
           std::abs(other.t - t) >= (1 - kSameFootPoint) * domain_.width()))
        return;
    result_.foot_points.push_back({t, at, glm::length(p_ - at), kind});
  }

  CurveSystem system_of(const Piece& piece) const { return {p_, *on_.curve, piece.domain}; }

  void search(const Piece& piece) {
    CurveFootPointZeros zeros;
    if (piece.polynomial && piece.polynomial->isolate(p_, zeros)) {
      const auto natural = [&](double x) { return piece.domain.clamp(piece.map.natural_of_bezier(x)); };
      const double beside = kBorderSlack * piece.domain.width();
      const auto part = [&](const Interval& x) {
        return intersect(Interval(natural(x.lo) - beside, natural(x.hi) + beside), piece.domain);
      };
      for (const CurveFootPointZeros::Single& zero : zeros.single)
        if (!polish(piece, natural(zero.near), part(zero.within))) zeros.undecided.push_back(zero.within);
      std::sort(zeros.undecided.begin(), zeros.undecided.end(),
                [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
      for (size_t k = 0; k < zeros.undecided.size();) {
        Interval all = zeros.undecided[k++];
        while (k < zeros.undecided.size() && zeros.undecided[k].lo <= all.hi) all = hull(all, zeros.undecided[k++]);
        search(piece, part(all));
      }
      return;
    }
    if (!is_arc_about(system_of(piece), piece.degree)) return search(piece, piece.domain);
    if (!result_.arcs.empty() && result_.arcs.back().hi == piece.domain.lo)
      result_.arcs.back().hi = piece.domain.hi;
    else
      result_.arcs.push_back(piece.domain);
  }

  // The foot point near t; false if Newton's iteration leads out of the part that holds one.
  bool polish(const Piece& piece, double t, const Interval& part) {
    const CurveSystem system = system_of(piece);
    double before = kInfinity;
    for (int step = 0; step < 20; ++step) {
      const CurveJet r = system.jet(t);
      const Vec3 way = p_ - r.d[0];
      const double slope = glm::dot(way, r.d[2]) - glm::dot(r.d[1], r.d[1]), by = glm::dot(way, r.d[1]) / slope;
      if (!part.contains(t - by)) return false;
      t -= by;
      const double length = std::abs(by) / domain_.width();
      if (length <= 1e-15 || (length <= 1e-8 && length > 0.5 * before)) {
        keep(t, glm::length(r.d[1]), 0, slope < 0 ? FootPointKind::minimum : FootPointKind::maximum);
        return true;
      }
      before = length;
    }
    return false;
  }

  // By intervals.
  void search(const Piece& piece, const Interval& part) {
    const CurveSystem system = system_of(piece);
    RootSearchOptions<1, 1> options;
    options.least[0] = kMinBox * domain_.width();
    options.slack[0] = kBorderSlack * domain_.width();
    const auto found = search_roots<1, 1>(system, ParameterBox<1>{part}, options);
    for (const auto& at : found.isolated)
      keep(at[0], speed(system, at[0]), 0,
           system.evaluate(at).derivative[0][0] < 0 ? FootPointKind::minimum : FootPointKind::maximum);
    for (const auto& box : found.open)
      if (may_hold_foot(system, box[0]))
        keep(box[0].middle(), speed(system, box[0].middle()), box[0].width(), FootPointKind::degenerate);
  }
  // Where a slope is infinite bounds tell nothing: a foot point has the way across the curve, or on both sides in its
  // box.
  bool may_hold_foot(const CurveSystem& system, const Interval& box) const {
    const auto cosine = [&](double t) {
      const CurveJet r = system.jet(t);
      const Vec3 way = p_ - r.d[0];
      return glm::dot(way, r.d[1]) / (glm::length(way) * glm::length(r.d[1]));
    };
    const double first = cosine(box.lo), last = cosine(box.hi);
    return !(std::abs(first) > kAcross && std::abs(last) > kAcross && (first > 0) == (last > 0));
  }
  static double speed(const CurveSystem& system, double t) { return glm::length(system.jet(t).d[1]); }

  void keep(double t, double speed, double width, FootPointKind kind) {
    if (speed * domain_.width() > kNoDerivative * size_) return add(t, kind);
    // A cusp: f vanishes whatever the direction.
    const double beside = std::max(width, 1e-6 * domain_.width());
    const auto distance = [&](double at) { return glm::length(p_ - on_.curve->point(domain_.clamp(at))); };
    if (distance(t - beside) > distance(t) && distance(t + beside) > distance(t)) add(t, FootPointKind::border);
  }

  // Joints of pieces and ends: f falls from plus to minus there, or the curve ends on the rising side. Where f vanishes
  // on both sides, but for rounding, either piece may have lost the foot point to the other.
  void add_joints() {
    const std::vector<Piece>& pieces = on_.pieces;
    for (size_t k = 0; k <= pieces.size(); ++k) {
      const bool inner = k > 0 && k < pieces.size();
      if (on_.closed && k == pieces.size()) break;
      const Piece* before = k > 0 ? &pieces[k - 1] : on_.closed ? &pieces.back() : nullptr;
      const Piece* behind = k < pieces.size() ? &pieces[k] : nullptr;
      const double t = inner || k == 0 ? pieces[k].domain.lo : domain_.hi;
      // f, or 0 where it is rounding.
      const auto sign = [&](const Piece* piece, bool at_end) {
        const CurveJet& r = at_end ? piece->end : piece->begin;
        const double f = glm::dot(p_ - r.d[0], r.d[1]);
        return std::abs(f) > 1e-14 * glm::length(p_ - r.d[0]) * glm::length(r.d[1]) ? f : 0;
      };
      const auto falls = [&](const Piece* piece, bool at_end) {
        return !piece || (at_end ? sign(piece, true) > 0 : sign(piece, false) < 0);
      };
      if (falls(before, true) && falls(behind, false)) add(t, FootPointKind::border);
      if (before && behind && sign(before, true) == 0 && sign(behind, false) == 0) add_stationary(t);
    }
  }

  void add_stationary(double t) {
    const CurveJet r = on_.curve->evaluate(t, 2);
    const double turns = glm::dot(p_ - r.d[0], r.d[2]), square = glm::dot(r.d[1], r.d[1]);
    // About the point as a center of curvature this side of the joint tells nothing.
    if (!(std::abs(turns - square) > 1e-9 * square)) return;
    keep(t, std::sqrt(square), 0, turns < square ? FootPointKind::minimum : FootPointKind::maximum);
  }

  const Vec3 p_;
  const Prepared& on_;
  const double within_;
  const Interval domain_;
  const double size_;
  CurveFootPoints result_;
};

}  // namespace

CurveProjector::CurveProjector(CurvePtr curve, std::vector<CurvePiece> pieces)
    : prepared_(std::make_shared<Prepared>(std::move(curve), pieces)) {}
CurveProjector::CurveProjector(CurvePtr curve) : CurveProjector(curve, curve->pieces()) {}

CurveFootPoints CurveProjector::foot_points(const Vec3& point) const { return foot_points(point, kInfinity); }
CurveFootPoints CurveProjector::foot_points(const Vec3& point, double within) const {
  return CurveProjection(point, *prepared_, within).run();
}

CurveFootPoints project(const Vec3& point, const Curve& curve) {
  return CurveProjector(CurvePtr(CurvePtr(), &curve)).foot_points(point);
}

}  // namespace lekalo::geometry
