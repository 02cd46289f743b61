#include "geometry/bodies/blends/crossing.h"

#include <algorithm>
#include <cmath>

#include "geometry/bodies/blends/blend_edges.h"
#include "geometry/curves/splines/polynomial_approximation.h"

namespace lekalo::geometry {

namespace {

constexpr double kAgree = 1e-13;

// A section of the band, where the face is across it.
std::optional<Crossing> straight_crossing(const BlendBand& band, const Surface& face, const SurfacePtr& surface,
                                          double s, double from, double to, const std::function<Vec2(double)>& place,
                                          double size) {
  for (const double share : {0.25, 0.5, 0.75}) {
    const double z = from + share * (to - from);
    const Vec2 at = place(z);
    if (glm::length(face.point(at.x, at.y) - band.at(s, z).point) > kAgree * size) return std::nullopt;
  }
  const LineOnSurface line = line_between(band.surface(), band.place(s, from), band.place(s, to));
  const Curve2Ptr image = image_on(surface, line.curve, place(0.5 * (from + to)));
  if (!image) return std::nullopt;
  return Crossing{line.curve, line.image, image};
}

constexpr int kNodes = 32;

// Solutions at even steps, from the end where the surfaces cross to the one where they may touch.
class Way {
 public:
  // `along`: the lines are sections, s = const, and what is sought is z.
  Way(const BlendBand& band, const SurfacePtr& face, const std::array<BandOnCurve, 2>& ends,
      const std::array<Vec2, 2>& places, bool along, double size, int edge)
      : band_(band),
        face_(*face),
        along_(along),
        from_(along ? ends[0].s : ends[0].z),
        to_(along ? ends[1].s : ends[1].z),
        nodes_(kNodes + 1) {
    nodes_.front() = {along ? ends[0].z : ends[0].s, places[0]};
    nodes_.back() = {along ? ends[1].z : ends[1].s, places[1]};
    march(sine(0) < sine(kNodes) ? -1 : 1, size, edge);
  }

  // Of the line: z, or s.
  double line(double x) const { return x == 0 ? from_ : x == 1 ? to_ : from_ + x * (to_ - from_); }
  BandOnSurface at(double x) const {
    if (x <= 0) return nodes_.front();
    if (x >= 1) return nodes_.back();
    const int k = std::min(static_cast<int>(x * kNodes), kNodes - 1);
    const double w = x * kNodes - k;
    const BandOnSurface near{nodes_[k].s + w * (nodes_[k + 1].s - nodes_[k].s),
                             glm::mix(nodes_[k].place, nodes_[k + 1].place, w)};
    const auto found = solved(line(x), near);
    return found ? *found : near;
  }
  Vec3 point(double x) const {
    const Vec2 at = place(x);
    return band_.at(at.x, at.y).point;
  }
  Vec2 on_band(double x) const {
    const Vec2 at = place(x);
    return band_.place(at.x, at.y);
  }

 private:
  // s and z.
  Vec2 place(double x) const {
    const double sought = at(x).s;
    return along_ ? Vec2(line(x), sought) : Vec2(sought, line(x));
  }
  std::optional<BandOnSurface> solved(double line, const BandOnSurface& near) const {
    return along_ ? section_on_surface(band_, line, face_, near) : line_on_surface(band_, line, face_, near);
  }
  // Between the normals of both surfaces.
  double sine(int k) const {
    const BandOnSurface& node = nodes_[k];
    const double line = k == 0 ? from_ : to_;
    const Vec3 normal = along_ ? band_.outward(line, node.s) : band_.outward(node.s, line);
    return glm::length(glm::cross(normal, face_.normal(node.place.x, node.place.y)));
  }

  void march(int step, double size, int edge) {
    const int first = step > 0 ? 0 : kNodes, last = kNodes - first;
    double longest = 0;
    for (int k = first + step; k != last; k += step) {
      const BandOnSurface& before = nodes_[k - step];
      BandOnSurface near = before;
      if (k != first + step) {
        const BandOnSurface& earlier = nodes_[k - 2 * step];
        near.s += before.s - earlier.s, near.place += before.place - earlier.place;
      }
      const auto found = solved(line(static_cast<double>(k) / kNodes), near);
      if (!found) throw BlendError(edge, "the blend does not meet the face at its end all across");
      nodes_[k] = *found;
      longest = std::max(longest, glm::length(face_point(k) - face_point(k - step)));
    }
    if (glm::length(face_point(last) - face_point(last - step)) > 4 * longest + 1e-9 * size)
      throw BlendError(edge, "the blend leaves the face at its end");
  }
  Vec3 face_point(int k) const { return face_.point(nodes_[k].place.x, nodes_[k].place.y); }

  const BlendBand& band_;
  const Surface& face_;
  bool along_;
  double from_, to_;
  std::vector<BandOnSurface> nodes_;
};

Crossing fitted(const Way& way, const BlendBand& band, const std::array<BandOnCurve, 2>& ends,
                const std::array<Vec2, 2>& places, double size, int edge) {
  const std::vector<Interval> whole{{0, 1}};
  // Beside places where the surfaces touch points are known less well.
  const auto fit = [&](auto&& value, double scale) -> CurvePtr {
    for (const double share : {kAgree, 1e-12, 1e-11, 1e-10})
      if (auto curve = polynomial_approximation(value, whole, share * scale)) return curve;
    return nullptr;
  };
  const Vec2 here = band.place(ends[0].s, ends[0].z), there = band.place(ends[1].s, ends[1].z);
  const auto curve = fit([&](double x) { return way.point(x); }, size);
  const auto on_band =
      fit([&](double x) { return Vec3(way.on_band(x), 0); }, (glm::length(here) + glm::length(there - here)));
  const auto on_face = fit([&](double x) { return Vec3(way.at(x).place, 0); },
                           (glm::length(places[0]) + glm::length(places[1] - places[0])));
  if (!curve || !on_band || !on_face) throw BlendError(edge, "the blend does not cross the face at its end smoothly");
  return {curve, on_band, on_face};
}

}  // namespace

Crossing crossing(const BlendBand& band, const SurfacePtr& face, const std::array<BandOnCurve, 2>& ends,
                  const std::array<Vec2, 2>& places, double size, int edge) {
  const Way way(band, face, ends, places, false, size, edge);
  if (std::abs(ends[0].s - ends[1].s) <= 1e-12 * band.range().width()) {
    const double from = ends[0].z, to = ends[1].z;
    const auto place = [&](double z) { return way.at((z - from) / (to - from)).place; };
    if (auto straight = straight_crossing(band, *face, face, ends[0].s, from, to, place, size)) return *straight;
  }
  return fitted(way, band, ends, places, size, edge);
}

Crossing crossing_along(const BlendBand& band, const SurfacePtr& face, const std::array<BandOnCurve, 2>& ends,
                        const std::array<Vec2, 2>& places, double size, int edge) {
  return fitted(Way(band, face, ends, places, true, size, edge), band, ends, places, size, edge);
}

}  // namespace lekalo::geometry
