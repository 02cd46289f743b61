#include "ray_cases.h"

#include <charconv>
#include <random>
#include <stdexcept>

#include "geometry/surfaces/splines/bezier_surface.h"
#include "render/cameras/cameras.h"
#include "render/scene/build/load.h"

namespace lekalo::benchmarks {

using geometry::Affine;
using geometry::SurfacePtr;
using geometry::Vec3;
using geometry::Vec4;
using render::Model;
using render::SurfaceSet;

namespace {

render::Object object_of(SurfaceSet surfaces) {
  render::Object object;
  object.shape = std::move(surfaces);
  return object;
}

// Copies with their own control points: nothing of them can be shared.
SurfaceSet moved(const SurfaceSet& surfaces, const Affine& map) {
  SurfaceSet result;
  for (const SurfacePtr& surface : surfaces) {
    const auto form = surface->as_nurbs();
    geometry::Grid<Vec3> net{form->count_u(), form->count_v(), {}};
    for (const Vec4& p : form->points) net.values.push_back(map.point(Vec3(p) / p.w));
    result.push_back(std::make_shared<geometry::NurbsSurface>(geometry::bezier_surface(net)));
  }
  return result;
}

constexpr int kTeapotsAcross = 40, kTeapotsDeep = 80;

std::shared_ptr<Model> teapots(const std::filesystem::path& file, int width, int height) {
  const render::LoadedScene scene = render::load_scene(file);
  const auto& teapot = std::get<SurfaceSet>(scene.model->objects.front().shape);
  auto model = std::make_shared<Model>();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < kTeapotsAcross; ++i)
    for (int j = 0; j < kTeapotsDeep; ++j) {
      const double angle = 2 * geometry::kPi * unit(random), size = 0.8 + 0.4 * unit(random);
      Affine map;
      map.linear = size * geometry::Mat3(std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle), 0, 0,
                                         0, 0.8 + 0.4 * unit(random));
      map.offset = {5.0 * (i - 0.5 * kTeapotsAcross), 5.0 * j, 0};
      model->objects.push_back(object_of(moved(teapot, map)));
    }
  model->camera = render::make_camera(
      render::PerspectiveView{{0, -30, 60}, {0, 60, 0}, {0, 0, 1}, 40 * geometry::kPi / 180}, width, height);
  return model;
}

// Across x across distinct teapots side by side, each seen as the only one of a mosaic of one is: the same share of the
// rays hits.
std::shared_ptr<Model> mosaic(const std::filesystem::path& file, int across, int width, int height) {
  const render::LoadedScene scene = render::load_scene(file);
  const auto& teapot = std::get<SurfaceSet>(scene.model->objects.front().shape);
  auto model = std::make_shared<Model>();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> size(0.98, 1.02);
  const double wide = 7, high = wide * height / width;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j) {
      Affine map;
      map.linear = geometry::Mat3(size(random), 0, 0, 0, size(random), 0, 0, 0, size(random));
      map.offset = {wide * (i + 0.5 - 0.5 * across), 0, high * (j + 0.2 - 0.5 * across)};
      model->objects.push_back(object_of(moved(teapot, map)));
    }
  render::ParallelView view;
  view.from = {0, -100, 30};
  view.along = {0, 1, -0.3};
  view.height = high * across;
  model->camera = render::make_camera(view, width, height);
  return model;
}

std::shared_ptr<Model> random_patches(int degree, int width, int height) {
  std::mt19937 random(static_cast<unsigned>(degree));
  std::uniform_real_distribution<double> unit(-1, 1);
  auto model = std::make_shared<Model>();
  SurfaceSet set;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 4; ++j) {
      geometry::Grid<Vec3> net{degree + 1, degree + 1, {}};
      std::vector<double> weights;
      for (int k = 0; k <= degree; ++k)
        for (int l = 0; l <= degree; ++l) {
          const Vec3 bump(unit(random), unit(random), unit(random));
          net.values.push_back(Vec3(i - 4 + k / double(degree), j - 2 + l / double(degree), 0) + 0.3 * bump);
          weights.push_back(std::exp2(unit(random)));
        }
      set.push_back(std::make_shared<geometry::NurbsSurface>(geometry::bezier_surface(net, weights)));
    }
  model->objects.push_back(object_of(std::move(set)));
  model->camera = render::make_camera(
      render::PerspectiveView{{2, -7, 6}, {0, 0, 0}, {0, 0, 1}, 28 * geometry::kPi / 180}, width, height);
  return model;
}

}  // namespace

std::shared_ptr<Model> ray_case(const std::string& name, const std::filesystem::path& teapot, int width, int height) {
  if (name == "teapots") return teapots(teapot, width, height);
  if (name == "quintics") return random_patches(5, width, height);
  for (const std::string kind : {"degree-", "mosaic-"}) {
    if (!name.starts_with(kind)) continue;
    int number = 0;
    std::from_chars(name.data() + kind.size(), name.data() + name.size(), number);
    if (number < 1) throw std::invalid_argument("no case '" + name + "'");
    return kind == "degree-" ? random_patches(number, width, height) : mosaic(teapot, number, width, height);
  }
  const render::LoadedScene scene = render::load_scene(name);
  auto model = std::make_shared<Model>(*scene.model);
  // Unbounded grounds have no triangles to race against.
  std::erase_if(model->objects, [](const render::Object& object) {
    const geometry::Box3 box = render::bounds(object.shape);
    return box.empty() || !box.bounded();
  });
  if (scene.model->make_camera) model->camera = scene.model->make_camera(width, height);
  return model;
}

}  // namespace lekalo::benchmarks
