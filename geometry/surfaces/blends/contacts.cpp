#include "geometry/surfaces/blends/contacts.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "geometry/composition.h"
#include "geometry/describe.h"
#include "geometry/queries/differential/curvature.h"

namespace lekalo::geometry {

namespace {

constexpr int kMaxIterations = 20;
constexpr double kSolved = 1e-11;    // of the size: the step after which there is none, as convergence is quadratic
constexpr double kSatisfied = 1e-9;  // of the size: the equations
constexpr double kRounding = 1e-15;
constexpr int kPolished = 4;      // steps below that
constexpr double kLongest = 0.5;  // of the size: no step is longer
constexpr int kSteps = 64;        // of a march, at least
constexpr double kShortestStep = 1e-7;
constexpr double kInsideSlack = 1e-9;
constexpr double kTurn = 0.8;  // cosine of what normals turn by from step to step

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

struct Contacts::Place {
  double t = 0;
  Vec3 guide{0}, along{0};  // its point, its direction of length 1
  std::array<double, 2> sizes{0, 0};
};

Contacts::Contacts(BlendLaw law, double start_t, const std::array<Vec2, 2>& starts) : law_(std::move(law)) {
  if (!(law_.sizes[0].is_constant() && law_.sizes[1].is_constant())) fraction_ = ArcFraction(*law_.guide);
  const Interval all = law_.guide->domain();
  const Place start = place_at(start_t);
  size_ = bounds(*law_.guide).diameter() + std::max(start.sizes[0], start.sizes[1]);
  const Solution first = first_solution(start_t, starts);
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
  const double s = fraction_.length() > 0 ? fraction_.at(law_.guide->domain().clamp(t)) : 0;
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
                             const J& radius) -> std::array<J, kMost> {
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
  Eigen::Matrix<double, kMost, kMost> matrix = Eigen::Matrix<double, kMost, kMost>::Zero();
  Eigen::Matrix<double, kMost, 1> values = Eigen::Matrix<double, kMost, 1>::Zero();
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

// Adds the nodes behind `from`; false where it stops before the guide's end.
bool Contacts::march(const Node& from, double direction, std::vector<Node>& nodes) const {
  const Interval all = law_.guide->domain();
  const double end = direction > 0 ? all.hi : all.lo, longest = all.width() / kSteps;
  double step = longest, last_step = 0;
  Node at = from, last = from;
  const auto normals = [&](const Unknowns& x) {
    return std::array<Vec3, 2>{local_at(*law_.of[0], 1, x[0], x[1]).normal[0],
                               count() > 2 ? local_at(*law_.of[1], 1, x[2], x[3]).normal[0] : Vec3(0)};
  };
  while (at.t != end) {
    const bool reaches = std::abs(end - at.t) <= step * (1 + 1e-9);
    const double t = reaches ? end : at.t + direction * step, taken = std::abs(t - at.t);
    Unknowns start = at.x;
    if (last_step > 0)
      for (int k = 0; k < kMost; ++k) start[k] += (at.x[k] - last.x[k]) * taken / last_step;
    const Solution found = solve(place_at(t), start);
    bool is_smooth = found.found;
    if (is_smooth) {
      const auto a = normals(at.x), b = normals(found.x);
      is_smooth = glm::dot(a[0], b[0]) > kTurn && (count() == 2 || glm::dot(a[1], b[1]) > kTurn);
    }
    if (!is_smooth) {
      step = 0.5 * taken;
      if (step > kShortestStep * all.width()) continue;
      if (!is_inside(at.x, kInsideSlack)) return false;
      const Vec3 p = law_.guide->point(at.t);
      throw FieldError(law_.size_field,
                       fmt::format("the contacts end near the guide's [{:.4g}, {:.4g}, {:.4g}] (its t = {:.6g})", p.x,
                                   p.y, p.z, at.t),
                       "take a smaller size, or a part of the guide");
    }
    last = at, last_step = taken;
    at = {t, found.x};
    nodes.push_back(at);
    step = std::min(longest, 1.5 * taken);
  }
  return true;
}

bool Contacts::is_inside(const Unknowns& x, double slack_share) const {
  for (int k = 0; k < count() / 2; ++k) {
    const Surface& of = *law_.of[k];
    const Rectangle domain = of.domain();
    const Periods periods = of.periods();
    const auto lies = [&](const Interval& range, double period, double at) {
      const double slack = slack_share * std::min(range.width(), 1e9);
      if (period > 0) {
        if (range.width() >= period * (1 - 1e-12)) return true;
        at -= period * std::floor((at - range.lo + slack) / period);
      }
      return at >= range.lo - slack && at <= range.hi + slack;
    };
    if (!lies(domain.u, periods.u, x[2 * k]) || !lies(domain.v, periods.v, x[2 * k + 1])) return false;
  }
  return true;
}

double Contacts::border_between(Node inside, const Node& outside) const {
  double t = outside.t;
  constexpr int kHalvings = 45;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (inside.t + t);
    const Solution at = solve(place_at(middle), inside.x);
    if (at.found && is_inside(at.x, 0))
      inside = {middle, at.x};
    else
      t = middle;
  }
  return inside.t;
}

void Contacts::cut(const std::vector<Node>& nodes) {
  Interval best(0, 0);
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (!is_inside(nodes[i].x, kInsideSlack)) continue;
    size_t j = i;
    while (j + 1 < nodes.size() && is_inside(nodes[j + 1].x, kInsideSlack)) ++j;
    if (nodes[j].t - nodes[i].t > best.width() && j > i) {
      best.lo = i > 0 ? border_between(nodes[i], nodes[i - 1]) : nodes[i].t;
      best.hi = j + 1 < nodes.size() ? border_between(nodes[j], nodes[j + 1]) : nodes[j].t;
    }
    i = j;
  }
  if (!(best.width() > 0))
    throw FieldError(law_.size_field, "the contacts lie outside of the surfaces all along the guide",
                     "turn `sides`, take a smaller size, or extend the surfaces (extended_surface)");
  domain_ = best;
}

// A ball fits where no principal curvature towards it exceeds its own.
void Contacts::check_fit(const Node& node) const {
  if (law_.kind == BlendKind::chamfer) return;
  const Contact at = contact(place_at(node.t), node.x);
  const auto sizes = place_at(node.t).sizes;
  for (int k = 0; k < count() / 2; ++k) {
    const SurfaceJet jet = law_.of[k]->evaluate(at.places[k].x, at.places[k].y, 2);
    const double bent = curvature(jet, at.normals[k]).principal[0],
                 r = law_.kind == BlendKind::ball ? sizes[k] : at.radius;
    if (bent * r < 1 - 1e-9) continue;
    const Vec3& p = at.points[k];
    throw FieldError(law_.size_field,
                     fmt::format("the ball of radius {:.6g} does not fit: the {} surface bends with the radius {:.6g} "
                                 "at [{:.4g}, {:.4g}, {:.4g}]",
                                 r, k == 0 ? "first" : "second", 1 / bent, p.x, p.y, p.z),
                     "take a smaller one, or the other side of the surface");
  }
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

namespace {

// The cells between the lines of a surface, and over its seam, counted.
class Cells {
 public:
  Cells(std::vector<double> lines, double period) : lines_(std::move(lines)), period_(period) {}
  long at(double x) const {
    long turns = 0;
    if (period_ > 0) {
      turns = static_cast<long>(std::floor((x - lines_.front()) / period_));
      x -= static_cast<double>(turns) * period_;
    }
    const auto above = std::upper_bound(lines_.begin() + 1, lines_.end() - 1, x);
    return turns * static_cast<long>(lines_.size() - 1) + (above - lines_.begin() - 1);
  }

 private:
  std::vector<double> lines_;
  double period_;
};

}  // namespace

void Contacts::find_breaks() {
  constexpr double kAlong = 1e-9;  // of the width: a contact that keeps as near to a line runs along it
  for (int axis = 0; axis < count() / 2 * 2; ++axis) {
    const Surface& of = *law_.of[axis / 2];
    if (!of.bounded()) continue;
    const SurfaceProperties properties = properties_of(of);
    const bool is_u = axis % 2 == 0;
    const double period = is_u ? of.periods().u : of.periods().v;
    const Interval range = is_u ? of.domain().u : of.domain().v;
    const bool closes = period > 0 && range.width() >= period * (1 - 1e-12);
    const Cells cells(is_u ? properties.breaks_u : properties.breaks_v, closes ? period : 0);
    const auto value = [&](double t) { return at(t).places[axis / 2][is_u ? 0 : 1]; };
    for (size_t i = 0; i + 1 < nodes_.size(); ++i) {
      double from = std::max(nodes_[i].t, domain_.lo);
      const double to = std::min(nodes_[i + 1].t, domain_.hi);
      if (!(from < to)) continue;
      const double last = value(to);
      for (double first = value(from); cells.at(first) != cells.at(last); first = value(from)) {
        if (std::abs(last - first) <= kAlong * range.width()) break;
        Interval t(from, to);  // the last of the first cell, the first of another
        for (int k = 0; k < 60 && t.lo < t.middle() && t.middle() < t.hi; ++k)
          (cells.at(value(t.middle())) == cells.at(first) ? t.lo : t.hi) = t.middle();
        breaks_.push_back(t.hi);
        from = t.hi;
      }
    }
  }
  std::sort(breaks_.begin(), breaks_.end());
}

Contact Contacts::at(double t) const {
  const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), t, [](double a, const Node& b) { return a < b.t; });
  const Node& next = after == nodes_.end() ? nodes_.back() : *after;
  const Node& node = after == nodes_.begin() ? next : *(after - 1);
  const double w = next.t > node.t ? (t - node.t) / (next.t - node.t) : 0;
  Unknowns start;
  for (int k = 0; k < kMost; ++k) start[k] = node.x[k] + w * (next.x[k] - node.x[k]);
  const Place place = place_at(t);
  const Solution found = solve(place, start);
  if (!found.found)
    throw FieldError(law_.size_field, fmt::format("the contacts are lost at the guide's t = {:.6g}", t),
                     "take a smaller size, or a part of the guide");
  return contact(place, found.x);
}

}  // namespace lekalo::geometry
