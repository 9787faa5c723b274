#pragma once
/// Racers: mote's filters along a recording, and the contenders.

#include "bench/contenders/contender.hpp"
#include "mote/app/bench/task.hpp"
#include "mote/app/catalogue/scene.hpp"

namespace mote::bench {

/// A model with a recording of its own, shared by those who filter it.
struct Course {
  std::shared_ptr<const CatalogueModel> model;
  Scene scene;

  std::size_t steps() const { return scene.recording.steps.size(); }
};

/// A course of a catalogue model at its defaults: the recording that `mote simulate MODEL --steps T --seed S` writes.
std::shared_ptr<const Course> simulated_course(const std::string& model, Step steps, std::uint64_t seed);

/// A plan for SISR as the tasks have it: systematic resampling at every step.
Plan plan_of(Engine engine, Precision precision, std::size_t threads = 1);

/// A filter of mote; its answer is the mean of every component at every step, (T, D) row by row.
///
/// Making the filter and drawing its prior is not timed, as is its kind with the contenders.
Entrant filter_entrant(const std::string& name, std::shared_ptr<const Course> course, const Plan& plan);

/// A contender on a recording of `ungm`; its answer is the mean at every step, (T,).
Entrant contender_entrant(const contenders::Description& description, std::shared_ptr<const Course> course);

/// Greatest difference of two answers, in the units of the states.
double greatest_between(const std::vector<double>& a, const std::vector<double>& b);

/// Root mean square of the difference.
///
/// shape   a, b: (n,), n >= 1
double rms_between(const std::vector<double>& a, const std::vector<double>& b);

/// The answer of an entrant for a number of particles and a seed.
std::vector<double> answer_of(const Entrant& entrant, std::size_t particles, std::uint64_t seed);

}  // namespace mote::bench
