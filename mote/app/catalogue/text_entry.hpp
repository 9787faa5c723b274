#pragma once
/// Models given as text: catalogue entries made of files.

#include <string>

#include "mote/app/catalogue/catalogue.hpp"

namespace mote {

/// Whether a model's name is that of a file.
inline bool is_text_model(const std::string& name) { return name.ends_with(".toml"); }

/// The entry of the model that a file describes, with its own parameters.
///
/// error   Refusal (kBadData) when the file cannot be read or is no model
CatalogueEntry text_entry(const std::string& path);

}  // namespace mote
