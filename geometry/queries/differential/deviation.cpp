#include "geometry/queries/differential/deviation.h"

#include <cmath>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

// How parameters of one range are taken to another.
struct LinearMap {
  Interval from, to;
  LinearMap(const Interval& from, const Interval& to) : from(from), to(to) {
    for (const Interval& range : {from, to})
      if (!(range.width() > 0 && range.width() < kInfinity))
        throw std::invalid_argument("its domain is not finite: there is no linear map between the parameters");
  }
  double slope() const { return from == to ? 1 : to.width() / from.width(); }
  double operator()(double x) const { return from == to ? x : x == from.hi ? to.hi : to.lo + (x - from.lo) * slope(); }
};

struct Worst {
  Deviation deviation;
  explicit Worst(std::string quantity) { deviation.quantity = std::move(quantity); }
  void include(const Vec3& first, const Vec3& second, double u, double v) {
    const double length = glm::length(first), difference = glm::length(second - first);
    deviation.scale = std::max(deviation.scale, length);
    const double counted = std::isfinite(difference) ? difference : kInfinity;
    if (counted <= deviation.largest) return;
    deviation.largest = counted;
    deviation.at = {u, v};
    deviation.first = first;
    deviation.second = second;
  }
};

constexpr const char* kOfCurve[] = {"point", "d1", "d2"};
constexpr const char* kOfSurface[] = {"point", "du", "dv", "duu", "duv", "dvv"};

Vec3 unit_or_zero(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : Vec3(0);
}

}  // namespace

std::vector<Deviation> deviations(std::span<const CurveJet> first, std::span<const CurveJet> second,
                                  std::span<const double> t, int order) {
  std::vector<Deviation> result;
  for (int k = 0; k <= order; ++k) {
    Worst worst(kOfCurve[k]);
    for (size_t i = 0; i < t.size(); ++i) worst.include(first[i].d[k], second[i].d[k], t[i], 0);
    result.push_back(worst.deviation);
  }
  return result;
}

std::vector<Deviation> deviations(std::span<const SurfaceJet> first, std::span<const SurfaceJet> second,
                                  std::span<const Vec2> uv, int order) {
  std::vector<Deviation> result;
  for (int k = 0; k < (order + 1) * (order + 2) / 2; ++k) {
    Worst worst(kOfSurface[k]);
    for (size_t i = 0; i < uv.size(); ++i) worst.include(first[i].values[k], second[i].values[k], uv[i].x, uv[i].y);
    result.push_back(worst.deviation);
  }
  return result;
}

std::vector<Deviation> deviations(const Curve& first, const Curve& second, std::span<const double> t, int order) {
  const LinearMap map(first.domain(), second.domain());
  std::vector<double> mapped;
  for (const double x : t) mapped.push_back(map(x));
  std::vector<CurveJet> ours(t.size()), theirs(t.size());
  first.evaluate_many(t, order, ours);
  second.evaluate_many(mapped, order, theirs);
  Worst tangent("tangent");
  for (size_t i = 0; i < t.size(); ++i) {
    double factor = 1;
    for (int k = 1; k <= order; ++k) theirs[i].d[k] *= factor *= map.slope();
    if (order >= 1) tangent.include(unit_or_zero(ours[i].d[1]), unit_or_zero(theirs[i].d[1]), t[i], 0);
  }
  std::vector<Deviation> result = deviations(ours, theirs, t, order);
  if (order >= 1) result.push_back(tangent.deviation);
  return result;
}

std::vector<Deviation> deviations(const Surface& first, const Surface& second, std::span<const Vec2> uv, int order) {
  const LinearMap map_u(first.domain().u, second.domain().u), map_v(first.domain().v, second.domain().v);
  std::vector<Vec2> mapped;
  for (const Vec2& place : uv) mapped.emplace_back(map_u(place.x), map_v(place.y));
  std::vector<SurfaceJet> ours(uv.size()), theirs(uv.size());
  first.evaluate_many(uv, order, ours);
  second.evaluate_many(mapped, order, theirs);
  Worst normal("normal");
  for (size_t i = 0; i < uv.size(); ++i) {
    if (order >= 1)
      normal.include(first.normal(uv[i].x, uv[i].y, ours[i]), second.normal(mapped[i].x, mapped[i].y, theirs[i]),
                     uv[i].x, uv[i].y);
    for (int n = 1; n <= order; ++n)
      for (int j = 0; j <= n; ++j) theirs[i].d(n - j, j) *= std::pow(map_u.slope(), n - j) * std::pow(map_v.slope(), j);
  }
  std::vector<Deviation> result = deviations(ours, theirs, uv, order);
  if (order >= 1) result.push_back(normal.deviation);
  return result;
}

}  // namespace lekalo::geometry
