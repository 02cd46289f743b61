#include "geometry/surfaces/blends/contacts.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "geometry/describe.h"
#include "geometry/formula.h"

namespace lekalo::geometry {

namespace {

constexpr int kMaxIterations = 20;
constexpr double kSolved = 1e-11;    // of the size: the step after which there is none, as convergence is quadratic
constexpr double kSatisfied = 1e-9;  // of the size: the equations
constexpr double kRounding = 1e-15;
constexpr int kPolished = 4;      // steps below that
constexpr double kLongest = 0.5;  // of the size: no step is longer

// A point of a surface with its normal, and their derivatives by u and v.
struct Local {
  std::array<Vec3, 3> point, normal;
};

Local local_at(const Surface& surface, double side, double u, double v) {
  const SurfaceJet r = surface.evaluate(u, v, 2);
  const Vec3 n = glm::cross(r.du(), r.dv());
  const std::array<Vec3, 2> dn{glm::cross(r.duu(), r.dv()) + glm::cross(r.du(), r.duv()),
                               glm::cross(r.duv(), r.dv()) + glm::cross(r.du(), r.dvv())};
  const double length = glm::length(n);
  const Vec3 m = n / length;
  Local local{{r.point(), r.du(), r.dv()}, {side * m, Vec3(0), Vec3(0)}};
  for (int k = 0; k < 2; ++k) local.normal[k + 1] = (side / length) * (dn[k] - glm::dot(m, dn[k]) * m);
  return local;
}

// One unknown, `axis` (0: u, 1: v), varies; another axis: none.
Triple<Jet<double, 1>> varied(const std::array<Vec3, 3>& of, int axis) {
  const Vec3 d = axis == 0 || axis == 1 ? of[axis + 1] : Vec3(0);
  Triple<Jet<double, 1>> r{of[0].x, of[0].y, of[0].z};
  r.x.c[1] = d.x, r.y.c[1] = d.y, r.z.c[1] = d.z;
  return r;
}

}  // namespace

Contacts::Contacts(BlendLaw law, double start_t, const std::array<Vec2, 2>& starts, bool known) : law_(std::move(law)) {
  if (!(law_.sizes[0].is_constant() && law_.sizes[1].is_constant())) fraction_ = ArcFraction(measured());
  const Interval all = law_.guide->domain();
  const Place start = place_at(start_t);
  size_ = bounds(*law_.guide).diameter() + std::max(start.sizes[0], start.sizes[1]);
  const Solution first = known ? solve(start, {starts[0].x, starts[0].y, starts[1].x, starts[1].y, start.sizes[0]})
                               : first_solution(start_t, starts);
  if (!first.found)
    throw FieldError(law_.size_field,
                     fmt::format("no contacts were found across the guide at [{:.4g}, {:.4g}, {:.4g}]", start.guide.x,
                                 start.guide.y, start.guide.z),
                     "turn `sides`, take a smaller size, or a guide nearer to the blend");
  std::vector<Node> before, after;
  const Node node{start_t, first.x};
  march(node, -1, before);
  march(node, 1, after);
  nodes_.assign(before.rbegin(), before.rend());
  nodes_.push_back(node);
  nodes_.insert(nodes_.end(), after.begin(), after.end());
  domain_ = {nodes_.front().t, nodes_.back().t};
  cut(nodes_);
  for (const Node& one : nodes_)
    if (domain_.contains(one.t)) check_fit(one);
  if (domain_.width() >= all.width() * (1 - 1e-12)) domain_ = all;
  find_breaks();
}

int Contacts::count() const { return law_.kind == BlendKind::edge ? 2 : law_.kind == BlendKind::chord ? 5 : 4; }

Contacts::Place Contacts::place_at(double t) const {
  const CurveJet jet = law_.guide->evaluate(t, 1);
  Place place{t, jet.d[0], glm::normalize(jet.d[1]), {0, 0}};
  const double s = fraction_.length() > 0 ? fraction_.at(measured().domain().clamp(t)) : 0;
  for (int k = 0; k < 2; ++k) {
    place.sizes[k] = law_.sizes[k](s);
    if (!(place.sizes[k] > 0 && place.sizes[k] < kInfinity))
      throw FieldError(law_.size_field, fmt::format("it is {:.6g} at s = {:.6g}", place.sizes[k], s),
                       "it is positive all along the guide");
  }
  return place;
}

// One step: the residuals and their derivatives by each unknown.
Contacts::Solution Contacts::solve(const Place& place, Unknowns x) const {
  using J = Jet<double, 1>;
  const int n = count();
  const Triple<double> g = triple(place.guide), along = triple(place.along);
  const auto residuals = [&](const Triple<J>& p, const Triple<J>& m, const Triple<J>& q, const Triple<J>& k,
                             const J& radius) -> std::array<J, kMaxUnknowns> {
    const auto [a, b] = place.sizes;
    if (law_.kind == BlendKind::edge) {
      const Triple<J> way = p + a * m - g;
      return {(dot(way, way) - a * a) / a, dot(way, along), J(0), J(0), J(0)};
    }
    Triple<J> c, d;
    if (law_.kind == BlendKind::chamfer) {
      const J cosine = dot(m, k), sine = length(cross(m, k));
      c = p + (a / sine) * (cosine * m - k), d = q + (b / sine) * (cosine * k - m);
    } else if (law_.kind == BlendKind::chord) {
      c = p + radius * m, d = q + radius * k;
    } else {
      c = p + a * m, d = q + b * k;
    }
    const Triple<J> apart = c - d, chord = p - q;
    return {apart.x, apart.y, apart.z, dot(0.5 * (c + d) - g, along), (dot(chord, chord) - a * a) / a};
  };
  Eigen::Matrix<double, kMaxUnknowns, kMaxUnknowns> matrix = Eigen::Matrix<double, kMaxUnknowns, kMaxUnknowns>::Zero();
  Eigen::Matrix<double, kMaxUnknowns, 1> values = Eigen::Matrix<double, kMaxUnknowns, 1>::Zero();
  int polished = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Local p = local_at(*law_.of[0], law_.sides[0], x[0], x[1]);
    const Local q = n > 2 ? local_at(*law_.of[1], law_.sides[1], x[2], x[3]) : p;
    for (int axis = 0; axis < n; ++axis) {
      J radius(x[4]);
      if (axis == 4) radius.c[1] = 1;
      const auto column = residuals(varied(p.point, axis), varied(p.normal, axis), varied(q.point, axis - 2),
                                    varied(q.normal, axis - 2), radius);
      for (int row = 0; row < n; ++row) matrix(row, axis) = column[row].c[1], values(row) = column[row].c[0];
    }
    const Eigen::VectorXd step = matrix.topLeftCorner(n, n).fullPivLu().solve(values.head(n));
    if (!step.allFinite()) return {};
    const double off = values.head(n).norm();
    double length = glm::length(step(0) * p.point[1] + step(1) * p.point[2]);
    if (n > 2) length = std::max(length, glm::length(step(2) * q.point[1] + step(3) * q.point[2]));
    if (n > 4) length = std::max(length, std::abs(step(4)));
    const double share = std::min(1.0, kLongest * size_ / length);
    for (int k = 0; k < n; ++k) x[k] -= share * step(k);
    // On a surface of class C1 Newton's matrix may be that of the other side of a knot: once more, or twice.
    // A singular matrix may keep still without a solution.
    if (length <= kRounding * size_ || (length <= kSolved * size_ && ++polished == kPolished))
      return {x, off <= kSatisfied * size_};
  }
  return {};
}

// The solution for sizes that grow from nothing, where the surfaces meet, to what they are.
Contacts::Solution Contacts::enlarged(Place place, Unknowns x) const {
  const std::array<double, 2> full = place.sizes;
  double share = 0, step = 0.125;
  place.sizes = {0, 0};
  Solution at = solve(place, x);
  while (at.found && share < 1) {
    const double next = std::min(1.0, share + step);
    place.sizes = {next * full[0], next * full[1]};
    const Solution more = solve(place, at.x);
    if (more.found)
      at = more, share = next, step = std::min(0.25, 1.5 * step);
    else if ((step *= 0.5) < 1e-4)
      return {};
  }
  return at;
}

// Beside the edge's point, on the side of the second surface, as far as the ball's circle reaches.
Contacts::Unknowns Contacts::edge_start(const Place& place, const std::array<Vec2, 2>& starts) const {
  const Local p = local_at(*law_.of[0], law_.sides[0], starts[0].x, starts[0].y);
  const Local q = local_at(*law_.of[1], law_.sides[1], starts[1].x, starts[1].y);
  const double r = place.sizes[0], height = glm::dot(place.guide - p.point[0], p.normal[0]);
  Vec3 across = glm::cross(place.along, p.normal[0]);
  if (glm::dot(across, q.normal[0]) < 0) across = -across;
  const Vec3 way = std::sqrt(std::max(r * r - (r - height) * (r - height), 1e-6 * r * r)) * glm::normalize(across);
  const double e = glm::dot(p.point[1], p.point[1]), f = glm::dot(p.point[1], p.point[2]),
               g = glm::dot(p.point[2], p.point[2]), a = glm::dot(way, p.point[1]), b = glm::dot(way, p.point[2]);
  const double d = e * g - f * f;
  return {starts[0].x + (a * g - b * f) / d, starts[0].y + (b * e - a * f) / d, starts[1].x, starts[1].y, r};
}

Contacts::Solution Contacts::first_solution(double t, const std::array<Vec2, 2>& starts) const {
  Place place = place_at(t);
  if (law_.kind == BlendKind::edge) return solve(place, edge_start(place, starts));
  Unknowns x{starts[0].x, starts[0].y, starts[1].x, starts[1].y, place.sizes[0]};
  if (law_.kind != BlendKind::chord) {
    const Solution grown = enlarged(place, x);
    return grown.found ? grown : solve(place, x);
  }
  // The chord is 2 r sin(a/2), a the angle between the normals: that of the ball with such a radius is near.
  const Vec3 m = local_at(*law_.of[0], law_.sides[0], x[0], x[1]).normal[0],
             k = local_at(*law_.of[1], law_.sides[1], x[2], x[3]).normal[0];
  Contacts ball = *this;
  ball.law_.kind = BlendKind::ball;
  Place smaller = place;
  smaller.sizes[0] = smaller.sizes[1] = place.sizes[0] / glm::length(m - k);
  Solution start = ball.enlarged(smaller, x);
  if (!start.found) return {};
  start.x[4] = smaller.sizes[0];
  return solve(place, start.x);
}

Contact Contacts::contact(const Place& place, const Unknowns& x) const {
  Contact result;
  result.places = {Vec2(x[0], x[1]), Vec2(x[2], x[3])};
  const double a = law_.kind == BlendKind::chord ? x[4] : place.sizes[0];
  result.radius = a;
  const Local p = local_at(*law_.of[0], law_.sides[0], x[0], x[1]);
  result.points[0] = p.point[0], result.normals[0] = p.normal[0];
  result.center = p.point[0] + a * p.normal[0];
  if (law_.kind == BlendKind::edge) {
    result.points[1] = place.guide;
    result.normals[1] = (result.center - place.guide) / a;
    return result;
  }
  const Local q = local_at(*law_.of[1], law_.sides[1], x[2], x[3]);
  result.points[1] = q.point[0], result.normals[1] = q.normal[0];
  if (law_.kind == BlendKind::chamfer) {
    const double cosine = glm::dot(p.normal[0], q.normal[0]);
    const double sine = glm::length(glm::cross(p.normal[0], q.normal[0]));
    result.center = p.point[0] + (a / sine) * (cosine * p.normal[0] - q.normal[0]);
  }
  return result;
}

Contact Contacts::at(double t) const {
  const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), t, [](double a, const Node& b) { return a < b.t; });
  const Node& next = after == nodes_.end() ? nodes_.back() : *after;
  const Node& node = after == nodes_.begin() ? next : *(after - 1);
  const double w = next.t > node.t ? (t - node.t) / (next.t - node.t) : 0;
  Unknowns start;
  for (int k = 0; k < kMaxUnknowns; ++k) start[k] = node.x[k] + w * (next.x[k] - node.x[k]);
  const Place place = place_at(t);
  const Solution found = solve(place, start);
  if (!found.found)
    throw FieldError(law_.size_field, fmt::format("the contacts are lost at the guide's t = {:.6g}", t),
                     "take a smaller size, or a part of the guide");
  return contact(place, found.x);
}

}  // namespace lekalo::geometry
