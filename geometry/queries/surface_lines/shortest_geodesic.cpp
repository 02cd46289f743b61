// The shortest geodesic between two points, by shooting.
//
// Geodesics that go out from the first point in all directions, each as long as a curve that is known to join the two
// points, make a net of cells (direction, length) on the surface. Every cell whose image in the parameter plane
// contains the second point, or comes nearest to it, is a beginning for Newton's iteration: the miss at the end, seen
// along the geodesic and across it, is a change of its length and J times one of its direction, J being Jacobi's field.
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/surface_lines/geodesic_law.h"

namespace lekalo::geometry {

namespace {

constexpr int kFirstDirections = 48;
constexpr int kMaxDirections = 768;
constexpr int kPlaces = 48;       // along each
constexpr double kSpread = 0.08;  // neighbours are no farther from each other, of the length
// A shot that misses by no more has reached the point; the other is for ways next to a pole, where parameters are bad
// coordinates and steps do not come nearer. The miss is part of the error then.
constexpr double kReached = 1e-13, kNearlyReached = 1e-7;
constexpr int kMaxShots = 30;

class Shooting {
 public:
  Shooting(const Surface& surface, const Vec2& from, const Vec2& to)
      : surface_(surface), from_(from), to_(to), target_(surface.point(to.x, to.y)), periods_(closed_periods(surface)) {
    find_images();
    reach_ = straight_length();
    options_.size = std::min(line_size(surface, reach_), reach_);
  }

  SurfaceLine run() {
    draw_net();
    std::vector<Start> starts = find_starts();
    std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.length < b.length; });
    std::optional<Shot> best;
    for (const Start& start : starts) {
      if (best && start.length > 1.1 * best->length) break;
      const auto shot = solve(start);
      if (shot && (!best || shot->length < best->length)) best = shot;
    }
    if (!best)
      throw FieldError("to", "no geodesic joins the two points in the surface's domain",
                       "the shortest way runs along its border: widen the domain");
    FlowOptions other = options_;
    other.longest_step *= 0.1;
    other.tolerance *= 0.1;
    other.length = best->length;
    const auto again = GeodesicFlow(surface_, law_, other).run(GeodesicLaw::start(surface_, from_, best->angle));
    SurfaceLine line = finished(surface_, std::move(best->flow.parts), again.parts);
    line.error = std::max({line.error, best->miss, best->flow.beside});
    return line;
  }

 private:
  struct Ray {
    double angle = 0, length = 0;
    std::vector<Vec2> places;  // kPlaces + 1, evenly along it; empty where it leaves the domain at once
  };
  struct Start {
    double angle, length;
  };
  struct Shot {
    double angle, length, miss;
    GeodesicFlow::Result flow;
  };

  // The second point in the unwrapped parameter plane, over one period each way and more.
  void find_images() {
    const int turns_u = periods_.u > 0 ? 2 : 0, turns_v = periods_.v > 0 ? 2 : 0;
    for (int i = -turns_u; i <= turns_u; ++i)
      for (int j = -turns_v; j <= turns_v; ++j) images_.push_back(to_ + Vec2(i * periods_.u, j * periods_.v));
  }

  // The length of the shortest straight line in the parameter plane.
  double straight_length() const {
    double shortest = kInfinity;
    const SurfacePtr shared(SurfacePtr(), &surface_);
    for (const Vec2& image : images_) {
      const auto line = std::make_shared<Segment>(Vec3(from_, 0), Vec3(image, 0));
      shortest = std::min(shortest, arc_length(SurfaceCurve(shared, line), 0, 1).value);
    }
    return shortest;
  }

  Ray ray(double angle) const {
    FlowOptions coarse = options_;
    coarse.tolerance = 1e-7;
    coarse.length = reach_ * (1 + 1e-6);
    const auto flow = GeodesicFlow(surface_, law_, coarse).run(GeodesicLaw::start(surface_, from_, angle));
    Ray result{angle, flow.length, {}};
    if (flow.parts.empty()) return result;
    for (int i = 0; i <= kPlaces; ++i) {
      const double t = flow.length * i / kPlaces;
      const PolynomialCurve::Part& part = part_at(flow.parts, t);
      result.places.push_back(Vec2(part.value(part.local(t))));
    }
    return result;
  }

  // Directions with others between those that go apart.
  void draw_net() {
    for (int i = 0; i <= kFirstDirections; ++i) rays_.push_back(ray(kTwoPi * i / kFirstDirections));
    for (size_t i = 0; i + 1 < rays_.size() && rays_.size() < kMaxDirections;) {
      const bool narrow = rays_[i + 1].angle - rays_[i].angle < 1e-4;
      if (narrow || spread(rays_[i], rays_[i + 1]) <= kSpread * reach_)
        ++i;
      else
        rays_.insert(rays_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     ray(0.5 * (rays_[i].angle + rays_[i + 1].angle)));
    }
  }
  double spread(const Ray& a, const Ray& b) const {
    if (a.places.empty() != b.places.empty()) return kInfinity;
    double most = 0;
    for (size_t i = 0; i < a.places.size(); ++i)
      most = std::max(most, glm::length(point(a.places[i]) - point(b.places[i])));
    return most;
  }
  Vec3 point(const Vec2& uv) const { return surface_.point(uv.x, uv.y); }

  static double side(const Vec2& a, const Vec2& b, const Vec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  }
  static bool holds(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
    const double x = side(a, b, p), y = side(b, c, p), z = side(c, a, p);
    return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
  }

  std::vector<Start> find_starts() const {
    std::vector<Start> starts;
    for (size_t r = 0; r + 1 < rays_.size(); ++r) {
      const Ray &a = rays_[r], &b = rays_[r + 1];
      for (size_t i = 0; i + 1 < a.places.size() && !b.places.empty(); ++i)
        for (const Vec2& image : images_) {
          if (!holds(a.places[i], b.places[i], b.places[i + 1], image) &&
              !holds(a.places[i], b.places[i + 1], a.places[i + 1], image))
            continue;
          const double part = (static_cast<double>(i) + 0.5) / kPlaces;
          starts.push_back({0.5 * (a.angle + b.angle), 0.5 * (a.length + b.length) * part});
        }
    }
    // A point on the border may lie beyond the last cells: where rays come nearest to it, nearer than their neighbours.
    for (const Vec2& image : images_) {
      std::vector<std::pair<double, size_t>> nearest;
      for (const Ray& one : rays_) {
        std::pair<double, size_t> best{kInfinity, 0};
        for (size_t i = 1; i < one.places.size(); ++i)
          if (std::abs(one.places[i].x - image.x) < 0.5 * (periods_.u > 0 ? periods_.u : kInfinity) &&
              std::abs(one.places[i].y - image.y) < 0.5 * (periods_.v > 0 ? periods_.v : kInfinity))
            best = std::min(best, {glm::length(point(one.places[i]) - target_), i});
        nearest.push_back(best);
      }
      const size_t count = nearest.size() - 1;  // the last is the first again
      for (size_t r = 0; r < count; ++r)
        if (nearest[r].first < kSpread * reach_ && nearest[r].first <= nearest[(r + 1) % count].first &&
            nearest[r].first <= nearest[(r + count - 1) % count].first)
          starts.push_back({rays_[r].angle, rays_[r].length * static_cast<double>(nearest[r].second) / kPlaces});
    }
    return starts;
  }

  // The way to the next image.
  Vec2 nearest(Vec2 way) const {
    if (periods_.u > 0) way.x -= periods_.u * std::round(way.x / periods_.u);
    if (periods_.v > 0) way.y -= periods_.v * std::round(way.y / periods_.v);
    return way;
  }

  std::optional<Shot> solve(const Start& start) const {
    constexpr int kPatience = 6;
    int shots = 0;  // that were exact
    double angle = start.angle, length = start.length, before = kInfinity;
    for (int time = 0; time < kMaxShots; ++time) {
      if (!(length > 0) || length > 1.5 * reach_) return std::nullopt;
      FlowOptions options = options_;
      options.length = length;
      options.tolerance = before < 1e-4 * reach_ ? options.tolerance : 1e-7;
      GeodesicFlow::Result flow = GeodesicFlow(surface_, law_, options).run(GeodesicLaw::start(surface_, from_, angle));
      if (flow.parts.empty()) return std::nullopt;
      // One that has met the border goes on straight as far as it still should.
      GeodesicLaw::State& y = flow.end;
      const double beyond = length - flow.length;
      const Vec2 inside(y[0], y[1]);
      const SurfaceJet at = surface_.evaluate(y[0], y[1], 1);
      const Vec2 apart = nearest(to_ - inside - beyond * Vec2(y[2], y[3]));
      const Vec3 along = y[2] * at.du() + y[3] * at.dv();
      const Vec3 across = glm::cross(glm::normalize(glm::cross(at.du(), at.dv())), along);
      const Vec3 miss = apart.x * at.du() + apart.y * at.dv();
      const double distance = glm::length(miss);
      const bool exact = options.tolerance == options_.tolerance;
      if (exact) ++shots;
      const bool stays = shots > kPatience && distance >= 0.5 * before;
      if (exact && (distance <= kReached * options_.size || (stays && distance <= kNearlyReached * options_.size))) {
        if (beyond > 1e-9 * options_.size) return std::nullopt;  // only beyond the border
        return Shot{angle, length, distance, std::move(flow)};
      }
      const double turn = glm::dot(miss, across) / (y[4] + beyond * y[5]);
      const double longer = glm::dot(miss, along);
      if (!std::isfinite(turn)) return std::nullopt;
      angle += std::clamp(turn, -0.3, 0.3);
      length += std::clamp(longer, -0.3 * length, 0.3 * length);
      before = distance;
    }
    return std::nullopt;
  }

  const Surface& surface_;
  const Vec2 from_, to_;
  const Vec3 target_;
  const Periods periods_;
  const GeodesicLaw law_{};
  FlowOptions options_;
  double reach_ = 0;
  std::vector<Vec2> images_;
  std::vector<Ray> rays_;
};

}  // namespace

SurfaceLine shortest_geodesic(const Surface& surface, const Vec2& from, const Vec2& to) {
  check_place(surface, from, "from");
  check_place(surface, to, "to");
  const double size = line_size(surface, 1);
  if (glm::length(surface.point(from.x, from.y) - surface.point(to.x, to.y)) <= 1e-12 * size)
    throw FieldError("to", "'from' and 'to' are one point");
  return Shooting(surface, from, to).run();
}

}  // namespace lekalo::geometry
