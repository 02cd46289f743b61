// Constructive solid geometry: union, intersection and difference of closed shapes, to any depth (Golovanov 2016, 5.1
// and 6.1 speak of the bodies; the rule for lines is Roth's, "Ray Casting for Modeling Solids", 1982).
//
// A line crosses each leaf of the tree in and out by turns; the tree says of every stretch between crossings whether it
// is inside. A crossing of a leaf is one of the whole where that changes. What cannot matter is not looked at: the
// operands beyond where the first of an intersection or difference lies, and parts of the tree whose boxes the line
// misses.
//
// Crossings of several leaves nearer than a tolerance (kSameHit of the size) are one place: operands that share a face
// are decided there together. So union and intersection keep one face of two that coincide, that of the first operand;
// in A minus B a shared face vanishes; two bodies that touch from outside unite without a wall between them.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "geometry/body.h"
#include "geometry/shape.h"
#include "geometry/shapes/csg/convex_solid.h"
#include "geometry/spatial/box_tree.h"

namespace lekalo::geometry {

class Csg final : public Shape {
 public:
  enum class Operation { unite, intersect, subtract };

  // A tree of more leaves takes too much memory; one name used twice in each of twenty operations has a million.
  static constexpr int kMaxLeaves = 100'000;

  // The operands, at least one, must be closed; subtract takes all others from the first. Throws std::invalid_argument
  // for an open operand, for more than kMaxLeaves, and where nothing can be left since the operands' boxes do not
  // meet.
  // `names`: what the operands are called in the names of the result's faces; none, or one for each.
  Csg(Operation operation, const std::vector<ShapePtr>& operands, std::vector<std::string> names = {});

  Operation operation() const { return nodes_[0].operation; }
  const std::vector<ShapePtr>& operands() const { return operands_; }
  const std::vector<std::string>& names() const { return names_; }
  // The same solid by its faces: made at the first question (bodies/booleans/solid_boundary.h) and kept.
  BodyPtr boundary(const std::function<BodyPtr(const Csg&)>& make) const;
  // Of the whole tree: operands that are no operations themselves.
  int leaf_count() const { return static_cast<int>(leaves_.size()); }

  Box3 bounds() const override { return nodes_[0].box; }
  // The parameters of hits on leaves with closed forms are zero; point() finds them.
  void all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const override;
  bool first_hit(const Line& line, const Interval& t, SurfaceHit& hit) const override;
  ShapePoint point(const SurfaceHit& hit, const Vec3& near) const override { return point_of(hit, near, true); }
  ShapePoint bare_point(const SurfaceHit& hit, const Vec3& near) const override { return point_of(hit, near, false); }
  std::optional<Mat3> shape_operator(const SurfaceHit& hit, const Vec3& near) const override;
  bool is_closed() const override { return true; }
  LineMethod method() const override { return {"CSG of leaves", leaves_.size(), leaves_.size() * sizeof(Leaf)}; }
  bool begins_inside(const Line& line) const override;
  // Those of the leaves, as far as the boxes of what they are operands of let them show.
  std::vector<SurfacePart> surface_parts() const override;
  Box3 piece_box(const PieceOfSurface& piece) const override;
  PieceOfSurface piece_of(const SurfaceHit& hit) const override;

 private:
  // Nodes stand behind their parent; the root is the first. A node is inside where at least `needed` of its operands
  // are, those that it takes away counted where they are outside.
  struct Node {
    Operation operation = Operation::unite;
    std::vector<int> operands;  // of an operation: numbers of nodes
    int leaf = -1;              // else
    int parent = -1;
    bool taken_away = false;  // by its parent
    bool convex = false;      // a leaf with a closed form, or an intersection of such
    int needed = 1;
    bool is_enough = false;  // of a leaf or convex node: what is inside of it alone is inside of all
    Box3 box = Box3::everything();
    BoxTree tree;  // of many operands that need not all be looked at: operands[first_in_tree] and on
    int first_in_tree = 0;
  };
  struct Leaf {
    ShapePtr shape;
    std::optional<ConvexSolid> convex;  // the same in closed form
    bool turned;                        // taken away: its normals look into the result
    int node;
    int first_part = 0;  // of the whole's
  };
  struct Crossing;
  struct Stretch;
  struct Search;

  ShapePoint point_of(const SurfaceHit& hit, const Vec3& near, bool parameters) const;
  // A hit as the leaf numbers its faces.
  SurfaceHit of_leaf(SurfaceHit hit) const {
    hit.face /= leaf_count();
    return hit;
  }
  int append(const ShapePtr& operand, int parent, bool taken_away, bool turned);
  void finish(Node& node);
  // Adds the crossings of all leaves and convex nodes that may matter where t is in the range, and returns where in it
  // the node may be inside; adds none where that is empty. One that is inside where t goes to minus infinity is crossed
  // there.
  Interval gather(int number, const Interval& range, Search& search) const;
  Interval gather_convex(int number, const Interval& range, Search& search) const;
  Interval gather_leaf(int number, const Interval& range, Search& search) const;
  // Where the line is inside a convex node; false if nowhere.
  bool stretch(const Node& node, const Search& search, Stretch& inside) const;
  void turn(int node, int* inside) const;
  Box3 shown_of(const Box3& box, const Leaf& leaf) const;
  // Calls visit(hit) for the hits in order until it returns false.
  template <class Visit>
  void walk(const Line& line, const Interval& t, Visit&& visit) const;

  std::vector<ShapePtr> operands_;
  std::vector<std::string> names_;
  mutable std::once_flag boundary_made_;
  mutable BodyPtr boundary_;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<int> outside_;  // how many operands count, by node, where all leaves are outside
  double size_ = 1;
  double farthest_ = 0;  // coordinate of the nodes' boxes
};

}  // namespace lekalo::geometry
