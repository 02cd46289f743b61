#include "geometry/queries/projection.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/curves/parameter_line.h"
#include "geometry/numerics/root_search.h"
#include "geometry/queries/smooth_pieces.h"
#include "geometry/surfaces/plane.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Boxes are not halved below this part of the domain: a double foot shows as a few of them.
constexpr double kLeastBox = 1e-8;
// A derivative below this part of the size over the width of the domain vanishes: a cusp or a pole.
constexpr double kNoDerivative = 1e-9;
// What is not decided so near to a pole, in parts of the domain, belongs to the pole.
constexpr double kAtPole = 1e-6;
// Feet nearer than this part of the size are one, seen from both sides of a seam.
constexpr double kSameFoot = 1e-11;

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
  SystemValue<double, 1, 1> evaluate(const ParameterPlace<1>& at) const {
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

CurveFeet project(const Vec3& p, const Curve& curve) {
  CurveFeet result;
  const Interval domain = curve.domain();
  const double size = std::max(bounds(curve).diameter(), 1e-300);
  const auto add = [&](double t, FootKind kind) {
    const Vec3 at = curve.point(t);
    for (const CurveFoot& other : result.feet)
      if (glm::length(other.point - at) <= kSameFoot * size &&
          (std::abs(other.t - t) <= kSameFoot * domain.width() ||
           std::abs(other.t - t) >= (1 - kSameFoot) * domain.width()))
        return;
    result.feet.push_back({t, at, glm::length(p - at), kind});
  };

  const std::vector<CurvePiece> pieces = curve.pieces();
  const auto system_of = [&](const CurvePiece& piece) { return CurveSystem{p, curve, piece.domain}; };
  for (const CurvePiece& piece : pieces) {
    const CurveSystem system = system_of(piece);
    if (is_arc_about(system, piece.is_rational() ? piece.degree() : 0)) {
      if (!result.arcs.empty() && result.arcs.back().hi == piece.domain.lo)
        result.arcs.back().hi = piece.domain.hi;
      else
        result.arcs.push_back(piece.domain);
      continue;
    }
    RootSearchOptions<1, 1> options;
    options.least[0] = kLeastBox * domain.width();
    options.slack[0] = kBorderSlack * domain.width();
    const auto found = search_roots<1, 1>(system, ParameterBox<1>{piece.domain}, options);
    const auto keep = [&](double t, double width, FootKind kind) {
      if (glm::length(system.jet(t).d[1]) * domain.width() > kNoDerivative * size) return add(t, kind);
      // A cusp: f vanishes whatever the direction.
      const double beside = std::max(width, 1e-6 * domain.width());
      const auto distance = [&](double at) { return glm::length(p - curve.point(domain.clamp(at))); };
      if (distance(t - beside) > distance(t) && distance(t + beside) > distance(t)) add(t, FootKind::border);
    };
    for (const auto& at : found.isolated)
      keep(at[0], 0, system.evaluate(at).derivative[0][0] < 0 ? FootKind::minimum : FootKind::maximum);
    for (const auto& box : found.open) keep(box[0].middle(), box[0].width(), FootKind::degenerate);
  }
  for (const Interval& arc : result.arcs) add(arc.middle(), FootKind::degenerate);

  // Joints of pieces and ends: f falls from plus to minus there, or the curve ends on the rising side.
  // An arc of a periodic curve has ends.
  const bool closed = curve.is_closed() || (curve.period() > 0 &&
                                            std::abs(curve.period() - domain.width()) <= kDomainSlack * domain.width());
  for (size_t k = 0; k <= pieces.size(); ++k) {
    const bool inner = k > 0 && k < pieces.size();
    if (closed && k == pieces.size()) break;
    const CurvePiece* before = k > 0 ? &pieces[k - 1] : closed ? &pieces.back() : nullptr;
    const CurvePiece* behind = k < pieces.size() ? &pieces[k] : nullptr;
    const double t = inner || k == 0 ? pieces[k].domain.lo : domain.hi;
    const auto falls = [&](const CurvePiece* piece, bool at_end) {
      if (!piece) return true;
      const CurveJet r = system_of(*piece).jet(at_end ? piece->domain.hi : piece->domain.lo);
      const double f = glm::dot(p - r.d[0], r.d[1]);
      const double rounding = 1e-14 * glm::length(p - r.d[0]) * glm::length(r.d[1]);
      return at_end ? f > rounding : f < -rounding;
    };
    if (falls(before, true) && falls(behind, false)) add(t, FootKind::border);
  }
  std::sort(result.feet.begin(), result.feet.end(), [](const CurveFoot& a, const CurveFoot& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.t < b.t;
  });
  return result;
}

namespace {

// (p - s) . s_u = (p - s) . s_v = 0 (Golovanov 2016, (4.2.5)).
struct SurfaceSystem {
  const Vec3& p;
  const Surface& surface;
  Rectangle piece;

  SurfaceJet jet(double u, double v) const { return evaluate_within(surface, piece, u, v, 2); }
  SystemValue<Interval, 2, 2> enclose(const ParameterBox<2>& box) const {
    const SurfaceEnclosure s = surface.enclose({box[0], box[1]}, 2);
    const Box3 &r = s.d(0, 0), &u = s.d(1, 0), &v = s.d(0, 1);
    const Interval mixed = product(p, r, s.d(1, 1)) - product(u, v);
    return {{product(p, r, u), product(p, r, v)},
            {{{product(p, r, s.d(2, 0)) - square(u), mixed}, {mixed, product(p, r, s.d(0, 2)) - square(v)}}}};
  }
  SystemValue<double, 2, 2> evaluate(const ParameterPlace<2>& at) const {
    const SurfaceJet s = jet(at[0], at[1]);
    const Vec3 way = p - s.point();
    const double mixed = glm::dot(way, s.duv()) - glm::dot(s.du(), s.dv());
    return {{glm::dot(way, s.du()), glm::dot(way, s.dv())},
            {{{glm::dot(way, s.duu()) - glm::dot(s.du(), s.du()), mixed},
              {mixed, glm::dot(way, s.dvv()) - glm::dot(s.dv(), s.dv())}}}};
  }
};

FootKind kind_of(const SystemValue<double, 2, 2>& at) {
  const auto& j = at.derivative;  // minus half the second derivatives of the squared distance
  const double determinant = j[0][0] * j[1][1] - j[0][1] * j[1][0];
  const double scale = std::abs(j[0][0] * j[1][1]) + std::abs(j[0][1] * j[1][0]);
  if (!(std::abs(determinant) > 1e-12 * scale)) return FootKind::degenerate;
  if (determinant < 0) return FootKind::saddle;
  return j[0][0] < 0 ? FootKind::minimum : FootKind::maximum;
}

// All feet of one surface, gathered.
class SurfaceProjection {
 public:
  SurfaceProjection(const Vec3& p, const Surface& surface)
      : p_(p),
        surface_(surface),
        domain_(surface.domain()),
        pieces_(surface.pieces()),
        edges_(surface.degenerate_edges()),
        size_(std::max(bounds(surface).diameter(), 1e-300)) {}

  SurfaceFeet run() {
    for (const SurfacePiece& piece : pieces_) search(piece.domain);
    for (const HeldParameter held : {HeldParameter::u, HeldParameter::v}) add_lines(held);
    std::sort(result_.feet.begin(), result_.feet.end(), [](const SurfaceFoot& a, const SurfaceFoot& b) {
      if (a.distance != b.distance) return a.distance < b.distance;
      return a.u != b.u ? a.u < b.u : a.v < b.v;
    });
    return std::move(result_);
  }

 private:
  void add(double u, double v, FootKind kind) {
    const Vec3 at = surface_.point(u, v);
    for (const SurfaceFoot& other : result_.feet)
      if (glm::length(other.point - at) <= kSameFoot * size_ && are_one(other, u, v)) return;
    result_.feet.push_back({u, v, at, glm::length(p_ - at), kind});
  }

  // One place of the parameters, or both sides of a seam: a surface may pass through one point several times.
  bool are_one(const SurfaceFoot& a, double u, double v) const {
    const auto near = [](double x, double y, const Interval& range) {
      const double apart = std::abs(x - y) / range.width();
      return apart <= 1e-6 || apart >= 1 - 1e-6;
    };
    return near(a.u, u, domain_.u) && near(a.v, v, domain_.v);
  }

  bool is_singular(const SurfaceJet& s) const {
    return glm::length(s.du()) * domain_.u.width() <= kNoDerivative * size_ ||
           glm::length(s.dv()) * domain_.v.width() <= kNoDerivative * size_;
  }

  // Both equations hold all along an edge that is one point: see add_pole.
  static bool is_at_pole(const Interval& box, const Interval& range, bool pole_below, bool pole_above) {
    const double near = kAtPole * range.width();
    return (pole_below && box.hi <= range.lo + near) || (pole_above && box.lo >= range.hi - near);
  }

  void search(const Rectangle& piece) {
    const SurfaceSystem system{p_, surface_, piece};
    RootSearchOptions<2, 2> options;
    options.least = {kLeastBox * domain_.u.width(), kLeastBox * domain_.v.width()};
    options.slack = {kBorderSlack * domain_.u.width(), kBorderSlack * domain_.v.width()};
    const auto found = search_roots<2, 2>(system, ParameterBox<2>{piece.u, piece.v}, options);
    for (const auto& at : found.isolated)
      if (!is_singular(system.jet(at[0], at[1]))) add(at[0], at[1], kind_of(system.evaluate(at)));
    for (const auto& box : found.open) {
      const double u = box[0].middle(), v = box[1].middle();
      if (is_at_pole(box[0], domain_.u, edges_.u_min, edges_.u_max) ||
          is_at_pole(box[1], domain_.v, edges_.v_min, edges_.v_max))
        continue;
      if (box[0].width() > 1e3 * options.least[0] || box[1].width() > 1e3 * options.least[1])
        result_.regions.push_back({box[0], box[1]});
      add(u, v, FootKind::degenerate);
    }
  }

  // Edges of the domain, and lines inside where the tangent plane jumps.
  void add_lines(HeldParameter held) {
    const bool holds_u = held == HeldParameter::u;
    const Interval& range = holds_u ? domain_.u : domain_.v;
    const Interval& other = holds_u ? domain_.v : domain_.u;
    const Periods periods = surface_.periods();
    const double period = holds_u ? periods.u : periods.v;
    const bool periodic = period > 0 && std::abs(period - range.width()) <= kDomainSlack * range.width();
    std::vector<double> places;
    for (const SurfacePiece& piece : pieces_) places.push_back(holds_u ? piece.domain.u.lo : piece.domain.v.lo);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    places.push_back(range.hi);
    // The derivative across the line, on the side towards less or greater parameters.
    const auto across = [&](double place, double t, bool below) {
      const double beside = below ? within({range.lo, place}, place) : place;
      const SurfaceJet s = holds_u ? surface_.evaluate(beside, t, 1) : surface_.evaluate(t, beside, 1);
      return holds_u ? s.du() : s.dv();
    };
    for (size_t k = 0; k < places.size(); ++k) {
      const double place = places[k];
      const bool first = k == 0, last = k + 1 == places.size();
      if (periodic && last) continue;
      const bool has_below = !first || periodic, has_above = !last;
      const double below = first ? range.hi : place;
      const auto jumps = [&](double t) {
        const Vec3 a = across(below, t, true), b = across(place, t, false);
        return glm::length(a - b) > 1e-9 * (glm::length(a) + glm::length(b));
      };
      if (has_below && has_above) {
        bool crease = false;
        for (int i = 0; i <= 8; ++i) crease = crease || jumps(other.lo + other.width() * i / 8);
        if (!crease) continue;
      }
      const ParameterLine line(SurfacePtr(SurfacePtr(), &surface_), held, place);
      if (bounds(line).diameter() <= kCollapsedEdge * size_) {
        add_pole(holds_u, place, other, has_above);
        continue;
      }
      for (const CurveFoot& foot : project(p_, line).feet) {
        if (foot.kind == FootKind::maximum) continue;
        const Vec3 way = p_ - foot.point;
        const double rounding = 1e-14 * glm::length(way);
        const auto slope = [&](const Vec3& d) { return glm::dot(way, d) / std::max(glm::length(d), 1e-300); };
        if (has_below && !(slope(across(below, foot.t, true)) > rounding)) continue;
        if (has_above && !(slope(across(place, foot.t, false)) < -rounding)) continue;
        holds_u ? add(place, foot.t, FootKind::border) : add(foot.t, place, FootKind::border);
      }
    }
  }

  // All parameters of the edge are one point: a foot where the way to it is normal to the surface, a border where the
  // distance grows in all directions.
  void add_pole(bool holds_u, double place, const Interval& other, bool begins) {
    const auto jet = [&](double t) {
      return holds_u ? surface_.evaluate(place, t, 2) : surface_.evaluate(t, place, 2);
    };
    const Vec3 way = p_ - jet(other.lo).point();
    double steepest = -kInfinity, flattest = kInfinity;
    constexpr int kPlaces = 256;
    for (int k = 0; k <= kPlaces; ++k) {
      const SurfaceJet s = jet(other.lo + other.width() * k / kPlaces);
      Vec3 inward = holds_u ? s.du() : s.dv();
      if (!begins) inward = -inward;
      const double length = glm::length(inward);
      if (!(length > 0)) continue;
      const double slope = glm::dot(way, inward) / length;
      steepest = std::max(steepest, slope);
      flattest = std::min(flattest, slope);
    }
    const double rounding = 1e-12 * std::max(glm::length(way), size_);
    const double t = other.lo;
    const auto keep = [&](FootKind kind) { holds_u ? add(place, t, kind) : add(t, place, kind); };
    if (std::max(std::abs(steepest), std::abs(flattest)) <= rounding)
      keep(FootKind::degenerate);
    else if (steepest < -rounding)
      keep(FootKind::border);
  }

  const Vec3 p_;
  const Surface& surface_;
  const Rectangle domain_;
  const std::vector<SurfacePiece> pieces_;
  const DegenerateEdges edges_;
  const double size_;
  SurfaceFeet result_;
};

}  // namespace

SurfaceFeet project(const Vec3& p, const Surface& surface) {
  if (!surface.bounded()) {
    const auto* plane = dynamic_cast<const Plane*>(&surface);
    if (!plane || !plane->knows_feet())
      throw std::invalid_argument("the surface is unbounded: give it a domain to project on");
    const Vec3 local = plane->frame().to_local_point(p);
    return {{{local.x, local.y, plane->point(local.x, local.y), std::abs(local.z), FootKind::minimum}}, {}};
  }
  return SurfaceProjection(p, surface).run();
}

}  // namespace lekalo::geometry
