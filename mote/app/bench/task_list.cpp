#include "mote/app/bench/task_list.hpp"

namespace mote::bench {

const std::vector<TaskEntry>& tasks() {
  static const std::vector<TaskEntry> all{
      {"ungm-float", "growth model, bootstrap filter, 100 steps, float; one thread", growth_float_task},
      {"ungm-double", "growth model, bootstrap filter, 100 steps, double; one thread", growth_double_task},
      {"filters", "growth model, filters side by side, 100 steps, float; one thread", filters_task},
      {"bearings", "bearings-only tracking, 4 states, bootstrap filter, 30 steps; one thread", bearings_task},
      {"doa", "direction of arrival, 3 states, bootstrap filter, 30 steps; one thread", doa_task},
      {"resample", "ancestors from weights, and their states copied; one thread", resample_task},
      {"threads", "growth model in float on several threads, 100 steps; wall-clock", threads_task},
      {"ranks", "growth model in double on several ranks, threads and processes apart, 100 steps; wall-clock",
       ranks_task},
      {"pipeline", "settings of the pipeline, stages of a stated cost; in the stages, wall-clock", pipeline_task},
      {"pipeline-2", "bearings, guided proposals: stages that compute, two threads; in the stages, wall-clock",
       computing_pipeline_task}};
  return all;
}

}  // namespace mote::bench
