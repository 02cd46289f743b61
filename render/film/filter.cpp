#include "render/film/filter.h"

#include <cmath>
#include <stdexcept>

namespace lekalo::render {

namespace {

class Box final : public Filter {
 public:
  explicit Box(double radius) : Filter(radius) {}
  double weight(double d) const override { return d >= -radius() && d < radius() ? 1 : 0; }
};

class Gaussian final : public Filter {
 public:
  explicit Gaussian(double radius) : Filter(radius), edge_(bell(radius)) {}
  double weight(double d) const override { return std::fabs(d) < radius() ? bell(d) - edge_ : 0; }

 private:
  double bell(double d) const {
    const double s = radius() / 3;
    return std::exp(-0.5 * (d / s) * (d / s));
  }
  double edge_;
};

class Mitchell final : public Filter {
 public:
  explicit Mitchell(double radius) : Filter(radius) {}
  double weight(double d) const override {
    const double x = 2 * std::fabs(d) / radius();
    if (x >= 2) return 0;
    if (x >= 1) return (-(7.0 / 3) * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6;
    return (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6;
  }
};

}  // namespace

std::unique_ptr<const Filter> make_filter(const std::string& name, double radius) {
  if (radius != 0 && !(radius >= kMinFilterRadius && radius <= kMaxFilterRadius))
    throw std::invalid_argument("the filter's radius must lie between 0.5 and 16 pixels");
  if (name == "box") return std::make_unique<Box>(radius == 0 ? 0.5 : radius);
  if (name == "gaussian") return std::make_unique<Gaussian>(radius == 0 ? 1.5 : radius);
  if (name == "mitchell") return std::make_unique<Mitchell>(radius == 0 ? 2.0 : radius);
  throw std::invalid_argument("no filter is called '" + name + "' (box, gaussian, mitchell)");
}

}  // namespace lekalo::render
