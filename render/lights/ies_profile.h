// Light of a luminaire by direction, as its maker measured it: IES files (ANSI/IESNA LM-63-2002), photometry of type C.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "render/spectrum.h"

namespace lekalo::render {

class IesError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class IesProfile {
 public:
  // The text of a file. Throws IesError, which says what is wrong and where.
  explicit IesProfile(const std::string& text);

  // Share of the largest intensity that goes into a unit direction of the luminaire's frame: z down its axis (vertical
  // angle 0), x at the horizontal angle 0. Linear between the measured angles; nothing beyond them.
  double share(const Vec3& direction) const;
  double largest() const { return largest_; }  // candela

 private:
  double measured(double horizontal, double vertical) const;

  std::vector<double> vertical_, horizontal_;  // degrees, growing
  std::vector<double> candela_;                // [horizontal][vertical]
  double largest_ = 0;
};

}  // namespace lekalo::render
