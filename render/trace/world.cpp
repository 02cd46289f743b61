#include "render/trace/world.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>
#include <unordered_map>

#include "geometry/bodies/topology/sew.h"
#include "geometry/box_corners.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/tessellation/tessellate.h"
#include "geometry/tolerances.h"
#include "render/lobes/scattering.h"
#include "render/model/face_materials.h"
#include "render/model/mesh_tolerance.h"
#include "render/model/placed_objects.h"
#include "render/trace/clipped_body.h"
#include "render/trace/device.h"
#include "render/trace/hierarchy.h"
#include "render/trace/hit_curvature.h"
#include "render/trace/leaf_point.h"

namespace lekalo::render {

using geometry::Affine;
using geometry::BodyPtr;
using geometry::MeshPtr;
using geometry::SurfacePtr;

namespace {

// Boxes nearer to each other than this part of the scene's size and place may hold surfaces that rays do not tell
// apart: more than the clearance of rays that leave a mesh.
constexpr double kContact = 1e-5;
// Pairs of boxes that are compared: more would be felt; rays look for themselves then.
constexpr double kMaxPairs = 1e7;
// Boxes of clear bodies that are asked for every ray of the eye.
constexpr size_t kMaxMedia = 32;

// What one leaf is made from; equal keys share a compiled child.
using ShareKey = std::tuple<std::vector<const void*>, int, double, double, double, bool, bool>;

// All that it consists of.
std::vector<const void*> parts_of(const Entity& entity) {
  return std::visit(
      [](const auto& value) -> std::vector<const void*> {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, Vec3>) {
          return {};
        } else if constexpr (std::is_same_v<T, SurfaceSet>) {
          std::vector<const void*> all;
          for (const auto& surface : value) all.push_back(surface.get());
          return all;
        } else {
          return {value.get()};
        }
      },
      entity);
}

// True if an object's materials need the parameters of its hits.
bool uses_parameters(const Object& object) {
  const auto all = materials_of(object);
  return std::any_of(all.begin(), all.end(), [](const Material* one) { return one->uses_parameters(); });
}

ShareKey key_of(const Object& object) {
  return {parts_of(object.shape),
          static_cast<int>(object.representation),
          object.sag,
          object.sag_pixels,
          object.mesh_angle,
          object.flat_shading,
          uses_parameters(object)};
}

// Cells that cover less of the picture, in pixels, are not cut any further: they are halved along the rays that meet
// them.
constexpr double kMinCell = 4;

// Bytes of an object, without its shape and what objects have in common.
size_t memory_of(const Object& object) {
  const auto own = [](const std::string& text) {  // beside the object
    const auto at = reinterpret_cast<uintptr_t>(text.data()), begin = reinterpret_cast<uintptr_t>(&text);
    return at - begin < sizeof(text) ? 0 : text.capacity() + 1;
  };
  return sizeof(Object) + own(object.name) + own(object.legend) + object.clips.capacity() * sizeof(ClipPlane);
}

bool is_drawn_only(const Entity& entity) {
  return std::holds_alternative<Vec3>(entity) || std::holds_alternative<geometry::CurvePtr>(entity);
}

}  // namespace

struct World::Compiled {
  const CurvatureSource* curvatures = nullptr;
  Hierarchy top;
  // Hierarchy::place of all hits where nothing is in an instance; else empty.
  struct Place {
    const Leaf* leaf;
    int object;
    double error;
  };
  std::vector<Place> places;
  std::vector<const Object*> objects;       // by the number that hits carry
  std::vector<const FaceMaterials*> faced;  // of these; empty where no object has any
  WorldStatistics statistics;
  bool parameters = true;
  std::map<ShareKey, int> uses;
  std::map<ShareKey, std::shared_ptr<Hierarchy>> shared;
  std::map<const Group*, std::shared_ptr<Hierarchy>> groups;
  CameraPtr camera;

  void list_places() {
    for (int64_t i = 0; i < top.leaf_count(); ++i) {
      const Hierarchy::Place place = top.place(i);
      if (place.to_world) {
        places.clear();
        return;
      }
      places.push_back({place.leaf, place.object, place.error});
    }
  }

  void list_faced() {
    if (std::none_of(objects.begin(), objects.end(), [](const Object* one) { return face_materials(*one); })) return;
    for (const Object* object : objects) faced.push_back(face_materials(*object));
  }

  void count_uses(const std::vector<Object>& list) {
    for (const Object& object : list) {
      if (const auto* group = std::get_if<GroupPtr>(&object.shape)) {
        if (uses[{{group->get()}, -1, 0, 0, 0, false, false}]++ == 0) count_uses((*group)->objects);
      } else {
        ++uses[key_of(object)];
      }
    }
  }

  SurfacePoint point_in_world(const Leaf& leaf, const Ray& ray, const Hit& hit, int object, double error) const {
    SurfacePoint point = point_in_leaf(leaf, hit, ray.at(hit.t), ray.direction, object, error, 1);
    finish(leaf, ray, point);
    return point;
  }

  SurfacePoint point_of_instance(const Hierarchy::Place& place, const Ray& ray, const Hit& hit) const {
    const Affine &map = *place.to_world, to_leaf = map.inverse();
    SurfacePoint point = point_in_leaf(*place.leaf, hit, to_leaf.point(ray.at(hit.t)), ray.direction, place.object,
                                       place.error, geometry::operator_norm_bound(map));
    const geometry::Mat3 normals = glm::transpose(to_leaf.linear);
    point.position = map.point(point.position);
    point.smooth_position = map.point(point.smooth_position);
    point.du = map.direction(point.du);
    point.dv = map.direction(point.dv);
    point.geometric_normal = glm::normalize(normals * point.geometric_normal);
    point.normal = glm::normalize(normals * point.normal);
    finish(*place.leaf, ray, point);
    return point;
  }

  // What only the world knows of a point.
  void finish(const Leaf& leaf, const Ray& ray, SurfacePoint& point) const {
    const auto size = [](const Vec3& v) { return Vec3(std::abs(v.x), std::abs(v.y), std::abs(v.z)); };
    const Vec3 sizes = size(point.position) + size(point.position - ray.origin);
    point.error += geometry::kHitRounding * (sizes.x + sizes.y + sizes.z);
    if (leaf.parameters && camera) point.pixel_size = camera->pixel_size(point.position);
    if (leaf.parameters) point.curvature_source = curvatures;
  }

  // The area below which cells of a surface with these bounds are not cut, in the space of its leaf.
  double min_cell(const geometry::Box3& box, const Affine& to_world) const {
    if (!camera || box.empty() || !box.bounded()) return 0;
    double pixel = camera->pixel_size(to_world.point(box.center()));
    for (const Vec3& corner : geometry::corners(box))
      pixel = std::min(pixel, camera->pixel_size(to_world.point(corner)));
    const double side = std::sqrt(kMinCell) * pixel / geometry::operator_norm_bound(to_world);
    return side > 0 ? side * side : 0;
  }

  // The planes that cut an object, in the space of its leaf.
  static std::vector<CutPlane> cuts_of(const Object& object) {
    const Affine to_leaf = object.transform.inverse();
    std::vector<CutPlane> cuts;
    // A plane's normal maps with the transpose of the map from the leaf to where the object is placed.
    for (const ClipPlane& clip : object.clips) {
      const Vec3 normal = glm::normalize(glm::transpose(object.transform.linear) * clip.normal);
      cuts.push_back({{to_leaf.point(clip.through), normal}, clip.cap});
    }
    return cuts;
  }

  static bool is_solid(const Entity& entity) {
    if (const auto* body = std::get_if<BodyPtr>(&entity)) return (*body)->is_closed();
    const auto* shape = std::get_if<geometry::ShapePtr>(&entity);
    return shape && (*shape)->is_closed();
  }

  static bool has_caps(const Object& object) {
    return std::any_of(object.clips.begin(), object.clips.end(), [](const ClipPlane& clip) { return clip.cap; });
  }

  void count_method(const geometry::LineMethod& method) {
    auto& methods = statistics.methods;
    auto found = std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.name == method.name; });
    if (found == methods.end()) found = methods.insert(found, {std::string(method.name)});
    ++found->count;
    found->pieces += method.pieces;
    found->bytes += method.bytes;
  }

  void add_leaves(Hierarchy& into, const Object& object, int number, const Affine& to_world) {
    Leaf leaf = named(object, [&] { return compile(object, number, to_world); });
    for (const auto& target : leaf.targets)
      count_method({target->method(), static_cast<size_t>(target->piece_count()), target->memory()});
    if (leaf.shape) count_method(leaf.shape->method());
    into.add(std::move(leaf));
    const auto* body = std::get_if<BodyPtr>(&object.shape);
    if (!body || object.representation != Representation::mesh || !has_caps(object)) return;
    // A mesh knows no inside: its caps are those of the exact body.
    Leaf caps;
    caps.object = number;
    caps.visible_to = object.visible_to;
    caps.shape = std::make_shared<ClippedBody>(*body, cuts_of(object), true);
    into.add(std::move(caps));
  }

  static void use_mesh_of(const geometry::Body& body, const geometry::TessellationTolerance& tolerance, Leaf& leaf) {
    leaf.mesh = std::make_shared<PackedMesh>(tessellate(body, tolerance));
    for (const geometry::Face& face : body.faces) {
      leaf.mesh_surfaces.push_back(face.surface);
      leaf.signs.push_back(face.forward ? 1 : -1);
    }
  }

  // What cannot be made says of which object.
  template <class Make>
  static Leaf named(const Object& object, const Make& make) {
    try {
      return make();
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("object '{}': {}", object.name, error.what()));
    }
  }

  Leaf compile(const Object& object, int number, const Affine& to_world) const {
    Leaf leaf;
    leaf.object = number;
    leaf.visible_to = object.visible_to;
    leaf.flat = object.flat_shading;
    leaf.solid = is_solid(object.shape);
    leaf.parameters = parameters || uses_parameters(object);
    for (const CutPlane& plane : cuts_of(object)) leaf.clips.push_back(plane.half_space);
    const bool capped = has_caps(object);
    const bool as_mesh = object.representation == Representation::mesh;
    std::visit(
        [&](const auto& shape) {
          using T = std::decay_t<decltype(shape)>;
          if constexpr (std::is_same_v<T, SurfacePtr> || std::is_same_v<T, SurfaceSet>) {
            SurfaceSet set;
            if constexpr (std::is_same_v<T, SurfacePtr>)
              set.push_back(shape);
            else
              set = shape;
            if (as_mesh && set.front()->bounded()) {
              const auto tolerance = mesh_tolerance(object, to_world, camera);
              if (set.size() > 1) {
                use_mesh_of(geometry::sew(set), tolerance, leaf);
                return;
              }
              leaf.mesh = std::make_shared<PackedMesh>(tessellate(*set.front(), tolerance));
              leaf.mesh_surfaces = {set.front()};
              leaf.signs = {1};
              return;
            }
            leaf.targets.resize(set.size());
            tbb::parallel_for(tbb::blocked_range<size_t>(0, set.size()), [&](const tbb::blocked_range<size_t>& part) {
              for (size_t i = part.begin(); i < part.end(); ++i)
                leaf.targets[i] = geometry::make_line_target(set[i], nullptr, min_cell(bounds(*set[i]), to_world));
            });
            leaf.signs.assign(set.size(), 1);
          } else if constexpr (std::is_same_v<T, BodyPtr>) {
            if (as_mesh) {
              use_mesh_of(*shape, mesh_tolerance(object, to_world, camera), leaf);
            } else if (capped) {
              leaf.clips.clear();
              leaf.shape = std::make_shared<ClippedBody>(shape, cuts_of(object), false);
            } else {
              leaf.targets = geometry::make_line_targets(*shape, min_cell(bounds(*shape), to_world));
              for (const geometry::Face& face : shape->faces) leaf.signs.push_back(face.forward ? 1 : -1);
            }
          } else if constexpr (std::is_same_v<T, MeshPtr>) {
            leaf.mesh = std::make_shared<PackedMesh>(*shape);
          } else if constexpr (std::is_same_v<T, geometry::ShapePtr>) {
            leaf.shape = shape;
          } else {
            throw std::logic_error("points, curves and groups are not leaves");
          }
        },
        object.shape);
    return leaf;
  }

  void commit(Hierarchy& hierarchy) {
    hierarchy.commit();
    statistics.bytes += hierarchy.memory();
  }

  // Adds a list of objects to a hierarchy whose space maps to the world by `to_world` (of its first use). `number` is
  // the object number that all of them carry, or -1 to number each.
  void add(Hierarchy& into, const std::vector<Object>& list, const Affine& to_world) {
    into.reserve_instances(list.size());
    for (const Object& object : list) {
      const int number = static_cast<int>(objects.size());
      objects.push_back(&object);
      if (is_drawn_only(object.shape)) continue;
      if (const auto* group = std::get_if<GroupPtr>(&object.shape)) {
        auto& child = groups[group->get()];
        if (!child) {
          child = std::make_shared<Hierarchy>();
          add(*child, (*group)->objects, to_world * object.transform);
          commit(*child);
        }
        into.add_instance(child, object.transform, -1);  // its members keep their own numbers and materials
        ++statistics.instances;
        continue;
      }
      const bool plain = object.clips.empty() && object.visible_to == kVisibleToAll;
      const ShareKey key = key_of(object);
      const bool share = plain && uses[key] > 1;
      if (!share && object.transform.is_identity()) {
        add_leaves(into, object, number, to_world);
        continue;
      }
      std::shared_ptr<Hierarchy> child = share ? shared[key] : nullptr;
      if (!child) {
        child = std::make_shared<Hierarchy>();
        add_leaves(*child, object, number, to_world * object.transform);
        commit(*child);
        if (share) shared[key] = child;
      }
      into.add_instance(child, object.transform, number);
      ++statistics.instances;
    }
  }
};

World::World(std::shared_ptr<const Model> model, bool parameters)
    : model_(std::move(model)), compiled_(std::make_unique<Compiled>()) {
  compiled_->curvatures = this;
  const auto begin = std::chrono::steady_clock::now();
  const size_t embree_before = device_memory();
  Compiled& c = *compiled_;
  c.parameters = parameters || (model_->integrator && model_->integrator->uses_parameters());
  c.camera = model_->camera;
  const std::vector<std::string> groups = light_groups(*model_);
  ambient_by_group_.resize(groups.size() + 1);
  for (const LightPtr& light : model_->lights) {
    const auto named = std::find(groups.begin(), groups.end(), light->group());
    const int group = named == groups.end() ? 0 : static_cast<int>(named - groups.begin()) + 1;
    ambient_ += light->ambient();
    ambient_by_group_[group] += light->ambient();
    if (light->sample_count() == 0) continue;
    if (light->has_size()) lamps_with_size_.push_back(lamps_.size());
    if (light->is_backdrop()) backdrops_.push_back(lamps_.size());
    lamps_.push_back(light);
    lamp_groups_.push_back(group);
  }
  c.count_uses(model_->objects);
  with_device_threads([&] {
    c.add(c.top, model_->objects, Affine());
    c.commit(c.top);
  });
  c.list_places();
  c.list_faced();
  const auto seen_by = [](const Object& object, RayKind kind) {
    return (object.visible_to & static_cast<uint32_t>(kind)) != 0;
  };
  for (const Object* object : c.objects) {
    for (const Material* material : materials_of(*object)) transmits_ = transmits_ || material->transmits();
    shadows_differ_ = shadows_differ_ || seen_by(*object, RayKind::shadow) != seen_by(*object, RayKind::reflection);
  }
  if (transmits_) list_contacts();
  list_glows();
  c.statistics.pieces = c.top.piece_count();
  c.statistics.triangles = c.top.triangle_count();
  c.statistics.hierarchy_bytes = std::max(device_memory(), embree_before) - embree_before;
  c.statistics.object_bytes = c.objects.capacity() * sizeof(Object*) + contacts_.capacity() * sizeof(Box3);
  for (const Object* object : c.objects) c.statistics.object_bytes += memory_of(*object);
  c.statistics.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void World::list_glows() {
  constexpr size_t kMaxGlows = 1 << 16;
  std::unordered_map<const Object*, float> brightness;
  for (const Object* object : compiled_->objects) {
    float most = 0;
    for (const Material* material : materials_of(*object))
      most = std::max(most, material->scattering({}, Wavelengths()).emission.largest());
    if (most > 0 && !is_drawn_only(object->shape)) brightness.emplace(object, most);
  }
  if (brightness.empty()) return;
  const Hierarchy& top = compiled_->top;
  for (int64_t i = 0; i < static_cast<int64_t>(top.leaf_count()); ++i) {
    const auto found = brightness.find(compiled_->objects[top.place(i).object]);
    const Box3 box = top.bounds(i);
    if (found == brightness.end() || box.empty() || !box.bounded()) continue;
    glows_.push_back({i, 0.5 * (box.lo + box.hi), 0.5 * box.diameter() * (1 + 1e-6), found->second});
    if (glows_.size() > kMaxGlows) {
      glows_.clear();
      return;
    }
  }
}

// Where bodies of some substance are, and where others may touch them.
void World::list_contacts() {
  const Hierarchy& top = compiled_->top;
  const auto has_medium = [](const Object& object) {
    const auto all = materials_of(object);
    return !is_drawn_only(object.shape) && std::any_of(all.begin(), all.end(), [](const Material* one) {
      return one->interior(Wavelengths()).has_value();
    });
  };
  const double placed = PlacedObjects(model_->objects, has_medium).count();
  if (placed == 0) return;
  if (placed * static_cast<double>(top.leaf_count()) > kMaxPairs) {
    media_ = {Box3::everything()};
    return;
  }
  const auto count = static_cast<size_t>(top.leaf_count());
  std::vector<size_t> media;
  for (size_t i = 0; i < count; ++i)
    if (has_medium(*compiled_->objects[top.place(static_cast<int64_t>(i)).object])) media.push_back(i);
  std::vector<Box3> boxes(count);
  for (size_t i = 0; i < count; ++i) boxes[i] = top.bounds(static_cast<int64_t>(i));
  contacts_.resize(count);
  const double margin = kContact * (top.radius() + glm::length(top.center()));
  for (const size_t i : media) {
    media_.push_back(boxes[i]);
    for (size_t k = 0; k < count; ++k) {
      if (k == i || boxes[k].empty()) continue;
      const Box3 box = boxes[k].inflated(margin), common{glm::max(boxes[i].lo, box.lo), glm::min(boxes[i].hi, box.hi)};
      if (!common.empty()) contacts_[i].include(common.inflated(margin));
    }
  }
  if (media_.size() <= kMaxMedia) return;
  Box3 all;
  for (const Box3& box : media_) all.include(box);
  media_ = {all};
}

bool World::may_be_in_medium(const Vec3& place) const {
  return std::any_of(media_.begin(), media_.end(), [&](const Box3& box) { return box.contains(place); });
}

World::~World() = default;

bool World::nearest(const Ray& ray, Hit& hit, const Obstacles& among) const {
  return compiled_->top.nearest(ray, hit, among);
}
void World::nearest(std::span<const Ray> rays, std::span<Hit> hits) const { compiled_->top.nearest(rays, hits); }
bool World::occluded(const Ray& ray) const { return compiled_->top.occluded(ray); }
Obstacles World::obstacles(const Ray& from, const Box3& to) const { return compiled_->top.obstacles(from, to); }
bool World::occluded(const Ray& ray, const Obstacles& among) const { return compiled_->top.occluded(ray, among); }
void World::occluded(std::span<const Ray> rays, const Obstacles& among, std::span<bool> occluded) const {
  compiled_->top.occluded(rays, among, occluded);
}
bool World::gains_by_lists() const { return compiled_->top.gains_by_lists(); }
std::vector<Hit> World::all_hits(const Ray& ray) const {
  std::vector<Hit> hits;
  all_hits(ray, hits);
  return hits;
}
void World::all_hits(const Ray& ray, std::vector<Hit>& hits) const { compiled_->top.all_hits(ray, hits); }
WorldStatistics World::statistics() const { return compiled_->statistics; }
Vec3 World::center() const { return compiled_->top.center(); }
double World::radius() const { return compiled_->top.radius(); }

SurfacePoint World::surface_point(const Ray& ray, const Hit& hit) const {
  const Compiled& c = *compiled_;
  if (!c.places.empty()) {
    const Compiled::Place& place = c.places[hit.instance];
    return c.point_in_world(*place.leaf, ray, hit, place.object, place.error);
  }
  const Hierarchy::Place place = c.top.place(hit.instance);
  return place.to_world ? c.point_of_instance(place, ray, hit)
                        : c.point_in_world(*place.leaf, ray, hit, place.object, place.error);
}

HitTarget World::target(const Hit& hit) const {
  const Hierarchy::Place place = compiled_->top.place(hit.instance);
  const Leaf& leaf = *place.leaf;
  HitTarget target;
  if (place.to_world) target.to_world = *place.to_world;
  const auto face = static_cast<size_t>(hit.face);
  if (leaf.mesh)
    target.surface = leaf.mesh_surfaces.empty() ? nullptr : leaf.mesh_surfaces[face].get();
  else if (leaf.shape)
    target.shape = leaf.shape.get();
  else
    target.surface = &leaf.targets[face]->surface();
  return target;
}

geometry::SurfaceCurvature World::curvature(const SurfacePoint& point) const {
  Hit hit;
  hit.u = point.u;
  hit.v = point.v;
  hit.instance = point.instance;
  hit.face = point.face;
  hit.piece = point.piece;
  return curvature_at(*this, hit, point);
}

void World::leave(const SurfacePoint& point, const Vec3& side, Ray& ray) const {
  const bool outward = glm::dot(side, point.geometric_normal) >= 0;
  const Vec3 normal = outward ? point.geometric_normal : -point.geometric_normal;
  ray.origin = (outward ? point.smooth_position : point.position) + clearance(point) * normal;
  ray.left_instance = point.instance;
  ray.left_face = point.face;
  ray.left_piece = point.piece;
  ray.left_for_good = outward ? point.convex_sides.front : point.convex_sides.back;
}

const Object& World::object(const SurfacePoint& point) const { return *compiled_->objects[point.object]; }

const std::vector<const Object*>& World::objects() const { return compiled_->objects; }

const Material& World::material(const SurfacePoint& point, bool front) const {
  const Object& object = this->object(point);
  const FaceMaterials* faced = compiled_->faced.empty() ? nullptr : compiled_->faced[static_cast<size_t>(point.object)];
  const Material* own = faced ? faced->own(point.face) : nullptr;
  if (own) return *own;
  if (!front && object.back_material) return *object.back_material;
  return faced ? *faced->body() : *object.material;
}

}  // namespace lekalo::render
