#include "render/drawing/output/element_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lekalo::render {

std::string name_token(std::string_view name) {
  std::string result;
  for (const char c : name) {
    const bool letter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
    const bool other = (c >= '0' && c <= '9') || c == '-' || c == '.';
    if (result.empty() && !letter) result += '_';
    result += letter || other ? c : '_';
  }
  return result;
}

std::string ElementNames::unique(const std::string& name) {
  const std::string token = name_token(name);
  int& number = last_number_[token];
  std::string id = token;
  while (!taken_.insert(id).second) id = fmt::format("{}_{}", token, number = std::max(number, 1) + 1);
  return id;
}

std::string ElementNames::next() {
  return within_.empty() ? std::string() : unique(fmt::format("{}-{}", within_, ++number_));
}

// block, block-sharp, block-hidden, block-sharp-hidden-layers-1.
std::string ElementNames::name_of(const SheetGroup& group) {
  std::string classes = group.kind;
  std::replace(classes.begin(), classes.end(), ' ', '-');
  if (group.object.empty()) return unique(panel_ + classes);
  for (const std::string_view whole : {"object", "panel"})
    if (group.kind.starts_with(whole)) return unique(panel_ + group.object + classes.substr(whole.size()));
  return unique(panel_ + group.object + "-" + classes);
}

ElementNames::Within::Within(ElementNames& names, const SheetGroup& group)
    : names_(names),
      name_(names.name_of(group)),
      within_(std::exchange(names.within_, name_)),
      panel_(names.panel_),
      number_(std::exchange(names.number_, 0)) {
  if (group.kind == "panel") names.panel_ = name_ + "-";
}

ElementNames::Within::~Within() { names_.within_ = within_, names_.panel_ = panel_, names_.number_ = number_; }

}  // namespace lekalo::render
