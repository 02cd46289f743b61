// Look-up in values and places inside scalars.
#include "render/scene/values/value.h"

#include <algorithm>

#include "render/scene/values/characters.h"

namespace lekalo::render {

const Entry* Value::find_entry(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key.name == key; });
  return found == entries.end() ? nullptr : &*found;
}

const Value* Value::find(std::string_view key) const {
  const Entry* entry = find_entry(key);
  return entry ? &entry->value : nullptr;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(static_cast<const Value*>(this)->find(key));  // NOLINT: the object is not const here
}

Place Value::place_of(std::size_t offset, std::size_t length) const {
  if (!place.file || place.line < 1) return place;
  const std::string_view line = place.file->line(place.line);
  std::size_t begin = 0;
  for (int column = 1; column < place.column && begin < line.size(); ++column)
    begin += static_cast<std::size_t>(decode_utf8(line, begin).length);
  if (quoted) ++begin;
  if (begin > line.size() || line.compare(begin, text.size(), text) != 0 || offset > text.size()) return place;
  Place inside = place;
  inside.column += (quoted ? 1 : 0) + static_cast<int>(count_code_points(std::string_view(text).substr(0, offset)));
  inside.length = std::max(1, static_cast<int>(count_code_points(std::string_view(text).substr(offset, length))));
  return inside;
}

const char* kind_name(const Value& value) {
  switch (value.kind) {
    case Value::Kind::scalar:
      return value.quoted ? "a text in quotes" : "a single value";
    case Value::Kind::sequence:
      return "a list";
    case Value::Kind::map:
      return "a map";
  }
  return "";
}

}  // namespace lekalo::render
