#pragma once
/// The models whose datapaths are tested: those of the catalogue, and one given as text that uses every operation.

#include <fstream>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/words/study.hpp"
#include "mote/base/scratch_folder.hpp"
#include "mote/hardware/datapath/datapath.hpp"

namespace mote::hardware {

/// A model, what a filter's particles were, and its circuit.
struct Subject {
  std::string name;
  graph::Recorded recorded;
  Samples samples;
  Datapath datapath;
};

/// A model by its name in the catalogue or its file.
inline std::unique_ptr<CatalogueModel> catalogue_model(const std::string& name,
                                                       const std::vector<std::string>& settings = {}) {
  return find_model(name, "test").make(Settings("test", settings), frame_header(6));
}

inline Subject subject(const std::string& name, const CatalogueModel& model, DatapathOptions options = {}) {
  const WordStudy study(model, {.particles = 200, .steps = 40, .recordings = 4, .search = {}});
  options.prefix = name;
  const Samples samples = study.samples();
  return {name, study.recorded(), samples, datapath(study.recorded(), samples, options)};
}

/// A file that stands in a folder of its own.
inline std::string file_of(const ScratchFolder& folder, const std::string& name, const std::string& text) {
  const std::string path = (folder.path() / name).string();
  std::ofstream(path) << text;
  return path;
}

/// + - * / sqrt exp log sin cos tan atan2 abs min max, a power, normal and uniform numbers, a wrapped angle, an input.
inline constexpr const char* kEveryOperation = R"toml(
[parameters]
q = 0.3
[inputs]
gain = 1.0
[states]
x = "normal(1, 0.5)"
v = "0.2*uniform(-1, 1)"
a = "normal(0, 0.3)"
[next]
x = "0.9*x + v/(1 + abs(x)) + 0.1*sin(x) + q*normal(0, 1)"
v = "0.8*v + 0.1*tan(0.2*(a + v)) + max(min(0.2*x, 0.5), -0.5) + uniform(-0.1, 0.1)"
a = "wrap(a + atan2(0.1*v, 1 + x^2) + normal(0, 0.05))"
[observations]
y = "normal(gain*(sqrt(1 + x^2) + exp(-0.5*abs(v))), 0.3)"
z = "normal(log(1.5 + cos(a)), 0.2)"
)toml";

/// Two states, two measurements, all correlated but the measurements' errors.
inline constexpr const char* kLinear = R"(
F = [[0.9, 0.3], [-0.2, 0.7]]
Q = [[0.5, 0.1], [0.1, 0.3]]
H = [[1.0, 0.5], [0.0, 2.0]]
R = [[0.4, 0.0], [0.0, 0.9]]
mean = [1.0, -1.0]
covariance = [[1.0, 0.2], [0.2, 2.0]]
)";

inline std::vector<Subject> subjects(const DatapathOptions& options = {}) {
  const ScratchFolder folder;
  const std::string linear = file_of(folder, "linear.toml", kLinear);
  std::vector<Subject> all;
  all.push_back(subject("ungm", *catalogue_model("ungm"), options));
  all.push_back(subject("ungm2", *catalogue_model("ungm", {"copies=2"}), options));
  all.push_back(subject("bearings", *catalogue_model("bearings"), options));
  all.push_back(subject("doa", *catalogue_model("doa"), options));
  all.push_back(subject("local_level", *catalogue_model("local-level"), options));
  all.push_back(subject("linear", *catalogue_model("linear-gaussian", {"file=" + linear}), options));
  all.push_back(subject("every", *catalogue_model(file_of(folder, "every.toml", kEveryOperation)), options));
  return all;
}

}  // namespace mote::hardware
