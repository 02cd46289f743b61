#include "geometry/machining/pocket_trapezoids.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace lekalo::geometry {

namespace {

// Of the size: corners at such different x stand one above the other.
constexpr double kUpright = 1e-9;

struct Slope {
  Vec2 a, b;  // a.x < b.x
  double at(double x) const { return a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)); }
};

// Different abscissas of the corners, increasing.
std::vector<double> abscissas(const PocketRegion& region, double same) {
  std::vector<double> all, x;
  for (const Polygon2& rim : region.rims)
    for (const Vec2& corner : rim) all.push_back(corner.x);
  std::sort(all.begin(), all.end());
  for (const double one : all)
    if (x.empty() || one - x.back() > same) x.push_back(one);
  return x;
}

std::vector<Slope> slopes_of(const PocketRegion& region) {
  std::vector<Slope> slopes;
  for (const Polygon2& rim : region.rims)
    for (size_t k = 0; k < rim.size(); ++k) {
      const Vec2 &a = rim[k], &b = rim[(k + 1) % rim.size()];
      slopes.push_back(a.x < b.x ? Slope{a, b} : Slope{b, a});
    }
  return slopes;
}

// What is being swept between two sides, and where it began.
struct Open {
  size_t lower, upper;
  double since;
};

Trapezoid closed(const Open& open, const std::vector<Slope>& slopes, double until) {
  Trapezoid result;
  result.x = {open.since, until};
  for (const int end : {0, 1}) {
    const double x = end == 0 ? open.since : until;
    result.lower[end] = slopes[open.lower].at(x);
    result.upper[end] = std::max(slopes[open.upper].at(x), result.lower[end]);
  }
  return result;
}

// The sides over a strip in pairs, from below: between the sides of each pair lies the region.
std::vector<std::pair<size_t, size_t>> pairs_over(const std::vector<Slope>& slopes, double from, double to) {
  const double middle = 0.5 * (from + to);
  std::vector<std::pair<double, size_t>> over;
  for (size_t k = 0; k < slopes.size(); ++k)
    if (slopes[k].a.x < middle && slopes[k].b.x > middle) over.push_back({slopes[k].at(middle), k});
  std::sort(over.begin(), over.end());
  std::vector<std::pair<size_t, size_t>> pairs;
  for (size_t k = 0; k + 1 < over.size(); k += 2) pairs.push_back({over[k].second, over[k + 1].second});
  return pairs;
}

std::vector<TrapezoidContact> contacts_of(const std::vector<Trapezoid>& all, double same) {
  std::vector<TrapezoidContact> contacts;
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = 0; j < all.size(); ++j) {
      if (std::abs(all[i].x.hi - all[j].x.lo) > same) continue;
      const double lo = std::max(all[i].lower[1], all[j].lower[0]), hi = std::min(all[i].upper[1], all[j].upper[0]);
      if (hi - lo > same) contacts.push_back({static_cast<int>(i), static_cast<int>(j), all[i].x.hi, {lo, hi}});
    }
  return contacts;
}

}  // namespace

double Trapezoid::lower_at(double at) const { return std::lerp(lower[0], lower[1], (at - x.lo) / x.width()); }
double Trapezoid::upper_at(double at) const { return std::lerp(upper[0], upper[1], (at - x.lo) / x.width()); }
Vec2 Trapezoid::center() const { return {x.middle(), 0.25 * (lower[0] + lower[1] + upper[0] + upper[1])}; }
double Trapezoid::area() const { return 0.5 * x.width() * (upper[0] - lower[0] + upper[1] - lower[1]); }

TrapezoidSplit trapezoid_split(const PocketRegion& region) {
  Box3 box;
  for (const Polygon2& rim : region.rims)
    for (const Vec2& corner : rim) box.include(Vec3(corner, 0));
  const double same = kUpright * box.diameter();
  const std::vector<double> x = abscissas(region, same);
  const std::vector<Slope> slopes = slopes_of(region);
  TrapezoidSplit split;
  std::vector<Open> open;
  for (size_t k = 0; k + 1 < x.size(); ++k) {
    const auto pairs = pairs_over(slopes, x[k], x[k + 1]);
    std::vector<Open> next;
    // A pair of sides that goes on has met no corner at its left.
    for (const auto& [lower, upper] : pairs) {
      const auto same_pair = [&, l = lower, u = upper](const Open& one) { return one.lower == l && one.upper == u; };
      const auto before = std::find_if(open.begin(), open.end(), same_pair);
      next.push_back(before == open.end() ? Open{lower, upper, x[k]} : *before);
      if (before != open.end()) open.erase(before);
    }
    for (const Open& ended : open) split.trapezoids.push_back(closed(ended, slopes, x[k]));
    open = std::move(next);
  }
  for (const Open& ended : open) split.trapezoids.push_back(closed(ended, slopes, x.back()));
  std::sort(split.trapezoids.begin(), split.trapezoids.end(), [](const Trapezoid& a, const Trapezoid& b) {
    return std::pair(a.center().x, a.center().y) < std::pair(b.center().x, b.center().y);
  });
  split.contacts = contacts_of(split.trapezoids, same);
  return split;
}

}  // namespace lekalo::geometry
