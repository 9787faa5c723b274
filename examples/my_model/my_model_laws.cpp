// What every engine relies on, checked for this model by one line: the same bits in every number type, a constant
// number of draws, densities that match the draws, silence of missing fields.

#include "my_model.hpp"
#include <mote/model/laws.hpp>

MOTE_MODEL_LAWS(Pendulum, Pendulum{})
