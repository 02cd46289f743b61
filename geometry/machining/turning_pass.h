// Turning of a body of revolution about the axis x: profiles between the blank and the part (Zavyalov et al. 1985,
// V.3).
#pragma once

#include "geometry/curve.h"
#include "geometry/machining/route_path.h"
#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

// A place of the tool on its way, by the allowance that is taken off along the normal and the feed along the profile.
struct FeedPoint {
  double t = 0;  // parameter of the profile
  Vec3 point{0};
  double slope = 0;  // gamma, radians: positive where the profile falls along the feed
  double depth = 0;  // radial: allowance / cos gamma
  double step = 0;   // along x to the next: feed cos gamma, shorter where the next point would be farther than the feed
};

struct TurningPlan {
  int passes = 1, pass = 1;
  CurvePtr before, profile;  // what this pass finds and leaves: radius y over x
  double steepest = 0;       // gamma, radians, and where
  double steepest_at = 0;
  std::vector<FeedPoint> feed_points;  // none where no feed is given
};

// Where x is reached on a profile whose x runs in one direction; beyond it the nearer end.
double parameter_at_x(const Curve& profile, double x);

// pi int (r_before^2 - r_after^2) dx; both have the same parameter and the same x at it.
Measured removed_volume(const Curve& before, const Curve& after);

// From the beginning of a profile to its end, or back. `feed` is the largest distance of neighbours.
std::vector<FeedPoint> feed_points(const Curve& profile, double feed, double allowance, bool forward);

}  // namespace lekalo::geometry
