#include "mote/app/files/matrices.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

using Json = nlohmann::json;

const std::string kKeys = "A linear-gaussian file has F, Q, H, R, mean and covariance.";

/// The JSON library's message without its "[json.exception...] ".
std::string without_tag(const std::string& message) {
  const std::size_t end = message.find("] ");
  return message.starts_with('[') && end != std::string::npos ? message.substr(end + 2) : message;
}

/// A name that can be part of a CSV header and of --estimate: letters, digits and _, a letter first.
bool is_name(const std::string& name) {
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0 &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '_'); });
}

Json from_toml(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    Json object = Json::object();
    for (const auto& [key, value] : *table) object[std::string(key.str())] = from_toml(value);
    return object;
  }
  if (const auto* array = node.as_array()) {
    Json list = Json::array();
    for (const auto& value : *array) list.push_back(from_toml(value));
    return list;
  }
  if (const auto number = node.value<double>()) return *number;
  if (const auto text = node.value<std::string>()) return *text;
  return nullptr;
}

Json parsed(const std::string& path, const std::string& text) {
  if (path.ends_with(".json")) {
    try {
      return Json::parse(text);
    } catch (const Json::exception& error) {
      throw Refusal(ExitCode::kBadData, {path, "", "JSON with finite numbers", without_tag(error.what()), kKeys});
    }
  }
  refuse_other_than_ascii(path, text);
  try {
    const toml::table table = toml::parse(text, path);
    return from_toml(table);
  } catch (const toml::parse_error& error) {
    throw Refusal(ExitCode::kBadData, {fmt::format("{}:{}", path, error.source().begin.line), "", "TOML",
                                       std::string(error.description()), kKeys});
  }
}

/// Reads keys of one file, refusing by the file's name.
class Reader {
 public:
  Reader(std::string path, Json root) : path_(std::move(path)), root_(std::move(root)) {}

  const Json& at(const std::string& key, const std::string& other = "") const {
    if (root_.contains(key)) return root_[key];
    if (!other.empty() && root_.contains(other)) return root_[other];
    throw Refusal(ExitCode::kBadData, {path_, "\"" + key + "\"", "a key of that name", "none", kKeys});
  }
  Eigen::MatrixXd matrix(const Json& value, const std::string& key) const {
    if (value.is_number()) return Eigen::MatrixXd::Constant(1, 1, value.get<double>());
    if (!value.is_array() || value.empty() || !value[0].is_array() || value[0].empty())
      refuse(key, "a list of rows of numbers");
    Eigen::MatrixXd out(static_cast<Eigen::Index>(value.size()), static_cast<Eigen::Index>(value[0].size()));
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!value[i].is_array() || value[i].size() != value[0].size()) refuse(key, "rows of equal length");
      for (std::size_t j = 0; j < value[i].size(); ++j) {
        if (!value[i][j].is_number()) refuse(key, "numbers");
        out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = value[i][j].get<double>();
      }
    }
    return out;
  }
  Eigen::VectorXd vector(const Json& value, const std::string& key) const {
    if (value.is_number()) return Eigen::VectorXd::Constant(1, value.get<double>());
    if (!value.is_array() || value.empty()) refuse(key, "a list of numbers");
    Eigen::VectorXd out(static_cast<Eigen::Index>(value.size()));
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!value[i].is_number()) refuse(key, "numbers");
      out(static_cast<Eigen::Index>(i)) = value[i].get<double>();
    }
    return out;
  }
  std::vector<std::string> names(const std::string& key) const {
    std::vector<std::string> out;
    if (!root_.contains(key)) return out;
    if (!root_[key].is_array()) refuse(key, "a list of names");
    for (const Json& value : root_[key]) {
      const std::string name = value.is_string() ? value.get<std::string>() : "";
      if (!is_name(name) || name == "t" || std::find(out.begin(), out.end(), name) != out.end())
        throw Refusal(
            ExitCode::kBadData,
            {path_, "\"" + key + "\"", "different names of letters, digits and _ with a letter first, none of them t",
             value.dump(), R"(Names are written ["x", "v"].)"});
      out.push_back(name);
    }
    return out;
  }

 private:
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const {
    throw Refusal(ExitCode::kBadData,
                  {path_, "\"" + key + "\"", expected, "something else", "A matrix is written [[1, 0], [0, 1]]."});
  }

  std::string path_;
  Json root_;
};

}  // namespace

LinearGaussianParameters read_linear_gaussian(const std::string& path) {
  return parse_linear_gaussian(path, read_text(path));
}

LinearGaussianParameters parse_linear_gaussian(const std::string& path, const std::string& text) {
  const Reader reader(path, parsed(path, text));
  LinearGaussianParameters p;
  p.F = reader.matrix(reader.at("F"), "F");
  p.Q = reader.matrix(reader.at("Q"), "Q");
  p.H = reader.matrix(reader.at("H"), "H");
  p.R = reader.matrix(reader.at("R"), "R");
  p.mean = reader.vector(reader.at("mean", "m0"), "mean");
  p.covariance = reader.matrix(reader.at("covariance", "P0"), "covariance");
  p.state_names = reader.names("states");
  p.observation_names = reader.names("observations");
  return p;
}

}  // namespace mote
