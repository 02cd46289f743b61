// Lists of commands of this program, one a line, as documents write them for figures that they lack:
//
//   draw 'ring.yaml' --quiet -o 'lekalo/0f3c.pdf' --width 84 --set 'r=0.5'
#pragma once

#include <string>

namespace lekalo::command {

// Runs the draw, render and make commands of the file whose outputs (-o) are not all there, as many at a time as there
// are cores; folders are made. Gives the largest of their exit codes. Throws UsageError for other lines, before
// anything is run, and ImageError if the file cannot be read.
int make_listed(const std::string& file, bool quiet);

}  // namespace lekalo::command
