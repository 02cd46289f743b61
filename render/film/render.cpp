#include "render/film/render.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "render/film/blocks.h"
#include "render/film/cryptomatte.h"
#include "render/film/denoise.h"
#include "render/film/tiles.h"
#include "render/image/image_error.h"
#include "render/lines/picture_lines.h"
#include "render/model/face_materials.h"
#include "render/model/placed_objects.h"

namespace lekalo::render {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kProgressInterval{100};

// Materials numbered from 1 in the order in which objects first use them.
class MaterialNumbers {
 public:
  explicit MaterialNumbers(const std::vector<Object>& objects) {
    each_object(objects, [&](const Object& object) {
      for (const Material* material : materials_of(object))
        numbers_.emplace(material, static_cast<uint32_t>(numbers_.size() + 1));
    });
  }
  uint32_t operator()(const Material& material) const {
    const auto found = numbers_.find(&material);
    return found == numbers_.end() ? 0 : found->second;
  }
  // Their names in the model, by number less one; "material.N" of those without.
  std::vector<std::string> names(const Model& model) const {
    std::vector<std::string> result(numbers_.size());
    for (const auto& [name, material] : model.materials)
      if (const uint32_t number = (*this)(*material)) result[number - 1] = name;
    for (size_t i = 0; i < result.size(); ++i)
      if (result[i].empty()) result[i] = fmt::format("material.{}", i + 1);
    return result;
  }

 private:
  std::unordered_map<const Material*, uint32_t> numbers_;
};

// By number less one; "object.N" of those without a name.
std::vector<std::string> object_names(const World& world) {
  std::vector<std::string> result;
  for (const Object* object : world.objects())
    result.push_back(object->name.empty() ? fmt::format("object.{}", result.size() + 1) : object->name);
  return result;
}

std::vector<float> matte_numbers(const std::vector<std::string>& names) {
  std::vector<float> result;
  for (const std::string& name : names) result.push_back(matte_number(name));
  return result;
}

// A sample as displayed.
struct PixelContent {
  float lanes[4];
  explicit PixelContent(const RaySample& s) {
    for (int i = 0; i < 3; ++i) lanes[i] = s.radiance[i] > 0 ? std::sqrt(s.radiance[i]) : 0;
    lanes[3] = s.alpha;
  }
};
bool differ(const PixelContent& a, const PixelContent& b, float contrast) {
  bool result = false;
  for (int i = 0; i < 4; ++i) result = result || !(std::fabs(a.lanes[i] - b.lanes[i]) <= contrast);
  return result;
}

// Whether two samples met different things, or only one of them met any.
bool is_outline_between(const RaySample& a, const RaySample& b) {
  if (a.line != b.line) return true;
  if (!a.point || !b.point) return a.point.has_value() != b.point.has_value();
  return a.point->instance != b.point->instance || a.point->face != b.point->face;
}

bool is_finite(const RaySample& s) { return s.radiance.is_finite() && s.direct.is_finite() && std::isfinite(s.alpha); }

SamplerPtr make_sampler(const Film& film) {
  return film.noise > 0 ? make_progressive_sampler(film.samples, film.seed)
                        : make_stratified_sampler(film.samples, film.seed);
}

// Traces the pixels of one tile.
class TileTracer {
 public:
  // `stop`: set when tiles in work are to be given up; null: never.
  TileTracer(const World& world, const Integrator& integrator, TiledFilm& film, const std::atomic<bool>* stop)
      : world_(world),
        camera_(*world.model().camera),
        integrator_(integrator),
        film_(film),
        lines_(world, stop),
        sampler_(make_sampler(world.model().film)),
        materials_(world.model().objects),
        keeps_records_(film.channel(kVarianceR) || film.channel(kObjectMatte) || film.channel(kMaterialMatte)),
        colors_only_(!film.keeps_data() && !film.channel(kKey) && lines_.empty() && !is_adaptive()),
        stop_(stop) {
    if (film.channel(kObjectMatte)) object_mattes_ = matte_numbers(object_names(world));
    if (film.channel(kMaterialMatte)) material_mattes_ = matte_numbers(materials_.names(world.model()));
  }

  // The tile's cost; nothing if it was given up and left no trace.
  std::optional<Tally> trace(int number) const {
    Exposure exposure(film_, number);
    if (world_.model().film.noise > 0)
      trace_to_noise(film_.tile(number), exposure);
    else if (is_adaptive())
      trace_adaptively(film_.tile(number), static_cast<float>(world_.model().film.contrast), exposure);
    else
      trace_evenly(film_.tile(number), exposure);
    if (exposure.given_up) {
      film_.clear(number);
      return std::nullopt;
    }
    film_.finish(number, exposure.sums);
    return exposure.tally;
  }

 private:
  // Samples after which a pixel may be found to be even; a picture with no more than these takes all of them.
  static constexpr int kFewSamples = 4;
  // Reach of a noisy centre sample, in pixels.
  static constexpr int kPenumbra = 2;
  // Camera rays that are met together.
  static constexpr size_t kTogether = 32;
  // Samples after which a block of pixels is first asked whether it is even enough.
  static constexpr int kFirstRound = 16;

  // The sums of a tile while it is traced.
  struct Exposure {
    Exposure(TiledFilm& film, int number) : Exposure(film, film.sums_window(number), film.reach() == 0) {}
    Exposure(TiledFilm& film, const Window& window, bool pixel_alone)
        : film(film),
          window(window),
          sums(pixel_alone ? film.planes() : film.planes() * static_cast<size_t>(window.width()) * window.height()),
          weights(2 * film.reach() + 1),
          values(film.planes() - 1),
          rays(kTogether),
          hits(kTogether) {}

    // Sets the values of the filtered layers.
    void look_at(const RaySample& s) {
      const float all[7] = {s.radiance[0], s.radiance[1], s.radiance[2], s.alpha,
                            s.direct[0],   s.direct[1],   s.direct[2]};
      std::copy_n(all + film.first_filtered(), film.base_planes(), values.begin());
      if (!film.keeps_parts()) return;
      float* next = values.data() + film.base_planes();
      const auto put = [&](const Spectrum& light) {
        for (int i = 0; i < 3; ++i) *next++ = light[i];
      };
      for (const auto part : film.parts()) put((*s.parts).*part);
      for (int g = 0; g < film.group_count(); ++g) put(s.parts->groups[static_cast<size_t>(g)]);
    }

    // The only sample of a pixel, where the filter does not reach beyond it.
    void set(int x, int y, const RaySample& sample) {
      look_at(sample);
      film.set_pixel(x, y, values.data());
    }

    // Adds a sample of pixel (x, y) at `place` in it, with the given share of the pixel's weight.
    void add(int x, int y, const Vec2& place, const RaySample& sample, double share) {
      const int reach = film.reach();
      look_at(sample);
      const Filter& filter = film.filter();
      if (reach == 0) {
        deposit(pixel_sums(x, y), share * filter.weight(place.x - 0.5) * filter.weight(place.y - 0.5));
        return;
      }
      for (int i = -reach; i <= reach; ++i) weights[i + reach] = share * filter.weight(place.x - i - 0.5);
      for (int qy = std::max(y - reach, window.y0); qy <= std::min(y + reach, window.y1 - 1); ++qy) {
        const double weight_y = filter.weight(place.y - (qy - y) - 0.5);
        for (int qx = std::max(x - reach, window.x0); qx <= std::min(x + reach, window.x1 - 1); ++qx)
          deposit(window_sums(qx, qy), weight_y * weights[qx - x + reach]);
      }
    }
    // All that another one has, its weights times `share`. It lies within this one.
    void add(const Exposure& part, double share) {
      for (int y = part.window.y0; y < part.window.y1; ++y)
        for (int x = part.window.x0; x < part.window.x1; ++x) {
          const double* from = part.sums.data() + part.place(x, y);
          double* to = pixel_sums(x, y);
          for (int i = 0; i < film.planes(); ++i) to[i] += share * from[i];
          finish(x, y);
        }
    }
    size_t place(int x, int y) const {
      return (static_cast<size_t>(y - window.y0) * window.width() + (x - window.x0)) * film.planes();
    }
    double* window_sums(int x, int y) { return &sums[place(x, y)]; }
    double* pixel_sums(int x, int y) {
      return sums.size() == static_cast<size_t>(film.planes()) ? sums.data() : window_sums(x, y);
    }
    void deposit(double* sum, double weight) {
      const int n = film.planes() - 1;
      for (int i = 0; i < n; ++i) sum[i] += weight * values[i];
      sum[n] += weight;
    }
    // All samples of the pixel are added.
    void finish(int x, int y) {
      if (film.reach() > 0) return;
      film.set_pixel(x, y, sums);
      std::fill(sums.begin(), sums.end(), 0.0);
    }

    TiledFilm& film;
    Window window;
    // Of all pixels of the window; where the filter does not reach beyond a pixel, of the pixel at hand.
    std::vector<double> sums, weights;
    std::vector<float> values;  // of the sample at hand
    std::vector<Ray> rays;      // that are met together, and what they meet
    std::vector<Hit> hits;
    Tally tally;
    bool given_up = false;
  };

  // A camera ray on its way: the place in its pixel and the number of its sample.
  struct Shot {
    int x, y;
    Vec2 place;
    int number;
  };

  bool is_adaptive() const { return world_.model().film.contrast > 0 && sampler_->samples_per_pixel() > kFewSamples; }

  static void add_shot(std::vector<Shot>& shots, int x, int y, const Vec2& place, int number) {
    Shot& shot = shots.emplace_back();
    shot.x = x;
    shot.y = y;
    shot.place = place;
    shot.number = number;
  }

  // Its place on the lens is the first pair of its random numbers.
  Ray camera_ray(const Shot& shot) const {
    const double x = shot.x + shot.place.x, y = shot.y + shot.place.y;
    if (!has_lens_) return camera_.ray(x, y);
    return camera_.lens_ray(x, y, sampler_->stream(shot.x, shot.y, shot.number).next_sobol_pair());
  }

  // The shots' rays are met together, which is faster; then `use` gets each shot with its sample and whether
  // that is finite. Once the tile is given up no more of them.
  template <class Use>
  void take(std::span<const Shot> shots, Exposure& exposure, const Use& use) const {
    std::vector<Ray>& rays = exposure.rays;
    Tally& tally = exposure.tally;
    for (size_t begin = 0; begin < shots.size(); begin += kTogether) {
      exposure.given_up = exposure.given_up || (stop_ && stop_->load(std::memory_order_relaxed));
      if (exposure.given_up) return;
      const std::span<const Shot> some = shots.subspan(begin, std::min(kTogether, shots.size() - begin));
      // Made where they stay: a copy of what was just written waits for the writing.
      for (size_t i = 0; i < some.size(); ++i) ::new (&rays[i]) Ray(camera_ray(some[i]));
      const std::span<Hit> hits(exposure.hits.data(), some.size());
      world_.nearest(std::span(rays.data(), some.size()), hits);
      for (size_t i = 0; i < some.size(); ++i) {
        const Shot& shot = some[i];
        SampleStream random = sampler_->stream(shot.x, shot.y, shot.number);
        if (has_lens_) random.skip_pairs(1);
        RaySample sample = film_.keeps_parts() ? integrator_.trace_parts(world_, rays[i], hits[i], random)
                           : colors_only_      ? integrator_.trace_color(world_, rays[i], hits[i], random)
                                               : integrator_.trace(world_, rays[i], hits[i], random);
        sample.noisy = sample.noisy || has_lens_;
        if (!lines_.empty()) lines_.draw(Vec2(shot.x, shot.y) + shot.place, sample);
        ++tally.camera_rays;
        tally.shadow_rays += sample.shadow_rays;
        tally.other_rays += sample.other_rays;
        const bool finite = is_finite(sample);
        tally.not_finite += !finite;
        use(shot, std::move(sample), finite);
      }
    }
  }

  void trace_evenly(const Window& tile, Exposure& exposure) const {
    const int samples = sampler_->samples_per_pixel();
    const bool keeps_data = film_.keeps_data(), alone = samples == 1 && film_.reach() == 0;
    std::vector<Shot> shots(static_cast<size_t>(tile.width()) * samples);  // of a row
    for (int y = tile.y0; y < tile.y1; ++y) {
      Shot* shot = shots.data();
      for (int x = tile.x0; x < tile.x1; ++x)
        for (int s = 0; s < samples; ++s)
          *shot++ = {x, y, samples == 1 ? Vec2(0.5) : sampler_->pixel_position(x, y, s), s};
      double nearest = geometry::kInfinity;
      int counted = 0;
      PixelRecord record;
      take(shots, exposure, [&](const Shot& shot, const RaySample& sample, bool finite) {
        if (finite) {
          ++counted;
          if (keeps_records_) add(record, sample);
          if (alone)
            exposure.set(shot.x, y, sample);
          else
            exposure.add(shot.x, y, shot.place, sample, 1);
          const Vec2 off = shot.place - 0.5;
          if (keeps_data && glm::dot(off, off) < nearest && film_.crop().contains(shot.x, y)) {
            nearest = glm::dot(off, off);
            store(shot.x, y, sample);
          }
        }
        if (shot.number + 1 < samples) return;
        if (!alone) exposure.finish(shot.x, y);
        count(shot.x, y, counted);
        write(shot.x, y, record);
        record.clear();
        nearest = geometry::kInfinity;
        counted = 0;
      });
      if (exposure.given_up) return;
    }
  }

  void trace_adaptively(const Window& tile, float contrast, Exposure& exposure) const {
    // The centres, with those of the neighbours around the tile.
    const Film& settings = world_.model().film;
    const Window around = intersection(tile.grown(kPenumbra), {0, 0, settings.width, settings.height});
    const int all = sampler_->samples_per_pixel();
    std::vector<RaySample> centers;
    centers.reserve(static_cast<size_t>(around.width()) * around.height());
    std::vector<Shot> shots;
    for (int y = around.y0; y < around.y1; ++y)
      for (int x = around.x0; x < around.x1; ++x) add_shot(shots, x, y, Vec2(0.5), all);
    take(shots, exposure, [&](const Shot&, RaySample&& sample, bool) { centers.push_back(std::move(sample)); });
    if (exposure.given_up) return;
    const auto index = [&](int x, int y) {
      return static_cast<size_t>(y - around.y0) * around.width() + (x - around.x0);
    };
    std::vector<PixelContent> shown(centers.begin(), centers.end());
    struct LightContribution {
      Vec2 place;
      RaySample sample;
    };
    std::vector<LightContribution> taken;
    PixelRecord record;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const RaySample& own = centers[index(x, y)];
        const PixelContent& own_shown = shown[index(x, y)];
        if (is_finite(own) && film_.crop().contains(x, y)) store(x, y, own);
        const bool parted = !lines_.empty() && lines_.may_part(x, y);
        bool even = is_finite(own) && !parted;
        // In a penumbra a single ray to the light tells little: a few pixels around one that knows count as well.
        for (int ny = std::max(y - kPenumbra, around.y0); even && ny <= std::min(y + kPenumbra, around.y1 - 1); ++ny)
          for (int nx = std::max(x - kPenumbra, around.x0); even && nx <= std::min(x + kPenumbra, around.x1 - 1); ++nx)
            even = !centers[index(nx, ny)].noisy;
        // A few samples alike tell that texture or shading is calm there, not that no outline cuts off a corner.
        bool calm = even;
        for (int ny = std::max(y - 1, around.y0); calm && ny <= std::min(y + 1, around.y1 - 1); ++ny)
          for (int nx = std::max(x - 1, around.x0); calm && nx <= std::min(x + 1, around.x1 - 1); ++nx) {
            if (!differ(own_shown, shown[index(nx, ny)], contrast)) continue;
            even = false;
            calm = !is_outline_between(own, centers[index(nx, ny)]);
          }
        if (even) {
          exposure.add(x, y, Vec2(0.5), own, all);
          exposure.finish(x, y);
          count(x, y, 1);
          if (keeps_records_) add(record, own);
          write(x, y, record);
          record.clear();
          continue;
        }
        taken.clear();
        bool alike = calm;
        // A few, and unless they are alike all others.
        for (int s = 0; s < all && (s < kFewSamples || !alike);) {
          shots.clear();
          for (const int end = alike && s < kFewSamples ? kFewSamples : all; s < end; ++s)
            add_shot(shots, x, y, sampler_->pixel_position(x, y, s), s);
          take(shots, exposure, [&](const Shot& shot, RaySample&& sample, bool) {
            alike = alike && !sample.noisy && !differ(own_shown, PixelContent(sample), contrast);
            taken.push_back({shot.place, std::move(sample)});
          });
          if (exposure.given_up) return;
        }
        int counted = 0;
        for (const LightContribution& one : taken) counted += is_finite(one.sample);
        for (const LightContribution& one : taken)
          if (is_finite(one.sample)) {
            exposure.add(x, y, one.place, one.sample, static_cast<double>(all) / counted);
            if (keeps_records_) add(record, one.sample);
          }
        exposure.finish(x, y);
        count(x, y, counted);
        write(x, y, record);
        record.clear();
      }
  }

  // Block by block: all their pixels take as many samples, which are summed apart, as all pixels weigh the same.
  void trace_to_noise(const Window& tile, Exposure& exposure) const {
    for (int y = tile.y0; y < tile.y1 && !exposure.given_up; y += kBlockSize)
      for (int x = tile.x0; x < tile.x1 && !exposure.given_up; x += kBlockSize)
        trace_block(intersection({x, y, x + kBlockSize, y + kBlockSize}, tile), exposure);
  }

  // Rounds of 16, 32, 64, ... samples in all, until the block is even enough.
  void trace_block(const Window& block, Exposure& exposure) const {
    const int all = sampler_->samples_per_pixel();
    Exposure own(film_, intersection(block.grown(film_.reach()), exposure.window), false);
    std::vector<PixelRecord> records(static_cast<size_t>(block.width()) * block.height());
    std::vector<double> nearest(records.size(), geometry::kInfinity);
    std::vector<Shot> shots;
    int taken = 0;
    for (int round = std::min(kFirstRound, all);; round = std::min(2 * round, all)) {
      shots.clear();
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
          for (int s = taken; s < round; ++s) add_shot(shots, x, y, sampler_->pixel_position(x, y, s), s);
      own.tally = {};
      take(shots, own, [&](const Shot& shot, const RaySample& sample, bool finite) {
        if (!finite) return;
        const size_t i = static_cast<size_t>(shot.y - block.y0) * block.width() + (shot.x - block.x0);
        if (film_.reach() > 0 || own.window.contains(shot.x, shot.y)) own.add(shot.x, shot.y, shot.place, sample, 1);
        add(records[i], sample);
        const Vec2 off = shot.place - 0.5;
        if (glm::dot(off, off) >= nearest[i] || !film_.crop().contains(shot.x, shot.y)) return;
        nearest[i] = glm::dot(off, off);
        store(shot.x, shot.y, sample);
      });
      exposure.tally += own.tally;
      exposure.given_up = own.given_up;
      if (exposure.given_up) return;
      taken = round;
      if (taken == all || displayed_error(records) <= world_.model().film.noise) break;
    }
    exposure.add(own, static_cast<double>(all) / taken);
    for (int y = block.y0; y < block.y1; ++y)
      for (int x = block.x0; x < block.x1; ++x) {
        PixelRecord& record = records[static_cast<size_t>(y - block.y0) * block.width() + (x - block.x0)];
        count(x, y, record.count);
        write(x, y, record);
      }
  }

  void add(PixelRecord& record, const RaySample& sample) const {
    record.add(sample.radiance);
    if (!sample.point) return;
    const SurfacePoint& point = *sample.point;
    if (!object_mattes_.empty()) record.objects.add(object_mattes_[point.object]);
    if (material_mattes_.empty() || lines_.color(point)) return;
    const Material& material = world_.material(point, glm::dot(point.incoming, point.geometric_normal) < 0);
    if (const uint32_t number = materials_(material)) record.materials.add(material_mattes_[number - 1]);
  }

  void write(int x, int y, PixelRecord& record) const {
    if (!keeps_records_ || !film_.crop().contains(x, y)) return;
    const size_t i = pixel(x, y);
    const Vec3 variance = record.variance();
    for (int c = 0; c < 3; ++c)
      if (Channel* kept = film_.channel(static_cast<FilmChannel>(kVarianceR + c)))
        kept->values[i] = static_cast<float>(variance[c]);
    const int samples = std::max(record.count, 1);
    if (Channel* kept = film_.channel(kObjectMatte)) record.objects.write(kept, i, samples);
    if (Channel* kept = film_.channel(kMaterialMatte)) record.materials.write(kept, i, samples);
  }

  void count(int x, int y, int samples) const {
    if (Channel* kept = film_.channel(kSamples); kept && film_.crop().contains(x, y))
      kept->values[pixel(x, y)] = static_cast<float>(samples);
  }

  size_t pixel(int x, int y) const {
    const Window& crop = film_.crop();
    return static_cast<size_t>(y - crop.y0) * crop.width() + (x - crop.x0);
  }

  // The data layers of a sample.
  void store(int x, int y, const RaySample& sample) const {
    const size_t i = pixel(x, y);
    const auto set = [&](FilmChannel c, double value) {
      if (Channel* kept = film_.channel(c)) kept->values[i] = static_cast<float>(value);
    };
    const auto set3 = [&](FilmChannel first, const Vec3& v) {
      for (int k = 0; k < 3; ++k) set(static_cast<FilmChannel>(first + k), v[k]);
    };
    if (!film_.keeps_data()) return;
    if (Channel* key = film_.channel(kKey)) key->ids[i] = static_cast<uint32_t>(sample.key ^ (sample.key >> 32));
    if (!sample.point) {
      film_.clear_data(i);
      return;
    }
    const SurfacePoint& point = *sample.point;
    set(kZ, sample.depth);
    set3(kPX, point.position);
    set3(kNX, point.normal);
    set3(kNgX, point.geometric_normal);
    set(kU, point.u);
    set(kV, point.v);
    set(kQuantity, sample.quantity);
    if (const auto color = lines_.color(point)) {
      set3(kAlbedoR, *color);
      if (Channel* object = film_.channel(kObject)) {
        object->ids[i] = static_cast<uint32_t>(point.object + 1);
        film_.channel(kMaterial)->ids[i] = 0;
      }
      return;
    }
    const Material& material = world_.material(point, glm::dot(point.incoming, point.geometric_normal) < 0);
    if (film_.channel(kAlbedoR)) set3(kAlbedoR, rgb(material.albedo(point, Wavelengths{})));
    if (Channel* object = film_.channel(kObject)) {
      object->ids[i] = static_cast<uint32_t>(point.object + 1);
      film_.channel(kMaterial)->ids[i] = materials_(material);
    }
  }

  const World& world_;
  const Camera& camera_;
  const Integrator& integrator_;
  TiledFilm& film_;
  PictureLines lines_;
  SamplerPtr sampler_;
  MaterialNumbers materials_;
  std::vector<float> object_mattes_, material_mattes_;  // by number less one; none without their layer
  bool keeps_records_;                                  // of pixels
  bool colors_only_;                                    // of samples
  bool has_lens_ = camera_.has_lens();
  const std::atomic<bool>* stop_;
};

// What is done so far, kept by all threads together.
class Ledger {
 public:
  Ledger(TiledFilm& film, const RenderOptions& options)
      : film_(film), options_(options), save_interval_(options.save_interval) {
    std::vector<char> is_done(film.tile_count(), 0);
    for (const std::string& file : options.resume_files)
      for (const int tile : read_partial(file, film, options.identity, tally_))
        if (!std::exchange(is_done[tile], 1)) done_.push_back(tile);
    part_done_ = std::count_if(done_.begin(), done_.end(), [&](int tile) { return is_asked_for(tile); });
  }

  // A tile of the part of the picture that is made.
  bool is_asked_for(int tile) const { return !options_.part || tile % options_.part->count == options_.part->index; }

  bool stopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }
  bool complete() const { return static_cast<int>(done_.size()) == film_.tile_count(); }
  bool part_complete() const { return part_done_ == tiles_of_part(); }
  const Tally& tally() const { return tally_; }
  const std::vector<int>& done() const { return done_; }

  void finished(int tile, const Tally& tally) {
    bool save = false;
    {
      std::lock_guard lock(mutex_);
      done_.push_back(tile);
      ++part_done_;
      tally_ += tally;
      const Clock::time_point now = Clock::now();
      if (options_.progress && now - last_progress_ >= kProgressInterval) {
        last_progress_ = now;
        report();
      }
      if (!options_.partial_file.empty() && now - last_save_ >= save_interval_) {
        last_save_ = now;
        save = true;
      }
    }
    if (save) write();
  }

  void report() const {
    if (options_.progress)
      options_.progress(static_cast<double>(part_done_) / std::max<std::ptrdiff_t>(tiles_of_part(), 1),
                        tally_.camera_rays + tally_.shadow_rays + tally_.other_rays);
  }

  // The finished tiles do not change any more, so others may go on while this is written. A full disk costs what could
  // be resumed, not the picture. Whether it was written.
  bool write() {
    std::unique_lock writing(write_mutex_, std::try_to_lock);
    if (!writing) return false;
    std::vector<int> done;
    Tally tally;
    {
      std::lock_guard lock(mutex_);
      done = done_;
      tally = tally_;
    }
    try {
      PartialHeader header;
      header.identity = options_.identity;
      header.part = options_.part.value_or(PicturePart());
      header.job = options_.job;
      write_partial(options_.partial_file, film_, header, done, tally);
      return true;
    } catch (const ImageError& error) {
      if (options_.warning && !warned_) options_.warning(error.what());
      warned_ = true;
      return false;
    }
  }

 private:
  std::ptrdiff_t tiles_of_part() const {
    const PicturePart part = options_.part.value_or(PicturePart());
    return (film_.tile_count() - part.index + part.count - 1) / part.count;
  }

  TiledFilm& film_;
  const RenderOptions& options_;
  const std::chrono::duration<double> save_interval_;
  std::mutex mutex_, write_mutex_;
  bool warned_ = false;  // guarded by write_mutex_
  std::vector<int> done_;
  std::ptrdiff_t part_done_ = 0;  // of those, tiles of the part that is made
  Tally tally_;
  Clock::time_point last_progress_ = Clock::now(), last_save_ = Clock::now();
};

void describe(Image& image, const Model& model) {
  image.metadata["lekalo.samples"] = model.film.samples;
  image.metadata["lekalo.filter"] = model.film.filter;
  image.metadata["lekalo.seed"] = static_cast<int>(model.film.seed);
  if (!model.source.empty()) image.metadata["lekalo.scene"] = model.source;
  if (!model.title.empty()) image.metadata["lekalo.title"] = model.title;
  if (!model.unit.empty()) image.metadata["lekalo.unit"] = model.unit;
  for (const auto& [name, value] : model.parameters) image.metadata["lekalo.parameter." + name] = value;
}

}  // namespace

RenderResult render(const World& world, const RenderOptions& options) {
  const Model& model = world.model();
  if (!model.camera || !model.integrator) throw std::invalid_argument("a picture needs a camera and an integrator");
  if (model.camera->width() != model.film.width || model.camera->height() != model.film.height)
    throw std::invalid_argument("the camera was made for a picture of another size");
  const Clock::time_point begin = Clock::now();
  const IntegratorPtr prepared = model.integrator->prepared(world);
  const Integrator& integrator = prepared ? *prepared : *model.integrator;
  TiledFilm film(model.film, options.key_layer, {integrator.quantity(), integrator.tells_parts(), light_groups(model)});
  Ledger ledger(film, options);
  std::vector<char> is_done(film.tile_count(), 0);
  for (const int tile : ledger.done()) is_done[tile] = 1;

  const TileTracer tracer(world, integrator, film, options.stop);
  const int threads = options.threads > 0 ? options.threads : tbb::task_arena::automatic;
  std::unique_ptr<tbb::global_control> more_threads;  // than there are cores, if asked for
  if (options.threads > 0)
    more_threads = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, options.threads);
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, film.tile_count(), 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int tile = range.begin(); tile < range.end(); ++tile) {
            if (is_done[tile] || !ledger.is_asked_for(tile) || ledger.stopped()) continue;
            if (const std::optional<Tally> tally = tracer.trace(tile)) ledger.finished(tile, *tally);
          }
        },
        tbb::simple_partitioner());
  });

  RenderResult result;
  result.complete = ledger.complete();
  result.part_complete = ledger.part_complete();
  result.saved = (!result.complete || options.part) && !options.partial_file.empty() && ledger.write();
  film.develop();
  if (film.channel(kDenoisedR) && result.complete) denoise(film.image());
  describe(film.image(), model);
  if (film.channel(kObjectMatte)) describe_cryptomatte(film.image(), "CryptoObject", object_names(world));
  if (film.channel(kMaterialMatte))
    describe_cryptomatte(film.image(), "CryptoMaterial", MaterialNumbers(model.objects).names(model));
  result.image = std::move(film.image());
  result.camera_rays = ledger.tally().camera_rays;
  result.shadow_rays = ledger.tally().shadow_rays;
  result.other_rays = ledger.tally().other_rays;
  result.notes = integrator.notes();
  result.scale = integrator.scale();
  result.not_finite = ledger.tally().not_finite;
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  ledger.report();
  return result;
}

}  // namespace lekalo::render
