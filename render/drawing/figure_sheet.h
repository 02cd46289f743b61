// A finished drawing: its sheet, and what is to be said of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/drawing/sheet.h"
#include "render/drawing/visibility/hidden_lines.h"

namespace lekalo::render {

struct FigureOptions {
  std::string panel;                      // only this one; empty: the page
  double width = 0;                       // of the sheet in millimetres, its height in proportion; 0: the scene's
  int threads = 0;                        // of a ground that is rendered; 0: all
  std::function<void(double)> progress;   // the share of the lines that is done
  std::function<void(double)> rendering;  // of a ground that is rendered
};

struct Figure {
  Sheet sheet;
  LineStatistics statistics;
  double seconds_of_world = 0, seconds_of_ground = 0;
  int incomplete = 0;                           // surfaces of which not all lines are known
  std::vector<std::string> incomplete_objects;  // theirs, in words
  int open_areas = 0;                           // areas of fills whose border is not known all around
  std::vector<std::string> cut_off;             // texts that go over the page's edges, with what would have room
  std::vector<std::string> notes;               // on a ground that is rendered, a sentence each
  std::vector<std::string> left_out;            // what the scene asks for and drawings do not show
};

}  // namespace lekalo::render
