// How many sheets a place of a line lies behind: a ray from the eye counts them (Golovanov 2016, 8.3).
#pragma once

#include <atomic>
#include <optional>

#include "render/lines/projected_curve.h"
#include "render/lines/strokes.h"

namespace lekalo::render {

// Safe to use from many threads.
class QuantitativeInvisibility {
 public:
  // A sheet that passes nearer than this to a point of a line, of the scene's radius, is that on which the line lies.
  static constexpr double kTouch = 1e-9;
  // The same of a line that is known to lie on a surface, as exactly as lines are found: where it goes round the
  // surface another sheet comes near.
  static constexpr double kOnSupportingSurface = 2e-12;
  // The least that rays are aimed beside a line, of the scene's radius.
  static constexpr double kMinLateralOffset = 1e-11;

  explicit QuantitativeInvisibility(const World& world);

  // Before a point.
  int before(const Vec3& point) { return count_before(point, {}).layers; }
  // Before the point of a line at t, its curve's parameter. `lateral_offset`: how far beside it rays may be aimed, of
  // the scene's radius.
  int before(const Stroke& stroke, const ProjectedCurve& curve, double t, double lateral_offset);
  // How far that may be on a stretch of a line: what is seen there is to be seen on the stretch too.
  double room_beside(const ProjectedCurve& curve, const geometry::Interval& t) const;
  // Of a central view: where all rays come from.
  const Vec3& eye() const { return eye_; }
  // That were asked.
  int rays() const { return rays_; }

 private:
  // Which sheets before a point of a line are those on which it lies, of the scene's radius: those that pass it so
  // near, and no farther before it along the line of sight.
  struct Own {
    double across = kTouch, along = geometry::kInfinity;
  };
  Own own_sheets(const Stroke& stroke) const;
  std::optional<Vec3> normal_seen_edge_on(const Stroke& stroke, const ProjectedCurve& curve, double t) const;
  Vec3 probe(const Stroke& stroke, const ProjectedCurve& curve, double t, double lateral_offset) const;
  Vec3 beside_cuspidal_edge(const Stroke& stroke, const Vec3& exact, const geometry::SurfaceJet& s,
                            double lateral_offset) const;
  struct Count {
    int layers = 0;
    double nearest = geometry::kInfinity;  // of them across the line, of the scene's radius
  };
  Count count_before(const Vec3& point, const Own& own);

  const World& world_;
  const Camera& camera_;
  Vec3 eye_;
  std::atomic<int> rays_ = 0;
};

}  // namespace lekalo::render
