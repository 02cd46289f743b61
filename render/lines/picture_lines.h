// Lines and marks of constant size in a ray-traced picture.
//
// A line is the set of picture points within half its width of the picture of its curve. What is seen at such a place q
// is decided at two places. Let C be the curve's nearest point, at the picture distance d from q and the depth D.
//
//   at C   The line is hidden if what the camera's ray through C meets first lies before C, by more than a small part
//   of
//          a pixel across the surface. So a line on a surface is seen where its curve is, to the very place where it
//          goes behind a silhouette, at any angle of view; and nothing thin is seen through.
//   at q   The line is hidden if what the sample's own ray meets first lies before D by more than the surface can climb
//          from C to q: d times the steepest slope of the depth at either place, twice that as surfaces curve. So a
//          line that passes behind something ends at its outline, and one on a surface keeps its whole width there.
//
// Lines that meet in one place of a surface or of space are seen in their order, last ones on top. Only camera rays see
// lines. Behind clear bodies they are hidden too.
#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "render/integrator.h"
#include "render/lines/projected_curve.h"
#include "render/lines/strokes.h"

namespace lekalo::render {

class PictureLines {
 public:
  // The lines of the world's model before its camera, on its film. The world must stay. Once `stop` is set (null:
  // never) no more of them are looked for: no picture comes of these.
  explicit PictureLines(const World& world, const std::atomic<bool>* stop = nullptr);

  bool empty() const { return items_.empty(); }
  // Puts what lines show at the picture point q over what the sample brings from its ray through it. Where that is a
  // line, the sample's point is a place on the curve, u its parameter; it has no material but a color().
  void draw(const Vec2& q, RaySample& sample) const;
  // Whether the edge of a line or mark may run through a pixel, so that its centre does not tell what all of it shows.
  bool may_part(int x, int y) const;
  // Of the line or mark that the point belongs to, if it does to one.
  std::optional<Vec3> color(const SurfacePoint& point) const;

 private:
  struct PlacedStroke {
    Stroke stroke;
    ProjectedCurve curve;
    double reach;
  };
  struct PlacedMark {
    Mark mark;
    PicturePoint at;
    double reach;
  };
  // What one line or mark shows at q.
  struct Layer {
    Spectrum color;
    double opacity = 1;
    bool open = true;  // not hidden
    double depth = 0;
    double rise = 0;  // how much the depth may differ where the line's middle is crossed by another
    int order = 0;
    int object = 0;
    Vec3 point{0};
    Vec3 geometric_normal{0}, normal{0};
    double parameter = 0;
  };
  struct Sight {
    bool open = false;
    double slope = 0;  // of the depth of the surface that C lies on, if it lies on one: scene units a pixel
    Vec3 geometric_normal{0}, normal{0};  // of that surface; else towards the viewer
  };
  struct Item {
    int stroke = 0;  // or, from -1 down, a mark
    int cell = 0;
  };

  void sort_into_bins();
  std::span<const Item> items_near(const Vec2& q) const;
  // Of C at the picture's place `at`, from q at this distance in pixels.
  Sight sight(const Vec3& point, const PicturePoint& at, double distance, const RaySample& sample) const;
  void add_stroke(const Item& item, const Vec2& q, const RaySample& sample, std::vector<Layer>& layers) const;
  void add_mark(const PlacedMark& mark, const Vec2& q, const RaySample& sample, std::vector<Layer>& layers) const;

  const World& world_;
  const Camera* camera_ = nullptr;
  std::vector<PlacedStroke> strokes_;
  std::vector<PlacedMark> marks_;
  std::vector<Vec3> colors_;     // of strokes and marks by their order
  int columns_ = 0, rows_ = 0;   // of bins
  std::vector<uint32_t> first_;  // of a bin's items, and the end of all
  std::vector<Item> items_;
};

}  // namespace lekalo::render
