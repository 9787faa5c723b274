#include "mote/app/explore/journal.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "mote/app/files/text.hpp"
#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::explore {
namespace {

using Json = nlohmann::json;

/// JSON has no such numbers.
Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? Json(nullptr) : Json("inf");
}

double value_of(const Json& json) {
  if (json.is_number()) return json.get<double>();
  return json.is_null() ? kNaN : kInfinity;
}

Refusal cannot_write(const std::string& path) {
  return {ExitCode::kCannotWrite,
          {path, "", "a file that can be written", std::strerror(errno), "Pass another --state."}};
}

}  // namespace

Journal::Journal(std::string path, const Json& belongs) : path_(std::move(path)) {
  if (path_.empty()) return;
  std::error_code error;
  const bool there = std::filesystem::exists(path_, error) && read(belongs);
  file_ = std::fopen(path_.c_str(), "ae");
  if (file_ == nullptr) throw cannot_write(path_);
  if (!there) append(belongs);
}

Journal::~Journal() {
  if (file_ != nullptr) std::fclose(file_);
}

bool Journal::read(const Json& belongs) {
  const std::string text = read_text(path_);
  const std::size_t whole = text.find_last_of('\n') + 1;  // npos + 1 = 0
  std::size_t number = 0;
  for (std::size_t at = 0; at < whole;) {
    const std::size_t end = text.find('\n', at);
    const Json line = Json::parse(text.begin() + static_cast<std::ptrdiff_t>(at),
                                  text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    ++number;
    if (!line.is_object() || (number == 1) != line.contains("exploration"))
      throw Refusal(ExitCode::kBadData,
                    {path_ + ":" + std::to_string(number), "", "a line of what mote design explore keeps",
                     in_quotes(text.substr(at, end - at)), "Pass another --state, or remove the file."});
    if (number == 1 && line != belongs)
      throw Refusal(ExitCode::kWrongUse, {path_, "", "the findings of this exploration",
                                          "those of another model, target, candidates or data",
                                          "Pass another --state, or remove the file."});
    if (number > 1) take(line);
    at = end + 1;
  }
  if (whole < text.size()) std::filesystem::resize_file(path_, whole);
  return number > 0;
}

void Journal::take(const Json& line) {
  if (line.contains("found")) {
    auto& values = found_[line.at("found").get<std::string>()];
    for (const Json& value : line.at("values")) values.push_back(value_of(value));
    return;
  }
  errors_[{line.at("candidate").get<std::size_t>(), line.at("run").get<std::size_t>()}] = {
      value_of(line.at("reference")), value_of(line.at("truth"))};
}

void Journal::append(const Json& line) {
  if (file_ == nullptr) return;
  const std::string text = line.dump() + "\n";
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0)
    throw cannot_write(path_);
}

std::vector<double> Journal::recall(const std::string& name, const std::function<std::vector<double>()>& find) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = found_.find(name); known != found_.end()) return known->second;
  }
  const std::vector<double> values = find();
  const std::lock_guard lock(mutex_);
  const auto [at, fresh] = found_.emplace(name, values);
  if (fresh) {
    Json list = Json::array();
    for (const double value : values) list.push_back(number(value));
    append({{"found", name}, {"values", list}});
  }
  return at->second;
}

std::optional<Errors> Journal::errors(std::size_t candidate, std::size_t run) const {
  const std::lock_guard lock(mutex_);
  const auto known = errors_.find({candidate, run});
  return known == errors_.end() ? std::nullopt : std::optional(known->second);
}

void Journal::keep(std::size_t candidate, std::size_t run, const Errors& errors) {
  const std::lock_guard lock(mutex_);
  if (!errors_.emplace(std::pair(candidate, run), errors).second) return;
  append({{"candidate", candidate},
          {"run", run},
          {"reference", number(errors.reference)},
          {"truth", number(errors.truth)}});
}

}  // namespace mote::explore
