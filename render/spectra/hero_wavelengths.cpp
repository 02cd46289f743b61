#include "render/spectra/hero_wavelengths.h"

#include <algorithm>
#include <cmath>

#include "render/spectra/illuminants.h"
#include "render/spectra/observer.h"

namespace lekalo::render {

namespace {

// Between the entries r is straight; the choice is even within a step.
struct Choice {
  std::vector<double> ends{0};  // of the probability, up to each entry
  Choice() {
    const std::vector<Vec3>& r = white_response();
    for (size_t i = 0; i + 1 < r.size(); ++i) {
      const Vec3 mean = 0.5 * (glm::abs(r[i]) + glm::abs(r[i + 1]));
      ends.push_back(ends.back() + mean.x + mean.y + mean.z);
    }
    const double sum = ends.back();
    for (double& end : ends) end /= sum;
  }
};

}  // namespace

const std::vector<Vec3>& white_response() {
  static const std::vector<Vec3> table = [] {
    std::vector<Vec3> r;
    for (int i = 0; i < kSpectrumEntries; ++i)
      r.push_back(illuminant_power("D65", entry_nanometres(i)) * rec709(observer()[static_cast<size_t>(i)]));
    Vec3 integral = -0.5 * (r.front() + r.back());
    for (const Vec3& one : r) integral += one;
    for (Vec3& one : r) one /= kNanometreStep * integral;
    return r;
  }();
  return table;
}

Vec3 color_of(const std::function<double(double)>& multiple) {
  const std::vector<Vec3>& r = white_response();
  Vec3 sum(0);
  for (int i = 0; i < kSpectrumEntries; ++i) {
    const double width = kNanometreStep * (i == 0 || i + 1 == kSpectrumEntries ? 0.5 : 1);
    sum += width * multiple(entry_nanometres(i)) * r[static_cast<size_t>(i)];
  }
  return sum;
}

WavelengthSample sample_wavelength(double random) {
  static const Choice choice;
  const std::vector<double>& ends = choice.ends;
  const auto after = std::upper_bound(ends.begin() + 1, ends.end() - 1, random);
  const size_t i = static_cast<size_t>(after - ends.begin()) - 1;
  const double width = ends[i + 1] - ends[i];
  const double share = std::clamp((random - ends[i]) / width, 0.0, 1.0);
  const Vec3 response = glm::mix(white_response()[i], white_response()[i + 1], share);
  return {static_cast<float>(kFirstNanometre + kNanometreStep * (static_cast<double>(i) + share)),
          rgb(response * (kNanometreStep / width))};
}

HeroWavelengths hero_wavelengths(double random) {
  HeroWavelengths hero;
  for (size_t i = 0; i < 4; ++i) {
    const double place = random + 0.25 * static_cast<double>(i);
    const WavelengthSample sample = sample_wavelength(place - std::floor(place));
    hero.wavelengths.nanometres[i] = sample.nanometres;
    hero.shares[i] = 0.25f * sample.share;
  }
  return hero;
}

}  // namespace lekalo::render
