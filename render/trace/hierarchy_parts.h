// What a Hierarchy is made of, shared by what builds it (hierarchy.cpp) and what runs queries (hierarchy_query.cpp).
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <optional>

#include "geometry/queries/rays/line_group.h"
#include "geometry/tolerances.h"
#include "render/trace/hierarchy.h"

namespace lekalo::render {

// The one device of the process, made when it is first asked for; Embree's scenes share its thread pool. Throws
// std::runtime_error if Embree cannot start.
RTCDevice device();

// Boxes are larger than what they hold by this part of the bounding sphere's radius: it covers the rounding of the
// ray's origin and direction to float and Embree's own arithmetic (docs/internals/rays.md).
inline constexpr double kBoxInflation = 4e-7;

// A child where it is placed.
struct Instance {
  std::shared_ptr<const Hierarchy> child;
  Affine to_parent, to_child;
  int64_t first_leaf = 0;  // number of its first leaf
  int object = 0;          // as in Hierarchy::add_instance
};

// What an Embree geometry stands for.
struct GeometryRecord {
  enum class Kind { target, mesh, shape, instances } kind = Kind::target;
  const Leaf* leaf = nullptr;
  int64_t leaf_number = 0;
  int face = 0;  // of a target
  const geometry::LineTarget* target = nullptr;
  int count = 1;  // pieces of a target, or instances
  // Pieces that follow each other, neighbours mostly, and are one primitive to Embree: two where there are many (at
  // most GroupHits::kMaxPieces).
  int together = 1;
  int primitive_count() const { return (count + together - 1) / together; }
  int first_piece(unsigned primitive) const { return together * static_cast<int>(primitive); }
  int end_of_pieces(unsigned primitive) const { return std::min(first_piece(primitive) + together, count); }
  bool bare = false;   // the nearest hit needs no parameters
  bool whole = false;  // a target that all rays see, without clips
  std::vector<Instance> instances;
  int object = 0;
  const Hierarchy::Parts* parts = nullptr;
};

struct Hierarchy::Parts {
  std::vector<std::unique_ptr<Leaf>> leaves;
  std::vector<std::unique_ptr<GeometryRecord>> records;  // by Embree geometry number, then the unbounded ones
  struct Piece {
    const GeometryRecord* record;
    int number;
    Box3 box;
  };
  std::vector<Piece> unbounded;
  bool has_columns = false;  // the boxes of some of them are bounded in some direction
  // The pieces of a scene of few, in place of an Embree scene, whose overhead would be most of its time.
  std::vector<Piece> few;
  Box3 few_box;                 // of all of them
  std::vector<Instance> added;  // instances, until they are sorted into records
  struct Numbered {
    int64_t first;
    const GeometryRecord* record;
    const Instance* instance;  // null: a leaf
  };
  std::vector<Numbered> numbers;  // one entry for each leaf or instance, by first number
  int64_t leaf_count = 0;
  Box3 box;
  Vec3 center{0};
  double radius = 0;
  double extent = 0;  // the largest distance from the origin of coordinates
  size_t pieces = 0, triangles = 0, bytes = 0;
  // The scene holds nothing but triangles that all rays see, so that Embree alone finds candidates.
  bool plain_triangles = false;
  // The scene holds pieces of surfaces, which are asked for groups of lines, and no triangles; and Embree takes eight
  // rays at once.
  bool grouped_pieces = false;
  RTCScene scene = nullptr;

  ~Parts() {
    if (scene) rtcReleaseScene(scene);
  }

  void record_instances();
  bool list_few();
  void build_scene();
  RTCBounds float_bounds(const Box3& box) const;
};

// Callbacks of Embree for pieces, shapes and instances, and for single triangles: they collect every triangle along
// the line, or hide those that this kind of ray does not see or that are clipped away.
void intersect_callback(const RTCIntersectFunctionNArguments* args);
void occluded_callback(const RTCOccludedFunctionNArguments* args);
void triangle_filter(const RTCFilterFunctionNArguments* args);

// The order of hits along a line, ties by (instance, face, piece).
inline bool comes_before(const Hit& a, const Hit& b) {
  if (a.t != b.t) return a.t < b.t;
  if (a.instance != b.instance) return a.instance < b.instance;
  if (a.face != b.face) return a.face < b.face;
  return a.piece < b.piece;
}

// A query in the space of one hierarchy. Embree hands its address back to the callbacks.
struct Hierarchy::Query {
  RTCIntersectContext context;
  geometry::PreparedLine prepared;
  geometry::Interval range{0, geometry::kInfinity};  // up to where hits may still be the nearest
  double extent = 0;                                 // of all that is asked, from the origin of coordinates
  double start = 0;                                  // the float ray begins here
  double slack = 0;                                  // float uncertainty of t
  uint32_t kind = 1;
  int64_t leaf_offset = 0;
  int64_t left_instance = -1;  // as in Ray, and what follows
  int left_face = 0, left_piece = 0;
  bool left_for_good = false;
  Obstacles among;
  bool found = false;
  // What is wanted: the nearest hit, all hits, or, with neither, whether there is one.
  Hit* nearest = nullptr;
  std::vector<Hit>* all = nullptr;

  explicit Query(const geometry::Line& line) : prepared(line) {}
  const geometry::Line& line() const { return prepared.line(); }
  // True if the ray left this face, or this piece of it, and does not meet it again.
  bool has_left(const GeometryRecord& record) const { return left_for_good && is_left(record); }
  bool has_left(const GeometryRecord& record, int piece) const {
    return is_left(record) &&
           (left_for_good || (piece == left_piece && record.target->meets_once(piece, line().direction)));
  }
  bool is_done() const { return found && !nearest && !all; }

  void accept(const Hit& hit) {
    if (nearest)
      accept_nearest(hit);
    else if (all)
      all->push_back(hit);
    found = true;
  }
  // The same where the nearest hit is wanted. Of objects that lie on one another there the last listed shows, as if
  // painted over the others.
  void accept_nearest(const Hit& hit) {
    if (found && !(lies_on_nearest(hit) ? hit.instance > nearest->instance : comes_before(hit, *nearest))) return;
    found = true;
    *nearest = hit;
    range.hi = std::min(range.hi, end_behind(hit.t));
  }
  // Behind all that lies on what is met at t.
  double end_behind(double t) const { return t + geometry::kHitRounding * (extent + std::abs(t)); }

 private:
  bool lies_on_nearest(const Hit& hit) const {
    const double apart = std::abs(hit.t - nearest->t);
    if (hit.instance == nearest->instance || hit.t + apart > end_behind(hit.t)) return false;
    const Vec3 &o = line().origin, &d = line().direction;
    return apart <= geometry::kHitRounding * (glm::length(o) / glm::length(d) + std::abs(hit.t));
  }
  bool is_left(const GeometryRecord& record) const {
    return record.kind == GeometryRecord::Kind::target && leaf_offset + record.leaf_number == left_instance &&
           record.face == left_face;
  }
};

// Queries of rays that Embree takes at once.
struct PacketQuery {
  static constexpr size_t kMaxRays = geometry::LineGroup::kMaxLines;
  RTCIntersectContext context;  // first: Embree hands its address back
  geometry::LineGroup lines;
  bool leave;  // some of the rays have left a face or piece
  std::optional<Hierarchy::Query> queries[kMaxRays];
};

// What Embree found for the query: nothing but triangles, which double decides against the nearest of the others.
void accept_triangle(const Hierarchy::Parts& p, unsigned geometry, unsigned triangle, Hierarchy::Query& query);

}  // namespace lekalo::render
