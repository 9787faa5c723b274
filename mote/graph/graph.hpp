#pragma once
/// A dataflow graph: what a model computes, as data.
///
/// Vertices are numbered so that operands come before what uses them. Equal vertices are one: a graph is hash-consed as
/// it grows.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace mote::graph {

/// Number of a vertex in its graph.
using Id = std::uint32_t;

enum class Op : std::uint8_t {
  kConstant,
  kInput,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kNegate,
  kAbs,
  kFloor,
  kSqrt,
  kExp,
  kLog,
  kSin,
  kCos,
  kTan,
  kAtan,
  kAtan2,
  kSelect,  ///< a < b ? c : d
};

/// Operands of an operation.
std::size_t arity(Op op);
/// Name of an operation, "multiply".
std::string_view name_of(Op op);

/// The mark of t itself: a mark says how a number follows t, 0 that it does not.
inline constexpr std::uint64_t kMarkOfTime = 1;
/// A bit that the marks of all operations have and t's has not.
inline constexpr std::uint64_t kMarkOfOperation = 2;

/// The mark of what an operation makes of numbers by theirs; those without one count by their values. 0 if all are.
///
/// A hash: of two ways to follow t, the chance that they have one mark is 2^-63. They are told apart by their values
/// too.
std::uint64_t mark_of(Op op, const std::array<double, 4>& values, const std::array<std::uint64_t, 4>& marks);

/// What stands behind an input.
enum class Role : std::uint8_t {
  kState,         ///< component of x_t, where it is weighed
  kBefore,        ///< component of x_{t-1}, where it is moved
  kColumn,        ///< column of the data: an observation or an input
  kTime,          ///< t
  kSchedule,      ///< number that the model computes from t alone
  kNormal,        ///< normal number drawn for a move; normal and uniform ones are counted together
  kUniform,       ///< uniform number drawn for a move
  kPriorNormal,   ///< normal number drawn for x_0
  kPriorUniform,  ///< uniform number drawn for x_0
};

struct Vertex {
  Op op = Op::kConstant;
  std::array<Id, 4> args{};  ///< the first arity(op) are operands; of a constant that follows t, the halves of its mark
  double value = 0;          ///< of a constant
  Role role = Role::kState;  ///< of an input; kSchedule of a constant that is known to follow t
  std::uint32_t index = 0;   ///< of an input within its role; of a constant kept apart, its number

  std::span<const Id> operands() const { return {args.data(), arity(op)}; }
};

/// Whether it is a constant of one step that is known to follow t.
inline bool follows_t(const Vertex& v) { return v.op == Op::kConstant && v.role == Role::kSchedule; }

/// Whether equal constants are one vertex.
enum class Constants : std::uint8_t {
  kMerged,
  kApart,  ///< each is a vertex of its own: two recordings of one model can be laid side by side
};

class Graph {
 public:
  explicit Graph(Constants constants = Constants::kMerged) : constants_(constants) {}

  Id constant(double value);
  /// A constant of this step, that others are for at other steps; equal marks follow t alike.
  Id constant_of_step(double value, std::uint64_t mark);
  Id input(Role role, std::uint32_t index);
  /// The vertex of an operation; the first arity(op) of `args` are its operands, the others 0.
  Id operation(Op op, const std::array<Id, 4>& args);

  std::size_t size() const { return vertices_.size(); }
  const Vertex& operator[](Id id) const { return vertices_[id]; }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  bool is_constant(Id id) const { return vertices_[id].op == Op::kConstant; }

 private:
  using Key = std::array<std::uint64_t, 4>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  Id interned(const Vertex& vertex);

  Constants constants_;
  std::uint32_t apart_ = 0;
  std::vector<Vertex> vertices_;
  std::unordered_map<Key, Id, Hash> known_;
};

/// Which vertices the outputs depend on.
///
/// shape   (graph.size(),)
/// cost    O(size)
std::vector<bool> reached(const Graph& graph, std::span<const Id> outputs);

/// How often each operation occurs among the vertices that outputs depend on; a product with a constant is counted as
/// "multiply by constant".
std::map<std::string, std::size_t> operations(const Graph& graph, std::span<const Id> outputs);

}  // namespace mote::graph
