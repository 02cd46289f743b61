// A web page that shows where pictures differ: both pictures, the error map in magma colours, a switch that blinks
// between the two, and the figures. It works from a folder without a server and loads nothing from elsewhere.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/image/compare.h"

namespace lekalo::render {

// One comparison, or one test that never came to its comparison.
struct ReportEntry {
  std::string name;
  bool passed = false;
  std::string note;                            // shown as text: why the golden changed, what failed; may be empty
  std::optional<ComparisonResult> comparison;  // without one there are no pictures but `picture`
  std::optional<DisplayImage> picture;         // of a test that has nothing to be compared with yet
};

// Writes folder/index.html and, for entry number i from 1, folder/iiii-{a,b,error}.png, or iiii-b.png for a single
// picture. Makes the folder. Failed entries come first. The same entries give the same bytes. Throws ImageError.
void write_report(const std::filesystem::path& folder, const std::string& title,
                  const std::vector<ReportEntry>& entries);

}  // namespace lekalo::render
