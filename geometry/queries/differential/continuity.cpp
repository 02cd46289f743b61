#include "geometry/queries/differential/continuity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

constexpr int kPlaces = 64;        // along an edge
constexpr int kSearchSteps = 60;   // beside the worst of them
constexpr double kRegular = 1e-9;  // of the product of its sides: a smaller area of r_u, r_v is a singular place
constexpr int kPlacesOfEdges = 8;  // at which two edges must be near to be shared

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

// One place of a joint: what differs, and of what order of magnitude it is there.
struct Jumps {
  std::array<double, 4> differences{}, scales{1, 1, 1, 1};
  Vec3 point{0};
};

void judge(Continuity& result, const ContinuityTolerances& tolerances) {
  result.order = -1;
  while (result.order < 3 && result.jumps[result.order + 1].relative <= tolerances.of_order[result.order + 1])
    ++result.order;
}

// r_s, r_ss, r_sss by arc length.
std::array<Vec3, 3> by_arc_length(const CurveJet& r) {
  const double v2 = glm::dot(r.d[1], r.d[1]), v = std::sqrt(v2);
  const double a = glm::dot(r.d[1], r.d[2]), a1 = glm::dot(r.d[2], r.d[2]) + glm::dot(r.d[1], r.d[3]);
  const Vec3 second = r.d[2] / v2 - a / (v2 * v2) * r.d[1];
  const Vec3 third = (r.d[3] / v2 - 3 * a / (v2 * v2) * r.d[2] + (4 * a * a / v2 - a1) / (v2 * v2) * r.d[1]) / v;
  return {r.d[1] / v, second, third};
}

double order_of_curvature(double a, double b, double size) { return std::max({std::abs(a), std::abs(b), 1 / size}); }
double order_of_derivative(double a, double b, double curvature, double size) {
  return std::max({std::abs(a), std::abs(b), curvature * curvature, 1 / (size * size)});
}

// The height over the tangent plane across an edge: second and third derivative in the direction D.
struct AcrossEdge {
  Vec3 point, tangent, across;  // across the edge, into the surface or out of it
  double second = 0, third = 0;
};

// `along`: direction of the edge; `inward`: a direction into the surface in its parameters. Nothing at a singular
// place. z_abc = h_abc(r_a, r_b, r_c) + II(r_ab, r_c) + II(r_bc, r_a) + II(r_ac, r_b) for z = h(x, y), grad h = 0.
std::optional<AcrossEdge> across_edge(const Surface& surface, const Vec2& at, const Vec2& inward, const Vec3& along,
                                      bool outward) {
  const SurfaceJet s = surface.evaluate(at.x, at.y, 3);
  const Vec3 area = glm::cross(s.du(), s.dv());
  if (!(glm::length(area) > kRegular * glm::length(s.du()) * glm::length(s.dv()))) return std::nullopt;
  const Vec3 m = glm::normalize(area);
  AcrossEdge result;
  result.point = s.point();
  result.tangent = glm::normalize(along - glm::dot(along, m) * m);
  const Vec3 into = inward.x * s.du() + inward.y * s.dv();
  const Vec3 side = into - glm::dot(into, result.tangent) * result.tangent;
  if (!(glm::length(side) > kRegular * glm::length(into))) return std::nullopt;
  result.across = (outward ? -1.0 : 1.0) / glm::length(side) * side;
  const Vec3 n = glm::cross(result.tangent, result.across);
  // D in the parameters: w with w_u r_u + w_v r_v = D.
  const double size2 = glm::dot(area, area);
  const double w[2] = {glm::dot(glm::cross(result.across, s.dv()), area) / size2,
                       glm::dot(glm::cross(s.du(), result.across), area) / size2};
  // Along w: second derivative q and third c of the surface; the tangential part of q turns II off D.
  const Vec3 q = w[0] * w[0] * s.duu() + 2 * w[0] * w[1] * s.duv() + w[1] * w[1] * s.dvv();
  const Vec3 c = w[0] * w[0] * w[0] * s.d(3, 0) + 3 * w[0] * w[0] * w[1] * s.d(2, 1) +
                 3 * w[0] * w[1] * w[1] * s.d(1, 2) + w[1] * w[1] * w[1] * s.d(0, 3);
  const double p[2] = {glm::dot(glm::cross(q, s.dv()), area) / size2, glm::dot(glm::cross(s.du(), q), area) / size2};
  const double b11 = glm::dot(s.duu(), n), b12 = glm::dot(s.duv(), n), b22 = glm::dot(s.dvv(), n);
  result.second = glm::dot(q, n);
  result.third = glm::dot(c, n) - 3 * (b11 * p[0] * w[0] + b12 * (p[0] * w[1] + p[1] * w[0]) + b22 * p[1] * w[1]);
  return result;
}

// The worst places along an edge; `jumps_at` gives nothing at singular ones.
Continuity worst_along(const Interval& range, const std::function<std::optional<Jumps>(double)>& jumps_at,
                       const ContinuityTolerances& tolerances) {
  Continuity result;
  std::array<std::optional<double>, 4> worst;
  for (int k = 0; k <= kPlaces; ++k) {
    const double t = range.lo + range.width() * k / kPlaces;
    const auto jumps = jumps_at(t);
    if (!jumps) continue;
    for (int i = 0; i < 4; ++i)
      if (!worst[i] || jumps->differences[i] > result.jumps[i].largest) {
        worst[i] = t;
        result.jumps[i] = {jumps->differences[i], jumps->differences[i] / jumps->scales[i], t, jumps->point};
      }
  }
  if (!worst[0]) throw std::invalid_argument("the edge is singular throughout");
  for (int i = 0; i < 4; ++i) {
    // Golden section between the neighbours.
    double lo = std::max(range.lo, *worst[i] - range.width() / kPlaces);
    double hi = std::min(range.hi, *worst[i] + range.width() / kPlaces);
    const auto look = [&](double t) {
      const auto jumps = jumps_at(t);
      if (!jumps) return 0.0;
      if (jumps->differences[i] > result.jumps[i].largest)
        result.jumps[i] = {jumps->differences[i], jumps->differences[i] / jumps->scales[i], t, jumps->point};
      return jumps->differences[i];
    };
    constexpr double kGolden = 0.6180339887498949;
    double x = hi - kGolden * (hi - lo), y = lo + kGolden * (hi - lo), at_x = look(x), at_y = look(y);
    for (int step = 0; step < kSearchSteps; ++step) {
      if (at_x > at_y) {
        hi = y, y = x, at_y = at_x;
        x = hi - kGolden * (hi - lo), at_x = look(x);
      } else {
        lo = x, x = y, at_x = at_y;
        y = lo + kGolden * (hi - lo), at_y = look(y);
      }
    }
  }
  judge(result, tolerances);
  return result;
}

std::optional<Jumps> jumps_between(const std::optional<AcrossEdge>& a, const std::optional<AcrossEdge>& b,
                                   double size) {
  if (!a || !b) return std::nullopt;
  Jumps jumps;
  jumps.point = a->point;
  jumps.differences = {glm::length(a->point - b->point), angle_between(a->across, b->across),
                       std::abs(a->second - b->second), std::abs(a->third - b->third)};
  const double curvature = order_of_curvature(a->second, b->second, size);
  jumps.scales = {size, 1, curvature, order_of_derivative(a->third, b->third, curvature, size)};
  return jumps;
}

// What arrives at a joint of curves, or leaves it; the curve itself may run the other way.
struct JointSide {
  CurveJet jet;
  bool reversed;
};

Continuity at_joint(const JointSide& a, const JointSide& b, double t, double size,
                    const ContinuityTolerances& tolerances) {
  if (!(glm::length(a.jet.d[1]) > 0) || !(glm::length(b.jet.d[1]) > 0))
    throw std::invalid_argument("a curve has a cusp at the joint: it has no tangent there");
  std::array<Vec3, 3> da = by_arc_length(a.jet), db = by_arc_length(b.jet);
  if (a.reversed) da[0] = -da[0], da[2] = -da[2];
  if (b.reversed) db[0] = -db[0], db[2] = -db[2];
  const double curvature = order_of_curvature(glm::length(da[1]), glm::length(db[1]), size);
  const double differences[] = {glm::length(a.jet.d[0] - b.jet.d[0]), angle_between(da[0], db[0]),
                                glm::length(da[1] - db[1]), glm::length(da[2] - db[2])};
  const double scales[] = {size, 1, curvature,
                           order_of_derivative(glm::length(da[2]), glm::length(db[2]), curvature, size)};
  Continuity result;
  for (int i = 0; i < 4; ++i) result.jumps[i] = {differences[i], differences[i] / scales[i], t, a.jet.d[0]};
  judge(result, tolerances);
  return result;
}

}  // namespace

CurveJoint joint(const Curve& a, const Curve& b, const ContinuityTolerances& tolerances) {
  if (a.is_closed() || b.is_closed()) throw std::invalid_argument("a closed curve has no ends to join");
  Box3 box = bounds(a);
  box.include(bounds(b));
  const double size = std::max(box.diameter(), 1e-300);
  const auto end_of = [](const Curve& curve, bool last) { return last ? curve.domain().hi : curve.domain().lo; };
  CurveJoint result;
  double nearest = kInfinity;
  for (const bool a_end : {true, false})
    for (const bool b_end : {false, true}) {
      const double gap = glm::length(a.point(end_of(a, a_end)) - b.point(end_of(b, b_end)));
      if (gap < nearest) nearest = gap, result.a_end = a_end, result.b_end = b_end;
    }
  const double t = end_of(a, result.a_end);
  result.continuity = at_joint({a.evaluate(t, 3), !result.a_end},
                               {b.evaluate(end_of(b, result.b_end), 3), result.b_end}, t, size, tolerances);
  return result;
}

std::vector<CurveOwnJoint> joints(const Curve& curve, const ContinuityTolerances& tolerances) {
  if (!(curve.domain().width() < kInfinity)) throw std::invalid_argument("the curve is unbounded");
  const double size = std::max(bounds(curve).diameter(), 1e-300);
  const std::vector<CurvePiece> pieces = curve.pieces();
  std::vector<CurveOwnJoint> result;
  for (size_t i = curve.is_closed() ? 0 : 1; i < pieces.size(); ++i) {
    const Interval before = pieces[i > 0 ? i - 1 : pieces.size() - 1].domain, after = pieces[i].domain;
    result.push_back(
        {after.lo, at_joint({evaluate_within(curve, before, before.hi, 3), false},
                            {evaluate_within(curve, after, after.lo, 3), false}, after.lo, size, tolerances)});
  }
  return result;
}

namespace {

// An edge of a domain as a curve, with what lies beside it.
struct DomainSide {
  const Surface& surface;
  DomainEdge edge;
  ParameterLine line;

  Vec2 place(double t) const { return edge.held == IsoDirection::u ? Vec2(edge.at, t) : Vec2(t, edge.at); }
  Vec2 inward() const {
    const Rectangle domain = surface.domain();
    const bool holds_u = edge.held == IsoDirection::u;
    const double side = edge.at == (holds_u ? domain.u.lo : domain.v.lo) ? 1 : -1;
    return holds_u ? Vec2(side, 0) : Vec2(0, side);
  }
};

std::vector<DomainSide> sides_of(const Surface& surface, double size) {
  const Rectangle domain = surface.domain();
  const SurfacePtr shared(SurfacePtr(), &surface);
  std::vector<DomainSide> result;
  for (const IsoDirection held : {IsoDirection::u, IsoDirection::v}) {
    const Interval across = held == IsoDirection::u ? domain.u : domain.v;
    for (const double at : {across.lo, across.hi}) {
      DomainSide side{surface, {held, at, held == IsoDirection::u ? domain.v : domain.u}, {shared, held, at}};
      if (bounds(side.line).diameter() > kCollapsedEdge * size) result.push_back(std::move(side));
    }
  }
  return result;
}

// The part of the first that runs along the second.
std::optional<Interval> shared_part(const DomainSide& a, const DomainSide& b, double gap) {
  const Interval range = a.line.domain();
  const auto is_near = [&](double t) { return project(a.line.point(t), b.line).foot_points[0].distance <= gap; };
  std::vector<double> places;
  for (const double t : {range.lo, range.hi})
    if (is_near(t)) places.push_back(t);
  if (places.size() < 2 && !b.line.is_closed())
    for (const double t : {b.line.domain().lo, b.line.domain().hi}) {
      const CurveFootPoint foot_point = project(b.line.point(t), a.line).foot_points[0];
      if (foot_point.distance <= gap) places.push_back(foot_point.t);
    }
  if (places.empty()) return std::nullopt;
  const auto [lo, hi] = std::minmax_element(places.begin(), places.end());
  const Interval part{*lo, *hi};
  if (!(glm::length(a.line.point(part.middle()) - a.line.point(part.lo)) > gap)) return std::nullopt;
  for (int k = 1; k < kPlacesOfEdges; ++k)
    if (!is_near(part.lo + part.width() * k / kPlacesOfEdges)) return std::nullopt;
  return part;
}

}  // namespace

std::vector<SurfaceJoint> joints(const Surface& a, const Surface& b, const ContinuityTolerances& tolerances,
                                 double gap) {
  if (!a.bounded() || !b.bounded()) throw std::invalid_argument("the surface is unbounded: give it a domain");
  Box3 box = bounds(a);
  box.include(bounds(b));
  const double size = std::max(box.diameter(), 1e-300);
  std::vector<SurfaceJoint> result;
  for (const DomainSide& side_a : sides_of(a, size))
    for (const DomainSide& side_b : sides_of(b, size)) {
      // The seam of one surface is no joint of it with itself held at the same place.
      if (&a == &b && side_a.edge.held == side_b.edge.held && side_a.edge.at >= side_b.edge.at) continue;
      if (&a == &b && side_a.edge.held != side_b.edge.held) continue;
      const auto part = shared_part(side_a, side_b, gap * size);
      if (!part) continue;
      const auto foot_point = [&](double t) { return project(side_a.line.point(t), side_b.line).foot_points[0].t; };
      const auto jumps_at = [&](double t) {
        const Vec3 along = side_a.line.evaluate(t, 1).d[1];
        return jumps_between(across_edge(a, side_a.place(t), side_a.inward(), along, true),
                             across_edge(b, side_b.place(foot_point(t)), side_b.inward(), along, false), size);
      };
      SurfaceJoint joint{side_a.edge, side_b.edge, {}};
      joint.a.range = *part;
      if (!side_b.line.is_closed()) {
        const double first = foot_point(part->lo), last = foot_point(part->hi);
        joint.b.range = {std::min(first, last), std::max(first, last)};
      }
      joint.continuity = worst_along(*part, jumps_at, tolerances);
      result.push_back(std::move(joint));
    }
  return result;
}

Continuity continuity(const Body& body, int index, const ContinuityTolerances& tolerances) {
  const Edge& edge = body.edges[index];
  if (edge.kind == EdgeKind::pole || edge.coedges.size() != 2)
    throw std::invalid_argument("the edge does not join two faces");
  const double size = std::max(bounds(body).diameter(), 1e-300);
  const auto side = [&](int use, double t, const Vec3& along) {
    const Coedge& coedge = body.coedges[edge.coedges[use]];
    const Face& face = body.faces[body.loops[coedge.loop].face];
    const CurveJet image = coedge.image->evaluate(t, 1);
    // The face is on the left of its loop, seen against its normal.
    const double turn = (face.forward == (face.surface->normal_sign() > 0)) == coedge.forward ? 1 : -1;
    return across_edge(*face.surface, Vec2(image.d[0]), turn * Vec2(-image.d[1].y, image.d[1].x), along, use == 0);
  };
  return worst_along(
      edge.curve->domain(),
      [&](double t) {
        const Vec3 along = edge.curve->evaluate(t, 1).d[1];
        return jumps_between(side(0, t, along), side(1, t, along), size);
      },
      tolerances);
}

}  // namespace lekalo::geometry
