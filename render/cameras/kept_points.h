// The points of shapes that views of a drawing are framed by (framed_content.h), found once for all of them.
#pragma once

namespace lekalo::render {

// While one lives, the points found on a shape are kept for all content that shows it: panels are framed many times.
class KeptPoints {
 public:
  KeptPoints();
  ~KeptPoints();
  KeptPoints(const KeptPoints&) = delete;
  KeptPoints& operator=(const KeptPoints&) = delete;
};

}  // namespace lekalo::render
