// A regression suite: which scenes are rendered how, and what the pictures and numbers must be.
//
//   lekalo_suite: 1
//   golden: golden
//   defaults: { size: [320, 240], compare: { metric: flip, mean: 0.01 } }
//   tests:
//     - { name: torus, scene: torus.yaml, expect: [{ measure: torus, area: 118.4352528, tolerance: 1e-9 }] }
//     - { name: torus_mesh, scene: torus.yaml, representation: mesh, against: torus }
//
// Read by the rules of scene files: the same YAML subset, declared fields, all errors of a file in one run.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/describe.h"
#include "render/image/compare.h"
#include "render/model/model.h"

namespace lekalo::render {

/// What a comparison must give; every limit given must hold, without any only equal pictures pass.
struct PictureLimits {
  Metric metric = Metric::flip;
  std::optional<double> mean;     ///< flip: at most, of the error per pixel
  std::optional<double> maximum;  ///< flip: at most, of the error of any pixel; max, rmse: at most, of the figure
  std::optional<double> minimum;  ///< ssim, psnr: at least, of the figure
};

/// Numbers that the geometry of a test's scene must have.
struct Expectation {
  std::string name;  ///< of the curve, surface, body, shape or mesh
  /// measure: length, area, volume; they hold to `tolerance` times the expected number (to `tolerance` itself for 0).
  std::map<std::string, double> measures;
  /// evaluate: a table with columns t, x, y, z or u, v, x, y, z; no distance exceeds `tolerance`. Empty: none.
  std::filesystem::path samples;
  double tolerance = 0;
};

struct SuiteTest {
  std::string name;
  std::filesystem::path scene;
  std::vector<std::filesystem::path> includes;           ///< need not exist: other programs write them
  std::vector<std::pair<std::string, std::string>> set;  ///< as --set takes them
  std::optional<std::pair<int, int>> size;               ///< pixels; the scene's own without it
  std::optional<int> samples;                            ///< per pixel
  std::optional<Representation> representation;          ///< of every object
  IntegratorPtr integrator;                              ///< null: the scene's own
  std::string layer;                                     ///< as compare_images takes it
  PictureLimits limits;
  std::string against;  ///< name of another test; empty: the golden picture
  std::vector<Expectation> expectations;
  double time_limit = 60;  ///< seconds
};

struct Suite {
  std::filesystem::path file;
  std::filesystem::path golden;   ///< beside the suite
  std::filesystem::path results;  ///< in the current folder
  std::vector<SuiteTest> tests;   ///< repeats expanded, names unique, in written order

  const SuiteTest* find(std::string_view name) const;
};

/// Throws SceneError with all errors of the file.
Suite read_suite(const std::filesystem::path& path);

/// The sections of a suite and the fields of a test, for schema and manual. `set` and `repeat` come beside them.
struct SuiteSection {
  std::string name;
  std::string description;
  std::vector<geometry::Field> fields;  ///< of `defaults` and of each of `tests`; empty for folders
};
const std::vector<SuiteSection>& suite_sections();

}  // namespace lekalo::render
