// Merging the sections of an included file with those of the file that includes it (rules in include.h).
#pragma once

#include <string>

#include "render/scene/values/diagnostics.h"
#include "render/scene/values/value.h"

namespace lekalo::render {

/// Gives all names that the root of a file defines in its named sections a prefix and a dot.
void prefix_names(Value& root, const std::string& prefix);

/// Adds a further included root to those before it; parameters that `including` gives itself may stand in both.
void merge_sibling(Value& roots, Value&& further, const Value& including, Diagnostics& diagnostics);

/// The including file's root over everything that it includes.
Value merge_over(Value&& included, Value&& including, Diagnostics& diagnostics);

}  // namespace lekalo::render
