#include "render/drawing/output/cairo_output.h"

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/drawing/text/pango_text.h"
#include "render/image/display.h"

namespace lekalo::render {

namespace {

constexpr double kPointsPerMillimetre = 72 / 25.4;
// Cairo rounds coordinates to 1/256 of a device unit. On a recording so many times larger than the page that is
// 0.00008 mm, 0.0003 of a pixel.
constexpr double kFiner = 16;
// PDF has no arcs: cubic curves this near, in millimetres.
constexpr double kArcTolerance = 1e-4;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("Cairo cannot draw: {}", cairo_status_to_string(status)));
}

struct SurfaceEnd {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using SurfacePtr = std::unique_ptr<cairo_surface_t, SurfaceEnd>;
struct ContextEnd {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using ContextPtr = std::unique_ptr<cairo_t, ContextEnd>;
struct PatternEnd {
  void operator()(cairo_pattern_t* pattern) const { cairo_pattern_destroy(pattern); }
};
using PatternPtr = std::unique_ptr<cairo_pattern_t, PatternEnd>;

cairo_status_t append(void* text, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

// A picture as Cairo holds it: opaque pixels.
SurfacePtr surface_of(const DisplayImage& picture) {
  SurfacePtr surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.width, picture.height));
  check(cairo_surface_status(surface.get()));
  cairo_surface_flush(surface.get());
  unsigned char* const data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  const int shift = picture.bits - 8;
  for (int y = 0; y < picture.height; ++y) {
    auto* row = reinterpret_cast<uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < picture.width; ++x) {
      const auto* sample = &picture.samples[(static_cast<size_t>(y) * picture.width + x) * picture.channels];
      const auto at = [&](int channel) {
        return static_cast<uint32_t>(sample[picture.channels < 3 ? 0 : channel] >> shift);
      };
      row[x] = at(0) << 16 | at(1) << 8 | at(2);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

// Draws in millimetres on a context that has been scaled so.
class Painter {
 public:
  explicit Painter(cairo_t* cairo) : cairo_(cairo), pango_(exact_context()) {}

  void paint(const Sheet& sheet) {
    set_color(sheet.paper, 1);
    cairo_rectangle(cairo_, 0, 0, sheet.width, sheet.height);
    cairo_fill(cairo_);
    cairo_translate(cairo_, -sheet.corner.x, -sheet.corner.y);
    items(sheet.items);
    check(cairo_status(cairo_));
  }

 private:
  void items(const std::vector<SheetItem>& list) {
    for (const SheetItem& item : list) std::visit([&](const auto& one) { paint(one); }, item);
  }

  void paint(const SheetGroup& group) {
    cairo_save(cairo_);
    if (group.clip_at) {
      const Vec2 &at = *group.clip_at, &size = group.clip_size;
      if (group.clip_is_round)
        cairo_arc(cairo_, at.x + 0.5 * size.x, at.y + 0.5 * size.y, 0.5 * size.x, 0, geometry::kTwoPi);
      else
        cairo_rectangle(cairo_, at.x, at.y, size.x, size.y);
      cairo_clip(cairo_);
    }
    items(group.items);
    cairo_restore(cairo_);
  }

  void set_color(const Spectrum& color, double opacity) {
    cairo_set_source_rgba(cairo_, srgb_encode(color[0]), srgb_encode(color[1]), srgb_encode(color[2]), opacity);
  }

  void add(const Path& given) {
    const Path path = without_arcs(given, kArcTolerance);
    cairo_move_to(cairo_, path.from.x, path.from.y);
    for (const PathStep& step : path.steps) {
      if (step.kind == PathStep::Kind::line)
        cairo_line_to(cairo_, step.to.x, step.to.y);
      else
        cairo_curve_to(cairo_, step.first.x, step.first.y, step.second.x, step.second.y, step.to.x, step.to.y);
    }
    if (path.closed) cairo_close_path(cairo_);
  }

  void paint(const SheetPath& path) {
    for (const Path& part : path.parts) add(part);
    if (path.brush) {
      set_color(path.brush->color, path.brush->opacity);
      cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
      cairo_fill_preserve(cairo_);
    } else if (path.gradient) {
      const Gradient& given = *path.gradient;
      const PatternPtr pattern(given.radial
                                   ? cairo_pattern_create_radial(given.from.x, given.from.y, 0, given.from.x,
                                                                 given.from.y, glm::length(given.to - given.from))
                                   : cairo_pattern_create_linear(given.from.x, given.from.y, given.to.x, given.to.y));
      for (const Gradient::Stop& stop : given.stops)
        cairo_pattern_add_color_stop_rgb(pattern.get(), stop.offset, srgb_encode(stop.color[0]),
                                         srgb_encode(stop.color[1]), srgb_encode(stop.color[2]));
      cairo_set_source(cairo_, pattern.get());
      cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
      cairo_fill_preserve(cairo_);
    }
    if (path.pen) {
      const LineLook& pen = *path.pen;
      set_color(pen.color, pen.opacity);
      cairo_set_line_width(cairo_, 2 * pen.half_width);
      cairo_set_line_cap(cairo_, pen.cap == LineLook::Cap::round    ? CAIRO_LINE_CAP_ROUND
                                 : pen.cap == LineLook::Cap::square ? CAIRO_LINE_CAP_SQUARE
                                                                    : CAIRO_LINE_CAP_BUTT);
      cairo_set_line_join(cairo_, pen.join == LineLook::Join::miter   ? CAIRO_LINE_JOIN_MITER
                                  : pen.join == LineLook::Join::bevel ? CAIRO_LINE_JOIN_BEVEL
                                                                      : CAIRO_LINE_JOIN_ROUND);
      cairo_set_dash(cairo_, pen.dash.data(), static_cast<int>(pen.dash.size()), 0);
      cairo_stroke_preserve(cairo_);
    }
    cairo_new_path(cairo_);
  }

  void paint(const SheetText& text) {
    cairo_save(cairo_);
    cairo_translate(cairo_, text.at.x, text.at.y);
    cairo_rotate(cairo_, -text.angle);
    set_color(text.brush.color, text.brush.opacity);
    for (const TextRun& run : text.runs) {
      const PangoLayoutPtr layout = layout_of(pango_.get(), run.font, run.text, run.size);
      cairo_move_to(cairo_, run.at.x, run.at.y);
      pango_cairo_show_layout_line(cairo_, pango_layout_get_line_readonly(layout.get(), 0));
    }
    cairo_set_line_width(cairo_, text.stroke_width);
    cairo_set_dash(cairo_, nullptr, 0, 0);
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
    cairo_new_path(cairo_);
    for (const Path& stroke : text.strokes) add(stroke);
    cairo_stroke(cairo_);
    cairo_restore(cairo_);
  }

  void paint(const SheetPicture& picture) {
    const SurfacePtr pixels = surface_of(*picture.picture);
    cairo_save(cairo_);
    cairo_translate(cairo_, picture.at.x, picture.at.y);
    cairo_scale(cairo_, picture.width / picture.picture->width, picture.height / picture.picture->height);
    cairo_set_source_surface(cairo_, pixels.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cairo_), CAIRO_FILTER_GOOD);
    cairo_rectangle(cairo_, 0, 0, picture.picture->width, picture.picture->height);
    cairo_fill(cairo_);
    cairo_restore(cairo_);
  }

  cairo_t* cairo_;
  PangoContextPtr pango_;
};

// Whether nothing shines through anything.
bool is_opaque(const std::vector<SheetItem>& items) {
  return std::all_of(items.begin(), items.end(), [](const SheetItem& item) {
    if (const auto* group = std::get_if<SheetGroup>(&item)) return is_opaque(group->items);
    if (const auto* text = std::get_if<SheetText>(&item)) return text->brush.opacity == 1;
    const auto* path = std::get_if<SheetPath>(&item);
    return !path || ((!path->pen || path->pen->opacity == 1) && (!path->brush || path->brush->opacity == 1));
  });
}

// From the first place of one text to the end of the other, if it is there: all places in the file stay.
void blank(std::string_view from, std::string_view to, std::string& bytes) {
  const size_t begin = bytes.find(from);
  if (begin == std::string::npos) return;
  const size_t end = bytes.find(to, begin) + to.size();
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.begin() + static_cast<std::ptrdiff_t>(end), ' ');
}

}  // namespace

std::string pdf_of(const Sheet& sheet) {
  demand_finite(sheet);
  const double width = sheet.width * kPointsPerMillimetre, height = sheet.height * kPointsPerMillimetre;
  std::string bytes;
  {
    const SurfacePtr surface(cairo_pdf_surface_create_for_stream(append, &bytes, width, height));
    check(cairo_surface_status(surface.get()));
    if (!sheet.title.empty())
      cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, sheet.title.c_str());
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "Lekalo");
    // As long in every time zone.
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
    const cairo_rectangle_t extents{0, 0, width * kFiner, height * kFiner};
    const SurfacePtr large(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extents));
    {
      const ContextPtr context(cairo_create(large.get()));
      cairo_scale(context.get(), kFiner * kPointsPerMillimetre, kFiner * kPointsPerMillimetre);
      Painter(context.get()).paint(sheet);
    }
    const ContextPtr context(cairo_create(surface.get()));
    cairo_scale(context.get(), 1 / kFiner, 1 / kFiner);
    cairo_set_source_surface(context.get(), large.get(), 0, 0);
    cairo_paint(context.get());
    check(cairo_status(context.get()));
    cairo_show_page(context.get());
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()));
  }
  // Cairo writes a date, whether one wants it or not, and calls every page a transparency group, which pdfTeX warns of
  // where several figures stand on a page.
  blank("/CreationDate (", ")", bytes);
  if (is_opaque(sheet.items)) blank("/Group <<", ">>", bytes);
  return bytes;
}

DisplayImage pixels_of(const Sheet& sheet, int width, int height) {
  demand_finite(sheet);
  const SurfacePtr surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  check(cairo_surface_status(surface.get()));
  {
    const ContextPtr context(cairo_create(surface.get()));
    cairo_scale(context.get(), width / sheet.width, height / sheet.height);
    Painter(context.get()).paint(sheet);
  }
  cairo_surface_flush(surface.get());
  DisplayImage image;
  image.width = width, image.height = height;
  image.samples.reserve(3 * static_cast<size_t>(width) * height);
  const unsigned char* const data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < height; ++y) {
    const auto* row = reinterpret_cast<const uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < width; ++x)
      for (const int shift : {16, 8, 0}) image.samples.push_back(static_cast<uint16_t>(row[x] >> shift & 255));
  }
  return image;
}

std::vector<Path> text_outlines(const TextRun& run) {
  // In a thousandth of the em, for Cairo's rounding.
  const double scale = 1000 / run.size;
  const SurfacePtr surface(cairo_recording_surface_create(CAIRO_CONTENT_ALPHA, nullptr));
  const ContextPtr context(cairo_create(surface.get()));
  const PangoContextPtr pango = exact_context();
  const PangoLayoutPtr layout = layout_of(pango.get(), run.font, run.text, 1000);
  cairo_move_to(context.get(), 0, 0);
  pango_cairo_layout_line_path(context.get(), pango_layout_get_line_readonly(layout.get(), 0));
  cairo_path_t* const found = cairo_copy_path(context.get());
  std::vector<Path> paths;
  const auto place = [&](const cairo_path_data_t& p) { return run.at + Vec2(p.point.x, p.point.y) / scale; };
  for (int i = 0; i < found->num_data; i += found->data[i].header.length) {
    const cairo_path_data_t* const data = &found->data[i];
    switch (data->header.type) {
      case CAIRO_PATH_MOVE_TO:
        paths.emplace_back();
        paths.back().from = place(data[1]);
        break;
      case CAIRO_PATH_LINE_TO:
        paths.back().steps.push_back(line_to(place(data[1])));
        break;
      case CAIRO_PATH_CURVE_TO:
        paths.back().steps.push_back(curve_to(place(data[1]), place(data[2]), place(data[3])));
        break;
      case CAIRO_PATH_CLOSE_PATH:
        paths.back().closed = true;
        break;
    }
  }
  cairo_path_destroy(found);
  std::erase_if(paths, [](const Path& path) { return path.steps.empty(); });
  return paths;
}

std::string png_bytes(const DisplayImage& picture) {
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface_of(picture).get(), append, &bytes));
  return bytes;
}

}  // namespace lekalo::render
