#include "mote/app/catalogue/text_entry.hpp"

#include <fmt/format.h>

#include "mote/app/catalogue/entry.hpp"
#include "mote/app/files/text.hpp"
#include "mote/graph/text/text_model.hpp"

namespace mote {
namespace {

std::vector<double> parameters_of(const graph::TextFile& file, const Settings& settings) {
  std::vector<double> values;
  for (const graph::NamedNumber& p : file.parameters) values.push_back(settings.number(p.name, p.value));
  return values;
}

}  // namespace

CatalogueEntry text_entry(const std::string& path) {
  const std::string text = read_text(path);
  refuse_other_than_ascii(path, text);
  const graph::TextFile file = graph::parse_text_file(path, text);
  CatalogueEntry made{file.name, file.meaning, {}, proposals_of<graph::TextModel>(), {}, {}, nullptr};
  std::vector<std::string> names;
  std::vector<double> defaults;
  for (const graph::NamedNumber& p : file.parameters) {
    made.parameters.push_back({p.name, "", fmt::format("{:.12g}", p.value), words_for(Range::kAny), "see " + path});
    names.push_back(p.name);
    defaults.push_back(p.value);
  }
  made.build = [file, names](const std::string&, const Settings& settings, std::span<const std::string>) {
    const std::vector<double> values = parameters_of(file, settings);
    settings.finish(file.path, names);
    return wrapped(graph::TextModel(file, values));
  };
  return shown(std::move(made), graph::TextModel(file, defaults));
}

}  // namespace mote
