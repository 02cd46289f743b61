// The certified double-precision solver line against surfaces and bodies: all hits.
//
// A surface becomes a list of pieces with boxes. A surface with a line formula is one piece; the others are rational
// Bezier patches, cut until each is nearly planar, and solved by subdivision of the two plane equations of the line in
// Bernstein form: a rectangle of parameters is discarded only if its convex hull excludes the line, accepted only if an
// interval Newton test proves a single root in it, and split otherwise. Measures, ray queries, inside/outside tests,
// drawings and rendering all use this solver; rendering only puts its own hierarchy over the pieces' boxes.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "geometry/body.h"
#include "geometry/queries/rays/line_basis.h"
#include "geometry/shape.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

class GroupHits;
class LineGroup;
class TrimRegion;

// A surface prepared for lines. Pieces are independent of each other; hits of a line on a border shared by two pieces
// may be reported by both (merge_hits removes the second).
class LineTarget {
 public:
  virtual ~LineTarget() = default;
  virtual int piece_count() const = 0;
  virtual Box3 piece_bounds(int piece) const = 0;
  // Adds the hits with t in the interval, in natural parameters, inside the domain (and the trims, if any).
  virtual void piece_hits(int piece, const PreparedLine& line, const Interval& t, LineHits& hits) const = 0;
  // Hits of lines that are asked together on the pieces from `first` to before `end`, at most GroupHits::kMaxPieces,
  // in the lines' ranges: line i on the k-th piece if bit i of asked[k] is set. What is not told at once is left open.
  virtual void group_hits(int first, int end, const unsigned* asked, const LineGroup& lines, GroupHits& hits) const;
  // True if certainly no line of that direction meets the piece twice: a ray that leaves a point of the piece does not
  // come back to it.
  virtual bool meets_once(int, const Vec3&) const { return false; }
  virtual const Surface& surface() const = 0;
  // Point and first derivatives of the surface at a hit on the piece, which lies at `near` but for rounding.
  virtual SurfaceJet jet_at(int /*piece*/, double u, double v, const Vec3& near) const {
    return surface().evaluate_near(near, u, v, 1);
  }
  virtual size_t memory() const = 0;  // bytes
  virtual std::string_view method() const = 0;
};

// Unbounded surfaces give one piece with an unbounded box. `trim` may be null. Cells smaller than `min_area` are not
// cut further, which costs time and saves memory, nothing else.
std::unique_ptr<LineTarget> make_line_target(SurfacePtr surface, std::shared_ptr<const TrimRegion> trim = nullptr,
                                             double min_area = 0);

// All hits of a line with a surface or body, sorted by t, one for each crossing: a small hierarchy over the pieces.
class LineIntersector {
 public:
  explicit LineIntersector(SurfacePtr surface);
  explicit LineIntersector(const Body& body);
  ~LineIntersector();
  LineIntersector(LineIntersector&&) noexcept;
  LineIntersector& operator=(LineIntersector&&) noexcept;

  std::vector<SurfaceHit> all_hits(const Line& line, const Interval& t = {-kInfinity, kInfinity}) const;
  // The same, added to a list.
  void add_all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Sorts hits of one surface or closed body by t and removes those that are one crossing reported by two neighbours:
// nearer than kSameHit of the object's size (more where the line is shallow) and crossing in the same direction; on one
// surface, neighbours by their parameters too. `normal` gives the outward normal at a hit, `surface` the surface whose
// parameters it has; null: it has none.
// Only the hits from the `first` on are looked at.
void merge_hits(std::vector<SurfaceHit>& hits, const Line& line, double size,
                const std::function<Vec3(const SurfaceHit&)>& normal,
                const std::function<const Surface*(const SurfaceHit&)>& surface, size_t first = 0);

// Line targets of a body's faces, trims included, in the order of its faces.
std::vector<std::unique_ptr<LineTarget>> make_line_targets(const Body& body, double min_area = 0);

}  // namespace lekalo::geometry
