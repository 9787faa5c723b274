#pragma once
#include "mote/app/catalogue/entry.hpp"
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
  made.make = [](const Settings& settings, std::span<const std::string> header) {
    Doa model{parameters_from<Doa>(settings)};
    settings.finish("doa", names_of(parameters_of<Doa>()));
    std::size_t frame = 0;
    for (const std::string& column : header) frame += column.starts_with("doa") ? 1 : 0;
    model.frame = frame > 0 ? frame : 1;
    return wrapped(std::move(model));
  };
  return shown(std::move(made), Doa{});
}

}  // namespace mote
