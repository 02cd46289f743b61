#include "geometry/numerics/crossings.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {
namespace {

constexpr int kMaxCoefficients = BernsteinSource::kMaxDegree + 1;
constexpr int kDeepest = 48;  // halvings: cells of 2^-48 are at the resolution of s

// A crossing in a cell whose coefficients are so much smaller than those of the whole is computed from its own, which
// have lost less to rounding.
constexpr double kSmallCell = 1e-3;

bool is_positive(double x) { return x >= 0; }

// The right half stays in b.
void halve(double* b, double* left, int n) {
  left[0] = b[0];
  for (int level = 1; level <= n; ++level) {
    for (int i = 0; i <= n - level; ++i) b[i] = 0.5 * (b[i] + b[i + 1]);
    left[level] = b[0];
  }
}

// Where the only change of sign is, in [0, 1] of the cell. From the end that lies on its side of the middle the
// polynomial is (1 - s)^n g(r) with g(r) = sum C(n, i) b_i r^i, r = s / (1 - s) in [0, 1]: Newton's iteration on g,
// kept in a bracket.
double crossing(const double* b, int n, double noise, double precision) {
  double c[kMaxCoefficients];
  double binomial = 1, middle = 0;
  for (int i = 0; i <= n; ++i) {
    c[i] = binomial * b[i];
    middle += c[i];
    binomial = binomial * (n - i) / (i + 1);
  }
  const bool left = is_positive(middle) != is_positive(b[0]);
  if (!left) std::reverse(c, c + n + 1);
  const bool rising = !is_positive(c[0]);
  const double start = b[0] / (b[0] - b[n]), s = left ? std::min(start, 0.5) : std::min(1 - start, 0.5);
  double lo = 0, hi = 1, r = s / (1 - s);
  double previous = 1;
  for (int step = 0; step < 100; ++step) {
    double g = c[n], slope = 0;
    for (int i = n - 1; i >= 0; --i) {
      slope = slope * r + g;
      g = g * r + c[i];
    }
    (is_positive(g) == rising ? hi : lo) = r;
    double next = r - g / slope;
    if (!(lo <= next && next <= hi)) next = 0.5 * (lo + hi);
    const double change = std::abs(next - r);
    r = next;
    // Steps shrink fast until rounding keeps them from it.
    if (change <= precision || (previous < 1e-6 && change > 0.25 * previous && std::abs(g) <= noise)) break;
    previous = change;
  }
  const double at = r / (1 + r);
  return left ? at : 1 - at;
}

// Signs of the slope beside a stretch below the noise; 0: not known.
struct Slopes {
  double before = 0, after = 0;
};

class Search {
 public:
  Search(const BernsteinSource& polynomial, int degree, bool first_only, Crossings& found)
      : polynomial_(polynomial), n_(degree), first_only_(first_only), found_(found) {}

  void run() {
    double cells[kDeepest + 1][kMaxCoefficients];
    const double noise = polynomial_.coefficients(0, 1, cells[0]);
    positive_ = found_.begins_positive = is_positive(cells[0][0]);
    found_.ends_positive = is_positive(cells[0][n_]);
    search(cells, 0, 1, noise, false, {});
    pass(1, found_.ends_positive);
  }

 private:
  using Cells = double[kDeepest + 1][kMaxCoefficients];

  // A part of [0, 1] on its own, `beside` it what the coefficients over the whole say.
  void run_again(double s0, double s1, const Slopes& beside) {
    double cells[kDeepest + 1][kMaxCoefficients];
    const double noise = polynomial_.coefficients(s0, s1, cells[0]);
    search(cells, s0, s1, noise, true, beside);
  }

  // From the coefficients in cells[0].
  void search(Cells& cells, double s0, double s1, double noise, bool again, const Slopes& beside) {
    struct Place {
      double begin;
      int depth;
    };
    Place places[kDeepest + 1];
    places[0] = {s0, 0};
    const double whole = largest(cells[0]);
    const bool ends_positive = is_positive(cells[0][n_]);
    bool unclear = false;  // in a stretch below the noise
    double unclear_begin = s0;
    Slopes slopes = beside;
    const auto close = [&](double end, bool positive_after, double slope_after) {
      if (!unclear) return;
      unclear = false;
      slopes.after = slope_after;
      if (!again && end - unclear_begin < 0.5 * (s1 - s0))
        run_again(unclear_begin, end, slopes);
      else
        add_unclear(unclear_begin, end, positive_after, slopes);
    };
    for (int top = 0; top >= 0;) {
      double* cell = cells[top];
      const double begin = places[top].begin, width = std::ldexp(s1 - s0, -places[top].depth);
      int changes = 0;
      double smallest = std::abs(cell[0]);
      for (int i = 1; i <= n_; ++i) {
        changes += is_positive(cell[i]) != is_positive(cell[i - 1]);
        smallest = std::min(smallest, std::abs(cell[i]));
      }
      const double ends = std::min(std::abs(cell[0]), std::abs(cell[n_]));
      const bool open = changes > 1 || (changes == 1 ? ends : smallest) <= noise;
      const bool deepest = places[top].depth == kDeepest;
      if (open && (deepest || largest(cell) <= noise)) {
        if (!unclear) unclear_begin = begin;
        unclear = true;
        --top;
      } else if (open) {
        halve(cell, cells[top + 1], n_);
        const int depth = places[top].depth + 1;
        places[top + 1] = {begin, depth};
        places[top] = {begin + 0.5 * width, depth};
        ++top;
      } else {
        close(begin, is_positive(cell[0]), cell[1] - cell[0]);
        pass(begin, is_positive(cell[0]));
        if (changes == 1) {
          if (!again && largest(cell) < kSmallCell * whole)
            run_again(begin, begin + width, {});
          else
            add(begin + width * crossing(cell, n_, noise, 0x1p-53 / width));
          pass(begin + width, is_positive(cell[n_]));
        }
        slopes.before = cell[n_] - cell[n_ - 1];
        --top;
      }
      if (first_only_ && found_.count > 0) return;
    }
    close(s1, ends_positive, beside.after);
  }

  double largest(const double* b) const {
    double result = 0;
    for (int i = 0; i <= n_; ++i) result = std::max(result, std::abs(b[i]));
    return result;
  }

  void add(double s) {
    if (found_.count == Crossings::kMaxCount) return;
    found_.s[found_.count++] = s;
    positive_ = !positive_;
  }
  // Coefficients computed anew may have another sign at a border, within the noise.
  void pass(double s, bool positive) {
    if (positive != positive_) add(s);
  }
  // A crossing or, where the polynomial comes down to zero and goes up again, a touch.
  void add_unclear(double s0, double s1, bool positive_after, const Slopes& slopes) {
    if (positive_after != positive_) return add(0.5 * (s0 + s1));
    const double sign = positive_ ? 1 : -1;
    if (sign * slopes.before < 0 && sign * slopes.after > 0 && polynomial_.is_touched(0.5 * (s0 + s1), positive_)) {
      add(s0);
      add(s1);
    }
  }

  const BernsteinSource& polynomial_;
  int n_;
  bool first_only_;
  Crossings& found_;
  bool positive_ = true;
};

}  // namespace

void find_crossings(const BernsteinSource& polynomial, int degree, bool first_only, Crossings& found) {
  found.count = 0;
  Search(polynomial, degree, first_only, found).run();
}

}  // namespace lekalo::geometry
