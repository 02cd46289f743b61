// Scenes of a few shapes with all their lines, seen from anywhere.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "render/model/look.h"
#include "render/small_scene.h"

namespace lekalo::render {

class Views {
 public:
  explicit Views(unsigned seed) : random_(seed) {}
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  geometry::Vec3 direction() {
    using geometry::Vec3;
    Vec3 v(number(-1, 1), number(-1, 1), number(-1, 1));
    while (glm::length(v) > 1 || glm::length(v) < 0.2) v = {number(-1, 1), number(-1, 1), number(-1, 1)};
    return glm::normalize(v);
  }
  // From all around, every second one central.
  void look(SmallScene& scene, bool central) {
    scene.model.film.width = 600;
    scene.model.film.height = 500;
    const Vec3 from = number(7, 15) * direction();
    if (central)
      scene.model.camera = make_camera(PerspectiveView{from, {0, 0, 0}, direction(), 1.0}, 600, 500);
    else
      scene.model.camera = make_camera(ParallelView{from, {0, 0, 0}, direction(), 8}, 600, 500);
  }

 private:
  std::mt19937 random_;
};

inline void show(SmallScene& scene, Entity shape, const std::vector<std::string>& kinds, int parameter_lines = 0,
                 std::vector<SectionPlane> planes = {}) {
  Look look;
  look.lines.emplace();
  for (const std::string& kind : kinds) look.lines->styles[kind] = Style();
  look.lines->at_u.count = look.lines->at_v.count = parameter_lines;
  look.lines->planes = std::move(planes);
  ClassicLook white;
  scene.add(std::move(shape), make_material(white));
  scene.model.objects.back().look = std::make_shared<const Look>(look);
}

}  // namespace lekalo::render
