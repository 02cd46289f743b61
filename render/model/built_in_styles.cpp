// The styles that are there without being written.
#include "render/model/styles.h"

namespace lekalo::render {

namespace {

// Dashes of ISO 128-2: 12 widths drawn, 3 left out; chains 24, 3, 0.5, 3. Shortened by half for small figures.
constexpr std::string_view kBuiltIn = R"(
thick:        { width: 0.5 mm, arrow_size: 3 mm }
thin:         { width: 0.25 mm }
hairline:     { width: 0.13 mm }
hidden:       { width: 0.25 mm, dash: [1.5 mm, 0.75 mm] }
axis:         { width: 0.18 mm, dash: [3 mm, 0.6 mm, 0.2 mm, 0.6 mm] }
construction: { width: 0.18 mm, color: '#555555' }
dimension:    { width: 0.18 mm, arrows: both, text_size: 8 pt }
label:        { width: 0.18 mm, text_size: 10 pt }
ray:          { width: 0.25 mm, color: crimson, arrows: end }
)";

}  // namespace

std::string_view built_in_styles() { return kBuiltIn; }

bool is_built_in_style(std::string_view name) {
  std::string line = "\n";
  line += name;
  line += ':';
  return kBuiltIn.find(line) != std::string_view::npos;
}

}  // namespace lekalo::render
