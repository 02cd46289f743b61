// A lamina: the part of a plane inside a profile, as an open body of one face.
#pragma once

#include "geometry/bodies/constructions/profile.h"
#include "geometry/body.h"

namespace lekalo::geometry {

// Its normal is the plane's z. Throws TrimError (trimmed_surface.h) for loops that make no face.
Body lamina(const Profile& profile);

}  // namespace lekalo::geometry
