#include "mote/engine/estimand.hpp"

#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || std::isnan(value)) return std::nullopt;
  return value;
}

std::string names_of(const std::vector<ValueSource>& sources) {
  std::string names;
  for (const auto& source : sources) names += (names.empty() ? "" : ", ") + source.quantity.name;
  return names;
}

/// The parts of `head(inner)`, or of a bare name as `mean(name)`.
struct Call {
  std::string_view head, inner;
};

std::optional<Call> call_of(std::string_view text) {
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos) return Call{"mean", text};
  if (text.back() != ')') return std::nullopt;
  return Call{text.substr(0, open), text.substr(open + 1, text.size() - open - 2)};
}

}  // namespace

Estimand parse_estimand(const std::string& text, const std::vector<ValueSource>& sources, const std::string& where) {
  using Kind = Estimand::Kind;
  const auto refused = [&] {
    return Refusal(
        ExitCode::kWrongUse,
        {where, "--estimate",
         fmt::format("mean(f), sd(f), median(f), q0.9(f), P(f>1.5) or P(f<1.5) with f one of {}", names_of(sources)),
         text, "Pass for example --estimate \"q0.95(" + sources.front().quantity.name + ")\"."});
  };
  const auto call = call_of(text);
  if (!call || text.find(',') != std::string::npos) throw refused();
  std::string_view inner = call->inner;
  Estimand estimand{text, Kind::kMean, 0, 0};
  if (call->head == "sd") {
    estimand.kind = Kind::kSd;
  } else if (call->head == "median") {
    estimand = {text, Kind::kQuantile, 0.5, 0};
  } else if (call->head.starts_with("q")) {
    const auto level = number(call->head.substr(1));
    if (!level || *level < 0 || *level > 1) throw refused();
    estimand = {text, Kind::kQuantile, *level, 0};
  } else if (call->head == "P") {
    const std::size_t sign = inner.find_first_of("<>");
    if (sign == std::string_view::npos) throw refused();
    const auto threshold = number(inner.substr(sign + 1));
    if (!threshold) throw refused();
    estimand = {text, inner[sign] == '>' ? Kind::kAbove : Kind::kBelow, *threshold, 0};
    inner = inner.substr(0, sign);
  } else if (call->head != "mean") {
    throw refused();
  }
  for (; estimand.source < sources.size(); ++estimand.source)
    if (sources[estimand.source].quantity.name == inner) return estimand;
  throw refused();
}

double evaluate(const Estimand& estimand, const ValueSource& source, const WeightedSet& set,
                std::vector<double>& scratch) {
  using Kind = Estimand::Kind;
  scratch.resize(set.size());
  source.fill(set, scratch);
  const std::span<const double> values = scratch;
  switch (estimand.kind) {
    case Kind::kMean:
      return moments(values, set.weights, set.total, source.quantity.angle).mean;
    case Kind::kSd:
      return moments(values, set.weights, set.total, source.quantity.angle).sd;
    case Kind::kQuantile:
      return quantile(values, set.weights, estimand.argument, source.quantity.angle);
    case Kind::kAbove:
      return probability(values, set.weights, estimand.argument, true);
    case Kind::kBelow:
      return probability(values, set.weights, estimand.argument, false);
  }
  return kNaN;
}

}  // namespace mote
