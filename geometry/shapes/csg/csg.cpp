#include "geometry/shapes/csg/csg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "geometry/bodies/topology/sew.h"
#include "geometry/describe.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Operands in a list longer than this have a tree of boxes.
constexpr size_t kFewOperands = 4;

Box3 common(const Box3& a, const Box3& b) { return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)}; }

std::optional<ConvexSolid> closed_form(const Shape& shape) {
  if (const auto* body = dynamic_cast<const BodyShape*>(&shape)) return ConvexSolid::of(*body->body());
  if (const auto* half_space = dynamic_cast<const HalfSpaceShape*>(&shape))
    return ConvexSolid::half_space(half_space->frame());
  return std::nullopt;
}

// A list that takes memory of its own only where it is longer than usual.
template <class T, size_t kUsual>
class GrowingRoom {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  GrowingRoom() : values_(few_) {}
  explicit GrowingRoom(const std::vector<T>& values) : values_(few_), size_(values.size()) {
    if (size_ > capacity_) {
      many_ = values;
      values_ = many_.data();
      capacity_ = size_;
    } else {
      std::copy(values.begin(), values.end(), values_);
    }
  }
  GrowingRoom(const GrowingRoom&) = delete;
  GrowingRoom& operator=(const GrowingRoom&) = delete;
  ~GrowingRoom() {}

  void add(const T& value) {
    if (size_ == capacity_) grow();
    values_[size_++] = value;
  }
  size_t size() const { return size_; }
  // Drops all but the first ones.
  void keep(size_t size) { size_ = size; }
  T* begin() { return values_; }

 private:
  void grow() {
    std::vector<T> larger(2 * capacity_);
    std::copy(values_, values_ + size_, larger.begin());
    many_ = std::move(larger);
    values_ = many_.data();
    capacity_ *= 2;
  }

  union {
    T few_[kUsual];  // not initialised
  };
  std::vector<T> many_;
  T* values_;
  size_t size_ = 0, capacity_ = kUsual;
};

}  // namespace

BodyPtr Csg::boundary(const std::function<BodyPtr(const Csg&)>& make) const {
  std::call_once(boundary_made_, [&] { boundary_ = make(*this); });
  return boundary_;
}

Csg::Csg(Operation operation, const std::vector<ShapePtr>& operands, std::vector<std::string> names)
    : operands_(operands), names_(std::move(names)) {
  if (operands.empty()) throw std::invalid_argument("there is nothing to combine");
  nodes_.emplace_back().operation = operation;
  for (size_t k = 0; k < operands.size(); ++k) {
    const bool taken_away = operation == Operation::subtract && k > 0;
    const int operand = append(operands[k], 0, taken_away, taken_away);
    nodes_[0].operands.push_back(operand);
  }
  for (size_t k = nodes_.size(); k-- > 0;) finish(nodes_[k]);
  if (nodes_[0].box.empty()) throw std::invalid_argument("the operands have nothing in common: nothing is left");
  Box3 all;
  int parts = 0;
  for (Leaf& leaf : leaves_) {
    leaf.first_part = parts;
    parts += static_cast<int>(leaf.shape->surface_parts().size());
  }
  for (const Leaf& leaf : leaves_)
    if (const Box3 box = leaf.shape->bounds(); box.bounded()) all.include(box);
  if (!all.empty()) size_ = all.diameter();
  for (const Node& node : nodes_) farthest_ = std::max(farthest_, BoxTree::farthest(node.box));
  outside_.assign(nodes_.size(), 0);
  for (const Node& node : nodes_)
    if (node.taken_away) ++outside_[node.parent];
  std::vector<int> inside = outside_;
  for (int number = 0; number < static_cast<int>(nodes_.size()); ++number) {
    Node& node = nodes_[number];
    if (node.leaf < 0 && !node.convex) continue;
    turn(number, inside.data());
    node.is_enough = inside[0] >= nodes_[0].needed;
    turn(number, inside.data());
  }
}

// The trees of operands that are operations themselves are taken apart, so that all leaves meet in one list.
int Csg::append(const ShapePtr& operand, int parent, bool taken_away, bool turned) {
  if (!operand->is_closed()) throw std::invalid_argument("an operand is not closed: it has no inside");
  const int number = static_cast<int>(nodes_.size());
  {
    Node& node = nodes_.emplace_back();
    node.parent = parent;
    node.taken_away = taken_away;
  }
  const auto* tree = dynamic_cast<const Csg*>(operand.get());
  if (!tree) {
    if (leaf_count() == kMaxLeaves)
      throw std::invalid_argument(
          fmt::format("it has more than {} parts, those of its operands' operands counted", kMaxLeaves));
    nodes_[number].leaf = leaf_count();
    leaves_.push_back({operand, closed_form(*operand), turned, number});
    return number;
  }
  nodes_[number].operation = tree->operation();
  for (size_t k = 0; k < tree->operands_.size(); ++k) {
    const bool inner = tree->operation() == Operation::subtract && k > 0;
    const int child = append(tree->operands_[k], number, inner, turned != inner);
    nodes_[number].operands.push_back(child);
  }
  return number;
}

// Its operands are finished.
void Csg::finish(Node& node) {
  if (node.leaf >= 0) {
    node.box = leaves_[node.leaf].shape->bounds();
    node.convex = leaves_[node.leaf].convex.has_value();
    return;
  }
  const auto box_of = [&](size_t k) -> const Box3& { return nodes_[node.operands[k]].box; };
  node.box = box_of(0);
  for (size_t k = 1; k < node.operands.size(); ++k) {
    if (node.operation == Operation::unite) node.box.include(box_of(k));
    if (node.operation == Operation::intersect) node.box = common(node.box, box_of(k));
  }
  if (node.operation == Operation::intersect && !node.box.bounded()) {
    std::vector<Frame> planes;
    for (const int operand : node.operands)
      if (const int leaf = nodes_[operand].leaf; leaf >= 0)
        if (const auto* half_space = dynamic_cast<const HalfSpaceShape*>(leaves_[leaf].shape.get()))
          planes.push_back(half_space->frame());
    node.box = common(node.box, bounds_of_common(planes));
  }
  node.convex = node.operation == Operation::intersect &&
                std::all_of(node.operands.begin(), node.operands.end(),
                            [&](int operand) { return nodes_[operand].leaf >= 0 && nodes_[operand].convex; });
  node.needed = node.operation == Operation::unite ? 1 : static_cast<int>(node.operands.size());
  node.first_in_tree = static_cast<int>(node.operands.size());
  if (node.operation == Operation::intersect || node.operands.size() <= kFewOperands) return;
  node.first_in_tree = node.operation == Operation::unite ? 0 : 1;
  std::vector<Box3> boxes;
  for (size_t k = node.first_in_tree; k < node.operands.size(); ++k) boxes.push_back(box_of(k));
  node.tree = BoxTree(boxes);
}

struct Csg::Crossing {
  double t;
  int node;  // what is entered or left
  int leaf, face;
  // Of leaves without a closed form.
  int piece = 0;
  double u = 0, v = 0;
};

// Of a convex node, from one crossing to another, either of which may be at infinity.
struct Csg::Stretch {
  struct End {
    double t;
    int leaf, face;
    Crossing of(int node) const { return {t, node, leaf, face}; }
  };
  End in, out;
};

struct Csg::Search {
  Search(const Line& line, double size, double farthest_of_boxes)
      : solids(line), farthest(farthest_of_boxes), tolerance_at_zero(kSameHit * size * root(solids.inverse_square)) {}
  // Of a number that is 1 but for rounding for all rays.
  static double root(double x) { return std::abs(x - 1) < 1e-8 ? 0.5 * (1 + x) : std::sqrt(x); }
  double tolerance(double t) const { return tolerance_at_zero + 4e-16 * std::abs(t); }
  const Line& line() const { return solids.line; }
  const LineThroughBoxes& through_boxes() {
    if (!line_through_boxes) line_through_boxes.emplace(line(), farthest);
    return *line_through_boxes;
  }

  LineOfSolids solids;
  double farthest;                                     // coordinate of the nodes' boxes
  std::optional<LineThroughBoxes> line_through_boxes;  // once it is needed
  double tolerance_at_zero;                            // in units of the line's direction
  GrowingRoom<Crossing, 16> crossings;
};

namespace {
constexpr Interval kNowhere{kInfinity, -kInfinity};
}

bool Csg::stretch(const Node& node, const Search& search, Stretch& inside) const {
  ConvexSolid::Stretch one;
  if (node.leaf >= 0) {
    if (!leaves_[node.leaf].convex->stretch(search.solids, one)) return false;
    inside.in = {one.in, node.leaf, one.face_in};
    inside.out = {one.out, node.leaf, one.face_out};
    return true;
  }
  inside.in = {-kInfinity, -1, 0};
  inside.out = {kInfinity, -1, 0};
  for (const int operand : node.operands) {
    const int leaf = nodes_[operand].leaf;
    if (!leaves_[leaf].convex->stretch(search.solids, one)) return false;
    // Of faces in one place that of the first operand counts.
    if (one.in > inside.in.t + search.tolerance(one.in)) inside.in = {one.in, leaf, one.face_in};
    if (one.out < inside.out.t - search.tolerance(one.out)) inside.out = {one.out, leaf, one.face_out};
    if (!(inside.in.t < inside.out.t)) return false;
  }
  return true;
}

Interval Csg::gather_convex(int number, const Interval& range, Search& search) const {
  Stretch inside;
  if (!stretch(nodes_[number], search, inside)) return kNowhere;
  const Interval result{std::max(range.lo, inside.in.t), std::min(range.hi, inside.out.t)};
  if (result.empty()) return kNowhere;
  search.crossings.add(inside.in.of(number));
  if (inside.out.t < kInfinity) search.crossings.add(inside.out.of(number));
  return result;
}

Interval Csg::gather_leaf(int number, const Interval& range, Search& search) const {
  const Node& node = nodes_[number];
  const Shape& shape = *leaves_[node.leaf].shape;
  const bool begins = !node.box.bounded() && shape.begins_inside(search.line());
  if (node.box.bounded() && !search.through_boxes().meets(node.box, range)) return kNowhere;
  // The room is kept from call to call, but for calls within calls.
  static thread_local std::vector<SurfaceHit> room;
  std::vector<SurfaceHit> hits = std::move(room);
  hits.clear();
  shape.all_hits(search.line(), {-kInfinity, range.hi}, hits);
  const bool ends = begins != (hits.size() % 2 != 0);  // inside at the end of the range
  Interval result = kNowhere;
  if (begins || !hits.empty())
    result = {std::max(range.lo, begins ? -kInfinity : hits.front().t),
              std::min(range.hi, ends ? kInfinity : hits.back().t)};
  if (!result.empty()) {
    if (begins) search.crossings.add({-kInfinity, number, node.leaf, 0});
    for (const SurfaceHit& hit : hits)
      search.crossings.add({hit.t, number, node.leaf, hit.face, hit.piece, hit.u, hit.v});
  }
  room = std::move(hits);
  return result.empty() ? kNowhere : result;
}

Interval Csg::gather(int number, const Interval& range, Search& search) const {
  const Node& node = nodes_[number];
  if (node.convex) return gather_convex(number, range, search);
  if (node.leaf >= 0) return gather_leaf(number, range, search);
  if (node.parent >= 0 && !search.through_boxes().meets(node.box, range)) return kNowhere;
  Interval result{range.lo, range.hi};  // a copy as one would wait for its parts to be written
  if (node.operation == Operation::intersect) {
    const size_t before = search.crossings.size();
    for (int k = 0; k < static_cast<int>(node.operands.size()); ++k) {
      result = gather(node.operands[k], result, search);
      if (!result.empty()) continue;
      search.crossings.keep(before);
      return kNowhere;
    }
    return result;
  }
  const bool unite = node.operation == Operation::unite;
  if (!unite) {
    result = gather(node.operands[0], range, search);
    if (result.empty()) return kNowhere;
  }
  Interval any = kNowhere;
  const auto visit = [&](int k) {
    const Interval one = gather(node.operands[k], result, search);
    any = {std::min(any.lo, one.lo), std::max(any.hi, one.hi)};
  };
  for (int k = unite ? 0 : 1; k < node.first_in_tree; ++k) visit(k);
  if (node.first_in_tree < static_cast<int>(node.operands.size()))
    node.tree.along(search.through_boxes(), result, [&](int k) { visit(node.first_in_tree + k); });
  return unite ? any : result;
}

// Changes the side of a leaf or convex node, and all that changes with it.
void Csg::turn(int number, int* inside) const {
  bool now = inside[number] < nodes_[number].needed;
  inside[number] = now ? nodes_[number].needed : 0;
  for (int parent = nodes_[number].parent; parent >= 0; number = parent, parent = nodes_[parent].parent) {
    const int needed = nodes_[parent].needed;
    const bool before = inside[parent] >= needed;
    inside[parent] += now != nodes_[number].taken_away ? 1 : -1;
    now = inside[parent] >= needed;
    if (now == before) return;
  }
}

template <class Visit>
void Csg::walk(const Line& line, const Interval& t, Visit&& visit) const {
  Search search(line, size_, farthest_);
  const auto hit_of = [&](const Crossing& at) -> SurfaceHit {
    return {at.t, at.u, at.v, at.leaf + leaf_count() * at.face, at.piece};
  };
  // Where the solid is a stretch, either end of which may be at infinity.
  const auto visit_ends = [&](const Crossing& in, const Crossing& out) {
    if (in.t > -kInfinity && out.t - in.t <= search.tolerance(in.t)) return;
    if (in.t > -kInfinity && t.contains(in.t) && !visit(hit_of(in))) return;
    if (out.t < kInfinity && t.contains(out.t)) visit(hit_of(out));
  };
  if (nodes_[0].convex) {
    Stretch inside;
    if (stretch(nodes_[0], search, inside)) visit_ends(inside.in.of(0), inside.out.of(0));
    return;
  }
  // A crossing just beyond either end may be one with a crossing inside.
  const Interval range{t.lo - 4 * search.tolerance(t.lo), t.hi + 4 * search.tolerance(t.hi)};
  if (gather(0, range, search).empty()) return;
  Crossing *const begin = search.crossings.begin(), *const end = begin + search.crossings.size();
  // Mostly it is one part that is crossed, in and out.
  if (end - begin == 2 && begin[0].node == begin[1].node && nodes_[begin[0].node].is_enough)
    return visit_ends(begin[0], begin[1]);
  std::sort(begin, end, [](const Crossing& a, const Crossing& b) { return a.t != b.t ? a.t < b.t : a.leaf < b.leaf; });

  GrowingRoom<int, 64> counts(outside_);
  int* const inside_node = counts.begin();
  const auto is_inside = [&] { return inside_node[0] >= nodes_[0].needed; };
  Crossing* first = begin;
  for (; first < end && first->t == -kInfinity; ++first) turn(first->node, inside_node);
  bool inside = is_inside();
  for (Crossing* last; first < end && first->t <= t.hi; first = last) {
    const double place = first->t + search.tolerance(first->t);
    for (last = first; last < end && last->t <= place; ++last) turn(last->node, inside_node);
    const bool before = inside;
    inside = is_inside();
    if (inside == before) continue;
    // The face of the first operand that was crossed in this sense.
    const Crossing* best = nullptr;
    for (const Crossing* one = first; one < last; ++one) {
      const bool entered = (inside_node[one->node] >= nodes_[one->node].needed) != leaves_[one->leaf].turned;
      if (entered == inside && (!best || one->leaf < best->leaf)) best = one;
    }
    if (!best || !t.contains(best->t)) continue;
    if (!visit(hit_of(*best))) return;
  }
}

void Csg::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  walk(line, t, [&](const SurfaceHit& hit) {
    hits.push_back(hit);
    return true;
  });
}

bool Csg::first_hit(const Line& line, const Interval& t, SurfaceHit& first) const {
  bool found = false;
  walk(line, t, [&](const SurfaceHit& hit) {
    first = hit;
    found = true;
    return false;
  });
  return found;
}

ShapePoint Csg::point_of(const SurfaceHit& hit, const Vec3& near, bool parameters) const {
  const Leaf& leaf = leaves_[hit.face % leaf_count()];
  const SurfaceHit own = of_leaf(hit);
  ShapePoint point = leaf.convex  ? leaf.convex->point(own.face, near, parameters)
                     : parameters ? leaf.shape->point(own, near)
                                  : leaf.shape->bare_point(own, near);
  if (leaf.turned) point.normal = -point.normal;
  return point;
}

std::optional<Mat3> Csg::shape_operator(const SurfaceHit& hit, const Vec3& near) const {
  const Leaf& leaf = leaves_[hit.face % leaf_count()];
  SurfaceHit own = of_leaf(hit);
  if (leaf.convex) {
    const ShapePoint point = leaf.convex->point(own.face, near, true);
    own.u = point.u;
    own.v = point.v;
  }
  const std::optional<Mat3> result = leaf.shape->shape_operator(own, near);
  return result && leaf.turned ? std::optional<Mat3>(-*result) : result;
}

bool Csg::begins_inside(const Line& line) const {
  std::vector<int> inside = outside_;
  const LineOfSolids solids(line);
  for (int number = 0; number < leaf_count(); ++number) {
    const Leaf& leaf = leaves_[number];
    if (nodes_[leaf.node].box.bounded()) continue;
    ConvexSolid::Stretch stretch;
    const bool begins = leaf.convex ? leaf.convex->stretch(solids, stretch) && stretch.in == -kInfinity
                                    : leaf.shape->begins_inside(line);
    if (begins) turn(leaf.node, inside.data());
  }
  return inside[0] >= nodes_[0].needed;
}

Box3 Csg::shown_of(const Box3& box, const Leaf& leaf) const {
  Box3 shown = box;
  for (int node = nodes_[leaf.node].parent; node >= 0; node = nodes_[node].parent)
    shown = common(shown, nodes_[node].box);
  return shown;
}

std::vector<SurfacePart> Csg::surface_parts() const {
  std::vector<SurfacePart> parts;
  for (const Leaf& leaf : leaves_)
    for (const SurfacePart& part : leaf.shape->surface_parts())
      parts.push_back({shown_of(part.solid, leaf), part.pieces});
  return parts;
}

Box3 Csg::piece_box(const PieceOfSurface& piece) const {
  const auto after = std::upper_bound(leaves_.begin(), leaves_.end(), piece.part,
                                      [](int part, const Leaf& leaf) { return part < leaf.first_part; });
  const Leaf& leaf = after[-1];
  return shown_of(leaf.shape->piece_box({piece.part - leaf.first_part, piece.piece}), leaf);
}

PieceOfSurface Csg::piece_of(const SurfaceHit& hit) const {
  const Leaf& leaf = leaves_[hit.face % leaf_count()];
  const PieceOfSurface piece = leaf.shape->piece_of(of_leaf(hit));
  return {leaf.first_part + piece.part, piece.piece};
}

namespace {

// The closed shape that a field's item stands for.
ShapePtr operand(const std::any& thing, const std::string& field) {
  if (const auto* body = std::any_cast<BodyPtr>(&thing)) {
    if (!(*body)->is_closed())
      throw FieldError(field, "this body is not closed: it has no inside", "close it, or take a solid body");
    return std::make_shared<BodyShape>(*body);
  }
  const auto* surface = std::any_cast<SurfacePtr>(&thing);
  const auto* set = std::any_cast<std::vector<SurfacePtr>>(&thing);
  if (surface || set) {
    try {
      const std::span<const SurfacePtr> all = set ? std::span<const SurfacePtr>(*set) : std::span(surface, 1);
      return std::make_shared<BodyShape>(std::make_shared<Body>(enclosed_by(all)));
    } catch (const std::invalid_argument& error) {
      throw FieldError(field, fmt::format("this surface bounds no solid: {}", error.what()),
                       "operands are bodies, closed surfaces, and sets of surfaces whose edges meet all round");
    }
  }
  const ShapePtr& shape = std::any_cast<const ShapePtr&>(thing);
  if (!shape->is_closed()) throw FieldError(field, "this shape is not closed: it has no inside", shape->how_to_close());
  return shape;
}

ShapePtr combined(Csg::Operation operation, const std::vector<ShapePtr>& operands, std::vector<std::string> names,
                  const std::string& field) {
  try {
    return std::make_shared<Csg>(operation, operands, std::move(names));
  } catch (const std::invalid_argument& error) {
    throw FieldError(field, error.what(), "move them, so that they overlap");
  }
}

// What operands are called: as in the scene, else by the field and their number there.
void add_names(const Fields& f, const std::string& field, size_t count, std::vector<std::string>& names) {
  std::vector<std::string> given(count);
  if (f.has(field + ".names")) given = f.get<std::vector<std::string>>(field + ".names");
  given.resize(count);
  for (size_t k = 0; k < count; ++k)
    names.push_back(!given[k].empty() ? given[k] : count == 1 ? field : fmt::format("{}.{}", field, k));
}

const std::vector<Category> kSolids{Category::body, Category::shape, Category::surface};

TypeDeclaration of_several(const std::string& name, const std::string& description, Csg::Operation operation) {
  return declare(Category::shape, name, description)
      .example("of: [{ type: box, size: [2, 2, 2] }, { type: cylinder_body, radius: 0.6, height: 2 }]")
      .field("of", references(kSolids).count(1),
             "bodies, closed shapes and closed surfaces; where faces coincide the first counts")
      .built_by([operation](const Fields& f) -> ShapePtr {
        std::vector<ShapePtr> operands;
        for (const std::any& one : f.references("of")) operands.push_back(operand(one, "of"));
        std::vector<std::string> names;
        add_names(f, "of", operands.size(), names);
        return combined(operation, operands, std::move(names), "of");
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
      .example("of: { type: box, size: [2, 2, 2] }, minus: { type: ball, radius: 1.2 }")
      .field("of", reference(kSolids), "body, closed shape or closed surface")
      .field("minus", references(kSolids).count(1), "bodies, closed shapes and closed surfaces to take away")
      .built_by([](const Fields& f) -> ShapePtr {
        std::vector<ShapePtr> operands{operand(f.any("of"), "of")};
        for (const std::any& one : f.references("minus")) operands.push_back(operand(one, "minus"));
        std::vector<std::string> names;
        add_names(f, "of", 1, names);
        add_names(f, "minus", operands.size() - 1, names);
        return combined(Csg::Operation::subtract, operands, std::move(names), "minus");
      });
}

}  // namespace lekalo::geometry
