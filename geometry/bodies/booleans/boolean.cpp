#include "geometry/bodies/booleans/boolean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/bodies/booleans/arrangement.h"
#include "geometry/bodies/booleans/coincidence.h"
#include "geometry/bodies/booleans/gluing.h"
#include "geometry/bodies/booleans/imprint.h"
#include "geometry/bodies/booleans/merging.h"
#include "geometry/bodies/booleans/turned_ball.h"
#include "geometry/queries/closest/distance.h"
#include "geometry/queries/closest/position.h"
#include "geometry/queries/rays/line_intersections.h"

namespace lekalo::geometry {

namespace {

// Where a part of a face lies: beside the other body, or on a face of it whose normal is the same or the opposite.
enum class Class { inside, outside, same, opposite };

struct Region {
  int face;
  PlaneRegion plane;
  Vec2 place;  // a point in it
  Vec3 point;
  Class where;
};

// The region of a face by its loops alone, also where it fills its surface.
std::shared_ptr<const TrimRegion> trim_by_loops(const Body& body, int f) {
  std::vector<std::vector<TrimRegion::Part>> loops;
  for (const int loop : body.faces[f].loops) {
    loops.emplace_back();
    for (const int c : body.loops[loop].coedges)
      loops.back().push_back({body.coedges[c].image, body.coedges[c].forward});
  }
  return std::make_shared<const TrimRegion>(loops, body.faces[f].surface->periods());
}

class Boolean {
 public:
  // An open second body stands for the half of space that its normals look away from.
  Boolean(BooleanOperation operation, const Body& a, const Body& b)
      : operation_(operation),
        turned_{turned_ball(a, b), turned_ball(b, a)},
        bodies_{turned_[0] ? &*turned_[0] : &a, turned_[1] ? &*turned_[1] : &b},
        imprint_(imprint(*bodies_[0], *bodies_[1])) {}

  Body body() {
    std::vector<FacePiece> pieces;
    for (const int side : {0, 1}) {
      classify(side);
      for (size_t f = 0; f < bodies_[side]->faces.size(); ++f) add_pieces(side, static_cast<int>(f), pieces);
    }
    merge_pieces(pieces, imprint_);
    if (pieces.empty()) throw BooleanError("nothing is left", bounds(*bodies_[0]).center(), true);
    Body result = glued(pieces, imprint_);
    if (const auto wrong = result.violations(); !wrong.empty())
      throw BooleanError(
          fmt::format("the result is not a valid body: {} ({})", wrong.front().condition, wrong.front().entity),
          bounds(result).center());
    return result;
  }

 private:
  const std::vector<DirectedCurve>& curves(int side, int f) const { return imprint_.faces[side][f].curves; }

  void classify(int side) {
    const Body &own = *bodies_[side], &other = *bodies_[1 - side];
    const LineIntersector lines(other);
    const bool open = !bodies_[1]->is_closed();
    std::vector<std::shared_ptr<const TrimRegion>> trims(other.faces.size());
    for (size_t f = 0; f < own.faces.size(); ++f) {
      const SurfacePtr& surface = own.faces[f].surface;
      for (PlaneRegion& plane : regions_of(curves(side, static_cast<int>(f)), *surface)) {
        Region region{static_cast<int>(f), std::move(plane), Vec2(0), Vec3(0), Class::outside};
        const auto decide = [&](const Vec2& uv) {
          region.place = uv, region.point = surface->point(uv.x, uv.y);
          if (const auto on = on_coincident(side, region, trims))
            region.where = *on;
          else if (lies_on(region.point, lines))
            return false;
          else if (open && side == 0)
            region.where = side_of_sheet(region);
          else
            region.where = is_inside(region.point, lines) ? Class::inside : Class::outside;
          return true;
        };
        point_inside(curves(side, static_cast<int>(f)), region.plane, decide);
        regions_[side].push_back(std::move(region));
      }
    }
    check_neighbours(side);
  }

  // Where a face touches the other body along a line that does not divide it, points of that line tell nothing.
  bool lies_on(const Vec3& p, const LineIntersector& other) const {
    const Line line{p, glm::normalize(Vec3(0.3, 0.5, 0.8))};
    return !other.all_hits(line, {-imprint_.tolerance, imprint_.tolerance}).empty();
  }

  std::optional<Class> on_coincident(int side, const Region& region,
                                     std::vector<std::shared_ptr<const TrimRegion>>& trims) const {
    const Body &own = *bodies_[side], &other = *bodies_[1 - side];
    for (const int g : imprint_.faces[side][region.face].coincident) {
      const Vec2 uv = parameters_on(other.faces[g].surface, region.point);
      if (!trims[g]) trims[g] = trim_by_loops(other, g);
      // Not the nearest point of a border.
      if (glm::length(other.faces[g].surface->point(uv.x, uv.y) - region.point) > 10 * imprint_.tolerance) continue;
      if (!trims[g]->contains(uv.x, uv.y)) continue;
      const Vec3 normal = own.normal(region.face, region.place.x, region.place.y);
      return glm::dot(normal, other.normal(g, uv.x, uv.y)) > 0 ? Class::same : Class::opposite;
    }
    return std::nullopt;
  }

  // By the nearest point of the sheet: on an edge of it by the sum of the normals beside it.
  Class side_of_sheet(const Region& region) const {
    const Body& sheet = *bodies_[1];
    const Distance found = distance(region.point, &sheet, DistanceMinima::nearest);
    const DistancePlace& at = found.minima.front().b;
    Vec3 normal(0);
    if (at.kind == DistancePlace::Kind::face) {
      normal = sheet.normal(at.index, at.u, at.v);
    } else {
      for (size_t f = 0; f < sheet.faces.size(); ++f) {
        const bool beside = std::any_of(sheet.faces[f].loops.begin(), sheet.faces[f].loops.end(), [&](int loop) {
          return std::any_of(sheet.loops[loop].coedges.begin(), sheet.loops[loop].coedges.end(), [&](int c) {
            const Edge& edge = sheet.edges[sheet.coedges[c].edge];
            return at.kind == DistancePlace::Kind::edge
                       ? sheet.coedges[c].edge == at.index
                       : glm::length(sheet.vertices[edge.start].point - at.point) <= imprint_.tolerance ||
                             glm::length(sheet.vertices[edge.end].point - at.point) <= imprint_.tolerance;
          });
        });
        if (!beside) continue;
        const Vec2 uv = parameters_on(sheet.faces[f].surface, at.point);
        normal += sheet.normal(static_cast<int>(f), uv.x, uv.y);
      }
    }
    const double height = glm::dot(region.point - at.point, normal);
    if (!(std::abs(height) > imprint_.tolerance * glm::length(normal)))
      throw BooleanError("on which side of the sheet a face lies is not decided", region.point);
    return height < 0 ? Class::inside : Class::outside;
  }

  // A region that is next to another across an edge that is not on the other body lies on the same side of it.
  void check_neighbours(int side) const {
    std::map<int, const Region*> region_at;
    for (const Region& region : regions_[side])
      for (const auto& loop : region.plane.loops)
        for (const int k : loop) {
          const DirectedCurve& curve = curves(side, region.face)[k];
          const Strand& strand = imprint_.strands[curve.strand];
          if (strand.kind == EdgeKind::pole || imprint_.lies_on[curve.strand][1 - side]) continue;
          const auto [found, is_new] = region_at.try_emplace(curve.strand, &region);
          if (!is_new && found->second->where != region.where)
            throw BooleanError("whether a part of a face is inside of the other body is not decided", region.point);
        }
  }

  bool is_kept(int side, Class where) const {
    switch (where) {
      case Class::inside:
        return operation_ == BooleanOperation::intersect || (operation_ == BooleanOperation::subtract && side == 1);
      case Class::outside:
        return operation_ == BooleanOperation::unite || (operation_ == BooleanOperation::subtract && side == 0);
      case Class::same:
        return side == 0 && operation_ != BooleanOperation::subtract;
      case Class::opposite:
        return side == 0 && operation_ == BooleanOperation::subtract;
    }
    return false;
  }

  // What is left of a face, its parts joined again where only a curve of the other body has divided them.
  void add_pieces(int side, int f, std::vector<FacePiece>& pieces) const {
    std::map<int, int> uses;
    for (const Region& region : regions_[side])
      if (region.face == f && is_kept(side, region.where))
        for (const auto& loop : region.plane.loops)
          for (const int k : loop)
            if (curves(side, f)[k].inner) ++uses[curves(side, f)[k].strand];
    std::vector<DirectedCurve> kept;
    for (const Region& region : regions_[side]) {
      if (region.face != f || !is_kept(side, region.where)) continue;
      for (const auto& loop : region.plane.loops)
        for (const int k : loop) {
          const DirectedCurve& curve = curves(side, f)[k];
          if (!curve.inner || uses[curve.strand] < 2) kept.push_back(curve);
        }
    }
    if (kept.empty()) return;
    const Face& face = bodies_[side]->faces[f];
    const std::vector<PlaneRegion> regions = regions_of(kept, *face.surface);
    for (size_t r = 0; r < regions.size(); ++r) {
      FacePiece piece;
      piece.surface = face.surface;
      piece.forward = face.forward != (side == 1 && operation_ == BooleanOperation::subtract);
      piece.origin = face.origin;
      if (regions.size() > 1) piece.origin = part_of(face.origin, static_cast<int>(r));
      for (const auto& loop : regions[r].loops) {
        piece.loops.emplace_back();
        for (const int k : loop) piece.loops.back().push_back(kept[k]);
      }
      pieces.push_back(std::move(piece));
    }
  }

  static Origin part_of(const Origin& origin, int number) {
    Origin result = origin;
    if (origin.index >= 0) result.role = fmt::format("{}.{}", origin.role, origin.index);
    result.index = number;
    return result;
  }

  BooleanOperation operation_;
  std::array<std::optional<Body>, 2> turned_;
  std::array<const Body*, 2> bodies_;
  Imprint imprint_;
  std::array<std::vector<Region>, 2> regions_;
};

}  // namespace

BooleanError::BooleanError(const std::string& message, const Vec3& at, bool is_empty)
    : std::runtime_error(is_empty ? message
                                  : fmt::format("{}, near ({:.6g}, {:.6g}, {:.6g})", message, at.x, at.y, at.z)),
      place(at),
      empty(is_empty) {}

Body boolean(BooleanOperation operation, const Body& a, const Body& b) {
  for (const Body* body : {&a, &b})
    if (!body->is_closed()) throw std::invalid_argument("the body is not closed: it has no inside");
  return Boolean(operation, a, b).body();
}

Body cut(const Body& body, const Body& sheet, bool keep_inner) {
  if (!body.is_closed()) throw std::invalid_argument("the body is not closed: it has no inside");
  if (sheet.is_closed()) throw std::invalid_argument("the sheet is closed: take a difference or intersection");
  return Boolean(keep_inner ? BooleanOperation::intersect : BooleanOperation::subtract, body, sheet).body();
}

Body inverted(const Body& body) {
  Body result = body;
  for (Face& face : result.faces) face.forward = !face.forward;
  for (Loop& loop : result.loops) std::reverse(loop.coedges.begin(), loop.coedges.end());
  for (Coedge& coedge : result.coedges) coedge.forward = !coedge.forward;
  return result;
}

}  // namespace lekalo::geometry
