// Values of a scene file as written: nothing evaluated, no type decided by the text, everything with its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/scene/values/source.h"

namespace lekalo::render {

struct Key {
  std::string name;
  Place place;
};

struct Entry;

/// A scalar, a sequence or a map. Cheap to move; copying copies everything below.
struct Value {
  enum class Kind { scalar, sequence, map };

  Kind kind = Kind::scalar;
  bool quoted =
      false;  ///< a scalar in single or double quotes or a block of text: text, never a number or keyword slip
  bool invalid = false;        ///< an error about this value has been reported already: say nothing more about it
  Place place;                 ///< of the scalar, the opening bracket, or the first key or dash of a block
  std::string text;            ///< of a scalar, quotes and escapes resolved
  std::vector<Value> items;    ///< of a sequence
  std::vector<Entry> entries;  ///< of a map, in written order

  bool is_scalar() const { return kind == Kind::scalar; }
  bool is_sequence() const { return kind == Kind::sequence; }
  bool is_map() const { return kind == Kind::map; }

  /// The entry, or its value, with this key; null where there is none and for scalars and sequences.
  const Entry* find_entry(std::string_view key) const;
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);

  /// The place of bytes `offset .. offset + length` of `text`: exact for scalars written on one line without escapes,
  /// otherwise the whole scalar. For errors inside formulas.
  Place place_of(std::size_t offset, std::size_t length) const;
};

struct Entry {
  Key key;
  Value value;
};

/// "a number or word", "a list", "a map": for messages that say what was found.
const char* kind_name(const Value& value);

}  // namespace lekalo::render
