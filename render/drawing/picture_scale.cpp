#include "render/drawing/picture_scale.h"

#include <algorithm>

#include "render/drawing/annotations/annotations.h"
#include "render/drawing/output/cairo_output.h"

namespace lekalo::render {

bool has_color_bars(const Model& model) {
  const std::vector<Annotation>& all = model.drawing.annotations;
  return model.camera && model.film.crop.x1 == 0 && std::any_of(all.begin(), all.end(), tells_scale_of_ground);
}

DisplayImage with_color_bars(const DisplayImage& picture, const Model& model, const PictureScale& scale) {
  Model page;  // no more of the model than annotations ask for
  page.camera = model.camera;
  page.film = model.film;
  page.paper = model.paper;
  page.styles = model.styles;
  for (const Annotation& annotation : model.drawing.annotations)
    if (tells_scale_of_ground(annotation)) page.drawing.annotations.push_back(annotation);
  const double per_pixel = millimetres_of_pixel(page);
  const Vec2 size = per_pixel * Vec2(picture.width, picture.height);
  const View view{page, *page.camera, Vec2(0), per_pixel, Vec2(0, size.y), {Vec2(0), size}, false, scale};
  LineWork lines;
  PageWork work;
  add_annotations(view, lines, work);
  place_labels(work.labels, {{}, {}, size.x, size.y});
  Sheet sheet;
  sheet.width = size.x;
  sheet.height = size.y;
  sheet.items.push_back(SheetPicture{Vec2(0), size.x, size.y, std::make_shared<const DisplayImage>(picture)});
  for (SheetItem& item : work.shapes) sheet.items.push_back(std::move(item));
  for (const Label& label : work.labels) sheet.items.push_back(drawn_label(label));
  DisplayImage result = pixels_of(sheet, picture.width, picture.height);
  result.text = picture.text;
  return result;
}

}  // namespace lekalo::render
