// Where curves cross in the picture.
//
// Curves are cut into cells that hardly turn (render/lines/projected_curve.h). Two cells whose directions cannot agree
// cross at most once. Two that meet at ends and lead away to different sides have that place alone. Two that run side
// by side are apart if their ends and the bounds of how they bend say so; if one bends more than the other they are
// nearest or deepest in one another at one place: if they are apart there, or touch there, that is all. Others are
// halved until they are apart, cross once, or are shorter than a ten-thousandth of a pixel: there they touch.
#pragma once

#include <functional>
#include <vector>

#include "render/lines/projected_curve.h"

namespace lekalo::render {

struct PictureCrossing {
  double t = 0;        // on the curve
  double t_other = 0;  // on the other
  bool touching = false;
};

// The cells of many curves by place, to be crossed with others.
class PictureCrossings {
 public:
  // The curves must stay. `width` and `height` in pixels.
  PictureCrossings(std::vector<const ProjectedCurve*> curves, double width, double height);

  // Calls found(index of the other curve, crossing) for all crossings of a curve with those for which skip(index) is
  // false; the same place may come twice where cells meet. Of a curve with itself too, but for neighbouring cells.
  template <class Skip, class Found>
  void with(const ProjectedCurve& curve, Skip&& skip, Found&& found) const {
    std::vector<Hit> hits;
    collect(curve, skip, hits);
    for (const Hit& hit : hits) found(hit.curve, hit.crossing);
  }

 private:
  struct Hit {
    int curve;
    PictureCrossing crossing;
  };
  // Where a curve runs along another.
  struct Run {
    int curve;
    geometry::Interval t;
  };
  struct Item {
    int curve;
    int cell;
    Vec2 lo, hi;  // of the cell's box
  };
  void collect(const ProjectedCurve& curve, const std::function<bool(int)>& skip, std::vector<Hit>& hits) const;
  static void drop_joints(const ProjectedCurve& curve, std::vector<Run>& runs, std::vector<Hit>& hits);
  size_t bin_of(const Vec2& place) const;
  template <class Visit>
  void each_bin(const Vec2& lo, const Vec2& hi, Visit&& visit) const;

  std::vector<const ProjectedCurve*> curves_;
  double bin_;  // pixels
  int columns_, rows_;
  std::vector<std::vector<Item>> bins_;
};

}  // namespace lekalo::render
