// Errors and warnings about scene files: collected, sorted, shown with the line they are about.
//
//   ring.yaml:5:41: unknown field 'axes' of 'revolution_surface' (did you mean 'axis'?)
//       ring: { type: revolution_surface, of: section, axes: z }
//                                                      ^~~~
//   hint: ...
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

#include "render/scene/values/source.h"

namespace lekalo::render {

enum class Severity { error, warning, note };

/// One finding. The message is a sentence without capital and full stop; the hint says what to write instead.
struct Diagnostic {
  Severity severity = Severity::error;
  Place place;
  std::string message;
  std::string hint;
  std::vector<Diagnostic> notes;  ///< further places: "the first one is here"
};

class Diagnostics {
 public:
  static constexpr std::size_t kShownLimit = 100;  ///< text() shows so many and counts the rest

  void error(const Place& place, std::string message, std::string hint = {}, std::vector<Diagnostic> notes = {});
  void warning(const Place& place, std::string message, std::string hint = {}, std::vector<Diagnostic> notes = {});
  /// An error because a file named by the user (not by a scene) cannot be read; callers end with another exit code.
  void unreadable(const Place& place, std::string message, std::string hint = {});
  /// A finding to attach to another as one of its notes.
  static Diagnostic note(const Place& place, std::string message);

  bool has_errors() const { return error_count_ > 0; }
  bool cannot_read() const { return cannot_read_; }
  std::size_t error_count() const { return error_count_; }
  /// Findings that were counted but not kept.
  std::size_t dropped() const { return dropped_; }

  /// Without repetitions, in the order of the files' first appearance, then by line and column.
  std::vector<Diagnostic> sorted() const;
  /// All of it as the user reads it; ends in a line break unless empty.
  std::string text() const;

 private:
  void add(Diagnostic diagnostic);

  std::vector<Diagnostic> found_;
  std::size_t error_count_ = 0;
  std::size_t dropped_ = 0;
  bool cannot_read_ = false;
};

/// The word that a message or its hint proposes in place of what stands there ("did you mean 'axis'?"); empty if none
/// or several are.
std::string replacement_of(const Diagnostic& diagnostic);

/// What a function throws that cannot go on: carries everything found so far.
class SceneError : public std::exception {
 public:
  explicit SceneError(Diagnostics diagnostics) : diagnostics_(std::move(diagnostics)), text_(diagnostics_.text()) {}
  const Diagnostics& diagnostics() const { return diagnostics_; }
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  Diagnostics diagnostics_;
  std::string text_;
};

}  // namespace lekalo::render
