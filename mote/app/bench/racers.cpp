#include "mote/app/bench/racers.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mote::bench {
namespace {

class FilterRacer final : public Racer {
 public:
  FilterRacer(std::shared_ptr<const Course> course, const Plan& plan)
      : course_(std::move(course)), plan_(plan), states_(course_->model->states()) {}

  void prepare(std::size_t particles, std::uint64_t seed) override {
    plan_.particles = particles;
    plan_.seed = seed;
    filter_.reset();  // before the next takes its memory
    filter_ = course_->model->filter(plan_, "mote bench");
  }

  void run(std::vector<double>& answer) override {
    answer.clear();
    Step t = 0;
    for (const ObservedStep& step : course_->scene.recording.steps) {
      StepReport report = filter_->update(++t, step.rows);
      for (std::size_t d = 0; d < states_.size(); ++d) answer.push_back(filter_->moments(d, states_[d].angle).mean);
      filter_->select(t, report);
    }
  }

 private:
  std::shared_ptr<const Course> course_;
  Plan plan_;
  std::vector<Quantity> states_;
  std::unique_ptr<Filter> filter_;
};

class ContenderRacer final : public Racer {
 public:
  ContenderRacer(const contenders::Description& description, const Recording& recording)
      : contender_(description.make()) {
    for (const ObservedStep& step : recording.steps) observations_.push_back(step.rows.front().values.front());
  }

  void prepare(std::size_t particles, std::uint64_t seed) override { contender_->prepare(particles, seed); }
  void run(std::vector<double>& answer) override {
    answer.resize(observations_.size());
    contender_->run(observations_, answer);
  }
  double outside_seconds() const override { return contender_->outside_seconds(); }
  double outside_bytes() const override { return contender_->outside_bytes(); }

 private:
  std::unique_ptr<contenders::Contender> contender_;
  std::vector<double> observations_;
};

/// Bytes that a particle-step moves at least, by the passes over arrays of N numbers of `number` bytes.
///
///   simd        weights and D components of the parents are read, those of the children written: (2 D + 2) number.
///               Chains: parents read, proposals written and read, the kept written, 4 D; log weights and log uniform
///               numbers written and read, 4. Points: D components read twice and written; weights read and written,
///               their units likewise, 4 number; 80 bytes of the sort, its sums and the parents
///   reference   D (propose 2, weigh 1, moments 2, gather 4) numbers; D (weights for moments 16, ancestors 4) bytes;
///               log weights and weights 96, ancestors 4 bytes
double bytes_moved(const Plan& plan, double dimensions, double number) {
  if (engine_of(plan) != Engine::kSimd) return dimensions * (9 * number + 20) + 100;
  if (plan.filter == FilterKind::kSisr) return (2 * dimensions + 2) * number;
  if (plan.filter == FilterKind::kSqmc) return (3 * dimensions + 4) * number + 80;
  return (4 * dimensions + 4) * number;
}

}  // namespace

std::shared_ptr<const Course> simulated_course(const std::string& model, Step steps, std::uint64_t seed) {
  const std::string where = "mote bench";
  auto course = std::make_shared<Course>();
  course->model = find_model(model, where).make(Settings(where, {}), frame_header(1));
  course->scene = simulated_scene(*course->model, steps, seed);
  return course;
}

Plan plan_of(Engine engine, Precision precision, std::size_t threads) {
  Plan plan;
  plan.engine = engine;
  plan.precision = precision;
  plan.threads = threads;
  return plan;
}

Entrant filter_entrant(const std::string& name, std::shared_ptr<const Course> course, const Plan& plan) {
  const bool is_float = plan.precision == Precision::kFloat;
  const auto dimensions = static_cast<double>(course->model->states().size());
  const std::string meaning = fmt::format("mote's {} engine, {}, {} thread{}{}", name_of(engine_of(plan)),
                                          is_float ? "float" : "double", plan.threads, plan.threads == 1 ? "" : "s",
                                          plan.estimates == Estimates::kMeans ? ", no standard deviations" : "");
  return {name, meaning, bytes_moved(plan, dimensions, is_float ? 4 : 8), "",
          [course = std::move(course), plan] { return std::make_unique<FilterRacer>(course, plan); }};
}

Entrant contender_entrant(const contenders::Description& description, std::shared_ptr<const Course> course) {
  return {std::string(description.name), std::string(description.meaning), description.bytes_per_particle_step,
          description.why_not(), [&description, course = std::move(course)] {
            return std::make_unique<ContenderRacer>(description, course->scene.recording);
          }};
}

double greatest_between(const std::vector<double>& a, const std::vector<double>& b) {
  double greatest = a.size() == b.size() ? 0 : kInfinity;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double apart = std::abs(a[i] - b[i]);
    greatest = apart <= greatest ? greatest : apart;  // NaN counts
  }
  return greatest;
}

double rms_between(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<double> answer_of(const Entrant& entrant, std::size_t particles, std::uint64_t seed) {
  const auto racer = entrant.make();
  std::vector<double> answer;
  racer->prepare(particles, seed);
  racer->run(answer);
  return answer;
}

}  // namespace mote::bench
