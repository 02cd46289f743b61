// How line work is collected (render/lines/strokes.h): object by object, kind by kind. strokes.cpp has objects and
// looks, stroke_shapes.cpp and stroke_faces.cpp the lines of curves, surfaces, bodies and solids, stroke_sections.cpp
// where they are cut, stroke_intersections.cpp, stroke_parts.cpp, stroke_tubes.cpp and stroke_meshes.cpp where they
// meet, stroke_cuts.cpp what clip planes leave of lines, stroke_helpers.cpp the helpers.
#pragma once

#include <atomic>
#include <functional>
#include <map>

#include "geometry/curves/operations/creases.h"
#include "geometry/queries/contours/body_contours.h"
#include "geometry/queries/contours/mesh_contours.h"
#include "geometry/queries/contours/parameter_lines.h"
#include "geometry/queries/implicit_curves/smooth_parts.h"
#include "geometry/shapes/csg/csg_contours.h"
#include "geometry/shapes/implicit/implicit_contours.h"
#include "geometry/shapes/tube/ball_outlines.h"
#include "geometry/shapes/tube/tube_lines.h"
#include "geometry/surfaces/triangles/parameter_triangle.h"
#include "render/lines/control_mesh.h"
#include "render/lines/strokes.h"

namespace lekalo::render {

// De Casteljau's and de Boor's triangles, which are shown of curves.
bool is_triangle(const Helper& helper);

// Whether a shape is made of surfaces: one, several, a body.
bool has_faces(const Entity& shape);

// The solid that a shape is, if it is one of this type.
template <class T>
const T* solid_of(const Entity& shape) {
  const auto* solid = std::get_if<geometry::ShapePtr>(&shape);
  return solid ? dynamic_cast<const T*>(solid->get()) : nullptr;
}

class StrokeCollector {
 public:
  // `stop`: as of line_work().
  // `solids`: lines that are known, and those that were found; null: none.
  StrokeCollector(const World& world, bool drawing, const std::atomic<bool>* stop, SolidLines* solids = nullptr);
  LineWork take() { return std::move(work_); }

 private:
  void add_object(const Object& object, const geometry::Affine& to_world, int placement);

  void leave_out(const std::string& what);
  // Whether the camera sees a point of the object; where a drawing does not, it notes that the object's `what` are left
  // out.
  bool is_seen(const Vec3& point, const char* what);
  // Of the object not all lines are known.
  void is_incomplete();
  // In messages.
  std::string name_of_object() const;

  // The line or the sign that stands for an object: what there is of it first.
  void add_legend(const Object& object);

  LineLook look_of(const Style& style);

  // Of the palette, the next colour for each object that is drawn in the style.
  Vec3 color_of(const Style& style);

  void stroke(geometry::CurvePtr curve, const Style& style, const HiddenLines& hidden);

  // The object's curve, or the polygon that stands for it.
  geometry::CurvePtr shown_curve(const geometry::CurvePtr& curve) const;
  void add_curve(const geometry::CurvePtr& curve, const Style& style, const HiddenLines& hidden);

  void polygon(std::vector<Vec3> points, bool closed, const Style& style, const HiddenLines& hidden);

  void mark(const Vec3& point, const std::string& sign, const Style& style, const HiddenLines& hidden);

  // The label of a helper's point, for these counters.
  void label(const Vec3& point, std::initializer_list<double> counters, const Helper& helper);
  void text(const Vec3& point, std::string words, const Helper& helper, bool marked);

  void add_lines(const Lines& lines);

  void add_kind(std::string_view kind, const Style& style, const Lines& lines);

  template <class Visit>
  static void each_surface(const Entity& shape, const Visit& visit) {
    if (const auto* surface = std::get_if<geometry::SurfacePtr>(&shape)) visit(*surface);
    if (const auto* set = std::get_if<SurfaceSet>(&shape))
      for (const geometry::SurfacePtr& surface : *set) visit(surface);
  }
  template <class Visit>
  void each_surface(const Visit& visit) const {
    each_surface(object_->shape, visit);
  }
  // Those of bodies too.
  template <class Visit>
  void each_face(const Visit& visit) const {
    each_surface(visit);
    if (const auto* body = std::get_if<geometry::BodyPtr>(&object_->shape))
      for (const geometry::Face& face : (*body)->faces) visit(face.surface);
  }

  // The smooth parts of a surface, or itself, with cutters that keep what lies on each.
  void each_smooth_part(const geometry::SurfacePtr& surface,
                        const std::function<void(const geometry::SurfacePtr&)>& visit);
  // Of all its bounded surfaces.
  void each_bounded_part(const Entity& shape, const std::function<void(const geometry::SurfacePtr&)>& visit);
  const std::vector<geometry::SmoothPart>& smooth_parts_of(const geometry::SurfacePtr& surface);
  // The body with fitted copies of its composed surfaces, which silhouettes are searched on faster; itself if it has
  // none.
  geometry::BodyPtr with_fitted_faces(const geometry::BodyPtr& body);

  void add_boundary(const geometry::SurfacePtr& surface, const Style& style, const HiddenLines& hidden);

  // Of a body's faces as far as the faces go.
  void add_creases(const geometry::SurfacePtr& surface, const Style& style, const HiddenLines& hidden);
  void add_creases(const geometry::Body& body, const Style& style, const HiddenLines& hidden);
  void add_crease(const geometry::SurfacePtr& surface, const geometry::Crease& crease, const geometry::Interval& along,
                  const Style& style, const HiddenLines& hidden);

  // Of balls, tubes, and solids put together of others.
  void add_parameter_lines(const geometry::ShapePtr& shape, const Lines& lines, const Style& style);

  void add_edges(const geometry::Body& body, std::string_view kind, const Style& style, const HiddenLines& hidden);

  void add(const geometry::NetLine& line, const Style& style, const HiddenLines& hidden);
  // The next stroke does.
  void lies_on(const geometry::NetLine& line);

  void add(const geometry::Contours& contours, const std::vector<geometry::SurfacePtr>& surfaces, const Style& style,
           const HiddenLines& hidden);
  void add(const geometry::BodyContours& contours, const geometry::Body& body, const Style& style,
           const HiddenLines& hidden);

  // The view is one of the object's own coordinates.
  void add_silhouettes(const geometry::ViewOf& view, const Style& style, const HiddenLines& hidden);

  // The edges or outlines of implicit surfaces, balls, tubes, and solids put together of others. Only open implicit
  // surfaces have a boundary.
  void add_solid(const geometry::ShapePtr& shape, const geometry::ViewOf& view, bool edges, const Style& style,
                 const HiddenLines& hidden);
  void add(const geometry::ShapeOutlines& outlines, bool edges, const Style& style, const HiddenLines& hidden);
  void add(const geometry::ImplicitContours& contours, const Style& style, const HiddenLines& hidden);
  void add(const geometry::CsgLine& line, const Style& style, const HiddenLines& hidden);
  // What is missing of them.
  void note(const geometry::CsgLines& lines);
  // Adds what the visitor adds of the shape as it is before it was moved as a whole; the map leads back to there.
  void in_own_coordinates(const geometry::ShapePtr& shape,
                          const std::function<void(const geometry::Shape&, const geometry::Affine&)>& visit);

  void add_mesh_lines(geometry::MeshLineKind kind, const Style& style, const HiddenLines& hidden);

  // What ends areas of a fill besides outlines, drawn or not: where the surface turns away from the light, which is its
  // outline as seen from there, and where one face goes on smoothly as another.
  void add_borders_of_fill(const Fill& fill);

  // Where different objects go through one another.
  void add_intersections();

  // A view in the coordinates to which the map leads.
  static geometry::ViewOf seen_through(geometry::ViewOf view, const geometry::Affine& map);
  geometry::ViewOf view_from(const geometry::Affine& map) const { return seen_through(view_, map); }

  // Where a plane of the world cuts a shape that to_world_ places.
  void add_section(const Entity& shape, const SectionPlane& plane, const Style& style, const HiddenLines& hidden);

  // With another shape, as the objects that show it place it; one that none shows stands as it is written.
  void add_intersections(const Entity& other, const Style& style, const HiddenLines& hidden);
  struct PlacedShape {
    Entity shape;
    geometry::Affine to_world;
    int object = -1;  // its number, if an object shows it
    int placement = 0;
  };
  std::vector<PlacedShape> placements_of(const Entity& shape) const;
  void add_intersection(PlacedShape a, PlacedShape b, const Style& style, const HiddenLines& hidden);
  // Of two of which one at most is made of faces.
  void add_intersection_of_solids(const PlacedShape& a, const PlacedShape& b, const Style& style,
                                  const HiddenLines& hidden);
  // Of a mesh, and one that is no solid put together of others and no body.
  void add_intersection_of_mesh(const PlacedShape& mesh, const PlacedShape& other, const Style& style,
                                const HiddenLines& hidden);
  // Of a solid that is put together: the lines in which its leaves meet another shape, as far as they lie on it.
  void add_intersection_of_leaves(const PlacedShape& whole, const PlacedShape& other, const Style& style,
                                  const HiddenLines& hidden);
  // Of a surface, or a body's face, with a shape that is not made of faces, both in the world.
  void add_intersection_of_face(const geometry::FaceRegion& face, const geometry::Affine& to_world,
                                const PlacedShape& solid, const Style& style, const HiddenLines& hidden);
  // How something meets a part of an implicit surface or of balls, given in that shape's coordinates: adds the lines.
  struct Meets {
    geometry::Box3 box;  // what holds it there
    std::function<void(const geometry::ImplicitSurface& formula)> formula;
    std::function<void(const geometry::SurfacePtr& surface)> surface;
  };
  Meets meets_of_face(const geometry::SurfacePtr& face, const geometry::Affine& to_world,
                      const geometry::Affine& solid_to_world, const Style& style, const HiddenLines& hidden);
  Meets meets_of_formula(const geometry::ImplicitSurface& implicit, const geometry::Affine& to_world,
                         const geometry::Affine& solid_to_world, const Style& style, const HiddenLines& hidden);
  Meets meets_of_tube(const geometry::Tube& tube, const geometry::Affine& to_world,
                      const geometry::Affine& solid_to_world, const Style& style, const HiddenLines& hidden);
  // Implicit surfaces and balls consist of parts.
  static bool has_parts(const Entity& shape);
  // The formula alone, or a surface: what closes an implicit solid at the border of its region, a ball.
  struct Part {
    const geometry::ImplicitSurface* formula = nullptr;
    geometry::SurfacePtr surface;
  };
  // Visits the parts that may meet a box, with cutters that keep what of each is on the whole.
  void each_part(const PlacedShape& solid, const geometry::Box3& near, const std::function<void(const Part&)>& visit);
  void meets_parts(const Meets& meets, const PlacedShape& solid);
  // Of two such; false if they are none.
  bool add_intersection_of_parts(const PlacedShape& a, const PlacedShape& b, const Style& style,
                                 const HiddenLines& hidden);
  // Of two shapes without faces; false if that is not known.
  bool add_intersection_of_tube(const PlacedShape& a, const PlacedShape& b, const Style& style,
                                const HiddenLines& hidden);
  const geometry::TubeBoundary& boundary_of(const geometry::Tube& tube);
  // Lines on a tube that meet a surface, if one is given.
  void add_on_tube(const geometry::ShapeOutlines& lines, const geometry::SurfacePtr& met, const Style& style,
                   const HiddenLines& hidden);

  // What is kept of strokes: where along them that may change, and whether a point is kept (`size` is that of the
  // stroke's curve in the world).
  struct Cutter {
    std::function<void(const Stroke& stroke, std::vector<double>& cuts)> add_cuts;
    std::function<bool(const Stroke& stroke, double t, double size)> keeps;
  };
  // What is kept where a function of the place is not positive; it is given in coordinates that to_world maps.
  static Cutter cut_where(const geometry::Affine& to_world,
                          const std::function<geometry::Interval(const geometry::Box3&)>& range,
                          const std::function<double(const Vec3&)>& value);
  static Cutter cutter_of(const ClipPlane& plane);
  static Cutter cutter_of(const geometry::SmoothPart& part);
  static Cutter cut_in_ball(const geometry::Affine& to_world, const Vec3& center, double radius);
  // The part of a surface that a face is.
  static Cutter cutter_of(const geometry::FaceRegion& face, const geometry::Affine& to_world);
  // What lies on a solid that is put together; `on` is the leaf on which the strokes lie, by number.
  static Cutter cutter_of(const std::vector<PlacedShape>& leaves, size_t on, const geometry::ShapePtr& placed_solid);
  std::vector<geometry::Interval> kept_parts(const Stroke& whole) const;
  void add_part(const Stroke& whole, const geometry::Interval& t);

  // The edges at which the object's clip planes cut it, of one kind: `sharp` where caps close the cut, else `boundary`.
  void add_cut_edges(std::string_view kind, const Style& style, const HiddenLines& hidden);
  // The part of a clip plane around the object, in its coordinates.
  geometry::SurfacePtr cap_of(const ClipPlane& plane) const;
  void lies_on_cap(const geometry::CurvePtr& curve, const geometry::SurfacePtr& cap);

  static std::string_view kind_of(const geometry::Body& body, const geometry::Edge& edge);

  void add_helper(const Helper& helper);

  void add_triangle(const geometry::NurbsCurveForm& form, const std::string& sign, const Helper& helper);

  // A periodic direction repeats its first points, as many as the degree.
  static int distinct(size_t count, int degree, bool periodic);

  static std::vector<Vec3> control_points(const std::vector<geometry::Vec4>& points, int first, int step, int count);

  void add_mesh(const ControlMesh& mesh, const std::string& sign, const Helper& helper);
  void add_triangle(geometry::TriangularNet net, const geometry::ParameterTriangle& triangle, const std::string& sign,
                    const Helper& helper);
  void add_mesh_image(const geometry::SurfacePtr& surface, const std::string& sign, const Helper& helper);

  void blossom(const Vec3& point, const geometry::NurbsCurveForm& form, size_t index, int level, double t,
               const Helper& helper);

  void add_figure(const geometry::CurvePtr& curve, const std::string& sign, const Helper& helper);

  std::vector<double> levels_of(const Helper& helper);
  void add_figure(const geometry::SurfacePtr& surface, const std::vector<double>& levels, const std::string& sign,
                  const Helper& helper);
  // On the faces of the object's body.
  void add_figure(const geometry::Body& body, const std::vector<double>& levels, const std::string& sign,
                  const Helper& helper);

  void add_colored(const geometry::CurvePtr& curve, const Helper& helper);

  void add_comb(const geometry::Curve& curve, const Helper& helper);

  void add_frames(const geometry::Curve& curve, const Helper& helper);

  void add_normals(const geometry::Surface& surface, const Helper& helper);

  const Model& model_;
  bool drawing_;
  SolidLines own_solids_, &solids_;
  double pixels_ = 1;     // of a millimetre on the page
  double min_width_ = 1;  // of lines
  geometry::ViewOf view_;
  std::map<const Object*, int> numbers_;
  std::map<std::string, std::map<const Object*, size_t>> cycles_;
  LineWork work_;
  int order_ = 0;
  // What is being added.
  const Object* object_ = nullptr;
  int object_number_ = 0, placement_ = 0;
  geometry::Affine to_world_;
  std::vector<ClipPlane> planes_;  // that cut it, in the world
  std::string kind_;
  bool undrawn_ = false, outlines_ = false, borders_ = false;
  std::vector<Stroke::SupportingSurface> supporting_surfaces_;  // of the next stroke
  std::vector<double> cusps_;                                   // likewise
  geometry::CurvePtr outward_offset_;                           // likewise
  geometry::SurfacePtr cap_;                                    // on which strokes lie, if any
  std::vector<Cutter> cutters_;                                 // of strokes
  int met_ = -2, met_placement_ = 0;                            // Stroke::met
  geometry::ShapePtr solid_;                                    // the last one, and how its lines are seen
  Vec3 solid_view_{0};
  const geometry::Shape* outlined_ = nullptr;  // likewise, of tubes and balls
  Vec3 outlined_view_{0};
  geometry::ShapeOutlines outlines_of_shape_;
  std::map<geometry::BodyPtr, geometry::BodyPtr> fitted_bodies_;
  std::map<const geometry::Tube*, geometry::TubeBoundary> tubes_;            // those that were met
  std::map<geometry::SurfacePtr, std::vector<geometry::SmoothPart>> parts_;  // of those that were asked
  std::vector<geometry::MeshLine> mesh_lines_;                               // of the object
  // Of fills: all faces in the world.
  struct PlacedFace {
    geometry::SurfacePtr surface;
    int object, placement;
  };
  std::vector<PlacedFace> faces_;
  std::vector<std::pair<const Object*, PlacedShape>> filled_;  // and what they belong to
};

}  // namespace lekalo::render
