// Lines that lie on one another in the picture are drawn once.
//
// What others cover of a line is cut away; of a curve as far as it ends where a step of one of them does. A line that
// was drawn covers one that is no wider, no more opaque and, unless itself solid, not solid: of a wider one under it
// something would be missed. What is seen covers all that is hidden. Annotations do not cover lines of objects that are
// seen, nor these annotations: somebody wants both.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "render/drawing/paths/paths.h"

namespace lekalo::render {

class Overlaps {
 public:
  // How a line is drawn.
  struct Pen {
    double half_width = 0.5;  // of any unit
    double opacity = 1;
    bool solid = true, hidden = false;
    int object = -1;  // its number; -1: an annotation's
    bool operator==(const Pen&) const = default;
  };
  // What of the path is not drawn yet, in order; it counts as drawn then. Millimetres.
  std::vector<Path> left_of(const Path& path, const Pen& pen);

 private:
  // What a curve does between two of its places.
  struct Chord {
    Vec2 begin;  // of the step
    int step;
    double from, to;  // of the step, 0 to 1
  };
  struct Drawn {
    Vec2 lo{0}, hi{0};
    bool straight = false;
    Path path;
    Pen pen;
    std::vector<Vec2> places;   // of a curve, close together
    std::vector<Chord> chords;  // from each place to the next
    double bow = 0;             // how far the curve is from these, at most
    Vec2 from{0}, to{0};        // of a straight line
  };
  static void add_places(Drawn& drawn);
  std::vector<Path> left_of_line(const Drawn& own) const;
  std::vector<Path> left_of_curve(const Drawn& own) const;
  static Vec2 point_at(const Drawn& own, double x);
  std::vector<double> ends_on(const Drawn& own) const;
  bool is_covered(const Drawn& own, double from, double to, bool by_likes) const;
  static bool comes_near(const Drawn& drawn, size_t chord, const Vec2& place);
  static bool covers(const Pen& above, const Pen& below);
  bool is_covered(const Vec2& place, const Pen& pen, bool by_likes) const;
  // What was drawn near a place; near some line, each once.
  const std::vector<int>& near(const Vec2& place) const;
  std::vector<int> near(const std::vector<Vec2>& places) const;

  std::vector<Drawn> drawn_;
  std::unordered_map<int64_t, std::vector<int>> bins_;  // of those near a square of the page, by their numbers
};

}  // namespace lekalo::render
