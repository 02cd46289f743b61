#include "geometry/shapes/csg.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "geometry/describe.h"
#include "geometry/shapes/body_shape.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

Box3 common(const Box3& a, const Box3& b) { return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)}; }

}  // namespace

Csg::Csg(Operation operation, const std::vector<ShapePtr>& operands) : operands_(operands) {
  if (operands.empty()) throw std::invalid_argument("there is nothing to combine");
  nodes_.push_back({operation, {}, -1});
  for (size_t k = 0; k < operands.size(); ++k) {
    const Box3 box = operands[k]->bounds();
    const int operand = append(operands[k], operation == Operation::subtract && k > 0);
    nodes_[0].operands.push_back(operand);
    if (k == 0)
      box_ = box;
    else if (operation == Operation::unite)
      box_.include(box);
    else if (operation == Operation::intersect)
      box_ = common(box_, box);
  }
  if (box_.empty()) throw std::invalid_argument("the operands have nothing in common: nothing is left");
  std::vector<Box3> boxes;
  Box3 all;
  for (int leaf = 0; leaf < leaf_count(); ++leaf) {
    const Box3 box = leaves_[leaf].shape->bounds();
    (box.bounded() ? bounded_ : unbounded_).push_back(leaf);
    if (!box.bounded()) continue;
    boxes.push_back(box);
    all.include(box);
  }
  tree_ = BoxTree(boxes);
  if (!all.empty()) size_ = all.diameter();
}

// The trees of operands that are operations themselves are taken apart, so that all leaves meet in one list.
int Csg::append(const ShapePtr& operand, bool turned) {
  if (!operand->is_closed()) throw std::invalid_argument("an operand is not closed: it has no inside");
  const int number = static_cast<int>(nodes_.size());
  const auto* tree = dynamic_cast<const Csg*>(operand.get());
  if (!tree) {
    nodes_.push_back({Operation::unite, {}, leaf_count()});
    leaves_.push_back({operand, turned});
    return number;
  }
  const int first_leaf = leaf_count();
  for (Node node : tree->nodes_) {
    for (int& child : node.operands) child += number;
    if (node.leaf >= 0) node.leaf += first_leaf;
    nodes_.push_back(std::move(node));
  }
  for (Leaf leaf : tree->leaves_) leaves_.push_back({leaf.shape, leaf.turned != turned});
  return number;
}

bool Csg::is_inside(int number, const std::vector<char>& inside_leaf) const {
  const Node& node = nodes_[number];
  if (node.leaf >= 0) return inside_leaf[node.leaf] != 0;
  // The first operand that decides ends the search: an inside one of a union, an outside one of an intersection, of a
  // difference the first if outside, another if inside.
  for (size_t k = 0; k < node.operands.size(); ++k) {
    const bool inside = is_inside(node.operands[k], inside_leaf);
    if (node.operation == Operation::unite && inside) return true;
    if (node.operation == Operation::intersect && !inside) return false;
    if (node.operation == Operation::subtract && inside != (k == 0)) return false;
  }
  return node.operation != Operation::unite;
}

// Room for one line, kept for the next; a leaf that holds a tree of its own takes another.
struct Csg::Scratch {
  struct Crossing {
    double t;
    int leaf;
    SurfaceHit hit;
  };
  std::vector<SurfaceHit> hits;
  std::vector<Crossing> crossings;
  std::vector<char> inside;

  class Loan {
   public:
    Loan() {
      if (free_.empty()) {
        scratch_ = std::make_unique<Scratch>();
      } else {
        scratch_ = std::move(free_.back());
        free_.pop_back();
      }
    }
    ~Loan() { free_.push_back(std::move(scratch_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    Scratch* operator->() { return scratch_.get(); }

   private:
    static thread_local std::vector<std::unique_ptr<Scratch>> free_;
    std::unique_ptr<Scratch> scratch_;
  };
};
thread_local std::vector<std::unique_ptr<Csg::Scratch>> Csg::Scratch::Loan::free_;

void Csg::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  Scratch::Loan scratch;
  auto& crossings = scratch->crossings;
  crossings.clear();
  scratch->inside.assign(leaves_.size(), 0);
  const double length = glm::length(line.direction);
  const auto tolerance = [&](double at) { return kSameHit * size_ / length + 4e-16 * std::abs(at); };
  // What lies before the interval decides what is inside where it begins, and a crossing just behind its end may belong
  // to one before it.
  const Interval whole{-kInfinity, t.hi < kInfinity ? t.hi + tolerance(t.hi) : t.hi};
  const auto cross = [&](int leaf) {
    scratch->hits.clear();
    leaves_[leaf].shape->all_hits(line, whole, scratch->hits);
    for (const SurfaceHit& hit : scratch->hits) crossings.push_back({hit.t, leaf, hit});
  };
  for (const int leaf : unbounded_) {
    scratch->inside[leaf] = leaves_[leaf].shape->begins_inside(line);
    cross(leaf);
  }
  tree_.along(line, whole, [&](int k) { cross(bounded_[k]); });
  std::sort(crossings.begin(), crossings.end(), [](const Scratch::Crossing& a, const Scratch::Crossing& b) {
    return a.t != b.t ? a.t < b.t : a.leaf < b.leaf;
  });

  bool inside = is_inside(0, scratch->inside);
  for (size_t first = 0, last; first < crossings.size(); first = last) {
    const double end = crossings[first].t + tolerance(crossings[first].t);
    for (last = first; last < crossings.size() && crossings[last].t <= end; ++last)
      scratch->inside[crossings[last].leaf] ^= 1;
    const bool before = inside;
    inside = is_inside(0, scratch->inside);
    if (inside == before) continue;
    // The face of the first operand that was crossed in this sense.
    const Scratch::Crossing* best = nullptr;
    for (size_t k = first; k < last; ++k) {
      const Scratch::Crossing& one = crossings[k];
      const bool entered = (scratch->inside[one.leaf] != 0) != leaves_[one.leaf].turned;
      if (entered == inside && (!best || one.leaf < best->leaf)) best = &one;
    }
    if (!best || !t.contains(best->t)) continue;
    SurfaceHit hit = best->hit;
    hit.face = best->leaf + leaf_count() * hit.face;
    hits.push_back(hit);
  }
}

ShapePoint Csg::point(const SurfaceHit& hit, const Vec3& near) const {
  const Leaf& leaf = leaves_[hit.face % leaf_count()];
  SurfaceHit of_leaf = hit;
  of_leaf.face = hit.face / leaf_count();
  ShapePoint point = leaf.shape->point(of_leaf, near);
  if (leaf.turned) point.normal = -point.normal;
  return point;
}

bool Csg::begins_inside(const Line& line) const {
  std::vector<char> inside(leaves_.size());
  for (const int leaf : unbounded_) inside[leaf] = leaves_[leaf].shape->begins_inside(line);
  return is_inside(0, inside);
}

namespace {

// The closed shape that a field's item stands for.
ShapePtr operand(const std::any& thing, const std::string& field) {
  if (const auto* body = std::any_cast<BodyPtr>(&thing)) {
    if (!(*body)->is_closed())
      throw FieldError(field, "this body is not closed: it has no inside", "close it, or take a solid body");
    return std::make_shared<BodyShape>(*body);
  }
  const ShapePtr& shape = std::any_cast<const ShapePtr&>(thing);
  if (!shape->is_closed())
    throw FieldError(field, "this shape is not closed: it has no inside",
                     "an implicit surface has one with closed: true");
  return shape;
}

ShapePtr combined(Csg::Operation operation, const std::vector<ShapePtr>& operands, const std::string& field) {
  try {
    return std::make_shared<Csg>(operation, operands);
  } catch (const std::invalid_argument& error) {
    throw FieldError(field, error.what(), "move them, so that they overlap");
  }
}

const std::vector<Category> kSolids{Category::body, Category::shape};

TypeDeclaration of_several(const std::string& name, const std::string& description, Csg::Operation operation) {
  return declare(Category::shape, name, description)
      .field("of", references(kSolids).count(1), "bodies and closed shapes; where faces coincide the first counts")
      .built_by([operation](const Fields& f) -> ShapePtr {
        std::vector<ShapePtr> operands;
        for (const std::any& one : f.references("of")) operands.push_back(operand(one, "of"));
        return combined(operation, operands, "of");
      });
}

}  // namespace

TypeDeclaration union_type() {
  return of_several("union", "What lies in any of several solids, without the walls inside.", Csg::Operation::unite);
}

TypeDeclaration intersection_type() {
  return of_several("intersection", "What lies in all of several solids.", Csg::Operation::intersect);
}

TypeDeclaration difference_type() {
  return declare(Category::shape, "difference", "A solid without what lies in others.")
      .field("of", reference(kSolids), "body or closed shape")
      .field("minus", references(kSolids).count(1), "bodies and closed shapes to take away")
      .built_by([](const Fields& f) -> ShapePtr {
        std::vector<ShapePtr> operands{operand(f.any("of"), "of")};
        for (const std::any& one : f.references("minus")) operands.push_back(operand(one, "minus"));
        return combined(Csg::Operation::subtract, operands, "minus");
      });
}

}  // namespace lekalo::geometry
