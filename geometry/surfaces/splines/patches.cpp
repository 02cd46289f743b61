#include "geometry/surfaces/splines/patches.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/surfaces/splines/bezier_surface.h"

namespace lekalo::geometry {

namespace {

// Lines of numbers, without comments and blank lines.
class NumberLines {
 public:
  explicit NumberLines(std::string_view text) : rest_(text) {}

  // The numbers of the next line that has any; empty at the end of the text.
  const std::vector<double>& next() {
    numbers_.clear();
    while (numbers_.empty() && !rest_.empty()) {
      const size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      read(line.substr(0, std::min(line.find('#'), line.size())));
    }
    return numbers_;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw FieldError("file", fmt::format("line {}: {}", number_, message),
                     "the file holds the number of patches, then 16 points of three numbers for each");
  }

 private:
  void read(std::string_view line) {
    constexpr std::string_view kBlank = " \t\r,";
    while (true) {
      line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
      if (line.empty()) return;
      const std::string_view word = line.substr(0, line.find_first_of(kBlank));
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
        fail(fmt::format("'{}' is not a number", word.substr(0, 40)));
      numbers_.push_back(value);
      line.remove_prefix(word.size());
    }
  }

  std::string_view rest_;
  std::vector<double> numbers_;
  int number_ = 0;
};

bool whole(double x, double lowest, double highest) { return x == std::floor(x) && x >= lowest && x <= highest; }

}  // namespace

std::vector<SurfacePtr> parse_patches(std::string_view text) {
  constexpr double kMaxPatches = 1e6;
  NumberLines lines(text);
  const std::vector<double> first = lines.next();
  if (first.size() != 1 || !whole(first[0], 1, kMaxPatches)) lines.fail("expected the number of patches");
  const int count = static_cast<int>(first[0]);

  std::vector<SurfacePtr> patches;
  Grid<Vec3> net{4, 4, {}};
  for (int patch = 0; patch < count; ++patch) {
    net.values.clear();
    for (int k = 0; k < net.rows * net.columns; ++k) {
      const std::vector<double>* numbers = &lines.next();
      if (k == 0 && numbers->size() == 2) {
        if (!whole((*numbers)[0], 1, kMaxDegree) || !whole((*numbers)[1], 1, kMaxDegree))
          lines.fail(fmt::format("expected two degrees from 1 to {}", kMaxDegree));
        net.rows = static_cast<int>((*numbers)[0]) + 1;
        net.columns = static_cast<int>((*numbers)[1]) + 1;
        numbers = &lines.next();
      }
      if (numbers->empty())
        lines.fail(fmt::format("the file ends in patch {} of {}, after {} of {} points", patch, count, k,
                               net.rows * net.columns));
      if (numbers->size() != 3)
        lines.fail(fmt::format("expected the three coordinates of point {} of patch {}, found {} number{}", k, patch,
                               numbers->size(), numbers->size() == 1 ? "" : "s"));
      net.values.emplace_back((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    }
    patches.push_back(std::make_shared<NurbsSurface>(bezier_surface(net)));
  }
  if (!lines.next().empty()) lines.fail(fmt::format("more points than those of {} patches", count));
  return patches;
}

}  // namespace lekalo::geometry
