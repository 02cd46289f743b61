#include "render/trace/hierarchy.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "render/trace/device.h"

namespace lekalo::render {

using geometry::Interval;
using geometry::kInfinity;
using geometry::Line;
using geometry::LineHits;

namespace {

// Boxes are larger than what they hold by this part of the bounding sphere's radius: it covers the rounding of the
// ray's origin and direction to float and Embree's own arithmetic (docs/internals/rays.md).
constexpr double kBoxInflation = 4e-7;

float round_down(double x) {
  const float f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -INFINITY) : f;
}
float round_up(double x) { return -round_down(-x); }
// The same for the ends of rays, once for each of them: a rounding of 2^-24 of x outward is enough there.
float ray_end(double x) { return static_cast<float>(x + 0x1p-23 * std::abs(x)); }

DeviceOptions device_options;
bool device_exists = false;

// Pieces that are tested one after the other; an Embree scene of as many takes longer.
constexpr size_t kFew = 6;

// One device for the process; Embree's scenes share its thread pool.
RTCDevice device() {
  static const RTCDevice shared = [] {
    std::string configuration;
    if (device_options.threads > 0) configuration += "threads=" + std::to_string(device_options.threads);
    if (!device_options.instruction_set.empty())
      configuration += (configuration.empty() ? "isa=" : ",isa=") + device_options.instruction_set;
    const RTCDevice d = rtcNewDevice(configuration.empty() ? nullptr : configuration.c_str());
    if (!d) throw std::runtime_error("Embree cannot start: error " + std::to_string(rtcGetDeviceError(nullptr)));
    device_exists = true;
    return d;
  }();
  return shared;
}

bool comes_before(const Hit& a, const Hit& b) {
  if (a.t != b.t) return a.t < b.t;
  if (a.instance != b.instance) return a.instance < b.instance;
  if (a.face != b.face) return a.face < b.face;
  return a.piece < b.piece;
}

bool keeps(const std::vector<HalfSpace>& clips, const Vec3& point) {
  for (const HalfSpace& clip : clips)
    if (glm::dot(point - clip.through, clip.normal) > 0) return false;
  return true;
}

// The point where the line meets the triangle's plane, in double, with the weights clamped to the triangle.
bool triangle_hit(const geometry::Mesh& mesh, int triangle, const Line& line, Hit& hit) {
  const auto& corners = mesh.triangles[triangle].point;
  const Vec3 a = mesh.points[corners[0]], ab = mesh.points[corners[1]] - a, ac = mesh.points[corners[2]] - a;
  const Vec3 n = glm::cross(ab, ac);
  const double slope = glm::dot(n, line.direction), area2 = glm::dot(n, n);
  if (slope == 0 || area2 == 0) return false;
  hit.t = glm::dot(n, a - line.origin) / slope;
  const Vec3 p = line.at(hit.t) - a;
  hit.b = std::clamp(glm::dot(glm::cross(p, ac), n) / area2, 0.0, 1.0);
  hit.c = std::clamp(glm::dot(glm::cross(ab, p), n) / area2, 0.0, 1.0 - hit.b);
  hit.piece = triangle;
  hit.face = mesh.triangles[triangle].face;
  const auto& uv = mesh.triangles[triangle].parameter;
  if (!mesh.parameters.empty() && uv[0] >= 0) {
    const geometry::Vec2 q =
        (1 - hit.b - hit.c) * mesh.parameters[uv[0]] + hit.b * mesh.parameters[uv[1]] + hit.c * mesh.parameters[uv[2]];
    hit.u = q.x;
    hit.v = q.y;
  }
  return std::isfinite(hit.t);
}

}  // namespace

void set_device_options(const DeviceOptions& options) {
  if (device_exists) throw std::logic_error("Embree runs already");
  const std::string& set = options.instruction_set;
  const bool known = set.empty() || set == "sse2" || set == "avx2" || set == "avx512";
  if (!known) throw std::invalid_argument("there is no instruction set '" + set + "'; take sse2, avx2 or avx512");
  // What Embree compiles its kernels for.
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512cd");
  if ((set == "avx2" && !avx2) || (set == "avx512" && !avx512))
    throw std::invalid_argument("this processor has no " + set + "; every one has sse2");
  device_options = options;
}

// A query in the space of one hierarchy. Embree hands its address back to the callbacks.
struct Hierarchy::Query {
  RTCIntersectContext context;
  geometry::PreparedLine prepared;
  const Line& line;
  double t_min = 0;
  double t_max = kInfinity;  // of the nearest hit so far
  double start = 0;          // the float ray begins here
  double slack = 0;          // float uncertainty of t
  uint32_t kind = 1;
  int leaf_offset = 0;
  Hit best;
  bool found = false;
  bool any = false;  // stop at the first hit
  std::vector<Hit>* all = nullptr;

  explicit Query(const Line& l) : prepared(l), line(prepared.line()) {}

  void accept(const Hit& hit) {
    if (all) {
      all->push_back(hit);
    } else if (!found || comes_before(hit, best)) {
      best = hit;
      t_max = hit.t;
    }
    found = true;
  }
};

// What an Embree geometry stands for.
struct GeometryRecord {
  enum class Kind { target, mesh, shape, instance } kind = Kind::target;
  const Leaf* leaf = nullptr;
  int leaf_number = 0;  // first number of an instance
  int face = 0;         // of a target
  const geometry::LineTarget* target = nullptr;
  int count = 1;  // pieces of a target
  std::shared_ptr<const Hierarchy> child;
  Affine to_parent, to_child;
  int object = 0;
  const Hierarchy::Parts* parts = nullptr;
};

struct Hierarchy::Parts {
  std::vector<std::unique_ptr<Leaf>> leaves;
  std::vector<std::unique_ptr<GeometryRecord>> records;  // by Embree geometry number, then the unbounded ones
  std::vector<const GeometryRecord*> unbounded;
  // The pieces of a scene of few, in place of an Embree scene, whose overhead would be most of its time.
  struct Piece {
    const GeometryRecord* record;
    int number;
    Box3 box;
  };
  std::vector<Piece> few;
  bool list_few();
  void build_scene();
  struct Numbered {
    int first;
    const GeometryRecord* record;
  };
  std::vector<Numbered> numbers;  // one entry for each leaf or instance, by first number
  int leaf_count = 0;
  Box3 box;
  Vec3 center{0};
  double radius = 0;
  size_t pieces = 0, triangles = 0, bytes = 0;
  bool meshes = false;
  RTCScene scene = nullptr;

  ~Parts() {
    if (scene) rtcReleaseScene(scene);
  }

  RTCBounds float_bounds(const Box3& b) const {
    const double by = kBoxInflation * radius;
    const Vec3 lo = b.lo - center - Vec3(by), hi = b.hi - center + Vec3(by);
    RTCBounds r;
    r.lower_x = round_down(lo.x), r.lower_y = round_down(lo.y), r.lower_z = round_down(lo.z);
    r.upper_x = round_up(hi.x), r.upper_y = round_up(hi.y), r.upper_z = round_up(hi.z);
    r.align0 = r.align1 = 0;
    return r;
  }
};

namespace {

using Query = Hierarchy::Query;

Box3 box_of(const GeometryRecord& record, int primitive) {
  switch (record.kind) {
    case GeometryRecord::Kind::target: {
      Box3 box = record.target->piece_bounds(primitive);
      return box;
    }
    case GeometryRecord::Kind::shape:
      return record.leaf->shape->bounds();
    case GeometryRecord::Kind::instance:
      return transformed(record.child->bounds(), record.to_parent);
    case GeometryRecord::Kind::mesh:
      return bounds(*record.leaf->mesh);
  }
  return {};
}

// Tests one primitive of a record in double and passes its hits on.
void test(const GeometryRecord& record, int primitive, Query& query) {
  if (record.kind == GeometryRecord::Kind::instance) {
    Query inner({record.to_child.point(query.line.origin), record.to_child.direction(query.line.direction)});
    inner.t_min = query.t_min;
    inner.t_max = query.t_max;
    inner.kind = query.kind;
    inner.leaf_offset = query.leaf_offset + record.leaf_number;
    inner.any = query.any;
    inner.all = query.all;
    inner.found = query.found && !query.all;
    inner.best = query.best;
    record.child->run(inner);
    if (inner.found) {
      query.found = true;
      query.best = inner.best;
      query.t_max = inner.t_max;
    }
    return;
  }
  const Leaf& leaf = *record.leaf;
  if (!(leaf.visible_to & query.kind)) return;
  const Interval t{query.t_min, query.t_max};
  Hit hit;
  hit.instance = query.leaf_offset + record.leaf_number;
  if (record.kind == GeometryRecord::Kind::target) {
    LineHits hits;
    record.target->piece_hits(primitive, query.prepared, t, hits);
    for (int i = 0; i < hits.size(); ++i) {
      if (!leaf.clips.empty() && !keeps(leaf.clips, query.line.at(hits[i].t))) continue;
      hit.t = hits[i].t;
      hit.u = hits[i].u;
      hit.v = hits[i].v;
      hit.face = record.face;
      hit.piece = primitive;
      query.accept(hit);
    }
  } else if (record.kind == GeometryRecord::Kind::shape) {
    std::vector<geometry::SurfaceHit> hits;
    leaf.shape->all_hits(query.line, t, hits);
    for (const geometry::SurfaceHit& h : hits) {
      hit.t = h.t;
      hit.u = h.u;
      hit.v = h.v;
      hit.face = h.face;
      hit.piece = h.piece;
      query.accept(hit);
      if (!query.all) break;
    }
  }
}

void bounds_callback(const RTCBoundsFunctionArguments* args) {
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  *args->bounds_o = record.parts->float_bounds(box_of(record, static_cast<int>(args->primID)));
}

void intersect_callback(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  Query& query = *reinterpret_cast<Query*>(args->context);
  const double before = query.t_max;
  test(*static_cast<const GeometryRecord*>(args->geometryUserPtr), static_cast<int>(args->primID), query);
  if (query.t_max < before) {
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray;
    ray.tfar = std::min(ray.tfar, ray_end(query.t_max - query.start + query.slack));
  }
}

void occluded_callback(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  Query& query = *reinterpret_cast<Query*>(args->context);
  test(*static_cast<const GeometryRecord*>(args->geometryUserPtr), static_cast<int>(args->primID), query);
  if (query.found) reinterpret_cast<RTCRay*>(args->ray)->tfar = -INFINITY;
}

// Collects every triangle along the line, or hides those that this kind of ray does not see or that are clipped away.
void triangle_filter(const RTCFilterFunctionNArguments* args) {
  if (!args->valid[0]) return;
  Query& query = *reinterpret_cast<Query*>(args->context);
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  const int triangle = static_cast<int>(reinterpret_cast<const RTCHit*>(args->hit)->primID);
  const Leaf& leaf = *record.leaf;
  Hit hit;
  const bool seen = (leaf.visible_to & query.kind) && triangle_hit(*leaf.mesh, triangle, query.line, hit) &&
                    hit.t >= query.t_min && hit.t <= query.t_max && keeps(leaf.clips, query.line.at(hit.t));
  if (seen && query.all) {
    hit.instance = query.leaf_offset + record.leaf_number;
    query.accept(hit);
  }
  if (!seen || query.all) args->valid[0] = 0;
}

}  // namespace

namespace {

// True if the line may enter the box between t_min and t_max. The box is inflated beyond the rounding of this test.
bool may_enter(const Box3& box, const Line& line, const Vec3& inverse, double t_min, double t_max) {
  for (int k = 0; k < 3; ++k) {
    const double a = (box.lo[k] - line.origin[k]) * inverse[k], b = (box.hi[k] - line.origin[k]) * inverse[k];
    // In this order: a NaN, of a line that runs in the plane of a side, changes nothing.
    t_min = std::max(t_min, std::min(a, b));
    t_max = std::min(t_max, std::max(a, b));
  }
  return t_min <= t_max;
}

}  // namespace

void Hierarchy::run(Query& query) const {
  const Parts& p = *parts_;
  for (const GeometryRecord* record : p.unbounded) {
    const int count = record->count;
    for (int i = 0; i < count; ++i) test(*record, i, query);
    if (query.any && query.found) return;
  }
  if (!p.few.empty()) {
    const Vec3 inverse = 1.0 / query.line.direction;
    for (const Parts::Piece& piece : p.few) {
      if (!may_enter(piece.box, query.line, inverse, query.t_min, query.t_max)) continue;
      test(*piece.record, piece.number, query);
      if (query.any && query.found) return;
    }
  }
  if (!p.scene) return;
  // Enter the bounding sphere in double.
  const Vec3 from = query.line.origin - p.center;
  const double a = glm::dot(query.line.direction, query.line.direction), b = glm::dot(from, query.line.direction);
  const double foot = -b / a;
  const Vec3 nearest = from + foot * query.line.direction;
  const double r = p.radius * (1 + 1e-6);
  const double inside = r * r - glm::dot(nearest, nearest);
  if (!(inside > 0)) return;
  const double half = std::sqrt(inside / a);
  query.start = std::max(query.t_min, foot - half);
  const double end = std::min(query.t_max, foot + half);
  if (!(query.start <= end)) return;
  query.slack = kBoxInflation * p.radius / std::sqrt(a);

  const Vec3 o = from + query.start * query.line.direction;
  rtcInitIntersectContext(&query.context);
  if (query.all) query.context.filter = triangle_filter;
  const auto fill = [&](RTCRay& ray) {
    ray.org_x = static_cast<float>(o.x), ray.org_y = static_cast<float>(o.y), ray.org_z = static_cast<float>(o.z);
    ray.dir_x = static_cast<float>(query.line.direction.x);
    ray.dir_y = static_cast<float>(query.line.direction.y);
    ray.dir_z = static_cast<float>(query.line.direction.z);
    ray.tnear = 0;
    ray.tfar = ray_end(end - query.start + query.slack);
    ray.time = 0;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
  };
  if (query.any) {
    RTCRay ray;
    fill(ray);
    rtcOccluded1(p.scene, &query.context, &ray);
    if (ray.tfar < 0) query.found = true;
    return;
  }
  RTCRayHit ray;
  fill(ray.ray);
  ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(p.scene, &query.context, &ray);
  if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
    // Only triangles write the hit; double decides between the triangle and the nearest of the others.
    const GeometryRecord& record = *p.records[ray.hit.geomID];
    Hit hit;
    if (triangle_hit(*record.leaf->mesh, static_cast<int>(ray.hit.primID), query.line, hit) &&
        hit.t >= query.t_min - query.slack) {
      hit.instance = query.leaf_offset + record.leaf_number;
      query.accept(hit);
    }
  }
}

Hierarchy::Hierarchy() : parts_(std::make_unique<Parts>()) {}
Hierarchy::~Hierarchy() = default;

void Hierarchy::add(Leaf given) {
  Parts& p = *parts_;
  Box3 box;
  if (given.mesh) box = geometry::bounds(*given.mesh);
  if (given.shape) box = given.shape->bounds();
  for (const auto& target : given.targets)
    for (int piece = 0; piece < target->piece_count(); ++piece) box.include(target->piece_bounds(piece));
  given.size = box.bounded() && !box.empty() ? box.diameter() : 1.0;
  p.leaves.push_back(std::make_unique<Leaf>(std::move(given)));
  const Leaf& leaf = *p.leaves.back();
  const int number = p.leaf_count++;
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
    }
    if (leaf.targets.empty()) throw std::logic_error("a leaf without surfaces, mesh or shape");
  }
  p.numbers.push_back({number, p.records.back().get()});
}

void Hierarchy::add_instance(std::shared_ptr<const Hierarchy> child, const Affine& to_parent, int object) {
  Parts& p = *parts_;
  p.records.push_back(std::make_unique<GeometryRecord>());
  GeometryRecord& r = *p.records.back();
  r.kind = GeometryRecord::Kind::instance;
  r.leaf_number = p.leaf_count;
  r.to_parent = to_parent;
  r.to_child = to_parent.inverse();
  r.object = object;
  r.parts = &p;
  p.leaf_count += child->leaf_count();
  r.child = std::move(child);
  p.numbers.push_back({r.leaf_number, &r});
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
      few.push_back({record.get(), i, box_of(*record, i).inflated(kBoxInflation * radius)});
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
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(flags));
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  for (auto& record : records) {
    RTCGeometry geometry;
    if (record->kind == GeometryRecord::Kind::mesh) {
      const geometry::Mesh& mesh = *record->leaf->mesh;
      geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.points.size()));
      for (const Vec3& point : mesh.points) {
        const Vec3 q = point - center;
        for (int k = 0; k < 3; ++k) *points++ = static_cast<float>(q[k]);
      }
      auto* corners = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
          geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), mesh.triangles.size()));
      for (const auto& triangle : mesh.triangles)
        for (int k = 0; k < 3; ++k) *corners++ = static_cast<uint32_t>(triangle.point[k]);
      // Triangles that some rays do not see, or that are clipped, are looked at one by one.
      if (record->leaf->visible_to != kVisibleToAll || !record->leaf->clips.empty()) {
        rtcSetGeometryIntersectFilterFunction(geometry, triangle_filter);
        rtcSetGeometryOccludedFilterFunction(geometry, triangle_filter);
      }
      triangles += mesh.triangles.size();
      bytes += mesh.points.size() * 12 + mesh.triangles.size() * 12;
      meshes = true;
    } else {
      geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
      const int count = record->count;
      rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(count));
      rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
      rtcSetGeometryIntersectFunction(geometry, intersect_callback);
      rtcSetGeometryOccludedFunction(geometry, occluded_callback);
      if (record->kind == GeometryRecord::Kind::target) {
        pieces += static_cast<size_t>(count);
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
  // Unbounded things (planes, half-spaces, infinite cylinders) stand in a list beside the hierarchy.
  std::vector<std::unique_ptr<GeometryRecord>> bounded, others;
  for (auto& record : p.records) {
    Box3 box;
    const int count = record->count;
    for (int i = 0; i < count; ++i) box.include(box_of(*record, i));
    const bool child_has_unbounded =
        record->kind == GeometryRecord::Kind::instance && !record->child->parts_->unbounded.empty();
    if (box.empty() || !box.bounded() || child_has_unbounded) {
      if (!box.empty() || child_has_unbounded) p.unbounded.push_back(record.get());
      others.push_back(std::move(record));
    } else {
      p.box.include(box);
      bounded.push_back(std::move(record));
    }
  }
  p.records = std::move(bounded);
  if (!p.box.empty()) {
    p.center = p.box.center();
    p.radius = 0.5 * p.box.diameter();
    if (!(p.radius > 0)) p.radius = 1e-30 + 1e-12 * glm::length(p.center);
    if (!p.list_few()) p.build_scene();
  }
  // Unbounded records live on behind the bounded ones, whose places are Embree's numbers.
  for (auto& record : others) p.records.push_back(std::move(record));
  for (const auto& record : p.records)
    if (record->kind == GeometryRecord::Kind::instance) {
      p.pieces += record->child->piece_count();
      p.triangles += record->child->triangle_count();
    }
}

namespace {

void begin(Query& query, const Ray& ray) {
  query.t_min = ray.t_min;
  query.t_max = ray.t_max;
  query.kind = static_cast<uint32_t>(ray.kind);
}

}  // namespace

bool Hierarchy::nearest(const Ray& ray, Hit& hit) const {
  Query query({ray.origin, ray.direction});
  begin(query, ray);
  run(query);
  if (query.found) hit = query.best;
  return query.found;
}

bool Hierarchy::occluded(const Ray& ray) const {
  Query query({ray.origin, ray.direction});
  begin(query, ray);
  query.any = true;
  run(query);
  return query.found;
}

std::vector<Hit> Hierarchy::all_hits(const Ray& ray) const {
  std::vector<Hit> found;
  Query query({ray.origin, ray.direction});
  begin(query, ray);
  query.all = &found;
  run(query);
  std::sort(found.begin(), found.end(), [](const Hit& a, const Hit& b) {
    return a.instance != b.instance ? a.instance < b.instance : comes_before(a, b);
  });
  // Neighbours of one leaf report a crossing on their common border twice.
  std::vector<Hit> result;
  for (size_t first = 0, last; first < found.size(); first = last) {
    for (last = first; last < found.size() && found[last].instance == found[first].instance;) ++last;
    const Place where = place(found[first].instance);
    const Affine to_leaf = where.to_world.inverse();
    const Line line{to_leaf.point(ray.origin), to_leaf.direction(ray.direction)};
    const Leaf& leaf = *where.leaf;
    std::vector<geometry::SurfaceHit> hits;
    for (size_t i = first; i < last; ++i)
      hits.push_back({found[i].t, found[i].u, found[i].v, static_cast<int>(i), found[i].piece});
    geometry::merge_hits(hits, line, leaf.size, [&](const geometry::SurfaceHit& h) -> Vec3 {
      const Hit& hit = found[h.face];
      if (leaf.mesh) {
        const auto& corner = leaf.mesh->triangles[hit.piece].point;
        const Vec3 a = leaf.mesh->points[corner[0]];
        return glm::normalize(glm::cross(leaf.mesh->points[corner[1]] - a, leaf.mesh->points[corner[2]] - a));
      }
      if (leaf.shape) return leaf.shape->sign(hit.face) * leaf.shape->surface(hit.face).normal(hit.u, hit.v);
      return leaf.signs[hit.face] * leaf.targets[hit.face]->surface().normal(hit.u, hit.v);
    });
    for (const geometry::SurfaceHit& h : hits) result.push_back(found[h.face]);
  }
  std::sort(result.begin(), result.end(), comes_before);
  return result;
}

Hierarchy::Place Hierarchy::place(int instance) const {
  const auto& numbers = parts_->numbers;
  // One number each, unless an instance has several leaves.
  const bool direct = static_cast<int>(numbers.size()) == parts_->leaf_count;
  const GeometryRecord& record =
      direct ? *numbers[instance].record
             : *std::prev(std::upper_bound(numbers.begin(), numbers.end(), instance,
                                           [](int n, const Parts::Numbered& entry) { return n < entry.first; }))
                    ->record;
  Place result;
  if (record.kind == GeometryRecord::Kind::instance) {
    result = record.child->place(instance - record.leaf_number);
    result.to_world = record.to_parent * result.to_world;
    result.moved = true;
    const geometry::Mat3& a = record.to_parent.linear;
    result.error *= std::sqrt(glm::dot(a[0], a[0]) + glm::dot(a[1], a[1]) + glm::dot(a[2], a[2]));
  } else {
    result.leaf = record.leaf;
    // Vertices and rays of meshes are rounded to float about the centre.
    if (record.leaf->mesh) result.error = kBoxInflation * parts_->radius;
  }
  result.object = record.object;
  return result;
}

int Hierarchy::leaf_count() const { return parts_->leaf_count; }
Box3 Hierarchy::bounds() const { return parts_->box; }
Vec3 Hierarchy::center() const { return parts_->center; }
double Hierarchy::radius() const { return parts_->radius; }
size_t Hierarchy::piece_count() const { return parts_->pieces; }
size_t Hierarchy::triangle_count() const { return parts_->triangles; }
size_t Hierarchy::memory() const { return parts_->bytes; }

}  // namespace lekalo::render
