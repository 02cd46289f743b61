// Points and normals between the lines of a wire frame (Zavyalov et al. 1985, III.3).
#include "geometry/surfaces/interpolation/frame_net.h"

#include <gtest/gtest.h>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {
namespace {

// Lines of the graph z = f(x, y) over straight ones of a grid that stands askew in the base plane.
std::vector<CurvePtr> frame_of(const std::string& z, int lines) {
  std::vector<CurvePtr> result;
  for (const bool first : {true, false})
    for (int k = 0; k < lines; ++k) {
      const std::string at = std::to_string(-1.0 + 2.0 * k / (lines - 1));
      const std::string a = first ? "t" : "(" + at + ")", b = first ? "(" + at + ")" : "t";
      const std::string x = "(" + a + " + 0.2*" + b + ")", y = "(" + b + " - 0.1*" + a + ")";
      std::string height = z;
      for (const auto& [letter, value] : {std::pair('X', x), std::pair('Y', y)})
        for (size_t at_letter; (at_letter = height.find(letter)) != std::string::npos;)
          height.replace(at_letter, 1, value);
      result.push_back(std::make_shared<FormulaCurve>(point_formulas({x, y, height}, {"t"}), Interval(-1, 1), false));
    }
  return result;
}

struct Errors {
  double point = 0, normal = 0;
};
template <class F>
Errors errors_of(const Mesh& mesh, const F& exact) {
  Errors errors;
  for (size_t k = 0; k < mesh.points.size(); ++k) {
    const auto [z, normal] = exact(mesh.points[k].x, mesh.points[k].y);
    errors.point = std::max(errors.point, std::abs(mesh.points[k].z - z));
    errors.normal = std::max(errors.normal, glm::length(glm::cross(mesh.normals[k], glm::normalize(normal))));
  }
  return errors;
}

const Rectangle kInner{{-0.7, 0.7}, {-0.7, 0.7}};

TEST(FrameNet, ReproducesAPlaneAndAParaboloid) {
  const Mesh plane = FrameNet(frame_of("0.3*X - 0.5*Y", 5), Frame{}).mesh(kInner, 9, 7);
  EXPECT_EQ(plane.points.size(), 63u);
  const Errors of_plane =
      errors_of(plane, [](double x, double y) { return std::pair(0.3 * x - 0.5 * y, Vec3(-0.3, 0.5, 1)); });
  EXPECT_LE(of_plane.point, 1e-14);
  EXPECT_LE(of_plane.normal, 1e-14);
  // Splines through four points and more hold parabolas.
  const Mesh bowl = FrameNet(frame_of("X^2/2 + X*Y/4 - Y^2/3", 5), Frame{}).mesh(kInner, 9, 7);
  const Errors of_bowl = errors_of(bowl, [](double x, double y) {
    return std::pair(x * x / 2 + x * y / 4 - y * y / 3, Vec3(-x - y / 4, -x / 4 + 2 * y / 3, 1));
  });
  EXPECT_LE(of_bowl.point, 1e-13);
  EXPECT_LE(of_bowl.normal, 1e-12);
}

TEST(FrameNet, ComesNearToASphereInTheFourthOrder) {
  const auto errors = [](int lines) {
    const Mesh cap = FrameNet(frame_of("sqrt(4 - X^2 - Y^2)", lines), Frame{}).mesh(kInner, 9, 9);
    return errors_of(cap, [](double x, double y) {
      const double z = std::sqrt(4 - x * x - y * y);
      return std::pair(z, Vec3(x, y, z));
    });
  };
  const Errors few = errors(5), many = errors(9);
  EXPECT_LE(few.point, 3e-3);
  EXPECT_LE(many.point, few.point / 8);
  EXPECT_LE(many.normal, few.normal / 4);
}

TEST(FrameNet, RefusesWhatLiesAboveItself) {
  std::vector<CurvePtr> lines = frame_of("0*X", 3);
  for (const CurvePtr& line : frame_of("0*X + 1", 3)) lines.push_back(line);
  EXPECT_THROW(FrameNet(lines, Frame{}).mesh(kInner, 5, 5), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry
