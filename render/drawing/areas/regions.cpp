#include "render/drawing/areas/regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "geometry/spatial/box_tree.h"
#include "render/drawing/visibility/picture_crossings.h"

namespace lekalo::render {

using geometry::Box3;
using geometry::BoxTree;
using geometry::Interval;

namespace {

// Ends of parts nearer than this are one place, and a part that ends so near to another ends on it; pixels.
constexpr double kSamePlace = 2e-3;
// How far beside a part is asked what is seen there: of its length, and in pixels.
// Less than what tells two curves apart, so that an area between them is not passed over.
constexpr double kBeside = 1e-3, kMinBeside = 1e-5, kMaxBeside = 0.25 * kSamePlace;
// Where what is seen changes along a part without a cut is found to so many pixels.
constexpr double kChange = 1e-4;
// Loops that end so near to one another are joined, pixels. Curves that touch, with radii up to R, part by kMaxBeside
// only sqrt(2 R kMaxBeside) from there.
constexpr double kCorner = 2;

Box3 box_of(const ProjectedCurve::Cell& cell, double slack) {
  const Vec2 lo = glm::min(cell.begin, cell.end) - cell.bulge - slack,
             hi = glm::max(cell.begin, cell.end) + cell.bulge + slack;
  return {{lo.x, lo.y, 0}, {hi.x, hi.y, 0}};
}

}  // namespace

Regions::Regions(std::vector<RegionBorder> borders, double width, double height,
                 const std::function<RegionLabel(const Vec2&)>& what)
    : borders_(std::move(borders)), cells_(borders_) {
  cut(width, height);
  label_parts(what);
  join_nodes();
  drop_repeated();
}

Regions::Cells::Cells(const std::vector<RegionBorder>& borders) {
  for (size_t k = 0; k < borders.size(); ++k) {
    auto& of_curve = borders_of_[borders[k].curve.get()];
    if (of_curve.empty()) curves_.push_back(borders[k].curve.get());
    of_curve.push_back(static_cast<int>(k));
  }
  std::vector<Box3> boxes;
  for (const ProjectedCurve* curve : curves_)
    for (size_t i = 0; i < curve->cells().size(); ++i) {
      boxes.push_back(box_of(curve->cells()[i], kSamePlace));
      cells_.emplace_back(curve, static_cast<int>(i));
    }
  tree_ = BoxTree(boxes);
}

// At crossings, at places where others end on it, and at the sides of the picture.
void Regions::cut(double width, double height) {
  const std::vector<const ProjectedCurve*>& curves = cells_.curves();
  std::vector<std::vector<double>> cuts(borders_.size());
  const auto add_cut = [&](const ProjectedCurve* curve, double t) {
    for (const int k : cells_.borders_of(curve))
      if (borders_[k].t.contains(t)) cuts[k].push_back(t);
  };
  const PictureCrossings crossings(curves, width, height);
  const auto none = [](int) { return false; };
  for (const ProjectedCurve* curve : curves)
    crossings.with(*curve, none, [&](int other, const PictureCrossing& crossing) {
      add_cut(curve, crossing.t);
      add_cut(curves[other], crossing.t_other);
    });
  // Where pictures of curves turn back: a circle seen from its side runs there and back on one line.
  for (size_t k = 0; k < borders_.size(); ++k) {
    const auto& of_curve = borders_[k].curve->cells();
    for (size_t i = 0; i + 1 < of_curve.size(); ++i)
      if (of_curve[i].t.hi == of_curve[i + 1].t.lo && borders_[k].t.contains(of_curve[i].t.hi) &&
          glm::dot(of_curve[i].end - of_curve[i].begin, of_curve[i + 1].end - of_curve[i + 1].begin) < 0)
        cuts[k].push_back(of_curve[i].t.hi);
  }
  // Where another one ends or is cut: curves that lie on one another have the same cuts.
  const std::vector<std::vector<double>> own = cuts;
  for (size_t k = 0; k < borders_.size(); ++k) {
    const RegionBorder& border = borders_[k];
    const auto add_to_others = [&](double t) {
      const Vec2 q = border.curve->place(t).p;
      cells_.around(q, [&](const ProjectedCurve* curve, int cell) {
        if (curve == border.curve.get() && curve->cells()[cell].t.contains(t)) return;
        if (const auto near = curve->nearest(cell, q); near && near->distance < kSamePlace) add_cut(curve, near->t);
      });
    };
    add_to_others(border.t.lo), add_to_others(border.t.hi);
    for (const double t : own[k]) add_to_others(t);
  }
  // The sides of the picture, and what of the curves is inside.
  struct Side {
    int axis;
    double at;
    std::vector<double> cuts;
  };
  std::array<Side, 4> sides{Side{0, 0, {0, height}}, Side{0, width, {0, height}}, Side{1, 0, {0, width}},
                            Side{1, height, {0, width}}};
  for (size_t k = 0; k < borders_.size(); ++k) {
    const RegionBorder& border = borders_[k];
    for (const ProjectedCurve::Cell& cell : border.curve->cells()) {
      const Interval t{std::max(cell.t.lo, border.t.lo), std::min(cell.t.hi, border.t.hi)};
      if (!(t.lo < t.hi)) continue;
      for (Side& side : sides) {
        const auto off = [&](double x) { return border.curve->place(x).p[side.axis] - side.at; };
        double lo = t.lo, hi = t.hi;
        if ((off(lo) < 0) == (off(hi) < 0)) continue;
        for (double middle = 0.5 * (lo + hi); lo < middle && middle < hi; middle = 0.5 * (lo + hi))
          ((off(middle) < 0) == (off(lo) < 0) ? lo : hi) = middle;
        cuts[k].push_back(lo);
        side.cuts.push_back(border.curve->place(lo).p[1 - side.axis]);
      }
    }
  }
  for (size_t k = 0; k < borders_.size(); ++k) {
    const RegionBorder& border = borders_[k];
    auto& list = cuts[k];
    list.push_back(border.t.lo), list.push_back(border.t.hi);
    std::sort(list.begin(), list.end());
    Vec2 begin = border.curve->place(list.front()).p;
    double from = list.front();
    for (const double t : list) {
      const Vec2 end = border.curve->place(t).p, middle = border.curve->place(0.5 * (from + t)).p;
      const bool last = t == list.back();
      if (t == from || (!last && glm::length(end - begin) < kSamePlace && glm::length(middle - begin) < kSamePlace))
        continue;
      const bool inside = middle.x > 0 && middle.x < width && middle.y > 0 && middle.y < height;
      if (inside) add_part(static_cast<int>(k), {from, t}, begin, end);
      from = t, begin = end;
    }
  }
  for (Side& side : sides) {
    std::sort(side.cuts.begin(), side.cuts.end());
    const auto at = [&](double x) { return side.axis == 0 ? Vec2(side.at, x) : Vec2(x, side.at); };
    const double length = side.axis == 0 ? height : width;
    double from = 0;
    for (const double x : side.cuts)
      if (x > from && x <= length && (x - from > kSamePlace || x == length)) {
        add_part(-1, {from, x}, at(from), at(x));
        from = x;
      }
  }
}

void Regions::add_part(int border, const Interval& t, const Vec2& begin, const Vec2& end) {
  parts_.push_back({border, t, begin, end, 0, 0, {}, {}});
}

Vec2 Regions::place(int border, const Vec2& begin, const Vec2& end, const Interval& range, double t) const {
  if (border >= 0) return borders_[border].curve->place(t).p;
  return begin + (t - range.lo) / range.width() * (end - begin);
}

// What is seen beside each part, at three places; where they differ, a cut is missing: the part is halved there.
void Regions::label_parts(const std::function<RegionLabel(const Vec2&)>& what) {
  constexpr int kMaxParts = 64;  // of one
  std::vector<Part> labelled;
  for (const Part& whole : parts_) {
    std::vector<Part> open{whole};
    int made = 1;
    while (!open.empty()) {
      Part part = open.back();
      open.pop_back();
      // Both sides at the share x of the part. The sides of the picture have nothing beyond them.
      const auto beside = [&](double t) {
        const Vec2 at = place(part.border, whole.begin, whole.end, whole.t, t);
        const double h = 1e-4 * part.t.width();
        Vec2 way = place(part.border, whole.begin, whole.end, whole.t, t + h) -
                   place(part.border, whole.begin, whole.end, whole.t, t - h);
        const double length = glm::length(way);
        if (!(length > 0)) return std::pair<RegionLabel, RegionLabel>();
        way /= length;
        const Vec2 left(way.y, -way.x);
        const double off = std::clamp(kBeside * length / h * 0.5 * part.t.width(), kMinBeside, kMaxBeside);
        const auto seen = [&](const Vec2& p) {
          if (part.border >= 0) return what(p);
          const Vec2 in = p - at;
          const bool outside = (whole.begin.x == whole.end.x && (whole.begin.x == 0 ? in.x < 0 : in.x > 0)) ||
                               (whole.begin.y == whole.end.y && (whole.begin.y == 0 ? in.y < 0 : in.y > 0));
          return outside ? RegionLabel() : what(p);
        };
        return std::pair(seen(at + off * left), seen(at - off * left));
      };
      const auto at_share = [&](double share) { return part.t.lo + share * part.t.width(); };
      const auto middle = beside(at_share(0.5));
      bool split = false;
      for (const double share : {0.17, 0.83}) {
        const auto here = beside(at_share(share));
        if (here == middle || made >= kMaxParts) continue;
        double lo = at_share(std::min(share, 0.5)), hi = at_share(std::max(share, 0.5));
        const auto at_lo = share < 0.5 ? here : middle;
        const auto at = [&](double t) { return place(part.border, whole.begin, whole.end, whole.t, t); };
        while (glm::length(at(hi) - at(lo)) > kChange) {
          const double between = 0.5 * (lo + hi);
          if (!(lo < between && between < hi)) break;
          (beside(between) == at_lo ? lo : hi) = between;
        }
        const Vec2 where = at(hi);
        if (glm::length(where - part.begin) < kSamePlace || glm::length(where - part.end) < kSamePlace) continue;
        Part first = part, second = part;
        first.t.hi = second.t.lo = hi;
        first.end = second.begin = where;
        open.push_back(second), open.push_back(first);
        ++made;
        split = true;
        break;
      }
      if (split) continue;
      std::tie(part.left, part.right) = middle;
      labelled.push_back(part);
    }
  }
  parts_ = std::move(labelled);
}

// Ends of parts that are one place get one number.
void Regions::join_nodes() {
  std::vector<Box3> boxes;
  for (const Part& part : parts_)
    for (const Vec2& p : {part.begin, part.end}) boxes.push_back({{p.x, p.y, 0}, {p.x, p.y, 0}});
  const BoxTree tree(boxes);
  std::vector<int> leader(boxes.size());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int k) {
    while (leader[k] != k) k = leader[k] = leader[leader[k]];
    return k;
  };
  for (size_t k = 0; k < boxes.size(); ++k) {
    Box3 around = boxes[k];
    around.lo -= kSamePlace, around.hi += kSamePlace;
    tree.around(around, [&](int other) { leader[find(other)] = find(static_cast<int>(k)); });
  }
  std::map<int, int> numbers;
  const auto number = [&](size_t k) {
    return numbers.emplace(find(static_cast<int>(k)), static_cast<int>(numbers.size())).first->second;
  };
  for (size_t k = 0; k < parts_.size(); ++k)
    parts_[k].begin_node = number(2 * k), parts_[k].end_node = number(2 * k + 1);
  nodes_ = static_cast<int>(numbers.size());
}

// Curves that lie on one another in the picture bound an area once: of parts that others cover only the longest stay.
void Regions::drop_repeated() {
  std::vector<size_t> order(parts_.size());
  std::iota(order.begin(), order.end(), 0);
  const auto length = [&](size_t k) { return glm::length(parts_[k].end - parts_[k].begin); };
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return length(a) > length(b); });
  std::vector<std::vector<const Part*>> kept(borders_.size());  // of each border
  std::vector<bool> dropped(parts_.size());
  for (const size_t k : order) {
    const Part& part = parts_[k];
    if (part.border < 0) continue;
    const auto sides = std::minmax(part.left, part.right);
    const auto is_covered = [&](double share) {
      const Vec2 q = borders_[part.border].curve->place(part.t.lo + share * part.t.width()).p;
      bool found = false;
      cells_.around(q, [&](const ProjectedCurve* curve, int cell) {
        if (found) return;
        const auto near = curve->nearest(cell, q);
        if (!near || !(near->distance < kSamePlace)) return;
        for (const int border : cells_.borders_of(curve))
          for (const Part* other : kept[border])
            found = found || (other->t.contains(near->t) && std::minmax(other->left, other->right) == sides);
      });
      return found;
    };
    constexpr double kShares[] = {0.5, 0.05, 0.26, 0.71, 0.95};
    dropped[k] = std::all_of(std::begin(kShares), std::end(kShares), is_covered);
    if (!dropped[k]) kept[part.border].push_back(&part);
  }
  std::vector<Part> rest;
  for (size_t k = 0; k < parts_.size(); ++k)
    if (!dropped[k]) rest.push_back(parts_[k]);
  parts_ = std::move(rest);
}

std::vector<RegionLabel> Regions::labels() const {
  std::set<RegionLabel> found;
  for (const Part& part : parts_) found.insert(part.left), found.insert(part.right);
  return {found.begin(), found.end()};
}

std::vector<Path> Regions::loops(const std::function<bool(const RegionLabel&)>& belongs, double tolerance) const {
  std::vector<std::vector<int>> at_node(static_cast<size_t>(nodes_));
  std::vector<bool> used(parts_.size(), true);
  for (size_t k = 0; k < parts_.size(); ++k) {
    const Part& part = parts_[k];
    if (belongs(part.left) == belongs(part.right)) continue;
    used[k] = false;
    at_node[part.begin_node].push_back(static_cast<int>(k));
    at_node[part.end_node].push_back(static_cast<int>(k));
  }
  // Loops as lists of parts: those that begin at nodes of odd degree first, which do not close.
  struct Step {
    int part;
    bool backwards;
  };
  const auto next_at = [&](int node) {
    for (const int k : at_node[node])
      if (!used[k]) return k;
    return -1;
  };
  std::vector<std::vector<Step>> chains;
  const auto follow = [&](int node) {
    std::vector<Step> chain;
    const int first = node;
    for (int k; (k = next_at(node)) >= 0;) {
      used[k] = true;
      const bool backwards = parts_[k].begin_node != node;
      chain.push_back({k, backwards});
      node = backwards ? parts_[k].begin_node : parts_[k].end_node;
      if (node == first && at_node[first].size() == 2) break;
    }
    if (!chain.empty()) chains.push_back(std::move(chain));
  };
  for (int node = 0; node < nodes_; ++node)
    if (at_node[node].size() % 2 == 1 && next_at(node) >= 0) follow(node);
  for (int node = 0; node < nodes_; ++node)
    while (next_at(node) >= 0) follow(node);

  const auto begin_of = [&](const Step& s) { return s.backwards ? parts_[s.part].end : parts_[s.part].begin; };
  const auto end_of = [&](const Step& s) { return s.backwards ? parts_[s.part].begin : parts_[s.part].end; };
  // What does not close goes on where another one begins or ends nearest, which is right where only a short piece of
  // a border is missing.
  std::vector<std::vector<Step>> closed, loose;
  for (auto& chain : chains)
    (glm::length(begin_of(chain.front()) - end_of(chain.back())) <= kCorner ? closed : loose).push_back(chain);
  while (!loose.empty()) {
    std::vector<Step> chain = std::move(loose.back());
    loose.pop_back();
    while (!loose.empty()) {
      const Vec2 at = end_of(chain.back());
      double least = glm::length(begin_of(chain.front()) - at);
      size_t best = loose.size();
      bool turned = false;
      for (size_t k = 0; k < loose.size(); ++k)
        for (const bool backwards : {false, true}) {
          const double distance = glm::length((backwards ? end_of(loose[k].back()) : begin_of(loose[k].front())) - at);
          if (distance < least) least = distance, best = k, turned = backwards;
        }
      if (best == loose.size()) break;
      if (least > kCorner) ++open_;
      std::vector<Step> more = std::move(loose[best]);
      loose.erase(loose.begin() + static_cast<std::ptrdiff_t>(best));
      if (turned) {
        std::reverse(more.begin(), more.end());
        for (Step& step : more) step.backwards = !step.backwards;
      }
      chain.insert(chain.end(), more.begin(), more.end());
    }
    if (glm::length(begin_of(chain.front()) - end_of(chain.back())) > kCorner) ++open_;
    closed.push_back(std::move(chain));
  }

  std::vector<Path> result;
  for (const auto& chain : closed) {
    Path loop;
    for (size_t k = 0; k < chain.size();) {
      const Part& part = parts_[chain[k].part];
      Path piece;
      if (part.border < 0) {
        piece.from = begin_of(chain[k]);
        piece.steps.push_back(line_to(end_of(chain[k])));
        ++k;
      } else {
        // Parts of one curve that follow one another are one stretch of it.
        Interval t = part.t;
        size_t next = k + 1;
        for (; next < chain.size(); ++next) {
          const Part& other = parts_[chain[next].part];
          if (other.border != part.border || chain[next].backwards != chain[k].backwards) break;
          if (chain[k].backwards ? other.t.hi != t.lo : other.t.lo != t.hi) break;
          t = hull(t, other.t);
        }
        const RegionBorder& border = borders_[part.border];
        piece = fitted_path(*border.curve, t, border.breaks, tolerance);
        if (chain[k].backwards) piece = reversed(piece);
        k = next;
      }
      if (loop.steps.empty())
        loop.from = piece.from;
      else if (glm::length(piece.from - loop.steps.back().to) > kCorner)
        loop.steps.push_back(line_to(piece.from));
      loop.steps.insert(loop.steps.end(), piece.steps.begin(), piece.steps.end());
    }
    loop.closed = true;
    result.push_back(std::move(loop));
  }
  return result;
}

}  // namespace lekalo::render
