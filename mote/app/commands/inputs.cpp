#include "mote/app/commands/inputs.hpp"

#include <string_view>

#include "mote/app/catalogue/text_entry.hpp"
#include "mote/app/files/text.hpp"

namespace mote {

void protect_inputs(OutputSet& outputs, const Arguments& arguments, const std::vector<std::string>& options) {
  constexpr std::string_view kFile = "file=";
  for (const std::string& option : options) outputs.protect(arguments.text(option));
  const std::string models = arguments.text("MODEL");
  for (const std::string_view model : parts_of(models, ','))
    if (is_text_model(std::string(model))) outputs.protect(std::string(model));
  for (const std::string& setting : arguments.list("--set"))
    if (setting.starts_with(kFile)) outputs.protect(setting.substr(kFile.size()));
}

}  // namespace mote
