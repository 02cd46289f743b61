// A model made in C++, without a scene file: an exact torus, ray-traced without tessellation, written as ring.png.

#include "geometry/surfaces/analytic/torus.h"
#include "render/cameras/cameras.h"
#include "render/film/render.h"
#include "render/image/display.h"
#include "render/integrators/classic.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"

using namespace lekalo;

int main() {
  auto model = std::make_shared<render::Model>();
  render::Object ring;
  ring.shape = std::make_shared<geometry::TorusSurface>(geometry::Frame{}, 1.0, 0.4);
  ring.material = render::make_material(render::Plastic{.color = render::Vec3(0.7, 0.25, 0.1)});
  model->objects = {ring};
  model->lights = {render::make_light(render::AmbientLight{.intensity = 0.3}),
                   render::make_light(render::PointLight{.position = {3, -4, 5}})};
  model->film = {.width = 640, .height = 480, .samples = 16};
  model->camera = render::make_camera(render::PerspectiveView{.from = {0, -4, 2.5}}, 640, 480);
  model->integrator = render::make_classic_integrator();

  const render::World world(model);
  const render::RenderResult result = render::render(world, {});
  render::write_png("ring.png", render::to_display(result.image, {}).image);
}
