// Reconstruction filters: how much a sample counts for a pixel, by the distance from the sample to the pixel's centre.
// Separable, f(dx) f(dy); the film divides by the sum of weights.
#pragma once

#include <memory>
#include <string>

namespace lekalo::render {

// Of the radius, in pixels.
inline constexpr double kMinFilterRadius = 0.5, kMaxFilterRadius = 16;

class Filter {
 public:
  virtual ~Filter() = default;
  // Pixels from a pixel's centre within which samples count, along x and along y.
  double radius() const { return radius_; }
  // f(d); 0 for |d| >= radius (a box includes its left and lower border).
  virtual double weight(double d) const = 0;

 protected:
  explicit Filter(double radius) : radius_(radius) {}

 private:
  double radius_;
};

// box: 1 within the radius (0.5). gaussian: e^(-d^2/(2 s^2)) less its value at the radius (1.5), s = radius/3.
// mitchell: the cubic of Mitchell and Netravali (1988) with B = C = 1/3, stretched to the radius (2).
// radius 0 stands for the radius in parentheses. Throws std::invalid_argument for another name or a radius outside of
// the range above.
std::unique_ptr<const Filter> make_filter(const std::string& name, double radius);

}  // namespace lekalo::render
