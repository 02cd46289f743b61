// The way of the contacts along the guide: from place to place, where it leaves the surfaces, where it is not smooth.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/composition.h"
#include "geometry/describe.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/surfaces/blends/contacts.h"

namespace lekalo::geometry {

namespace {

constexpr int kSteps = 64;  // of a march, at least
constexpr double kShortestStep = 1e-7;
constexpr double kInsideSlack = 1e-9;
constexpr double kTurn = 0.8;  // cosine of what normals turn by from step to step

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

// Adds the nodes behind `from`; false where it stops before the guide's end.
bool Contacts::march(const Node& from, double direction, std::vector<Node>& nodes) const {
  const Interval all = law_.guide->domain();
  const double end = direction > 0 ? all.hi : all.lo, longest = all.width() / kSteps;
  double step = longest, last_step = 0;
  Node at = from, last = from;
  const auto normals = [&](const Unknowns& x) {
    return std::array<Vec3, 2>{law_.of[0]->normal(x[0], x[1]), count() > 2 ? law_.of[1]->normal(x[2], x[3]) : Vec3(0)};
  };
  while (at.t != end) {
    const bool reaches = std::abs(end - at.t) <= step * (1 + 1e-9);
    const double t = reaches ? end : at.t + direction * step, taken = std::abs(t - at.t);
    Unknowns start = at.x;
    if (last_step > 0)
      for (int k = 0; k < kMaxUnknowns; ++k) start[k] += (at.x[k] - last.x[k]) * taken / last_step;
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

}  // namespace lekalo::geometry
