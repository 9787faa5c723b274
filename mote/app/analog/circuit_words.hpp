#pragma once
/// Circuits as words: "arctan=mite:Ia=10n,gaussian=mite:Ia=0.1n".

#include <optional>
#include <string>

#include "mote/analog/behaviour.hpp"

namespace mote {

/// A circuit that is asked for.
struct CircuitWords {
  analog::Level level = analog::Level::kRealistic;
  double ia_a = 0;
};

/// The circuits of --analog.
struct AnalogWords {
  std::optional<CircuitWords> arctan, gaussian;
};

/// Reads FUNCTION=KIND[:Ia=CURRENT], separated by commas. FUNCTION is arctan or gaussian, KIND mite (transistors) or
/// ideal (the MITE law); a current is a number with p, n or u behind it, or in ampere [MIXED's: 10n for arctan, 0.1n
/// for gaussian].
///
/// error   Refusal (kWrongUse) naming the word
AnalogWords analog_words(const std::string& text, const std::string& where);

/// A behaviour, simulated the first time that the program asks for it.
///
/// error, cost   analog::characterised()
const analog::Behaviour& circuit_behaviour(analog::Function function, const CircuitWords& words);

}  // namespace mote
