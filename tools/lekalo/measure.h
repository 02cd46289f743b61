// The parts of `lekalo measure`.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "geometry/contour.h"
#include "geometry/machining/tool_path.h"
#include "geometry/mesh.h"
#include "geometry/queries/closest/distance.h"
#include "json.h"
#include "render/model/model.h"
#include "render/scene/build/scene_attributes.h"
#include "render/scene/yaml/table.h"

namespace lekalo::command {

// Length, area, volume and moments of an entity with their errors. Throws UsageError for points.
ordered_json measures(const std::string& name, const render::Entity& entity);
// Adds what is known of a path that was planned (route, pocket, turning, drilling); nothing for other curves.
void put_plan(ordered_json& out, const geometry::Curve& curve);
void print_plan(const ordered_json& plan);
void print_measures(const ordered_json& measured);

// Adds what the scene says of the thing, face or edge of this name, and the mass and its moments where it has a
// density.
void put_attributes(ordered_json& out, const render::SceneWithAttributes& scene, const std::string& name);
void print_attributes(const ordered_json& attributes);
// A row for every element that has attributes of its own.
ordered_json attributes_of_elements(const render::SceneWithAttributes& scene);

// Faces, edges and vertices of a body with their names; counts of a mesh. Throws UsageError for anything else.
ordered_json topology(const std::string& name, const render::Entity& entity);
void print_topology(const ordered_json& found);

// The smallest box along an axis, "DX,DY,DZ", about a curve, surface or body. Throws UsageError.
ordered_json blank_of(const std::string& name, const render::Entity& entity, const std::string& axis);
void print_blank(const ordered_json& found);

// Whether a curve or surface is regular, with proven bounds. Throws UsageError for anything else.
ordered_json regularity(const std::string& name, const render::Entity& entity);
void print_regularity(const ordered_json& found);

// Area and volume on triangular cells inside of which the normal turns by so many degrees at most, by a rule of so many
// points. Throws UsageError for what is neither a surface nor a body.
ordered_json cubature_of(const std::string& name, const render::Entity& entity, int points, double turn);
void print_cubature(const ordered_json& found);

// Diameters of the cells of a surface, `counts` of them along u and v, and whether they prove that a line (a point and
// a direction, or empty) misses it. Throws UsageError for anything else.
ordered_json cells_of(const std::string& name, const render::Entity& entity, const std::vector<double>& counts,
                      const std::vector<double>& line);
void print_cells(const ordered_json& found);

// How far a curve or surface lies from a table of its points: columns t, x, y, z or u, v, x, y, z. "passed" tells
// whether no distance is above the tolerance, if there is one.
ordered_json compare_with_table(const std::string& name, const render::Entity& entity, const render::Table& table,
                                const std::string& table_name, std::optional<double> tolerance);
void print_comparison(const ordered_json& compared);

// How far two curves or two surfaces of one scene differ at the same parameters: points, derivatives up to `order`
// (0..2), unit tangents or normals, each with the place where it is worst. `samples` places in each direction, the ends
// of the domain among them. "passed" tells whether none is above the tolerance, if there is one.
ordered_json compare_pair(const std::string& name, const render::Entity& entity, const std::string& other_name,
                          const render::Entity& other, int samples, int order, std::optional<double> tolerance);
void print_pair(const ordered_json& compared);

// The distance of a curve or surface from a point with all foot points of the point on it; of a body from a point, and
// between two of all these, with all local minima, or with `nearest` the nearest ones. Throws UsageError for anything
// else.
ordered_json distance_to(const std::string& name, const render::Entity& entity, const std::string& to,
                         const render::Entity& other, bool nearest);
void print_distance(const ordered_json& found);

// Where two curves, or a curve and a surface, meet. `tolerance`, relative to the size of both: points nearer than that
// are one. Throws UsageError for anything else.
ordered_json intersections(const std::string& name, const render::Entity& entity, const std::string& other_name,
                           const render::Entity& other, double tolerance);
void print_intersections(const ordered_json& found);

// Where a curve meets itself. Throws UsageError for anything else.
ordered_json self_intersections(const std::string& name, const geometry::CurvePtr& curve, double tolerance);
void print_self_intersections(const ordered_json& found);

// All common points of three surfaces or bodies. Throws UsageError for anything else.
ordered_json common_points_of(const std::array<std::string, 3>& names,
                              const std::array<const render::Entity*, 3>& entities, double tolerance);
void print_common_points(const ordered_json& found);

// Where two surfaces or bodies meet, with `samples` points along each branch (0 or at least 2). Throws UsageError for
// anything else.
ordered_json surface_intersections(const std::string& name, const render::Entity& entity, const std::string& other_name,
                                   const render::Entity& other, double tolerance, int samples);
// The curves along which a surface meets itself. Throws UsageError for anything but a surface.
ordered_json surface_self_intersections(const std::string& name, const render::Entity& entity, double tolerance,
                                        int samples);
// Where the plane "X,Y,Z,NX,NY,NZ" cuts a surface or body.
ordered_json section(const std::string& name, const render::Entity& entity, const std::string& plane, int samples);
// The silhouette of a surface or body: `view` is "camera", a direction of sight "DX,DY,DZ", or "eye:X,Y,Z".
// Adds to every point its coordinates in the plane of a section: along the x and y of the frame about its normal.
void put_plane_coordinates(ordered_json& rows, const geometry::Vec3& origin, const geometry::Vec3& normal);
// What --silhouette says: camera, DX,DY,DZ or eye:X,Y,Z.
geometry::ViewOf view_asked(const std::string& view, const render::Camera* camera);
// The same of shapes and meshes.
bool is_solid_without_faces(const render::Entity& entity);
ordered_json section_of_solid(const std::string& name, const render::Entity& entity, const std::string& plane,
                              int samples);
ordered_json silhouette_of_solid(const std::string& name, const render::Entity& entity, const std::string& view,
                                 const render::Camera* camera, int samples);
ordered_json silhouette_seen(const std::string& name, const render::Entity& entity, const std::string& view,
                             const render::Camera* camera, int samples);
void print_contours(const ordered_json& found);

// Where the point of a scene or X,Y,Z (three numbers) lies by a surface, closed body or closed shape; U,V (two numbers)
// in the region of a body's only face. Throws UsageError for anything else.
ordered_json position_of(const std::string& name, const render::Entity& entity, const std::string& of,
                         const std::vector<double>& place);
void print_position(const ordered_json& found);

// How smoothly two curves, two surfaces, or with an empty `other_name` the faces of a body, join: the jump of each
// order. `tolerance`: what passes of each order, see geometry/queries/differential/continuity.h. Throws UsageError for
// anything else.
ordered_json continuity_of(const std::string& name, const render::Entity& entity, const std::string& other_name,
                           const render::Entity* other, double tolerance);
void print_continuity(const ordered_json& found);

// A curve as a NURBS curve, exactly where it has such a form, else fitted: degree, knots, points, weights. Throws
// UsageError for anything else.
ordered_json nurbs_form(const std::string& name, const render::Entity& entity);
void print_nurbs_form(const ordered_json& form);
ordered_json nurbs_surface_form(const std::string& name, const geometry::Surface& surface);
void print_nurbs_surface_form(const ordered_json& form);

// Inflections, vertices, cusps, corners of a curve, total curvature, turning number, enclosed area; the length of the
// part between two parameters; the parameter at a length from the beginning. curve_shape also takes surfaces: their
// umbilics. All throw UsageError for anything else.
ordered_json curve_shape(const std::string& name, const render::Entity& entity);
void print_curve_shape(const ordered_json& found);
ordered_json arc_of(const std::string& name, const render::Entity& entity, double from, double to);
ordered_json parameter_at(const std::string& name, const render::Entity& entity, double length);
void print_arc(const ordered_json& found);

// Hausdorff's and Frechet's distance of two curves as brackets. Throw UsageError for anything else.
ordered_json hausdorff_between(const std::string& name, const render::Entity& entity, const std::string& other_name,
                               const render::Entity& other);
ordered_json frechet_between(const std::string& name, const render::Entity& entity, const std::string& other_name,
                             const render::Entity& other);
void print_nearness(const ordered_json& found);

// Whether a closed plane curve is the rim of a sheet that may overlap itself, and with the parameters of the ends of a
// chord whether that is one line on it. Throws UsageError for anything else.
ordered_json rim_of(const std::string& name, const render::Entity& entity, const std::vector<double>& chord,
                    const render::Entity* along);
void print_rim(const ordered_json& found);

// The least and the greatest stretch of a surface that is laid on another of the same parameters, looked for among
// `samples` places each way. Throws UsageError for anything else.
ordered_json stretch_of(const std::string& name, const render::Entity& entity, const std::string& other_name,
                        const render::Entity& other, int samples);
void print_stretch(const ordered_json& found);

// Rows, lengths, time, height of cusps, widths of strips of a cutter's path, and by how much the cutter is more curved
// than the part at least.
void put_tool_path(ordered_json& out, const geometry::ToolPath& path);

// Parts of these outputs: what keeps a mesh from being closed, as convex_sides, turned_sides, crowded_sides; a range of
// a parameter; a point back from JSON; the row's parameters as text.
void put_open_sides(ordered_json& out, const geometry::MeshSides& sides);
ordered_json range(const geometry::Interval& x);
geometry::Vec3 vector_of(const ordered_json& v);
// A place on a thing; of a body its vertex, edge or face first.
ordered_json place_row(const geometry::DistancePlace& place);
std::string place_text(const ordered_json& place);
std::string parameter_text(const ordered_json& row);

}  // namespace lekalo::command
