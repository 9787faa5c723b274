#include "mote/app/simulated/platform.hpp"

#include <array>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/base/filled_in.hpp"
#include "mote/base/refusal.hpp"

namespace mote::simulated {
namespace {

constexpr long long kMostCores = 1024;

/// What stands between two texts, the first time that it does.
std::optional<std::string> between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t start = text.find(before);
  if (start == std::string_view::npos) return std::nullopt;
  const std::size_t end = text.find(after, start + before.size());
  if (end == std::string_view::npos) return std::nullopt;
  return std::string(text.substr(start + before.size(), end - start - before.size()));
}

/// A number with one of the units of SimGrid that the files use.
std::optional<double> quantity(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 8> kUnits{
      {{"GBps", 1e9}, {"MBps", 1e6}, {"kBps", 1e3}, {"Bps", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"s", 1}}};
  for (const auto& [unit, size] : kUnits)
    if (text.ends_with(unit)) {
      const auto number = number_in(std::string_view(text).substr(0, text.size() - unit.size()));
      return number ? std::optional(*number * size) : std::nullopt;
    }
  return std::nullopt;
}

/// A platform from the text of its file: the first comment says what it is, the cluster's attributes the rest.
Platform described(const std::string& name, const std::string& xml) {
  const std::string cluster = between(xml, "<cluster", "/>").value();
  const auto attribute = [&](const std::string& key) { return between(cluster, " " + key + "=\"", "\"").value_or(""); };
  return {.name = name,
          .meaning = between(xml, "<!-- ", " -->").value(),
          .xml = xml,
          .hosts = static_cast<std::size_t>(integer_in(attribute("radical").substr(2)).value()) + 1,  // "0-15"
          .link_latency_s = quantity(attribute("lat")).value(),
          .bandwidth = quantity(attribute("bw")).value(),
          .ring = !attribute("topology").empty()};
}

/// One of data/platforms, with so many cores where it is a template.
Platform built_in(const std::string& name, const std::string& file, long long cores) {
  return described(name, filled_in(platform_files().at(file),
                                   {{"cores", std::to_string(cores)}, {"last", std::to_string(cores - 1)}}));
}

}  // namespace

Platform platform_from(const std::string& text, const std::string& where) {
  for (const char* name : {"red", "blue", "modern", "ideal"})
    if (text == name) return built_in(text, text, 0);
  const auto refused = [&](const std::string& expected) {
    return Refusal(ExitCode::kWrongUse, {where, "--platform", expected, "\"" + text + "\"", "Pass --platform modern."});
  };
  if (text.starts_with("ring:")) {
    const auto cores = integer_in(text.substr(5));
    if (!cores || *cores < 2 || *cores > kMostCores)
      throw refused(fmt::format("ring:N, N cores from 2 to {}", kMostCores));
    return built_in(text, "ring", *cores);
  }
  if (!text.ends_with(".xml")) throw refused(std::string(kPlatforms));
  std::error_code error;
  if (!std::filesystem::is_regular_file(text, error))
    throw Refusal(ExitCode::kBadData,
                  {text, "", "a platform file of SimGrid", "no file that can be read", "Check the path."});
  return {.name = text, .meaning = "as the file says", .file = std::filesystem::absolute(text).string()};
}

std::string host_list(const Platform& platform) {
  std::string list;
  for (std::size_t host = 0; host < platform.hosts; ++host) list += fmt::format("host{}\n", host);
  return list;
}

}  // namespace mote::simulated
