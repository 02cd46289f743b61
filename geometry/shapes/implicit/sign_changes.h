// Where a function changes its sign along a line: collected in order, and searched by interval arithmetic.
#pragma once

#include <vector>

#include "geometry/queries/implicit_curves/implicit_formula.h"
#include "geometry/queries/rays/line_intersections.h"

namespace lekalo::geometry {

// Zero counts as positive.
inline bool is_positive(double value) { return !(value < 0); }

// Hits of face 0, added in order. They alternate between changes to plus and to minus.
class SignChanges {
 public:
  // `shift` is added to every t; with `first_only` one hit suffices. `with_jumps`: changes by a jump or at a pole
  // count.
  SignChanges(std::vector<SurfaceHit>& hits, double shift, bool first_only, bool with_jumps)
      : hits_(hits), shift_(shift), first_only_(first_only), with_jumps_(with_jumps) {}

  // Where this is not called the first pass() tells.
  void begin(bool positive) {
    positive_ = positive;
    has_begun_ = true;
  }
  bool has_begun() const { return has_begun_; }
  // The sign changes here.
  void add(double t) {
    hits_.push_back({t + shift_});
    positive_ = !positive_;
    found_ = true;
  }
  // The sign at t is known. Where it is not the last one, the change lies here to within the rounding.
  void pass(double t, bool positive) {
    if (!has_begun_)
      begin(positive);
    else if (positive != positive_)
      add(t);
  }
  // The same, but what changed is no zero.
  void jump(double t) {
    if (with_jumps_)
      add(t);
    else
      positive_ = !positive_;
  }
  bool positive() const { return positive_; }
  bool is_done() const { return first_only_ && found_; }

 private:
  std::vector<SurfaceHit>& hits_;
  double shift_;
  bool first_only_, with_jumps_;
  bool positive_ = true, has_begun_ = false;
  bool found_ = false;
};

// The only zero between lo and hi, where the signs differ: Newton's iteration from `start`, kept in the bracket, and
// halving where derivatives are not finite or tell nothing.
double find_zero(const ImplicitFormula& formula, const Line& line, double lo, double hi, bool rising, double start);

// Follows the sign of the formula along the line from t0 to t1 by halving: a part is done where the enclosure of F
// excludes zero, or that of its derivative where it is bounded. What is left where no halving tells more, by rounding
// or at 1e-13 of `size`, is a touch, two changes at its ends, or, where the signs there differ, one change; but if F
// does not come down to zero there it is a jump or a pole.
void follow_by_intervals(const ImplicitFormula& formula, const Line& line, double t0, double t1, double size,
                         SignChanges& changes);

}  // namespace lekalo::geometry
