// What pictures and drawings show of an object: which lines, which helpers of its geometry, which words in the legend.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/describe.h"
#include "geometry/vectors.h"
#include "render/model/styles.h"
#include "render/model/text_template.h"

namespace lekalo::render {

// What becomes of lines behind something.
struct HiddenLines {
  enum class Way {
    show,    // as if nothing were before them
    drop,    // not drawn
    dashed,  // in their own style, with the dashes of the style `hidden`
    thin,    // in their own style at half the width
    faded,   // in their own style at a third of the opacity; in drawings fainter with each further layer
    styled   // in `style`
  };
  Way way = Way::drop;
  Style style;               // of the way styled
  int max_layers = 1 << 30;  // of drawings: what lies behind more is dropped
};

// Where the object is cut by a plane.
struct SectionPlane {
  geometry::Vec3 through{0};
  geometry::Vec3 normal{0, 0, 1};
};

struct Lines {
  // boundary, sharp, smooth, silhouette, parameter, section, intersection, self_intersection, curve: only those drawn.
  std::map<std::string, Style> styles;
  geometry::ParameterValues at_u, at_v;  // of `parameter`
  std::vector<SectionPlane> planes;      // of `section`
  std::vector<std::any> with;            // of `intersection`: geometry, as references hold it
  HiddenLines hidden;
  std::map<std::string, HiddenLines, std::less<>> own_hidden;  // of kinds that say so themselves

  const HiddenLines& hidden_of(std::string_view kind) const {
    const auto own = own_hidden.find(kind);
    return own == own_hidden.end() ? hidden : own->second;
  }
};

// A helper of a geometry type, drawn beside it: control polygon, frames, comb, ...
struct Helper {
  std::string type;  // as declared in helper_types.cpp
  Style style;
  HiddenLines hidden;
  geometry::Fields values;  // its other fields as declared
};

// Parallel lines on the page over an area.
struct Hatching {
  double angle = geometry::kPi / 4;  // from the horizontal, radians
  double spacing = 1.2;              // millimetres
  bool crossed = false;              // a second family across the first
  bool shade_only = false;           // only where the surface is turned away from the light
  Style style;
};

// How the areas in which an object is seen are filled under the lines (`ground: fill`).
struct Fill {
  enum class Shading {
    none,      // no colour: hatching alone
    flat,      // one colour
    two_tone,  // darker where the surface is turned away from the light; without cast shadows
    gradient   // Lambert's law along one direction of the page, or about a point, of each smooth face
  };
  Shading shading = Shading::flat;
  std::optional<geometry::Vec3> color;  // none: the material's
  double shade = 0.75;                  // brightness of what is turned away from the light
  std::optional<geometry::Vec3> light;  // unit, towards it; none: above the viewer, to the left
  std::optional<Hatching> hatching;
};

// How the faces look at which a section cuts an object (section.h).
struct CutFaces {
  bool hatched = true;
  Hatching hatching;
  bool own_angle = true;  // none was given: each object has another
};

struct Look {
  std::optional<Lines> lines;  // none: those of the drawing
  std::vector<Helper> helpers;
  std::optional<Fill> fill;  // none: that of the drawing
};

// Fields of `lines`, of objects and of `drawing`.
std::vector<geometry::Field> lines_fields();
Lines lines_of(const geometry::Fields& fields);
// The lines of an object where nobody says which.
constexpr const char* kUsualLines = "{ boundary: thick, sharp: thick, silhouette: thick, curve: thick }";

// Fields of `fill`, of objects and of `drawing`.
std::vector<geometry::Field> fill_fields();
Fill fill_of(const geometry::Fields& fields);

// The field `hidden`, wherever one is declared.
geometry::FieldType hidden_lines();
HiddenLines hidden_of(const geometry::Fields& fields);

}  // namespace lekalo::render
