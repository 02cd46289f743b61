// Names of what a drawing file has, so that documents and scripts can change it: objects have theirs, their lines name
// and kind (block, block-sharp, block-hidden), what stands in a group the group's with a number.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "render/drawing/sheet.h"

namespace lekalo::render {

// As XML has it for an id: letters, digits, - and ., the first a letter. All beyond ASCII are taken for letters.
std::string name_token(std::string_view name);

class ElementNames {
 public:
  // A name that no other element has.
  std::string unique(const std::string& name);
  // Of what stands in a group without being one; empty outside of all.
  std::string next();

  // While it lives, names are those of elements of the group.
  class Within {
   public:
    Within(ElementNames& names, const SheetGroup& group);
    ~Within();
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;
    const std::string& name() const { return name_; }

   private:
    ElementNames& names_;
    std::string name_, within_, panel_;
    int number_;
  };

 private:
  std::string name_of(const SheetGroup& group);

  std::set<std::string> taken_;
  std::map<std::string, int> last_number_;  // behind names that were taken
  std::string within_, panel_;              // name of the group; how names in its panel begin
  int number_ = 0;                          // of elements so far in the group
};

}  // namespace lekalo::render
