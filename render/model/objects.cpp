#include "render/model/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/bodies/booleans/solid_boundary.h"
#include "geometry/shapes/implicit/implicit_surface.h"
#include "geometry/surfaces/analytic/plane.h"
#include "render/model/section.h"
#include "render/model/section_faces.h"
#include "render/scene/values/types.h"

namespace lekalo::render {

using namespace geometry;

Entity entity_of(const std::any& thing) {
  if (const auto* point = std::any_cast<Vec3>(&thing)) return *point;
  if (const auto* curve = std::any_cast<CurvePtr>(&thing)) return *curve;
  if (const auto* surface = std::any_cast<SurfacePtr>(&thing)) return *surface;
  if (const auto* set = std::any_cast<SurfaceSet>(&thing)) return *set;
  if (const auto* body = std::any_cast<BodyPtr>(&thing)) return *body;
  if (const auto* mesh = std::any_cast<MeshPtr>(&thing)) return *mesh;
  if (const auto* shape = std::any_cast<ShapePtr>(&thing)) return *shape;
  if (const auto* group = std::any_cast<GroupPtr>(&thing)) return *group;
  throw std::logic_error("a builder returned something that is no geometry");
}

const void* identity(const Entity& entity) {
  return std::visit(
      [](const auto& shape) -> const void* {
        using T = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<T, Vec3>)
          return nullptr;
        else if constexpr (std::is_same_v<T, SurfaceSet>)
          return shape.empty() ? nullptr : shape.front().get();
        else
          return shape.get();
      },
      entity);
}

namespace {

bool is_implicit(const Entity& entity) {
  const auto* shape = std::get_if<ShapePtr>(&entity);
  const auto* moved = shape ? dynamic_cast<const TransformedShape*>(shape->get()) : nullptr;
  return shape && dynamic_cast<const ImplicitSurface*>(moved ? moved->original().get() : shape->get());
}

}  // namespace

void put_boundary_for_caps(Object& object) {
  const auto* shape = std::get_if<ShapePtr>(&object.shape);
  if (shape && has_boundary(**shape) &&
      std::any_of(object.clips.begin(), object.clips.end(), [](const ClipPlane& clip) { return clip.cap; })) {
    object.as_written = shape_as_written(object);
    object.shape = boundary_of(*shape);
  }
}

std::vector<std::string> line_kinds_of(const Entity& entity) {
  if (std::holds_alternative<Vec3>(entity) || std::holds_alternative<CurvePtr>(entity)) return {"curve"};
  if (std::holds_alternative<SurfacePtr>(entity) || std::holds_alternative<SurfaceSet>(entity))
    return {"boundary", "sharp", "silhouette", "parameter", "section", "intersection", "self_intersection"};
  std::vector<std::string> kinds{"boundary", "sharp", "smooth", "silhouette", "section", "intersection"};
  if (!std::holds_alternative<MeshPtr>(entity) && !is_implicit(entity)) kinds.push_back("parameter");
  // Known of none of these yet.
  if (std::holds_alternative<ShapePtr>(entity)) kinds.push_back("self_intersection");
  return kinds;
}

namespace {

bool is_unbounded(const Entity& entity) {
  if (const auto* surface = std::get_if<SurfacePtr>(&entity)) return !(*surface)->bounded();
  if (const auto* set = std::get_if<SurfaceSet>(&entity))
    return std::any_of(set->begin(), set->end(), [](const SurfacePtr& surface) { return !surface->bounded(); });
  return false;
}

bool is_plane(const Entity& entity) {
  const auto* surface = std::get_if<SurfacePtr>(&entity);
  return surface && dynamic_cast<const geometry::Plane*>(surface->get());
}

// Embree squares lengths in single precision, which ends at the square of 1.8e19: beyond, nothing is hit. Some is left
// for what cameras and transforms add.
constexpr double kMaxCoordinate = 1e15;
// Curvatures have the sixth powers of lengths, and double precision ends at 1e-308.
constexpr double kMinCoordinate = 1e-50;
// Of places of groups: what they hold is met in their own coordinates.
constexpr double kMaxOfGroups = 1e19;

// How far a shape reaches from the origin along an axis. Of curves and surfaces how near places all over them are: a
// graph may leave the page towards a pole.
double reach(const Entity& entity, const Affine& placed) {
  constexpr double kShares[] = {0.13, 0.37, 0.61, 0.89};
  const auto reach_of = [&](const Vec3& p) {
    const Vec3 at = glm::abs(placed.point(p));
    return std::max({at.x, at.y, at.z});
  };
  const auto inside = [](const Interval& range, double share) { return range.lo + share * range.width(); };
  const auto reach_of_surface = [&](const Surface& surface) {
    if (!surface.bounded()) return 0.0;
    const Rectangle domain = surface.domain();
    double near = kInfinity;
    for (const double u : kShares)
      for (const double v : kShares)
        near = std::min(near, reach_of(surface.point(inside(domain.u, u), inside(domain.v, v))));
    return near;
  };
  const auto reach_of_box = [&](const Box3& box) {
    return box.bounded() ? std::max(reach_of(box.lo), reach_of(box.hi)) : 0.0;
  };
  double far = 0;
  if (const auto* point = std::get_if<Vec3>(&entity)) far = reach_of(*point);
  if (const auto* curve = std::get_if<CurvePtr>(&entity); curve && (*curve)->domain().width() < kInfinity) {
    far = kInfinity;
    for (const double t : kShares) far = std::min(far, reach_of((*curve)->point(inside((*curve)->domain(), t))));
  }
  if (const auto* surface = std::get_if<SurfacePtr>(&entity)) far = reach_of_surface(**surface);
  if (const auto* set = std::get_if<SurfaceSet>(&entity))
    for (const SurfacePtr& surface : *set) far = std::max(far, reach_of_surface(*surface));
  if (const auto* body = std::get_if<BodyPtr>(&entity))
    for (const Vertex& vertex : (*body)->vertices) far = std::max(far, reach_of(vertex.point));
  if (const auto* mesh = std::get_if<MeshPtr>(&entity)) far = reach_of_box(bounds(**mesh));
  if (const auto* shape = std::get_if<ShapePtr>(&entity)) far = reach_of_box((*shape)->bounds());
  // The first of a group stands for all: others may lie far off, and copies of copies are too many.
  const auto* group = std::get_if<GroupPtr>(&entity);
  if (group && !(*group)->objects.empty()) {
    const Object& first = (*group)->objects.front();
    far = reach(first.shape, placed * first.transform);
  }
  return far;
}

// What surfaces without an end cannot be cut by or meet.
void check_unbounded(const Object& object) {
  if (!object.look || !object.look->lines) return;
  const Lines& lines = *object.look->lines;
  const char* hint = "give the surface a domain";
  if (is_unbounded(object.shape))
    for (const char* kind : {"section", "self_intersection"})
      if (lines.styles.count(kind) > 0)
        throw FieldError(std::string("lines.") + kind, "the surface is unbounded: these lines have no end", hint);
  for (const std::any& one : lines.with) {
    const Entity other = entity_of(one);
    // A plane cuts what has an end.
    if (is_unbounded(object.shape) && (!is_plane(object.shape) || is_unbounded(other)))
      throw FieldError("lines.intersection", "the surface is unbounded: these lines have no end", hint);
    if (is_unbounded(other) && !is_plane(other))
      throw FieldError("lines.intersection.with", "what is met is an unbounded surface", hint);
  }
}

uint32_t visibility(const std::vector<std::string>& words) {
  uint32_t bits = 0;
  for (const std::string& word : words)
    bits |= static_cast<uint32_t>(word == "camera"   ? RayKind::camera
                                  : word == "shadow" ? RayKind::shadow
                                                     : RayKind::reflection);
  return bits;
}

// Caps need an inside. Solids that are put together are capped by their boundary.
void check_caps(const Object& object) {
  if (std::holds_alternative<BodyPtr>(object.shape) || std::holds_alternative<GroupPtr>(object.shape)) return;
  for (size_t k = 0; k < object.clips.size(); ++k) {
    if (!object.clips[k].cap) continue;
    const std::string field = "clip." + std::to_string(k) + ".cap";
    if (std::holds_alternative<MeshPtr>(object.shape))
      throw FieldError(field, "a cap closes the cut of a body; a mesh from a file knows no inside",
                       "leave out 'cap', or build the shape as a body");
    const auto* shape = std::get_if<ShapePtr>(&object.shape);
    if (shape && has_boundary(**shape)) {
      try {
        boundary_of(*shape);
      } catch (const std::exception& error) {
        throw FieldError(field,
                         fmt::format("a cap closes the cut of a body; the boundary of this solid: {}", error.what()),
                         "leave out 'cap', or cut with an intersection with a half_space: that is closed by itself");
      }
      continue;
    }
    if (shape && (*shape)->is_closed())
      throw FieldError(field, "a cap closes the cut of a body, and this shape is none",
                       "leave out 'cap', or cut with an intersection with a half_space: that is closed by itself");
    throw FieldError(field, "a cap closes the cut of a body; this shape has no inside",
                     "leave out 'cap', or show a body in its place");
  }
}

// The sag of a chord as long as the shape that turns by the mesh's angle: larger ones do not occur.
double sag_of_angle(const Object& object) {
  const Mat3& a = object.transform.linear;
  const double scale = std::max({glm::length(a[0]), glm::length(a[1]), glm::length(a[2])});
  return 0.5 * scale * bounds(object.shape).diameter() * std::tan(object.mesh_angle / 4);
}

void cut_by_own_section(const Fields& fields, Objects& objects) {
  try {
    const SectionEffect effect = cut(objects, section_of(fields.group("section")));
    if (objects.empty() && effect.taken_away > 0)
      throw FieldError("", "this section leaves nothing of the object", "what is on the normal's side is taken away");
    if (effect.cut + effect.taken_away == 0 && effect.untouched > 0)
      throw FieldError("", "this section does not cut the object",
                       "it cuts closed bodies and shapes; surfaces and curves are cut by 'clip'");
  } catch (const FieldError& error) {
    throw FieldError(error.field.empty() ? "section" : "section." + error.field, error.what(), error.hint);
  }
}

Objects objects_of(const Fields& fields) {
  Object object;
  if (fields.has("material")) object.material = fields.get<MaterialPtr>("material");
  if (fields.has("back_material")) object.back_material = fields.get<MaterialPtr>("back_material");
  object.representation = fields.text("representation") == "mesh" ? Representation::mesh : Representation::direct;
  const Fields& mesh = fields.group("mesh");
  if (mesh.has("sag")) object.sag = mesh.number("sag");
  object.sag_pixels = mesh.number("sag_pixels");
  if (mesh.has("angle")) object.mesh_angle = mesh.number("angle");
  object.flat_shading = fields.text("shading") == "flat";
  object.visible_to = visibility(fields.get<std::vector<std::string>>("visible_to"));
  if (fields.has("clip"))
    for (const Fields& plane : fields.groups("clip"))
      object.clips.push_back({plane.vec3("through"), plane.vec3("normal"), plane.boolean("cap")});
  if (fields.has("transform")) object.transform = fields.transform("transform");
  object.may_be_cut = !fields.has("section") || fields.word("section").empty();
  if (fields.has("section_hatch")) object.cut_faces = cut_faces_of(fields, "section_hatch");
  if (fields.has("lines") || fields.has("show") || fields.has("fill")) {
    Look look;
    if (fields.has("lines")) look.lines = lines_of(fields.group("lines"));
    if (fields.has("show"))
      for (const std::any& helper : fields.references("show"))
        look.helpers.push_back(std::any_cast<const Helper&>(helper));
    if (fields.has("fill")) look.fill = fill_of(fields.group("fill"));
    object.look = std::make_shared<const Look>(std::move(look));
  }
  Objects all;
  const auto& names = fields.get<std::vector<std::string>>("shape.names");
  for (const std::any& one : fields.references("shape")) {
    object.name = fields.has("name") ? fields.text("name") : names[all.size()];
    object.shape = entity_of(one);
    if (object.mesh_angle > 0 && !mesh.has("sag") && !mesh.given("sag_pixels")) object.sag = sag_of_angle(object);
    check_caps(object);
    check_unbounded(object);
    check_size(object);
    if (std::holds_alternative<GroupPtr>(object.shape))
      for (const char* field : {"back_material", "representation", "mesh", "shading", "visible_to", "clip",
                                "section_hatch", "lines", "show", "fill"})
        if (fields.given(field))
          throw FieldError(field, "'" + std::string(field) + "' is for single shapes, and this is a group",
                           "give it to the objects inside the group");
    if (object.representation == Representation::mesh && std::holds_alternative<ShapePtr>(object.shape))
      throw FieldError("representation", "this shape is met by rays only; it has no mesh",
                       "leave out 'representation'");
    if (object.flat_shading && object.representation == Representation::direct &&
        !std::holds_alternative<MeshPtr>(object.shape))
      throw FieldError("shading", "flat shading is for meshes", "add representation: mesh");
    if (fields.has("legend")) {
      const double index = static_cast<double>(all.size());
      object.legend = fields.get<TextTemplate>("legend").text({&index, 1});
    }
    all.push_back(object);
  }
  if (fields.has("section") && object.may_be_cut) cut_by_own_section(fields, all);
  return all;
}

}  // namespace

void check_size(const Object& object) {
  const double most = std::holds_alternative<GroupPtr>(object.shape) ? kMaxOfGroups : kMaxCoordinate;
  const double far = reach(object.shape, object.transform);
  if (far > most)
    throw FieldError("shape", fmt::format("'{}' has coordinates beyond {:g}", object.name, most),
                     "measure in a larger unit");
  if (far > 0 && far < kMinCoordinate)
    throw FieldError("shape", fmt::format("'{}' has no coordinate above {:g}", object.name, kMinCoordinate),
                     "measure in a smaller unit");
}

TypeDeclaration object_type() {
  TypeDeclaration type = declare(Category::object, "object", "What is shown, and how it looks.");
  const auto categories = geometry_categories();
  return type
      .field("shape", references({categories.begin(), categories.end()}).count(0),
             "what is shown: a name, a family or an inline map")
      .optional("name", text(), "in messages, layers and drawings; the shape's name by default")
      .optional("material", reference({Category::material}),
                "name or inline map; a neutral grey by default. Of a group: for members without a material")
      .optional("back_material", reference({Category::material}), "of the side that the normals look away from")
      .field("representation", choice({"direct", "mesh"}),
             "rays meet the exact surface, or triangles; a curve is seen as itself, or as a polygon", "direct")
      .field("mesh",
             group({{"sag", length().positive(), "largest distance from the surface, in scene units", false, {}},
                    {"sag_pixels", number().positive(), "the same in pixels, where no sag is given", false, "0.25"},
                    {"angle",
                     angle().positive().at_most(kPi / 2),
                     "largest turn of the normal along u and along v, of a curve's tangent along a chord; given alone, "
                     "it decides alone. Without it 10 of surfaces",
                     false,
                     {}}}),
             "fineness of the mesh representation", "{}")
      .field("shading", choice({"smooth", "flat"}), "normals of the surface, or of the facets of a mesh", "smooth")
      .field("visible_to", words({"camera", "shadow", "reflection"}), "which rays see it",
             "[camera, shadow, reflection]")
      .optional(
          "clip",
          groups({{"through", point(), "a point of the plane", false, "[0, 0, 0]"},
                  {"normal", direction(), "towards what is cut away", true, {}},
                  {"cap", boolean(), "close the cut of a body by a plane face", false, "false"}}),
          "planes that cut away what lies beyond them; they stand where the object is placed, in the world or in its "
          "group, and its own transform does not move them")
      .optional("section", group(section_fields(false)).or_word({"none"}),
                "what is taken away of it to show its inside, the cut faces hatched in drawings; none: sections of its "
                "panel leave it whole, as shafts, bolts and ribs are")
      .optional("section_hatch", section_hatch(), "of its cut faces, whichever section cuts it; none: no lines")
      .optional("transform", transform(), "steps in the order in which they happen")
      .optional("lines", group(lines_fields()),
                "lines that are seen of it: only those given; without it pictures show curves and points, drawings "
                "what `drawing` says")
      .optional("show", helpers(), "helpers beside it: those that the shape's type offers")
      .optional("fill", group(fill_fields()),
                "of the areas in which it is seen, in drawings with `ground: fill`; of a closed plane curve the region "
                "inside, which hides what is behind it")
      .optional("legend", label({"i"}),
                "text in the legend of a drawing; %i is the number of a family's member, from 0")
      .built_by(objects_of);
}

TypeDeclaration group_type() {
  TypeDeclaration type = declare(Category::group, "group",
                                 "Objects placed together as one. Shown more than once, the group is stored once.");
  return type.field("of", references({Category::object}), "the objects: { shape, material, transform, ... }")
      .built_by([](const Fields& f) -> std::any {
        auto group = std::make_shared<Group>();
        for (const std::any& one : f.references("of")) {
          const auto& some = std::any_cast<const Objects&>(one);
          group->objects.insert(group->objects.end(), some.begin(), some.end());
        }
        return GroupPtr(std::move(group));
      });
}

}  // namespace lekalo::render
