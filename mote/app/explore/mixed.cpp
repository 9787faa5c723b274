#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "mote/analog/budget.hpp"
#include "mote/analog/placement.hpp"
#include "mote/app/analog/circuit_words.hpp"
#include "mote/app/analog/mixed_run.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/app/explore/filters.hpp"
#include "mote/app/explore/target.hpp"
#include "mote/app/terminal/shell.hpp"
#include "mote/engine/run.hpp"

namespace mote::explore {
namespace {

using analog::Function;
using analog::Implementation;
using analog::Method;

/// A method with a filter that it has.
struct Variant {
  Method method;
  std::string kind, filter;
};
const std::vector<Variant>& variants() {
  static const std::vector<Variant> all{
      {Method::kWeights, "sisr", "sisr"},          {Method::kWeights, "imh", "imh"},
      {Method::kWeights, "imh", "imh --improved"}, {Method::kAllButResampling, "sisr", "sisr"},
      {Method::kAllButResampling, "imh", "imh"},   {Method::kAllButResampling, "imh", "imh --improved"},
      {Method::kAllButRandom, "imh", "imh"}};
  return all;
}

/// I_a of the arctangent and of the Gaussian, in nA.
struct Currents {
  double arctan = 0, gaussian = 0;
};

const std::string kCopies = "copies=";
constexpr int kMoreForDac = 2;  // bits, as the paper's DAC has more than its ADC

class Mixed final : public Target {
 public:
  explicit Mixed(const Space& space) : space_(space), recorded_(space_.catalogue_model->recorded()) {
    const std::vector<std::string> kinds = kinds_of(space_, {"sisr", "imh"});
    std::vector<Words> all;
    for (const Variant& variant : variants()) {
      if (std::find(kinds.begin(), kinds.end(), variant.kind) == kinds.end()) continue;
      const std::vector<int> bits =
          variant.method == Method::kAllButRandom ? std::vector{0} : listed(space_.bits, {6, 8, 10});
      for (const Currents& i : currents())
        for (const std::size_t n : listed(space_.particles, {64, 256, 1024, 4096}))
          for (const int b : bits)
            for (const std::size_t copies : listed(space_.workers, {1, 8})) {
              const Words words = words_of(variant, i, n, b, copies);
              if (std::find(all.begin(), all.end(), words) == all.end()) all.push_back(words);
            }
    }
    candidates_ = accepted(space_, all, "filters with particles, currents, bits and copies",
                           [&](const Words& words) { make(words); });
    for (const Words& words : candidates_) takes_.push_back(found_takes(words));
  }

  std::string name() const override { return "mixed"; }
  std::string meaning() const override {
    return "circuits simulated by ngspice; time by their settling; power of circuits, converters, adders, products and "
           "random numbers by the components of MIXED, the resampler's left out";
  }
  std::vector<Figure> figures() const override {
    return {{"time", "s", "--deadline"}, {"power", "mW", "--max-power"}, {"copies", "", "--max-workers", false}};
  }
  const std::vector<Words>& candidates() const override { return candidates_; }
  bool measures() const override { return false; }
  std::vector<double> takes(std::size_t c, Memory& /*memory*/) const override { return takes_[c]; }

  RunRecord run(std::size_t c, const Recording& recording, std::uint64_t seed) const override {
    Plan plan = plan_from(arguments_of(candidates_[c]));
    plan.seed = seed;
    const auto filter = mixed_filter(*space_.catalogue_model, plan, designs_.at(key_of(candidates_[c])), space_.where);
    RunRequest request;
    request.where = space_.where;
    request.states = space_.catalogue_model->states();
    return mote::run(*filter, plan, recording, request);
  }
  std::string command(std::size_t c, const std::string& data) const override {
    return fmt::format("mote analog run {}{} --data {} {} --out estimates.csv", shell_word(space_.model),
                       settings_of(space_), shell_word(data), key_of(candidates_[c]));
  }

 private:
  template <class T>
  static std::vector<T> listed(const std::vector<T>& told, std::vector<T> own) {
    return told.empty() ? own : told;
  }
  /// Both circuits at the same; without any told, Table III's too.
  std::vector<Currents> currents() const {
    std::vector<Currents> all;
    for (const int na : listed(space_.currents, {1, 10, 50}))
      all.push_back({static_cast<double>(na), static_cast<double>(na)});
    if (space_.currents.empty())
      all.push_back(
          {1e9 * analog::table3_current(Function::kArctan), 1e9 * analog::table3_current(Function::kGaussian)});
    return all;
  }

  /// The last word says how many circuits work side by side, on which estimates do not depend.
  Words words_of(const Variant& variant, const Currents& i, std::size_t n, int bits, std::size_t copies) const {
    const analog::Wanted has = analog::functions_of(recorded_, variant.method);
    std::string circuits;
    if (has.arctan) circuits = fmt::format("arctan=mite:Ia={:g}n", i.arctan);
    if (has.gaussian) circuits += fmt::format("{}gaussian=mite:Ia={:g}n", circuits.empty() ? "" : ",", i.gaussian);
    std::string text =
        fmt::format("--method {} --filter {} -n {}", static_cast<int>(variant.method), variant.filter, n);
    if (!circuits.empty()) text += " --analog " + circuits;
    if (variant.method == Method::kWeights) text += fmt::format(" --dac-bits {}", bits + kMoreForDac);
    if (variant.method != Method::kAllButRandom) text += fmt::format(" --adc-bits {}", bits);
    Words words = words_in(text);
    words.push_back(kCopies + std::to_string(copies));
    return words;
  }
  static std::string key_of(const Words& words) {
    return fmt::format("{}", fmt::join(words.begin(), words.end() - 1, " "));
  }
  static double copies_of(const Words& words) { return std::stod(words.back().substr(kCopies.size())); }
  static Arguments arguments_of(const Words& words) {
    return arguments_from("mote analog run", mixed_run_options(), {words.begin(), words.end() - 1});
  }

  /// Simulates the circuits of a candidate, once for all that have the same, and refuses what mixed mode does not have.
  void make(const Words& words) {
    const auto [found, fresh] = designs_.try_emplace(key_of(words));
    if (!fresh) return;
    const Arguments arguments = arguments_of(words);
    found->second = design_from(arguments, *space_.catalogue_model);
    mixed_filter(*space_.catalogue_model, plan_from(arguments), found->second, space_.where);
  }

  std::vector<double> found_takes(const Words& words) const {
    const Plan plan = plan_from(arguments_of(words));
    const analog::Design& design = designs_.at(key_of(words));
    const analog::Load load = load_of(design);
    const Implementation implementation = implementation_of(design.method);
    const double rate = copies_of(words) * analog::rate_of_copy(load, implementation);
    const double mac_w = analog::digital_mac_power(load.rate_hz) / analog::kAnalogMacSaving;
    const auto particles = static_cast<double>(plan.particles);
    return {particles / rate, 1e3 * analog::whole_power_at_rate(load, implementation, rate, mac_w), copies_of(words)};
  }

  /// The Gaussian of a design; the square of Method-3, half of one, takes no more than one at the arctangent's current.
  static analog::Behaviour::Facts gaussian_of(const analog::Design& design) {
    if (design.gaussian) return design.gaussian->facts();
    const double ia_a = design.arctan ? design.arctan->facts().ia_a : analog::table3_current(Function::kArctan);
    return circuit_behaviour(Function::kGaussian, {analog::Level::kRealistic, ia_a}).facts();
  }

  /// The circuits of a particle settle one after the other, those of a kind side by side.
  analog::Load load_of(const analog::Design& design) const {
    const analog::Placement placement = analog::placed(recorded_, design.method, {}, design.cells);
    analog::Load load;
    load.arctan_w = load.gaussian_w = 0;
    double settling_s = 0;
    if (design.arctan) {
      load.arctan_w = static_cast<double>(placement.arctans) * design.arctan->facts().power_w;
      settling_s += design.arctan->facts().settling_s;
    }
    if (placement.gaussians > 0) {
      const analog::Behaviour::Facts gaussian = gaussian_of(design);
      load.gaussian_w = static_cast<double>(placement.gaussians) * gaussian.power_w;
      settling_s += gaussian.settling_s;
    }
    load.dac = design.dac;
    load.adc = design.adc;
    load.rate_hz = 1 / settling_s;
    load.normals = static_cast<int>(recorded_.draws.size());
    const auto moves = graph::operations(recorded_.graph, recorded_.next);
    load.additions = 0;
    for (const char* op : {"add", "subtract"})
      if (const auto found = moves.find(op); found != moves.end()) load.additions += static_cast<int>(found->second);
    return load;
  }
  static Implementation implementation_of(Method method) {
    return method == Method::kWeights            ? Implementation::kMethod1
           : method == Method::kAllButResampling ? Implementation::kMethod2
                                                 : Implementation::kMethod3;
  }

  Space space_;
  graph::Recorded recorded_;
  std::map<std::string, analog::Design> designs_;  ///< by the words of a run
  std::vector<Words> candidates_;
  std::vector<std::vector<double>> takes_;
};

}  // namespace

std::unique_ptr<Target> mixed_mode(const Space& space, const Recording& /*unread*/) {
  return std::make_unique<Mixed>(space);
}

}  // namespace mote::explore
