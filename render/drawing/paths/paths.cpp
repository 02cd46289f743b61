// The cubic with the curve's ends and derivatives there, B(s) = P(a + s h), is off by P'''' h^4 / 384. It is compared
// with the curve at places between; what is too far off is halved. Where the speed at one end is infinite, as that of
// (t, sqrt(t)) at 0, the parabola B(s) = P(a + s^2 h) stands for it: of roots it is the curve itself.
#include "render/drawing/paths/paths.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/numerics/interval.h"
#include "render/drawing/paths/ellipse_fit.h"

namespace lekalo::render {

using geometry::Interval;
using geometry::kPi;

namespace {

constexpr int kMaxHalvings = 24;
// Halvings towards an end of infinite speed, until numbers end: a cube root falls by a fifth with each.
constexpr int kMaxHalvingsOfSteep = 52;
// Of a chord: an end whose tangent takes the path farther than this is steep.
constexpr double kSteep = 10;
// What is told as a straight line or an arc is nearer to it than these parts of the tolerance. Pictures of circles are
// ellipses to rounding; other curves come so near to one only where they hardly turn.
constexpr double kStraight = 0.1, kElliptic = 1e-3;
constexpr double kMinTurn = 0.1;  // radians of its ellipse; shorter arcs tell it badly

class Fitting {
 public:
  Fitting(const ProjectedCurve& curve, const std::vector<double>& breaks, double tolerance, Path& path)
      : curve_(curve), breaks_(breaks), tolerance_(tolerance), path_(path) {}

  void run(const Interval& t) {
    std::vector<double> ends{t.lo};
    for (const double at : breaks_)
      if (at > ends.back() && at < t.hi) ends.push_back(at);
    ends.push_back(t.hi);
    if (add_simple(ends)) return;
    for (size_t k = 0; k + 1 < ends.size(); ++k) {
      const Interval part{ends[k], ends[k + 1]};
      if (ends.size() > 2 && add_simple({part.lo, part.hi})) continue;
      add(part, curve_.place(part.lo), curve_.place(geometry::next_down(part.hi)), 0);
    }
  }

 private:
  // As a straight line or an arc.
  bool add_simple(const std::vector<double>& ends) {
    const std::vector<Vec2> places = places_in(ends);
    const Vec2 end = curve_.place(ends.back()).p;
    if (is_straight(places)) {
      path_.steps.push_back(line_to(end));
      return true;
    }
    if (const auto arc = elliptic_arc(places, kElliptic * tolerance_, kMinTurn)) {
      std::vector<PathStep> steps = arcs_to(arc->ellipse, arc->begin, arc->end);
      steps.back().to = end;
      path_.steps.insert(path_.steps.end(), steps.begin(), steps.end());
      return true;
    }
    return false;
  }

  // Both ends, and places in all smooth parts between.
  std::vector<Vec2> places_in(const std::vector<double>& ends) const {
    const int parts = std::max(4, 24 / static_cast<int>(ends.size() - 1));
    std::vector<Vec2> places;
    for (size_t k = 0; k + 1 < ends.size(); ++k)
      for (int i = 0; i < parts; ++i) places.push_back(curve_.place(ends[k] + (ends[k + 1] - ends[k]) * i / parts).p);
    places.push_back(curve_.place(geometry::next_down(ends.back())).p);
    return places;
  }

  bool is_straight(const std::vector<Vec2>& places) const {
    const Vec2 from = places.front(), chord = places.back() - from;
    const double length = glm::length(chord);
    if (!(length > 0)) return false;
    const Vec2 across(-chord.y / length, chord.x / length), along = chord / length;
    const double off_by = kStraight * tolerance_;
    double farthest = 0;
    for (const Vec2& place : places) {
      const Vec2 off = place - from;
      const double ahead = glm::dot(off, along);
      if (std::abs(glm::dot(off, across)) > off_by || ahead < farthest - off_by || ahead > length + off_by)
        return false;
      farthest = std::max(farthest, ahead);
    }
    return true;
  }

  // A smooth stretch.
  void add(const Interval& t, const ProjectedCurve::Place& begin, const ProjectedCurve::Place& end, int depth) {
    const double h = t.width(), middle = t.middle(), chord = glm::length(end.p - begin.p);
    const auto is_steep = [&](const Vec2& tangent) { return !(h * glm::length(tangent) <= kSteep * chord); };
    const bool steep_begin = is_steep(begin.tangent), steep_end = is_steep(end.tangent);
    const PathStep cubic = curve_to(begin.p + h / 3 * begin.tangent, end.p - h / 3 * end.tangent, end.p);
    const auto same = [](double s) { return s; };
    if (fits(cubic, begin.p, t, same)) return path_.steps.push_back(cubic);
    if (steep_begin != steep_end) {
      const Vec2 corner = steep_begin ? end.p - h * end.tangent : begin.p + h * begin.tangent;
      const PathStep parabola =
          curve_to(begin.p + 2.0 / 3 * (corner - begin.p), end.p + 2.0 / 3 * (corner - end.p), end.p);
      const auto square = [&](double s) { return steep_begin ? s * s : s * (2 - s); };
      if (fits(parabola, begin.p, t, square)) return path_.steps.push_back(parabola);
    }
    const bool is_steep_somewhere = steep_begin || steep_end;
    if (depth >= (is_steep_somewhere ? kMaxHalvingsOfSteep : kMaxHalvings) || !(t.lo < middle && middle < t.hi))
      return path_.steps.push_back(is_steep_somewhere ? line_to(end.p) : cubic);
    const ProjectedCurve::Place between = curve_.place(middle);
    add({t.lo, middle}, begin, between, depth + 1);
    add({middle, t.hi}, between, end, depth + 1);
  }

  // Whether the step at s is where the curve is at the share share(s) of t.
  template <class Share>
  bool fits(const PathStep& step, const Vec2& begin, const Interval& t, const Share& share) const {
    for (const double s : {0.5, 0.2, 0.8, 0.35, 0.65})
      if (!(glm::length(point_on(begin, step, s) - curve_.place(t.lo + share(s) * t.width()).p) <= tolerance_))
        return false;
    return true;
  }

  const ProjectedCurve& curve_;
  const std::vector<double>& breaks_;
  double tolerance_;
  Path& path_;
};

}  // namespace

Vec2 PictureEllipse::point(double angle) const { return center + std::cos(angle) * x + std::sin(angle) * y; }

std::vector<PathStep> arcs_to(const PictureEllipse& ellipse, double begin, double end) {
  // A little more than a quarter is one quarter with rounding.
  const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(end - begin) / (kPi / 2) - 1e-9)));
  std::vector<PathStep> steps;
  for (int k = 0; k < parts; ++k) {
    const double a = begin + (end - begin) * k / parts, b = begin + (end - begin) * (k + 1) / parts;
    steps.push_back({PathStep::Kind::arc, ellipse.point(b), {}, {}, ellipse, a, b});
  }
  return steps;
}

Vec2 point_on(const Vec2& begin, const PathStep& step, double s) {
  const double r = 1 - s;
  switch (step.kind) {
    case PathStep::Kind::line:
      return r * begin + s * step.to;
    case PathStep::Kind::curve:
      return r * r * r * begin + 3 * r * r * s * step.first + 3 * r * s * s * step.second + s * s * s * step.to;
    case PathStep::Kind::arc:
      return s == 1 ? step.to : step.ellipse.point(r * step.begin + s * step.end);
  }
  return step.to;
}

Path fitted_path(const ProjectedCurve& curve, const Interval& t, const std::vector<double>& breaks, double tolerance) {
  Path path;
  path.from = curve.place(t.lo).p;
  Fitting(curve, breaks, tolerance, path).run(t);
  path.closed = path.steps.size() > 1 && glm::length(path.end() - path.from) <= tolerance;
  return path;
}

bool is_point(const Path& path, double size) {
  Vec2 begin = path.from;
  for (const PathStep& step : path.steps) {
    for (const double share : {0.25, 0.5, 0.75, 1.0})
      if (glm::length(point_on(begin, step, share) - path.from) > size) return false;
    begin = step.to;
  }
  return true;
}

PathStep part_of(const Vec2& begin, const PathStep& step, double from, double to) {
  PathStep part = step;
  part.to = point_on(begin, step, to);
  if (step.kind == PathStep::Kind::curve) {
    // By its polar form (blossom): the handles at (from, from, to) and (from, to, to).
    const auto polar = [&](double a, double b, double c) {
      const auto mix = [](const Vec2& p, const Vec2& q, double t) { return (1 - t) * p + t * q; };
      const Vec2 ends[] = {mix(begin, step.first, a), mix(step.first, step.second, a), mix(step.second, step.to, a)};
      return mix(mix(ends[0], ends[1], b), mix(ends[1], ends[2], b), c);
    };
    part.first = polar(from, from, to), part.second = polar(from, to, to);
  }
  if (step.kind == PathStep::Kind::arc) {
    part.begin = (1 - from) * step.begin + from * step.end;
    part.end = (1 - to) * step.begin + to * step.end;
  }
  return part;
}

Path reversed(const Path& path) {
  Path result;
  result.closed = path.closed;
  result.from = path.end();
  for (size_t k = path.steps.size(); k-- > 0;) {
    PathStep step = path.steps[k];
    std::swap(step.first, step.second);
    std::swap(step.begin, step.end);
    step.to = k > 0 ? path.steps[k - 1].to : path.from;
    result.steps.push_back(step);
  }
  return result;
}

Path moved(Path path, const Vec2& shift, double scale) {
  const auto move = [&](Vec2& p) { p = shift + scale * p; };
  move(path.from);
  for (PathStep& step : path.steps) {
    move(step.to), move(step.first), move(step.second), move(step.ellipse.center);
    step.ellipse.x *= scale, step.ellipse.y *= scale;
  }
  return path;
}

// A cubic with an arc's ends and tangents is off by 2/27 r sin^6(a/4) / cos^2(a/4) of an arc of the angle a.
Path without_arcs(const Path& path, double tolerance) {
  Path result = path;
  result.steps.clear();
  for (const PathStep& step : path.steps) {
    if (step.kind != PathStep::Kind::arc) {
      result.steps.push_back(step);
      continue;
    }
    const double radius = std::max(glm::length(step.ellipse.x), glm::length(step.ellipse.y));
    int parts = 1;
    const auto part = [&] { return (step.end - step.begin) / parts; };
    while (2.0 / 27 * radius * std::pow(std::sin(part() / 4), 6) / std::pow(std::cos(part() / 4), 2) > tolerance)
      ++parts;
    const double handle = 4.0 / 3 * std::tan(part() / 4);
    const auto tangent = [&](double a) { return std::cos(a) * step.ellipse.y - std::sin(a) * step.ellipse.x; };
    for (int k = 0; k < parts; ++k) {
      const double a = step.begin + k * part(), b = step.begin + (k + 1) * part();
      const Vec2 to = k + 1 == parts ? step.to : step.ellipse.point(b);
      result.steps.push_back(curve_to(step.ellipse.point(a) + handle * tangent(a), to - handle * tangent(b), to));
    }
  }
  return result;
}

}  // namespace lekalo::render
