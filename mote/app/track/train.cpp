#include "mote/app/track/train.hpp"

#include <filesystem>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>

#include "mote/app/files/output.hpp"
#include "mote/vision/frames.hpp"
#include "mote/vision/training.hpp"

namespace mote {

ExitCode run_train(const Arguments& arguments) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  const std::string out = arguments.required("--out", "a file for the detector", "Pass --out vehicles.txt.");
  for (const std::string name : {"--positives", "--negatives"})
    arguments.required(name, "a picture of 64 x 64 patches", fmt::format("Pass {} patches.png.", name));
  std::vector<std::unique_ptr<vision::Frames>> scenes;
  for (const std::string& path : arguments.list("--scenes"))
    scenes.push_back(vision::open_frames(path, vision::Sizes::kAny));
  OutputSet outputs;
  for (const std::string name : {"--positives", "--negatives"})
    for (const std::string& path : arguments.list(name)) outputs.protect(path);
  for (const auto& frames : scenes)
    for (const std::string& path : frames->files()) outputs.protect(path);
  Output* file = outputs.open(out);
  vision::Training training;
  for (const std::string& path : arguments.list("--positives")) training.add_mosaic(path, true);
  for (const std::string& path : arguments.list("--negatives")) training.add_mosaic(path, false);
  std::vector<float> weights = training.train();
  std::size_t hard = 0;
  for (const auto& frames : scenes)
    while (const auto frame = frames->next()) hard += training.add_hard_negatives(*frame, weights);
  if (hard > 0) weights = training.train();
  for (const float weight : weights) file->write(fmt::format("{}\n", weight));
  outputs.commit();
  fmt::print("{} patches with a target, {} without, {} of these hard negatives\n", training.positives(),
             training.negatives(), hard);
  return ExitCode::kDone;
}

}  // namespace mote
