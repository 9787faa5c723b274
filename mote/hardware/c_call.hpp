#pragma once
/// Operators in C: a circuit's twin called with the circuit's own parameters (machine/golden/operators.h).

#include <string>
#include <vector>

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// Lines that declare the outputs and call the function of a circuit's module:
///
///   library    mote_add(&(mote_add_parameters){.AWidth = 12, ...}, a, b, &y);
///   generated  NAME(tables + table, a, b, &y);
///
/// shape   table: the place of its first memory among the caller's tables; in, out: a name a port
std::string c_call(const Circuit& circuit, std::size_t table, const std::vector<std::string>& in,
                   const std::vector<std::string>& out);

/// A parameter's SystemVerilog literal in C:  64'd5 -> UINT64_C(5),  {8'd2, 8'd1} -> the array 1, 2.
std::string c_literal(const std::string& value);

}  // namespace mote::hardware
