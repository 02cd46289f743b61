// Layers that are kept when asked for: parts of light, Cryptomatte, variance; and sampling to a noise target.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>

#include "render/film/cryptomatte.h"
#include "render/film/render.h"
#include "render/integrators/path.h"
#include "tests/render/small_scene.h"

namespace lekalo::render {
namespace {

std::shared_ptr<Light> grouped(LightPtr light, const std::string& group) {
  auto own = std::const_pointer_cast<Light>(light);
  own->set_group(group);
  return own;
}

// A glass ball and a glossy one on a matt ground, two lamps in groups and a sky in none.
SmallScene lit_balls() {
  SmallScene scene;
  scene.add(sphere({-1, 0, 1}, 0.9), make_material(Dielectric{}));
  scene.add(sphere({1, 0, 1}, 1), make_material(Plastic{.roughness = 0.2}));
  scene.add(plane_part({}, {-3, 3}, {-3, 3}), make_material(Diffuse{.color = Vec3(0.7, 0.5, 0.3)}));
  scene.model.objects[0].name = "glass";
  scene.model.objects[1].name = "ball";
  scene.model.lights.push_back(grouped(make_light(SphereLight{.center = {-3, -3, 6}, .radius = 1}), "key"));
  scene.model.lights.push_back(grouped(make_light(PointLight{.position = {4, -2, 3}}), "fill"));
  scene.light(AmbientLight{.intensity = 0.2});
  scene.model.background = {0.1f, 0.2f, 0.4f};
  scene.model.film.width = 45;
  scene.model.film.height = 30;
  scene.model.film.samples = 8;
  scene.model.camera = make_camera(PerspectiveView{{0, -7, 4}, {0, 0, 0.7}, {0, 0, 1}, 0.6}, 45, 30);
  return scene;
}

std::shared_ptr<const World> world(const SmallScene& scene, const PathOptions& options = {.photons = 2000}) {
  auto finished = std::make_shared<Model>(scene.model);
  finished->integrator = make_path_integrator(options);
  return std::make_shared<World>(finished);
}

bool same(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels.size() != b.channels.size()) return false;
  for (size_t i = 0; i < a.channels.size(); ++i)
    if (a.channels[i].values != b.channels[i].values || a.channels[i].ids != b.channels[i].ids) return false;
  return true;
}

double sum_of(const Image& image, const std::vector<std::string>& layers, const char* lane, size_t pixel) {
  double sum = 0;
  for (const std::string& layer : layers) {
    const Channel* channel = find_channel(image, layer + lane);
    EXPECT_NE(channel, nullptr) << layer << lane;
    if (channel) sum += channel->values[pixel];
  }
  return sum;
}

TEST(Layers, PartsOfLightAddUpToTheColour) {
  for (const char* filter : {"box", "gaussian"}) {
    SmallScene scene = lit_balls();
    scene.model.film.filter = filter;
    const Image plain = render(*world(scene), {}).image;
    scene.model.film.layers = {"color",   "direct",   "indirect",     "emission",
                               "diffuse", "specular", "transmission", "light_groups"};
    const Image image = render(*world(scene), {.threads = 3}).image;
    EXPECT_EQ(find_channel(image, "R")->values, find_channel(plain, "R")->values) << "parts change no colour";
    bool has_transmission = false, has_indirect = false;
    for (size_t i = 0; i < image.pixel_count(); ++i)
      for (const char* lane : {".R", ".G", ".B"}) {
        const double all = find_channel(image, lane + 1)->values[i], tolerance = 1e-5 * (1 + all);
        ASSERT_NEAR(sum_of(image, {"emission", "direct", "indirect"}, lane, i), all, tolerance);
        ASSERT_NEAR(sum_of(image, {"emission", "diffuse", "specular", "transmission"}, lane, i), all, tolerance);
        ASSERT_NEAR(sum_of(image, {"group.rest", "group.key", "group.fill"}, lane, i), all, tolerance);
        has_transmission = has_transmission || find_channel(image, "transmission.R")->values[i] > 0.05;
        has_indirect = has_indirect || find_channel(image, "indirect.R")->values[i] > 0.05;
      }
    EXPECT_TRUE(has_transmission && has_indirect);
  }
}

// What a lamp's group shows is the picture under that lamp alone.
TEST(Layers, GroupIsThePictureOfItsLamps) {
  SmallScene scene = lit_balls();
  scene.model.film.samples = 64;
  scene.model.film.layers = {"light_groups", "color"};
  const Image image = render(*world(scene), {}).image;
  scene.model.lights.erase(scene.model.lights.begin(), scene.model.lights.begin() + 1);
  scene.model.lights.resize(1);
  scene.model.background = Spectrum();
  const Image alone = render(*world(scene), {}).image;
  double in_group = 0, in_picture = 0;
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    in_group += find_channel(image, "group.fill.R")->values[i];
    in_picture += find_channel(alone, "R")->values[i];
  }
  EXPECT_NEAR(in_group, in_picture, 0.02 * in_picture);
}

TEST(Layers, PartsAreThoseOfPaths) {
  SmallScene scene = lit_balls();
  scene.model.film.layers = {"color", "diffuse"};
  EXPECT_THROW(render(*scene.world(), {}), std::invalid_argument);
}

// Values of the published function.
TEST(Cryptomatte, HashIsMurmur) {
  EXPECT_EQ(murmur_hash(""), 0u);
  EXPECT_EQ(murmur_hash("test"), 0xba6bd213u);
  EXPECT_EQ(murmur_hash("Hello, world!"), 0xc0363e43u);
  EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, SharesAreThoseOfTheIds) {
  SmallScene scene = lit_balls();
  scene.model.film.samples = 1;
  scene.model.film.layers = {"id", "cryptomatte_object", "cryptomatte_material"};
  Image image = render(*world(scene), {}).image;
  const float numbers[] = {0, matte_number("glass"), matte_number("ball"), matte_number("object.3")};
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    const uint32_t object = find_channel(image, "id.object")->ids[i];
    ASSERT_EQ(find_channel(image, "CryptoObject00.R")->values[i], numbers[object]);
    ASSERT_EQ(find_channel(image, "CryptoObject00.G")->values[i], object > 0 ? 1 : 0);
    ASSERT_EQ(find_channel(image, "CryptoObject02.A")->values[i], 0);
  }
  EXPECT_EQ(std::get<std::string>(image.metadata.at("cryptomatte/3ae39a5/conversion")), "uint32_to_float32");
  // Of many samples the shares of all are 1 less that of the open background.
  scene.model.film.samples = 16;
  scene.model.film.layers.push_back("color");
  image = render(*world(scene), {}).image;
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    double sum = 0;
    float before = 1;
    for (const char* name : {"CryptoObject00.G", "CryptoObject00.A", "CryptoObject01.G"}) {
      const float share = find_channel(image, name)->values[i];
      EXPECT_LE(share, before);
      before = share;
      sum += share;
    }
    ASSERT_NEAR(sum, find_channel(image, "A")->values[i], 1e-6);
  }
}

// Within outlines nearer, as displayed, to the picture of many samples than what it is made of, and as bright.
TEST(Denoise, IsNearerToTheTruth) {
  SmallScene scene = lit_balls();
  // Photons err all pixels together, which no variance tells.
  scene.model.objects[0].material = make_material(Diffuse{.color = 0.6});
  scene.model.film.width = 90;
  scene.model.film.height = 60;
  scene.model.camera = make_camera(PerspectiveView{{0, -7, 4}, {0, 0, 0.7}, {0, 0, 1}, 0.6}, 90, 60);
  scene.model.film.layers = {"color", "normal", "albedo", "depth", "variance", "denoised"};
  const Image image = render(*world(scene), {.threads = 1}).image;
  EXPECT_TRUE(same(image, render(*world(scene), {.threads = 3}).image));
  scene.model.film.samples = 512;
  scene.model.film.seed = 5;
  const Image truth = render(*world(scene), {}).image;
  double before = 0, after = 0, mean_before = 0, mean_after = 0;
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    const double is = find_channel(truth, "R")->values[i], raw = find_channel(image, "R")->values[i],
                 clean = find_channel(image, "denoised.R")->values[i];
    mean_before += raw;
    mean_after += clean;
    if (clean == raw) continue;  // an outline: kept
    before += std::pow(std::sqrt(raw) - std::sqrt(is), 2);
    after += std::pow(std::sqrt(clean) - std::sqrt(is), 2);
  }
  EXPECT_LT(after, 0.5 * before);
  EXPECT_NEAR(mean_after, mean_before, 0.01 * mean_before);
  scene.model.film.layers = {"color", "denoised"};
  EXPECT_THROW(render(*world(scene), {}), std::invalid_argument);
}

TEST(Path, PictureIsTheSameBitsByThreadsCropsAndRounds) {
  SmallScene scene = lit_balls();
  const auto whole = render(*world(scene), {.threads = 1});
  EXPECT_TRUE(same(whole.image, render(*world(scene), {.threads = 5}).image));

  const std::string file = (std::filesystem::temp_directory_path() / "lekalo_path_test.partial").string();
  RenderOptions options{.part = PicturePart{.index = 1, .count = 2}, .partial_file = file, .identity = 42};
  EXPECT_FALSE(render(*world(scene), options).complete);
  options.part.reset();
  options.resume_files = {file};
  EXPECT_TRUE(same(whole.image, render(*world(scene), options).image));
  std::filesystem::remove(file);

  scene.model.film.crop = {13, 7, 31, 29};
  const Image crop = render(*world(scene), {}).image;
  for (size_t c = 0; c < crop.channels.size(); ++c)
    for (int y = 0; y < crop.height; ++y)
      for (int x = 0; x < crop.width; ++x) {
        const size_t i = static_cast<size_t>(y) * crop.width + x, j = static_cast<size_t>(y + 7) * 45 + x + 13;
        ASSERT_EQ(value_at(crop.channels[c], i), value_at(whole.image.channels[c], j)) << crop.channels[c].name;
      }
}

TEST(Noise, BlocksTakeWhatTheyNeed) {
  for (const char* filter : {"box", "mitchell"}) {
    SmallScene scene = lit_balls();
    scene.model.film.filter = filter;
    scene.model.film.samples = 200;
    scene.model.film.noise = 0.01;
    scene.model.film.layers = {"color", "samples", "variance", "depth"};
    // So many photons that those of another seed bring the same light.
    const PathOptions options{.photons = 200000};
    const RenderResult result = render(*world(scene, options), {.threads = 3});
    const Image& image = result.image;
    EXPECT_TRUE(same(image, render(*world(scene, options), {.threads = 1}).image));
    std::map<float, int> counts;
    for (const float n : find_channel(image, "samples")->values) ++counts[n];
    for (const auto& [n, pixels] : counts) EXPECT_TRUE(n == 16 || n == 32 || n == 64 || n == 128 || n == 200) << n;
    EXPECT_GE(counts.size(), 3u);
    // Against a picture of far more samples: pixels differ by the target in the root mean square, but where even all
    // samples were not enough.
    SmallScene many = scene;
    many.model.film.noise = 0;
    many.model.film.samples = 4096;
    many.model.film.seed = 7;
    if (std::string(filter) != "box") continue;
    const Image truth = render(*world(many, options), {}).image;
    double squares = 0;
    int count = 0;
    for (size_t i = 0; i < image.pixel_count(); ++i) {
      if (find_channel(image, "samples")->values[i] == 200) continue;
      ++count;
      const double off =
          std::sqrt(find_channel(image, "R")->values[i]) - std::sqrt(find_channel(truth, "R")->values[i]);
      squares += off * off;
    }
    EXPECT_LT(std::sqrt(squares / count), 0.012);
  }
}

TEST(Noise, CropShowsThePixelsOfTheFullPicture) {
  SmallScene scene = lit_balls();
  for (const char* filter : {"box", "gaussian"}) {
    scene.model.film.filter = filter;
    scene.model.film.samples = 64;
    scene.model.film.noise = 0.02;
    scene.model.film.layers = {"color", "samples", "cryptomatte_object"};
    scene.model.film.crop = {};
    const Image whole = render(*world(scene), {}).image;
    scene.model.film.crop = {11, 5, 38, 21};
    const Image crop = render(*world(scene), {}).image;
    for (const Channel& channel : crop.channels)
      for (int y = 0; y < crop.height; ++y)
        for (int x = 0; x < crop.width; ++x)
          ASSERT_EQ(channel.values[y * crop.width + x],
                    find_channel(whole, channel.name)->values[(y + 5) * 45 + x + 11])
              << channel.name;
  }
}

TEST(Noise, ResumedPictureIsTheSameBits) {
  const std::string file = (std::filesystem::temp_directory_path() / "lekalo_noise_test.partial").string();
  SmallScene scene = lit_balls();
  scene.model.film.samples = 64;
  scene.model.film.noise = 0.02;
  scene.model.film.layers = {"color", "diffuse", "light_groups", "samples", "variance", "cryptomatte_object"};
  const auto drawn = world(scene);
  const RenderResult whole = render(*drawn, {});
  // Stopped from inside, after some thousand samples.
  class Stopping final : public Integrator {
   public:
    Stopping(IntegratorPtr inner, std::atomic<bool>& stop, std::atomic<int>& samples)
        : inner_(std::move(inner)), stop_(stop), samples_(samples) {}
    RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
      return inner_->trace(world, ray, first, random);
    }
    RaySample trace_parts(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const override {
      if (++samples_ == 5000) stop_ = true;
      return inner_->trace_parts(world, ray, first, random);
    }
    bool tells_parts() const override { return inner_->tells_parts(); }
    IntegratorPtr prepared(const World& world) const override {
      const IntegratorPtr ready = inner_->prepared(world);
      return ready ? std::make_shared<Stopping>(ready, stop_, samples_) : nullptr;
    }

   private:
    IntegratorPtr inner_;
    std::atomic<bool>& stop_;
    std::atomic<int>& samples_;
  };
  std::atomic<bool> stop = false;
  std::atomic<int> samples = 0;
  auto model = std::make_shared<Model>(drawn->model());
  model->integrator = std::make_shared<Stopping>(model->integrator, stop, samples);
  const World stopping(model);
  RenderOptions options{.threads = 1, .partial_file = file, .identity = 1};
  options.stop = &stop;
  RenderResult part = render(stopping, options);
  EXPECT_FALSE(part.complete);
  options.resume_files = {file};
  stop = false;
  part = render(stopping, options);
  EXPECT_TRUE(part.complete);
  EXPECT_TRUE(same(part.image, whole.image));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace lekalo::render
