#include "mote/app/reproduce/drawn_clip.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "mote/app/files/output.hpp"
#include "mote/base/draws.hpp"
#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
enum Picture : std::uint32_t { kScene, kTarget, kPath, kNoise };  // what draws are for

/// Random grey levels on a grid, smoothly joined.
class Texture {
 public:
  Texture(std::uint64_t seed, std::uint32_t stream, int columns, int rows) : columns_(columns) {
    Draws{seed, 0, stream}.for_each(Purpose::kTruth, 0,
                                    static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                                    [&](std::size_t, auto& draw) { levels_.push_back(20 + 216 * draw.uniform()); });
  }
  /// The level at a place of the grid, in [0, columns - 1) x [0, rows - 1).
  double at(double x, double y) const {
    const int i = static_cast<int>(x);
    const int j = static_cast<int>(y);
    const double u = eased(x - i);
    const double v = eased(y - j);
    return (1 - v) * ((1 - u) * level(i, j) + u * level(i + 1, j)) +
           v * ((1 - u) * level(i, j + 1) + u * level(i + 1, j + 1));
  }

 private:
  static double eased(double u) { return u * u * (3 - 2 * u); }
  double level(int i, int j) const { return levels_[static_cast<std::size_t>(j * columns_ + i)]; }

  int columns_;
  std::vector<double> levels_;
};

struct Place {
  double x, y, w, h;  ///< centre and sides, px
};

Place place_at(int t, std::uint64_t seed) {
  const auto phase = [&](std::uint32_t which) { return 2 * kPi * Draws{seed, which, kPath}.uniform(Purpose::kTruth); };
  return {160 + 50 * std::sin(2 * kPi * t / 90 + phase(0)), 120 + 30 * std::sin(2 * kPi * t / 60 + phase(1)), 48, 40};
}

std::string picture(const Texture& scene, const Texture& target, const Place& place, const Draws& noise) {
  constexpr double kSceneGrain = 12;
  constexpr double kTargetCells = 6.9;  // along each side
  std::string levels(std::size_t{kWidth} * kHeight, '\0');
  noise.for_each(Purpose::kObserve, 0, levels.size(), [&](std::size_t k, auto& draw) {
    const double x = static_cast<double>(k % kWidth) + 0.5;
    const double y = static_cast<double>(k / kWidth) + 0.5;
    const double u = (x - place.x) / place.w + 0.5;
    const double v = (y - place.y) / place.h + 0.5;
    const bool inside = u >= 0 && u < 1 && v >= 0 && v < 1;
    const double level =
        inside ? target.at(u * kTargetCells, v * kTargetCells) : scene.at(x / kSceneGrain, y / kSceneGrain);
    levels[k] =
        static_cast<char>(static_cast<unsigned char>(std::lround(std::clamp(level + 4 * draw.normal(), 0.0, 255.0))));
  });
  return fmt::format("P5\n{} {}\n255\n", kWidth, kHeight) + levels;
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  Output file(path.string());
  file.write(bytes);
  file.commit();
}

}  // namespace

std::string draw_clip(const std::filesystem::path& folder, int frames, std::uint64_t seed) {
  const Texture scene(seed, kScene, 29, 22);
  const Texture target(seed, kTarget, 8, 8);
  std::string truth = "frame,x,y,w,h\n";
  const auto box = [](const Place& p) {
    return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}", p.x - p.w / 2, p.y - p.h / 2, p.w, p.h);
  };
  for (int t = 0; t < frames; ++t) {
    const Place place = place_at(t, seed);
    const Draws noise{seed, static_cast<std::uint32_t>(t), kNoise};
    write_file(folder / fmt::format("f{:04}.pgm", t + 1), picture(scene, target, place, noise));
    truth += fmt::format("{},{}\n", t + 1, box(place));
  }
  write_file(folder / "truth.csv", truth);
  return box(place_at(0, seed));
}

}  // namespace mote::reproduce
