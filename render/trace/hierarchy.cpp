#include "render/trace/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/surfaces/analytic/plane.h"
#include "render/trace/device.h"
#include "render/trace/hierarchy_parts.h"

namespace lekalo::render {

namespace {

float round_down(double x) {
  const float f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -INFINITY) : f;
}
float round_up(double x) { return -round_down(-x); }

// Copies of leaves in a hierarchy; numbers of lines and sums with them must not overflow.
constexpr int64_t kMaxLeaves = int64_t{1} << 62;

// Pieces that are tested one after the other; an Embree scene of as many takes longer.
constexpr size_t kFew = 6;

// Pieces of surfaces from which on memory counts: fewer are single primitives in nodes of eight boxes, at most half a
// megabyte more, and rays take 0.6 to 0.9 times the time. More would make a body heavier than a twentieth of the mesh
// that is as exact (docs/internals/ray-costs.md).
constexpr size_t kManyPieces = 1 << 13;

Box3 box_of(const GeometryRecord& record, int primitive) {
  switch (record.kind) {
    case GeometryRecord::Kind::target:
      return record.target->piece_bounds(primitive);
    case GeometryRecord::Kind::shape:
      return record.leaf->shape->bounds();
    case GeometryRecord::Kind::instances: {
      const Instance& instance = record.instances[primitive];
      return transformed(instance.child->bounds(), instance.to_parent);
    }
    case GeometryRecord::Kind::mesh:
      return record.leaf->mesh->bounds();
  }
  return {};
}

void bounds_callback(const RTCBoundsFunctionArguments* args) {
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  Box3 box;
  for (int i = record.first_piece(args->primID); i < record.end_of_pieces(args->primID); ++i)
    if (const Box3 piece = box_of(record, i); piece.bounded()) box.include(piece);
  // Embree leaves out what is empty.
  *args->bounds_o = record.parts->float_bounds(box);
}

}  // namespace

RTCBounds Hierarchy::Parts::float_bounds(const Box3& b) const {
  const double by = kBoxInflation * radius;
  const Vec3 lo = b.lo - center - Vec3(by), hi = b.hi - center + Vec3(by);
  RTCBounds r;
  r.lower_x = round_down(lo.x), r.lower_y = round_down(lo.y), r.lower_z = round_down(lo.z);
  r.upper_x = round_up(hi.x), r.upper_y = round_up(hi.y), r.upper_z = round_up(hi.z);
  r.align0 = r.align1 = 0;
  return r;
}

Hierarchy::Hierarchy() : parts_(std::make_unique<Parts>()) {}
Hierarchy::~Hierarchy() = default;

void Hierarchy::add(Leaf given) {
  Parts& p = *parts_;
  Box3& box = given.box;
  Box3 bounded;  // of the pieces that are
  const auto include = [&](const Box3& part) {
    box.include(part);
    if (part.bounded()) bounded.include(part);
  };
  if (given.mesh) include(given.mesh->bounds());
  if (given.shape) include(given.shape->bounds());
  for (const auto& target : given.targets)
    for (int piece = 0; piece < target->piece_count(); ++piece) include(target->piece_bounds(piece));
  for (const auto& target : given.targets)
    given.foot_points.push_back(!given.parameters && target->surface().has_closest_point() ? &target->surface()
                                                                                           : nullptr);
  given.size = bounded.empty() ? 1.0 : bounded.diameter();
  p.leaves.push_back(std::make_unique<Leaf>(std::move(given)));
  const Leaf& leaf = *p.leaves.back();
  const int64_t number = p.leaf_count++;
  const auto record = [&](GeometryRecord::Kind kind) -> GeometryRecord& {
    p.records.push_back(std::make_unique<GeometryRecord>());
    GeometryRecord& r = *p.records.back();
    r.kind = kind;
    r.leaf = &leaf;
    r.leaf_number = number;
    r.object = leaf.object;
    r.parts = &p;
    return r;
  };
  if (leaf.mesh) {
    record(GeometryRecord::Kind::mesh);
  } else if (leaf.shape) {
    record(GeometryRecord::Kind::shape);
  } else {
    for (size_t face = 0; face < leaf.targets.size(); ++face) {
      GeometryRecord& r = record(GeometryRecord::Kind::target);
      r.face = static_cast<int>(face);
      r.target = leaf.targets[face].get();
      r.count = r.target->piece_count();
      r.bare = leaf.foot_points[face] != nullptr;
      r.whole = leaf.clips.empty() && leaf.visible_to == kVisibleToAll;
    }
    if (leaf.targets.empty()) throw std::logic_error("a leaf without surfaces, mesh or shape");
  }
  p.numbers.push_back({number, p.records.back().get(), nullptr});
}

void Hierarchy::reserve_instances(size_t count) { parts_->added.reserve(count); }

void Hierarchy::add_instance(std::shared_ptr<const Hierarchy> child, const Affine& to_parent, int object) {
  Parts& p = *parts_;
  const int64_t leaves = child->leaf_count(), first = p.leaf_count;
  if (leaves == 0) return;
  if (leaves > kMaxLeaves - first)
    throw std::invalid_argument("groups in groups place more shapes than can be numbered");
  p.leaf_count += leaves;
  p.added.push_back({std::move(child), to_parent, to_parent.inverse(), first, object});
}

// The bounded instances are pieces of one record, since Embree takes a quarter of a kilobyte for each geometry; each
// of the others has a record of its own.
void Hierarchy::Parts::record_instances() {
  const auto record = [&](std::vector<Instance> instances) {
    GeometryRecord& r = *records.emplace_back(std::make_unique<GeometryRecord>());
    r.kind = GeometryRecord::Kind::instances;
    r.count = static_cast<int>(instances.size());
    r.instances = std::move(instances);
    r.parts = this;
    for (const Instance& instance : r.instances) numbers.push_back({instance.first_leaf, &r, &instance});
  };
  const auto is_bounded = [](const Instance& instance) {
    const Box3 box = transformed(instance.child->bounds(), instance.to_parent);
    return instance.child->parts_->unbounded.empty() && box.bounded() && !box.empty();
  };
  if (added.empty()) return;
  numbers.reserve(numbers.size() + added.size());
  bytes += added.size() * (sizeof(Instance) + sizeof(Numbered));
  const auto rest = std::partition(added.begin(), added.end(), is_bounded);
  for (auto one = rest; one != added.end(); ++one) record({*one});
  added.erase(rest, added.end());
  if (!added.empty()) record(std::move(added));
  std::sort(numbers.begin(), numbers.end(), [](const Numbered& a, const Numbered& b) { return a.first < b.first; });
}

// Lists the pieces beside each other if they are few and none is a mesh.
bool Hierarchy::Parts::list_few() {
  size_t count = 0;
  for (const auto& record : records) {
    if (record->kind == GeometryRecord::Kind::mesh) return false;
    count += record->count;
  }
  if (count > kFew) return false;
  for (const auto& record : records)
    for (int i = 0; i < record->count; ++i)
      if (const Box3 piece = box_of(*record, i); piece.bounded())
        few.push_back({record.get(), i, piece.inflated(kBoxInflation * radius)});
  for (const Piece& piece : few) few_box.include(piece.box);
  for (const auto& record : records)
    if (record->kind == GeometryRecord::Kind::target) {
      pieces += record->count;
      bytes += record->target->memory();
    }
  return true;
}

void Hierarchy::Parts::build_scene() {
  scene = rtcNewScene(device());
  int flags = RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
  // Where memory counts: nodes of four boxes take less of it than those of eight, and two pieces in one primitive less
  // than two primitives. The triangles of a mesh would become slower.
  const auto is_mesh = [](const auto& record) { return record->kind == GeometryRecord::Kind::mesh; };
  const auto is_target = [](const auto& record) { return record->kind == GeometryRecord::Kind::target; };
  size_t of_targets = 0;
  for (const auto& record : records)
    if (is_target(record)) of_targets += static_cast<size_t>(record->count);
  if (of_targets > kManyPieces) {
    for (const auto& record : records)
      if (is_target(record)) record->together = geometry::GroupHits::kMaxPieces;
    if (std::none_of(records.begin(), records.end(), is_mesh)) flags |= RTC_SCENE_FLAG_COMPACT;
  }
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(flags));
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  plain_triangles = true;
  // Embree takes eight rays apart, and asks for them in another order, where the processor has no registers for them.
  grouped_pieces = of_targets > 0 && std::none_of(records.begin(), records.end(), is_mesh) &&
                   rtcGetDeviceProperty(device(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0;
  for (auto& record : records) {
    RTCGeometry geometry;
    if (record->kind == GeometryRecord::Kind::mesh) {
      const PackedMesh& mesh = *record->leaf->mesh;
      geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.vertices.size()));
      for (const PackedVertex& vertex : mesh.vertices) {
        const Vec3 q = vertex.point - center;
        for (int k = 0; k < 3; ++k) *points++ = static_cast<float>(q[k]);
      }
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                                 sizeof(PackedTriangle), mesh.triangles.size());
      // Triangles that some rays do not see, or that are clipped, are looked at one by one.
      if (record->leaf->visible_to != kVisibleToAll || !record->leaf->clips.empty()) {
        rtcSetGeometryIntersectFilterFunction(geometry, triangle_filter);
        rtcSetGeometryOccludedFilterFunction(geometry, triangle_filter);
        plain_triangles = false;
      }
      triangles += mesh.triangles.size();
      bytes += mesh.memory();
    } else {
      plain_triangles = false;
      geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
      rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(record->primitive_count()));
      rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
      rtcSetGeometryIntersectFunction(geometry, intersect_callback);
      rtcSetGeometryOccludedFunction(geometry, occluded_callback);
      if (record->kind == GeometryRecord::Kind::target) {
        pieces += static_cast<size_t>(record->count);
        bytes += record->target->memory();
      }
    }
    rtcSetGeometryUserData(geometry, record.get());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device());
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(error == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory for the scene's hierarchy"
                                                              : "Embree reports error " + std::to_string(error));
}

void Hierarchy::commit() {
  Parts& p = *parts_;
  p.record_instances();
  // Unbounded things (planes, half-spaces, infinite cylinders, pieces about a pole) stand in a list beside the
  // hierarchy.
  std::vector<std::unique_ptr<GeometryRecord>> bounded, others;
  for (auto& record : p.records) {
    Box3 of_bounded;
    const bool child_has_unbounded =
        std::any_of(record->instances.begin(), record->instances.end(),
                    [](const Instance& instance) { return !instance.child->parts_->unbounded.empty(); });
    for (int i = 0; i < record->count; ++i) {
      const Box3 box = box_of(*record, i);
      if (child_has_unbounded)
        p.unbounded.push_back({record.get(), i, Box3::everything()});
      else if (!box.empty() && !box.bounded())
        p.unbounded.push_back({record.get(), i, box});
      else
        of_bounded.include(box);
    }
    if (of_bounded.empty()) {
      others.push_back(std::move(record));
    } else {
      p.box.include(of_bounded);
      bounded.push_back(std::move(record));
    }
  }
  p.has_columns = std::any_of(p.unbounded.begin(), p.unbounded.end(), [](const Parts::Piece& piece) {
    const Vec3 size = piece.box.size();
    return std::min({size.x, size.y, size.z}) < geometry::kInfinity;
  });
  p.records = std::move(bounded);
  if (!p.box.empty()) {
    p.center = p.box.center();
    p.radius = 0.5 * p.box.diameter();
    if (!(p.radius > 0)) p.radius = 1e-30 + 1e-12 * glm::length(p.center);
    p.extent = glm::length(p.center) + p.radius;
    if (!p.list_few()) p.build_scene();
  }
  // Unbounded records live on behind the bounded ones, whose places are Embree's numbers.
  for (auto& record : others) p.records.push_back(std::move(record));
  for (const auto& record : p.records)
    for (const Instance& instance : record->instances) {
      p.pieces += instance.child->piece_count();
      p.triangles += instance.child->triangle_count();
    }
}

Hierarchy::Place Hierarchy::place(int64_t instance) const {
  const auto& numbers = parts_->numbers;
  // One number each, unless an instance has several leaves.
  const bool direct = static_cast<int64_t>(numbers.size()) == parts_->leaf_count;
  const Parts::Numbered& at =
      direct ? numbers[instance]
             : *std::prev(std::upper_bound(numbers.begin(), numbers.end(), instance,
                                           [](int64_t n, const Parts::Numbered& entry) { return n < entry.first; }));
  Place result;
  if (!at.instance) {
    const GeometryRecord& record = *at.record;
    // Vertices and rays of meshes are rounded to float about the centre.
    const double error = record.leaf->mesh ? kBoxInflation * parts_->radius : 0;
    result.leaf = record.leaf;
    result.object = std::max(record.object, 0);
    result.error = error;
    return result;
  }
  const Instance& copy = *at.instance;
  result = copy.child->place(instance - copy.first_leaf);
  result.to_world = result.to_world ? copy.to_parent * *result.to_world : copy.to_parent;
  result.error *= geometry::operator_norm_bound(copy.to_parent);
  if (copy.object >= 0) result.object = copy.object;
  return result;
}

Box3 Hierarchy::bounds(int64_t instance) const {
  const Place at = place(instance);
  if (at.to_world) return transformed(at.leaf->box, *at.to_world);
  if (at.leaf->box.bounded() || at.leaf->box.empty()) return at.leaf->box;
  // A ground under a scene has no more of a box than its height.
  Box3 box;
  for (const auto& target : at.leaf->targets) {
    const auto* plane = dynamic_cast<const geometry::Plane*>(&target->surface());
    if (!plane) return Box3::everything();
    const geometry::Frame& frame = plane->frame();
    Box3 flat = Box3::everything();
    for (int k = 0; k < 3; ++k)
      if (frame.x[k] == 0 && frame.y[k] == 0) flat.lo[k] = flat.hi[k] = frame.origin[k];
    box.include(flat);
  }
  return box.empty() ? Box3::everything() : box;
}

int64_t Hierarchy::leaf_count() const { return parts_->leaf_count; }
Box3 Hierarchy::bounds() const { return parts_->box; }
Vec3 Hierarchy::center() const { return parts_->center; }
double Hierarchy::radius() const { return parts_->radius; }
size_t Hierarchy::piece_count() const { return parts_->pieces; }
size_t Hierarchy::triangle_count() const { return parts_->triangles; }
size_t Hierarchy::memory() const { return parts_->bytes; }

}  // namespace lekalo::render
