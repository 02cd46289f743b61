// Constructive solid geometry: union, intersection and difference of closed shapes, to any depth (Golovanov 2016, 5.1
// and 6.1 speak of the bodies; the rule for lines is Roth's, "Ray Casting for Modeling Solids", 1982).
//
// A line crosses each leaf of the tree in and out by turns; the tree says of every stretch between crossings whether it
// is inside. A crossing of a leaf is one of the whole where that changes.
//
// Crossings of several leaves nearer than a tolerance (kSameHit of the size) are one place: operands that share a face
// are decided there together. So union and intersection keep one face of two that coincide, that of the first operand;
// in A minus B a shared face vanishes; two bodies that touch from outside unite without a wall between them.
#pragma once

#include "geometry/queries/box_tree.h"
#include "geometry/shape.h"

namespace lekalo::geometry {

class Csg final : public Shape {
 public:
  enum class Operation { unite, intersect, subtract };

  // The operands, at least one, must be closed; subtract takes all others from the first. Throws std::invalid_argument
  // for an open operand, and where nothing can be left since the operands' boxes do not meet.
  Csg(Operation operation, const std::vector<ShapePtr>& operands);

  Operation operation() const { return nodes_[0].operation; }
  const std::vector<ShapePtr>& operands() const { return operands_; }

  Box3 bounds() const override { return box_; }
  void all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const override;
  ShapePoint point(const SurfaceHit& hit, const Vec3& near) const override;
  bool is_closed() const override { return true; }
  LineMethod method() const override { return {"CSG of leaves", leaves_.size(), leaves_.size() * sizeof(Leaf)}; }
  bool begins_inside(const Line& line) const override;

 private:
  // Nodes stand behind their parent; the root is the first.
  struct Node {
    Operation operation;
    std::vector<int> operands;  // of an operation: numbers of nodes
    int leaf;                   // else -1
  };
  struct Leaf {
    ShapePtr shape;
    bool turned;  // taken away: its normals look into the result
  };
  struct Scratch;

  int leaf_count() const { return static_cast<int>(leaves_.size()); }
  int append(const ShapePtr& operand, bool turned);
  bool is_inside(int node, const std::vector<char>& inside_leaf) const;

  std::vector<ShapePtr> operands_;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<int> bounded_, unbounded_;  // leaves
  BoxTree tree_;                          // of the bounded ones
  Box3 box_;
  double size_ = 1;
};

}  // namespace lekalo::geometry
