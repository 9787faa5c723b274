#include "mote/cluster/mpi_team.hpp"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <vector>

#include <mpi.h>

namespace mote {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30U;  // of a message: MPI counts in int
constexpr int kParcel = 0, kScan = 1, kMessage = 2;        // tags
constexpr std::size_t kMostSent = 64;                      // messages that have not arrived yet

int as_int(std::size_t number) { return static_cast<int>(number); }

// NOLINTNEXTLINE(readability-non-const-parameter): the type that MPI calls
void add_sums(void* in, void* in_out, int* length, MPI_Datatype*) {
  const auto* const from = static_cast<const ExactSum*>(in);
  auto* const to = static_cast<ExactSum*>(in_out);
  for (int i = 0; i < *length; ++i) to[i] += from[i];
}

class MpiTeam final : public Team {
 public:
  MpiTeam() {
    int number = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &number);
    rank_ = static_cast<std::size_t>(number);
    MPI_Comm_size(MPI_COMM_WORLD, &number);
    ranks_ = static_cast<std::size_t>(number);
    static_assert(std::is_trivially_copyable_v<ExactSum>);
    MPI_Type_contiguous(as_int(sizeof(ExactSum)), MPI_BYTE, &sum_type_);
    MPI_Type_commit(&sum_type_);
    MPI_Op_create(add_sums, 1, &sum_);
  }
  ~MpiTeam() override {
    while (!sent_.empty()) wait_for_oldest(sent_);
    MPI_Op_free(&sum_);
    MPI_Type_free(&sum_type_);
  }
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;
  MpiTeam(MpiTeam&&) = delete;
  MpiTeam& operator=(MpiTeam&&) = delete;

  std::size_t rank() const override { return rank_; }
  std::size_t ranks() const override { return ranks_; }

  void largest(std::span<double> numbers) override {
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), as_int(numbers.size()), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  }
  void add(std::span<ExactSum> sums) override {
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), as_int(sums.size()), sum_type_, sum_, MPI_COMM_WORLD);
  }
  /// By doubled distances, in log2 R rounds: an MPI_Exscan may pass the sum from rank to rank, or from each to all
  /// (SMPI).
  ExactSum before(const ExactSum& mine) override {
    ExactSum sum;
    ExactSum of_run = mine;  // of the ranks up to this one that it knows of
    for (std::size_t distance = 1; distance < ranks_; distance *= 2) {
      ExactSum received;
      requests_.clear();
      if (rank_ >= distance)
        MPI_Irecv(&received, 1, sum_type_, as_int(rank_ - distance), kScan, MPI_COMM_WORLD, next_request());
      if (rank_ + distance < ranks_)
        MPI_Isend(&of_run, 1, sum_type_, as_int(rank_ + distance), kScan, MPI_COMM_WORLD, next_request());
      MPI_Waitall(as_int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
      sum += received;
      of_run += received;
    }
    return sum;
  }
  std::vector<std::uint32_t> gather(std::uint32_t mine) override {
    std::vector<std::uint32_t> all(ranks_);
    MPI_Allgather(&mine, 1, MPI_UINT32_T, all.data(), 1, MPI_UINT32_T, MPI_COMM_WORLD);
    return all;
  }
  void exchange(std::span<const ParcelOut> out, std::span<const ParcelIn> in) override {
    requests_.clear();
    for (const ParcelIn& parcel : in)
      each_message(parcel.bytes, [&](auto bytes) {
        MPI_Irecv(bytes.data(), as_int(bytes.size()), MPI_BYTE, as_int(parcel.rank), kParcel, MPI_COMM_WORLD,
                  next_request());
      });
    for (const ParcelOut& parcel : out)
      each_message(parcel.bytes, [&](auto bytes) {
        MPI_Isend(bytes.data(), as_int(bytes.size()), MPI_BYTE, as_int(parcel.rank), kParcel, MPI_COMM_WORLD,
                  next_request());
      });
    MPI_Waitall(as_int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  }
  void complete(std::span<std::byte> column, std::span<const std::size_t> begins) override {
    if (column.empty()) return;
    MPI_Datatype const element = column.size() / begins.back() == 4 ? MPI_UINT32_T : MPI_UINT64_T;
    counts_.resize(ranks_);
    places_.resize(ranks_);
    for (std::size_t r = 0; r < ranks_; ++r) {
      counts_[r] = as_int(begins[r + 1] - begins[r]);
      places_[r] = as_int(begins[r]);
    }
    MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, column.data(), counts_.data(), places_.data(), element,
                   MPI_COMM_WORLD);
  }
  void send(std::size_t to, std::span<const std::byte> bytes) override {
    if (sent_.size() == kMostSent) wait_for_oldest(sent_);
    while (!sent_.empty() && has_left(sent_.front())) sent_.pop_front();
    Sent& message = sent_.emplace_back();
    message.bytes.assign(bytes.begin(), bytes.end());
    MPI_Isend(message.bytes.data(), as_int(bytes.size()), MPI_BYTE, as_int(to), kMessage, MPI_COMM_WORLD,
              &message.request);
  }
  void expect(std::size_t from, std::span<std::byte> bytes) override {
    MPI_Irecv(bytes.data(), as_int(bytes.size()), MPI_BYTE, as_int(from), kMessage, MPI_COMM_WORLD,
              &expected_.emplace_back().request);
  }
  void await() override { wait_for_oldest(expected_); }
  void share(std::span<std::byte> bytes) override {
    each_message(bytes, [](auto part) { MPI_Bcast(part.data(), as_int(part.size()), MPI_BYTE, 0, MPI_COMM_WORLD); });
  }

 private:
  struct Expected {
    MPI_Request request{};
  };
  struct Sent {
    MPI_Request request{};
    std::vector<std::byte> bytes = {};
  };
  template <class Message>
  static void wait_for_oldest(std::deque<Message>& messages) {
    MPI_Wait(&messages.front().request, MPI_STATUS_IGNORE);
    messages.pop_front();
  }
  static bool has_left(Sent& message) {
    int left = 0;
    MPI_Test(&message.request, &left, MPI_STATUS_IGNORE);
    return left != 0;
  }

  template <class Byte, class Do>
  static void each_message(std::span<Byte> bytes, const Do& message) {
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(kMostBytes, bytes.size())))
      message(bytes.first(std::min(kMostBytes, bytes.size())));
  }
  MPI_Request* next_request() { return &requests_.emplace_back(); }

  std::size_t rank_ = 0, ranks_ = 1;
  MPI_Datatype sum_type_{};
  MPI_Op sum_{};
  std::vector<MPI_Request> requests_;
  std::vector<int> counts_, places_;  // of a column's parts
  std::deque<Sent> sent_;             // the oldest first
  std::deque<Expected> expected_;     // likewise
};

}  // namespace

MpiSession::MpiSession(int& count, char**& words) { MPI_Init(&count, &words); }

MpiSession::~MpiSession() { MPI_Finalize(); }

void MpiSession::abort(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();
}

std::unique_ptr<Team> make_mpi_team() { return std::make_unique<MpiTeam>(); }

}  // namespace mote
