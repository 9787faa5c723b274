#pragma once
/// The makers of the tasks that tasks() lists.

#include "mote/app/bench/task.hpp"

namespace mote::bench {

Task growth_float_task(const TaskEntry& entry, std::size_t threads);
Task growth_double_task(const TaskEntry& entry, std::size_t threads);
Task filters_task(const TaskEntry& entry, std::size_t threads);
Task bearings_task(const TaskEntry& entry, std::size_t threads);
Task doa_task(const TaskEntry& entry, std::size_t threads);
Task resample_task(const TaskEntry& entry, std::size_t threads);
Task threads_task(const TaskEntry& entry, std::size_t threads);
Task ranks_task(const TaskEntry& entry, std::size_t threads);
Task pipeline_task(const TaskEntry& entry, std::size_t threads);
Task computing_pipeline_task(const TaskEntry& entry, std::size_t threads);

}  // namespace mote::bench
