// The areas of a picture in which one thing is seen, bounded by the picture's own curves.
//
// All visible outlines, and other curves at which areas may end, are cut where one ends on another and where they
// cross. What is seen on either side of each part is asked just beside it. The border of an area consists of the parts
// that have it on one side only; they are joined into loops, which bound it by the even-odd rule: no search for the
// faces of a subdivision is needed, nor which loop lies inside which.
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "geometry/spatial/box_tree.h"
#include "render/drawing/paths/paths.h"
#include "render/lines/projected_curve.h"

namespace lekalo::render {

// What is seen at a place.
struct RegionLabel {
  int object = -1;  // -1: none
  int face = 0;
  bool back = false;   // the side with a material of its own that the normal turns away from
  bool shade = false;  // turned away from the light
  bool cut = false;    // on a face at which a section cuts the object
  auto operator<=>(const RegionLabel&) const = default;
};

// A stretch of a curve that may bound areas.
struct RegionBorder {
  std::shared_ptr<const ProjectedCurve> curve;
  geometry::Interval t;
  std::vector<double> breaks;  // parameters where the curve may have a corner
};

class Regions {
 public:
  // `what` tells what is seen at a place of the picture, in pixels.
  Regions(std::vector<RegionBorder> borders, double width, double height,
          const std::function<RegionLabel(const Vec2&)>& what);

  // All labels that are next to some border, in order.
  std::vector<RegionLabel> labels() const;
  // The loops around all places whose label belongs; closed, in pixels, to be filled by the even-odd rule. No farther
  // than `tolerance` from the curves.
  std::vector<Path> loops(const std::function<bool(const RegionLabel&)>& belongs, double tolerance) const;
  // Loops that do not close by themselves, seen so far: a border is missing there.
  int open() const { return open_; }

 private:
  struct Part {
    int border;  // -1: a side of the picture
    geometry::Interval t;
    Vec2 begin, end;
    int begin_node, end_node;
    RegionLabel left, right;  // as seen on paper by who walks along it: y is downwards
  };
  // The cells of all curves by place.
  class Cells {
   public:
    explicit Cells(const std::vector<RegionBorder>& borders);
    const std::vector<const ProjectedCurve*>& curves() const { return curves_; }
    const std::vector<int>& borders_of(const ProjectedCurve* curve) const { return borders_of_.at(curve); }
    // Calls visit(curve, index of the cell) for cells near q.
    template <class Visit>
    void around(const Vec2& q, Visit&& visit) const {
      tree_.around({{q.x, q.y, 0}, {q.x, q.y, 0}}, [&](int k) { visit(cells_[k].first, cells_[k].second); });
    }

   private:
    std::vector<const ProjectedCurve*> curves_;
    std::map<const ProjectedCurve*, std::vector<int>> borders_of_;
    std::vector<std::pair<const ProjectedCurve*, int>> cells_;
    geometry::BoxTree tree_;
  };
  void cut(double width, double height);
  void add_part(int border, const geometry::Interval& t, const Vec2& begin, const Vec2& end);
  Vec2 place(int border, const Vec2& begin, const Vec2& end, const geometry::Interval& range, double t) const;
  void label_parts(const std::function<RegionLabel(const Vec2&)>& what);
  void join_nodes();
  void drop_repeated();

  std::vector<RegionBorder> borders_;
  Cells cells_;
  std::vector<Part> parts_;
  int nodes_ = 0;
  mutable int open_ = 0;
};

}  // namespace lekalo::render
