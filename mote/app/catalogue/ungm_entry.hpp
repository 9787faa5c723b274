#pragma once
#include "mote/app/catalogue/entry.hpp"
#include "mote/model/ungm.hpp"

namespace mote {

/// `ungm`: one copy, or two with --set copies=2.
inline CatalogueEntry ungm_entry() {
  CatalogueEntry made{"ungm",
                      "univariate non-stationary growth model, in one or two independent copies",
                      parameters_of<Ungm<1>>(),
                      proposals_of<Ungm<1>>(),
                      {},
                      {},
                      nullptr};
  made.parameters.push_back(
      {"copies", "", "1", "1 or 2", "independent copies: states x, y and observations y1, y2 when 2"});
  made.build = [](const std::string& model_name, const Settings& settings,
                  std::span<const std::string>) -> std::unique_ptr<CatalogueModel> {
    const long copies = settings.integer("copies", 1, 1, 2);
    const UngmParameters parameters = parameters_from<Ungm<1>>(settings);
    settings.finish(model_name, parameter_names_of<Ungm<1>>({"copies"}));
    if (copies == 2) return wrapped(Ungm<2>{parameters});
    return wrapped(Ungm<1>{parameters});
  };
  return shown(std::move(made), Ungm<1>{});
}

}  // namespace mote
