#include "render/drawing/paths/overlaps.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lekalo::render {

namespace {

constexpr double kSame = 1e-3;      // millimetres between lines that are one
constexpr double kStraight = 1e-4;  // how far a straight line is from its chord
constexpr double kShortest = 1e-2;  // of what is left
constexpr double kCovering = 0.5;   // of what covers a part of a curve: less is a crossing or a touch
constexpr int kPlaces = 32;         // on each step of a curve
constexpr int kPlacesOnSide = 7;    // of a path with corners: others may touch it where a construction says so
constexpr double kBin = 3;          // millimetres

double distance_from(const Vec2& place, const Vec2& a, const Vec2& b) {
  const Vec2 way = b - a;
  const double square = glm::dot(way, way);
  const double x = square > 0 ? std::clamp(glm::dot(place - a, way) / square, 0.0, 1.0) : 0;
  return glm::length(place - (a + x * way));
}

int64_t bin_at(double x, double y) {
  const auto number = [](double at) { return static_cast<int64_t>(std::floor(at / kBin)); };
  return number(x) * (int64_t{1} << 32) + number(y);
}

// All that a chain of places comes as near to, perhaps more than once.
template <class Visit>
void each_bin(const std::vector<Vec2>& places, double near, const Visit& visit) {
  for (size_t k = 0; k + 1 < places.size(); ++k) {
    const Vec2 way = places[k + 1] - places[k];
    const int parts = std::max(1, static_cast<int>(std::ceil(glm::length(way) / kBin)));
    for (int i = 0; i < parts; ++i) {
      const Vec2 a = places[k] + way * (static_cast<double>(i) / parts),
                 b = places[k] + way * (static_cast<double>(i + 1) / parts);
      const Vec2 lo = glm::min(a, b) - near, hi = glm::max(a, b) + near;
      for (double x = lo.x; x < hi.x + kBin; x += kBin)
        for (double y = lo.y; y < hi.y + kBin; y += kBin) visit(bin_at(std::min(x, hi.x), std::min(y, hi.y)));
    }
  }
}

// The point of a path that is farthest in a direction.
Vec2 farthest_along(const Path& path, const Vec2& way) {
  Vec2 best = path.from, begin = path.from;
  for (const PathStep& step : path.steps) {
    const auto height = [&](double s) { return glm::dot(point_on(begin, step, s), way); };
    int highest = 0;
    for (int k = 1; k <= kPlaces; ++k)
      if (height(static_cast<double>(k) / kPlaces) > height(static_cast<double>(highest) / kPlaces)) highest = k;
    double lo = std::max(highest - 1.0, 0.0) / kPlaces, hi = std::min(highest + 1.0, 1.0 * kPlaces) / kPlaces;
    constexpr int kThirds = 40;
    for (int k = 0; k < kThirds; ++k) {
      const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
      (height(a) < height(b) ? lo : hi) = height(a) < height(b) ? a : b;
    }
    for (const double s : {static_cast<double>(highest) / kPlaces, 0.5 * (lo + hi)})
      if (height(s) > glm::dot(best, way)) best = point_on(begin, step, s);
    begin = step.to;
  }
  return best;
}

// A line that runs to and fro, as a circle does that is seen edge-on, is straight from one end to the other.
std::optional<Path> straightened(const Path& path, const std::vector<Vec2>& places) {
  const auto farthest = [&](const Vec2& from) {
    return *std::max_element(places.begin(), places.end(), [&](const Vec2& a, const Vec2& b) {
      return glm::length(a - from) < glm::length(b - from);
    });
  };
  Vec2 to = farthest(path.from);
  Vec2 from = farthest(to);
  if (!(glm::length(to - from) > kSame)) return std::nullopt;
  for (const Vec2& place : places)
    if (distance_from(place, from, to) > kStraight) return std::nullopt;
  const Vec2 way = (to - from) / glm::length(to - from);
  to = farthest_along(path, way), from = farthest_along(path, -way);
  // As the path ran, if it was straight.
  if (glm::length(to - path.from) < glm::length(from - path.from)) std::swap(from, to);
  Path line;
  line.from = glm::length(from - path.from) < kStraight ? path.from : from;
  line.steps.push_back(line_to(glm::length(to - path.end()) < kStraight ? path.end() : to));
  return line;
}

// The places of a curve's chain count from 0; between them, shares of their chords.
struct Place {
  size_t chord;
  double share;
};
Place place_at(double x, size_t chords) {
  const size_t chord = std::min(static_cast<size_t>(x), chords - 1);
  return {chord, x - static_cast<double>(chord)};
}

}  // namespace

void Overlaps::add_places(Drawn& drawn) {
  const Path& path = drawn.path;
  drawn.places = {path.from};
  for (size_t number = 0; number < path.steps.size(); ++number) {
    const PathStep& step = path.steps[number];
    const Vec2 begin = drawn.places.back();
    const int parts = step.kind != PathStep::Kind::line ? kPlaces : path.steps.size() == 1 ? 1 : kPlacesOnSide;
    for (int k = 0; k < parts; ++k) {
      const double from = static_cast<double>(k) / parts, to = static_cast<double>(k + 1) / parts;
      const Vec2 before = drawn.places.back();
      drawn.chords.push_back({begin, static_cast<int>(number), from, to});
      drawn.places.push_back(point_on(begin, step, to));
      drawn.bow = std::max(
          drawn.bow, glm::length(point_on(begin, step, 0.5 * (from + to)) - 0.5 * (before + drawn.places.back())));
    }
  }
}

const std::vector<int>& Overlaps::near(const Vec2& place) const {
  static const std::vector<int> none;
  const auto found = bins_.find(bin_at(place.x, place.y));
  return found == bins_.end() ? none : found->second;
}

std::vector<int> Overlaps::near(const std::vector<Vec2>& places) const {
  std::vector<int> numbers;
  std::vector<bool> known(drawn_.size());
  each_bin(places, kSame, [&](int64_t bin) {
    if (const auto found = bins_.find(bin); found != bins_.end())
      for (const int number : found->second)
        if (!known[number]) known[number] = true, numbers.push_back(number);
  });
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

bool Overlaps::covers(const Pen& above, const Pen& below) {
  if (below.hidden && !above.hidden) return true;
  return (above.object < 0) == (below.object < 0) && above.half_width >= below.half_width &&
         above.opacity >= below.opacity && (above.solid || !below.solid);
}

bool Overlaps::is_covered(const Vec2& place, const Pen& pen, bool by_likes) const {
  for (const int number : near(place)) {
    const Drawn& one = drawn_[number];
    if (!covers(one.pen, pen) || (by_likes && one.pen != pen)) continue;
    const double near = kSame + one.bow;
    if (place.x < one.lo.x - near || place.x > one.hi.x + near || place.y < one.lo.y - near ||
        place.y > one.hi.y + near)
      continue;
    for (size_t k = 0; k < one.chords.size(); ++k)
      if (comes_near(one, k, place)) return true;
  }
  return false;
}

// A chord tells as far as the curve may be from it; between, the curve's own parts.
bool Overlaps::comes_near(const Drawn& drawn, size_t number, const Vec2& place) {
  const double off = distance_from(place, drawn.places[number], drawn.places[number + 1]);
  if (off < kSame) return true;
  if (off > kSame + 2 * drawn.bow) return false;
  constexpr int kParts = 8;
  const Chord& chord = drawn.chords[number];
  const PathStep& step = drawn.path.steps[chord.step];
  Vec2 before = drawn.places[number];
  for (int k = 1; k <= kParts; ++k) {
    const Vec2 next = point_on(chord.begin, step, chord.from + (chord.to - chord.from) * k / kParts);
    if (distance_from(place, before, next) < kSame) return true;
    before = next;
  }
  return false;
}

Vec2 Overlaps::point_at(const Drawn& own, double x) {
  const Place at = place_at(x, own.chords.size());
  const Chord& chord = own.chords[at.chord];
  return point_on(chord.begin, own.path.steps[chord.step], chord.from + (chord.to - chord.from) * at.share);
}

// Where steps of what may cover a part of the curve end on it, but for its own ends, in order.
std::vector<double> Overlaps::ends_on(const Drawn& own) const {
  std::vector<double> ends;
  const double near = kSame + own.bow, last = static_cast<double>(own.chords.size());
  const auto add = [&](const Vec2& end) {
    if (end.x < own.lo.x - near || end.x > own.hi.x + near || end.y < own.lo.y - near || end.y > own.hi.y + near)
      return;
    for (size_t k = 0; k < own.chords.size(); ++k) {
      if (!comes_near(own, k, end)) continue;
      // The place of the chord that is nearest to it, by its direction there.
      constexpr int kSteps = 4;
      double x = static_cast<double>(k) + 0.5;
      for (int step = 0; step < kSteps; ++step) {
        const double before = std::max(x - 0.01, 0.0), behind = std::min(x + 0.01, last);
        const Vec2 way = point_at(own, behind) - point_at(own, before);
        const double square = glm::dot(way, way);
        if (square > 0) x += (behind - before) * glm::dot(end - point_at(own, x), way) / square;
        x = std::clamp(x, static_cast<double>(k), static_cast<double>(k) + 1);
      }
      if (x > 0 && x < last) ends.push_back(x);
    }
  };
  for (const int number : this->near(own.places)) {
    const Drawn& one = drawn_[number];
    if (one.pen != own.pen) continue;
    add(one.path.from);
    for (const PathStep& step : one.path.steps) add(step.to);
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

// Whether a stretch of the curve is.
bool Overlaps::is_covered(const Drawn& own, double from, double to, bool by_likes) const {
  const auto is_covered_at = [&](double x) { return is_covered(point_at(own, x), own.pen, by_likes); };
  for (const double share : {0.5, 0.1, 0.9})
    if (!is_covered_at(from + share * (to - from))) return false;
  // In the middle of its chords too, where no other line's chord can be its own by chance.
  for (double x = std::ceil(2 * from) / 2; x < to; x += 0.5)
    if (!is_covered_at(x)) return false;
  return true;
}

std::vector<Path> Overlaps::left_of_curve(const Drawn& own) const {
  const double last = static_cast<double>(own.chords.size());
  if (is_covered(own, 0, last, false)) return {};
  std::vector<double> cuts{0};
  const auto is_far = [&](double x, double other) {
    return glm::length(point_at(own, x) - point_at(own, other)) > kCovering;
  };
  for (const double end : ends_on(own))
    if (is_far(end, cuts.back()) && is_far(end, last)) cuts.push_back(end);
  cuts.push_back(last);
  // Stretches that are not covered.
  std::vector<std::pair<double, double>> free;
  for (size_t k = 0; k + 1 < cuts.size(); ++k) {
    if (cuts.size() > 2 && is_covered(own, cuts[k], cuts[k + 1], true)) continue;
    if (!free.empty() && free.back().second == cuts[k])
      free.back().second = cuts[k + 1];
    else
      free.emplace_back(cuts[k], cuts[k + 1]);
  }
  if (free.size() == 1 && free[0] == std::pair(0.0, last)) return {own.path};
  std::vector<Path> left;
  for (const auto& [from, to] : free) {
    const Place begin = place_at(from, own.chords.size()), end = place_at(to, own.chords.size());
    const auto share_of_step = [&](const Place& place) {
      const Chord& chord = own.chords[place.chord];
      return chord.from + (chord.to - chord.from) * place.share;
    };
    Path part;
    for (int k = own.chords[begin.chord].step; k <= own.chords[end.chord].step; ++k) {
      const PathStep& step = own.path.steps[k];
      const Vec2 start = k > 0 ? own.path.steps[k - 1].to : own.path.from;
      const double lo = k == own.chords[begin.chord].step ? share_of_step(begin) : 0,
                   hi = k == own.chords[end.chord].step ? share_of_step(end) : 1;
      if (part.steps.empty()) part.from = point_on(start, step, lo);
      if (lo < hi) part.steps.push_back(lo > 0 || hi < 1 ? part_of(start, step, lo, hi) : step);
    }
    if (!part.steps.empty() && !is_point(part, kShortest)) left.push_back(std::move(part));
  }
  // What goes on over the place where a closed one begins is one.
  if (own.path.closed && left.size() > 1 && left.front().from == own.path.from && left.back().end() == own.path.end()) {
    left.back().steps.insert(left.back().steps.end(), left.front().steps.begin(), left.front().steps.end());
    left.erase(left.begin());
  }
  return left;
}

std::vector<Path> Overlaps::left_of_line(const Drawn& own) const {
  const Vec2 way = own.to - own.from;
  const double length = glm::length(way);
  const Vec2 along = way / length;
  std::vector<std::pair<double, double>> covered;
  for (const int number : near(own.places)) {
    const Drawn& one = drawn_[number];
    if (!one.straight || !covers(one.pen, own.pen) || own.lo.x > one.hi.x + kSame || one.lo.x > own.hi.x + kSame ||
        own.lo.y > one.hi.y + kSame || one.lo.y > own.hi.y + kSame)
      continue;
    const auto off = [&](const Vec2& p) {
      return std::abs((p.x - own.from.x) * along.y - (p.y - own.from.y) * along.x);
    };
    if (off(one.from) > kSame || off(one.to) > kSame) continue;
    const double a = glm::dot(one.from - own.from, along), b = glm::dot(one.to - own.from, along);
    covered.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(covered.begin(), covered.end());
  std::vector<Path> left;
  double at = 0;
  const auto keep = [&](double from, double to) {
    if (to - from < (covered.empty() ? 0 : kShortest)) return;
    Path part;
    part.from = own.from + from * along;
    part.steps.push_back(line_to(to == length ? own.to : own.from + to * along));
    left.push_back(std::move(part));
  };
  for (const auto& [from, to] : covered) {
    if (from > at) keep(at, std::min(from, length));
    at = std::max(at, to);
  }
  if (at < length) keep(at, length);
  return left;
}

std::vector<Path> Overlaps::left_of(const Path& given, const Pen& pen) {
  Drawn own;
  own.path = given;
  add_places(own);
  if (auto line = straightened(given, own.places)) {
    own = Drawn();
    own.path = std::move(*line);
    add_places(own);
  }
  own.pen = pen;
  const Path& path = own.path;
  own.straight = path.steps.size() == 1 && path.steps[0].kind == PathStep::Kind::line;
  own.lo = own.hi = own.from = own.to = path.from;
  if (own.straight) own.to = path.steps[0].to;
  for (const Vec2& place : own.places) own.lo = glm::min(own.lo, place), own.hi = glm::max(own.hi, place);
  if (own.straight && own.from == own.to) return {path};
  std::vector<Path> left = own.straight ? left_of_line(own) : left_of_curve(own);
  if (!left.empty()) {
    const int number = static_cast<int>(drawn_.size());
    each_bin(own.places, kSame + own.bow, [&](int64_t bin) {
      std::vector<int>& here = bins_[bin];
      if (here.empty() || here.back() != number) here.push_back(number);
    });
    drawn_.push_back(std::move(own));
  }
  return left;
}

}  // namespace lekalo::render
