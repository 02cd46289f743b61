#include "render/lights/ies_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace lekalo::render {

namespace {

constexpr double kDegrees = 180 / geometry::kPi;

// The numbers after the line TILT, each with its own message when it is missing.
class Numbers {
 public:
  explicit Numbers(std::istream& stream) : stream_(stream) {}
  double next(const char* what) {
    std::string word;
    while (stream_ >> word) {
      size_t end = 0;
      double value = 0;
      try {
        value = std::stod(word, &end);
      } catch (const std::exception&) {
        end = 0;
      }
      if (end != word.size())
        throw IesError(fmt::format("'{}' stands where {} should be (number {})", word, what, count_ + 1));
      ++count_;
      if (!std::isfinite(value)) throw IesError(fmt::format("{} is no finite number (number {})", what, count_));
      return value;
    }
    throw IesError(fmt::format("the file ends after {} numbers, where {} should be", count_, what));
  }
  int count(const char* what, int most) {
    const double value = next(what);
    if (value < 1 || value > most || value != std::floor(value))
      throw IesError(fmt::format("{} is {}, not a number of angles from 1 to {}", what, value, most));
    return static_cast<int>(value);
  }
  std::vector<double> angles(const char* what, int n) {
    std::vector<double> values;
    for (int i = 0; i < n; ++i) {
      values.push_back(next(what));
      if (i > 0 && values[i] <= values[i - 1])
        throw IesError(fmt::format("the {}s do not grow: {} after {}", what, values[i], values[i - 1]));
    }
    return values;
  }

 private:
  std::istream& stream_;
  int count_ = 0;
};

// Index of the interval of the growing values that holds x, and the share of it before x.
std::pair<size_t, double> between(const std::vector<double>& values, double x) {
  if (values.size() == 1) return {0, 0};
  const auto after = std::upper_bound(values.begin() + 1, values.end() - 1, x);
  const size_t i = static_cast<size_t>(after - values.begin()) - 1;
  return {i, std::clamp((x - values[i]) / (values[i + 1] - values[i]), 0.0, 1.0)};
}

}  // namespace

IesProfile::IesProfile(const std::string& text) {
  std::string blank = text;  // numbers may stand apart by commas, too
  std::replace(blank.begin(), blank.end(), ',', ' ');
  std::istringstream stream(blank);
  std::string line;
  bool found = false;
  while (!found && std::getline(stream, line)) found = line.starts_with("TILT=");
  if (!found) throw IesError("no line begins with TILT=: this is no IES file, or it is cut short");
  if (!line.starts_with("TILT=NONE")) throw IesError("only TILT=NONE is read, found " + line.substr(0, 40));
  Numbers numbers(stream);
  numbers.next("the number of lamps");
  numbers.next("the lumens of a lamp");
  const double multiplier = numbers.next("the multiplier");
  const int vertical = numbers.count("the number of vertical angles", 10000);
  const int horizontal = numbers.count("the number of horizontal angles", 10000);
  if (const double type = numbers.next("the type of photometry"); type != 1)
    throw IesError(fmt::format("photometry of type {}; only type C (1) is read", type));
  for (const char* what :
       {"the unit", "the width", "the length", "the height", "the ballast factor", "the future use", "the watts"})
    numbers.next(what);
  vertical_ = numbers.angles("vertical angle", vertical);
  horizontal_ = numbers.angles("horizontal angle", horizontal);
  if (vertical_.front() < 0 || vertical_.back() > 180) throw IesError("vertical angles lie between 0 and 180");
  const double last = horizontal_.back();
  if (horizontal_.front() != 0 || (last != 0 && last != 90 && last != 180 && last != 360))
    throw IesError("horizontal angles begin at 0 and end at 0, 90, 180 or 360");
  for (int i = 0; i < vertical * horizontal; ++i)
    candela_.push_back(std::max(0.0, multiplier * numbers.next("an intensity")));
  largest_ = *std::max_element(candela_.begin(), candela_.end());
  if (largest_ <= 0) throw IesError("all intensities are zero");
}

double IesProfile::measured(double horizontal, double vertical) const {
  if (vertical < vertical_.front() || vertical > vertical_.back()) return 0;
  const auto [i, a] = between(horizontal_, horizontal);
  const auto [j, b] = between(vertical_, vertical);
  const size_t n = vertical_.size();
  const auto at = [&](size_t h, size_t v) {
    return candela_[std::min(h, horizontal_.size() - 1) * n + std::min(v, n - 1)];
  };
  return (1 - a) * ((1 - b) * at(i, j) + b * at(i, j + 1)) + a * ((1 - b) * at(i + 1, j) + b * at(i + 1, j + 1));
}

double IesProfile::share(const Vec3& direction) const {
  const double vertical = std::acos(std::clamp(direction.z, -1.0, 1.0)) * kDegrees;
  double horizontal = std::atan2(direction.y, direction.x) * kDegrees;
  if (horizontal < 0) horizontal += 360;
  const double last = horizontal_.back();  // what is measured of a symmetric luminaire is mirrored
  if (last <= 180 && horizontal > 180) horizontal = 360 - horizontal;
  if (last <= 90 && horizontal > 90) horizontal = 180 - horizontal;
  if (last == 0) horizontal = 0;
  return measured(horizontal, vertical) / largest_;
}

}  // namespace lekalo::render
