// Functions of shared libraries (include/lekalo/external.h), loaded while the program runs.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "geometry/external/external_function.h"

namespace lekalo::render {

// The function `name` of `parameter_count` parameters (1: lekalo_curve, 2: lekalo_surface) from a library, which is
// loaded once for all its functions and stays as long as one of them. `numbers` are what it gets as its first argument.
// Calls of one library come one at a time unless `concurrent`. Loading it or a call that takes longer than `timeout`
// seconds ends the process, with a message and exit code 4: code in this process cannot be stopped. Throws
// geometry::FieldError (library, function).
std::shared_ptr<const geometry::ExternalFunction> load_function(const std::filesystem::path& library,
                                                                const std::string& name, int parameter_count,
                                                                std::vector<double> numbers, bool concurrent,
                                                                double timeout);

// A library runs in this process and may end it. If this thread is inside of one, writes to stderr which call that is
// and `what` it did: "lekalo: 'wave' ended the program at u = 0.5, v = 2"; false if it is not. Async-signal-safe. From
// the first library on a signal that kills the process is told so.
bool tell_library_call(const char* what);

}  // namespace lekalo::render
