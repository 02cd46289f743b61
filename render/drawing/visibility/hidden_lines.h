// Which parts of a drawing's lines are seen (Golovanov 2016, 8.3).
//
// What a line is hidden by can change only
//
//   where its picture crosses an outline (silhouette, border, sharp edge) of something nearer,
//   where it goes round its own surface: the line of sight touches that, i . (s_u x s_v) = 0 along it,
//   where it pierces a surface,
//   at a cusp of its picture, where a silhouette goes behind its own surface.
//
// Between two such places one ray tells: the camera's own ray through a point of the line meets so many sheets before
// it. Outlines that are not known as curves (where a search is not complete) are found by more rays, and halving.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "render/lines/projected_curve.h"
#include "render/lines/strokes.h"

namespace lekalo::render {

// A stretch of a line behind so many sheets.
struct VisiblePiece {
  geometry::Interval t;
  int layers = 0;
};
struct VisibleLine {
  Stroke stroke;
  std::shared_ptr<const ProjectedCurve> curve;  // its picture
  // Inside of the picture, by t; what reaches out of it goes on as it is at the picture's border.
  std::vector<VisiblePiece> pieces;
};
struct VisibleMark {
  Mark mark;
  Vec2 place{0};  // in pixels
  int layers = 0;
};
struct VisibleText {
  PointText text;
  Vec2 place{0};  // of its point, in pixels
  int layers = 0;
};
struct LineStatistics {
  int lines = 0, pieces = 0, crossings = 0, rays = 0;
  double seconds_of_lines = 0, seconds_of_crossings = 0, seconds_of_rays = 0;
};
struct VisibleLines {
  std::vector<VisibleLine> lines;  // drawn ones and borders of fills, in their order
  std::vector<VisibleMark> marks;
  std::vector<VisibleText> texts;
  int incomplete = 0;                           // surfaces whose outlines are not all known
  std::vector<std::string> incomplete_objects;  // theirs, in words
  LineStatistics statistics;
};

// Of drawing_work(world), perhaps with lines and points of annotations. `progress`: the share that is done.
VisibleLines visible_lines(const World& world, LineWork work, const std::function<void(double)>& progress = {});

}  // namespace lekalo::render
