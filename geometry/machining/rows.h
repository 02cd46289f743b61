// Where rows over a surface lie: lines of a parameter, or sections by parallel planes (Zavyalov, Leus, Skorospelov
// 1985, V.1). Rows are so far apart that the strips about them meet: by the least width of each,
//
//   parameter held   dw = e |the change of w by a unit of length across the row|
//   planes           dx = e |chi N|,   N the normal of the planes
//
// e the width of the strip within the height (geometry/machining/strip.h). The book takes the length of the change of
// (u, v) for dw, which is the same where the parameter lines cross at right angles and too much elsewhere.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "geometry/machining/strip.h"

namespace lekalo::geometry {

// A row: its contact, with an image over [0, 1] or another range, and its place among the rows.
struct PathRow {
  SurfaceContact contact;
  double at = 0;  // of the held parameter, or along the normal of the planes
};

// Whatever makes the rows at a place; none where there are none.
class RowFamily {
 public:
  // along_u: v is held. The rows cover a rectangle of the domain.
  static RowFamily of_parameter(const SurfaceContact& base, bool along_u, const Rectangle& part);
  // Of the planes through `origin` with the unit normal.
  static RowFamily of_planes(const SurfaceContact& base, const Vec3& origin, const Vec3& normal);

  // Between the first and the last row, or beyond which there are none.
  const Interval& range() const { return range_; }
  bool has_rows_at_ends() const { return !normal_; }
  bool is_closed() const { return is_closed_; }
  std::vector<PathRow> at(double place) const;
  // The least distance to the next row for strips within a height; infinite where the cutter fits the part.
  double step(const PathRow& row, double height) const;
  // The largest height of cusps between rows at this distance.
  double scallop(const PathRow& row, double distance) const;

 private:
  RowFamily(SurfaceContact base) : base_(std::move(base)) {}
  // The change of the place by a unit of length across the row.
  double rate(const PathRow& row, double t, const ContactBend& bend) const;

  SurfaceContact base_;
  Interval range_;
  Rectangle part_;
  bool along_u_ = true, is_closed_ = false;
  std::optional<Vec3> normal_;
  Vec3 origin_{0};
};

// How rows are spread over a family.
struct RowSpacing {
  std::optional<int> count;
  std::optional<double> distance, height;  // at most so far apart; cusps at most so high
};
// In order. Throws FieldError: `spacing` or `scallop` for too many, `scallop` for a cutter that leaves no strip.
std::vector<double> row_places(const RowFamily& family, const RowSpacing& spacing);

}  // namespace lekalo::geometry
