// Changes of sign of a polynomial in Bernstein form, in order and without allocation, for rays.
//
// The signs are those of the computed numbers, zero counted as positive: a cell whose coefficients have one sign is
// left out, one with a single change of sign has one crossing (Lane, Riesenfeld 1981), any other is halved.
// Neighbouring cells share the value at their border, so crossings to minus and to plus alternate, and their number
// fits the signs at the ends. Only what lies below the noise, the bound on the coefficients' errors, can be wrong: two
// crossings between which the polynomial does not differ from zero by more count as a touch, which has two or none.
//
// Where all coefficients of a cell are below the noise no halving can tell more. Such a stretch is asked for once more
// on its own, where the noise is that of its surroundings alone. A touch that is left, if it counts, is two crossings,
// at the ends of the stretch, so that sheets that meet in a line or a point have no hole there.
#pragma once

#include <array>

namespace lekalo::geometry {

// A polynomial of s that can be had in Bernstein form on parts of [0, 1].
class BernsteinSource {
 public:
  static constexpr int kMaxDegree = 24;
  // Writes the coefficients over [s0, s1]; the result bounds their errors.
  virtual double coefficients(double s0, double s1, double* b) const = 0;
  // Whether a touch at s counts; the sign beside it.
  virtual bool is_touched(double s, bool positive) const = 0;

 protected:
  ~BernsteinSource() = default;
};

struct Crossings {
  static constexpr int kMaxCount = 64;
  bool begins_positive = true, ends_positive = true;
  int count = 0;
  std::array<double, kMaxCount> s;  // in [0, 1], in order
};

// With `first_only` the first one suffices; the sign at the end is then not known.
void find_crossings(const BernsteinSource& polynomial, int degree, bool first_only, Crossings& found);

}  // namespace lekalo::geometry
