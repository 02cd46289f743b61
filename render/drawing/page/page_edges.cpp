#include "render/drawing/page/page_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/drawing/text/text_layout.h"

namespace lekalo::render {

namespace {

// Millimetres.
constexpr double kSeen = 0.05;   // of a text beyond the edge
constexpr double kMinRoom = 20;  // between margins that a message speaks of
constexpr double kMarginStep = 0.5;
constexpr size_t kLongest = 40;  // characters of a text in a message

std::string shortened(const std::string& text) {
  size_t end = 0;
  for (size_t count = 0; end < text.size() && count < kLongest; ++count) do
      ++end;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80);  // of the same character
  if (end == text.size()) return text;
  while (end > 0 && text[end - 1] == ' ') --end;
  return text.substr(0, end) + "...";
}

}  // namespace

std::string over_the_edge(const Label& label, const PageEdges& edges) {
  const SheetBox box = box_of(label.text);
  struct Edge {
    const char* name;
    double over, size;  // how far the text reaches beyond it, and that of all the text
  };
  const Vec2 size = box.size(), page = edges.box.size();
  const Edge all[] = {{"left", edges.box.lo.x - box.lo.x, size.x},
                      {"right", box.hi.x - edges.box.hi.x, size.x},
                      {"upper", edges.box.lo.y - box.lo.y, size.y},
                      {"lower", box.hi.y - edges.box.hi.y, size.y}};
  const Edge& worst =
      *std::max_element(std::begin(all), std::end(all), [](const Edge& a, const Edge& b) { return a.over < b.over; });
  if (!(worst.over > kSeen)) return {};
  const std::string text = fmt::format("the text '{}'", shortened(label.text.tex));
  for (const int axis : {0, 1})
    if (size[axis] > page[axis])
      return fmt::format(
          "{} does not fit: it is {:.1f} mm {}, the {} {:.1f} mm; a shorter text, a smaller `text_size` or a larger "
          "page has room for it",
          text, size[axis], axis == 0 ? "wide" : "high", edges.name, page[axis]);
  std::string where =
      worst.over < worst.size
          ? fmt::format("{} goes {:.1f} mm over the {}'s {} edge", text, worst.over, edges.name, worst.name)
          : fmt::format("{} is not on the {}: it stands {:.1f} mm beyond the {} edge of {:.1f} x {:.1f} mm", text,
                        edges.name, worst.over - worst.size, worst.name, page.x, page.y);
  const double enough = kMarginStep * std::ceil((edges.margin + worst.over) / kMarginStep);
  if (label.on_page) return where + "; `page` holds it there, whatever the margin";
  // Names of axes and legends have their place beside the whole graph, which a margin does not change.
  if (label.kind == "axis" || label.kind == "legend" || 2 * enough + kMinRoom > std::min(page.x, page.y))
    return where + "; a larger page or a smaller `text_size` has room for it";
  return where + fmt::format("; `margin: {:g} mm` gives it room", enough);
}

}  // namespace lekalo::render
