// Functions of programs that read parameters and write numbers, line by line.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geometry/external/external_function.h"

namespace lekalo::render {

// Starts the program `command[0]` (looked for in PATH unless it has a slash) with its arguments. It reads one request a
// line from its standard input, the parameters and the order: "t order" (parameter_count 1) or "u v order" (2), and
// answers each with one line on its standard output: the point and the derivatives up to the order as
// include/lekalo/external.h lays them out, with blanks or commas between; or "error" and any words. It gets many
// requests before it must have answered the first; it ends when its input does. An answer that takes longer than
// `timeout` seconds is an error, as are a line that is none and the end of the program; what it wrote to its standard
// error is told then. Calls are made one at a time. Throws geometry::FieldError (command) if it cannot be started.
std::shared_ptr<const geometry::ExternalFunction> start_evaluator(const std::vector<std::string>& command,
                                                                  int parameter_count, double timeout);

}  // namespace lekalo::render
