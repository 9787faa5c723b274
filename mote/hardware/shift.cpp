#include "mote/hardware/shift.hpp"

namespace mote::hardware {

Circuit Normalise::circuit() const {
  return {"mote_normalise",
          {parameter("Width", width), parameter("EWidth", e_width()), parameter("Even", even)},
          {{"x_i", width, false}, {"n_i", width, false}},
          {{"e_o", e_width(), false}, {"m_o", width, false}, {"n_o", width, false}},
          3,
          false,
          {},
          {},
          Sharing::kAlike};
}

Circuit Scale::circuit() const {
  return {"mote_scale",
          {parameter("MWidth", m.width()), parameter("MFraction", m.fraction), parameter("SWidth", s_width),
           parameter("YWidth", y.width()), parameter("YFraction", y.fraction)},
          {port("m_i", m), {"s_i", s_width, false}},
          {port("y_o", y)},
          3,
          false,
          {},
          {},
          Sharing::kAlike};
}

}  // namespace mote::hardware
