// One view of a drawing in its place on the sheet.
#pragma once

#include "geometry/describe.h"
#include "render/drawing/sheet.h"
#include "render/model/model.h"

namespace lekalo::render {

struct View {
  const Model& model;      // with this view's camera and choices
  const Camera& camera;    // of `model`
  Vec2 at{0};              // upper left corner of the picture on the sheet, millimetres
  double millimetres = 1;  // of a pixel
  Vec2 page_at{0};         // lower left corner from which places on the page count
  SheetBox room{};         // between the page's margins, or the panel's; the picture has it but for axes and legend
  bool is_panel = false;
  std::optional<PictureScale> scale;  // of the ground, where its colours tell a number

  Vec2 place(const Vec2& pixels) const { return at + millimetres * pixels; }
  Vec2 place(const Vec3& point) const {
    const PicturePoint p = camera.project(point);
    return place(Vec2(p.x, p.y));
  }
  Vec2 place(const geometry::Anchor& anchor) const {
    return anchor.on_page ? Vec2(page_at.x + anchor.point.x, page_at.y - anchor.point.y) : place(anchor.point);
  }
  Path placed(Path path) const { return moved(std::move(path), at, millimetres); }
  double width() const { return millimetres * camera.width(); }
  double height() const { return millimetres * camera.height(); }
};

// A path of straight lines.
Path straight_path(std::initializer_list<Vec2> points, bool closed = false);
// Drawn by a pen alone.
SheetPath drawn(Path path, const LineLook& pen);
// The head of an arrow of this length, its tip there, pointing along the unit vector `way`.
SheetPath arrow_head(const Vec2& tip, const Vec2& way, double length, const LineLook& pen);
// Millimetres by which a line ends before the tip of its arrow.
double shortened_by(double arrow_length);

// A sign at a place of the sheet.
std::vector<SheetItem> drawn_mark(const Mark& mark, const Vec2& at, double opacity, const View& view);

// A text in a style; its colour and size are the style's.
SheetText text_in(const Style& style, const std::string& tex);

}  // namespace lekalo::render
