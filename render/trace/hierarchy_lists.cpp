// Queries of lists of rays: packets through Embree where a hierarchy has nothing but plain triangles, or pieces that
// ask groups of lines; double decides as for single rays.
#include <algorithm>
#include <cmath>

#include "render/trace/hierarchy_rays.h"

namespace lekalo::render {

namespace {

using Query = Hierarchy::Query;

// Rays that Embree takes at once.
constexpr size_t kPacket = PacketQuery::kMaxRays;
// Rays are taken through the hierarchy together if they begin this near to each other, in radii of the sphere, and
// their directions differ by no more; else one after the other.
constexpr float kTogether = 0.1f;
// The same for pieces, of which more is done for all rays at once.
constexpr float kTogetherByPieces = 0.3f;

float largest(float x, float y, float z) { return std::max(std::max(std::abs(x), std::abs(y)), std::abs(z)); }

// At most kPacket rays for Embree; `any` is false if none of them comes near the hierarchy.
struct Packet {
  alignas(32) int valid[kPacket];
  RTCRayHit8 rays;
  RTCIntersectContext context;
  bool any = false;
  bool together = true;
  double start[kPacket], slack[kPacket];  // as in Query

  // `most`: by which rays that are taken together differ.
  Packet(const Hierarchy::Parts& p, std::span<const Ray> from, float most = kTogether) {
    RTCRay8& to = rays.ray;
    float spread = 0;
    size_t first = kPacket;  // that is not empty
    const float per_radius = static_cast<float>(1 / p.radius);
    for (size_t i = 0; i < kPacket; ++i) {
      const Ray& ray = from[std::min(i, from.size() - 1)];
      const Stretch s = stretch_in(p, ray, ray.t_min, ray.t_max);
      valid[i] = i < from.size() && !s.empty ? -1 : 0;
      start[i] = s.start;
      slack[i] = s.slack;
      to.org_x[i] = static_cast<float>(s.from.x), to.org_y[i] = static_cast<float>(s.from.y);
      to.org_z[i] = static_cast<float>(s.from.z);
      to.dir_x[i] = static_cast<float>(ray.direction.x), to.dir_y[i] = static_cast<float>(ray.direction.y);
      to.dir_z[i] = static_cast<float>(ray.direction.z);
      to.tnear[i] = 0;
      to.tfar[i] = ray_end(s.end - s.start + s.slack);
      to.time[i] = 0;
      to.mask[i] = ~0u;
      to.id[i] = 0;
      to.flags[i] = 0;
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      if (!valid[i]) continue;
      first = std::min(first, i);
      const float turn = largest(to.dir_x[i] - to.dir_x[first], to.dir_y[i] - to.dir_y[first],
                                 to.dir_z[i] - to.dir_z[first]),
                  shift = largest(to.org_x[i] - to.org_x[first], to.org_y[i] - to.org_y[first],
                                  to.org_z[i] - to.org_z[first]);
      spread = std::max(spread, std::max(turn, per_radius * shift));
    }
    any = first < kPacket;
    together = spread <= most;
    rtcInitIntersectContext(&context);
    context.flags = together ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
};

// The triangle that a ray meets first, in float.
struct Met {
  const GeometryRecord* record = nullptr;
  int triangle = 0;
};

void meet_triangles(const Hierarchy::Parts& p, std::span<const Ray> rays, Met* met) {
  Packet packet(p, rays);
  if (!packet.any) return;
  rtcIntersect8(packet.valid, p.scene, &packet.context, &packet.rays);
  const RTCHit8& hit = packet.rays.hit;
  for (size_t i = 0; i < rays.size(); ++i)
    if (hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
      met[i] = {p.records[hit.geomID[i]].get(), static_cast<int>(hit.primID[i])};
      __builtin_prefetch(&met[i].record->leaf->mesh->triangles[met[i].triangle]);
    }
}

void fetch_corners(const PackedMesh& mesh, int triangle) {
  for (const uint32_t vertex : mesh.triangles[triangle].vertex) __builtin_prefetch(&mesh.vertices[vertex]);
}

// The nearest triangles of rays. While Embree is at one packet, memory brings the triangles of the packet before, and
// the corners of the one before that.
void meet_all(const Hierarchy::Parts& p, std::span<const Ray> rays, std::span<Hit> hits) {
  constexpr size_t kAtOnce = 3;
  Met met[kAtOnce][kPacket];
  const double slack = kBoxInflation * p.radius;
  const size_t packets = (rays.size() + kPacket - 1) / kPacket;
  const auto begin_of = [&](size_t packet) { return std::min(packet * kPacket, rays.size()); };
  for (size_t packet = 0; packet < packets + kAtOnce - 1; ++packet) {
    if (packet < packets) {
      const size_t begin = begin_of(packet), end = begin_of(packet + 1);
      for (size_t i = end; i < begin_of(packet + 2); ++i) {
        __builtin_prefetch(&rays[i]);
        __builtin_prefetch(&rays[i].t_max);
      }
      Met* const now = met[packet % kAtOnce];
      std::fill_n(now, kPacket, Met());
      meet_triangles(p, rays.subspan(begin, end - begin), now);
    }
    if (packet >= 1 && packet - 1 < packets)
      for (const Met& m : met[(packet - 1) % kAtOnce])
        if (m.record) fetch_corners(*m.record->leaf->mesh, m.triangle);
    if (packet < kAtOnce - 1) continue;
    const size_t ready = packet - (kAtOnce - 1);
    const Met* m = met[ready % kAtOnce];
    for (size_t i = begin_of(ready); i < begin_of(ready + 1); ++i, ++m) {
      const bool is_met = m->record && triangle_hit(*m->record->leaf->mesh, m->triangle, rays[i], hits[i]) &&
                          hits[i].t >= rays[i].t_min - slack;
      hits[i].instance = is_met ? m->record->leaf_number : -1;
    }
  }
}

// Rays through a scene of pieces, in packets where they go together; where not, nothing is done.
class PiecePackets {
 public:
  explicit PiecePackets(const Hierarchy::Parts& parts) : parts_(parts) {}

  // The nearest hits of at most kPacket rays among what the scene holds, in queries; false, and nothing is done, if the
  // rays do not go together.
  bool nearest(std::span<const Ray> rays, Hit* hits) { return trace(rays, hits); }
  bool occluded(std::span<const Ray> rays) { return trace(rays, nullptr); }
  Query& query(size_t ray) { return *queries_.queries[ray]; }

 private:
  // Most that do not are told by their directions before anything is made of them.
  static bool turn_apart(std::span<const Ray> rays) {
    return std::any_of(rays.begin() + 1, rays.end(), [&](const Ray& ray) {
      const Vec3 turn = glm::abs(ray.direction - rays[0].direction);
      return std::max(std::max(turn.x, turn.y), turn.z) > 2 * kTogetherByPieces;
    });
  }
  bool trace(std::span<const Ray> rays, Hit* hits) {
    if (!parts_.grouped_pieces || turn_apart(rays)) return false;
    Packet packet(parts_, rays, kTogetherByPieces);
    if (!packet.together) return false;
    queries_.leave = std::any_of(rays.begin(), rays.end(), [](const Ray& ray) { return ray.left_instance >= 0; });
    for (size_t i = 0; i < rays.size(); ++i) {
      Query& query = queries_.queries[i].emplace(rays[i]);
      begin(query, rays[i]);
      query.extent = parts_.extent;
      query.start = packet.start[i];
      query.slack = packet.slack[i];
      query.nearest = hits ? hits + i : nullptr;
      queries_.lines.set(static_cast<int>(i), rays[i], query.range);
    }
    if (!packet.any) return true;
    queries_.context = packet.context;
    if (hits)
      rtcIntersect8(packet.valid, parts_.scene, &queries_.context, &packet.rays);
    else
      rtcOccluded8(packet.valid, parts_.scene, &queries_.context, &packet.rays.ray);
    return true;
  }

  const Hierarchy::Parts& parts_;
  PacketQuery queries_;
};

}  // namespace

void Hierarchy::nearest(std::span<const Ray> rays, std::span<Hit> hits) const {
  const Parts& p = *parts_;
  if (!p.plain_triangles) {
    PiecePackets packets(p);
    for (size_t begin = 0; begin < rays.size(); begin += kPacket) {
      const std::span<const Ray> some = rays.subspan(begin, std::min(kPacket, rays.size() - begin));
      const bool together = packets.nearest(some, &hits[begin]);
      for (size_t i = 0; i < some.size(); ++i) {
        bool found = false;
        if (!together) {
          found = nearest(some[i], hits[begin + i]);
        } else {
          Query& query = packets.query(i);
          query.among.scene = false;
          if (!p.unbounded.empty()) run(query);
          found = query.found;
        }
        if (!found) hits[begin + i].instance = -1;
      }
    }
    return;
  }
  meet_all(p, rays, hits);
  for (size_t i = 0; i < rays.size() && !p.unbounded.empty(); ++i) {
    Query query(rays[i]);
    begin(query, rays[i]);
    query.among.scene = false;
    query.nearest = &hits[i];
    query.extent = p.extent;
    query.found = hits[i].instance >= 0;
    if (query.found) query.range.hi = query.end_behind(hits[i].t);
    run(query);
  }
}

bool Hierarchy::gains_by_lists() const { return parts_->plain_triangles || parts_->grouped_pieces; }

void Hierarchy::occluded(std::span<const Ray> rays, const Obstacles& among, std::span<bool> occluded) const {
  const Parts& p = *parts_;
  const Obstacles unbounded{p.unbounded.empty() ? 0 : among.listed, false};
  if (!p.plain_triangles || !among.scene) {
    PiecePackets packets(p);
    for (size_t begin = 0; begin < rays.size(); begin += kPacket) {
      const std::span<const Ray> some = rays.subspan(begin, std::min(kPacket, rays.size() - begin));
      const bool together = among.scene && packets.occluded(some);
      for (size_t i = 0; i < some.size(); ++i)
        occluded[begin + i] =
            together ? packets.query(i).found || this->occluded(some[i], unbounded) : this->occluded(some[i], among);
    }
    return;
  }
  for (size_t begin = 0; begin < rays.size(); begin += kPacket) {
    const size_t end = std::min(begin + kPacket, rays.size());
    Packet packet(p, rays.subspan(begin, end - begin));
    if (packet.any) rtcOccluded8(packet.valid, p.scene, &packet.context, &packet.rays.ray);
    for (size_t i = begin; i < end; ++i)
      occluded[i] =
          (packet.valid[i - begin] && packet.rays.ray.tfar[i - begin] < 0) || this->occluded(rays[i], unbounded);
  }
}

}  // namespace lekalo::render
