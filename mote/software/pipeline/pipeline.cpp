#include "mote/software/pipeline/pipeline.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include <immintrin.h>
#include <sys/prctl.h>

#include "mote/software/pipeline/ring.hpp"
#include "mote/software/threads.hpp"

namespace mote {
namespace {

constexpr std::size_t kApart = 128;  // bytes: two lines, because processors fetch them in pairs
constexpr std::chrono::microseconds kAwake{100};
constexpr std::size_t kStepsShown = 3;      // by the timeline
constexpr std::size_t kSpansShown = 3'000;  // likewise, at most

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration time) { return std::chrono::duration<double>(time).count(); }

enum StageNumber : std::size_t { kPropose, kWeigh, kChain, kStages };

/// A block: particles that pass together.
struct Block {
  std::size_t line;
  Stretch stretch;
};

/// Sleeps until then, to the microsecond rather than to the 50 us that the system allows itself.
void wait_until(Clock::time_point time) {
  thread_local const bool punctual = prctl(PR_SET_TIMERSLACK, 1) == 0;
  static_cast<void>(punctual);
  std::this_thread::sleep_until(time);
}

/// What a worker of a stage has done; its seat's alone while it works.
struct alignas(kApart) Account {
  Clock::duration busy{0};
  Clock::duration overslept{0};
  std::uint64_t blocks = 0, queued = 0, most_queued = 0;
  std::vector<StageSpan> spans;
};

/// Waits until a worker that has begun then has taken so many seconds. What the system lets it sleep too long is taken
/// off its next wait.
void keep_pace(Account& account, Clock::time_point begin, double seconds_in_all) {
  const auto due = begin + std::chrono::nanoseconds(std::llround(1e9 * seconds_in_all)) - account.overslept;
  wait_until(due);
  account.overslept = std::max(Clock::duration{0}, Clock::now() - due);
}

/// A stage: seats for its workers.
struct Bench {
  Seats seats;
  std::vector<Account> accounts;
  double pace;

  Bench(std::size_t workers, double seconds_a_particle) : seats(workers), accounts(workers), pace(seconds_a_particle) {}
};

}  // namespace

std::size_t block_for(std::size_t count, std::size_t workers) {
  const std::size_t wanted = count / (16 * workers);
  return std::clamp<std::size_t>(std::bit_floor(wanted), 16, kBlock);
}

/// The threads, the queues between them, and the blocks of the step at hand.
///
/// Whoever touches a block has taken it: dealt to him, from the queue of the proposed, or in a line's seat. So nobody
/// who comes late from one step sees the blocks of the next half laid out.
class Pipeline::Floor {
 public:
  explicit Floor(const PipelineSize& size)
      : size_(size),
        most_under_way_(4 * (size.proposers + size.weighers + size.chains)),
        awake_(size.threads <= cores()),
        settled_(size.threads >= size.proposers + size.weighers + size.chains),
        benches_{Bench(size.proposers, size.pace.propose), Bench(size.weighers, size.pace.weigh),
                 Bench(size.chains, size.pace.chain)},
        proposed_(most_under_way_),
        queues_(size.chains) {
    for (std::size_t k = 1; k < size.threads; ++k) {
      try {
        threads_.emplace_back([this] { work_while([this] { return !closed_.load(std::memory_order_acquire); }); });
      } catch (const std::exception&) {
        break;  // where the system grants fewer threads, there are fewer
      }
    }
  }
  Floor(const Floor&) = delete;
  Floor& operator=(const Floor&) = delete;
  ~Floor() {
    closed_.store(true, std::memory_order_release);
    tell_all();
  }

  const PipelineSize& size() const { return size_; }

  void run(const Stages& stages) {
    pass_begin_ = now();
    lay_out(stages);
    const std::size_t all = blocks_.size();
    dealt_.store(++pass_ << kHalf | all, std::memory_order_release);
    tell_all();
    work_while([&] { return retired_.load(std::memory_order_acquire) < all; });
    pass_end_ = now();
    in_stages_ += pass_end_ - pass_begin_;
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

  void begin_step(Step t) {
    // the first step finds cold caches and sleeping threads: it makes room for a later one
    if (steps_.size() == kStepsShown && steps_.front() == first_step_ && spans() < kSpansShown) drop_first();
    shows_ = steps_.size() < kStepsShown && spans() < kSpansShown;
    if (!shows_) return;
    if (steps_.empty()) first_step_ = t;
    steps_.push_back(t);
    step_begins_.push_back(now());
  }

  /// One thread has worked from `begin` on, but for `in_stages` seconds in which it has run the stages.
  void alone(double begin, double in_stages) {
    const double end = now();
    alone_ += end - begin - in_stages;
    if (!shows_) return;
    if (pass_end_ <= begin) return alone_spans_.push_back({kStages, 0, begin, end});
    alone_spans_.push_back({kStages, 0, begin, pass_begin_});
    alone_spans_.push_back({kStages, 0, pass_end_, end});
  }

  double now() const { return seconds(Clock::now() - start_); }
  double in_stages() const { return in_stages_; }

  StageRecord record() const {
    StageRecord record{threads_.size() + 1, in_stages_, alone_, {}, steps_, {}};
    for (std::size_t s = 0; s < kStages; ++s) {
      StageUse use{kNames[s], {}, 0, 0};
      std::uint64_t queued = 0;
      std::uint64_t blocks = 0;
      for (const Account& a : benches_[s].accounts) {
        use.workers.push_back({seconds(a.busy), a.blocks});
        use.largest_queue = std::max<std::size_t>(use.largest_queue, a.most_queued);
        queued += a.queued;
        blocks += a.blocks;
        record.timeline.insert(record.timeline.end(), a.spans.begin(), a.spans.end());
      }
      if (blocks == 0) use.workers.clear();  // nothing takes in SISR
      use.mean_queue = blocks == 0 ? 0 : static_cast<double>(queued) / static_cast<double>(blocks);
      record.stages.push_back(std::move(use));
    }
    record.timeline.insert(record.timeline.end(), alone_spans_.begin(), alone_spans_.end());
    for (StageSpan& span : record.timeline) {
      span.begin -= step_begins_.front();
      span.end -= step_begins_.front();
    }
    return record;
  }

 private:
  static constexpr std::array<const char*, kStages> kNames{"propose", "weigh", "chain"};
  static constexpr unsigned kHalf = 32;  // bits of dealt_ for the blocks that are left; above, the pass

  /// Blocks that a line takes, in its order.
  struct Queue {
    std::vector<std::uint32_t> blocks;
    std::size_t next = 0;
  };

  // ---- the blocks of a step

  void lay_out(const Stages& stages) {
    for (std::size_t k = 0; k < size_.chains; ++k)
      while (!benches_[kChain].seats.take(k)) std::this_thread::yield();
    stages_ = &stages;
    const std::size_t broadest = std::max(size_.proposers, size_.weighers);
    cut(stages, size_.block != 0 ? size_.block : block_for(stages.all.size(), broadest));
    if (flags_ < blocks_.size()) weighed_ = std::make_unique<std::atomic<bool>[]>(flags_ = blocks_.size());
    for (std::size_t i = 0; i < blocks_.size(); ++i) weighed_[i].store(false, std::memory_order_relaxed);
    retired_.store(0, std::memory_order_relaxed);
    waiting_.store(0, std::memory_order_relaxed);
    failed_.store(false, std::memory_order_relaxed);
    for (std::size_t k = 0; k < size_.chains; ++k) benches_[kChain].seats.leave(k);
  }

  /// A block of each line in turn, so that all have something to take early.
  void cut(const Stages& stages, std::size_t length) {
    std::vector<std::vector<Stretch>> lines(stages.lines.size());
    for (std::size_t k = 0; k < lines.size(); ++k)
      for (const Stretch& stretch : stages.lines[k])
        for (std::size_t first = stretch.first; first < stretch.last; first = lines[k].back().last)
          lines[k].push_back({first, std::min(stretch.last, (first / length + 1) * length)});
    blocks_.clear();
    for (Queue& queue : queues_) queue = {};
    for (std::size_t k = 0, before = 1; before != blocks_.size(); ++k) {
      before = blocks_.size();
      for (std::size_t line = 0; line < lines.size(); ++line) {
        if (k >= lines[line].size()) continue;
        if (stages.take) queues_[line].blocks.push_back(static_cast<std::uint32_t>(blocks_.size()));
        blocks_.push_back({line, lines[line][k]});
      }
    }
  }

  // ---- who does what next

  /// Something has changed that somebody may wait for. One is woken, because what has been done enables two works at
  /// most, and who did it takes up one of them.
  void tell() {
    news_.fetch_add(1);
    news_.notify_one();
  }
  void tell_all() {
    news_.fetch_add(1);
    news_.notify_all();
  }

  template <class Condition>
  void work_while(const Condition& goes_on) {
    auto idle_since = Clock::now();
    StageNumber last = kChain;
    for (;;) {
      const std::uint32_t seen = news_.load();
      if (!goes_on()) return;
      if (take_up(last)) {
        idle_since = Clock::now();
      } else if (awake_ && Clock::now() - idle_since < kAwake) {
        for (int k = 0; k < 32 && news_.load(std::memory_order_relaxed) == seen; ++k) _mm_pause();
        std::this_thread::yield();
      } else {
        news_.wait(seen);
      }
    }
  }

  /// Works on something, if there is something. Where every worker can have a thread, that keeps to its stage, so that
  /// no stage waits for a thread to wake; else what is furthest down the line comes first.
  bool take_up(StageNumber& last) {
    if (settled_ && work_at(last)) return true;
    for (const StageNumber stage : {kChain, kWeigh, kPropose})
      if (work_at(stage)) {
        last = stage;
        return true;
      }
    return false;
  }
  bool work_at(StageNumber stage) { return stage == kChain ? take() : stage == kWeigh ? weigh() : propose(); }

  bool propose() {
    Bench& bench = benches_[kPropose];
    const auto seat = bench.seats.take();
    if (!seat) return false;
    const auto number = deal();
    if (number) {
      const Block& block = blocks_[*number];
      labour(kPropose, *seat, block, 0, [&] { stages_->propose(*seat, block.line, block.stretch); });
    }
    bench.seats.leave(*seat);
    if (!number) return false;
    if (stages_->weigh)
      proposed_.push(*number);
    else
      pass_on(*number);
    tell();
    return true;
  }

  bool weigh() {
    Bench& bench = benches_[kWeigh];
    const auto seat = bench.seats.take();
    if (!seat) return false;
    const std::size_t queued = proposed_.size();
    const auto number = proposed_.pop();
    if (number) {
      const Block& block = blocks_[*number];
      labour(kWeigh, *seat, block, std::max<std::size_t>(queued, 1), [&] { stages_->weigh(block.stretch); });
    }
    bench.seats.leave(*seat);
    if (!number) return false;
    pass_on(*number);
    tell();
    return true;
  }

  /// To the chains, or out.
  void pass_on(std::uint32_t number) {
    if (!stages_->take) return retire();
    waiting_.fetch_add(1, std::memory_order_relaxed);
    weighed_[number].store(true, std::memory_order_release);
  }

  bool take() {
    bool any = false;
    for (std::size_t line = 0; line < size_.chains; ++line) {
      if (waiting_.load(std::memory_order_relaxed) == 0) break;
      if (!benches_[kChain].seats.take(line)) continue;
      const bool taken = take_for(line);
      benches_[kChain].seats.leave(line);
      if (taken) tell();  // to whoever found the seat taken, and weighed what comes next
      any = any || taken;
    }
    return any;
  }
  bool take_for(std::size_t line) {
    Queue& queue = queues_[line];
    bool any = false;
    for (; queue.next < queue.blocks.size(); ++queue.next) {
      const std::uint32_t number = queue.blocks[queue.next];
      if (!weighed_[number].load(std::memory_order_acquire)) break;
      const std::size_t queued = waiting_.fetch_sub(1, std::memory_order_relaxed);
      const Block& block = blocks_[number];
      labour(kChain, line, block, queued, [&] { stages_->take(block.stretch); });
      retire();
      any = true;
    }
    return any;
  }

  void retire() {
    const std::size_t all = blocks_.size();
    under_way_.fetch_sub(1, std::memory_order_release);
    if (retired_.fetch_add(1, std::memory_order_acq_rel) + 1 == all)
      tell_all();  // the caller among them
    else
      tell();
  }

  /// The next block to propose, if there is one and not too many are under way.
  std::optional<std::uint32_t> deal() {
    if (under_way_.fetch_add(1, std::memory_order_acquire) < most_under_way_) {
      std::uint64_t dealt = dealt_.load(std::memory_order_acquire);
      while (const std::uint64_t left = dealt & ((std::uint64_t{1} << kHalf) - 1))
        if (dealt_.compare_exchange_weak(dealt, dealt - 1, std::memory_order_acq_rel, std::memory_order_acquire))
          return static_cast<std::uint32_t>(blocks_.size() - left);
    }
    under_way_.fetch_sub(1, std::memory_order_release);
    return std::nullopt;
  }

  /// Does a block's work in a seat and enters it into the seat's account.
  template <class Work>
  void labour(StageNumber stage, std::size_t seat, const Block& block, std::size_t queued, const Work& work) {
    Account& account = benches_[stage].accounts[seat];
    const auto begin = Clock::now();
    if (!failed_.load(std::memory_order_relaxed)) attempt(work);
    if (benches_[stage].pace > 0)
      keep_pace(account, begin, benches_[stage].pace * static_cast<double>(block.stretch.size()));
    const auto end = Clock::now();
    account.busy += end - begin;
    ++account.blocks;
    account.queued += queued;
    account.most_queued = std::max<std::uint64_t>(account.most_queued, queued);
    if (shows_ && account.spans.size() < kSpansShown)
      account.spans.push_back({stage, seat, seconds(begin - start_), seconds(end - start_)});
  }
  template <class Work>
  void attempt(const Work& work) {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(failing_);
      if (!failure_) failure_ = std::current_exception();
      failed_.store(true, std::memory_order_relaxed);
    }
  }

  // ---- the timeline

  std::size_t spans() const {
    std::size_t all = 0;
    for (const Bench& bench : benches_)
      for (const Account& account : bench.accounts) all += account.spans.size();
    return all;
  }
  void drop_first() {
    steps_.erase(steps_.begin());
    step_begins_.erase(step_begins_.begin());
    const auto before = [&](const StageSpan& span) { return span.begin < step_begins_.front(); };
    for (Bench& bench : benches_)
      for (Account& account : bench.accounts) std::erase_if(account.spans, before);
    std::erase_if(alone_spans_, before);
  }

  PipelineSize size_;
  std::size_t most_under_way_;
  bool awake_;    // whether who has nothing to do may keep a core for a while
  bool settled_;  // whether threads keep to their stages
  std::array<Bench, kStages> benches_;
  Ring proposed_;
  std::vector<Queue> queues_;  // each of whoever sits in its line's seat

  const Stages* stages_ = nullptr;
  std::vector<Block> blocks_;
  std::unique_ptr<std::atomic<bool>[]> weighed_;
  std::size_t flags_ = 0;
  std::uint64_t pass_ = 0;

  const Clock::time_point start_ = Clock::now();
  double in_stages_ = 0, alone_ = 0, pass_begin_ = 0, pass_end_ = -1;
  bool shows_ = false;
  Step first_step_ = 0;
  std::vector<Step> steps_;
  std::vector<double> step_begins_;
  std::vector<StageSpan> alone_spans_;

  std::mutex failing_;
  std::exception_ptr failure_;
  std::atomic<bool> failed_{false}, closed_{false};
  alignas(kApart) std::atomic<std::uint64_t> dealt_{0};
  alignas(kApart) std::atomic<std::size_t> under_way_{0}, retired_{0}, waiting_{0};
  alignas(kApart) std::atomic<std::uint32_t> news_{0};
  std::vector<std::jthread> threads_;  // last: they end before what they use
};

Pipeline::Pipeline(const PipelineSize& size) : floor_(std::make_unique<Floor>(size)) {}
Pipeline::~Pipeline() = default;

void Pipeline::run(const Stages& stages) { floor_->run(stages); }
std::size_t Pipeline::proposers() const { return floor_->size().proposers; }
std::size_t Pipeline::lines() const { return floor_->size().chains; }
void Pipeline::begin_step(Step t) { floor_->begin_step(t); }
StageRecord Pipeline::record() const { return floor_->record(); }

Pipeline::Alone::Alone(Pipeline& pipeline)
    : pipeline_(&pipeline), begin_(pipeline.floor_->now()), in_stages_(pipeline.floor_->in_stages()) {}
Pipeline::Alone::~Alone() { pipeline_->floor_->alone(begin_, pipeline_->floor_->in_stages() - in_stages_); }

}  // namespace mote
