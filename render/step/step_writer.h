// The entities of a STEP file: numbered, one a line (ISO 10303-21).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "geometry/vectors.h"

namespace lekalo::render {

// A number with its shortest exact digits and the decimal point that the format asks for.
std::string step_real(double x);
// In quotes; letters beyond ASCII as \X2\....\X0\ (ISO 10646).
std::string step_string(std::string_view text);

class StepWriter {
 public:
  // The name of the new entity: "#12".
  std::string add(const std::string& entity);
  // The same, or that of an equal one: of geometry, which need not be there twice.
  std::string shared(const std::string& entity);
  std::string point(const geometry::Vec3& p);
  std::string direction(const geometry::Vec3& d);
  // A place with the axis z and the direction x.
  std::string placement(const geometry::Vec3& origin, const geometry::Vec3& z, const geometry::Vec3& x);
  const std::string& lines() const { return lines_; }

 private:
  std::string lines_;
  std::unordered_map<std::string, std::string> shared_;
  int count_ = 0;
};

std::string step_list(std::span<const std::string> items);

}  // namespace lekalo::render
