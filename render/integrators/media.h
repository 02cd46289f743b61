// The media that a ray is inside of, with priorities for bodies that overlap (Schmidt and Budge 2002): of the media
// around a place the one of the highest priority fills it, of equal ones the one entered last. A boundary that does not
// change the filling medium is no boundary for light.
#pragma once

#include <array>

#include "render/material.h"

namespace lekalo::render {

class Media {
 public:
  Media() : count_(0) {}
  // Only what is entered is copied: rays through air carry none.
  Media(const Media& other) : count_(other.count_) { copy(other); }
  Media& operator=(const Media& other) {
    count_ = other.count_;
    copy(other);
    return *this;
  }

  bool is_air() const { return count_ == 0; }
  // The medium that fills the place; air (index 1, no absorption) outside all bodies.
  Medium current() const { return count_ == 0 ? Medium{} : entries_[strongest()].medium; }

  // `instance` numbers the copy of the body; a body that is entered twice (a wrong mesh) counts once.
  void enter(int64_t instance, const Medium& medium) {
    leave(instance);
    if (count_ == kMaxMedia) {  // forget the outermost: nobody nests so many bodies
      for (int i = 1; i < count_; ++i) entries_[i - 1] = entries_[i];
      --count_;
    }
    entries_[count_++] = {instance, medium};
  }

  void leave(int64_t instance) {
    for (int i = 0; i < count_; ++i) {
      if (entries_[i].instance != instance) continue;
      for (int j = i + 1; j < count_; ++j) entries_[j - 1] = entries_[j];
      --count_;
      return;
    }
  }

  bool is_inside(int64_t instance) const {
    for (int i = 0; i < count_; ++i)
      if (entries_[i].instance == instance) return true;
    return false;
  }

  // The body that fills the place, -1 outside all.
  int64_t filling() const { return count_ == 0 ? -1 : entries_[strongest()].instance; }

 private:
  struct Entry {
    int64_t instance = -1;
    Medium medium;
  };
  int strongest() const {
    int best = 0;
    for (int i = 1; i < count_; ++i)
      if (entries_[i].medium.priority >= entries_[best].medium.priority) best = i;
    return best;
  }

  void copy(const Media& other) {
    for (int i = 0; i < count_; ++i) entries_[i] = other.entries_[i];
  }

  static constexpr int kMaxMedia = 8;
  union {
    std::array<Entry, kMaxMedia> entries_;  // not initialised: nearly all of it is never used
  };
  int count_;
};

}  // namespace lekalo::render
