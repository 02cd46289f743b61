#include "geometry/bodies/constructions/lamina.h"

#include <memory>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/trims/trimmed_surface.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

Body lamina(const Profile& profile) {
  std::vector<CurvePtr> images;
  Box3 box;
  for (const ProfileLoop& loop : profile.loops)
    for (const CurvePtr& segment : loop.segments) {
      images.push_back(image_in(profile.plane, segment));
      box.include(bounds(*images.back()));
    }
  // A bounded plane, which other surfaces can be intersected with; lines near the loops still meet it.
  const double reach = 0.05 * box.diameter();
  const Rectangle domain{{box.lo.x - reach, box.hi.x + reach}, {box.lo.y - reach, box.hi.y + reach}};
  return trimmed_surface(std::make_shared<Plane>(profile.plane, domain), images);
}

}  // namespace lekalo::geometry
