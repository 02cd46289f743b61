#include "render/drawing/page/line_groups.h"

#include <algorithm>

#include "render/drawing/view.h"

namespace lekalo::render {

namespace {

// Lines of one kind and pen that follow one another go on in one another.
std::vector<DrawnLines> by_pen(std::vector<DrawnLines> found, double same, double dot) {
  std::vector<DrawnLines> all;
  size_t begin = 0;  // of those of the object and kind in work
  for (size_t k = found.size(); k-- > 0;) {
    DrawnLines& one = found[k];
    if (all.empty() || all.back().object != one.object || all.back().line != one.line) begin = all.size();
    const auto with_pen =
        std::find_if(all.begin() + static_cast<std::ptrdiff_t>(begin), all.end(),
                     [&](const DrawnLines& other) { return other.kind == one.kind && other.pen == one.pen; });
    if (with_pen == all.end()) {
      all.push_back(std::move(one));
      continue;
    }
    with_pen->paths.insert(with_pen->paths.end(), one.paths.begin(), one.paths.end());
    with_pen->heads.insert(with_pen->heads.end(), one.heads.begin(), one.heads.end());
  }
  for (DrawnLines& one : all) {
    one.paths = joined(one.paths, same);
    // Lines that are seen along themselves.
    std::erase_if(one.paths, [&](const PathInSpace& path) { return is_point(path.path, dot); });
  }
  return all;
}

// Solid lines of one pen that meet in a corner without being one path have round ends: there are no notches in it.
// Whether so, of each path of each.
std::vector<std::vector<bool>> closed_corners(const std::vector<DrawnLines>& all, double same) {
  std::vector<std::vector<bool>> result(all.size());
  for (size_t k = 0; k < all.size(); ++k) result[k].assign(all[k].paths.size(), false);
  std::vector<bool> done(all.size(), false);
  for (size_t k = 0; k < all.size(); ++k) {
    const LineLook& pen = all[k].pen;
    if (done[k] || !pen.dash.empty() || pen.opacity < 1 || pen.cap != LineLook::Cap::butt) continue;
    std::vector<PathInSpace> paths;
    for (size_t j = k; j < all.size(); ++j)
      if (all[j].pen == pen) paths.insert(paths.end(), all[j].paths.begin(), all[j].paths.end());
    const std::vector<bool> corners = ends_at_corners(paths, same);
    size_t next = 0;
    for (size_t j = k; j < all.size(); ++j) {
      if (!(all[j].pen == pen)) continue;
      done[j] = true;
      for (size_t i = 0; i < all[j].paths.size(); ++i) result[j][i] = corners[next++];
    }
  }
  return result;
}

}  // namespace

SheetGroup& group_of(SheetGroup& all, const std::string& kind, const std::string& object) {
  if (!all.items.empty()) {
    auto* last = std::get_if<SheetGroup>(&all.items.back());
    if (last && last->kind == kind && last->object == object) return *last;
  }
  all.items.push_back(SheetGroup{kind, object, {}, {}, {}});
  return std::get<SheetGroup>(all.items.back());
}

SheetGroup line_groups(std::vector<DrawnLines> found, bool hidden, double same, double dot) {
  std::vector<DrawnLines> all = by_pen(std::move(found), same, dot);
  const std::vector<std::vector<bool>> corners = closed_corners(all, same);
  SheetGroup result{hidden ? "hidden" : "lines", "", {}, {}, {}};
  for (size_t j = 0; j < all.size(); ++j) {
    DrawnLines& one = all[j];
    if (one.paths.empty() && one.heads.empty()) continue;
    SheetGroup& owner = one.name.empty() ? result : group_of(result, hidden ? "object hidden" : "object", one.name);
    SheetGroup& group = group_of(owner, one.kind, one.name);
    for (size_t k = 0; k < one.paths.size(); ++k) {
      LineLook pen = one.pen;
      if (corners[j][k]) pen.cap = LineLook::Cap::round;
      group.items.emplace_back(drawn(std::move(one.paths[k].path), pen));
    }
    for (SheetItem& head : one.heads) group.items.push_back(std::move(head));
  }
  return result;
}

}  // namespace lekalo::render
