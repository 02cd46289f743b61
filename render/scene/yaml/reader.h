// The strict reader of one scene file: text -> Value, nothing evaluated.
#pragma once

#include <memory>

#include "render/scene/values/diagnostics.h"
#include "render/scene/values/value.h"
#include "render/scene/yaml/syntax.h"

namespace lekalo::render {

/// Reads a text of the YAML subset of syntax.h, or JSON. A syntax error ends the reading: the result is an empty map
/// marked invalid. Everything else (missing values, keys that are no names, keys given twice) is reported and reading
/// goes on; values with an error are marked invalid, of a key given twice the first stays. The root is always a map.
/// Never throws for anything in the text; time and memory are bounded by `limits`.
Value read_document(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics,
                    const ReadLimits& limits = {});

}  // namespace lekalo::render
