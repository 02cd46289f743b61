// The lines and marks that pictures show of a model's objects: curves, borders, edges, parameter lines, control
// polygons and nets, points. Lengths on the page become pixels here.
//
// What objects ask for by `lines` is shown; of objects that do not say, curves and points alone, in the style `curve`
// of the drawing.
#pragma once

#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/shapes/csg/csg_contours.h"
#include "render/model/look.h"
#include "render/trace/world.h"

namespace lekalo::render {

struct LineLook {
  double half_width = 0.5;  // pixels; no line is thinner than a pixel: a thinner one is the fainter for it
  Spectrum color;
  double opacity = 1;
  std::vector<double> dash;  // pixels drawn and left out in turn; empty: solid
  enum class Cap { butt, round, square } cap = Cap::butt;
  enum class Join { round, miter, bevel } join = Join::round;  // of drawings

  bool operator==(const LineLook&) const = default;
};

struct Stroke {
  // A surface on which the curve lies, with its image there; in the coordinates of the curve.
  struct SupportingSurface {
    geometry::SurfacePtr surface;
    geometry::Curve2Ptr image;
  };
  geometry::CurvePtr curve;
  geometry::Affine to_world;
  std::string kind;                                    // boundary, sharp, ...; control_polygon, ... of helpers
  std::vector<SupportingSurface> supporting_surfaces;  // of drawings
  // By t: of silhouettes where the picture turns back, of edges without supporting surfaces where a surface there turns
  // away.
  std::vector<double> cusps;
  geometry::CurvePtr outward_offset;  // of silhouettes without supporting surfaces: vectors along which rays beside
                                      // them miss their shape
  bool drawn = true;                  // else it is only there for what it hides: the outlines of all surfaces
  bool outlines = false;              // where surfaces end as seen: what others are hidden by ends there
  bool borders = false;               // where areas of fills may end, as they do at outlines
  LineLook look;
  std::optional<LineLook> hidden;  // of what lies behind something; none: not drawn
  double fade = 1;                 // of drawings: of its opacity for each layer beyond the first
  int max_layers = 1 << 30;        // of drawings: what lies behind more is not drawn
  int object = 0;                  // its number in World::objects(); -1: none of them, an annotation's
  int placement = 0;               // of the object's (placed_objects.h)
  int met = -2;                    // likewise of a shape without surfaces that it runs along, not exactly; -2: none
  int met_placement = 0;
  int order = 0;                                      // of lines at the same depth the one of the higher order is seen
  bool arrow_at_start = false, arrow_at_end = false;  // of drawings
  double arrow_size = 2;                              // millimetres
};

// A sign of constant size at a point.
struct Mark {
  Vec3 point{0};  // in the world
  enum class Sign { dot, circle, ball, cross, plus, square, triangle, diamond } sign = Sign::dot;
  double radius = 2;  // pixels
  LineLook line;      // of signs that are drawn by lines
  std::optional<Spectrum> fill;
  std::optional<double> hidden_opacity;  // of marks behind something; none: not drawn
  int object = 0;
  int order = 0;
};

// A text at a point, of drawings.
struct PointText {
  Vec3 point{0};     // in the world
  std::string text;  // TeX
  Style style;
  std::string kind;       // label, ...
  std::string side;       // above left, ...; empty: where there is room
  double distance = 0.6;  // millimetres from the point, or the sign at it, to the text
  bool leader = false;
  double hidden_opacity = 1;  // of what lies behind something, of its own
  int object = 0;
};

// What an object looks like in a legend.
struct LegendEntry {
  std::string text;
  std::optional<LineLook> line;
  std::optional<Mark> mark;
};

// Faces of an object that are one for whoever looks at it: those of solids whose parts have a surface in common.
class OneFaces {
 public:
  void join(int object, const std::set<int>& faces);
  // The first of those that are one with a face.
  int first(int object, int face) const;

 private:
  std::map<std::pair<int, int>, int> before_;
};

struct LineWork {
  std::vector<Stroke> strokes;
  std::vector<Mark> marks;
  std::vector<PointText> texts;  // of drawings, as the legend
  std::vector<LegendEntry> legend;
  int incomplete = 0;                           // searches for lines that did not find all
  std::vector<std::string> incomplete_objects;  // of these, in words
  bool fills = false;                           // areas are filled: their borders are among the strokes
  OneFaces one_faces;                           // of fills
  std::vector<std::string> left_out;            // of drawings: what has no lines of its own yet, in words
};

// How a style's lines look in a drawing, widths in millimetres; and what lies behind something (none: not drawn), with
// the dashes of the style `hidden`.
// Of a kind of lines: the higher is drawn over the lower where they coincide; -1: of helpers and annotations.
int line_rank(std::string_view kind);
LineLook drawn_look(const Style& style);
std::optional<LineLook> drawn_hidden_look(const Model& model, const LineLook& seen, const HiddenLines& hidden);
// The sign at points that a scene calls so.
std::optional<Mark::Sign> mark_sign(std::string_view name);

// How the areas of an object are filled, and where the light for it comes from: a unit vector towards it.
const Fill& fill_of(const Model& model, const Object& object);
Vec3 light_of(const Fill& fill, const Camera& camera);

// Millimetres on the page for one pixel of the picture.
double millimetres_of_pixel(const Model& model);

// Once `stop` is set (null: never) no more of them are found.
LineWork line_work(const World& world, const std::atomic<bool>* stop = nullptr);

// The lines of solids that are put together, as seen last, for views of the same.
using SolidLines = std::map<geometry::ShapePtr, geometry::CsgLines>;

// That of a drawing: lengths in millimetres on the page, all kinds of lines, and the outlines of all surfaces, drawn or
// not. `incomplete` counts surfaces whose silhouettes are not all known.
LineWork drawing_work(const World& world, SolidLines* solids = nullptr);

// Whether pictures may show lines or marks of an object: before a perspective or parallel camera.
bool has_lines_in_pictures(const Object& object);

// What of the objects' lines, helpers and shapes pictures do not show, but drawings: "lines (silhouette)", "helpers
// (comb)".
std::vector<std::string> left_to_drawings(const std::vector<Object>& objects);

}  // namespace lekalo::render
