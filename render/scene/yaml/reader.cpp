// Builds Values from the events of yaml-cpp (0.7), the only file that includes it. The library is used through its
// event interface: its node trees keep duplicate keys and expand aliases without bound.
#include "render/scene/yaml/reader.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <istream>
#include <streambuf>
#include <unordered_map>

#include "render/scene/values/characters.h"
#include "render/scene/values/scalars.h"

namespace lekalo::render {

namespace {

class ViewBuffer : public std::streambuf {
 public:
  explicit ViewBuffer(const std::string& text) {
    char* begin = const_cast<char*>(text.data());  // NOLINT: a get area is never written to
    setg(begin, begin, begin + text.size());
  }
};

class ValueBuilder : public YAML::EventHandler {
 public:
  ValueBuilder(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics)
      : text_(file->text), places_(file), diagnostics_(diagnostics) {}

  Value take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  // Aliases never come: check_syntax() refuses them.
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { scalar(mark, {}, false, true); }
  // Empty values, null and ~ have been reported by check_syntax().
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { scalar(mark, {}, false, true); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string& text) override {
    const char first = offset(mark) < text_.size() ? text_[offset(mark)] : ' ';
    const bool quoted = first == '\'' || first == '"' || first == '|' || first == '>';
    scalar(mark, text, quoted, false);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    begin(mark, Value::Kind::sequence);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    begin(mark, Value::Kind::map);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapEnd() override { end(); }

 private:
  struct Open {
    Value value;
    bool key_read = false;  // of a map: the next event is the value of `key`
    Key key;
    bool key_invalid = false;
    std::unordered_map<std::string, std::size_t> index;  // key -> index of its entry; of large maps only
  };

  static std::size_t offset(const YAML::Mark& mark) { return mark.pos < 0 ? 0 : static_cast<std::size_t>(mark.pos); }

  // Bytes that a scalar takes in the text, for underlining it.
  std::size_t extent(std::size_t at, const std::string& text, bool quoted) const {
    if (!quoted) return std::max<std::size_t>(1, text.size());
    const char quote = text_[at];
    if (quote != '\'' && quote != '"') return 1;
    std::size_t i = at + 1;
    for (; i < text_.size() && text_[i] != '\n'; ++i) {
      if (quote == '"' && text_[i] == '\\') {
        ++i;
      } else if (text_[i] == quote) {
        if (quote == '"' || i + 1 >= text_.size() || text_[i + 1] != quote) break;
        ++i;
      }
    }
    return i + 1 - at;
  }

  void scalar(const YAML::Mark& mark, const std::string& text, bool quoted, bool invalid) {
    const std::size_t at = offset(mark);
    Value value;
    value.quoted = quoted;
    value.invalid = invalid;
    value.text = text;
    value.place = places_.at(at, invalid ? 1 : extent(at, text, quoted));
    const bool is_key = !open_.empty() && open_.back().value.is_map() && !open_.back().key_read;
    if (is_key)
      key(std::move(value));
    else
      add(std::move(value));
  }

  void key(Value&& name) {
    Open& map = open_.back();
    map.key_read = true;
    map.key_invalid = name.invalid;
    if (!name.invalid) {
      if (const auto slip = key_slip(name)) {
        diagnostics_.error(name.place, slip->message, slip->hint);
        map.key_invalid = true;
      }
    }
    map.key = {std::move(name.text), std::move(name.place)};
  }

  void begin(const YAML::Mark& mark, Value::Kind kind) {
    Open open;
    open.value.kind = kind;
    open.value.place = places_.at(offset(mark), 1);
    open_.push_back(std::move(open));
  }

  void end() {
    Value value = std::move(open_.back().value);
    open_.pop_back();
    add(std::move(value));
  }

  void add(Value&& value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    Open& parent = open_.back();
    if (parent.value.is_sequence()) {
      parent.value.items.push_back(std::move(value));
      return;
    }
    parent.key_read = false;
    if (parent.key_invalid) return;
    const Entry* first = find(parent);
    if (!first) {
      parent.value.entries.push_back({std::move(parent.key), std::move(value)});
      return;
    }
    const Place& before = first->key.place;
    diagnostics_.error(
        parent.key.place,
        fmt::format("'{}' is given twice, in lines {} and {}", parent.key.name, before.line, parent.key.place.line),
        "remove one of them", {Diagnostics::note(before, "the first is here")});
  }

  // The entry of an open map that has the same key as the current one.
  static const Entry* find(Open& map) {
    constexpr std::size_t kSmall = 16;
    std::vector<Entry>& entries = map.value.entries;
    if (entries.size() < kSmall) return map.value.find_entry(map.key.name);
    if (map.index.empty())
      for (std::size_t i = 0; i < entries.size(); ++i) map.index.emplace(entries[i].key.name, i);
    const auto [found, is_new] = map.index.emplace(map.key.name, entries.size());
    return is_new ? nullptr : &entries[found->second];
  }

  std::string_view text_;
  PlaceFinder places_;
  Diagnostics& diagnostics_;
  std::vector<Open> open_;
  Value root_;
};

}  // namespace

Value read_document(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics, const ReadLimits& limits) {
  Value failed;
  failed.kind = Value::Kind::map;
  failed.invalid = true;
  failed.place = {file, 1, 1, 1};
  if (!check_syntax(file, limits, diagnostics)) return failed;
  ValueBuilder builder(file, diagnostics);
  try {
    ViewBuffer buffer(file->text);
    std::istream stream(&buffer);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
  } catch (const YAML::Exception& error) {
    // The recognizer above lets through only what the library reads; the fuzzer looks for exceptions to that.
    const std::size_t at = error.mark.pos < 0 ? 0 : static_cast<std::size_t>(error.mark.pos);
    diagnostics.error(PlaceFinder(file).at(at), "this cannot be read as YAML",
                      "simplify the line: quotes, one entry a line");
    return failed;
  }
  Value root = builder.take_root();
  if (root.is_map()) return root;
  if (!root.invalid)
    diagnostics.error(root.place, fmt::format("a scene file is a map of sections, not {}", kind_name(root)),
                      "it begins with 'lekalo: 1'");
  return failed;
}

}  // namespace lekalo::render
