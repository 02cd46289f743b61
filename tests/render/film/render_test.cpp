// The picture loop: the same bits for any threads, crops and interruptions; layers that agree with the camera.
#include "render/film/render.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "render/image/image_error.h"
#include "render/small_scene.h"

namespace lekalo::render::render_test {
namespace {

SmallScene ball_on_ground(const std::string& filter = "box") {
  SmallScene scene;
  scene.model.background = {0.2f, 0.4f, 0.8f};
  scene.add(sphere({0, 0, 1}, 1), make_material(Plastic{.roughness = 0.2}));
  geometry::Frame ground;
  scene.add(plane_part(ground, {-3, 3}, {-3, 3}),
            make_material(Diffuse{.color = make_texture(Checker{.color = 0.2, .background = 0.9})}));
  RectangleLight light;
  light.frame.origin = {-3, -3, 6};
  light.size = {1, 1};
  light.sampling.n = 2;
  scene.light(light).light(AmbientLight{.intensity = 0.2});
  scene.model.film.width = 70;
  scene.model.film.height = 50;
  scene.model.film.samples = 4;
  scene.model.film.filter = filter;
  scene.model.camera = make_camera(PerspectiveView{{0, -7, 4}, {0, 0, 0.7}, {0, 0, 1}, 0.6}, 70, 50);
  return scene;
}

bool same(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels.size() != b.channels.size()) return false;
  for (size_t i = 0; i < a.channels.size(); ++i)
    if (a.channels[i].values != b.channels[i].values || a.channels[i].ids != b.channels[i].ids) return false;
  return true;
}

TEST(Render, SameBitsForAnyNumberOfThreads) {
  for (const char* filter : {"box", "gaussian", "mitchell"}) {
    const auto world = ball_on_ground(filter).world();
    const RenderResult one = render(*world, {.threads = 1, .key_layer = true});
    const RenderResult many = render(*world, {.threads = 5, .key_layer = true});
    EXPECT_TRUE(one.complete);
    EXPECT_TRUE(same(one.image, many.image)) << filter;
    EXPECT_EQ(one.camera_rays, 70u * 50 * 4);
    EXPECT_EQ(one.shadow_rays, many.shadow_rays);
    EXPECT_GT(one.other_rays, 0u);
    EXPECT_EQ(one.not_finite, 0u);
  }
}

TEST(Render, CropShowsThePixelsOfTheFullPicture) {
  SmallScene scene = ball_on_ground("mitchell");
  const Image full = render(*scene.world(), {}).image;
  scene.model.film.crop = {20, 11, 53, 37};
  const Image crop = render(*scene.world(), {}).image;
  ASSERT_EQ(crop.width, 33);
  ASSERT_EQ(crop.height, 26);
  EXPECT_EQ(crop.x, 20);
  EXPECT_EQ(crop.full_width, 70);
  for (size_t c = 0; c < full.channels.size(); ++c)
    for (int y = 0; y < crop.height; ++y)
      for (int x = 0; x < crop.width; ++x) {
        const size_t i = static_cast<size_t>(y) * crop.width + x, j = static_cast<size_t>(y + 11) * 70 + x + 20;
        ASSERT_EQ(value_at(crop.channels[c], i), value_at(full.channels[c], j)) << full.channels[c].name;
      }
}

TEST(Render, AdaptiveSamplesGoWhereNeighboursDiffer) {
  for (const char* filter : {"box", "mitchell"}) {
    SmallScene scene = ball_on_ground(filter);
    scene.model.film.samples = 64;
    const RenderResult even = render(*scene.world(), {});
    scene.model.film.contrast = 0.03;
    const RenderResult adaptive = render(*scene.world(), {.threads = 3});
    EXPECT_TRUE(same(adaptive.image, render(*scene.world(), {.threads = 1}).image));
    EXPECT_LT(adaptive.camera_rays, even.camera_rays * 3 / 4);
    const Channel& samples = *find_channel(adaptive.image, "samples");
    double square = 0;
    int worse = 0;
    for (size_t i = 0; i < samples.values.size(); ++i) {
      EXPECT_TRUE(samples.values[i] == 1 || samples.values[i] == 4 || samples.values[i] > 4) << samples.values[i];
      EXPECT_LE(samples.values[i], 64);
      for (const char* name : {"R", "G", "B"}) {
        const double difference = std::sqrt(find_channel(adaptive.image, name)->values[i]) -
                                  std::sqrt(find_channel(even.image, name)->values[i]);
        square += difference * difference / 3;
        worse += std::fabs(difference) > 0.06;
      }
    }
    // Below the contrast everywhere but on thin things between the centres.
    EXPECT_LT(std::sqrt(square / samples.values.size()), 0.015) << filter;
    EXPECT_LT(worse, 0.01 * 3 * samples.values.size()) << filter;
    // The layers of data come from the pixel's centre.
    scene.model.film.crop = {20, 11, 53, 37};
    const Image crop = render(*scene.world(), {}).image;
    for (int y = 0; y < crop.height; ++y)
      for (int x = 0; x < crop.width; ++x)
        for (const char* name : {"R", "Z", "N.X", "samples"})
          ASSERT_EQ(find_channel(crop, name)->values[y * crop.width + x],
                    find_channel(adaptive.image, name)->values[(y + 11) * 70 + x + 20])
              << name;
  }
}

TEST(Render, FilmKeepsTheLayersAskedFor) {
  SmallScene scene = ball_on_ground();
  const Image all = render(*scene.world(), {}).image;
  scene.model.film.layers = {"color", "depth", "id"};
  scene.model.film.half_color = true;
  const Image some = render(*scene.world(), {}).image;
  std::vector<std::string> names;
  for (const Channel& channel : some.channels) {
    names.push_back(channel.name);
    EXPECT_EQ(channel.values, find_channel(all, channel.name)->values);
    EXPECT_EQ(channel.ids, find_channel(all, channel.name)->ids);
    EXPECT_EQ(channel.type == PixelType::half, channel.name.size() == 1 && channel.name != "Z") << channel.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"R", "G", "B", "A", "Z", "id.object", "id.material"}));
  scene.model.film.layers = {"colour"};
  EXPECT_THROW(render(*scene.world(), {}), std::invalid_argument);
}

TEST(Render, ResumedPictureIsTheSameBits) {
  const std::string file = (std::filesystem::temp_directory_path() / "lekalo_render_test.partial").string();
  const auto world = ball_on_ground("gaussian").world();
  const RenderResult whole = render(*world, {.threads = 2});

  // Stopped from inside a tile, every 5000 rays, again and again, until the picture is complete.
  class Stopping final : public Integrator {
   public:
    Stopping(IntegratorPtr inner, std::atomic<bool>& stop) : inner_(std::move(inner)), stop_(stop) {}
    RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
      if (++rays_ % 5000 == 0) stop_ = true;
      return inner_->trace(world, ray, first, random);
    }

   private:
    IntegratorPtr inner_;
    std::atomic<bool>& stop_;
    mutable std::atomic<int> rays_ = 0;
  };
  std::atomic<bool> stop = false;
  auto model = std::make_shared<Model>(world->model());
  model->integrator = std::make_shared<Stopping>(model->integrator, stop);
  const World stopping(model);
  RenderOptions options{.threads = 1, .stop = &stop, .partial_file = file, .identity = 42};
  RenderResult part = render(stopping, options);
  EXPECT_FALSE(part.complete);
  options.resume_files = {file};
  int rounds = 1;
  for (; !part.complete && rounds < 100; ++rounds) {
    stop = false;
    part = render(stopping, options);
  }
  EXPECT_GT(rounds, 2);
  EXPECT_TRUE(same(part.image, whole.image));
  EXPECT_EQ(part.camera_rays, whole.camera_rays);
  EXPECT_EQ(part.shadow_rays, whole.shadow_rays);

  options.identity = 43;
  EXPECT_THROW(render(*world, options), ImageError);
  options.resume_files = {file + ".missing"};
  EXPECT_THROW(render(*world, options), ImageError);
  std::filesystem::remove(file);
}

// A byte that has changed, or one too many or too few, is never taken for pixels.
TEST(Render, DamagedPartialPicturesAreRefused) {
  const std::string file = (std::filesystem::temp_directory_path() / "lekalo_damaged_test.partial").string();
  const auto world = ball_on_ground("gaussian").world();
  RenderOptions options{.threads = 1, .partial_file = file, .save_interval = 0, .identity = 42};
  render(*world, options);
  std::ifstream in(file, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  ASSERT_GT(good.size(), 10000u);
  options.partial_file.clear();
  options.resume_files = {file};
  const auto write = [&](const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; };
  const auto message = [&]() -> std::string {
    try {
      render(*world, options);
    } catch (const ImageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(), "");
  for (size_t at = 0; at < good.size(); at += at < 100 ? 7 : 4999) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    write(bad);
    EXPECT_NE(message(), "") << at;
  }
  write(good.substr(0, good.size() - 1));
  EXPECT_NE(message().find("ends too early"), std::string::npos);
  write(good + "x");
  EXPECT_NE(message().find("checksum"), std::string::npos);
  std::string other = good;
  other.replace(17, 8, std::string("sse9\0\0\0\0", 8));
  write(other);
  EXPECT_NE(message().find("made with the instruction set sse9"), std::string::npos);
  EXPECT_NE(message().find("add --isa sse9"), std::string::npos);
  other = good;
  other[15] = '1';
  write(other);
  EXPECT_NE(message().find("another version"), std::string::npos);
  std::filesystem::remove(file);
}

// A full disk, or a folder that is gone, is told once, and the picture is made.
TEST(Render, PictureGoesOnWithoutItsPartialFile) {
  const auto world = ball_on_ground("gaussian").world();
  int warnings = 0;
  RenderOptions options{.threads = 2, .partial_file = "/no/such/folder/x.partial", .save_interval = 0};
  options.warning = [&](const std::string& reason) {
    ++warnings;
    EXPECT_NE(reason.find("/no/such/folder/x.partial"), std::string::npos);
  };
  const RenderResult result = render(*world, options);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(warnings, 1);
  EXPECT_TRUE(same(result.image, render(*world, {.threads = 2}).image));
}

// The tile in work is given up, and nothing of it stays in the picture.
TEST(Render, StopsWithinATile) {
  constexpr int kLast = 500;  // ray
  class Stopping final : public Integrator {
   public:
    explicit Stopping(IntegratorPtr inner) : inner_(std::move(inner)) {}
    RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
      if (++rays == kLast) stop = true;
      return inner_->trace(world, ray, first, random);
    }
    mutable std::atomic<bool> stop = false;
    mutable std::atomic<int> rays = 0;

   private:
    IntegratorPtr inner_;
  };
  for (const char* filter : {"box", "mitchell"})
    for (const double contrast : {0.0, 0.05}) {
      SmallScene scene = ball_on_ground(filter);
      scene.model.film.samples = 16;
      scene.model.film.contrast = contrast;
      scene.model.film.crop = {20, 0, 70, 50};
      auto model = std::make_shared<Model>(scene.world()->model());
      const auto stopping = std::make_shared<Stopping>(model->integrator);
      model->integrator = stopping;
      const World world(model);
      const RenderResult part = render(world, {.threads = 1, .stop = &stopping->stop});
      EXPECT_FALSE(part.complete);
      EXPECT_EQ(part.camera_rays, 0u);
      EXPECT_LT(stopping->rays, kLast + 32);
      for (const Channel& channel : part.image.channels) {
        EXPECT_TRUE(std::all_of(channel.values.begin(), channel.values.end(), [](float x) { return x == 0; }))
            << channel.name;
        EXPECT_TRUE(std::all_of(channel.ids.begin(), channel.ids.end(), [](uint32_t id) { return id == 0; }));
      }
    }
}

TEST(Render, DataLayersAgreeWithTheCamera) {
  SmallScene scene = ball_on_ground();
  scene.model.film.samples = 1;
  const Image image = render(*scene.world(), {}).image;
  const auto value = [&](const char* name, size_t i) { return value_at(*find_channel(image, name), i); };
  int hits = 0;
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    EXPECT_EQ(value("samples", i), 1);
    if (value("id.object", i) == 0) {
      EXPECT_EQ(value("A", i), 0);
      EXPECT_EQ(value("Z", i), 0);
      EXPECT_EQ(value("B", i), 0.8f);
      continue;
    }
    ++hits;
    const Vec3 p(value("P.X", i), value("P.Y", i), value("P.Z", i)),
        n(value("N.X", i), value("N.Y", i), value("N.Z", i));
    const PicturePoint q = scene.model.camera->project(p);
    EXPECT_NEAR(q.x, i % 70 + 0.5, 1e-3);
    EXPECT_NEAR(q.y, i / 70 + 0.5, 1e-3);
    EXPECT_NEAR(q.depth, value("Z", i), 1e-5);
    const bool ball = value("id.object", i) == 1;
    EXPECT_LT(glm::length(n - (ball ? p - Vec3(0, 0, 1) : Vec3(0, 0, 1))), 1e-5);
    EXPECT_EQ(value("id.material", i), ball ? 1 : 2);
    if (!ball) {
      const bool even = static_cast<int>(std::floor(p.x) + std::floor(p.y)) % 2 == 0;
      EXPECT_FLOAT_EQ(value("albedo.R", i), even ? 0.2f : 0.9f);
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(Render, WhiteRoomStaysWhiteUnderEveryFilter) {
  for (const char* filter : {"box", "gaussian", "mitchell"}) {
    SmallScene scene;
    scene.model.background = Spectrum(1, 1, 1);
    scene.model.film = {.width = 40, .height = 40, .samples = 3, .filter = filter};
    scene.add(sphere({0, 0, 0}, 1), make_material(Emission{.color = 1.0}));
    scene.model.camera = make_camera(PerspectiveView{}, 40, 40);
    const Image image = render(*scene.world(), {}).image;
    for (const float value : find_channel(image, "R")->values) EXPECT_NEAR(value, 1, 1e-6);
  }
}

TEST(Render, NotFiniteSamplesAreCountedAndLeftOut) {
  class Broken final : public Integrator {
   public:
    RaySample trace(const World&, const Ray& ray, const Hit&, SampleStream&) const override {
      RaySample sample;
      sample.radiance = Spectrum(ray.direction.x < 0 ? NAN : 0.5f);
      return sample;
    }
  };
  SmallScene scene = ball_on_ground();
  auto model = std::make_shared<Model>(scene.model);
  model->integrator = std::make_shared<Broken>();
  const RenderResult result = render(World(model), {});
  EXPECT_EQ(result.not_finite, 35u * 50 * 4);
  EXPECT_EQ(find_channel(result.image, "samples")->values[0], 0);
  EXPECT_EQ(find_channel(result.image, "R")->values[0], 0);
  EXPECT_EQ(find_channel(result.image, "R")->values[69], 0.5f);
}

TEST(Render, SaysWhatItCannotDo) {
  SmallScene scene = ball_on_ground();
  scene.model.film.filter = "sinc";
  EXPECT_THROW(render(*scene.world(), {}), std::invalid_argument);
  scene = ball_on_ground();
  scene.model.film.crop = {100, 0, 120, 20};
  EXPECT_THROW(render(*scene.world(), {}), std::invalid_argument);
  scene = ball_on_ground();
  scene.model.film.width = 71;
  EXPECT_THROW(render(*scene.world(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::render::render_test
