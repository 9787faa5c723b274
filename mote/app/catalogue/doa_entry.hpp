#pragma once
#include <algorithm>

#include "mote/app/catalogue/entry.hpp"
#include "mote/app/files/text.hpp"
#include "mote/model/doa.hpp"

namespace mote {

/// `doa`: its frame is as long as the data has columns doa1, doa2, ...
inline CatalogueEntry doa_entry() {
  CatalogueEntry made{"doa",
                      "direction of arrival of one source from frames of noisy directions",
                      parameters_of<Doa>(),
                      proposals_of<Doa>(),
                      {},
                      {},
                      nullptr};
  made.build = [](const std::string& model_name, const Settings& settings, std::span<const std::string> header) {
    Doa model{parameters_from<Doa>(settings)};
    settings.finish(model_name, parameter_names_of<Doa>());
    const auto frame = std::count_if(header.begin(), header.end(), [](const std::string& column) {
      return column.starts_with("doa") && integer_in(std::string_view(column).substr(3));
    });
    model.frame = frame > 0 ? static_cast<std::size_t>(frame) : 1;
    return wrapped(std::move(model));
  };
  return shown(std::move(made), Doa{});
}

}  // namespace mote
