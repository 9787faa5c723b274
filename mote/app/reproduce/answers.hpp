#pragma once
/// What a comparison reads out of a command's JSON.

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "mote/app/reproduce/item.hpp"

namespace mote::reproduce {

/// The value at the comparison's key, a path as "cases/A/time": a number, yes as 1 and no as 0, nothing (null) as NaN.
///
/// error   Refusal (kBadData) naming file:line for a key that leads to no value; `command` is whose JSON it is,
/// `example`
///         a path that is one
double answer_at(const nlohmann::json& json, const Comparison& comparison, const std::string& command,
                 const std::string& example);

}  // namespace mote::reproduce
