// What is known of the paths of cutters.
#include <fmt/format.h>

#include "command.h"
#include "geometry/machining/deepest_cut.h"
#include "geometry/queries/measures/mass_properties.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::ToolMove;

struct Lengths {
  double cutting = 0, in_air = 0, time = 0;
  bool has_time = true;
};

Lengths lengths_of(const geometry::ToolPath& path) {
  Lengths sum;
  for (const ToolMove& move : path.moves()) {
    const double length = geometry::measure(*move.curve).length.value;
    const bool cuts = move.kind == ToolMove::Kind::cut || move.kind == ToolMove::Kind::link;
    (cuts ? sum.cutting : sum.in_air) += length;
    const auto feed = path.feed_of(move);
    sum.has_time = sum.has_time && feed;
    if (feed) sum.time += length / *feed;
  }
  return sum;
}

void put_lengths(ordered_json& out, const geometry::ToolPath& path) {
  const Lengths lengths = lengths_of(path);
  if (path.facts().rows > 0) out["rows"] = path.facts().rows;
  if (path.facts().rows > 0 || path.moves().size() > 1) {
    out["cutting_length"] = lengths.cutting;
    out["length_in_air"] = lengths.in_air;
  }
  if (lengths.has_time) out["time"] = lengths.time;
}

}  // namespace

void put_tool_path(ordered_json& out, const geometry::ToolPath& path) {
  const geometry::ToolPathFacts& facts = path.facts();
  put_lengths(out, path);
  if (facts.scallop_height) out["scallop_height"] = *facts.scallop_height;
  if (facts.bend) {
    out["least_curvature_difference"] = facts.bend->min_difference;
    out["least_difference_u"] = facts.bend->u;
    out["least_difference_v"] = facts.bend->v;
  }
  if (facts.part) {
    const geometry::DeepestCut deepest = geometry::deepest_cut(path, *facts.part);
    out["deepest_cut"] = deepest.depth;
    if (deepest.depth > 0) {
      out["deepest_cut_u"] = deepest.u;
      out["deepest_cut_v"] = deepest.v;
    }
  }
  if (!facts.strip) return;
  out["strip_width"] = {facts.strip->min_width, facts.strip->max_width};
  out["band_width"] = {facts.strip->min_band, facts.strip->max_band};
}

}  // namespace lekalo::command
