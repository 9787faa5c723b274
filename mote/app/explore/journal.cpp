#include "mote/app/explore/journal.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/files/text.hpp"
#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::explore {
namespace {

using Json = nlohmann::json;

const std::string kElsewhere = "Pass another --state, or remove the file.";

/// JSON has no such numbers.
Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? Json(nullptr) : Json("inf");
}

/// A number that is not negative, or nothing.
std::optional<double> value_of(const Json& json) {
  if (json == "inf") return kInfinity;
  if (json.is_number() && json.get<double>() >= 0) return json.get<double>();
  return std::nullopt;
}

std::optional<std::vector<double>> values_of(const Json& json) {
  if (!json.is_array()) return std::nullopt;
  std::vector<double> values;
  for (const Json& one : json) {
    const std::optional<double> value = value_of(one);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::optional<Errors> errors_of(const Json& reference, const Json& truth) {
  const std::optional<double> to_reference = value_of(reference);
  const std::optional<double> to_truth = truth.is_null() ? kNaN : value_of(truth);
  if (!to_reference || !to_truth) return std::nullopt;
  return Errors{*to_reference, *to_truth};
}

/// What a line has by a name; null where it has nothing.
const Json& part_of(const Json& line, const char* name) {
  static const Json nothing;
  const auto found = line.find(name);
  return found == line.end() ? nothing : *found;
}

Refusal cannot_write(const std::string& path, const std::string& why) {
  return {ExitCode::kCannotWrite, {path, "", "a file that can be written", why, "Pass another --state."}};
}

/// Takes away what stands behind so many bytes: a line that was cut short.
void shorten(const std::string& path, std::size_t bytes) {
  std::error_code error;
  std::filesystem::resize_file(path, bytes, error);
  if (error) throw cannot_write(path, error.message());
}

}  // namespace

Journal::Journal(std::string path, const RunFacts& facts) : path_(std::move(path)) {
  if (path_.empty()) return;
  std::error_code error;
  const bool there = std::filesystem::exists(path_, error) && read(facts);
  file_ = std::fopen(path_.c_str(), "ae");
  if (file_ == nullptr) throw cannot_write(path_, std::strerror(errno));
  if (!there) append({{"exploration", facts}});
}

Journal::~Journal() {
  if (file_ != nullptr) std::fclose(file_);
}

bool Journal::read(const RunFacts& facts) {
  const std::string text = read_text(path_);
  const std::size_t whole = text.find_last_of('\n') + 1;  // npos + 1 = 0
  std::size_t number = 0;
  for (std::size_t at = 0; at < whole;) {
    const std::size_t end = text.find('\n', at);
    const std::string_view line = std::string_view(text).substr(at, end - at);
    if (++number > 1) {
      take(line, number);
    } else {
      check_facts(Json::parse(line, nullptr, false), facts);
    }
    at = end + 1;
  }
  if (whole < text.size()) shorten(path_, whole);
  return number > 0;
}

void Journal::refuse_line(std::size_t line, const std::string& expected, const std::string& got) const {
  throw Refusal(ExitCode::kBadData, {fmt::format("{}:{}", path_, line), "", expected, got, kElsewhere});
}

void Journal::check_facts(const Json& kept, const RunFacts& facts) const {
  if (!kept.is_object() || !kept.contains("exploration"))
    refuse_line(1, "what mote design explore keeps", "a file of another kind");
  RunFacts theirs;
  try {
    kept.at("exploration").get_to(theirs);
  } catch (const Json::exception&) {
    refuse_line(1, "the facts of an exploration", "those of another mote, or damaged ones");
  }
  if (const auto differs = difference(facts, theirs))
    throw Refusal(ExitCode::kWrongUse, {path_, "", "the findings of this exploration, with " + differs->first,
                                        "those of one with " + differs->second, kElsewhere});
}

void Journal::take(std::string_view text, std::size_t number) {
  const Json line = Json::parse(text, nullptr, false);
  const Json& name = part_of(line, "found");
  const Json& candidate = part_of(line, "candidate");
  const Json& run = part_of(line, "run");
  if (name.is_string()) {
    if (auto values = values_of(part_of(line, "values"))) {
      found_.try_emplace(name.get<std::string>(), Found{std::move(*values), number});
      return;
    }
  } else if (candidate.is_number_unsigned() && run.is_number_unsigned()) {
    if (const auto errors = errors_of(part_of(line, "reference"), part_of(line, "truth"))) {
      errors_.try_emplace({candidate.get<std::size_t>(), run.get<std::size_t>()}, *errors);
      return;
    }
  }
  refuse_line(number, "a finding of mote design explore", in_quotes(text));
}

void Journal::append(const Json& line) {
  if (file_ == nullptr) return;
  const std::string text = line.dump() + "\n";
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0)
    throw cannot_write(path_, std::strerror(errno));
}

std::vector<double> Journal::recall(const std::string& name, std::size_t values,
                                    const std::function<std::vector<double>()>& find) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !sought_.contains(name); });
  if (const auto known = found_.find(name); known != found_.end()) {
    const Found& found = known->second;
    if (found.values.size() != values)
      refuse_line(found.line, fmt::format("{} values of {}", values, in_quotes(name)),
                  std::to_string(found.values.size()));
    return found.values;
  }
  sought_.insert(name);
  const auto done = [&] {
    sought_.erase(name);
    changed_.notify_all();
  };
  lock.unlock();
  std::vector<double> fresh;
  try {
    fresh = find();
  } catch (...) {
    lock.lock();
    done();
    throw;
  }
  lock.lock();
  done();
  found_[name] = {fresh, 0};
  Json list = Json::array();
  for (const double value : fresh) list.push_back(number(value));
  append({{"found", name}, {"values", list}});
  return fresh;
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
