// Whether a closed plane curve is the rim of a sheet that may overlap itself: the image of the border of a disc under a
// map that is one-to-one near every point, its inside to the left (Zavyalov, Leus, Skorospelov 1985, III.4; Blank
// 1967).
//
// A polygon is such a rim if its turning number is 1 and it is cut by diagonals into triangles that all run
// counterclockwise (Shor, Van Wyk 1992): with the angles of n - 2 triangles the sum of the inner angles is right, and
// so is every single one. The curve is taken as a polygon that crosses itself as often.
#pragma once

#include <optional>

#include "geometry/curve.h"

namespace lekalo::geometry {

struct SheetRim {
  int turning_number = 0;  // counterclockwise about the normal with a positive largest component
  int crossings = 0;       // of the curve with itself
  bool is_rim = false;     // of one that runs clockwise: after reversing it
  // Whether the secant between two points of the rim, the section of a plane or of a cylinder, is the image of one line
  // on the sheet.
  std::optional<bool> is_connected;
};

// `chord`: parameters of the two points; `secant`: a curve from one to the other, null: the straight line. Throws
// std::invalid_argument for a curve that is not plane or not closed, that touches itself or runs through a part twice,
// a chord without length, or a secant that leaves the plane or does not end at its points.
SheetRim sheet_rim(const Curve& curve, const std::optional<std::pair<double, double>>& chord = std::nullopt,
                   const Curve* secant = nullptr);

}  // namespace lekalo::geometry
