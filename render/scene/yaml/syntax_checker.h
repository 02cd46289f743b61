// The recognizer behind check_syntax(): block structure (syntax_block.cpp), brackets (syntax_flow.cpp), scalars
// (syntax_scalars.cpp). Included by these files only.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/yaml/syntax.h"

namespace lekalo::render {

class SyntaxChecker {
 public:
  SyntaxChecker(const std::shared_ptr<const SourceFile>& file, const ReadLimits& limits, Diagnostics& diagnostics)
      : text_(file->text), places_(file), limits_(limits), diagnostics_(diagnostics) {}
  bool run();

 private:
  struct Stop {};  // thrown after the one syntax error has been reported

  // Bytes begin .. end of the text.
  struct Span {
    std::size_t begin = 0, end = 0;
    bool empty() const { return end <= begin; }
  };

  // A block map or list that is open at the current line.
  struct Level {
    int column;             // of its keys or dashes, from 0
    bool sequence;          // else a map
    Span entry;             // latest key or dash
    bool awaiting = false;  // the latest entry has no value yet
    Span scalar = {};       // its value, if that is a plain scalar
  };

  // A bracket that is open.
  struct Bracket {
    enum class Expect { first, entry, value, separator };
    std::size_t open;
    bool map;
    Expect expect = Expect::first;
    Span key = {};     // latest key of a map
    Span scalar = {};  // latest item or value, if that is a plain scalar
  };

  // syntax_block.cpp
  void document();
  bool next_line();  // to the first character of the next line with content; false at the end of the text
  bool document_marker_at(std::size_t at) const;
  void document_marker();
  void line(int column);
  void close_level();
  void node(int column);
  void dash(int column);
  bool at_dash() const { return peek() == '-' && blank_at(at_ + 1); }
  bool looks_like_entry() const;
  bool key_begins(Span& key, std::size_t& colon);
  void keyed_value(Span key, std::size_t colon);
  void inline_value();
  void block_text();
  void end_of_line(const char* after);
  void push_level(int column, bool sequence);
  [[noreturn]] void indentation_error(int column);
  [[noreturn]] void continuation_error();
  [[noreturn]] void not_a_key();
  [[noreturn]] void not_an_item();
  void value_missing(const Level& level);

  // syntax_flow.cpp
  void flow();
  void open_bracket();
  void close_bracket();
  void flow_key();
  void flow_value();
  void separator();
  void skip_to_flow_token();
  void flow_line();
  std::size_t color_comment(bool alone) const;  // length of a '#ff0000' at at_ that is a comment; 0: none
  [[noreturn]] void key_without_value();
  [[noreturn]] void missing_separator();
  [[noreturn]] void flow_error(Span at, const std::string& message, const std::string& hint);

  // syntax_scalars.cpp
  void quoted();             // at_ on the quote; moves behind the closing one
  void escape(bool dollar);  // checks one escape of a double-quoted text, with a $ in it or not; moves behind it
  Span plain(bool in_flow);  // at_ on the first character; moves behind the last one
  void check_first_character(bool in_flow);
  void check_plain(Span scalar, bool in_flow);
  void check_null(Span scalar);

  char peek() const { return at_ < text_.size() ? text_[at_] : '\n'; }
  char char_at(std::size_t i) const { return i < text_.size() ? text_[i] : '\n'; }
  bool blank_at(std::size_t i) const { return char_at(i) == ' ' || char_at(i) == '\t' || char_at(i) == '\n'; }
  std::string_view slice(Span s) const { return text_.substr(s.begin, s.end - s.begin); }
  std::size_t line_end(std::size_t from) const { return std::min(text_.find('\n', from), text_.size()); }
  bool at_line_end() const { return at_ >= text_.size() || text_[at_] == '\n' || text_[at_] == '#'; }
  void skip_blanks();        // spaces and tabs
  void skip_block_blanks();  // the same, but a tab before content is an error
  void count_node();
  void check_depth();
  void report(Span at, const std::string& message, const std::string& hint = {});
  [[noreturn]] void fail(Span at, const std::string& message, const std::string& hint = {},
                         std::vector<Diagnostic> notes = {});
  Place place(Span at) { return places_.at(at.begin, at.empty() ? 1 : at.end - at.begin); }
  Span here(std::size_t length = 1) const { return {at_, at_ + length}; }

  std::string_view text_;
  PlaceFinder places_;
  const ReadLimits& limits_;
  Diagnostics& diagnostics_;

  std::size_t at_ = 0;          // reading position, bytes
  std::size_t line_begin_ = 0;  // of the current line
  int indent_ = 0;              // its leading spaces
  bool begun_ = false;          // a line has been read
  bool marker_seen_ = false;    // a "---" on top has been read
  bool root_done_ = false;      // the root was a scalar or in brackets and is complete
  std::size_t nodes_ = 0;
  std::vector<Level> levels_;
  std::vector<Bracket> brackets_;
  int flow_indent_ = 0;      // indentation of the line on which the outermost bracket was opened
  std::size_t suspect_ = 0;  // first line inside brackets that looks like an entry outside them; 0: none
};

/// Whether `c` can be part of a name.
inline bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// At most 40 characters of `text`, for quoting in messages.
std::string shorten(std::string_view text);

}  // namespace lekalo::render
