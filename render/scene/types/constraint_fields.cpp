#include "render/scene/types/constraint_fields.h"

namespace lekalo::render {

using geometry::Category;
using geometry::Field;

namespace {

Field weight() {
  using namespace geometry;
  return {"weight", number().positive(),
          "how unwilling it is to change: of the solutions near the start the one is taken with "
          "the least sum of weights times squares of changes",
          false, "1"};
}

}  // namespace

std::vector<Field> constraint_fields() {
  using namespace geometry;
  return {
      {"points",
       groups({{"name", text(), "geometry has a point of this name", true, {}},
               {"at", point(), "where it begins", true, {}},
               weight()}),
       "points to be found",
       false,
       {}},
      {"in_plane", boolean(), "whether points keep their z", false, "true"},
      {"variables",
       groups({{"name", text(), "every formula may use it, as a parameter", true, {}},
               {"start", number(), "where it begins", true, {}},
               weight()}),
       "numbers to be found; angles in radians",
       false,
       {}},
      {"on_curves",
       groups(
           {{"name", text(), "geometry has a point of this name", true, {}},
            {"of", reference({Category::curve}), "the curve, which does not depend on what is to be found", true, {}},
            {"t", number(), "the parameter where it begins", true, {}},
            weight()}),
       "points to be found on curves",
       false,
       {}},
      {"bodies",
       groups({{"name", text(), "a step { pose: NAME } of a transform moves things with it", true, {}},
               {"at", point(), "the point about which it turns", false, "[0, 0, 0]"},
               weight()}),
       "rigid bodies whose poses are to be found; they begin where they are drawn without the pose",
       false,
       {}},
      {"markers",
       groups({{"name", text(), "for conditions", true, {}},
               {"of", text(), "the body that carries it; the ground where left out", false, {}},
               {"point", point(), "in the body's start position", true, {}},
               {"normal", direction(), "an axis, or the normal of a plane", false, "z"},
               {"direction", direction(), "across the normal; any where left out", false, {}}}),
       "points with a normal and a direction, carried by bodies",
       false,
       {}},
      {"conditions",
       groups({{"type",
                choice({"fixed",
                        "coincident",
                        "distance",
                        "coordinate_distance",
                        "horizontal",
                        "vertical",
                        "angle",
                        "parallel",
                        "perpendicular",
                        "equal_length",
                        "point_on_point",
                        "point_distance",
                        "point_plane",
                        "point_axis",
                        "axis_along_plane",
                        "plane_angle",
                        "plane_parallel",
                        "revolute",
                        "cylindrical",
                        "prismatic",
                        "spherical",
                        "planar",
                        "rigid",
                        "equation"}),
                "what is to hold",
                true,
                {}},
               {"of",
                texts(),
                "names of points: of `fixed` one, or a body or variable; of `angle` three, the middle one being the "
                "corner; of parallel, perpendicular and equal_length four, two for each segment",
                false,
                {}},
               {"between", texts().count(2, 2), "two points or markers", false, {}},
               {"value", number(), "the distance, or what a variable is fixed at", false, {}},
               {"angle", angle().above(0).below(kPi), "of angle and plane_angle", false, {}},
               {"along", choice({"x", "y", "z"}), "of coordinate_distance", false, {}},
               {"is",
                text(),
                "of equation: two formulas with = or >= or <= between them; variables by their names, coordinates of "
                "points as P_x, P_y, P_z",
                false,
                {}},
               {"name", text(), "for messages and `lekalo solve`", false, {}}}),
       "what is to hold",
       true,
       {}},
  };
}

}  // namespace lekalo::render
