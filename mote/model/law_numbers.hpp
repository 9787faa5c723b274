#pragma once
/// Stand-ins for the number types of later engines, for the laws of models: a recording Node (a graph), a Pack (a
/// vector of four), and draws that are read from lists.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mote/model/model.hpp"

namespace mote::laws {

/// A dataflow graph recorded by running a model's lines on Node: operations in order, evaluated later.
class Tape {
 public:
  using Operation = double (*)(double, double, double);
  int record(Operation operation, int a = -1, int b = -1, int c = -1, double value = 0) {
    steps_.push_back({operation, a, b, c, value});
    return static_cast<int>(steps_.size()) - 1;
  }
  int input() { return record(nullptr); }
  std::size_t size() const { return steps_.size(); }

  /// The value of every node, with the inputs (in order of their creation) set to `inputs`.
  std::vector<double> evaluate(const std::vector<double>& inputs) const {
    std::vector<double> values;
    std::size_t next_input = 0;
    for (const auto& step : steps_) {
      const auto at = [&](int i) { return i < 0 ? step.value : values[static_cast<std::size_t>(i)]; };
      values.push_back(step.operation == nullptr ? inputs.at(next_input++)
                                                 : step.operation(at(step.a), at(step.b), at(step.c)));
    }
    return values;
  }
  static Tape*& current() {
    static Tape* tape = nullptr;
    return tape;
  }

 private:
  struct Entry {
    Operation operation;
    int a, b, c;
    double value;
  };
  std::vector<Entry> steps_;
};

/// A number that records what is done with it.
struct Node {
  int id;
  Node() : id(-1) {}
  explicit Node(double constant)
      : id(record([](double value, double, double) { return value; }, -1, -1, -1, constant)) {}
  static int record(Tape::Operation f, int a, int b = -1, int c = -1, double value = 0) {
    return Tape::current()->record(f, a, b, c, value);
  }
  static Node make(Tape::Operation f, Node a, Node b = {}, Node c = {}) {
    Node node;
    node.id = record(f, a.id, b.id, c.id);
    return node;
  }
  friend Node operator+(Node a, Node b) {
    return make([](double x, double y, double) { return x + y; }, a, b);
  }
  friend Node operator-(Node a, Node b) {
    return make([](double x, double y, double) { return x - y; }, a, b);
  }
  friend Node operator*(Node a, Node b) {
    return make([](double x, double y, double) { return x * y; }, a, b);
  }
  friend Node operator/(Node a, Node b) {
    return make([](double x, double y, double) { return x / y; }, a, b);
  }
  friend Node operator-(Node a) {
    return make([](double x, double, double) { return -x; }, a);
  }
  friend Node less(Node a, Node b) {
    return make([](double x, double y, double) { return x < y ? 1.0 : 0.0; }, a, b);
  }
  friend Node select(Node c, Node a, Node b) {
    return make([](double k, double x, double y) { return k != 0 ? x : y; }, c, a, b);
  }
  friend Node atan2(Node a, Node b) {
    return make([](double x, double y, double) { return std::atan2(x, y); }, a, b);
  }
#define MOTE_UNARY(f)                                                   \
  friend Node f(Node a) {                                               \
    return make([](double x, double, double) { return std::f(x); }, a); \
  }
  MOTE_UNARY(sqrt)
  MOTE_UNARY(exp)
  MOTE_UNARY(log)
  MOTE_UNARY(sin)
  MOTE_UNARY(cos)
  MOTE_UNARY(tan)
  MOTE_UNARY(atan)
  MOTE_UNARY(abs)
  MOTE_UNARY(floor)
#undef MOTE_UNARY
};

/// Four numbers at once, as a vector engine holds them.
struct Pack {
  using Number = double;
  static constexpr std::size_t kLanes = 4;
  std::array<double, kLanes> v{};
  Pack() = default;
  explicit Pack(double all) { v.fill(all); }
  static Pack load(const double* from) {
    Pack out;
    std::copy_n(from, kLanes, out.v.begin());
    return out;
  }
  void store(double* to) const { std::copy_n(v.begin(), kLanes, to); }
  template <class F, class... P>
  static Pack map(F f, const P&... packs) {
    Pack out;
    for (std::size_t i = 0; i < kLanes; ++i) out.v[i] = f(packs.v[i]...);
    return out;
  }
  friend Pack operator+(Pack a, Pack b) {
    return map([](double x, double y) { return x + y; }, a, b);
  }
  friend Pack operator-(Pack a, Pack b) {
    return map([](double x, double y) { return x - y; }, a, b);
  }
  friend Pack operator*(Pack a, Pack b) {
    return map([](double x, double y) { return x * y; }, a, b);
  }
  friend Pack operator/(Pack a, Pack b) {
    return map([](double x, double y) { return x / y; }, a, b);
  }
  friend Pack operator-(Pack a) {
    return map([](double x) { return -x; }, a);
  }
  friend Pack fma(Pack a, Pack b, Pack c) { return a * b + c; }
  friend Pack fnma(Pack a, Pack b, Pack c) { return c - a * b; }
  friend Pack less(Pack a, Pack b) {
    return map([](double x, double y) { return x < y ? 1.0 : 0.0; }, a, b);
  }
  friend Pack select(Pack c, Pack a, Pack b) {
    return map([](double k, double x, double y) { return k != 0 ? x : y; }, c, a, b);
  }
  friend Pack atan2(Pack a, Pack b) {
    return map([](double x, double y) { return std::atan2(x, y); }, a, b);
  }
#define MOTE_UNARY(f)                                  \
  friend Pack f(Pack a) {                              \
    return map([](double x) { return std::f(x); }, a); \
  }
  MOTE_UNARY(sqrt)
  MOTE_UNARY(exp)
  MOTE_UNARY(log)
  MOTE_UNARY(sin)
  MOTE_UNARY(cos)
  MOTE_UNARY(tan)
  MOTE_UNARY(atan)
  MOTE_UNARY(abs)
  MOTE_UNARY(floor)
#undef MOTE_UNARY
};

/// Draws that are read from lists, so that every number type gets the same ones; counts what is taken.
template <class S>
struct ListedDraw {
  std::vector<S> normals, uniforms;
  std::size_t taken_normals = 0, taken_uniforms = 0;
  S normal() { return normals.at(taken_normals++); }
  S uniform() { return uniforms.at(taken_uniforms++); }
};

inline constexpr std::size_t kListed = 64;

inline ListedDraw<double> listed(Draw<double>& source) {
  ListedDraw<double> draw;
  for (std::size_t i = 0; i < kListed; ++i) {
    draw.normals.push_back(source.normal());
    draw.uniforms.push_back(source.uniform());
  }
  return draw;
}

}  // namespace mote::laws
