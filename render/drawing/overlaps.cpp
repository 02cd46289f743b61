#include "render/drawing/overlaps.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

namespace {

constexpr double kSame = 1e-3;      // millimetres between lines that are one
constexpr double kShortest = 1e-2;  // of what is left
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

// All that a chain of places comes near to, perhaps more than once.
template <class Visit>
void each_bin(const std::vector<Vec2>& places, const Visit& visit) {
  for (size_t k = 0; k + 1 < places.size(); ++k) {
    const Vec2 way = places[k + 1] - places[k];
    const int parts = std::max(1, static_cast<int>(std::ceil(glm::length(way) / kBin)));
    for (int i = 0; i < parts; ++i) {
      const Vec2 a = places[k] + way * (static_cast<double>(i) / parts),
                 b = places[k] + way * (static_cast<double>(i + 1) / parts);
      const Vec2 lo = glm::min(a, b) - kSame, hi = glm::max(a, b) + kSame;
      for (double x = lo.x; x < hi.x + kBin; x += kBin)
        for (double y = lo.y; y < hi.y + kBin; y += kBin) visit(bin_at(std::min(x, hi.x), std::min(y, hi.y)));
    }
  }
}

}  // namespace

std::vector<Vec2> Overlaps::places_on(const Path& path) {
  std::vector<Vec2> places{path.from};
  for (const PathStep& step : path.steps) {
    const Vec2 begin = places.back();
    const int parts = step.kind != PathStep::Kind::line ? kPlaces : path.steps.size() == 1 ? 1 : kPlacesOnSide;
    for (int k = 1; k <= parts; ++k) places.push_back(point_on(begin, step, static_cast<double>(k) / parts));
  }
  return places;
}

const std::vector<int>& Overlaps::near(const Vec2& place) const {
  static const std::vector<int> none;
  const auto found = bins_.find(bin_at(place.x, place.y));
  return found == bins_.end() ? none : found->second;
}

std::vector<int> Overlaps::near(const std::vector<Vec2>& places) const {
  std::vector<int> numbers;
  each_bin(places, [&](int64_t bin) {
    if (const auto found = bins_.find(bin); found != bins_.end())
      numbers.insert(numbers.end(), found->second.begin(), found->second.end());
  });
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

bool Overlaps::is_covered(const Vec2& place) const {
  for (const int number : near(place)) {
    const Drawn& one = drawn_[number];
    if (place.x < one.lo.x - kSame || place.x > one.hi.x + kSame || place.y < one.lo.y - kSame ||
        place.y > one.hi.y + kSame)
      continue;
    for (size_t k = 0; k + 1 < one.places.size(); ++k)
      if (distance_from(place, one.places[k], one.places[k + 1]) < kSame) return true;
  }
  return false;
}

std::vector<Path> Overlaps::left_of(const Path& path) {
  const bool straight = path.steps.size() == 1 && path.steps[0].kind == PathStep::Kind::line;
  Drawn own{path.from, path.from, straight, places_on(path), path.from, path.from};
  for (const Vec2& place : own.places) own.lo = glm::min(own.lo, place), own.hi = glm::max(own.hi, place);
  std::vector<Path> left;
  if (!straight) {
    // In the middle of its places too, where no other line's chord can be its own by chance.
    bool covered = true;
    for (size_t k = 0; k + 1 < own.places.size() && covered; ++k)
      covered = is_covered(own.places[k]) && is_covered(0.5 * (own.places[k] + own.places[k + 1]));
    if (!covered) left.push_back(path);
  } else {
    own.to = path.steps[0].to;
    const Vec2 way = own.to - own.from;
    const double length = glm::length(way);
    if (!(length > 0)) return {path};
    const Vec2 along = way / length;
    std::vector<std::pair<double, double>> covered;
    for (const int number : near(own.places)) {
      const Drawn& one = drawn_[number];
      if (!one.straight || own.lo.x > one.hi.x + kSame || one.lo.x > own.hi.x + kSame || own.lo.y > one.hi.y + kSame ||
          one.lo.y > own.hi.y + kSame)
        continue;
      const auto off = [&](const Vec2& p) {
        return std::abs((p.x - own.from.x) * along.y - (p.y - own.from.y) * along.x);
      };
      if (off(one.from) > kSame || off(one.to) > kSame) continue;
      const double a = glm::dot(one.from - own.from, along), b = glm::dot(one.to - own.from, along);
      covered.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(covered.begin(), covered.end());
    double at = 0;
    const auto keep = [&](double from, double to) {
      if (to - from < (covered.empty() ? 0 : kShortest)) return;
      Path part;
      part.from = own.from + from * along;
      part.steps.push_back(line_to(own.from + to * along));
      left.push_back(std::move(part));
    };
    for (const auto& [from, to] : covered) {
      if (from > at) keep(at, std::min(from, length));
      at = std::max(at, to);
    }
    if (at < length) keep(at, length);
  }
  if (!left.empty()) {
    const int number = static_cast<int>(drawn_.size());
    each_bin(own.places, [&](int64_t bin) {
      std::vector<int>& here = bins_[bin];
      if (here.empty() || here.back() != number) here.push_back(number);
    });
    drawn_.push_back(std::move(own));
  }
  return left;
}

}  // namespace lekalo::render
