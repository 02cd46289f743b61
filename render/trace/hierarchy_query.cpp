// Queries: what Embree's boxes propose, or a short list, is decided in double.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "geometry/spatial/line_through_boxes.h"
#include "geometry/tolerances.h"
#include "render/trace/hierarchy_rays.h"

namespace lekalo::render {

using geometry::Line;
using geometry::LineHits;
using geometry::LineThroughBoxes;

namespace {

using Query = Hierarchy::Query;

// Whether a leaf's planes leave a hit; `normal()` is the outward normal there. In a plane, but for rounding, the face
// of a solid is left if the solid lies on the side that is left, and any surface.
template <class Normal>
bool keeps(const Leaf& leaf, const Line& line, double t, const Normal& normal) {
  if (leaf.clips.empty()) return true;
  const Vec3 point = line.at(t);
  const double near = geometry::kSameHit * leaf.size +
                      4 * std::numeric_limits<double>::epsilon() * (glm::length(line.origin) + glm::length(point));
  for (const HalfSpace& clip : leaf.clips) {
    const double height = glm::dot(point - clip.through, clip.normal);
    if (height > near) return false;
    if (height >= -near && leaf.solid && glm::dot(normal(), clip.normal) < 0) return false;
  }
  return true;
}

void test_instance(const Instance& instance, Query& query) {
  const Line line{instance.to_child.point(query.line().origin), instance.to_child.direction(query.line().direction)};
  Query inner(line);
  inner.range = query.range;
  inner.extent = query.extent;
  inner.kind = query.kind;
  inner.leaf_offset = query.leaf_offset + instance.first_leaf;
  inner.left_instance = query.left_instance;
  inner.left_face = query.left_face;
  inner.left_piece = query.left_piece;
  inner.left_for_good = query.left_for_good;
  inner.found = query.found;
  inner.nearest = query.nearest;
  inner.all = query.all;
  instance.child->run(inner);
  query.found = inner.found;
  query.range.hi = inner.range.hi;
}

void test_shape(const GeometryRecord& record, Query& query) {
  const auto accept = [&](const geometry::SurfaceHit& h) {
    query.accept({h.t, h.u, h.v, query.leaf_offset + record.leaf_number, h.face, h.piece});
  };
  if (!query.all && record.leaf->clips.empty()) {
    geometry::SurfaceHit first;
    if (record.leaf->shape->first_hit(query.line(), query.range, first)) accept(first);
    return;
  }
  static thread_local std::vector<geometry::SurfaceHit> hits;  // its room is kept
  hits.clear();
  record.leaf->shape->all_hits(query.line(), query.range, hits);
  for (const geometry::SurfaceHit& h : hits) {
    const auto normal = [&] { return record.leaf->shape->bare_point(h, query.line().at(h.t)).normal; };
    if (!keeps(*record.leaf, query.line(), h.t, normal)) continue;
    accept(h);
    if (!query.all) break;
  }
}

void test_target(const GeometryRecord& record, int primitive, Query& query) {
  const Leaf& leaf = *record.leaf;
  const bool is_cut = !leaf.clips.empty();
  LineHits hits(!query.all && !is_cut, query.all || is_cut || (query.nearest && !record.bare));
  record.target->piece_hits(primitive, query.prepared, query.range, hits);
  for (int i = 0; i < hits.size(); ++i) {
    const geometry::LineHit& h = hits[i];
    const auto normal = [&] { return leaf.signs[record.face] * record.target->surface().normal(h.u, h.v); };
    if (!keeps(leaf, query.line(), h.t, normal)) continue;
    query.accept({h.t, h.u, h.v, query.leaf_offset + record.leaf_number, record.face, primitive});
  }
}

// The same of a whole target for queries that do not want all hits, which most tests are.
void test_whole_target(const GeometryRecord& record, int primitive, Query& query) {
  LineHits hits(true, query.nearest && !record.bare);
  record.target->piece_hits(primitive, query.prepared, query.range, hits);
  if (hits.size() == 0) return;
  if (!query.nearest) {
    query.found = true;
    return;
  }
  for (int i = 0; i < hits.size(); ++i) {
    // Without parameters t alone is copied: what was just written in parts is slow to read as one.
    const geometry::LineHit& h = hits[i];
    const Vec2 at = record.bare ? Vec2(0) : Vec2(h.u, h.v);
    query.accept_nearest({h.t, at.x, at.y, query.leaf_offset + record.leaf_number, record.face, primitive});
  }
}

// Tests one primitive of a record in double and passes its hits on.
inline void test(const GeometryRecord& record, int primitive, Query& query) {
  if (record.whole && !query.all) {
    if (!query.has_left(record, primitive)) test_whole_target(record, primitive, query);
    return;
  }
  if (record.kind == GeometryRecord::Kind::instances)
    test_instance(record.instances[primitive], query);
  else if (!(record.leaf->visible_to & query.kind) || query.has_left(record, primitive))
    return;
  else if (record.kind == GeometryRecord::Kind::target)
    test_target(record, primitive, query);
  else if (record.kind == GeometryRecord::Kind::shape)
    test_shape(record, query);
}

// The same for all pieces of one of Embree's primitives.
void test_primitive(const void* of, unsigned primitive, Query& query) {
  const auto& record = *static_cast<const GeometryRecord*>(of);
  const int end = record.end_of_pieces(primitive);
  for (int i = record.first_piece(primitive); i < end && !query.is_done(); ++i) test(record, i, query);
}

// The same for those of a packet's queries that are valid; `after` is called for each query that was asked.
template <class After>
void test_packet(const void* of, unsigned primitive, const int* valid, PacketQuery& packet, const After& after) {
  const auto& record = *static_cast<const GeometryRecord*>(of);
  const int first = record.first_piece(primitive), end = record.end_of_pieces(primitive);
  unsigned rest = 0;
  for (int i = 0; i < geometry::LineGroup::kMaxLines; ++i) rest |= static_cast<unsigned>(valid[i] != 0) << i;
  if (!record.whole) {
    for (; rest; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      test_primitive(of, primitive, *packet.queries[i]);
      after(i, *packet.queries[i]);
    }
    return;
  }
  unsigned asked[geometry::GroupHits::kMaxPieces];
  for (int piece = first; piece < end; ++piece) {
    asked[piece - first] = rest;
    if (!packet.leave) continue;
    for (unsigned each = rest; each; each &= each - 1)
      if (packet.queries[std::countr_zero(each)]->has_left(record, piece)) asked[piece - first] &= ~(each & -each);
  }
  geometry::GroupHits hits;
  record.target->group_hits(first, end, asked, packet.lines, hits);
  for (const geometry::GroupHit& one : hits) {
    Query& query = *packet.queries[one.line];
    if (query.is_done()) continue;
    if (one.is_open)
      test_whole_target(record, one.piece, query);
    else if (!query.nearest)
      query.found = true;
    else if (query.range.contains(one.hit.t))
      query.accept_nearest({one.hit.t, record.bare ? 0 : one.hit.u, record.bare ? 0 : one.hit.v,
                            query.leaf_offset + record.leaf_number, record.face, one.piece});
    after(one.line, query);
  }
}

// Asked for one member of the lists after the other, whether it is among the obstacles.
class Listed {
 public:
  explicit Listed(const Obstacles& obstacles) : rest_(static_cast<int64_t>(obstacles.listed)) {}
  bool next() {
    const bool result = rest_ & 1;
    rest_ >>= 1;  // the last bit stays
    return result;
  }

 private:
  int64_t rest_;
};

}  // namespace

void intersect_callback(const RTCIntersectFunctionNArguments* args) {
  if (args->N > 1) {
    PacketQuery& packet = *reinterpret_cast<PacketQuery*>(args->context);
    float* const ends = &RTCRayN_tfar(RTCRayHitN_RayN(args->rayhit, args->N), args->N, 0);
    test_packet(args->geometryUserPtr, args->primID, args->valid, packet, [&](int i, const Query& query) {
      packet.lines.set_end(i, query.range.hi);
      ends[i] = std::min(ends[i], ray_end(query.range.hi - query.start + query.slack));
    });
    return;
  }
  if (!args->valid[0]) return;
  Query& query = *reinterpret_cast<Query*>(args->context);
  const double before = query.range.hi;
  test_primitive(args->geometryUserPtr, args->primID, query);
  if (query.range.hi < before) {
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray;
    ray.tfar = std::min(ray.tfar, ray_end(query.range.hi - query.start + query.slack));
  }
}

void occluded_callback(const RTCOccludedFunctionNArguments* args) {
  if (args->N > 1) {
    PacketQuery& packet = *reinterpret_cast<PacketQuery*>(args->context);
    float* const ends = &RTCRayN_tfar(args->ray, args->N, 0);
    test_packet(args->geometryUserPtr, args->primID, args->valid, packet, [&](int i, const Query& query) {
      if (query.found) ends[i] = -INFINITY;
    });
    return;
  }
  if (!args->valid[0]) return;
  Query& query = *reinterpret_cast<Query*>(args->context);
  test_primitive(args->geometryUserPtr, args->primID, query);
  if (query.found) reinterpret_cast<RTCRay*>(args->ray)->tfar = -INFINITY;
}

void triangle_filter(const RTCFilterFunctionNArguments* args) {
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  const Leaf& leaf = *record.leaf;
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    Query& query = args->N > 1 ? *reinterpret_cast<PacketQuery*>(args->context)->queries[i]
                               : *reinterpret_cast<Query*>(args->context);
    const int triangle = static_cast<int>(RTCHitN_primID(args->hit, args->N, i));
    Hit hit;
    const bool seen = (leaf.visible_to & query.kind) && triangle_hit(*leaf.mesh, triangle, query.line(), hit) &&
                      hit.t >= query.range.lo && hit.t <= query.range.hi &&
                      keeps(leaf, query.line(), hit.t, [&] { return leaf.mesh->outward(triangle); });
    if (seen && query.all) {
      hit.instance = query.leaf_offset + record.leaf_number;
      query.accept(hit);
    }
    if (!seen || query.all) args->valid[i] = 0;
  }
}

void accept_triangle(const Hierarchy::Parts& p, unsigned geometry, unsigned triangle, Query& query) {
  if (geometry == RTC_INVALID_GEOMETRY_ID) return;
  const GeometryRecord& record = *p.records[geometry];
  Hit hit;
  if (triangle_hit(*record.leaf->mesh, static_cast<int>(triangle), query.line(), hit) &&
      hit.t >= query.range.lo - query.slack) {
    hit.instance = query.leaf_offset + record.leaf_number;
    query.accept(hit);
  }
}

namespace {

// The part of a query that Embree's hierarchy answers. (Not inline: it would cost queries of lists alone their
// registers.)
__attribute__((noinline)) void run_scene(const Hierarchy::Parts& p, Query& query) {
  const Stretch stretch = stretch_in(p, query.line(), query.range.lo, query.range.hi);
  if (stretch.empty) return;
  query.start = stretch.start;
  query.slack = stretch.slack;
  rtcInitIntersectContext(&query.context);
  if (query.all) query.context.filter = triangle_filter;
  const auto fill = [&](RTCRay& ray) {
    const Vec3 &o = stretch.from, &d = query.line().direction;
    ray.org_x = static_cast<float>(o.x), ray.org_y = static_cast<float>(o.y), ray.org_z = static_cast<float>(o.z);
    ray.dir_x = static_cast<float>(d.x), ray.dir_y = static_cast<float>(d.y), ray.dir_z = static_cast<float>(d.z);
    ray.tnear = 0;
    ray.tfar = ray_end(stretch.end - stretch.start + stretch.slack);
    ray.time = 0;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
  };
  if (!query.nearest && !query.all) {
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
  accept_triangle(p, ray.hit.geomID, ray.hit.primID, query);
}

// Unbounded pieces, some of which the line may pass by.
__attribute__((noinline)) void test_columns(const Hierarchy::Parts& p, Listed listed, Query& query) {
  const LineThroughBoxes line(query.line());
  for (const Hierarchy::Parts::Piece& piece : p.unbounded) {
    if (!listed.next()) continue;
    if (query.is_done()) return;
    if (line.may_enter(piece.box.inflated(kBoxInflation * p.radius), query.range))
      test(*piece.record, piece.number, query);
  }
}

}  // namespace

void Hierarchy::run(Query& query) const {
  const Parts& p = *parts_;
  Listed listed(query.among);
  // What is bounded first: a ray that ends there asks less of a plane behind it.
  if (!p.few.empty()) {
    const LineThroughBoxes line(query.line());
    // Most rays miss the box of all.
    const bool any = p.few.size() < 3 || line.may_enter(p.few_box, query.range);
    for (const Parts::Piece& piece : p.few) {
      if (!listed.next() || !any || query.has_left(*piece.record)) continue;
      if (!line.may_enter(piece.box, query.range)) continue;
      test(*piece.record, piece.number, query);
      if (query.is_done()) return;
    }
  }
  if (p.scene && query.among.scene) run_scene(p, query);
  if (p.has_columns) return test_columns(p, listed, query);
  for (const Parts::Piece& piece : p.unbounded) {
    if (!listed.next()) continue;
    if (query.is_done()) return;
    test(*piece.record, piece.number, query);
  }
}

bool Hierarchy::nearest(const Ray& ray, Hit& hit, const Obstacles& among) const {
  Query query(ray);
  begin(query, ray);
  query.among = among;
  query.nearest = &hit;
  query.extent = parts_->extent;
  run(query);
  return query.found;
}

bool Hierarchy::occluded(const Ray& ray, const Obstacles& among) const {
  if (among.none()) return false;
  Query query(ray);
  begin(query, ray);
  query.among = among;
  run(query);
  return query.found;
}

void Hierarchy::all_hits(const Ray& ray, std::vector<Hit>& result) const {
  static thread_local std::vector<Hit> found;  // its room is kept
  found.clear();
  result.clear();
  Query query(ray);
  begin(query, ray);
  query.all = &found;
  run(query);
  std::sort(found.begin(), found.end(), [](const Hit& a, const Hit& b) {
    return a.instance != b.instance ? a.instance < b.instance : comes_before(a, b);
  });
  // Neighbours of one leaf report a crossing on their common border twice.
  for (size_t first = 0, last; first < found.size(); first = last) {
    for (last = first; last < found.size() && found[last].instance == found[first].instance;) ++last;
    if (last == first + 1) {
      result.push_back(found[first]);
      continue;
    }
    const Place where = place(found[first].instance);
    Line line{ray.origin, ray.direction};
    if (where.to_world) {
      const Affine to_leaf = where.to_world->inverse();
      line = {to_leaf.point(ray.origin), to_leaf.direction(ray.direction)};
    }
    const Leaf& leaf = *where.leaf;
    std::vector<geometry::SurfaceHit> hits;
    for (size_t i = first; i < last; ++i)
      hits.push_back({found[i].t, found[i].u, found[i].v, static_cast<int>(i), found[i].piece});
    const auto normal = [&](const geometry::SurfaceHit& h) -> Vec3 {
      const Hit& hit = found[h.face];
      if (leaf.mesh) {
        const auto& vertex = leaf.mesh->triangles[hit.piece].vertex;
        const Vec3 a = leaf.mesh->vertices[vertex[0]].point;
        return glm::normalize(
            glm::cross(leaf.mesh->vertices[vertex[1]].point - a, leaf.mesh->vertices[vertex[2]].point - a));
      }
      if (leaf.shape) return leaf.shape->point({hit.t, hit.u, hit.v, hit.face, hit.piece}, line.at(hit.t)).normal;
      return leaf.signs[hit.face] * leaf.targets[hit.face]->surface().normal(hit.u, hit.v);
    };
    const auto surface = [&](const geometry::SurfaceHit& h) {
      return leaf.targets.empty() ? nullptr : &leaf.targets[found[h.face].face]->surface();
    };
    geometry::merge_hits(hits, line, leaf.size, normal, surface);
    for (const geometry::SurfaceHit& h : hits) result.push_back(found[h.face]);
  }
  std::sort(result.begin(), result.end(), comes_before);
}

}  // namespace lekalo::render
