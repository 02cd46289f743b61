// The cubic with the curve's ends and derivatives there, B(s) = P(a + s h), is off by P'''' h^4 / 384. It is compared
// with the curve at places between; what is too far off is halved.
#include "render/drawing/paths.h"

#include <algorithm>
#include <cmath>

#include "geometry/numerics/interval.h"

namespace lekalo::render {

using geometry::Interval;

namespace {

constexpr int kMostHalvings = 24;

class Fitting {
 public:
  Fitting(const ProjectedCurve& curve, double tolerance, Path& path)
      : curve_(curve), tolerance_(tolerance), path_(path) {}

  // A smooth stretch.
  void add(const Interval& t) {
    if (is_straight(t)) {
      const ProjectedCurve::Place end = curve_.place(t.hi);
      path_.steps.push_back({true, {}, {}, end.p});
      return;
    }
    const auto at = [&](double x) { return curve_.place(x); };
    add(t, at(t.lo), at(geometry::next_down(t.hi)), 0);
  }

 private:
  bool is_straight(const Interval& t) const {
    const Vec2 from = curve_.place(t.lo).p, chord = curve_.place(geometry::next_down(t.hi)).p - from;
    const double length = glm::length(chord);
    if (!(length > 0)) return false;
    const Vec2 across(-chord.y / length, chord.x / length), along = chord / length;
    double before = 0;
    constexpr int kPlaces = 24;
    for (int k = 1; k < kPlaces; ++k) {
      const Vec2 off = curve_.place(t.lo + t.width() * k / kPlaces).p - from;
      const double ahead = glm::dot(off, along);
      if (std::abs(glm::dot(off, across)) > 0.1 * tolerance_ || ahead < before || ahead > length) return false;
      before = ahead;
    }
    return true;
  }

  void add(const Interval& t, const ProjectedCurve::Place& begin, const ProjectedCurve::Place& end, int depth) {
    const double h = t.width();
    const Vec2 first = begin.p + h / 3 * begin.tangent, second = end.p - h / 3 * end.tangent;
    bool fits = true;
    for (const double s : {0.5, 0.2, 0.8, 0.35, 0.65}) {
      const double r = 1 - s;
      const Vec2 b = r * r * r * begin.p + 3 * r * r * s * first + 3 * r * s * s * second + s * s * s * end.p;
      if (!(glm::length(b - curve_.place(t.lo + s * h).p) <= tolerance_)) {
        fits = false;
        break;
      }
    }
    if (fits || depth >= kMostHalvings) {
      path_.steps.push_back({false, first, second, end.p});
      return;
    }
    const double middle = t.middle();
    const ProjectedCurve::Place between = curve_.place(middle);
    add({t.lo, middle}, begin, between, depth + 1);
    add({middle, t.hi}, between, end, depth + 1);
  }

  const ProjectedCurve& curve_;
  double tolerance_;
  Path& path_;
};

}  // namespace

Path fitted_path(const ProjectedCurve& curve, const Interval& t, const std::vector<double>& breaks, double tolerance) {
  std::vector<double> ends{t.lo};
  for (const double at : breaks)
    if (at > ends.back() && at < t.hi) ends.push_back(at);
  ends.push_back(t.hi);
  Path path;
  path.from = curve.place(t.lo).p;
  Fitting fitting(curve, tolerance, path);
  for (size_t k = 0; k + 1 < ends.size(); ++k) fitting.add({ends[k], ends[k + 1]});
  path.closed = path.steps.size() > 1 && glm::length(path.steps.back().to - path.from) <= tolerance;
  return path;
}

Path reversed(const Path& path) {
  Path result;
  result.closed = path.closed;
  result.from = path.steps.empty() ? path.from : path.steps.back().to;
  for (size_t k = path.steps.size(); k-- > 0;) {
    PathStep step = path.steps[k];
    std::swap(step.first, step.second);
    step.to = k > 0 ? path.steps[k - 1].to : path.from;
    result.steps.push_back(step);
  }
  return result;
}

}  // namespace lekalo::render
